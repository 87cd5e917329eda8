//! Numbers that robots observe of a match.

use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::RefereeConfig;
use rsim_referee::features::FEATURES;
use rsim_referee::game::Game;

use crate::scene::{B, Bot, Scene, Side, Them, Us, views, views_with};

/// All numbers that a robot observes.
fn observed(scene: &Scene, bot: Bot) -> [f32; FEATURES.len()] {
    let features = scene.referee.features(&scene.game, scene.row()).expect("a row of this layout");
    let mut numbers = [7.0; FEATURES.len()];
    features.write(scene.index(bot), &mut numbers);
    numbers
}

/// The number with a name.
fn number(scene: &Scene, bot: Bot, name: &str) -> f32 {
    let place = FEATURES.iter().position(|feature| *feature == name).expect("a feature");
    observed(scene, bot)[place]
}

#[track_caller]
fn expect_number(scene: &Scene, bot: Bot, name: &str, expected: f32) {
    let got = number(scene, bot, name);
    assert!((got - expected).abs() < 1e-5, "{name}: expected {expected}, got {got}");
}

/// Names of the numbers about commands that are 1; all others of them are 0.
fn shown(scene: &Scene, bot: Bot) -> Vec<&'static str> {
    let commands = FEATURES.iter().take_while(|name| **name != "may_touch");
    let numbers = observed(scene, bot).into_iter().zip(commands);
    numbers
        .filter(|(number, _)| *number != 0.0)
        .map(|(number, name)| {
            assert!((number - 1.0).abs() < 1e-6, "{name}: {number}");
            *name
        })
        .collect()
}

#[test]
fn each_command_and_the_next_kick_are_shown_from_the_side_of_the_team() {
    for mut scene in views(B) {
        let us = scene.team(Us);
        for (command, next, own, others) in [
            (Command::Halt, None, vec!["halt"], vec!["halt"]),
            (
                Command::Halt,
                Some(Command::PrepareKickoff(us)),
                vec!["halt", "next_own_kickoff"],
                vec!["halt", "next_opponents_kickoff"],
            ),
            (
                Command::Stop,
                Some(Command::PreparePenalty(us)),
                vec!["stop", "next_own_penalty"],
                vec!["stop", "next_opponents_penalty"],
            ),
            (
                Command::BallPlacement(us),
                Some(Command::DirectFree(us)),
                vec!["own_placement", "next_own_free_kick"],
                vec!["opponents_placement", "next_opponents_free_kick"],
            ),
            (
                Command::Stop,
                Some(Command::ForceStart),
                vec!["stop", "next_free_ball"],
                vec!["stop", "next_free_ball"],
            ),
            (
                Command::PrepareKickoff(us),
                Some(Command::NormalStart),
                vec!["own_kickoff"],
                vec!["opponents_kickoff"],
            ),
            (Command::DirectFree(us), None, vec!["own_free_kick"], vec!["opponents_free_kick"]),
        ] {
            scene.game.in_play = false;
            scene.game.give(command, next);
            for number in [0, 5] {
                assert_eq!(shown(&scene, (Us, number)), own, "{command:?}");
                assert_eq!(shown(&scene, (Them, number)), others, "{command:?}");
            }
        }
    }
}

#[test]
fn a_permitted_kick_is_shown_until_the_ball_is_in_play() {
    for mut scene in views(B) {
        let us = scene.team(Us);
        for (command, kick, name) in [
            (Command::NormalStart, Some(Command::PrepareKickoff(us)), "own_kickoff"),
            (Command::NormalStart, Some(Command::PreparePenalty(us)), "own_penalty"),
            (Command::NormalStart, None, "in_play"),
            (Command::DirectFree(us), Some(Command::DirectFree(us)), "own_free_kick"),
        ] {
            scene.game.give(command, None);
            scene.game.kick = kick;
            scene.game.in_play = false;
            assert_eq!(shown(&scene, (Us, 1)), [name]);
            scene.game.in_play = true;
            assert_eq!(shown(&scene, (Us, 1)), ["in_play"]);
        }
        scene.free();
        assert_eq!(shown(&scene, (Us, 1)), ["in_play"]);
    }
}

#[test]
fn robots_see_who_may_touch_the_ball() {
    for mut scene in views(B) {
        let touchers = |scene: &Scene| {
            Side::BOTH.map(|side| [1, 2].map(|nth| number(scene, (side, nth), "may_touch")))
        };
        scene.free();
        assert_eq!(touchers(&scene), [[1.0; 2], [1.0; 2]]);
        scene.free_kick(Them);
        assert_eq!(touchers(&scene), [[0.0; 2], [1.0; 2]]);
        scene.game.in_play = true;
        scene.game.kick_taker = Some(scene.index((Them, 2)));
        assert_eq!(touchers(&scene), [[1.0; 2], [1.0, 0.0]]);
        scene.stop(Command::DirectFree, Us, (0.0, 0.0));
        assert_eq!(touchers(&scene), [[0.0; 2], [0.0; 2]]);
    }
}

/// Times that differ from each other.
fn times(config: &mut RefereeConfig) {
    config.halt_seconds = 4.0;
    config.prepare_seconds = 3.0;
    config.kickoff_seconds = 7.0;
    config.penalty_seconds = 8.0;
    config.free_kick_seconds = 9.0;
}

