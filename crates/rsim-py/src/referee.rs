//! The referee of many matches: judges the steps of all worlds.

use std::sync::{Mutex, PoisonError};

use numpy::{Ix2, PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadwriteArray};
use pyo3::exceptions::{PyKeyError, PyValueError};
use pyo3::prelude::*;
use rsim_referee::codes::{COMMANDS, Stage};
use rsim_referee::config::{League, RefereeConfig};
use rsim_referee::events::{Event, EventKind};
use rsim_referee::features::FEATURES;
use rsim_referee::game::Game;
use rsim_referee::statistics::{Statistics, count_offense, offense_columns};
use rsim_referee::{Decisions, RefereeError, Team, rules};

use crate::arrays::{Rows, readable, sizes, values, writeable};
use crate::config::{SimConfig, of_argument};
use crate::match_arrays::{MatchArrays, Matches, Sizes};
use crate::threads::{Threads, write_rows};

/// Most worlds whose steps the caller's thread judges alone.
const ALONE: usize = 64;

/// Most events of a world in a step that are listed; statistics count all.
pub(crate) const MAX_EVENTS: usize = 32;

/// Numbers of an event: world, kind, team, robot, x, y.
const EVENT: usize = 6;

/// Referee of matches with the same rules, field and robots.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct Referee {
    judge: rsim_referee::Referee,
    rules: String,
    config: SimConfig,
    sizes: Sizes,
}

/// Worlds in which play restarts, and events (k, 6); `None` where there are none.
type Judged<'py> = (Option<Bound<'py, PyArray1<bool>>>, Option<Bound<'py, PyArray2<f32>>>);

/// Work of a thread: some matches, and what is decided of them.
struct Portion<'a> {
    /// Index of the first world.
    first: usize,
    matches: Matches<'a>,
    restart: &'a mut [f32],
    restarts: &'a mut [bool],
}

#[pymethods]
impl Referee {
    #[new]
    fn new(#[pyo3(from_py_with = of_argument)] config: SimConfig, rules: String) -> PyResult<Self> {
        let decoded: RefereeConfig = serde_json::from_str(&rules)
            .map_err(|error| PyValueError::new_err(format!("rules: {error}")))?;
        let layout = rsim_match::layout(&config.0).map_err(invalid)?;
        let pitch = rsim_match::pitch(&config.0);
        let counted = Statistics::columns().len();
        let sizes = Sizes {
            game: Game::columns().len(),
            counted,
            statistics: counted + offense_columns().len(),
            robots: layout.robots(),
            row: layout.row_size(),
        };
        let judge = rsim_referee::Referee::new(decoded, pitch, layout).map_err(invalid)?;
        Ok(Self { judge, rules, config, sizes })
    }

    /// Returns the row of a match whose first kick-off a team has.
    #[staticmethod]
    fn new_game(py: Python<'_>, kickoff: usize) -> PyResult<Bound<'_, PyArray1<f32>>> {
        let Some(team) = Team::BOTH.get(kickoff) else {
            return Err(PyValueError::new_err(format!("kickoff: expected 0 or 1, got {kickoff}")));
        };
        Ok(PyArray1::from_vec(py, Game::new(*team).row()))
    }

    /// Puts robots and ball where matches begin. Seeds draw the errors of the places.
    fn line_up(&self, rows: &Bound<'_, PyAny>, seeds: Vec<u32>) -> PyResult<()> {
        let [n, _] = sizes::<2>("rows", rows)?;
        if seeds.len() != n {
            let got = seeds.len();
            return Err(PyValueError::new_err(format!("seeds: expected {n} numbers, got {got}")));
        }
        let mut rows: PyReadwriteArray<'_, f32, Ix2> =
            writeable("rows", rows, &[n, self.sizes.row])?;
        let rows = rows.as_slice_mut()?.chunks_exact_mut(self.sizes.row);
        for (row, seed) in rows.zip(seeds) {
            self.judge.line_up(row, seed).map_err(invalid)?;
        }
        Ok(())
    }

    /// Returns what robots observe of the state of their matches.
    #[pyo3(signature = (game, rows, observers, threads = None))]
    fn features<'py>(
        &self,
        py: Python<'py>,
        game: &Bound<'py, PyAny>,
        rows: &Bound<'py, PyAny>,
        observers: Vec<usize>,
        threads: Option<&Threads>,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let [n, _] = sizes::<2>("rows", rows)?;
        let game: Rows = readable("game", game, &[n, self.sizes.game])?;
        let rows: Rows = readable("rows", rows, &[n, self.sizes.row])?;
        let robots = self.judge.layout().robots();
        if let Some(robot) = observers.iter().find(|robot| **robot >= robots) {
            return Err(PyValueError::new_err(format!(
                "observers: expected robots below {robots}, got {robot}"
            )));
        }
        let games = values(&game);
        let games: Vec<Game> = games
            .chunks_exact(self.sizes.game)
            .map(Game::read)
            .collect::<Result<_, _>>()
            .map_err(invalid)?;
        let rows = values(&rows);
        let size = observers.len() * FEATURES.len();
        let features = PyArray3::zeros(py, [n, observers.len(), FEATURES.len()], false);
        {
            let mut out = features.readwrite();
            write_rows(py, threads, out.as_slice_mut()?, size, ALONE, |world, out| {
                let row = &rows[world * self.sizes.row..][..self.sizes.row];
                let Ok(features) = self.judge.features(&games[world], row) else { return };
                for (robot, out) in observers.iter().zip(out.chunks_exact_mut(FEATURES.len())) {
                    features.write(*robot, out);
                }
            });
        }
        Ok(features)
    }

