//! From an order to a command: ways, braking, distances to keep.

use rsim_referee::Vector;

use crate::avoidance::Limit;
use crate::bounds::Bounds;
use crate::config::TeamConfig;
use crate::order::Order;
use crate::path::{self, Obstacles};
use crate::pitch::Pitch;
use crate::plane::{Plane, turn_to};
use crate::skill::Skill;
use crate::tactics::Tactics;
use crate::view::{Player, View};

/// Angular velocity by the angle that is left, 1/s.
const TURN_GAIN: f32 = 9.0;
/// Angular velocity without the ball, rad/s.
const MAX_TURNING: f32 = 12.0;
/// Angular acceleration with which robots plan to brake, rad/s².
const TURN_BRAKING: f32 = 30.0;
/// Speed at which a robot leaves a place where it must not be, m/s for each m.
const LEAVING_GAIN: f32 = 6.0;
/// Speed toward a limit by the distance that is left, 1/s: half a step's way is left after a step.
const LIMIT_GAIN: f32 = 20.0;
/// Distance from other robots that ways keep, m.
const OWN_ROOM: f32 = 0.03;
/// Distance within which other robots limit the speed, m.
const NEAR: f32 = 1.5;
/// Gap at which robots do not close any more, m.
const CONTACT_GAP: f32 = 0.02;
/// Time for which others are expected to go on, s.
const FORESIGHT: f32 = 0.25;

/// Field, robots and limits of a step.
pub(crate) struct Driving<'a> {
    pub(crate) config: &'a TeamConfig,
    pub(crate) pitch: &'a Pitch,
    pub(crate) skill: &'a Skill,
    pub(crate) tactics: &'a Tactics,
    pub(crate) view: &'a View,
}

