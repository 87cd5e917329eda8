//! Contacts of robots: "Crashing", "Pushing".

use rsim_referee::codes::Command::DirectFree;
use rsim_referee::events::EventKind::{BotCrashDrawn, BotCrashUnique, BotPushedBot};

use crate::scene::{B, Scene, Them, Us, views};

/// Two robots meet, with speeds along x.
fn crash(scene: &mut Scene, ours: f32, theirs: f32, closing: f32) {
    scene.robot((Us, 4), 1.0, 1.0);
    scene.robot((Them, 4), 1.18, 1.0);
    scene.robot_velocity((Us, 4), ours, 0.0);
    scene.robot_velocity((Them, 4), theirs, 0.0);
    scene.settle();
    scene.collide((Us, 4), (Them, 4), closing);
    scene.step();
}

#[test]
fn the_faster_robot_of_a_crash_is_at_fault() {
    for mut scene in views(B) {
        crash(&mut scene, 2.0, 0.0, 2.0);
        scene.expect_bot(BotCrashUnique, (Us, 4), (1.09, 1.0));
        scene.expect_fouls(1, 0);
        assert!(scene.game.is_running(), "play goes on");
    }
    for mut scene in views(B) {
        crash(&mut scene, 0.6, -1.0, 1.6);
        scene.expect_bot(BotCrashUnique, (Them, 4), (1.09, 1.0));
        scene.expect_fouls(0, 1);
    }
}

#[test]
fn both_are_at_fault_at_about_the_same_speed() {
    for mut scene in views(B) {
        crash(&mut scene, 1.0, -1.2, 2.2);
        scene.expect_team(BotCrashDrawn, None, (1.09, 1.0));
        scene.expect_fouls(1, 1);
        assert_eq!(scene.events().len(), 1);
    }
    for (theirs, is_drawn) in [(-1.29, true), (-1.31, false)] {
        for mut scene in views(B) {
            crash(&mut scene, 1.0, theirs, 2.2);
            assert_eq!(scene.count_of(BotCrashDrawn), usize::from(is_drawn));
            assert_eq!(scene.count_of(BotCrashUnique), usize::from(!is_drawn));
        }
    }
}

#[test]
fn a_slow_contact_is_no_crash() {
    for closing in [1.49, 0.0] {
        for mut scene in views(B) {
            crash(&mut scene, 1.49, 0.0, closing);
            scene.expect_play();
        }
    }
}

