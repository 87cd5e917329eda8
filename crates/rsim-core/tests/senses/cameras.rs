//! Cameras, tracker and robots' own sensors.

use rsim_core::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS, parameters_size};
use rsim_core::scenes::{self, Driver, Scene};
use rsim_core::{Knowledge, Sensing, SimConfig};

use super::{Played, assert_near, moments};

/// A robot on a curve, and a ball that rolls.
fn moving() -> Scene {
    let mut scene = scenes::lone_robot([20.0, 30.0]);
    scene.set_ball([-0.6, 0.5], [1.0, 0.0]);
    scene
}

#[test]
fn the_state_is_known_as_late_as_asked() {
    let ticks = moving().every_tick(1.0);
    for delay in [0.005, 0.025, 0.037, 0.045, 0.1, 0.1234] {
        let played = Played::new(&moving(), Sensing { delay, ..Sensing::OFF }, 1, 40);
        for (robot, name) in [(None, "x"), (Some(0), "x"), (Some(0), "sin"), (Some(0), "v_theta")] {
            let known = played.column(robot, name);
            for (step, known) in (1..=40_u8).zip(known).skip(8) {
                let time = f32::from(step) * 0.025 - delay;
                // Rows of ticks: the first is that of the start.
                let at = time / 0.005;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "positive"
                )]
                let before = at.floor() as usize;
                let column = match robot {
                    None => rsim_core::columns::ball_column(name),
                    Some(_) => {
                        rsim_core::columns::row_size(0) + rsim_core::columns::robot_column(name)
                    }
                };
                let [a, b] = [ticks[before][column], ticks[before + 1][column]];
                let expected = a + (b - a) * at.fract();
                let tolerance = match name {
                    "v_theta" => 0.5,
                    "sin" => 1e-3,
                    _ => 2e-4,
                };
                assert!(
                    (known[0][1] - expected).abs() < tolerance,
                    "{delay} {name} {step}: {} instead of {expected}",
                    known[0][1]
                );
            }
        }
    }
}

#[test]
fn frames_come_at_their_own_rate() {
    // Between two control steps a state is older by half a period in the mean.
    let mut scene = scenes::rolling_ball(0.5);
    scene.config.ball.rolling_deceleration = 0.0;
    scene.config.ball.rolling_drag = 0.0;
    scene.set_ball_column("spin_y", 0.5 / scene.config.ball.radius);
    let sensing = Sensing { frame_rate: 70.0, delay: 0.03, ..Sensing::OFF };
    let played = Played::new(&scene, sensing, 100, 60);
    let x = played.column(None, "x");
    let ages = x[10..].iter().flatten().map(|[truth, known]| (truth - known) / 0.5);
    let (mean, deviation) = moments(ages);
    assert!((mean - (0.03 + 0.5 / 70.0)).abs() < 0.0005, "{mean}");
    assert_near(deviation, 1.0 / 70.0 / 12.0_f64.sqrt(), 0.05);
}

#[test]
fn jitter_and_lost_frames_make_the_state_older() {
    let mut scene = scenes::rolling_ball(0.5);
    scene.config.ball.rolling_deceleration = 0.0;
    scene.config.ball.rolling_drag = 0.0;
    scene.set_ball_column("spin_y", 0.5 / scene.config.ball.radius);
    let age = |sensing| {
        let x = Played::new(&scene, sensing, 200, 60).column(None, "x");
        moments(x[10..].iter().flatten().map(|[truth, known]| (truth - known) / 0.5)).0
    };
    let plain = Sensing { frame_rate: 100.0, delay: 0.05, ..Sensing::OFF };
    // A frame is followed by the next after 1 / (1 - loss) periods in the mean.
    let lossy = age(Sensing { frame_loss: 0.2, ..plain.clone() });
    assert!((lossy - (0.055 + 0.01 * 0.2 / 0.8)).abs() < 0.0005, "{lossy}");
    let late = age(Sensing { delay_jitter: 0.004, ..plain });
    assert!((late - 0.055).abs() < 0.0005, "frames that keep their order: {late}");
}

