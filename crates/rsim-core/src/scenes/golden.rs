//! Scenes whose rows are hashed, so that no platform and no change of the code gives other states unnoticed.

use super::{Driver, Scene};
use crate::columns::{BALL_COLUMNS, BALL_PARAMETERS, ROBOT_COLUMNS, ROBOT_PARAMETERS};
use crate::models::ball::BallModel;
use crate::models::config::{EngineKind, SimConfig};
use crate::models::field::Field;
use crate::models::robot::RobotModel;

/// 5 s of a match.
pub const STEPS: u64 = 200;

/// Both leagues; rolling, contacts, chips, the dribbler, kicks, crowds, walls, own parameters.
pub fn scenes() -> Vec<(&'static str, Scene)> {
    let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..super::vss(5, 5) };
    let wheels =
        super::config(Field::SSL_A, BallModel::GRSIM, &RobotModel::SSL_GENERIC_WHEELS, 3, 3);
    let random = |config: SimConfig| Scene::lined_up("random", config, Driver::Random);
    vec![
        ("vss_rolling_ball", super::rolling_ball(2.5)),
        ("vss_random", super::random_play()),
        ("vss_crowd", super::chase()),
        ("vss_crowded_kickoff", super::crowded_kickoff()),
        ("vss_5v5_crowd", Scene::lined_up("crowd", vss_5v5, Driver::Chase)),
        ("vss_skid", skid()),
        ("ssl_random", super::ssl_random(super::ssl(3, 3))),
        ("ssl_crowd", super::ssl_chase(super::ssl(6, 6))),
        ("ssl_wheels_random", random(wheels)),
        ("ssl_kick", super::ball_in_mouth(&[0.5, 0.0, 1.0, 6.0, 0.0, 0.0])),
        ("ssl_chip", super::ball_in_mouth(&[0.0, 0.3, 0.0, 3.0, 3.5, 0.0])),
        ("ssl_dribble", super::ball_in_mouth(&[0.6, 0.2, 1.5, 0.0, 0.0, 1.0])),
        ("ssl_corner", corner()),
        ("ssl_own_parameters", own_parameters()),
    ]
}

/// A VSSS robot that slides sideways and spins at full throttle.
fn skid() -> Scene {
    let mut scene = super::lone_robot([46.0, 40.0]);
    scene.set_robot_column(0, "v_y", 1.0);
    scene.set_robot_column(0, "v_theta", 20.0);
    scene
}

/// Three robots push a flying ball into a corner.
fn corner() -> Scene {
    let poses = [[4.55, 2.55, 45.0], [4.4, 2.4, 45.0], [4.25, 2.25, 45.0]];
    let driver = Driver::Constant(vec![vec![2.0, 0.0, 0.0, 0.0, 0.0, 0.0]; 3]);
    let mut scene = Scene::at("corner", super::ssl(3, 0), &poses, driver);
    scene.set_ball([4.7, 2.7], [1.0, 1.5]);
    scene.set_ball_column("z", 0.05);
    scene
}

/// A world whose factors all differ from 1.
fn own_parameters() -> Scene {
    let mut scene = super::ssl_chase(super::ssl(2, 2));
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
pub fn hash(scene: &Scene) -> u64 {
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

/// Hashes of all scenes under each engine, by the names of both, in hexadecimal digits.
pub fn hashes() -> Vec<(String, String)> {
    let all = EngineKind::ALL.into_iter().flat_map(|engine| {
        scenes().into_iter().map(move |(name, mut scene)| {
            scene.config.engine = engine;
            (format!("{}_{name}", engine.name()), format!("{:016x}", hash(&scene)))
        })
    });
    all.collect()
}
