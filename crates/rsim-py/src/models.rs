//! Fields, robots and balls: frozen mirrors of the core's data, by preset or by numbers.

use pyo3::exceptions::{PyAttributeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple, PyType};
use rsim_core::{Body, DifferentialDrive, Drive, Mouth, OmniDrive};

use crate::config::invalid;

/// A preset by its name, or a model.
#[derive(FromPyObject)]
pub(crate) enum Named<T> {
    Preset(String),
    Model(T),
}

/// Something that has presets.
pub(crate) trait Preset: Sized {
    fn preset(name: &str) -> PyResult<Self>;
}

impl<T: Preset> Named<T> {
    pub(crate) fn found(self) -> PyResult<T> {
        match self {
            Self::Preset(name) => T::preset(&name),
            Self::Model(model) => Ok(model),
        }
    }
}

/// The double that prints like this float: 0.005 and not 0.004999999888241291.
pub(crate) fn shortest(value: f32) -> f64 {
    value.to_string().parse().expect("a printed float is a float")
}

/// A frozen Python class around a struct of the core: a preset whose numbers can be replaced, with a
/// getter for each number. A number is where its expression says, if this model has it at all.
macro_rules! mirror {
    ($name:ident, $core:ty, $doc:literal, $it:ident, { $($number:ident: $place:expr,)* }, { $($extra:tt)* }) => {
        #[doc = $doc]
        #[pyclass(frozen, eq, from_py_object, module = "rsoccer._core")]
        #[derive(Clone, PartialEq)]
        pub(crate) struct $name(pub(crate) $core);

        impl Preset for $name {
            fn preset(name: &str) -> PyResult<Self> {
                Ok(Self(<$core>::preset(name).map_err(invalid)?))
            }
        }

        impl $name {
            const NUMBERS: &[&str] = &[$(stringify!($number)),*];

            /// Where a number is kept.
            fn place<'a>($it: &'a mut $core, number: &str) -> Option<&'a mut f32> {
                match number {
                    $(stringify!($number) => $place,)*
                    _ => None,
                }
            }

            fn number(&self, number: &str) -> PyResult<f64> {
                let mut model = self.0.clone();
                let found = Self::place(&mut model, number).map(|value| shortest(*value));
                found.ok_or_else(|| {
                    PyAttributeError::new_err(format!("{} has no {number}", self.0.name))
                })
            }

            /// With some of its numbers replaced.
            fn with(mut self, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
                for (key, value) in numbers.into_iter().flatten() {
                    let key: String = key.extract()?;
                    let place = Self::place(&mut self.0, &key);
                    let Some(place) = place else {
                        let model = self.0.clone();
                        let has = |number: &&&str| Self::place(&mut model.clone(), number).is_some();
                        let valid: Vec<&str> = Self::NUMBERS.iter().filter(has).copied().collect();
                        return Err(PyValueError::new_err(format!(
                            "{} has no {key:?}; its numbers are {}", self.0.name, valid.join(", ")
                        )));
                    };
                    *place = value.extract()?;
                }
                self.0.validate().map_err(invalid)?;
                Ok(self)
            }
        }

        #[pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = (name, **numbers))]
            fn new(name: &str, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
                Self::preset(name)?.with(numbers)
            }

            #[classattr]
            #[pyo3(name = "PRESETS")]
            fn presets(py: Python<'_>) -> PyResult<Bound<'_, PyTuple>> {
                PyTuple::new(py, <$core>::PRESETS.iter().map(|preset| &*preset.name))
            }

            #[getter]
            fn name(&self) -> &str {
                &self.0.name
            }

            $(#[getter]
            fn $number(&self) -> PyResult<f64> {
                self.number(stringify!($number))
            })*

            $($extra)*

            fn to_json(&self) -> String {
                serde_json::to_string(&self.0).expect("plain data always encodes")
            }

            #[classmethod]
            fn from_json(_class: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
                let model: $core = serde_json::from_str(text).map_err(|error| {
                    PyValueError::new_err(format!("text is not a {}: {error}", stringify!($name)))
                })?;
                Self(model).with(None)
            }

            fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<(Bound<'py, PyAny>, (String,))> {
                Ok((py.get_type::<Self>().getattr("from_json")?, (self.to_json(),)))
            }

            fn __repr__(&self) -> String {
                format!("{:?}", self.0)
            }
        }
    };
}

