//! A match before it begins, as text.

use rsim_core::{Field, League, SimConfig};
use rsim_referee::config::{HAND_ERROR, League as RuleLeague, RefereeConfig};
use rsim_referee::rules;
use serde::{Deserialize, Serialize};

use crate::conditions::Conditions;
use crate::error::MatchError;
use crate::self_play::{EPISODE_SECONDS, STUCK_SECONDS};

/// Most robots of a team.
const MAX_ROBOTS: usize = rsim_teams::MAX_ROBOTS;

/// Kind of play.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Play {
    /// A whole match under the league's referee.
    #[default]
    Match,
    /// The league's self-play task, `VSSSelfPlay-v0` or `SSLSelfPlay-v0`: episodes that begin at random places
    /// and end with a goal, after 30 s, or in VSSS with a ball that is stuck for 10 s; a ball that leaves an SSL field is repositioned.
    SelfPlay,
}

/// Field, teams and conditions of a match.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setup {
    /// Name of the field, such as `ssl_b`; its league decides on robots, ball and rules.
    pub field: String,
    /// Robots of team blue, 1 to 11.
    pub blue: usize,
    /// Robots of team yellow, 1 to 11.
    pub yellow: usize,
    /// Seed of all that is drawn.
    #[serde(default)]
    pub seed: u32,
    /// Kind of play.
    #[serde(default)]
    pub play: Play,
    /// Playing time of a half of a match, s.
    #[serde(default = "half_seconds")]
    pub half_seconds: f32,
    /// Physics and senses.
    #[serde(default)]
    pub conditions: Conditions,
}

fn half_seconds() -> f32 {
    300.0
}

impl Setup {
    /// A match with default conditions.
    pub fn new(field: &str, blue: usize, yellow: usize, seed: u32) -> Self {
        let (field, conditions) = (field.to_owned(), Conditions::default());
        let play = Play::default();
        Self { field, blue, yellow, seed, play, half_seconds: half_seconds(), conditions }
    }

    /// Configuration of the physics.
    ///
    /// # Errors
    /// An unknown field, a number of robots or a condition out of its range.
    pub fn config(&self) -> Result<SimConfig, MatchError> {
        for (name, got) in [("blue", self.blue), ("yellow", self.yellow)] {
            if !(1..=MAX_ROBOTS).contains(&got) {
                let expected = format!("1 to {MAX_ROBOTS} robots");
                return Err(MatchError::argument(name, expected, &got));
            }
        }
        let field = Field::preset(&self.field)?;
        let league = League::of(&field, "robot")?;
        let (ball, robot) = (league.ball(), league.robot());
        let mut config = SimConfig::new(field, ball, &robot, self.blue, self.yellow);
        config.sensing = self.conditions.senses()?;
        Ok(config)
    }

    /// The rules of the field's league: without extra time and shoot-out, with balls that are put in their
    /// places at once, as in the match tasks.
    pub(crate) fn rules(&self, config: &SimConfig) -> RefereeConfig {
        let field = &config.field;
        let preset = match (field.touch_line_margin > 0.0, field.inner_area_depth > 0.0) {
            (true, _) if field.name == Field::SSL_A.name => "ssl_2026_a",
            (true, _) => "ssl_2026_b",
            (false, true) => "vsss_5v5",
            (false, false) => "vsss_3v3",
        };
        let rules = RefereeConfig::preset(preset).expect("a preset's name");
        let half_seconds = self.half_seconds;
        let placement_error = if rules.league == RuleLeague::Vsss { HAND_ERROR } else { 0.0 };
        let rules = RefereeConfig {
            half_seconds,
            extra_half_seconds: 0.0,
            shootout_kicks: 0.0,
            placement_error,
            ..rules
        };
        match self.play {
            Play::Match => rules,
            Play::SelfPlay => {
                let names = rules::of_league(rules.league).iter().map(|rule| rule.name);
                // In SSL self-play nothing ends but by a goal or its time.
                let judged: &[&str] = match rules.league {
                    RuleLeague::Ssl => &["GOAL"],
                    RuleLeague::Vsss => &["GOAL", "NO_PROGRESS_IN_GAME"],
                };
                let off = names.filter(|name| !judged.contains(name)).map(str::to_owned).collect();
                RefereeConfig {
                    half_seconds: EPISODE_SECONDS,
                    halves: 1.0,
                    no_progress_seconds: STUCK_SECONDS,
                    off,
                    ..rules
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_setup_comes_back_from_its_text() {
        let text = r#"{"field": "ssl_b", "blue": 6, "yellow": 5}"#;
        let setup: Setup = serde_json::from_str(text).expect("valid");
        assert_eq!(setup, Setup::new("ssl_b", 6, 5, 0));
        let written = serde_json::to_string(&setup).expect("text");
        assert_eq!(serde_json::from_str::<Setup>(&written).expect("valid"), setup);
        let config = setup.config().expect("valid");
        assert_eq!((config.blue.len(), config.yellow.len()), (6, 5));
    }

    #[test]
    fn fields_have_the_rules_of_their_league() {
        for (field, halves) in [("ssl_a", 2.0), ("ssl_b", 2.0), ("vss_3v3", 2.0), ("vss_5v5", 2.0)]
        {
            let setup = Setup::new(field, 2, 2, 0);
            let rules = setup.rules(&setup.config().expect("valid"));
            rules.validate().expect(field);
            assert!((rules.halves - halves).abs() < 1e-9 && rules.shootout_kicks < 1e-9);
        }
    }

    #[test]
    fn wrong_setups_are_named() {
        let error = Setup::new("moon", 3, 3, 0).config().expect_err("no field").to_string();
        assert!(error.contains("moon"), "{error}");
        let error = Setup::new("ssl_b", 3, 12, 0).config().expect_err("too many").to_string();
        assert!(error.contains("yellow") && error.contains("12"), "{error}");
        assert!(serde_json::from_str::<Setup>(r#"{"field": "ssl_b", "bleu": 6}"#).is_err());
    }
}
