//! Repositioning of the ball: everything else of the match continues.
#![allow(clippy::float_cmp)] // equal results are exact

use rsim_core::columns::{
    BALL_COLUMNS, BALL_PARAMETERS, ROBOT_PARAMETERS, ball_column, parameters_size, robot_column,
};
use rsim_core::scenes::{self, Driver, Scene, ball_in_mouth, robots};
use rsim_core::{PlaceError, World};

const SIZE: usize = BALL_COLUMNS.len();
const KICK: [f32; 6] = [0.0, 0.0, 0.0, 3.0, 0.0, 0.0];

fn ball(x: f32, y: f32, v_x: f32) -> Vec<f32> {
    let mut ball = vec![0.0; SIZE];
    [ball[0], ball[1], ball[ball_column("v_x")]] = [x, y, v_x];
    ball
}

fn row(world: &World) -> Vec<f32> {
    let mut row = vec![0.0; world.config().row_size()];
    world.write_row(&mut row);
    row
}

#[test]
fn robots_continue_unchanged() {
    // Robots that drive, slip and push each other, far from the ball, in a world of its own.
    let mut config = scenes::ssl(3, 3);
    config.time_step = 0.025;
    let driver = Driver::Constant(vec![vec![1.0, 0.1, 0.3, 0.0, 0.0, 0.0]; 6]);
    let mut scene = Scene::lined_up("press", config, driver);
    for robot in 0..6 {
        scene.set_robot_column(robot, "x", -3.0 + 0.19 * robot as f32);
        scene.set_robot_column(robot, "y", 1.0);
    }
    scene.set_ball([3.0, -2.0], [0.0, 0.0]);
    let parameters = vec![1.1; parameters_size(6)];
    let mut left = scene.world();
    left.place(&scene.start, Some(&parameters)).expect("valid");
    let mut contacts = 0;
    for step in 0..40 {
        left.step(&scene.commands(&row(&left), step, 0)).expect("finite");
        contacts += left.contacts();
    }
    assert!(contacts > 20, "they press on each other");
    let mut moved = left.clone();
    moved.reposition_ball(&ball(3.0, 2.0, 0.5)).expect("free");
    for step in 40..80 {
        assert_eq!(row(&left)[SIZE..], row(&moved)[SIZE..], "step {step}");
        let commands = scene.commands(&row(&left), step, 0);
        left.step(&commands).expect("finite");
        moved.step(&commands).expect("finite");
    }
    assert_ne!(row(&left)[..SIZE], row(&moved)[..SIZE]);
}

#[test]
fn the_ball_is_at_its_new_place_without_a_last_touch() {
    let scene = ball_in_mouth(&KICK);
    let mut world = scene.world();
    for _ in 0..2 {
        world.step(&scene.commands(&row(&world), 0, 0)).expect("finite");
    }
    assert_eq!(row(&world)[ball_column("last_touch")], 0.0, "it was kicked");
    let mut wanted = ball(-1.0, 0.5, 1.0);
    wanted[ball_column("z")] = 0.2;
    wanted[ball_column("spin_y")] = 3.0;
    world.reposition_ball(&wanted).expect("free");
    let found = row(&world);
    wanted[ball_column("last_touch")] = -1.0;
    assert_eq!(found[..SIZE], wanted[..]);
    let infrared = robots(&found).map(|robot| robot[robot_column("infrared")]);
    assert!(infrared.into_iter().all(|beam| beam == 0.0));
}

#[test]
fn a_recharging_kicker_keeps_recharging() {
    let scene = ball_in_mouth(&KICK);
    let speed = |row: &[f32]| row[ball_column("v_x")].hypot(row[ball_column("v_y")]);
    let mut world = scene.world();
    let commands = scene.commands(&scene.start, 0, 0);
    world.step(&commands).expect("finite");
    assert!(speed(&row(&world)) > 2.0, "it kicks");
    let before_the_mouth = &scene.start[..SIZE];
    world.reposition_ball(before_the_mouth).expect("where it was");
    world.step(&commands).expect("finite");
    assert!(speed(&row(&world)) < 0.1, "it has just kicked");
    world.place(&scene.start, None).expect("valid");
    world.step(&commands).expect("finite");
    assert!(speed(&row(&world)) > 2.0, "placed anew it is charged");
}

#[test]
fn a_ball_that_cannot_be_there_changes_no_world() {
    let scene = scenes::random_play();
    let (mut batch, mut rows) = scene.batch(3, 1);
    let commands = scene.commands(&scene.start, 0, 0).repeat(3);
    batch.step(&commands, &mut rows, None).expect("finite");
    let (before, kept) = (rows.clone(), batch.snapshot());
    let size = scene.start.len();
    let at = robots(&rows[2 * size..]).next().expect("a robot").to_vec();
    let mut nan = ball(0.0, 0.0, 0.0);
    nan[ball_column("spin_z")] = f32::NAN;
    let mut low = ball(0.0, 0.0, 0.0);
    low[ball_column("z")] = -0.01;
    for (wrong, expected) in [
        (ball(at[0], at[1], 0.0), "overlap"),
        (ball(0.745, 0.3, 0.0), "outside"),
        (ball(9.0, 0.0, 0.0), "outside"),
        (ball(0.0, 0.0, 30.0), "ball moves at"),
        (nan, "must be finite"),
        (low, "below the floor"),
    ] {
        let balls = [ball(0.05, 0.0, 0.0), wrong].concat();
        let error =
            batch.reposition_balls(&[true, false, true], &balls, &mut rows).expect_err(expected);
        assert!(matches!(error, PlaceError::InWorld { world: 2, .. }), "{error}");
        assert!(error.to_string().contains(expected), "{error} should say {expected}");
        assert_eq!(rows, before);
        assert_eq!(batch.snapshot(), kept);
    }
    let balls = [ball(0.0, 0.05, 0.0), ball(0.05, 0.0, 0.0)].concat();
    batch.reposition_balls(&[true, false, true], &balls, &mut rows).expect("free");
    assert_eq!(rows[size..2 * size], before[size..2 * size]);
    assert_eq!([rows[1], rows[2 * size]], [0.05, 0.05]);
}

#[test]
fn a_worlds_own_height_of_robots_is_used() {
    let scene = scenes::ssl_random(scenes::ssl(1, 0));
    let mut world = scene.world();
    let mut parameters = vec![1.0; parameters_size(1)];
    let height = BALL_PARAMETERS.len()
        + ROBOT_PARAMETERS.iter().position(|name| *name == "height").expect("a parameter");
    parameters[height] = 0.5;
    world.place(&scene.start, Some(&parameters)).expect("valid");
    let robot = robots(&scene.start).next().expect("a robot");
    let mut above = ball(robot[0], robot[1], 0.0);
    above[ball_column("z")] = 0.1;
    world.reposition_ball(&above).expect("over a low robot");
    assert!(scene.world().reposition_ball(&above).is_err(), "but not over one of full height");
}
