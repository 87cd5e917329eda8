//! Prints the hashes that `golden` and `hash_network` of the module write, for the native code: the policy file
//! is the argument.

use std::error::Error;
use std::io::Write;

use rsim_core::scenes;
use rsim_match::{Network, hashes};

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).ok_or("expected the path of a policy file")?;
    let network = Network::read(&std::fs::read(file)?)?;
    let mut out = std::io::stdout().lock();
    for (name, hash) in scenes::golden::hashes() {
        writeln!(out, "{name} {hash:016x}")?;
    }
    for (name, hash) in hashes::scripted()? {
        writeln!(out, "match_{name} {hash:016x}")?;
    }
    writeln!(out, "match_network {:016x}", hashes::network(&network)?)?;
    Ok(())
}
