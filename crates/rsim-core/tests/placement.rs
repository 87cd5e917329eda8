//! Placement: a placed row is read unchanged, and a world can have parameters of its own.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{
    BALL_COLUMNS, BALL_PARAMETERS, ROBOT_PARAMETERS, ball_column, parameters_size, robot_column,
};
use rsim_core::scenes::{
    self, Driver, Scene, ball_in_mouth, lone_ball, lone_omni, lone_robot, robots, uniform,
};
use rsim_core::{Batch, SimConfig};

/// A start in which everything moves.
fn moving(config: SimConfig) -> Scene {
    let mut scene = Scene::lined_up("moving", config, Driver::STILL);
    for (nth, name) in ["v_x", "v_y", "v_z", "spin_x", "spin_y", "spin_z"].iter().enumerate() {
        scene.set_ball_column(name, uniform(nth as u64));
    }
    scene.set_ball_column("z", 0.3);
    for robot in 0..scene.config.n_robots() {
        for (nth, name) in ["v_x", "v_y", "v_theta"].iter().enumerate() {
            scene.set_robot_column(robot, name, uniform((robot * 3 + nth) as u64));
        }
    }
    scene
}

#[test]
fn a_placed_row_is_read_unchanged_and_reading_changes_nothing() {
    for config in [scenes::vss(3, 2), scenes::ssl(2, 4)] {
        let scene = moving(config);
        let world = scene.world();
        let mut expected = scene.start.clone();
        expected[ball_column("last_touch")] = -1.0;
        for _ in 0..2 {
            let mut row = vec![f32::NAN; expected.len()];
            world.write_row(&mut row);
            assert_eq!(row, expected);
        }
    }
}

#[test]
fn the_motion_of_a_state_that_was_read_can_be_placed() {
    let scene = moving(scenes::ssl(2, 2));
    let row = scene.after(3);
    let mut world = scene.world();
    world.place(&row, None).expect("a state of a match");
    let mut read = row.clone();
    world.write_row(&mut read);
    let (motion, records) = (ball_column("last_touch"), robot_column("infrared"));
    assert_eq!(read[..motion], row[..motion]);
    for (read, row) in robots(&read).zip(robots(&row)) {
        assert_eq!(read[..records], row[..records]);
    }
}

#[test]
fn states_of_random_play_can_be_placed_again() {
    let mut flown = 0;
    for config in [scenes::ssl(4, 4), scenes::vss(3, 3)] {
        let mut scene = Scene::lined_up("play", config, Driver::Random);
        scene.set_ball([0.0, 0.0], [0.5, 0.3]);
        scene.set_ball_column("v_z", 3.0);
        let (rows, _) = scene.play(&mut scene.world(), 2000);
        let mut world = scene.world();
        for row in rows.chunks_exact(scene.config.row_size()) {
            world.place(row, None).expect("a state of a running match");
            flown += u32::from(row[ball_column("z")] > 0.0);
        }
    }
    assert!(flown > 40, "only {flown} states with the ball in the air");
}

#[test]
fn a_ball_on_an_edge_can_be_placed() {
    for (config, place, z) in
        [(scenes::vss(0, 0), [0.5, 0.647], 0.049_99), (scenes::ssl(0, 0), [4.5, 0.2], 0.179_9)]
    {
        let mut scene = lone_ball(config, place, [0.0, 0.0]);
        scene.set_ball_column("z", z);
        let mut world = lone_ball(scene.config.clone(), [0.0, 0.0], [0.0, 0.0]).world();
        world.place(&scene.start, None).expect("it is above the edge");
    }
}

/// Factors of one robot and the ball, all 1 except one.
fn one_changed(of_ball: bool, name: &str, factor: f32) -> Vec<f32> {
    let mut parameters = vec![1.0; parameters_size(1)];
    let place = |names: &[&str]| names.iter().position(|known| *known == name).expect("a name");
    let at = if of_ball {
        place(&BALL_PARAMETERS)
    } else {
        BALL_PARAMETERS.len() + place(&ROBOT_PARAMETERS)
    };
    parameters[at] = factor;
    parameters
}

fn with(mut scene: Scene, parameters: Vec<f32>) -> Scene {
    scene.parameters = Some(parameters);
    scene
}

