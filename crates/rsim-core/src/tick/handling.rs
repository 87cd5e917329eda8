//! Kicks and dribbling of robots that have the ball in their mouths, before the bodies move.

use crate::ball::kicks::Kicks;
use crate::ball::mouth::HeldBall;
use crate::ball::rolling::GroundMotion;
use crate::body_params::BodyParams;
use crate::columns::{OMNI_COLUMNS, OMNI_WHEELS_COLUMNS};
use crate::engine::{BALL, robot};
use crate::math::{Vec3, Vector};
use crate::models::robot::Drive;
use crate::state::State;
use crate::tick::flight::min_takeoff_speed;

/// The part of a command for kicker and dribbler.
struct HandlingCommand {
    /// Speed of a kick along the floor, m/s.
    kick: f32,
    /// Upward speed of a chip, m/s.
    chip: f32,
    /// Speed of the dribbler by its maximum, 0 to 1.
    dribbler: f32,
}

impl HandlingCommand {
    /// The part of `command` for kicker and dribbler; `None` for a drive without them.
    fn read(drive: &Drive, command: &[f32]) -> Option<Self> {
        // The last three columns of an omnidirectional robot.
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

/// Sum of the effects of all robots on the ball in a tick.
struct Effect {
    /// Impulse in the plane without kicks, N s.
    impulse: Vector,
    kicks: Kicks,
    /// Upward velocity of the highest chip, m/s.
    v_z: f32,
    /// Spin by dribblers, rad/s; a kick leaves none.
    spin: Vec3,
    kicked: bool,
}

/// Lets every robot with the ball in its mouth kick or dribble it as commanded, for one tick.
///
/// All act on the same state of the ball, so that their order does not matter.
pub(super) fn handle_ball(
    state: &mut State,
    params: &BodyParams,
    commands: &[f32],
    columns: usize,
    tick: f32,
) {
    let ball = state.engine.motion(BALL);
    let ground = GroundMotion { velocity: ball.velocity, spin: state.ball.spin };
    let mut all = Effect {
        impulse: Vector::ZERO,
        kicks: Kicks::default(),
        v_z: 0.0,
        spin: Vec3::ZERO,
        kicked: false,
    };
    let mut handled = false;
    for (index, body) in params.robots.iter().enumerate() {
        let recharging = (state.robots[index].recharging - tick).max(0.0);
        state.robots[index].recharging = recharging;
        let command = commands.get(index * columns..(index + 1) * columns).unwrap_or_default();
        let (Some(mouth), Some(command)) =
            (&body.model.mouth, HandlingCommand::read(&body.model.drive, command))
        else {
            continue;
        };
        state.robots[index].dribbling = command.dribbler;
        let kicks = command.kicks() && recharging == 0.0;
        if !kicks && (command.dribbler == 0.0 || !state.ball.is_down()) {
            continue;
        }
        let motion = state.engine.motion(robot(index));
        let held = HeldBall::find(&body.model, &motion, &params.ball, ball.position, state.ball.z);
        let Some(held) = held else { continue };
        handled = true;
        state.touches.add_ball(index);
        if kicks {
            state.robots[index].recharging = mouth.kicker_recharge_time;
            let after = held.kicked(ball.velocity, command.kick, command.chip, body.kick_gain);
            all.kicked = true;
            all.v_z = all.v_z.max(after.z);
            let change = (after.truncate() - ball.velocity) * params.ball.mass;
            all.kicks.add(index, motion.heading, change);
            continue;
        }
        all.spin += held.spun(ground, command.dribbler, tick).spin - ground.spin;
        let impulse = held.dribbler_impulse(ball.velocity, command.dribbler, tick);
        all.impulse += impulse;
        state.engine.apply_impulse(robot(index), -impulse, ball.position - motion.position);
    }
    if !handled {
        return;
    }
    for (index, impulse) in all.kicks.shared() {
        let arm = ball.position - state.engine.motion(robot(index)).position;
        state.engine.apply_impulse(robot(index), -impulse, arm);
        all.impulse += impulse;
    }
    state.engine.apply_impulse(BALL, all.impulse, Vector::ZERO);
    if all.kicked {
        // A chip too weak to leave the floor stays on it.
        state.ball.v_z = if all.v_z < min_takeoff_speed() { 0.0 } else { all.v_z };
        state.ball.hops = 0;
        state.ball.spin = Vec3::ZERO;
    } else {
        state.ball.spin += all.spin;
    }
}
