//! Trained policies: perceptrons with tanh layers, from policy files.
//!
//! `python/rsoccer/policies/policy_file.py` defines the format, and has the same checks.

use std::collections::BTreeMap;

use crate::error::MatchError;
use crate::files::{self, Array};

const FORMAT: &str = "rsoccer-policy-2";
/// Beginning of the names of the arrays of a value network.
const VALUE: &str = "value.";
/// Bound of `action_repeat`, control steps.
const MAX_ACTION_REPEAT: u32 = 1_000_000;
/// Most observations in a stacked one.
const MAX_HISTORY: u32 = 1000;
/// Names of the shields that a policy may have, of which the first alone acts in whole matches.
const SHIELDS: [&str; 2] = ["vsss", "ssl_attack"];
/// Products that are summed side by side.
const LANES: usize = 8;

/// A perceptron with the normalization of its observations, and how it acts.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    mean: Vec<f32>,
    std: Vec<f32>,
    clip: f32,
    layers: Vec<Layer>,
    action_std: Option<Vec<f32>>,
    action_repeat: u32,
    history: usize,
    layout: Option<String>,
    task: String,
    is_shielded: bool,
    needs_forecast: bool,
}

#[derive(Debug, Clone, PartialEq)]
struct Layer {
    inputs: usize,
    /// Row by row, each of `inputs` numbers.
    weight: Vec<f32>,
    bias: Vec<f32>,
}

impl Network {
    /// Reads a policy file.
    ///
    /// # Errors
    /// Other bytes, or arrays and metadata that do not fit together.
    pub fn read(bytes: &[u8]) -> Result<Self, MatchError> {
        let (mut arrays, metadata) = files::read(bytes)?;
        for (name, wanted) in [("format", FORMAT), ("activation", "tanh")] {
            let got = metadata.get(name).map_or("nothing", String::as_str);
            if got != wanted {
                return Err(wrong(&format!("metadata {name:?} should be {wanted:?}, got {got:?}")));
            }
        }
        let Some(task) = metadata.get("task").filter(|task| !task.is_empty()).cloned() else {
            return Err(wrong("metadata 'task' should name the task of the training, got nothing"));
        };
        let clip = number(&metadata, "clip", 10.0)?;
        let action_repeat = whole(&metadata, "action_repeat", MAX_ACTION_REPEAT)?;
        let history = whole(&metadata, "history", MAX_HISTORY)? as usize;
        let layers = read_layers(&mut arrays)?;
        let (inputs, actions) = (layers[0].inputs, layers[layers.len() - 1].bias.len());
        for (name, size) in [("observation_size", inputs), ("action_size", actions)] {
            let got = metadata.get(name).map_or("nothing", String::as_str);
            if got != size.to_string() {
                let message =
                    format!("metadata {name:?} should be {size} as the layers are shaped");
                return Err(wrong(&format!("{message}, got {got:?}")));
            }
        }
        let mean = take(&mut arrays, "mean", &[inputs])?;
        let std = above_zero("std", take(&mut arrays, "std", &[inputs])?)?;
        let action_std = if arrays.contains_key("action_std") {
            Some(above_zero("action_std", take(&mut arrays, "action_std", &[actions])?)?)
        } else {
            None
        };
        // Its value network is for a lookahead, which tries actions in Python alone.
        arrays.retain(|name, _| !name.starts_with(VALUE));
        if let Some(name) = arrays.keys().next() {
            return Err(wrong(&format!("unknown array {name:?}")));
        }
        let stacked = inputs.checked_sub((history - 1) * actions);
        if stacked.is_none_or(|plain| plain == 0 || plain % history != 0) {
            return Err(wrong(&format!(
                "metadata 'history' should fit the layers, which take {inputs} numbers, got {history}"
            )));
        }
        let layout = metadata.get("layout").cloned();
        let is_shielded = match metadata.get("shield").map(String::as_str) {
            None => false,
            Some(name) if SHIELDS.contains(&name) => name == SHIELDS[0],
            Some(got) => {
                let names = SHIELDS.join(" or ");
                return Err(wrong(&format!("metadata 'shield' should be {names}, got {got:?}")));
            }
        };
        let needs_forecast = needs_forecast(metadata.get("sensing"))?;
        Ok(Self {
            mean,
            std,
            clip,
            layers,
            action_std,
            action_repeat,
            history,
            layout,
            task,
            is_shielded,
            needs_forecast,
        })
    }

    /// Task of the training.
    pub fn task(&self) -> &str {
        &self.task
    }

    /// Whether an [`AreaShield`](crate::AreaShield) changes its actions in matches.
    pub fn is_shielded(&self) -> bool {
        self.is_shielded
    }

    /// Whether it plays from a forecast of the state in which its commands act.
    pub fn needs_forecast(&self) -> bool {
        self.needs_forecast
    }

