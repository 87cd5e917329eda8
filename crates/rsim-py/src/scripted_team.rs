//! Scripted sides of SSL matches, for arrays of rows.

use std::sync::{Mutex, PoisonError};

use numpy::{Ix2, PyArray3, PyArrayMethods, PyReadwriteArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_referee::Team;
use rsim_referee::game::Game;
use rsim_teams::{COMMAND_COLUMNS, TACTICS};

use crate::arrays::{Rows, readable, sizes, values, writeable};
use crate::config::{SimConfig, of_argument};
use crate::threads::{Threads, write_rows};

/// Most worlds whose commands the caller's thread computes alone.
const ALONE: usize = 16;

/// Scripted side of SSL matches with the same field, robots and ball.
#[pyclass(frozen, module = "rsoccer._core")]
pub(crate) struct ScriptedTeam {
    team: rsim_teams::ScriptedTeam,
    config: SimConfig,
    skill: f32,
    sizes: [usize; 2],
    memory_size: usize,
    row_size: usize,
}

#[pymethods]
impl ScriptedTeam {
    #[new]
    fn new(#[pyo3(from_py_with = of_argument)] config: SimConfig, skill: f32) -> PyResult<Self> {
        let sim = &config.0;
        let (n_blue, n_yellow) = (sim.blue.len(), sim.yellow.len());
        let Some(robot) = sim.robots().next() else {
            return Err(PyValueError::new_err("config: expected robots, got none"));
        };
        let layout = rsim_match::layout(sim).map_err(invalid)?;
        let Some(team) = rsim_match::team_config(sim, layout, skill) else {
            let name = &robot.name;
            return Err(PyValueError::new_err(format!(
                "config: expected round robots with an omnidirectional drive and a mouth, got {name}"
            )));
        };
        let team = rsim_teams::ScriptedTeam::new(&team).map_err(invalid)?;
        let memory_size = team.memory_columns().len();
        let row_size = config.0.row_size();
        Ok(Self { team, config, skill, sizes: [n_blue, n_yellow], memory_size, row_size })
    }

    /// Number of columns of a team's memory.
    #[getter]
    fn memory_size(&self) -> usize {
        self.memory_size
    }

    /// Sets the memories of teams before their first step.
    #[pyo3(signature = (memory, seeds, tactics = None))]
    fn begin(
        &self,
        memory: &Bound<'_, PyAny>,
        seeds: Vec<u32>,
        tactics: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<()> {
        let mut memory: PyReadwriteArray<'_, f32, Ix2> =
            writeable("memory", memory, &[seeds.len(), self.memory_size])?;
        let numbers = TACTICS.len();
        let tactics: Option<Rows> = tactics
            .map(|tactics| readable("tactics", tactics, &[seeds.len(), numbers]))
            .transpose()?;
        let tactics = tactics.as_ref().map(values);
        let mut begun = vec![0.0; seeds.len() * self.memory_size];
        let each = begun.chunks_exact_mut(self.memory_size).zip(seeds);
        for (nth, (memory, seed)) in each.enumerate() {
            let own = tactics.as_ref().map(|all| &all[nth * numbers..][..numbers]);
            self.team.begin(memory, seed, own).map_err(invalid)?;
        }
        memory.as_slice_mut()?.copy_from_slice(&begun);
        Ok(())
    }

    /// Returns the commands of a team's robots.
    #[pyo3(signature = (rows, game, memory, team, threads = None))]
    fn commands<'py>(
        &self,
        py: Python<'py>,
        rows: &Bound<'py, PyAny>,
        game: &Bound<'py, PyAny>,
        memory: &Bound<'py, PyAny>,
        team: usize,
        threads: Option<&Threads>,
    ) -> PyResult<Bound<'py, PyArray3<f32>>> {
        let Some(side) = Team::BOTH.get(team) else {
            return Err(PyValueError::new_err(format!("team: expected 0 or 1, got {team}")));
        };
        let [n, _] = sizes::<2>("rows", rows)?;
        let rows: Rows = readable("rows", rows, &[n, self.row_size])?;
        let columns = Game::columns().len();
        let game: Rows = readable("game", game, &[n, columns])?;
        let mut memory: PyReadwriteArray<'_, f32, Ix2> =
            writeable("memory", memory, &[n, self.memory_size])?;
        let (rows, games) = (values(&rows), values(&game));
        let robots = self.sizes[team];
        let commands = PyArray3::zeros(py, [n, robots, COMMAND_COLUMNS.len()], false);
        if robots == 0 {
            return Ok(commands);
        }
        // Each world's memory and commands are written together, as one row.
        let numbers = self.memory_size + robots * COMMAND_COLUMNS.len();
        let mut both = vec![0.0; n * numbers];
        let memory = memory.as_slice_mut()?;
        for (both, memory) in
            both.chunks_exact_mut(numbers).zip(memory.chunks_exact(self.memory_size))
        {
            both[..self.memory_size].copy_from_slice(memory);
        }
        let failed = Mutex::new(None);
        write_rows(py, threads, &mut both, numbers, ALONE, |world, both| {
            let row = &rows[world * self.row_size..][..self.row_size];
            let (memory, out) = both.split_at_mut(self.memory_size);
            let acted = Game::read(&games[world * columns..][..columns])
                .map_err(|error| error.to_string())
                .and_then(|game| {
                    let acted = self.team.act(row, &game, *side, memory, out);
                    acted.map_err(|error| error.to_string())
                });
            if let Err(error) = acted {
                failed.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
            }
        });
        if let Some(error) = failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(PyValueError::new_err(error));
        }
        {
            let mut out = commands.readwrite();
            let outs = out.as_slice_mut()?.chunks_exact_mut(numbers - self.memory_size);
            let memories = memory.chunks_exact_mut(self.memory_size);
            for (both, (memory, out)) in both.chunks_exact(numbers).zip(memories.zip(outs)) {
                memory.copy_from_slice(&both[..self.memory_size]);
                out.copy_from_slice(&both[self.memory_size..]);
            }
        }
        Ok(commands)
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> (Bound<'py, PyAny>, (SimConfig, f32)) {
        let Self { config, skill, .. } = slf.get();
        (slf.get_type().into_any(), (config.clone(), *skill))
    }
}

fn invalid(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}
