//! Records of a control step in a row: touches, collisions, crossed lines.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{ball_column, crossing_name, robot_column};
use rsim_core::scenes::{self, Driver, Scene, lone_ball, robots};

fn column(row: &[f32], robot: usize, name: &str) -> f32 {
    robots(row).nth(robot).expect("a robot")[robot_column(name)]
}

#[test]
fn a_touch_is_recorded_in_its_step_and_the_last_touch_is_kept() {
    let poses = [[0.5, 0.0, 180.0], [-0.5, 0.0, 0.0]];
    let mut scene = Scene::at("touches", scenes::ssl(1, 1), &poses, Driver::STILL);
    scene.set_ball([0.2, 0.0], [3.0, 0.0]);
    let (rows, _) = scene.play(&mut scene.world(), 40);
    let rows: Vec<&[f32]> = rows.chunks_exact(scene.config.row_size()).collect();
    let touches = |robot: usize| {
        let steps = rows.iter().enumerate();
        let touched = steps.filter(|(_, row)| column(row, robot, "touched_ball") == 1.0);
        touched.map(|(step, _)| step).collect::<Vec<_>>()
    };
    let (blue, yellow) = (touches(0), touches(1));
    assert!(!blue.is_empty() && !yellow.is_empty(), "it went from one to the other");
    assert!(blue[0] < yellow[0]);
    let last = |step: usize| rows[step][ball_column("last_touch")];
    assert_eq!(last(blue[0] - 1), -1.0);
    assert_eq!(last(blue[0]), 0.0);
    assert_eq!(last(yellow[0] - 1), 0.0);
    assert_eq!(last(yellow[0]), 1.0);
}

#[test]
fn the_collision_speed_is_the_closing_speed() {
    // Blue 0 meets yellow 0 head on; blue 1 runs into blue 2.
    let config = scenes::ssl(3, 1);
    let poses = [[-0.5, 0.0, 0.0], [-0.5, 1.0, 0.0], [0.2, 1.0, 0.0], [0.5, 0.0, 180.0]];
    let commands = [2.0, 1.0, 0.0, 1.0].map(|forward| vec![forward, 0.0, 0.0]).to_vec();
    let mut scene = Scene::at("crash", config, &poses, Driver::Constant(commands));
    scene.set_ball([0.0, -2.0], [0.0, 0.0]);
    let (rows, _) = scene.play(&mut scene.world(), 60);
    let rows: Vec<&[f32]> = rows.chunks_exact(scene.config.row_size()).collect();
    let worst = |robot: usize| {
        rows.iter().map(|row| column(row, robot, "collision_speed")).fold(0.0, f32::max)
    };
    let touched_opponent =
        |robot: usize| rows.iter().any(|row| column(row, robot, "touched_opponent") == 1.0);
    assert!((worst(0) - 3.0).abs() < 0.1, "2 and 1 m/s: {}", worst(0));
    assert_eq!(worst(0), worst(3));
    assert!((worst(1) - 1.0).abs() < 0.05, "1 m/s into a teammate: {}", worst(1));
    assert!(
        touched_opponent(0) && touched_opponent(3) && !touched_opponent(1) && !touched_opponent(2)
    );
}

#[test]
fn crossings_have_line_point_and_height() {
    for (from, velocity, line, at) in [
        ([4.0, 0.2], [4.0, 0.0], "goal_right", [4.5, 0.2]),
        ([-4.0, 0.2], [-4.0, 0.0], "goal_left", [-4.5, 0.2]),
        ([4.0, 1.2], [4.0, 0.0], "goal_line_right", [4.5, 1.2]),
        ([-4.0, 1.2], [-4.0, 0.0], "goal_line_left", [-4.5, 1.2]),
        ([1.0, 2.5], [0.0, 4.0], "touch_line_left", [1.0, 3.0]),
        ([1.0, -2.5], [0.0, -4.0], "touch_line_right", [1.0, -3.0]),
    ] {
        let scene = lone_ball(scenes::ssl(0, 0), from, velocity);
        let (rows, _) = scene.play(&mut scene.world(), 12);
        let crossed: Vec<&[f32]> = rows
            .chunks_exact(scene.config.row_size())
            .filter(|row| row[ball_column("crossed")] != 0.0)
            .collect();
        assert_eq!(crossed.len(), 1, "{line}: recorded in one step only");
        assert_eq!(crossing_name(crossed[0][ball_column("crossed")]), line);
        let crossed_x = ball_column("crossed_x");
        let [x, y, z] = [0, 1, 2].map(|part| crossed[0][crossed_x + part]);
        assert!(
            (x - at[0]).abs() < 1e-3 && (y - at[1]).abs() < 1e-3 && z == 0.0,
            "{line}: {x} {y}"
        );
    }
}
