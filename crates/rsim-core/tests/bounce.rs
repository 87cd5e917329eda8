//! Bounces of the ball off walls and robots: the restitution of its preset along the normal, Coulomb's
//! friction along the surface.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{ball_column, robot_column};
use rsim_core::scenes::{self, Driver, Scene, deepest_ball, lone_ball, robots};
use rsim_core::{BallModel, Body, Drive, OmniDrive, RobotModel, SimConfig};

/// A floor without friction, so that only the bounce changes the ball.
fn slippery(ball: &BallModel, n_blue: usize) -> SimConfig {
    let ball = BallModel {
        sliding_deceleration: 0.0,
        rolling_deceleration: 0.0,
        spin_deceleration: 0.0,
        ..ball.clone()
    };
    SimConfig { ball, ..scenes::ssl(n_blue, 0) }
}

/// Coulomb's law for a ball that hits a wall: speeds back and along it, and spin about the vertical axis
/// (rad/s), from its speeds toward and along it.
fn coulomb(ball: &BallModel, toward: f32, along: f32) -> (f32, f32, f32) {
    // A solid sphere stops slipping when friction has taken 2/7 of the slip.
    let taken =
        (ball.wall_friction * (1.0 + ball.wall_restitution) * toward).min(2.0 / 7.0 * along);
    (ball.wall_restitution * toward, along - taken, 2.5 * taken / ball.radius)
}

#[test]
fn a_wall_gives_back_its_restitution_at_every_speed() {
    for ball in BallModel::PRESETS {
        for speed in [0.5, 1.0, 2.0, 4.0, 8.0] {
            for tick in [0.001, 0.0025, 0.005] {
                let config = SimConfig { tick, ..slippery(&ball, 0) };
                let row = lone_ball(config, [0.1, 3.1], [0.0, speed]).after(20);
                let back = -row[ball_column("v_y")] / speed;
                let expected = ball.wall_restitution;
                assert!((back - expected).abs() < 0.01, "{} {speed} m/s: {back}", ball.name);
            }
        }
    }
}

#[test]
fn steep_and_grazing_bounces_obey_coulomb() {
    for ball in BallModel::PRESETS {
        for (speed, degrees) in [(2.0_f32, 45.0_f32), (6.0, 45.0), (4.0, 15.0), (4.0, 75.0)] {
            let (toward, along) = (degrees.to_radians().sin(), degrees.to_radians().cos());
            let (toward, along) = (speed * toward, speed * along);
            let scene = lone_ball(slippery(&ball, 0), [-2.0, 3.1], [along, toward]);
            let row = scene.after(20);
            let (back, left, spin) = coulomb(&ball, toward, along);
            for (what, got, expected) in [
                ("back", -row[ball_column("v_y")], back),
                ("along", row[ball_column("v_x")], left),
                ("spin", row[ball_column("spin_z")], spin),
            ] {
                let error = (got / expected - 1.0).abs();
                let label = format!("{} {speed} m/s at {degrees} degrees", ball.name);
                assert!(error < 0.05, "{label}, {what}: {got}, Coulomb says {expected}");
            }
        }
    }
}

#[test]
fn the_spin_of_a_bounce_decays_by_its_law() {
    let mut config = slippery(&BallModel::SSL_TIGERS, 0);
    config.ball.spin_deceleration = BallModel::SSL_TIGERS.spin_deceleration;
    let (spin_z, scene) = (ball_column("spin_z"), lone_ball(config, [-2.0, 3.1], [2.0, 2.0]));
    let (early, late) = (scene.after(8)[spin_z], scene.after(48)[spin_z]);
    assert!((early - late - 10.0).abs() < 0.1, "10 rad/s in a second: {early}, {late}");
}

/// An SSL robot at the center; the ball comes at it from `degrees` of its front.
fn at_robot(ball: &BallModel, degrees: f32, speed: f32) -> Scene {
    let poses = [[0.0, 0.0, 0.0]];
    let mut scene = Scene::at("at_robot", slippery(ball, 1), &poses, Driver::STILL);
    let (sin, cos) = degrees.to_radians().sin_cos();
    scene.set_ball([0.3 * cos, 0.3 * sin], [-speed * cos, -speed * sin]);
    scene
}

