//! Robots in a stop and before a kick: "Robot Stop Speed", "Robot Too Close To Opponent Defense Area",
//! "Defender Too Close To Ball".

use rsim_referee::codes::Command::{
    self, BallPlacement, DirectFree, ForceStart, Halt, PrepareKickoff, PreparePenalty, Stop,
};
use rsim_referee::config::RefereeConfig;
use rsim_referee::events::EventKind::{
    AttackerTooCloseToDefenseArea, BotTooFastInStop, DefenderTooCloseToKickPoint,
};

use crate::scene::{A, B, Scene, Them, Us, views, views_with};

/// A stop that lasts long.
fn stop_long(scene: &mut Scene, next: fn(rsim_referee::Team) -> Command) {
    scene.stop(next, Us, (0.0, 0.0));
    scene.game.wait_steps = scene.steps(60.0);
}

#[test]
fn a_robot_that_is_too_fast_in_a_stop_is_a_foul_once() {
    for mut scene in views(B) {
        stop_long(&mut scene, DirectFree);
        scene.robot((Them, 3), 1.0, 1.0);
        scene.robot_velocity((Them, 3), 1.2, 1.2);
        assert_eq!(scene.wait(2.0), [], "time to slow down");
        scene.step();
        scene.expect_bot(BotTooFastInStop, (Them, 3), (1.0, 1.0));
        scene.expect_next(DirectFree, Us, (0.0, 0.0));
        assert_eq!(scene.wait(5.0), []);
        scene.expect_fouls(0, 1);
        scene.robot_velocity((Us, 3), 0.0, -1.6);
        scene.step();
        assert_eq!(scene.only(BotTooFastInStop).bot, Some((Us, 3)));
        scene.expect_fouls(1, 1);
    }
}

#[test]
fn the_speed_limit_is_that_of_stops_alone() {
    for mut scene in views(B) {
        stop_long(&mut scene, DirectFree);
        scene.robot_velocity((Them, 3), 1.49, 0.0);
        assert_eq!(scene.wait(5.0), []);
    }
    for command in [BallPlacement as fn(_) -> _, PrepareKickoff] {
        for mut scene in views(B) {
            stop_long(&mut scene, PrepareKickoff);
            let next = scene.game.next_command;
            scene.game.give(command(scene.team(Us)), next);
            scene.robot_velocity((Them, 3), 3.0, 0.0);
            scene.wait(2.5);
            assert_eq!(scene.count_of(BotTooFastInStop), 0);
        }
    }
}

#[test]
fn each_stop_counts_again() {
    for mut scene in views(B) {
        for fouls in 1..=2 {
            stop_long(&mut scene, PrepareKickoff);
            scene.robot_velocity((Them, 3), 1.6, 0.0);
            scene.wait(3.0);
            scene.expect_fouls(0, fouls);
            scene.game.wait_steps = 0;
            scene.run(20.0, |scene| scene.game.command == Command::NormalStart);
            scene.kick((Us, 1), 0.1, 0.0);
        }
    }
}

/// Our robot stands near their area in division B, in front of it.
fn stand_near(scene: &mut Scene, gap: f32) {
    scene.robot((Us, 3), 3.5 - 0.09 - gap, 0.0);
    scene.settle();
}

#[test]
fn a_robot_that_stays_too_close_to_the_area_is_a_foul() {
    for mut scene in views(B) {
        stop_long(&mut scene, ForceStart_for);
        stand_near(&mut scene, 0.19);
        assert_eq!(scene.wait(2.0), []);
        scene.step();
        scene.expect_bot(AttackerTooCloseToDefenseArea, (Us, 3), (3.22, 0.0));
        scene.expect_next(DirectFree, Them, (0.0, 0.0));
        scene.expect_fouls(1, 0);
    }
}

/// A force start, in the form of a command for a team.
#[allow(non_snake_case)]
fn ForceStart_for(_: rsim_referee::Team) -> Command {
    ForceStart
}

#[test]
fn two_decimeters_and_a_short_stay_are_far_enough() {
    for mut scene in views(B) {
        stop_long(&mut scene, DirectFree);
        stand_near(&mut scene, 0.21);
        assert_eq!(scene.wait(5.0), []);
        stand_near(&mut scene, 0.0);
        assert_eq!(scene.wait(1.9), []);
        stand_near(&mut scene, 0.3);
        scene.step();
        stand_near(&mut scene, 0.0);
        assert_eq!(scene.wait(1.9), [], "the time begins anew");
        scene.robot((Us, 3), -4.2, 0.0);
        assert_eq!(scene.wait(5.0), [], "the own area is free");
    }
}

#[test]
fn both_teams_keep_away_from_areas_before_a_free_kick() {
    for kicking in [Us, Them] {
        for mut scene in views(B) {
            scene.free_kick(kicking);
            stand_near(&mut scene, 0.1);
            scene.wait(2.0);
            scene.expect_play();
            scene.step();
            scene.only(AttackerTooCloseToDefenseArea);
            scene.expect_next(DirectFree, Them, (0.0, 0.0));
        }
    }
}

#[test]
fn areas_are_free_in_play_and_before_other_kicks() {
    for mut scene in views(B) {
        stand_near(&mut scene, 0.0);
        scene.wait(5.0);
        scene.expect_play();
    }
    for mut scene in views(B) {
        scene.free_kick(Us);
        stand_near(&mut scene, 0.0);
        scene.wait(1.5);
        scene.kick((Us, 1), 0.1, 0.0);
        scene.wait(1.5);
        scene.expect_play();
    }
    for mut scene in views(B) {
        scene.kickoff(Us);
        stand_near(&mut scene, 0.0);
        scene.wait(5.0);
        scene.expect_play();
    }
}

