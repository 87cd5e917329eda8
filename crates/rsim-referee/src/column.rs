//! Values that stand in columns of a row of numbers.

use crate::codes::{Command, Stage};
use crate::draws::Draws;
use crate::team::Team;
use crate::vector::Vector;

/// A value that stands in one or more columns of a row. All numbers are exact: whole ones are below 2^24.
pub trait Column: Sized {
    /// Ends of the names of its columns; `[""]` for a single one.
    fn suffixes() -> Vec<String>;

    /// Reads the value and the rest of the row; `None` for numbers that are no such value.
    fn read(row: &[f32]) -> Option<(Self, &[f32])>;

    /// Writes the value to the first columns of a row, and returns the others.
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32];
}

fn single() -> Vec<String> {
    vec![String::new()]
}

impl Column for f32 {
    fn suffixes() -> Vec<String> {
        single()
    }

    #[inline]
    fn read(row: &[f32]) -> Option<(Self, &[f32])> {
        let (first, rest) = row.split_first()?;
        Some((*first, rest))
    }

    #[inline]
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
        let (first, rest) = row.split_at_mut(1);
        first[0] = *self;
        rest
    }
}

impl Column for i32 {
    fn suffixes() -> Vec<String> {
        single()
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_precision_loss)] // compared below
    #[allow(clippy::float_cmp)] // whole numbers below 2^24 are exact
    #[inline]
    fn read(row: &[f32]) -> Option<(Self, &[f32])> {
        let (first, rest) = row.split_first()?;
        let number = *first as Self; // cheaper than `fract`
        (number as f32 == *first && number.abs() < 1 << 24).then_some((number, rest))
    }

    #[allow(clippy::cast_precision_loss)] // a whole number below 2^24
    #[inline]
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
        (*self as f32).write(row)
    }
}

/// Values that are whole numbers in a row.
macro_rules! as_number {
    ($($value:ty: $to:expr, $from:expr;)*) => {$(
        impl Column for $value {
            fn suffixes() -> Vec<String> {
                single()
            }

            #[inline]
    fn read(row: &[f32]) -> Option<(Self, &[f32])> {
                let (number, rest) = i32::read(row)?;
                let from: fn(i32) -> Option<Self> = $from;
                Some((from(number)?, rest))
            }

            #[inline]
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
                let to: fn(&Self) -> i32 = $to;
                to(self).write(row)
            }
        }
    )*};
}

as_number! {
    bool: |value| i32::from(*value), |number| match number {
        0 => Some(false),
        1 => Some(true),
        _ => None,
    };
    Command: |value| i32::from(value.code()), |number| Self::of_code(u8::try_from(number).ok()?);
    Stage: |value| i32::from(value.code()), |number| Self::of_code(u8::try_from(number).ok()?);
    Option<Command>: |value| value.map_or(-1, |command| i32::from(command.code())),
        |number| if number == -1 {
            Some(None)
        } else {
            Command::of_code(u8::try_from(number).ok()?).map(Some)
        };
    Option<Team>: |value| value.map_or(-1, |team| i32::from(team.index() != 0)), |number| match number {
        -1 => Some(None),
        0 => Some(Some(Team::Blue)),
        1 => Some(Some(Team::Yellow)),
        _ => None,
    };
    Team: |value| i32::from(value.index() != 0), |number| match number {
        0 => Some(Team::Blue),
        1 => Some(Team::Yellow),
        _ => None,
    };
    Draws: |value| i32::try_from(value.state()).unwrap_or(0), |number| u32::try_from(number).ok().map(Self::new);
    Option<usize>: |value| value.map_or(-1, |index| i32::try_from(index).unwrap_or(i32::MAX)),
        |number| if number == -1 { Some(None) } else { usize::try_from(number).ok().map(Some) };
}

impl Column for Vector {
    fn suffixes() -> Vec<String> {
        ["_x", "_y"].map(str::to_owned).to_vec()
    }

    #[inline]
    fn read(row: &[f32]) -> Option<(Self, &[f32])> {
        let [x, y, rest @ ..] = row else { return None };
        Some((Self::new(*x, *y), rest))
    }

    #[inline]
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
        self.y.write(self.x.write(row))
    }
}

/// One value for each team.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ByTeam<T>([T; 2]);

impl<T> ByTeam<T> {
    /// Values of blue and of yellow.
    pub const fn new(blue: T, yellow: T) -> Self {
        Self([blue, yellow])
    }
}

impl<T> std::ops::Index<Team> for ByTeam<T> {
    type Output = T;

    fn index(&self, team: Team) -> &T {
        &self.0[team.index()]
    }
}

impl<T> std::ops::IndexMut<Team> for ByTeam<T> {
    fn index_mut(&mut self, team: Team) -> &mut T {
        &mut self.0[team.index()]
    }
}

