//! Turn a scene half round, or reflect it: its future turns or reflects with it.

use rsim_core::SimConfig;
use rsim_core::columns::crossing_name;
use rsim_core::scenes::{self, Driver, Scene, robots, robots_mut};

/// Negates positions, velocities and headings of ball and robots, and swaps the teams.
fn half_turn(row: &[f32]) -> Vec<f32> {
    let mut turned: Vec<f32> = row.iter().map(|value| -value).collect();
    assert_eq!(crossing_name(row[4]), "none", "goals would change sides");
    let teams: Vec<Vec<f32>> = robots(row).map(<[f32]>::to_vec).collect();
    for (index, columns) in robots_mut(&mut turned).enumerate() {
        let other = &teams[(index + 3) % 6];
        for (column, value) in columns.iter_mut().enumerate() {
            *value = if column == 6 { other[6] } else { -other[column] };
        }
    }
    turned
}

fn worst(a: &[f32], b: &[f32]) -> f32 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn a_half_turn_with_teams_swapped_turns_the_match() {
    let mut scene = scenes::random_play();
    scene.driver = Driver::Constant([20.0, 17.0]);
    scene.set_ball([0.05, 0.1], [-0.4, 0.3]);
    let turned = Scene { start: half_turn(&scene.start), ..scene.clone() };
    let (rows, contacts) = scene.play(&mut scene.world(), 12);
    let (turned_rows, _) = turned.play(&mut turned.world(), 12);
    assert_eq!(contacts, 0, "this part is about free motion");
    let size = scene.config.row_size();
    for (row, turned_row) in rows.chunks_exact(size).zip(turned_rows.chunks_exact(size)) {
        assert_eq!(half_turn(row), turned_row, "free motion turns exactly");
    }
}

#[test]
fn one_contact_turns_to_a_tenth_of_a_millimetre() {
    let config = SimConfig::VSS_3V3;
    let poses = [
        [-0.3, 0.02, 0.0],
        [-0.6, 0.4, 0.0],
        [-0.6, -0.4, 0.0],
        [0.6, 0.0, 180.0],
        [0.6, 0.4, 180.0],
        [0.6, -0.4, 180.0],
    ];
    let mut scene = Scene::at("one_contact", config, &poses, Driver::Constant([0.0, 0.0]));
    scene.set_ball([0.0, 0.0], [-1.0, 0.0]);
    let turned = Scene { start: half_turn(&scene.start), ..scene.clone() };
    let (rows, contacts) = scene.play(&mut scene.world(), 14);
    let (turned_rows, _) = turned.play(&mut turned.world(), 14);
    let size = scene.config.row_size();
    let (last, turned_last) = (&rows[rows.len() - size..], &turned_rows[rows.len() - size..]);
    assert!(contacts > 0 || last[2] > 0.0, "the ball met the robot");
    assert!(last[2] > 0.0, "and came back");
    let error = worst(&half_turn(last), turned_last);
    assert!(error < 1e-4, "off by {error}");
}
