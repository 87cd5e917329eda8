//! Too many robots of a team in an area with the ball.

use rsim_referee::codes::Command;
use rsim_referee::events::EventKind::{
    self, AttackerTouchedBallInDefenseArea, DefenderInDefenseArea,
};
use rsim_referee::game::Game;
use rsim_referee::{Team, Vector};

use crate::pitches::{BALL_RADIUS, Size};
use crate::scene::{Scene, seen_by, steps};

/// Distance of the front of the goal area from the center, m.
pub(crate) fn goal_area(size: Size) -> f32 {
    size.pitch().lines.half_length - 0.15
}

/// Places in the goal area that a team attacks, as it sees them: those of attackers at +y.
fn in_goal_area(size: Size, nth: u8) -> [f32; 2] {
    [goal_area(size) + 0.05, 0.1 + 0.02 * f32::from(nth)]
}

/// Puts the ball, which rolls, and the last robots of a team in the goal area that it attacks.
pub(crate) fn attack(scene: &mut Scene, team: Team, robots: u8) {
    crowd(scene, team, team, robots);
}

/// Puts the ball, which rolls, and the last robots of a team in its own goal area.
pub(crate) fn defend(scene: &mut Scene, team: Team, robots: u8) {
    crowd(scene, team, team.opponent(), robots);
}

fn crowd(scene: &mut Scene, team: Team, attacker: Team, robots: u8) {
    let count = scene.referee.layout().team_size(team);
    let size = if count == 3 { Size::Three } else { Size::Five };
    for nth in 0..robots {
        let [x, y] = in_goal_area(size, nth);
        let y = if team == attacker { y } else { -y };
        scene.robot(team, count - 1 - usize::from(nth), seen_by(attacker, [x, y]));
    }
    scene.roll(seen_by(attacker, [goal_area(size) + 0.05, 0.0]), [1.0, 0.0]);
}

/// A way of a team to crowd an area, what it is called, and the command that follows, by the attacking team.
pub(crate) type Kind = (fn(&mut Scene, Team, u8), EventKind, fn(Team) -> (Team, Command));

const KINDS: [Kind; 2] = [
    (attack, AttackerTouchedBallInDefenseArea, |attacker| {
        (attacker, Command::GoalKick(attacker.opponent()))
    }),
    (
        |scene, attacker, robots| defend(scene, attacker.opponent(), robots),
        DefenderInDefenseArea,
        |attacker| (attacker.opponent(), Command::PreparePenalty(attacker)),
    ),
];

/// All kinds of crowds, for both sizes and both teams that attack.
pub(crate) fn each(check: impl Fn(Size, Team, Kind)) {
    for size in Size::BOTH {
        for attacker in Team::BOTH {
            for kind in KINDS {
                check(size, attacker, kind);
            }
        }
    }
}

#[test]
fn two_robots_in_the_goal_area_with_the_ball_are_a_foul_after_three_seconds() {
    each(|size, attacker, (crowd, kind, outcome)| {
        let mut scene = Scene::in_play(size);
        crowd(&mut scene, attacker, 2);
        let (nth, event) = scene.first_event(4.0).expect("a foul");
        assert_eq!((nth, event.kind), (steps(3.0), kind));
        let (at_fault, command) = outcome(attacker);
        assert_eq!((event.team, event.robot), (Some(at_fault), None));
        assert_eq!(event.position, scene.ball_position());
        assert_eq!((scene.game.command, scene.game.next_command), (Command::Stop, Some(command)));
        assert_eq!(scene.game.score, Game::new(Team::Blue).score);
    });
}

#[test]
fn penalty_marks_and_goal_kicks_have_the_places_of_the_league() {
    each(|size, attacker, (crowd, _, outcome)| {
        for side in [1.0, -1.0] {
            let mut scene = Scene::in_play(size);
            crowd(&mut scene, attacker, 2);
            let [x, y] = seen_by(attacker, [goal_area(size) + 0.02, 0.05 * side]);
            scene.roll([x, y], [1.0, 0.0]);
            scene.first_event(4.0).expect("a foul");
            let place = match (outcome(attacker).1, size) {
                (Command::PreparePenalty(_), Size::Three) => [0.375, 0.0],
                (Command::PreparePenalty(_), Size::Five) => [0.725, 0.0],
                (_, Size::Three) => [0.6, side * (0.375 - BALL_RADIUS)],
                (_, Size::Five) => [0.95, 0.0],
            };
            let [x, y] = seen_by(attacker, place);
            let distance = scene.game.designated_position.distance(Vector::new(x, y));
            assert!(distance < 1e-5, "{:?}", scene.game.designated_position);
        }
    });
}

