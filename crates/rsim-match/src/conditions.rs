//! Physics and senses that differ from the models', by name.

use std::collections::BTreeMap;

use rsim_core::columns::{BALL_PARAMETERS, ROBOT_PARAMETERS};
use rsim_core::{Sensing, SimConfig};
use serde::{Deserialize, Serialize};

use crate::error::MatchError;

/// Conditions of a match. Nothing of it is the default: models as they are, robots that know the true state.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Conditions {
    /// Factors on numbers of the ball, by the names of [`BALL_PARAMETERS`].
    pub ball: BTreeMap<String, f32>,
    /// Factors on numbers of all robots, by the names of [`ROBOT_PARAMETERS`].
    pub robots: BTreeMap<String, f32>,
    /// Numbers of senses and commands, by the names of [`Sensing::numbers`]; others are 0.
    pub sensing: BTreeMap<String, f32>,
}

impl Conditions {
    /// Whether both teams forecast, whatever drives them.
    pub(crate) fn forecasts(&self) -> bool {
        self.sensing.get("forecast").is_some_and(|value| *value >= 0.5)
    }

    /// The senses, with a forecast for those who expect one; `None` if robots know the true state and obey
    /// exactly.
    ///
    /// # Errors
    /// An unknown name, or a number out of its range.
    pub(crate) fn senses(&self) -> Result<Option<Sensing>, MatchError> {
        let mut sensing = Sensing { name: "own".into(), ..Sensing::OFF };
        for (name, value) in &self.sensing {
            let Some(number) = sensing.number_mut(name) else {
                let known = Sensing::numbers().into_iter().map(|number| number.name);
                let known = known.collect::<Vec<_>>().join(", ");
                return Err(MatchError::argument("sensing", format!("one of {known}"), name));
            };
            *number = *value;
        }
        sensing.validate()?;
        let is_off = sensing.is_off();
        Ok((!is_off).then_some(Sensing { forecast: 1.0, ..sensing }))
    }

    /// Factors on the numbers of the ball and of each robot; `None` if all are 1.
    ///
    /// # Errors
    /// An unknown name. The world checks the factors.
    pub(crate) fn parameters(&self, config: &SimConfig) -> Result<Option<Vec<f32>>, MatchError> {
        if self.ball.is_empty() && self.robots.is_empty() {
            return Ok(None);
        }
        let mut parameters = factors("ball", &BALL_PARAMETERS, &self.ball)?;
        let of_robot = factors("robots", &ROBOT_PARAMETERS, &self.robots)?;
        parameters.extend(of_robot.repeat(config.n_robots()));
        Ok(Some(parameters))
    }
}

fn factors(
    what: &'static str,
    names: &[&str],
    given: &BTreeMap<String, f32>,
) -> Result<Vec<f32>, MatchError> {
    if let Some(name) = given.keys().find(|name| !names.contains(&name.as_str())) {
        return Err(MatchError::argument(what, format!("factors on {}", names.join(", ")), name));
    }
    Ok(names.iter().map(|name| given.get(*name).copied().unwrap_or(1.0)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str, value: f32) -> BTreeMap<String, f32> {
        BTreeMap::from([(name.to_owned(), value)])
    }

    #[test]
    fn nothing_is_the_models_and_the_true_state() {
        let conditions = Conditions::default();
        assert_eq!(conditions.senses().expect("valid"), None);
        assert_eq!(conditions.parameters(&SimConfig::vss(1, 1)).expect("valid"), None);
    }

    #[test]
    fn numbers_come_by_name_and_wrong_ones_are_named() {
        let conditions = Conditions {
            ball: named("rolling_deceleration", 2.0),
            robots: named("mass", 0.5),
            sensing: named("delay", 0.1),
        };
        let sensing = conditions.senses().expect("valid").expect("a delay");
        assert!((sensing.delay - 0.1).abs() < 1e-9);
        let config = SimConfig::vss(1, 2);
        let parameters = conditions.parameters(&config).expect("valid").expect("factors");
        assert_eq!(parameters.len(), config.parameters_size());
        assert!((parameters[2] - 2.0).abs() < 1e-9 && (parameters[8] - 0.5).abs() < 1e-9);
        let wrong = Conditions { sensing: named("lag", 0.1), ..Conditions::default() };
        let error = wrong.senses().expect_err("no such number").to_string();
        assert!(error.contains("sensing") && error.contains("lag"), "{error}");
        let wrong = Conditions { robots: named("color", 2.0), ..Conditions::default() };
        let error = wrong.parameters(&config).expect_err("no such number").to_string();
        assert!(error.contains("robots") && error.contains("color"), "{error}");
        let wrong = Conditions { sensing: named("frame_loss", 2.0), ..Conditions::default() };
        assert!(wrong.senses().is_err());
    }
}
