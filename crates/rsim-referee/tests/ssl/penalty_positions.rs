//! "Penalty Kick": the keeper on its line until the kick, and the others behind the ball.

use rsim_referee::codes::Command::{DirectFree, PrepareKickoff};
use rsim_referee::events::EventKind::{Goal, PenaltyKickFailed, UnsportingBehaviorMinor};

use crate::scene::{A, B, Bot, Scene, Them, Us, views, views_with};

/// Checks that a robot of the defenders broke the rule: a goal, and no card.
fn expect_goal(scene: &Scene, bot: Bot, at: (f32, f32)) {
    scene.expect_bot(UnsportingBehaviorMinor, bot, at);
    assert_eq!((scene.only(Goal).side, scene.events().len()), (Some(Us), 2));
    assert_eq!(scene.score(), (1, 0));
    scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
    scene.expect_fouls(0, 0);
}

/// Checks that a robot of the attackers broke the rule: a goal kick, and no card.
fn expect_failed(scene: &Scene, bot: Bot, at: (f32, f32)) {
    scene.expect_bot(UnsportingBehaviorMinor, bot, at);
    assert_eq!((scene.only(PenaltyKickFailed).side, scene.events().len()), (Some(Us), 2));
    assert_eq!(scene.score(), (0, 0));
    scene.expect_next(DirectFree, Them, (3.5, 2.8));
    scene.expect_fouls(0, 0);
}

#[test]
fn a_keeper_that_leaves_its_line_before_the_kick_gives_a_goal() {
    for division in [A, B] {
        for mut scene in views(division) {
            let lines = &scene.referee.pitch().lines;
            let (x, post) = (lines.half_length, lines.half_goal_width);
            scene.penalty(Us);
            let out = (x - 0.1, 0.2);
            scene.robot((Them, 0), out.0, out.1);
            scene.step();
            expect_goal(&scene, (Them, 0), out);
            scene.penalty(Us);
            scene.robot((Them, 0), x, post);
            scene.step();
            scene.expect_bot(UnsportingBehaviorMinor, (Them, 0), (x, post));
        }
    }
}

#[test]
fn a_keeper_that_touches_its_line_may_move_between_the_posts() {
    for mut scene in views(B) {
        scene.penalty(Us);
        for (x, y) in [(4.42, 0.0), (4.5, 0.4), (4.58, -0.4), (4.42, 0.4)] {
            scene.robot((Them, 0), x, y);
            scene.robot_velocity((Them, 0), 0.0, 2.0);
            scene.step();
            scene.expect_play();
        }
    }
}

#[test]
fn the_keeper_may_leave_its_line_with_the_kick() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.robot((Them, 0), 4.3, 0.0);
        scene.kick((Us, 1), -1.4, 0.0);
        scene.expect_play();
        scene.robot((Them, 0), 3.5, 0.2);
        scene.step();
        scene.expect_play();
    }
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), -1.46, 0.0);
        scene.expect_play();
        scene.robot((Them, 0), 4.3, 0.0);
        scene.step();
        expect_goal(&scene, (Them, 0), (4.3, 0.0)); // the ball has moved 4 cm only
    }
}

#[test]
fn the_keeper_of_the_kicking_team_is_one_of_the_others() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.robot((Us, 0), -2.3, 1.0);
        scene.step();
        expect_failed(&scene, (Us, 0), (-2.3, 1.0));
    }
}

#[test]
fn a_robot_that_comes_near_the_ball_decides_the_kick() {
    for is_kicked in [false, true] {
        for mut scene in views(B) {
            scene.penalty(Us);
            if is_kicked {
                scene.kick((Us, 1), -1.2, 0.0);
            }
            scene.robot((Them, 3), -1.8, 1.0);
            scene.step();
            expect_goal(&scene, (Them, 3), (-1.8, 1.0));
        }
        for mut scene in views(B) {
            scene.penalty(Us);
            if is_kicked {
                scene.kick((Us, 1), -1.2, 0.0);
            }
            scene.robot((Us, 3), -1.8, 1.0);
            scene.step();
            expect_failed(&scene, (Us, 3), (-1.8, 1.0));
        }
    }
}

#[test]
fn robots_a_meter_behind_the_ball_keep_to_their_positions() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.robot((Them, 3), -2.51, 1.0);
        scene.robot((Us, 3), -2.51, -1.0);
        scene.step();
        scene.expect_play();
        // They may follow a ball that is on its way.
        scene.kick((Us, 1), 0.0, 0.0);
        scene.robot((Them, 3), -1.1, 1.0);
        scene.robot((Us, 3), -1.1, -1.0);
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn a_ball_that_the_keeper_sends_back_makes_nobody_an_offender() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.kick((Us, 1), 4.2, 0.0);
        scene.robot((Them, 3), 3.1, 1.0);
        scene.ball_velocity(5.0, 0.0, 0.0);
        scene.step();
        scene.touch((Them, 0));
        scene.ball(4.0, 0.0);
        scene.ball_velocity(-5.0, 0.0, 0.0);
        scene.step();
        assert_eq!(scene.count_of(UnsportingBehaviorMinor), 0);
        scene.only(PenaltyKickFailed);
    }
}

#[test]
fn the_kicker_is_the_nearest_robot_and_may_be_anywhere() {
    for mut scene in views(B) {
        scene.penalty(Us);
        for (x, y) in [(-1.7, 0.3), (-1.5, -0.2), (-1.2, 0.0)] {
            scene.robot((Us, 1), x, y);
            scene.step();
            scene.expect_play();
        }
        scene.robot((Us, 2), -2.0, 0.4);
        scene.step();
        expect_failed(&scene, (Us, 2), (-2.0, 0.4));
    }
}

#[test]
fn of_offenders_of_both_teams_the_defender_decides() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.robot((Us, 3), -1.8, 1.0);
        scene.robot((Them, 3), -1.8, -1.0);
        scene.step();
        assert_eq!((scene.count_of(UnsportingBehaviorMinor), scene.score()), (2, (1, 0)));
    }
}

#[test]
fn positions_are_judged_only_from_the_permission_on_and_where_the_rule_is_on() {
    for mut scene in views(B) {
        scene.penalty(Us);
        scene.free();
        scene.robot((Them, 0), 4.0, 0.0);
        scene.robot((Them, 3), -1.8, 1.0);
        scene.step();
        scene.expect_play();
    }
    for mut scene in views_with(B, |rules| rules.off = vec!["UNSPORTING_BEHAVIOR_MINOR".into()]) {
        scene.penalty(Us);
        scene.robot((Them, 0), 4.0, 0.0);
        scene.robot((Us, 3), -1.8, 1.0);
        scene.step();
        scene.expect_play();
    }
}