mirror!(
    Field,
    rsim_core::Field,
    "A field: play area, goals, walls, lines and marks. Metres.",
    it,
    {
        length: Some(&mut it.length),
        width: Some(&mut it.width),
        goal_line_margin: Some(&mut it.goal_line_margin),
        touch_line_margin: Some(&mut it.touch_line_margin),
        goal_width: Some(&mut it.goal_width),
        goal_depth: Some(&mut it.goal_depth),
        goal_height: Some(&mut it.goal_height),
        goal_wall: Some(&mut it.goal_wall),
        corner: Some(&mut it.corner),
        wall_height: Some(&mut it.wall_height),
        center_radius: Some(&mut it.center_radius),
        goal_area_width: Some(&mut it.goal_area_width),
        goal_area_depth: Some(&mut it.goal_area_depth),
        inner_area_width: Some(&mut it.inner_area_width),
        inner_area_depth: Some(&mut it.inner_area_depth),
        area_arc_width: Some(&mut it.area_arc_width),
        area_arc_depth: Some(&mut it.area_arc_depth),
        penalty_mark: Some(&mut it.penalty_mark),
        free_ball_x: Some(&mut it.free_ball_x),
        free_ball_y: Some(&mut it.free_ball_y),
        line_width: Some(&mut it.line_width),
    },
    {
        #[getter]
        fn half_length(&self) -> f64 {
            shortest(self.0.half_length())
        }

        #[getter]
        fn half_width(&self) -> f64 {
            shortest(self.0.half_width())
        }

        #[getter]
        fn reach_x(&self) -> f64 {
            shortest(self.0.reach_x())
        }

        #[getter]
        fn reach_y(&self) -> f64 {
            shortest(self.0.reach_y())
        }

        #[getter]
        fn max_robots(&self) -> usize {
            self.0.max_robots
        }
    }
);

mirror!(
    BallModel,
    rsim_core::BallModel,
    "A ball and what it rolls on and hits. SI units.",
    it,
    {
        radius: Some(&mut it.radius),
        mass: Some(&mut it.mass),
        sliding_deceleration: Some(&mut it.sliding_deceleration),
        rolling_deceleration: Some(&mut it.rolling_deceleration),
        rolling_share: Some(&mut it.rolling_share),
        spin_deceleration: Some(&mut it.spin_deceleration),
        hop_first: Some(&mut it.hop.first),
        hop_later: Some(&mut it.hop.later),
        hop_up: Some(&mut it.hop.up),
        robot_restitution: Some(&mut it.robot.restitution),
        robot_friction: Some(&mut it.robot.friction),
        wall_restitution: Some(&mut it.wall.restitution),
        wall_friction: Some(&mut it.wall.friction),
        goal_back_restitution: Some(&mut it.goal_back.restitution),
        goal_back_friction: Some(&mut it.goal_back.friction),
    },
    {}
);