#[test]
fn positions_and_headings_have_the_noise_that_was_asked_for() {
    let scene = Scene::lined_up("still", scenes::vss(2, 0), Driver::STILL);
    let sensing = Sensing {
        ball_position_noise: 0.004,
        robot_position_noise: 0.007,
        heading_noise: 0.05,
        ..Sensing::OFF
    };
    let played = Played::new(&scene, sensing, 100, 200);
    for (robot, name, expected) in
        [(None, "x", 0.004), (None, "y", 0.004), (Some(1), "x", 0.007), (Some(0), "sin", 0.05)]
    {
        let column = played.column(robot, name);
        let errors = || column.iter().flatten().map(|[truth, known]| known - truth);
        let (mean, deviation) = moments(errors());
        assert_near(deviation, expected, 0.02);
        assert!(mean.abs() < expected / 40.0, "{name}: {mean}");
        // Errors of two steps are independent.
        let steps = column.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]));
        let products = steps.map(|(a, b)| (a[1] - a[0]) * (b[1] - b[0]));
        let (correlation, _) = moments(products);
        assert!(correlation.abs() < 0.03 * expected * expected, "{name}: {correlation}");
    }
}

#[test]
fn large_noise_of_headings_is_that_of_angles() {
    let scene = Scene::lined_up("still", scenes::vss(2, 0), Driver::STILL);
    for (tracker, noise) in [(0.0, 0.5), (0.0, 1.0), (0.0, 0.2)] {
        let sensing = Sensing { heading_noise: noise, tracker, ..Sensing::OFF };
        let played = Played::new(&scene, sensing, 100, 200);
        let (cos, sin) = (played.column(Some(0), "cos"), played.column(Some(0), "sin"));
        let angles = cos.iter().flatten().zip(sin.iter().flatten()).map(|(cos, sin)| {
            let [truth, known] = [0, 1].map(|nth| sin[nth].atan2(cos[nth]));
            let turn = known - truth;
            turn - std::f32::consts::TAU * (turn / std::f32::consts::TAU).round()
        });
        // An angle beyond a half turn is one less by a whole turn: seldom up to 1 rad.
        assert_near(moments(angles).1, noise.into(), 0.02);
    }
}

#[test]
fn cameras_that_see_bodies_at_different_places_give_them_no_velocity() {
    // Where two cameras of the presets overlap.
    let mut scene = Scene::at("rest", scenes::ssl(1, 0), &[[-0.3, 0.5, 0.0]], Driver::STILL);
    scene.set_ball([0.0, 0.0], [0.0, 0.0]);
    for preset in [Sensing::FRIENDLY, Sensing::REALISTIC] {
        assert!(preset.camera_offset_error > 0.0 && preset.camera_overlap > 0.0);
        let name = preset.name.clone();
        let played = Played::new(&scene, preset, 60, 300);
        for robot in [None, Some(0)] {
            let [x, y] = ["v_x", "v_y"].map(|column| played.column(robot, column));
            let speeds = x[40..].iter().flatten().zip(y[40..].iter().flatten());
            let mut speeds: Vec<f32> = speeds.map(|(x, y)| x[1].hypot(y[1])).collect();
            speeds.sort_by(f32::total_cmp);
            let most = speeds[speeds.len() * 99 / 100];
            assert!(most < 0.25, "{name} {robot:?}: {most} m/s");
        }
    }
}

#[test]
fn as_many_detections_are_missing_as_asked() {
    let scene = Scene::lined_up("still", scenes::vss(2, 0), Driver::STILL);
    let noise = Sensing {
        ball_position_noise: 0.004,
        robot_position_noise: 0.004,
        heading_noise: 0.01,
        ..Sensing::OFF
    };
    let unchanged = |sensing, robot| {
        let x = Played::new(&scene, sensing, 100, 200).column(robot, "x");
        let pairs = x.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]));
        moments(pairs.map(|(a, b)| f32::from(u8::from(a[1].to_bits() == b[1].to_bits())))).0
    };
    let missing = Sensing { missing_balls: 0.1, missing_robots: 0.3, ..noise.clone() };
    assert_near(unchanged(missing.clone(), None), 0.1, 0.05);
    assert_near(unchanged(missing, Some(1)), 0.3, 0.02);
    assert_near(unchanged(Sensing { frame_loss: 0.2, ..noise.clone() }, None), 0.2, 0.02);
    assert!(unchanged(noise, Some(0)) < 1e-4);
}

#[test]
fn headings_are_misread_by_90_degrees_and_the_tracker_does_not_believe_them() {
    let scene = Scene::lined_up("still", scenes::vss(1, 0), Driver::STILL);
    let part = |tracker| {
        let sensing = Sensing { misread_headings: 0.05, tracker, ..Sensing::OFF };
        let cos = Played::new(&scene, sensing, 100, 200).column(Some(0), "cos");
        moments(cos.iter().flatten().map(|[_, known]| f32::from(u8::from(known.abs() < 0.5)))).0
    };
    assert_near(part(0.0), 0.05, 0.05);
    assert!(part(1.0) < 0.0005, "{}", part(1.0));
}