#[test]
fn the_time_to_act_is_that_of_the_command_less_what_has_passed() {
    for mut scene in views_with(B, times) {
        let us = scene.team(Us);
        let kickoff = Some(Command::PrepareKickoff(us));
        let penalty = Some(Command::PreparePenalty(us));
        for (command, kick, in_play, seconds) in [
            (Command::Halt, None, false, 4.0),
            (Command::Stop, None, false, 6.0),
            (Command::BallPlacement(us), None, false, 6.0),
            (Command::PrepareKickoff(us), kickoff, false, 3.0),
            (Command::PreparePenalty(us), penalty, false, 3.0),
            (Command::FreeBall, None, false, 3.0),
            (Command::GoalKick(us), None, false, 3.0),
            (Command::NormalStart, kickoff, false, 7.0),
            (Command::NormalStart, penalty, false, 8.0),
            (Command::DirectFree(us), Some(Command::DirectFree(us)), false, 9.0),
            (Command::NormalStart, kickoff, true, 0.0),
            (Command::DirectFree(us), Some(Command::DirectFree(us)), true, 0.0),
            (Command::ForceStart, Some(Command::ForceStart), true, 0.0),
        ] {
            scene.game.give(command, None);
            (scene.game.kick, scene.game.in_play) = (kick, in_play);
            scene.game.wait_steps = scene.steps(6.0);
            expect_number(&scene, (Them, 3), "time_to_act", seconds / 10.0);
            scene.game.command_steps = scene.steps(2.0);
            let left: f32 = seconds - 2.0;
            expect_number(&scene, (Them, 3), "time_to_act", left.max(0.0) / 10.0);
            scene.game.command_steps = scene.steps(30.0);
            expect_number(&scene, (Them, 3), "time_to_act", 0.0);
        }
    }
}

#[test]
fn the_place_of_the_next_kick_is_relative_to_the_robot_and_turned_to_its_side() {
    for mut scene in views(B).step_by(2) {
        scene.robot((Us, 1), -0.5, -1.0);
        scene.robot((Them, 2), 2.0, 1.5);
        scene.stop(Command::DirectFree, Us, (1.0, 0.5));
        for (bot, x, y) in [((Us, 1), 1.5, 1.5), ((Them, 2), 1.0, 1.0)] {
            expect_number(&scene, bot, "designated_x", x / 4.5);
            expect_number(&scene, bot, "designated_y", y / 4.5);
        }
        scene.take_out((Us, 1));
        scene.game.in_play = false;
        expect_number(&scene, (Us, 1), "designated_x", 0.0);
        scene.game.in_play = true;
        expect_number(&scene, (Them, 2), "designated_x", 0.0);
        expect_number(&scene, (Them, 2), "designated_y", 0.0);
    }
}

#[test]
fn the_first_robot_of_a_team_is_its_keeper() {
    for scene in views(B) {
        for side in [Us, Them] {
            for (robot, expected) in [(0, 1.0), (1, 0.0), (5, 0.0)] {
                expect_number(&scene, (side, robot), "keeper", expected);
            }
        }
    }
}

#[test]
fn the_way_that_a_robot_has_dribbled_is_a_share_of_the_allowed_one() {
    let half = |config: &mut RefereeConfig| config.dribble_distance = 0.5;
    for (mut scene, share) in
        views(B).map(|scene| (scene, 0.4)).chain(views_with(B, half).map(|scene| (scene, 0.8)))
    {
        scene.game.in_play = true;
        scene.game.dribbler = Some(scene.index((Us, 1)));
        scene.ball(0.5, -0.3);
        scene.game.dribble_start = scene.sight().ball().position;
        scene.ball(0.5, 0.1);
        expect_number(&scene, (Us, 1), "dribbled", share);
        expect_number(&scene, (Us, 2), "dribbled", 0.0);
        scene.game.in_play = false;
        expect_number(&scene, (Us, 1), "dribbled", 0.0);
    }
}

#[test]
fn the_difference_of_goals_is_in_units_of_five() {
    for mut scene in views(B) {
        for (us, them, expected) in [(2, 1, 0.2), (1, 4, -0.6), (9, 0, 1.0), (0, 9, -1.0)] {
            for (side, goals) in [(Us, us), (Them, them)] {
                let team = scene.team(side);
                scene.game.score[team] = goals;
            }
            expect_number(&scene, (Us, 2), "score_difference", expected);
            expect_number(&scene, (Them, 2), "score_difference", -expected);
        }
    }
}

#[test]
fn the_time_left_is_a_share_of_the_half() {
    for mut scene in views(B) {
        for (stage, seconds, expected) in [
            (Stage::FirstHalf, 300.0, 1.0),
            (Stage::FirstHalf, 75.0, 0.25),
            (Stage::SecondHalf, 150.0, 0.5),
            (Stage::ExtraFirstHalf, 75.0, 0.5),
            (Stage::SecondHalf, 0.0, 0.0),
            (Stage::FirstHalfPre, 0.0, 1.0),
            (Stage::Shootout, 0.0, 1.0),
        ] {
            scene.game.stage = stage;
            scene.game.stage_steps_left = scene.steps(seconds);
            expect_number(&scene, (Us, 0), "time_left", expected);
        }
        scene.game.stage = Stage::FirstHalf;
        scene.game.stage_steps_left = -40; // the half ends at the next stop
        expect_number(&scene, (Us, 0), "time_left", 0.0);
    }
}

#[test]
fn robots_on_the_field_are_shares_of_those_in_the_match() {
    for mut scene in views(B) {
        scene.take_out((Us, 1));
        scene.take_out((Us, 2));
        scene.take_out((Them, 4));
        for (bot, own, others) in [((Us, 3), 4.0, 5.0), ((Them, 3), 5.0, 4.0)] {
            expect_number(&scene, bot, "own_robots", own / 6.0);
            expect_number(&scene, bot, "opponents_robots", others / 6.0);
        }
    }
}

#[test]
fn rows_of_another_length_are_refused() {
    let scene = views(B).next().expect("a view");
    assert!(scene.referee.features(&Game::new(scene.team(Us)), &scene.row()[1..]).is_err());
}
