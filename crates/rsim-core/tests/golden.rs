//! Hashes of the rows of fourteen scenes under each engine: equal starts and commands may give other states only under
//! another [`PHYSICS_VERSION`]. `make golden` renews the hashes once the version is raised.

use std::collections::BTreeMap;
use std::fmt::Write;

use rsim_core::PHYSICS_VERSION;
use rsim_core::scenes::{self, golden};

/// File with the version, then one hash per line.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden.txt");

/// Environment variable that makes the test rewrite the file.
const RENEW: &str = "RSIM_RENEW_GOLDEN";

/// Version and hashes in the file; none if there is no file.
fn kept() -> (Option<u32>, BTreeMap<String, String>) {
    let text = std::fs::read_to_string(FILE).unwrap_or_default();
    let mut lines = text.lines().filter_map(|line| line.split_once(' '));
    let version = lines.next().map(|(_, version)| version.parse().expect("a version"));
    (version, lines.map(|(name, hash)| (name.to_owned(), hash.to_owned())).collect())
}

#[test]
fn physics_change_only_under_another_version() {
    let found = golden::hashes();
    let (version, kept) = kept();
    let changed: Vec<_> = found
        .iter()
        .filter(|(name, hash)| kept.get(name).is_some_and(|kept| kept != hash))
        .map(|(name, _)| name)
        .collect();
    let same_version = version == Some(PHYSICS_VERSION);
    assert!(
        !same_version || changed.is_empty(),
        "physics of version {PHYSICS_VERSION} give other states than before in {changed:?}: raise \
         PHYSICS_VERSION, then `make golden`"
    );
    if std::env::var_os(RENEW).is_some() {
        let mut text = format!("PHYSICS_VERSION {PHYSICS_VERSION}\n");
        for (name, hash) in &found {
            writeln!(text, "{name} {hash}").expect("a string takes all");
        }
        std::fs::write(FILE, text).expect("the file can be written");
        return;
    }
    let complete =
        found.iter().all(|(name, _)| kept.contains_key(name)) && kept.len() == found.len();
    assert!(
        same_version && complete,
        "{FILE} is of version {version:?} with {} scenes: `make golden` renews it",
        kept.len()
    );
}

#[test]
fn scenes_that_differ_have_hashes_that_differ() {
    let slower = scenes::rolling_ball(2.4);
    assert_ne!(golden::hash(&scenes::rolling_ball(2.5)), golden::hash(&slower));
    let crowded = golden::scenes()
        .into_iter()
        .filter(|(_, scene)| scene.play(&mut scene.world(), golden::STEPS).1 > 100);
    assert!(crowded.count() >= 6, "scenes with contacts");
}
