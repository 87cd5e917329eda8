//! A differential drive against its closed form: speeds, accelerations, arcs, pushes, skids.

use rsim_core::scenes::{self, Driver, lone_robot, robots};
use rsim_core::{DifferentialDrive, Drive, RobotModel, World, scenes::Scene};

/// Robot 0 after `steps` control steps.
fn after(scene: &Scene, steps: u64) -> Vec<f32> {
    let (rows, _) = scene.play(&mut scene.world(), steps);
    let last = &rows[rows.len() - scene.config.row_size()..];
    robots(last).next().expect("a robot").to_vec()
}

fn wheels(model: &RobotModel) -> DifferentialDrive {
    let Drive::Differential(drive) = model.drive else { panic!("{} has other wheels", model.name) };
    drive
}

fn close(got: f32, expected: f32, tolerance: f32) {
    assert!((got - expected).abs() <= tolerance, "{got}, expected {expected} +- {tolerance}");
}

#[test]
fn equal_wheels_drive_straight_at_their_rim_speed() {
    let robot = after(&lone_robot([20.0, 20.0]), 40);
    close(robot[4], 0.026 * 20.0, 1e-4);
    close(robot[1], 0.0, 1e-6);
    close(robot[3], 0.0, 1e-6);
}

#[test]
fn acceleration_is_limited_by_the_tires() {
    // 6.85 m/s² measured on the old simulator's robot: 0.1 s to 0.685 m/s and 34 mm.
    let robot = after(&lone_robot([100.0, 100.0]), 4);
    close(robot[4], 0.685, 0.005);
    close(robot[0], 0.5 * 6.85 * 0.01, 0.001);
    let robot = after(&lone_robot([100.0, 100.0]), 14);
    close(robot[4], RobotModel::VSS_440RPM.top_speed(), 1e-3); // 1.198 m/s; measured 1.199
}

#[test]
fn opposite_wheels_turn_on_the_spot() {
    let robot = after(&lone_robot([-40.0, 40.0]), 20);
    close(robot[6], 26.6, 0.1); // measured on the old simulator's robot
    close(robot[0], 0.0, 1e-4);
    close(robot[1], 0.0, 1e-4);
}

#[test]
fn unequal_wheels_drive_the_arc_of_the_closed_form() {
    let (left, right) = (18.0, 22.0);
    let (rows, _) = {
        let scene = lone_robot([left, right]);
        scene.play(&mut scene.world(), 60)
    };
    let radius =
        wheels(&RobotModel::VSS_440RPM).track_width / 2.0 * (right + left) / (right - left);
    // The curvature, from three positions of the steady part.
    let at = |step: usize| {
        let size = scenes::vss(1, 0).row_size();
        let robot = robots(&rows[step * size..][..size]).next().expect("a robot");
        [robot[0], robot[1]]
    };
    let [a, b, c] = [at(20), at(38), at(56)];
    let side = |p: [f32; 2], q: [f32; 2]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs() / 2.0;
    let measured = side(a, b) * side(b, c) * side(c, a) / (4.0 * area);
    close(measured, radius, 0.01 * radius);
}

#[test]
fn wheels_that_differ_by_2_percent_drive_the_arc_of_the_closed_form() {
    let (left, right) = (20.0, 20.4);
    let mut scene = lone_robot([left, right]);
    scene.set_robot_column(0, "x", -0.65);
    let drive = wheels(&RobotModel::VSS_440RPM);
    let radius = drive.track_width / 2.0 * (right + left) / (right - left); // 3.95 m
    let [early, late] = [8, 88].map(|steps| after(&scene, steps));
    // On a circle the chord between two places bends by half the angle between their headings.
    let chord = (late[0] - early[0]).hypot(late[1] - early[1]);
    let turned = late[3].atan2(late[2]) - early[3].atan2(early[2]);
    close(chord / (2.0 * (turned / 2.0).sin()), radius, 0.01 * radius);
    let traveled = drive.wheel_radius * (left + right) / 2.0 * 2.0; // m/s times 2 s
    close(turned, traveled / radius, 0.01 * traveled / radius);
}

#[test]
fn the_faster_preset_responds_by_its_numbers() {
    let model = RobotModel::VSS_650RPM;
    let drive = wheels(&model);
    let preset = |command: [f32; 2], steps: u64| {
        let mut scene = lone_robot(command);
        scene.config.blue = vec![model.clone()];
        scene.set_robot_column(0, "x", -0.6);
        after(&scene, steps)
    };
    let full = [drive.max_wheel_speed; 2];
    // Tires give 0.6 g, the motors would give 32 m/s².
    close(preset(full, 4)[4], 0.6 * 9.81 * 0.1, 0.005);
    close(preset(full, 4)[0] + 0.6, 0.5 * 0.6 * 9.81 * 0.01, 0.001);
    let top = drive.wheel_radius * drive.max_wheel_speed; // 1.7 m/s, after 0.289 s
    close(preset(full, 11)[4], 0.6 * 9.81 * 0.275, 0.01);
    close(preset(full, 13)[4], top, 1e-3);
    close(preset([-20.0, 20.0], 20)[6], 2.0 * 20.0 * drive.wheel_radius / drive.track_width, 0.05);
}