    /// Observation blocks of the task, where the file names them.
    pub fn layout(&self) -> Option<&str> {
        self.layout.as_deref()
    }

    /// Numbers in an observation, a stacked one with a history.
    pub fn observation_size(&self) -> usize {
        self.mean.len()
    }

    /// Numbers in a plain observation.
    pub fn plain_size(&self) -> usize {
        (self.observation_size() - (self.history - 1) * self.action_size()) / self.history
    }

    /// Numbers in an action.
    pub fn action_size(&self) -> usize {
        self.layers.last().map_or(0, |layer| layer.bias.len())
    }

    /// Control steps for which an action is held.
    pub fn action_repeat(&self) -> u32 {
        self.action_repeat
    }

    /// Observations in a stacked one.
    pub fn history(&self) -> usize {
        self.history
    }

    /// Standard deviation of actions; `None` for a policy without noise.
    pub fn action_std(&self) -> Option<&[f32]> {
        self.action_std.as_deref()
    }

    /// Output of the last layer for an observation: the mean of the actions before they are clipped.
    ///
    /// # Panics
    /// If the observation has another length.
    pub fn means(&self, observation: &[f32]) -> Vec<f32> {
        assert_eq!(observation.len(), self.mean.len(), "numbers in an observation");
        let normalized = observation.iter().zip(&self.mean).zip(&self.std);
        let mut values: Vec<f32> = normalized
            .map(|((number, mean), std)| ((number - mean) / std).clamp(-self.clip, self.clip))
            .collect();
        let last = self.layers.len() - 1;
        for (nth, layer) in self.layers.iter().enumerate() {
            values = layer.outputs(&values);
            if nth < last {
                // Not the system's `tanh`, whose last bit differs between platforms.
                for value in &mut values {
                    *value = libm::tanhf(*value);
                }
            }
        }
        values
    }
}

impl Layer {
    fn outputs(&self, inputs: &[f32]) -> Vec<f32> {
        let rows = self.weight.chunks_exact(self.inputs);
        rows.zip(&self.bias).map(|(row, bias)| product(row, inputs) + bias).collect()
    }
}

/// Scalar product, with eight sums side by side: an order that compilers can keep in wide registers.
fn product(row: &[f32], inputs: &[f32]) -> f32 {
    let (rows, chunks) = (row.chunks_exact(LANES), inputs.chunks_exact(LANES));
    let rest = rows.remainder().iter().zip(chunks.remainder());
    let tail: f32 = rest.map(|(weight, input)| weight * input).sum();
    let mut sums = [0.0_f32; LANES];
    for (row, inputs) in rows.zip(chunks) {
        for ((sum, weight), input) in sums.iter_mut().zip(row).zip(inputs) {
            *sum += weight * input;
        }
    }
    sums.iter().sum::<f32>() + tail
}

fn read_layers(arrays: &mut BTreeMap<String, Array>) -> Result<Vec<Layer>, MatchError> {
    let mut layers: Vec<Layer> = Vec::new();
    while let Some(shape) =
        arrays.get(&format!("layers.{}.weight", layers.len())).map(|array| array.shape.clone())
    {
        let name = format!("layers.{}", layers.len());
        let &[outputs, inputs] = shape.as_slice() else {
            return Err(wrong(&format!("array \"{name}.weight\" should have two axes")));
        };
        if inputs == 0 || outputs == 0 {
            return Err(wrong(&format!("array \"{name}.weight\" has no numbers")));
        }
        if layers.last().is_some_and(|layer| layer.bias.len() != inputs) {
            return Err(wrong(&format!("{name}.weight takes other numbers than the layer before")));
        }
        let weight = take(arrays, &format!("{name}.weight"), &shape)?;
        let bias = take(arrays, &format!("{name}.bias"), &[outputs])?;
        layers.push(Layer { inputs, weight, bias });
    }
    if layers.is_empty() { Err(wrong("missing array \"layers.0.weight\"")) } else { Ok(layers) }
}

fn take(
    arrays: &mut BTreeMap<String, Array>,
    name: &str,
    shape: &[usize],
) -> Result<Vec<f32>, MatchError> {
    let Some(array) = arrays.remove(name) else {
        return Err(wrong(&format!("missing array {name:?}")));
    };
    if array.shape != shape {
        return Err(wrong(&format!("array {name:?} should be {shape:?}, got {:?}", array.shape)));
    }
    Ok(array.values)
}

fn above_zero(name: &str, values: Vec<f32>) -> Result<Vec<f32>, MatchError> {
    match values.iter().find(|value| **value <= 0.0) {
        Some(value) => Err(wrong(&format!("array {name:?} should be above 0, got {value}"))),
        None => Ok(values),
    }
}

fn number(
    metadata: &BTreeMap<String, String>,
    name: &str,
    default: f32,
) -> Result<f32, MatchError> {
    let Some(text) = metadata.get(name) else { return Ok(default) };
    match text.parse::<f32>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err(wrong(&format!(
            "metadata {name:?} should be a finite number above 0, got {text:?}"
        ))),
    }
}

