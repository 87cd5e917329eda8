//! The ball leaves the field: "Throw-In", "Goal Kick", "Corner Kick", "Aimless Kick", "Boundary Crossing".

use rsim_referee::codes::Command::{DirectFree, ForceStart, NormalStart};
use rsim_referee::events::EventKind::{
    AimlessKick, BallLeftFieldGoalLine, BallLeftFieldTouchLine, BoundaryCrossing, InvalidGoal,
};

use crate::scene::{A, B, Scene, Side, Them, Us, views, views_with};

/// Distance beyond the middle of a line at which the ball has crossed it: half the line and the ball's radius.
const BEYOND: f32 = 0.005 + 0.0215;

/// A robot plays the ball from a place in its own half or in that of the others, and then it leaves.
fn play_out(scene: &mut Scene, side: Side, from: (f32, f32), to: (f32, f32)) {
    scene.ball(from.0, from.1);
    scene.settle();
    scene.touch((side, 3));
    scene.step();
    scene.expect_play();
    scene.ball(to.0, to.1);
    scene.step();
}

#[test]
fn a_ball_over_a_touch_line_is_thrown_in_by_the_others() {
    for division in [A, B] {
        for side in Side::BOTH {
            for mut scene in views(division) {
                let y = if division == A { 4.5 } else { 3.0 };
                play_out(&mut scene, side, (1.0, y - 0.1), (1.2, y + 0.1));
                let x = 1.0 + 0.2 * (0.1 + BEYOND) / 0.2;
                scene.expect_bot(BallLeftFieldTouchLine, (side, 3), (x, y + BEYOND));
                assert_eq!(scene.events().len(), 1);
                scene.expect_next(DirectFree, side.opponent(), (x, y - 0.2));
                scene.expect_fouls(0, 0);
                let (ball_x, ball_y) = scene.ball_at();
                assert!((ball_x - x).hypot(ball_y - y + 0.2) < 1e-3, "the ball is put there");
            }
        }
    }
}

#[test]
fn a_throw_in_keeps_its_distance_from_the_goal_lines() {
    for x in [4.45, -4.45] {
        for mut scene in views(B) {
            play_out(&mut scene, Us, (x, 2.95), (x, 3.05));
            scene.expect_next(DirectFree, Them, (4.3_f32.copysign(x), 2.8));
        }
    }
}

#[test]
fn a_ball_that_has_not_crossed_a_line_completely_is_on_the_field() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (1.0, 2.9), (1.0, 3.0 + BEYOND - 0.001));
        scene.expect_play();
        play_out(&mut scene, Us, (4.4, 2.0), (4.5 + BEYOND - 0.001, 2.0));
        scene.expect_play();
        scene.ball(4.5 + BEYOND + 0.001, 2.0);
        scene.step();
        scene.only(BallLeftFieldGoalLine);
    }
}

#[test]
fn over_the_line_of_the_others_it_is_a_goal_kick_and_over_the_own_one_a_corner_kick() {
    for (division, (x, y), goal_kick_x) in [(A, (6.0, 4.5), 5.0), (B, (4.5, 3.0), 3.5)] {
        for mut scene in views(division) {
            play_out(&mut scene, Us, (x - 0.1, 2.0), (x + 0.1, 2.0));
            scene.expect_bot(BallLeftFieldGoalLine, (Us, 3), (x + BEYOND, 2.0));
            scene.expect_next(DirectFree, Them, (goal_kick_x, y - 0.2));
            scene.expect_fouls(0, 0);
        }
        for mut scene in views(division) {
            play_out(&mut scene, Them, (x - 0.1, 2.0), (x + 0.1, 2.0));
            scene.expect_bot(BallLeftFieldGoalLine, (Them, 3), (x + BEYOND, 2.0));
            scene.expect_next(DirectFree, Us, (x - 0.2, y - 0.2));
        }
    }
}

#[test]
fn a_kick_into_the_own_side_netting_is_a_corner_of_the_others() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (-4.4, 0.6), (-4.6, 0.6));
        scene.expect_bot(BallLeftFieldGoalLine, (Us, 3), (-4.5 - BEYOND, 0.6));
        scene.expect_next(DirectFree, Them, (-4.3, 2.8));
    }
}

#[test]
fn in_a_corner_the_line_that_is_crossed_first_counts() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (4.4, 2.95), (4.7, 3.25));
        scene.only(BallLeftFieldTouchLine);
        scene.expect_next(DirectFree, Them, (4.3, 2.8));
    }
    for mut scene in views(B) {
        play_out(&mut scene, Us, (4.45, 2.9), (4.75, 3.2));
        scene.only(BallLeftFieldGoalLine);
        scene.expect_next(DirectFree, Them, (3.5, 2.8));
    }
}

