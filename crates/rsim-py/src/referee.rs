//! The referee of many matches: judges the steps of all worlds.

use std::sync::{Mutex, PoisonError};

use numpy::{Ix2, PyArray1, PyArray2, PyArrayMethods, PyReadwriteArray};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use rsim_core::RobotModel;
use rsim_core::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use rsim_referee::codes::{COMMANDS, Stage};
use rsim_referee::config::{League, RefereeConfig};
use rsim_referee::events::{Event, EventKind};
use rsim_referee::game::Game;
use rsim_referee::pitch::Pitch;
use rsim_referee::sight::Layout;
use rsim_referee::{Decisions, Lines, RefereeError, Team, rules};

use crate::arrays::{Rows, readable, sizes, values, writeable};
use crate::config::SimConfig;
use crate::threads::Threads;

/// Most worlds whose steps the caller's thread judges alone.
const ALONE: usize = 64;

/// Numbers of an event: world, kind, team, robot, x, y.
const EVENT: usize = 6;

/// Referee of matches with the same rules, field and robots.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Referee {
    referee: rsim_referee::Referee,
    rules: String,
    config: SimConfig,
    row_size: usize,
    game_size: usize,
}

/// Work of a thread: the matches of some worlds, one after the other.
struct Portion<'a> {
    first: usize,
    game: &'a mut [f32],
    restart: &'a mut [f32],
    restarts: &'a mut [bool],
}

#[pymethods]
impl Referee {
    #[new]
    fn new(config: &SimConfig, rules: String) -> PyResult<Self> {
        let decoded: RefereeConfig = serde_json::from_str(&rules)
            .map_err(|error| PyValueError::new_err(format!("rules: {error}")))?;
        let (sim, layout) = (&config.0, layout(config)?);
        let pitch = pitch(config);
        let row_size = layout.row_size();
        debug_assert_eq!(row_size, sim.row_size());
        let referee = rsim_referee::Referee::new(decoded, pitch, layout).map_err(invalid)?;
        let game_size = Game::columns().len();
        Ok(Self { referee, rules, config: config.clone(), row_size, game_size })
    }

    /// Returns the row of a match whose first kick-off a team has.
    fn new_game<'py>(&self, py: Python<'py>, kickoff: usize) -> PyResult<Bound<'py, PyArray1<f32>>> {
        let Some(team) = Team::BOTH.get(kickoff) else {
            return Err(PyValueError::new_err(format!("kickoff: expected 0 or 1, got {kickoff}")));
        };
        Ok(PyArray1::from_vec(py, Game::new(*team).row()))
    }

    /// Fits matches to the states from which play begins or goes on.
    fn begin(&self, rows: &Bound<'_, PyAny>, game: &Bound<'_, PyAny>) -> PyResult<()> {
        let [n, _] = sizes::<2>("rows", rows)?;
        let rows: Rows = readable("rows", rows, &[n, self.row_size])?;
        let mut game: PyReadwriteArray<'_, f32, Ix2> =
            writeable("game", game, &[n, self.game_size])?;
        let rows = values(&rows);
        let each = game.as_slice_mut()?.chunks_exact_mut(self.game_size);
        for (game_row, row) in each.zip(rows.chunks_exact(self.row_size)) {
            let mut game = Game::read(game_row).map_err(invalid)?;
            self.referee.begin(row, &mut game).map_err(invalid)?;
            game.write(game_row);
        }
        Ok(())
    }

    /// Judges a step of all matches.
    #[pyo3(signature = (before, after, game, restart, threads = None))]
    fn judge<'py>(
        &self,
        py: Python<'py>,
        before: &Bound<'py, PyAny>,
        after: &Bound<'py, PyAny>,
        game: &Bound<'py, PyAny>,
        restart: &Bound<'py, PyAny>,
        threads: Option<&Threads>,
    ) -> PyResult<(Option<Bound<'py, PyArray1<bool>>>, Option<Bound<'py, PyArray2<f32>>>)> {
        let [n, _] = sizes::<2>("after", after)?;
        let before: Rows = readable("before", before, &[n, self.row_size])?;
        let after: Rows = readable("after", after, &[n, self.row_size])?;
        let mut game: PyReadwriteArray<'_, f32, Ix2> =
            writeable("game", game, &[n, self.game_size])?;
        let mut restart: PyReadwriteArray<'_, f32, Ix2> =
            writeable("restart", restart, &[n, self.row_size])?;
        let (before, after) = (values(&before), values(&after));
        let (game, restart) = (game.as_slice_mut()?, restart.as_slice_mut()?);
        let mut restarts = vec![false; n];
        let found = py.detach(|| {
            self.judge_all(&before, &after, game, restart, &mut restarts, threads)
        });
        let events = found.map_err(invalid)?;
        let restarts = restarts.contains(&true).then(|| PyArray1::from_vec(py, restarts));
        let events = if events.is_empty() {
            None
        } else {
            let rows = events.len() / EVENT;
            Some(PyArray1::from_vec(py, events).reshape([rows, EVENT])?)
        };
        Ok((restarts, events))
    }

    fn __reduce__<'py>(
        slf: &Bound<'py, Self>,
    ) -> (Bound<'py, PyAny>, (SimConfig, String)) {
        let Self { config, rules, .. } = slf.get();
        (slf.get_type().into_any(), (config.clone(), rules.clone()))
    }
}

