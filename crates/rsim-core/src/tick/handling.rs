//! Kicks and dribbling of robots that have the ball in their mouths, before the bodies move.

use crate::ball::kicker::Kicker;
use crate::ball::kicks::Kicks;
use crate::ball::mouth::HeldBall;
use crate::ball::rolling::GroundMotion;
use crate::blocks::{BALL, Lanes, larger, robot};
use crate::body_parameters::BodyParameters;
use crate::math::{Vec3, Vector};
use crate::state::State;
use crate::tick::commands::StepCommands;
use crate::tick::flight::min_takeoff_speed;

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
    parameters: &BodyParameters,
    commands: &StepCommands,
    tick: f32,
) {
    for block in &mut state.bodies.blocks {
        block.recharging = larger(block.recharging - Lanes::splat(tick), Lanes::ZERO);
    }
    if commands.handling.is_empty() {
        return;
    }
    let near = state.bodies.robots_near_ball(parameters, parameters.mouth_reach);
    if near == 0 {
        return;
    }
    let ball = state.bodies.motion(BALL);
    let ground = GroundMotion { velocity: ball.velocity, spin: state.ball.spin };
    let mut all = Effect {
        impulse: Vector::ZERO,
        kicks: Kicks::default(),
        v_z: 0.0,
        spin: Vec3::ZERO,
        kicked: false,
    };
    let mut handled = false;
    for command in &commands.handling {
        let index = usize::from(command.robot);
        if near >> index & 1 == 0 {
            continue;
        }
        let is_charged = command.kicks() && state.bodies.recharging(index) == 0.0;
        let dribbles = command.dribbler != 0.0 && state.ball.is_down();
        if !is_charged && !dribbles {
            continue;
        }
        let body = &parameters.robots[index];
        let Some(mouth) = &body.model.mouth else { continue };
        let motion = state.bodies.motion(robot(index));
        let held =
            HeldBall::find(&body.model, &motion, &parameters.ball, ball.position, state.ball.z);
        let Some(held) = held else { continue };
        let kicks = is_charged && held.is_reached();
        if !kicks && !dribbles {
            continue;
        }
        handled = true;
        state.touches.add_ball(index);
        if kicks {
            state.bodies.set_recharging(index, mouth.kicker_recharge_time);
            let kicker = commands.kick_errors.of(index);
            let kicker = Kicker { gain: kicker.gain * body.kick_gain, ..kicker };
            let after = held.kicked(ball.velocity, command.kick, command.chip, kicker);
            all.kicked = true;
            all.v_z = all.v_z.max(after.z);
            let change = (after.truncate() - ball.velocity) * parameters.ball.mass;
            all.kicks.add(index, motion.heading, change);
            continue;
        }
        all.spin += held.spun(ground, command.dribbler, tick).spin - ground.spin;
        let impulse = held.dribbler_impulse(ball.velocity, command.dribbler, tick);
        all.impulse += impulse;
        state.bodies.apply_impulse(
            parameters,
            robot(index),
            -impulse,
            ball.position - motion.position,
        );
    }
    if !handled {
        return;
    }
    for (index, impulse) in all.kicks.shared() {
        let arm = ball.position - state.bodies.motion(robot(index)).position;
        state.bodies.apply_impulse(parameters, robot(index), -impulse, arm);
        all.impulse += impulse;
    }
    state.bodies.apply_impulse(parameters, BALL, all.impulse, Vector::ZERO);
    if all.kicked {
        // A chip too weak to leave the floor stays on it.
        state.ball.v_z = if all.v_z < min_takeoff_speed() { 0.0 } else { all.v_z };
        state.ball.hops = 0;
        state.ball.spin = Vec3::ZERO;
    } else {
        state.ball.spin += all.spin;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ball::mouth::HeldBall;
    use crate::geometry::arena::walls;
    use crate::geometry::motion::Motion;
    use crate::models::robot::RobotModel;
    use crate::scenes;

    #[test]
    fn every_ball_in_a_mouth_is_within_its_reach() {
        let models = RobotModel::PRESETS.into_iter().filter(|model| model.mouth.is_some());
        let mut held = 0;
        for model in models {
            let mut config = scenes::ssl(2, 0);
            config.blue = vec![RobotModel::SSL_GENERIC, model];
            let parameters = BodyParameters::of(&config);
            let walls = walls(&config.field);
            let mut state = State::new(&config, &parameters, &walls).boxed();
            let bodies = &mut state.bodies;
            let motion = Motion::at_rest(Vector::ZERO, Vector::X);
            bodies.set_motion(robot(0), &Motion { position: Vector::new(5.0, 0.0), ..motion });
            bodies.set_motion(robot(1), &motion);
            for (x, y) in (0..200_u8).flat_map(|x| (0..100_u8).map(move |y| (x, y))) {
                let place = Vector::new(f32::from(x), f32::from(y) - 50.0) * 0.001;
                bodies.set_ball(place, Vector::ZERO);
                let model = &parameters.robots[1].model;
                let ball = HeldBall::find(model, &motion, &parameters.ball, place, 0.0);
                let near = bodies.robots_near_ball(&parameters, parameters.mouth_reach);
                assert!(ball.is_none() || near == 0b10, "{}: {place} {near:b}", model.name);
                held += u32::from(ball.is_some());
            }
        }
        assert!(held > 1_000, "{held}");
    }
}
