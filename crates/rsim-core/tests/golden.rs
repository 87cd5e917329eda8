//! Hashes of the rows of fourteen scenes under each engine: equal starts and commands may give other states only under
//! another [`PHYSICS_VERSION`]. `make golden` renews the hashes once the version is raised.

use std::collections::BTreeMap;
use std::fmt::Write;

use rsim_core::columns::{BALL_COLUMNS, BALL_PARAMETERS, ROBOT_COLUMNS, ROBOT_PARAMETERS};
use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{BallModel, EngineKind, Field, PHYSICS_VERSION, RobotModel, SimConfig};

/// File with the version, then one hash per line.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden.txt");

/// Environment variable that makes the test rewrite the file.
const RENEW: &str = "RSIM_RENEW_GOLDEN";

/// 5 s of a match.
const STEPS: u64 = 200;

/// Both leagues; rolling, contacts, chips, the dribbler, kicks, crowds, walls, own parameters.
fn scenes() -> Vec<(&'static str, Scene)> {
    let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..scenes::vss(5, 5) };
    let wheels =
        scenes::config(Field::SSL_A, BallModel::GRSIM, &RobotModel::SSL_GENERIC_WHEELS, 3, 3);
    let random = |config: SimConfig| Scene::lined_up("random", config, Driver::Random);
    vec![
        ("vss_rolling_ball", scenes::rolling_ball(2.5)),
        ("vss_random", scenes::random_play()),
        ("vss_crowd", scenes::chase()),
        ("vss_crowded_kickoff", scenes::crowded_kickoff()),
        ("vss_5v5_crowd", Scene::lined_up("crowd", vss_5v5, Driver::Chase)),
        ("vss_skid", skid()),
        ("ssl_random", scenes::ssl_random(scenes::ssl(3, 3))),
        ("ssl_crowd", scenes::ssl_chase(scenes::ssl(6, 6))),
        ("ssl_wheels_random", random(wheels)),
        ("ssl_kick", scenes::ball_in_mouth(&[0.5, 0.0, 1.0, 6.0, 0.0, 0.0])),
        ("ssl_chip", scenes::ball_in_mouth(&[0.0, 0.3, 0.0, 3.0, 3.5, 0.0])),
        ("ssl_dribble", scenes::ball_in_mouth(&[0.6, 0.2, 1.5, 0.0, 0.0, 1.0])),
        ("ssl_corner", corner()),
        ("ssl_own_parameters", own_parameters()),
    ]
}

/// A VSSS robot that slides sideways and spins at full throttle.
fn skid() -> Scene {
    let mut scene = scenes::lone_robot([46.0, 40.0]);
    scene.set_robot_column(0, "v_y", 1.0);
    scene.set_robot_column(0, "v_theta", 20.0);
    scene
}

/// Three robots push a flying ball into a corner.
fn corner() -> Scene {
    let poses = [[4.55, 2.55, 45.0], [4.4, 2.4, 45.0], [4.25, 2.25, 45.0]];
    let driver = Driver::Constant(vec![vec![2.0, 0.0, 0.0, 0.0, 0.0, 0.0]; 3]);
    let mut scene = Scene::at("corner", scenes::ssl(3, 0), &poses, driver);
    scene.set_ball([4.7, 2.7], [1.0, 1.5]);
    scene.set_ball_column("z", 0.05);
    scene
}

/// A world whose factors all differ from 1.
fn own_parameters() -> Scene {
    let mut scene = scenes::ssl_chase(scenes::ssl(2, 2));
    let of_robots = ROBOT_PARAMETERS.len() * scene.config.n_robots();
    let parameters =
        (0..BALL_PARAMETERS.len() + of_robots).map(|nth| 0.8 + 0.05 * (nth % 9) as f32);
    scene.parameters = Some(parameters.collect());
    scene
}

/// Columns that no physics read, and that came after the hashes.
const NOT_HASHED: [&str; 4] =
    ["absent", "seconds_since_touch", "speed_after_touch", "height_since_touch"];

/// Hash (FNV-1a) of all rows of a match.
fn hash(scene: &Scene) -> u64 {
    let (rows, _) = scene.play(&mut scene.world(), STEPS);
    let columns = BALL_COLUMNS.into_iter().chain(ROBOT_COLUMNS.repeat(scene.config.n_robots()));
    rows.iter()
        .zip(columns.collect::<Vec<_>>().iter().cycle())
        .filter(|(_, column)| !NOT_HASHED.contains(column))
        .flat_map(|(value, _)| value.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        })
}

/// Version and hashes in the file; none if there is no file.
fn kept() -> (Option<u32>, BTreeMap<String, String>) {
    let text = std::fs::read_to_string(FILE).unwrap_or_default();
    let mut lines = text.lines().filter_map(|line| line.split_once(' '));
    let version = lines.next().map(|(_, version)| version.parse().expect("a version"));
    (version, lines.map(|(name, hash)| (name.to_owned(), hash.to_owned())).collect())
}

/// Hashes of all scenes under each engine.
fn hashes() -> Vec<(String, String)> {
    let all = EngineKind::ALL.into_iter().flat_map(|engine| {
        scenes().into_iter().map(move |(name, mut scene)| {
            scene.config.engine = engine;
            (format!("{}_{name}", engine.name()), format!("{:016x}", hash(&scene)))
        })
    });
    all.collect()
}

#[test]
fn physics_change_only_under_another_version() {
    let found = hashes();
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
    assert_ne!(hash(&scenes::rolling_ball(2.5)), hash(&slower));
    let crowded =
        scenes().into_iter().filter(|(_, scene)| scene.play(&mut scene.world(), STEPS).1 > 100);
    assert!(crowded.count() >= 6, "scenes with contacts");
}
