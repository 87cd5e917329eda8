//! Impulses that a tick starts from: those of the last sub-step of the tick before.

use serde::{Deserialize, Serialize};

use super::CompactScratch;
use super::impulses::Impulses;
use super::link::{Link, is_of_body};
use crate::blocks::BALL;
use crate::bodies::{Bodies, WarmStart};
use crate::engine::ball_contact::BallRules;
use crate::engine::near::Pair;

/// State of the solver between ticks, beyond the impulses, which are in the blocks of the bodies.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub(in crate::engine) struct CompactSolver {
    /// Number of pairs that pressed in the last sub-step.
    pub(in crate::engine) stored: usize,
    /// Mass of the ball in it, kg.
    ball_mass: f32,
    /// Length of that sub-step, s.
    time: f32,
}

impl CompactSolver {
    /// Writes the links of a tick, with the impulses that it starts from, into `scratch`.
    pub(super) fn link(
        &self,
        bodies: &Bodies,
        near: &[Pair],
        rules: &BallRules,
        time: f32,
        scratch: &mut CompactScratch,
    ) {
        let CompactScratch { bodies: solver_bodies, links, warm_starts, .. } = scratch;
        // Impulses on a heavy ball must not start the solution for a light one.
        let ball_is_lighter = bodies.ball_mass < self.ball_mass;
        let scale = if self.time > 0.0 { time / self.time } else { 0.0 };
        bodies.list_warm_starts(self.stored, warm_starts);
        links.clear();
        // Both lists are in the order of their keys.
        let mut stored = warm_starts.iter().peekable();
        for pair in near {
            let Some(mut link) = Link::of(pair, rules, solver_bodies) else { continue };
            debug_assert!(links.last().is_none_or(|last: &Link| last.key < link.key));
            while stored.next_if(|stored| u32::from(stored.key) < link.key).is_some() {}
            let found = stored.next_if(|stored| u32::from(stored.key) == link.key);
            let found = found.filter(|_| !(ball_is_lighter && link.second == BALL));
            if let Some(WarmStart { features, normals, tangent, .. }) = found {
                link.impulses = Impulses {
                    normals: [0, 1]
                        .map(|point| (u32::from(features[point]), normals[point] * scale)),
                    tangent: tangent * scale,
                };
            }
            links.push(link);
        }
    }

    /// Stores the impulses of the last sub-step, of length `time` (s), for the next tick.
    pub(super) fn store(&mut self, bodies: &mut Bodies, links: &[Link], time: f32) {
        let pressing = links.iter().filter(|link| link.impulses.press());
        #[allow(clippy::cast_possible_truncation)]
        // two small numbers in a key, five bits in a feature
        let stored = bodies.store_warm_starts(pressing.map(|link| {
            let Impulses { normals: [one, two], tangent } = link.impulses;
            let (key, features) = (link.key as u16, [one.0 as u8, two.0 as u8]);
            WarmStart { key, features, normals: [one.1, two.1], tangent }
        }));
        *self = Self { stored, ball_mass: bodies.ball_mass, time };
    }

    /// Forgets the impulses between a body and others.
    pub(in crate::engine) fn forget_body(&self, bodies: &mut Bodies, body: usize) {
        bodies.drop_warm_starts(self.stored, |key| is_of_body(u32::from(key), body));
    }

    /// Forgets the impulses: nothing touched in the last tick.
    pub(in crate::engine) fn forget(&mut self) {
        self.stored = 0;
    }
}