impl Driving<'_> {
    /// The command of a robot, with the columns of an omnidirectional robot.
    pub(crate) fn command(&self, robot: &Player, order: &Order, bounds: &Bounds) -> [f32; 6] {
        let velocity = self.velocity(robot, order, bounds);
        let turning = self.turning(robot, order);
        // The command holds for a step in which the robot turns.
        let half_turn = 0.5 * robot.angular_velocity * self.config.time_step;
        let ahead = (robot.heading + robot.heading.left() * half_turn).unit_or(robot.heading);
        let own = velocity.seen_from(ahead);
        [own.x, own.y, turning, order.kick[0], order.kick[1], order.dribbler]
    }

    fn velocity(&self, robot: &Player, order: &Order, bounds: &Bounds) -> Vector {
        let radius = self.config.robot.radius;
        let target = bounds.allowed(order.target, self.pitch, radius);
        let corner = if order.straight {
            target
        } else {
            let obstacles = self.obstacles(robot, target, order, bounds);
            path::next_corner(robot.position, target, &obstacles, self.pitch)
        };
        let way = corner - robot.position;
        let length = way.length() + corner.distance(target);
        let braking = self.tactics.braking_share * self.config.robot.max_deceleration;
        let speed = (2.0 * braking * length).sqrt().min(self.tactics.position_gain * length);
        let wanted = way.unit_or(Vector::default()) * speed + order.moving;
        let mut velocity = wanted.limited(order.max_speed.min(bounds.max_speed));
        let braking = self.tactics.limit_braking.min(0.8 * order.acceleration);
        for limit in bounds.limits(robot.position, self.pitch) {
            velocity = kept_off(velocity, &limit, braking);
        }
        for limit in self.walls(robot.position) {
            velocity = kept_off(velocity, &limit, braking);
        }
        velocity = self.kept_off_robots(robot, velocity);
        let is_faster = velocity.length() > robot.velocity.length();
        let own = if is_faster {
            self.skill.acceleration_with(self.tactics) * self.config.robot.max_acceleration
        } else {
            f32::INFINITY
        };
        let change = order.acceleration.min(own) * self.config.time_step;
        robot.velocity + (velocity - robot.velocity).limited(change)
    }

    /// The walls beside a robot.
    fn walls(&self, place: Vector) -> [Limit; 2] {
        let lines = &self.pitch.lines;
        let radius = self.config.robot.radius;
        let x = Vector::new(-place.x.signum(), 0.0);
        let y = Vector::new(0.0, -place.y.signum());
        [
            Limit { distance: lines.boundary_x - place.x.abs() - radius, away: x },
            Limit { distance: lines.boundary_y - place.y.abs() - radius, away: y },
        ]
    }

    fn obstacles(
        &self,
        robot: &Player,
        target: Vector,
        order: &Order,
        bounds: &Bounds,
    ) -> Obstacles {
        let from = robot.position;
        let reach = from.distance(target) + 1.0;
        let mut obstacles = Obstacles::new([bounds.own_area, Some(bounds.their_area)]);
        let diameter = 2.0 * self.config.robot.radius;
        let mut add = |other: &Player, room: f32| {
            if other.position.distance(from) < reach {
                let time = (from.distance(other.position) / bounds.max_speed).min(FORESIGHT);
                let place = other.position + other.velocity * time;
                obstacles.add(place, diameter + room, from, target);
            }
        };
        for other in self.view.own.iter().filter(|other| other.index != robot.index) {
            add(other, OWN_ROOM);
        }
        for other in self.view.others.iter() {
            add(other, self.tactics.their_room);
        }
        if order.ball_distance > 0.0 {
            obstacles.add(self.view.ball.position, order.ball_distance, from, target);
        }
        let avoided = &bounds.avoided;
        if avoided.distance > 0.0 && avoided.ends[0] == avoided.ends[1] {
            obstacles.add(avoided.ends[0], avoided.distance, from, target);
        }
        obstacles
    }

    /// The velocity with its part toward near robots limited, so that they do not crash or push.
    fn kept_off_robots(&self, robot: &Player, mut velocity: Vector) -> Vector {
        let diameter = 2.0 * self.config.robot.radius;
        let own = self.view.own.iter().filter(|other| other.index != robot.index);
        let own = own.map(|other| (other, 2.0));
        let others = self.view.others.iter().map(|other| (other, 1.0));
        for (other, easing) in own.chain(others) {
            let to = other.position - robot.position;
            let distance = to.length();
            if distance > NEAR {
                continue;
            }
            let ahead = to.unit_or(Vector::new(1.0, 0.0));
            let gap = distance - diameter;
            let closing =
                (2.0 * self.tactics.meeting_braking * easing * (gap - CONTACT_GAP).max(0.0)).sqrt();
            let leaving = other.velocity.dot(ahead);
            // In contact it is slower than the other, so that it does not push it along.
            let followed = if gap < CONTACT_GAP {
                leaving.min(self.tactics.following_share * leaving)
            } else {
                leaving
            };
            let allowed = (closing + followed).max(0.0);
            let toward = velocity.dot(ahead);
            if toward > allowed {
                velocity = velocity - ahead * (toward - allowed);
            }
        }
        velocity
    }

    fn turning(&self, robot: &Player, order: &Order) -> f32 {
        let angle = turn_to(robot.heading, order.facing);
        let by_braking = (2.0 * TURN_BRAKING * angle.abs()).sqrt();
        let limit = (MAX_TURNING * self.skill.turning)
            .min(order.turning)
            .min(self.config.robot.max_angular_velocity);
        let speed = (TURN_GAIN * angle.abs()).min(by_braking).min(limit);
        let change = order.turn_acceleration * self.config.time_step;
        speed
            .copysign(angle)
            .clamp(robot.angular_velocity - change, robot.angular_velocity + change)
    }
}

