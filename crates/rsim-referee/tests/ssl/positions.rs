//! Place where a teleport puts ball and robots.

use rsim_referee::Team;
use rsim_referee::codes::Command::{self, DirectFree, PrepareKickoff, PreparePenalty};

use crate::scene::{A, B, Bot, Division, Scene, Side, Them, Us, expect_near, views};

fn at(scene: &Scene, bot: Bot) -> (f32, f32) {
    scene.robot_at(bot).expect("present")
}

/// The state after the stop before a command, or the command itself.
fn arranged(
    division: Division,
    next: fn(Team) -> Command,
    place: (f32, f32),
    bodies: impl Fn(&mut Scene),
) -> Vec<Scene> {
    views(division)
        .map(|mut scene| {
            bodies(&mut scene);
            scene.stop(next, Us, place);
            scene.wait(2.0);
            scene
        })
        .collect()
}

#[test]
fn robots_in_valid_places_stay() {
    let bodies = |scene: &mut Scene| {
        scene.robot((Us, 1), 1.0 - 0.09 - 0.0215 - 0.06, 1.0);
        scene.robot((Them, 1), 1.0, 1.595);
    };
    for scene in arranged(B, DirectFree, (1.0, 1.0), bodies) {
        expect_near(at(&scene, (Us, 1)), (1.0 - 0.09 - 0.0215 - 0.06, 1.0));
        expect_near(at(&scene, (Them, 1)), (1.0, 1.595));
        expect_near(scene.ball_at(), (1.0, 1.0));
    }
}

#[test]
fn the_kicking_team_keeps_a_short_distance_from_the_ball() {
    for (gap, stays) in [(0.052, true), (0.049, false)] {
        for mut scene in views(B) {
            scene.ball(0.0, 2.0);
            scene.stop(DirectFree, Us, (0.0, 2.0));
            scene.wait(1.975);
            let x = -0.09 - 0.0215 - gap;
            scene.robot((Us, 1), x, 2.0);
            scene.step();
            scene.expect_command(DirectFree, Us);
            let moved = (at(&scene, (Us, 1)).0 - x).abs();
            assert_eq!(moved < 1e-4, stays, "{gap}");
        }
    }
}

#[test]
fn robots_too_near_go_to_the_nearest_valid_place() {
    let bodies = |scene: &mut Scene| {
        scene.robot((Them, 1), 1.0, 1.4);
        scene.robot((Them, 2), 1.0, 1.2);
        scene.robot((Us, 3), 3.0, 0.0);
        scene.robot((Us, 4), 3.4, 0.0);
    };
    for scene in arranged(B, DirectFree, (1.0, 1.0), bodies) {
        for number in [1, 2] {
            let (x, y) = at(&scene, (Them, number));
            let distance = (x - 1.0).hypot(y - 1.0);
            assert!((0.59..0.85).contains(&distance), "{distance}");
        }
        expect_near(at(&scene, (Us, 3)), (3.0, 0.0));
        let (x, y) = at(&scene, (Us, 4));
        assert!(x <= 3.5 - 0.29 + 1e-4 && (x - 3.4).hypot(y) < 0.25, "{x} {y}");
    }
}

#[test]
fn robots_that_are_moved_stand_still_and_face_the_ball() {
    for mut scene in views(B) {
        scene.robot((Them, 1), 1.0, 1.2);
        scene.robot_velocity((Them, 1), 1.0, 1.0);
        scene.stop(DirectFree, Us, (1.0, 1.0));
        scene.wait(2.0);
        assert!(scene.robots().iter().all(|robot| robot.velocity.length() < 1.01));
        let (x, y) = at(&scene, (Them, 1));
        let moved = scene
            .robots()
            .into_iter()
            .find(|robot| {
                robot.team == scene.team(Them)
                    && robot.position.length() > 0.0
                    && (robot.position.length() - x.hypot(y)).abs() < 1e-4
            })
            .expect("it is there");
        assert!(moved.velocity.length() < 1e-6);
        let ball = scene.sight().ball().position;
        let ahead = ball - moved.position;
        assert!(ahead.dot(moved.heading) > 0.999 * ahead.length());
    }
}

#[test]
fn before_a_kick_off_all_are_in_their_halves_and_one_may_be_in_the_circle() {
    let bodies = |scene: &mut Scene| {
        scene.robot((Us, 1), 0.2, 0.2);
        scene.robot((Us, 2), 0.0, -0.3);
        scene.robot((Us, 3), 2.0, 1.0);
        scene.robot((Them, 1), -0.2, 0.3);
        scene.robot((Them, 2), -3.0, 0.0);
    };
    for scene in arranged(B, PrepareKickoff, (0.0, 0.0), bodies) {
        for side in Side::BOTH {
            for number in 0..6 {
                let (x, y) = at(&scene, (side, number));
                let own = if side == Us { -x } else { x };
                let in_circle = x.hypot(y) + 0.09 <= 0.5 + 1e-4;
                let is_outside = x.hypot(y) - 0.09 >= 0.5 - 1e-4;
                assert!(own >= 0.09 - 1e-4 && is_outside || side == Us && in_circle);
            }
        }
    }
}

#[test]
fn the_kicker_of_a_kick_off_may_be_anywhere_in_the_circle() {
    for mut scene in views(B) {
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.run(3.0, |scene| scene.game.command == PrepareKickoff(scene.team(Us)));
        scene.robot((Us, 1), 0.3, 0.0);
        scene.run(2.1, |scene| scene.game.command == Command::NormalStart);
        expect_near(at(&scene, (Us, 1)), (0.3, 0.0));
    }
    for mut scene in views(B) {
        scene.stop(PrepareKickoff, Us, (0.0, 0.0));
        scene.run(3.0, |scene| scene.game.command == PrepareKickoff(scene.team(Us)));
        scene.robot((Us, 1), 0.45, 0.0); // partly outside
        scene.wait(3.0);
        scene.expect_command(PrepareKickoff, Us);
    }
}

