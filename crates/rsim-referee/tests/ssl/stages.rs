//! "Game Structure": halves, the clock, extra time, the end of a match.

use rsim_referee::Team;
use rsim_referee::codes::Command::{
    self, DirectFree, Halt, NormalStart, PrepareKickoff, PreparePenalty, Stop,
};
use rsim_referee::codes::Stage;
use rsim_referee::config::{Clock, HalfEnd, RefereeConfig};
use rsim_referee::events::EventKind::{DefenderInDefenseArea, Goal, PenaltyKickFailed};

use crate::scene::{B, Scene, Them, Us, views, views_with};

fn at_once(config: &mut RefereeConfig) {
    config.half_end = HalfEnd::AtOnce;
}

/// The half has so many steps left.
fn steps_left(scene: &mut Scene, stage: Stage, steps: i32) {
    (scene.game.stage, scene.game.stage_steps_left) = (stage, steps);
}

/// The ball enters their goal.
fn score(scene: &mut Scene) {
    scene.ball(4.4, 0.2);
    scene.settle();
    scene.touch((Us, 1));
    scene.robot((Us, 1), 3.0, 0.2);
    scene.ball(4.6, 0.2);
    scene.step();
    scene.only(Goal);
}

/// Stops play by a ball over the touch line.
fn ball_out(scene: &mut Scene) {
    scene.ball(1.0, 2.9);
    scene.settle();
    scene.ball(1.0, 3.1);
    scene.step();
}

#[test]
fn the_first_half_begins_when_its_kick_off_may_be_taken() {
    for mut scene in views(B) {
        scene.game = rsim_referee::game::Game::new(scene.team(Us));
        scene.step();
        assert_eq!((scene.game.stage, scene.game.stage_steps_left), (Stage::FirstHalfPre, 0));
        scene.run(11.0, |scene| scene.game.command == NormalStart);
        assert_eq!(scene.game.stage, Stage::FirstHalf);
        assert_eq!(scene.game.stage_steps_left, scene.steps(300.0));
    }
}

#[test]
fn the_clock_stands_in_stops_and_runs_while_a_team_may_play() {
    for (clock, in_stop) in [(Clock::Stopped, 0), (Clock::Running, 40)] {
        for mut scene in views_with(B, |config| config.clock = clock) {
            let left = |scene: &Scene| scene.game.stage_steps_left;
            let before = left(&scene);
            scene.wait(1.0);
            assert_eq!(before - left(&scene), 40);
            scene.stop(PrepareKickoff, Us, (0.0, 0.0));
            scene.wait(1.0);
            assert_eq!(before - left(&scene), 40 + in_stop);
            scene.run(20.0, |scene| scene.game.command == NormalStart);
            let before = left(&scene);
            scene.wait(1.0);
            assert_eq!(before - left(&scene), 40, "a kick-off may be taken");
        }
    }
}

#[test]
fn a_half_ends_at_the_next_stop_or_at_once() {
    for mut scene in views(B) {
        steps_left(&mut scene, Stage::FirstHalf, 2);
        scene.wait(1.0);
        assert_eq!(scene.game.stage, Stage::FirstHalf);
        scene.expect_play();
        ball_out(&mut scene);
        assert_eq!(scene.game.stage, Stage::SecondHalfPre);
        let first = scene.game.first_kickoff;
        scene.expect_next_for(PrepareKickoff(first.opponent()), (0.0, 0.0));
    }
    for mut scene in views_with(B, at_once) {
        steps_left(&mut scene, Stage::FirstHalf, 2);
        scene.step();
        assert_eq!(scene.game.stage, Stage::FirstHalf);
        scene.step();
        assert_eq!(scene.game.stage, Stage::SecondHalfPre);
        assert_eq!(scene.game.command, Stop);
    }
}

#[test]
fn a_stop_before_time_is_up_ends_nothing() {
    for mut scene in views(B) {
        steps_left(&mut scene, Stage::FirstHalf, 100);
        ball_out(&mut scene);
        assert_eq!(scene.game.stage, Stage::FirstHalf);
    }
}

#[test]
fn time_that_is_up_in_a_stop_ends_the_half_there() {
    let running = |config: &mut RefereeConfig| config.clock = Clock::Running;
    for mut scene in views_with(B, running) {
        scene.stop(DirectFree, Us, (1.0, 1.0));
        steps_left(&mut scene, Stage::FirstHalf, 20);
        scene.wait(0.5);
        assert_eq!(scene.game.stage, Stage::SecondHalfPre);
    }
}

#[test]
fn the_second_half_is_played_after_its_kick_off() {
    for mut scene in views(B) {
        steps_left(&mut scene, Stage::FirstHalf, 1);
        let kicking = scene.game.first_kickoff.opponent();
        scene.game.placement_failures[Team::Blue] = 5;
        scene.step();
        ball_out(&mut scene);
        assert_eq!(scene.game.placement_failures[Team::Blue], 0, "for the rest of the half");
        scene.run(5.0, |scene| scene.game.command == PrepareKickoff(kicking));
        scene.run(11.0, |scene| scene.game.command == NormalStart);
        assert_eq!(scene.game.stage, Stage::SecondHalf);
        assert_eq!(scene.game.stage_steps_left, scene.steps(300.0));
    }
}

#[test]
fn a_goal_in_the_last_step_of_a_half_counts() {
    for stage in [Stage::FirstHalf, Stage::SecondHalf] {
        for half_end in [HalfEnd::AtOnce, HalfEnd::NextStop] {
            for mut scene in views_with(B, |config| config.half_end = half_end) {
                steps_left(&mut scene, stage, 1);
                score(&mut scene);
                assert_eq!(scene.score(), (1, 0));
                if stage == Stage::FirstHalf {
                    assert_eq!(scene.game.stage, Stage::SecondHalfPre);
                    let kicking = scene.game.first_kickoff.opponent();
                    scene.expect_next_for(PrepareKickoff(kicking), (0.0, 0.0));
                } else {
                    assert_eq!(scene.game.stage, Stage::PostGame);
                }
            }
        }
    }
}

