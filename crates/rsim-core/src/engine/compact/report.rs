//! Contacts with an impulse in a tick.

use super::link::Link;
use crate::blocks::BALL;
use crate::engine::contacts::{BallContact, Contacts, RobotContact};

/// Writes the contacts that had an impulse in the tick.
pub(super) fn report(links: &[Link], contacts: &mut Contacts) {
    contacts.clear();
    for Link { second, with, total, .. } in links {
        let length = total.normal.length();
        if length <= 0.0 {
            continue;
        }
        let (with, normal) = (*with, total.normal / length);
        if *second == BALL {
            contacts.ball.push(BallContact { with, normal, impulse: total.impulse });
        } else {
            // The normal of a link points from the partner to this robot.
            let (robot, point) = (second - 1, total.point / total.impulse);
            contacts.robots.push(RobotContact { robot, with, normal: -normal, point });
        }
    }
}
