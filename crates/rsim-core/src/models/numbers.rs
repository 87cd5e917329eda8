//! Numbers of models: each is listed once, with its name, unit, range and meaning.
//!
//! The macro [`numbers!`] turns such a list into the fields of a struct with their documentation, and
//! into a table, from which follow validation, access by name and the attributes in Python.

use crate::error::ConfigError;

/// A number of a field, ball or robot model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Number {
    /// Name of the attribute and of the constructor's argument in Python.
    pub name: &'static str,
    /// SI unit; "1" for a ratio or coefficient.
    pub unit: &'static str,
    /// Allowed values.
    pub range: Range,
    /// Name in error messages, with the kind of model: `robot.mass`.
    pub(crate) qualified: &'static str,
    /// Documentation, as its lines stand in the list.
    pub(crate) lines: &'static [&'static str],
}

/// Allowed values of a number; all are finite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Above 0.
    Positive,
    /// 0 or above.
    NotNegative,
    /// From 0 to 1.
    Fraction,
    /// At least 0.5 and below 1.
    UpperHalf,
}

/// A number, and its place in a struct.
pub(crate) struct NumberField<M> {
    pub(crate) number: Number,
    pub(crate) get: fn(&M) -> Option<f32>,
    pub(crate) get_mut: fn(&mut M) -> Option<&mut f32>,
}

impl Number {
    /// Meaning, unit and range: "Radius (m, above 0)."
    pub fn doc(&self) -> String {
        let text = self.lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join(" ");
        let unit = if self.unit == "1" { String::new() } else { format!("{}, ", self.unit) };
        format!("{} ({unit}{}).", text.trim_end_matches('.'), self.range.short())
    }

    /// Checks a value against the range.
    fn check(&self, got: f32) -> Result<(), ConfigError> {
        if self.range.contains(got) {
            return Ok(());
        }
        Err(ConfigError::Number { name: self.qualified, expected: self.range.expected(), got })
    }
}

impl Range {
    /// The range in words, for error messages.
    pub const fn expected(self) -> &'static str {
        match self {
            Self::Positive => "positive and finite",
            Self::NotNegative => "finite and not negative",
            Self::Fraction => "between 0 and 1",
            Self::UpperHalf => "at least 0.5 and below 1",
        }
    }

    /// The range in few words, for documentation.
    pub const fn short(self) -> &'static str {
        match self {
            Self::Positive => "above 0",
            Self::NotNegative => "0 or above",
            Self::Fraction => "0 to 1",
            Self::UpperHalf => "0.5 to below 1",
        }
    }

    /// Whether the range has this value.
    pub fn contains(self, value: f32) -> bool {
        match self {
            Self::Positive => value > 0.0 && value.is_finite(),
            Self::NotNegative => value >= 0.0 && value.is_finite(),
            Self::Fraction => (0.0..=1.0).contains(&value),
            Self::UpperHalf => (0.5..1.0).contains(&value),
        }
    }
}

/// Checks all numbers that `model` has.
pub(crate) fn check_all<M>(fields: &[NumberField<M>], model: &M) -> Result<(), ConfigError> {
    let present = fields.iter().filter_map(|field| Some((field.number, (field.get)(model)?)));
    present.into_iter().try_for_each(|(number, value)| number.check(value))
}

/// The field of a number in a table.
pub(crate) fn find<'a, M>(fields: &'a [NumberField<M>], name: &str) -> Option<&'a NumberField<M>> {
    fields.iter().find(|field| field.number.name == name)
}

/// The numbers of a table.
pub(crate) fn listed<M>(fields: &'static [NumberField<M>]) -> impl Iterator<Item = Number> {
    fields.iter().map(|field| field.number)
}

/// Defines a struct with numbers, and its table `NUMBERS`.
///
/// `fields` are ordinary fields; `numbers` are `f32` fields: documentation, name, range, unit. One
/// with `#[serde(default)]` is 0 in files of versions without it.
macro_rules! numbers {
    (
        $(#[$meta:meta])*
        pub struct $model:ident, $kind:literal;
        fields { $($(#[$field_meta:meta])* $field:ident: $type:ty,)* }
        numbers {
            $(
                $(#[doc = $doc:literal])+ $(#[serde($serde:ident)])?
                $number:ident: $range:ident, $unit:literal;
            )*
        }
    ) => {
        $(#[$meta])*
        pub struct $model {
            $($(#[$field_meta])* pub $field: $type,)*
            $(
                $(#[doc = $doc])+
                #[doc = concat!(
                    "\n\nUnit: ", $unit, ". Range: [`", stringify!($range),
                    "`](crate::Range::", stringify!($range), ")."
                )]
                $(#[serde($serde)])?
                pub $number: f32,
            )*
        }

        impl $model {
            /// The numbers of this struct, in the order of its fields.
            pub(crate) const NUMBERS: &'static [$crate::models::numbers::NumberField<Self>] = &[
                $($crate::models::numbers::NumberField {
                    number: $crate::models::numbers::Number {
                        name: stringify!($number),
                        unit: $unit,
                        range: $crate::models::numbers::Range::$range,
                        qualified: concat!($kind, ".", stringify!($number)),
                        lines: &[$($doc),+],
                    },
                    get: |model| Some(model.$number),
                    get_mut: |model| Some(&mut model.$number),
                },)*
            ];
        }
    };
}

pub(crate) use numbers;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_exclude_what_is_not_finite() {
        for range in [Range::Positive, Range::NotNegative, Range::Fraction, Range::UpperHalf] {
            for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -0.1] {
                assert!(!range.contains(value), "{range:?} {value}");
            }
            assert!(range.contains(0.5), "{range:?}");
        }
        assert!(!Range::Positive.contains(0.0) && Range::NotNegative.contains(0.0));
        assert!(Range::Fraction.contains(1.0) && !Range::UpperHalf.contains(1.0));
    }
}
