//! Commands on the way, and what robots make of them.

use rsim_core::columns::{ball_column, robot_column, row_size};
use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{RobotModel, Sensing, SimConfig};

use super::{Played, assert_near, moments};

#[test]
fn robots_obey_as_late_as_asked() {
    let scene = scenes::lone_robot([20.0, 30.0]);
    let ticks = scene.every_tick(1.0);
    for (delay, late) in [(0.0, 0), (0.005, 1), (0.045, 9), (0.1, 20)] {
        let sensing = Sensing { command_delay: delay, ..Sensing::OFF };
        let played = Played::new(&scene, sensing, 1, 40);
        for name in ["x", "y", "v_x", "v_theta"] {
            let at = row_size(0) + robot_column(name);
            for (step, truth) in (1..=40_usize).zip(played.column(Some(0), name)) {
                let expected = ticks[(step * 5).saturating_sub(late)][at];
                assert!((truth[0][0] - expected).abs() < 1e-6, "{delay} {name} {step}");
            }
        }
    }
}

#[test]
fn a_robot_that_hears_nothing_stands_and_one_that_hears_no_more_stops() {
    let scene = scenes::lone_robot([20.0, 20.0]);
    let x = |sensing| Played::new(&scene, sensing, 1, 80).column(Some(0), "v_x");
    assert!(x(Sensing { command_loss: 1.0, ..Sensing::OFF }).iter().all(|v| v[0][0] == 0.0));
    // Rare commands: the robot goes on with the last one, or stops 50 ms after it.
    let rare = Sensing { command_loss: 0.9, ..Sensing::OFF };
    let goes = moments(x(rare.clone()).iter().map(|v| v[0][0])).0;
    let stops = moments(x(Sensing { command_timeout: 0.05, ..rare }).iter().map(|v| v[0][0])).0;
    assert!(goes > 2.0 * stops && stops > 0.0, "{goes} {stops}");
}

