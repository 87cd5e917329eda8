//! Wheels that move robots by bounded forces, so that robots push, stall, skid and are pushed.
//!
//! The robots of a block are driven together. All quantities are per unit of mass or of inertia: an
//! impulse is the change of velocity that it gives the robot.

mod differential;
mod omni;

pub(crate) use omni::WheelMap;

use differential::TippingState;
use serde::{Deserialize, Serialize};

use crate::blocks::{
    LANES, Lanes, VectorLanes, blocks_of, larger, mask_of, mask_of_bits, place_of, robot,
};
use crate::geometry::motion_block::MotionBlock;
use crate::math::Vector;
use crate::models::robot::{DifferentialDrive, Drive, OmniDrive, RobotModel};

/// Number of columns of the longest part of a command for the wheels.
const MAX_COLUMNS: usize = 4;

/// Number of wheels of a robot at most.
pub(crate) const MAX_WHEELS: usize = 4;

/// Wheels of the robots of a block, in one tick.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct BlockWheels {
    differential: Option<Mounted<differential::Wheels>>,
    /// Commanded by the body's velocity.
    omni: Option<Mounted<omni::Wheels>>,
    /// Commanded by the wheels' speeds.
    each_omni: Option<Mounted<omni::Wheels>>,
    /// Inverse of the tick, 1/s.
    ticks_per_second: f32,
}

/// Wheels of one kind, and the lanes of the robots that have them.
#[derive(Debug, Clone, Serialize, Deserialize)]
struct Mounted<W> {
    mask: Lanes,
    wheels: W,
}

/// Errors of the wheels of a block.
#[derive(Clone, Copy)]
pub(crate) struct WheelErrors<'a> {
    /// Factors on the speeds of the wheels.
    pub(crate) gains: &'a [Lanes; MAX_WHEELS],
    /// Speed below which a wheel stands, m/s at the rim.
    pub(crate) dead_zone: f32,
    /// Part of the maximum speeds that the battery leaves.
    pub(crate) battery: f32,
}

impl WheelErrors<'_> {
    /// Speeds of wheels that are to turn at `speeds` and turn at up to `most` with a full battery, rad/s. A robot whose
    /// fastest wheel is limited goes the same way more slowly.
    fn turn<const N: usize>(self, speeds: [Lanes; N], radius: Lanes, most: Lanes) -> [Lanes; N] {
        let dead_zone = Lanes::splat(self.dead_zone);
        let slower = saturation_factor(&speeds, Lanes::splat(self.battery) * most);
        std::array::from_fn(|wheel| {
            let stands = (speeds[wheel] * radius).abs().simd_lt(dead_zone);
            (speeds[wheel] * (self.gains[wheel] * slower)) & !stands
        })
    }
}

/// Factor on all speeds of a robot's wheels that lets none turn faster than `most`, rad/s.
fn saturation_factor(speeds: &[Lanes], most: Lanes) -> Lanes {
    let fastest = speeds.iter().fold(Lanes::ZERO, |fastest, speed| larger(fastest, speed.abs()));
    fastest.simd_gt(most).bitselect(most / fastest, Lanes::ONE)
}

/// A robot's drive of one kind, with the mass (kg) and moment of inertia (kg m²) that it moves.
struct Driven<'a, D> {
    drive: &'a D,
    mass: f32,
    inertia: f32,
}

/// The wheels of all blocks of a match.
pub(crate) fn wheels_of<'a>(
    models: impl ExactSizeIterator<Item = &'a RobotModel>,
    tick: f32,
) -> Vec<BlockWheels> {
    let mut blocks = vec![[None; LANES]; blocks_of(models.len())];
    for (index, model) in models.enumerate() {
        let (block, lane) = place_of(robot(index));
        blocks[block][lane] = Some(model);
    }
    blocks.iter().map(|models| BlockWheels::of(models, tick)).collect()
}

