//! "Ball Placement" by robots, and "Ball Placement Interference".

use rsim_referee::Team;
use rsim_referee::codes::Command::{
    self, BallPlacement, DirectFree, ForceStart, PrepareKickoff, Stop,
};
use rsim_referee::events::EventKind::{
    AimlessKick, BallLeftFieldGoalLine, BallLeftFieldTouchLine, BotInterferedPlacement,
    DefenderTooCloseToKickPoint, PlacementFailed, PlacementSucceeded,
};

use crate::scene::{A, B, Division, Scene, Side, Them, Us, expect_near, views_with_placement};

/// Puts the robots of both teams far from the way of the ball.
fn make_way(scene: &mut Scene) {
    for number in 1..scene.size() {
        let y = 0.4 * f32::from(u8::try_from(number).expect("few"));
        scene.robot((Us, number), -1.0, y - 2.0);
        scene.robot((Them, number), 2.8, y - 2.0);
    }
}

/// A stop before a command is over, with the ball far from its place, and robots far from both.
fn place(scene: &mut Scene, next: Command) {
    make_way(scene);
    scene.ball(1.0, -2.0);
    scene.stop_for(next, (1.0, 2.0));
    scene.wait(2.0);
}

fn place_for_us(division: Division) -> impl Iterator<Item = Scene> {
    views_with_placement(division).map(|mut scene| {
        let next = DirectFree(scene.team(Us));
        place(&mut scene, next);
        scene.expect_command(BallPlacement, Us);
        assert_eq!(scene.game.next_command, Some(next));
        scene
    })
}

#[test]
fn a_placed_ball_gives_the_free_kick_after_two_seconds() {
    for mut scene in place_for_us(B) {
        scene.wait(1.0);
        scene.ball(1.1, 2.0);
        scene.wait(0.975);
        assert_eq!(scene.events(), []);
        scene.expect_command(BallPlacement, Us);
        scene.step();
        scene.expect_team(PlacementSucceeded, Some(Us), (1.1, 2.0));
        scene.expect_command(DirectFree, Us);
        expect_near(scene.ball_at(), (1.1, 2.0));
        scene.expect_fouls(0, 0);
    }
}

#[test]
fn the_kick_is_taken_from_where_the_ball_was_placed() {
    for mut scene in place_for_us(B) {
        scene.ball(1.1, 2.0);
        scene.run(3.0, |scene| scene.game.command != BallPlacement(scene.team(Us)));
        scene.wait(1.0);
        assert!(!scene.game.in_play, "the ball has not moved");
        scene.kick((Us, 1), 1.2, 2.0);
        assert!(scene.game.in_play);
    }
}

#[test]
fn a_ball_that_is_far_moves_or_has_a_robot_beside_it_is_not_placed() {
    for mut scene in place_for_us(B) {
        scene.ball(1.16, 2.0);
        assert_eq!(scene.wait(5.0), [], "too far");
        scene.ball(1.1, 2.0);
        scene.ball_velocity(0.2, 0.0, 0.0);
        assert_eq!(scene.wait(1.0), [], "it moves");
        scene.ball(1.1, 2.0);
        scene.robot((Us, 2), 1.1, 2.0 - 0.09 - 0.0215 - 0.045);
        assert_eq!(scene.wait(1.0), [], "a robot is beside it");
        scene.robot((Us, 2), 1.1, 2.0 - 0.09 - 0.0215 - 0.055);
        scene.step();
        scene.only(PlacementSucceeded);
    }
}

#[test]
fn before_a_force_start_robots_keep_half_a_meter() {
    for mut scene in views_with_placement(B) {
        place(&mut scene, ForceStart);
        assert!(matches!(scene.game.command, BallPlacement(_)));
        scene.ball(1.0, 2.0);
        scene.robot((Us, 2), 1.0, 2.0 - 0.09 - 0.0215 - 0.49);
        let team = scene.team(Us);
        scene.game.give(BallPlacement(team), Some(ForceStart));
        assert_eq!(scene.wait(5.0), []);
        scene.robot((Us, 2), 1.0, 2.0 - 0.09 - 0.0215 - 0.51);
        scene.step();
        scene.only(PlacementSucceeded);
        assert_eq!((scene.game.command, scene.game.in_play), (ForceStart, true));
    }
}

