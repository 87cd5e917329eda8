//! "Penalty Kick".

use rsim_referee::codes::Command::{DirectFree, NormalStart, PrepareKickoff, PreparePenalty};
use rsim_referee::events::EventKind::{
    BallLeftFieldGoalLine, BotCrashDrawn, BotCrashUnique, BotDribbledBallTooFar,
    DefenderInDefenseArea, Goal, InvalidGoal, NoProgressInGame, PenaltyKickFailed,
};

use crate::scene::{A, B, Scene, Side, Them, Us, expect_near, views, views_with};

/// Checks that a penalty kick of ours failed: goal kick of the others, on a side of the field.
fn expect_failed(scene: &Scene, side: f32) {
    let event = scene.only(PenaltyKickFailed);
    assert_eq!((event.side, event.bot), (Some(Us), None));
    assert_eq!(scene.score(), (0, 0));
    let lines = &scene.referee.pitch().lines;
    let place = (lines.half_length - 1.0, (lines.half_width - 0.2) * side);
    scene.expect_next(DirectFree, Them, place);
}

#[test]
fn the_kicker_keeper_and_the_others_take_their_places() {
    for division in [A, B] {
        for mut scene in views(division) {
            scene.penalty(Us);
            let mark = scene.penalty_mark(Us);
            expect_near(scene.ball_at(), mark);
            assert_eq!(scene.game.penalty_taker(), Some(scene.team(Us)));
            let (x, y) = scene.robot_at((Them, 0)).expect("the keeper");
            let lines = &scene.referee.pitch().lines;
            assert!((x - lines.half_length).abs() <= 0.09 && y.abs() <= lines.half_goal_width);
            let behind = |bot| mark.0 - scene.robot_at(bot).expect("present").0 >= 1.09 - 1e-4;
            let size = scene.size();
            assert!((1..size).all(|number| behind((Them, number))));
            assert!((0..size).filter(|number| !behind((Us, *number))).count() <= 1);
        }
    }
}

#[test]
fn a_goal_counts_even_from_high_up_with_too_many_robots_and_after_a_foul() {
    for division in [A, B] {
        for mut scene in views(division) {
            scene.penalty(Us);
            let team = scene.team(Us);
            scene.game.yellow_steps_left[team] = [1000, 0];
            scene.game.foul_steps[team] = 1;
            let (x, _) = scene.penalty_mark(Us);
            scene.kick((Us, 1), x + 0.5, 0.0);
            scene.ball(x + 1.0, 0.0);
            scene.ball_height(0.5);
            scene.step();
            let goal_line = scene.referee.pitch().lines.half_length;
            scene.ball(goal_line - 0.1, 0.1);
            scene.settle();
            scene.ball(goal_line + 0.1, 0.1);
            scene.step();
            let event = scene.only(Goal);
            assert_eq!((event.side, event.bot), (Some(Us), Some((Us, 1))));
            assert_eq!(scene.count_of(InvalidGoal) + scene.count_of(PenaltyKickFailed), 0);
            assert_eq!(scene.score(), (1, 0));
            scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
        }
    }
}

#[test]
fn a_keeper_that_turns_the_ball_by_a_right_angle_saves() {
    for (after, is_saved) in [((-1.0, 1.0), true), ((-0.1, 2.0), true), ((0.5, 2.0), false)] {
        for mut scene in views(B) {
            scene.penalty(Us);
            scene.kick((Us, 1), 2.0, 0.3);
            scene.ball(4.2, 0.3);
            scene.ball_velocity(3.0, 0.0, 0.0);
            scene.settle();
            scene.ball(4.25, 0.35);
            scene.ball_velocity(after.0, after.1, 0.0);
            scene.touch((Them, 0));
            scene.step();
            assert_eq!(scene.count_of(PenaltyKickFailed), usize::from(is_saved), "{after:?}");
            if is_saved {
                expect_failed(&scene, 1.0);
            }
        }
    }
}

#[test]
fn only_a_touch_of_the_keeper_saves() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), 2.0, 0.3);
        scene.ball(2.5, 0.3);
        scene.ball_velocity(3.0, 0.0, 0.0);
        scene.settle();
        scene.ball(2.52, 0.35);
        scene.ball_velocity(-0.1, 3.0, 0.0);
        scene.touch((Us, 1));
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn a_ball_out_ends_it() {
    for (from, to, side) in [((4.4, -2.0), (4.6, -2.0), -1.0), ((3.0, 2.95), (3.0, 3.05), 1.0)] {
        for mut scene in views(B) {
            scene.penalty(Us);
            scene.kick((Us, 1), from.0, from.1);
            scene.ball(to.0, to.1);
            scene.step();
            expect_failed(&scene, side);
        }
    }
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), 4.4, 2.0);
        scene.touch((Them, 0));
        scene.ball(4.6, 2.0);
        scene.step();
        scene.only(BallLeftFieldGoalLine);
        expect_failed(&scene, 1.0); // and no corner kick
    }
}