#[test]
fn a_ball_that_is_out_already_leaves_no_more() {
    for mut scene in views(B) {
        scene.ball(1.0, 3.1);
        scene.settle();
        scene.ball(1.0, 3.2);
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn a_ball_that_nobody_touched_since_play_went_on_is_free_for_both() {
    for mut scene in views(B) {
        scene.ball(1.0, 2.9);
        scene.settle();
        scene.ball(1.0, 3.1);
        scene.step();
        scene.expect_team(BallLeftFieldTouchLine, None, (1.0, 3.0 + BEYOND));
        scene.expect_next_for(ForceStart, (1.0, 2.8));
    }
}

#[test]
fn the_last_toucher_counts_and_not_the_kicker() {
    for mut scene in views(B) {
        scene.ball(1.0, 2.5);
        scene.settle();
        scene.touch((Us, 2));
        scene.step();
        scene.touch((Them, 4));
        scene.ball(1.0, 2.9);
        scene.step();
        scene.ball(1.0, 3.1);
        scene.step();
        scene.expect_bot(BallLeftFieldTouchLine, (Them, 4), (1.0, 3.0 + BEYOND));
        scene.expect_next(DirectFree, Us, (1.0, 2.8));
    }
}

#[test]
fn a_kick_from_the_own_half_over_the_far_goal_line_is_aimless_in_division_b() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (-0.1, 2.0), (4.4, 2.0));
        scene.expect_play();
        scene.ball(4.6, 2.0);
        scene.step();
        scene.expect_bot(AimlessKick, (Us, 3), (4.5 + BEYOND, 2.0));
        assert_eq!(scene.events().len(), 1, "{:?}", scene.events());
        scene.expect_next(DirectFree, Them, (-0.1, 2.0));
        scene.expect_fouls(0, 0);
    }
    for mut scene in views(A) {
        play_out(&mut scene, Us, (-0.1, 2.0), (5.9, 2.0));
        scene.ball(6.1, 2.0);
        scene.step();
        scene.expect_bot(BallLeftFieldGoalLine, (Us, 3), (6.0 + BEYOND, 2.0));
    }
}

#[test]
fn the_place_of_an_aimless_kick_is_a_valid_one() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (-4.4, 0.0), (4.4, 2.0));
        scene.ball(4.6, 2.0);
        scene.step();
        scene.expect_next(DirectFree, Them, (-2.5, 0.0));
    }
}

#[test]
fn a_ball_that_another_robot_touched_on_its_way_or_from_the_far_half_is_not_aimless() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (-0.1, 2.0), (2.0, 2.0));
        scene.touch((Us, 4));
        scene.step();
        scene.ball(4.4, 2.0);
        scene.step();
        scene.ball(4.6, 2.0);
        scene.step();
        scene.expect_bot(BallLeftFieldGoalLine, (Us, 4), (4.5 + BEYOND, 2.0));
        scene.expect_next(DirectFree, Them, (3.5, 2.8));
    }
    for x in [0.0, 0.1] {
        for mut scene in views(B) {
            play_out(&mut scene, Us, (x, 2.0), (4.4, 2.0));
            scene.ball(4.6, 2.0);
            scene.step();
            scene.only(BallLeftFieldGoalLine);
            assert_eq!(scene.count_of(AimlessKick), 0);
        }
    }
}

#[test]
fn a_kick_back_over_the_own_line_and_a_shot_into_the_goal_are_not_aimless() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (-1.0, 2.0), (-4.4, 2.0));
        scene.ball(-4.6, 2.0);
        scene.step();
        assert_eq!(scene.count_of(AimlessKick), 0);
        scene.expect_next(DirectFree, Them, (-4.3, 2.8));
    }
    for mut scene in views(B) {
        play_out(&mut scene, Us, (-1.0, 0.0), (4.4, 0.0));
        scene.ball(4.6, 0.0);
        scene.step();
        assert_eq!(scene.count_of(AimlessKick), 0);
        assert_eq!(scene.score(), (1, 0));
    }
}

