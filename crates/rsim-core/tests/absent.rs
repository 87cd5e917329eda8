//! Absent robots: a match is as if they did not exist, and they can leave it and come back.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{
    BALL_COLUMNS, ROBOT_COLUMNS, ball_column, parameters_size, robot_column, row_size,
};
use rsim_core::scenes::{self, Driver, Scene, ball_in_mouth, robots, robots_mut};
use rsim_core::{Drive, EngineKind, SimConfig, World};

const STEPS: u64 = 120;

/// The scene with some robots absent.
fn without(scene: &Scene, absent: &[usize]) -> Scene {
    let mut scene = scene.clone();
    for robot in absent {
        scene.set_robot_column(*robot, "absent", 1.0);
    }
    scene
}

/// A match of the other robots alone.
fn of_others(scene: &Scene, absent: &[usize]) -> Scene {
    let n_blue = scene.config.blue.len();
    let kept = |first: usize, team: &[rsim_core::RobotModel]| {
        let team = team.iter().enumerate();
        team.filter(|(index, _)| !absent.contains(&(first + index)))
            .map(|(_, model)| model.clone())
            .collect()
    };
    let config = SimConfig {
        blue: kept(0, &scene.config.blue),
        yellow: kept(n_blue, &scene.config.yellow),
        ..scene.config.clone()
    };
    Scene { config, start: row_of_others(&scene.start, absent), ..scene.clone() }
}

/// A row without the columns of some robots; `last_touch` counts the others.
fn row_of_others(row: &[f32], absent: &[usize]) -> Vec<f32> {
    let mut others = row[..BALL_COLUMNS.len()].to_vec();
    let touch = ball_column("last_touch");
    others[touch] -= absent.iter().filter(|robot| (**robot as f32) < row[touch]).count() as f32;
    for (index, columns) in robots(row).enumerate() {
        if !absent.contains(&index) {
            others.extend_from_slice(columns);
        }
    }
    others
}

fn crowds() -> [Scene; 4] {
    let crowd = |config: SimConfig| Scene::lined_up("crowd", config, Driver::Chase);
    let ssl_a = SimConfig { field: rsim_core::Field::SSL_A, ..scenes::ssl(6, 6) };
    [crowd(scenes::vss(3, 3)), scenes::crowded_kickoff(), crowd(scenes::ssl(4, 4)), crowd(ssl_a)]
}

fn row(world: &World) -> Vec<f32> {
    let mut row = vec![0.0; world.config().row_size()];
    world.write_row(&mut row);
    row
}

