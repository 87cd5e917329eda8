//! Fouls, cards, and robots that are taken out: "Fouls", "Yellow Card", "Red Card".

use rsim_referee::codes::Command::{DirectFree, ForceStart, PrepareKickoff, Stop};
use rsim_referee::events::EventKind::{
    BotCrashDrawn, BotCrashUnique, MultipleCards, MultipleFouls, TooManyRobots,
};

use crate::scene::{B, Scene, Side, Them, Us, views};

/// Our robot crashes into one of them, so that we commit a foul.
fn foul(scene: &mut Scene) {
    scene.robot_velocity((Us, 4), 2.0, 0.0);
    scene.settle();
    scene.collide((Us, 4), (Them, 4), 2.0);
    scene.robot_velocity((Us, 4), 0.0, 0.0);
    scene.step();
    assert_eq!(scene.count_of(BotCrashUnique), 1);
}

/// We get a yellow card.
fn card(scene: &mut Scene) {
    for _ in 0..3 {
        scene.ball(scene.ball_at().0 + 0.2, 0.0); // there is progress
        scene.wait(0.2);
        foul(scene);
    }
}

fn yellow_cards(scene: &Scene) -> [i32; 2] {
    scene.game.yellow_steps_left[scene.team(Us)]
}

#[test]
fn every_third_foul_is_a_yellow_card() {
    for mut scene in views(B) {
        let team = scene.team(Us);
        for nth in 1..=7 {
            scene.wait(0.2);
            foul(&mut scene);
            assert_eq!(scene.count_of(MultipleFouls), usize::from(nth % 3 == 0), "{nth}");
            assert_eq!(scene.game.yellow_cards[team], nth / 3);
            assert!(scene.game.is_running(), "play goes on");
            if nth == 3 {
                let event = scene.only(MultipleFouls);
                assert_eq!((event.side, event.bot), (Some(Us), None));
            }
        }
        assert_eq!(scene.game.yellow_cards[scene.team(Them)], 0);
        assert_eq!(scene.count_of(MultipleCards), 0);
    }
}

#[test]
fn a_foul_of_both_teams_counts_for_both() {
    for mut scene in views(B) {
        for side in Side::BOTH {
            let team = scene.team(side);
            scene.game.fouls[team] = 2;
        }
        scene.collide((Us, 4), (Them, 4), 2.0);
        scene.step();
        scene.only(BotCrashDrawn);
        let cards = scene.events().iter().filter(|event| event.kind == MultipleFouls);
        let mut sides: Vec<_> = cards.filter_map(|event| event.side).collect();
        sides.dedup();
        assert_eq!(sides.len(), 2, "one for each team");
        assert!(Side::BOTH.iter().all(|side| scene.game.yellow_cards[scene.team(*side)] == 1));
    }
}

#[test]
fn no_cards_are_given_where_no_number_of_fouls_makes_one() {
    for mut scene in crate::scene::views_with(B, |config| config.fouls_per_card = 0.0) {
        card(&mut scene);
        assert_eq!((scene.fouls(Us), scene.count_of(MultipleFouls)), (3, 0));
    }
}

#[test]
fn the_third_yellow_card_at_once_is_red_instead() {
    for mut scene in views(B) {
        let team = scene.team(Us);
        for _ in 0..2 {
            card(&mut scene);
            let cards = usize::try_from(scene.game.yellow_cards[team]).expect("few");
            scene.take_out((Us, cards));
        }
        assert!(yellow_cards(&scene).iter().all(|steps| *steps > 4000));
        card(&mut scene);
        assert_eq!(scene.only(MultipleCards).side, Some(Us));
        assert_eq!((scene.game.yellow_cards[team], scene.game.red_cards[team]), (2, 1));
    }
}

#[test]
fn a_yellow_card_runs_for_playing_time_alone() {
    for mut scene in views(B) {
        card(&mut scene);
        assert_eq!(yellow_cards(&scene), [scene.steps(120.0) - 1, 0], "the present step counts");
        scene.step();
        assert_eq!(yellow_cards(&scene)[0], scene.steps(120.0) - 2);
        scene.stop(DirectFree, Them, (0.0, 0.0));
        scene.wait(1.0);
        assert_eq!(yellow_cards(&scene)[0], scene.steps(120.0) - 2, "a stop");
        scene.wait(1.0);
        scene.expect_command(DirectFree, Them);
        scene.step();
        assert_eq!(yellow_cards(&scene)[0], scene.steps(120.0) - 3, "a free kick");
    }
}

