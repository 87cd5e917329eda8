//! Matches of a caller, and the memory that both share.

use std::cell::RefCell;

use rsim_match::{Controls, Decision, Match, PolicyFile};
use rsim_referee::Team;
use rsim_referee::codes::{COMMANDS, Stage};
use rsim_referee::events::{Event, EventKind};
use rsim_referee::game::Game;
use serde::Serialize;

use rsim_core::columns::{BALL_COLUMNS, BALL_PARAMETERS, ROBOT_COLUMNS, ROBOT_PARAMETERS};
use rsim_core::{Sensing, scenes};

/// Any error, as text.
type Failure = Box<dyn std::error::Error>;

/// Matches by handle, and both buffers.
#[derive(Default)]
pub(crate) struct Session {
    pub(crate) input: Vec<u8>,
    pub(crate) output: Vec<u8>,
    matches: Vec<Option<Match>>,
}

thread_local! {
    static SESSION: RefCell<Session> = RefCell::default();
}

/// Runs a function on the session.
pub(crate) fn with<T>(act: impl FnOnce(&mut Session) -> T) -> T {
    SESSION.with_borrow_mut(act)
}

/// Runs a function that can fail: its number, or -1 with the error as output.
pub(crate) fn tried(act: impl FnOnce(&mut Session) -> Result<i32, Failure>) -> i32 {
    with(|session| {
        act(session).unwrap_or_else(|error| {
            session.output = error.to_string().into_bytes();
            -1
        })
    })
}

/// State of the referee, in words and numbers.
#[derive(Serialize)]
struct Report {
    command: &'static str,
    next: Option<&'static str>,
    kick: Option<&'static str>,
    stage: &'static str,
    seconds_left: f32,
    score: [i32; 2],
    in_play: bool,
    place: [f32; 2],
    may_touch: Vec<bool>,
    yellow_cards: [i32; 2],
    red_cards: [i32; 2],
    events: Vec<ReportedEvent>,
    steps: u64,
}

#[derive(Serialize)]
struct ReportedEvent {
    kind: &'static str,
    team: Option<usize>,
    robot: Option<usize>,
    position: [f32; 2],
}

/// Names that the caller needs to read rows.
#[derive(Serialize)]
struct Names {
    ball: &'static [&'static str],
    robot: &'static [&'static str],
    ball_factors: &'static [&'static str],
    robot_factors: &'static [&'static str],
    sensing: Vec<&'static str>,
    game: Vec<String>,
}

impl Session {
    /// The first bytes of the input.
    fn given(&self, length: usize) -> Result<&[u8], Failure> {
        self.input.get(..length).ok_or_else(|| "input: expected as many bytes as asked for".into())
    }

    fn one(&mut self, handle: usize) -> Result<&mut Match, Failure> {
        let found = self.matches.get_mut(handle).and_then(Option::as_mut);
        found.ok_or_else(|| format!("match: expected one that was created, got {handle}").into())
    }

    fn write(&mut self, value: &impl Serialize) -> Result<i32, Failure> {
        self.output = serde_json::to_vec(value)?;
        Ok(0)
    }

    fn write_numbers(&mut self, numbers: &[f32]) -> i32 {
        self.output.clear();
        self.output.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
        i32::try_from(numbers.len()).unwrap_or(i32::MAX)
    }

    pub(crate) fn create(&mut self, length: usize) -> Result<i32, Failure> {
        let created = Match::new(serde_json::from_slice(self.given(length)?)?)?;
        let free = self.matches.iter().position(Option::is_none);
        let handle = free.unwrap_or(self.matches.len());
        if free.is_none() {
            self.matches.push(None);
        }
        self.matches[handle] = Some(created);
        Ok(i32::try_from(handle)?)
    }

    pub(crate) fn remove(&mut self, handle: usize) -> Result<i32, Failure> {
        self.one(handle)?;
        self.matches[handle] = None;
        Ok(0)
    }

    pub(crate) fn set_side(
        &mut self,
        handle: usize,
        team: usize,
        skill: f32,
        length: usize,
    ) -> Result<i32, Failure> {
        let team = *Team::BOTH.get(team).ok_or("team: expected 0 or 1")?;
        if length > 0 {
            let policy = PolicyFile::read(self.given(length)?)?;
            self.one(handle)?.set_policy(team, policy)?;
        } else if skill < 0.0 {
            self.one(handle)?.set_idle(team);
        } else {
            self.one(handle)?.set_scripted(team, skill)?;
        }
        Ok(0)
    }

