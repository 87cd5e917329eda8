//! The ball against closed forms: how it rolls, bounces, and stays where it can be.

use rsim_core::columns::crossing_name;
use rsim_core::scenes::{Driver, Scene, rolling_ball, uniform};
use rsim_core::{BallModel, SimConfig};

/// A ball alone on the field.
fn alone(position: [f32; 2], velocity: [f32; 2]) -> Scene {
    let config = SimConfig { n_blue: 0, n_yellow: 0, ..SimConfig::VSS_3V3 };
    let mut scene = Scene::at("ball_alone", config, &[], Driver::Constant([0.0, 0.0]));
    scene.set_ball(position, velocity);
    scene
}

fn last_row(scene: &Scene, steps: u64) -> Vec<f32> {
    let (rows, _) = scene.play(&mut scene.world(), steps);
    rows[rows.len() - scene.config.row_size()..].to_vec()
}

#[test]
fn it_rolls_as_far_as_the_closed_form_in_every_direction() {
    let speed: f32 = 0.35;
    let expected = speed * speed / (2.0 * BallModel::VSS_RSIM.rolling_deceleration);
    for degrees in [0.0_f32, 30.0, 45.0, 90.0, 200.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let row = last_row(&alone([0.0, 0.0], [speed * cos, speed * sin]), 150);
        let distance = row[0].hypot(row[1]);
        assert!(
            (distance / expected - 1.0).abs() < 0.002,
            "{degrees}: {distance} m, not {expected} m"
        );
        assert_eq!(row[2..4], [0.0, 0.0], "it came to rest");
    }
}

#[test]
fn its_way_does_not_depend_on_the_tick() {
    let scenes = [0.0025, 0.005, 0.0125].map(|tick| {
        let mut scene = rolling_ball(1.0);
        scene.config.tick = tick;
        scene
    });
    let ends = scenes.map(|scene| last_row(&scene, 30)[0]);
    for end in ends {
        assert!((end / ends[0] - 1.0).abs() < 0.01, "{ends:?}");
    }
}

#[test]
fn it_bounces_off_a_wall_and_off_a_robot_with_their_restitution() {
    for speed in [0.5_f32, 1.5, 4.0] {
        let row = last_row(&alone([0.0, 0.45], [0.0, speed]), 16);
        let left = -row[3] / speed;
        assert!((left - 0.5).abs() < 0.06, "wall at {speed} m/s: {left}");
    }
    // A robot gives way: the closing speed is what restitution is about.
    let config = SimConfig { n_blue: 1, n_yellow: 0, ..SimConfig::VSS_3V3 };
    let mut scene =
        Scene::at("at_a_robot", config, &[[0.3, 0.0, 0.0]], Driver::Constant([0.0, 0.0]));
    scene.set_ball([0.2, 0.0], [2.0, 0.0]);
    let mut world = scene.world();
    let mut row = vec![0.0; scene.config.row_size()];
    let after_bounce = (0..6).find_map(|step| {
        world.step(&scene.commands(&row, step, 0)).expect("finite");
        world.write_row(&mut row);
        (row[2] < 0.0).then(|| row[2])
    });
    let back = after_bounce.expect("it bounced");
    // A ball of 46 g on a robot of 150 g: v (m - e M) / (m + M), before the brakes act.
    let expected = 2.0 * (0.046 - 0.6 * 0.15) / (0.046 + 0.15);
    assert!((back - expected).abs() < 0.15, "{back} m/s, expected about {expected} m/s");
}

#[test]
fn no_fast_shot_leaves_the_arena_or_passes_a_robot() {
    let config = SimConfig { n_blue: 1, n_yellow: 0, ..SimConfig::VSS_3V3 };
    let poses = [[0.0, 0.0, 20.0]];
    let mut disturbed = 0;
    for shot in 0..1000_u64 {
        let mut scene = Scene::at("shots", config.clone(), &poses, Driver::Constant([0.0, 0.0]));
        // From the left half at the robot, at 10 m/s: 50 mm a tick.
        let from = [-0.5 + 0.2 * uniform(shot), 0.3 * uniform(shot + 5000)];
        let to = [0.0, 0.02 * uniform(shot + 9000)];
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        scene.set_ball(from, way.map(|part| part / length * 10.0));
        let (rows, _) = scene.play(&mut scene.world(), 12);
        for row in rows.chunks_exact(scene.config.row_size()) {
            assert!(
                row[0].abs() < 0.85 && row[1].abs() < 0.65,
                "shot {shot} is at {:?}",
                &row[..2]
            );
            // Undisturbed, a ball stays before the robot: behind it there is 0.6 m to the walls,
            // more than two steps in which it would be seen there.
            let undisturbed = row[2].hypot(row[3]) > 9.9;
            let behind = row[0] * way[0] + row[1] * way[1] > 0.03 * length;
            assert!(!(undisturbed && behind), "shot {shot} passed the robot");
            disturbed += usize::from(!undisturbed);
        }
    }
    assert!(disturbed > 5000, "shots were stopped, and seen to be: {disturbed} rows");
}

#[test]
fn no_fast_shot_at_the_goal_breaks_through_its_back_or_its_posts() {
    let mut goals = 0;
    for shot in 0..1000_u64 {
        let from = [0.3 * uniform(shot), 0.5 * uniform(shot + 5000)];
        let side = if shot % 2 == 0 { 1.0 } else { -1.0 };
        let to = [side * 0.8, 0.3 * uniform(shot + 9000)];
        let way = [to[0] - from[0], to[1] - from[1]];
        let length = way[0].hypot(way[1]);
        let scene = alone(from, way.map(|part| part / length * 10.0));
        let (rows, _) = scene.play(&mut scene.world(), 20);
        for row in rows.chunks_exact(scene.config.row_size()) {
            let [x, y] = [row[0].abs(), row[1].abs()];
            assert!(x < 0.85 && y < 0.65, "shot {shot} is at {:?}", &row[..2]);
            assert!(x < 0.75 || y < 0.2, "shot {shot} is in the wall at {:?}", &row[..2]);
            if row[4] != 0.0 {
                goals += 1;
                let side = if row[5] > 0.0 { "goal_right" } else { "goal_left" };
                assert_eq!(crossing_name(row[4]), side);
                assert!((row[5].abs() - 0.75).abs() < 1e-4 && row[6].abs() < 0.2);
            }
        }
    }
    assert!(goals > 300, "only {goals} goals");
}

#[test]
fn corner_blocks_send_it_round_the_corner() {
    // Along the side wall into the corner: a right wall would send it straight back.
    let row = last_row(&alone([0.4, 0.62], [2.0, 0.0]), 12);
    assert!(row[3] < -0.2, "it leaves the corner inward, got {:?}", &row[2..4]);
}
