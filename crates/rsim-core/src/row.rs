//! The state of a match as a row of numbers, in the order that [`crate::columns`] names.

use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::engine::{BALL, Motion, robot};
use crate::mouth::sees;
use crate::physique::Physique;
use crate::world::State;

/// Writes the row of `state`.
pub(crate) fn write(physique: &Physique, state: &State, out: &mut [f32]) {
    let (ball, robots) = out.split_at_mut(BALL_COLUMNS.len());
    write_ball(state, ball);
    for (index, columns) in robots.chunks_exact_mut(ROBOT_COLUMNS.len()).enumerate() {
        write_robot(physique, state, index, columns);
    }
}

fn write_ball(state: &State, columns: &mut [f32]) {
    let Motion { position, velocity, .. } = state.engine.motion(BALL);
    let (ball, crossing) = (&state.ball, &state.crossing);
    columns.copy_from_slice(&[
        position.x,
        position.y,
        ball.z,
        velocity.x,
        velocity.y,
        ball.v_z,
        ball.spin.x,
        ball.spin.y,
        ball.spin.z,
        state.touched.last.map_or(-1.0, f32::from),
        f32::from(crossing.code),
        crossing.at.x,
        crossing.at.y,
        crossing.at.z,
    ]);
}

fn write_robot(physique: &Physique, state: &State, index: usize, columns: &mut [f32]) {
    let motion = state.engine.motion(robot(index));
    let ball = state.engine.motion(BALL).position;
    let sees = sees(&physique.robots[index].model, &motion, &physique.ball, ball, &state.ball);
    let touched = state.touched.of(index);
    columns.copy_from_slice(&[
        motion.position.x,
        motion.position.y,
        motion.heading.x,
        motion.heading.y,
        motion.velocity.x,
        motion.velocity.y,
        motion.spin,
        f32::from(u8::from(sees)),
        f32::from(u8::from(touched.ball)),
        f32::from(u8::from(touched.foe)),
        touched.crash_speed,
    ]);
}
