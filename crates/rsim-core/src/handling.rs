//! What robots do to a ball in their mouth before a tick: kick it, or hold it.

use rapier2d::math::Vector;

use crate::ball::Rolling;
use crate::engine::{BALL, robot};
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
    /// What a command of `columns` says; the last three of an omnidirectional robot's.
    fn read(drive: &Drive, command: &[f32]) -> Option<Self> {
        let at = match drive {
            Drive::Differential(_) => return None,
            Drive::Omni(_) => 3,
            Drive::OmniWheels(_) => 4,
        };
        let [kick, chip, dribbler] = [command[at], command[at + 1], command[at + 2]];
        Some(Self { kick, chip, dribbler: dribbler.clamp(0.0, 1.0) })
    }

    fn kicks(&self) -> bool {
        self.kick > 0.0 || self.chip > 0.0
    }
}

/// Lets every robot that has the ball in its mouth do to it what it is told; one tick's worth.
pub(crate) fn handle_ball(
    state: &mut State,
    physique: &Physique,
    commands: &[f32],
    columns: usize,
    tick: f32,
) {
    for index in 0..physique.robots.len() {
        let body = &physique.robots[index];
        let recharging = (state.robots[index].recharging - tick).max(0.0);
        state.robots[index].recharging = recharging;
        let (Some(mouth), Some(told)) = (
            &body.model.mouth,
            Handling::read(&body.model.drive, &commands[index * columns..][..columns]),
        ) else {
            continue;
        };
        state.robots[index].dribbling = told.dribbler;
        let kicks = told.kicks() && recharging == 0.0;
        if !kicks && told.dribbler == 0.0 {
            continue;
        }
        let (motion, ball) = (state.engine.motion(robot(index)), state.engine.motion(BALL));
        let held = Held::find(&body.model, &motion, &physique.ball, ball.position, state.ball.z);
        let Some(held) = held else { continue };
        let impulse = if kicks {
            state.robots[index].recharging = mouth.recharge;
            let after = held.kicked(ball.velocity, told.kick, told.chip, body.kick_gain);
            state.ball.v_z = after.z;
            state.ball.hops = 0;
            state.ball.spin = rapier2d::glamx::Vec3::ZERO;
            (after.truncate() - ball.velocity) * physique.ball.mass
        } else if state.ball.is_down() {
            let spun = held.spun(
                Rolling { velocity: ball.velocity, spin: state.ball.spin },
                told.dribbler,
                tick,
            );
            state.ball.spin = spun.spin;
            held.pull(ball.velocity, told.dribbler, tick)
        } else {
            continue;
        };
        state.touched.ball(index);
        state.engine.hit(BALL, impulse, Vector::ZERO);
        state.engine.hit(robot(index), -impulse, ball.position - motion.position);
    }
}