#[test]
fn no_placement_is_needed_near_the_place() {
    for (ball, is_needed) in [((1.0, 1.01), false), ((1.0, 0.99), true), ((1.9, 2.0), false)] {
        for mut scene in views_with_placement(B) {
            make_way(&mut scene);
            scene.ball(ball.0, ball.1);
            scene.stop(DirectFree, Us, (1.0, 2.0));
            scene.wait(2.0);
            let expected: fn(Team) -> Command = if is_needed { BallPlacement } else { DirectFree };
            scene.expect_command(expected, Us);
            expect_near(scene.ball_at(), ball);
            if !is_needed {
                scene.wait(0.5);
                assert!(!scene.game.in_play, "the kick is taken from there");
            }
        }
    }
    for (ball, place, speed) in [
        ((0.5, 3.01), (0.5, 2.8), 0.0),
        ((2.85, 0.0), (2.5, 0.0), 0.0),
        ((1.0, 1.5), (1.0, 2.0), 0.2),
    ] {
        for mut scene in views_with_placement(B) {
            make_way(&mut scene);
            scene.ball(ball.0, ball.1);
            scene.ball_velocity(speed, 0.0, 0.0);
            scene.stop(DirectFree, Us, place);
            scene.wait(2.0);
            scene.expect_command(BallPlacement, Us);
        }
    }
}

#[test]
fn play_waits_for_robots_that_leave_a_ball_near_its_place() {
    for mut scene in views_with_placement(B) {
        make_way(&mut scene);
        scene.ball(1.0, 1.8);
        scene.robot((Them, 2), 1.3, 1.8);
        scene.stop(DirectFree, Us, (1.0, 2.0));
        scene.wait(5.0);
        assert_eq!(scene.game.command, Stop);
        scene.robot((Them, 2), 1.6, 1.8);
        scene.step();
        scene.expect_command(DirectFree, Us);
    }
    for mut scene in views_with_placement(B) {
        make_way(&mut scene);
        scene.ball(1.0, 1.8);
        scene.robot((Them, 2), 1.3, 1.8);
        scene.stop(DirectFree, Us, (1.0, 2.0));
        scene.wait(11.95);
        assert_eq!(scene.game.command, Stop);
        scene.step();
        scene.step();
        scene.expect_command(DirectFree, Us);
        scene.step();
        scene.only(DefenderTooCloseToKickPoint);
    }
}

#[test]
fn the_referee_places_the_ball_for_a_kick_off() {
    for mut scene in views_with_placement(B) {
        scene.ball(1.0, -2.0);
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.wait(2.0);
        scene.expect_command(PrepareKickoff, Us);
        expect_near(scene.ball_at(), (0.0, 0.0));
    }
}

/// Lets the present placement fail.
fn fail(scene: &mut Scene) {
    let before = scene.game.command;
    scene.run(30.1, |scene| scene.game.command != before);
    scene.only(PlacementFailed);
}

#[test]
fn after_thirty_seconds_a_placement_has_failed() {
    for mut scene in place_for_us(B) {
        scene.wait(29.95);
        assert_eq!(scene.events(), []);
        scene.run(0.1, |scene| scene.game.command == Stop);
        let event = scene.only(PlacementFailed);
        assert_eq!((event.side, event.bot), (Some(Us), None));
        assert_eq!(scene.game.placement_failures[scene.team(Us)], 1);
        scene.expect_fouls(0, 0);
    }
}

#[test]
fn a_ball_that_is_placed_in_the_last_step_is_placed() {
    for mut scene in place_for_us(B) {
        scene.run(30.0, |scene| scene.game.command_steps == scene.game.wait_steps - 1);
        scene.expect_command(BallPlacement, Us);
        scene.ball(1.0, 2.0);
        scene.step();
        scene.expect_team(PlacementSucceeded, Some(Us), (1.0, 2.0));
        assert_eq!(scene.count_of(PlacementFailed), 0);
        scene.expect_command(DirectFree, Us);
    }
}

#[test]
fn in_division_a_the_free_kick_passes_and_in_b_it_stays() {
    for (division, kicking) in [(A, Them), (B, Us)] {
        for mut scene in place_for_us(division) {
            fail(&mut scene);
            scene.expect_next(DirectFree, kicking, (1.0, 2.0));
            scene.wait(2.0);
            scene.expect_command(BallPlacement, Them);
            assert_eq!(scene.game.next_command, Some(DirectFree(scene.team(kicking))));
            scene.ball(1.0, 2.0);
            scene.run(2.1, |scene| !matches!(scene.game.command, BallPlacement(_)));
            scene.expect_command(DirectFree, kicking);
        }
    }
}

