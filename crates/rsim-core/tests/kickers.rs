//! Several kickers at one ball.

use rsim_core::columns::{ball_column, robot_column};
use rsim_core::scenes::{self, Driver, Scene, robots, uniform};
use rsim_core::{Body, RobotModel};

/// A robot so small that two can have the ball in their mouths from nearly one direction.
fn small() -> RobotModel {
    let model = RobotModel::SSL_GENERIC;
    RobotModel { body: Body::Round { radius: 0.03, front_distance: 0.028 }, ..model }
}

fn heading(degrees: f32) -> [f32; 2] {
    let (sin, cos) = degrees.to_radians().sin_cos();
    [cos, sin]
}

/// The ball's velocity after one tick in which robots of `model`, whose headings are `degrees` apart
/// about the direction `middle`, kick it at these speeds.
fn kicked(model: &RobotModel, middle: f32, degrees: f32, speeds: [f32; 2]) -> [f32; 2] {
    let mut config = scenes::ssl(1, 1);
    (config.blue, config.yellow) = (vec![model.clone()], vec![model.clone()]);
    config.time_step = config.tick;
    let commands = speeds.map(|speed| vec![0.0, 0.0, 0.0, speed, 0.0, 0.0]).to_vec();
    let away = model.front_distance() + config.ball.radius + 1e-3;
    let half = degrees / 2.0;
    let (sin, cos) = half.to_radians().sin_cos();
    // The offset that keeps the robots apart moves the ball from the middle of the mouth.
    let beside = ((model.bounding_radius() + 5e-4 - away * sin) / cos.max(1e-3)).max(0.0);
    let pose = |side: f32| {
        let angle = middle - side * half;
        let ([x, y], [left_x, left_y]) = (heading(angle), heading(angle + 90.0));
        let beside = side * beside;
        [-away * x + beside * left_x, -away * y + beside * left_y, angle]
    };
    let poses = [pose(1.0), pose(-1.0)];
    let mut scene = Scene::at("kickers", config, &poses, Driver::Constant(commands));
    scene.set_ball([0.0, 0.0], [0.0, 0.0]);
    assert!(beams_are_cut(&scene), "both have it: {degrees} degrees");
    let row = scene.after(1);
    ["v_x", "v_y"].map(|name| row[ball_column(name)])
}

/// Whether both have the ball in their mouths at the start.
fn beams_are_cut(scene: &Scene) -> bool {
    let mut row = scene.start.clone();
    scene.world().write_row(&mut row);
    let mut beams = robots(&row).map(|robot| robot[robot_column("infrared")]);
    beams.all(|beam| beam > 0.0)
}

fn dot(a: [f32; 2], b: [f32; 2]) -> f32 {
    a[0] * b[0] + a[1] * b[1]
}

#[test]
fn two_kickers_gave_one_ball_more_than_plates_can() {
    for middle in [0.0, 70.0, 200.0, 310.0] {
        for degrees in (2..=18).map(|tens| tens as f32 * 10.0) {
            for speed in [2.0, 5.0, 8.0] {
                let [x, y] = kicked(&small(), middle, degrees, [speed; 2]);
                let got = x.hypot(y);
                let cos = (degrees / 2.0).to_radians().cos();
                // Each plate pushes until the ball is as fast as the plate, and never harder than alone.
                let most = (1.0 / cos.max(1e-3)).min(2.0 * cos) * speed;
                let label = format!("{degrees} degrees at {middle}, {speed} m/s");
                assert!((got - most).abs() < 0.03 * speed, "{label}: {got}, not {most}");
                assert!(got <= 1.01 * std::f32::consts::SQRT_2 * speed, "{label}: {got}");
            }
        }
    }
}

#[test]
fn a_weaker_kicker_added_its_whole_kick_to_a_stronger_one() {
    for nth in 0..200 {
        let draw = |part: u64| f32::midpoint(1.0, uniform(nth * 16 + part));
        // Kicks at larger angles send the ball into the weaker robot's plate.
        let (middle, degrees) = (360.0 * draw(0), 20.0 + 65.0 * draw(1));
        let speeds = [1.0 + 7.0 * draw(2), 1.0 + 7.0 * draw(3)];
        let got = kicked(&small(), middle, degrees, speeds);
        let strongest = speeds[0].max(speeds[1]);
        let label = format!("{degrees} degrees, {speeds:?}: {got:?}");
        assert!(got[0].hypot(got[1]) < 1.01 * std::f32::consts::SQRT_2 * strongest, "{label}");
        // No plate drives the ball faster than itself along its direction; the other plate may.
        let cos = degrees.to_radians().cos();
        for (side, [own, other]) in [(-1.0, speeds), (1.0, [speeds[1], speeds[0]])] {
            let along = dot(got, heading(middle + side * degrees / 2.0));
            assert!(along < own.max(other * cos) + 0.02 * strongest, "{label}: {along}");
        }
    }
}

#[test]
fn a_kick_beside_a_robot_that_does_not_kick_has_its_full_speed() {
    for degrees in [30.0, 60.0, 85.0] {
        for speed in [3.0, 7.5] {
            let got = kicked(&small(), 0.0, degrees, [speed, 0.0]);
            let along = dot(got, heading(-degrees / 2.0));
            assert!((along / speed - 1.0).abs() < 0.02, "{degrees}: {along} of {speed}");
        }
    }
}