/// Robots are not put in valid places, so that they stay where they are.
fn placed_by_robots(config: &mut RefereeConfig) {
    config.placement = rsim_referee::config::Placement::Robots;
}

#[test]
fn the_second_foul_of_a_team_halts_play() {
    for mut scene in views_with(B, placed_by_robots) {
        scene.free_kick(Us);
        stand_near(&mut scene, 0.1);
        scene.wait(2.1);
        assert_eq!(scene.game.command, Stop, "the first one stops it");
        scene.game.wait_steps = scene.steps(60.0);
        scene.wait(2.0);
        scene.only(AttackerTooCloseToDefenseArea);
        assert_eq!(scene.game.command, Halt);
        assert_eq!(scene.game.next_command, Some(DirectFree(scene.team(Them))));
        scene.expect_fouls(2, 0);
        scene.run(2.1, |scene| scene.game.command == Stop);
        assert_eq!(scene.game.next_command, Some(DirectFree(scene.team(Them))));
    }
}

#[test]
fn fouls_of_different_teams_and_of_different_stops_do_not_halt() {
    for mut scene in views_with(B, placed_by_robots) {
        stop_long(&mut scene, PrepareKickoff);
        stand_near(&mut scene, 0.1);
        scene.wait(1.0);
        scene.robot((Them, 3), -3.25, 0.0);
        scene.wait(2.1);
        assert_eq!((scene.fouls(Us), scene.fouls(Them)), (1, 1));
        assert_eq!(scene.game.command, Stop);
    }
    for mut scene in views_with(B, placed_by_robots) {
        for _ in 0..2 {
            scene.free_kick(Us);
            stand_near(&mut scene, 0.1);
            scene.wait(2.1);
            assert_eq!(scene.game.command, Stop);
            scene.free_kick(Us);
            scene.kick((Us, 1), 0.1, 0.0);
            scene.ball(0.0, 0.0);
        }
    }
}

#[test]
fn a_due_kick_off_or_penalty_kick_stays_with_its_place() {
    for (next, place) in [(PrepareKickoff as fn(_) -> _, (0.0, 0.0)), (PreparePenalty, (-1.5, 0.0))]
    {
        for mut scene in views(B) {
            stop_long(&mut scene, next);
            let team = scene.team(Us);
            scene.game.next_command = Some(next(team));
            scene.stop_for(next(team), place);
            scene.game.wait_steps = scene.steps(60.0);
            stand_near(&mut scene, 0.1);
            scene.wait(2.1);
            scene.only(AttackerTooCloseToDefenseArea);
            scene.expect_next(next, Us, place);
            scene.expect_fouls(1, 0);
        }
    }
}

#[test]
fn a_free_kick_that_is_due_passes_to_the_others() {
    for mut scene in views(B) {
        stop_long(&mut scene, DirectFree);
        scene.ball(1.0, 1.0);
        stand_near(&mut scene, 0.1);
        scene.wait(2.1);
        scene.expect_next(DirectFree, Them, (1.0, 1.0));
    }
}

#[test]
fn a_robot_that_is_too_close_to_the_kick_is_a_foul() {
    for is_kickoff in [true, false] {
        for mut scene in views(B) {
            if is_kickoff {
                scene.kickoff(Us);
            } else {
                scene.free_kick(Us);
            }
            scene.wait(1.0);
            scene.robot((Them, 3), 0.0, 0.58);
            scene.step();
            scene.expect_bot(DefenderTooCloseToKickPoint, (Them, 3), (0.0, 0.58));
            assert!(scene.game.is_running() && !scene.game.in_play);
            scene.expect_fouls(0, 1);
            assert_eq!(scene.game.command_steps, 0, "the kicker has its time again");
        }
    }
}

#[test]
fn the_kickers_time_is_that_after_the_foul() {
    for mut scene in views(A) {
        scene.free_kick(Us);
        scene.wait(4.5);
        scene.robot((Them, 3), 0.0, 0.5);
        scene.step();
        scene.robot((Them, 3), 2.0, 0.5);
        scene.wait(4.9);
        assert!(!scene.game.in_play);
        scene.wait(0.1);
        assert!(scene.game.in_play);
    }
}

#[test]
fn half_a_meter_and_the_kicking_team_are_no_foul() {
    for mut scene in views(B) {
        scene.free_kick(Us);
        scene.robot((Them, 3), 0.0, 0.595);
        scene.robot((Us, 3), 0.0, -0.2);
        scene.wait(3.0);
        scene.expect_play();
    }
}

#[test]
fn the_foul_is_raised_once_in_two_seconds_for_each_team() {
    for mut scene in views(B) {
        scene.free_kick(Us);
        scene.robot((Them, 3), 0.0, 0.5);
        scene.wait(1.0);
        scene.robot((Them, 3), 2.0, 0.5);
        scene.wait(0.5);
        scene.robot((Them, 4), 0.0, 0.5);
        scene.wait(0.5);
        scene.expect_fouls(0, 1);
        scene.step();
        scene.expect_fouls(0, 2);
    }
}

#[test]
fn in_play_and_in_stops_nobody_is_too_close_to_the_ball() {
    for mut scene in views(B) {
        scene.free_kick(Us);
        scene.kick((Us, 1), 0.1, 0.0);
        scene.robot((Them, 3), 0.0, 0.3);
        scene.wait(1.0);
        scene.expect_play();
        stop_long(&mut scene, DirectFree);
        scene.robot((Them, 3), 0.0, 0.3);
        assert_eq!(scene.wait(1.0), []);
    }
}