impl<T: Column> Column for ByTeam<T> {
    fn suffixes() -> Vec<String> {
        let ends = T::suffixes();
        ["_blue", "_yellow"]
            .iter()
            .flat_map(|team| ends.iter().map(move |end| format!("{team}{end}")))
            .collect()
    }

    #[inline]
    fn read(row: &[f32]) -> Option<(Self, &[f32])> {
        let (blue, rest) = T::read(row)?;
        let (yellow, rest) = T::read(rest)?;
        Some((Self([blue, yellow]), rest))
    }

    #[inline]
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
        self.0.iter().fold(row, |rest, value| value.write(rest))
    }
}

impl<T: Column, const N: usize> Column for [T; N] {
    fn suffixes() -> Vec<String> {
        let ends = T::suffixes();
        (0..N).flat_map(|nth| ends.iter().map(move |end| format!("_{nth}{end}"))).collect()
    }

    #[inline]
    fn read(mut row: &[f32]) -> Option<(Self, &[f32])> {
        let mut values = [(); N].map(|()| None);
        for value in &mut values {
            let (read, rest) = T::read(row)?;
            *value = Some(read);
            row = rest;
        }
        Some((values.map(|value| value.expect("all were read")), row))
    }

    #[inline]
    fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
        self.iter().fold(row, |rest, value| value.write(rest))
    }
}

/// Declares a struct whose fields are columns of a row.
macro_rules! row {
    ($(#[$of_struct:meta])* pub struct $row:ident { $($(#[$doc:meta])* $name:ident: $value:ty,)* }) => {
        $(#[$of_struct])*
        #[derive(Debug, Clone, PartialEq)]
        pub struct $row { $($(#[$doc])* pub $name: $value,)* }

        impl $row {
            /// Names of the columns, in the order of a row.
            pub fn columns() -> Vec<String> {
                let mut names = Vec::new();
                $(names.extend(
                    <$value as $crate::column::Column>::suffixes().iter().map(|end| format!("{}{end}", stringify!($name))),
                );)*
                names
            }

            /// Reads a row.
            ///
            /// # Errors
            /// If the row has another length, or a number that its column cannot have.
            pub fn read(row: &[f32]) -> Result<Self, $crate::error::RefereeError> {
                let rest = row;
                $(let ($name, rest) = <$value as $crate::column::Column>::read(rest)
                    .ok_or($crate::error::RefereeError::Column { name: stringify!($name) })?;)*
                if rest.is_empty() {
                    return Ok(Self { $($name,)* });
                }
                let size = Self::columns().len();
                Err($crate::error::RefereeError::RowSize { expected: size, got: row.len() })
            }

            /// Writes the state to a row.
            ///
            /// # Panics
            /// If the row is shorter.
            pub fn write(&self, row: &mut [f32]) {
                let rest = row;
                $(let rest = $crate::column::Column::write(&self.$name, rest);)*
                debug_assert!(rest.is_empty(), "the row is longer");
            }

            /// The state as a new row.
            pub fn row(&self) -> Vec<f32> {
                let mut row = vec![0.0; Self::columns().len()];
                self.write(&mut row);
                row
            }
        }
    };
}
pub(crate) use row;

#[cfg(test)]
mod tests {
    use super::*;

    fn there_and_back<T: Column + PartialEq + std::fmt::Debug>(value: &T) {
        let size = T::suffixes().len();
        let mut row = vec![7.0; size + 1];
        assert_eq!(value.write(&mut row).len(), 1, "{value:?}");
        let (read, rest) = T::read(&row).expect("it was written");
        assert_eq!((&read, rest), (value, &[7.0][..]));
    }

    #[test]
    fn values_come_back_from_their_columns() {
        there_and_back(&1.5_f32);
        there_and_back(&-3_i32);
        there_and_back(&true);
        there_and_back(&Command::BallPlacement(Team::Blue));
        there_and_back(&Stage::Shootout);
        for team in [None, Some(Team::Blue), Some(Team::Yellow)] {
            there_and_back(&team);
            there_and_back(&team.map(Command::DirectFree));
            there_and_back(&team.map(Team::index));
        }
        there_and_back(&Vector::new(1.0, -2.0));
        there_and_back(&ByTeam::new([1_i32, 2, 3], [4, 5, 6]));
    }

    #[test]
    fn numbers_that_are_no_value_are_refused() {
        assert!(bool::read(&[2.0]).is_none());
        assert!(i32::read(&[0.5]).is_none());
        assert!(Command::read(&[11.0]).is_none());
        assert!(Stage::read(&[-1.0]).is_none());
        assert!(Option::<Team>::read(&[2.0]).is_none());
        assert!(Vector::read(&[1.0]).is_none());
        assert!(<[i32; 2]>::read(&[1.0]).is_none());
    }

    #[test]
    fn columns_of_teams_have_their_names() {
        assert_eq!(ByTeam::<i32>::suffixes(), ["_blue", "_yellow"]);
        assert_eq!(<[Vector; 2]>::suffixes(), ["_0_x", "_0_y", "_1_x", "_1_y"]);
    }
}
