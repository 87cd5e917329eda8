//! Fast shots: none passes through a body, and none bounces off a body that it misses.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{ball_column, crossing_name};
use rsim_core::scenes::{self, Driver, Scene, lone_ball, uniform};
use rsim_core::{Field, SimConfig};

const SPEED: f32 = 10.0; // m/s: 50 mm a tick, more than the ball is wide
const SHOTS: u64 = 1000;

/// A shot from `from` at `to`.
fn shoot(scene: &mut Scene, from: [f32; 2], to: [f32; 2]) {
    let way = [to[0] - from[0], to[1] - from[1]];
    let length = way[0].hypot(way[1]);
    scene.set_ball(from, way.map(|part| part / length * SPEED));
}

fn rows(scene: &Scene, steps: u64) -> Vec<Vec<f32>> {
    let (rows, _) = scene.play(&mut scene.world(), steps);
    rows.chunks_exact(scene.config.row_size()).map(<[f32]>::to_vec).collect()
}

#[test]
fn no_shot_passes_a_wall() {
    for (config, reach) in [
        (scenes::vss(0, 0), [0.85, 0.65]),
        (scenes::ssl(0, 0), [4.8, 3.3]),
        (SimConfig { field: Field::SSL_A, ..scenes::ssl(0, 0) }, [6.6, 4.8]),
    ] {
        let half = [config.field.half_length(), config.field.half_width()];
        for shot in 0..SHOTS {
            let mut scene = lone_ball(config.clone(), [0.0, 0.0], [0.0, 0.0]);
            let draw = |nth: u64| uniform(shot + nth * 5000);
            let from = [draw(0) * half[0] * 0.8, draw(1) * half[1] * 0.8];
            shoot(&mut scene, from, [draw(2) * 2.0 * half[0], draw(3) * 2.0 * half[1]]);
            for row in rows(&scene, 24) {
                let inside = row[0].abs() < reach[0] && row[1].abs() < reach[1];
                assert!(inside, "{} shot {shot} is at {:?}", scene.config.field.name, &row[..2]);
            }
        }
    }
}

#[test]
fn no_shot_passes_the_sides_and_the_back_of_a_goal() {
    let mut kept_out = 0;
    let mut goals = 0;
    for shot in 0..SHOTS {
        let mut scene = lone_ball(scenes::ssl(0, 0), [0.0, 0.0], [0.0, 0.0]);
        let draw = |nth: u64| uniform(shot + nth * 5000);
        // Half at the 20 mm side from beside the goal, half through the mouth at the back.
        let beside = shot % 2 == 0;
        if beside {
            let from = [4.65 + 0.1 * draw(0), 0.9 + 0.3 * draw(1)];
            shoot(&mut scene, from, [4.62 + 0.1 * draw(2), 0.0]);
        } else {
            shoot(&mut scene, [3.5 + draw(0), 0.4 * draw(1)], [4.7, 0.48 * draw(2)]);
        }
        // Later a shot from the side may come round the post, which is correct.
        let rows = rows(&scene, if beside { 4 } else { 12 });
        for row in &rows {
            let in_goal = row[0] > 4.52 && row[1].abs() < 0.5;
            assert!(!(beside && in_goal), "shot {shot} went in from the side");
            assert!(row[0] < 4.68 || row[1].abs() > 0.5, "shot {shot} passed the back");
            let in_side = row[0] > 4.52 && (row[1].abs() - 0.51).abs() < 0.009;
            assert!(!in_side, "shot {shot} is in the goal's side at {:?}", &row[..2]);
        }
        kept_out += u32::from(beside);
        let name = |row: &Vec<f32>| crossing_name(row[ball_column("crossed")]);
        goals += u32::from(!beside && rows.iter().any(|row| name(row) == "goal_right"));
    }
    assert!(kept_out == 500 && goals > 450, "{kept_out} kept out, {goals} goals");
}

#[test]
fn no_shot_passes_a_robot() {
    for (config, half) in [(scenes::vss(1, 0), 0.0375), (scenes::ssl(1, 0), 0.0715)] {
        let mut stopped = 0;
        for shot in 0..SHOTS {
            let degrees = 180.0 * uniform(shot + 77);
            let mut scene = Scene::at("at", config.clone(), &[[0.0, 0.0, degrees]], Driver::STILL);
            let draw = |nth: u64| uniform(shot + nth * 5000);
            let from = [-0.4 + 0.1 * draw(0), 0.3 * draw(1)];
            shoot(&mut scene, from, [0.0, 0.8 * half * draw(2)]);
            let direction = [-from[0], -from[1]];
            // Undisturbed it would be half a meter behind the robot after 0.1 s.
            let last = rows(&scene, 4).pop().expect("a row");
            let behind = last[0] * direction[0] + last[1] * direction[1];
            let moving = last[ball_column("v_x")].hypot(last[ball_column("v_x") + 1]);
            assert!(!(behind > 0.1 && moving > 0.95 * SPEED), "shot {shot} passed: {last:?}");
            stopped += u32::from(last[ball_column("last_touch")] == 0.0);
        }
        assert_eq!(stopped, 1000, "every shot touched the robot");
    }
}

