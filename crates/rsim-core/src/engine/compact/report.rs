//! Contacts with an impulse in a tick.

use super::body::SolverBody;
use super::link::Link;
use crate::blocks::BALL;
use crate::engine::contacts::{BallContact, Contacts, Partner, RobotContact};

/// Writes the contacts that had an impulse in the tick.
///
/// Bodies move on after a contact. Its point moves with them, so that a bounce has the levers of the
/// contact.
pub(super) fn report(links: &[Link], bodies: &[SolverBody], contacts: &mut Contacts) {
    contacts.clear();
    for Link { first, second, with, total, .. } in links {
        let length = total.normal.length();
        if length <= 0.0 {
            continue;
        }
        let (with, normal) = (*with, total.normal / length);
        if *second == BALL {
            let (impulse, arm) = (total.impulse, total.arms[0] / total.impulse);
            contacts.ball.push(BallContact { with, normal, impulse, arm });
        } else {
            let [on_first, on_second] = [(first, total.arms[0]), (second, total.arms[1])]
                .map(|(body, arm)| bodies[*body].position + arm / total.impulse);
            let point = match with {
                Partner::Robot(_) => on_first.midpoint(on_second),
                Partner::Wall(_) => on_second,
            };
            // The normal of a link points from the partner to this robot.
            contacts.robots.push(RobotContact { robot: second - 1, with, normal: -normal, point });
        }
    }
}
