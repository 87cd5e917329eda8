//! Tires of a differential drive: Coulomb friction of each against its slip, also if both slide.

use rsim_core::scenes::{Scene, kinetic_energy, lone_robot, robots, uniform};
use rsim_core::{DifferentialDrive, Drive, RobotModel};

const MODELS: [RobotModel; 2] = [RobotModel::VSS_440RPM, RobotModel::VSS_650RPM];
const TICKS: [f32; 2] = [0.005, 0.0025];

fn drive(model: &RobotModel) -> DifferentialDrive {
    let Drive::Differential(drive) = model.drive else { panic!("{} has other wheels", model.name) };
    drive
}

/// A single robot on a large field.
///
/// `motion` is its velocity forward and to its left (m/s) and its angular velocity (rad/s); `wheels` are
/// fractions of the motors' free speed.
fn moving(model: &RobotModel, tick: f32, motion: [f32; 3], wheels: [f32; 2]) -> Scene {
    let top = drive(model).max_wheel_speed;
    let mut scene = lone_robot(wheels.map(|share| share * top));
    scene.config.blue = vec![model.clone()];
    (scene.config.field.length, scene.config.field.width) = (8.0, 8.0);
    scene.set_ball([-3.5, -3.5], [0.0, 0.0]);
    scene.config.tick = tick;
    for (name, value) in ["v_x", "v_y", "v_theta"].into_iter().zip(motion) {
        scene.set_robot_column(0, name, value);
    }
    scene
}

/// Velocity forward and to its left, and angular velocity, of robot 0.
fn motion(row: &[f32]) -> [f32; 3] {
    let robot = robots(row).next().expect("a robot");
    let (cos, sin) = (robot[2], robot[3]);
    [robot[4] * cos + robot[5] * sin, robot[5] * cos - robot[4] * sin, robot[6]]
}

/// Motion of robot 0 after each tick.
fn motions(scene: &Scene, seconds: f32) -> Vec<[f32; 3]> {
    scene.every_tick(seconds).iter().map(|row| motion(row)).collect()
}

/// Integration of the law in steps of 10 microseconds: friction acts on each tire against its slip.
fn by_the_law(model: &RobotModel, start: [f32; 3], wheels: [f32; 2], seconds: f64) -> [f64; 3] {
    const STEP: f64 = 1e-5;
    let DifferentialDrive {
        wheel_radius,
        track_width,
        max_wheel_speed,
        longitudinal_grip,
        lateral_grip,
        ..
    } = drive(model);
    let half_track = f64::from(track_width) / 2.0;
    let Some(side) = side(model) else { panic!("{} is not square", model.name) };
    // Effect of a force at a wheel on the angular velocity, by its effect on the speed.
    let lever = half_track * 6.0 / (side * side);
    let rims = wheels.map(|share| f64::from(share * max_wheel_speed * wheel_radius));
    let [mut ahead, mut aside, mut angular_velocity] = start.map(f64::from);
    let mut left = seconds;
    while left > STEP / 2.0 {
        let pulls = [(-1.0, rims[0]), (1.0, rims[1])].map(|(sign, rim)| {
            let along = ahead + sign * angular_velocity * half_track - rim;
            let slip = along.hypot(aside).max(1e-4);
            let [forward, sideways] =
                [longitudinal_grip, lateral_grip].map(|grip| f64::from(grip) / 2.0);
            (-forward * along / slip, -sideways * aside / slip)
        });
        let [(left_pull, a), (right_pull, b)] = pulls;
        // The robot's own frame turns.
        let (faster, aside_faster) =
            (left_pull + right_pull + angular_velocity * aside, a + b - angular_velocity * ahead);
        angular_velocity += (right_pull - left_pull) * lever * STEP;
        ahead += faster * STEP;
        aside += aside_faster * STEP;
        left -= STEP;
    }
    [ahead, aside, angular_velocity]
}

fn side(model: &RobotModel) -> Option<f64> {
    let rsim_core::Body::Square { side_length: side } = model.body else { return None };
    Some(f64::from(side))
}

/// A number in [-1, 1): the `part`-th of draw `nth`.
fn draw(nth: u64, part: u64) -> f32 {
    uniform(nth * 16 + part)
}

