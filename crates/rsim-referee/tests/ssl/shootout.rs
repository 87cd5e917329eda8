//! "Shoot-Out": alternating penalty kicks.

use rsim_referee::Team;
use rsim_referee::codes::Command::{Halt, PreparePenalty};
use rsim_referee::codes::Stage;
use rsim_referee::events::EventKind::{AttackerTooCloseToDefenseArea, Goal, PenaltyKickFailed};

use crate::scene::{B, Scene, Side, Them, Us, views, views_with};

/// A shoot-out begins, with a first kick of ours.
fn begin(scene: &mut Scene) {
    scene.game.first_kickoff = scene.team(Us);
    scene.game.stage = Stage::ExtraSecondHalf;
    scene.game.stage_steps_left = 0;
    scene.ball(1.0, 2.9);
    scene.settle();
    scene.ball(1.0, 3.1);
    scene.step();
    assert_eq!(scene.game.stage, Stage::Shootout);
}

/// The team whose penalty kick is allowed next, or is over.
fn kick(scene: &mut Scene, is_goal: bool) -> Side {
    scene.run(20.0, |scene| scene.game.penalty_taker().is_some());
    let side = if scene.game.penalty_taker() == Some(scene.team(Us)) { Us } else { Them };
    let ahead = if side == Us { 1.0 } else { -1.0 };
    scene.kick((side, 1), -ahead, 0.2);
    scene.ball(ahead * 4.4, if is_goal { 0.2 } else { 1.0 });
    scene.step();
    scene.ball(ahead * 4.6, if is_goal { 0.2 } else { 1.0 });
    scene.step();
    scene.only(if is_goal { Goal } else { PenaltyKickFailed });
    side
}

fn play(scene: &mut Scene, goals: &[bool]) {
    begin(scene);
    let mut side = Us;
    for (nth, is_goal) in goals.iter().enumerate() {
        assert_eq!(scene.game.stage, Stage::Shootout, "before kick {nth}");
        assert_eq!(kick(scene, *is_goal), side, "kick {nth}");
        side = side.opponent();
    }
}

#[test]
fn the_teams_take_turns_from_their_marks() {
    for mut scene in views(B) {
        begin(&mut scene);
        scene.expect_next(PreparePenalty, Us, (-1.5, 0.0));
        kick(&mut scene, true);
        scene.expect_next(PreparePenalty, Them, (1.5, 0.0));
        kick(&mut scene, false);
        scene.expect_next(PreparePenalty, Us, (-1.5, 0.0));
        assert_eq!(scene.score(), (1, 0));
        let kicks = Team::BOTH.map(|team| scene.game.shootout_kicks[team]);
        assert_eq!(kicks, [1, 1]);
    }
}

#[test]
fn each_team_has_its_five_kicks() {
    for mut scene in views(B) {
        play(&mut scene, &[true, false, true, false, true, false, false, false, false]);
        assert_eq!(scene.game.stage, Stage::Shootout, "they have lost, and have their kick");
        kick(&mut scene, true);
        assert_eq!((scene.game.stage, scene.score()), (Stage::PostGame, (3, 1)));
    }
    for mut scene in views(B) {
        play(&mut scene, &[true, true, true, true, true, true, true, true, false]);
        assert_eq!(scene.game.stage, Stage::Shootout, "they may still win");
        kick(&mut scene, true);
        assert_eq!((scene.game.stage, scene.score()), (Stage::PostGame, (4, 5)));
    }
}

#[test]
fn a_shoot_out_that_decides_nothing_ends_with_a_draw() {
    for is_goal in [false, true] {
        for mut scene in views(B) {
            play(&mut scene, &[is_goal; 19]);
            assert_eq!(scene.game.stage, Stage::Shootout, "their tenth kick may decide it");
            kick(&mut scene, is_goal);
            let goals = if is_goal { 10 } else { 0 };
            assert_eq!((scene.game.stage, scene.score()), (Stage::PostGame, (goals, goals)));
            assert_eq!(scene.game.command, Halt);
        }
    }
    for mut scene in views_with(B, |rules| rules.max_shootout_kicks = 2.0) {
        play(&mut scene, &[false, false, true, false]);
        assert_eq!((scene.game.stage, scene.score()), (Stage::PostGame, (1, 0)));
    }
}

#[test]
fn a_shoot_out_in_which_nobody_moves_ends() {
    for mut scene in views(B) {
        begin(&mut scene);
        let events = scene.run(20.0 * 25.0, |scene| scene.game.stage == Stage::PostGame);
        let failed = events.iter().filter(|event| event.kind == PenaltyKickFailed).count();
        assert_eq!((failed, scene.score()), (20, (0, 0)));
    }
}

#[test]
fn after_five_each_a_pair_of_kicks_decides() {
    for mut scene in views(B) {
        let mut goals = vec![true; 12];
        goals.push(true);
        play(&mut scene, &goals);
        assert_eq!(scene.game.stage, Stage::Shootout, "they have their kick");
        kick(&mut scene, false);
        assert_eq!((scene.game.stage, scene.score()), (Stage::PostGame, (7, 6)));
    }
}

#[test]
fn many_goals_do_not_end_it_early() {
    for mut scene in views(B) {
        for side in Side::BOTH {
            let team = scene.team(side);
            scene.game.score[team] = 11;
        }
        play(&mut scene, &[true, false, true]);
        assert_eq!((scene.game.stage, scene.score()), (Stage::Shootout, (13, 11)));
    }
}

#[test]
fn an_offense_in_a_stop_does_not_change_whose_kick_it_is() {
    for mut scene in views(B) {
        begin(&mut scene);
        scene.game.wait_steps = scene.steps(10.0);
        scene.robot((Us, 3), 3.3, 0.0);
        scene.wait(2.1);
        scene.only(AttackerTooCloseToDefenseArea);
        scene.expect_next(PreparePenalty, Us, (-1.5, 0.0));
        assert_eq!(scene.game.shootout_kicks[scene.team(Us)], 0);
    }
}

#[test]
fn outside_a_shoot_out_penalty_kicks_are_not_counted() {
    for mut scene in views(B) {
        scene.penalty(Us);
        kick(&mut scene, true);
        assert_eq!(scene.game.shootout_kicks[scene.team(Us)], 0);
        assert_eq!(scene.game.stage, Stage::FirstHalf);
    }
}
