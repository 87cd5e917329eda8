//! How a robot handles the ball: its break beam sees it, its kicker shoots it, its dribbler holds it.

use rapier2d::glamx::Vec3;
use rapier2d::math::Vector;
use rapier2d::parry::query::PointQuery;
use rapier2d::parry::shape::Segment;

use crate::ball::{Ball, Rolling};
use crate::drive::ABSURD;
use crate::engine::Motion;
use crate::mouth_model::Mouth;
use crate::{BallModel, RobotModel};

/// Rate at which the dribbler draws the ball to the middle of the mouth, 1/s.
const DRAW: f32 = 20.0;

/// A ball in a robot's mouth.
pub(crate) struct Held<'a> {
    mouth: &'a Mouth,
    robot: &'a Motion,
    model: &'a BallModel,
    /// From the robot's centre to the ball's, in the robot's frame, m.
    place: Vector,
    /// From the front to the ball's surface, m.
    gap: f32,
}

impl<'a> Held<'a> {
    /// The ball, if it stands before the mouth and cuts the beam.
    pub(crate) fn find(
        model: &'a RobotModel,
        robot: &'a Motion,
        ball_model: &'a BallModel,
        position: Vector,
        z: f32,
    ) -> Option<Self> {
        let mouth = model.mouth.as_ref()?;
        let (front, radius) = (model.front(), ball_model.radius);
        let offset = position - robot.position;
        // Most balls are far away.
        let reach = front + mouth.beam_distance + radius + mouth.width;
        if offset.length_squared() > reach * reach {
            return None;
        }
        let side = robot.heading.perp();
        let place = Vector::new(offset.dot(robot.heading), offset.dot(side));
        let above = mouth.beam_height - (z + radius);
        let section = radius * radius - above * above;
        if place.y.abs() > mouth.width / 2.0 || section <= 0.0 {
            return None;
        }
        let beam_x = front + mouth.beam_distance;
        let half = mouth.width / 2.0;
        let beam = Segment::new(Vector::new(beam_x, -half), Vector::new(beam_x, half));
        let cut = beam.distance_to_local_point(place, true).powi(2) < section;
        cut.then_some(Self {
            mouth,
            robot,
            model: ball_model,
            place,
            gap: place.x - front - radius,
        })
    }

    /// Velocity of the robot where the ball is, m/s.
    fn carrier(&self) -> Vector {
        let arm = self.robot.heading * self.place.x + self.robot.heading.perp() * self.place.y;
        self.robot.velocity + arm.perp() * self.robot.spin
    }

    /// Velocity after a kick of `forward` and `upward` m/s relative to the front.
    ///
    /// The device's limits hold for the whole speed; part of the ball's speed across the front
    /// stays.
    pub(crate) fn kicked(&self, velocity: Vector, forward: f32, upward: f32, gain: f32) -> Vec3 {
        let most = if upward > 0.0 { self.mouth.max_chip } else { self.mouth.max_kick };
        let asked = Vector::new(forward, upward).clamp(Vector::ZERO, Vector::splat(ABSURD));
        let asked = asked.clamp_length_max(most) * gain;
        let carrier = self.carrier();
        let side = self.robot.heading.perp();
        let relative = velocity - carrier;
        let across = relative.dot(side) * self.mouth.kick_keeps;
        // A plate that is slower than the ball does not catch up with it.
        let along = asked.x.max(relative.dot(self.robot.heading));
        (carrier + self.robot.heading * along + side * across).extend(asked.y)
    }

    /// Impulse of the dribbler on the ball in a tick, N s, at a share of its speed.
    ///
    /// It draws the ball to the middle of the mouth and along with the robot, as hard as its grip
    /// allows and no harder.
    pub(crate) fn pull(&self, velocity: Vector, share: f32, tick: f32) -> Vector {
        let side = self.robot.heading.perp();
        let inward = self.robot.heading * -self.gap.max(0.0) - side * self.place.y;
        let missing = self.carrier() + inward * DRAW - velocity;
        (missing * self.model.mass).clamp_length_max(self.mouth.grip * share * tick)
    }

    /// Back-spin that the bar gives the ball in a tick: its friction, until the ball turns as the
    /// bar does.
    pub(crate) fn spun(&self, rolling: Rolling, share: f32, tick: f32) -> Rolling {
        let radius = self.model.radius;
        let wanted = self.robot.heading * (-self.mouth.bar_speed * share);
        // A solid sphere's rim follows a force at it 2.5 times as readily as its centre.
        let force = self.mouth.bar_friction * self.mouth.bar_force * share;
        let most = 2.5 * force / self.model.mass * tick;
        let rim = rolling.rim(radius);
        rolling.with_rim(rim + (wanted - rim).clamp_length_max(most), radius)
    }
}

/// Whether a robot's beam is cut.
pub(crate) fn sees(
    model: &RobotModel,
    robot: &Motion,
    ball_model: &BallModel,
    position: Vector,
    ball: &Ball,
) -> bool {
    Held::find(model, robot, ball_model, position, ball.z).is_some()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether the generic SSL robot at the centre, facing +x, sees a ball there.
    fn seen(x: f32, y: f32, z: f32) -> bool {
        let robot = Motion {
            position: Vector::ZERO,
            heading: Vector::X,
            velocity: Vector::ZERO,
            spin: 0.0,
        };
        let (model, ball) = (RobotModel::SSL_GENERIC, BallModel::SSL_TIGERS);
        let (at, ball_state) = (Vector::new(x, y), Ball { z, ..Ball::default() });
        sees(&model, &robot, &ball, at, &ball_state)
    }

    #[test]
    fn the_beam_is_cut_from_the_front_to_its_distance() {
        let touching = 0.0715 + 0.0215;
        assert!(seen(touching, 0.0, 0.0));
        assert!(seen(touching + 0.009, 0.0, 0.0));
        assert!(!seen(touching + 0.011, 0.0, 0.0));
    }

    #[test]
    fn what_is_beside_or_above_the_mouth_does_not_cut_it() {
        let touching = 0.0715 + 0.0215;
        assert!(seen(touching, 0.032, 0.0) && seen(touching, -0.032, 0.0));
        assert!(!seen(touching, 0.034, 0.0));
        assert!(!seen(-touching, 0.0, 0.0), "behind it");
        assert!(seen(touching, 0.0, 0.01));
        assert!(!seen(touching, 0.0, 0.022), "it flies over the beam");
    }
}
