//! Boxes that slide over the joint of two others.
//!
//! Robots side by side have an edge at their joint, which a robot that slides along them must not catch
//! on. The contact of least depth cannot tell that edge from the side of a robot that stands alone: a
//! box whose corner is a hundredth of a millimeter deep in a face comes upon the side of the next box
//! first there. So an edge counts only if it protrudes.

use super::rectangle::{Face, Met, Rectangle};
use crate::engine::joints::PROTRUDING;
use crate::math::Vector;

/// Speed, m/s, by which boxes must close slower along the face that they slide along than along the
/// one that they would catch on. Boxes that press close by less.
const SLIDING: f32 = 0.02;

/// Whether two boxes are so slow that they do not slide, by the velocity of their centers and the speed of their
/// corners by rotation, m/s.
pub(super) fn press(velocity: Vector, rim: f32) -> bool {
    let most = SLIDING - rim;
    most > 0.0 && velocity.length_squared() < most * most
}

/// The face that two boxes meet at: that of `found`, or another that they slide along.
pub(super) fn slide(boxes: [&Rectangle; 2], faces: &[[Face; 2]; 2], found: Met, time: f32) -> Met {
    let deep = |face: &Face| face.separation < -PROTRUDING;
    let other = 1 - found.face.axis;
    let own = usize::from(found.of_second);
    if faces[1 - own].iter().all(deep) && deep(&faces[own][other]) {
        return found;
    }
    let velocity = velocity_at_corner(boxes, &found);
    let closing = |met: &Met| -velocity.dot(normal(boxes, met));
    let most = closing(&found) - SLIDING;
    if most <= 0.0 {
        return found;
    }
    let touch = found.face.after.min(time);
    let mut slowest = (most, found);
    let all = faces.iter().zip([false, true]);
    for met in all.flat_map(|(faces, of_second)| faces.map(|face| Met { face, of_second })) {
        let speed = closing(&met);
        if speed < slowest.0 && met.face.separation - speed * touch > -PROTRUDING {
            slowest = (speed, met);
        }
    }
    slowest.1
}

/// Direction of a face, from the first box to the second.
fn normal([a, b]: [&Rectangle; 2], met: &Met) -> Vector {
    let axis = if met.of_second { b.axes() } else { a.axes() }[met.face.axis];
    axis * 1.0_f32.copysign((b.body.position - a.body.position).dot(axis))
}

/// Velocity of the second box against the first at the corner that meets a face, m/s.
fn velocity_at_corner(boxes: [&Rectangle; 2], met: &Met) -> Vector {
    let normal = normal(boxes, met);
    let [a, b] = boxes;
    let apart = b.body.position - a.body.position;
    let arms = if met.of_second {
        let arm = a.corner(normal);
        [arm, arm - apart]
    } else {
        let arm = b.corner(-normal);
        [arm + apart, arm]
    };
    b.body.velocity + arms[1].perp() * b.body.angular_velocity
        - a.body.velocity
        - arms[0].perp() * a.body.angular_velocity
}
