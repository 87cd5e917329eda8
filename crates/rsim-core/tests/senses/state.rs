//! Senses as state: off is off, the same bytes in every way, saved and restored.

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, robot_column, row_size};
use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{Sensing, SimConfig};

use super::{begin, keys};

/// All senses on, also those that no preset has.
fn all() -> Sensing {
    Sensing {
        delay_jitter: 0.003,
        frame_loss: 0.05,
        misread_headings: 0.01,
        missing_robots: 0.02,
        camera_offset_error: 0.01,
        feedback_delay: 0.01,
        beam_misses: 0.05,
        beam_false_alarms: 0.02,
        odometry: 1.0,
        odometry_noise: 0.02,
        gyroscope_noise: 0.02,
        gyroscope_error: 0.05,
        command_delay: 0.012,
        command_jitter: 0.004,
        wheel_error: 0.02,
        wheel_dead_zone: 0.02,
        kick_speed_noise: 0.05,
        kick_direction_noise: 0.02,
        kick_failures: 0.05,
        dribbler_failures: 0.05,
        battery_sag: 0.01,
        ..Sensing::RC2021
    }
}

fn scenes() -> [Scene; 2] {
    [scenes::chase(), scenes::ssl_chase(scenes::ssl(3, 3))]
}

/// Steps a batch, and returns true and sensed rows.
fn step(batch: &mut rsim_core::Batch, scene: &Scene, rows: &mut [f32], nth: u64) -> Vec<f32> {
    step_some(batch, scene, rows, nth, None)
}

/// The same of the active worlds.
fn step_some(
    batch: &mut rsim_core::Batch,
    scene: &Scene,
    rows: &mut [f32],
    nth: u64,
    active: Option<&[bool]>,
) -> Vec<f32> {
    let size = scene.config.row_size();
    let commands: Vec<f32> =
        rows.chunks_exact(size).flat_map(|row| scene.commands(row, nth, 3)).collect();
    let [mut at_once, mut known] = [(); 2].map(|()| vec![0.0; rows.len()]);
    batch.step_and_sense(&commands, rows, Some(&mut at_once), active).expect("finite");
    batch.sense(&mut known, None);
    for (world, (one, other)) in at_once.chunks(size).zip(known.chunks(size)).enumerate() {
        let stepped = active.is_none_or(|active| active[world]);
        assert!(if stepped { one == other } else { one.iter().all(|value| *value == 0.0) });
    }
    known
}

#[test]
fn robots_without_senses_know_the_truth() {
    let scene = scenes::chase();
    let (mut batch, mut rows) = scene.batch(2, 1);
    for nth in 0..20 {
        let known = step(&mut batch, &scene, &mut rows, nth);
        assert_eq!(known, rows);
    }
}

#[test]
fn exact_senses_change_no_bit_of_the_physics_and_know_all_motion() {
    for scene in scenes() {
        let (mut plain, mut rows) = scene.batch(2, 1);
        let (mut sensing, mut same) = begin(&scene, Sensing::OFF, 2);
        for nth in 0..100 {
            step(&mut plain, &scene, &mut rows, nth);
            let known = step(&mut sensing, &scene, &mut same, nth);
            assert_eq!(rows, same);
            let each = rows.chunks_exact(rows.len() / 2).zip(known.chunks_exact(rows.len() / 2));
            for (truth, known) in each {
                assert_eq!(truth[..9], known[..9], "the ball");
                let robots = truth[BALL_COLUMNS.len()..].chunks_exact(ROBOT_COLUMNS.len());
                let known = known[BALL_COLUMNS.len()..].chunks_exact(ROBOT_COLUMNS.len());
                for (truth, known) in robots.zip(known) {
                    assert_eq!(truth[..8], known[..8], "motion and beam");
                }
            }
        }
    }
}

