//! What the tick's contacts did beyond keeping bodies apart: how the ball comes off walls and robots,
//! and who crashed into whom.

use rapier2d::math::Vector;

use crate::ball::Rolling;
use crate::ball_model::Surface;
use crate::engine::{BALL, Contact, Motion, Partner, robot};
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
        let (before, other) = partner_of(state, rules, physique, &contact);
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
            let drive = &state.robots[index].drive;
            (drive.expected_velocity + other.arm.perp() * drive.expected_spin, other)
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

/// Notes which robots met, and how fast.
pub(crate) fn note_crashes(state: &mut State, n_blue: usize) {
    let State { engine, robots, touched, .. } = state;
    for (pair, normal) in engine.robot_contacts() {
        let [first, second] = pair.map(|index| robots[index].drive.expected_velocity);
        let foes = (pair[0] < n_blue) != (pair[1] < n_blue);
        touched.robots(pair, foes, (first - second).dot(normal));
    }
}
