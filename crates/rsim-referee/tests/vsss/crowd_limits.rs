//! Crowds of both teams, in the larger area, and under other rules.

use rsim_referee::Team;
use rsim_referee::events::EventKind::{AttackerTouchedBallInDefenseArea, DefenderInDefenseArea};

use crate::crowds::{attack, defend, each};
use crate::pitches::Size;
use crate::scene::{Scene, seen_by, steps};

#[test]
fn where_both_teams_are_too_many_there_is_one_foul() {
    for size in Size::BOTH {
        for attacker in Team::BOTH {
            let both = |scene: &mut Scene| {
                attack(scene, attacker, 2);
                defend(scene, attacker.opponent(), 2);
            };
            let mut scene = Scene::in_play(size);
            both(&mut scene);
            let (nth, event) = scene.first_event(4.0).expect("a foul");
            assert_eq!((nth, event.kind), (steps(3.0), AttackerTouchedBallInDefenseArea));
            assert_eq!(scene.run(3.0), [], "nor another one in the stop");

            let mut scene = Scene::in_play(size);
            defend(&mut scene, attacker.opponent(), 2);
            scene.run(1.0);
            both(&mut scene);
            let (nth, event) = scene.first_event(4.0).expect("a foul");
            assert_eq!((nth, event.kind), (steps(2.0), DefenderInDefenseArea), "it began first");

            let mut scene = Scene::in_play(size);
            both(&mut scene);
            scene.run(1.0);
            scene.roll([0.0, 0.0], [1.0, 0.0]);
            let event = scene.step_to(DefenderInDefenseArea);
            assert_eq!(
                event.team,
                Some(attacker.opponent()),
                "the defenders' when the ball leaves"
            );
        }
    }
}

/// Puts robots of a team, and the ball, in the larger area that `attacker` attacks, outside the smaller one.
fn fill_large_area(scene: &mut Scene, team: Team, attacker: Team, robots: u8) {
    for nth in 0..robots {
        let place = [0.8, -0.3 + 0.1 * f32::from(nth)];
        scene.robot(team, usize::from(nth), seen_by(attacker, place));
    }
    scene.roll(seen_by(attacker, [0.9, 0.39]), [1.0, 0.0]);
}

#[test]
fn at_five_a_side_four_attackers_or_five_defenders_in_the_larger_area_are_a_foul() {
    for attacker in Team::BOTH {
        for (team, most, kind) in [
            (attacker, 4, AttackerTouchedBallInDefenseArea),
            (attacker.opponent(), 5, DefenderInDefenseArea),
        ] {
            let mut scene = Scene::in_play(Size::Five);
            fill_large_area(&mut scene, team, attacker, most);
            let (nth, event) = scene.first_event(4.0).expect("a foul");
            assert_eq!((nth, event.kind, event.team), (steps(3.0), kind, Some(team)));

            let mut scene = Scene::in_play(Size::Five);
            fill_large_area(&mut scene, team, attacker, most - 1);
            assert_eq!(scene.run(4.0), [], "one less is allowed");

            let mut scene = Scene::in_play(Size::Five);
            fill_large_area(&mut scene, team, attacker, most);
            scene.robot(team, 0, seen_by(attacker, [0.8, 0.4]));
            assert_eq!(scene.run(4.0), [], "one is on the line");

            let mut scene = Scene::in_play(Size::Five);
            fill_large_area(&mut scene, team, attacker, most);
            scene.roll(seen_by(attacker, [0.749, 0.0]), [1.0, 0.0]);
            assert_eq!(scene.run(4.0), [], "the ball is outside");
        }
    }
}

#[test]
fn numbers_of_the_larger_area_are_switched_off_by_0() {
    let mut config = Size::Five.config();
    config.large_area_attackers = 0.0;
    config.large_area_defenders = 0.0;
    for (team, robots) in [(Team::Blue, 4), (Team::Yellow, 5)] {
        let mut scene = Scene::in_play_with(Size::Five, config.clone());
        fill_large_area(&mut scene, team, Team::Blue, robots);
        assert_eq!(scene.run(4.0), []);
    }
}

#[test]
fn three_robots_are_a_foul_where_three_are_too_many() {
    each(|size, attacker, (crowd, kind, _)| {
        let mut config = size.config();
        (config.area_robots, config.held_ball_seconds) = (3.0, 1.0);
        let mut scene = Scene::in_play_with(size, config);
        crowd(&mut scene, attacker, 2);
        assert_eq!(scene.run(4.0), []);
        crowd(&mut scene, attacker, 3);
        let (nth, event) = scene.first_event(4.0).expect("a foul");
        assert_eq!((nth, event.kind), (steps(1.0), kind));
    });
}

#[test]
fn a_time_of_0_gives_the_foul_at_once_but_only_to_a_crowd() {
    each(|size, attacker, (crowd, kind, _)| {
        let mut config = size.config();
        config.held_ball_seconds = 0.0;
        let mut scene = Scene::in_play_with(size, config);
        assert_eq!(scene.run(1.0), []);
        crowd(&mut scene, attacker, 2);
        scene.step_to(kind);
    });
}

#[test]
fn absent_robots_do_not_count() {
    each(|size, attacker, (crowd, _, _)| {
        let mut scene = Scene::in_play(size);
        crowd(&mut scene, attacker, 2);
        for team in Team::BOTH {
            scene.set(team, size.robots() - 1, "absent", 1.0);
        }
        assert_eq!(scene.run(4.0), []);
    });
}

#[test]
fn rules_that_are_off_judge_no_crowds() {
    each(|size, attacker, (crowd, _, _)| {
        let mut config = size.config();
        config.off = ["ATTACKER_TOUCHED_BALL_IN_DEFENSE_AREA", "DEFENDER_IN_DEFENSE_AREA"]
            .map(str::to_owned)
            .to_vec();
        let mut scene = Scene::in_play_with(size, config);
        crowd(&mut scene, attacker, 2);
        assert_eq!(scene.run(4.0), []);
    });
}
