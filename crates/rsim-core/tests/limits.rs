//! Finite but absurd numbers: refused in starts by the name of the column, clipped in commands.

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, parameters_size, robot_column};
use rsim_core::scenes;
use rsim_core::{
    BallModel, Field, MAX_PLACED_ANGULAR_VELOCITY, MAX_PLACED_HEIGHT, MAX_PLACED_SPEED,
    MAX_PLACED_SPIN, PlaceError, RobotModel, World,
};

#[test]
fn absurd_numbers_of_a_start_are_refused_by_their_column() {
    let scene = scenes::random_play();
    let mut world = scene.world();
    let before = scene.play(&mut world.clone(), 3).0;
    let of_ball = BALL_COLUMNS[..9].iter().map(|name| (ball_column(name), *name));
    let robot = BALL_COLUMNS.len() + ROBOT_COLUMNS.len();
    let of_robot = ROBOT_COLUMNS[..7].iter().map(|name| (robot + robot_column(name), *name));
    for (column, name) in of_ball.chain(of_robot) {
        for value in [1e3, 1e5, 1e20, 1e38, f32::MAX, f32::INFINITY, f32::NAN] {
            for value in [value, -value] {
                // A golf ball spins at 1000 rad/s.
                if value.abs() <= 1e3 && name.starts_with("spin") {
                    continue;
                }
                let mut row = scene.start.clone();
                row[column] = value;
                let error = world.place(&row, None).expect_err(name).to_string();
                let body = if column < robot { "ball" } else { "blue_1" };
                let place = matches!(name, "x" | "y") && value.is_finite();
                let named = if place { "outside" } else { name };
                assert!(error.contains(body) && error.contains(named), "{name} {value}: {error}");
            }
        }
    }
    assert_eq!(scene.play(&mut world, 3).0, before, "nothing has changed");
}

#[test]
fn starts_at_the_limits_are_played_and_those_beyond_are_refused() {
    for mut scene in [scenes::random_play(), scenes::ssl_random(scenes::ssl(2, 2))] {
        for sign in [1.0, -1.0] {
            scene.set_robot_column(0, "v_theta", sign * MAX_PLACED_ANGULAR_VELOCITY);
            scene.set_robot_column(1, "v_x", sign * MAX_PLACED_SPEED);
            scene.set_ball_column("z", MAX_PLACED_HEIGHT);
            scene.set_ball_column("v_z", -MAX_PLACED_SPEED);
            scene.set_ball_column("spin_x", sign * MAX_PLACED_SPIN);
            let (rows, _) = scene.play(&mut scene.world(), 400);
            assert!(rows.iter().all(|value| value.is_finite()));
        }
        for (name, limit) in
            [("z", MAX_PLACED_HEIGHT), ("v_z", MAX_PLACED_SPEED), ("spin_y", MAX_PLACED_SPIN)]
        {
            let mut beyond = scene.clone();
            (beyond.start[ball_column("spin_x")], beyond.start[ball_column("v_z")]) = (0.0, 0.0);
            beyond.set_ball_column(name, 1.001 * limit);
            let error = scene.world().place(&beyond.start, None).expect_err(name).to_string();
            assert!(error.contains(name) && error.contains(&format!("{limit}")), "{error}");
        }
        let mut beyond = scene.clone();
        beyond.set_robot_column(0, "v_theta", -1.001 * MAX_PLACED_ANGULAR_VELOCITY);
        let error = scene.world().place(&beyond.start, None).expect_err("it turns").to_string();
        assert!(error.contains("blue_0 turns at -200.2") && error.contains("200 rad/s"), "{error}");
    }
}

#[test]
fn a_repositioned_ball_has_the_limits_of_a_placed_one() {
    let scene = scenes::random_play();
    let mut world = scene.world();
    for (name, value) in [("z", 1e30), ("v_z", -1e38), ("spin_z", 1e38), ("v_x", f32::NAN)] {
        let mut ball = scene.start[..BALL_COLUMNS.len()].to_vec();
        ball[ball_column(name)] = value;
        let error = world.reposition_ball(&ball).expect_err(name).to_string();
        assert!(error.contains("ball") && error.contains(name), "{error}");
    }
}

#[test]
fn absurd_parameters_are_refused() {
    let scene = scenes::random_play();
    let size = parameters_size(scene.config.n_robots());
    for nth in 0..size {
        for wrong in [1e30, 1001.0, -1.0, f32::NAN, f32::INFINITY] {
            let mut parameters = vec![1.0; size];
            parameters[nth] = wrong;
            let error = scene.world().place(&scene.start, Some(&parameters)).expect_err("refused");
            assert!(matches!(error, PlaceError::Parameters(_)), "{nth} {wrong}: {error}");
        }
    }
    let mut parameters = vec![1.0; size];
    parameters[0] = 1e-30;
    let error = scene.world().place(&scene.start, Some(&parameters)).expect_err("refused");
    assert!(error.to_string().contains("mass must be a factor from 0.001 to 1000"), "{error}");
}

#[test]
fn commands_of_any_size_are_clipped_and_lose_no_world() {
    let wheels = RobotModel::SSL_GENERIC_WHEELS;
    let by_wheels = scenes::config(Field::SSL_B, BallModel::SSL_TIGERS, &wheels, 2, 2);
    for config in [scenes::vss(3, 3), scenes::ssl(2, 2), by_wheels] {
        let mut world = World::new(&config).expect("valid");
        let mut row = vec![0.0; config.row_size()];
        for step in 0..100_usize {
            let sizes = [f32::MAX, -f32::MAX, 1e38, -1e20, f32::MIN_POSITIVE, 0.0, 1e30];
            let commands: Vec<f32> =
                (0..config.command_size()).map(|nth| sizes[(nth * 5 + step / 10) % 7]).collect();
            world.step(&commands).expect("the state stays finite");
            world.write_row(&mut row);
            assert!(row.iter().all(|value| value.is_finite() && value.abs() < 1e3), "{row:?}");
        }
    }
}
