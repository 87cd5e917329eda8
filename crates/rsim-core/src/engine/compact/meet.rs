//! Contact of any two outlines within one sub-step.

use super::boxes::boxes;
use super::discs::{discs, outline_and_disc};
use super::manifold::{Manifold, Moving};
use crate::geometry::outline::Outline;

/// Contact of two outlines that touch within `time` (s), or that are at most `reach` (m) apart.
pub(super) fn meet(a: &Moving, b: &Moving, time: f32, reach: f32) -> Option<Manifold> {
    match (a.place.outline, b.place.outline) {
        (Outline::Disc { radius: first }, Outline::Disc { radius: second }) => {
            discs(a, first, b, second, time, reach)
        }
        (Outline::Box { half: first }, Outline::Box { half: second }) => {
            boxes((a, first), (b, second), time, reach)
        }
        (_, Outline::Disc { radius }) => outline_and_disc(a, b, radius, time, reach),
        (Outline::Disc { radius }, _) => {
            outline_and_disc(b, a, radius, time, reach).map(Manifold::reversed)
        }
        // Robots meet robots and walls as discs or boxes.
        _ => None,
    }
}