#[test]
fn the_ball_must_not_move_back() {
    for (back, fails) in [(0.04, false), (0.06, true)] {
        for mut scene in views(B) {
            scene.penalty(Us);
            scene.kick((Us, 1), -1.0, 0.4);
            scene.kick((Us, 1), -1.0 - back, -0.4);
            assert_eq!(scene.count_of(PenaltyKickFailed), usize::from(fails), "{back}");
        }
    }
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), -1.6, 0.1);
        expect_failed(&scene, 1.0);
    }
}

#[test]
fn it_ends_after_ten_seconds() {
    for moves in [true, false] {
        for mut scene in views(A) {
            scene.penalty(Us);
            if moves {
                let (x, _) = scene.penalty_mark(Us);
                scene.kick((Us, 1), x + 0.2, 0.1);
            }
            scene.run(10.0, |scene| scene.game.command_steps == 400);
            scene.expect_play();
            scene.step();
            expect_failed(&scene, 1.0);
            assert_eq!(scene.count_of(NoProgressInGame), 0);
        }
    }
}

#[test]
fn a_ball_that_nobody_kicks_is_not_in_play_after_the_time_of_a_free_kick() {
    for mut scene in views(A) {
        scene.penalty(Us);
        scene.run(9.0, |scene| scene.game.command_steps == 360);
        assert!(!scene.game.in_play);
        let (x, _) = scene.penalty_mark(Us);
        scene.kick((Us, 1), x + 0.2, 0.1);
        assert!(scene.game.in_play);
    }
}

#[test]
fn a_kicker_just_behind_the_ball_stays_where_it_is() {
    for mut scene in views(B) {
        let (x, y) = scene.penalty_mark(Us);
        scene.robot((Us, 1), x - 0.3, y);
        scene.penalty(Us);
        expect_near(scene.robot_at((Us, 1)).expect("present"), (x - 0.3, y));
    }
}

#[test]
fn a_foul_of_the_defenders_is_a_goal() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), 0.0, 0.0);
        scene.robot_velocity((Them, 0), -2.0, 0.0);
        scene.settle();
        scene.collide((Us, 1), (Them, 0), 2.0);
        scene.step();
        scene.only(BotCrashUnique);
        assert_eq!(scene.only(Goal).side, Some(Us));
        assert_eq!(scene.score(), (1, 0));
        scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
        scene.expect_fouls(0, 1);
    }
    for mut scene in views_with(B, |rules| rules.off = vec!["UNSPORTING_BEHAVIOR_MINOR".into()]) {
        scene.penalty(Us);
        scene.kick((Us, 1), 3.0, 0.0);
        scene.robot((Them, 3), 4.0, 0.0);
        scene.touch((Them, 3));
        scene.step();
        scene.only(DefenderInDefenseArea);
        assert_eq!(scene.score(), (1, 0));
        scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
    }
}

#[test]
fn a_foul_of_the_attackers_ends_it() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), 0.0, 0.5);
        scene.robot_velocity((Us, 1), 2.0, 0.0);
        scene.settle();
        scene.collide((Us, 1), (Them, 0), 2.0);
        scene.step();
        scene.only(BotCrashUnique);
        expect_failed(&scene, 1.0);
        scene.expect_fouls(1, 0);
    }
    for mut scene in views(B) {
        scene.penalty(Us);
        for x in [-1.4, -1.0, -0.6, -0.3] {
            scene.robot((Us, 1), x - 0.1, 0.1);
            scene.kick((Us, 1), x, 0.1);
        }
        scene.only(BotDribbledBallTooFar);
        expect_failed(&scene, 1.0);
    }
}

#[test]
fn a_foul_of_both_decides_nothing() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), 0.0, 0.5);
        scene.robot_velocity((Us, 1), 1.0, 0.0);
        scene.robot_velocity((Them, 0), -1.0, 0.0);
        scene.settle();
        scene.collide((Us, 1), (Them, 0), 2.0);
        scene.step();
        scene.only(BotCrashDrawn);
        scene.expect_fouls(1, 1);
        assert!(scene.game.is_running());
    }
}

#[test]
fn the_kicker_may_touch_the_ball_again() {
    for mut scene in views(B) {
        scene.penalty(Us);
        for x in [-1.3, -1.2] {
            scene.kick((Us, 1), x, 0.0);
            scene.expect_play();
        }
    }
}

#[test]
fn a_card_does_not_interrupt_it() {
    for side in Side::BOTH {
        for mut scene in views(B) {
            scene.penalty(Us);
            let team = scene.team(side);
            scene.game.yellow_steps_left[team] = [4800, 0];
            scene.game.removal_steps_left[team] = 2;
            scene.wait(1.0);
            scene.expect_play();
        }
    }
}

#[test]
fn before_the_permission_nothing_counts() {
    for mut scene in views(B) {
        scene.stop(PreparePenalty, Us, (-1.5, 0.0));
        scene.run(4.0, |scene| scene.game.command == PreparePenalty(scene.team(Us)));
        scene.touch((Us, 1));
        scene.ball(-1.2, 0.0);
        scene.step();
        assert_eq!(scene.events(), []);
        scene.run(11.0, |scene| scene.game.command == NormalStart);
        expect_near(scene.ball_at(), (-1.5, 0.0));
    }
}
