//! Default positions of both teams, and on both sides of the field.

use rsim_referee::codes::Command;
use rsim_referee::{Team, Vector};

use crate::formation::{arrange, kicks, scattered};
use crate::pitches::Size;
use crate::scene::Scene;

/// The same match with the teams swapped and x with the opposite sign.
fn swapped(scene: &Scene, robots: [usize; 2], size: Size) -> Scene {
    let mut other = Scene::with(size.config(), size.pitch(), [robots[1], robots[0]]);
    for (team, count) in Team::BOTH.into_iter().zip(robots) {
        for nth in 0..count {
            let place = scene.position(team, nth);
            other.robot(team.opponent(), nth, [-place.x, place.y]);
        }
    }
    other
}

/// The same command of the other team.
fn of_opponent(command: Command) -> Command {
    match command {
        Command::PrepareKickoff(team) => Command::PrepareKickoff(team.opponent()),
        Command::PreparePenalty(team) => Command::PreparePenalty(team.opponent()),
        Command::GoalKick(team) => Command::GoalKick(team.opponent()),
        command => command,
    }
}

#[test]
fn both_teams_are_treated_alike() {
    for size in Size::BOTH {
        for seed in 0..40 {
            for (command, ball) in kicks(size) {
                let robots = [5, 4];
                let mut scene = scattered(size, robots, seed, 0.0);
                let mut other = swapped(&scene, robots, size);
                arrange(&mut scene, command, ball);
                arrange(&mut other, of_opponent(command), Vector::new(-ball.x, ball.y));
                for (team, count) in Team::BOTH.into_iter().zip(robots) {
                    for nth in 0..count {
                        let place = scene.position(team, nth);
                        let expected = Vector::new(-place.x, place.y);
                        assert_eq!(other.position(team.opponent(), nth), expected);
                    }
                }
            }
        }
    }
}

#[test]
fn left_and_right_are_treated_alike_at_free_balls_and_goal_kicks() {
    for seed in 0..40 {
        for (command, ball) in kicks(Size::Three).into_iter().filter(|(_, ball)| ball.y > 0.0) {
            let mut scene = scattered(Size::Three, [5, 5], seed, 0.0);
            let mut other = Scene::with(Size::Three.config(), Size::Three.pitch(), [5, 5]);
            for team in Team::BOTH {
                for nth in 0..5 {
                    let place = scene.position(team, nth);
                    other.robot(team, nth, [place.x, -place.y]);
                }
            }
            arrange(&mut scene, command, ball);
            arrange(&mut other, command, Vector::new(ball.x, -ball.y));
            for (robot, mirrored) in scene.robots().iter().zip(other.robots()) {
                let expected = Vector::new(robot.position.x, -robot.position.y);
                assert_eq!(mirrored.position, expected);
            }
        }
    }
}

#[test]
fn robots_at_y_0_are_moved_as_after_half_a_turn() {
    let mut scene = scattered(Size::Three, [4, 4], 6, 0.0);
    for team in Team::BOTH {
        scene.robot(team, 3, [team.own_side() * 0.25, 0.0]);
    }
    arrange(&mut scene, Command::PrepareKickoff(Team::Blue), Vector::default());
    let [blue, yellow] = Team::BOTH.map(|team| scene.position(team, 3));
    assert_eq!(blue, yellow * -1.0);
    assert!(blue.y != 0.0, "the places in line with it are taken");
}
