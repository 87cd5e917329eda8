//! The Python module `rsoccer._core`: checks arguments, releases the GIL, delegates to `rsim-core`.
//! The rules are in the core.
#![deny(unsafe_code)]
#![allow(clippy::needless_pass_by_value)] // PyO3 hands arrays over by value

mod arguments;
mod arrays;
mod bounds;
mod config;
mod ego_features;
mod forecaster;
mod json;
mod match_arrays;
mod models;
mod moments;
mod referee;
mod scripted_team;
mod shaping;
mod shields;
mod simulator;
mod steering;
mod streams;
mod threads;
mod viewpoint;
mod vision_tracker;

use pyo3::prelude::*;

/// Physics of robot soccer.
#[pymodule]
mod _core {
    #[pymodule_export]
    use crate::bounds::{clip_actions, clip_in_place, write_clipped};
    #[pymodule_export]
    use crate::config::SimConfig;
    #[pymodule_export]
    use crate::ego_features::EgoFeatures;
    #[pymodule_export]
    use crate::forecaster::Forecaster;
    #[pymodule_export]
    use crate::models::{BallModel, Field, RobotModel, Sensing};
    #[pymodule_export]
    use crate::moments::{add_rewards, normalized, pooled_moments};
    #[pymodule_export]
    use crate::referee::{Referee, referee_preset, referee_rules, referee_values};
    #[pymodule_export]
    use crate::scripted_team::ScriptedTeam;
    #[pymodule_export]
    use crate::shaping::{Potential, mean_action_magnitude, nearest_to_ball};
    #[pymodule_export]
    use crate::shields::{AreaShield, AttackShield};
    #[pymodule_export]
    use crate::simulator::Simulator;
    #[pymodule_export]
    use crate::steering::Steering;
    #[pymodule_export]
    use crate::streams::{normal_inputs, random_words, uniform};
    #[pymodule_export]
    use crate::threads::Threads;
    #[pymodule_export]
    use crate::viewpoint::Viewpoint;
    #[pymodule_export]
    use crate::vision_tracker::VisionTracker;

    use pyo3::prelude::*;
    use pyo3::types::{PyDict, PyTuple};
    use rsim_core::columns;
    use rsim_referee::events::EventKind;
    use rsim_referee::features::FEATURES;
    use rsim_referee::game::Game;
    use rsim_referee::statistics::{OFFENSES, Statistics, offense_columns};
    use rsim_teams::TACTICS;

    use crate::models::add_numbers;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let py = module.py();
        add_numbers::<Field>(py)?;
        add_numbers::<BallModel>(py)?;
        add_numbers::<RobotModel>(py)?;
        add_numbers::<Sensing>(py)?;
        module.add("BALL_COLUMNS", PyTuple::new(py, columns::BALL_COLUMNS)?)?;
        module.add("ROBOT_COLUMNS", PyTuple::new(py, columns::ROBOT_COLUMNS)?)?;
        module.add("CROSSINGS", PyTuple::new(py, columns::CROSSINGS)?)?;
        let commands = PyDict::new(py);
        commands.set_item("differential", PyTuple::new(py, columns::DIFFERENTIAL_COLUMNS)?)?;
        commands.set_item("omni", PyTuple::new(py, columns::OMNI_COLUMNS)?)?;
        commands.set_item("omni_wheels", PyTuple::new(py, columns::OMNI_WHEELS_COLUMNS)?)?;
        for (table, names) in crate::referee::names() {
            let codes = PyDict::new(py);
            for (name, code) in names {
                codes.set_item(name, code)?;
            }
            module.add(table, codes)?;
        }
        module.add("GAME_COLUMNS", PyTuple::new(py, Game::columns())?)?;
        let tactics =
            TACTICS.map(|tactic| (tactic.name, tactic.default, tactic.least, tactic.most));
        module.add("TACTICS", PyTuple::new(py, tactics)?)?;
        module.add(
            "STATISTICS_COLUMNS",
            PyTuple::new(py, [Statistics::columns(), offense_columns()].concat())?,
        )?;
        module.add("OFFENSES", PyTuple::new(py, OFFENSES.map(EventKind::code))?)?;
        module.add("GAME_FEATURES", PyTuple::new(py, FEATURES)?)?;
        module.add("HAND_ERROR", rsim_referee::config::HAND_ERROR)?;
        module.add("MAX_EVENTS", crate::referee::MAX_EVENTS)?;
        module.add("BALL_PARAMETERS", PyTuple::new(py, columns::BALL_PARAMETERS)?)?;
        let sensing = rsim_core::Sensing::numbers().into_iter().map(|number| number.name);
        module.add("SENSING_NUMBERS", PyTuple::new(py, sensing.collect::<Vec<_>>())?)?;
        module.add("ROBOT_PARAMETERS", PyTuple::new(py, columns::ROBOT_PARAMETERS)?)?;
        module.add("COMMAND_COLUMNS", commands)?;
        module.add("MAX_PLACED_ANGULAR_VELOCITY", rsim_core::MAX_PLACED_ANGULAR_VELOCITY)?;
        module.add("MAX_PLACED_HEIGHT", rsim_core::MAX_PLACED_HEIGHT)?;
        module.add("MAX_PLACED_SPEED", rsim_core::MAX_PLACED_SPEED)?;
        module.add("MAX_PLACED_SPIN", rsim_core::MAX_PLACED_SPIN)
    }

    /// Return version, profile ("release" or "debug") and physics version of this build.
    #[pyfunction]
    fn build_info(py: Python<'_>) -> PyResult<Bound<'_, PyDict>> {
        let info = PyDict::new(py);
        info.set_item("version", env!("CARGO_PKG_VERSION"))?;
        info.set_item("profile", if cfg!(debug_assertions) { "debug" } else { "release" })?;
        info.set_item("physics", rsim_core::PHYSICS_VERSION)?;
        Ok(info)
    }

    /// Return the hashes of the golden scenes by name, which are the same for all builds.
    #[pyfunction]
    fn golden_hashes(py: Python<'_>) -> std::collections::BTreeMap<String, String> {
        py.detach(rsim_core::scenes::golden::hashes).into_iter().collect()
    }
}
