//! Fast balls at robots that spin.

use rsim_core::columns::robot_column;
use rsim_core::scenes::{self, Driver, Scene, robots, uniform};
use rsim_core::{Body, Drive, RobotModel, SimConfig};

const DRAWS: u64 = 2000;

/// A robot at the center that turns at its maximum angular velocity.
fn turning(model: &RobotModel, tick: f32, nth: u64) -> Scene {
    let draw = |part: u64| uniform(nth * 16 + part);
    let angular_velocity = if draw(0) > 0.0 { 1.0 } else { -1.0 } * model.top_angular_velocity();
    let command = match model.drive {
        Drive::Differential(drive) => {
            let wheel = drive.max_wheel_speed * angular_velocity.signum();
            vec![-wheel, wheel]
        }
        Drive::Omni(_) | Drive::OmniWheels(_) => vec![0.0, 0.0, angular_velocity, 0.0, 0.0, 0.0],
    };
    let vss = matches!(model.drive, Drive::Differential(_));
    let config = if vss { scenes::vss(1, 0) } else { scenes::ssl(1, 0) };
    let config = SimConfig { blue: vec![model.clone()], tick, ..config };
    let poses = [[0.0, 0.0, 180.0 * draw(1)]];
    let mut scene = Scene::at("turning", config, &poses, Driver::Constant(vec![command]));
    scene.set_robot_column(0, "v_theta", angular_velocity);
    scene
}

/// Radius of the circle that the body always fills, however it turns.
fn inner(model: &RobotModel) -> f32 {
    match model.body {
        Body::Square { side_length: side } => side / 2.0,
        Body::Round { front_distance, .. } => front_distance,
    }
}

/// Shoots a ball at the robot, past its center by a fraction of the distance at which it would miss.
fn shoot(scene: &mut Scene, nth: u64, share: f32) -> f32 {
    let draw = |part: u64| uniform(nth * 16 + part);
    let aim = share * draw(2) * (inner(&scene.config.blue[0]) + scene.config.ball.radius);
    let (speed, away) = (7.5 + 2.5 * draw(3), 0.3 + 0.05 * draw(4));
    let (sin, cos) = (std::f32::consts::PI * draw(5)).sin_cos();
    scene.set_ball([-away * cos - aim * sin, -away * sin + aim * cos], [speed * cos, speed * sin]);
    aim
}

/// Whether the ball passed through, and whether the robot touched it.
fn passed_and_touched(scene: &Scene) -> (bool, bool) {
    let rows = scene.every_tick(0.12);
    let (v_x, v_y) = (scene.start[3], scene.start[4]);
    let speed = v_x.hypot(v_y);
    let model = &scene.config.blue[0];
    let beyond = inner(model) + scene.config.ball.radius;
    // From the robot: a ball may follow one that it has hit.
    let through = |row: &Vec<f32>| {
        let robot = robots(row).next().expect("a robot");
        let (x, y) = (row[0] - robot[0], row[1] - robot[1]);
        let (way, aside) = ((x * v_x + y * v_y) / speed, (y * v_x - x * v_y) / speed);
        way > beyond && aside.abs() < inner(model)
    };
    let touched =
        |row: &Vec<f32>| robots(row).any(|robot| robot[robot_column("touched_ball")] > 0.0);
    (rows.iter().any(through), rows.iter().any(touched))
}

fn check(model: &RobotModel) {
    for tick in [0.005, 0.0025] {
        for nth in 0..DRAWS {
            let mut scene = turning(model, tick, nth);
            let aim = shoot(&mut scene, nth, 0.95);
            let (passed, touched) = passed_and_touched(&scene);
            let label = format!("{}, ticks of {tick} s, draw {nth}: {aim} m", model.name);
            assert!(!passed, "{label}: it came through");
            assert!(touched, "{label}: the robot felt nothing");
        }
    }
}

#[test]
fn fast_balls_passed_through_spinning_squares() {
    check(&RobotModel::VSS_440RPM);
    check(&RobotModel::VSS_650RPM);
}

#[test]
fn fast_balls_passed_through_spinning_round_robots() {
    check(&RobotModel::SSL_GENERIC);
}
