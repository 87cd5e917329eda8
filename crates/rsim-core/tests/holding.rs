//! Static friction of tires: a standing robot holds what pushes it with less than their grip.

use rsim_core::scenes::{self, Driver, Scene, robots, steps};
use rsim_core::{Body, DifferentialDrive, Drive, RobotModel};

const MODELS: [RobotModel; 2] = [RobotModel::VSS_440RPM, RobotModel::VSS_650RPM];

fn drive(model: &RobotModel) -> DifferentialDrive {
    let Drive::Differential(drive) = model.drive else { panic!("{} has other wheels", model.name) };
    drive
}

fn side(model: &RobotModel) -> f32 {
    let Body::Square { side_length } = model.body else { panic!("{} is not square", model.name) };
    side_length
}

/// The model with tires that push with `force` by its mass (m/s²) and do not slip aside.
fn pusher(model: &RobotModel, force: f32) -> RobotModel {
    let drive = DifferentialDrive { longitudinal_grip: force, lateral_grip: 20.0, ..drive(model) };
    RobotModel { drive: Drive::Differential(drive), ..model.clone() }
}

/// A robot with heading `degrees` at the center that is commanded to stand, pushed along +x by robots that
/// touch it at `places` across and `forces` (by its mass, m/s²).
fn pushed(model: &RobotModel, degrees: f32, pushes: &[[f32; 2]]) -> Scene {
    let mut config = scenes::vss(1, pushes.len());
    (config.field.length, config.field.width) = (12.0, 4.0);
    config.blue = vec![model.clone()];
    config.yellow = pushes.iter().map(|[_, force]| pusher(model, *force)).collect();
    let mut poses = vec![[0.0, 0.0, degrees]];
    poses.extend(pushes.iter().map(|[aside, _]| [-side(model) - 1e-4, *aside, 0.0]));
    let mut commands = vec![vec![0.0, 0.0]];
    commands.extend(vec![vec![20.0, 20.0]; pushes.len()]);
    let mut scene = Scene::at("pushed", config, &poses, Driver::Constant(commands));
    scene.set_ball([0.0, 1.5], [0.0, 0.0]);
    scene
}

/// Distance of the robot from the center, and degrees by which it has turned, after 10 s.
fn displaced(scene: &Scene, degrees: f32) -> [f32; 2] {
    let row = scene.after(steps(10.0, scene.config.time_step));
    let robot = robots(&row).next().expect("a robot");
    let (sin, cos) = degrees.to_radians().sin_cos();
    let turned = (robot[3] * cos - robot[2] * sin).atan2(robot[2] * cos + robot[3] * sin);
    [robot[0].hypot(robot[1]), turned.to_degrees()]
}

/// Grip against a push along +x, m/s².
fn grip(model: &RobotModel, degrees: f32) -> f32 {
    let DifferentialDrive { longitudinal_grip, lateral_grip, .. } = drive(model);
    if degrees % 180.0 == 0.0 { longitudinal_grip } else { lateral_grip }
}

#[test]
fn a_standing_robot_crept_under_a_push_below_its_grip() {
    for model in MODELS {
        for degrees in [0.0, 90.0, 180.0, 270.0] {
            for share in [0.5, 0.7, 0.85, 0.95] {
                for tick in [0.005, 0.001] {
                    let force = share * grip(&model, degrees);
                    let mut scene = pushed(&model, degrees, &[[0.0, force]]);
                    scene.config.tick = tick;
                    let [way, turned] = displaced(&scene, degrees);
                    let label =
                        format!("{} at {degrees}, {share} of the grip, {tick} s", model.name);
                    assert!(way < 2e-3 && turned.abs() < 0.1, "{label}: {way} m, {turned} degrees");
                }
            }
        }
    }
}

#[test]
fn a_push_beyond_the_grip_moves_the_robot() {
    for model in MODELS {
        for degrees in [0.0, 90.0] {
            let force = 1.05 * grip(&model, degrees);
            let [way, _] = displaced(&pushed(&model, degrees, &[[0.0, force]]), degrees);
            assert!(way > 1.0, "{} at {degrees}: {way} m", model.name);
        }
    }
}