#[test]
fn a_first_frame_soon_after_the_start_made_robots_turn_once_in_each_frame() {
    let scene = Scene::lined_up("still", scenes::ssl(3, 3), Driver::STILL);
    let sensing = Sensing { delay: 0.0, ..Sensing::RC2021 };
    let played = Played::new(&scene, sensing, 2000, 12);
    for robot in 0..6 {
        let turns = played.column(Some(robot), "v_theta");
        let most = turns.iter().flatten().map(|[_, known]| known.abs()).fold(0.0, f32::max);
        assert!(most < 8.0, "a standing robot seems to turn at {most} rad/s");
    }
    let speeds = played.column(None, "v_x");
    let most = speeds.iter().flatten().map(|[_, known]| known.abs()).fold(0.0, f32::max);
    assert!(most < 0.5, "a resting ball seems to move at {most} m/s");
}

#[test]
fn the_speed_of_a_kicked_ball_is_known_soon() {
    let mut scene = scenes::ball_in_mouth(&[0.0; 6]);
    scene.config.time_step = 0.005;
    // RC2021 without what is not the tracker's: delay, losses.
    let sensing = Sensing { delay: 0.0, missing_balls: 0.0, command_loss: 0.0, ..Sensing::RC2021 };
    let worlds = 100;
    let (mut batch, mut rows) = super::begin(&scene, sensing, worlds);
    let mut errors = Vec::new();
    for tick in 0..240_u8 {
        let kick = if tick == 40 { 4.0 } else { 0.0 };
        let commands = [0.0, 0.0, 0.0, kick, 0.0, 0.0].repeat(worlds);
        batch.step(&commands, &mut rows, None).expect("finite");
        let mut known = vec![0.0; rows.len()];
        batch.sense(&mut known, None);
        let (size, v_x) = (scene.config.row_size(), rsim_core::columns::ball_column("v_x"));
        let each = || rows.chunks_exact(size).zip(known.chunks_exact(size));
        let parts = each().map(|(truth, known)| known[v_x] / truth[v_x] - 1.0);
        let (mean, deviation) = moments(parts);
        errors.push(mean.hypot(deviation));
    }
    // The kick is in tick 40; 30 ms later two frames have shown it.
    assert!(rows[rsim_core::columns::ball_column("v_x")] > 2.0);
    assert!(errors[46] < 0.10, "{:?}", &errors[38..60]);
    let steady = errors[140..].iter().fold(0.0_f64, |most, error| most.max(*error));
    assert!(steady < 0.02, "{steady}");
}

#[test]
fn a_flying_ball_is_seen_on_the_floor_and_a_hidden_one_not_at_all() {
    let config = SimConfig { ..scenes::ssl(1, 0) };
    let mut scene = scenes::lone_ball(config, [2.0, 1.0], [0.0, 0.0]);
    scene.set_ball_column("z", 0.5);
    scene.set_ball_column("v_z", 2.0);
    let sensing = Sensing { camera_height: 4.0, ..Sensing::OFF };
    let played = Played::new(&scene, sensing, 1, 4);
    let (x, z) = (played.column(None, "x"), played.column(None, "z"));
    for (x, z) in x.iter().zip(&z) {
        let [height, known] = z[0];
        assert!(height > 0.4 && known == 0.0, "{height} {known}");
        let expected = x[0][0] * 4.0 / (4.0 - height);
        assert!((x[0][1] - expected).abs() < 1e-3, "{} instead of {expected}", x[0][1]);
    }
    // Behind a robot, as the camera above the middle sees it.
    for (x, is_hidden) in [(2.11, true), (1.89, false)] {
        let mut scene = scenes::lone_omni(&[0.0; 6]);
        scene.set_robot_column(0, "x", 2.0);
        scene.set_robot_column(0, "cos", 0.0);
        scene.set_robot_column(0, "sin", 1.0);
        scene.set_ball([x, 0.0], [0.0, 0.0]);
        let sensing = Sensing {
            camera_height: 4.0,
            visible_part: 0.4,
            ball_position_noise: 0.001,
            ..Sensing::OFF
        };
        let seen = Played::new(&scene, sensing, 1, 20).column(None, "x");
        let changed =
            seen.windows(2).any(|pair| pair[0][0][1].to_bits() != pair[1][0][1].to_bits());
        assert_eq!(changed, !is_hidden);
    }
}