#[test]
fn parameters_of_one_are_the_models_bit_for_bit() {
    let scene = ball_in_mouth(&[1.0, 0.5, 2.0, 0.0, 0.0, 1.0]);
    let plain = scene.play(&mut scene.world(), 60).0;
    let scene = with(scene, vec![1.0; parameters_size(1)]);
    assert!(scene.play(&mut scene.world(), 60).0 == plain);
}

#[test]
fn every_parameter_has_its_effect() {
    let v_x = ball_column("v_x");
    let robot_at = |row: &[f32]| robots(row).next().expect("a robot").to_vec();

    let rolling = |name: &str, factor: f32| {
        let mut scene = Scene::lined_up("roll", scenes::ssl(1, 0), Driver::STILL);
        scene.set_ball([0.0, 1.0], [2.0, 0.0]);
        with(scene, one_changed(true, name, factor)).after(5)[v_x]
    };
    let slid = |factor: f32| 2.0 - rolling("sliding_deceleration", factor);
    assert!((slid(1.5) / slid(1.0) - 1.5).abs() < 0.01);
    let mut rolled = Scene::lined_up("roll", scenes::ssl(1, 0), Driver::STILL);
    rolled.set_ball([0.0, 1.0], [2.0, 0.0]);
    rolled.set_ball_column("spin_y", 2.0 / 0.0215);
    let lost = |factor: f32| {
        2.0 - with(rolled.clone(), one_changed(true, "rolling_deceleration", factor)).after(8)[v_x]
    };
    assert!((lost(2.0) / lost(1.0) - 2.0).abs() < 0.01);

    let at_wall = |name: &str, factor: f32| {
        let mut scene = Scene::lined_up("wall", scenes::ssl(1, 0), Driver::STILL);
        scene.set_ball([1.0, 3.2], [3.0, 3.0]);
        with(scene, one_changed(true, name, factor)).after(2)
    };
    let back = |factor: f32| -at_wall("wall_restitution", factor)[v_x + 1];
    assert!((back(1.5) / back(1.0) - 1.5).abs() < 0.05);
    let along = |factor: f32| at_wall("wall_friction", factor)[v_x];
    assert!(along(0.0) > along(0.5) && along(0.5) > along(1.0), "friction along the wall");

    let at_robot = |name: &str, factor: f32| {
        let mut scene = Scene::at("hit", scenes::ssl(1, 0), &[[0.0, 0.0, 0.0]], Driver::STILL);
        scene.set_ball([0.02, 0.2], [0.0, -3.0]);
        with(scene, one_changed(true, name, factor)).after(2)
    };
    let back = |factor: f32| at_robot("robot_restitution", factor)[v_x + 1];
    assert!(back(1.5) > back(1.0) + 0.3, "{} {}", back(1.5), back(1.0));
    let spin = |factor: f32| at_robot("robot_friction", factor)[ball_column("spin_z")].abs();
    assert!(spin(0.1) < spin(1.0) && spin(0.0) < 1e-3);
    let pushed = |factor: f32| robot_at(&at_robot("mass", factor))[1];
    assert!(pushed(2.0) < 1.5 * pushed(1.0), "a heavy ball pushes it farther");

    let mut chip = Scene::lined_up("chip", scenes::ssl(1, 0), Driver::STILL);
    chip.set_ball([0.0, 1.0], [2.0, 0.0]);
    chip.set_ball_column("v_z", 3.0);
    let hop = |factor: f32| {
        with(chip.clone(), one_changed(true, "hop", factor)).after(30)[ball_column("z")]
    };
    assert!(hop(1.5) > hop(1.0) && hop(0.0) == 0.0, "{} {}", hop(1.5), hop(1.0));

    let driven = |name: &str, factor: f32, steps: u64| {
        let scene = with(lone_omni(&[9.0, 0.0, 0.0]), one_changed(false, name, factor));
        robot_at(&scene.after(steps))[robot_column("v_x")]
    };
    assert!((driven("speed", 0.5, 60) / driven("speed", 1.0, 60) - 0.5).abs() < 0.01);
    assert!((driven("acceleration", 0.5, 8) / driven("acceleration", 1.0, 8) - 0.5).abs() < 0.01);
    assert!((driven("traction", 0.34, 8) / driven("traction", 1.0, 8) - 0.5).abs() < 0.01);

    let vss = |name: &str, factor: f32| {
        let scene = lone_robot([46.0, 46.0]);
        robot_at(&with(scene, one_changed(false, name, factor)).after(4))[robot_column("v_x")]
    };
    for factor in [0.5, 1.5] {
        assert!((vss("acceleration", factor) / vss("acceleration", 1.0) - factor).abs() < 0.01);
    }

    let kick = |name: &str, factor: f32| {
        let scene = ball_in_mouth(&[0.0, 0.0, 0.0, 4.0, 0.0, 0.0]);
        with(scene, one_changed(false, name, factor)).after(1)
    };
    assert!(((kick("kick", 0.8)[v_x]) / kick("kick", 1.0)[v_x] - 0.8).abs() < 0.01);
    let recoil = |factor: f32| {
        // Within one tick: later the wheels correct the recoil.
        let mut scene = ball_in_mouth(&[0.0, 0.0, 0.0, 8.0, 0.0, 0.0]);
        scene.config.time_step = scene.config.tick;
        robot_at(&with(scene, one_changed(false, "mass", factor)).after(1))[0].abs()
    };
    assert!(recoil(2.0) < recoil(1.0), "a heavier robot moves less");

    let held = |factor: f32| {
        let scene = ball_in_mouth(&[0.0, 0.0, 4.8, 0.0, 0.0, 1.0]);
        robot_at(&with(scene, one_changed(false, "grip", factor)).after(60))
            [robot_column("infrared")]
    };
    assert_eq!([held(1.0), held(0.3)], [1.0, 0.0]);

    let flown = |factor: f32| {
        let poses = [[0.6, 0.0, 180.0]];
        let mut scene = Scene::at("over", scenes::ssl(1, 0), &poses, Driver::STILL);
        scene.set_ball([0.0, 0.0], [3.0, 0.0]);
        scene.set_ball_column("v_z", 2.2);
        with(scene, one_changed(false, "height", factor)).after(12)[0]
    };
    assert!(flown(1.0) > 0.7 && flown(3.0) < 0.6, "{} {}", flown(1.0), flown(3.0));
}

