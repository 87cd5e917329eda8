//! An omnidirectional robot against the limits of its model: times to a speed, directions, wheels, pushing.

use rsim_core::columns::{ROBOT_PARAMETERS, parameters_size, robot_column};
use rsim_core::scenes::{self, Driver, Scene, lone_omni, robots, steps};
use rsim_core::{BallModel, Drive, Field, RobotModel, SimConfig};

/// Robot 0 after each tick: (time, speed, angular velocity).
fn response(mut scene: Scene, seconds: f32) -> Vec<[f32; 3]> {
    scene.config.time_step = scene.config.tick;
    let steps = steps(seconds, scene.config.tick);
    let (rows, _) = scene.play(&mut scene.world(), steps);
    let [v_x, v_theta] = ["v_x", "v_theta"].map(robot_column);
    let rows = rows.chunks_exact(scene.config.row_size()).enumerate();
    rows.map(|(step, row)| {
        let robot = robots(row).next().expect("a robot");
        let time = (step + 1) as f32 * scene.config.tick;
        [time, robot[v_x].hypot(robot[v_x + 1]), robot[v_theta]]
    })
    .collect()
}

fn first(track: &[[f32; 3]], reached: impl Fn(&[f32; 3]) -> bool) -> f32 {
    track.iter().find(|at| reached(at)).expect("it gets there")[0]
}

#[test]
fn accelerating_braking_and_turning_take_the_times_of_the_limits() {
    for degrees in [0.0_f32, 30.0, 45.0, 90.0, 135.0, 200.0, 270.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let forward = lone_omni(&[3.0 * cos, 3.0 * sin, 0.0]);
        let time = first(&response(forward, 1.0), |[_, speed, _]| *speed >= 2.99);
        assert!((time - 0.64).abs() < 0.01, "0 to 3 m/s at {degrees}: {time} s"); // 3 / 4.7
        let mut stop = lone_omni(&[0.0, 0.0, 0.0]);
        stop.set_robot_column(0, "v_x", 3.0 * cos);
        stop.set_robot_column(0, "v_y", 3.0 * sin);
        let time = first(&response(stop, 1.0), |[_, speed, _]| *speed < 0.01);
        assert!((time - 0.51).abs() < 0.01, "3 m/s to 0 at {degrees}: {time} s"); // 3 / 5.9
    }
    let turn = response(lone_omni(&[0.0, 0.0, 20.0]), 1.0);
    let time = first(&turn, |[_, _, angular_velocity]| *angular_velocity >= 19.9);
    assert!((time - 0.39).abs() < 0.01, "0 to 20 rad/s: {time} s"); // 20 / 50.8
}

#[test]
fn top_speeds_are_those_of_the_model() {
    let fastest = response(lone_omni(&[0.0, -9.0, 0.0]), 1.0)[199];
    assert!((fastest[1] - 3.7).abs() < 1e-3, "{fastest:?}");
    let fastest = response(lone_omni(&[0.0, 0.0, -99.0]), 1.0)[199];
    assert!((fastest[2] + 26.2).abs() < 0.01, "{fastest:?}");
}

#[test]
fn wheel_speeds_and_body_speeds_drive_the_same_way() {
    let Drive::OmniWheels(drive) = RobotModel::SSL_GENERIC_WHEELS.drive else { unreachable!() };
    for [v_x, v_y, v_theta] in [[1.0_f32, 0.0, 0.0], [0.0, 0.8, 0.0], [0.7, -0.5, 2.0]] {
        let wheels = drive.wheel_angles.map(|degrees| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            (-v_x * sin + v_y * cos + drive.wheel_distance * v_theta) / drive.wheel_radius
        });
        let mut by_wheels = lone_omni(&[&wheels[..], &[0.0; 3]].concat());
        by_wheels.config.blue = vec![RobotModel::SSL_GENERIC_WHEELS];
        let [a, b] = [by_wheels, lone_omni(&[v_x, v_y, v_theta])].map(|scene| scene.after(40));
        let [a, b] = [&a, &b].map(|row| robots(row).next().expect("a robot").to_vec());
        for (column, (a, b)) in a.iter().zip(&b).enumerate() {
            assert!((a - b).abs() < 1e-3, "column {column}: {a} by wheels, {b} by body");
        }
    }
}

