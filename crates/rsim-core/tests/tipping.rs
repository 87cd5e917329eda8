//! Two-wheeled robots that tip: their bodies rub over the floor, and they skid to a stop after a sudden brake.

use rsim_core::scenes::{self, Driver, Scene, lone_robot, robots};
use rsim_core::{Batch, DifferentialDrive, Drive, RobotModel};

/// Acceleration of the tires and of the body's friction, m/s².
const TIRES: f32 = 4.0;
const BODY: f32 = 2.8;

/// A robot of [`RobotModel::VSS_FIRASIM`] with other numbers.
fn model(longitudinal_grip: f32, tipping_friction: f32, skid_slip: f32) -> RobotModel {
    let Drive::Differential(drive) = RobotModel::VSS_FIRASIM.drive else { panic!("two wheels") };
    let drive = DifferentialDrive { longitudinal_grip, tipping_friction, skid_slip, ..drive };
    RobotModel { drive: Drive::Differential(drive), ..RobotModel::VSS_FIRASIM }
}

fn tipping(skid_slip: f32) -> RobotModel {
    model(TIRES, BODY / TIRES, skid_slip)
}

fn alone(model: RobotModel) -> Scene {
    let mut scene = lone_robot([0.0, 0.0]);
    scene.config.blue = vec![model];
    scene.set_robot_column(0, "x", -0.6);
    scene
}

/// Velocity forward (m/s) and angular velocity (rad/s) after each control step of commands `[left, right]`, rad/s, each
/// for a number of steps.
fn driven(model: RobotModel, commands: &[([f32; 2], usize)]) -> Vec<[f32; 2]> {
    let scene = alone(model);
    let (mut world, mut row) = (scene.world(), scene.start.clone());
    let each = commands.iter().flat_map(|(wheels, steps)| vec![*wheels; *steps]);
    each.map(|wheels| {
        world.step(&wheels).expect("finite");
        world.write_row(&mut row);
        let robot = robots(&row).next().expect("a robot");
        [robot[4] * robot[2] + robot[5] * robot[3], robot[6]]
    })
    .collect()
}

const STRAIGHT: [f32; 2] = [50.0, 50.0];

#[test]
fn friction_of_the_body_is_against_the_motion_whatever_the_tires_do() {
    for direction in [1.0, -1.0] {
        let wheels = STRAIGHT.map(|speed| speed * direction);
        let speeds = driven(tipping(0.0), &[(wheels, 20), ([0.0; 2], 5)]);
        for (step, [speed, _]) in (1_u8..).zip(&speeds[..20]) {
            let expected = (TIRES - BODY) * 0.025 * f32::from(step);
            assert!((speed * direction - expected).abs() < 1e-4, "{speed}");
        }
        let change = (speeds[19][0] - speeds[20][0]) * direction;
        assert!((change - (TIRES + BODY) * 0.025).abs() < 1e-4, "{change}");
        assert!(speeds[24][0].abs() < 1e-5);
    }
}

#[test]
fn a_robot_that_drives_at_its_speed_rubs_nowhere() {
    let speeds = driven(tipping(0.15), &[(STRAIGHT, 60)]);
    assert!((speeds[20][0] - 21.0 * 0.03).abs() < 1e-3, "it tips while it gets faster");
    assert!(speeds[40..].iter().all(|[speed, _]| (speed - 1.0).abs() < 1e-4), "{speeds:?}");
}

/// Way of a standing robot at the center that a robot of its mass pushes along +x with a force by their mass, m/s²,
/// for 10 s.
fn pushed(degrees: f32, force: f32) -> f32 {
    let mut config = scenes::vss(1, 1);
    (config.field.length, config.field.width) = (12.0, 4.0);
    (config.blue, config.yellow) = (vec![tipping(0.15)], vec![model(force, 0.0, 0.0)]);
    let poses = [[0.0, 0.0, degrees], [-0.0751, 0.0, 0.0]];
    let commands = vec![vec![0.0, 0.0], vec![40.0, 40.0]];
    let mut scene = Scene::at("pushed", config, &poses, Driver::Constant(commands));
    scene.set_ball([0.0, 1.5], [0.0, 0.0]);
    robots(&scene.after(400)).next().expect("a robot")[0]
}

#[test]
fn a_standing_robot_holds_what_its_tires_and_its_body_hold() {
    for degrees in [0.0, 180.0] {
        for share in [0.3, 0.9, 1.4] {
            let way = pushed(degrees, share * TIRES);
            assert!(way.abs() < 2e-3, "{degrees} degrees, {share} of the tires: {way} m");
        }
        assert!(pushed(degrees, 1.1 * (TIRES + BODY)) > 0.5, "more than both");
    }
}

