//! Whole matches of bodies that wander: what holds in each step, whatever happens.

use std::collections::HashSet;

use rsim_referee::codes::{Command, Stage};
use rsim_referee::config::RefereeConfig;
use rsim_referee::events::{Event, EventKind};
use rsim_referee::game::Game;
use rsim_referee::{Team, Vector};

use crate::outlines::assert_valid;
use crate::pitches::{BALL_RADIUS, Size, TIME_STEP};
use crate::random::Random;
use crate::scene::{Scene, seen_by, steps};

/// Duration of a half, s.
const HALF_SECONDS: f32 = 15.0;
/// Speed of a wandering robot, m/s.
const ROBOT_SPEED: f32 = 0.8;
/// Speed up to which the ball is kicked, m/s.
const KICK_SPEED: f32 = 1.5;
/// Deceleration of the ball, m/s2.
const DECELERATION: f32 = 0.5;

/// A match with bodies that wander: robots to the ball or anywhere, the ball where it is kicked.
struct Walk {
    scene: Scene,
    /// The match as a row.
    row: Vec<f32>,
    random: Random,
    /// Place where each robot of blue and of yellow is going; `None` to the ball.
    targets: Vec<Option<Vector>>,
    /// Probability that a robot turns to the ball when it chooses a target.
    chases: f32,
    /// Probability that a robot at the ball kicks it in a step.
    kicks: f32,
    velocity: Vector,
}

impl Walk {
    fn new(size: Size, robots: [usize; 2], seed: u8) -> Self {
        let config =
            RefereeConfig { half_seconds: HALF_SECONDS, extra_half_seconds: 5.0, ..size.config() };
        let mut scene = Scene::with(config, size.pitch(), robots);
        scene.game = Game::new(if seed % 2 == 0 { Team::Blue } else { Team::Yellow });
        scene.park();
        // Lively matches, and some in which the ball often lies: with many robots around it, or with few.
        let [chases, kicks] = [[0.4, 0.002], [0.4, 0.1], [0.02, 0.3]][usize::from(seed % 3)];
        Self {
            row: scene.game.row(),
            scene,
            random: Random::new(u64::from(seed)),
            targets: vec![None; robots[0] + robots[1]],
            chases,
            kicks,
            velocity: Vector::default(),
        }
    }

    /// Moves all bodies by a step.
    fn wander(&mut self) {
        for robot in self.scene.robots() {
            if self.random.happens(0.02) {
                let lines = &self.scene.referee.pitch().lines;
                let (length, width) = (lines.half_length - 0.1, lines.half_width - 0.1);
                let x = self.random.between(-length, length);
                let target = Vector::new(x, self.random.between(-width, width));
                self.targets[robot.index] = (!self.random.happens(self.chases)).then_some(target);
            }
            let ball = self.scene.ball_position();
            let way = self.targets[robot.index].unwrap_or(ball) - robot.position;
            let place = robot.position + way * (ROBOT_SPEED * TIME_STEP / way.length().max(0.1));
            let nth = robot.index - self.scene.index(robot.team, 0);
            self.scene.robot(robot.team, nth, [place.x, place.y]);
            if place.distance(ball) < 0.08 && self.random.happens(self.kicks) {
                self.scene.touch(robot.team, nth);
                let ahead = seen_by(robot.team, [self.random.between(-0.3, 1.0), 0.0])[0];
                let aside = self.random.between(-0.5, 0.5);
                self.velocity = Vector::new(ahead, aside) * KICK_SPEED;
            }
        }
        self.roll();
    }

    /// Lets the ball roll, and bounce at walls; goals have no end.
    fn roll(&mut self) {
        let lines = &self.scene.referee.pitch().lines;
        let (x, y) = (lines.half_length - BALL_RADIUS, lines.half_width - BALL_RADIUS);
        let mut place = self.scene.ball_position() + self.velocity * TIME_STEP;
        if place.x.abs() > x && place.y.abs() > lines.half_goal_width {
            self.velocity.x = -self.velocity.x;
        }
        if place.y.abs() > y {
            self.velocity.y = -self.velocity.y;
        }
        place = Vector::new(place.x, place.y.clamp(-y, y));
        if place.y.abs() > lines.half_goal_width {
            place.x = place.x.clamp(-x, x);
        }
        let speed = self.velocity.length();
        let slower = (speed - DECELERATION * TIME_STEP).max(0.0);
        self.velocity = self.velocity * (slower / speed.max(1e-6));
        self.scene.roll([place.x, place.y], [self.velocity.x, self.velocity.y]);
    }

