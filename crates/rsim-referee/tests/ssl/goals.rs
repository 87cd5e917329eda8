//! "Scoring Goals": what is a goal, and what speaks against it.

use rsim_referee::codes::Command::{DirectFree, PrepareKickoff};
use rsim_referee::config::Placement;
use rsim_referee::events::EventKind::{
    AttackerTouchedBallInDefenseArea, BallLeftFieldGoalLine, BotCrashUnique, BotKickedBallTooFast,
    Goal, InvalidGoal,
};

use crate::scene::{A, B, Bot, Scene, Them, Us, views, views_with};

const BEYOND: f32 = 0.005 + 0.0215;

/// A robot touches the ball in front of their goal, which then enters it.
fn shoot(scene: &mut Scene, shooter: Bot) {
    touch_before_goal(scene, shooter);
    enter(scene);
}

fn touch_before_goal(scene: &mut Scene, toucher: Bot) {
    scene.ball(3.0, 0.2);
    scene.settle();
    scene.touch(toucher);
    scene.step();
}

fn enter(scene: &mut Scene) {
    let x = scene.referee.pitch().lines.half_length;
    scene.ball(x - 0.1, 0.2);
    scene.settle();
    scene.ball(x + 0.1, 0.2);
    scene.step();
}

#[test]
fn a_goal_counts_and_the_others_kick_off() {
    for division in [A, B] {
        for mut scene in views(division) {
            shoot(&mut scene, (Us, 2));
            let x = scene.referee.pitch().lines.half_length;
            scene.expect_bot(Goal, (Us, 2), (x + BEYOND, 0.2));
            assert_eq!((scene.events().len(), scene.score()), (1, (1, 0)));
            scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
            assert_eq!(scene.game.wait_steps, scene.steps(2.0));
            scene.expect_fouls(0, 0);
        }
    }
}

#[test]
fn an_own_goal_counts_for_the_others() {
    for mut scene in views(B) {
        shoot(&mut scene, (Them, 2));
        let event = scene.only(Goal);
        assert_eq!((event.side, event.bot), (Some(Us), Some((Them, 2))));
        assert_eq!(scene.score(), (1, 0));
        scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
    }
}

#[test]
fn beside_and_above_the_goal_and_before_the_line_is_no_goal() {
    for (y, height, is_goal) in
        [(0.49, 0.0, true), (0.51, 0.0, false), (0.0, 0.14, true), (0.0, 0.17, false)]
    {
        for mut scene in views(B) {
            touch_before_goal(&mut scene, (Them, 2));
            scene.ball(4.4, y);
            scene.ball_height(height);
            scene.settle();
            scene.ball(4.6, y);
            scene.ball_height(height);
            scene.step();
            assert_eq!(scene.count_of(Goal), usize::from(is_goal), "{y} {height}");
            assert_eq!(scene.count_of(BallLeftFieldGoalLine), usize::from(!is_goal));
        }
    }
    for mut scene in views(B) {
        touch_before_goal(&mut scene, (Us, 2));
        scene.ball(4.52, 0.0);
        scene.step();
        scene.expect_play();
    }
}

#[test]
fn the_height_of_a_shot_is_that_over_the_line() {
    for (before, after, is_goal) in [(0.0, 0.4, false), (0.4, 0.0, false), (0.3, 0.0, true)] {
        for mut scene in views(B) {
            touch_before_goal(&mut scene, (Them, 2));
            scene.ball(4.5 + BEYOND - 0.1, 0.0);
            scene.ball_height(before);
            scene.settle();
            scene.ball(4.5 + BEYOND + 0.1, 0.0);
            scene.ball_height(after);
            scene.step();
            let shots = [Goal, InvalidGoal].map(|kind| scene.count_of(kind));
            assert_eq!(shots.iter().sum::<usize>(), usize::from(is_goal), "{before} {after}");
        }
    }
}

/// A robot touches the ball, which then is at a height, and enters the goal from the floor.
fn shoot_high(scene: &mut Scene, shooter: Bot, height: f32) {
    touch_before_goal(scene, shooter);
    scene.ball(3.5, 0.2);
    scene.ball_height(height);
    scene.step();
    enter(scene);
}