#[test]
fn a_match_that_is_won_is_over() {
    for mut scene in views(B) {
        let team = scene.team(Them);
        scene.game.score[team] = 1;
        steps_left(&mut scene, Stage::SecondHalf, 1);
        scene.step();
        ball_out(&mut scene);
        assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Halt));
        assert_eq!(scene.game.next_command, None);
        scene.wait(20.0);
        assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Halt));
        assert!(!scene.game.is_running());
    }
}

#[test]
fn a_draw_is_followed_by_extra_time_and_a_shoot_out() {
    for mut scene in views(B) {
        for (stage, next, seconds) in [
            (Stage::SecondHalf, Stage::ExtraFirstHalf, 150.0),
            (Stage::ExtraFirstHalf, Stage::ExtraSecondHalf, 150.0),
        ] {
            steps_left(&mut scene, stage, 1);
            scene.step();
            ball_out(&mut scene);
            scene.run(20.0, |scene| scene.game.command == NormalStart);
            assert_eq!(scene.game.stage, next);
            assert_eq!(scene.game.stage_steps_left, scene.steps(seconds));
            scene.free();
        }
        steps_left(&mut scene, Stage::ExtraSecondHalf, 1);
        scene.step();
        ball_out(&mut scene);
        assert_eq!(scene.game.stage, Stage::Shootout);
        let first = scene.game.first_kickoff;
        let x = if first == scene.team(Us) { -1.5 } else { 1.5 };
        scene.expect_next_for(PreparePenalty(first), (x, 0.0));
    }
}

#[test]
fn teams_take_turns_at_the_kick_offs_of_halves() {
    for mut scene in views(B) {
        let first = scene.game.first_kickoff;
        for (stage, kicking) in [
            (Stage::FirstHalf, first.opponent()),
            (Stage::SecondHalf, first),
            (Stage::ExtraFirstHalf, first.opponent()),
        ] {
            steps_left(&mut scene, stage, 0);
            ball_out(&mut scene);
            assert_eq!(scene.game.next_command, Some(PrepareKickoff(kicking)), "{stage:?}");
            scene.free();
        }
    }
}

#[test]
fn ten_goals_and_a_lead_of_two_end_a_match() {
    for (us, them, is_over) in [(9, 0, true), (9, 9, false), (9, 8, true), (8, 0, false)] {
        for mut scene in views(B) {
            let teams = (scene.team(Us), scene.team(Them));
            scene.game.score[teams.0] = us;
            scene.game.score[teams.1] = them;
            score(&mut scene);
            assert_eq!(scene.score(), (us + 1, them));
            assert_eq!(scene.game.stage == Stage::PostGame, is_over, "{us} {them}");
        }
    }
}

/// A second defender of theirs touches the ball in its area in the last step of a half.
fn penalty_in_the_last_step(scene: &mut Scene) {
    steps_left(scene, Stage::FirstHalf, 1);
    scene.robot((Them, 3), 4.0, 0.0);
    scene.touch((Them, 3));
    scene.step();
    scene.only(DefenderInDefenseArea);
    scene.expect_next(PreparePenalty, Us, (-1.5, 0.0));
}

#[test]
fn a_penalty_kick_is_taken_after_time_is_up() {
    for half_end in [HalfEnd::AtOnce, HalfEnd::NextStop] {
        for clock in [Clock::Stopped, Clock::Running] {
            let change = |config: &mut RefereeConfig| {
                (config.half_end, config.clock) = (half_end, clock);
            };
            for mut scene in views_with(B, change) {
                penalty_in_the_last_step(&mut scene);
                scene.run(20.0, |scene| scene.game.penalty_taker().is_some());
                assert_eq!(scene.game.stage, Stage::FirstHalf);
                scene.run(10.1, |scene| scene.game.command != NormalStart);
                scene.only(PenaltyKickFailed);
                assert_eq!(scene.game.stage, Stage::SecondHalfPre);
                let kicking = scene.game.first_kickoff.opponent();
                scene.expect_next_for(PrepareKickoff(kicking), (0.0, 0.0));
            }
        }
    }
    for mut scene in views_with(B, at_once) {
        penalty_in_the_last_step(&mut scene);
        scene.run(20.0, |scene| scene.game.penalty_taker().is_some());
        scene.kick((Us, 1), 0.0, 0.0);
        scene.robot((Them, 0), 4.5, 0.3);
        score(&mut scene);
        assert_eq!((scene.score(), scene.game.stage), ((1, 0), Stage::SecondHalfPre));
    }
}

#[test]
fn the_speed_of_robots_is_judged_anew_in_the_break() {
    for mut scene in views_with(B, at_once) {
        scene.stop(DirectFree, Us, (0.0, 0.0));
        scene.game.wait_steps = scene.steps(10.0);
        scene.robot_velocity((Them, 3), 1.6, 0.0);
        scene.wait(3.0);
        scene.expect_fouls(0, 1);
        scene.game.wait_steps = 0;
        scene.step();
        assert!(matches!(scene.game.command, Command::DirectFree(_)));
        steps_left(&mut scene, Stage::FirstHalf, 1);
        scene.step();
        assert_eq!(scene.game.stage, Stage::SecondHalfPre);
        scene.game.wait_steps = scene.steps(10.0);
        scene.robot_velocity((Them, 3), 1.6, 0.0);
        scene.wait(3.0);
        scene.expect_fouls(0, 2);
    }
}