#[test]
fn a_world_senses_the_same_whatever_batch_and_threads() {
    for (scene, threads) in scenes().into_iter().flat_map(|scene| [(scene.clone(), 1), (scene, 2)])
    {
        let mut scene = scene;
        scene.config.sensing = Some(Sensing { own_cameras: 1.0, ..all() });
        let worlds = 40;
        let (mut batch, mut rows) = scene.batch(worlds, threads);
        batch.begin_senses(&vec![true; worlds], &keys(worlds), None).expect("valid");
        let (mut single, mut row) = scene.batch(1, 1);
        single.begin_senses(&[true], &keys(worlds)[17..18], None).expect("valid");
        let mut differ = false;
        for nth in 0..120 {
            // Its neighbors rest now and then.
            let active: Vec<bool> =
                (0..worlds as u64).map(|world| world == 17 || (world + nth) % 3 > 0).collect();
            let known = step_some(&mut batch, &scene, &mut rows, nth, Some(&active));
            let alone = step(&mut single, &scene, &mut row, nth);
            let size = row.len();
            assert_eq!(known[17 * size..18 * size], alone);
            assert_eq!(rows[17 * size..18 * size], row);
            differ |= known[..size] != alone[..];
        }
        assert!(differ, "other keys have other errors");
    }
}

#[test]
fn snapshots_hold_all_that_is_on_its_way() {
    for scene in scenes() {
        let (mut batch, mut rows) = begin(&scene, all(), 3);
        for nth in 0..53 {
            step(&mut batch, &scene, &mut rows, nth);
        }
        let (saved, start) = (batch.snapshot(), rows.clone());
        let futures: Vec<Vec<f32>> =
            (53..100).map(|nth| step(&mut batch, &scene, &mut rows, nth)).collect();
        let (mut again, _) = begin(&scene, all(), 3);
        again.restore(&saved).expect("its own");
        let (mut other, _) = begin(&scene, all(), 3);
        other.restore(&saved).expect("its own");
        let mut rows = start;
        let mut detected = 0;
        for (nth, future) in (53..100).zip(futures) {
            // A snapshot holds the frames that have arrived, too.
            again.restore(&other.snapshot()).expect("its own");
            let frames = other.camera_frames(1);
            detected += frames.iter().map(|frame| frame.robots.len()).sum::<usize>();
            assert_eq!(again.camera_frames(1), frames);
            assert_eq!(step(&mut other, &scene, &mut rows, nth), future);
        }
        assert!(detected > 20, "{detected}");
    }
}

#[test]
fn a_new_match_has_nothing_of_the_old_one() {
    let scene = scenes::chase();
    let (mut batch, start) = begin(&scene, all(), 1);
    let mut first = start.clone();
    let expected: Vec<Vec<f32>> =
        (0..30).map(|nth| step(&mut batch, &scene, &mut first, nth)).collect();
    let mut rows = vec![0.0; start.len()];
    batch.place(&[true], &scene.start, scene.parameters.as_deref(), &mut rows).expect("valid");
    batch.begin_senses(&[true], &keys(1), None).expect("valid");
    for (nth, expected) in (0..30).zip(expected) {
        assert_eq!(step(&mut batch, &scene, &mut rows, nth), expected);
    }
}

#[test]
fn a_restart_is_seen_at_once() {
    let scene = scenes::chase();
    let sensing = Sensing { delay: 0.5, ..all() };
    let (mut batch, mut rows) = begin(&scene, sensing, 1);
    for nth in 0..40 {
        step(&mut batch, &scene, &mut rows, nth);
    }
    let mut ball = rows[..BALL_COLUMNS.len()].to_vec();
    (ball[0], ball[1]) = (0.6, 0.55);
    batch.reposition_balls(&[true], &ball, &mut rows).expect("free");
    let mut known = rows.clone();
    batch.sense(&mut known, None);
    assert!((known[0] - 0.6).hypot(known[1] - 0.55) < 0.1, "{} {}", known[0], known[1]);
}

#[test]
fn each_world_can_have_numbers_of_its_own() {
    let mut scene = Scene::lined_up("still", scenes::vss(1, 0), Driver::STILL);
    scene.config.sensing = Some(Sensing::OFF);
    let (mut batch, mut rows) = scene.batch(2, 1);
    let own = Sensing { ball_position_noise: 0.05, ..Sensing::OFF }.values();
    let numbers = [Sensing::OFF.values(), own].concat();
    batch.begin_senses(&[true, true], &keys(2), Some(&numbers)).expect("in range");
    let known = step(&mut batch, &scene, &mut rows, 0);
    let size = scene.config.row_size();
    assert_eq!(known[0].to_bits(), rows[0].to_bits());
    assert_ne!(known[size].to_bits(), rows[size].to_bits());
    let wrong = [Sensing::OFF.values(), vec![-1.0; own_len()]].concat();
    let error = batch.begin_senses(&[true, true], &keys(2), Some(&wrong)).expect_err("negative");
    assert!(error.to_string().contains("sensing."), "{error}");
}