#[test]
fn after_both_have_failed_the_referee_places_the_ball_for_the_team_in_favor() {
    for division in [A, B] {
        for mut scene in place_for_us(division) {
            fail(&mut scene);
            scene.wait(2.0);
            fail(&mut scene);
            scene.expect_command(DirectFree, Us);
            expect_near(scene.ball_at(), (1.0, 2.0));
            assert_eq!(scene.game.placement_failures, rsim_referee::column::ByTeam::new(1, 1));
        }
    }
}

#[test]
fn the_next_stop_begins_with_the_team_in_favor_again() {
    for mut scene in place_for_us(A) {
        fail(&mut scene);
        scene.wait(2.0);
        scene.ball(1.0, 2.0);
        scene.run(2.1, |scene| !matches!(scene.game.command, BallPlacement(_)));
        let next = DirectFree(scene.team(Us));
        place(&mut scene, next);
        scene.expect_command(BallPlacement, Us);
    }
}

#[test]
fn a_success_lowers_the_count_of_failures() {
    for (before, after) in [(3, 2), (0, 0)] {
        for mut scene in place_for_us(B) {
            let team = scene.team(Us);
            scene.game.placement_failures[team] = before;
            scene.ball(1.0, 2.0);
            scene.run(2.1, |scene| scene.game.command == DirectFree(team));
            assert_eq!(scene.game.placement_failures[team], after);
        }
    }
}

#[test]
fn for_a_force_start_the_teams_take_turns() {
    for first in Team::BOTH {
        for mut scene in views_with_placement(B) {
            scene.game.first_kickoff = first;
            let mut placing = Vec::new();
            for _ in 0..4 {
                place(&mut scene, ForceStart);
                placing.push(scene.game.command);
                scene.ball(1.0, 2.0);
                scene.run(2.1, |scene| scene.game.command == ForceStart);
            }
            let other = first.opponent();
            assert_eq!(placing, [first, other, first, other].map(BallPlacement));
        }
        for mut scene in views_with_placement(B) {
            scene.game.first_kickoff = first;
            place(&mut scene, ForceStart);
            fail(&mut scene);
            scene.wait(2.0);
            assert_eq!(scene.game.command, BallPlacement(first.opponent()));
            fail(&mut scene);
            assert_eq!(scene.game.command, ForceStart);
            expect_near(scene.ball_at(), (1.0, 2.0));
        }
    }
}

/// The ball is kicked over a touch line by them, so that we are in favor.
fn throw_in(scene: &mut Scene) {
    scene.ball(1.0, 2.95);
    scene.settle();
    scene.touch((Them, 4));
    scene.step();
    scene.ball(1.0, 3.05);
    scene.step();
    scene.only(BallLeftFieldTouchLine);
}

#[test]
fn after_five_failures_a_team_gets_no_free_kick_for_a_ball_out() {
    for (ours, theirs, kicking, placing) in
        [(4, 0, Us, Some(Us)), (5, 0, Them, Some(Them)), (5, 5, Us, None), (0, 5, Us, Some(Us))]
    {
        for mut scene in views_with_placement(A) {
            let teams = (scene.team(Us), scene.team(Them));
            scene.game.placement_failures[teams.0] = ours;
            scene.game.placement_failures[teams.1] = theirs;
            scene.ball(1.0, 4.45);
            scene.settle();
            scene.touch((Them, 4));
            scene.step();
            scene.ball(1.0, 4.55);
            scene.step();
            scene.expect_next(DirectFree, kicking, (1.0, 4.3));
            scene.wait(2.0);
            if let Some(side) = placing {
                scene.expect_command(BallPlacement, side);
            } else {
                scene.expect_command(DirectFree, kicking);
                expect_near(scene.ball_at(), (1.0, 4.3));
            }
        }
    }
}