#[test]
fn parameters_are_one_worlds_own_and_end_with_the_match() {
    let scene = lone_omni(&[1.0, 0.0, 0.0]);
    let slow = one_changed(false, "acceleration", 0.25);
    let (size, commands) = (scene.config.row_size(), scene.commands(&scene.start, 0, 0));
    let mut batch = Batch::new(&scene.config, 2, 1).expect("valid");
    let mut rows = vec![0.0; 2 * size];
    let parameters = [vec![1.0; slow.len()], slow].concat();
    let starts = scene.start.repeat(2);
    batch.place(&[true, true], &starts, Some(&parameters), &mut rows).expect("valid");
    let x = BALL_COLUMNS.len();
    let step = |batch: &mut Batch, rows: &mut [f32]| {
        for _ in 0..4 {
            batch.step(&commands.repeat(2), rows, None).expect("finite");
        }
        [rows[x], rows[size + x]]
    };
    let [fast, slow] = step(&mut batch, &mut rows);
    assert!((slow / fast - 0.25).abs() < 0.01, "{fast} {slow}");
    // A snapshot keeps the factors; a new match without factors has those of the models.
    let bytes = batch.snapshot();
    let mut other = Batch::new(&scene.config, 2, 1).expect("valid");
    other.restore(&bytes).expect("its own");
    let mut other_rows = rows.clone();
    assert_eq!(step(&mut other, &mut other_rows), step(&mut batch, &mut rows));
    batch.place(&[false, true], &scene.start, None, &mut rows).expect("valid");
    assert_eq!(step(&mut batch, &mut rows)[1], fast);
}

#[test]
fn impossible_parameters_are_refused_by_name() {
    let scene = lone_ball(scenes::ssl(0, 0), [0.0, 0.0], [0.0, 0.0]);
    for (name, factor) in [("mass", 0.0), ("mass", f32::NAN), ("hop", -0.5)] {
        let mut parameters = vec![1.0; BALL_PARAMETERS.len()];
        parameters[BALL_PARAMETERS.iter().position(|known| *known == name).expect("known")] =
            factor;
        let error = scene.world().place(&scene.start, Some(&parameters)).expect_err("refused");
        assert!(error.to_string().contains(name), "{error}");
    }
}
