//! A ball in the air: its parabola, its hops by preset, and bodies that it clears or hits.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{ball_column, crossing_name};
use rsim_core::scenes::{self, Driver, Scene, ball_in_mouth, lone_ball, steps};
use rsim_core::{BallModel, SimConfig};

const G: f32 = 9.81;

/// A chip along x at `degrees` from `x`, alone on a field with nothing in the way.
fn chip(ball: &BallModel, speed: f32, degrees: f32) -> Scene {
    let mut config = SimConfig { ball: ball.clone(), ..scenes::ssl(0, 0) };
    config.field.length = 60.0;
    let (up, along) = degrees.to_radians().sin_cos();
    let mut scene = lone_ball(config, [0.0, 0.0], [speed * along, 0.0]);
    scene.set_ball_column("v_z", speed * up);
    scene
}

/// Columns `x`, `z`, `v_x` and `v_z` after each tick.
fn flight(mut scene: Scene, seconds: f32) -> Vec<[f32; 4]> {
    scene.config.time_step = scene.config.tick;
    let steps = steps(seconds, scene.config.tick);
    let (rows, _) = scene.play(&mut scene.world(), steps);
    let [z, v_x, v_z] = ["z", "v_x", "v_z"].map(ball_column);
    let rows = rows.chunks_exact(scene.config.row_size());
    rows.map(|row| [row[0], row[z], row[v_x], row[v_z]]).collect()
}

/// Hops between two touch-downs, as (apex, length, horizontal speed).
fn hops(track: &[[f32; 4]]) -> Vec<[f32; 3]> {
    let mut hops = Vec::new();
    let (mut start, mut apex) = (0.0, 0.0_f32);
    for pair in track.windows(2) {
        let [[_, _, v_x, before], [x, z, _, v_z]] = [pair[0], pair[1]];
        if z == 0.0 || v_z > before {
            hops.push([apex, x - start, v_x]);
            (start, apex) = (x, 0.0);
        }
        if z == 0.0 {
            break;
        }
        apex = apex.max(z);
    }
    hops
}

#[test]
fn apex_and_landing_are_the_parabolas() {
    for ball in BallModel::PRESETS {
        let track = flight(chip(&ball, 5.5, 45.0), 0.9);
        let apex = track.iter().map(|[_, z, _, _]| *z).fold(0.0, f32::max);
        let expected = (5.5 / 2.0_f32.sqrt()).powi(2) / (2.0 * G); // 0.77 m
        assert!((apex / expected - 1.0).abs() < 0.02, "apex {apex} m, not {expected} m");
        let landing = hops(&track)[0][1];
        let expected = 5.5 * 5.5 / G; // 3.08 m
        assert!((landing / expected - 1.0).abs() < 0.02, "landing {landing} m, not {expected} m");
    }
}

#[test]
fn hops_shrink_by_the_presets_ratios() {
    for ball in BallModel::PRESETS {
        let hops = hops(&flight(chip(&ball, 6.5, 45.0), 4.0));
        assert!(hops.len() >= 3, "{}: {hops:?}", ball.name);
        for (nth, pair) in hops.windows(2).enumerate() {
            let along = if nth == 0 { ball.first_hop_factor } else { ball.later_hop_factor };
            let [[before, _, v_before], [after, _, v_after]] = [pair[0], pair[1]];
            assert!((v_after / v_before - along).abs() < 0.01, "{} along: {pair:?}", ball.name);
            if after > 0.02 {
                let up = (after / before).sqrt();
                assert!(
                    (up - ball.vertical_restitution).abs() < 0.02,
                    "{} up: {pair:?}",
                    ball.name
                );
            }
        }
    }
}

#[test]
fn a_ball_rolls_after_its_hops() {
    let scene = chip(&BallModel::SSL_TIGERS, 4.0, 45.0);
    let row = scene.after(120);
    let rim = row[ball_column("spin_y")] * scene.config.ball.radius;
    assert_eq!(row[ball_column("z")], 0.0);
    assert!(rim > 0.5 && (row[ball_column("v_x")] - rim).abs() < 1e-3, "{row:?}");
}

/// A robot 1.2 m ahead of a kick along x.
fn over_a_robot(v_x: f32, v_z: f32) -> Scene {
    let poses = [[1.2, 0.0, 180.0]];
    let mut scene = Scene::at("over_a_robot", scenes::ssl(1, 0), &poses, Driver::STILL);
    scene.set_ball([0.0, 0.0], [v_x, 0.0]);
    scene.set_ball_column("v_z", v_z);
    scene
}

#[test]
fn a_chip_flies_over_a_robot_and_a_low_one_is_stopped() {
    let high = over_a_robot(3.0, 3.5).after(28);
    assert!(high[0] > 1.4 && high[ball_column("v_x")] > 2.0, "it flew over: {high:?}");
    assert_eq!(high[ball_column("last_touch")], -1.0);
    let low = over_a_robot(4.0, 1.0).after(28);
    assert!(low[0] < 1.2 && low[ball_column("v_x")] < 0.0, "it came back: {low:?}");
    assert_eq!(low[ball_column("last_touch")], 0.0);
}

