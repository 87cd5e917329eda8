//! What the tick's contacts did beyond keeping bodies apart: how the ball comes off walls and robots,
//! and who crashed into whom.

use rapier2d::math::Vector;

use crate::ball::Rolling;
use crate::ball_model::Surface;
use crate::engine::{BALL, Contact, Motion, Partner, Press, Undisturbed, robot};
use crate::impact::{Other, Sphere};
use crate::mouth::Held;
use crate::physique::Physique;
use crate::world::{Fixed, State};

/// Contacts of the ball in one tick that are settled; more are squeezes, where friction is moot.
const MOST: usize = 4;

/// Gives the ball the bounce and friction of its contacts, by Coulomb's law in closed form.
///
/// The engine has solved the tick with the ball as a smooth disc that does not bounce, coming in
/// with velocity `mean`. `now` is how it moves after that. Returns whether it bounced.
pub(crate) fn settle(
    state: &mut State,
    rules: &Fixed,
    physique: &Physique,
    mean: Vector,
    now: &mut Rolling,
    undisturbed: &[Undisturbed],
) -> bool {
    let mut contacts = [None; MOST];
    let found = state.engine.ball_contacts();
    contacts.iter_mut().zip(found).for_each(|(slot, contact)| *slot = Some(contact));
    if contacts[0].is_none() {
        return false;
    }
    let model = &physique.ball;
    let mut sphere = Sphere {
        velocity: now.velocity.extend(0.0),
        spin: now.spin,
        radius: model.radius,
        mass: model.mass,
    };
    let mut bounced = false;
    for contact in contacts.into_iter().flatten() {
        let normal = contact.normal.extend(0.0);
        let (before, other) = partner_of(state, rules, physique, &contact, undisturbed);
        let closing = (before - mean).dot(contact.normal);
        let rebound = sphere.rebound(&other, normal, closing);
        let friction = sphere.friction(&other, normal, contact.pressing + rebound);
        let impulse = normal * rebound + friction;
        sphere.take(impulse, normal);
        bounced |= rebound > 0.0;
        if let Partner::Robot(index) = contact.with {
            state.engine.hit(robot(index), -impulse.truncate(), other.arm);
            state.touched.ball(index);
        }
    }
    // Spin against a wall would also lift the ball a little: left out, the floor keeps it down.
    *now = Rolling { velocity: sphere.velocity.truncate(), spin: sphere.spin };
    bounced
}

/// Velocity of the point of contact before the tick, and the partner there as it is now.
fn partner_of(
    state: &State,
    rules: &Fixed,
    physique: &Physique,
    contact: &Contact,
    undisturbed: &[Undisturbed],
) -> (Vector, Other) {
    let model = &physique.ball;
    match contact.with {
        Partner::Wall(index) => (Vector::ZERO, Other::fixed(rules.walls[index].surface(model))),
        Partner::Robot(index) => {
            let motion = state.engine.motion(robot(index));
            let ball = state.engine.motion(BALL).position;
            let at = ball - contact.normal * model.radius;
            let body = &physique.robots[index];
            let mut other = body.at(&motion, at, model.robot);
            if let Some((surface, down)) = running_bar(state, physique, index, &motion, ball) {
                other.surface = surface;
                other.velocity.z = -down;
            }
            let before = &undisturbed[index];
            (before.velocity + other.arm.perp() * before.spin, other)
        }
    }
}

/// Surface and downward speed (m/s) of a dribbler's bar, if it runs and the ball is at it.
fn running_bar(
    state: &State,
    physique: &Physique,
    index: usize,
    motion: &Motion,
    ball: Vector,
) -> Option<(Surface, f32)> {
    let share = state.robots[index].dribbling;
    if share == 0.0 {
        return None;
    }
    let model = &physique.robots[index].model;
    Held::find(model, motion, &physique.ball, ball, state.ball.z)?;
    let mouth = model.mouth?;
    let surface = Surface { restitution: mouth.bar_restitution, friction: mouth.bar_friction };
    Some((surface, mouth.bar_speed * share))
}

