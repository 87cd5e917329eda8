//! Symmetry: the future of a rotated or reflected scene is rotated or reflected too.
#![allow(clippy::float_cmp)] // flags, zeros and equal results are exact

use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS, ball_column, crossing_name};
use rsim_core::scenes::{self, Driver, Scene, lone_ball, robots, robots_mut};

/// A symmetry of the field: signs that it flips, and whether it swaps the teams.
#[derive(Clone, Copy)]
struct Symmetry {
    flips: fn(&str) -> bool,
    swaps_teams: bool,
    name: &'static str,
}

const HALF_TURN: Symmetry = Symmetry {
    flips: |column| {
        matches!(column, "x" | "y" | "cos" | "sin")
            || column.ends_with("_x")
            || column.ends_with("_y")
    },
    swaps_teams: true,
    name: "half turn",
};

/// Reflection at the x axis. Spin is an axial vector: its components in the mirror's plane flip.
const REFLECTION: Symmetry = Symmetry {
    flips: |column| {
        matches!(column, "y" | "sin" | "v_theta" | "spin_x" | "spin_z" | "v_y" | "crossed_y")
    },
    swaps_teams: false,
    name: "reflection",
};

impl Symmetry {
    fn row(self, row: &[f32]) -> Vec<f32> {
        assert_eq!(crossing_name(row[ball_column("crossed")]), "none", "sides would change");
        let sign = |column: &str| if (self.flips)(column) { -1.0 } else { 1.0 };
        let mut image = row.to_vec();
        for (value, column) in image.iter_mut().zip(BALL_COLUMNS) {
            *value *= sign(column);
        }
        let before: Vec<Vec<f32>> = robots(row).map(<[f32]>::to_vec).collect();
        let shift = if self.swaps_teams { before.len() / 2 } else { 0 };
        for (index, columns) in robots_mut(&mut image).enumerate() {
            let other = &before[(index + shift) % before.len()];
            for ((value, column), from) in columns.iter_mut().zip(ROBOT_COLUMNS).zip(other) {
                *value = from * sign(column);
            }
        }
        let last = ball_column("last_touch");
        if self.swaps_teams && row[last] >= 0.0 {
            image[last] = (row[last] + shift as f32) % before.len() as f32;
        }
        image
    }

    fn scene(self, scene: &Scene) -> Scene {
        let Driver::Constant(commands) = &scene.driver else {
            panic!("only constant commands turn")
        };
        let mut commands = commands.clone();
        for command in &mut commands {
            if !self.swaps_teams && command.len() == 2 {
                command.swap(0, 1);
            } else if !self.swaps_teams {
                // To the left and turning left.
                (command[1], command[2]) = (-command[1], -command[2]);
            }
        }
        if self.swaps_teams {
            let half = commands.len() / 2;
            commands.rotate_left(half);
        }
        Scene { start: self.row(&scene.start), driver: Driver::Constant(commands), ..scene.clone() }
    }

    /// Plays both scenes and returns the maximum difference.
    fn error(self, scene: &Scene, steps: u64) -> f32 {
        let (rows, _) = scene.play(&mut scene.world(), steps);
        let image = self.scene(scene);
        let (image_rows, _) = image.play(&mut image.world(), steps);
        let size = scene.config.row_size();
        let pairs = rows.chunks_exact(size).zip(image_rows.chunks_exact(size));
        let spin = ball_column("spin_x")..=ball_column("spin_z");
        let differences = pairs.flat_map(|(row, image_row)| {
            let expected = self.row(row);
            // Spin as surface speed, so that all columns have similar sizes.
            let scale = |column: usize| if spin.contains(&column) { 0.0215 } else { 1.0 };
            let both = expected.into_iter().zip(image_row.to_vec()).enumerate();
            both.map(|(column, (a, b))| (a - b).abs() * scale(column)).collect::<Vec<_>>()
        });
        differences.fold(0.0, f32::max)
    }
}

const BOTH: [Symmetry; 2] = [HALF_TURN, REFLECTION];

