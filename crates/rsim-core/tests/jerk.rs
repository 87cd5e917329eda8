//! Robots with a maximum jerk.

use rsim_core::scenes::{Scene, lone_omni, robots};
use rsim_core::{Drive, OmniDrive, RobotModel};

const TICKS: [f32; 2] = [0.005, 0.0025];

fn with_jerk(jerk: f32) -> RobotModel {
    let model = RobotModel::SSL_GENERIC;
    let Drive::Omni(drive) = model.drive else { panic!("{} has other wheels", model.name) };
    RobotModel { drive: Drive::Omni(OmniDrive { max_jerk: jerk, ..drive }), ..model }
}

/// A single robot with a commanded velocity.
fn driven(jerk: f32, tick: f32, command: [f32; 2]) -> Scene {
    let mut scene = lone_omni(&[command[0], command[1], 0.0]);
    scene.config.blue = vec![with_jerk(jerk)];
    scene.config.tick = tick;
    scene.set_ball([-4.0, 2.5], [0.0, 0.0]);
    scene.set_robot_column(0, "x", -1.5);
    scene
}

/// Velocities after each tick.
fn velocities(scene: &Scene, seconds: f32) -> Vec<[f32; 2]> {
    let rows = scene.every_tick(seconds);
    let robot = |row: &Vec<f32>| robots(row).next().map(|robot| [robot[4], robot[5]]);
    rows.iter().map(|row| robot(row).expect("a robot")).collect()
}

/// Maximum jerk in a tick, m/s³, of a robot without acceleration at the start.
fn max_jerk(velocities: &[[f32; 2]], tick: f32) -> f32 {
    let change = |pair: &[[f32; 2]]| [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
    let mut changes = vec![[0.0; 2]];
    changes.extend(velocities.windows(2).map(change));
    let jerks = changes.windows(2).map(|pair| {
        let [x, y] = change(pair);
        x.hypot(y) / tick / tick
    });
    jerks.fold(0.0, f32::max)
}

#[test]
fn a_robot_with_a_limit_speeds_up_and_stops_within_it() {
    for tick in TICKS {
        for jerk in [8.0, 20.0, 60.0] {
            for command in [[2.0_f32, 0.0], [0.0, 1.4], [-1.2, 0.9], [0.6, 0.0]] {
                let speed = command[0].hypot(command[1]);
                let label = format!("{tick} s, {jerk} m/s³, {command:?}");
                let up = velocities(&driven(jerk, tick, command), 1.5);
                check(&up, tick, jerk, command, &label);
                let mut stop = driven(jerk, tick, [0.0; 2]);
                stop.set_robot_column(0, "v_x", command[0]);
                stop.set_robot_column(0, "v_y", command[1]);
                let down = velocities(&stop, 1.5);
                check(&down, tick, jerk, [0.0; 2], &label);
                let most = speed * 1.01;
                for [x, y] in up.into_iter().chain(down) {
                    assert!(x.hypot(y) <= most, "{label}: {x} {y}");
                }
            }
        }
    }
}

/// Checks that the limit holds, and that the robot reaches the target velocity without overshoot.
fn check(velocities: &[[f32; 2]], tick: f32, jerk: f32, target: [f32; 2], label: &str) {
    let got = max_jerk(velocities, tick);
    // With the error of a second difference in single precision.
    let most = jerk + 1e-6 / tick / tick;
    assert!(got <= most, "{label}: {got} m/s³");
    let last = velocities[velocities.len() - 1];
    let missing = (last[0] - target[0]).hypot(last[1] - target[1]);
    assert!(missing < 1e-3, "{label}: {last:?}, target {target:?}");
    let missing: Vec<f32> =
        velocities.iter().map(|[x, y]| (x - target[0]).hypot(y - target[1])).collect();
    let turns_back = missing.windows(2).any(|pair| pair[1] > pair[0] + 0.01 * missing[0]);
    assert!(!turns_back, "{label}: it overshoots: {missing:?}");
}

#[test]
fn without_a_limit_acceleration_starts_at_once() {
    let Drive::Omni(drive) = with_jerk(0.0).drive else { unreachable!() };
    for tick in TICKS {
        let got = velocities(&driven(0.0, tick, [2.0, 0.0]), 0.5);
        for (nth, [x, y]) in got.iter().enumerate() {
            let expected = (drive.max_acceleration * tick * nth as f32).min(2.0);
            assert!((x - expected).abs() < 1e-4 && y.abs() < 1e-5, "{nth}: {x}, {expected}");
        }
    }
    // A limit that is never reached changes nothing.
    let free = velocities(&driven(0.0, 0.005, [1.0, 0.7]), 0.5);
    let wide = velocities(&driven(1e6, 0.005, [1.0, 0.7]), 0.5);
    for (free, wide) in free.iter().zip(wide) {
        assert!((free[0] - wide[0]).abs() + (free[1] - wide[1]).abs() < 1e-4, "{free:?} {wide:?}");
    }
}