#[test]
fn a_robot_is_taken_out_at_the_next_stop() {
    for mut scene in views(B) {
        card(&mut scene);
        assert_eq!(scene.count(Us), 6);
        scene.ball(1.0, 2.9);
        scene.settle();
        scene.ball(1.0, 3.1);
        scene.step();
        assert_eq!(scene.game.command, Stop);
        assert_eq!((scene.count(Us), scene.count(Them)), (5, 6));
        assert_eq!(scene.count_of(TooManyRobots), 0);
        scene.wait(30.0);
        assert_eq!(scene.count_of(TooManyRobots), 0);
    }
}

#[test]
fn the_farthest_robot_from_the_ball_is_taken_out_and_the_keeper_last() {
    for mut scene in views(B) {
        let team = scene.team(Us);
        scene.game.yellow_steps_left[team] = [4000, 4000];
        scene.ball(1.0, 2.9);
        scene.robot((Us, 1), -3.0, -2.0);
        scene.robot((Us, 4), -3.0, -2.3);
        scene.settle();
        scene.ball(1.0, 3.1);
        scene.step();
        let present: Vec<usize> = (0..6).filter(|n| scene.robot_at((Us, *n)).is_some()).collect();
        assert_eq!(present, [0, 2, 3, 5]);
    }
    for mut scene in views(B) {
        let team = scene.team(Us);
        scene.game.red_cards[team] = 5;
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.wait(2.1);
        let present: Vec<usize> = (0..6).filter(|n| scene.robot_at((Us, *n)).is_some()).collect();
        assert_eq!(present, [0]);
    }
}

#[test]
fn play_stops_where_no_robot_is_taken_out_in_time() {
    for mut scene in views(B) {
        card(&mut scene);
        for _ in 0..399 {
            scene.ball(-scene.ball_at().0, 0.0);
            scene.step();
            scene.expect_play();
        }
        scene.ball(1.0, 1.0);
        scene.step();
        scene.expect_team(TooManyRobots, Some(Us), (1.0, 1.0));
        scene.expect_next_for(ForceStart, (1.0, 1.0));
        assert_eq!(scene.count(Us), 5);
        scene.expect_fouls(3, 0);
    }
}

#[test]
fn a_team_that_takes_a_robot_out_itself_is_not_stopped() {
    for mut scene in views(B) {
        card(&mut scene);
        scene.wait(5.0);
        let outside = scene.referee.layout().clone();
        assert_eq!(outside.robots(), 12);
        scene.take_out((Us, 3));
        scene.wait(3.0);
        // The referee knows only robots that it took out itself: an absent robot is none of the team's.
        assert_eq!(scene.count(Us), 5);
    }
}

#[test]
fn a_kick_that_was_not_taken_is_repeated_after_the_removal() {
    for mut scene in views(B) {
        card(&mut scene);
        scene.ball(1.0, 1.0);
        scene.free_kick(Them);
        let team = scene.team(Us);
        scene.game.removal_steps_left[team] = 2;
        scene.wait(0.05);
        scene.only(TooManyRobots);
        scene.expect_next(DirectFree, Them, (1.0, 1.0));
    }
    for mut scene in views(B) {
        card(&mut scene);
        scene.kickoff(Them);
        let team = scene.team(Us);
        scene.game.removal_steps_left[team] = 2;
        scene.wait(0.05);
        scene.expect_next(PrepareKickoff, Them, (0.0, 0.0));
    }
}

#[test]
fn a_robot_comes_back_at_the_next_stop_after_the_card() {
    for mut scene in views(B) {
        card(&mut scene);
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.wait(2.1);
        assert_eq!(scene.count(Us), 5);
        scene.free();
        let team = scene.team(Us);
        scene.game.yellow_steps_left[team] = [2, 0];
        scene.step();
        assert_eq!(scene.game.max_robots(team, 6), 5);
        scene.step();
        assert_eq!((scene.game.max_robots(team, 6), scene.count(Us)), (6, 5), "not in play");
        scene.stop(DirectFree, Them, (2.0, 1.0));
        scene.wait(2.1);
        assert_eq!(scene.count(Us), 6);
        assert_eq!(scene.game.removed_robots, 0);
        let entered = (0..6)
            .filter_map(|n| scene.robot_at((Us, n)))
            .any(|(x, y)| x.abs() < 0.2 && y.abs() > 2.8);
        assert!(entered, "at the halfway line");
    }
}

#[test]
fn red_cards_stay() {
    for mut scene in views(B) {
        let team = scene.team(Us);
        scene.game.red_cards[team] = 1;
        scene.stop(DirectFree, Them, (2.0, 1.0));
        scene.wait(2.1);
        assert_eq!(scene.count(Us), 5);
        scene.free();
        scene.wait(5.0);
        scene.stop(DirectFree, Them, (2.0, 1.0));
        scene.wait(2.1);
        assert_eq!(scene.count(Us), 5);
    }
}
