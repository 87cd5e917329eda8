//! Kick-offs and free kicks: how play goes on, and when the ball is in play.

use rsim_referee::codes::Command::{
    self, DirectFree, ForceStart, NormalStart, PrepareKickoff, Stop,
};
use rsim_referee::events::EventKind::{AttackerDoubleTouchedBall, NoProgressInGame};

use crate::scene::{A, B, Side, Them, Us, expect_near, views};

#[test]
fn a_stop_lasts_two_seconds_before_a_free_kick() {
    for mut scene in views(B) {
        scene.stop(DirectFree, Us, (1.0, 1.0));
        scene.wait(1.95);
        assert_eq!(scene.game.command, Stop);
        scene.wait(0.05);
        scene.expect_command(DirectFree, Us);
        assert_eq!(scene.game.next_command, None);
        assert!(!scene.game.in_play);
        expect_near(scene.ball_at(), (1.0, 1.0));
    }
}

#[test]
fn a_force_start_puts_the_ball_in_play_at_once() {
    for mut scene in views(B) {
        scene.stop_for(ForceStart, (1.0, 1.0));
        scene.wait(2.0);
        assert_eq!((scene.game.command, scene.game.in_play), (ForceStart, true));
    }
}

#[test]
fn a_kick_off_is_prepared_and_then_allowed() {
    for mut scene in views(B) {
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.wait(2.0);
        scene.expect_command(PrepareKickoff, Us);
        assert_eq!(scene.game.next_command, Some(NormalStart));
        scene.wait(1.95);
        scene.expect_command(PrepareKickoff, Us);
        scene.step();
        scene.step();
        assert_eq!((scene.game.command, scene.game.in_play), (NormalStart, false));
        assert_eq!(scene.game.kicking_team(), Some(scene.team(Us)));
    }
}

#[test]
fn robots_have_time_to_prepare_and_are_then_put_in_valid_places() {
    for mut scene in views(B) {
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.run(3.0, |scene| scene.game.command != Stop);
        scene.robot((Them, 3), -1.0, 1.0); // in the wrong half
        scene.wait(9.95);
        scene.expect_command(PrepareKickoff, Us);
        scene.run(0.1, |scene| scene.game.command == NormalStart);
        assert!(scene.robot_at((Them, 3)).expect("present").0 >= 0.09);
    }
    for mut scene in views(B) {
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.run(3.0, |scene| scene.game.command != Stop);
        scene.robot((Them, 3), -1.0, 1.0);
        scene.wait(5.0);
        scene.robot((Them, 3), 1.0, 1.0);
        scene.step();
        assert_eq!(scene.game.command, NormalStart, "all are ready");
    }
}

#[test]
fn the_ball_comes_into_play_by_its_way() {
    for mut scene in views(B) {
        scene.kickoff(Us);
        scene.kick((Us, 1), 0.03, 0.035);
        assert!(!scene.game.in_play);
        scene.kick((Us, 1), 0.035, 0.04);
        assert!(scene.game.in_play);
        scene.expect_play();
    }
}

#[test]
fn the_ball_comes_into_play_by_time() {
    for (division, seconds) in [(A, 5.0), (B, 10.0)] {
        for mut scene in views(division) {
            scene.free_kick(Us);
            scene.wait(seconds - 0.025);
            assert!(!scene.game.in_play && !scene.game.may_touch(scene.team(Them)));
            scene.step();
            assert!(scene.game.in_play && scene.game.may_touch(scene.team(Them)));
            scene.expect_play();
        }
        for mut scene in views(division) {
            scene.kickoff(Us);
            scene.wait(9.975);
            assert!(!scene.game.in_play);
            scene.step();
            assert!(scene.game.in_play);
        }
    }
}

#[test]
fn teams_may_touch_the_ball_as_the_command_says() {
    for mut scene in views(B) {
        let may = |scene: &crate::scene::Scene| {
            Side::BOTH.map(|side| scene.game.may_touch(scene.team(side)))
        };
        assert_eq!(may(&scene), [true, true]);
        scene.free_kick(Us);
        assert_eq!(may(&scene), [true, false]);
        scene.kickoff(Them);
        assert_eq!(may(&scene), [false, true]);
        scene.stop(DirectFree, Us, (0.0, 0.0));
        assert_eq!(may(&scene), [false, false]);
        let next = scene.game.next_command;
        scene.game.give(Command::BallPlacement(scene.team(Us)), next);
        assert_eq!(may(&scene), [true, false]);
        scene.game.give(Command::Halt, next);
        assert_eq!(may(&scene), [false, false]);
    }
}

#[test]
fn a_free_kick_after_an_offense_near_an_area_or_a_line_is_at_a_valid_place() {
    for (ball, place) in [
        ((3.9, 0.5), (2.5, 0.5)),
        ((3.0, -0.5), (2.5, -0.5)),
        ((4.4, 2.9), (4.3, 2.8)),
        ((4.2, 1.3), (4.2, 2.0)),
        ((-3.2, 1.4), (-2.9, 1.8)),
        ((0.0, -2.95), (0.0, -2.8)),
        ((1.0, 1.0), (1.0, 1.0)),
    ] {
        for mut scene in views(B) {
            scene.ball(ball.0, ball.1);
            scene.free_kick(Us);
            scene.game.in_play = true;
            let kicker = if scene.team(Us) == rsim_referee::Team::Blue { 4 } else { 10 };
            scene.game.kick_taker = Some(kicker);
            scene.touch((Us, 4));
            scene.step();
            scene.only(AttackerDoubleTouchedBall);
            scene.expect_next(DirectFree, Them, place);
        }
    }
}

#[test]
fn of_two_offenses_in_a_step_both_are_events_and_one_decides() {
    for mut scene in views(B) {
        scene.ball(1.0, 1.0);
        scene.settle();
        scene.wait(10.0);
        // The ball is stuck, and the kicker touches it again.
        let kicker = if scene.team(Us) == rsim_referee::Team::Blue { 4 } else { 10 };
        scene.game.kick_taker = Some(kicker);
        scene.touch((Us, 4));
        scene.step();
        scene.only(AttackerDoubleTouchedBall);
        scene.only(NoProgressInGame);
        scene.expect_next(DirectFree, Them, (1.0, 1.0));
    }
}
