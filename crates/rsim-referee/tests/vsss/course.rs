//! From a stop to the next play: times, commands, restarts, and the clock.

use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::Clock;
use rsim_referee::events::EventKind;
use rsim_referee::game::Game;
use rsim_referee::{Team, Vector};

use crate::crowds::{attack, defend};
use crate::pitches::{BALL_RADIUS, Size};
use crate::scene::{Scene, seen_by, steps};

/// Ways to stop play, with the command that follows.
fn stops(size: Size, attacker: Team) -> [(Scene, Command); 4] {
    let scenes = [(); 4].map(|()| Scene::in_play(size));
    let [mut stuck, mut attack_crowd, mut defense_crowd, mut goal] = scenes;
    stuck.ball(seen_by(attacker, [0.2, -0.2]));
    attack(&mut attack_crowd, attacker, 2);
    defend(&mut defense_crowd, attacker.opponent(), 2);
    let behind = goal.referee.pitch().lines.half_length + BALL_RADIUS + 0.01;
    goal.roll(seen_by(attacker, [behind, 0.0]), [0.0, 0.0]);
    [
        (stuck, Command::FreeBall),
        (attack_crowd, Command::GoalKick(attacker.opponent())),
        (defense_crowd, Command::PreparePenalty(attacker)),
        (goal, Command::PrepareKickoff(attacker.opponent())),
    ]
}

/// All ways to stop play, for both sizes and both teams that attack.
fn each(check: impl Fn(Scene, Command)) {
    for size in Size::BOTH {
        for attacker in Team::BOTH {
            for (scene, command) in stops(size, attacker) {
                check(scene, command);
            }
        }
    }
}

#[test]
fn a_stop_is_followed_by_the_kick_after_four_seconds_and_by_play_after_four_more() {
    each(|mut scene, command| {
        let (_, event) = scene.first_event(6.0).expect("play stops");
        assert!(!scene.restarts, "bodies stay until the stop is over");
        let stop = if event.kind == EventKind::Goal { 8.0 } else { 4.0 };
        assert_eq!(scene.wait_for(command), steps(stop), "{command:?}");
        assert!(scene.restarts);
        assert_eq!(scene.game.next_command, Some(Command::NormalStart));
        assert_eq!(scene.ball_position(), scene.game.designated_position);
        assert!(!scene.game.in_play);
        assert_eq!(scene.wait_for(Command::NormalStart), steps(4.0), "{command:?}");
        assert!(!scene.restarts, "bodies have stayed at their places");
        assert!(scene.game.in_play);
        assert_eq!(scene.game.next_command, None);
    });
}

#[test]
fn bodies_that_move_before_the_kick_return_to_their_places() {
    each(|mut scene, command| {
        scene.wait_for(command);
        let expected = scene.row.clone();
        scene.roll([0.05, 0.3], [1.0, 0.0]);
        scene.robot(Team::Yellow, 1, [0.1, -0.4]);
        scene.set(Team::Blue, 2, "v_theta", 3.0);
        scene.step();
        scene.set(Team::Blue, 0, "v_x", 0.5);
        scene.wait_for(Command::NormalStart);
        assert!(scene.restarts);
        let places = |row: &[f32]| {
            let sight = scene.referee.layout().sight(row).expect("its row");
            let robots: Vec<_> =
                sight.robots().map(|robot| (robot.position, robot.velocity)).collect();
            let spins: Vec<_> = sight.robots().map(|robot| robot.angular_velocity).collect();
            (sight.ball().position, sight.ball().velocity, robots, spins)
        };
        assert_eq!(places(&scene.row), places(&expected), "{command:?}");
    });
}

#[test]
fn robots_that_were_placed_face_the_ball() {
    each(|mut scene, command| {
        scene.wait_for(command);
        let ball = scene.ball_position();
        for robot in scene.robots() {
            let to_ball = ball - robot.position;
            let cosine = robot.heading.dot(to_ball) / to_ball.length();
            assert!((cosine - 1.0).abs() < 1e-5, "{command:?}: {robot:?}");
        }
    });
}

