//! Invariants of all matches: a seeded walk through random bodies and touches.

mod course;
mod places;

use rsim_referee::codes::Stage;
use rsim_referee::config::{Clock, HalfEnd, Placement, RefereeConfig};
use rsim_referee::game::Game;
use rsim_referee::{Lines, Team};

use crate::scene::{
    A, B, BALL_RADIUS, Bot, Division, ROBOT_RADIUS, Scene, Side, TIME_STEP, Us, views_with,
};
use course::{check_change, check_clock, check_pair, check_score};
use places::{ROUNDING, check_places, check_valid_for_the_rules};

/// Random numbers: splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// A number between two others.
    fn between(&mut self, low: f32, high: f32) -> f32 {
        let share = f32::from(u16::try_from(self.next() >> 48).expect("16 bits")) / 65_535.0;
        low + share * (high - low)
    }

    /// Whether something with a probability happens.
    fn happens(&mut self, probability: f32) -> bool {
        self.between(0.0, 1.0) < probability
    }
}

/// A ball and robots without physics, in a match.
struct Walk {
    scene: Scene,
    random: Random,
    ball_velocity: (f32, f32),
    height: (f32, f32),
}

impl Walk {
    fn new(scene: Scene, seed: u64) -> Self {
        let mut walk =
            Self { scene, random: Random(seed), ball_velocity: (0.0, 0.0), height: (0.0, 0.0) };
        walk.scene.game = Game::new(Team::Blue);
        walk
    }

    fn bots(&self) -> Vec<Bot> {
        let all = Side::BOTH.into_iter();
        all.flat_map(|side| (0..self.scene.size()).map(move |number| (side, number))).collect()
    }

    fn move_all(&mut self) {
        let present: Vec<(Bot, (f32, f32))> = self
            .bots()
            .into_iter()
            .filter_map(|bot| self.scene.robot_at(bot).map(|place| (bot, place)))
            .collect();
        let lines = self.scene.referee.pitch().lines.clone();
        for (bot, place) in &present {
            self.move_robot(*bot, *place, &lines);
        }
        self.move_ball(&present);
        for (bot, place) in &present {
            for (other, at) in &present {
                let near = (place.0 - at.0).hypot(place.1 - at.1) < 2.0 * ROBOT_RADIUS + 0.05;
                if bot.0 == Us && other.0 != Us && near {
                    let closing = self.random.between(0.0, 1.52);
                    self.scene.collide(*bot, *other, closing);
                }
            }
        }
    }

    /// A robot drives a bit, mostly to the ball.
    fn move_robot(&mut self, bot: Bot, (x, y): (f32, f32), lines: &Lines) {
        let speed = if self.random.happens(0.01) { 3.0 } else { 1.2 };
        let ball = self.scene.ball_at();
        let away = (ball.0 - x).hypot(ball.1 - y).max(0.1);
        let pull = if bot.1 % 2 == 1 { speed / away } else { 0.0 };
        let velocity = (
            pull * (ball.0 - x) + self.random.between(-speed, speed),
            pull * (ball.1 - y) + self.random.between(-speed, speed),
        );
        let (max_x, max_y) = (lines.boundary_x - ROBOT_RADIUS, lines.boundary_y - ROBOT_RADIUS);
        let to = (
            (x + velocity.0 * TIME_STEP).clamp(-max_x, max_x),
            (y + velocity.1 * TIME_STEP).clamp(-max_y, max_y),
        );
        if self.is_free(bot, to) {
            self.scene.robot(bot, to.0, to.1);
        }
        self.scene.robot_velocity(bot, velocity.0, velocity.1);
    }

    /// Whether no other robot is at a place.
    fn is_free(&self, bot: Bot, (x, y): (f32, f32)) -> bool {
        let mut others = self.bots().into_iter().filter(|other| *other != bot);
        others.all(|other| {
            let at = self.scene.robot_at(other);
            at.is_none_or(|at| (at.0 - x).hypot(at.1 - y) >= 2.0 * ROBOT_RADIUS + ROUNDING)
        })
    }

    /// The ball rolls and flies; a robot near it may kick it.
    fn move_ball(&mut self, present: &[(Bot, (f32, f32))]) {
        let (x, y) = self.scene.ball_at();
        let reach = ROBOT_RADIUS + BALL_RADIUS + 0.05;
        let near = present.iter().find(|(_, at)| (at.0 - x).hypot(at.1 - y) < reach);
        if let Some((bot, _)) = near.filter(|_| self.random.happens(0.5)) {
            let speed = if self.random.happens(0.1) { 7.0 } else { 3.0 };
            self.ball_velocity =
                (self.random.between(-speed, speed), self.random.between(-speed, speed));
            self.height.1 = if self.random.happens(0.2) { 3.0 } else { 0.0 };
            self.scene.touch(*bot);
        }
        self.height.1 -= 9.81 * TIME_STEP;
        self.height.0 = (self.height.0 + self.height.1 * TIME_STEP).max(0.0);
        if self.height.0 <= 0.0 {
            self.height.1 = 0.0;
        }
        self.ball_velocity = (self.ball_velocity.0 * 0.98, self.ball_velocity.1 * 0.98);
        if self.ball_velocity.0.hypot(self.ball_velocity.1) < 0.1 {
            self.ball_velocity = (0.0, 0.0);
        }
        let lines = &self.scene.referee.pitch().lines;
        let to = (
            (x + self.ball_velocity.0 * TIME_STEP).clamp(-lines.boundary_x, lines.boundary_x),
            (y + self.ball_velocity.1 * TIME_STEP).clamp(-lines.boundary_y, lines.boundary_y),
        );
        self.scene.ball(to.0, to.1);
        self.scene.ball_velocity(self.ball_velocity.0, self.ball_velocity.1, self.height.1);
        self.scene.ball_height(self.height.0);
    }