#[test]
fn robots_of_the_same_block_that_do_not_tip_keep_their_bits() {
    let others = |first: RobotModel| {
        let mut config = scenes::vss(3, 0);
        config.blue = vec![first, RobotModel::VSS_440RPM, RobotModel::VSS_650RPM];
        let poses = [[0.0, 0.5, 0.0], [-0.3, 0.0, 20.0], [-0.3, -0.4, 90.0]];
        let commands = vec![vec![40.0, 35.0], vec![40.0, 20.0], vec![-30.0, 30.0]];
        let scene = Scene::at("a block", config, &poses, Driver::Constant(commands));
        robots(&scene.after(30)).skip(1).flatten().map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(others(tipping(0.15)), others(RobotModel::VSS_440RPM));
}

#[test]
fn turns_on_the_spot_are_those_of_the_tires_and_slow_a_robot_that_drives() {
    let turn = [([-20.0, 20.0], 3)];
    assert_eq!(driven(tipping(0.0), &turn), driven(model(TIRES, 0.0, 0.0), &turn));
    let speeds = driven(tipping(0.0), &[(STRAIGHT, 20), ([60.0, -55.0], 2)]);
    let change = speeds[19][0] - speeds[21][0];
    assert!((change - BODY * 0.05).abs() < 0.01, "{speeds:?}");
}

#[test]
fn the_slower_wheel_of_an_arc_drives_too() {
    // Both tires slip, so that the robot does not turn before it has the speed of the slower wheel.
    let arc = driven(tipping(0.0), &[([20.0, 40.0], 40)]);
    assert!(arc[..11].iter().all(|[_, turn]| turn.abs() < 1e-3), "{arc:?}");
    assert!((arc[39][1] - 20.0 * 0.02 / 0.08).abs() < 0.01, "{arc:?}");
}

#[test]
fn a_sudden_brake_of_both_wheels_skids_to_a_stop_whatever_is_commanded_then() {
    let (fast, limit) = ((STRAIGHT, 60), 0.15);
    let slowest = |next: [f32; 2], skid_slip: f32| {
        let speeds = driven(tipping(skid_slip), &[fast, (next, 10)]);
        assert!((speeds[59][0] - 1.0).abs() < 1e-4);
        speeds[60..].iter().map(|[speed, _]| *speed).fold(f32::INFINITY, f32::min)
    };
    assert!(slowest([40.0, 40.0], limit) < 0.1, "it has skidded");
    assert!((slowest([40.0, 40.0], 0.0) - 0.8).abs() < 0.01, "a robot that never skids");
    assert!((slowest([45.0, 45.0], limit) - 0.9).abs() < 0.01, "less slip than the limit");
    assert!(slowest([50.0, 20.0], limit) > 0.6, "one wheel alone");
}

#[test]
fn a_robot_that_has_skidded_to_a_stop_obeys_again() {
    let speeds = driven(tipping(0.15), &[(STRAIGHT, 60), ([-50.0; 2], 20)]);
    assert!(speeds[79][0] < -0.25, "{speeds:?}");
}

/// A batch of one robot that skids, and its row.
fn skidding(scene: &Scene) -> (Batch, Vec<f32>) {
    let (mut batch, mut rows) = scene.batch(1, 1);
    for wheels in [vec![STRAIGHT; 60], vec![[0.0; 2]; 2]].concat() {
        batch.step(&wheels, &mut rows, None).expect("finite");
    }
    (batch, rows)
}

/// Speed after a step straight on.
fn next_speed(batch: &mut Batch, rows: &mut [f32]) -> f32 {
    batch.step(&STRAIGHT, rows, None).expect("finite");
    robots(rows).next().expect("a robot")[4]
}

#[test]
fn a_robot_that_is_put_elsewhere_does_not_skid_any_more() {
    let scene = alone(tipping(0.15));
    let (mut batch, mut rows) = skidding(&scene);
    let skidded = next_speed(&mut batch, &mut rows);
    assert!(skidded < 0.8, "{skidded}");
    let (mut batch, mut rows) = skidding(&scene);
    let mut moving = alone(tipping(0.15));
    moving.set_robot_column(0, "v_x", 0.9);
    batch.reposition_robots(&[true], &[true], &moving.start, &mut rows).expect("valid");
    let speed = next_speed(&mut batch, &mut rows);
    assert!((speed - 0.93).abs() < 1e-3, "{speed}");
}

#[test]
fn a_skid_is_part_of_a_snapshot() {
    let scene = alone(tipping(0.15));
    let (mut batch, mut rows) = skidding(&scene);
    let saved = batch.snapshot();
    let on = next_speed(&mut batch, &mut rows);
    let (mut other, _) = scene.batch(1, 1);
    other.restore(&saved).expect("its own");
    assert_eq!(next_speed(&mut other, &mut rows).to_bits(), on.to_bits());
}