#[test]
fn a_robot_without_a_place_nearby_finds_one_behind_the_others() {
    let bodies = |scene: &mut Scene| {
        for number in 1..6_u8 {
            scene.robot((Them, usize::from(number)), 1.0, 1.0 + 0.1 * f32::from(number));
        }
    };
    for scene in arranged(B, DirectFree, (1.0, 1.0), bodies) {
        let robots = scene.robots();
        for (nth, robot) in robots.iter().enumerate() {
            for other in &robots[nth + 1..] {
                assert!(robot.position.distance(other.position) >= 0.18);
            }
        }
    }
}

#[test]
fn before_a_penalty_kick_the_keepers_line_and_the_room_behind_the_ball_hold_all() {
    for division in [A, B] {
        let bodies = |scene: &mut Scene| {
            for number in 0..scene.size() {
                let y = 0.2 * f32::from(u8::try_from(number).expect("few"));
                scene.robot((Us, number), 1.0, -y);
                scene.robot((Them, number), 2.0, y);
            }
        };
        let mark = if division == A { -2.0 } else { -1.5 };
        for mut scene in arranged(division, PreparePenalty, (mark, 0.0), bodies) {
            scene.run(11.0, |scene| scene.game.penalty_taker().is_some());
            assert!(scene.game.command_steps == 0);
            let kickers = (0..scene.size()).filter(|n| at(&scene, (Us, *n)).0 > mark - 1.09 + 1e-4);
            assert!(kickers.count() <= 1);
        }
    }
}

#[test]
fn before_a_penalty_kick_the_keeper_is_put_straight_back_on_its_line() {
    for aside in [0.0, 0.2, -0.3] {
        let bodies = |scene: &mut Scene| scene.robot((Them, 0), 3.7, aside);
        for scene in arranged(B, PreparePenalty, (-1.5, 0.0), bodies) {
            expect_near(at(&scene, (Them, 0)), (4.5, aside));
        }
    }
    for aside in [0.9, -0.9] {
        let bodies = |scene: &mut Scene| scene.robot((Them, 0), 3.7, aside);
        for scene in arranged(B, PreparePenalty, (-1.5, 0.0), bodies) {
            let (x, y) = at(&scene, (Them, 0));
            let from_post = (x - 4.5).hypot(y - 0.41_f32.copysign(aside));
            assert!(from_post < 0.1, "at the post on its side: {x} {y}");
        }
    }
}

#[test]
fn a_ball_that_rests_at_its_place_stays_and_others_are_put_there() {
    for (x, height, speed, is_put) in [
        (0.005, 0.0, 0.0, false),
        (0.02, 0.0, 0.0, true),
        (0.0, 0.1, 0.0, true),
        (0.0, 0.0, 0.5, true),
    ] {
        for mut scene in views(B) {
            scene.ball(x, -2.5);
            scene.ball_height(height);
            scene.ball_velocity(speed, 0.0, 0.0);
            scene.stop(DirectFree, Us, (0.0, -2.5));
            scene.game.wait_steps = 1;
            scene.step();
            assert_eq!(scene.restarted, is_put, "{x} {height} {speed}");
            let ball = scene.sight().ball();
            assert!(ball.speed() == 0.0 && ball.height == 0.0);
            expect_near(scene.ball_at(), (if is_put { 0.0 } else { x }, -2.5));
        }
    }
}

/// Two of our robots were taken out, and their cards are over. Guards stand where they enter.
fn bring_back(scene: &mut Scene, guards: &[f32]) -> Vec<(f32, f32)> {
    let team = scene.team(Us);
    scene.game.yellow_steps_left[team] = [1000, 1000];
    scene.stop(DirectFree, Us, (2.0, -1.0));
    scene.run(2.1, |scene| scene.count(Us) == 4);
    scene.game.yellow_steps_left[team] = [0, 0];
    for (number, x) in guards.iter().enumerate() {
        for y in [2.95, -2.95] {
            let side = if y > 0.0 { Us } else { Them };
            scene.robot((side, number + 1), *x, y);
        }
    }
    let present: Vec<bool> = (0..6).map(|n| scene.robot_at((Us, n)).is_some()).collect();
    scene.stop(DirectFree, Us, (2.0, -1.0));
    scene.wait(2.0);
    assert_eq!(scene.count(Us), 6);
    (0..6).filter(|n| !present[*n]).map(|n| at(scene, (Us, n))).collect()
}

#[test]
fn robots_come_back_beside_each_other_and_beside_those_who_are_there() {
    for guards in [&[][..], &[0.0]] {
        for mut scene in views(B) {
            // Those that are farthest from the ball are taken out, so that the guards stay.
            for number in 1..6_u8 {
                let x = if number < 4 { 2.0 } else { -3.0 };
                scene.robot((Us, usize::from(number)), x, 0.4 * f32::from(number) - 2.0);
            }
            let entered = bring_back(&mut scene, guards);
            for (x, y) in &entered {
                assert!(x.abs() < 0.5 && y.abs() > 2.4, "{entered:?}");
            }
            let robots = scene.robots();
            for (nth, robot) in robots.iter().enumerate() {
                for other in &robots[nth + 1..] {
                    assert!(robot.position.distance(other.position) >= 0.18);
                }
            }
        }
    }
}
