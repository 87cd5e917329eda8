//! Robots that press against walls and each other under constant commands come to rest, and leave when they
//! are commanded to.

use rsim_core::columns::{BALL_COLUMNS, ball_column};
use rsim_core::scenes::{self, Driver, Scene, driving, robots, steps, uniform};
use rsim_core::{Body, RobotModel, SimConfig};

/// Speed of bodies at rest, m/s. The slowest creep of a loaded tire is as fast.
const REST: f32 = 0.008;

/// Time for a crowd to come to rest, and then a sixth of it at rest, s.
const SETTLING: f32 = 6.0;

/// Distance from a robot's center to its side, m.
fn side(model: &RobotModel) -> f32 {
    match model.body {
        Body::Square { side_length } => side_length / 2.0,
        Body::Round { radius, .. } => radius,
    }
}

/// Robots at poses that all drive straight ahead at `speed` (m/s), and the ball.
fn crowd(config: &SimConfig, poses: &[[f32; 3]], speed: f32, ball: [f32; 2]) -> Scene {
    let commands = poses.iter().zip(config.robots()).map(|([_, _, degrees], model)| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        driving(model, *degrees, [speed * cos, speed * sin])
    });
    let driver = Driver::Constant(commands.collect());
    let mut scene = Scene::at("pressing", config.clone(), poses, driver);
    scene.set_ball(ball, [0.0; 2]);
    scene
}

/// A crowd of `robots`, and the speeds that it is tried at, m/s.
fn crowds(robots: usize) -> [(SimConfig, [f32; 3]); 2] {
    let half = robots / 2;
    [
        (scenes::vss(robots - half, half), [0.2, 0.6, 1.15]),
        (scenes::ssl(robots - half, half), [0.3, 1.0, 3.0]),
    ]
}

fn check_rest(scene: &Scene, label: &str) {
    let rows = scene.every_tick(SETTLING * 7.0 / 6.0);
    let v_x = ball_column("v_x");
    let settled = rows.len() * 6 / 7;
    for row in &rows[settled..] {
        let ball = row[v_x].hypot(row[v_x + 1]);
        assert!(ball < REST, "{label}: the ball moves at {ball} m/s");
        for (index, robot) in robots(row).enumerate() {
            let speed = robot[4].hypot(robot[5]);
            assert!(speed < REST, "{label}: robot {index} moves at {speed} m/s");
        }
    }
}

/// Eight squares kept moving at 0.03 m/s, and discs broke out of line.
#[test]
fn robots_one_behind_the_other_at_a_wall_kept_moving() {
    for (config, speeds) in crowds(8) {
        let half = side(&config.blue[0]);
        for (nth, speed) in speeds.into_iter().enumerate() {
            let draw = |robot: usize| uniform(nth as u64 * 100 + robot as u64);
            let poses: Vec<_> = (0..8)
                .map(|robot| {
                    let y =
                        config.field.max_y() - half - 0.01 - (2.0 * half + 0.003) * robot as f32;
                    [0.001 * draw(robot), y, 90.0 + 2.0 * draw(robot + 50)]
                })
                .collect();
            let scene = crowd(&config, &poses, speed, [-0.4, -0.4]);
            check_rest(&scene, &format!("{}, {speed} m/s", config.blue[0].name));
        }
    }
}

#[test]
fn robots_side_by_side_at_a_wall_come_to_rest() {
    for (config, speeds) in crowds(8) {
        let half = side(&config.blue[0]);
        for speed in speeds {
            let y = config.field.max_y() - half - 0.03;
            let place = |robot: usize| [(2.0 * half + 0.003) * (robot as f32 - 3.5), y, 90.0];
            let poses: Vec<_> = (0..8).map(place).collect();
            let scene = crowd(&config, &poses, speed, [-0.4, -0.4]);
            check_rest(&scene, &format!("{}, {speed} m/s", config.blue[0].name));
        }
    }
}

/// Robots one behind the other drive a ball into a corner.
#[test]
fn robots_that_press_a_ball_into_a_corner_come_to_rest() {
    for (config, speeds) in crowds(3) {
        let (model, radius) = (&config.blue[0], config.ball.radius);
        let (field, diagonal) = (&config.field, std::f32::consts::FRAC_1_SQRT_2);
        let inset = if field.corner_leg > 0.0 {
            field.corner_leg / 2.0 + (radius + 0.002) * diagonal
        } else {
            radius + 0.002
        };
        let end = field.half_length() + field.goal_line_margin;
        let ball = [end - inset, field.max_y() - inset];
        for speed in speeds {
            let away = |robot: usize| {
                let first = side(model) + radius + 0.01;
                (first + (2.0 * side(model) + 0.01) * robot as f32) * diagonal
            };
            let place = |robot: usize| [ball[0] - away(robot), ball[1] - away(robot), 45.0];
            let poses: Vec<_> = (0..3).map(place).collect();
            let scene = crowd(&config, &poses, speed, ball);
            check_rest(&scene, &format!("{}, {speed} m/s", model.name));
        }
    }
}

/// Way of a robot in 0.4 s with both wheels at full speed backwards, m, after `hold` (s) at full speed ahead.
fn way_back(config: &SimConfig, pose: [f32; 3], hold: f32) -> f32 {
    let mut scene = Scene::at("leaving", config.clone(), &[pose], Driver::STILL);
    scene.set_ball([-0.5, -0.5], [0.0; 2]);
    let full = 2.0 * config.blue[0].top_speed() / 0.02;
    let mut world = scene.world();
    let mut row = scene.start.clone();
    let mut drive = |wheels: f32, seconds: f32| {
        for _ in 0..steps(seconds, config.time_step) {
            world.step(&[wheels; 2]).expect("finite");
        }
        world.write_row(&mut row);
        [row[BALL_COLUMNS.len()], row[BALL_COLUMNS.len() + 1]]
    };
    let [x, y] = drive(full, hold);
    let [back_x, back_y] = drive(-full, 0.4);
    (back_x - x).hypot(back_y - y)
}

/// A robot that has driven into a wall leaves it as fast as one that starts in the open.
#[test]
fn a_robot_leaves_a_wall_like_one_without_a_wall() {
    for model in [RobotModel::VSS_440RPM, RobotModel::VSS_650RPM] {
        for tick in [0.005, 0.0025] {
            let config = SimConfig {
                tick,
                time_step: 0.005,
                blue: vec![model.clone()],
                ..scenes::vss(1, 0)
            };
            let free = way_back(&config, [0.0; 3], 0.0);
            for degrees in [90.0, 89.5, 85.0, 75.0, 60.0, 45.0] {
                for hold in [0.6, 1.0, 3.0] {
                    let way = way_back(&config, [-0.2, 0.5, degrees], hold);
                    let label = format!("{}, {tick} s, {degrees} degrees, {hold} s", model.name);
                    assert!(way > 0.98 * free, "{label}: {way} m, not {free} m");
                }
            }
        }
    }
}