#[test]
fn a_ball_that_rests_near_its_place_stays_and_robots_keep_clear_of_it() {
    let mut scene = Scene::in_play(Size::Three);
    defend(&mut scene, Team::Yellow, 2);
    scene.first_event(6.0).expect("a foul");
    scene.ball([0.366, 0.0]);
    scene.wait_for(Command::PreparePenalty(Team::Blue));
    assert_eq!(scene.ball_position(), Vector::new(0.366, 0.0));
    for robot in scene.robots() {
        let distance = robot.position.distance(scene.ball_position());
        assert!(distance > scene.referee.pitch().robot_radius + BALL_RADIUS, "{robot:?}");
    }
    for (x, z) in [(0.364, 0.0), (0.366, 0.1)] {
        let mut scene = Scene::in_play(Size::Three);
        defend(&mut scene, Team::Yellow, 2);
        scene.first_event(6.0).expect("a foul");
        scene.ball([x, 0.0]);
        scene.lift(z);
        scene.wait_for(Command::PreparePenalty(Team::Blue));
        assert_eq!(scene.ball_position(), Vector::new(0.375, 0.0), "{x} {z}");
    }
}

#[test]
fn the_match_begins_with_the_kick_off_of_the_first_team() {
    for size in Size::BOTH {
        for first in Team::BOTH {
            let mut scene = Scene::new(size);
            scene.game = Game::new(first);
            assert_eq!(scene.game.command, Command::PrepareKickoff(first));
            assert_eq!(scene.game.stage, Stage::FirstHalfPre);
            assert_eq!(scene.wait_for(Command::NormalStart), steps(4.0));
            assert!(scene.restarts && scene.game.in_play);
            assert_eq!(scene.game.stage, Stage::FirstHalf);
            assert_eq!(scene.game.stage_steps_left, 12_000, "300 s");
        }
    }
}

#[test]
fn the_clock_counts_only_while_play_is_on() {
    each(|mut scene, command| {
        let before = scene.game.stage_steps_left;
        let (nth, _) = scene.first_event(6.0).expect("play stops");
        let left = before - i32::try_from(nth).expect("few");
        assert_eq!(scene.game.stage_steps_left, left, "the step of the foul was play");
        scene.wait_for(command);
        scene.wait_for(Command::NormalStart);
        assert_eq!(scene.game.stage_steps_left, left);
        scene.step();
        assert_eq!(scene.game.stage_steps_left, left - 1);
        assert_eq!(scene.game.stage, Stage::FirstHalf);
    });
}

#[test]
fn a_running_clock_counts_stops_too() {
    let mut config = Size::Three.config();
    config.clock = Clock::Running;
    let mut scene = Scene::in_play_with(Size::Three, config);
    scene.ball([0.2, 0.2]);
    scene.first_event(6.0).expect("it is stuck");
    let left = scene.game.stage_steps_left;
    scene.wait_for(Command::NormalStart);
    assert_eq!(scene.game.stage_steps_left, left - 320);
}

#[test]
fn a_foul_of_the_next_play_decides_anew() {
    for size in Size::BOTH {
        let mut scene = Scene::in_play(size);
        scene.ball([0.2, 0.2]);
        scene.first_event(6.0).expect("it is stuck");
        scene.wait_for(Command::NormalStart);
        scene.park();
        attack(&mut scene, Team::Yellow, 2);
        scene.first_event(6.0).expect("a foul");
        let next = Command::GoalKick(Team::Blue);
        assert_eq!(scene.game.next_command, Some(next));
        scene.wait_for(next);
        assert_eq!(scene.game.kick, Some(next));
    }
}

#[test]
fn teams_may_touch_the_ball_only_in_play() {
    each(|mut scene, command| {
        let may_touch = |scene: &Scene| Team::BOTH.map(|team| scene.game.may_touch(team));
        assert_eq!(may_touch(&scene), [true, true]);
        scene.first_event(6.0).expect("play stops");
        assert_eq!(may_touch(&scene), [false, false]);
        scene.wait_for(command);
        assert_eq!(may_touch(&scene), [false, false]);
        scene.wait_for(Command::NormalStart);
        assert_eq!(may_touch(&scene), [true, true]);
    });
}
