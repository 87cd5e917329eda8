//! The last toucher of a ball that leaves the field or enters a goal: every robot, for every line.

use rsim_referee::codes::Command::{DirectFree, ForceStart, PrepareKickoff};
use rsim_referee::events::EventKind::{
    self, BallLeftFieldGoalLine, BallLeftFieldTouchLine, Goal, InvalidGoal,
};

use crate::scene::{A, B, Bot, Division, Scene, Side, Them, Us, views};

/// Every robot of both teams.
fn all(scene: &Scene) -> Vec<Bot> {
    let numbers = 0..scene.size();
    numbers.flat_map(|number| Side::BOTH.map(|side| (side, number))).collect()
}

/// The ball passes from a place on the field to one beyond a line, with a robot as the last toucher.
fn leave(scene: &mut Scene, toucher: Option<Bot>, from: (f32, f32), to: (f32, f32)) {
    scene.free();
    scene.game.last_touch = None;
    scene.ball(0.5 * from.0, from.1);
    scene.settle();
    if let Some(bot) = toucher {
        scene.touch(bot);
    }
    scene.step();
    scene.expect_play();
    scene.ball(from.0, from.1);
    scene.step();
    scene.ball(to.0, to.1);
    scene.step();
}

/// Checks the event of every robot as the last toucher, and the team of the free kick.
fn each_toucher(division: Division, kind: EventKind, y: f32, ahead: (f32, f32), place: (f32, f32)) {
    let (line_x, line_y) = if division == A { (6.0, 4.5) } else { (4.5, 3.0) };
    let from = (ahead.0 * (line_x - 0.1), y + ahead.1 * (line_y - 0.1));
    let to = (from.0 + 0.2 * ahead.0, from.1 + 0.2 * ahead.1);
    for mut scene in views(division) {
        for bot in all(&scene) {
            leave(&mut scene, Some(bot), from, to);
            let event = scene.only(kind);
            assert_eq!((event.side, event.bot), (Some(bot.0), Some(bot)));
            assert_eq!(scene.events().len(), 1);
            // Over a goal line it depends on the toucher whether it is a goal kick or a corner kick.
            let is_corner = ahead.0 != 0.0 && (ahead.0 < 0.0) == (bot.0 == Us);
            let x = if is_corner { ahead.0 * (line_x - 0.2) } else { place.0 };
            scene.expect_next(DirectFree, bot.0.opponent(), (x, place.1));
        }
    }
}

#[test]
fn a_throw_in_is_for_the_opponents_of_whichever_robot_touched_the_ball_last() {
    each_toucher(B, BallLeftFieldTouchLine, 0.0, (0.0, 1.0), (0.0, 2.8));
    each_toucher(B, BallLeftFieldTouchLine, 0.0, (0.0, -1.0), (0.0, -2.8));
    each_toucher(A, BallLeftFieldTouchLine, 0.0, (0.0, 1.0), (0.0, 4.3));
}

#[test]
fn a_goal_kick_or_corner_kick_is_for_the_opponents_of_whichever_robot_touched_the_ball_last() {
    each_toucher(B, BallLeftFieldGoalLine, 2.0, (1.0, 0.0), (3.5, 2.8));
    each_toucher(B, BallLeftFieldGoalLine, -2.0, (-1.0, 0.0), (-3.5, -2.8));
    each_toucher(A, BallLeftFieldGoalLine, 3.0, (1.0, 0.0), (5.0, 4.3));
}

#[test]
fn a_goal_is_for_the_team_that_attacks_it_whichever_robot_touched_the_ball_last() {
    for mut scene in views(B) {
        for bot in all(&scene) {
            for (side, scorer) in [(1.0, Us), (-1.0, Them)] {
                let before = scene.score();
                leave(&mut scene, Some(bot), (4.4 * side, 0.2), (4.6 * side, 0.2));
                let event = scene.only(Goal);
                assert_eq!((event.side, event.bot), (Some(scorer), Some(bot)));
                let (us, them) = scene.score();
                let goals = (i32::from(scorer == Us), i32::from(scorer == Them));
                assert_eq!((us - before.0, them - before.1), goals);
                scene.expect_next(PrepareKickoff, scorer.opponent(), (0.0, 0.0));
                for side in Side::BOTH {
                    let team = scene.team(side);
                    scene.game.score[team] = 0; // the match goes on
                }
            }
        }
    }
}

#[test]
fn a_ball_that_nobody_touched_is_free_for_both_or_a_goal() {
    for mut scene in views(B) {
        leave(&mut scene, None, (0.0, 2.9), (0.0, 3.1));
        assert_eq!(scene.only(BallLeftFieldTouchLine).side, None);
        scene.expect_next_for(ForceStart, (0.0, 2.8));
        leave(&mut scene, None, (4.4, 2.0), (4.6, 2.0));
        assert_eq!(scene.only(BallLeftFieldGoalLine).side, None);
        scene.expect_next_for(ForceStart, (3.5, 2.8));
        leave(&mut scene, None, (4.4, 0.0), (4.6, 0.0));
        let event = scene.only(Goal);
        assert_eq!((event.side, event.bot, scene.score()), (Some(Us), None, (1, 0)));
    }
}

#[test]
fn a_goal_that_does_not_count_is_a_ball_over_the_line_by_its_last_toucher() {
    for mut scene in views(B) {
        for bot in all(&scene) {
            leave(&mut scene, Some(bot), (3.0, 0.2), (3.1, 0.2));
            for side in Side::BOTH {
                let team = scene.team(side);
                scene.game.height_since_touch[team] = 0.2;
            }
            scene.ball(4.4, 0.2);
            scene.step();
            scene.ball(4.6, 0.2);
            scene.step();
            let event = scene.only(InvalidGoal);
            assert_eq!((event.side, event.bot, scene.score()), (Some(Us), Some(bot), (0, 0)));
            let x = if bot.0 == Us { 3.5 } else { 4.3 };
            scene.expect_next(DirectFree, bot.0.opponent(), (x, 2.8));
        }
    }
}
