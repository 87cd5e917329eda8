//! Scenes that several benchmarks play; what measures is in `benches`.

use std::ops::RangeInclusive;

use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{EngineKind, Field, SimConfig};

/// Steps between two starts of a scene.
pub const EPISODE: u64 = 400;

/// A scene with the range of its contacts: a benchmark of a crowd must have a crowd.
#[derive(Debug)]
pub struct Case {
    /// League and team sizes.
    pub teams: &'static str,
    /// The scene, with the engine of scenes.
    pub scene: Scene,
    /// Range of the number of contacts in twice [`EPISODE`] steps.
    pub contacts: RangeInclusive<usize>,
}

impl Case {
    /// The scene with an engine.
    pub fn scene_with(&self, engine: EngineKind) -> Scene {
        let config = SimConfig { engine, ..self.scene.config.clone() };
        Scene { config, ..self.scene.clone() }
    }
}

/// The cases of all leagues, team sizes and kinds of play.
pub fn cases() -> Vec<Case> {
    let most = usize::MAX;
    let mut cases = vec![
        Case { teams: "vss_3v3", scene: scenes::vss_free(), contacts: 0..=0 },
        Case { teams: "vss_3v3", scene: scenes::random_play(), contacts: 50..=most },
        Case { teams: "vss_3v3", scene: scenes::chase(), contacts: 1000..=most },
    ];
    let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..scenes::vss(5, 5) };
    for driver in [Driver::Random, Driver::Chase] {
        let (name, contacts) = named(&driver, 50, 1000);
        let scene = Scene::lined_up(name, vss_5v5.clone(), driver);
        cases.push(Case { teams: "vss_5v5", scene, contacts: contacts..=most });
    }
    let ssl_a = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
    for (teams, config, random, crowd) in [
        ("ssl_1v1", scenes::ssl(1, 1), 1, 20),
        ("ssl_6v6", scenes::ssl(6, 6), 20, 1000),
        ("ssl_11v11", ssl_a, 20, 2000),
    ] {
        for driver in [Driver::STILL, Driver::Random, Driver::Chase] {
            let (name, contacts) = named(&driver, random, crowd);
            let free = driver == Driver::STILL;
            let mut scene = Scene::lined_up(name, config.clone(), driver);
            if free {
                scene.set_ball([0.0, 0.3], [0.0, 1.0]);
            }
            let contacts = if free { 0..=0 } else { contacts..=most };
            cases.push(Case { teams, scene, contacts });
        }
    }
    cases
}

/// Label of a driver, and the minimum number of contacts: `random` in random play, `crowd` in a crowd.
fn named(driver: &Driver, random: usize, crowd: usize) -> (&'static str, usize) {
    match driver {
        Driver::Constant(_) => ("free", 0),
        Driver::Random => ("random", random),
        Driver::Chase => ("crowd", crowd),
    }
}
