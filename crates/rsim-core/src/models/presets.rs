//! Look-up of presets by name.

use crate::error::ConfigError;

/// The entry of `presets` with this name. `what` names the argument in the error message.
pub(crate) fn find_preset<T: Clone>(
    what: &'static str,
    presets: &[T],
    name_of: impl Fn(&T) -> &str,
    name: &str,
) -> Result<T, ConfigError> {
    let found = presets.iter().find(|preset| name_of(preset) == name);
    found.cloned().ok_or_else(|| ConfigError::UnknownPreset {
        what,
        known: presets.iter().map(&name_of).collect::<Vec<_>>().join(", "),
        got: name.to_owned(),
    })
}
