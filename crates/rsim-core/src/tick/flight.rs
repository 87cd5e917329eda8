//! A ball in the air: it falls, hops on the floor, and bounces off bodies that it does not clear. Its
//! contacts are found and solved here, as those of a sphere with upright bodies; the planar engine
//! knows no height.

use crate::ball::impact::{ContactBody, Sphere};
use crate::ball::rolling::GroundMotion;
use crate::ball::state::BallState;
use crate::blocks::{BALL, robot};
use crate::bodies::Bodies;
use crate::body_parameters::BodyParameters;
use crate::geometry::arena::Wall;
use crate::geometry::clearance::{Clearance, Obstacle};
use crate::math::{Vec3, Vector};
use crate::models::ball::BallModel;
use crate::state::touch::TouchRecord;

/// m/s², as TIGERs and all other simulators have it.
const GRAVITY: f32 = 9.81;

/// Height of the lowest hop, m; a lower one does not take place: TIGERs' Sumatra.
const MIN_HOP: f32 = 0.010;

/// Distance at which surfaces touch, m.
const TOUCHING: f32 = 1e-5;

/// Closing speed below which an upper surface carries the ball, m/s.
const CARRIED: f32 = 0.1;

/// Acceleration with which a ball that lies on a body runs off it, m/s². Covers are hardly ever level;
/// on a level one a ball would stay for ever.
const CROWN: f32 = 0.5;

/// Maximum number of contacts of the ball in one tick.
const MAX_CONTACTS: usize = 16;

/// Maximum number of iterations of the search for a contact.
const MAX_ITERATIONS: usize = 32;

/// Vertical speed that takes the ball up to [`MIN_HOP`], m/s.
pub(super) fn min_takeoff_speed() -> f32 {
    (2.0 * GRAVITY * MIN_HOP).sqrt()
}

/// Motion of the ball through one tick.
pub(super) struct Flight<'a> {
    pub(super) parameters: &'a BodyParameters,
    pub(super) walls: &'a [Wall],
    pub(super) bodies: &'a mut Bodies,
    pub(super) touches: &'a mut TouchRecord,
}

/// The ball as a sphere in space.
struct FlyingBall {
    /// Position of the center, m.
    center: Vec3,
    sphere: Sphere,
    hops: u8,
    /// Whether the ball lies on the floor for the rest of the tick.
    down: bool,
}

/// A contact ahead: time until it (s), obstacle, and normal toward the ball.
type Contact = (f32, Obstacle, Vec3);