fn whole(metadata: &BTreeMap<String, String>, name: &str, most: u32) -> Result<u32, MatchError> {
    let Some(text) = metadata.get(name) else { return Ok(1) };
    match text.parse::<u32>() {
        Ok(number) if (1..=most).contains(&number) => Ok(number),
        _ => Err(wrong(&format!(
            "metadata {name:?} should be a whole number from 1 to {most}, got {text:?}"
        ))),
    }
}

/// Whether senses of a policy file have a forecast. They are a JSON object of numbers, or the name of code, which
/// has none.
fn needs_forecast(sensing: Option<&String>) -> Result<bool, MatchError> {
    let Some(text) = sensing.filter(|text| text.starts_with('{')) else { return Ok(false) };
    let senses: serde_json::Value = serde_json::from_str(text)
        .map_err(|error| wrong(&format!("metadata 'sensing' should be JSON: {error}")))?;
    Ok(senses["forecast"].as_f64().is_some_and(|switch| switch >= 0.5))
}

fn wrong(message: &str) -> MatchError {
    MatchError::Policy(message.to_owned())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A policy file with a hidden layer, whose weights are small numbers by their place.
    pub(crate) fn file(inputs: usize, actions: usize, extra: &[(&str, &str)]) -> Vec<u8> {
        let hidden = 11;
        let some = |count: usize| -> Vec<f32> {
            (0..count).map(|nth| 0.1 * ((nth * 7 % 13) as f32 / 6.0 - 1.0)).collect()
        };
        let (o, a) = (inputs.to_string(), actions.to_string());
        let mut metadata = vec![
            ("format", FORMAT),
            ("activation", "tanh"),
            ("task", "Test-v0"),
            ("observation_size", &o),
            ("action_size", &a),
        ];
        metadata.extend(extra);
        files::tests::file(
            &[
                ("layers.0.weight", &[hidden, inputs], &some(hidden * inputs)),
                ("layers.0.bias", &[hidden], &some(hidden)),
                ("layers.1.weight", &[actions, hidden], &some(actions * hidden)),
                ("layers.1.bias", &[actions], &some(actions)),
                ("mean", &[inputs], &some(inputs)),
                ("std", &[inputs], &vec![0.5; inputs]),
                ("action_std", &[actions], &vec![0.1; actions]),
                ("value.0.weight", &[1, inputs], &some(inputs)), // nothing here reads them
                ("value.0.bias", &[1], &some(1)),
            ],
            &metadata,
        )
    }

    #[test]
    fn outputs_are_those_of_the_definition() {
        let network = Network::read(&file(19, 2, &[])).expect("a policy");
        let observation: Vec<f32> = (0..19).map(|nth| (nth as f32 - 9.0) / 5.0).collect();
        let mut values: Vec<f64> = (0..19)
            .map(|nth| f64::from((observation[nth] - network.mean[nth]) / network.std[nth]))
            .map(|value| value.clamp(-10.0, 10.0))
            .collect();
        for (nth, layer) in network.layers.iter().enumerate() {
            let rows = layer.weight.chunks_exact(layer.inputs).zip(&layer.bias);
            values = rows
                .map(|(row, bias)| {
                    let products = row.iter().zip(&values).map(|(a, b)| f64::from(*a) * b);
                    products.sum::<f64>() + f64::from(*bias)
                })
                .map(|sum| if nth == 0 { sum.tanh() } else { sum })
                .collect();
        }
        for (got, expected) in network.means(&observation).iter().zip(values) {
            assert!((f64::from(*got) - expected).abs() < 1e-6, "{got} {expected}");
        }
    }

    #[test]
    fn files_that_do_not_fit_are_refused_by_name() {
        for (key, value) in [
            ("activation", "relu"),
            ("format", "rsoccer-policy-1"),
            ("clip", "-1"),
            ("action_repeat", "0"),
            ("history", "4"),
            ("shield", "walls"),
            ("sensing", "{"),
            ("observation_size", "20"),
        ] {
            let error = Network::read(&file(19, 2, &[(key, value)])).expect_err(key).to_string();
            assert!(error.contains(key), "{error}");
        }
        for (sensing, needs) in
            [(r#"{"forecast":1.0}"#, true), (r#"{"forecast":0.0}"#, false), ("own:model", false)]
        {
            let network = Network::read(&file(19, 2, &[("sensing", sensing)])).expect("senses");
            assert_eq!((network.needs_forecast(), network.is_shielded()), (needs, false));
        }
        let stacked = Network::read(&file(19, 2, &[("history", "3")])).expect("3 · 5 + 2 · 2");
        assert_eq!((stacked.plain_size(), stacked.history()), (5, 3));
    }
}
