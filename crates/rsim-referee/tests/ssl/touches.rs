//! Touches of the ball: "Double Touch", "Excessive Dribbling", "Ball Speed", "No Progress In Game".

use rsim_referee::codes::Command::{DirectFree, ForceStart};
use rsim_referee::events::EventKind::{
    AttackerDoubleTouchedBall, BotDribbledBallTooFar, BotKickedBallTooFast, NoProgressInGame,
};

use crate::scene::{A, B, Scene, Them, Us, expect_near, views};

#[test]
fn the_kicker_must_not_touch_the_ball_again() {
    for is_kickoff in [true, false] {
        for mut scene in views(B) {
            if is_kickoff {
                scene.kickoff(Us);
            } else {
                scene.free_kick(Us);
            }
            scene.kick((Us, 1), 0.06, 0.0);
            scene.expect_play();
            scene.ball(0.5, 0.3);
            scene.step();
            scene.kick((Us, 1), 0.6, 0.3);
            scene.expect_bot(AttackerDoubleTouchedBall, (Us, 1), (0.6, 0.3));
            scene.expect_next(DirectFree, Them, (0.6, 0.3));
            scene.expect_fouls(0, 0);
        }
    }
}

#[test]
fn to_stay_in_contact_beyond_the_first_way_is_a_double_touch() {
    for mut scene in views(B) {
        scene.free_kick(Us);
        for way in [0.01, 0.03, 0.049] {
            scene.kick((Us, 1), way, 0.0);
            scene.expect_play();
            assert!(!scene.game.in_play);
        }
        scene.kick((Us, 1), 0.051, 0.0);
        scene.expect_play();
        scene.kick((Us, 1), 0.07, 0.0);
        scene.only(AttackerDoubleTouchedBall);
    }
}

#[test]
fn after_a_touch_of_any_other_robot_the_kicker_may_play_again() {
    for other in [(Us, 2), (Them, 2)] {
        for mut scene in views(B) {
            scene.free_kick(Us);
            scene.kick((Us, 1), 0.06, 0.0);
            scene.kick(other, 0.2, 0.0);
            scene.kick((Us, 1), 0.3, 0.0);
            scene.expect_play();
        }
    }
}

#[test]
fn the_robot_that_moves_the_ball_far_enough_is_the_kicker() {
    for mut scene in views(B) {
        scene.free_kick(Us);
        scene.kick((Us, 2), 0.03, 0.0);
        scene.kick((Us, 1), 0.06, 0.0);
        scene.ball(0.5, 0.0);
        scene.step();
        scene.kick((Us, 2), 0.6, 0.0);
        scene.expect_play();
    }
}

#[test]
fn nobody_is_the_kicker_where_the_others_bumped_the_ball_or_time_was_up() {
    for mut scene in views(B) {
        scene.free_kick(Us);
        scene.kick((Them, 2), 0.06, 0.0);
        assert!(scene.game.in_play);
        scene.kick((Them, 2), 0.2, 0.0);
        assert_eq!(scene.count_of(AttackerDoubleTouchedBall), 0);
    }
    for mut scene in views(B) {
        scene.free_kick(Us);
        scene.run(11.0, |scene| scene.game.in_play);
        scene.kick((Us, 1), 0.06, 0.0);
        scene.kick((Us, 1), 0.2, 0.0);
        scene.expect_play();
    }
}

/// A robot of ours has the ball, and takes it along x.
fn dribble(scene: &mut Scene, from: f32, to: f32) {
    scene.ball(from, 1.0);
    scene.settle();
    let mut x = from;
    while scene.game.is_running() && x < to {
        scene.ball(x, 1.0);
        scene.robot((Us, 1), x - 0.1, 1.0);
        scene.touch((Us, 1));
        scene.step();
        x += 0.04;
    }
}

#[test]
fn a_new_touch_is_where_the_ball_was_and_one_that_lasts_where_it_is() {
    for (lasts, x) in [(false, 1.0), (true, 1.2)] {
        for mut scene in views(B) {
            scene.ball(1.0, 1.0);
            scene.settle();
            if lasts {
                scene.touched_before((Us, 1));
            }
            scene.touch((Us, 1));
            scene.ball(1.2, 1.0);
            scene.step();
            expect_near(scene.back(scene.game.last_touch_position), (x, 1.0));
        }
    }
}

