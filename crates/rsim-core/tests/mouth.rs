//! Break beam, kicker and dribbler, with a ball in a robot's mouth.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::RobotModel;
use rsim_core::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS, ball_column, robot_column};
use rsim_core::scenes::{self, Driver, Scene, ball_in_mouth, lone_omni, robots, steps};

const DRIBBLE: [f32; 3] = [0.0, 0.0, 1.0];

/// A command: velocity of the body, and the dribbler on.
fn dribbling(body: [f32; 3]) -> Vec<f32> {
    [body, DRIBBLE].concat()
}

fn robot(row: &[f32], index: usize) -> &[f32] {
    robots(row).nth(index).expect("a robot")
}

/// Gap between the robot's front and the ball's surface, m.
fn gap(scene: &Scene, row: &[f32], index: usize) -> f32 {
    let (model, robot) = (&scene.config.blue[0], robot(row, index));
    let (x, y) = (row[0] - robot[0], row[1] - robot[1]);
    x * robot[2] + y * robot[3] - model.front_distance() - scene.config.ball.radius
}

/// Whether the ball cuts the beam after each step.
fn beam_cut(scene: &Scene, steps: u64) -> Vec<bool> {
    let (rows, _) = scene.play(&mut scene.world(), steps);
    let infrared = robot_column("infrared");
    rows.chunks_exact(scene.config.row_size()).map(|row| robot(row, 0)[infrared] == 1.0).collect()
}

#[test]
fn a_kick_has_the_commanded_speed_in_the_robots_direction() {
    for degrees in [0.0_f32, 50.0, 180.0, 290.0] {
        for speed in [1.0, 4.0, 6.5] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut scene = ball_in_mouth(&[0.0, 0.0, 0.0, speed, 0.0, 0.0]);
            scene.config.time_step = scene.config.tick;
            scene.set_robot_column(0, "cos", cos);
            scene.set_robot_column(0, "sin", sin);
            let away = scene.config.blue[0].front_distance() + scene.config.ball.radius;
            scene.set_ball([away * cos, away * sin], [0.0, 0.0]);
            let row = scene.after(1);
            let (v_x, v_y) = (row[ball_column("v_x")], row[ball_column("v_y")]);
            let (along, across) = (v_x * cos + v_y * sin, v_y * cos - v_x * sin);
            assert!((along / speed - 1.0).abs() < 0.02, "{speed} m/s at {degrees}: {along}");
            assert!(across.abs() < 0.02 * speed);
            assert_eq!(row[ball_column("last_touch")], 0.0);
            assert_eq!(robot(&row, 0)[robot_column("touched_ball")], 1.0);
        }
    }
}

#[test]
fn the_devices_limits_hold() {
    for (command, most) in [([20.0, 0.0], 8.0_f32), ([20.0, 20.0], 8.0)] {
        let mut scene = ball_in_mouth(&[0.0, 0.0, 0.0, command[0], command[1], 0.0]);
        scene.config.time_step = scene.config.tick;
        let row = scene.after(1);
        let speed = row[ball_column("v_x")].hypot(row[ball_column("v_z")]);
        assert!((speed / most - 1.0).abs() < 0.02, "{command:?}: {speed}");
    }
}

#[test]
fn there_is_no_kick_without_the_ball_in_the_mouth() {
    let kick = [0.0, 0.0, 0.0, 5.0, 0.0, 0.0];
    let front = 0.0715 + 0.0215;
    for place in [[front + 0.012, 0.0], [front, 0.034], [-0.12, 0.0], [0.0, 0.12]] {
        let mut scene = lone_omni(&kick);
        scene.set_ball(place, [0.0, 0.0]);
        let row = scene.after(2);
        assert_eq!(row[ball_column("v_x")], 0.0, "ball at {place:?}");
        assert_eq!(row[ball_column("last_touch")], -1.0);
    }
}

