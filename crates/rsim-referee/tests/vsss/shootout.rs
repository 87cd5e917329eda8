//! The shoot-out: alternating penalty kicks.

use rsim_referee::Team;
use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::RefereeConfig;
use rsim_referee::events::{Event, EventKind};
use rsim_referee::game::Game;

use crate::crowds::{attack, defend, goal_area};
use crate::pitches::{BALL_RADIUS, Size};
use crate::scene::{Scene, seen_by, steps};

/// A drawn match at the first kick of the shoot-out, with the ball on its mark and the other robots away.
fn kick(size: Size, first: Team) -> Scene {
    let config = RefereeConfig { half_seconds: 1.0, extra_half_seconds: 0.0, ..size.config() };
    let mut scene = Scene::with(config, size.pitch(), [size.robots(); 2]);
    scene.game = Game::new(first);
    for _ in 0..steps(14.0) {
        scene.roll([0.0, 0.0], [1.0, 0.0]);
        assert_eq!(scene.step(), []);
    }
    assert_eq!(scene.game.stage, Stage::Shootout);
    assert_eq!(scene.game.next_command, Some(Command::PreparePenalty(first)));
    begin_kick(&mut scene, first);
    scene
}

/// Waits for a kick, and takes the robots away from the ball.
fn begin_kick(scene: &mut Scene, taker: Team) {
    scene.wait_for(Command::PreparePenalty(taker));
    let mark = scene.referee.pitch().lines.penalty_mark(taker);
    assert!(scene.ball_position().distance(mark) < 1e-6);
    assert_eq!(scene.wait_for(Command::NormalStart), steps(4.0));
    scene.park();
}

/// Takes a kick, with or without a goal.
fn take(scene: &mut Scene, taker: Team, is_goal: bool) -> Event {
    if is_goal {
        let x = scene.referee.pitch().lines.half_length + BALL_RADIUS + 0.01;
        scene.roll(seen_by(taker, [x, 0.0]), [1.0, 0.0]);
        scene.step_to(EventKind::Goal)
    } else {
        scene.roll(seen_by(taker, [-0.001, 0.0]), [1.0, 0.0]);
        scene.step_to(EventKind::PenaltyKickFailed)
    }
}

/// All sizes, and teams that kick first.
fn each(check: impl Fn(Size, Team)) {
    for size in Size::BOTH {
        for taker in Team::BOTH {
            check(size, taker);
        }
    }
}

#[test]
fn the_teams_take_turns_until_one_cannot_catch_up() {
    each(|size, first| {
        let mut scene = kick(size, first);
        for (nth, is_goal) in [true, false, true, false, true].into_iter().enumerate() {
            let taker = if nth % 2 == 0 { first } else { first.opponent() };
            take(&mut scene, taker, is_goal);
            assert_eq!((scene.game.stage, scene.game.command), (Stage::Shootout, Command::Stop));
            begin_kick(&mut scene, taker.opponent());
        }
        take(&mut scene, first.opponent(), false);
        assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Command::Halt));
        assert_eq!(scene.game.score[first], 3);
        assert_eq!(scene.game.score[first.opponent()], 0);
    });
}

#[test]
fn after_five_each_a_pair_of_kicks_decides() {
    let mut scene = kick(Size::Three, Team::Yellow);
    let mut taker = Team::Yellow;
    for _ in 0..11 {
        take(&mut scene, taker, true);
        taker = taker.opponent();
        begin_kick(&mut scene, taker);
    }
    take(&mut scene, taker, false);
    assert_eq!(scene.game.stage, Stage::PostGame);
    assert_eq!(scene.game.score[Team::Yellow], 6);
    assert_eq!(scene.game.score[Team::Blue], 5);
}

#[test]
fn the_next_kick_comes_after_a_stop_that_is_longer_after_a_goal() {
    each(|size, taker| {
        for (is_goal, seconds) in [(true, 8.0), (false, 4.0)] {
            let mut scene = kick(size, taker);
            take(&mut scene, taker, is_goal);
            let next = Command::PreparePenalty(taker.opponent());
            assert_eq!(scene.game.next_command, Some(next));
            assert_eq!(scene.wait_for(next), steps(seconds));
        }
    });
}

#[test]
fn a_kick_fails_when_the_ball_comes_back_to_the_own_half() {
    each(|size, taker| {
        let mut scene = kick(size, taker);
        scene.roll(seen_by(taker, [0.001, 0.3]), [1.0, 0.0]);
        assert_eq!(scene.step(), [], "it is still in the other half");
        scene.roll(seen_by(taker, [-0.001, 0.3]), [1.0, 0.0]);
        assert_eq!(scene.step_to(EventKind::PenaltyKickFailed).team, Some(taker));
    });
}