#[test]
fn a_saturated_wheel_does_not_bend_the_path() {
    let robot = lone_omni(&[3.7, 1.0, 0.0]).after(40);
    let robot = robots(&robot).next().expect("a robot");
    assert!((robot[1] / robot[0] - 1.0 / 3.7).abs() < 1e-3, "straight: {robot:?}");
}

/// Two generic robots front to front; blue pushes, with a factor on its traction.
fn pushing(push: f32, hold: f32, blue_traction: f32) -> Scene {
    let config = SimConfig {
        field: Field::SSL_A,
        ..scenes::config(Field::SSL_A, BallModel::SSL_TIGERS, &RobotModel::SSL_GENERIC, 1, 1)
    };
    let poses = [[-0.0901, 0.0, 0.0], [0.0901, 0.0, 180.0]];
    let commands = vec![vec![push, 0.0, 0.0], vec![hold, 0.0, 0.0]];
    let mut scene = Scene::at("pushing", config, &poses, Driver::Constant(commands));
    scene.set_ball([0.0, 3.0], [0.0, 0.0]);
    let mut parameters = vec![1.0; parameters_size(2)];
    let blue = parameters.len() - 2 * ROBOT_PARAMETERS.len();
    let column = ROBOT_PARAMETERS.iter().position(|known| *known == "traction");
    parameters[blue + column.expect("known")] = blue_traction;
    scene.parameters = Some(parameters);
    scene
}

fn places(scene: &Scene, steps: u64) -> [f32; 2] {
    let row = scene.after(steps);
    let mut x = robots(&row).map(|robot| robot[0]);
    [x.next().expect("blue"), x.next().expect("yellow")]
}

#[test]
fn two_robots_head_on_stall() {
    let [blue, yellow] = places(&pushing(2.0, 2.0, 1.0), 200);
    assert!((blue + yellow).abs() < 2e-3, "they stay: {blue}, {yellow}");
    assert!((yellow - blue - 0.18).abs() < 1e-3, "none sinks in: {blue}, {yellow}");
}

#[test]
fn a_standing_robot_holds_below_its_traction_and_slides_above_it() {
    // The pusher transmits 8 N and 24 N, the one that stands 18.6 N.
    let start = 0.0901;
    let [_, held] = places(&pushing(2.0, 0.0, 8.0 / 18.63), 200);
    assert!((held - start).abs() < 2e-3, "pushed with 8 N for 5 s it moved to {held} m");
    let [_, slid] = places(&pushing(2.0, 0.0, 24.0 / 18.63), 200);
    assert!(slid - start > 0.5, "pushed with 24 N it moved to {slid} m only");
}

#[test]
fn a_ball_squeezed_at_the_traction_limit_does_not_sink_in() {
    let poses = [[-0.1125, 0.0, 180.0], [0.1125, 0.0, 0.0]];
    let commands = vec![vec![-2.0, 0.0, 0.0]; 2]; // backs to the ball: round against round
    let scene = Scene::at("squeeze", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
    let (rows, contacts) = scene.play(&mut scene.world(), 40);
    assert!(contacts > 40);
    let mut deepest = 0.0_f32;
    let mut squeezed = 0;
    for row in rows.chunks_exact(scene.config.row_size()) {
        for robot in robots(row) {
            let gap = (robot[0] - row[0]).hypot(robot[1] - row[1]) - 0.09 - 0.0215;
            deepest = deepest.max(-gap);
            squeezed += usize::from(gap < 1e-4);
        }
    }
    assert!(squeezed > 10, "it was squeezed: {squeezed}");
    assert!(deepest < 1e-3, "{deepest} m deep");
}