#[test]
fn a_robot_must_not_dribble_farther_than_a_meter() {
    for division in [A, B] {
        for mut scene in views(division) {
            dribble(&mut scene, -1.0, 1.0);
            let event = scene.only(BotDribbledBallTooFar);
            assert_eq!(event.bot, Some((Us, 1)));
            assert!((event.at.0 - 0.02).abs() < 0.03, "{event:?}: at once");
            scene.expect_next(DirectFree, Them, (-1.0, 1.0));
            scene.expect_fouls(1, 0);
        }
    }
}

#[test]
fn a_meter_is_measured_in_a_straight_line() {
    for mut scene in views(B) {
        dribble(&mut scene, -1.0, -0.04);
        scene.expect_play();
        dribble(&mut scene, -0.9, -0.04);
        scene.expect_play();
    }
}

#[test]
fn a_separation_begins_a_new_dribble() {
    for mut scene in views(B) {
        dribble(&mut scene, -1.0, -0.1);
        scene.ball(0.05, 1.0); // 0.05 m beyond the hull
        scene.step();
        dribble(&mut scene, 0.05, 1.0);
        scene.expect_play();
    }
}

#[test]
fn a_gap_that_nobody_sees_is_no_separation() {
    for mut scene in views(B) {
        dribble(&mut scene, -1.0, -0.1);
        scene.robot((Us, 1), -0.2, 1.0);
        scene.ball(-0.2 + 0.09 + 0.0215 + 0.015, 1.0);
        scene.step();
        dribble(&mut scene, -0.07, 1.0);
        scene.only(BotDribbledBallTooFar);
    }
}

#[test]
fn a_ball_in_the_mouth_is_dribbled_without_touches() {
    for mut scene in views(B) {
        scene.ball(-1.0, 1.0);
        scene.robot((Us, 1), -1.1, 1.0);
        scene.touch((Us, 1));
        scene.step();
        for x in [-0.5, 0.05] {
            scene.ball(x, 1.0);
            scene.robot((Us, 1), x - 0.2, 1.0);
            scene.hold((Us, 1));
            scene.step();
        }
        scene.only(BotDribbledBallTooFar);
    }
}

