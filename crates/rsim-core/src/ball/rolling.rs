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
            let (added, velocity) = roll(now.velocity, model, rolling_time);
            displacement += added;
            now = Self { velocity, ..now }.without_slip(model.radius);
        }
        now.spin.z = toward_zero(self.spin.z, model.spin_deceleration * time);
        (displacement, now)
    }
}

/// Slip of a rolling ball by rounding, m/s.
const SLIP_ERROR: f32 = 1e-5;

/// Displacement (m) and velocity (m/s) after `time` (s) of rolling.
fn roll(velocity: Vector, model: &BallModel, time: f32) -> (Vector, Vector) {
    if model.rolling_drag > 0.0 {
        return roll_with_drag(velocity, model, time);
    }
    let deceleration = model.rolling_deceleration;
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

/// As [`roll`], for a deceleration that grows with the speed: v' = -(deceleration + drag v).
fn roll_with_drag(velocity: Vector, model: &BallModel, time: f32) -> (Vector, Vector) {
    let (deceleration, drag) = (model.rolling_deceleration, model.rolling_drag);
    let speed = velocity.length();
    if speed <= STOP_SPEED {
        return (Vector::ZERO, Vector::ZERO);
    }
    let first = deceleration + drag * speed;
    let last = deceleration + drag * STOP_SPEED;
    let until_stop = libm::log1pf(drag * (speed - STOP_SPEED) / last) / drag;
    let rolling_time = time.min(until_stop);
    let fade = drag * rolling_time;
    let (loss, delay) = (first * rolling_time, decay_integral(fade));
    let way = (speed - loss * delay) * rolling_time;
    let end = if time < until_stop { speed - loss * (1.0 - fade * delay) } else { 0.0 };
    (velocity * (way / speed), velocity * (end / speed))
}

/// (exp(-z) - 1 + z) / z² for z >= 0: the mean over a time of what decays at a constant rate, integrated.
fn decay_integral(z: f32) -> f32 {
    // The closed form cancels where z is small; there its series converges fast.
    if z > 0.5 {
        return (libm::expf(-z) - 1.0 + z) / (z * z);
    }
    let divisors = [9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0];
    divisors.iter().fold(1.0, |sum, divisor| 1.0 - z / divisor * sum) / 2.0
}

fn toward_zero(value: f32, by: f32) -> f32 {
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

    /// Distance that a ball rolls until it stops, m.
    fn roll_out_way(model: &BallModel, speed: f32) -> f32 {
        let (deceleration, drag) = (model.rolling_deceleration, model.rolling_drag);
        if drag > 0.0 {
            (speed - deceleration / drag * (drag * speed / deceleration).ln_1p()) / drag
        } else {
            speed * speed / (2.0 * deceleration)
        }
    }

    #[test]
    fn ticks_of_any_length_add_up_to_the_closed_form() {
        for model in BallModel::PRESETS {
            let speed = 1.0_f32;
            let rolls = speed * model.slide_to_roll_ratio;
            let expected = (speed * speed - rolls * rolls) / (2.0 * model.sliding_deceleration)
                + roll_out_way(&model, rolls);
            for tick in [0.001, 0.0025, 0.005] {
                let (displacement, _) = roll_out(&model, kicked(Vector::new(0.6, 0.8)), tick);
                let error = (displacement / expected - 1.0).abs();
                assert!(error < 2e-3, "{}: {displacement} m, expected {expected} m", model.name);
            }
        }
    }

    /// A ball without slip, on a floor with these numbers.
    fn rolling(deceleration: f32, drag: f32, velocity: Vector) -> (BallModel, GroundMotion) {
        let model = BallModel {
            rolling_deceleration: deceleration,
            rolling_drag: drag,
            ..BallModel::SSL_TIGERS
        };
        (model.clone(), kicked(velocity).without_slip(model.radius))
    }

    /// Speed and distance by v' = -(deceleration + drag v) in steps of 10 microseconds.
    fn by_the_law(deceleration: f64, drag: f64, speed: f64, time: f64) -> (f64, f64) {
        let (mut speed, mut way, mut left) = (speed, 0.0, time);
        while left > 0.5e-5 && speed > f64::from(STOP_SPEED) {
            let before = speed;
            speed -=
                (deceleration + drag * (before - (deceleration + drag * before) * 0.5e-5)) * 1e-5;
            way += f64::midpoint(before, speed) * 1e-5;
            left -= 1e-5;
        }
        (if left > 0.5e-5 { 0.0 } else { speed }, way)
    }

    #[test]
    fn a_deceleration_that_grows_with_the_speed_follows_its_law_at_every_tick() {
        for (deceleration, drag) in [(0.15, 0.04), (0.3, 2.0), (0.0, 0.5), (0.14, 1e-4)] {
            for (speed, time) in [(4.0_f32, 2.0), (0.5, 1.0), (0.02, 0.5), (3.0, 8.0)] {
                let (model, start) = rolling(deceleration, drag, Vector::new(0.6, 0.8) * speed);
                let law = [deceleration, drag, speed].map(f64::from);
                let (end, way) = by_the_law(law[0], law[1], law[2], f64::from(time));
                for tick in [0.001, 0.005, time] {
                    let (mut now, mut displacement) = (start, Vector::ZERO);
                    for _ in 0..steps(time, tick) {
                        let (added, next) = now.after(&model, tick);
                        (displacement, now) = (displacement + added, next);
                    }
                    let label = format!("{deceleration} {drag} {speed} m/s, {tick} of {time} s");
                    let error = (f64::from(now.velocity.length()) - end).abs();
                    assert!(error < 2e-4 * f64::from(speed) + 2e-5, "{label}: {now:?}, {end} m/s");
                    let error = (f64::from(displacement.length()) - way).abs();
                    assert!(error < 2e-4 * way + 1e-5, "{label}: {displacement}, {way} m");
                    let slip = now.velocity - now.rolling_velocity(model.radius);
                    assert!(slip.length() < 1e-5, "{label}: it rolls");
                }
            }
        }
    }

    #[test]
    fn a_drag_of_almost_0_is_none() {
        for time in [0.005, 1.0, 30.0] {
            let (none, start) = rolling(0.26, 0.0, Vector::new(2.0, 0.0));
            let (little, _) = rolling(0.26, 1e-6, Vector::new(2.0, 0.0));
            let [(a, first), (b, second)] = [start.after(&none, time), start.after(&little, time)];
            assert!((a - b).length() < 1e-4 && (first.velocity - second.velocity).length() < 1e-4);
        }
    }

    fn steps(time: f32, tick: f32) -> usize {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small number
        let steps = (time / tick).round() as usize;
        steps
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