#[test]
fn a_higher_robot_of_a_worlds_own_hides_the_ball_farther_away() {
    let hides = |height: f32| {
        let mut scene = scenes::lone_omni(&[0.0; 6]);
        scene.set_robot_column(0, "x", 4.0);
        scene.set_ball([4.36, 0.0], [0.0, 0.0]);
        let sensing = Sensing {
            camera_height: 4.0,
            visible_part: 0.4,
            ball_position_noise: 0.001,
            ..Sensing::OFF
        };
        scene.config.sensing = Some(sensing);
        let mut world = scene.world();
        let mut parameters = vec![1.0; parameters_size(1)];
        let columns = ROBOT_PARAMETERS.iter().position(|name| *name == "height");
        parameters[BALL_PARAMETERS.len() + columns.expect("a parameter")] = height;
        world.place(&scene.start, Some(&parameters)).expect("valid");
        let mut known = vec![0.0; scene.config.row_size()];
        let mut seen = Vec::new();
        for _ in 0..10 {
            world.step(&[0.0; 6]).expect("finite");
            world.write_sensed_row(&mut known);
            seen.push(known[0].to_bits());
        }
        seen.windows(2).all(|pair| pair[0] == pair[1])
    };
    assert!(!hides(1.0) && hides(2.0));
}

#[test]
fn exact_detections_of_robots_that_two_cameras_see_have_their_velocities() {
    let mut scene = scenes::ssl_random(scenes::ssl(6, 6));
    scene.config.ball.rolling_deceleration = 0.0;
    let sensing =
        Sensing { cameras_along: 2.0, cameras_across: 2.0, camera_overlap: 3.0, ..Sensing::OFF };
    let played = Played::new(&scene, sensing, 4, 40);
    for name in ["x", "sin", "v_x", "v_theta"] {
        for robot in 0..12 {
            for [truth, known] in played.column(Some(robot), name).iter().flatten() {
                assert!((truth - known).abs() < 1e-4, "{robot} {name}: {known}, not {truth}");
            }
        }
    }
}

#[test]
fn velocities_are_found_from_frames_that_seldom_come() {
    let mut scene = scenes::lone_ball(scenes::ssl(1, 0), [-2.0, 1.0], [1.0, 0.0]);
    scene.config.ball.rolling_deceleration = 0.0;
    scene.config.ball.rolling_drag = 0.0;
    scene.set_ball_column("spin_y", 1.0 / scene.config.ball.radius);
    let sensing = Sensing { frame_rate: 2.5, tracker: 1.0, ..Sensing::OFF };
    let speeds = Played::new(&scene, sensing, 20, 80).column(None, "v_x");
    let found = speeds.last().expect("steps").iter().map(|[_, known]| *known);
    let (mean, deviation) = moments(found);
    assert!((mean - 1.0).abs() < 0.05 && deviation < 0.05, "{mean} {deviation}");
}

#[test]
fn cameras_have_offsets_and_overlaps() {
    let mut scene = scenes::rolling_ball(0.8);
    let sensing = Sensing {
        cameras_along: 2.0,
        camera_overlap: 0.2,
        camera_offset_error: 0.02,
        ..Sensing::OFF
    };
    scene.set_ball([-0.5, 0.3], [1.5, 0.0]);
    let played = Played::new(&scene, sensing, 200, 50);
    let (x, y) = (played.column(None, "x"), played.column(None, "y"));
    let error_where = |inside: &dyn Fn(f32) -> bool| {
        let errors = x.iter().flatten().zip(y.iter().flatten());
        errors.filter(|(x, _)| inside(x[0])).map(|(_, y)| y[1] - y[0]).collect::<Vec<f32>>()
    };
    let (left, right) = (error_where(&|x| x < -0.15), error_where(&|x| x > 0.15));
    assert_near(moments(left.iter().copied()).1, 0.02, 0.15);
    assert_near(moments(right.iter().copied()).1, 0.02, 0.15);
    // Within a match each camera keeps its offset, and the two differ.
    let first = y.iter().map(|step| step[0][1] - step[0][0]).collect::<Vec<f32>>();
    assert!((first[0] - first[3]).abs() < 1e-5);
    assert!((first[0] - first[first.len() - 1]).abs() > 1e-3);
}