#[test]
fn a_ball_that_was_too_high_scores_no_goal() {
    for mut scene in views(B) {
        shoot_high(&mut scene, (Us, 2), 0.16);
        scene.expect_bot(InvalidGoal, (Us, 2), (4.5 + BEYOND, 0.2));
        assert_eq!((scene.count_of(Goal), scene.score()), (0, (0, 0)));
        scene.only(BallLeftFieldGoalLine);
        scene.expect_next(DirectFree, Them, (3.5, 2.8));
        scene.expect_fouls(0, 0);
    }
    for mut scene in views(B) {
        shoot_high(&mut scene, (Us, 2), 0.14);
        assert_eq!(scene.score(), (1, 0));
    }
}

#[test]
fn the_height_counts_since_the_last_touch_of_the_scoring_team() {
    for mut scene in views(B) {
        touch_before_goal(&mut scene, (Us, 2));
        scene.ball_height(0.3);
        scene.step();
        scene.ball(3.0, 0.2);
        scene.touch((Us, 4));
        scene.step();
        enter(&mut scene);
        assert_eq!(scene.score(), (1, 0), "a touch of the team resets it");
    }
    for mut scene in views(B) {
        touch_before_goal(&mut scene, (Us, 2));
        scene.ball_height(0.3);
        scene.step();
        scene.ball(3.0, 0.2);
        scene.touch((Them, 4));
        scene.step();
        enter(&mut scene);
        assert_eq!(scene.score(), (0, 0), "a touch of the others does not");
        scene.only(InvalidGoal);
        scene.expect_next(DirectFree, Us, (4.3, 2.8));
    }
}

#[test]
fn the_height_between_touch_and_end_of_a_step_counts() {
    for (height, is_goal) in [(0.16, false), (0.14, true)] {
        for mut scene in views(B) {
            scene.ball(3.0, 0.2);
            scene.settle();
            scene.touch((Us, 2));
            scene.since_touch(5.0, height); // it comes down in the step
            scene.step();
            enter(&mut scene);
            assert_eq!(scene.score(), (i32::from(is_goal), 0), "{height}");
        }
    }
}

#[test]
fn the_last_of_two_robots_that_touch_the_ball_in_a_step_is_the_scorer() {
    for mut scene in views(B) {
        for (first, second) in [((Us, 2), (Them, 3)), ((Them, 3), (Us, 2))] {
            scene.free();
            scene.ball(3.0, 0.2);
            scene.settle();
            scene.touch(first);
            scene.touch(second);
            scene.step();
            enter(&mut scene);
            assert_eq!(scene.only(Goal).bot, Some(second));
        }
    }
}

#[test]
fn a_chip_into_the_own_goal_is_as_high_as_since_the_others_touched_the_ball() {
    for mut scene in views(B) {
        shoot_high(&mut scene, (Them, 2), 0.3);
        assert_eq!(scene.score(), (0, 0), "we have never touched it");
    }
    for mut scene in views(B) {
        touch_before_goal(&mut scene, (Them, 2));
        scene.ball_height(0.3);
        scene.step();
        scene.ball(3.2, 0.2);
        scene.touch((Us, 2));
        scene.step();
        shoot(&mut scene, (Them, 3));
        assert_eq!(scene.score(), (1, 0));
    }
}

#[test]
fn a_team_with_too_many_robots_scores_no_goal() {
    for (cards, expected) in [([0, 0], 1), ([1000, 0], 0)] {
        for mut scene in views(B) {
            let team = scene.team(Us);
            scene.game.yellow_steps_left[team] = cards;
            shoot(&mut scene, (Us, 2));
            assert_eq!(scene.score(), (expected, 0));
            assert_eq!(scene.count_of(InvalidGoal), usize::from(expected == 0));
        }
    }
    for mut scene in views(B) {
        let team = scene.team(Us);
        scene.game.yellow_steps_left[team] = [1000, 0];
        shoot(&mut scene, (Them, 2));
        assert_eq!(scene.score(), (0, 0), "an own goal of the others does not count for us either");
    }
    for mut scene in views(B) {
        let team = scene.team(Them);
        scene.game.yellow_steps_left[team] = [1000, 0];
        shoot(&mut scene, (Us, 2));
        assert_eq!(scene.score(), (1, 0), "cards of the others do not matter");
    }
}

