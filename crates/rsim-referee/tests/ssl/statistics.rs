//! Statistics of a match: time in play, possession, ways, shots and offenses.

use rsim_referee::codes::Command::DirectFree;
use rsim_referee::events::EventKind;
use rsim_referee::ruling::Ruling;
use rsim_referee::statistics::{OFFENSES, count_offense, offense_columns};
use rsim_referee::{Team, Vector};

use crate::scene::{B, Bot, Scene, Side, Them, Us, views};

/// Steps in which each side touched the ball last.
fn possession(scene: &Scene) -> [i32; 2] {
    Side::BOTH.map(|side| scene.statistics.possession_steps[scene.team(side)])
}

fn shots(scene: &Scene) -> [i32; 2] {
    Side::BOTH.map(|side| scene.statistics.shots[scene.team(side)])
}

#[track_caller]
fn expect_ways(scene: &Scene, us: f32, them: f32) {
    for (side, expected) in [(Us, us), (Them, them)] {
        let got = scene.statistics.distance[scene.team(side)];
        assert!((got - expected).abs() < 1e-5, "{side:?}: expected {expected}, got {got}");
    }
}

#[test]
fn time_in_play_counts_and_who_touched_the_ball_last_possesses_it() {
    for mut scene in views(B) {
        scene.step();
        assert_eq!((scene.statistics.in_play_steps, possession(&scene)), (1, [0, 0]));
        scene.touch((Us, 1));
        scene.step();
        scene.step();
        scene.step();
        assert_eq!((scene.statistics.in_play_steps, possession(&scene)), (4, [3, 0]));
        scene.touch((Them, 2));
        scene.step();
        assert_eq!((scene.statistics.in_play_steps, possession(&scene)), (5, [3, 1]));
        scene.stop(DirectFree, Us, (0.0, 0.0));
        scene.step();
        scene.step();
        assert_eq!((scene.statistics.in_play_steps, possession(&scene)), (5, [3, 1]));
    }
}

#[test]
fn ways_of_robots_count_for_their_team_in_stops_too() {
    for mut scene in views(B) {
        scene.robot_velocity((Us, 1), 0.9, 1.2);
        scene.robot_velocity((Us, 3), 0.0, -0.5);
        scene.robot_velocity((Them, 2), -0.6, 0.8);
        scene.step();
        expect_ways(&scene, 2.0 * 0.025, 1.0 * 0.025);
        scene.step();
        expect_ways(&scene, 4.0 * 0.025, 2.0 * 0.025);
        scene.take_out((Us, 1));
        scene.game.in_play = false;
        scene.step();
        expect_ways(&scene, 4.5 * 0.025, 3.0 * 0.025);
    }
}

/// The ball leaves a robot at a place, with a velocity.
fn leave(scene: &mut Scene, bot: Bot, place: (f32, f32), velocity: (f32, f32)) {
    scene.free();
    scene.game.last_touch = Some(scene.index(bot));
    scene.ball(place.0 - 0.01 * place.0.signum(), place.1);
    scene.settle();
    scene.touched_before(bot);
    scene.ball(place.0, place.1);
    scene.ball_velocity(velocity.0, velocity.1, 0.0);
    scene.step();
}

#[test]
fn a_ball_that_leaves_a_robot_toward_the_goal_is_a_shot() {
    // A shot is faster than 0.603 m/s along the field, toward |y| < 0.5 m at x = 4.5 m.
    for (place, velocity, expected) in [
        ((1.0, 0.0), (1.0, 0.0), 1),
        ((1.0, 0.0), (0.595, 0.0), 0),
        ((1.0, 0.0), (0.067 * 2.0 * 4.5, 0.0), 0),
        ((1.0, 0.0), (0.61, 0.0), 1),
        ((1.0, 0.0), (-1.0, 0.0), 0),
        ((1.0, 0.0), (1.0, 0.2), 0),
        ((1.0, 0.0), (1.0, 0.13), 1),
        ((1.0, -2.0), (3.5, 2.3), 1),
        ((1.0, -2.0), (3.5, 1.4), 0),
        ((-3.0, 2.0), (5.0, -1.25), 1),
        ((-3.0, 2.0), (5.0, -2.0), 0),
        ((4.505, 2.0), (5.0, 2000.0), 0), // from behind the line it came from the goal's direction
    ] {
        for mut scene in views(B) {
            leave(&mut scene, (Us, 1), place, velocity);
            assert_eq!(shots(&scene), [expected, 0], "{place:?} {velocity:?}");
            leave(&mut scene, (Them, 1), (-place.0, place.1), (-velocity.0, velocity.1));
            assert_eq!(shots(&scene), [expected, expected], "{place:?} {velocity:?}");
        }
    }
}

#[test]
fn a_ball_that_does_not_leave_a_robot_is_no_shot() {
    for mut scene in views(B) {
        let roll = |scene: &mut Scene| {
            scene.ball(1.0, 0.0);
            scene.ball_velocity(2.0, 0.0, 0.0);
        };
        scene.game.last_touch = Some(scene.index((Us, 1)));
        roll(&mut scene);
        scene.step();
        assert_eq!(shots(&scene), [0, 0], "nobody touched it before");
        scene.touched_before((Us, 1));
        scene.touch((Us, 1));
        roll(&mut scene);
        scene.step();
        assert_eq!(shots(&scene), [0, 0], "it is still touched");
        scene.touched_before((Us, 1));
        scene.touch((Them, 1));
        scene.touch((Us, 1));
        roll(&mut scene);
        scene.step();
        assert_eq!(shots(&scene), [0, 0], "another robot touches it");
        scene.touched_before((Us, 1));
        scene.game.in_play = false;
        roll(&mut scene);
        scene.step();
        assert_eq!(shots(&scene), [0, 0], "it is not in play");
    }
}

#[test]
fn offenses_count_for_the_team_at_fault_or_for_both() {
    let mut row = vec![0.0; offense_columns().len()];
    let place = Vector::default();
    let counted = |row: &[f32]| -> Vec<String> {
        let columns = offense_columns().into_iter().zip(row);
        columns.filter(|(_, count)| **count > 0.0).map(|(name, n)| format!("{name}: {n}")).collect()
    };
    let nth = |kind| OFFENSES.iter().position(|other| *other == kind).expect("an offense");
    count_offense(&mut row, &Ruling::of_team(EventKind::Goal, Some(Team::Blue), place));
    assert_eq!(counted(&row), [""; 0]);
    let push = Ruling::of_robot(EventKind::BotPushedBot, Team::Yellow, 7, place);
    count_offense(&mut row, &push);
    count_offense(&mut row, &push);
    count_offense(&mut row, &Ruling::of_team(EventKind::BotCrashDrawn, None, place));
    let (crash, pushed) = (nth(EventKind::BotCrashDrawn), nth(EventKind::BotPushedBot));
    assert_eq!((crash, pushed), (7, 9));
    let expected =
        ["offenses_blue_7: 1", "offenses_yellow_7: 1", "offenses_yellow_9: 2"].map(str::to_owned);
    assert_eq!(counted(&row), expected);
}

#[test]
fn columns_of_offenses_are_those_of_blue_and_then_of_yellow() {
    let columns = offense_columns();
    assert_eq!(columns.len(), 2 * OFFENSES.len());
    assert_eq!(
        [&columns[0], &columns[14], &columns[15]],
        ["offenses_blue_0", "offenses_blue_14", "offenses_yellow_0"]
    );
}