fn random_motion(nth: u64) -> [f32; 3] {
    [draw(nth, 0) * 1.5, draw(nth, 1) * 1.5, draw(nth, 2) * 40.0]
}

#[test]
fn a_turn_on_the_spot_lasted_through_full_speed_straight_on() {
    for tick in TICKS {
        for initial in (4..=30).map(|initial| initial as f32) {
            for (sign, power) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)] {
                let start = [0.0, 0.0, sign * initial];
                let scene = moving(&RobotModel::VSS_440RPM, tick, start, [power; 2]);
                let [.., angular_velocity] = *motions(&scene, 0.5).last().expect("ticks");
                assert!(
                    angular_velocity.abs() < 0.01,
                    "{initial} rad/s, {tick} s: still {angular_velocity} rad/s"
                );
            }
        }
    }
}

#[test]
fn the_faster_robots_angular_velocity_did_not_fall_at_full_speed() {
    // Its rims are faster, so that its tires slide nearly straight back for longer.
    for tick in TICKS {
        for initial in [4.0, 6.0, 11.0, 19.0, 30.0] {
            let scene = moving(&RobotModel::VSS_650RPM, tick, [0.0, 0.0, initial], [1.0; 2]);
            let angular_velocities: Vec<f32> = motions(&scene, 2.0)
                .iter()
                .map(|[.., angular_velocity]| *angular_velocity)
                .collect();
            let falls = angular_velocities.windows(2).all(|pair| pair[1] <= pair[0] + 1e-4);
            assert!(falls, "{initial} rad/s, {tick} s: {angular_velocities:?}");
            let [.., end] = by_the_law(&RobotModel::VSS_650RPM, [0.0, 0.0, initial], [1.0; 2], 2.0);
            let off = f64::from(angular_velocities[angular_velocities.len() - 1]) - end;
            assert!(off.abs() < 0.5, "{initial} rad/s, {tick} s: off by {off}");
        }
    }
}

#[test]
fn full_throttle_switched_off_the_lateral_grip() {
    for tick in TICKS {
        for (speed, power) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0)] {
            let scene = moving(&RobotModel::VSS_440RPM, tick, [0.0, speed, 0.0], [power; 2]);
            let [ahead, aside, angular_velocity] = *motions(&scene, 0.1).last().expect("ticks");
            assert!((aside / speed - 0.42).abs() < 0.05, "{speed}: still {aside} m/s sideways");
            assert!(
                ahead * power > 0.3 && angular_velocity.abs() < 1e-3,
                "{ahead} m/s, {angular_velocity} rad/s"
            );
        }
    }
}

#[test]
fn locked_wheels_braked_forward_before_they_braked_sideways() {
    for model in MODELS {
        for degrees in [20.0_f32, 45.0, 70.0, 135.0, 250.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let scene = moving(&model, 0.005, [cos, sin, 0.0], [0.0; 2]);
            let [ahead, aside, _] = motions(&scene, 0.05)[10];
            for (what, share) in [("forward", ahead / cos), ("sideways", aside / sin)] {
                let label = format!("{} at {degrees}, {what}: {share} left", model.name);
                assert!((0.3..0.8).contains(&share), "{label}");
            }
        }
    }
    let diagonal = std::f32::consts::FRAC_1_SQRT_2;
    let scene = moving(&MODELS[0], 0.005, [diagonal, diagonal, 0.0], [0.0; 2]);
    let [_, aside, _] = motions(&scene, 0.05)[10];
    assert!((aside - 0.35).abs() < 0.04, "friction against the slip leaves 0.35, not {aside}");
}

#[test]
fn a_robot_faster_than_its_rims_slows_down_to_them() {
    for model in MODELS {
        for tick in TICKS {
            for (faster, initial) in
                [(1.05, 0.0), (1.16, 0.0), (1.4, 5.0), (1.05, 6.0), (1.1, 12.0)]
            {
                let start = faster * model.top_speed();
                let scene = moving(&model, tick, [start, 0.0, initial], [1.0; 2]);
                let speeds = motions(&scene, 0.5).into_iter().map(|[x, y, _]| x.hypot(y));
                let speeds: Vec<f32> = speeds.collect();
                let label = format!("{} {faster} {initial} {tick}: {speeds:?}", model.name);
                assert!(speeds.iter().all(|speed| *speed <= speeds[0] + 1e-5), "{label}");
                assert!(speeds[speeds.len() - 1] < model.top_speed() * 1.001, "{label}");
            }
        }
    }
}