impl Flight<'_> {
    /// Moves the ball for `time` (s) from `position`, with `velocity` in the plane.
    pub(super) fn fly(
        mut self,
        ball: &mut BallState,
        position: Vector,
        velocity: Vector,
        time: f32,
    ) {
        let model = &self.parameters.ball;
        let mut flying = self.flying_ball(ball, position, velocity);
        self.push_out(&mut flying);
        let mut left = time;
        for _ in 0..MAX_CONTACTS {
            let gravity = if flying.down { 0.0 } else { GRAVITY };
            let mean = flying.sphere.velocity - Vec3::Z * (gravity * left / 2.0);
            let Some((after, obstacle, normal)) = self.first_contact(&flying, mean, left, None)
            else {
                flying.center += mean * left;
                flying.sphere.velocity.z -= gravity * left;
                break;
            };
            flying.center += mean * after;
            flying.sphere.velocity.z -= gravity * after;
            left -= after;
            if obstacle == Obstacle::Floor {
                land(model, &mut flying);
            } else if self.bounce(&mut flying, obstacle, normal) {
                self.rest(&mut flying, obstacle, normal, left);
                break;
            }
        }
        self.write_back(ball, &flying);
    }

    /// Lets a ball that is jammed in the plane rise or fall for `time` (s).
    pub(super) fn fall(mut self, ball: &mut BallState, time: f32) {
        let motion = self.bodies.motion(BALL);
        let mut flying = self.flying_ball(ball, motion.position, motion.velocity);
        flying.center.z += (ball.v_z - GRAVITY * time / 2.0) * time;
        flying.sphere.velocity.z -= GRAVITY * time;
        if flying.center.z < self.parameters.ball.radius {
            land(&self.parameters.ball, &mut flying);
            flying.center.z = self.parameters.ball.radius;
        }
        self.write_back(ball, &flying);
    }

    fn flying_ball(&self, ball: &BallState, position: Vector, velocity: Vector) -> FlyingBall {
        let model = &self.parameters.ball;
        FlyingBall {
            center: position.extend(ball.z + model.radius),
            sphere: Sphere {
                velocity: velocity.extend(ball.v_z),
                spin: ball.spin,
                radius: model.radius,
                mass: model.mass,
            },
            hops: ball.hops,
            down: false,
        }
    }

    /// Writes the result into the state of the ball.
    fn write_back(&mut self, ball: &mut BallState, flying: &FlyingBall) {
        ball.z = if flying.down { 0.0 } else { (flying.center.z - flying.sphere.radius).max(0.0) };
        ball.v_z = flying.sphere.velocity.z;
        if ball.z == 0.0 && ball.v_z.abs() < min_takeoff_speed() {
            ball.v_z = 0.0;
        }
        ball.hops = if ball.is_down() { 0 } else { flying.hops };
        ball.spin = flying.sphere.spin;
        self.bodies.set_ball(flying.center.truncate(), flying.sphere.velocity.truncate());
    }

    /// Resolves overlaps with robots that drove into the ball since its last motion: they hit the ball,
    /// and it moves out of them. If a wall leaves no space, the ball slips up over an edge, or is jammed
    /// in the next tick.
    fn push_out(&mut self, flying: &mut FlyingBall) {
        for index in 0..self.parameters.robots.len() {
            let clearance = self.clearance(Obstacle::Robot(index), flying.center);
            if clearance.distance < 0.0 {
                self.bounce(flying, Obstacle::Robot(index), clearance.normal);
                flying.center -= clearance.normal * clearance.distance;
            }
        }
        for index in 0..self.walls.len() {
            let clearance = self.clearance(Obstacle::Wall(index), flying.center);
            flying.center -= clearance.normal * clearance.distance.min(0.0);
        }
    }

    /// The first contact within `time` (s) of straight motion with `velocity`, except with `ignored`.
    fn first_contact(
        &self,
        flying: &FlyingBall,
        velocity: Vec3,
        time: f32,
        ignored: Option<Obstacle>,
    ) -> Option<Contact> {
        let walls = (0..self.walls.len()).map(Obstacle::Wall);
        let robots = (0..self.parameters.robots.len()).map(Obstacle::Robot);
        let floor = (!flying.down).then_some(Obstacle::Floor);
        let mut first: Option<Contact> = None;
        let all = floor.into_iter().chain(walls).chain(robots);
        for obstacle in all.filter(|obstacle| Some(*obstacle) != ignored) {
            let until = first.map_or(time, |(after, ..)| after);
            if let Some((after, normal)) = self.contact(obstacle, flying.center, velocity, until) {
                first = Some((after, obstacle, normal));
            }
        }
        first
    }

    /// Time (s) and normal of the contact with a convex obstacle, in straight motion. The distance is a
    /// convex function of time, so Newton's method converges to the contact and never passes it.
    fn contact(
        &self,
        obstacle: Obstacle,
        from: Vec3,
        velocity: Vec3,
        until: f32,
    ) -> Option<(f32, Vec3)> {
        let mut after = 0.0;
        for _ in 0..MAX_ITERATIONS {
            let clearance = self.clearance(obstacle, from + velocity * after);
            let closing = -velocity.dot(clearance.normal);
            if closing <= 0.0 {
                return None;
            }
            if clearance.distance <= TOUCHING {
                return Some((after, clearance.normal));
            }
            after += clearance.distance / closing;
            if after >= until {
                return None;
            }
        }
        None
    }

    /// Clearance of a ball with its center at `center` from an obstacle.
    fn clearance(&self, obstacle: Obstacle, center: Vec3) -> Clearance {
        let radius = self.parameters.ball.radius;
        let point = center.truncate();
        match obstacle {
            Obstacle::Floor => Clearance { distance: center.z - radius, normal: Vec3::Z },
            Obstacle::Wall(index) => {
                let wall = &self.walls[index];
                let nearest = wall.placed().nearest(point);
                Clearance::of_upright(&nearest, [wall.bottom, wall.top], center.z, radius)
            }
            Obstacle::Robot(index) => {
                let body = &self.parameters.robots[index];
                let motion = self.bodies.motion(robot(index));
                let nearest = body.outline.nearest_at(motion.position, motion.rotation(), point);
                Clearance::of_upright(&nearest, [0.0, body.model.height], center.z, radius)
            }
        }
    }

    /// Bounces the ball off a wall or a robot. Returns whether the ball now lies on it.
    fn bounce(&mut self, flying: &mut FlyingBall, obstacle: Obstacle, normal: Vec3) -> bool {
        let ball = &self.parameters.ball;
        let other = match obstacle {
            Obstacle::Floor => unreachable!("the floor is no upright body"),
            Obstacle::Wall(index) => ContactBody::fixed(self.walls[index].surface(ball)),
            Obstacle::Robot(index) => {
                self.touches.add_ball(index);
                let point = (flying.center - normal * ball.radius).truncate();
                let motion = self.bodies.motion(robot(index));
                self.parameters.robots[index].contact_body(&motion, point, ball.robot_surface())
            }
        };
        let closing = flying.sphere.closing(&other, normal);
        let rebound = flying.sphere.rebound(&other, normal, closing);
        let mut impulse = normal * rebound;
        let carried = closing < CARRIED && normal.z > 0.0;
        if !carried {
            impulse += flying.sphere.friction(&other, normal, rebound);
        }
        flying.sphere.apply_impulse(impulse, normal);
        if let Obstacle::Robot(index) = obstacle {
            self.bodies.apply_impulse(
                self.parameters,
                robot(index),
                -impulse.truncate(),
                other.arm,
            );
        }
        carried
    }

    /// Moves a ball that lies on an obstacle for the rest of the tick: it runs off as far as nothing is
    /// in its way.
    fn rest(&self, flying: &mut FlyingBall, obstacle: Obstacle, normal: Vec3, mut time: f32) {
        let outward = self.outward(obstacle, flying);
        let falling = flying.sphere.velocity - Vec3::Z * (GRAVITY * time);
        let pressed = falling.dot(normal).min(0.0);
        let mut velocity = falling - normal * pressed + (outward * (CROWN * time)).extend(0.0);
        for _ in 0..MAX_CONTACTS {
            let met = self.first_contact(flying, velocity, time, Some(obstacle));
            let Some((after, _, wall)) = met else { break };
            flying.center += velocity * after;
            velocity -= wall * velocity.dot(wall).min(0.0);
            time -= after;
        }
        flying.center += velocity * time;
        flying.sphere.velocity = velocity;
    }

    /// Direction in the plane away from the middle of an obstacle.
    fn outward(&self, obstacle: Obstacle, flying: &FlyingBall) -> Vector {
        let level = Vec3::new(
            flying.center.x,
            flying.center.y,
            match obstacle {
                Obstacle::Floor => return Vector::ZERO,
                Obstacle::Wall(index) => self.walls[index].top,
                Obstacle::Robot(index) => self.parameters.robots[index].model.height,
            },
        );
        self.clearance(obstacle, level).normal.truncate()
    }
}

/// Touch-down of the ball: it hops again, or stays down.
fn land(model: &BallModel, flying: &mut FlyingBall) {
    let velocity = flying.sphere.velocity;
    if -velocity.z < min_takeoff_speed() {
        // The ball was hardly off the floor: it loses nothing.
        flying.down = true;
        flying.sphere.velocity.z = 0.0;
        flying.center.z = model.radius;
        return;
    }
    let factor = if flying.hops == 0 { model.first_hop_factor } else { model.later_hop_factor };
    let horizontal = velocity.truncate() * factor;
    let up = -velocity.z * model.vertical_restitution;
    // From the first touch-down on the ball spins as if it rolled (TIGERs).
    let ground = GroundMotion { velocity: horizontal, spin: flying.sphere.spin };
    flying.sphere.spin = ground.without_slip(model.radius).spin;
    flying.hops = flying.hops.saturating_add(1);
    flying.down = up < min_takeoff_speed();
    flying.sphere.velocity = horizontal.extend(if flying.down { 0.0 } else { up });
    if flying.down {
        flying.center.z = model.radius;
    }
}
