//! Ticks without contacts go without the contact solver, which changes rounding only.

use rsim_core::columns::{BALL_COLUMNS, ball_column};
use rsim_core::scenes::{self, Driver, Scene, uniform};
use rsim_core::{Field, SimConfig, World};

/// Scenes with and without contacts, in both leagues.
fn all() -> Vec<Scene> {
    let ssl_a = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
    vec![
        scenes::random_play(),
        scenes::chase(),
        scenes::ssl_random(scenes::ssl(1, 1)),
        scenes::ssl_random(scenes::ssl(6, 6)),
        scenes::ssl_random(ssl_a),
        scenes::ssl_chase(scenes::ssl(6, 6)),
    ]
}

/// Maximum difference of two rows, with spins as surface speeds.
fn difference(a: &[f32], b: &[f32]) -> f32 {
    let spin = ball_column("spin_x")..=ball_column("spin_z");
    let pairs = a.iter().zip(b).enumerate();
    let scaled = pairs.map(|(column, (a, b))| {
        let scale =
            if column < BALL_COLUMNS.len() && spin.contains(&column) { 0.0215 } else { 1.0 };
        (a - b).abs() * scale
    });
    scaled.fold(0.0, f32::max)
}

/// Steps a world into `row`, and a copy of it that always uses the solver. Returns their difference.
fn step_both(world: &mut World, commands: &[f32], row: &mut [f32]) -> f32 {
    let (mut solved, mut other) = (world.clone(), row.to_vec());
    solved.disable_contact_free_ticks();
    solved.step(commands).expect("finite");
    world.step(commands).expect("finite");
    solved.write_row(&mut other);
    world.write_row(row);
    difference(row, &other)
}

/// Difference by rounding.
const ROUNDING: f32 = 2e-5;

/// Maximum number of ticks, of 2,000, with a larger difference: the solver predicts along straight lines
/// and stops corners that pass each other very closely.
const CORNERS: usize = 2;

#[test]
fn a_tick_without_the_solver_differs_by_rounding_only() {
    for mut scene in all() {
        scene.config.time_step = scene.config.tick;
        let mut world = scene.world();
        let mut row = scene.start.clone();
        let differing: Vec<_> = (0..2000)
            .map(|step| {
                let commands = scene.commands(&row, step / 5, 5);
                (step, step_both(&mut world, &commands, &mut row))
            })
            .filter(|(_, error)| *error > ROUNDING)
            .collect();
        assert!(differing.len() <= CORNERS, "{}: {differing:?}", scene.name);
        let free = world.contact_free_ticks();
        assert!((10..1990).contains(&free), "{}: {free} ticks without the solver", scene.name);
    }
}

#[test]
fn a_fast_ball_grazes_with_and_without_the_solver() {
    const SPEED: f32 = 19.0; // nearly as fast as a ball may be
    let mut grazed = 0;
    for shot in 0..2000_u64 {
        let draw = |nth: u64| f32::midpoint(1.0, uniform(shot + nth * 5000)); // from 0 to 1
        let mut scene = Scene::lined_up("graze", scenes::ssl(1, 0), Driver::STILL);
        scene.config.time_step = scene.config.tick;
        let heading = std::f32::consts::TAU * draw(0);
        for (name, value) in
            [("x", 0.0), ("y", 0.0), ("cos", heading.cos()), ("sin", heading.sin())]
        {
            scene.set_robot_column(0, name, value);
        }
        // From 1 mm past the disc to just past its flat front.
        let aside = 0.1125 - 0.021 * draw(1);
        scene.set_ball([-0.3 - SPEED * scene.config.tick * draw(2), aside], [SPEED, 0.0]);
        let mut world = scene.world();
        let mut row = scene.start.clone();
        for step in 0..14 {
            let commands = scene.commands(&row, step, 0);
            let error = step_both(&mut world, &commands, &mut row);
            assert!(error < ROUNDING, "shot {shot} tick {step}: {error}");
        }
        let turned = (row[ball_column("v_y")] / row[ball_column("v_x")]).abs();
        grazed += u32::from((1e-3..0.2).contains(&turned));
    }
    assert!(grazed > 50, "only {grazed} shots grazed");
}

#[test]
fn a_whole_scene_without_contacts_differs_by_rounding_only() {
    let scene = scenes::lone_omni(&[1.0, 0.4, 3.0]);
    let mut solved = scene.world();
    solved.disable_contact_free_ticks();
    let (rows, contacts) = scene.play(&mut scene.world(), 80);
    let (other, _) = scene.play(&mut solved, 80);
    assert_eq!(contacts, 0);
    let error = difference(
        &rows[rows.len() - scene.config.row_size()..],
        &other[other.len() - scene.config.row_size()..],
    );
    assert!(error < 1e-4, "{error}");
}
