//! Placement of estimates: the nearest valid state, and by how much bodies were moved.
#![allow(clippy::float_cmp)] // equal results are exact

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, parameters_size, robot_column};
use rsim_core::scenes::{self, Driver, Scene, robots, robots_mut, uniform};
use rsim_core::{EngineKind, Field, MAX_PLACED_SPEED, PlaceError, SimConfig, World};

fn row(world: &World) -> Vec<f32> {
    let mut row = vec![0.0; world.config().row_size()];
    world.write_row(&mut row);
    row
}

fn configs() -> [SimConfig; 5] {
    let vss_5v5 = SimConfig { field: Field::VSS_5V5, ..scenes::vss(5, 5) };
    let ssl_a = SimConfig { field: Field::SSL_A, ..scenes::ssl(11, 11) };
    [scenes::vss(3, 3), vss_5v5, scenes::ssl(6, 6), ssl_a, scenes::vss(1, 0)]
}

/// Places an estimate, and returns the valid row and by how much each body was moved.
fn placed(scene: &Scene, estimate: &[f32]) -> (Vec<f32>, Vec<f32>) {
    let mut world = scene.world();
    let moved = world.place_estimate(estimate).expect("finite");
    let found = row(&world);
    scene.world().place(&found, None).expect("the found state is valid");
    (found, moved)
}

/// Positions of ball and robots in a row, m.
fn positions(row: &[f32]) -> Vec<[f32; 3]> {
    let ball = [row[0], row[1], row[ball_column("z")]];
    std::iter::once(ball).chain(robots(row).map(|robot| [robot[0], robot[1], 0.0])).collect()
}

#[test]
fn valid_states_pass_unchanged() {
    let mut held = 0;
    for engine in EngineKind::ALL {
        for config in [scenes::vss(3, 3), scenes::ssl(4, 4)] {
            let scene = Scene::lined_up("crowd", SimConfig { engine, ..config }, Driver::Chase);
            let (rows, _) = scene.play(&mut scene.world(), 200);
            let (mut placed, mut estimated) = (scene.batch(1, 1).0, scene.batch(1, 1).0);
            for row in rows.chunks_exact(scene.start.len()) {
                let (mut expected, mut found) = (row.to_vec(), row.to_vec());
                let mut moved = vec![f32::NAN; 1 + scene.config.n_robots()];
                placed.restart(&[true], row, &mut expected).expect("valid");
                estimated.place_estimates(&[true], row, &mut found, &mut moved).expect("finite");
                assert_eq!(found, expected);
                assert_eq!(estimated.snapshot(), placed.snapshot());
                assert!(moved.iter().all(|distance| *distance == 0.0), "{moved:?}");
                held += 1;
            }
        }
    }
    assert_eq!(held, 800);
}

#[test]
fn two_bodies_that_overlap_are_moved_apart_by_as_much_as_they_must() {
    // Two squares of 75 mm, 45 mm apart: they may overlap by 10 mm.
    let mut scene = Scene::lined_up("random", scenes::vss(3, 3), Driver::STILL);
    scene.set_ball([0.0, 0.5], [0.0, 0.0]);
    for (robot, x) in [(0, 0.0), (3, 0.045)] {
        scene.set_robot_column(robot, "x", x);
        scene.set_robot_column(robot, "y", 0.0);
    }
    let estimate = scene.start.clone();
    let valid = Scene::lined_up("random", scenes::vss(3, 3), Driver::STILL);
    let (found, moved) = placed(&valid, &estimate);
    for robot in 0..6 {
        let expected = if [0, 3].contains(&robot) { 0.0105 } else { 0.0 };
        assert!((moved[1 + robot] - expected).abs() < 1e-4, "{robot}: {moved:?}");
    }
    let x = |robot: usize| robots(&found).nth(robot).expect("a robot")[0];
    assert!((x(0) + 0.0105).abs() < 1e-4 && (x(3) - 0.0555).abs() < 1e-4, "{} {}", x(0), x(3));
}

#[test]
fn a_robot_in_a_goals_wall_and_a_ball_in_a_robot_move_by_millimeters() {
    // Measured: the side of an SSL goal of the field for hardware challenges, 20 mm thick.
    let mut config = scenes::ssl(2, 0);
    config.field = Field::SSL_CHALLENGE;
    let scene = Scene::lined_up("challenge", config, Driver::STILL);
    let mut estimate = scene.start.clone();
    let robot = robots_mut(&mut estimate).next().expect("a robot");
    robot[..4].copy_from_slice(&[-2.978, 0.361, 0.0, -1.0]);
    estimate[..2].copy_from_slice(&[-2.978, 0.42]);
    let mut world = scene.world();
    world.place(&estimate, None).expect_err("in a wall");
    let (_, moved) = placed(&scene, &estimate);
    assert!(moved[0] < 0.08 && moved[1] < 0.08, "{moved:?}");
    assert!(moved[0] + moved[1] > 0.01, "{moved:?}");
    assert_eq!(moved[2], 0.0);
}

