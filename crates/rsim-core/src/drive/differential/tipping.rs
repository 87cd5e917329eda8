//! Robots that tip: floor and body rub where a robot is high for the length of its base.
//!
//! Such a robot lifts its front as tires drive it, and its back as they brake it. The part of its weight that the other
//! edge of its body carries then grows with the force of the tires, and so does the friction there, which always
//! slows the robot: it gets faster by the grip times one minus `tipping_friction`, and brakes with the grip times one
//! plus that. Once it has tipped forward altogether it skids to a stop.

use serde::{Deserialize, Serialize};

use super::super::Driven;
use crate::blocks::{LANES, Lanes, lanes_of, limited, smaller};
use crate::models::robot::DifferentialDrive;

/// Speed below which a robot that skids stands on its wheels again, m/s.
const STANDING: f32 = 0.05;

/// Numbers of the robots of a block.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct Tipping {
    /// Friction of the body, divided by that of the tires.
    friction: Lanes,
    /// Slip of both tires of a robot that brakes beyond which it skids, m/s; infinite for one that never does.
    skid_slip: Lanes,
}

/// Tipping of the robots of a block as it lasts from one tick to the next.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(in crate::drive) struct TippingState {
    /// Change of the speed forward by friction of the body in the last tick, m/s.
    pub(super) drag: Lanes,
    /// 1 for robots that skid, 0 for others.
    skids: Lanes,
}

impl TippingState {
    /// Robots that stand on their wheels.
    pub(in crate::drive) const UPRIGHT: Self = Self { drag: Lanes::ZERO, skids: Lanes::ZERO };

    /// Puts the robots of `mask` on their wheels.
    pub(in crate::drive) fn set_upright(&mut self, mask: Lanes) {
        self.drag = mask.bitselect(Lanes::ZERO, self.drag);
        self.skids = mask.bitselect(Lanes::ZERO, self.skids);
    }
}

impl Tipping {
    /// The numbers of robots, of which some tip.
    pub(super) fn of(robots: &[Driven<DifferentialDrive>; LANES]) -> Option<Self> {
        let may_tip =
            |drive: &DifferentialDrive| drive.tipping_friction > 0.0 || drive.skid_slip > 0.0;
        let skid_slip = |lane: usize| match robots[lane].drive.skid_slip {
            0.0 => f32::INFINITY,
            slip => slip,
        };
        robots.iter().any(|robot| may_tip(robot.drive)).then(|| Self {
            friction: lanes_of(|lane| robots[lane].drive.tipping_friction),
            skid_slip: lanes_of(skid_slip),
        })
    }

    /// Updates which robots of `mask` skid, by the slip of their tires and their velocity forward, m/s. Returns their
    /// mask.
    pub(super) fn update_skids(
        &self,
        state: &mut TippingState,
        mask: Lanes,
        slip: [Lanes; 2],
        velocity: Lanes,
    ) -> Lanes {
        let backward = velocity.simd_lt(Lanes::ZERO);
        let [left, right] = slip.map(|slip| backward.bitselect(-slip, slip));
        let brakes_hard = smaller(left, right).simd_gt(self.skid_slip);
        let moves = velocity.abs().simd_gt(Lanes::splat(STANDING));
        let skids = (state.skids.simd_gt(Lanes::ZERO) | brakes_hard) & moves & mask;
        state.skids = skids & Lanes::ONE;
        skids
    }

    /// Change of the speed forward (m/s) by friction of the body, with friction of the tires `along` the wheels. It
    /// stops a robot that its tires and its load leave with this velocity forward, and does not push it back.
    pub(super) fn drag(&self, along: [Lanes; 2], velocity: Lanes) -> Lanes {
        let [left, right] = along.map(Lanes::abs);
        -limited(velocity, self.friction * (left + right))
    }
}
