//! A ball that is stuck.

use rsim_referee::codes::Command;
use rsim_referee::events::EventKind::{KeeperHeldBall, NoProgressInGame};
use rsim_referee::{Team, Vector};

use crate::crowds::goal_area;
use crate::pitches::{Size, TIME_STEP};
use crate::scene::{Scene, seen_by, steps};

/// Speed up to which the ball is stuck, m/s.
const SLOW: f32 = 0.1;

#[test]
fn a_ball_that_is_stuck_for_five_seconds_is_a_free_ball_in_its_quarter() {
    for (size, mark) in [(Size::Three, [0.375, 0.4]), (Size::Five, [0.55, 0.6])] {
        for (x, y, signs) in [
            (0.01, 0.01, [1.0, 1.0]),
            (-0.01, 0.3, [-1.0, 1.0]),
            (-0.3, -0.01, [-1.0, -1.0]),
            (0.3, -0.3, [1.0, -1.0]),
            (0.0, 0.3, [-1.0, 1.0]),
            (0.3, 0.0, [1.0, -1.0]),
            (0.0, 0.0, [-1.0, -1.0]),
        ] {
            let mut scene = Scene::in_play(size);
            scene.ball([x, y]);
            let (nth, event) = scene.first_event(6.0).expect("it is stuck");
            assert_eq!((nth, event.kind), (steps(5.0), NoProgressInGame));
            assert_eq!((event.team, event.position), (None, Vector::new(x, y)));
            assert_eq!(scene.game.next_command, Some(Command::FreeBall));
            let place = Vector::new(signs[0] * mark[0], signs[1] * mark[1]);
            assert_eq!(scene.game.designated_position, place, "{x} {y}");
        }
    }
}

#[test]
fn a_ball_that_rolls_slowly_is_stuck_and_a_faster_one_is_not() {
    for (speed, is_stuck) in [(SLOW, true), (SLOW + 0.001, false)] {
        let mut scene = Scene::in_play(Size::Three);
        let mut x = -0.3;
        let mut events = Vec::new();
        for _ in 0..steps(5.0) {
            x += speed * TIME_STEP;
            scene.roll([x, 0.1], [speed, 0.0]);
            events.extend(scene.step());
        }
        assert_eq!(!events.is_empty(), is_stuck, "{speed} m/s");
    }
}

#[test]
fn a_ball_that_is_faster_for_a_moment_is_stuck_anew() {
    let mut scene = Scene::in_play(Size::Five);
    scene.ball([0.2, 0.2]);
    assert_eq!(scene.run(4.9), []);
    scene.roll([0.2, 0.2], [0.2, 0.0]);
    assert_eq!(scene.step(), []);
    scene.ball([0.2, 0.2]);
    assert_eq!(scene.first_event(6.0).expect("it is stuck").0, steps(5.0));
}

#[test]
fn a_ball_that_is_stuck_in_a_goal_area_is_a_penalty_kick() {
    for size in Size::BOTH {
        for attacker in Team::BOTH {
            let mut scene = Scene::in_play(size);
            scene.ball(seen_by(attacker, [goal_area(size) + 0.02, 0.2]));
            assert_eq!(scene.step(), [], "it comes into the area");
            let (nth, event) = scene.first_event(6.0).expect("it is stuck");
            assert_eq!((nth, event.kind), (steps(5.0), KeeperHeldBall));
            assert_eq!(event.team, Some(attacker.opponent()));
            assert_eq!(scene.game.next_command, Some(Command::PreparePenalty(attacker)));
            let mark = scene.referee.pitch().lines.penalty_mark(attacker);
            assert_eq!(scene.game.designated_position, mark);
        }
    }
}