#[test]
fn a_kicker_of_short_reach_waits_until_the_ball_touches() {
    let kick = [0.0, 0.0, 0.0, 5.0, 0.0, 0.0];
    for (gap, reach, kicks) in [(0.005, 0.05, true), (0.005, 0.001, false), (0.0, 0.001, true)] {
        let mut scene = lone_omni(&kick);
        scene.config.blue[0].mouth.as_mut().expect("a mouth").kicker_reach = reach;
        scene.set_ball([0.0715 + 0.0215 + gap, 0.0], [0.0, 0.0]);
        let row = scene.after(2);
        assert_eq!(row[ball_column("v_x")] > 4.0, kicks, "gap {gap}, reach {reach}");
        assert_eq!(row[ball_column("last_touch")] == 0.0, kicks, "gap {gap}, reach {reach}");
    }
}

#[test]
fn a_kicker_that_is_not_charged_waits() {
    // The back of a goal right in front of the mouth returns the ball before the kicker is charged.
    let mut scene = ball_in_mouth(&[0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
    scene.config.time_step = scene.config.tick;
    let (recharge, tick) =
        (scene.config.blue[0].mouth.expect("a mouth").kicker_recharge_time, scene.config.tick);
    scene.set_robot_column(0, "x", 4.52);
    scene.set_ball([4.52 + 0.0715 + 0.0215, 0.0], [0.0, 0.0]);
    let (rows, _) = scene.play(&mut scene.world(), 120);
    let v_x = ball_column("v_x");
    let speeds: Vec<f32> = rows.chunks_exact(scene.config.row_size()).map(|row| row[v_x]).collect();
    let kicked = |speed: &f32| *speed > 4.0;
    let kicks: Vec<usize> = speeds
        .windows(2)
        .enumerate()
        .filter(|(_, pair)| kicked(&pair[1]) && !kicked(&pair[0]))
        .map(|(step, _)| step)
        .collect();
    assert!(!kicks.is_empty(), "it kicks again when it is charged: {speeds:?}");
    for pair in kicks.windows(2) {
        assert!((pair[1] - pair[0]) as f32 * tick >= recharge - 1e-4, "kicks at {kicks:?}");
    }
    // The first kick was in the first tick.
    assert!((kicks[0] + 1) as f32 * tick >= recharge - 1e-4, "kicks at {kicks:?}");
}

#[test]
fn the_dribbler_holds_the_ball_in_turns_and_backwards_and_forwards() {
    for (what, body) in [
        ("turning", [0.0, 0.0, 3.0]),
        ("turning the other way", [0.0, 0.0, -3.0]),
        ("backwards", [-0.5, 0.0, 0.0]),
        ("forwards", [1.0, 0.0, 0.0]),
        ("sideways", [0.0, 0.5, 0.0]),
    ] {
        let scene = ball_in_mouth(&dribbling(body));
        let cut = beam_cut(&scene, 80);
        assert!(cut.iter().all(|cut| *cut), "{what}: {cut:?}");
        let row = scene.after(80);
        assert!(gap(&scene, &row, 0).abs() < 5e-3, "{what}: {} m", gap(&scene, &row, 0));
    }
}

#[test]
fn without_the_dribbler_those_moves_lose_the_ball() {
    for body in [[0.0, 0.0, 3.0], [-0.5, 0.0, 0.0]] {
        let cut = beam_cut(&ball_in_mouth(&body), 80);
        assert!(!cut[79], "{body:?}");
    }
}

#[test]
fn beyond_the_grip_the_ball_is_lost() {
    // 0.12 N hold 46 g in a circle of 93 mm up to 5.3 rad/s; TIGERs turn with the ball at up to 5.
    assert!(beam_cut(&ball_in_mouth(&dribbling([0.0, 0.0, 4.8])), 80)[79]);
    assert!(!beam_cut(&ball_in_mouth(&dribbling([0.0, 0.0, 8.0])), 80)[79]);
}

#[test]
fn the_dribbler_gives_back_spin() {
    let row = ball_in_mouth(&dribbling([0.0, 0.0, 0.0])).after(40);
    let rim = row[ball_column("spin_y")] * 0.0215;
    assert!((rim + 2.0).abs() < 0.1, "the bar's 2 m/s backwards: {rim}");
}

#[test]
fn off_releases_within_a_tick() {
    // From the tick after, only the floor acts.
    let mut scene = ball_in_mouth(&dribbling([0.0, 0.0, 4.8]));
    scene.config.time_step = scene.config.tick;
    let mut world = scene.world();
    let mut row = scene.play(&mut world, 200).0;
    row = row[row.len() - scene.config.row_size()..].to_vec();
    let off = [0.0, 0.0, 4.8, 0.0, 0.0, 0.0];
    let [v_x, v_y] = ["v_x", "v_y"].map(ball_column);
    let mut velocities = vec![[row[v_x], row[v_y]]];
    for _ in 0..3 {
        world.step(&off).expect("finite");
        world.write_row(&mut row);
        velocities.push([row[v_x], row[v_y]]);
    }
    let floor = scene.config.ball.sliding_deceleration * scene.config.tick;
    for pair in velocities.windows(2) {
        let change = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]);
        assert!(change <= floor * 1.05, "only the floor acts: {change} m/s in a tick");
    }
    let apart = scene.config.time_step;
    for _ in 0..steps(1.0, apart) {
        world.step(&off).expect("finite");
    }
    world.write_row(&mut row);
    assert_eq!(robot(&row, 0)[robot_column("infrared")], 0.0, "and it is out of the mouth");
}

