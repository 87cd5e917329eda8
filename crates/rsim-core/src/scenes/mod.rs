//! Scenes shared by tests, benchmarks and examples.

mod configs;
mod driver;
pub mod golden;
mod measures;
mod setup;

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, robot_column};
use crate::models::config::SimConfig;
use crate::world::World;
use crate::world::batch::Batch;

pub use configs::{config, engine, ssl, vss};
pub use driver::{Driver, driving};
pub use measures::{ball_gap, deepest_ball, deepest_robots, kinetic_energy, robot_depth};

/// A start of a match, with the commands of its robots.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Name for labels of benchmarks and errors.
    pub name: &'static str,
    /// Configuration of the match.
    pub config: SimConfig,
    /// State row of the start.
    pub start: Vec<f32>,
    /// Factors on the models' numbers.
    pub parameters: Option<Vec<f32>>,
    /// Source of the commands.
    pub driver: Driver,
}

/// The ball rolls along x at `speed` (m/s), free for 1.2 m; all robots stand still.
pub fn rolling_ball(speed: f32) -> Scene {
    let mut scene = Scene::at("rolling_ball", vss(3, 3), &LINED_UP, Driver::STILL);
    scene.set_ball([-0.6, 0.0], [speed, 0.0]);
    scene
}

/// The ball rolls slowly and meets no robot; all robots stand still.
pub fn vss_free() -> Scene {
    let mut scene = rolling_ball(0.1);
    scene.name = "free";
    scene
}

/// Six robots spread over the field, driving at random.
pub fn random_play() -> Scene {
    Scene::at("random", vss(3, 3), &SPREAD, Driver::Random)
}

/// Six robots that chase the ball, in contact all the time.
pub fn chase() -> Scene {
    Scene::at("crowd", vss(3, 3), &SPREAD, Driver::Chase)
}

/// Six robots and the ball within 25 cm, pushing: many contacts from the first tick.
pub fn crowded_kickoff() -> Scene {
    Scene::at("crowded_kickoff", vss(3, 3), &CROWDED, Driver::Chase)
}

/// SSL teams lined up in their halves, driving, kicking and dribbling at random.
pub fn ssl_random(config: SimConfig) -> Scene {
    Scene::lined_up("ssl_random", config, Driver::Random)
}

/// SSL teams lined up in their halves that chase the ball.
pub fn ssl_chase(config: SimConfig) -> Scene {
    Scene::lined_up("ssl_crowd", config, Driver::Chase)
}

/// Robot 0 alone in the middle of an empty VSSS field, at rest, facing +x.
pub fn lone_robot(wheels: [f32; 2]) -> Scene {
    let driver = Driver::Constant(vec![wheels.to_vec()]);
    let mut scene = Scene::at("lone_robot", vss(1, 0), &[[0.0, 0.0, 0.0]], driver);
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    scene
}

/// An SSL robot alone in the middle of an empty field of division B, at rest, facing +x.
pub fn lone_omni(command: &[f32]) -> Scene {
    let driver = Driver::Constant(vec![command.to_vec()]);
    let mut scene = Scene::at("lone_omni", ssl(1, 0), &[[0.0, 0.0, 0.0]], driver);
    scene.set_ball([0.0, 2.5], [0.0, 0.0]);
    scene
}

/// An SSL robot at the center, facing +x, with the ball at rest at its front.
pub fn ball_in_mouth(command: &[f32]) -> Scene {
    let mut scene = Scene { name: "ball_in_mouth", ..lone_omni(command) };
    let touching = scene.config.blue[0].front_distance() + scene.config.ball.radius;
    scene.set_ball([touching, 0.0], [0.0, 0.0]);
    scene
}

