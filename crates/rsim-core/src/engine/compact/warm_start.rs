//! Impulses that a tick starts from: those of the last sub-step of the tick before.

use serde::{Deserialize, Serialize};

use super::constraint::Impulse;
use super::link::{Kept, Link};
use crate::engine::BALL;
use crate::engine::ball_contact::BallRules;
use crate::engine::near::Pair;

/// State of the solver between ticks.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(in crate::engine) struct CompactSolver {
    /// Impulses of the last sub-step, in the order of their keys.
    impulses: Vec<StoredImpulse>,
    /// Mass of the ball in it, kg.
    ball_mass: f32,
    /// Length of that sub-step, s.
    time: f32,
}

/// Impulses of a contact point.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct StoredImpulse {
    key: u32,
    feature: u32,
    /// N s.
    normal: f32,
    tangent: f32,
}

impl CompactSolver {
    /// Writes the links of a tick, with the impulses that it starts from, into `links`.
    pub(super) fn link(
        &self,
        near: &[Pair],
        fixed: usize,
        rules: &BallRules,
        time: f32,
        links: &mut Vec<Link>,
    ) {
        let ball_mass = rules.squeezed.map_or(rules.params.ball.mass, |squeezed| squeezed.mass);
        // Impulses on a heavy ball must not start the solution for a light one.
        let ball_is_lighter = ball_mass < self.ball_mass;
        let scale = if self.time > 0.0 { time / self.time } else { 0.0 };
        links.clear();
        links.extend(near.iter().filter_map(|pair| Link::of(pair, fixed, rules)));
        for link in links.iter_mut().filter(|link| !(ball_is_lighter && link.second == BALL)) {
            let stored = self.impulses.iter().filter(|stored| stored.key == link.key);
            for (kept, stored) in link.kept.iter_mut().zip(stored) {
                let (normal, tangent) = (stored.normal * scale, stored.tangent * scale);
                *kept = Kept { feature: stored.feature, impulse: Impulse { normal, tangent } };
            }
        }
    }

    /// Stores the impulses of the last sub-step, of length `time` (s), for the next tick.
    pub(super) fn store(&mut self, links: &[Link], ball_mass: f32, time: f32) {
        (self.ball_mass, self.time) = (ball_mass, time);
        self.impulses.clear();
        self.impulses.extend(links.iter().flat_map(|link| {
            let points = link.kept.iter().filter(|kept| kept.impulse.normal > 0.0);
            points.map(|kept| {
                let Impulse { normal, tangent } = kept.impulse;
                StoredImpulse { key: link.key, feature: kept.feature, normal, tangent }
            })
        }));
    }

    /// Forgets the impulses: nothing touched in the last tick.
    pub(in crate::engine) fn forget(&mut self) {
        self.impulses.clear();
    }
}
