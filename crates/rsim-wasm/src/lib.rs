//! Matches as WebAssembly with plain exports: numbers in, numbers out, everything else by memory.
//!
//! A caller asks for room with [`input`], writes there, and calls a function with the length. Functions that
//! can fail return 0 or more, or -1; the text of the error is then the output, at [`output`] with
//! [`output_length`] bytes. Texts are UTF-8, structures are JSON, rows are f32 in the order of the core's columns.
//! Addresses hold until the next call. `tools/playground/web/engine.js` is the caller in a browser.

mod exports;
mod session;

pub use exports::{
    change, configuration, control, create, decision, describe, golden, input, move_body, names,
    output, output_length, physics_version, remove, resume, row, set_side, step,
};