#[test]
fn ghosts_at_dribblers_do_not_move_the_tracked_ball() {
    let mut scene = Scene::lined_up("still", scenes::ssl(3, 3), Driver::STILL);
    scene.set_ball([0.0, 1.5], [0.0, 0.0]);
    let sensing = Sensing { ghost_balls: 5.0, tracker: 1.0, frame_rate: 70.0, ..Sensing::OFF };
    let y = Played::new(&scene, sensing, 20, 100).column(None, "y");
    assert!(y.iter().flatten().all(|[truth, known]| (truth - known).abs() < 0.005));
}

#[test]
fn beams_miss_and_report_wrongly_as_often_as_asked() {
    let part_of = |scene: &Scene, sensing| {
        let cut = Played::new(scene, sensing, 400, 200).column(Some(0), "infrared");
        moments(cut.iter().flatten().map(|[_, known]| *known)).0
    };
    let sensing = Sensing { beam_misses: 0.1, beam_false_alarms: 0.05, ..Sensing::OFF };
    let held = scenes::ball_in_mouth(&[0.0; 6]);
    assert_near(part_of(&held, sensing.clone()), 0.9, 0.01);
    assert_near(part_of(&scenes::lone_omni(&[0.0; 6]), sensing), 0.05, 0.05);
}

#[test]
fn odometry_and_gyroscopes_replace_the_cameras_velocities() {
    let scene = scenes::lone_omni(&[1.0, 0.5, 2.0, 0.0, 0.0, 0.0]);
    let sensing = Sensing {
        odometry: 1.0,
        odometry_noise: 0.05,
        gyroscope_noise: 0.02,
        gyroscope_error: 0.1,
        ..Sensing::OFF
    };
    let played = Played::new(&scene, sensing, 100, 200);
    let errors = |name: &str| -> Vec<f32> {
        let column = played.column(Some(0), name);
        column[40..].iter().flatten().map(|[truth, known]| known - truth).collect()
    };
    assert_near(moments(errors("v_x")).1, 0.05, 0.03);
    let (_, spread) = moments(errors("v_theta"));
    assert_near(spread, 0.1_f64.hypot(0.02), 0.2);
}

#[test]
fn what_no_robot_senses_is_not_known() {
    let played = Played::new(&scenes::chase(), Sensing { delay: 0.01, ..Sensing::OFF }, 1, 400);
    let mut robots: Vec<Option<usize>> = (0..6).map(Some).collect();
    robots.push(None);
    for (name, empty) in [("last_touch", -1.0), ("touched_ball", 0.0), ("collision_speed", 0.0)] {
        let mut happened = false;
        for robot in robots.iter().filter(|robot| robot.is_none() == (name == "last_touch")) {
            for [truth, known] in played.column(*robot, name).concat() {
                happened |= (truth - empty).abs() > 1e-6;
                assert!((known - empty).abs() < 1e-9, "{name}: {known}");
            }
        }
        assert!(happened, "{name}");
    }
}

/// Position noise of what both teams know, by step and world.
fn noises_of_teams(sensing: &Sensing) -> [Vec<f32>; 2] {
    let scene = moving();
    let (mut batch, mut rows) = super::begin(&scene, sensing.clone(), 50);
    let size = scene.config.row_size();
    let mut noises = [Vec::new(), Vec::new()];
    for step in 0..20 {
        let each = rows.chunks_exact(size);
        let commands: Vec<f32> = each.flat_map(|row| scene.commands(row, step, 0)).collect();
        batch.step(&commands, &mut rows, None).expect("finite");
        for (knowledge, noises) in [Knowledge::Blue, Knowledge::Yellow].into_iter().zip(&mut noises)
        {
            let mut known = vec![0.0; rows.len()];
            batch.sense_as(knowledge, &mut known, None);
            let pairs = known.chunks_exact(size).zip(rows.chunks_exact(size));
            noises.extend(pairs.map(|(known, truth)| known[0] - truth[0]));
        }
    }
    noises
}

#[test]
fn cameras_of_their_own_give_teams_errors_of_their_own() {
    let shared = Sensing { ball_position_noise: 0.01, ..Sensing::OFF };
    let own = Sensing { own_cameras: 1.0, ..shared.clone() };
    let [blue, yellow] = noises_of_teams(&shared);
    assert_eq!(blue, yellow);
    let [first, second] = noises_of_teams(&own);
    assert_eq!(first, blue, "the first team sees what both saw");
    let (_, deviation) = moments(second.iter().copied());
    assert_near(deviation, 0.01, 0.06);
    let (_, together) = moments(first.iter().zip(&second).map(|(a, b)| a + b));
    assert_near(together, 0.01 * std::f64::consts::SQRT_2, 0.06);
}
