//! Forecasts, against the states that came.

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, robot_column, row_size};
use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{Batch, ForecastError, Forecaster, Knowledge, Sensing, Threads};

use super::{begin, keys};

/// Columns of ball and robots that follow from poses, motion and spin alone.
const OF_BALL: usize = 9;
const OF_ROBOT: usize = 8;

/// Late commands and a forecast that knows all of them.
fn late(command_delay: f32, delay: f32) -> Sensing {
    Sensing { command_delay, delay, forecast: 1.0, forecast_others: 1.0, ..Sensing::OFF }
}

/// Robots far from each other and from the ball, with random commands.
fn scenes_without_contacts() -> [Scene; 2] {
    let poses = [[-0.4, -0.2, 0.0], [0.4, -0.2, 180.0]];
    let mut vss = Scene::at("vss apart", scenes::vss(1, 1), &poses, Driver::Random);
    vss.set_ball([-0.2, 0.58], [0.5, 0.0]);
    [vss, scenes::ssl_random(scenes::ssl(1, 1))]
}

/// True rows and forecasts of a match after each step.
fn played(scene: &Scene, sensing: Sensing, knowledge: Knowledge, steps: u64) -> [Vec<Vec<f32>>; 2] {
    let (mut batch, mut rows) = begin(scene, sensing, 1);
    let (mut truth, mut forecasts) = (Vec::new(), Vec::new());
    for step in 0..steps {
        forecasts.push(step_and_sense(&mut batch, scene, &mut rows, step, knowledge));
        truth.push(rows.clone());
    }
    [truth, forecasts]
}

fn step_and_sense(
    batch: &mut Batch,
    scene: &Scene,
    rows: &mut [f32],
    step: u64,
    knowledge: Knowledge,
) -> Vec<f32> {
    let size = scene.config.row_size();
    let commands: Vec<f32> =
        rows.chunks_exact(size).flat_map(|row| scene.commands(row, step, 0)).collect();
    batch.step(&commands, rows, None).expect("finite");
    let mut known = vec![0.0; rows.len()];
    batch.sense_as(knowledge, &mut known, None);
    known
}

/// Largest difference of two rows in poses, motion, spin and beams.
fn difference(one: &[f32], other: &[f32]) -> f32 {
    let robots = one.len() / ROBOT_COLUMNS.len();
    let columns = (0..OF_BALL)
        .chain((0..robots).flat_map(|nth| row_size(nth)..row_size(nth) + OF_ROBOT))
        .filter(|at| *at < one.len());
    columns.map(|at| (one[at] - other[at]).abs()).fold(0.0, f32::max)
}

#[test]
fn a_forecast_is_the_state_in_which_the_next_commands_act() {
    for scene in scenes_without_contacts() {
        for (command_delay, delay, late_steps, tolerance) in [
            // rapier rounds poses in frames of its own.
            (0.1, 0.0, 4, 1e-5),
            (0.025, 0.0, 1, 1e-5),
            (0.1, 0.05, 4, 1e-5),
            // Frames between two ticks are exposed on the straight line of the tick.
            (0.05, 0.037, 2, 2e-2),
        ] {
            let [truth, forecasts] =
                played(&scene, late(command_delay, delay), Knowledge::Blue, 24);
            let mut moved = 0.0_f32;
            for step in 4..20 {
                let then = &truth[step + late_steps];
                let error = difference(&forecasts[step], then);
                assert!(
                    error <= tolerance,
                    "{} {command_delay} {delay} {step}: {error}",
                    scene.name
                );
                moved = moved.max(difference(&truth[step], then));
            }
            assert!(moved > 0.05, "{}: nothing moves", scene.name);
        }
    }
}

