//! The rules: a table for each league, and one small function for each rule.

pub mod ssl;
pub mod vsss;

use crate::config::League;
use crate::error::RefereeError;
use crate::game::Game;
use crate::moment::Moment;
use crate::ruling::Rulings;

/// A rule.
#[derive(Debug, Clone, Copy)]
pub struct Rule {
    /// Name of its event, and of its switch.
    pub name: &'static str,
    /// Its content, in short.
    pub summary: &'static str,
    /// Paragraph of the source.
    pub source: &'static str,
    /// Name of its function, with its module.
    pub function: &'static str,
    /// Judges a step.
    pub judge: fn(&mut Game, &Moment, &mut Rulings),
}

/// Declares a table of rules.
macro_rules! table {
    ($($name:literal, $($module:ident)::+, $source:literal, $summary:literal;)*) => {
        &[$($crate::rules::Rule {
            name: $name,
            summary: $summary,
            source: $source,
            function: stringify!($($module)::+),
            judge: $($module)::+,
        },)*]
    };
}
pub(crate) use table;

/// The rules of a league, in the order in which they are judged: the first that stops play decides how it
/// goes on.
pub const fn of_league(league: League) -> &'static [Rule] {
    match league {
        League::Ssl => ssl::RULES,
        League::Vsss => vsss::RULES,
    }
}

/// A rule of any league by its name.
///
/// # Errors
/// If there is none.
pub fn find(name: &str) -> Result<&'static Rule, RefereeError> {
    let all = || ssl::RULES.iter().chain(vsss::RULES);
    all().find(|rule| rule.name == name).ok_or_else(|| {
        let mut known: Vec<_> = all().map(|rule| rule.name).collect();
        known.sort_unstable();
        known.dedup();
        RefereeError::UnknownRule { name: name.to_owned(), known: known.join(", ") }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::events::EventKind;

    #[test]
    fn rules_have_the_names_of_their_events() {
        for rule in ssl::RULES.iter().chain(vsss::RULES) {
            assert!(EventKind::ALL.iter().any(|(_, _, name)| *name == rule.name), "{}", rule.name);
            assert!(find(rule.name).is_ok());
        }
    }
}
