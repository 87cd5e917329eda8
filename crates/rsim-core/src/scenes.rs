//! Named situations, shared by tests, benchmarks and examples.

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::{Batch, SimConfig, World};

/// A start, and how its robots are driven.
#[derive(Debug, Clone)]
pub struct Scene {
    /// For benchmark and error labels.
    pub name: &'static str,
    /// What is played with.
    pub config: SimConfig,
    /// The row that it starts from.
    pub start: Vec<f32>,
    /// What the robots do.
    pub driver: Driver,
}

/// How the robots of a scene are driven.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Driver {
    /// Every robot gets these wheel speeds, rad/s.
    Constant([f32; 2]),
    /// Each robot's wheel speeds are drawn anew every ten steps.
    Random,
    /// All robots drive at the ball, all the time: a crowd.
    Chase,
}

/// Nobody drives, one ball rolls along x with nothing in its way for 1.2 m.
pub fn rolling_ball(speed: f32) -> Scene {
    let mut scene = vss_3v3("rolling_ball", &LINED_UP, Driver::Constant([0.0, 0.0]));
    scene.set_ball([-0.6, 0.0], [speed, 0.0]);
    scene
}

/// Six robots spread over the field, driving at random.
pub fn random_play() -> Scene {
    vss_3v3("random", &SPREAD, Driver::Random)
}

/// Six robots that all chase the ball: contacts all the time.
pub fn chase() -> Scene {
    vss_3v3("crowd", &SPREAD, Driver::Chase)
}

/// Six robots and the ball within 25 cm, pushing: many contacts from the first tick.
pub fn crowded_kickoff() -> Scene {
    vss_3v3("crowded_kickoff", &CROWDED, Driver::Chase)
}

/// Robot 0 alone in the middle of an empty field, at rest, facing +x.
pub fn lone_robot(wheels: [f32; 2]) -> Scene {
    let config = SimConfig { n_blue: 1, n_yellow: 0, ..SimConfig::VSS_3V3 };
    let mut scene = Scene::at("lone_robot", config, &[[0.0, 0.0, 0.0]], Driver::Constant(wheels));
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    scene
}

/// Poses are x (m), y (m), heading (degrees).
const LINED_UP: [[f32; 3]; 6] = [
    [-0.6, 0.5, 0.0],
    [-0.4, 0.5, 0.0],
    [-0.2, 0.5, 0.0],
    [0.6, -0.5, 180.0],
    [0.4, -0.5, 180.0],
    [0.2, -0.5, 180.0],
];
const SPREAD: [[f32; 3]; 6] = [
    [-0.6, 0.0, 0.0],
    [-0.3, 0.35, -30.0],
    [-0.3, -0.35, 30.0],
    [0.6, 0.0, 180.0],
    [0.3, 0.35, 210.0],
    [0.3, -0.35, 150.0],
];
const CROWDED: [[f32; 3]; 6] = [
    [-0.07, 0.0, 0.0],
    [-0.07, 0.1, -45.0],
    [-0.07, -0.1, 45.0],
    [0.07, 0.0, 180.0],
    [0.07, 0.1, 225.0],
    [0.07, -0.1, 135.0],
];

fn vss_3v3(name: &'static str, poses: &[[f32; 3]], driver: Driver) -> Scene {
    Scene::at(name, SimConfig::VSS_3V3, poses, driver)
}

impl Scene {
    /// Robots at these poses (x and y in m, heading in degrees), ball at rest at the centre.
    ///
    /// # Panics
    /// When there is not one pose for each robot.
    pub fn at(name: &'static str, config: SimConfig, poses: &[[f32; 3]], driver: Driver) -> Self {
        assert_eq!(poses.len(), config.n_robots(), "one pose for each robot");
        let mut start = vec![0.0; config.row_size()];
        for (columns, [x, y, degrees]) in robots_mut(&mut start).zip(poses) {
            let (sin, cos) = degrees.to_radians().sin_cos();
            columns[..4].copy_from_slice(&[*x, *y, cos, sin]);
        }
        Self { name, config, start, driver }
    }

