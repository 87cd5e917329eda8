//! Robots in line that drive at a wall, with and without the ball between them.

use rsim_core::scenes::{self, Driver, Scene, deepest_ball, deepest_robots, driving, robots};
use rsim_core::{RobotModel, SimConfig};

const TICKS: [f32; 2] = [0.005, 0.0025];

/// Maximum separation speed of bodies with a ball between them, by their closing speed.
const BOUNCE: f32 = 0.25;

/// Distance from a robot's center to its back, m.
fn behind(model: &RobotModel) -> f32 {
    if model.mouth.is_some() { model.bounding_radius() } else { model.front_distance() }
}

/// Robots front to back that drive at a wall, which is `clear` (m) ahead of the first.
fn train(config: &SimConfig, speed: f32, [gap, clear]: [f32; 2]) -> Scene {
    let model = &config.blue[0];
    let half = behind(model);
    let first = config.field.max_y() - half - clear;
    let place = |nth: usize| [0.3, first - (2.0 * half + gap) * nth as f32, 90.0];
    let poses: Vec<_> = (0..config.blue.len()).map(place).collect();
    let command = driving(model, 90.0, [0.0, speed]);
    let driver = Driver::Constant(vec![command; poses.len()]);
    let mut scene = Scene::at("train", config.clone(), &poses, driver);
    scene.set_ball([-0.4, 0.0], [0.0, 0.0]);
    (0..poses.len()).for_each(|robot| scene.set_velocity(robot, [0.0, speed]));
    scene
}

fn check_trains(robots: usize, speeds: [f32; 2]) {
    for (config, speed) in [scenes::vss(robots, 0), scenes::ssl(robots, 0)].iter().zip(speeds) {
        for tick in TICKS {
            for [gap, clear] in [[0.0, 0.0], [1e-3, 0.006], [1e-4, 0.011]] {
                let config = SimConfig { tick, ..config.clone() };
                let scene = train(&config, speed, [gap, clear]);
                let label = format!("{} {tick} s {speed} m/s {gap} {clear}", config.blue[0].name);
                check_train(&scene, speed, &label);
            }
        }
    }
}

fn check_train(scene: &Scene, speed: f32, label: &str) {
    for row in scene.every_tick(0.3) {
        let depth = deepest_robots(&scene.config, &row);
        assert!(depth < 3e-3, "{label}: {depth} m in each other");
        let back = robots(&row).map(|robot| -robot[5] / speed).fold(0.0, f32::max);
        assert!(back < 0.45, "{label}: thrown back at {back}");
    }
}

#[test]
fn a_robot_that_drives_into_a_wall_bounces_by_its_restitution() {
    check_trains(1, [1.15, 3.5]);
}

/// The others drove on for a whole tick after the first was stopped, and were thrown back at up to 1.5
/// times their speed.
#[test]
fn robots_front_to_back_sank_into_each_other_when_the_first_was_stopped() {
    check_trains(3, [1.15, 3.5]);
}

/// Plays a robot, a ball and a robot in line, driven at a wall that is `clear` (m) ahead of the first.
fn check_chains(clear: f32) {
    for (config, speeds) in [
        (scenes::ssl(2, 0), [0.6, 1.5, 2.5].as_slice()),
        (scenes::vss(2, 0), [0.4, 0.8, 1.15].as_slice()),
    ] {
        for speed in speeds.iter().copied() {
            for tick in TICKS {
                for gap in [0.0, 0.007, 0.015] {
                    check_chain(&SimConfig { tick, ..config.clone() }, speed, [clear, gap]);
                }
            }
        }
    }
}

fn check_chain(config: &SimConfig, speed: f32, [clear, gap]: [f32; 2]) {
    let (model, radius) = (config.blue[0].clone(), config.ball.radius);
    let first = config.field.max_y() - behind(&model) - clear;
    // Both robots face the ball with their fronts.
    let ball = first - model.front_distance() - radius - 1e-3;
    let last = ball - radius - model.front_distance() - gap;
    let commands = vec![vec![], driving(&model, 90.0, [0.0, speed])];
    let poses = [[0.1, first, 270.0], [0.1, last, 90.0]];
    let mut scene = Scene::at("chain", config.clone(), &poses, Driver::Constant(commands));
    scene.set_ball([0.1, ball], [0.0, 0.0]);
    scene.set_velocity(1, [0.0, speed]);
    let label = format!("{}, {speed} m/s, {clear} m, {gap} m, {} s", model.name, config.tick);
    for row in scene.every_tick(0.3) {
        let all: Vec<&[f32]> = robots(&row).collect();
        let inside = deepest_ball(config, &row);
        let into_wall = all[0][1] + behind(&model) - config.field.max_y();
        let back = -all[1][5] / speed;
        assert!(inside < 3e-3, "{label}: the ball is {inside} m in a robot");
        assert!(into_wall < 2e-3, "{label}: a robot is {into_wall} m in the wall");
        assert!(back <= BOUNCE, "{label}: thrown back at {back}");
    }
}

#[test]
fn a_ball_between_two_robots_was_a_spring() {
    check_chains(0.0);
    check_chains(0.4);
}

/// The contact with the wall of a robot that was pushed from rest was detected a tick too late.
#[test]
fn a_robot_that_was_pushed_at_a_near_wall_sank_into_it() {
    check_chains(1e-3);
}