    pub(crate) fn control(
        &mut self,
        handle: usize,
        robot: usize,
        length: usize,
    ) -> Result<i32, Failure> {
        let controls: Option<Controls> = serde_json::from_slice(self.given(length)?)?;
        self.one(handle)?.control(robot, controls)?;
        Ok(0)
    }

    pub(crate) fn step(&mut self, handle: usize) -> Result<i32, Failure> {
        let one = self.one(handle)?;
        one.step()?;
        Ok(i32::from(!one.decisions().events.is_empty()))
    }

    pub(crate) fn change(&mut self, handle: usize, length: usize) -> Result<i32, Failure> {
        let conditions = serde_json::from_slice(self.given(length)?)?;
        self.one(handle)?.change(conditions)?;
        Ok(0)
    }

    pub(crate) fn move_body(
        &mut self,
        handle: usize,
        body: usize,
        place: [f32; 2],
        velocity: [f32; 2],
    ) -> Result<i32, Failure> {
        let one = self.one(handle)?;
        match body.checked_sub(1) {
            None => one.move_ball(place, velocity)?,
            Some(robot) => one.move_robot(robot, place)?,
        }
        Ok(0)
    }

    pub(crate) fn resume(&mut self, handle: usize, length: usize) -> Result<i32, Failure> {
        let bytes = self.given(length)?.chunks_exact(4);
        let numbers: Vec<f32> =
            bytes.filter_map(|word| word.try_into().ok().map(f32::from_le_bytes)).collect();
        let one = self.one(handle)?;
        let expected = one.row().len() + Game::columns().len();
        if numbers.len() != expected {
            let got = numbers.len();
            return Err(format!("situation: expected {expected} numbers, got {got}").into());
        }
        let (row, game) = numbers.split_at(one.row().len());
        one.resume(row, game)?;
        Ok(0)
    }

    pub(crate) fn row(&mut self, handle: usize, which: u32) -> Result<i32, Failure> {
        let one = self.one(handle)?;
        let numbers = match which {
            0 => one.row().to_vec(),
            1 => one.known(Team::Blue).to_vec(),
            2 => one.known(Team::Yellow).to_vec(),
            3 => one.commands().to_vec(),
            4 => one.game().row(),
            _ => return Err(format!("which: expected a row from 0 to 4, got {which}").into()),
        };
        Ok(self.write_numbers(&numbers))
    }

    pub(crate) fn describe(&mut self, handle: usize) -> Result<i32, Failure> {
        let one = self.one(handle)?;
        let report = report(one);
        self.write(&report)
    }

    pub(crate) fn configuration(&mut self, handle: usize) -> Result<i32, Failure> {
        let config = self.one(handle)?.config().clone();
        self.write(&config)
    }

    pub(crate) fn decision(&mut self, handle: usize, robot: usize) -> Result<i32, Failure> {
        let decided = self.one(handle)?.decision(robot)?;
        let Some(Decision { observation, means }) = decided else {
            return Err("robot: expected one of a network's team".into());
        };
        self.write_numbers(&[observation, means].concat());
        Ok(0)
    }

    pub(crate) fn names(&mut self) -> Result<i32, Failure> {
        self.write(&Names {
            ball: &BALL_COLUMNS,
            robot: &ROBOT_COLUMNS,
            ball_factors: &BALL_PARAMETERS,
            robot_factors: &ROBOT_PARAMETERS,
            sensing: Sensing::numbers().into_iter().map(|number| number.name).collect(),
            game: Game::columns(),
        })
    }

    pub(crate) fn golden(&mut self) -> i32 {
        let lines = scenes::golden::hashes().into_iter();
        let lines: Vec<String> = lines.map(|(name, hash)| format!("{name} {hash}")).collect();
        self.output = lines.join("\n").into_bytes();
        0
    }
}