/// A ball alone on a field.
pub fn lone_ball(config: SimConfig, position: [f32; 2], velocity: [f32; 2]) -> Scene {
    let config = SimConfig { blue: Vec::new(), yellow: Vec::new(), ..config };
    let mut scene = Scene::at("lone_ball", config, &[], Driver::STILL);
    scene.set_ball(position, velocity);
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

impl Scene {
    /// Robots at these poses (x and y in m, heading in degrees), ball at rest at the center.
    ///
    /// # Panics
    /// If the number of poses is not that of robots.
    pub fn at(name: &'static str, config: SimConfig, poses: &[[f32; 3]], driver: Driver) -> Self {
        assert_eq!(poses.len(), config.n_robots(), "one pose for each robot");
        let mut start = vec![0.0; config.row_size()];
        for (columns, [x, y, degrees]) in robots_mut(&mut start).zip(poses) {
            let (sin, cos) = libm::sincosf(degrees.to_radians());
            columns[..4].copy_from_slice(&[*x, *y, cos, sin]);
        }
        Self { name, config, start, parameters: None, driver }
    }

    /// All bodies in the default line-up.
    ///
    /// # Panics
    /// If `config` is invalid.
    pub fn lined_up(name: &'static str, config: SimConfig, driver: Driver) -> Self {
        let mut start = vec![0.0; config.row_size()];
        World::new(&config).expect("a valid configuration").write_row(&mut start);
        Self { name, config, start, parameters: None, driver }
    }

    /// Sets position (m) and velocity (m/s) of the ball in the plane.
    pub fn set_ball(&mut self, position: [f32; 2], velocity: [f32; 2]) {
        self.start[..2].copy_from_slice(&position);
        let v_x = ball_column("v_x");
        self.start[v_x..v_x + 2].copy_from_slice(&velocity);
    }

    /// Sets a column of the ball.
    pub fn set_ball_column(&mut self, name: &str, value: f32) {
        self.start[ball_column(name)] = value;
    }

    /// Sets a column of a robot.
    ///
    /// # Panics
    /// If there is no such robot.
    pub fn set_robot_column(&mut self, robot: usize, name: &str, value: f32) {
        robots_mut(&mut self.start).nth(robot).expect("a robot")[robot_column(name)] = value;
    }

    /// A match at the start of the scene.
    ///
    /// # Panics
    /// If the configuration or the start is invalid.
    pub fn world(&self) -> World {
        let mut world = World::new(&self.config).expect("the scene's configuration is valid");
        world.place(&self.start, self.parameters.as_deref()).expect("the scene's start is valid");
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
        batch.place(&vec![true; worlds], &starts, None, &mut rows).expect("a valid start");
        (batch, rows)
    }

    /// Commands of one world at control step `step`, given its row. `seed` varies random commands.
    pub fn commands(&self, row: &[f32], step: u64, seed: u64) -> Vec<f32> {
        let columns = self.config.command_columns();
        let mut commands = vec![0.0; self.config.command_size()];
        let each = commands.chunks_exact_mut(columns.max(1)).zip(self.config.robots());
        for (index, (command, (model, robot))) in
            each.zip(robots(row)).map(|((c, m), r)| (c, (m, r))).enumerate()
        {
            let key = seed ^ (step / 10 * 64 + index as u64 * 8);
            let robot_command = self.driver.command(index, model, robot, [row[0], row[1]], key);
            command[..robot_command.len()].copy_from_slice(&robot_command);
        }
        commands
    }

    /// Plays `steps` control steps of one world. Returns the rows and the number of contacts.
    ///
    /// # Panics
    /// If a state becomes non-finite.
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

    /// The row after `steps` control steps.
    pub fn after(&self, steps: u64) -> Vec<f32> {
        let (rows, _) = self.play(&mut self.world(), steps);
        rows[rows.len() - self.config.row_size()..].to_vec()
    }
}

/// Number of steps of `length` (s) in `seconds`.
pub fn steps(seconds: f32, length: f32) -> u64 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // scenes last seconds
    let steps = (seconds / length).round() as u64;
    steps
}

/// The columns of each robot in a row.
pub fn robots(row: &[f32]) -> impl Iterator<Item = &[f32]> {
    row[BALL_COLUMNS.len()..].chunks_exact(ROBOT_COLUMNS.len())
}

/// The columns of each robot in a row, mutable.
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