#[test]
fn free_motion_mirrors_exactly() {
    let vss = Scene::at(
        "vss",
        scenes::vss(2, 2),
        &[[-0.5, 0.1, 10.0], [-0.4, -0.4, 80.0], [0.5, 0.2, 200.0], [0.4, -0.3, 120.0]],
        Driver::Constant(vec![vec![20.0, 17.0], vec![5.0, -5.0], vec![9.0, 9.5], vec![3.0, 2.0]]),
    );
    let ssl = Scene::at(
        "ssl",
        scenes::ssl(2, 2),
        &[[-2.5, 0.1, 10.0], [-2.0, -2.0, 80.0], [2.5, 0.2, 200.0], [2.0, -1.0, 120.0]],
        Driver::Constant(vec![
            vec![1.0, 0.5, 2.0],
            vec![-0.5, 0.2, 0.0],
            vec![0.3, -0.8, -3.0],
            vec![3.7, 3.7, 9.0],
        ]),
    );
    for mut scene in [vss, ssl] {
        scene.set_ball([0.05, 0.1], [-0.4, 0.3]);
        scene.set_ball_column("spin_z", 3.0);
        let (_, contacts) = scene.play(&mut scene.world(), 12);
        assert_eq!(contacts, 0, "this part is about free motion");
        for symmetry in BOTH {
            let error = symmetry.error(&scene, 12);
            assert_eq!(error, 0.0, "{} of {}", symmetry.name, scene.name);
        }
    }
}

#[test]
fn a_flight_mirrors_exactly() {
    let poses = [[-2.0, 0.0, 0.0], [2.0, 0.5, 180.0]];
    let commands = vec![vec![0.0; 3]; 2];
    let mut scene = Scene::at("chip", scenes::ssl(1, 1), &poses, Driver::Constant(commands));
    scene.set_ball([0.2, -0.3], [-1.0, 0.7]);
    scene.set_ball_column("v_z", 3.0);
    for symmetry in BOTH {
        assert_eq!(symmetry.error(&scene, 30), 0.0, "{}", symmetry.name);
    }
}

#[test]
fn one_contact_mirrors_to_a_tenth_of_a_millimeter() {
    let vss = |driver| {
        let poses = [[-0.3, 0.02, 5.0], [0.6, 0.0, 180.0]];
        let mut scene = Scene::at("vss", scenes::vss(1, 1), &poses, driver);
        scene.set_ball([0.0, 0.0], [-1.0, 0.0]);
        scene
    };
    let ssl = |driver| {
        let poses = [[-0.3, 0.03, 5.0], [2.0, 0.0, 180.0]];
        let mut scene = Scene::at("ssl", scenes::ssl(1, 1), &poses, driver);
        scene.set_ball([0.0, 0.0], [-1.5, 0.0]);
        scene
    };
    let still = |columns: usize| Driver::Constant(vec![vec![0.0; columns]; 2]);
    for (scene, steps) in [(vss(still(2)), 14), (ssl(still(3)), 10)] {
        let last = scene.after(steps);
        // It may come back only for part of a tick: its spin sends it to the robot again.
        assert!(last[ball_column("v_x")] > -0.1, "{}: it was stopped: {last:?}", scene.name);
        assert_eq!(last[ball_column("last_touch")], 0.0);
        for symmetry in BOTH {
            let error = symmetry.error(&scene, steps);
            assert!(error < 1e-4, "{} of {}: off by {error}", symmetry.name, scene.name);
        }
    }
}

#[test]
fn a_wall_mirrors_too() {
    let scene = Scene {
        driver: Driver::Constant(Vec::new()),
        ..lone_ball(scenes::ssl(0, 0), [0.3, 3.0], [2.0, 2.0])
    };
    // Without robots no teams are swapped.
    let reflected = Symmetry { swaps_teams: false, ..REFLECTION };
    let (rows, _) = scene.play(&mut scene.world(), 2);
    assert!(rows[ball_column("v_y")] > 0.0);
    let mut image = scene.clone();
    image.start = reflected.row(&scene.start);
    let (after, image_after) = (scene.after(8), image.after(8));
    assert!(after[ball_column("v_y")] < 0.0, "it met the wall");
    for column in ["x", "v_x"].map(ball_column) {
        assert!((after[column] - image_after[column]).abs() < 1e-4);
    }
    assert!((after[1] + image_after[1]).abs() < 1e-4);
}