#[test]
fn without_any_delay_a_forecast_is_what_is_sensed() {
    let scene = scenes::chase();
    for odometry in [0.0, 1.0] {
        let sensing = Sensing { odometry, odometry_noise: 0.1, ..late(0.0, 0.0) };
        let [_, forecasts] = played(&scene, sensing.clone(), Knowledge::Blue, 60);
        let sensing = Sensing { forecast: 0.0, ..sensing };
        let [_, sensed] = played(&scene, sensing, Knowledge::Blue, 60);
        assert_eq!(forecasts, sensed);
    }
}

#[test]
fn a_forecast_begins_with_what_cameras_saw_and_not_with_newer_velocities() {
    for scene in scenes_without_contacts() {
        let by_cameras = late(0.05, 0.05);
        let own = Sensing { odometry: 1.0, ..by_cameras.clone() };
        let [_, expected] = played(&scene, by_cameras.clone(), Knowledge::Blue, 24);
        let [_, forecasts] = played(&scene, own.clone(), Knowledge::Blue, 24);
        assert_eq!(forecasts, expected, "{}", scene.name);
        let sensed = [by_cameras, own].map(|sensing| {
            played(&scene, Sensing { forecast: 0.0, ..sensing }, Knowledge::Blue, 24)
        });
        assert_ne!(sensed[0][1], sensed[1][1], "{}: velocities change", scene.name);
    }
}

#[test]
fn robots_whose_commands_are_unknown_keep_their_velocities() {
    for scene in scenes_without_contacts() {
        let sensing = Sensing { forecast_others: 0.0, ..late(0.1, 0.0) };
        for (knowledge, known) in
            [(Knowledge::Blue, 0), (Knowledge::Yellow, scene.config.blue.len())]
        {
            let [truth, forecasts] = played(&scene, sensing.clone(), knowledge, 24);
            let unknown = if known == 0 { scene.config.blue.len() } else { 0 };
            let (mut moved, mut errs) = (0.0_f32, 0.0_f32);
            for step in 4..20 {
                let of = |row: &[f32], robot: usize| -> Vec<f32> {
                    row[row_size(robot)..row_size(robot) + OF_ROBOT].to_vec()
                };
                let then = of(&truth[step + 4], known);
                let forecast = of(&forecasts[step], known);
                for (then, forecast) in then.iter().zip(&forecast) {
                    assert!((then - forecast).abs() <= 1e-5, "{}: known", scene.name);
                }
                let (now, forecast) = (of(&truth[step], unknown), of(&forecasts[step], unknown));
                let [v_x, v_y, turn] = ["v_x", "v_y", "v_theta"].map(robot_column);
                let speed = |robot: &[f32]| robot[v_x].hypot(robot[v_y]);
                assert!((speed(&now) - speed(&forecast)).abs() < 0.05, "{} {step}", scene.name);
                assert!((now[turn] - forecast[turn]).abs() < 0.5, "{} {step}", scene.name);
                let way = (forecast[0] - now[0]).hypot(forecast[1] - now[1]);
                assert!((way - speed(&now) * 0.1).abs() < 0.02, "{} {step}: {way}", scene.name);
                moved = moved.max(way);
                let then = of(&truth[step + 4], unknown);
                errs = errs.max((forecast[0] - then[0]).hypot(forecast[1] - then[1]));
            }
            assert!(moved > 0.02 && errs > 0.005, "{}: {moved} {errs}", scene.name);
        }
    }
}

