//! The ball: what it is at an instant, and what the floor does to it. It slides until it rolls,
//! and slows down, the same in every direction.

use rapier2d::glamx::Vec3;
use rapier2d::math::Vector;
use serde::{Deserialize, Serialize};

use crate::BallModel;

/// Speed below which a rolling ball stops, m/s: a real one drops into a dimple of the carpet
/// (ER-Force's simulator).
const STOP_SPEED: f32 = 0.01;

/// What the plane does not know of the ball.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Ball {
    /// Height of its lowest point, m.
    pub(crate) z: f32,
    /// m/s.
    pub(crate) v_z: f32,
    /// rad/s, about the field's axes.
    pub(crate) spin: Vec3,
    /// Touch-downs since it took off.
    pub(crate) hops: u8,
}

impl Ball {
    /// Whether the floor carries it, so that it meets others in the plane.
    pub(crate) fn is_down(&self) -> bool {
        self.z <= 0.0 && self.v_z == 0.0
    }
}

/// How a ball moves along the floor at an instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rolling {
    pub(crate) velocity: Vector,
    pub(crate) spin: Vec3,
}

impl Rolling {
    /// The velocity at which a ball with this spin rolls, m/s.
    pub(crate) fn rim(&self, radius: f32) -> Vector {
        Vector::new(self.spin.y, -self.spin.x) * radius
    }

    /// With another rim speed, m/s.
    pub(crate) fn with_rim(self, rim: Vector, radius: f32) -> Self {
        Self { spin: Vec3::new(-rim.y / radius, rim.x / radius, self.spin.z), ..self }
    }

    /// Makes it roll at its speed.
    pub(crate) fn rolled(self, radius: f32) -> Self {
        self.with_rim(self.velocity, radius)
    }

    /// Closed form of `time` on the floor with nothing in the way: how far it gets (m), and how it
    /// moves then.
    ///
    /// While the lowest point slips, friction slows the ball along the slip and spins it up; the
    /// slip keeps its direction. Once it rolls, it slows along its way.
    pub(crate) fn after(self, model: &BallModel, time: f32) -> (Vector, Self) {
        let rim = self.rim(model.radius);
        let slip = self.velocity - rim;
        let slipping = slip.length();
        // A slide takes `1` from the velocity and gives `spin_up` to the rim, for each m/s.
        let spin_up = model.rolling_share / (1.0 - model.rolling_share);
        let slide = model.sliding_deceleration;
        let sliding_time = if slipping <= SLIP_ERROR {
            0.0
        } else {
            (slipping / (slide * (1.0 + spin_up))).min(time)
        };
        let mut way = Vector::ZERO;
        let mut now = self;
        if sliding_time > 0.0 {
            let along = slip / slipping * slide;
            way = (self.velocity - along * (sliding_time / 2.0)) * sliding_time;
            now.velocity -= along * sliding_time;
            now = now.with_rim(rim + along * (spin_up * sliding_time), model.radius);
        }
        let rolling_time = time - sliding_time;
        if rolling_time > 0.0 {
            let (further, velocity) = roll(now.velocity, model.rolling_deceleration, rolling_time);
            way += further;
            now = Self { velocity, ..now }.rolled(model.radius);
        }
        now.spin.z = towards_zero(self.spin.z, model.spin_deceleration * time);
        (way, now)
    }
}

/// Slip that counts as none, m/s: what rounding makes of a rolling ball.
const SLIP_ERROR: f32 = 1e-5;

/// Way and velocity after `time` of rolling.
fn roll(velocity: Vector, deceleration: f32, time: f32) -> (Vector, Vector) {
    let speed = velocity.length();
    if deceleration == 0.0 {
        return (velocity * time, velocity);
    }
    if speed <= STOP_SPEED {
        return (Vector::ZERO, Vector::ZERO);
    }
    let until_stop = (speed - STOP_SPEED) / deceleration;
    let (rolling_time, end) =
        if time < until_stop { (time, speed - deceleration * time) } else { (until_stop, 0.0) };
    let mean = speed - deceleration * rolling_time / 2.0;
    (velocity * (mean / speed * rolling_time), velocity * (end / speed))
}

fn towards_zero(value: f32, by: f32) -> f32 {
    (value.abs() - by).max(0.0).copysign(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kicked(velocity: Vector) -> Rolling {
        Rolling { velocity, spin: Vec3::ZERO }
    }

    /// Rolls out in steps of `tick`; how far it gets and how long it takes.
    fn roll_out(model: &BallModel, start: Rolling, tick: f32) -> (f32, f32) {
        let (mut now, mut way, mut time) = (start, Vector::ZERO, 0.0);
        while now.velocity != Vector::ZERO || now.spin != Vec3::ZERO {
            let (further, next) = now.after(model, tick);
            (way, now, time) = (way + further, next, time + tick);
        }
        (way.length(), time)
    }

    #[test]
    fn ticks_add_up_to_the_closed_form_whatever_their_length() {
        for model in BallModel::PRESETS {
            let speed = 1.0_f32;
            let rolls = speed * model.rolling_share;
            let expected = (speed * speed - rolls * rolls) / (2.0 * model.sliding_deceleration)
                + rolls * rolls / (2.0 * model.rolling_deceleration);
            for tick in [0.001, 0.0025, 0.005] {
                let (way, _) = roll_out(&model, kicked(Vector::new(0.6, 0.8)), tick);
                let error = (way / expected - 1.0).abs();
                assert!(error < 2e-3, "{}: {way} m, expected {expected} m", model.name);
            }
        }
    }

    #[test]
    fn a_rolling_ball_does_not_slide() {
        let model = BallModel::SSL_TIGERS;
        let rolling = kicked(Vector::new(2.0, 0.0)).rolled(model.radius);
        let (_, after) = rolling.after(&model, 0.1);
        assert!((after.velocity.x - (2.0 - 0.026)).abs() < 1e-5, "{after:?}");
    }

    #[test]
    fn back_spin_brakes_and_can_bring_it_back() {
        let model = BallModel::SSL_TIGERS;
        let start = kicked(Vector::new(1.0, 0.0)).with_rim(Vector::new(-4.0, 0.0), model.radius);
        let (_, braking) = start.after(&model, 0.1);
        assert!((braking.velocity.x - 0.7).abs() < 1e-5);
        let (_, back) = start.after(&model, 0.6);
        // Slip 5 m/s is gone after 5 / (3 (1 + 2)) s, with 1 - 5/3 m/s left.
        let expected = -(2.0 / 3.0 - 0.26 * (0.6 - 5.0 / 9.0));
        assert!((back.velocity.x - expected).abs() < 1e-4, "{back:?}");
    }

    #[test]
    fn spin_about_the_vertical_axis_fades_by_its_law() {
        let model = BallModel::SSL_TIGERS;
        let start = Rolling { velocity: Vector::ZERO, spin: Vec3::new(0.0, 0.0, -20.0) };
        assert!((start.after(&model, 0.5).1.spin.z + 15.0).abs() < 1e-4);
        assert!(start.after(&model, 3.0).1.spin.z.abs() <= 0.0);
    }

    #[test]
    fn a_ball_without_friction_keeps_its_speed() {
        let model = BallModel {
            sliding_deceleration: 0.0,
            rolling_deceleration: 0.0,
            ..BallModel::VSS_RSIM
        };
        let (way, after) = kicked(Vector::new(0.3, 0.0)).after(&model, 0.005);
        assert_eq!(after.velocity, Vector::new(0.3, 0.0));
        assert!((way.x - 0.0015).abs() < 1e-7);
    }
}