#[test]
fn a_crash_of_teammates_is_none() {
    for mut scene in views(B) {
        scene.robot_velocity((Us, 4), 3.0, 0.0);
        scene.settle();
        scene.robot_velocity((Us, 4), 0.0, 0.0);
        // Two of us collide; another pair of opponents touches gently.
        scene.collide((Us, 4), (Us, 5), 3.0);
        scene.collide((Us, 2), (Them, 2), 0.1);
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn crashes_are_judged_in_stops_too() {
    for mut scene in views(B) {
        scene.stop(DirectFree, Us, (0.0, 0.0));
        crash(&mut scene, 2.0, 0.0, 2.0);
        scene.only(BotCrashUnique);
        scene.expect_next(DirectFree, Us, (0.0, 0.0));
    }
}

#[test]
fn a_crash_that_lasts_is_one_foul() {
    for mut scene in views(B) {
        crash(&mut scene, 2.0, 0.0, 2.0);
        crash(&mut scene, 2.0, 0.0, 2.0);
        assert_eq!(scene.events(), []);
        scene.expect_fouls(1, 0);
        scene.wait(0.2);
        crash(&mut scene, 2.0, 0.0, 2.0);
        scene.expect_fouls(2, 0);
    }
}

#[test]
fn a_drawn_crash_is_a_foul_of_one_team_while_that_of_the_other_lasts() {
    for mut scene in views(B) {
        crash(&mut scene, 2.0, 0.0, 2.0);
        crash(&mut scene, 1.0, -1.0, 2.0);
        assert_eq!(scene.only(BotCrashDrawn).side, Some(Them));
        scene.expect_fouls(1, 1);
    }
}

#[test]
fn two_crashes_of_different_teams_in_a_step_are_two_fouls() {
    for mut scene in views(B) {
        scene.robot((Us, 5), -1.0, 1.0);
        scene.robot((Them, 5), -0.82, 1.0);
        scene.robot_velocity((Them, 5), -2.0, 0.0);
        scene.collide((Us, 5), (Them, 5), 2.0);
        scene.robot((Us, 4), 1.0, 1.0);
        scene.robot((Them, 4), 1.18, 1.0);
        scene.robot_velocity((Us, 4), 2.0, 0.0);
        scene.collide((Us, 4), (Them, 4), 2.0);
        scene.settle();
        scene.step();
        assert_eq!(scene.count_of(BotCrashUnique), 2);
        scene.expect_fouls(1, 1);
    }
}

/// Our robot and one of them in contact move a way along x; `y` of both.
fn push(scene: &mut Scene, ways: (f32, f32), sideways: f32) {
    scene.ball(0.0, 1.0);
    scene.robot((Us, 4), 1.0, 1.0);
    scene.robot((Them, 4), 1.18, 1.0);
    scene.settle();
    for nth in 0..=20_u8 {
        let share = f32::from(nth) / 20.0;
        scene.robot((Us, 4), 1.0 + ways.0 * share, 1.0 + sideways * share);
        scene.robot((Them, 4), 1.18 + ways.1 * share, 1.0 + sideways * share);
        scene.collide((Us, 4), (Them, 4), 0.1);
        scene.step();
        if !scene.events().is_empty() {
            return;
        }
    }
}

#[test]
fn a_robot_must_not_push_an_opponent() {
    for mut scene in views(B) {
        push(&mut scene, (0.25, 0.25), 0.0);
        let event = scene.only(BotPushedBot);
        assert_eq!(event.bot, Some((Us, 4)));
        scene.expect_next(DirectFree, Them, (0.0, 1.0));
        scene.expect_fouls(1, 0);
    }
    for mut scene in views(B) {
        push(&mut scene, (-0.25, -0.25), 0.0);
        assert_eq!(scene.only(BotPushedBot).bot, Some((Them, 4)));
        scene.expect_next(DirectFree, Us, (0.0, 1.0));
        scene.expect_fouls(0, 1);
    }
}

#[test]
fn a_short_way_a_way_aside_and_a_turn_are_no_push() {
    for (ways, sideways) in [((0.19, 0.19), 0.0), ((0.1, 0.1), 0.3), ((-0.1, 0.1), 0.0)] {
        for mut scene in views(B) {
            push(&mut scene, ways, sideways);
            scene.expect_play();
        }
    }
}

#[test]
fn a_contact_that_ends_begins_anew() {
    for mut scene in views(B) {
        push(&mut scene, (0.15, 0.15), 0.0);
        scene.step(); // no contact
        scene.robot((Us, 4), 1.15, 1.0);
        scene.robot((Them, 4), 1.33, 1.0);
        for nth in 0..6_u8 {
            let way = f32::from(nth) * 0.02;
            scene.robot((Us, 4), 1.15 + way, 1.0);
            scene.robot((Them, 4), 1.33 + way, 1.0);
            scene.collide((Us, 4), (Them, 4), 0.1);
            scene.step();
        }
        scene.expect_play();
    }
}

#[test]
fn robots_that_are_apart_do_not_push() {
    for mut scene in views(B) {
        for nth in 0..10_u8 {
            let way = f32::from(nth) * 0.05;
            scene.robot((Us, 4), 1.0 + way, 1.0);
            scene.robot((Them, 4), 1.3 + way, 1.0); // each touches somebody else
            scene.collide((Us, 4), (Them, 4), 0.1);
            scene.step();
        }
        scene.expect_play();
    }
}

#[test]
fn of_two_contacts_the_one_near_the_ball_is_followed() {
    for mut scene in views(B) {
        scene.ball(1.0, 0.5);
        scene.robot((Us, 2), -1.0, 1.0);
        scene.robot((Them, 2), -0.82, 1.0);
        scene.robot((Us, 4), 1.0, 1.0);
        scene.robot((Them, 4), 1.18, 1.0);
        scene.settle();
        for nth in 0..=20_u8 {
            let way = f32::from(nth) * 0.0125;
            scene.robot((Us, 2), -1.0 - way, 1.0);
            scene.robot((Them, 2), -0.82 - way, 1.0);
            scene.robot((Us, 4), 1.0 + way, 1.0);
            scene.robot((Them, 4), 1.18 + way, 1.0);
            scene.collide((Us, 2), (Them, 2), 0.1);
            scene.collide((Us, 4), (Them, 4), 0.1);
            scene.step();
            if !scene.events().is_empty() {
                break;
            }
        }
        assert_eq!(scene.only(BotPushedBot).bot, Some((Us, 4)));
    }
}

#[test]
fn pushes_in_a_stop_are_not_judged() {
    for mut scene in views(B) {
        scene.stop(DirectFree, Us, (0.0, 1.0));
        push(&mut scene, (0.25, 0.25), 0.0);
        assert_eq!(scene.events(), []);
    }
}