#[test]
fn a_ball_that_clears_a_wall_of_a_table_leaves_it() {
    let mut scene = lone_ball(scenes::vss(0, 0), [0.5, 0.4], [0.0, 2.0]);
    scene.set_ball_column("z", 0.2);
    let farthest = |scene: &Scene| {
        let (rows, _) = scene.play(&mut scene.world(), 60);
        rows.chunks_exact(scene.config.row_size()).map(|row| row[1]).fold(0.0, f32::max)
    };
    let far = farthest(&scene);
    assert!(far > 0.7 && far < 0.95, "beyond the wall, before the fence: {far} m");
    scene.set_ball_column("z", 0.02);
    assert!(farthest(&scene) < 0.65, "a low one stays on the table");
}

#[test]
fn there_is_no_goal_above_the_bar() {
    let (mut under, mut over) = (0, 0);
    for shot in 0..60_u8 {
        let mut scene = lone_ball(scenes::ssl(0, 0), [3.0, 0.0], [6.0, 0.0]);
        scene.set_ball_column("v_z", f32::from(shot) * 0.06);
        let (rows, _) = scene.play(&mut scene.world(), 20);
        let crossed = rows
            .chunks_exact(scene.config.row_size())
            .find(|row| row[ball_column("crossed")] != 0.0);
        let Some(row) = crossed else { continue }; // the bar or a hop before the line stopped it
        let height = row[ball_column("crossed_z")];
        match crossing_name(row[ball_column("crossed")]) {
            "goal_right" => {
                under += 1;
                assert!(height + 0.043 <= 0.16 + 1e-3, "shot {shot} is in at {height} m");
            }
            "goal_line_right" => {
                over += 1;
                assert!(height >= 0.18 - 1e-3, "shot {shot} passed the bar at {height} m");
                let last = &rows[rows.len() - scene.config.row_size()..];
                let below = last[0] > 4.5 && last[0] < 4.68 && last[ball_column("z")] < 0.1;
                assert!(!below, "and is not in the goal afterwards");
            }
            other => panic!("shot {shot} crossed {other}"),
        }
    }
    assert!(under > 10 && over > 10, "{under} under, {over} over");
}

#[test]
fn a_ball_that_lands_on_a_robot_does_not_stay() {
    let poses = [[0.0, 0.0, 30.0]];
    for (x, v_x) in [(0.0, 0.0), (0.03, 0.0), (-0.4, 0.5), (0.0, 0.2)] {
        let mut scene = Scene::at("landing", scenes::ssl(1, 0), &poses, Driver::STILL);
        scene.set_ball([x, 0.01], [v_x, 0.0]);
        scene.set_ball_column("z", 1.0);
        let (rows, _) = scene.play(&mut scene.world(), 160);
        let size = scene.config.row_size();
        let last = &rows[rows.len() - size..];
        let touched = rows.chunks_exact(size).any(|row| row[ball_column("last_touch")] == 0.0);
        assert!(touched, "it met the robot");
        assert_eq!(last[ball_column("z")], 0.0, "it is down again: {last:?}");
        assert!(last[0].hypot(last[1]) > 0.09, "beside the robot: {last:?}");
    }
}

#[test]
fn a_chip_from_the_mouth_leaves_at_the_commanded_angle() {
    let scene = ball_in_mouth(&[0.0, 0.0, 0.0, 3.0, 3.0, 0.0]);
    let row = scene.after(4);
    assert!((row[ball_column("v_x")] / 3.0 - 1.0).abs() < 0.02, "{row:?}");
    assert!((row[ball_column("v_z")] - (3.0 - 0.1 * G)).abs() < 0.06, "{row:?}");
}

#[test]
fn a_robot_that_drives_into_a_hopping_ball_hits_it() {
    let poses = [[0.0, 0.0, 0.0]];
    let commands = vec![vec![3.0, 0.0, 0.0]];
    let mut scene = Scene::at("behind", scenes::ssl(1, 0), &poses, Driver::Constant(commands));
    scene.set_robot_column(0, "v_x", 3.0);
    scene.set_ball([0.12, 0.0], [0.0, 0.0]);
    scene.set_ball_column("v_z", 0.9);
    let row = scene.after(4);
    assert!(row[ball_column("v_x")] > 3.0, "it is pushed ahead: {row:?}");
    assert_eq!(row[ball_column("last_touch")], 0.0);
}

#[test]
fn a_hopping_ball_is_not_pushed_through_a_goals_side() {
    let (mut beside, mut hops) = (0, 0);
    for try_ in 0..60_u8 {
        let y = 0.52 + 0.0215 + 0.09 + 0.04;
        let poses = [[4.62, y, -90.0]];
        let commands = vec![vec![1.0, 0.0, 0.0]];
        let mut scene = Scene::at("press", scenes::ssl(1, 0), &poses, Driver::Constant(commands));
        scene.set_ball([4.62, 0.545], [0.0, 0.0]);
        scene.set_ball_column("v_z", 0.5 + f32::from(try_) * 0.01);
        let (rows, _) = scene.play(&mut scene.world(), 30);
        for row in rows.chunks_exact(scene.config.row_size()) {
            hops += u32::from(row[ball_column("z")] > 0.0);
            let inside = row[1] < 0.5 && row[0] > 4.5 && row[ball_column("z")] < 0.1;
            assert!(!inside, "try {try_} is in the goal: {row:?}");
        }
        beside += 1;
    }
    assert!(beside == 60 && hops > 60, "{beside} {hops}");
}