#[test]
fn any_finite_row_becomes_a_valid_state() {
    for config in configs() {
        let scene = Scene::lined_up("any", config, Driver::STILL);
        let (mut farthest, field) = (0.0_f32, &scene.config.field);
        for seed in 0..60_u64 {
            // From noise about a crowd to rows that mean nothing.
            let size = [0.05, 0.3, 1.0, 3.0, 1e6, 1e38][(seed % 6) as usize];
            let mut estimate = vec![0.0; scene.start.len()];
            for (nth, value) in estimate.iter_mut().enumerate() {
                *value = size * uniform(seed * 1000 + nth as u64);
            }
            for robot in robots_mut(&mut estimate) {
                robot[robot_column("absent")] = 0.0;
            }
            let (found, moved) = placed(&scene, &estimate);
            let pairs = positions(&estimate).into_iter().zip(positions(&found)).zip(&moved);
            for ((from, to), moved) in pairs {
                let square: f64 = from.iter().zip(to).map(|(a, b)| f64::from(a - b).powi(2)).sum();
                assert!((square.sqrt() - f64::from(*moved)).abs() <= 1e-5 * square.sqrt() + 1e-6);
            }
            if size <= 0.3 {
                farthest = moved.into_iter().fold(farthest, f32::max);
            }
        }
        assert!(farthest < field.max_x(), "{farthest} m on {}", field.name);
    }
}

#[test]
fn a_crowd_without_space_is_spread() {
    // All bodies at one point, and in a goal with space for one.
    for config in configs() {
        let scene = Scene::lined_up("point", config, Driver::STILL);
        let goal = scene.config.field.half_length() + 0.05;
        for x in [0.0, goal] {
            let mut estimate = scene.start.clone();
            estimate[..2].copy_from_slice(&[x, 0.0]);
            for robot in robots_mut(&mut estimate) {
                robot[..2].copy_from_slice(&[x, 0.0]);
            }
            let (_, moved) = placed(&scene, &estimate);
            let farthest = moved.iter().copied().fold(0.0, f32::max);
            let crowd = 0.2 * scene.config.n_robots() as f32;
            assert!(farthest < 0.2 + crowd, "{farthest} m of {} robots", moved.len() - 1);
        }
    }
}

#[test]
fn speeds_headings_and_heights_are_brought_into_their_ranges() {
    let scene = Scene::lined_up("random", scenes::ssl(2, 2), Driver::STILL);
    let mut estimate = scene.start.clone();
    estimate[ball_column("z")] = -0.02;
    estimate[ball_column("v_x")] = 30.0;
    estimate[ball_column("v_y")] = -40.0;
    let [cos, sin, v_x] = ["cos", "sin", "v_x"].map(robot_column);
    for (robot, [c, s, v]) in robots_mut(&mut estimate).zip([
        [0.6, 0.9, 0.5],
        [0.0; 3],
        [1e38, 1e38, 3e38],
        [-3.0, 0.0, 1.0],
    ]) {
        (robot[cos], robot[sin], robot[v_x]) = (c, s, v);
    }
    let (found, moved) = placed(&scene, &estimate);
    assert!(
        (moved[0] - 0.02).abs() < 1e-6 && moved[1..].iter().all(|way| *way == 0.0),
        "{moved:?}"
    );
    assert_eq!(found[ball_column("z")], 0.0);
    let close =
        |found: f32, expected: f32| assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    close(found[ball_column("v_x")], 0.6 * MAX_PLACED_SPEED);
    close(found[ball_column("v_y")], -0.8 * MAX_PLACED_SPEED);
    let length = 0.6_f32.hypot(0.9);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let expected = [
        [0.6 / length, 0.9 / length, 0.5],
        [1.0, 0.0, 0.0],
        [half, half, MAX_PLACED_SPEED],
        [-1.0, 0.0, 1.0],
    ];
    for (robot, [c, s, v]) in robots(&found).zip(expected) {
        close(robot[cos], c);
        close(robot[sin], s);
        close(robot[v_x], v);
    }
}

#[test]
fn a_ball_on_a_robot_stays_above_it_and_one_over_it_is_not_moved() {
    let mut scene = Scene::lined_up("above", scenes::ssl(1, 0), Driver::STILL);
    let at: Vec<f32> = robots(&scene.start).next().expect("a robot").to_vec();
    let height = scene.config.blue[0].height;
    let valid = scene.clone();
    scene.set_ball([at[0], at[1]], [0.0, 0.0]);
    scene.set_ball_column("z", height - 0.015);
    let (found, moved) = placed(&valid, &scene.start);
    assert!((moved[0] - 0.006).abs() < 1e-4 && moved[1] == 0.0, "{moved:?}");
    assert!((found[ball_column("z")] - (height - 0.009)).abs() < 1e-4);
    scene.set_ball_column("z", height + 0.01);
    assert_eq!(placed(&valid, &scene.start).1, [0.0, 0.0]);
}

