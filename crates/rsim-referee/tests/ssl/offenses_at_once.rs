//! Offenses that meet in a step: with others, with the ball out, and with the end of a half or of the match.

use rsim_referee::codes::Command::{DirectFree, Halt, PrepareKickoff};
use rsim_referee::codes::Stage;
use rsim_referee::config::HalfEnd;
use rsim_referee::events::EventKind::{
    AttackerTouchedBallInDefenseArea, BallLeftFieldTouchLine, BotCrashUnique,
    BotDribbledBallTooFar, BotKickedBallTooFast, MultipleFouls,
};

use crate::scene::{B, Bot, Scene, Side, Them, Us, views, views_with};

/// Lets a robot crash into one of the others in the next step.
fn crash(scene: &mut Scene, faster: Bot, slower: Bot) {
    scene.robot_velocity(faster, 2.0, 0.0);
    scene.settle();
    scene.collide(faster, slower, 2.0);
}

#[test]
fn a_foul_and_a_ball_out_in_a_step_are_both_events_and_the_ball_decides() {
    for mut scene in views(B) {
        scene.ball(0.0, 2.5);
        scene.settle();
        scene.touch((Them, 2));
        scene.step();
        scene.ball(0.0, 2.9);
        crash(&mut scene, (Us, 4), (Them, 4));
        scene.ball(0.0, 3.1);
        scene.step();
        scene.only(BotCrashUnique);
        scene.only(BallLeftFieldTouchLine);
        scene.expect_fouls(1, 0);
        scene.expect_next(DirectFree, Us, (0.0, 2.8));
    }
}

#[test]
fn two_fouls_of_a_team_in_a_step_count_twice_and_make_one_card() {
    for mut scene in views(B) {
        let team = scene.team(Us);
        scene.game.fouls[team] = 2;
        scene.robot((Us, 2), 3.6, 0.3);
        scene.ball(3.5, 0.3);
        scene.settle();
        crash(&mut scene, (Us, 4), (Them, 4));
        scene.touch((Us, 2));
        scene.step();
        scene.only(AttackerTouchedBallInDefenseArea);
        scene.only(BotCrashUnique);
        scene.only(MultipleFouls);
        scene.expect_fouls(4, 0);
        assert_eq!((scene.game.yellow_cards[team], scene.game.is_running()), (1, true));
    }
}

#[test]
fn fouls_of_both_teams_in_a_step_count_for_each_and_the_one_that_stops_play_decides() {
    for mut scene in views(B) {
        scene.ball(-1.0, 0.0);
        scene.settle();
        scene.touch((Us, 2));
        scene.step();
        scene.ball(-0.2, 0.0);
        scene.hold((Us, 2));
        scene.step();
        scene.expect_play();
        scene.ball(0.1, 0.0);
        scene.hold((Us, 2));
        crash(&mut scene, (Them, 4), (Us, 4));
        scene.step();
        scene.only(BotDribbledBallTooFar);
        scene.only(BotCrashUnique);
        scene.expect_fouls(1, 1);
        scene.expect_next(DirectFree, Them, (-1.0, 0.0));
    }
}

#[test]
fn a_foul_that_does_not_stop_play_leaves_the_others_their_advantage() {
    for mut scene in views(B) {
        scene.ball(1.0, 0.0);
        scene.settle();
        scene.ball_velocity(-7.0, 0.0, 0.0);
        scene.touch((Them, 2));
        scene.step();
        scene.only(BotKickedBallTooFast);
        assert!(scene.game.is_running());
        scene.ball_velocity(3.0, 0.0, 0.0);
        scene.ball(4.4, 0.0);
        scene.touch((Us, 2));
        scene.step();
        scene.ball(4.6, 0.0);
        scene.step();
        assert_eq!(scene.score(), (1, 0));
    }
}

/// Play in the last step of a half.
fn last_step(scene: &mut Scene, stage: Stage) {
    scene.game.stage = stage;
    scene.game.stage_steps_left = 1;
}

#[test]
fn a_foul_in_the_last_step_of_a_half_counts() {
    for stage in [Stage::FirstHalf, Stage::SecondHalf] {
        for mut scene in views_with(B, |rules| rules.half_end = HalfEnd::AtOnce) {
            let team = scene.team(Us);
            (scene.game.fouls[team], scene.game.score[team]) = (2, 1);
            last_step(&mut scene, stage);
            crash(&mut scene, (Us, 4), (Them, 4));
            scene.step();
            scene.only(BotCrashUnique);
            scene.only(MultipleFouls);
            assert_eq!(scene.game.yellow_cards[team], 1);
            if stage == Stage::FirstHalf {
                scene.expect_next_for(
                    PrepareKickoff(scene.game.first_kickoff.opponent()),
                    (0.0, 0.0),
                );
            } else {
                assert_eq!((scene.game.stage, scene.game.command), (Stage::PostGame, Halt));
            }
        }
    }
}

#[test]
fn after_the_match_nothing_counts_any_more() {
    for mut scene in views_with(B, |rules| rules.half_end = HalfEnd::AtOnce) {
        let team = scene.team(Us);
        (scene.game.fouls[team], scene.game.score[team]) = (2, 1);
        last_step(&mut scene, Stage::SecondHalf);
        scene.step();
        assert_eq!(scene.game.stage, Stage::PostGame);
        let end = scene.game.clone();
        crash(&mut scene, (Us, 4), (Them, 4));
        scene.step();
        assert_eq!(scene.events(), []);
        crash(&mut scene, (Them, 4), (Us, 4));
        scene.ball(4.4, 0.0);
        scene.touch((Us, 2));
        scene.step();
        scene.ball(4.6, 0.0);
        scene.step();
        assert_eq!((scene.events(), scene.restarted), (&[][..], false));
        assert_eq!(scene.score(), (1, 0));
        let now = Side::BOTH.map(|side| scene.game.fouls[scene.team(side)]);
        assert_eq!(now, Side::BOTH.map(|side| end.fouls[scene.team(side)]));
        assert_eq!(scene.game.yellow_cards, end.yellow_cards);
    }
}