#[test]
fn no_shot_bounces_off_a_body_that_it_misses() {
    // Past a robot in every direction, and past the front of a goal's side, by 2 to 10 mm.
    for (config, clear) in [(scenes::vss(1, 0), 0.0375 * 1.4143), (scenes::ssl(1, 0), 0.09)] {
        for shot in 0..SHOTS {
            let draw = |nth: u64| uniform(shot + nth * 5000);
            let poses = [[0.0, 0.0, 180.0 * draw(0)]];
            let mut scene = Scene::at("near", config.clone(), &poses, Driver::STILL);
            let (sin, cos) = (3.1 * draw(1)).sin_cos();
            let gap = 0.006 + 0.004 * draw(2);
            let side = (clear + config.ball.radius + gap) * if shot % 2 == 0 { 1.0 } else { -1.0 };
            let before = 0.35 + 0.05 * draw(3);
            let from = [-cos * before - sin * side, -sin * before + cos * side];
            scene.set_ball(from, [cos * SPEED, sin * SPEED]);
            for row in rows(&scene, 2) {
                let aside = row[1] * cos - row[0] * sin;
                assert!((aside - side).abs() < 1e-5, "shot {shot} was bent: {row:?}");
                assert_eq!(row[ball_column("last_touch")], -1.0, "shot {shot} touched");
            }
        }
    }
    for shot in 0..SHOTS {
        let mut scene = lone_ball(scenes::ssl(0, 0), [0.0, 0.0], [0.0, 0.0]);
        let draw = |nth: u64| uniform(shot + nth * 5000);
        // Out of a goal, past the front of its side.
        let angle = 1.9 + 0.3 * draw(0);
        let (sin, cos) = (angle.sin(), angle.cos());
        let gap = config_radius() + 0.006 + 0.004 * draw(1);
        let post = [4.5 - gap * sin, 0.5 + gap * cos];
        let before = 0.25 + 0.025 * draw(2);
        scene
            .set_ball([post[0] - cos * before, post[1] - sin * before], [cos * SPEED, sin * SPEED]);
        for row in rows(&scene, 2) {
            let aside = (row[1] - post[1]) * cos - (row[0] - post[0]) * sin;
            assert!(aside.abs() < 1e-5, "shot {shot} was bent by the post: {row:?}");
        }
    }
}

fn config_radius() -> f32 {
    scenes::ssl(0, 0).ball.radius
}

#[test]
fn an_oblique_shot_bounces_off_a_round_robot_by_coulombs_law() {
    let mut config = scenes::ssl(1, 0);
    (config.ball.sliding_deceleration, config.ball.rolling_deceleration) = (0.0, 0.0);
    for shot in 0..200 {
        let draw = |nth: u64| uniform(shot + nth * 5000);
        let speed = 6.0 + 4.0 * draw(0);
        // At the back of a robot, off its middle by up to 80% of where it would pass.
        let reach = 0.09 + config.ball.radius;
        let aside = 0.8 * reach * draw(1);
        let mut scene = Scene::at("oblique", config.clone(), &[[0.0, 0.0, 0.0]], Driver::STILL);
        scene.config.time_step = scene.config.tick;
        let before = (reach * reach - aside * aside).sqrt() + 0.03 + 0.025 * (1.0 + draw(2));
        scene.set_ball([-before, aside], [speed, 0.0]);
        let rows = rows(&scene, 8);
        let after = rows.iter().find(|row| row[ball_column("last_touch")] == 0.0);
        let row = after.expect("it hit the robot");
        let along_x = -(reach * reach - aside * aside).sqrt();
        let normal = [along_x / reach, aside / reach];
        let tangent = [-normal[1], normal[0]];
        let (closing, along) = (-speed * normal[0], speed * tangent[0]);
        let (ball, robot) = (&config.ball, &config.blue[0]);
        let yields = 1.0 / (1.0 / ball.mass + 1.0 / robot.mass);
        let pressing = (1.0 + ball.robot_restitution) * closing * yields;
        let inertia = robot.mass * 0.09 * 0.09 / 2.0;
        let slip = 3.5 / ball.mass + 1.0 / robot.mass + 0.09 * 0.09 / inertia;
        let friction = (along.abs() / slip).min(ball.robot_friction * pressing);
        let back = -closing + pressing / ball.mass;
        let left = along - friction.copysign(along) / ball.mass;
        let expected = [0, 1].map(|axis| normal[axis] * back + tangent[axis] * left);
        let v_x = ball_column("v_x");
        let error = (row[v_x] - expected[0]).hypot(row[v_x + 1] - expected[1]);
        assert!(error < 0.05 * speed, "shot {shot}: {:?}, not {expected:?}", &row[v_x..v_x + 2]);
    }
}

#[test]
fn corner_blocks_deflect_the_ball_round_the_corner() {
    // Along the side wall into the corner: a right wall would send it straight back.
    let row = lone_ball(scenes::vss(0, 0), [0.4, 0.62], [2.0, 0.0]).after(12);
    assert!(row[ball_column("v_y")] < -0.2, "it leaves the corner inward: {row:?}");
}