/// Notes who touches a ball that is caught: nothing bounces there.
pub(crate) fn settle_caught(state: &mut State) {
    let State { engine, touched, .. } = state;
    for contact in engine.ball_contacts() {
        if let Partner::Robot(index) = contact.with {
            touched.ball(index);
        }
    }
}

/// Closing speed below which robots do not bounce off each other and off walls, m/s.
const ROBOT_BOUNCE_SPEED: f32 = 0.1;

/// Robots against walls: as robots against robots. Nobody has published how a robot comes off one.
const WALL_RESTITUTION: f32 = 0.2;

/// Speed from which two that pressed on each other come apart, m/s. Robots that push each other in
/// a crowd jitter by less.
const SEPARATING: f32 = 0.05;

/// Gives robots the bounce of their contacts, and notes who crashed into whom, and how fast.
pub(crate) fn settle_robots(
    state: &mut State,
    physique: &Physique,
    n_blue: usize,
    presses: &[Press],
    undisturbed: &[Undisturbed],
) {
    for press in presses {
        let closing = -separation(state, press, |_, index| {
            let before = &undisturbed[index];
            (before.velocity, before.spin)
        });
        if let Partner::Robot(other) = press.with {
            let foes = (press.robot < n_blue) != (other < n_blue);
            state.touched.robots([press.robot, other], foes, closing);
        }
        if closing > ROBOT_BOUNCE_SPEED {
            rebound(state, physique, press, closing);
        }
    }
}

/// Robots that lean on something, a bit each: what pressed on them in the last tick has not come off
/// them in it.
pub(crate) fn leaning(state: &State, presses: &[Press]) -> u64 {
    let lasting = presses.iter().filter(|press| separation(state, press, as_it_moves) < SEPARATING);
    lasting.fold(0, |all, press| {
        let other = if let Partner::Robot(other) = press.with { 1 << other } else { 0 };
        all | 1 << press.robot | other
    })
}

/// Velocity (m/s) and turn rate (rad/s) of a robot now.
fn as_it_moves(state: &State, index: usize) -> (Vector, f32) {
    let motion = state.engine.motion(robot(index));
    (motion.velocity, motion.spin)
}

/// Speed at which two come apart where they press, m/s, if they move and turn as `moves` says.
fn separation(state: &State, press: &Press, moves: impl Fn(&State, usize) -> (Vector, f32)) -> f32 {
    let at = |index: usize| {
        let (velocity, spin) = moves(state, index);
        let arm = press.point - state.engine.motion(robot(index)).position;
        velocity + arm.perp() * spin
    };
    let with = if let Partner::Robot(other) = press.with { at(other) } else { Vector::ZERO };
    (with - at(press.robot)).dot(press.normal)
}

/// Has two come apart by their share of the speed at which they came together.
fn rebound(state: &mut State, physique: &Physique, press: &Press, closing: f32) {
    let Press { robot: first, with, normal, point } = *press;
    let restitution = |index: usize| physique.robots[index].model.restitution;
    let arm = |index: usize| point - state.engine.motion(robot(index)).position;
    let yields = |index: usize| physique.robots[index].yields(arm(index), normal);
    let (mean, per_impulse) = match with {
        Partner::Robot(other) => {
            (restitution(first).midpoint(restitution(other)), yields(first) + yields(other))
        }
        Partner::Wall(_) => (restitution(first).midpoint(WALL_RESTITUTION), yields(first)),
    };
    let apart = separation(state, press, as_it_moves);
    let impulse = normal * ((mean * closing - apart) / per_impulse).max(0.0);
    let own_arm = arm(first);
    if let Partner::Robot(other) = with {
        let arm = arm(other);
        state.engine.hit(robot(other), impulse, arm);
    }
    state.engine.hit(robot(first), -impulse, own_arm);
}