fn own_len() -> usize {
    Sensing::numbers().len()
}

#[test]
fn absent_robots_are_not_seen_and_known_to_be_absent() {
    let config = SimConfig { sensing: Some(all()), ..scenes::ssl(2, 2) };
    let mut scene = Scene::lined_up("still", config, Driver::STILL);
    scene.set_robot_column(1, "absent", 1.0);
    let (mut batch, mut rows) = scene.batch(1, 1);
    let known = step(&mut batch, &scene, &mut rows, 0);
    let absent = rsim_core::columns::row_size(1)..rsim_core::columns::row_size(2);
    assert_eq!(known[absent.clone()], rows[absent], "it rests where absent robots do");
}

#[test]
fn headings_have_length_1() {
    let presets = [Sensing::VSSS, all(), Sensing { heading_noise: 0.5, ..all() }];
    for (scene, preset) in scenes().into_iter().cycle().zip(presets) {
        let (mut batch, mut rows) = begin(&scene, preset, 10);
        let mut turned = 0.0_f32;
        for nth in 0..200 {
            let known = step(&mut batch, &scene, &mut rows, nth);
            for row in known.chunks_exact(scene.config.row_size()) {
                for robot in scenes::robots(row) {
                    assert!((robot[2].hypot(robot[3]) - 1.0).abs() < 1e-3, "{robot:?}");
                    turned = turned.max(robot[6].abs());
                }
            }
        }
        assert!(turned > 5.0, "{turned}");
    }
}

#[test]
fn robots_that_leave_and_come_back_obey_the_commands_on_their_way_as_others_do() {
    // Commands arrive two ticks after a step began: until then the last ones count.
    let sensing = Sensing { command_delay: 0.01, ..Sensing::OFF };
    let drive = vec![1.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let poses = [[-2.0, -1.0, 0.0], [-2.0, 1.0, 0.0]];
    let driver = Driver::Constant(vec![drive; 2]);
    let scene = Scene::at("drive", scenes::ssl(2, 0), &poses, driver);
    let (mut batch, mut rows) = begin(&scene, sensing, 1);
    let column =
        |rows: &[f32], robot: usize, name: &str| rows[row_size(robot) + robot_column(name)];
    (0..10).for_each(|nth| drop(step(&mut batch, &scene, &mut rows, nth)));
    let mut away = scene.start.clone();
    away[row_size(1) + robot_column("absent")] = 1.0;
    batch.reposition_robots(&[true], &[false, true], &away, &mut rows).expect("absent");
    let bench = rows[row_size(1)..].to_vec();
    step(&mut batch, &scene, &mut rows, 10);
    assert_eq!(rows[row_size(1)..], bench, "an absent robot rests");
    batch.reposition_robots(&[true], &[true, true], &scene.start, &mut rows).expect("free");
    step(&mut batch, &scene, &mut rows, 11);
    let [one, other] = [0, 1].map(|robot| column(&rows, robot, "v_x"));
    assert!(one > 0.05 && (one - other).abs() < 1e-4, "{one} {other}");
}

#[test]
fn frames_after_a_restart_show_robots_where_they_are() {
    let poses = [[-2.0, -1.0, 0.0], [-2.0, 1.0, 0.0]];
    let scene = Scene::at("still", scenes::ssl(2, 0), &poses, Driver::STILL);
    let sensing = Sensing { delay: 0.1, frame_rate: 100.0, ..Sensing::OFF };
    let (mut batch, mut rows) = begin(&scene, sensing, 1);
    (0..10).for_each(|nth| drop(step(&mut batch, &scene, &mut rows, nth)));
    let mut start = scene.start.clone();
    for robot in scenes::robots_mut(&mut start) {
        robot[0] = 2.0;
    }
    batch.restart(&[true], &start, &mut rows).expect("free");
    let mut seen = 0;
    for nth in 10..30 {
        step(&mut batch, &scene, &mut rows, nth);
        for frame in batch.camera_frames(0) {
            assert!(frame.robots.iter().all(|robot| (robot[2] - 2.0).abs() < 1e-3), "{frame:?}");
            seen += frame.robots.len();
        }
    }
    assert!(seen > 20, "{seen}");
}