/// The velocity that comes no nearer to a limit than braking allows, and leaves what is beyond it.
fn kept_off(velocity: Vector, limit: &Limit, braking: f32) -> Vector {
    let away = velocity.dot(limit.away);
    let least = if limit.distance < 0.0 {
        (-limit.distance * LEAVING_GAIN).min(1.0)
    } else {
        -(2.0 * braking * limit.distance).sqrt().min(LIMIT_GAIN * limit.distance)
    };
    if away < least { velocity + limit.away * (least - away) } else { velocity }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bounds::Part;
    use crate::phase::{Mode, Phase, Restart};
    use crate::testing::{Scene, pitch};
    use rsim_referee::Team;

    fn command(scene: &Scene, order: &Order) -> [f32; 6] {
        let (view, pitch) = (scene.view(Team::Blue), pitch());
        let skill = Skill::new(1.0, 0.025);
        let (config, tactics) = (&scene.config, &Tactics::DEFAULT);
        let driving = Driving { config, pitch: &pitch, skill: &skill, tactics, view: &view };
        let phase =
            Phase { mode: Mode::Play, restart: Restart::Free, ours: false, kicks_next: false };
        let bounds = Bounds::new(phase, Part::Other, [view.ball.position; 2], 3.0, &pitch, 0.09);
        driving.command(&view.own[0], order, &bounds)
    }

    #[test]
    fn a_robot_drives_to_its_target_in_its_own_axes_and_brakes() {
        let mut scene = Scene::new(1, 0);
        scene.ball([0.0, 2.5], [0.0, 0.0]);
        scene.robot(0, [0.0, 0.0]);
        scene.set(0, "cos", 0.0);
        scene.set(0, "sin", 1.0);
        let facing = Vector::new(0.0, 1.0);
        let far = command(&scene, &Order::to(Vector::new(3.0, 0.0), facing));
        assert!(far[1] < -0.09 && far[0].abs() < 1e-4, "to its right: {far:?}");
        scene.set(0, "v_x", 3.0);
        scene.set(0, "v_y", 0.0);
        let fast = command(&scene, &Order::to(Vector::new(3.0, 0.0), facing));
        assert!((fast[1] + 3.0).abs() < 1e-4, "{fast:?}");
        let near = command(&scene, &Order::to(Vector::new(0.05, 0.0), facing));
        assert!(near[1] > -0.5 && near[1] < -0.1, "{near:?}");
        scene.set(0, "v_x", 0.0);
        assert!(far[2].abs() < 1e-3, "it faces its direction already");
        let turned = command(&scene, &Order::to(Vector::default(), Vector::new(1.0, 0.0)));
        assert!(turned[2] < -5.0, "clockwise: {turned:?}");
    }

    #[test]
    fn a_robot_slows_down_toward_an_opponent_in_its_way() {
        let mut scene = Scene::new(1, 1);
        scene.ball([0.0, 2.5], [0.0, 0.0]);
        scene.robot(0, [0.0, 0.0]);
        scene.robot(1, [0.3, 0.0]);
        scene.set(0, "v_x", 1.5);
        let target = Vector::new(0.29, 0.0);
        let order = Order { straight: true, ..Order::to(target, target) };
        let toward = command(&scene, &order)[0];
        assert!(toward > 0.3 && toward < 1.0, "{toward}");
        scene.set(1, "v_x", -1.0);
        assert!(command(&scene, &order)[0] < toward - 0.25);
    }

    #[test]
    fn limits_are_approached_slowly_and_left() {
        let away = Vector::new(1.0, 0.0);
        let toward = Vector::new(-3.0, 0.5);
        let near = kept_off(toward, &Limit { distance: 0.01, away }, 3.0);
        assert!(near.x > -0.3 && (near.y - 0.5).abs() < 1e-6, "{near:?}");
        let beyond = kept_off(toward, &Limit { distance: -0.1, away }, 3.0);
        assert!(beyond.x > 0.5, "{beyond:?}");
        assert_eq!(kept_off(toward, &Limit { distance: 5.0, away }, 3.0), toward);
    }
}
