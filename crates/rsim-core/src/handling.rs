//! What robots do to a ball in their mouth before a tick: kick it, or hold it.

use rapier2d::glamx::Vec3;
use rapier2d::math::Vector;

use crate::ball::Rolling;
use crate::columns::{OMNI_COLUMNS, OMNI_WHEELS_COLUMNS};
use crate::engine::{BALL, robot};
use crate::flight::lowest_take_off;
use crate::kicks::Kicks;
use crate::mouth::Held;
use crate::physique::Physique;
use crate::robot_model::Drive;
use crate::world::State;

/// The part of a command that is about the ball.
struct Handling {
    kick: f32,
    chip: f32,
    dribbler: f32,
}

impl Handling {
    /// What a command says of it; nothing to a robot without a mouth.
    fn read(drive: &Drive, command: &[f32]) -> Option<Self> {
        // The last three of an omnidirectional robot's columns.
        let at = match drive {
            Drive::Differential(_) => return None,
            Drive::Omni(_) => OMNI_COLUMNS.len() - 3,
            Drive::OmniWheels(_) => OMNI_WHEELS_COLUMNS.len() - 3,
        };
        let [kick, chip, dribbler] = [command[at], command[at + 1], command[at + 2]];
        Some(Self { kick, chip, dribbler: dribbler.clamp(0.0, 1.0) })
    }

    fn kicks(&self) -> bool {
        self.kick > 0.0 || self.chip > 0.0
    }
}

/// What all robots together do to the ball in a tick.
struct Effect {
    /// N s, in the plane, but for kicks.
    impulse: Vector,
    kicks: Kicks,
    /// m/s upward; of the highest chip.
    v_z: f32,
    /// Spin that dribblers add, rad/s; none is left where somebody kicks.
    spin: Vec3,
    kicked: bool,
}

/// Lets every robot that has the ball in its mouth do to it what it is told; one tick's worth.
///
/// All act on the ball as it was, so that their order does not matter.
pub(crate) fn handle_ball(
    state: &mut State,
    physique: &Physique,
    commands: &[f32],
    columns: usize,
    tick: f32,
) {
    let ball = state.engine.motion(BALL);
    let rolling = Rolling { velocity: ball.velocity, spin: state.ball.spin };
    let mut all = Effect {
        impulse: Vector::ZERO,
        kicks: Kicks::default(),
        v_z: 0.0,
        spin: Vec3::ZERO,
        kicked: false,
    };
    let mut handled = false;
    for (index, body) in physique.robots.iter().enumerate() {
        let recharging = (state.robots[index].recharging - tick).max(0.0);
        state.robots[index].recharging = recharging;
        let command = commands.get(index * columns..(index + 1) * columns).unwrap_or_default();
        let (Some(mouth), Some(told)) =
            (&body.model.mouth, Handling::read(&body.model.drive, command))
        else {
            continue;
        };
        state.robots[index].dribbling = told.dribbler;
        let kicks = told.kicks() && recharging == 0.0;
        if !kicks && (told.dribbler == 0.0 || !state.ball.is_down()) {
            continue;
        }
        let motion = state.engine.motion(robot(index));
        let held = Held::find(&body.model, &motion, &physique.ball, ball.position, state.ball.z);
        let Some(held) = held else { continue };
        handled = true;
        state.touched.ball(index);
        if kicks {
            state.robots[index].recharging = mouth.recharge;
            let after = held.kicked(ball.velocity, told.kick, told.chip, body.kick_gain);
            all.kicked = true;
            all.v_z = all.v_z.max(after.z);
            let change = (after.truncate() - ball.velocity) * physique.ball.mass;
            all.kicks.add(index, motion.heading, change);
            continue;
        }
        all.spin += held.spun(rolling, told.dribbler, tick).spin - rolling.spin;
        let impulse = held.pull(ball.velocity, told.dribbler, tick);
        all.impulse += impulse;
        state.engine.hit(robot(index), -impulse, ball.position - motion.position);
    }
    if !handled {
        return;
    }
    for (index, impulse) in all.kicks.shared() {
        let arm = ball.position - state.engine.motion(robot(index)).position;
        state.engine.hit(robot(index), -impulse, arm);
        all.impulse += impulse;
    }
    state.engine.hit(BALL, all.impulse, Vector::ZERO);
    if all.kicked {
        // A chip too weak to leave the floor stays on it.
        state.ball.v_z = if all.v_z < lowest_take_off() { 0.0 } else { all.v_z };
        state.ball.hops = 0;
        state.ball.spin = Vec3::ZERO;
    } else {
        state.ball.spin += all.spin;
    }
}
