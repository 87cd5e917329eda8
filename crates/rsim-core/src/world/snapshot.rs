//! Snapshots as bytes: a header that identifies the simulator, a checksum, and the states.

use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::PHYSICS_VERSION;
use crate::error::SnapshotError;
use crate::models::config::SimConfig;

/// Beginning of all snapshots. The last character counts the layouts of states that had the same physics.
const MAGIC: [u8; 8] = *b"rsimsnae";
/// Part of the beginning that all layouts share.
const ANY_LAYOUT: &[u8] = b"rsimsna";
const HEADER_SIZE: usize = 28;

/// Identity of the simulator of a snapshot.
pub(super) struct Header {
    config_hash: u32,
    worlds: u64,
}

impl Header {
    /// The header of a kind of snapshots; the kind of a simulator's has no name.
    pub(super) fn new(config: &SimConfig, worlds: usize, kind: &[u8]) -> Self {
        let identity = [&encode(config), kind].concat();
        Self { config_hash: crc32fast::hash(&identity), worlds: worlds as u64 }
    }
}

pub(super) fn write(header: &Header, states: &impl Serialize) -> Vec<u8> {
    let body = encode(states);
    let mut bytes = Vec::with_capacity(HEADER_SIZE + body.len());
    bytes.extend(MAGIC);
    bytes.extend(PHYSICS_VERSION.to_le_bytes());
    bytes.extend(header.config_hash.to_le_bytes());
    bytes.extend(header.worlds.to_le_bytes());
    bytes.extend(crc32fast::hash(&body).to_le_bytes());
    bytes.extend(body);
    bytes
}

pub(super) fn read<T: DeserializeOwned>(header: &Header, bytes: &[u8]) -> Result<T, SnapshotError> {
    if !bytes.starts_with(&MAGIC) {
        let is_other = bytes.starts_with(ANY_LAYOUT);
        return Err(if is_other { SnapshotError::Layout } else { SnapshotError::Foreign });
    }
    if bytes.len() < HEADER_SIZE {
        return Err(SnapshotError::Damaged("it ends inside its header"));
    }
    let (head, body) = bytes.split_at(HEADER_SIZE);
    let word = |at: usize| u32::from_le_bytes([head[at], head[at + 1], head[at + 2], head[at + 3]]);
    if word(8) != PHYSICS_VERSION {
        return Err(SnapshotError::Version { found: word(8), expected: PHYSICS_VERSION });
    }
    if word(12) != header.config_hash || head[16..24] != header.worlds.to_le_bytes() {
        return Err(SnapshotError::OtherConfig);
    }
    if word(24) != crc32fast::hash(body) {
        return Err(SnapshotError::Damaged("its checksum does not match"));
    }
    match postcard::take_from_bytes(body) {
        Ok((states, [])) => Ok(states),
        _ => Err(SnapshotError::Damaged("its contents cannot be read")),
    }
}

fn encode(value: &impl Serialize) -> Vec<u8> {
    postcard::to_stdvec(value).expect("plain data always encodes")
}
