//! The last touch of the ball in a row: who, how long ago, how fast the ball was then, how high it has been since.
#![allow(clippy::float_cmp)] // zeros and equal results are exact

use rsim_core::EngineKind;
use rsim_core::columns::{ball_column, robot_column};
use rsim_core::scenes::{self, Driver, Scene, ball_in_mouth, robots};

/// The last touch in a row.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Touch {
    robot: f32,
    seconds: f32,
    speed: f32,
    height: f32,
}

fn touch(row: &[f32]) -> Touch {
    let [robot, seconds, speed, height] =
        ["last_touch", "seconds_since_touch", "speed_after_touch", "height_since_touch"]
            .map(|name| row[ball_column(name)]);
    Touch { robot, seconds, speed, height }
}

/// Touches after each of `steps` control steps under both engines.
fn touches(scene: &Scene, steps: u64) -> Vec<Vec<(Touch, Vec<f32>)>> {
    EngineKind::ALL
        .into_iter()
        .map(|engine| {
            let mut scene = scene.clone();
            scene.config.engine = engine;
            let (rows, _) = scene.play(&mut scene.world(), steps);
            let rows = rows.chunks_exact(scene.config.row_size());
            rows.map(|row| (touch(row), row.to_vec())).collect()
        })
        .collect()
}

fn speed(row: &[f32]) -> f32 {
    let [x, y, z] = ["v_x", "v_y", "v_z"].map(|name| row[ball_column(name)]);
    (x * x + y * y + z * z).sqrt()
}

#[test]
fn a_kick_has_its_speed_and_its_time() {
    let scene = ball_in_mouth(&[0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
    let [tick, step] = [scene.config.tick, scene.config.time_step];
    for rows in touches(&scene, 20) {
        let (first, row) = &rows[0];
        assert_eq!((first.robot, first.height), (0.0, 0.0));
        assert!((first.seconds - (step - tick)).abs() < 1e-6, "in the first tick: {first:?}");
        assert!((first.speed - 6.0).abs() < 0.05 && first.speed > speed(row) + 0.03, "{first:?}");
        for (nth, (later, _)) in (0_u8..).zip(&rows) {
            let seconds = first.seconds + f32::from(nth) * step;
            assert!((later.seconds - seconds).abs() < 1e-5);
            assert_eq!(
                (later.speed, later.height),
                (first.speed, 0.0),
                "it stays that of the kick"
            );
        }
    }
}

#[test]
fn a_chip_has_its_speed_in_three_dimensions_and_its_greatest_height() {
    for rows in touches(&ball_in_mouth(&[0.0, 0.0, 0.0, 3.0, 3.5, 0.0]), 60) {
        let apex = 3.5_f32.powi(2) / (2.0 * 9.81);
        let (first, _) = rows[0];
        assert!((first.speed - 3.0_f32.hypot(3.5)).abs() < 0.1, "{first:?}");
        let mut highest = 0.0_f32;
        for (touch, row) in &rows {
            highest = highest.max(row[ball_column("z")]);
            assert!(touch.height >= highest && touch.height < highest + 0.05);
        }
        let (last, row) = rows.last().expect("steps");
        assert!((last.height - apex).abs() < 0.02, "{last:?}");
        assert!(row[ball_column("z")] < 0.5 * apex, "it has come down, and the height stays");
    }
}

#[test]
fn a_robot_that_keeps_the_ball_has_touched_it_just_now() {
    for rows in touches(&ball_in_mouth(&[0.6, 0.2, 0.0, 0.0, 0.0, 1.0]), 40) {
        for (touch, row) in &rows {
            assert_eq!((touch.robot, touch.seconds), (0.0, 0.0));
            assert!((touch.speed - speed(row)).abs() < 1e-5, "the speed of now");
        }
    }
}

#[test]
fn of_two_robots_the_later_one_begins_anew() {
    let poses = [[0.5, 0.0, 180.0], [-0.5, 0.0, 0.0]];
    let mut scene = Scene::at("touches", scenes::ssl(1, 1), &poses, Driver::STILL);
    scene.set_ball([0.2, 0.0], [3.0, 0.0]);
    for rows in touches(&scene, 40) {
        assert_eq!(rows[0].0, Touch { robot: -1.0, seconds: 0.0, speed: 0.0, height: 0.0 });
        for robot in [0.0, 1.0] {
            let first = rows.iter().position(|(touch, _)| touch.robot == robot).expect("a touch");
            assert!(rows[first].0.seconds < scene.config.time_step);
            let after = speed(&rows[first].1);
            assert!(rows[first].0.speed >= after && rows[first].0.speed < after + 0.1);
        }
        let touched =
            |row: &[f32]| robots(row).any(|robot| robot[robot_column("touched_ball")] > 0.0);
        for (touch, row) in rows.iter().filter(|(touch, _)| touch.robot >= 0.0) {
            assert_eq!(touched(row), touch.seconds < scene.config.time_step - 1e-6, "{touch:?}");
        }
    }
}

#[test]
fn it_is_forgotten_with_a_new_ball_and_kept_in_snapshots() {
    let scene = ball_in_mouth(&[0.0, 0.0, 0.0, 3.0, 3.5, 0.0]);
    let (mut batch, mut rows) = scene.batch(1, 1);
    let commands = scene.commands(&scene.start, 0, 0);
    for _ in 0..4 {
        batch.step(&commands, &mut rows, None).expect("finite");
    }
    let before = (touch(&rows), batch.snapshot());
    assert!(before.0.seconds > 0.05 && before.0.height > 0.1);
    let mut ball = rows[..ball_column("last_touch")].to_vec();
    ball.resize(rsim_core::columns::BALL_COLUMNS.len(), 0.0);
    batch.reposition_balls(&[true], &ball, &mut rows).expect("free");
    assert_eq!(touch(&rows), Touch { robot: -1.0, seconds: 0.0, speed: 0.0, height: 0.0 });
    batch.restore(&before.1).expect("its own");
    batch.read(&mut rows);
    assert_eq!(touch(&rows), before.0);
}