#[test]
fn a_kick_off_is_never_aimless_but_a_later_kick_of_the_same_robot_is() {
    for mut scene in views(B) {
        scene.kickoff(Us);
        scene.ball(-0.01, 0.0);
        scene.settle();
        scene.kick((Us, 1), 0.3, 0.1);
        assert_eq!((scene.game.command, scene.game.in_play), (NormalStart, true));
        scene.ball(4.4, 2.0);
        scene.step();
        scene.ball(4.6, 2.0);
        scene.step();
        scene.expect_bot(BallLeftFieldGoalLine, (Us, 1), (4.5 + BEYOND, 2.0));
        assert_eq!(scene.count_of(AimlessKick), 0);
    }
    for mut scene in views(B) {
        scene.kickoff(Us);
        scene.kick((Us, 1), -0.3, 0.1);
        scene.kick((Us, 2), -0.4, 0.1);
        scene.kick((Us, 1), 0.3, 0.1);
        scene.ball(4.4, 2.0);
        scene.step();
        scene.ball(4.6, 2.0);
        scene.step();
        scene.only(AimlessKick);
    }
}

/// A ball flies over a touch line with a speed upward, from a height.
fn fly_out(scene: &mut Scene, height: f32, up: f32) {
    scene.ball(1.0, 2.95);
    scene.settle();
    scene.touch((Us, 3));
    scene.step();
    scene.ball(1.0, 3.05);
    scene.ball_height(height);
    scene.ball_velocity(0.0, 4.0, up);
    scene.step();
}

#[test]
fn a_ball_that_flies_over_the_wall_is_a_foul() {
    for mut scene in views(B) {
        // 0.25 m to the wall take 1/16 s: the ball is 0.0625 - 0.019 m higher there.
        fly_out(&mut scene, 0.1, 1.0);
        scene.expect_bot(BoundaryCrossing, (Us, 3), (1.0, 3.0 + BEYOND));
        scene.expect_next(DirectFree, Them, (1.0, 2.8));
        scene.expect_fouls(1, 0);
        assert_eq!(scene.count_of(BallLeftFieldTouchLine), 1, "both are events");
    }
}

#[test]
fn a_ball_that_meets_the_wall_is_only_out() {
    for (height, up) in [(0.05, 1.0), (0.1, 0.0), (0.3, -4.0), (0.0, 0.0)] {
        for mut scene in views(B) {
            fly_out(&mut scene, height, up);
            assert_eq!(scene.count_of(BoundaryCrossing), 0, "{height} {up}");
            scene.only(BallLeftFieldTouchLine);
            scene.expect_fouls(0, 0);
        }
    }
}

#[test]
fn over_the_walls_behind_the_goals_it_is_a_foul_too() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (2.0, 0.5), (4.4, 0.5));
        scene.ball(4.6, 0.5);
        scene.ball_height(0.4);
        scene.ball_velocity(4.0, 0.0, 0.0);
        scene.step();
        scene.expect_bot(BoundaryCrossing, (Us, 3), (4.5 + BEYOND, 0.5));
        scene.expect_next(DirectFree, Them, (4.3, 2.0));
        scene.expect_fouls(1, 0);
    }
}

#[test]
fn a_ball_that_flies_into_the_goal_meets_its_back() {
    for mut scene in views(B) {
        play_out(&mut scene, Us, (2.0, 0.1), (4.3, 0.1));
        scene.ball_height(0.3);
        scene.step();
        scene.ball(4.45, 0.1);
        scene.ball_height(0.05);
        scene.settle();
        scene.ball(4.6, 0.1);
        scene.ball_height(0.1);
        scene.ball_velocity(8.0, 0.0, 2.0);
        scene.step();
        assert_eq!((scene.count_of(InvalidGoal), scene.count_of(BoundaryCrossing)), (1, 0));
        scene.expect_fouls(0, 0);
    }
}

#[test]
fn nobody_is_at_fault_for_a_flight_without_a_touch() {
    for mut scene in views(B) {
        scene.ball(1.0, 2.95);
        scene.settle();
        scene.ball(1.0, 3.05);
        scene.ball_height(0.4);
        scene.ball_velocity(0.0, 4.0, 0.0);
        scene.step();
        assert_eq!(scene.count_of(BoundaryCrossing), 0);
    }
}

#[test]
fn rules_that_are_off_are_not_judged() {
    let off = |config: &mut rsim_referee::config::RefereeConfig| {
        config.off = vec!["BALL_LEFT_FIELD_TOUCH_LINE".to_owned()];
    };
    for mut scene in views_with(B, off) {
        play_out(&mut scene, Us, (1.0, 2.9), (1.0, 3.1));
        scene.expect_play();
    }
}
