//! State rows: the state of a match as numbers, in the order of [`crate::columns`].

use crate::ball::mouth::beam_is_cut;
use crate::blocks::{BALL, robot};
use crate::body_parameters::BodyParameters;
use crate::columns::{BALL_COLUMNS, ROBOT_COLUMNS};
use crate::geometry::motion::Motion;
use crate::state::State;

/// Writes the row of `state`. `tick` is the duration of a tick, s.
pub(super) fn write(parameters: &BodyParameters, state: &State, tick: f32, out: &mut [f32]) {
    let (ball, robots) = out.split_at_mut(BALL_COLUMNS.len());
    write_ball(state, tick, ball);
    for (index, columns) in robots.chunks_exact_mut(ROBOT_COLUMNS.len()).enumerate() {
        write_robot(parameters, state, index, columns);
    }
}

fn write_ball(state: &State, tick: f32, columns: &mut [f32]) {
    let Motion { position, velocity, .. } = state.bodies.motion(BALL);
    let (ball, crossing, touch) = (&state.ball, &state.crossing, &state.touches.last);
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
        touch.map_or(-1.0, |touch| f32::from(touch.robot)),
        f32::from(crossing.code),
        crossing.at.x,
        crossing.at.y,
        crossing.at.z,
        touch.map_or(0.0, |touch| touch.seconds(tick)),
        touch.map_or(0.0, |touch| touch.speed),
        touch.map_or(0.0, |touch| touch.height),
    ]);
}

fn write_robot(parameters: &BodyParameters, state: &State, index: usize, columns: &mut [f32]) {
    let motion = state.bodies.motion(robot(index));
    let ball = state.bodies.motion(BALL).position;
    let cut =
        beam_is_cut(&parameters.robots[index].model, &motion, &parameters.ball, ball, &state.ball);
    columns.copy_from_slice(&[
        motion.position.x,
        motion.position.y,
        motion.heading.x,
        motion.heading.y,
        motion.velocity.x,
        motion.velocity.y,
        motion.angular_velocity,
        f32::from(u8::from(cut)),
        f32::from(u8::from(state.touches.touched_ball(index))),
        f32::from(u8::from(state.touches.touched_opponent(index))),
        state.bodies.collision_speed(index),
        f32::from(u8::from(state.is_absent(index))),
    ]);
}
