//! The numbers of models in the Python stub: each has its property, documented as in the core's table.

use std::path::Path;

use rsim_core::{BallModel, Field, Number, RobotModel};

/// Path of the stub from this crate.
const STUB: &str = "../../python/rsoccer/_core.pyi";

/// Maximum length of a docstring that fits on a line of 100 characters.
const MAX_DOC: usize = 86;

/// The property of a number in the stub.
fn property(number: &Number) -> String {
    let (name, doc) = (number.name, number.doc());
    assert!(doc.chars().count() <= MAX_DOC, "{name}: {doc:?} is too long");
    format!("    @property\n    def {name}(self) -> float:\n        \"\"\"{doc}\"\"\"\n\n")
}

#[test]
fn every_number_of_a_model_has_its_property_in_the_stub() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(STUB);
    let stub = std::fs::read_to_string(path).expect("the stub is in the package");
    for (class, numbers) in [
        ("Field", Field::numbers()),
        ("BallModel", BallModel::numbers()),
        ("RobotModel", RobotModel::numbers()),
    ] {
        assert!(numbers.len() > 10, "{class}: {numbers:?}");
        let start = stub.find(&format!("\nclass {class}:\n")).expect("the class is in the stub");
        let body = &stub[start..];
        let body = &body[..body.find("\n@final").unwrap_or(body.len())];
        let missing: String =
            numbers.iter().map(property).filter(|text| !body.contains(text.as_str())).collect();
        assert!(missing.is_empty(), "class {class} in {STUB} must have\n{missing}");
        assert_eq!(body.matches("-> float:\n").count(), numbers.len() + derived(class), "{class}");
    }
}

/// Number of documented float properties that are no numbers but follow from them.
fn derived(class: &str) -> usize {
    match class {
        "Field" => 4,      // half_length, half_width, max_x, max_y
        "RobotModel" => 3, // bounding_radius, top_speed, top_angular_velocity
        _ => 0,
    }
}
