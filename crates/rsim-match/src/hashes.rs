//! Hashes of whole matches: the same on every platform.

use crate::error::MatchError;
use crate::network::Network;
use crate::setup::Setup;
use crate::whole_match::Match;
use rsim_referee::Team;

/// Steps of a hashed match: 50 s.
const STEPS: usize = 2000;

/// Matches that are hashed: name, field, robots of a team.
const MATCHES: [(&str, &str, usize); 4] = [
    ("ssl_6v6", "ssl_b", 6),
    ("ssl_11v11", "ssl_a", 11),
    ("ssl_sensed", "ssl_b", 3),
    ("ssl_slippery", "ssl_b", 4),
];

/// Adds numbers to a hash (FNV-1a).
pub fn add(hash: u64, numbers: &[f32]) -> u64 {
    numbers
        .iter()
        .flat_map(|number| number.to_bits().to_le_bytes())
        .fold(hash, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// Hash before any number.
pub const START: u64 = 0xcbf2_9ce4_8422_2325;

/// Plays a match for some steps, and hashes its rows and states.
///
/// # Errors
/// As [`Match::step`].
pub fn play(one: &mut Match, steps: usize) -> Result<u64, MatchError> {
    let mut hash = START;
    for _ in 0..steps {
        one.step()?;
        hash = add(add(hash, one.row()), &one.game().row());
    }
    Ok(hash)
}

/// Hashes of matches between scripted teams, by name: with and without senses and other physics.
///
/// # Errors
/// As [`play`].
pub fn scripted() -> Result<Vec<(&'static str, u64)>, MatchError> {
    let mut all = Vec::new();
    for (name, field, robots) in MATCHES {
        let mut setup = Setup::new(field, robots, robots, 7);
        let conditions = &mut setup.conditions;
        if name == "ssl_sensed" {
            let numbers = [("frame_rate", 60.0), ("delay", 0.05), ("ball_position_noise", 0.003)];
            let more = [("tracker", 1.0), ("command_delay", 0.03), ("kick_speed_noise", 0.05)];
            let named = numbers.into_iter().chain(more);
            conditions.sensing = named.map(|(name, value)| (name.to_owned(), value)).collect();
        } else if name == "ssl_slippery" {
            conditions.robots.insert("traction".to_owned(), 0.5);
            conditions.ball.insert("rolling_deceleration".to_owned(), 0.5);
        }
        let mut one = Match::new(setup)?;
        one.set_scripted(Team::Blue, 1.0)?;
        one.set_scripted(Team::Yellow, 0.6)?;
        all.push((name, play(&mut one, STEPS)?));
    }
    Ok(all)
}

/// Hash of a VSSS match in which a network plays both teams.
///
/// # Errors
/// A network that does not fit; as [`play`].
pub fn network(network: &Network) -> Result<u64, MatchError> {
    let mut one = Match::new(Setup::new("vss_3v3", 3, 3, 7))?;
    for team in Team::BOTH {
        one.set_network(team, network.clone())?;
    }
    play(&mut one, STEPS)
}