mirror!(
    RobotModel,
    rsim_core::RobotModel,
    "A robot as data. SI units.",
    it,
    {
        side: side(&mut it.body),
        radius: radius(&mut it.body),
        front: front(&mut it.body),
        height: Some(&mut it.height),
        mass: Some(&mut it.mass),
        restitution: Some(&mut it.restitution),
        friction: Some(&mut it.friction),
        wheel_radius: Some(match &mut it.drive {
            Drive::Differential(drive) => &mut drive.wheel_radius,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => &mut drive.wheel_radius,
        }),
        max_wheel_speed: Some(match &mut it.drive {
            Drive::Differential(drive) => &mut drive.max_wheel_speed,
            Drive::Omni(drive) | Drive::OmniWheels(drive) => &mut drive.max_wheel_speed,
        }),
        track: differential(&mut it.drive).map(|drive| &mut drive.track),
        motor_torque: differential(&mut it.drive).map(|drive| &mut drive.motor_torque),
        forward_grip: differential(&mut it.drive).map(|drive| &mut drive.forward_grip),
        side_grip: differential(&mut it.drive).map(|drive| &mut drive.side_grip),
        wheel_distance: omni(&mut it.drive).map(|drive| &mut drive.wheel_distance),
        max_speed: omni(&mut it.drive).map(|drive| &mut drive.max_speed),
        max_turn_rate: omni(&mut it.drive).map(|drive| &mut drive.max_turn_rate),
        speed_up: omni(&mut it.drive).map(|drive| &mut drive.speed_up),
        brake: omni(&mut it.drive).map(|drive| &mut drive.brake),
        turn_speed_up: omni(&mut it.drive).map(|drive| &mut drive.turn_speed_up),
        turn_brake: omni(&mut it.drive).map(|drive| &mut drive.turn_brake),
        traction: omni(&mut it.drive).map(|drive| &mut drive.traction),
        jerk: omni(&mut it.drive).map(|drive| &mut drive.jerk),
        mouth_width: mouth(&mut it.mouth).map(|mouth| &mut mouth.width),
        beam_distance: mouth(&mut it.mouth).map(|mouth| &mut mouth.beam_distance),
        beam_height: mouth(&mut it.mouth).map(|mouth| &mut mouth.beam_height),
        max_kick: mouth(&mut it.mouth).map(|mouth| &mut mouth.max_kick),
        max_chip: mouth(&mut it.mouth).map(|mouth| &mut mouth.max_chip),
        recharge: mouth(&mut it.mouth).map(|mouth| &mut mouth.recharge),
        kick_keeps: mouth(&mut it.mouth).map(|mouth| &mut mouth.kick_keeps),
        grip: mouth(&mut it.mouth).map(|mouth| &mut mouth.grip),
        bar_force: mouth(&mut it.mouth).map(|mouth| &mut mouth.bar_force),
        bar_speed: mouth(&mut it.mouth).map(|mouth| &mut mouth.bar_speed),
        bar_restitution: mouth(&mut it.mouth).map(|mouth| &mut mouth.bar_restitution),
        bar_friction: mouth(&mut it.mouth).map(|mouth| &mut mouth.bar_friction),
    },
    {
        #[getter]
        fn bounding_radius(&self) -> f64 {
            shortest(self.0.bounding_radius())
        }

        #[getter]
        fn top_speed(&self) -> f64 {
            shortest(self.0.top_speed())
        }

        #[getter]
        fn top_turn_rate(&self) -> f64 {
            shortest(self.0.top_turn_rate())
        }

        #[getter]
        fn has_mouth(&self) -> bool {
            self.0.mouth.is_some()
        }

        #[getter]
        fn drive(&self) -> &'static str {
            match self.0.drive {
                Drive::Differential(_) => "differential",
                Drive::Omni(_) => "omni",
                Drive::OmniWheels(_) => "omni_wheels",
            }
        }

        #[getter]
        fn wheel_angles(&self) -> PyResult<[f64; 4]> {
            let angles = omni(&mut self.0.drive.clone()).map(|drive| drive.wheel_angles);
            let angles = angles.map(|angles| angles.map(shortest));
            angles.ok_or_else(|| {
                PyAttributeError::new_err(format!("{} has no wheel_angles", self.0.name))
            })
        }

        #[getter]
        fn command_columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
            PyTuple::new(py, self.0.command_columns())
        }
    }
);

fn side(body: &mut Body) -> Option<&mut f32> {
    if let Body::Square { side } = body { Some(side) } else { None }
}

fn radius(body: &mut Body) -> Option<&mut f32> {
    if let Body::Round { radius, .. } = body { Some(radius) } else { None }
}

fn front(body: &mut Body) -> Option<&mut f32> {
    if let Body::Round { front, .. } = body { Some(front) } else { None }
}

fn differential(drive: &mut Drive) -> Option<&mut DifferentialDrive> {
    if let Drive::Differential(drive) = drive { Some(drive) } else { None }
}

fn omni(drive: &mut Drive) -> Option<&mut OmniDrive> {
    if let Drive::Omni(drive) | Drive::OmniWheels(drive) = drive { Some(drive) } else { None }
}

fn mouth(mouth: &mut Option<Mouth>) -> Option<&mut Mouth> {
    mouth.as_mut()
}
