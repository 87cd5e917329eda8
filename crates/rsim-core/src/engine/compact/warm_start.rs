//! Impulses that a tick starts from: those of the last sub-step of the tick before.

use serde::{Deserialize, Serialize};

use super::body::SolverBody;
use super::impulses::Impulses;
use super::link::Link;
use crate::blocks::BALL;
use crate::engine::ball_contact::BallRules;
use crate::engine::near::Pair;

/// State of the solver between ticks.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(in crate::engine) struct CompactSolver {
    /// Impulses of the last sub-step, in the order of its pairs.
    stored: Vec<Stored>,
    /// Mass of the ball in it, kg.
    ball_mass: f32,
    /// Length of that sub-step, s.
    time: f32,
}

/// Impulses of a pair.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
struct Stored {
    key: u32,
    features: [u32; 2],
    /// N s.
    normals: [f32; 2],
    tangent: f32,
}

impl CompactSolver {
    /// Writes the links of a tick, with the impulses that it starts from, into `links`.
    pub(super) fn link(
        &self,
        near: &[Pair],
        rules: &BallRules,
        time: f32,
        bodies: &mut Vec<SolverBody>,
        links: &mut Vec<Link>,
    ) {
        let ball_mass = rules.squeezed.map_or(rules.params.ball.mass, |squeezed| squeezed.mass);
        // Impulses on a heavy ball must not start the solution for a light one.
        let ball_is_lighter = ball_mass < self.ball_mass;
        let scale = if self.time > 0.0 { time / self.time } else { 0.0 };
        links.clear();
        for pair in near {
            let Some(mut link) = Link::of(pair, rules, bodies) else { continue };
            let stored = self.stored.iter().find(|stored| stored.key == link.key);
            let stored = stored.filter(|_| !(ball_is_lighter && link.second == BALL));
            if let Some(Stored { features, normals, tangent, .. }) = stored {
                link.impulses = Impulses {
                    normals: [0, 1].map(|point| (features[point], normals[point] * scale)),
                    tangent: tangent * scale,
                };
            }
            links.push(link);
        }
    }

    /// Stores the impulses of the last sub-step, of length `time` (s), for the next tick.
    pub(super) fn store(&mut self, links: &[Link], ball_mass: f32, time: f32) {
        (self.ball_mass, self.time) = (ball_mass, time);
        self.stored.clear();
        let pressing = links.iter().filter(|link| link.impulses.press());
        self.stored.extend(pressing.map(|link| {
            let Impulses { normals: [one, two], tangent } = link.impulses;
            Stored { key: link.key, features: [one.0, two.0], normals: [one.1, two.1], tangent }
        }));
    }

    /// Forgets the impulses: nothing touched in the last tick.
    pub(in crate::engine) fn forget(&mut self) {
        self.stored.clear();
    }
}