#[test]
fn wheels_have_errors_of_their_own() {
    let spread = |scene: &Scene, sensing| {
        let turn = Played::new(scene, sensing, 200, 40).column(Some(0), "v_theta");
        moments(turn[39].iter().map(|turn| turn[0]))
    };
    let straight = scenes::lone_robot([20.0, 20.0]);
    let (_, none) = spread(&straight, Sensing { delay: 0.1, ..Sensing::OFF });
    let (mean, some) = spread(&straight, Sensing { wheel_error: 0.03, ..Sensing::OFF });
    assert!(none < 1e-6);
    // Two wheels of 0.026 m turn at 20 rad/s with 3% of error, on a track of 0.0775 m or so.
    assert!(mean.abs() < 0.1, "{mean}");
    assert_near(some, 20.0 * 0.03 * 2.0_f64.sqrt() * 0.026 / 0.0775, 0.15);
    let omni = scenes::lone_omni(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let (_, some) = spread(&omni, Sensing { wheel_error: 0.03, ..Sensing::OFF });
    assert!((0.05..1.0).contains(&some), "{some}");
}

#[test]
fn a_wheel_beyond_its_limit_is_clipped_as_without_errors() {
    let turn = |sensing| {
        let scene = scenes::lone_robot([100.0, 20.0]);
        Played::new(&scene, sensing, 1, 40).column(Some(0), "v_theta")[39][0][0]
    };
    let exact = turn(Sensing { delay: 0.1, ..Sensing::OFF });
    let nearly = turn(Sensing { wheel_error: 1e-7, ..Sensing::OFF });
    assert!(exact < -1.0 && (exact - nearly).abs() < 1e-3, "{exact} {nearly}");
}

#[test]
fn slow_wheels_stand_in_the_dead_zone() {
    let speed = |wheel: f32| {
        let sensing = Sensing { wheel_dead_zone: 0.05, ..Sensing::OFF };
        Played::new(&scenes::lone_robot([wheel, wheel]), sensing, 1, 40).column(Some(0), "v_x")[39]
            [0][0]
    };
    let radius = 0.026;
    assert_eq!(speed(0.049 / radius).to_bits(), 0.0_f32.to_bits());
    assert!((speed(0.051 / radius) - 0.051).abs() < 0.002, "{}", speed(0.051 / radius));
}

#[test]
fn batteries_sag_to_half() {
    let speed = |battery_sag| {
        let sensing = Sensing { battery_sag, ..Sensing::OFF };
        let mut scene = scenes::lone_omni(&[9.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        scene.set_robot_column(0, "x", -4.0);
        Played::new(&scene, sensing, 1, 80).column(Some(0), "v_x")[79][0][0]
    };
    let full = speed(0.0);
    assert!((speed(0.1) / full - 0.8).abs() < 0.02, "{} of {full}", speed(0.1));
    assert!((speed(10.0) / full - 0.5).abs() < 0.02, "{} of {full}", speed(10.0));
}

/// Ball velocities after a kick of 4 m/s with these senses.
fn kicks(sensing: Sensing) -> Vec<[f32; 2]> {
    let scene = scenes::ball_in_mouth(&[0.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
    let played = Played::new(&scene, sensing, 1000, 1);
    let [v_x, v_y] = ["v_x", "v_y"].map(ball_column);
    let rows = played.truth[0].chunks_exact(scene.config.row_size());
    rows.map(|row| [row[v_x], row[v_y]]).collect()
}

#[test]
fn kicks_scatter_in_speed_and_direction_as_asked() {
    let exact = kicks(Sensing { delay: 0.1, ..Sensing::OFF });
    assert!(exact.windows(2).all(|pair| pair[0].map(f32::to_bits) == pair[1].map(f32::to_bits)));
    let sensing = Sensing { kick_speed_noise: 0.05, kick_direction_noise: 0.03, ..Sensing::OFF };
    let scattered = kicks(sensing);
    let speeds = scattered.iter().map(|[x, y]| x.hypot(*y));
    assert_near(moments(speeds).1, 4.0 * 0.05, 0.06);
    let directions = scattered.iter().map(|[x, y]| y / x);
    let (mean, deviation) = moments(directions);
    assert!(mean.abs() < 0.003, "{mean}");
    assert_near(deviation, 0.03, 0.06);
}

#[test]
fn kickers_and_dribblers_fail_as_often_as_asked() {
    let scattered = kicks(Sensing { kick_failures: 0.2, ..Sensing::OFF });
    let failed = scattered.iter().map(|[x, _]| f32::from(u8::from(*x < 1.0)));
    assert_near(moments(failed).0, 0.2, 0.15);
    // A dribbler that fails all the time loses the ball as one that is off.
    let backwards = |dribbler: f32, dribbler_failures| {
        let scene = scenes::ball_in_mouth(&[-0.5, 0.0, 0.0, 0.0, 0.0, dribbler]);
        let sensing = Sensing { dribbler_failures, delay: 0.01, ..Sensing::OFF };
        Played::new(&scene, sensing, 1, 20).column(None, "x")[19][0][0]
    };
    assert_eq!(backwards(1.0, 1.0).to_bits(), backwards(0.0, 0.0).to_bits());
    assert!(backwards(1.0, 0.0) < backwards(1.0, 1.0) - 0.05);
}

#[test]
fn robots_with_wheels_commanded_one_by_one_have_the_same_errors() {
    let omni = scenes::lone_omni(&[0.0; 6]);
    let wheels =
        RobotModel { drive: wheels_of(&omni.config.blue[0]), ..omni.config.blue[0].clone() };
    let config = SimConfig { blue: vec![wheels], ..omni.config };
    let driver = Driver::Constant(vec![vec![-40.0, -30.0, 30.0, 40.0, 0.0, 0.0, 0.0]]);
    let mut scene = Scene::at("wheels", config, &[[0.0, 0.0, 0.0]], driver);
    scene.set_ball([0.0, 2.5], [0.0, 0.0]);
    let turn = Played::new(&scene, Sensing { wheel_error: 0.03, ..Sensing::OFF }, 100, 20)
        .column(Some(0), "v_theta");
    assert!(moments(turn[19].iter().map(|turn| turn[0])).1 > 0.05);
}

fn wheels_of(model: &RobotModel) -> rsim_core::Drive {
    match &model.drive {
        rsim_core::Drive::Omni(drive) => rsim_core::Drive::OmniWheels(*drive),
        other => panic!("an omnidirectional robot has {other:?}"),
    }
}