#[test]
fn commands_beyond_the_motors_are_clipped_to_their_top_speed() {
    assert_eq!(after(&lone_robot([1e9, 1e9]), 30), after(&lone_robot([46.077, 46.077]), 30));
}

#[test]
fn a_standing_robot_pushed_sideways_skids_and_stops() {
    let mut scene = lone_robot([0.0, 0.0]);
    let columns = first_robot(&mut scene);
    columns[5] = 1.0; // m/s along its axle
    let robot = after(&scene, 40);
    close(robot[5], 0.0, 1e-4);
    // v² / (2 a) with the tires' 9.81 m/s².
    close(robot[1], 1.0 / (2.0 * 9.81), 0.003);
}

#[test]
fn a_robot_along_a_wall_can_turn_away_from_it() {
    let mut scene = lone_robot([-30.0, 30.0]);
    let columns = first_robot(&mut scene);
    columns[1] = -0.65 + 0.0375;
    let robot = after(&scene, 40);
    assert!(robot[6] > 10.0, "it spins freely, got {} rad/s", robot[6]);
    assert!(robot[1] > -0.65 + 0.045, "it has pushed itself off, to {} m", robot[1]);
}

#[test]
fn a_robot_against_the_wall_stalls_and_stays_straight() {
    let mut scene = lone_robot([46.0, 46.0]);
    first_robot(&mut scene)[1] = -0.3;
    first_robot(&mut scene)[0] = 0.4;
    let robot = after(&scene, 200);
    close(robot[4], 0.0, 1e-3);
    close(robot[0], 0.75 - 0.0375, 5e-4);
    close(robot[1], -0.3, 1e-3);
}

#[test]
fn two_robots_head_on_stall() {
    // Two robots of one model are equally strong, so both stay. The test is that neither passes through
    // the other.
    let config = scenes::vss(1, 1);
    let mut scene = Scene::at(
        "head_on",
        config,
        &[[-0.2, 0.0, 0.0], [0.2, 0.0, 180.0]],
        Driver::Constant(vec![vec![46.0, 46.0]; 2]),
    );
    scene.set_ball([0.0, 0.6], [0.0, 0.0]);
    let mut world: World = scene.world();
    let (rows, contacts) = scene.play(&mut world, 200);
    assert!(contacts > 100, "they met");
    let last: Vec<_> = robots(&rows[rows.len() - scene.config.row_size()..]).collect();
    close(last[1][0] - last[0][0], 0.075, 1e-3);
    close(last[0][0] + last[1][0], 0.0, 1e-3);
}

fn first_robot(scene: &mut Scene) -> &mut [f32] {
    rsim_core::scenes::robots_mut(&mut scene.start).next().expect("a robot")
}

/// Angular velocities of a robot that turns for `steps` on the spot and is then commanded to drive at
/// `power`.
fn turn_then_drive(model: &RobotModel, steps: usize, power: f32) -> Vec<f32> {
    let top = wheels(model).max_wheel_speed;
    let mut scene = lone_robot([0.0, 0.0]);
    scene.config.blue = vec![model.clone()];
    scene.config.field.length = 6.0;
    scene.set_ball([0.0, 0.3], [0.0, 0.0]);
    let mut world = scene.world();
    let mut row = scene.start.clone();
    let turn = |world: &mut World, wheels: [f32; 2], row: &mut [f32]| {
        world.step(&wheels).expect("finite");
        world.write_row(row);
        robots(row).next().expect("a robot")[6]
    };
    for _ in 0..steps {
        turn(&mut world, [-top, top], &mut row);
    }
    (0..40).map(|_| turn(&mut world, [power * top; 2], &mut row)).collect()
}

#[test]
fn a_spinning_robot_commanded_straight_at_full_speed_stops_spinning() {
    for steps in [1, 2, 4, 12] {
        let angular_velocities = turn_then_drive(&RobotModel::VSS_440RPM, steps, 1.0);
        assert!(angular_velocities[0] > 4.0, "it spun: {} rad/s", angular_velocities[0]);
        assert!(angular_velocities[19].abs() < 1e-2, "{steps} steps: {angular_velocities:?}");
    }
}
