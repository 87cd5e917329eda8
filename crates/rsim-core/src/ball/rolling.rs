//! The ball on the floor: it slides until it rolls, and slows down, the same in every direction.

use crate::math::{Vec3, Vector};
use crate::models::ball::BallModel;

/// Speed below which a rolling ball stops, m/s: a real one drops into a dimple of the carpet
/// (ER-Force's simulator).
const STOP_SPEED: f32 = 0.01;

/// Motion of a ball on the floor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct GroundMotion {
    /// m/s.
    pub(crate) velocity: Vector,
    /// Spin about the field's axes, rad/s.
    pub(crate) spin: Vec3,
}

impl GroundMotion {
    /// The velocity at which a ball with this spin rolls without slip, m/s.
    pub(crate) fn rolling_velocity(&self, radius: f32) -> Vector {
        Vector::new(self.spin.y, -self.spin.x) * radius
    }

    /// The motion with the spin of another rolling velocity, m/s.
    pub(crate) fn with_rolling_velocity(self, rolling_velocity: Vector, radius: f32) -> Self {
        Self {
            spin: Vec3::new(-rolling_velocity.y / radius, rolling_velocity.x / radius, self.spin.z),
            ..self
        }
    }

    /// The motion with the spin at which the ball rolls without slip.
    pub(crate) fn without_slip(self, radius: f32) -> Self {
        self.with_rolling_velocity(self.velocity, radius)
    }

    /// Displacement (m) and motion after `time` (s) without contacts, in closed form.
    ///
    /// While the lowest point slips, friction slows the ball along the slip and changes its spin; the
    /// slip keeps its direction. A rolling ball slows along its path.
    pub(crate) fn after(self, model: &BallModel, time: f32) -> (Vector, Self) {
        let rolling_velocity = self.rolling_velocity(model.radius);
        let slip = self.velocity - rolling_velocity;
        let slip_speed = slip.length();
        // For each m/s that sliding takes from the velocity, the rolling velocity gains `spin_up` m/s.
        let spin_up = model.slide_to_roll_ratio / (1.0 - model.slide_to_roll_ratio);
        let slide = model.sliding_deceleration;
        let sliding_time = if slip_speed <= SLIP_ERROR {
            0.0
        } else {
            (slip_speed / (slide * (1.0 + spin_up))).min(time)
        };
        let mut displacement = Vector::ZERO;
        let mut now = self;
        if sliding_time > 0.0 {
            let along = slip / slip_speed * slide;
            displacement = (self.velocity - along * (sliding_time / 2.0)) * sliding_time;
            now.velocity -= along * sliding_time;
            now = now.with_rolling_velocity(
                rolling_velocity + along * (spin_up * sliding_time),
                model.radius,
            );
        }
        let rolling_time = time - sliding_time;
        if rolling_time > 0.0 {
            let (added, velocity) = roll(now.velocity, model.rolling_deceleration, rolling_time);
            displacement += added;
            now = Self { velocity, ..now }.without_slip(model.radius);
        }
        now.spin.z = towards_zero(self.spin.z, model.spin_deceleration * time);
        (displacement, now)
    }
}

/// Slip of a rolling ball by rounding, m/s.
const SLIP_ERROR: f32 = 1e-5;

/// Displacement (m) and velocity (m/s) after `time` (s) of rolling.
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

    fn kicked(velocity: Vector) -> GroundMotion {
        GroundMotion { velocity, spin: Vec3::ZERO }
    }

    /// Rolls to rest in steps of `tick`. Returns distance and time.
    fn roll_out(model: &BallModel, start: GroundMotion, tick: f32) -> (f32, f32) {
        let (mut now, mut displacement, mut time) = (start, Vector::ZERO, 0.0);
        while now.velocity != Vector::ZERO || now.spin != Vec3::ZERO {
            let (added, next) = now.after(model, tick);
            (displacement, now, time) = (displacement + added, next, time + tick);
        }
        (displacement.length(), time)
    }

    #[test]
    fn ticks_of_any_length_add_up_to_the_closed_form() {
        for model in BallModel::PRESETS {
            let speed = 1.0_f32;
            let rolls = speed * model.slide_to_roll_ratio;
            let expected = (speed * speed - rolls * rolls) / (2.0 * model.sliding_deceleration)
                + rolls * rolls / (2.0 * model.rolling_deceleration);
            for tick in [0.001, 0.0025, 0.005] {
                let (displacement, _) = roll_out(&model, kicked(Vector::new(0.6, 0.8)), tick);
                let error = (displacement / expected - 1.0).abs();
                assert!(error < 2e-3, "{}: {displacement} m, expected {expected} m", model.name);
            }
        }
    }

    #[test]
    fn a_rolling_ball_does_not_slide() {
        let model = BallModel::SSL_TIGERS;
        let rolling = kicked(Vector::new(2.0, 0.0)).without_slip(model.radius);
        let (_, after) = rolling.after(&model, 0.1);
        assert!((after.velocity.x - (2.0 - 0.026)).abs() < 1e-5, "{after:?}");
    }

    #[test]
    fn back_spin_brakes_and_can_reverse_the_ball() {
        let model = BallModel::SSL_TIGERS;
        let start = kicked(Vector::new(1.0, 0.0))
            .with_rolling_velocity(Vector::new(-4.0, 0.0), model.radius);
        let (_, braking) = start.after(&model, 0.1);
        assert!((braking.velocity.x - 0.7).abs() < 1e-5);
        let (_, back) = start.after(&model, 0.6);
        // Slip 5 m/s is gone after 5 / (3 (1 + 2)) s, with 1 - 5/3 m/s left.
        let expected = -(2.0 / 3.0 - 0.26 * (0.6 - 5.0 / 9.0));
        assert!((back.velocity.x - expected).abs() < 1e-4, "{back:?}");
    }

    #[test]
    fn spin_about_the_vertical_axis_decays_by_its_law() {
        let model = BallModel::SSL_TIGERS;
        let start = GroundMotion { velocity: Vector::ZERO, spin: Vec3::new(0.0, 0.0, -20.0) };
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
        let (displacement, after) = kicked(Vector::new(0.3, 0.0)).after(&model, 0.005);
        assert_eq!(after.velocity, Vector::new(0.3, 0.0));
        assert!((displacement.x - 0.0015).abs() < 1e-7);
    }
}
