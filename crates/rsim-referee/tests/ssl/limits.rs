//! Scenes at the limits: a rule allows at a number what it forbids beyond it.

use rsim_referee::codes::Command::{BallPlacement, DirectFree, ForceStart};
use rsim_referee::events::EventKind::{
    BotCrashUnique, BotInterferedPlacement, NoProgressInGame, PlacementSucceeded,
};

use crate::scene::{B, ROBOT_RADIUS, Scene, Them, Us, views, views_with_placement};

#[test]
fn a_contact_at_one_and_a_half_meters_per_second_is_no_crash() {
    for mut scene in views(B) {
        scene.robot_velocity((Us, 4), 1.5, 0.0);
        scene.settle();
        scene.collide((Us, 4), (Them, 4), 1.5);
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn a_robot_that_is_three_decimeters_per_second_faster_is_at_fault_alone() {
    for mut scene in views(B) {
        scene.robot_velocity((Us, 4), 0.3, 0.0);
        scene.settle();
        scene.collide((Us, 4), (Them, 4), 2.0);
        scene.step();
        assert_eq!(scene.only(BotCrashUnique).bot, Some((Us, 4)));
        scene.expect_fouls(1, 0);
    }
}

#[test]
fn a_robot_may_dribble_a_meter() {
    for mut scene in views(B) {
        scene.ball(-0.5, 1.0);
        scene.settle();
        scene.touch((Us, 2));
        scene.step();
        for x in [0.0, 0.5] {
            scene.ball(x, 1.0);
            scene.hold((Us, 2));
            scene.step();
            scene.expect_play();
        }
    }
}

#[test]
fn a_robot_may_kick_at_the_limit_and_keep_a_fast_ball_as_fast_as_it_is() {
    for (before, after) in [(0.0, 6.5), (7.0, 7.0), (7.0, 6.9)] {
        for mut scene in views(B) {
            scene.ball_velocity(before, 0.0, 0.0);
            scene.settle();
            scene.ball_velocity(after, 0.0, 0.0);
            scene.touch((Us, 2));
            scene.step();
            scene.expect_play();
        }
    }
}

#[test]
fn a_ball_that_was_as_high_as_it_may_be_scores() {
    for mut scene in views(B) {
        scene.ball(3.0, 0.2);
        scene.settle();
        scene.touch((Us, 2));
        scene.since_touch(5.0, 0.15);
        scene.step();
        scene.ball(4.4, 0.2);
        scene.step();
        scene.ball(4.6, 0.2);
        scene.step();
        assert_eq!(scene.score(), (1, 0));
    }
}

#[test]
fn a_robot_may_drive_at_the_limit_in_a_stop() {
    for mut scene in views(B) {
        scene.stop(DirectFree, Us, (0.0, 0.0));
        scene.game.wait_steps = scene.steps(60.0);
        scene.robot_velocity((Them, 3), 1.5, 0.0);
        assert_eq!(scene.wait(3.0), []);
    }
}

#[test]
fn a_decimeter_is_no_progress_yet() {
    for mut scene in views(B) {
        scene.ball(0.0, 0.0);
        scene.settle();
        for nth in 0..scene.steps(10.0) {
            scene.ball(if nth % 2 == 0 { 0.1 } else { 0.0 }, 0.0);
            scene.step();
            scene.expect_play();
        }
        scene.step();
        scene.only(NoProgressInGame);
    }
}

/// Puts all robots but the keepers far from the middle.
fn make_way(scene: &mut Scene) {
    for number in 1..scene.size() {
        let y = 0.4 * f32::from(u8::try_from(number).expect("few")) - 2.0;
        scene.robot((Us, number), -2.0, y);
        scene.robot((Them, number), 2.8, y);
    }
}

#[test]
fn a_robot_half_a_meter_beside_the_way_of_a_placement_does_not_interfere() {
    for mut scene in views_with_placement(B) {
        make_way(&mut scene);
        scene.ball(0.0, -2.0);
        scene.stop_for(ForceStart, (0.0, 2.0));
        let team = scene.team(Us);
        scene.game.give(BallPlacement(team), Some(ForceStart));
        scene.game.wait_steps = scene.steps(30.0);
        scene.robot((Them, 2), 0.5 + ROBOT_RADIUS, 0.0);
        assert_eq!(scene.wait(3.0), []);
        scene.robot((Them, 2), 0.499 + ROBOT_RADIUS, 0.0);
        scene.wait(3.0);
        scene.only(BotInterferedPlacement);
    }
}

#[test]
fn a_placed_ball_is_slower_than_one_decimeter_per_second() {
    for mut scene in views_with_placement(B) {
        make_way(&mut scene);
        let team = scene.team(Us);
        scene.ball(1.0, 2.0);
        scene.stop(DirectFree, Us, (1.0, 2.0));
        scene.game.give(BallPlacement(team), Some(DirectFree(team)));
        scene.game.wait_steps = scene.steps(30.0);
        scene.ball_velocity(0.1, 0.0, 0.0);
        assert_eq!(scene.wait(5.0), []);
        scene.ball_velocity(0.099, 0.0, 0.0);
        scene.step();
        scene.only(PlacementSucceeded);
    }
}