#[test]
fn a_robot_gives_back_its_restitution_at_front_and_side() {
    for ball in BallModel::PRESETS {
        for speed in [0.5, 1.0, 2.0, 4.0, 8.0] {
            for degrees in [0.0_f32, 90.0, 180.0, -100.0] {
                let scene = at_robot(&ball, degrees, speed);
                let (rows, _) = scene.play(&mut scene.world(), 60);
                // The separation speed, relative to the robot that recoiled.
                let (sin, cos) = degrees.to_radians().sin_cos();
                let outward = |x: f32, y: f32| x * cos + y * sin;
                let after = rows
                    .chunks_exact(scene.config.row_size())
                    .find(|row| outward(row[ball_column("v_x")], row[ball_column("v_y")]) > 0.0);
                let row = after.expect("it bounced");
                let ball_speed = outward(row[ball_column("v_x")], row[ball_column("v_y")]);
                // The wheels brake the robot between the bounce and the end of the step: its speed after
                // the bounce follows from momentum.
                let model = &scene.config.blue[0];
                let given = ball.mass * (ball_speed + speed) / model.mass;
                let back = (ball_speed + given) / speed;
                let expected = ball.robot_restitution;
                assert!(
                    (back - expected).abs() < 0.01,
                    "{} {speed} m/s at {degrees}: {back}, not {expected}",
                    ball.name
                );
                let robot = robots(row).next().expect("a robot");
                assert!(outward(robot[4], robot[5]) <= 1e-4, "it was pushed back");
            }
        }
    }
}

#[test]
fn a_wall_takes_spin_from_a_rolling_ball_by_the_same_law() {
    // The front of the ball moves down along the wall: the slip is the ball's speed, and friction takes
    // 5/7 of it, or 2.5 mu (1 + e) of the closing speed if that is less.
    for ball in BallModel::PRESETS {
        let speed = 2.0;
        let mut scene = lone_ball(slippery(&ball, 0), [0.0, 3.1], [0.0, speed]);
        scene.config.ball.sliding_deceleration = 0.0;
        scene.set_ball_column("spin_x", -speed / ball.radius);
        let row = scene.after(8);
        let taken = 2.5 * ball.wall_friction * (1.0 + ball.wall_restitution);
        let expected = -speed / ball.radius * (1.0 - taken.min(5.0 / 7.0));
        let got = row[ball_column("spin_x")];
        assert!((got / expected - 1.0).abs() < 0.05, "{}: {got}, not {expected}", ball.name);
        assert_eq!(row[ball_column("z")], 0.0, "it stays on the floor");
    }
}

/// A robot whose wheels do next to nothing.
fn free_robot() -> RobotModel {
    let model = RobotModel::SSL_GENERIC;
    let Drive::Omni(drive) = &model.drive else { panic!("it has other wheels") };
    let drive = OmniDrive {
        max_acceleration: 1e-4,
        max_deceleration: 1e-4,
        max_angular_acceleration: 1e-4,
        max_angular_deceleration: 1e-4,
        max_traction: 1e-4,
        ..*drive
    };
    RobotModel { drive: Drive::Omni(drive), ..model }
}

#[test]
fn a_ball_turns_a_round_robot_by_its_friction_at_every_speed_and_tick() {
    let (robot, ball) = (free_robot(), BallModel::SSL_TIGERS);
    let Body::Round { radius, .. } = robot.body else { panic!("it is not round") };
    let inertia = robot.mass * radius * radius / 2.0;
    for speed in [1.0_f32, 3.0, 6.0, 10.0] {
        for aside in [0.03_f32, 0.06, 0.09] {
            // Against the back of the robot.
            let sin = aside / (radius + ball.radius);
            let (toward, along) = (speed * (1.0 - sin * sin).sqrt(), speed * sin);
            let push =
                (1.0 + ball.robot_restitution) * toward / (1.0 / ball.mass + 1.0 / robot.mass);
            let turning = radius * radius / inertia;
            let stop = along / (3.5 / ball.mass + 1.0 / robot.mass + turning);
            let expected = (ball.robot_friction * push).min(stop) * radius / inertia;
            for tick in [0.001, 0.005] {
                let config = SimConfig { tick, ..slippery(&ball, 0) };
                let config = SimConfig { blue: vec![robot.clone()], ..config };
                let mut scene = Scene::at("hit", config, &[[0.0, 0.0, 0.0]], Driver::STILL);
                scene.set_ball([-0.5, aside], [speed, 0.0]);
                let row = scene.after(24);
                let turned = robots(&row).next().expect("one")[robot_column("v_theta")];
                let error = (turned.abs() / expected - 1.0).abs();
                let label = format!("{speed} m/s, {aside} m aside, ticks of {tick} s");
                assert!(error < 0.03, "{label}: {turned} rad/s, friction gives {expected}");
            }
        }
    }
}