#[test]
fn no_goal_counts_within_two_seconds_of_an_own_foul_that_did_not_stop_play() {
    for (seconds, expected) in [(0.5, 0), (1.9, 0), (2.1, 1)] {
        for mut scene in views(B) {
            scene.collide((Us, 4), (Them, 4), 2.0);
            scene.robot_velocity((Us, 4), 2.0, 0.0);
            scene.settle();
            scene.step();
            scene.expect_fouls(1, 0);
            scene.wait(seconds - 0.05);
            shoot(&mut scene, (Us, 2));
            assert_eq!(scene.score(), (expected, 0), "{seconds}");
        }
    }
    for mut scene in views(B) {
        scene.collide((Us, 4), (Them, 4), 2.0);
        scene.robot_velocity((Them, 4), 2.0, 0.0);
        scene.settle();
        scene.step();
        scene.expect_fouls(0, 1);
        shoot(&mut scene, (Us, 2));
        assert_eq!(scene.score(), (1, 0), "a foul of the others does not matter");
    }
}

#[test]
fn a_foul_in_the_step_of_the_goal_speaks_against_it() {
    for mut scene in views(B) {
        scene.ball(4.45, 0.2);
        scene.settle();
        scene.robot((Us, 2), 4.3, 0.2);
        scene.touch((Us, 2));
        scene.ball(4.6, 0.2);
        scene.step();
        scene.only(AttackerTouchedBallInDefenseArea);
        scene.only(InvalidGoal);
        assert_eq!(scene.score(), (0, 0));
        scene.expect_fouls(1, 0);
    }
    for mut scene in views(B) {
        scene.ball(4.45, 0.2);
        scene.settle();
        scene.touch((Us, 2));
        scene.ball(4.6, 0.2);
        scene.ball_velocity(6.6, 0.0, 0.0);
        scene.step();
        scene.only(BotKickedBallTooFast);
        assert_eq!(scene.score(), (0, 0));
    }
}

#[test]
fn a_foul_of_the_others_in_the_step_of_the_goal_does_not_speak_against_it() {
    for mut scene in views(B) {
        touch_before_goal(&mut scene, (Us, 2));
        scene.ball(4.4, 0.2);
        scene.robot_velocity((Them, 4), 2.0, 0.0);
        scene.settle();
        scene.collide((Us, 4), (Them, 4), 2.0);
        scene.ball(4.6, 0.2);
        scene.step();
        scene.only(BotCrashUnique);
        scene.expect_fouls(0, 1);
        assert_eq!(scene.score(), (1, 0));
    }
}

#[test]
fn a_foul_before_the_kick_does_not_speak_against_a_goal() {
    for mut scene in views(B) {
        scene.free_kick(Them);
        scene.robot((Us, 2), 0.3, 0.3);
        scene.step();
        scene.expect_fouls(1, 0);
        scene.kick((Them, 1), 0.3, 0.0);
        shoot(&mut scene, (Us, 2));
        assert_eq!(scene.score(), (1, 0));
    }
}

#[test]
fn a_goal_may_be_scored_directly_from_kick_off_and_free_kick() {
    for is_kickoff in [true, false] {
        for mut scene in views(B) {
            if is_kickoff {
                scene.kickoff(Us);
            } else {
                scene.free_kick(Us);
            }
            scene.kick((Us, 1), 0.2, 0.0);
            enter(&mut scene);
            scene.expect_bot(Goal, (Us, 1), (4.5 + BEYOND, 0.2));
            assert_eq!(scene.score(), (1, 0));
        }
    }
}

#[test]
fn a_ball_in_the_goal_while_play_is_stopped_is_no_goal() {
    let by_robots = |config: &mut rsim_referee::config::RefereeConfig| {
        config.placement = Placement::Robots;
    };
    for mut scene in views_with(B, by_robots) {
        scene.stop(DirectFree, Us, (1.0, 1.0));
        enter(&mut scene);
        assert_eq!((scene.events().len(), scene.score()), (0, (0, 0)));
    }
}

#[test]
fn a_goal_ends_what_another_rule_would_stop() {
    for mut scene in views(B) {
        scene.ball(4.45, 0.2);
        scene.settle();
        scene.robot((Them, 2), 4.3, 0.3);
        scene.touch((Them, 2));
        scene.ball(4.6, 0.2);
        scene.step();
        assert_eq!(scene.score(), (1, 0), "the defender in its area does not spoil it");
        scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
    }
}