#[test]
fn one_robot_in_the_goal_area_is_allowed() {
    each(|size, attacker, (crowd, _, _)| {
        let mut scene = Scene::in_play(size);
        crowd(&mut scene, attacker, 1);
        assert_eq!(scene.run(4.0), []);
        let ball = seen_by(attacker, [0.0, 0.0]);
        scene.roll(ball, [1.0, 0.0]);
        assert_eq!(scene.step(), [], "nor is it a foul when the ball leaves the area");
    });
}

#[test]
fn robots_of_both_teams_do_not_count_together() {
    for size in Size::BOTH {
        let mut scene = Scene::in_play(size);
        attack(&mut scene, Team::Blue, 1);
        defend(&mut scene, Team::Yellow, 1);
        assert_eq!(scene.run(4.0), []);
    }
}

/// Places just outside the goal area that a team attacks, as it sees them. Its lines do not belong to it.
fn just_outside(size: Size) -> [[f32; 2]; 3] {
    let half_width = if size == Size::Three { 0.35 } else { 0.25 };
    [
        [goal_area(size) - 0.001, 0.1],
        [goal_area(size) + 0.05, half_width],
        [goal_area(size) + 0.05, -half_width],
    ]
}

#[test]
fn a_robot_or_the_ball_just_outside_the_goal_area_does_not_count() {
    each(|size, attacker, (crowd, _, _)| {
        for place in just_outside(size) {
            let mut scene = Scene::in_play(size);
            crowd(&mut scene, attacker, 2);
            scene.roll(seen_by(attacker, place), [1.0, 0.0]);
            assert_eq!(scene.run(4.0), [], "ball at {place:?}");
            let mut scene = Scene::in_play(size);
            crowd(&mut scene, attacker, 2);
            for team in Team::BOTH {
                scene.robot(team, size.robots() - 1, seen_by(attacker, place));
            }
            assert_eq!(scene.run(4.0), [], "robot at {place:?}");
        }
    });
}

#[test]
fn a_robot_that_leaves_the_area_ends_the_time_but_not_the_foul() {
    each(|size, attacker, (crowd, kind, _)| {
        let mut scene = Scene::in_play(size);
        crowd(&mut scene, attacker, 2);
        assert_eq!(scene.run(2.9), []);
        crowd(&mut scene, attacker, 1);
        scene.park();
        assert_eq!(scene.run(0.025), []);
        crowd(&mut scene, attacker, 2);
        assert_eq!(scene.run(2.9), [], "the time has begun again");
        scene.park();
        assert_eq!(scene.run(10.0), [], "the ball is still in the area");
        scene.roll([0.0, 0.0], [1.0, 0.0]);
        scene.step_to(kind);
    });
}

#[test]
fn the_foul_is_given_when_the_ball_leaves_the_large_area() {
    each(|size, attacker, (crowd, kind, outcome)| {
        let mut scene = Scene::in_play(size);
        crowd(&mut scene, attacker, 2);
        assert_eq!(scene.run(0.025), []);
        if size == Size::Five {
            scene.roll(seen_by(attacker, [0.751, 0.39]), [1.0, 0.0]);
            assert_eq!(scene.run(5.0), [], "the ball is in the larger area");
        }
        let front = if size == Size::Five { 0.749 } else { 0.599 };
        scene.roll(seen_by(attacker, [front, 0.0]), [1.0, 0.0]);
        scene.step_to(kind);
        assert_eq!(scene.game.next_command, Some(outcome(attacker).1));
        let place = scene.game.designated_position;
        assert!(place.x.abs() > 0.3, "{place:?}");
    });
}

#[test]
fn a_foul_is_forgotten_with_the_next_kick() {
    each(|size, attacker, (crowd, kind, _)| {
        let mut scene = Scene::in_play(size);
        crowd(&mut scene, attacker, 2);
        assert_eq!(scene.first_event(4.0).expect("a foul").1.kind, kind);
        scene.wait_for(Command::NormalStart);
        scene.park();
        scene.roll(seen_by(attacker, [goal_area(size) + 0.05, 0.0]), [1.0, 0.0]);
        assert_eq!(scene.run(5.0), []);
        scene.roll([0.0, 0.0], [1.0, 0.0]);
        assert_eq!(scene.run(5.0), []);
    });
}