#[test]
fn a_ball_between_both_teams_in_a_goal_area_is_a_free_ball() {
    // Robots of the attackers and of the defenders at these distances: 1.5 robot lengths are near.
    let (near, far) = (0.112, 0.113);
    for (distances, kind) in [
        ([near, near], NoProgressInGame),
        ([near, far], KeeperHeldBall),
        ([far, near], KeeperHeldBall),
    ] {
        for size in Size::BOTH {
            for attacker in Team::BOTH {
                let mut scene = Scene::in_play(size);
                let ball = [goal_area(size) + 0.02, 0.1];
                scene.ball(seen_by(attacker, ball));
                let teams = [(attacker, distances[0]), (attacker.opponent(), -distances[1])];
                for (team, distance) in teams {
                    let place = [ball[0], ball[1] + distance];
                    scene.robot(team, 1, seen_by(attacker, place));
                }
                assert_eq!(scene.step(), [], "the ball comes into the area");
                let (nth, event) = scene.first_event(6.0).expect("it is stuck");
                assert_eq!((nth, event.kind), (steps(5.0), kind));
                if kind == NoProgressInGame {
                    let lines = &scene.referee.pitch().lines;
                    let [x, y] = seen_by(attacker, [lines.free_ball_x, lines.free_ball_y]);
                    assert_eq!(scene.game.next_command, Some(Command::FreeBall));
                    assert_eq!(scene.game.designated_position, Vector::new(x, y));
                }
            }
        }
    }
}

#[test]
fn at_five_a_side_the_larger_area_is_no_goal_area() {
    for attacker in Team::BOTH {
        for place in [[0.94, 0.0], [1.0, 0.26], [0.76, -0.1]] {
            let mut scene = Scene::in_play(Size::Five);
            scene.ball(seen_by(attacker, place));
            assert_eq!(scene.first_event(6.0).expect("it is stuck").1.kind, NoProgressInGame);
        }
    }
}

#[test]
fn the_time_begins_again_when_the_ball_enters_or_leaves_a_goal_area() {
    for size in Size::BOTH {
        for attacker in Team::BOTH {
            let [outside, inside] =
                [-0.001, 0.001].map(|x| seen_by(attacker, [goal_area(size) + x, 0.1]));
            let cases = [(outside, inside, KeeperHeldBall), (inside, outside, NoProgressInGame)];
            for (from, to, kind) in cases {
                let mut scene = Scene::in_play(size);
                scene.ball(from);
                assert_eq!(scene.run(4.9), []);
                scene.ball(to);
                assert_eq!(scene.step(), []);
                let (nth, event) = scene.first_event(6.0).expect("it is stuck");
                assert_eq!((nth, event.kind), (steps(5.0), kind));
            }
        }
    }
}

#[test]
fn a_ball_at_rest_is_not_stuck_while_play_is_stopped() {
    let mut scene = Scene::in_play(Size::Three);
    scene.ball([0.1, 0.1]);
    scene.first_event(6.0).expect("it is stuck");
    assert_eq!(scene.run(8.0), [], "the ball waits for its kick");
    assert_eq!(scene.game.command, Command::NormalStart);
    let (nth, event) = scene.first_event(6.0).expect("nobody plays it");
    assert_eq!((nth, event.kind), (steps(5.0), NoProgressInGame));
}

#[test]
fn a_ball_that_is_stuck_with_two_defenders_is_one_foul() {
    // The defenders' time is as long as that of a stuck ball.
    for size in Size::BOTH {
        let mut config = size.config();
        config.held_ball_seconds = config.no_progress_seconds;
        let mut scene = Scene::in_play_with(size, config);
        crate::crowds::defend(&mut scene, Team::Blue, 2);
        scene.ball([-goal_area(size) - 0.05, 0.0]);
        let (nth, event) = scene.first_event(6.0).expect("a foul");
        assert_eq!((nth, event.team), (steps(5.0), Some(Team::Blue)));
        assert_eq!(event.kind.code(), 31);
    }
}

#[test]
fn other_times_and_switches_are_obeyed() {
    let mut config = Size::Three.config();
    config.no_progress_seconds = 0.0;
    let mut scene = Scene::in_play_with(Size::Three, config.clone());
    assert_eq!(scene.run(1.0), [], "the ball rolls");
    scene.ball([0.1, 0.1]);
    assert_eq!(scene.first_event(1.0).expect("it is stuck").0, 1);
    config.off = vec!["NO_PROGRESS_IN_GAME".to_owned(), "KEEPER_HELD_BALL".to_owned()];
    for x in [0.1, 0.7] {
        let mut scene = Scene::in_play_with(Size::Three, config.clone());
        scene.ball([x, 0.1]);
        assert_eq!(scene.run(6.0), []);
    }
}
