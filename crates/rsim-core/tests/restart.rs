//! Restart of play: all bodies in a new state, in a world that keeps its own parameters.

use rsim_core::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS, parameters_size};
use rsim_core::scenes::{self, Scene};
use rsim_core::{Batch, EngineKind, PlaceError, SimConfig};

fn scene(engine: EngineKind) -> Scene {
    let mut scene = scenes::random_play();
    scene.config.engine = engine;
    scene
}

fn parameters(scene: &Scene) -> Vec<f32> {
    let count = parameters_size(scene.config.n_robots());
    (0..count).map(|nth| 0.8 + 0.4 * (nth as f32 / count as f32)).collect()
}

/// Steps with the commands of the scene.
fn play(scene: &Scene, batch: &mut Batch, rows: &mut [f32], steps: u64) {
    for step in 0..steps {
        let commands = scene.commands(rows, step, 0);
        batch.step(&commands, rows, None).expect("finite");
    }
}

#[test]
fn a_restarted_match_is_a_new_one_with_the_worlds_own_parameters() {
    for engine in EngineKind::ALL {
        let scene = scene(engine);
        let parameters = parameters(&scene);
        let (mut restarted, mut rows) = scene.batch(1, 1);
        for given in [Some(&parameters[..]), None] {
            restarted.place(&[true], &scene.start, given, &mut rows).expect("valid");
            play(&scene, &mut restarted, &mut rows, 60);
            let old = restarted.snapshot();
            restarted.restart(&[true], &scene.start, &mut rows).expect("valid");
            assert_ne!(restarted.snapshot(), old);
            let (mut new, mut expected) = scene.batch(1, 1);
            new.place(&[true], &scene.start, given, &mut expected).expect("valid");
            assert_eq!(restarted.snapshot(), new.snapshot());
            assert_eq!(rows, expected);
            play(&scene, &mut restarted, &mut rows, 60);
            play(&scene, &mut new, &mut expected, 60);
            assert_eq!(rows, expected);
        }
    }
}

#[test]
fn an_invalid_row_changes_no_world() {
    let scene = scene(EngineKind::Compact);
    let (mut batch, mut rows) = scene.batch(3, 1);
    let (before, kept) = (rows.clone(), batch.snapshot());
    let mut wrong = scene.start.clone();
    wrong[0] = 9.0;
    let starts = [scene.start.clone(), wrong].concat();
    let error = batch.restart(&[false, true, true], &starts, &mut rows).expect_err("outside");
    assert!(matches!(error, PlaceError::InWorld { world: 2, .. }), "{error}");
    assert_eq!(rows, before);
    assert_eq!(batch.snapshot(), kept);
}

#[test]
fn worlds_outside_the_mask_continue() {
    let scene = scene(EngineKind::Compact);
    let size = scene.config.row_size();
    let (mut batch, mut rows) = scene.batch(3, 1);
    let commands = scene.commands(&scene.start, 0, 0).repeat(3);
    batch.step(&commands, &mut rows, None).expect("finite");
    let before = rows.clone();
    batch.restart(&[false, true, false], &scene.start, &mut rows).expect("valid");
    assert_eq!(rows[..size], before[..size]);
    assert_eq!(rows[2 * size..], before[2 * size..]);
    assert_ne!(rows[size..2 * size], before[size..2 * size]);
}

#[test]
fn a_row_is_checked_with_the_worlds_own_heights() {
    // A ball above a robot of half the height.
    let config = SimConfig::ssl(1, 0);
    let mut scene = Scene::lined_up("low", config, scenes::Driver::STILL);
    scene.set_robot_column(0, "x", 0.0);
    scene.set_robot_column(0, "y", 0.0);
    let mut low = vec![1.0; parameters_size(1)];
    let height = ROBOT_PARAMETERS.iter().position(|name| *name == "height");
    low[BALL_PARAMETERS.len() + height.expect("a parameter")] = 0.5;
    scene.set_ball([1.0, 0.0], [0.0, 0.0]);
    let (mut batch, mut rows) = scene.batch(1, 1);
    let away = scene.start.clone();
    scene.set_ball([0.0, 0.0], [0.0, 0.0]);
    scene.set_ball_column("z", 0.1);
    batch.restart(&[true], &scene.start, &mut rows).expect_err("inside a robot");
    batch.place(&[true], &away, Some(&low), &mut rows).expect("valid");
    batch.restart(&[true], &scene.start, &mut rows).expect("above it");
}
