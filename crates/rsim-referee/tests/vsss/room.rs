//! Room for the bodies that are placed, wherever robots were before.

use rsim_referee::codes::Command;
use rsim_referee::{Team, Vector};

use crate::formation::{arrange, kicks, scattered};
use crate::outlines::assert_valid;
use crate::pitches::{BALL_RADIUS, Size};

#[test]
fn any_robots_are_put_on_the_table_without_touching_anything() {
    for size in Size::BOTH {
        for seed in 0..40 {
            for (command, ball) in kicks(size) {
                let mut scene = scattered(size, [5, 5], seed, 0.2);
                let before: Vec<usize> = scene.robots().iter().map(|robot| robot.index).collect();
                arrange(&mut scene, command, ball);
                let after: Vec<usize> = scene.robots().iter().map(|robot| robot.index).collect();
                assert_eq!(before, after, "absent robots stay away");
                assert!(scene.row.iter().all(|value| value.is_finite()));
                assert_valid(&scene);
            }
        }
    }
}

#[test]
fn the_first_robot_on_the_field_keeps_the_goal() {
    for size in Size::BOTH {
        for seed in 0..10 {
            for (command, ball) in kicks(size) {
                let mut scene = scattered(size, [5, 4], seed, 0.4);
                arrange(&mut scene, command, ball);
                let lines = &scene.referee.pitch().lines;
                for team in Team::BOTH {
                    let robots = scene.robots();
                    let Some(keeper) = robots.iter().find(|robot| robot.team == team) else {
                        continue;
                    };
                    let from_goal = keeper.position.distance(lines.goal(team));
                    // At three a side the keeper takes goal kicks, beside its goal.
                    let kicks = size == Size::Three && command == Command::GoalKick(team);
                    let limit = if kicks { 0.3 } else { 0.1 };
                    assert!(from_goal <= limit + 1e-6, "{command:?}: {keeper:?}");
                }
            }
        }
    }
}

#[test]
fn robots_without_a_place_stay_where_they_may() {
    for size in Size::BOTH {
        let robots = [size.robots() + 1; 2];
        for (command, ball) in kicks(size) {
            let mut scene = scattered(size, robots, 3, 0.0);
            // Beside all places of the tables, and beside the blocks in the corners.
            let x = size.pitch().lines.half_length - 0.1;
            let y = size.pitch().lines.half_width - 0.15;
            for team in Team::BOTH {
                scene.robot(team, size.robots(), [team.own_side() * x, y]);
            }
            arrange(&mut scene, command, ball);
            for team in Team::BOTH {
                let place = Vector::new(team.own_side() * x, y);
                assert_eq!(scene.position(team, size.robots()), place);
            }
        }
    }
}

/// Place where a robot without a place of a table comes from a place.
fn moved_from(place: [f32; 2]) -> f32 {
    let mut scene = scattered(Size::Three, [4, 3], 4, 0.0);
    scene.robot(Team::Blue, 3, place);
    arrange(&mut scene, Command::PrepareKickoff(Team::Blue), Vector::default());
    scene.position(Team::Blue, 3).distance(Vector::new(place[0], place[1]))
}

#[test]
fn robots_in_walls_corners_and_goals_are_moved_and_those_beside_them_are_not() {
    // 0.0375 m times the root of 2, and 1 mm of room.
    let radius = 0.054_03;
    for (x, y) in [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)] {
        let corner = (0.75 + 0.65 - 0.07 - 2_f32.sqrt() * radius) / 2.0;
        for ([ahead, aside], moves) in [
            ([0.75 - radius - 0.001, 0.4], false),
            ([0.75 - radius + 0.001, 0.4], true),
            ([0.3, 0.65 - radius - 0.001], false),
            ([0.3, 0.65 - radius + 0.001], true),
            ([corner + 0.05 - 0.001, corner - 0.05], false),
            ([corner + 0.05 + 0.002, corner - 0.05], true),
            ([0.749, 0.2 - radius - 0.001], false),
            ([0.749, 0.2 - radius + 0.001], true),
            ([0.751, 0.12], true),
            ([0.749, 0.2 + radius + 0.001], true),
        ] {
            let way = moved_from([x * ahead, y * aside]);
            assert_eq!(way > 0.0, moves, "{ahead} {aside}");
            assert!(way < 0.1, "to a place nearby");
        }
    }
}

#[test]
fn robots_at_the_ball_are_moved_away_from_it() {
    let touching = 0.053_03 + BALL_RADIUS + 0.001;
    for (distance, moves) in [(touching + 0.001, false), (touching - 0.001, true), (0.0, true)] {
        let way = moved_from([0.0, distance]);
        assert_eq!(way > 0.0, moves, "{distance}");
        assert!(way < 0.15);
    }
}

#[test]
fn a_kicker_whose_place_is_that_of_the_ball_is_moved_away_from_it() {
    let mut scene = scattered(Size::Three, [3, 3], 5, 0.0);
    arrange(&mut scene, Command::PreparePenalty(Team::Yellow), Vector::new(-0.3, 0.0));
    assert_valid(&scene);
}