impl Referee {
    /// Judges all worlds. Returns the numbers of all events, in the order of worlds.
    fn judge_all(
        &self,
        before: &[f32],
        after: &[f32],
        game: &mut [f32],
        restart: &mut [f32],
        restarts: &mut [bool],
        threads: Option<&Threads>,
    ) -> Result<Vec<f32>, RefereeError> {
        let n = restarts.len();
        let alone = threads.is_none_or(|threads| threads.0.count() == 1) || n <= ALONE;
        let size = if alone { n.max(1) } else { threads.map_or(n, |t| t.0.portion(n, 1, ALONE)) };
        let portions = game
            .chunks_mut(size * self.game_size)
            .zip(restart.chunks_mut(size * self.row_size))
            .zip(restarts.chunks_mut(size))
            .enumerate()
            .map(|(nth, ((game, restart), restarts))| Portion {
                first: nth * size,
                game,
                restart,
                restarts,
            });
        let found = Mutex::new(Vec::new());
        let judge = |portion: Portion<'_>| {
            let first = portion.first;
            let events = self.judge_portion(before, after, portion);
            let mut found = found.lock().unwrap_or_else(PoisonError::into_inner);
            found.push((first, events));
        };
        match threads {
            Some(threads) if !alone => threads.0.share(portions, judge),
            _ => portions.for_each(judge),
        }
        let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
        found.sort_unstable_by_key(|(first, _)| *first);
        let mut events = Vec::new();
        for (_, some) in found {
            events.extend(some?);
        }
        Ok(events)
    }

    fn judge_portion(
        &self,
        before: &[f32],
        after: &[f32],
        portion: Portion<'_>,
    ) -> Result<Vec<f32>, RefereeError> {
        let mut decisions = Decisions::default();
        let mut events = Vec::new();
        let games = portion.game.chunks_exact_mut(self.game_size);
        let restarts = portion.restart.chunks_exact_mut(self.row_size);
        let each = games.zip(restarts).zip(portion.restarts);
        for (world, ((game_row, restart), restarts)) in each.enumerate() {
            let world = portion.first + world;
            let row = world * self.row_size..(world + 1) * self.row_size;
            let mut game = Game::read(game_row)?;
            let (before, after) = (&before[row.clone()], &after[row]);
            self.referee.judge(before, after, &mut game, restart, &mut decisions)?;
            game.write(game_row);
            *restarts = decisions.restarts;
            for event in &decisions.events {
                events.extend(numbers(world, event));
            }
        }
        Ok(events)
    }
}

/// The numbers of an event.
#[allow(clippy::cast_precision_loss)] // small whole numbers
fn numbers(world: usize, event: &Event) -> [f32; EVENT] {
    let index = |index: Option<usize>| index.map_or(-1.0, |index| index as f32);
    [
        world as f32,
        f32::from(event.kind.code()),
        index(event.team.map(Team::index)),
        index(event.robot),
        event.position.x,
        event.position.y,
    ]
}

/// Columns of the state rows of matches.
fn layout(config: &SimConfig) -> PyResult<Layout> {
    let sim = &config.0;
    Layout::new(&BALL_COLUMNS, &ROBOT_COLUMNS, sim.blue.len(), sim.yellow.len()).map_err(invalid)
}

/// What the rules know of a configuration.
fn pitch(config: &SimConfig) -> Pitch {
    let sim = &config.0;
    let field = &sim.field;
    let radius = sim.robots().map(RobotModel::bounding_radius).fold(0.0, f32::max);
    Pitch {
        lines: Lines {
            half_length: field.half_length(),
            half_width: field.half_width(),
            half_goal_width: field.goal_width / 2.0,
            goal_height: field.goal_height,
            area_depth: field.goal_area_depth,
            half_area_width: field.goal_area_width / 2.0,
            inner_area_depth: field.inner_area_depth,
            half_inner_area_width: field.inner_area_width / 2.0,
            line_width: field.line_width,
            corner_leg: field.corner_leg,
            goal_wall_thickness: field.goal_wall_thickness,
            center_circle_radius: field.center_circle_radius,
            penalty_mark_distance: field.penalty_mark_distance,
            boundary_x: field.half_length() + field.goal_line_margin,
            boundary_y: field.half_width() + field.touch_line_margin,
            free_ball_x: field.free_ball_x,
            free_ball_y: field.free_ball_y,
        },
        robot_radius: radius,
        ball_radius: sim.ball.radius,
        time_step: sim.time_step,
    }
}

/// Returns the numbers and switches of a preset of the rules, as JSON.
#[pyfunction]
pub(crate) fn referee_preset(name: &str) -> PyResult<String> {
    let Some(preset) = RefereeConfig::preset(name) else {
        let known = RefereeConfig::PRESETS.join(", ");
        return Err(PyKeyError::new_err(format!("expected one of {known}, got {name:?}")));
    };
    serde_json::to_string(&preset).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Returns name, source, summary and function of each rule of a league.
#[pyfunction]
pub(crate) fn referee_rules(league: &str) -> PyResult<Vec<[&'static str; 4]>> {
    let league = match league {
        "ssl" => League::Ssl,
        "vsss" => League::Vsss,
        _ => {
            return Err(PyValueError::new_err(format!(
                "league: expected 'ssl' or 'vsss', got {league:?}"
            )));
        }
    };
    let rules = rules::of_league(league).iter();
    Ok(rules.map(|rule| [rule.name, rule.source, rule.summary, rule.function]).collect())
}

/// Names and numbers of commands, stages and kinds of events, for constants of the module.
pub(crate) fn names() -> [(&'static str, Vec<(&'static str, u16)>); 3] {
    let commands = COMMANDS.iter().map(|(_, code, name)| (*name, u16::from(*code)));
    let stages = (0..).zip(Stage::NAMES).map(|(code, name)| (name, code));
    let events = EventKind::ALL.iter().map(|(_, code, name)| (*name, *code));
    [("COMMANDS", commands.collect()), ("STAGES", stages.collect()), ("EVENT_KINDS", events.collect())]
}

fn invalid(error: RefereeError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