#[test]
fn a_kick_at_the_end_of_a_dribble_is_no_dribbling() {
    for mut scene in views(B) {
        dribble(&mut scene, -1.0, -0.05);
        scene.touch((Us, 1));
        scene.ball(0.1, 1.0); // 1.1 m from the start, but 0.15 m from the robot
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn each_robot_has_its_own_dribble() {
    for mut scene in views(B) {
        dribble(&mut scene, -1.0, -0.3);
        scene.ball(0.0, 1.0);
        scene.step();
        scene.robot((Them, 2), 0.6, 1.0);
        scene.touch((Them, 2));
        scene.ball(0.5, 1.0);
        scene.step();
        scene.robot((Them, 2), 0.9, 1.0);
        scene.touch((Them, 2));
        scene.ball(0.8, 1.0);
        scene.step();
        scene.expect_play();
    }
}

/// A robot of ours kicks the ball to a velocity.
fn kick_fast(scene: &mut Scene, x: f32, y: f32, up: f32) {
    scene.touch((Us, 1));
    scene.ball_velocity(x, y, up);
    scene.step();
}

#[test]
fn a_ball_must_not_be_kicked_faster_than_the_limit_in_three_dimensions() {
    for (velocity, fouls) in [
        ((6.6, 0.0, 0.0), 1),
        ((6.4, 0.0, 0.0), 0),
        ((5.0, 3.0, 3.1), 1),
        ((5.0, 3.0, 2.8), 0),
        ((-6.6, 0.0, 0.0), 1),
    ] {
        for mut scene in views(B) {
            scene.ball(1.0, 1.0);
            scene.settle();
            kick_fast(&mut scene, velocity.0, velocity.1, velocity.2);
            assert_eq!(scene.count_of(BotKickedBallTooFast), fouls, "{velocity:?}");
            assert!(scene.game.is_running(), "play goes on");
            if fouls == 1 {
                scene.expect_bot(BotKickedBallTooFast, (Us, 1), (1.0, 1.0));
            }
            assert_eq!(scene.fouls(Us), i32::try_from(fouls).expect("few"));
        }
    }
}

#[test]
fn a_flight_is_one_foul_and_so_is_a_fast_ball_that_another_robot_deflects() {
    for mut scene in views(B) {
        scene.ball(-2.0, 1.0);
        scene.settle();
        kick_fast(&mut scene, 5.0, 0.0, 4.4);
        for up in [3.0, 0.0, -3.0, -4.4] {
            scene.ball_velocity(5.0, 0.0, up);
            scene.wait(0.25);
            assert_eq!(scene.events(), []);
        }
        scene.touch((Them, 1));
        scene.ball_velocity(0.0, 6.55, 0.0);
        scene.step();
        scene.expect_fouls(1, 0);
    }
}

#[test]
fn a_robot_that_makes_a_fast_ball_faster_is_at_fault_too() {
    for mut scene in views(B) {
        kick_fast(&mut scene, 6.6, 0.0, 0.0);
        scene.touch((Them, 1));
        scene.ball_velocity(-7.0, 0.0, 0.0);
        scene.step();
        scene.only(BotKickedBallTooFast);
        scene.expect_fouls(1, 1);
    }
}

#[test]
fn the_speed_of_a_kick_is_that_right_after_the_touch() {
    for (speed, is_foul) in [(6.49, false), (6.51, true)] {
        for mut scene in views(B) {
            scene.touch((Us, 2));
            scene.ball_velocity(6.45, 0.0, 0.0); // it slows down within the step
            scene.since_touch(speed, 0.0);
            scene.step();
            assert_eq!(scene.count_of(BotKickedBallTooFast), usize::from(is_foul), "{speed}");
        }
    }
    for mut scene in views(B) {
        scene.touch((Us, 2));
        scene.ball_velocity(3.0, 0.0, 0.0);
        scene.since_touch(3.0, 0.0);
        scene.step();
        scene.ball_velocity(7.0, 0.0, 0.0);
        scene.since_touch(7.0, 0.0);
        scene.step();
        scene.expect_play(); // nobody has touched it in the step
    }
}

#[test]
fn a_ball_that_makes_no_progress_is_free_for_both() {
    for (division, seconds) in [(A, 5.0), (B, 10.0)] {
        for mut scene in views(division) {
            scene.ball(1.0, 1.0);
            scene.settle();
            scene.wait(seconds);
            scene.expect_play();
            scene.step();
            scene.expect_team(NoProgressInGame, None, (1.0, 1.0));
            scene.expect_next_for(ForceStart, (1.0, 1.0));
            scene.expect_fouls(0, 0);
        }
    }
}

#[test]
fn a_decimeter_is_progress() {
    for (way, stops) in [(0.11, false), (0.09, true)] {
        for mut scene in views(B) {
            scene.ball(1.0, 1.0);
            scene.settle();
            scene.wait(9.0);
            scene.ball(1.0 + way, 1.0);
            scene.wait(2.0);
            assert_eq!(scene.count_of(NoProgressInGame), usize::from(stops));
        }
    }
}

#[test]
fn before_a_kick_the_ball_may_rest() {
    for mut scene in views(A) {
        scene.free_kick(Us);
        scene.wait(4.9);
        assert!(!scene.game.in_play);
        scene.run(0.2, |scene| scene.game.in_play);
        scene.wait(4.9);
        scene.expect_play();
        scene.wait(0.2);
        scene.only(NoProgressInGame);
    }
}

#[test]
fn a_stuck_ball_in_an_area_goes_to_a_valid_place() {
    for mut scene in views(A) {
        scene.ball(-4.3, 0.5);
        scene.robot((Us, 6), -3.0, 3.0);
        scene.settle();
        let team = scene.team(Us);
        scene.wait(5.0);
        scene.game.area_steps[team] = 0; // so that the keeper does not hold it
        scene.step();
        scene.only(NoProgressInGame);
        scene.expect_next_for(ForceStart, (-3.2, 0.5));
    }
}