impl BlockWheels {
    fn of(models: &[Option<&RobotModel>; LANES], tick: f32) -> Self {
        Self {
            differential: mounted(models, differential_of, |all| {
                differential::Wheels::of(&all, tick)
            }),
            omni: mounted(models, omni_of, |all| omni::Wheels::of(&all, tick)),
            each_omni: mounted(models, each_omni_of, |all| omni::Wheels::of(&all, tick)),
            ticks_per_second: 1.0 / tick,
        }
    }

    /// Wheels of omnidirectional robots.
    fn all_omni(&self) -> impl Iterator<Item = &Mounted<omni::Wheels>> {
        self.omni.iter().chain(&self.each_omni)
    }

    /// Whether the jerk of some robots is limited: only these need the last change of their velocity.
    fn limits_jerk(&self) -> bool {
        self.all_omni().any(|Mounted { wheels, .. }| wheels.limits_jerk())
    }

    /// Numbers of each robot by the kind of its wheels: `none` where it has none.
    fn by_kind<const N: usize>(
        &self,
        none: [Lanes; N],
        differential: impl FnOnce(&differential::Wheels) -> [Lanes; N],
        omni: impl FnOnce(&omni::Wheels) -> [Lanes; N],
        each_omni: impl FnOnce(&omni::Wheels) -> [Lanes; N],
    ) -> [Lanes; N] {
        let mut numbers = none;
        let mut replace = |mask: Lanes, by: [Lanes; N]| {
            numbers = std::array::from_fn(|nth| mask.bitselect(by[nth], numbers[nth]));
        };
        if let Some(Mounted { mask, wheels }) = &self.differential {
            replace(*mask, differential(wheels));
        }
        if let Some(Mounted { mask, wheels }) = &self.omni {
            replace(*mask, omni(wheels));
        }
        if let Some(Mounted { mask, wheels }) = &self.each_omni {
            replace(*mask, each_omni(wheels));
        }
        numbers
    }
}

fn differential_of(model: &RobotModel) -> Option<&DifferentialDrive> {
    if let Drive::Differential(drive) = &model.drive { Some(drive) } else { None }
}

fn omni_of(model: &RobotModel) -> Option<&OmniDrive> {
    if let Drive::Omni(drive) = &model.drive { Some(drive) } else { None }
}

fn each_omni_of(model: &RobotModel) -> Option<&OmniDrive> {
    if let Drive::OmniWheels(drive) = &model.drive { Some(drive) } else { None }
}