fn report(one: &Match) -> Report {
    let game = one.game();
    let named = |command| {
        let found = COMMANDS.iter().find(|(each, ..)| *each == command);
        found.map_or("", |(_, _, name)| *name)
    };
    let pair = |of: fn(&Game, Team) -> i32| Team::BOTH.map(|team| of(game, team));
    let config = one.config();
    let team_of = |robot| if robot < config.blue.len() { Team::Blue } else { Team::Yellow };
    let places = Stage::ALL.iter().zip(Stage::NAMES);
    Report {
        command: named(game.command),
        next: game.next_command.map(named),
        kick: game.kick.map(named),
        stage: places
            .into_iter()
            .find(|(stage, _)| **stage == game.stage)
            .map_or("", |(_, name)| name),
        seconds_left: (game.stage_steps_left as f32 * config.time_step).max(0.0),
        score: pair(|game, team| game.score[team]),
        in_play: game.in_play,
        place: [game.designated_position.x, game.designated_position.y],
        may_touch: (0..config.n_robots())
            .map(|robot| game.robot_may_touch(robot, team_of(robot)))
            .collect(),
        yellow_cards: pair(|game, team| game.yellow_cards[team]),
        red_cards: pair(|game, team| game.red_cards[team]),
        events: one.decisions().events.iter().map(reported_event).collect(),
        steps: one.steps(),
    }
}

fn reported_event(event: &Event) -> ReportedEvent {
    let kind = EventKind::ALL.iter().find(|(kind, ..)| *kind == event.kind);
    ReportedEvent {
        kind: kind.map_or("", |(_, _, name)| *name),
        team: event.team.map(Team::index),
        robot: event.robot,
        position: [event.position.x, event.position.y],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exports;

    fn give(text: &str) -> usize {
        with(|session| session.input = text.as_bytes().to_vec());
        text.len()
    }

    fn output() -> String {
        with(|session| String::from_utf8_lossy(&session.output).into_owned())
    }

    fn handle(number: i32) -> usize {
        usize::try_from(number).unwrap_or_else(|_| panic!("{}", output()))
    }

    #[test]
    fn a_match_is_created_stepped_described_and_removed() {
        let text = r#"{"field": "ssl_b", "blue": 2, "yellow": 3}"#;
        let one = handle(exports::create(give(text)));
        assert_eq!(exports::set_side(one, 1, 0.8, 0), 0);
        assert_eq!(exports::control(one, 0, give(r#"{"up": 1}"#)), 0);
        for _ in 0..50 {
            assert!(exports::step(one) >= 0, "{}", output());
        }
        let numbers = exports::row(one, 0);
        assert_eq!(usize::try_from(numbers).expect("a count") * 4, exports::output_length());
        assert_eq!(exports::describe(one), 0);
        let report: serde_json::Value = serde_json::from_str(&output()).expect("JSON");
        assert_eq!(report["steps"], 50);
        assert_eq!(report["may_touch"].as_array().map(Vec::len), Some(5));
        assert_eq!(exports::names(), 0);
        let names: serde_json::Value = serde_json::from_str(&output()).expect("JSON");
        assert_eq!(names["game"].as_array().map(Vec::len), Some(Game::columns().len()));
        assert_eq!(exports::configuration(one), 0);
        let config: rsim_core::SimConfig = serde_json::from_str(&output()).expect("JSON");
        assert_eq!(config.yellow.len(), 3);
        assert_eq!(exports::remove(one), 0);
        assert_eq!(exports::step(one), -1);
        assert!(output().contains("match"), "{}", output());
        assert_eq!(handle(exports::create(give(text))), one, "the handle is free again");
    }

    #[test]
    fn errors_are_texts() {
        assert_eq!(exports::create(give("{}")), -1);
        assert!(output().contains("field"), "{}", output());
        assert_eq!(exports::create(99), -1);
        assert!(output().contains("input"), "{}", output());
        let one = handle(exports::create(give(r#"{"field": "vss_3v3", "blue": 1, "yellow": 1}"#)));
        assert_eq!(exports::decision(one, 0), -1);
        assert_eq!(exports::row(one, 9), -1);
        assert!(output().contains("which"), "{}", output());
        assert_eq!(exports::move_body(one, 0, 0.2, 0.1, 0.0, 0.0), 0);
        assert_eq!(exports::move_body(one, 7, 0.2, 0.1, 0.0, 0.0), -1);
        assert_eq!(exports::change(one, give(r#"{"sensing": {"delay": 0.1}}"#)), 0);
        assert_eq!(exports::resume(one, give("12345678")), -1);
        assert!(output().contains("situation"), "{}", output());
    }
}
