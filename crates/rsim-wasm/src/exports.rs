//! Functions that WebAssembly exports.

use rsim_core::PHYSICS_VERSION;

use crate::session::{Session, tried, with};

/// Address of room for `length` bytes of input.
#[unsafe(no_mangle)]
pub extern "C" fn input(length: usize) -> *mut u8 {
    with(|session| {
        session.input.resize(length, 0);
        session.input.as_mut_ptr()
    })
}

/// Address of the output of the last call that has one.
#[unsafe(no_mangle)]
pub extern "C" fn output() -> *const u8 {
    with(|session| session.output.as_ptr())
}

/// Bytes of that output.
#[unsafe(no_mangle)]
pub extern "C" fn output_length() -> usize {
    with(|session| session.output.len())
}

/// Version of the physics.
#[unsafe(no_mangle)]
pub extern "C" fn physics_version() -> u32 {
    PHYSICS_VERSION
}

/// Creates a match from a setup (input: JSON of `Setup`). Returns its handle.
#[unsafe(no_mangle)]
pub extern "C" fn create(length: usize) -> i32 {
    tried(|session| session.create(length))
}

/// Forgets a match; its handle may be given to another one.
#[unsafe(no_mangle)]
pub extern "C" fn remove(handle: usize) -> i32 {
    tried(|session| session.remove(handle))
}

/// Sets who drives a team, 0 or 1: a policy file (input), or the scripted team with a skill from 0 to 1, or
/// nobody with a skill below 0.
#[unsafe(no_mangle)]
pub extern "C" fn set_side(handle: usize, team: usize, skill: f32, length: usize) -> i32 {
    tried(|session| session.set_side(handle, team, skill, length))
}

/// Gives a robot to a person, or back (input: JSON of `Controls`, or null).
#[unsafe(no_mangle)]
pub extern "C" fn control(handle: usize, robot: usize, length: usize) -> i32 {
    tried(|session| session.control(handle, robot, length))
}

/// Advances a match by a control step. Returns 1 if the referee decided something.
#[unsafe(no_mangle)]
pub extern "C" fn step(handle: usize) -> i32 {
    tried(|session| session.step(handle))
}

/// Changes physics and senses (input: JSON of `Conditions`).
#[unsafe(no_mangle)]
pub extern "C" fn change(handle: usize, length: usize) -> i32 {
    tried(|session| session.change(handle, length))
}

/// Moves a body: 0 is the ball, `i + 1` robot `i`. A robot is put at rest, the ball gets the velocity.
#[unsafe(no_mangle)]
pub extern "C" fn move_body(handle: usize, body: usize, x: f32, y: f32, v_x: f32, v_y: f32) -> i32 {
    tried(|session| session.move_body(handle, body, [x, y], [v_x, v_y]))
}

/// Goes on from a situation (input: f32 of a state row, then of the row of a state of the match).
#[unsafe(no_mangle)]
pub extern "C" fn resume(handle: usize, length: usize) -> i32 {
    tried(|session| session.resume(handle, length))
}

/// Writes a row (output: f32). 0: state; 1, 2: what blue and yellow know; 3: commands; 4: state of the match.
/// Returns the number of numbers.
#[unsafe(no_mangle)]
pub extern "C" fn row(handle: usize, which: u32) -> i32 {
    tried(|session| session.row(handle, which))
}

/// Describes the state of the match and the referee's last decisions (output: JSON).
#[unsafe(no_mangle)]
pub extern "C" fn describe(handle: usize) -> i32 {
    tried(|session| session.describe(handle))
}

/// Writes the configuration of the physics (output: JSON of `SimConfig`, as replay files hold it).
#[unsafe(no_mangle)]
pub extern "C" fn configuration(handle: usize) -> i32 {
    tried(|session| session.configuration(handle))
}

/// Writes the observation of a robot of a network's team, and the means of its action (output: f32).
#[unsafe(no_mangle)]
pub extern "C" fn decision(handle: usize, robot: usize) -> i32 {
    tried(|session| session.decision(handle, robot))
}

/// Writes the names of all columns, factors and numbers of senses (output: JSON).
#[unsafe(no_mangle)]
pub extern "C" fn names() -> i32 {
    tried(Session::names)
}

/// Plays the golden scenes of the physics, and writes their hashes (output: a line of name and hash for each).
#[unsafe(no_mangle)]
pub extern "C" fn golden() -> i32 {
    with(Session::golden)
}