/// The wheels of the robots of a block whose drive is of the kind that `drive_of` finds. The lanes of the
/// others get the numbers of one that has it.
fn mounted<'a, D: 'a, W>(
    models: &[Option<&'a RobotModel>; LANES],
    drive_of: impl Fn(&'a RobotModel) -> Option<&'a D>,
    wheels: impl FnOnce([Driven<'a, D>; LANES]) -> W,
) -> Option<Mounted<W>> {
    let of = |lane: usize| {
        let model = models[lane]?;
        let drive = drive_of(model)?;
        Some(Driven { drive, mass: model.mass, inertia: model.inertia() })
    };
    let any = || (0..LANES).find_map(of);
    any()?;
    let mask = mask_of(|lane| of(lane).is_some());
    let all = std::array::from_fn(|lane| of(lane).or_else(any).expect("one has this drive"));
    Some(Mounted { mask, wheels: wheels(all) })
}

/// The parts of commands that are for the wheels of a block, by column.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BlockCommands([Lanes; MAX_COLUMNS]);

impl BlockCommands {
    /// Reads the commands of block `block` from rows of `columns` numbers, one row per robot.
    pub(crate) fn read(commands: &[f32], columns: usize, block: usize) -> Self {
        let row = |lane: usize| {
            let body = block * LANES + lane;
            let robot = body.checked_sub(robot(0));
            let row = robot.and_then(|robot| commands.get(robot * columns..)?.get(..columns));
            match row.unwrap_or_default() {
                [first, second, third, fourth, ..] => [*first, *second, *third, *fourth],
                [left, right] => [*left, *right, 0.0, 0.0],
                row => std::array::from_fn(|column| row.get(column).copied().unwrap_or_default()),
            }
        };
        Self(Lanes::transpose(std::array::from_fn(|lane| Lanes::from(row(lane)))))
    }

    /// Replaces the commands by those that wheels with errors obey.
    pub(crate) fn obey(&mut self, wheels: &BlockWheels, errors: WheelErrors<'_>) {
        self.0 = wheels.by_kind(
            self.0,
            |wheels| wheels.obeyed(self.0, errors),
            |wheels| wheels.obeyed_velocity(self.0, errors),
            |wheels| wheels.obeyed_wheel_speeds(self.0, errors),
        );
    }

    /// Commands the wheels in the lanes of `mask` to stand still.
    pub(crate) fn halt(&mut self, mask: Lanes) {
        self.0 = self.0.map(|column| mask.bitselect(Lanes::ZERO, column));
    }

    /// Targets of the wheels by these commands.
    pub(crate) fn targets(&self, wheels: &BlockWheels) -> BlockTargets {
        let Self(command) = self;
        BlockTargets(wheels.by_kind(
            [Lanes::ZERO; 3],
            |wheels| wheels.rims(command),
            |wheels| wheels.target_of_velocity(command),
            |wheels| wheels.target_of_wheel_speeds(command),
        ))
    }
}

/// Speeds that the wheels of a block are to have, by lane: of robots with two wheels those of the rims, left and right
/// (m/s); of omnidirectional ones the velocity forward and to the left (m/s) and the angular velocity (rad/s), in their
/// own frames.
///
/// They follow from the commands alone, so they are computed once for all ticks.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct BlockTargets([Lanes; 3]);

impl BlockTargets {
    /// The first number.
    pub(crate) fn first(&self) -> &Lanes {
        &self.0[0]
    }
}

/// Motion and estimated load of the robots of a block in their own frames: x forward, y to the left.
struct OwnMotion {
    /// m/s.
    velocity: VectorLanes,
    /// rad/s.
    angular_velocity: Lanes,
    /// Change of velocity by other bodies in the last tick, m/s.
    load: VectorLanes,
    /// Change of the angular velocity by other bodies in the last tick, rad/s.
    angular_load: Lanes,
    /// Change of velocity by the wheels in the last tick, without the compensation of loads, m/s.
    last_change: VectorLanes,
}

/// Effect of the wheels of a block in a tick, in the robots' own frames.
struct WheelEffect {
    /// Change of velocity, m/s.
    velocity: VectorLanes,
    /// Change of the angular velocity, rad/s.
    angular_velocity: Lanes,
    /// Change of velocity without the compensation of loads, m/s.
    change: VectorLanes,
}

impl WheelEffect {
    const NONE: Self = Self {
        velocity: VectorLanes::ZERO,
        angular_velocity: Lanes::ZERO,
        change: VectorLanes::ZERO,
    };

    /// `self` in the lanes of `mask`, `other` in the others.
    fn where_else(&self, mask: Lanes, other: &Self) -> Self {
        Self {
            velocity: self.velocity.where_else(mask, other.velocity),
            angular_velocity: mask.bitselect(self.angular_velocity, other.angular_velocity),
            change: self.change.where_else(mask, other.change),
        }
    }
}

/// Acceleration of the bodies of a block.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct BlockAcceleration {
    /// m/s².
    pub(crate) linear: VectorLanes,
    /// rad/s².
    pub(crate) angular: Lanes,
}

impl BlockAcceleration {
    pub(crate) const NONE: Self = Self { linear: VectorLanes::ZERO, angular: Lanes::ZERO };

    /// Sets the acceleration of the body in `lane` to 0.
    pub(crate) fn clear(&mut self, lane: usize) {
        self.linear.set(lane, Vector::ZERO);
        self.angular.as_mut_array()[lane] = 0.0;
    }
}

/// State of the wheels of a block between ticks.
///
/// A bounded correction of the velocity alone lets a pushed robot creep: each tick corrects only the
/// error of the last one. So wheels also compensate the load of the last tick, within the same bounds.
/// They do so only while the robot is in contact: the load of an impact does not come again.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(crate) struct DriveState {
    /// Change of velocity by other bodies in the last tick, m/s.
    load: VectorLanes,
    /// Change of the angular velocity by other bodies in the last tick, rad/s.
    angular_load: Lanes,
    /// Change of velocity by the wheels in the last tick, without the compensation of loads, m/s.
    change: VectorLanes,
    /// Velocity after the tick without contacts, m/s.
    expected_velocity: VectorLanes,
    /// Angular velocity after the tick without contacts, rad/s.
    expected_angular_velocity: Lanes,
    tipping: TippingState,
}

impl DriveState {
    /// Wheels before their first tick.
    pub(crate) const AT_REST: Self = Self {
        load: VectorLanes::ZERO,
        angular_load: Lanes::ZERO,
        change: VectorLanes::ZERO,
        expected_velocity: VectorLanes::ZERO,
        expected_angular_velocity: Lanes::ZERO,
        tipping: TippingState::UPRIGHT,
    };

    /// Gives the robot in `lane` wheels before their first tick.
    pub(crate) fn clear(&mut self, lane: usize) {
        let Self {
            load,
            angular_load,
            change,
            expected_velocity,
            expected_angular_velocity,
            tipping,
        } = self;
        for vector in [load, change, expected_velocity] {
            vector.set(lane, Vector::ZERO);
        }
        for number in [angular_load, expected_angular_velocity] {
            number.as_mut_array()[lane] = 0.0;
        }
        tipping.set_upright(mask_of_bits(1 << lane));
    }

    /// Puts the robots of `mask` on their wheels, of which something tells that they do not tip.
    pub(crate) fn set_upright(&mut self, mask: Lanes) {
        self.tipping.set_upright(mask);
    }

    /// Accelerations of the robots by their wheels, which follow `targets` for a tick.
    pub(crate) fn accelerate(
        &mut self,
        wheels: &BlockWheels,
        targets: &BlockTargets,
        motion: &MotionBlock,
    ) -> BlockAcceleration {
        let has_change = wheels.limits_jerk();
        let own = OwnMotion {
            velocity: motion.velocity.seen_from(motion.heading),
            angular_velocity: motion.angular_velocity,
            load: self.load.seen_from(motion.heading),
            angular_load: self.angular_load,
            last_change: if has_change {
                self.change.seen_from(motion.heading)
            } else {
                VectorLanes::ZERO
            },
        };
        let BlockTargets(targets) = targets;
        let mut effect = WheelEffect::NONE;
        if let Some(Mounted { mask, wheels }) = &wheels.differential {
            effect =
                wheels.effect(*mask, targets, &own, &mut self.tipping).where_else(*mask, &effect);
        }
        for Mounted { mask, wheels } in wheels.all_omni() {
            effect = wheels.effect(targets, &own).where_else(*mask, &effect);
        }
        let velocity = effect.velocity.rotated_by(motion.heading);
        if has_change {
            self.change = effect.change.rotated_by(motion.heading);
        }
        self.expected_velocity = motion.velocity + velocity;
        self.expected_angular_velocity = motion.angular_velocity + effect.angular_velocity;
        let per_second = Lanes::splat(wheels.ticks_per_second);
        BlockAcceleration {
            linear: velocity * per_second,
            angular: effect.angular_velocity * per_second,
        }
    }

    /// Estimates the loads of the tick from the difference to the expected motion, for robots that are
    /// in contact after the tick, one bit each. The others have none.
    pub(crate) fn estimate_loads(&mut self, motion: &MotionBlock, in_contact: u64) {
        (self.load, self.angular_load) = (VectorLanes::ZERO, Lanes::ZERO);
        if in_contact & ((1 << LANES) - 1) != 0 {
            let mask = mask_of_bits(in_contact);
            let load = motion.velocity - self.expected_velocity;
            self.load = load.where_else(mask, VectorLanes::ZERO);
            self.angular_load = mask & (motion.angular_velocity - self.expected_angular_velocity);
        }
    }
}
