//! All tests of the physics, one file per subject, as one program, because linking takes long.

use std::path::Path;

mod absent;
mod bounce;
mod chip;
mod collisions;
mod contact_free;
mod corners;
mod crowd;
mod determinism;
mod drive;
mod estimate;
mod floor;
mod golden;
mod holding;
mod input;
mod jerk;
mod joints;
mod kickers;
mod last_touch;
mod layers;
mod limits;
mod mirror;
mod mouth;
mod omni;
mod placement;
mod pressing;
mod pushed_rows;
mod records;
mod reposition;
mod restart;
mod senses;
mod shots;
mod soak;
mod spinning;
mod squeeze;
mod stub;
mod tipping;
mod tires;
mod trains;

#[test]
fn no_file_of_tests_is_forgotten() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests");
    let files = folder.read_dir().expect("this file lies there");
    let names: Vec<_> = files
        .map(|file| file.expect("readable").path())
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .filter(|name| name != "all")
        .collect();
    assert!(names.len() > 10, "{names:?}");
    for name in names {
        assert!(include_str!("all.rs").contains(&format!("\nmod {name};\n")), "{name} never runs");
    }
}