    fn step(&mut self) {
        self.move_all();
        let before = self.scene.game.clone();
        self.scene.step();
        if self.scene.sight().ball().speed() == 0.0 {
            (self.ball_velocity, self.height) = ((0.0, 0.0), (0.0, 0.0));
        }
        check_pair(&self.scene);
        check_change(&before, &self.scene.game);
        check_score(&before, &self.scene);
        check_clock(&before, &self.scene);
        let game = &self.scene.game;
        assert_eq!(Game::read(&game.row()).as_ref(), Ok(game), "the row holds all of it");
        if self.scene.restarted && self.scene.referee.config().placement == Placement::Teleport {
            check_places(&self.scene);
            check_valid_for_the_rules(&self.scene);
        }
    }
}

/// Configurations that differ in how matches go on.
fn changes() -> Vec<(Division, Placement, Clock, HalfEnd)> {
    use Placement::{Robots, Teleport};
    vec![
        (B, Teleport, Clock::Stopped, HalfEnd::NextStop),
        (A, Teleport, Clock::Stopped, HalfEnd::AtOnce),
        (B, Teleport, Clock::Running, HalfEnd::AtOnce),
        (B, Robots, Clock::Stopped, HalfEnd::NextStop),
        (A, Robots, Clock::Running, HalfEnd::NextStop),
    ]
}

fn scene((division, placement, clock, half_end): (Division, Placement, Clock, HalfEnd)) -> Scene {
    let change = move |config: &mut RefereeConfig| {
        config.placement = placement;
        config.clock = clock;
        config.half_end = half_end;
        config.half_seconds = 30.0;
        config.extra_half_seconds = 10.0;
        config.yellow_card_seconds = 5.0;
    };
    views_with(division, change).next().expect("the first view")
}

/// Longest time that a match may wait for something, s: a ball placement that is interfered with.
const LONGEST_WAIT: f32 = 80.0;

#[test]
fn matches_keep_their_order() {
    for (nth, change) in (0..).zip(changes()) {
        let mut walk = Walk::new(scene(change), nth);
        let (mut waited, mut before, mut ends) = (0, [0, 0], 0);
        for _ in 0..8000 {
            walk.step();
            let kicks = Team::BOTH.map(|team| walk.scene.game.shootout_kicks[team]);
            let goes_on = walk.scene.game.in_play || kicks != before;
            (waited, before) = (if goes_on { 0 } else { waited + 1 }, kicks);
            assert!(waited < walk.scene.steps(LONGEST_WAIT), "{:?}", walk.scene.game);
            if walk.scene.game.stage == Stage::PostGame {
                ends += 1;
                waited = 0;
                walk.scene.game = Game::new(Team::Yellow);
            }
        }
        let stages = walk.scene.game.stage;
        assert!(ends > 0 || stages != Stage::FirstHalf, "the match has not gone on: {stages:?}");
    }
}

#[test]
fn a_match_in_which_nobody_moves_comes_to_its_shoot_out() {
    for change in changes() {
        let mut scene = scene(change);
        scene.game = Game::new(Team::Blue);
        scene.run(600.0, |scene| scene.game.stage == Stage::Shootout);
        let kicks = |scene: &Scene| Team::BOTH.map(|team| scene.game.shootout_kicks[team]);
        scene.run(600.0, |scene| kicks(scene) == [6, 6]);
    }
}

#[test]
fn a_match_from_its_row_has_the_same_future() {
    let mut walk = Walk::new(scene(changes()[0]), 9);
    for _ in 0..2000 {
        walk.step();
    }
    let row = walk.scene.game.row();
    let mut other = Walk::new(scene(changes()[0]), 0);
    other.scene.take_state(&walk.scene);
    other.scene.game = Game::read(&row).expect("a row of a match");
    other.random = Random(walk.random.0);
    (other.ball_velocity, other.height) = (walk.ball_velocity, walk.height);
    for _ in 0..1000 {
        walk.step();
        other.step();
        assert_eq!(walk.scene.game, other.scene.game);
        assert_eq!(walk.scene.events(), other.scene.events());
        assert_eq!(walk.scene.row(), other.scene.row());
    }
}
