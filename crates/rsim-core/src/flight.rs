//! A ball in the air: it falls, hops on the floor, and meets what it does not clear. Its contacts
//! are found and solved here, as a sphere's with upright bodies; the plane knows nothing of height.

use rapier2d::glamx::Vec3;
use rapier2d::math::Vector;

use crate::BallModel;
use crate::arena::Wall;
use crate::ball::{Ball, Rolling};
use crate::engine::{BALL, Engine, Motion, robot, rotation};
use crate::impact::{Other, Sphere};
use crate::obstacle::{Near, Obstacle};
use crate::physique::Physique;
use crate::touch::Touched;

/// m/s², TIGERs' and everybody's.
const GRAVITY: f32 = 9.81;

/// A hop that would stay below this height is none, m: TIGERs' Sumatra.
const LOWEST_HOP: f32 = 0.010;

/// Surfaces this near touch, m.
const TOUCHING: f32 = 1e-5;

/// Speed towards a surface below which the surface carries the ball, m/s.
const CARRIED: f32 = 0.1;

/// Acceleration with which a ball that lies on something runs off it, m/s². A cover is hardly ever
/// level; on one that is, a ball would stay for ever.
const CROWN: f32 = 0.5;

/// More contacts than a ball has in one tick.
const MOST_CONTACTS: usize = 16;

/// Vertical speed that takes the ball up to [`LOWEST_HOP`], m/s.
pub(crate) fn lowest_take_off() -> f32 {
    (2.0 * GRAVITY * LOWEST_HOP).sqrt()
}

/// A ball on its way through one tick.
pub(crate) struct Flight<'a> {
    pub(crate) physique: &'a Physique,
    pub(crate) walls: &'a [Wall],
    pub(crate) engine: &'a mut Engine,
    pub(crate) touched: &'a mut Touched,
}

/// The ball as a body in space; `place` is its centre.
struct Body {
    place: Vec3,
    sphere: Sphere,
    hops: u8,
    /// On the floor, for good.
    down: bool,
}