/// A ball that bounces at the time `contact` of its tick: its places along the normal, m, from the place of the
/// contact, and where it would be with the speed of the bounce from then on.
fn places_after(scene: &Scene, at: [f32; 2], toward: [f32; 2], speed: f32) -> Vec<[f32; 2]> {
    let along = |x: f32, y: f32| x * toward[0] + y * toward[1];
    let (tick, v_x) = (scene.config.tick, ball_column("v_x"));
    let way = along(at[0] - scene.start[0], at[1] - scene.start[1]);
    let contact = way / speed;
    let rows = scene.every_tick(contact + 0.03);
    let places = rows.iter().enumerate().filter_map(|(nth, row)| {
        let since = nth as f32 * tick - contact;
        let back = along(row[v_x], row[v_x + 1]);
        (since > 0.0).then(|| [along(row[0] - at[0], row[1] - at[1]), back * since])
    });
    places.collect()
}

/// It stayed at the wall or robot until the tick ended, and was up to 12 mm behind.
#[test]
fn a_ball_lost_the_rest_of_the_tick_of_its_bounce() {
    for speed in [0.5, 2.0, 5.0] {
        for nth in 0..8_u8 {
            let away = 0.05 + 0.005 * speed * f32::from(nth) / 8.0;
            let config = slippery(&BallModel::VSS_RSIM, 0);
            let wall = [0.0, config.field.max_y() - config.ball.radius];
            let at_wall = lone_ball(config, [0.0, wall[1] - away], [0.0, speed]);
            let robot = at_robot(&BallModel::VSS_RSIM, 0.0, speed);
            let front = RobotModel::SSL_GENERIC.front_distance() + robot.config.ball.radius;
            let mut at_robot = robot;
            at_robot.set_ball([front + away, 0.0], [-speed, 0.0]);
            for (scene, at, toward) in
                [(at_wall, wall, [0.0, 1.0]), (at_robot, [front, 0.0], [-1.0, 0.0])]
            {
                let places = places_after(&scene, at, toward, speed);
                assert!(places.len() > 2 && places[2][0] < 0.0, "{speed} m/s: {places:?}");
                for [place, expected] in places {
                    let label = format!("{} at {speed} m/s, {away} m away", scene.name);
                    assert!((place - expected).abs() < 5e-4, "{label}: {place}, not {expected} m");
                }
            }
        }
    }
}

/// Between a wall and a robot there is less space than a ball makes on its way back in a tick.
#[test]
fn a_ball_that_bounces_enters_no_other_body() {
    for space in [0.5e-3, 2e-3, 5e-3] {
        for degrees in [0.0_f32, 30.0, 60.0] {
            let config = SimConfig { tick: 0.005, ..scenes::vss(1, 0) };
            let (half, radius) = (RobotModel::VSS_440RPM.front_distance(), config.ball.radius);
            let wall = config.field.max_y();
            let poses = [[0.0, wall - 2.0 * radius - space - half, 90.0]];
            let mut scene = Scene::at("slot", config, &poses, Driver::STILL);
            let (sin, cos) = degrees.to_radians().sin_cos();
            scene.set_ball([-0.02, wall - radius - 0.8 * space], [5.0 * sin, 5.0 * cos]);
            for row in scene.every_tick(0.1) {
                let deep = deepest_ball(&scene.config, &row).max(row[1] + radius - wall);
                assert!(deep < 1e-3, "{space} m, {degrees} degrees: {deep} m deep: {row:?}");
            }
        }
    }
}