#[test]
fn so_it_is_over_goal_lines_and_after_aimless_kicks() {
    // They play the ball over their own goal line, or from their half over ours.
    for (from_x, line_x, kind) in [(-4.0, 4.5, BallLeftFieldGoalLine), (1.0, -4.5, AimlessKick)] {
        for mut scene in views_with_placement(B) {
            let team = scene.team(Us);
            scene.game.placement_failures[team] = 5;
            scene.ball(from_x, 2.0);
            scene.settle();
            scene.touch((Them, 4));
            scene.step();
            scene.ball(line_x * 0.98, 2.0);
            scene.step();
            scene.ball(line_x * 1.02, 2.0);
            scene.step();
            scene.only(kind);
            assert_eq!(scene.game.next_command, Some(DirectFree(scene.team(Them))));
        }
    }
}

#[test]
fn after_five_failures_the_referee_places_the_ball_of_other_free_kicks() {
    for mut scene in views_with_placement(B) {
        let team = scene.team(Us);
        scene.game.placement_failures[team] = 5;
        let next = DirectFree(team);
        place(&mut scene, next);
        scene.expect_command(DirectFree, Us);
        expect_near(scene.ball_at(), (1.0, 2.0));
    }
    for mut scene in views_with_placement(B) {
        for side in Side::BOTH {
            let team = scene.team(side);
            scene.game.placement_failures[team] = 5;
        }
        place(&mut scene, ForceStart);
        assert_eq!(scene.game.command, ForceStart);
    }
    for mut scene in views_with_placement(B) {
        scene.game.placement_failures[Team::Blue] = 5;
        place(&mut scene, ForceStart);
        assert_eq!(scene.game.command, BallPlacement(Team::Yellow));
    }
}

#[test]
fn the_free_kick_does_not_pass_where_balls_are_teleported() {
    for mut scene in crate::scene::views(B) {
        let team = scene.team(Us);
        scene.game.placement_failures[team] = 5;
        throw_in(&mut scene);
        scene.expect_next(DirectFree, Us, (1.0, 2.8));
    }
}

#[test]
fn who_stays_in_the_way_commits_one_foul_and_gives_time_each_time() {
    for mut scene in place_for_us(B) {
        let wait = scene.game.wait_steps;
        scene.robot((Them, 2), 1.0 + 0.58, 0.0); // beside the line from the ball to its place
        assert_eq!(scene.wait(2.0), []);
        scene.step();
        scene.expect_bot(BotInterferedPlacement, (Them, 2), (1.58, 0.0));
        scene.expect_fouls(0, 1);
        assert_eq!(scene.game.wait_steps, wait + scene.steps(10.0));
        scene.wait(2.1);
        scene.only(BotInterferedPlacement);
        scene.expect_fouls(0, 1);
        assert_eq!(scene.game.wait_steps, wait + scene.steps(20.0));
        scene.expect_command(BallPlacement, Us);
    }
}

#[test]
fn who_is_beside_the_way_leaves_it_in_time_or_places_does_not_interfere() {
    for mut scene in place_for_us(B) {
        scene.robot((Them, 2), 1.0 + 0.6, 0.0);
        scene.robot((Them, 3), 1.0, 2.0 + 0.6);
        scene.robot((Us, 2), 1.0, 0.0);
        assert_eq!(scene.wait(3.0), []);
        scene.robot((Them, 2), 1.0, 0.5);
        assert_eq!(scene.wait(1.9), []);
        scene.robot((Them, 2), 2.0, 0.5);
        scene.step();
        scene.robot((Them, 2), 1.0, 0.5);
        assert_eq!(scene.wait(1.9), [], "the time begins anew");
    }
}

#[test]
fn each_placement_counts_its_first_interference() {
    for mut scene in place_for_us(B) {
        for fouls in 1..=2 {
            scene.robot((Them, 2), 1.0, 0.0);
            scene.wait(2.1);
            scene.expect_fouls(0, fouls);
            scene.robot((Them, 2), 3.0, 0.0);
            let next = DirectFree(scene.team(Us));
            place(&mut scene, next);
        }
    }
}

#[test]
fn the_referee_places_the_ball_where_the_others_do_not_stop_to_interfere() {
    for mut scene in place_for_us(A) {
        scene.robot((Them, 2), 1.0, 0.0);
        scene.run(60.0, |scene| !matches!(scene.game.command, BallPlacement(_)));
        assert_eq!(
            (scene.count_of(BotInterferedPlacement), scene.count_of(PlacementFailed)),
            (4, 0)
        );
        scene.expect_command(DirectFree, Us);
        expect_near(scene.ball_at(), (1.0, 2.0));
    }
}