impl Flight<'_> {
    /// Moves the ball for `time`: it starts at `position` with `motion` in the plane.
    pub(crate) fn fly(mut self, ball: &mut Ball, position: Vector, velocity: Vector, time: f32) {
        let model = &self.physique.ball;
        let mut body = self.body(ball, position, velocity);
        self.step_aside(&mut body);
        let mut left = time;
        for _ in 0..MOST_CONTACTS {
            let gravity = if body.down { 0.0 } else { GRAVITY };
            let way = body.sphere.velocity - Vec3::Z * (gravity * left / 2.0);
            let Some((after, obstacle, normal)) = self.first_contact(&body, way, left, None) else {
                body.place += way * left;
                body.sphere.velocity.z -= gravity * left;
                break;
            };
            body.place += way * after;
            body.sphere.velocity.z -= gravity * after;
            left -= after;
            if obstacle == Obstacle::Floor {
                land(model, &mut body);
            } else if self.hit(&mut body, obstacle, normal) {
                self.rest(&mut body, obstacle, normal, left);
                break;
            }
        }
        self.settle(ball, &body);
    }

    /// Lets a ball that is caught in the plane rise or fall for `time`.
    pub(crate) fn fall(mut self, ball: &mut Ball, time: f32) {
        let motion = self.engine.motion(BALL);
        let mut body = self.body(ball, motion.position, motion.velocity);
        body.place.z += (ball.v_z - GRAVITY * time / 2.0) * time;
        body.sphere.velocity.z -= GRAVITY * time;
        if body.place.z < self.physique.ball.radius {
            land(&self.physique.ball, &mut body);
            body.place.z = self.physique.ball.radius;
        }
        self.settle(ball, &body);
    }

    fn body(&self, ball: &Ball, position: Vector, velocity: Vector) -> Body {
        let model = &self.physique.ball;
        Body {
            place: position.extend(ball.z + model.radius),
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

    /// Puts the ball where the body has got to.
    fn settle(&mut self, ball: &mut Ball, body: &Body) {
        ball.z = if body.down { 0.0 } else { (body.place.z - body.sphere.radius).max(0.0) };
        ball.v_z = body.sphere.velocity.z;
        if ball.z == 0.0 && ball.v_z.abs() < lowest_take_off() {
            ball.v_z = 0.0;
        }
        ball.hops = if ball.is_down() { 0 } else { body.hops };
        ball.spin = body.sphere.spin;
        self.engine.set_ball(body.place.truncate(), body.sphere.velocity.truncate());
    }

    /// Robots may have driven into the ball since it was moved last: they hit it, and it makes room.
    /// Where a wall leaves none, it slips up over an edge, or is caught in the next tick.
    fn step_aside(&mut self, body: &mut Body) {
        for index in 0..self.physique.robots.len() {
            let near = self.near(Obstacle::Robot(index), body.place);
            if near.distance < 0.0 {
                self.hit(body, Obstacle::Robot(index), near.normal);
                body.place -= near.normal * near.distance;
            }
        }
        for index in 0..self.walls.len() {
            let near = self.near(Obstacle::Wall(index), body.place);
            body.place -= near.normal * near.distance.min(0.0);
        }
    }

    /// The first thing met within `time` of going straight along `way`, but for one: when, what, and
    /// from where.
    fn first_contact(
        &self,
        body: &Body,
        way: Vec3,
        time: f32,
        but_for: Option<Obstacle>,
    ) -> Option<(f32, Obstacle, Vec3)> {
        let walls = (0..self.walls.len()).map(Obstacle::Wall);
        let robots = (0..self.physique.robots.len()).map(Obstacle::Robot);
        let floor = (!body.down).then_some(Obstacle::Floor);
        let mut first: Option<(f32, Obstacle, Vec3)> = None;
        let all = floor.into_iter().chain(walls).chain(robots);
        for obstacle in all.filter(|obstacle| Some(*obstacle) != but_for) {
            let until = first.map_or(time, |(after, ..)| after);
            if let Some((after, normal)) = self.contact(obstacle, body.place, way, until) {
                first = Some((after, obstacle, normal));
            }
        }
        first
    }

    /// When the ball touches a convex obstacle, going straight. The distance is a convex function of
    /// time, so Newton's method comes up to the contact and never passes it.
    fn contact(&self, what: Obstacle, from: Vec3, way: Vec3, until: f32) -> Option<(f32, Vec3)> {
        let mut after = 0.0;
        for _ in 0..32 {
            let near = self.near(what, from + way * after);
            let closing = -way.dot(near.normal);
            if closing <= 0.0 {
                return None;
            }
            if near.distance <= TOUCHING {
                return Some((after, near.normal));
            }
            after += near.distance / closing;
            if after >= until {
                return None;
            }
        }
        None
    }

    fn near(&self, obstacle: Obstacle, place: Vec3) -> Near {
        let radius = self.physique.ball.radius;
        let point = place.truncate();
        match obstacle {
            Obstacle::Floor => Near { distance: place.z - radius, normal: Vec3::Z },
            Obstacle::Wall(index) => {
                let wall = &self.walls[index];
                let nearest = wall.placed().nearest(point);
                Near::of_upright(&nearest, [wall.bottom, wall.top], place.z, radius)
            }
            Obstacle::Robot(index) => {
                let body = &self.physique.robots[index];
                let Motion { position, heading, .. } = self.engine.motion(robot(index));
                let nearest = body.outline.nearest_at(position, rotation(heading), point);
                Near::of_upright(&nearest, [0.0, body.model.height], place.z, radius)
            }
        }
    }

    /// Bounces off a wall or a robot. Whether it now lies on it.
    fn hit(&mut self, body: &mut Body, obstacle: Obstacle, normal: Vec3) -> bool {
        let ball = &self.physique.ball;
        let other = match obstacle {
            Obstacle::Floor => unreachable!("the floor is no upright body"),
            Obstacle::Wall(index) => Other::fixed(self.walls[index].surface(ball)),
            Obstacle::Robot(index) => {
                self.touched.ball(index);
                let at = (body.place - normal * ball.radius).truncate();
                let motion = self.engine.motion(robot(index));
                self.physique.robots[index].at(&motion, at, ball.robot)
            }
        };
        let closing = body.sphere.closing(&other, normal);
        let pressing = body.sphere.rebound(&other, normal, closing);
        let mut impulse = normal * pressing;
        let carried = closing < CARRIED && normal.z > 0.0;
        if !carried {
            impulse += body.sphere.friction(&other, normal, pressing);
        }
        body.sphere.take(impulse, normal);
        if let Obstacle::Robot(index) = obstacle {
            self.engine.hit(robot(index), -impulse.truncate(), other.arm);
        }
        carried
    }

    /// Lies on an obstacle for the rest of the tick, and runs off it as far as there is room.
    fn rest(&self, body: &mut Body, obstacle: Obstacle, normal: Vec3, mut time: f32) {
        let outward = self.outward(obstacle, body);
        let falls = body.sphere.velocity - Vec3::Z * (GRAVITY * time);
        let pressed = falls.dot(normal).min(0.0);
        let mut velocity = falls - normal * pressed + (outward * (CROWN * time)).extend(0.0);
        for _ in 0..MOST_CONTACTS {
            let met = self.first_contact(body, velocity, time, Some(obstacle));
            let Some((after, _, wall)) = met else { break };
            body.place += velocity * after;
            velocity -= wall * velocity.dot(wall).min(0.0);
            time -= after;
        }
        body.place += velocity * time;
        body.sphere.velocity = velocity;
    }

    /// Away from the middle of an obstacle, in the plane.
    fn outward(&self, obstacle: Obstacle, body: &Body) -> Vector {
        let level = Vec3::new(
            body.place.x,
            body.place.y,
            match obstacle {
                Obstacle::Floor => return Vector::ZERO,
                Obstacle::Wall(index) => self.walls[index].top,
                Obstacle::Robot(index) => self.physique.robots[index].model.height,
            },
        );
        self.near(obstacle, level).normal.truncate()
    }
}

/// Touches the floor: hops again, or stays down.
fn land(model: &BallModel, body: &mut Body) {
    let velocity = body.sphere.velocity;
    if -velocity.z < lowest_take_off() {
        // It was hardly off the floor: nothing is lost.
        body.down = true;
        body.sphere.velocity.z = 0.0;
        body.place.z = model.radius;
        return;
    }
    let keeps = if body.hops == 0 { model.hop.first } else { model.hop.later };
    let flat = velocity.truncate() * keeps;
    let up = -velocity.z * model.hop.up;
    // From the first touch-down on it turns as if it rolled (TIGERs).
    let rolling = Rolling { velocity: flat, spin: body.sphere.spin }.rolled(model.radius);
    body.sphere.spin = rolling.spin;
    body.hops = body.hops.saturating_add(1);
    body.down = up < lowest_take_off();
    body.sphere.velocity = flat.extend(if body.down { 0.0 } else { up });
    if body.down {
        body.place.z = model.radius;
    }
}