    /// Puts the ball somewhere, with a velocity.
    pub fn set_ball(&mut self, position: [f32; 2], velocity: [f32; 2]) {
        self.start[..2].copy_from_slice(&position);
        self.start[2..4].copy_from_slice(&velocity);
    }

    /// A match at the start of the scene.
    ///
    /// # Panics
    /// When the scene is not one that a match can start from: a slip in this file or in a test.
    pub fn world(&self) -> World {
        let mut world = World::new(&self.config).expect("the scene's configuration is valid");
        world.place(&self.start).expect("the scene's start is valid");
        world
    }

    /// Many matches at the start of the scene, and their rows.
    ///
    /// # Panics
    /// As [`Scene::world`].
    pub fn batch(&self, worlds: usize, threads: usize) -> (Batch, Vec<f32>) {
        let mut batch = Batch::new(&self.config, worlds, threads).expect("a valid configuration");
        let mut rows = vec![0.0; worlds * self.config.row_size()];
        let starts = self.start.repeat(worlds);
        batch.place(&vec![true; worlds], &starts, &mut rows).expect("a valid start");
        (batch, rows)
    }

    /// Commands of one world at control step `step`, given its row. `seed` sets random play apart.
    pub fn commands(&self, row: &[f32], step: u64, seed: u64) -> Vec<f32> {
        let wheels = |(index, robot): (usize, &[f32])| match self.driver {
            Driver::Constant(wheels) => wheels,
            Driver::Random => {
                let draw = |wheel: u64| uniform(seed ^ (step / 10 * 64 + index as u64 * 2 + wheel));
                [draw(0), draw(1)].map(|share| share * self.config.robot.drive.max_wheel_speed)
            }
            Driver::Chase => self.wheels_towards(robot, [row[0], row[1]]),
        };
        robots(row).enumerate().flat_map(wheels).collect()
    }

    /// Plays `steps` control steps of one world and returns the rows, and the contacts seen.
    ///
    /// # Panics
    /// When a state becomes non-finite.
    pub fn play(&self, world: &mut World, steps: u64) -> (Vec<f32>, usize) {
        let mut row = vec![0.0; self.config.row_size()];
        world.write_row(&mut row);
        let (mut rows, mut contacts) = (Vec::new(), 0);
        for step in 0..steps {
            world.step(&self.commands(&row, step, 0)).expect("the state stays finite");
            world.write_row(&mut row);
            contacts += world.contacts();
            rows.extend_from_slice(&row);
        }
        (rows, contacts)
    }

    fn wheels_towards(&self, robot: &[f32], target: [f32; 2]) -> [f32; 2] {
        let [x, y, cos, sin, ..] = robot else { unreachable!("a robot has {ROBOT_COLUMNS:?}") };
        let (to_x, to_y) = (target[0] - x, target[1] - y);
        let (ahead, aside) = (to_x * cos + to_y * sin, to_y * cos - to_x * sin);
        let top = self.config.robot.drive.max_wheel_speed;
        let turn = aside.atan2(ahead) * 0.3;
        [(1.0 - turn) * top, (1.0 + turn) * top]
    }
}

/// The columns of each robot in a row.
pub fn robots(row: &[f32]) -> impl Iterator<Item = &[f32]> {
    row[BALL_COLUMNS.len()..].chunks_exact(ROBOT_COLUMNS.len())
}

/// Likewise, to change.
pub fn robots_mut(row: &mut [f32]) -> impl Iterator<Item = &mut [f32]> {
    row[BALL_COLUMNS.len()..].chunks_exact_mut(ROBOT_COLUMNS.len())
}

/// A number in [-1, 1) that depends on `key` alone (`SplitMix64`).
pub fn uniform(key: u64) -> f32 {
    let mut bits = key.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^= bits >> 31;
    ((bits >> 40) as f32) / 8_388_608.0 - 1.0
}
