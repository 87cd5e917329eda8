//! Equal starts and commands give equal bytes, whatever the threads, the other worlds and the history.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::Batch;
use rsim_core::scenes::{self, Scene};

/// Steps a batch whose worlds have different commands. Returns all rows of all steps.
fn advance(scene: &Scene, batch: &mut Batch, steps: std::ops::Range<u64>) -> Vec<f32> {
    let size = scene.config.row_size();
    let mut rows = vec![0.0; batch.worlds() * size];
    batch.read(&mut rows);
    let mut all_rows = Vec::new();
    for step in steps {
        let each = rows.chunks_exact(size).enumerate();
        let commands: Vec<f32> =
            each.flat_map(|(world, row)| scene.commands(row, step, world as u64 * 7919)).collect();
        batch.step(&commands, &mut rows, None).expect("finite");
        all_rows.extend_from_slice(&rows);
    }
    all_rows
}

fn run(scene: &Scene, worlds: usize, threads: usize, steps: u64) -> Vec<f32> {
    advance(scene, &mut scene.batch(worlds, threads).0, 0..steps)
}

#[test]
fn thread_count_does_not_change_results() {
    let ssl = scenes::ssl_random(scenes::ssl(3, 2));
    for scene in [scenes::random_play(), scenes::crowded_kickoff(), ssl] {
        let expected = run(&scene, 12, 1, 200);
        for threads in [2, 3, 8] {
            assert!(
                run(&scene, 12, threads, 200) == expected,
                "{} on {threads} threads",
                scene.name
            );
        }
    }
}

#[test]
fn a_world_in_a_batch_equals_a_single_world() {
    let scene = scenes::random_play();
    let (worlds, size) = (5, scene.config.row_size());
    let together = run(&scene, worlds, 1, 150);
    for world in 0..worlds {
        let mut single = scene.world();
        let mut row = scene.start.clone();
        for step in 0..150_u64 {
            single.step(&scene.commands(&row, step, world as u64 * 7919)).expect("finite");
            single.write_row(&mut row);
            let at = (usize::try_from(step).expect("small") * worlds + world) * size;
            assert!(together[at..at + size] == row, "world {world}, step {step}");
        }
    }
}

#[test]
fn a_placed_world_keeps_nothing_of_its_past() {
    let ssl = scenes::ssl_random(scenes::ssl(3, 2));
    for (scene, past) in [(scenes::crowded_kickoff(), scenes::chase()), (ssl.clone(), ssl)] {
        let (fresh, contacts) = scene.play(&mut scene.world(), 300);
        assert!(contacts > 0, "only {contacts} contacts: the comparison would prove little");
        let mut used = past.world();
        past.play(&mut used, 137);
        used.place(&scene.start, None).expect("valid");
        assert!(scene.play(&mut used, 300).0 == fresh, "{}", scene.name);
    }
}

#[test]
fn a_restored_world_continues_as_if_never_stopped() {
    for scene in [scenes::crowded_kickoff(), scenes::ssl_random(scenes::ssl(3, 2))] {
        // Right after placing, and at several moments within the play.
        for before in [0, 1, 5, 40, 111] {
            let (mut batch, _) = scene.batch(2, 1);
            advance(&scene, &mut batch, 0..before);
            let bytes = batch.snapshot();
            let expected = advance(&scene, &mut batch, before..before + 120);
            let mut other = Batch::new(&scene.config, 2, 1).expect("valid");
            other.restore(&bytes).expect("its own snapshot");
            let restored = advance(&scene, &mut other, before..before + 120);
            assert!(restored == expected, "{}: snapshot after {before} steps", scene.name);
        }
    }
}

#[test]
fn inactive_worlds_stand_still_and_their_rows_stay() {
    let scene = scenes::chase();
    let (mut batch, mut rows) = scene.batch(3, 2);
    let before = rows.clone();
    let commands: Vec<f32> = rows
        .chunks_exact(scene.config.row_size())
        .flat_map(|row| scene.commands(row, 0, 0))
        .collect();
    batch.step(&commands, &mut rows, Some(&[true, false, true])).expect("finite");
    let size = scene.config.row_size();
    assert_ne!(rows[..size], before[..size], "an active world moves");
    assert_eq!(rows[size..2 * size], before[size..2 * size]);
    let mut read = vec![0.0; rows.len()];
    batch.read(&mut read);
    assert_eq!(read, rows, "reading is what the step wrote");
}