    /// Fits matches to the states from which play begins or goes on.
    fn begin(&self, rows: &Bound<'_, PyAny>, matches: MatchArrays<'_>) -> PyResult<()> {
        let [n, _] = sizes::<2>("rows", rows)?;
        let rows: Rows = readable("rows", rows, &[n, self.sizes.row])?;
        let mut borrowed = matches.borrow(n, &self.sizes)?;
        let rows = values(&rows);
        let each = borrowed.matches()?.split(1, &self.sizes);
        for (mut one, row) in each.zip(rows.chunks_exact(self.sizes.row)) {
            let mut game = one.read().map_err(invalid)?;
            self.judge.begin(row, &mut game).map_err(invalid)?;
            one.write(&game, &self.judge);
        }
        Ok(())
    }

    /// Judges a step of all matches.
    #[pyo3(signature = (before, after, matches, restart, threads = None))]
    fn judge<'py>(
        &self,
        py: Python<'py>,
        before: &Bound<'py, PyAny>,
        after: &Bound<'py, PyAny>,
        matches: MatchArrays<'py>,
        restart: &Bound<'py, PyAny>,
        threads: Option<&Threads>,
    ) -> PyResult<Judged<'py>> {
        let [n, _] = sizes::<2>("after", after)?;
        let before: Rows = readable("before", before, &[n, self.sizes.row])?;
        let after: Rows = readable("after", after, &[n, self.sizes.row])?;
        let mut borrowed = matches.borrow(n, &self.sizes)?;
        let mut restart: PyReadwriteArray<'_, f32, Ix2> =
            writeable("restart", restart, &[n, self.sizes.row])?;
        let (before, after) = (values(&before), values(&after));
        let mut restarts = vec![false; n];
        let all = Portion {
            first: 0,
            matches: borrowed.matches()?,
            restart: restart.as_slice_mut()?,
            restarts: &mut restarts,
        };
        let found = py.detach(|| self.judge_all(&before, &after, all, threads));
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

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (SimConfig, String)) {
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
        all: Portion<'_>,
        threads: Option<&Threads>,
    ) -> Result<Vec<f32>, RefereeError> {
        let n = all.restarts.len();
        let threads = match threads {
            Some(threads) if threads.0.count() > 1 && n > ALONE => &threads.0,
            _ => return self.judge_portion(before, after, all),
        };
        let size = threads.portion(n, 1, ALONE);
        let matches = all.matches.split(size, &self.sizes);
        let portions = matches
            .zip(all.restart.chunks_mut(size * self.sizes.row))
            .zip(all.restarts.chunks_mut(size))
            .enumerate()
            .map(|(nth, ((matches, restart), restarts))| Portion {
                first: nth * size,
                matches,
                restart,
                restarts,
            });
        let found = Mutex::new(Vec::new());
        threads.share(portions, |portion| {
            let first = portion.first;
            let events = self.judge_portion(before, after, portion);
            found.lock().unwrap_or_else(PoisonError::into_inner).push((first, events));
        });
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
        let each = portion
            .matches
            .split(1, &self.sizes)
            .zip(portion.restart.chunks_exact_mut(self.sizes.row))
            .zip(portion.restarts);
        for (world, ((mut one, restart), restarts)) in each.enumerate() {
            let world = portion.first + world;
            let row = world * self.sizes.row..(world + 1) * self.sizes.row;
            let (before, after) = (&before[row.clone()], &after[row]);
            let mut game = one.read()?;
            let (columns, offenses) = one.statistics.split_at_mut(self.sizes.counted);
            let mut statistics = Statistics::read(columns)?;
            self.judge.judge(before, after, &mut game, &mut statistics, restart, &mut decisions)?;
            statistics.write(columns);
            decisions.rulings.iter().for_each(|ruling| count_offense(offenses, ruling));
            one.write(&game, &self.judge);
            *restarts = decisions.restarts;
            for event in decisions.events.iter().take(MAX_EVENTS) {
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

/// Returns the numbers and switches of a preset of the rules, as JSON.
#[pyfunction]
pub(crate) fn referee_preset(name: &str) -> PyResult<String> {
    let Some(preset) = RefereeConfig::preset(name) else {
        let known = RefereeConfig::PRESETS.join(", ");
        return Err(PyKeyError::new_err(format!("name: expected one of {known}, got {name:?}")));
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

/// Returns name, unit and meaning of each value of a `RefereeConfig`; choices have no unit.
#[pyfunction]
pub(crate) fn referee_values() -> Vec<[&'static str; 3]> {
    let choices = RefereeConfig::CHOICES.iter().map(|(name, meaning)| [*name, "", meaning.trim()]);
    let numbers =
        RefereeConfig::NUMBERS.iter().map(|(name, unit, meaning)| [*name, *unit, meaning.trim()]);
    choices.chain(numbers).collect()
}

/// Names and numbers of commands, stages and kinds of events, for constants of the module.
pub(crate) fn names() -> [(&'static str, Vec<(&'static str, u16)>); 3] {
    let commands = COMMANDS.iter().map(|(_, code, name)| (*name, u16::from(*code)));
    let stages = (0..).zip(Stage::NAMES).map(|(code, name)| (name, code));
    let events = EventKind::ALL.iter().map(|(_, code, name)| (*name, *code));
    [
        ("COMMANDS", commands.collect()),
        ("STAGES", stages.collect()),
        ("EVENT_KINDS", events.collect()),
    ]
}

fn invalid(error: RefereeError) -> PyErr {
    PyValueError::new_err(error.to_string())
}