#[test]
fn holding_the_ball_does_not_slow_the_robot() {
    for body in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
        let with = ball_in_mouth(&dribbling(body));
        let mut without = with.clone();
        without.set_ball([0.0, 2.5], [0.0, 0.0]);
        let way = |scene: &Scene| {
            let row = scene.after(60);
            robot(&row, 0)[0].hypot(robot(&row, 0)[1])
        };
        let (with, without) = (way(&with), way(&without));
        assert!((with / without - 1.0).abs() < 0.05, "{body:?}: {with} m, {without} m without");
    }
}

#[test]
fn a_free_ball_is_pulled_away_by_a_dribbler() {
    let front = RobotModel::SSL_GENERIC.front_distance() + 0.0215;
    let poses = [[0.0, 0.0, 0.0], [2.0 * front, 0.0, 180.0]];
    let commands = vec![vec![0.0; 6], dribbling([-0.3, 0.0, 0.0])];
    let mut scene = Scene::at("pull", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
    scene.set_ball([front, 0.0], [0.0, 0.0]);
    let row = scene.after(60);
    assert_eq!(robot(&row, 1)[robot_column("infrared")], 1.0, "yellow has it: {row:?}");
}

#[test]
fn another_robot_can_knock_the_ball_off_a_running_dribbler() {
    // The robot comes from the side and drives through the ball's position.
    let front = RobotModel::SSL_GENERIC.front_distance() + 0.0215;
    for speed in [0.5, 1.0, 2.0] {
        let poses = [[0.0, 0.0, 0.0], [front, 0.17, -90.0]];
        let commands = vec![dribbling([0.0; 3]), dribbling([speed, 0.0, 0.0])];
        let mut scene = Scene::at("steal", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
        scene.set_ball([front, 0.0], [0.0, 0.0]);
        let row = scene.after(60);
        assert_eq!(robot(&row, 0)[robot_column("infrared")], 0.0, "{speed} m/s: {row:?}");
    }
}

#[test]
fn another_robot_can_take_the_ball_off_a_running_dribbler_into_its_own() {
    // Front to front, both dribbling; one turns away with the ball between the two bars.
    let front = RobotModel::SSL_GENERIC.front_distance() + 0.0215;
    let poses = [[0.0, 0.0, 0.0], [2.0 * front, 0.0, 180.0]];
    let commands = vec![dribbling([0.0; 3]), dribbling([-0.5, 0.0, 0.0])];
    let mut scene = Scene::at("steal", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
    scene.set_ball([front, 0.0], [0.0, 0.0]);
    // A robot with half the grip loses the ball to one that backs off gently.
    let mut parameters = vec![1.0; scene.config.parameters_size()];
    let place = |name: &str| ROBOT_PARAMETERS.iter().position(|known| *known == name);
    parameters[BALL_PARAMETERS.len() + place("grip").expect("known")] = 0.5;
    let thief = BALL_PARAMETERS.len() + ROBOT_PARAMETERS.len();
    parameters[thief + place("acceleration").expect("known")] = 0.1;
    scene.parameters = Some(parameters);
    let row = scene.after(80);
    assert_eq!(robot(&row, 1)[robot_column("infrared")], 1.0, "yellow has it: {row:?}");
    assert_eq!(robot(&row, 0)[robot_column("infrared")], 0.0);
}

#[test]
fn a_robot_that_brakes_hardest_loses_the_dribbled_ball() {
    // From 3 to -3 m/s no real dribbler keeps the ball; with gentle braking it does.
    for (share, kept) in [(1.0, 0.0), (0.2, 1.0)] {
        let mut scene = ball_in_mouth(&dribbling([-3.0, 0.0, 0.0]));
        let speed = if share < 1.0 { 1.0 } else { 3.0 };
        scene.set_robot_column(0, "v_x", speed);
        scene.set_ball_column("v_x", speed);
        scene.set_ball_column("spin_y", -2.0 / scene.config.ball.radius);
        let mut parameters = vec![1.0; scene.config.parameters_size()];
        let place = ROBOT_PARAMETERS.iter().position(|known| *known == "acceleration");
        parameters[BALL_PARAMETERS.len() + place.expect("known")] = share;
        scene.parameters = Some(parameters);
        let row = scene.after(32);
        assert_eq!(robot(&row, 0)[robot_column("infrared")], kept, "{share}: {row:?}");
    }
}

#[test]
fn two_opposed_kicks_at_once_cancel() {
    let front = RobotModel::SSL_GENERIC.front_distance() + 0.0215;
    let poses = [[-front, 0.0, 0.0], [front, 0.0, 180.0]];
    let commands = vec![vec![0.0, 0.0, 0.0, 6.0, 0.0, 0.0]; 2];
    let mut scene = Scene::at("both", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
    scene.config.time_step = scene.config.tick;
    let row = scene.after(1);
    assert!(row[ball_column("v_x")].abs() < 1e-4, "{row:?}");
}

#[test]
fn a_kick_that_is_slower_than_the_ball_leaves_it() {
    let mut scene = ball_in_mouth(&[0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    scene.config.time_step = scene.config.tick;
    scene.set_ball_column("v_x", 3.0);
    assert!(scene.after(1)[ball_column("v_x")] > 2.9);
}

#[test]
fn a_chip_too_weak_to_fly_is_a_flat_kick() {
    let [flat, weak] = [0.0, 1e-4]
        .map(|up| ball_in_mouth(&[0.0, 0.0, 0.0, 4.0, up, 0.0]).after(4)[ball_column("v_x")]);
    assert!((flat - weak).abs() < 1e-3, "{flat} {weak}");
}

#[test]
fn a_kick_at_a_robot_right_before_it_does_not_get_into_it() {
    for (speed, gap) in [(8.0, 0.021), (10.0, 0.024), (6.0, 0.01)] {
        let front = RobotModel::SSL_GENERIC.front_distance() + 0.0215;
        let poses = [[0.0, 0.0, 0.0], [front + 0.0215 + gap + 0.09, 0.0, 0.0]];
        let commands = vec![vec![0.0, 0.0, 0.0, speed, 0.0, 0.0], vec![0.0; 6]];
        let mut scene = Scene::at("wall", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
        scene.config.time_step = scene.config.tick;
        scene.set_ball([front, 0.0], [0.0, 0.0]);
        let (rows, _) = scene.play(&mut scene.world(), 6);
        for row in rows.chunks_exact(scene.config.row_size()) {
            let into = 0.09 + 0.0215 - (robot(row, 1)[0] - row[0]);
            assert!(into < 1e-3, "{speed} m/s: {into} m inside");
        }
    }
}
