//! Memory of a team between steps: a row of numbers in named columns, which the caller owns.

use rsim_referee::Vector;
use rsim_referee::column::Column;

use crate::error::TeamsError;
use crate::tactics::Tactics;

/// Declares a struct whose fields stand in columns of a row.
macro_rules! record {
    ($(#[$of_struct:meta])* struct $record:ident { $($(#[$doc:meta])* $name:ident: $value:ty,)* }) => {
        $(#[$of_struct])*
        #[derive(Debug, Clone, Copy, PartialEq)]
        pub(crate) struct $record { $($(#[$doc])* pub(crate) $name: $value,)* }

        impl $record {
            fn columns(end: &str) -> Vec<String> {
                let mut names = Vec::new();
                $(names.extend(
                    <$value>::suffixes().iter().map(|part| format!("{}{end}{part}", stringify!($name))),
                );)*
                names
            }

            fn read(row: &[f32]) -> Result<(Self, &[f32]), TeamsError> {
                let rest = row;
                $(let ($name, rest) = <$value>::read(rest)
                    .ok_or(TeamsError::Memory { name: stringify!($name) })?;)*
                Ok((Self { $($name,)* }, rest))
            }

            fn write<'a>(&self, row: &'a mut [f32]) -> &'a mut [f32] {
                let rest = row;
                $(let rest = self.$name.write(rest);)*
                rest
            }
        }
    };
}

record! {
    /// Memory of a team.
    struct TeamMemory {
        /// Upper 16 bits of the seed.
        seed_high: i32,
        /// Lower 16 bits of the seed.
        seed_low: i32,
        /// Control steps since the beginning.
        step: i32,
        /// Robot that goes to the ball.
        taker: Option<usize>,
        /// Robot to which a pass is on its way.
        receiver: Option<usize>,
        /// Time that the pass has left, in control steps.
        pass_steps: i32,
        /// Velocity of the ball in the last step, m/s.
        ball_velocity: Vector,
        /// Speed of the ball after the last kick, m/s.
        kick_speed: f32,
        /// Robot that has the ball.
        carrier: Option<usize>,
        /// Place where it began to have it, m.
        carry_start: Vector,
        /// Control steps for which it has had it.
        carry_steps: i32,
        /// Robot for which a kick was chosen; none if no kick is.
        aimer: Option<usize>,
        /// Place where the kick goes, m.
        aim: Vector,
        /// Speed of the kick, m/s.
        aim_speed: f32,
        /// Whether it is a chip.
        aim_chip: bool,
        /// Robot that is to receive it.
        aim_receiver: Option<usize>,
        /// Value.
        aim_value: f32,
        /// Robot that has chosen a corner for its penalty kick; none if no robot has.
        corner_kicker: Option<usize>,
        /// The corner, by its y, m.
        corner: f32,
        /// Whether the team attacks.
        attacks: bool,
        /// Whether the ball of a placement is to be left where it is.
        releases: bool,
    }
}

record! {
    /// Memory of a team about a robot.
    struct RobotMemory {
        /// Job among the robots without the ball, by number; -1 for none.
        job: i32,
        /// Place where it runs free, m.
        spot: Vector,
        /// Place where it goes, m.
        target: Vector,
        /// Direction that it is to face.
        facing: Vector,
    }
}

impl TeamMemory {
    /// Memory before the first step.
    pub(crate) fn new(seed: u32) -> Self {
        let half = |bits: u32| i32::try_from(bits & 0xffff).unwrap_or(0);
        Self {
            seed_high: half(seed >> 16),
            seed_low: half(seed),
            step: 0,
            taker: None,
            receiver: None,
            pass_steps: 0,
            ball_velocity: Vector::default(),
            kick_speed: 0.0,
            carrier: None,
            carry_start: Vector::default(),
            carry_steps: 0,
            aimer: None,
            aim: Vector::default(),
            aim_speed: 0.0,
            aim_chip: false,
            aim_receiver: None,
            aim_value: 0.0,
            corner_kicker: None,
            corner: 0.0,
            attacks: false,
            releases: false,
        }
    }

    /// The seed.
    pub(crate) fn seed(&self) -> u32 {
        let part = |half: i32| u32::try_from(half).unwrap_or(0);
        part(self.seed_high) << 16 | part(self.seed_low)
    }
}

impl RobotMemory {
    /// Memory before the first step.
    pub(crate) const NEW: Self = Self {
        job: -1,
        spot: Vector::new(0.0, 0.0),
        target: Vector::new(0.0, 0.0),
        facing: Vector::new(1.0, 0.0),
    };
}

/// Memory of a team of `robots`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Memory {
    /// Of the team.
    pub(crate) team: TeamMemory,
    /// The numbers by which it plays.
    pub(crate) tactics: Tactics,
    /// Of each robot.
    pub(crate) robots: [RobotMemory; crate::config::MAX_ROBOTS],
}

impl Memory {
    /// Names of the columns for `robots`.
    pub(crate) fn columns(robots: usize) -> Vec<String> {
        let of_robots = (0..robots).flat_map(|index| RobotMemory::columns(&format!("_{index}")));
        TeamMemory::columns("").into_iter().chain(Tactics::columns()).chain(of_robots).collect()
    }

    /// Memory before the first step.
    pub(crate) fn new(seed: u32) -> Self {
        let robots = [RobotMemory::NEW; crate::config::MAX_ROBOTS];
        Self { team: TeamMemory::new(seed), tactics: Tactics::DEFAULT, robots }
    }

    /// Reads the memory of `robots` from a row.
    pub(crate) fn read(row: &[f32], robots: usize) -> Result<Self, TeamsError> {
        let (team, rest) = TeamMemory::read(row)?;
        let cut_off =
            TeamsError::Size { name: "memory", expected: Tactics::COUNT, got: rest.len() };
        let (tactics, mut rest) = rest.split_at_checked(Tactics::COUNT).ok_or(cut_off)?;
        let mut memory = Self { team, tactics: Tactics::read(tactics)?, ..Self::new(0) };
        for robot in &mut memory.robots[..robots] {
            (*robot, rest) = RobotMemory::read(rest)?;
        }
        Ok(memory)
    }

    /// Writes the memory of `robots` to a row.
    pub(crate) fn write(&self, row: &mut [f32], robots: usize) {
        let mut rest = self.tactics.write(self.team.write(row));
        for robot in &self.robots[..robots] {
            rest = robot.write(rest);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_comes_back_from_its_row() {
        let mut memory = Memory::new(0xdead_beef);
        memory.team.taker = Some(3);
        memory.team.aim = Vector::new(1.0, -0.5);
        memory.robots[1].spot = Vector::new(2.0, 1.0);
        let mut row = vec![0.0; Memory::columns(2).len()];
        memory.write(&mut row, 2);
        let read = Memory::read(&row, 2).expect("it was written");
        assert_eq!(read, memory);
        assert_eq!(read.team.seed(), 0xdead_beef);
    }

    #[test]
    fn columns_have_names_of_their_own() {
        let mut names = Memory::columns(11);
        assert!(names.contains(&"aim_x".to_owned()));
        assert!(names.contains(&"spot_10_y".to_owned()), "{names:?}");
        let count = names.len();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn numbers_that_are_no_memory_are_refused_by_name() {
        let mut row = vec![0.0; Memory::columns(1).len()];
        row[2] = 0.5;
        assert_eq!(Memory::read(&row, 1), Err(TeamsError::Memory { name: "step" }));
    }
}
