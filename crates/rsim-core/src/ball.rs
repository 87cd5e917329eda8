//! What the floor does to the ball: it rolls and slows down, the same in every direction.

use rapier2d::math::Vector;

use crate::BallModel;
use crate::engine::Engine;

const BALL: usize = 0;

/// Closed form of one tick of rolling.
///
/// The engine moves the ball with its *mean* velocity over the tick, and afterwards gets the
/// difference to the *end* velocity added to whatever it made of it. So the path is exact at any
/// tick, and whether a contact happened in between makes no difference to the law.
pub(crate) struct Roll {
    mean: Vector,
    end: Vector,
}

impl Roll {
    pub(crate) fn over(model: &BallModel, velocity: Vector, tick: f32) -> Self {
        let speed = velocity.length();
        if speed <= 0.0 {
            return Self { mean: Vector::ZERO, end: Vector::ZERO };
        }
        let end = (speed - model.rolling_deceleration * tick).max(0.0);
        // It stops within the tick when `end` is cut off at zero.
        let rolling_time = if end > 0.0 { tick } else { speed / model.rolling_deceleration };
        let mean = speed.midpoint(end) * (rolling_time / tick);
        Self { mean: velocity * (mean / speed), end: velocity * (end / speed) }
    }

    /// Before the engine's tick.
    pub(crate) fn begin(&self, engine: &mut Engine) {
        engine.set_velocity(BALL, self.mean);
    }

    /// After the engine's tick.
    pub(crate) fn finish(&self, engine: &mut Engine) {
        let left = engine.motion(BALL).velocity;
        engine.set_velocity(BALL, left + (self.end - self.mean));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_add_up_to_the_closed_form_whatever_their_length() {
        let model = BallModel::VSS_RSIM;
        for tick in [0.0025, 0.005, 0.0125] {
            let (mut velocity, mut distance) = (Vector::new(0.6, 0.8), 0.0);
            while velocity != Vector::ZERO {
                let roll = Roll::over(&model, velocity, tick);
                distance += roll.mean.length() * tick;
                velocity = roll.end;
            }
            let expected = 1.0 / (2.0 * model.rolling_deceleration);
            assert!(
                (distance / expected - 1.0).abs() < 1e-3,
                "{distance} m, expected {expected} m"
            );
        }
    }

    #[test]
    fn a_ball_without_friction_keeps_its_speed() {
        let model = BallModel { rolling_deceleration: 0.0, ..BallModel::VSS_RSIM };
        let roll = Roll::over(&model, Vector::new(0.3, 0.0), 0.005);
        assert_eq!(roll.mean, roll.end);
        assert_eq!(roll.end, Vector::new(0.3, 0.0));
    }
}