/// Maximum difference of two rows.
fn difference(one: &[f32], other: &[f32]) -> f32 {
    assert_eq!(one.len(), other.len());
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

#[test]
fn a_match_with_absent_robots_is_that_of_the_others() {
    for mut whole in crowds() {
        whole.config.engine = EngineKind::Compact;
        for absent in [&[5][..], &[1], &[0, 4], &[0, 1, 2]] {
            let (scene, few) = (without(&whole, absent), of_others(&whole, absent));
            let (rows, contacts) = scene.play(&mut scene.world(), STEPS);
            let (expected, as_many) = few.play(&mut few.world(), STEPS);
            let rows = rows.chunks_exact(scene.start.len());
            for (step, (row, few)) in rows.zip(expected.chunks_exact(few.start.len())).enumerate() {
                assert_eq!(row_of_others(row, absent), few, "step {step} without {absent:?}");
            }
            assert!(contacts == as_many && contacts > 0, "{contacts} {as_many}");
        }
    }
}

#[test]
fn the_reference_engine_agrees_until_rounding_grows() {
    // rapier solves contacts in the order of its own numbers of bodies.
    let mut scene = press();
    scene.config.engine = EngineKind::Rapier;
    for absent in [&[5][..], &[4], &[1], &[2, 5]] {
        let (scene, few) = (without(&scene, absent), of_others(&scene, absent));
        let (rows, contacts) = scene.play(&mut scene.world(), 12);
        let (expected, _) = few.play(&mut few.world(), 12);
        let rows = rows.chunks_exact(scene.start.len());
        for (row, few) in rows.zip(expected.chunks_exact(few.start.len())) {
            let error = difference(&row_of_others(row, absent), few);
            assert!(error < 1e-3, "{error} without {absent:?}");
        }
        assert!(contacts > 5, "{contacts}");
    }
}

#[test]
fn absent_robots_rest_beyond_the_walls_whatever_they_are_commanded() {
    for engine in EngineKind::ALL {
        for config in [scenes::vss(3, 3), scenes::ssl(3, 3)] {
            let config = SimConfig { engine, ..config };
            let (x, field) = (robot_column("x"), config.field.clone());
            let scene = without(&Scene::lined_up("random", config, Driver::Random), &[0, 2, 5]);
            let mut world = scene.world();
            let start = row(&world);
            let outside = field.max_x() + 1.0;
            for (robot, columns) in robots(&start).enumerate() {
                let expected = [0, 2, 5].contains(&robot);
                assert_eq!(columns[robot_column("absent")] == 1.0, expected);
                assert_eq!(columns[x].abs() > outside, expected);
                assert!(!expected || (columns[x] < 0.0) == (robot < 3), "behind its own goal");
            }
            let (rows, _) = scene.play(&mut world, STEPS);
            for row in rows.chunks_exact(start.len()) {
                for robot in [0, 2, 5] {
                    let [now, then] = [row, &start[..]].map(|row| robots(row).nth(robot));
                    assert_eq!(now, then, "robot {robot}");
                }
            }
            assert!(robots(&row(&world)).nth(1).expect("a robot")[robot_column("v_x")] != 0.0);
        }
    }
}

#[test]
fn an_absent_robot_neither_kicks_nor_dribbles_nor_senses_the_ball() {
    for command in [[0.0, 0.0, 0.0, 3.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 1.0]] {
        let present = ball_in_mouth(&command);
        let touched = |scene: &Scene| {
            let row = scene.after(1);
            let robot: Vec<f32> = robots(&row).flatten().copied().collect();
            let columns = ["infrared", "touched_ball"].map(|name| robot[robot_column(name)]);
            (row[ball_column("last_touch")], columns[0].max(columns[1]))
        };
        assert_eq!(touched(&present), (0.0, 1.0));
        assert_eq!(touched(&without(&present, &[0])), (-1.0, 0.0));
    }
}

#[test]
fn of_an_absent_robot_only_that_is_read() {
    let whole = Scene::lined_up("crowd", scenes::vss(3, 3), Driver::Chase);
    let scene = without(&whole, &[1]);
    let expected = row(&scene.world());
    let mut start = scene.start.clone();
    let columns = robots_mut(&mut start).nth(1).expect("a robot");
    columns[..robot_column("absent")].fill(f32::NAN);
    let mut world = whole.world();
    world.place(&start, None).expect("absent");
    assert_eq!(row(&world), expected);
    world.place(&expected, None).expect("a row that was read");
    assert_eq!(row(&world), expected);
    world.restart(&whole.start).expect("all present");
    assert_eq!(row(&world)[BALL_COLUMNS.len()..], whole.start[BALL_COLUMNS.len()..]);
    // Two robots at one place, of which one is not there.
    let [first, second] = [0, 1].map(|nth| robots(&scene.start).nth(nth).expect("a robot"));
    let mut onto = scene.start.clone();
    robots_mut(&mut onto).nth(1).expect("a robot").copy_from_slice(first);
    world.place(&onto, None).expect_err("two robots overlap");
    assert_eq!(second[robot_column("absent")], 1.0);
    for wrong in [0.5, -1.0, 2.0, f32::NAN] {
        robots_mut(&mut onto).nth(1).expect("a robot")[robot_column("absent")] = wrong;
        let error = world.place(&onto, None).expect_err("neither 0 nor 1").to_string();
        assert!(error.starts_with("`absent` of blue_1 must be 0 or 1"), "{error}");
    }
}

#[test]
fn snapshots_and_clones_keep_who_is_absent() {
    let scene = without(&Scene::lined_up("crowd", scenes::vss(3, 3), Driver::Chase), &[2, 4]);
    let (mut batch, mut rows) = scene.batch(2, 1);
    let bytes = batch.snapshot();
    let mut other = rsim_core::Batch::new(&scene.config, 2, 1).expect("valid");
    other.restore(&bytes).expect("its own");
    let mut other_rows = vec![0.0; rows.len()];
    other.read(&mut other_rows);
    assert_eq!(other_rows, rows);
    let commands = scene.commands(&scene.start, 0, 0).repeat(2);
    batch.step(&commands, &mut rows, None).expect("finite");
    other.step(&commands, &mut other_rows, None).expect("finite");
    assert_eq!(other_rows, rows);
}

/// Four SSL robots that press on each other, and two others apart from all.
fn press() -> Scene {
    let mut config = scenes::ssl(3, 3);
    config.time_step = 0.025;
    let driver = Driver::Constant(vec![vec![1.0, 0.1, 0.3, 0.0, 0.0, 0.0]; 6]);
    let mut scene = Scene::lined_up("press", config, driver);
    for robot in 0..6 {
        scene.set_robot_column(robot, "x", -3.0 + 0.19 * robot as f32);
        scene.set_robot_column(robot, "y", [1.0, 1.0, 1.0, 1.0, -2.0, -1.0][robot]);
    }
    scene.set_ball([3.0, 2.0], [0.0, 0.0]);
    scene
}

#[test]
fn a_robot_leaves_and_enters_while_all_others_continue() {
    for engine in EngineKind::ALL {
        let mut scene = press();
        scene.config.engine = engine;
        let mut stays = scene.world();
        stays.place(&scene.start, Some(&vec![1.1; parameters_size(6)])).expect("valid");
        let mut contacts = 0;
        for step in 0..30 {
            stays.step(&scene.commands(&row(&stays), step, 0)).expect("finite");
            contacts += stays.contacts();
        }
        assert!(contacts > 20, "they press on each other");
        let mut leaves = stays.clone();
        let mut changed = row(&leaves);
        let away = robots_mut(&mut changed).nth(4).expect("a robot");
        away[robot_column("absent")] = 1.0;
        let only_4 = [false, false, false, false, true, false];
        leaves.reposition_robots(&only_4, &changed).expect("absent");
        let others = |world: &World| row_of_others(&row(world), &[4]);
        let column = |world: &World, name: &str| {
            robots(&row(world)).nth(4).expect("a robot")[robot_column(name)]
        };
        for step in 30..60 {
            let error = difference(&others(&stays), &others(&leaves));
            let bound = if engine == EngineKind::Compact { 0.0 } else { 1e-3 };
            assert!(error <= bound, "{error} in step {step}");
            assert_eq!(column(&leaves, "absent"), 1.0);
            assert_eq!(column(&leaves, "v_x"), 0.0);
            for world in [&mut stays, &mut leaves] {
                world.step(&scene.commands(&row(world), step, 0)).expect("finite");
            }
        }
        let mut back = vec![f32::NAN; row_size(6)];
        let entering = robots_mut(&mut back).nth(4).expect("a robot");
        entering.fill(0.0);
        (entering[robot_column("x")], entering[robot_column("cos")]) = (2.0, 1.0);
        leaves.reposition_robots(&only_4, &back).expect("a free place");
        assert_eq!([column(&leaves, "absent"), column(&leaves, "x")], [0.0, 2.0]);
        leaves.step(&scene.commands(&row(&leaves), 60, 0)).expect("finite");
        assert!(column(&leaves, "v_x") > 0.0, "it drives again");
    }
}

#[test]
fn a_robot_that_leaves_takes_nothing_of_its_motion_along() {
    // With a limited jerk, wheels accelerate further after a command to stand still.
    let mut config = scenes::ssl(1, 0);
    let Drive::Omni(drive) = &mut config.blue[0].drive else { panic!("an omnidirectional robot") };
    drive.max_jerk = 20.0;
    let driver = Driver::Constant(vec![vec![2.0, 0.5, 3.0, 0.0, 0.0, 1.0]]);
    let mut scene = Scene::at("jerk", config, &[[0.0, 0.0, 0.0]], driver);
    scene.set_ball([0.0, 2.5], [0.0, 0.0]);
    let mut world = scene.world();
    let commands = scene.commands(&scene.start, 0, 0);
    world.step(&commands).expect("finite");
    assert!(row(&world)[BALL_COLUMNS.len() + robot_column("v_x")] > 0.0);
    let mut away = row(&world);
    robots_mut(&mut away).next().expect("a robot")[robot_column("absent")] = 1.0;
    world.reposition_robots(&[true], &away).expect("absent");
    let rest = row(&world);
    assert_eq!(rest[BALL_COLUMNS.len() + robot_column("v_x")], 0.0);
    for _ in 0..4 {
        world.step(&commands).expect("finite");
        assert_eq!(row(&world)[BALL_COLUMNS.len()..], rest[BALL_COLUMNS.len()..]);
    }
    // It enters as a new robot would.
    let mut new = scene.world();
    world.reposition_robots(&[true], &scene.start).expect("free");
    for world in [&mut new, &mut world] {
        world.step(&commands).expect("finite");
    }
    assert_eq!(row(&world)[BALL_COLUMNS.len()..], row(&new)[BALL_COLUMNS.len()..]);
}

#[test]
fn touches_and_collisions_of_a_moved_robot_are_cleared() {
    let scene = scenes::chase();
    let mut world = scene.world();
    let met = |row: &[f32], robot: usize| {
        let columns = robots(row).nth(robot).expect("a robot");
        ["touched_ball", "touched_opponent", "collision_speed"]
            .map(|name| columns[robot_column(name)])
    };
    let mut cleared = [0.0; 3];
    for (step, taken) in (0..400).zip((0..6).cycle()) {
        world.step(&scene.commands(&row(&world), step, 0)).expect("finite");
        let before = row(&world);
        let mut moved = world.clone();
        let mut out = before.clone();
        let other = (taken + 1) % 6;
        robots_mut(&mut out).nth(taken).expect("a robot")[robot_column("absent")] = 1.0;
        let mut mask = [false; 6];
        mask[taken] = true;
        moved.reposition_robots(&mask, &out).expect("absent");
        let after = row(&moved);
        assert_eq!(met(&after, taken), [0.0; 3]);
        assert_eq!(met(&after, other), met(&before, other));
        assert_eq!(after[..BALL_COLUMNS.len()], before[..BALL_COLUMNS.len()]);
        cleared = std::array::from_fn(|nth| cleared[nth] + met(&before, taken)[nth]);
    }
    assert!(cleared.iter().all(|sum| *sum > 0.0), "{cleared:?}");
}

#[test]
fn a_robot_that_cannot_be_there_changes_no_world() {
    let scene = Scene::lined_up("random", scenes::vss(3, 3), Driver::Random);
    let (mut batch, mut rows) = scene.batch(2, 1);
    let (kept, before) = (batch.snapshot(), rows.clone());
    let other: Vec<f32> = robots(&scene.start).nth(3).expect("a robot").to_vec();
    let size = ROBOT_COLUMNS.len();
    for (columns, expected) in [
        ([&other[..2], &[1.0, 0.0]].concat(), "blue_1 and yellow_0 overlap"),
        (vec![0.0, 0.0, 1.0, 0.0], "ball and blue_1 overlap"),
        (vec![0.0, 0.9, 1.0, 0.0], "blue_1 is outside"),
        (vec![0.3, 0.0, 0.5, 0.0], "the heading of blue_1"),
        (vec![f32::NAN, 0.0, 1.0, 0.0], "x of blue_1 must be finite"),
    ] {
        let mut wrong = scene.start.repeat(2);
        let at = scene.start.len() + BALL_COLUMNS.len() + size;
        wrong[at..at + columns.len()].copy_from_slice(&columns);
        let mask = [[false, true, false, false, false, false]; 2].concat();
        let error = batch
            .reposition_robots(&[true, true], &mask, &wrong, &mut rows)
            .expect_err(expected)
            .to_string();
        assert!(error.starts_with(&format!("world 1: {expected}")), "{error}");
        assert_eq!(rows, before);
        assert_eq!(batch.snapshot(), kept);
        // Robots that are not moved are not read.
        let none = [false; 12];
        batch.reposition_robots(&[true, true], &none, &wrong, &mut rows).expect("nothing moves");
        assert_eq!(batch.snapshot(), kept);
    }
}

#[test]
fn robots_that_are_moved_at_once_may_swap_places() {
    let scene = Scene::lined_up("random", scenes::vss(3, 3), Driver::Random);
    let mut world = scene.world();
    let mut swapped = scene.start.clone();
    let [first, second] =
        [0, 1].map(|nth| robots(&scene.start).nth(nth).expect("a robot").to_vec());
    for (nth, columns) in [(1, first), (0, second)] {
        robots_mut(&mut swapped).nth(nth).expect("a robot").copy_from_slice(&columns);
    }
    let mask = [true, true, false, false, false, false];
    world.reposition_robots(&mask, &swapped).expect("free");
    assert_eq!(row(&world)[BALL_COLUMNS.len()..], swapped[BALL_COLUMNS.len()..]);
}

#[test]
fn the_kicker_of_a_robot_that_enters_is_charged() {
    let scene = ball_in_mouth(&[0.0, 0.0, 0.0, 3.0, 0.0, 0.0]);
    let mut world = scene.world();
    let commands = scene.commands(&scene.start, 0, 0);
    let speed = |world: &World| row(world)[ball_column("v_x")];
    for (moved, kicks) in [(false, false), (true, true)] {
        world.restart(&scene.start).expect("valid");
        world.step(&commands).expect("finite");
        assert!(speed(&world) > 2.0, "it kicks");
        world.reposition_ball(&scene.start[..BALL_COLUMNS.len()]).expect("where it was");
        world.reposition_robots(&[moved], &scene.start).expect("where it was");
        world.step(&commands).expect("finite");
        assert_eq!(speed(&world) > 2.0, kicks);
    }
}
