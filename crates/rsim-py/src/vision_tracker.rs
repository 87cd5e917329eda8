//! Tracker: from detections of cameras to states.

use numpy::{Ix2, PyReadonlyArray};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rsim_core::SeenRobot;

use crate::arrays::{RowsOut, finite, readable, sizes, values, writeable};
use crate::config::{SimConfig, invalid, of_argument};

/// Columns of a detected robot: index, position, cosine and sine of the heading.
const ROBOT_COLUMNS: usize = 5;

/// Estimates of all bodies from detections of cameras.
#[pyclass(module = "rsoccer._core")]
pub(crate) struct VisionTracker(rsim_core::VisionTracker);

/// Numbers of detected bodies, and commands.
type Detected<'py> = PyReadonlyArray<'py, f32, Ix2>;
type Commands<'py> = PyReadonlyArray<'py, f32, Ix2>;

#[pymethods]
impl VisionTracker {
    #[new]
    #[pyo3(signature = (config))]
    fn new(#[pyo3(from_py_with = of_argument)] config: SimConfig) -> PyResult<Self> {
        rsim_core::VisionTracker::new(&config.0).map(Self).map_err(invalid)
    }

    #[getter]
    fn config(&self) -> SimConfig {
        SimConfig(self.0.config().clone())
    }

    #[getter]
    fn time(&self) -> Option<f64> {
        self.0.time()
    }

    #[getter]
    fn has_ball(&self) -> bool {
        self.0.has_ball()
    }

    #[getter]
    fn robots_in_sight(&self) -> Vec<usize> {
        (0..self.0.config().n_robots()).filter(|&robot| self.0.has_robot(robot)).collect()
    }

    #[pyo3(signature = (time, balls, robots, cut = None, camera = 0))]
    fn take(
        &mut self,
        time: f64,
        balls: &Bound<'_, PyAny>,
        robots: &Bound<'_, PyAny>,
        cut: Option<Vec<usize>>,
        camera: i64,
    ) -> PyResult<bool> {
        finite_time(time)?;
        let camera = u8::try_from(camera).map_err(|_| {
            PyValueError::new_err(format!("camera must be from 0 to 255, got {camera}"))
        })?;
        let balls = numbers("balls", balls, 2)?;
        let balls: Vec<[f32; 2]> = balls.chunks_exact(2).map(|ball| [ball[0], ball[1]]).collect();
        let seen = numbers("robots", robots, ROBOT_COLUMNS)?;
        let robots = seen.chunks_exact(ROBOT_COLUMNS).map(|columns| self.robot(columns));
        let robots = robots.collect::<PyResult<Vec<SeenRobot>>>()?;
        let cut = cut.map(|cut| self.bits("cut", &cut)).transpose()?;
        Ok(self.0.take(camera, time, &balls, &robots, cut))
    }

    fn send(
        &mut self,
        time: f64,
        commands: &Bound<'_, PyAny>,
        robots: Vec<usize>,
    ) -> PyResult<bool> {
        finite_time(time)?;
        let (count, columns) = (self.0.config().n_robots(), self.0.config().command_columns());
        let commands: Commands = readable("commands", commands, &[count, columns])?;
        let commands = values(&commands);
        finite("commands", &commands)?;
        let robots = self.bits("robots", &robots)?;
        Ok(self.0.send(time, &commands, robots))
    }

    #[pyo3(signature = (out, robots = None))]
    fn read(&self, out: &Bound<'_, PyAny>, robots: Option<Vec<usize>>) -> PyResult<()> {
        let known = robots.map_or(Ok(u64::MAX), |robots| self.bits("robots", &robots))?;
        let mut out: RowsOut = writeable("out", out, &[1, self.0.config().row_size()])?;
        self.0.write_row(known, out.as_slice_mut()?);
        Ok(())
    }

    fn __repr__(&self) -> String {
        let robots = self.0.config().n_robots();
        let time = self.0.time().map_or_else(|| "None".to_owned(), |time| format!("{time:?}"));
        format!("VisionTracker({robots} robots, time={time})")
    }
}

impl VisionTracker {
    /// A bit for each robot of a list.
    fn bits(&self, name: &str, robots: &[usize]) -> PyResult<u64> {
        let count = self.0.config().n_robots();
        if let Some(robot) = robots.iter().find(|&&robot| robot >= count) {
            return Err(PyValueError::new_err(format!(
                "{name} must have indices from 0 to {}, got {robot}",
                count.saturating_sub(1)
            )));
        }
        Ok(robots.iter().fold(0, |bits, robot| bits | 1 << robot))
    }

    /// A detected robot.
    fn robot(&self, columns: &[f32]) -> PyResult<SeenRobot> {
        let [index, x, y, cos, sin] = columns else { unreachable!("the shape has been checked") };
        let count = self.0.config().n_robots();
        let Some(robot) = (0..count).find(|&robot| is_number(robot, *index)) else {
            return Err(PyValueError::new_err(format!(
                "robots must have indices from 0 to {}, got {index}",
                count.saturating_sub(1)
            )));
        };
        let length = f64::from(*cos).hypot(f64::from(*sin));
        if length.is_nan() || length < 1e-3 {
            return Err(PyValueError::new_err(format!(
                "robots must have headings of a length above 0, got {cos}, {sin}"
            )));
        }
        // The square of a long one would be infinite. One of about 1 keeps its bits.
        let heading = [*cos, *sin].map(|part| {
            #[expect(clippy::cast_possible_truncation, reason = "at most 1")]
            let scaled = (f64::from(part) / length) as f32;
            if (0.5..2.0).contains(&length) { part } else { scaled }
        });
        Ok(SeenRobot { robot, position: [*x, *y], heading })
    }
}

/// Refuses a time that is not finite.
fn finite_time(time: f64) -> PyResult<()> {
    if time.is_finite() {
        return Ok(());
    }
    Err(PyValueError::new_err(format!("time must be finite, got {time}")))
}

/// Whether a number is an index.
#[expect(clippy::cast_precision_loss, clippy::float_cmp, reason = "at most 22 robots")]
fn is_number(robot: usize, number: f32) -> bool {
    robot as f32 == number
}

/// Checks an array of detected bodies with these columns.
fn numbers(name: &str, value: &Bound<'_, PyAny>, columns: usize) -> PyResult<Vec<f32>> {
    let [count, _] = sizes::<2>(name, value)?;
    let array: Detected = readable(name, value, &[count, columns])?;
    let array = values(&array).into_owned();
    finite(name, &array)?;
    Ok(array)
}