#[test]
fn saturated_commands_drove_robots_past_their_top_speed() {
    for nth in 0..200 {
        for model in MODELS {
            let wheels = [3, 4].map(|part| draw(nth, part).signum());
            let scene = moving(&model, 0.005, random_motion(nth), wheels);
            let speeds = motions(&scene, 0.5).into_iter().map(|[x, y, _]| x.hypot(y));
            let speeds: Vec<f32> = speeds.collect();
            let most = speeds[0].max(model.top_speed()) + 1e-4;
            let fastest = speeds.iter().fold(0.0_f32, |most, speed| most.max(*speed));
            assert!(fastest <= most, "{} {nth}: {fastest}, at most {most}", model.name);
        }
    }
}

#[test]
fn locked_tires_never_add_energy() {
    for nth in 0..200 {
        for model in MODELS {
            let scene = moving(&model, 0.005, random_motion(nth), [0.0; 2]);
            let rows = scene.every_tick(0.5);
            let energies: Vec<f32> =
                rows.iter().map(|row| kinetic_energy(&scene.config, row)).collect();
            let falls = energies.windows(2).all(|pair| pair[1] <= pair[0] * 1.00001);
            assert!(falls, "{} {nth}: {energies:?}", model.name);
            assert!(energies[energies.len() - 1] < 0.05 * energies[0], "it comes to rest");
        }
    }
}

/// A robot whose motors give less at the rim than its tires transmit: 2.5 m/s².
fn weak() -> RobotModel {
    let model = RobotModel::VSS_440RPM;
    let motor_torque = 2.5 * model.mass / 2.0 * drive(&model).wheel_radius;
    let drive = Drive::Differential(DifferentialDrive { motor_torque, ..drive(&model) });
    RobotModel { drive, ..model }
}

#[test]
fn motors_weaker_than_the_tires_limit_the_longitudinal_force_only() {
    let model = weak();
    let [ahead, ..] = motions(&moving(&model, 0.005, [0.0; 3], [1.0; 2]), 0.1)[20];
    assert!((ahead - 0.25).abs() < 0.01, "2.5 m/s² for 0.1 s: {ahead}");
    for nth in 0..100 {
        let wheels = [3, 4].map(|part| draw(nth, part).signum());
        let driven = motions(&moving(&model, 0.005, random_motion(nth), wheels), 0.5);
        let speed = |[x, y, _]: [f32; 3]| x.hypot(y);
        let most = speed(driven[0]).max(model.top_speed()) + 1e-4;
        assert!(driven.iter().all(|motion| speed(*motion) <= most), "{nth}: {driven:?}");
        let locked = moving(&model, 0.005, random_motion(nth), [0.0; 2]);
        let rows = locked.every_tick(1.0);
        let energy = |row: &Vec<f32>| kinetic_energy(&locked.config, row);
        assert!(rows.windows(2).all(|pair| energy(&pair[1]) <= energy(&pair[0]) * 1.00001));
        assert!(energy(&rows[200]) < 0.05 * energy(&rows[0]), "{nth}: it comes to rest");
    }
}

/// Maximum error of a run of 5 ms ticks, m/s and rad/s; that of shorter ticks is smaller in proportion.
const FROM_THE_LAW: [f32; 3] = [0.03, 0.03, 0.8];

#[test]
fn sliding_tires_follow_the_law_at_every_tick() {
    for nth in 0..24 {
        for model in MODELS {
            let (start, wheels) = (random_motion(nth), [3, 4].map(|part| draw(nth, part)));
            let exact = by_the_law(&model, start, wheels, 0.1);
            for tick in [0.005, 0.0025, 0.000_25] {
                let got =
                    *motions(&moving(&model, tick, start, wheels), 0.1).last().expect("ticks");
                let close = got.iter().zip(exact).zip(FROM_THE_LAW).all(|((got, exact), most)| {
                    (f64::from(*got) - exact).abs() < f64::from(most * tick.max(0.001) / 0.005)
                });
                let label = format!("{} {start:?} {wheels:?}, ticks of {tick} s", model.name);
                assert!(close, "{label}: {got:?}, by the law {exact:?}");
            }
        }
    }
}
