//! Policy files of both kinds: networks, and tactics of the scripted SSL team.

use crate::error::MatchError;
use crate::files;
use crate::network::Network;

/// Format of files with tactics; `python/rsoccer/policies/evolved.py` defines it.
const TACTICS_FORMAT: &str = "rsoccer-tactics-1";
/// Array of such a file.
const TACTICS: &str = "tactics";
/// Texts of such a file: the script, and the names of its numbers, parted by blanks.
const SCRIPT: &str = "script";
const NAMES: &str = "names";
/// Name of the scripted SSL team.
const TEAM: &str = "scripted";

/// Content of a policy file.
#[derive(Debug, Clone, PartialEq)]
pub enum PolicyFile {
    /// A network.
    Network(Box<Network>),
    /// Numbers by which the scripted SSL team plays.
    Tactics(Vec<f32>),
}

impl PolicyFile {
    /// Reads a policy file.
    ///
    /// # Errors
    /// Other bytes, or arrays and metadata that do not fit together. Numbers of tactics out of their ranges are
    /// refused by the side that is to play by them.
    pub fn read(bytes: &[u8]) -> Result<Self, MatchError> {
        let (mut arrays, metadata) = files::read(bytes)?;
        if metadata.get("format").is_none_or(|format| format != TACTICS_FORMAT) {
            return Ok(Self::Network(Box::new(Network::read(bytes)?)));
        }
        let wrong = |what: &str| MatchError::Policy(format!("no usable tactics: {what}"));
        let script = metadata.get(SCRIPT).map_or("nothing", String::as_str);
        if script != TEAM {
            return Err(wrong(&format!("expected those of {TEAM:?}, got {script:?}")));
        }
        let known = rsim_teams::TACTICS.map(|tactic| tactic.name).join(" ");
        if metadata.get(NAMES) != Some(&known) {
            return Err(wrong("it has numbers of another version of the scripted team"));
        }
        match (arrays.remove(TACTICS), arrays.keys().next()) {
            (Some(array), None) if array.shape.len() == 1 => Ok(Self::Tactics(array.values)),
            (Some(array), None) => {
                Err(wrong(&format!("expected one row of numbers, got shape {:?}", array.shape)))
            }
            (None, _) => Err(wrong("expected an array \"tactics\"")),
            (_, Some(name)) => Err(wrong(&format!("unknown array {name:?}"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A safetensors file with one array of some numbers.
    fn file(array: &str, numbers: &[f32], names: &str) -> Vec<u8> {
        let size = 4 * numbers.len();
        let header = format!(
            r#"{{"__metadata__": {{"format": "{TACTICS_FORMAT}", "script": "scripted", "names": "{names}"}}, "{array}": {{"dtype": "F32", "shape": [{}], "data_offsets": [0, {size}]}}}}"#,
            numbers.len()
        );
        let mut bytes = (header.len() as u64).to_le_bytes().to_vec();
        bytes.extend(header.as_bytes());
        bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        bytes
    }

    #[test]
    fn tactics_are_read_and_others_refused() {
        let names = rsim_teams::TACTICS.map(|tactic| tactic.name).join(" ");
        let numbers = rsim_teams::TACTICS.map(|tactic| tactic.default);
        let read = PolicyFile::read(&file("tactics", &numbers, &names)).expect("tactics");
        assert_eq!(read, PolicyFile::Tactics(numbers.to_vec()));
        for (array, names, word) in
            [("mean", names.as_str(), "tactics"), ("tactics", "speed", "another version")]
        {
            let error = PolicyFile::read(&file(array, &numbers, names)).expect_err("wrong");
            assert!(error.to_string().contains(word), "{error}");
        }
        let network = crate::network::tests::file(80, 2, &[]);
        assert!(matches!(PolicyFile::read(&network), Ok(PolicyFile::Network(_))));
    }
}
