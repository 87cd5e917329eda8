//! Break beam, kicker and dribbler of a robot, as they act on the ball.

use crate::ball::kicker::Kicker;
use crate::ball::rolling::GroundMotion;
use crate::ball::state::BallState;
use crate::columns::MAX_COMMAND;
use crate::geometry::motion::Motion;
use crate::math::{Vec3, Vector};
use crate::models::ball::BallModel;
use crate::models::mouth::Mouth;
use crate::models::robot::RobotModel;

/// Rate at which the dribbler centers the ball in the mouth, 1/s.
const CENTERING_RATE: f32 = 20.0;

/// A ball in a robot's mouth.
pub(crate) struct HeldBall<'a> {
    mouth: &'a Mouth,
    robot: &'a Motion,
    model: &'a BallModel,
    /// Vector from the robot's center to the ball's, in the robot's frame, m.
    place: Vector,
    /// Distance from the front to the ball's surface, m.
    gap: f32,
}

impl<'a> HeldBall<'a> {
    /// The ball at `position` and height `z`, if it is in front of the mouth and cuts the beam.
    pub(crate) fn find(
        model: &'a RobotModel,
        robot: &'a Motion,
        ball_model: &'a BallModel,
        position: Vector,
        z: f32,
    ) -> Option<Self> {
        let mouth = model.mouth.as_ref()?;
        let (front, radius) = (model.front_distance(), ball_model.radius);
        let offset = position - robot.position;
        // Quick test: most balls are far away.
        let reach = model.mouth_reach()? + radius;
        if offset.length_squared() > reach * reach {
            return None;
        }
        let side = robot.heading.perp();
        let place = Vector::new(offset.dot(robot.heading), offset.dot(side));
        let above = mouth.beam_height - (z + radius);
        let section = radius * radius - above * above;
        if place.y.abs() > mouth.mouth_width / 2.0 || section <= 0.0 {
            return None;
        }
        let beam_x = front + mouth.beam_distance;
        let cut = (place.x - beam_x).powi(2) < section;
        cut.then_some(Self {
            mouth,
            robot,
            model: ball_model,
            place,
            gap: place.x - front - radius,
        })
    }

    /// Whether the kicker reaches the ball.
    pub(crate) fn is_reached(&self) -> bool {
        self.gap <= self.mouth.kicker_reach
    }

    /// Velocity of the robot at the ball's center, m/s.
    fn robot_velocity(&self) -> Vector {
        let arm = self.robot.heading * self.place.x + self.robot.heading.perp() * self.place.y;
        self.robot.velocity + arm.perp() * self.robot.angular_velocity
    }

    /// Velocity of the ball after a kick of `forward` and `upward` m/s relative to the front.
    ///
    /// The device's limits apply to the total speed; part of the ball's speed across the front
    /// remains.
    pub(crate) fn kicked(
        &self,
        velocity: Vector,
        forward: f32,
        upward: f32,
        kicker: Kicker,
    ) -> Vec3 {
        let limit =
            if upward > 0.0 { self.mouth.max_chip_speed } else { self.mouth.max_kick_speed };
        let commanded =
            Vector::new(forward, upward).clamp(Vector::ZERO, Vector::splat(MAX_COMMAND));
        let commanded = commanded.clamp_length_max(limit) * kicker.gain;
        let robot_velocity = self.robot_velocity();
        let side = self.robot.heading.perp();
        let relative = velocity - robot_velocity;
        let across = relative.dot(side) * self.mouth.kick_lateral_factor;
        // A plate that is slower than the ball does not reach it.
        let along = commanded.x.max(relative.dot(self.robot.heading));
        let (ahead, aside) = (kicker.direction * along, kicker.direction.perp() * across);
        let relative = ahead + aside;
        (robot_velocity + self.robot.heading * relative.x + side * relative.y).extend(commanded.y)
    }

    /// Impulse of the dribbler on the ball in a tick, N s. `speed` is the dribbler's, 0 to 1.
    ///
    /// The dribbler pulls the ball to the middle of the mouth and along with the robot, within its grip.
    pub(crate) fn dribbler_impulse(&self, velocity: Vector, speed: f32, tick: f32) -> Vector {
        let side = self.robot.heading.perp();
        let inward = self.robot.heading * -self.gap.max(0.0) - side * self.place.y;
        let error = self.robot_velocity() + inward * CENTERING_RATE - velocity;
        (error * self.model.mass).clamp_length_max(self.mouth.dribbler_grip * speed * tick)
    }

    /// Motion of the ball after a tick of the bar's friction, which spins it until its surface moves with
    /// the bar. `speed` is the dribbler's, 0 to 1.
    pub(crate) fn spun(&self, ball: GroundMotion, speed: f32, tick: f32) -> GroundMotion {
        let radius = self.model.radius;
        let target = self.robot.heading * (-self.mouth.dribbler_speed * speed);
        // A force at a solid sphere's surface accelerates the surface by its rotation 2.5 times as much
        // as the center.
        let force = self.mouth.dribbler_friction * self.mouth.dribbler_force * speed;
        let limit = 2.5 * force / self.model.mass * tick;
        let now = ball.rolling_velocity(radius);
        ball.with_rolling_velocity(now + (target - now).clamp_length_max(limit), radius)
    }
}

/// Whether the ball cuts a robot's break beam.
pub(crate) fn beam_is_cut(
    model: &RobotModel,
    robot: &Motion,
    ball_model: &BallModel,
    position: Vector,
    ball: &BallState,
) -> bool {
    HeldBall::find(model, robot, ball_model, position, ball.z).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a ball there cuts the beam of the generic SSL robot at the center, facing +x.
    fn is_cut(x: f32, y: f32, z: f32) -> bool {
        let robot = Motion::at_rest(Vector::ZERO, Vector::X);
        let (model, ball) = (RobotModel::SSL_GENERIC, BallModel::SSL_TIGERS);
        let (at, ball_state) = (Vector::new(x, y), BallState { z, ..BallState::default() });
        beam_is_cut(&model, &robot, &ball, at, &ball_state)
    }

    #[test]
    fn the_beam_is_cut_from_the_front_to_its_distance() {
        let touching = 0.0715 + 0.0215;
        assert!(is_cut(touching, 0.0, 0.0));
        assert!(is_cut(touching + 0.009, 0.0, 0.0));
        assert!(!is_cut(touching + 0.011, 0.0, 0.0));
    }

    #[test]
    fn a_ball_beside_or_above_the_mouth_does_not_cut_the_beam() {
        let touching = 0.0715 + 0.0215;
        assert!(is_cut(touching, 0.032, 0.0) && is_cut(touching, -0.032, 0.0));
        assert!(!is_cut(touching, 0.034, 0.0));
        assert!(!is_cut(-touching, 0.0, 0.0), "behind it");
        assert!(is_cut(touching, 0.0, 0.01));
        assert!(!is_cut(touching, 0.0, 0.022), "it flies over the beam");
    }
}
