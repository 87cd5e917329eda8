//! Touches in the goal areas: "Multiple Defenders", "Attacker Touched Ball In Opponent Defense Area",
//! "Keeper Held Ball".

use rsim_referee::codes::Command::{DirectFree, PreparePenalty};
use rsim_referee::events::EventKind::{
    AttackerTouchedBallInDefenseArea, DefenderInDefenseArea, KeeperHeldBall,
};

use crate::scene::{A, B, Bot, Them, Us, views};

/// Corner of our area, where the front line and a side line meet.
const FRONT: f32 = -3.5;
const SIDE: f32 = 1.0;

/// Robots that touch the ball, their places, and whether that is an offense.
fn judged(bot: Bot, places: &[((f32, f32), bool)], kind: rsim_referee::events::EventKind) {
    for ((x, y), is_offense) in places {
        for mut scene in views(B) {
            scene.ball(-3.3, 1.4);
            scene.robot(bot, *x, *y);
            scene.settle();
            scene.touch(bot);
            scene.step();
            assert_eq!(scene.count_of(kind), usize::from(*is_offense), "{x} {y}");
            if *is_offense {
                scene.expect_bot(kind, bot, (*x, *y));
            }
        }
    }
}

#[test]
fn a_second_defender_that_is_entirely_inside_costs_a_penalty_kick() {
    let inside = FRONT - 0.09 - 0.001;
    let places = [
        ((inside, 0.0), true),
        ((inside + 0.002, 0.0), false),
        ((FRONT, 0.0), false),
        ((-4.0, SIDE - 0.09 - 0.001), true),
        ((-4.0, SIDE - 0.09 + 0.001), false),
        ((-4.6, 0.0), true),
        ((4.0, 0.0), false),
    ];
    judged((Us, 3), &places, DefenderInDefenseArea);
    for (division, x) in [(A, 2.0), (B, 1.5)] {
        for mut scene in views(division) {
            let goal_line = -scene.referee.pitch().lines.half_length;
            scene.robot((Us, 3), goal_line + 0.5, 0.5);
            scene.touch((Us, 3));
            scene.step();
            scene.expect_next(PreparePenalty, Them, (x, 0.0));
            scene.expect_fouls(0, 0);
        }
    }
}

#[test]
fn the_keeper_may_touch_the_ball_in_its_area() {
    for mut scene in views(B) {
        scene.robot((Us, 0), -4.0, 0.0);
        scene.touch((Us, 0));
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn a_defender_inside_that_does_not_touch_the_ball_is_no_offense() {
    for mut scene in views(B) {
        scene.ball(-3.6, 0.0);
        scene.robot((Us, 3), -4.0, 0.0);
        scene.settle();
        scene.wait(1.0);
        scene.expect_play();
    }
}

#[test]
fn an_attacker_that_is_partly_inside_must_not_touch_the_ball() {
    let outside = FRONT + 0.09 + 0.001;
    let places = [
        ((outside, 0.0), false),
        ((outside - 0.002, 0.0), true),
        ((-4.0, 0.0), true),
        ((-4.0, SIDE + 0.089), true),
        ((-4.0, SIDE + 0.091), false),
        ((FRONT + 0.07, SIDE + 0.07), false),
        ((FRONT + 0.06, SIDE + 0.06), true),
    ];
    judged((Them, 3), &places, AttackerTouchedBallInDefenseArea);
    judged((Them, 0), &places, AttackerTouchedBallInDefenseArea);
    for mut scene in views(B) {
        scene.robot((Them, 3), -4.0, 0.0);
        scene.touch((Them, 3));
        scene.step();
        assert!(scene.game.is_running(), "play goes on");
        scene.expect_fouls(0, 1);
    }
}

#[test]
fn a_touch_that_lasts_is_raised_every_two_seconds_and_a_new_one_at_once() {
    for mut scene in views(B) {
        scene.robot((Them, 3), -4.0, 0.0);
        let mut fouls = Vec::new();
        for _ in 0..81 {
            scene.touch((Them, 3));
            scene.step();
            fouls.push(scene.count_of(AttackerTouchedBallInDefenseArea));
        }
        assert_eq!((fouls[0], fouls[80], fouls.iter().sum::<usize>()), (1, 1, 2));
    }
    for mut scene in views(B) {
        scene.robot((Them, 3), -4.0, 0.0);
        scene.touch((Them, 3));
        scene.step();
        scene.wait(0.2);
        scene.touch((Them, 3));
        scene.step();
        scene.only(AttackerTouchedBallInDefenseArea);
        scene.expect_fouls(0, 2);
    }
}

#[test]
fn before_a_kick_nobody_is_judged_for_touches_in_areas() {
    for bot in [(Us, 3), (Them, 3)] {
        for mut scene in views(B) {
            scene.ball(-2.5, 0.0);
            scene.free_kick(bot.0);
            scene.robot(bot, -4.0, 0.0);
            scene.touch(bot);
            scene.step();
            scene.expect_play();
        }
    }
}

#[test]
fn the_ball_must_not_stay_in_an_area() {
    for (division, seconds, place) in [(A, 5.0, (-3.2, 0.3)), (B, 10.0, (-2.5, 0.3))] {
        for mut scene in views(division) {
            let x = 0.5 - scene.referee.pitch().lines.half_length;
            let mut y = 0.3;
            for _ in 0..scene.steps(seconds) {
                y = -y; // it moves, so that there is progress
                scene.ball(x, y);
                scene.step();
                scene.expect_play();
            }
            scene.ball(x, 0.3);
            scene.step();
            scene.expect_team(KeeperHeldBall, Some(Us), (x, 0.3));
            scene.expect_next(DirectFree, Them, place);
            scene.expect_fouls(1, 0);
        }
    }
}

#[test]
fn the_time_in_an_area_begins_anew_when_the_ball_leaves_it() {
    for mut scene in views(A) {
        for nth in 0..3 {
            scene.ball(-5.0, 0.3);
            scene.wait(4.0);
            assert_eq!(scene.events(), [], "{nth}");
            scene.ball(-4.19, 0.3);
            scene.step();
        }
        scene.expect_play();
    }
}

#[test]
fn each_area_counts_against_its_own_team() {
    for mut scene in views(A) {
        scene.ball(5.0, 0.3);
        scene.settle();
        scene.wait(4.0);
        scene.ball(5.0, -0.3);
        scene.wait(1.1);
        assert_eq!(scene.only(KeeperHeldBall).side, Some(Them));
        scene.expect_fouls(0, 1);
    }
}