#[test]
fn absent_robots_take_no_space_and_are_not_moved() {
    let mut scene = Scene::lined_up("absent", scenes::vss(2, 0), Driver::STILL);
    let valid = scene.clone();
    for robot in 0..2 {
        for name in ["x", "y"] {
            scene.set_robot_column(robot, name, 0.3);
        }
    }
    scene.set_robot_column(1, "absent", 1.0);
    let (found, moved) = placed(&valid, &scene.start);
    assert_eq!(moved, [0.0; 3]);
    assert_eq!(robots(&found).nth(1).expect("a robot")[robot_column("absent")], 1.0);
}

#[test]
fn what_is_not_finite_is_refused_without_a_change() {
    let scene = scenes::random_play();
    let (mut batch, mut rows) = scene.batch(2, 1);
    let (kept, before, mut moved) = (batch.snapshot(), rows.clone(), vec![9.0; 14]);
    let size = scene.start.len();
    for column in [0, BALL_COLUMNS.len(), BALL_COLUMNS.len() + ROBOT_COLUMNS.len() + 5] {
        for wrong in [f32::NAN, f32::INFINITY] {
            let mut estimate = scene.start.repeat(2);
            estimate[size + column] = wrong;
            estimate[size + 1] = 100.0;
            let error = batch.place_estimates(&[true; 2], &estimate, &mut rows, &mut moved);
            let error = error.expect_err("not finite");
            assert!(matches!(error, PlaceError::InWorld { world: 1, .. }), "{error}");
            assert!(error.to_string().contains("must be finite"), "{error}");
            assert_eq!(batch.snapshot(), kept);
            assert_eq!((&rows, &moved), (&before, &vec![9.0; 14]));
        }
    }
}

#[test]
fn a_world_keeps_its_parameters_and_threads_change_nothing() {
    let scene = Scene::lined_up("random", scenes::vss(3, 3), Driver::Random);
    let worlds = 80;
    let parameters: Vec<f32> =
        (0..worlds * parameters_size(6)).map(|nth| 1.0 + 0.2 * uniform(nth as u64)).collect();
    let size = scene.start.len();
    let mut estimates = scene.start.repeat(worlds);
    for (nth, value) in estimates.iter_mut().enumerate() {
        let column = nth % size;
        if column < 2
            || column >= BALL_COLUMNS.len()
                && (column - BALL_COLUMNS.len()) % ROBOT_COLUMNS.len() < 2
        {
            *value += 0.3 * uniform(nth as u64);
        }
    }
    let mask: Vec<bool> = (0..worlds).map(|world| world % 5 != 3).collect();
    let chosen: Vec<f32> = estimates
        .chunks_exact(size)
        .zip(&mask)
        .filter(|(_, chosen)| **chosen)
        .flat_map(|(row, _)| row.to_vec())
        .collect();
    let mut results = Vec::new();
    for threads in [1, 3] {
        let (mut batch, mut rows) = scene.batch(worlds, threads);
        batch
            .place(&vec![true; worlds], &scene.start.repeat(worlds), Some(&parameters), &mut rows)
            .expect("valid");
        let mut moved = vec![f32::NAN; chosen.len() / size * 7];
        batch.place_estimates(&mask, &chosen, &mut rows, &mut moved).expect("finite");
        assert!(moved.iter().any(|way| *way > 0.0) && moved.contains(&0.0));
        let mut restarted = scene.batch(worlds, threads).0;
        let mut valid = rows.clone();
        restarted.place(&vec![true; worlds], &rows, Some(&parameters), &mut valid).expect("valid");
        assert_eq!(valid, rows);
        let commands = scene.commands(&scene.start, 0, 0).repeat(worlds);
        for batch in [&mut batch, &mut restarted] {
            batch.step(&commands, &mut rows, None).expect("finite");
        }
        assert_eq!(batch.snapshot(), restarted.snapshot());
        results.push((batch.snapshot(), moved));
    }
    assert!(results[0] == results[1]);
}

#[test]
fn a_body_in_a_corner_of_walls_goes_to_the_space_beside_it() {
    // The shortest way out of the wall at the end of the field leads into the one at its side.
    let valid = Scene::lined_up("corner", scenes::vss(1, 1), Driver::STILL);
    let field = &valid.config.field;
    let (end, side) = (field.half_length(), field.half_width());
    for [x, y] in [[end + 0.08, side - 0.03], [-end - 0.05, side - 0.02], [end, -side]] {
        let mut estimate = valid.start.clone();
        let robot = robots_mut(&mut estimate).next().expect("a robot");
        (robot[0], robot[1]) = (x, y);
        estimate[..2].copy_from_slice(&[x, -y]);
        let (_, moved) = placed(&valid, &estimate);
        assert!(moved[0] < 0.17 && moved[1] < 0.2 && moved[2] == 0.0, "{moved:?}");
    }
}
