//! Goals, and the crowds that speak against them.

use rsim_referee::codes::Command;
use rsim_referee::events::EventKind;
use rsim_referee::{Team, Vector};

use crate::crowds::{attack, defend, goal_area};
use crate::pitches::{BALL_RADIUS, Size};
use crate::scene::{Scene, seen_by};

/// Rolls the ball of a team over the goal line that it attacks, at some distance from the middle.
fn shoot(scene: &mut Scene, attacker: Team, y: f32) {
    let x = scene.referee.pitch().lines.half_length + BALL_RADIUS + 0.001;
    scene.roll(seen_by(attacker, [x, y]), seen_by(attacker, [1.0, 0.0]));
}

fn each(check: impl Fn(Size, Team)) {
    for size in Size::BOTH {
        for team in Team::BOTH {
            check(size, team);
        }
    }
}

#[test]
fn a_ball_fully_over_the_line_is_a_goal() {
    each(|size, attacker| {
        for y in [0.0, 0.19, -0.19] {
            let mut scene = Scene::in_play(size);
            shoot(&mut scene, attacker, y);
            let event = scene.step_to(EventKind::Goal);
            assert_eq!(event.team, Some(attacker));
            assert_eq!(event.robot, None, "nobody has touched the ball");
            let line = scene.referee.pitch().lines.half_length + BALL_RADIUS;
            assert!((event.position.x.abs() - line).abs() < 1e-5);
            let score = Team::BOTH.map(|team| scene.game.score[team]);
            assert_eq!(score, Team::BOTH.map(|team| i32::from(team == attacker)));
            let kickoff = Command::PrepareKickoff(attacker.opponent());
            assert_eq!(
                (scene.game.command, scene.game.next_command),
                (Command::Stop, Some(kickoff))
            );
            assert_eq!(scene.game.designated_position, Vector::default());
        }
    });
}

#[test]
fn a_ball_on_the_line_is_no_goal() {
    each(|size, attacker| {
        let mut scene = Scene::in_play(size);
        let x = scene.referee.pitch().lines.half_length + BALL_RADIUS - 0.001;
        scene.roll(seen_by(attacker, [x, 0.0]), [1.0, 0.0]);
        assert_eq!(scene.step(), []);
        shoot(&mut scene, attacker, 0.0);
        scene.step_to(EventKind::Goal);
    });
}

#[test]
fn a_ball_beside_or_above_the_goal_is_no_goal() {
    each(|size, attacker| {
        for (y, height) in [(0.21, 0.0), (-0.21, 0.0), (0.0, 0.06)] {
            let mut scene = Scene::in_play(size);
            shoot(&mut scene, attacker, y);
            scene.lift(height);
            assert_eq!(scene.step(), [], "{y} {height}");
            assert!(scene.game.in_play);
        }
    });
}

#[test]
fn a_ball_that_rolls_in_after_a_foul_is_no_goal() {
    each(|size, attacker| {
        let mut scene = Scene::in_play(size);
        scene.ball([0.1, 0.1]);
        scene.first_event(6.0).expect("the ball is stuck");
        shoot(&mut scene, attacker, 0.0);
        assert_eq!(scene.step(), []);
        assert_eq!(scene.game.score[attacker], 0);
    });
}

#[test]
fn a_goal_names_the_last_toucher_and_counts_for_the_team_that_attacks_the_goal() {
    each(|size, attacker| {
        for toucher in Team::BOTH {
            let mut scene = Scene::in_play(size);
            scene.touch(toucher, 2);
            scene.step();
            shoot(&mut scene, attacker, 0.0);
            let event = scene.step_to(EventKind::Goal);
            assert_eq!((event.team, event.robot), (Some(attacker), Some(scene.index(toucher, 2))));
            assert_eq!(scene.game.score[attacker], 1, "an own goal counts too");
        }
    });
}