    /// Ends a step, and checks what follows from its beginning. Returns its events.
    fn step(&mut self) -> Vec<Event> {
        let before = self.scene.game.clone();
        before.write(&mut self.row);
        self.scene.game = Game::read(&self.row).expect("its own row");
        assert_eq!(self.scene.game, before, "a match comes back from its row");
        if before.in_play || self.random.happens(0.3) {
            self.wander();
        }
        let events = self.scene.step();
        if self.scene.restarts {
            self.velocity = Vector::default();
            assert_valid(&self.scene);
        }
        if self.scene.game.in_play && !before.in_play {
            let ahead = self.random.between(-KICK_SPEED, KICK_SPEED);
            self.velocity = Vector::new(ahead, self.random.between(-0.2, 0.2));
        }
        assert_events(&before, &self.scene.game, &events);
        assert_clock(&before, &self.scene);
        assert_times(&self.scene);
        events
    }
}

/// Decisions are made in play, one in a step, and goals are the score.
fn assert_events(before: &Game, after: &Game, events: &[Event]) {
    assert!(events.is_empty() || before.in_play, "{events:?} in {:?}", before.command);
    assert!(events.len() <= 1, "{events:?}");
    for team in Team::BOTH {
        let goals = events
            .iter()
            .filter(|event| event.kind == EventKind::Goal && event.team == Some(team))
            .count();
        let gained = after.score[team] - before.score[team];
        assert_eq!(usize::try_from(gained), Ok(goals));
    }
    if !events.is_empty() {
        assert!(!after.in_play);
        assert!(matches!(after.command, Command::Stop | Command::Halt));
    }
}

/// The clock counts the steps of play, and a stage follows when it is over.
fn assert_clock(before: &Game, scene: &Scene) {
    let (after, config) = (&scene.game, scene.referee.config());
    let counts = i32::from(before.in_play && before.stage.is_played());
    if before.stage == after.stage {
        assert_eq!(before.stage_steps_left - after.stage_steps_left, counts);
        assert!(!after.stage.is_played() || after.stage_steps_left > 0);
    } else if after.stage.is_played() {
        assert_eq!(
            after.stage_steps_left,
            scene.referee.pitch().steps(config.seconds(after.stage))
        );
    } else {
        assert!(!before.stage.is_played() || before.stage_steps_left == counts);
    }
}

/// No command lasts longer than its time; only play goes on until its half is over.
fn assert_times(scene: &Scene) {
    let game = &scene.game;
    let most = match (game.command, game.stage) {
        (Command::Halt, _) => f32::INFINITY,
        (Command::Stop, _) => 8.0,
        (Command::NormalStart, Stage::Shootout) => 10.0,
        (Command::NormalStart, _) => HALF_SECONDS,
        _ => 4.0,
    };
    let lasted = scene.referee.pitch().seconds(game.command_steps);
    assert!(lasted < most + 0.001, "{:?} for {lasted} s", game.command);
    assert_eq!(game.command == Command::Halt, game.stage == Stage::PostGame);
}

/// Plays a match to its end. Returns what it ends with, and the kinds of its events and commands.
fn play(size: Size, robots: [usize; 2], seed: u8) -> (Vec<f32>, HashSet<&'static str>) {
    let mut walk = Walk::new(size, robots, seed);
    let mut kinds = HashSet::new();
    for _ in 0..steps(500.0) {
        for event in walk.step() {
            let found = EventKind::ALL.iter().find(|(kind, _, _)| *kind == event.kind);
            kinds.insert(found.expect("a kind").2);
        }
        if walk.scene.game.stage == Stage::PostGame {
            return (walk.scene.game.row(), kinds);
        }
    }
    panic!("no end: {:?}", walk.scene.game);
}

#[test]
fn matches_end_and_all_that_holds_in_a_step_holds_in_each() {
    let mut kinds = HashSet::new();
    for size in Size::BOTH {
        for (seed, fewer) in (0..8).zip([0, 0, 1, 0, 2, 0, 0, 0]) {
            kinds.extend(play(size, [size.robots(), size.robots() - fewer], seed).1);
        }
    }
    for rule in rsim_referee::rules::vsss::RULES {
        assert!(kinds.contains(rule.name), "{} is never seen, but {kinds:?}", rule.name);
    }
    assert!(kinds.contains("INVALID_GOAL"));
}

#[test]
fn the_same_seed_gives_the_same_match() {
    let play = |seed| play(Size::Three, [3, 3], seed);
    assert_eq!(play(7), play(7));
    assert_ne!(play(7), play(8));
}