#[test]
fn a_kick_fails_when_the_ball_leaves_the_area_after_it_was_in_it() {
    each(|size, taker| {
        let mut scene = kick(size, taker);
        let front = if size == Size::Five { 0.75 } else { 0.6 };
        for x in [front - 0.01, front + 0.01, front + 0.1] {
            scene.roll(seen_by(taker, [x, 0.0]), [1.0, 0.0]);
            assert_eq!(scene.step(), []);
        }
        scene.roll(seen_by(taker, [front - 0.01, 0.0]), [1.0, 0.0]);
        let event = scene.step_to(EventKind::PenaltyKickFailed);
        assert_eq!((event.team, event.robot), (Some(taker), None));
        assert_eq!(event.position, scene.ball_position());
    });
}

#[test]
fn a_kick_fails_when_the_ball_is_stuck_in_the_goal_area_too() {
    each(|size, taker| {
        for x in [0.3, goal_area(size) + 0.02] {
            let mut scene = kick(size, taker);
            scene.ball(seen_by(taker, [x, 0.1]));
            scene.step();
            let (_, event) = scene.first_event(6.0).expect("it ends");
            assert_eq!((event.kind, event.team), (EventKind::PenaltyKickFailed, Some(taker)));
            let passed = scene.game.shootout_kicks[taker];
            assert_eq!(passed, 1);
        }
    });
}

#[test]
fn a_kick_fails_after_ten_seconds() {
    each(|size, taker| {
        let mut scene = kick(size, taker);
        scene.roll(seen_by(taker, [0.3, 0.3]), [1.0, 0.0]);
        let (nth, event) = scene.first_event(11.0).expect("it ends");
        assert_eq!((nth, event.kind), (steps(10.0), EventKind::PenaltyKickFailed));
    });
}

#[test]
fn a_goal_in_the_last_step_of_a_kick_counts() {
    each(|size, taker| {
        let mut scene = kick(size, taker);
        scene.roll(seen_by(taker, [0.3, 0.1]), [1.0, 0.0]);
        assert_eq!(scene.run(9.975), []);
        take(&mut scene, taker, true);
        assert_eq!(scene.game.score[taker], 1);
        assert_eq!(scene.game.shootout_kicks[taker], 1);
    });
}

#[test]
fn a_kick_does_not_fail_before_it_may_be_taken() {
    each(|size, taker| {
        let mut scene = kick(size, taker);
        take(&mut scene, taker, false);
        let other = taker.opponent();
        scene.wait_for(Command::PreparePenalty(other));
        scene.roll(seen_by(other, [-0.1, 0.3]), [1.0, 0.0]);
        assert_eq!(scene.run(4.0), []);
        assert_eq!(scene.game.command, Command::NormalStart);
        let mark = scene.referee.pitch().lines.penalty_mark(other);
        assert!(scene.ball_position().distance(mark) < 1e-6, "the ball is put back");
    });
}

#[test]
fn crowds_are_not_judged_in_the_shoot_out() {
    each(|size, taker| {
        let mut scene = kick(size, taker);
        attack(&mut scene, taker, 2);
        defend(&mut scene, taker.opponent(), 2);
        assert_eq!(scene.run(5.0), []);
        take(&mut scene, taker, true);
        assert_eq!(scene.game.score[taker], 1);
    });
}

#[test]
fn a_penalty_kick_of_a_half_does_not_fail() {
    each(|size, taker| {
        let mut scene = Scene::in_play(size);
        defend(&mut scene, taker.opponent(), 2);
        scene.first_event(4.0).expect("a foul");
        scene.wait_for(Command::NormalStart);
        scene.park();
        scene.roll(seen_by(taker, [-0.1, 0.3]), [1.0, 0.0]);
        assert_eq!(scene.run(11.0), [], "play goes on");
        assert!(scene.game.in_play);
    });
}

#[test]
fn without_a_shoot_out_a_draw_is_the_end() {
    let config = RefereeConfig {
        half_seconds: 1.0,
        extra_half_seconds: 0.0,
        shootout_kicks: 0.0,
        ..Size::Three.config()
    };
    let mut scene = Scene::with(config, Size::Three.pitch(), [3, 3]);
    for _ in 0..steps(18.0) {
        scene.roll([0.0, 0.0], [1.0, 0.0]);
        scene.step();
    }
    assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Command::Halt));
}