#[test]
fn a_kick_on_its_way_is_forecast_with_its_touch() {
    let mut scene = scenes::ball_in_mouth(&[0.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
    scene.config.sensing = Some(late(0.1, 0.0));
    let (mut batch, mut rows) = scene.batch(1, 1);
    let mut known = vec![0.0; rows.len()];
    let [v_x, last_touch] = ["v_x", "last_touch"].map(ball_column);
    let beam = row_size(0) + robot_column("infrared");
    let touched = row_size(0) + robot_column("touched_ball");
    let mut seen = Vec::new();
    for step in 0..6 {
        let kick = if step == 0 { 4.0 } else { 0.0 };
        batch.step(&[0.0, 0.0, 0.0, kick, 0.0, 0.0], &mut rows, None).expect("finite");
        batch.sense(&mut known, None);
        seen.push([known[v_x], known[beam], known[touched], known[last_touch], rows[v_x]]);
    }
    // The command acts in the step after the fourth; the first forecast is of the time at its end.
    assert!(seen[0][0] > 3.0 && seen[0][4] == 0.0, "{seen:?}");
    assert_eq!((seen[0][1], seen[0][2], seen[0][3]), (0.0, 1.0, 0.0), "{seen:?}");
    assert!(seen[3][4] == 0.0 && seen[4][4] > 3.0, "{seen:?}");
}

#[test]
fn a_world_forecasts_the_same_whatever_batch_and_threads_and_from_a_snapshot() {
    for scene in [scenes::chase(), scenes::ssl_chase(scenes::ssl(3, 3))] {
        for preset in
            [late(0.1, 0.02), Sensing { forecast: 1.0, command_delay: 0.04, ..Sensing::VSSS }]
        {
            let mut scene = scene.clone();
            scene.config.sensing = Some(preset.clone());
            let (mut batch, mut rows) = scene.batch(9, 2);
            batch.begin_senses(&[true; 9], &keys(9), None).expect("valid");
            let (mut single, mut row) = scene.batch(1, 1);
            single.begin_senses(&[true], &keys(9)[7..8], None).expect("valid");
            let mut saved = None;
            let mut futures = Vec::new();
            for step in 0..60 {
                if step == 31 {
                    saved = Some((batch.snapshot(), rows.clone()));
                }
                let known = step_and_sense(&mut batch, &scene, &mut rows, step, Knowledge::Yellow);
                let alone = step_and_sense(&mut single, &scene, &mut row, step, Knowledge::Yellow);
                let size = row.len();
                assert_eq!(known[7 * size..8 * size], alone);
                assert!(known.iter().all(|number| number.is_finite()));
                if saved.is_some() {
                    futures.push(known);
                }
            }
            let (snapshot, mut rows) = saved.expect("60 steps");
            let (mut other, _) = scene.batch(9, 1);
            other.restore(&snapshot).expect("its own");
            for (step, future) in (31..).zip(futures) {
                let known = step_and_sense(&mut other, &scene, &mut rows, step, Knowledge::Yellow);
                assert_eq!(known, future);
            }
        }
    }
}

/// A forecaster on its own, at a late time of some clock.
const CLOCK: f64 = 1.7e9;

fn new_forecaster(scene: &Scene, threads: usize) -> Forecaster {
    let threads = Threads::new(threads).expect("some");
    Forecaster::new(&scene.config, 1, Knowledge::All, threads).expect("valid")
}

/// Plays a step that a forecaster is informed of. Writes the state and its forecast to `rows` and returns what
/// senses know.
fn step_both(
    batch: &mut Batch,
    forecaster: &mut Forecaster,
    [rows, forecast]: [&mut Vec<f32>; 2],
    scene: &Scene,
    step: u32,
    before: f64,
) -> Vec<f32> {
    let commands = scene.commands(rows, step.into(), 0);
    forecaster.send(&commands, &[before], None).expect("in order");
    batch.step(&commands, rows, None).expect("finite");
    let mut known = rows.clone();
    batch.sense(&mut known, None);
    let now = [before + 0.025];
    forecaster.forecast(rows, &now, &now, forecast).expect("valid");
    known
}

#[test]
fn a_forecaster_of_ones_own_forecasts_as_senses_do() {
    let [vss, ssl] = scenes_without_contacts();
    for mut scene in [vss, ssl, scenes::chase()] {
        scene.config.sensing = Some(late(0.06, 0.0));
        let (mut batch, mut rows) = scene.batch(1, 1);
        let mut forecaster = new_forecaster(&scene, 1);
        let mut out = rows.clone();
        for step in 0..60_u32 {
            let before = CLOCK + f64::from(step) * 0.025;
            let known =
                step_both(&mut batch, &mut forecaster, [&mut rows, &mut out], &scene, step, before);
            assert!(difference(&known, &out) < 1e-6, "{step}");
            if step == 30 {
                let saved = forecaster.snapshot();
                forecaster = new_forecaster(&scene, 2);
                forecaster.restore(&saved).expect("its own");
            }
        }
        assert!(difference(&rows, &out) > 0.01);
    }
}

#[test]
fn a_forecast_takes_the_delay_of_the_configuration_and_not_that_of_the_episode() {
    let [vss, ssl] = scenes_without_contacts();
    for mut scene in [vss, ssl] {
        let sensing = Sensing { command_timeout: 0.2, ..late(0.06, 0.0) };
        let drawn = Sensing { command_delay: 0.02, command_timeout: 0.01, ..sensing.clone() };
        scene.config.sensing = Some(sensing);
        let (mut batch, mut rows) = scene.batch(1, 1);
        batch.begin_senses(&[true], &keys(1), Some(&drawn.values())).expect("valid");
        let mut forecaster = new_forecaster(&scene, 1);
        let mut out = rows.clone();
        let mut ahead = 0.0_f32;
        for step in 0..20_u32 {
            let before = f64::from(step) * 0.025;
            let known =
                step_both(&mut batch, &mut forecaster, [&mut rows, &mut out], &scene, step, before);
            assert!(difference(&known, &out) < 1e-6, "{}: {step}", scene.name);
            ahead = ahead.max(difference(&known, &rows));
        }
        assert!(ahead > 0.01, "{}: {ahead}", scene.name);
    }
}

#[test]
fn rows_of_times_whose_commands_are_forgotten_are_refused() {
    let mut scene = scenes::vss_free();
    scene.config.sensing = Some(late(0.1, 0.0));
    let new = || new_forecaster(&scene, 1);
    let (mut forecaster, row) = (new(), scene.start.clone());
    for (time, speed) in [(1.0, 5.0), (1.1, 20.0), (1.2, -5.0)] {
        let commands = vec![speed; scene.config.command_size()];
        forecaster.send(&commands, &[time], None).expect("in order");
    }
    let mut out = [(); 3].map(|()| row.clone());
    let [early, then, other] = &mut out;
    forecaster.forecast(&row, &[1.15], &[1.2], early).expect("all commands are known");
    forecaster.forecast(&row, &[1.25], &[1.2], then).expect("valid");
    let saved = forecaster.snapshot();
    let mut restored = new();
    restored.restore(&saved).expect("its own");
    for each in [&mut forecaster, &mut restored] {
        let error = each.forecast(&row, &[1.15], &[1.2], other).expect_err("forgotten");
        assert_eq!(
            error,
            ForecastError::Forgotten { world: 0, got: 1.15, since: 1.1 + f64::from(0.1_f32) }
        );
        assert!(error.to_string().contains("seen: the row of world 0 is of 1.15 s"), "{error}");
        assert_eq!((each.snapshot(), &*other), (saved.clone(), &row));
        each.forecast(&row, &[1.25], &[1.2], other).expect("as before");
        assert_eq!(other, then);
        other.copy_from_slice(&row);
    }
    assert!(difference(early, then) > 0.0);
    forecaster.reset(&[true]);
    forecaster.forecast(&row, &[0.5], &[0.6], other).expect("nothing is forgotten");
}

#[test]
fn commands_that_no_forecast_needs_take_no_memory() {
    let scene = scenes::vss_free();
    let threads = Threads::new(1).expect("one");
    let mut forecaster = Forecaster::new(&scene.config, 1, Knowledge::All, threads).expect("valid");
    let commands = vec![5.0; scene.config.command_size()];
    let mut sizes = Vec::new();
    for step in 0..1000_u32 {
        forecaster.send(&commands, &[f64::from(step) * 0.025], None).expect("in order");
        sizes.push(forecaster.snapshot().len());
    }
    assert!(sizes[10] < sizes[60], "those of 2 s are kept");
    assert!(sizes[100..].iter().all(|size| *size < sizes[100] + 300));
    let (row, mut out) = (scene.start.clone(), scene.start.clone());
    let now = 999.0 * 0.025;
    forecaster.forecast(&row, &[now - 1.99], &[now], &mut out).expect("up to 2 s");
    let mut matches = scene.clone();
    // Without frames that arrive, a match forecasts from its start, up to the limit.
    matches.config.sensing = Some(Sensing { frame_loss: 1.0, ..late(0.1, 0.0) });
    let (mut batch, mut rows) = matches.batch(1, 1);
    let mut sizes = Vec::new();
    for _ in 0..300 {
        batch.step(&commands, &mut rows, None).expect("finite");
        sizes.push(batch.snapshot().len());
    }
    // Contacts of robots at a wall take some hundred bytes, commands of 200 steps more than ten thousand.
    assert!(sizes[299] < sizes[100] + 2000, "{sizes:?}");
}

#[test]
fn a_team_that_does_not_forecast_knows_what_is_sensed() {
    for scene in scenes_without_contacts() {
        let sensing = Sensing { odometry: 1.0, odometry_noise: 0.1, ..late(0.1, 0.05) };
        let [_, sensed] =
            played(&scene, Sensing { forecast: 0.0, ..sensing.clone() }, Knowledge::Blue, 12);
        let (mut batch, mut rows) = begin(&scene, sensing, 1);
        for (step, sensed) in (0..12).zip(sensed) {
            let forecast = step_and_sense(&mut batch, &scene, &mut rows, step, Knowledge::Blue);
            let mut known = rows.clone();
            batch.sense_without_forecast(Knowledge::Blue, &mut known, None);
            assert_eq!(known, sensed, "{}", scene.name);
            assert_ne!(known, forecast, "{}", scene.name);
        }
    }
}

#[test]
fn wrong_times_and_rows_are_refused_and_change_nothing() {
    let scene = scenes::vss_free();
    let threads = Threads::new(1).expect("one");
    let mut forecaster =
        Forecaster::new(&scene.config, 2, Knowledge::Blue, threads).expect("valid");
    let commands = vec![5.0; 2 * scene.config.command_size()];
    let rows = scene.start.repeat(2);
    forecaster.send(&commands, &[1.0, 1.0], None).expect("first");
    let saved = forecaster.snapshot();
    let error = forecaster.send(&commands, &[2.0, 0.5], None).expect_err("back in time");
    assert_eq!(error, ForecastError::OutOfOrder { world: 1, got: 0.5, last: 1.0 });
    forecaster.send(&commands, &[2.0, 0.5], Some(&[true, false])).expect("the other waits");
    forecaster.restore(&saved).expect("its own");
    let mut out = vec![7.0; rows.len()];
    let error = forecaster.forecast(&rows, &[3.0, 0.9], &[3.0, 3.0], &mut out).expect_err("old");
    assert!(error.to_string().contains("world 1"), "{error}");
    let mut wrong = rows.clone();
    wrong[BALL_COLUMNS.len() * 2] = f32::NAN;
    let error = forecaster.forecast(&wrong, &[1.0; 2], &[1.1; 2], &mut out).expect_err("NaN");
    assert!(matches!(error, ForecastError::Row(_)), "{error}");
    assert!(out.iter().all(|number| number.to_bits() == 7.0_f32.to_bits()));
    assert_eq!(forecaster.snapshot(), saved);
    forecaster.forecast(&rows, &[1.0; 2], &[1.1; 2], &mut out).expect("valid");
    let moved = difference(&rows[..rows.len() / 2], &out[..rows.len() / 2]);
    forecaster.reset(&[true, true]);
    let mut still = out.clone();
    forecaster.forecast(&rows, &[1.0; 2], &[1.1; 2], &mut still).expect("valid");
    assert!(moved > 0.0 && difference(&out, &still) > 0.0, "the commands are forgotten");
}