#[test]
fn a_robot_holds_pushes_off_its_center_and_of_two_robots() {
    for model in MODELS {
        let half = side(&model) / 2.0 + 5e-4;
        for degrees in [0.0, 90.0] {
            let grip = grip(&model, degrees);
            let off = pushed(&model, degrees, &[[0.02, 0.6 * grip]]);
            let two = pushed(&model, degrees, &[[half, 0.3 * grip], [-half, 0.4 * grip]]);
            for (what, scene) in [("off its center", off), ("two robots", two)] {
                let [way, turned] = displaced(&scene, degrees);
                let label = format!("{} at {degrees}, {what}", model.name);
                assert!(way < 2e-3 && turned.abs() < 1.0, "{label}: {way} m, {turned} degrees");
            }
        }
    }
}

/// A standing robot that is pushed from the side with `share` of its grip, by a robot of `mass` (a factor on
/// its own) that would accelerate by `acceleration` (m/s²).
fn pushed_hard(model: &RobotModel, share: f32, mass: f32, acceleration: f32) -> Scene {
    let mut scene = pushed(model, 90.0, &[[0.0, acceleration]]);
    let grip = acceleration * mass / share;
    let target = DifferentialDrive { lateral_grip: grip, ..drive(model) };
    scene.config.blue[0].drive = Drive::Differential(target);
    let pusher = &mut scene.config.yellow[0];
    pusher.mass *= mass;
    let strong = DifferentialDrive { motor_torque: 1.0, ..drive(pusher) };
    pusher.drive = Drive::Differential(strong);
    scene
}

#[test]
fn pushers_that_accelerate_hard_bounced_in_each_tick() {
    for model in MODELS {
        for tick in [0.005, 0.0025] {
            for acceleration in [8.0, 10.0, 13.0, 20.0] {
                for (share, mass) in [(0.5, 1.0), (0.6, 1.0), (0.95, 1.0), (0.95, 0.7), (0.8, 1.4)]
                {
                    let mut scene = pushed_hard(&model, share, mass, acceleration);
                    scene.config.tick = tick;
                    // The impact over the gap between both moves the robot by millimeters.
                    let places = [1.0, 10.0].map(|seconds| {
                        let row = scene.after(steps(seconds, scene.config.time_step));
                        robots(&row).next().expect("a robot")[0]
                    });
                    let label = format!(
                        "{}, {acceleration} m/s², {share} of the grip, mass {mass}, {tick} s",
                        model.name
                    );
                    assert!((0.0..4e-3).contains(&places[0]), "{label}: {} m", places[0]);
                    assert!((places[1] - places[0]).abs() < 1e-5, "{label}: {places:?} m");
                }
            }
        }
    }
}

#[test]
fn a_robot_holds_two_pushers_in_line() {
    for model in MODELS {
        for (acceleration, share) in [(6.0, 0.95), (10.0, 0.6), (16.0, 0.9)] {
            let mut scene = pushed(&model, 90.0, &[[0.0, acceleration]; 2]);
            scene.set_robot_column(2, "x", -2.0 * (side(&model) + 1e-4));
            let grip = 2.0 * acceleration / share;
            let target = DifferentialDrive { lateral_grip: grip, ..drive(&model) };
            scene.config.blue[0].drive = Drive::Differential(target);
            for pusher in &mut scene.config.yellow {
                let strong = DifferentialDrive { motor_torque: 1.0, ..drive(pusher) };
                pusher.drive = Drive::Differential(strong);
            }
            let places = [1.0, 10.0].map(|seconds| {
                let row = scene.after(steps(seconds, scene.config.time_step));
                robots(&row).next().expect("a robot")[0]
            });
            let label = format!("{}, {acceleration} m/s², {share} of the grip", model.name);
            assert!((0.0..8e-3).contains(&places[0]), "{label}: {} m", places[0]);
            assert!((places[1] - places[0]).abs() < 5e-5, "{label}: {places:?} m");
        }
    }
}

#[test]
fn tires_that_roll_hold_a_push_across() {
    // The robot drives away under the smooth front of the pusher.
    for model in MODELS {
        let mut scene = pushed(&model, 90.0, &[[0.0, 0.8 * drive(&model).lateral_grip]]);
        scene.config.blue[0].friction = 0.0;
        scene.config.yellow[0].friction = 0.0;
        scene.driver = Driver::Constant(vec![vec![0.03, 0.03], vec![20.0, 20.0]]);
        let row = scene.after(steps(10.0, scene.config.time_step));
        let robot = robots(&row).next().expect("a robot");
        let way = 10.0 * 0.03 * drive(&model).wheel_radius;
        assert!((robot[1] - way).abs() < 1e-3, "{}: {} m, driven {way} m", model.name, robot[1]);
        assert!(robot[0].abs() < 2e-3, "{}: pushed aside to {} m", model.name, robot[0]);
    }
}
