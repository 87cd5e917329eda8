//! Bounce and friction of the ball's contacts in a tick, and the record of its touches.

use crate::ball::impact::{ContactBody, Sphere};
use crate::ball::mouth::HeldBall;
use crate::ball::rolling::GroundMotion;
use crate::blocks::{BALL, robot};
use crate::bodies::Undisturbed;
use crate::body_parameters::BodyParameters;
use crate::engine::{BallContact, Partner, Scratch};
use crate::geometry::motion::Motion;
use crate::math::Vector;
use crate::models::ball::Surface;
use crate::state::touch::TouchRecord;
use crate::state::{Setup, State};

/// Maximum number of contacts of the ball that are resolved in one tick; more are squeezes, in which
/// friction does not matter.
const MAX_CONTACTS: usize = 4;

/// Gives the ball bounce and friction of its contacts, by Coulomb's law in closed form.
///
/// The engine has solved the tick with a smooth ball that does not bounce, with the initial velocity
/// `mean`. `now` is the ball's motion after that. Returns whether the ball bounced.
pub(super) fn resolve(
    state: &mut State,
    setup: &Setup,
    parameters: &BodyParameters,
    mean: Vector,
    now: &mut GroundMotion,
    scratch: &Scratch,
) -> bool {
    if scratch.contacts.ball.is_empty() {
        return false;
    }
    let mut contacts = [None; MAX_CONTACTS];
    let found = scratch.contacts.ball.iter().copied();
    contacts.iter_mut().zip(found).for_each(|(slot, contact)| *slot = Some(contact));
    let model = &parameters.ball;
    let mut sphere = Sphere {
        velocity: now.velocity.extend(0.0),
        spin: now.spin,
        radius: model.radius,
        mass: model.mass,
    };
    let mut bounced = false;
    for contact in contacts.into_iter().flatten() {
        let normal = contact.normal.extend(0.0);
        let (before, other) =
            contact_body(state, setup, parameters, &contact, &scratch.undisturbed);
        let closing = (before - mean).dot(contact.normal);
        let rebound = sphere.rebound(&other, normal, closing);
        let friction = sphere.friction(&other, normal, contact.impulse + rebound);
        let impulse = normal * rebound + friction;
        sphere.apply_impulse(impulse, normal);
        bounced |= rebound > 0.0;
        if let Partner::Robot(index) = contact.with {
            let body = robot(index);
            state.bodies.apply_impulse(parameters, body, -impulse.truncate(), other.arm);
            state.touches.add_ball(index);
        }
    }
    // Spin against a wall would also lift the ball a little: ignored, the floor keeps it down.
    *now = GroundMotion { velocity: sphere.velocity.truncate(), spin: sphere.spin };
    bounced
}

/// Velocity of the partner's contact point before the tick, m/s, and the partner at that point now.
fn contact_body(
    state: &State,
    setup: &Setup,
    parameters: &BodyParameters,
    contact: &BallContact,
    undisturbed: &[Undisturbed],
) -> (Vector, ContactBody) {
    let model = &parameters.ball;
    match contact.with {
        Partner::Wall(index) => {
            (Vector::ZERO, ContactBody::fixed(setup.walls[index].surface(model)))
        }
        Partner::Robot(index) => {
            let motion = state.bodies.motion(robot(index));
            let ball = state.bodies.motion(BALL).position;
            let body = &parameters.robots[index];
            let point = motion.position + contact.arm;
            let mut other = body.contact_body(&motion, point, model.robot_surface());
            if let Some((surface, down)) = running_dribbler(state, parameters, index, &motion, ball)
            {
                other.surface = surface;
                other.velocity.z = -down;
            }
            let (velocity, angular_velocity) = Undisturbed::motion(undisturbed, index);
            (velocity + other.arm.perp() * angular_velocity, other)
        }
    }
}

/// Surface and downward speed (m/s) of a dribbler bar, if it runs and the ball is at it.
fn running_dribbler(
    state: &State,
    parameters: &BodyParameters,
    index: usize,
    motion: &Motion,
    ball: Vector,
) -> Option<(Surface, f32)> {
    let speed = state.bodies.dribbling(index);
    if speed == 0.0 {
        return None;
    }
    let model = &parameters.robots[index].model;
    HeldBall::find(model, motion, &parameters.ball, ball, state.ball.z)?;
    let mouth = model.mouth?;
    let surface =
        Surface { restitution: mouth.dribbler_restitution, friction: mouth.dribbler_friction };
    Some((surface, mouth.dribbler_speed * speed))
}

/// Records the robots that touch a jammed ball, which does not bounce.
pub(super) fn record_touches(touches: &mut TouchRecord, contacts: &[BallContact]) {
    for contact in contacts {
        if let Partner::Robot(index) = contact.with {
            touches.add_ball(index);
        }
    }
}