#[test]
fn a_goal_after_two_attackers_in_the_area_is_a_goal_kick() {
    each(|size, attacker| {
        let mut scene = Scene::in_play(size);
        attack(&mut scene, attacker, 2);
        scene.touch(attacker, 1);
        assert_eq!(scene.run(1.0), []);
        scene.park();
        assert_eq!(scene.run(1.0), [], "the ball is still in the area");
        shoot(&mut scene, attacker, 0.0);
        let event = scene.step_to(EventKind::InvalidGoal);
        let toucher = scene.index(attacker, 1);
        assert_eq!((event.team, event.robot), (Some(attacker), Some(toucher)));
        assert_eq!(scene.game.score[attacker], 0);
        let next = Command::GoalKick(attacker.opponent());
        assert_eq!(scene.game.next_command, Some(next));
    });
}

#[test]
fn a_goal_stands_with_one_attacker_and_with_a_ball_that_was_not_in_the_area_with_two() {
    each(|size, attacker| {
        let mut scene = Scene::in_play(size);
        attack(&mut scene, attacker, 1);
        assert_eq!(scene.run(1.0), []);
        shoot(&mut scene, attacker, 0.0);
        scene.step_to(EventKind::Goal);
        let mut scene = Scene::in_play(size);
        attack(&mut scene, attacker, 2);
        scene.roll([0.0, 0.0], [1.0, 0.0]);
        assert_eq!(scene.run(1.0), []);
        shoot(&mut scene, attacker, 0.0);
        scene.step_to(EventKind::Goal);
    });
}

#[test]
fn a_goal_stands_after_two_defenders_in_the_area() {
    each(|size, attacker| {
        let mut scene = Scene::in_play(size);
        defend(&mut scene, attacker.opponent(), 2);
        assert_eq!(scene.run(1.0), []);
        shoot(&mut scene, attacker, 0.0);
        scene.step_to(EventKind::Goal);
        assert_eq!(scene.game.score[attacker], 1);
        let next = Command::PrepareKickoff(attacker.opponent());
        assert_eq!(scene.game.next_command, Some(next));
    });
}

/// Lets both teams crowd the area, attackers and defenders for some time before the goal. Returns the command
/// after it.
fn after_both(size: Size, attacker: Team, attackers: f32, defenders: f32) -> Option<Command> {
    let mut scene = Scene::in_play(size);
    let mut crowds = [(attackers, true), (defenders, false)];
    crowds.sort_by(|a, b| b.0.total_cmp(&a.0));
    scene.roll(seen_by(attacker, [goal_area(size) + 0.05, 0.0]), [1.0, 0.0]);
    for (nth, (seconds, is_attack)) in crowds.into_iter().enumerate() {
        let next = if nth == 0 { crowds[1].0 } else { 0.0 };
        if is_attack {
            attack(&mut scene, attacker, 2);
        } else {
            defend(&mut scene, attacker.opponent(), 2);
        }
        assert_eq!(scene.run(seconds - next), []);
    }
    shoot(&mut scene, attacker, 0.0);
    scene.step_to(EventKind::InvalidGoal);
    assert_eq!(scene.game.score[attacker], 0);
    scene.game.next_command
}

#[test]
fn after_a_goal_with_two_of_each_the_longer_foul_decides() {
    each(|size, attacker| {
        let goal_kick = Some(Command::GoalKick(attacker.opponent()));
        let penalty = Some(Command::PreparePenalty(attacker));
        assert_eq!(after_both(size, attacker, 2.0, 1.0), goal_kick);
        assert_eq!(after_both(size, attacker, 1.0, 2.0), penalty);
        assert_eq!(after_both(size, attacker, 1.0, 1.0), penalty, "the defenders' if equal");
    });
}

#[test]
fn rules_that_are_off_do_not_judge_goals() {
    each(|size, attacker| {
        let mut config = size.config();
        config.off = vec!["GOAL".to_owned()];
        let mut scene = Scene::in_play_with(size, config.clone());
        shoot(&mut scene, attacker, 0.0);
        assert_eq!(scene.step(), []);
        config.off = vec!["ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA".to_owned()];
        let mut scene = Scene::in_play_with(size, config);
        attack(&mut scene, attacker, 2);
        assert_eq!(scene.run(1.0), []);
        shoot(&mut scene, attacker, 0.0);
        scene.step_to(EventKind::Goal);
    });
}
