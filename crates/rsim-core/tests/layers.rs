//! Layers of the crate: a module uses only modules of lower layers, and only few files name the contact
//! engine's library.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Modules from the lowest layer to the highest: a folder or file of `src`. Modules of one layer do not
/// use each other.
const LAYERS: &[&[&str]] = &[
    &["math", "columns", "streams"],
    &["blocks"],
    &["error"],
    &["models", "threads"],
    &["geometry"],
    &["drive", "ball", "features"],
    &["body_parameters"],
    &["bodies"],
    &["forecast"],
    &["engine"],
    &["state"],
    &["tick"],
    &["senses"],
    &["world"],
    &["scenes"],
];

/// Modules that may name the library of the reference engine: its solver, overlaps of shapes, and the
/// types of mathematics.
const NAMES_RAPIER: [&[&str]; 3] = [&["math"], &["engine", "rapier"], &["engine", "shapes"]];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = folder.read_dir().expect("a folder of sources");
    let paths = entries.map(|entry| entry.expect("readable").path());
    paths
        .flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] })
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect()
}

/// Module path of a file: `["geometry", "arena"]`; of `mod.rs`, that of its folder.
fn module_of(root: &Path, path: &Path) -> Vec<String> {
    let inside = path.strip_prefix(root).expect("inside the sources").with_extension("");
    let parts = inside.iter().map(|part| part.to_str().expect("plain names").to_owned());
    parts.filter(|part| part != "mod").collect()
}

/// Code of a file without comments and without its tests, which may use everything.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("readable");
    let text = text.split("#[cfg(test)]").next().expect("split has a first part");
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
    lines.collect::<Vec<_>>().join("\n")
}

/// Paths in a file after a prefix such as `crate::`, with groups expanded: `crate::a::{b, c}` gives
/// `a::b` and `a::c`.
fn paths_after(code: &str, prefix: &str) -> Vec<String> {
    let starts = code.match_indices(prefix).map(|(at, _)| &code[at + prefix.len()..]);
    starts.flat_map(expanded).collect()
}

fn expanded(text: &str) -> Vec<String> {
    let end = text.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
    let (path, rest) = text.split_at(end.unwrap_or(text.len()));
    if !(path.is_empty() || path.ends_with("::")) || !rest.starts_with('{') {
        return vec![path.trim_end_matches("::").to_owned()];
    }
    let mut depth = 0;
    let (mut parts, mut part) = (Vec::new(), String::new());
    for c in rest.chars() {
        depth += i32::from(c == '{') - i32::from(c == '}');
        if depth == 0 {
            break;
        }
        if depth == 1 && c == ',' {
            parts.push(std::mem::take(&mut part));
        } else if !(depth == 1 && c == '{') {
            part.push(c);
        }
    }
    parts.push(part);
    let parts = parts.iter().map(|part| part.trim()).filter(|part| !part.is_empty());
    parts
        .flat_map(|part| expanded(part).into_iter().map(|inner| format!("{path}{inner}")))
        .collect()
}

/// Every use of a module by another: (user, used), as module paths of files.
fn uses() -> Vec<(Vec<String>, Vec<String>)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let files: BTreeMap<Vec<String>, String> =
        sources(&root).iter().map(|path| (module_of(&root, path), code(path))).collect();
    let exports: BTreeMap<String, Vec<String>> =
        paths_after(&files[&vec!["lib".to_owned()]], "pub use ")
            .iter()
            .map(|path| {
                let parts: Vec<String> = path.split("::").map(str::to_owned).collect();
                (parts[parts.len() - 1].clone(), parts)
            })
            .collect();
    let mut found = Vec::new();
    for (module, code) in files.iter().filter(|(module, _)| module[0] != "lib") {
        let mut used: Vec<Vec<String>> = paths_after(code, "crate::")
            .iter()
            .map(|path| path.split("::").map(str::to_owned).collect::<Vec<_>>())
            .map(|path| exports.get(&path[0]).cloned().unwrap_or(path))
            .collect();
        // `super` is the folder's `mod.rs`, also from that file's children.
        let parent = module[..module.len() - 1].to_vec();
        used.extend(paths_after(code, "super::").iter().map(|path| {
            let inside = path.split("::").map(str::to_owned);
            parent.iter().cloned().chain(inside).collect()
        }));
        for path in used {
            let file = (1..=path.len()).rev().map(|end| &path[..end]);
            let file = file.into_iter().find(|file| files.contains_key(*file));
            let file =
                file.unwrap_or_else(|| panic!("{module:?} uses {path:?}, which is no module"));
            if file != module.as_slice() {
                found.push((module.clone(), file.to_vec()));
            }
        }
    }
    found
}

fn layer(module: &[String]) -> usize {
    let found = LAYERS.iter().position(|layer| layer.contains(&module[0].as_str()));
    found.unwrap_or_else(|| panic!("{module:?} must be in a layer"))
}

#[test]
fn every_module_has_a_layer_and_every_layer_its_modules() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let modules: BTreeSet<String> =
        sources(&root).iter().map(|path| module_of(&root, path)[0].clone()).collect();
    let listed: BTreeSet<String> =
        LAYERS.iter().flat_map(|layer| layer.iter().map(|&name| name.to_owned())).collect();
    let unlisted: Vec<_> = modules.difference(&listed).collect();
    assert_eq!(unlisted, ["lib"], "modules without a layer");
    assert!(listed.is_subset(&modules), "{listed:?}");
}

#[test]
fn modules_use_only_lower_layers() {
    let uses = uses();
    assert!(uses.len() > 100, "only {} uses were found", uses.len());
    let upward: Vec<_> = uses
        .iter()
        .filter(|(user, used)| user[0] != used[0] && layer(used) >= layer(user))
        .collect();
    assert!(upward.is_empty(), "{upward:?}");
    for (user, used) in [("engine", "geometry"), ("tick", "engine"), ("world", "tick")] {
        let found = uses.iter().any(|(a, b)| a[0] == user && b[0] == used);
        assert!(found, "{user} uses {used}, but no such use was found");
    }
}

#[test]
fn files_of_a_folder_do_not_use_each_other_in_cycles() {
    // A folder's `mod.rs` declares its files and uses them, and they use what it defines.
    let mut used: BTreeMap<Vec<String>, BTreeSet<Vec<String>>> = BTreeMap::new();
    let inner = uses();
    let inner = inner.iter().filter(|(a, b)| a[0] == b[0] && a.len() > 1 && b.len() > 1);
    for (user, file) in inner {
        used.entry(user.clone()).or_default().insert(file.clone());
    }
    assert!(used.len() > 5, "{used:?}");
    let mut left: BTreeSet<Vec<String>> = used.keys().cloned().collect();
    // Files that use no file that is left go, until none is left or a cycle remains.
    while let Some(free) = left.iter().find(|file| used[*file].is_disjoint(&left)).cloned() {
        left.remove(&free);
    }
    assert!(left.is_empty(), "cycles among {left:?}");
}

#[test]
fn only_the_reference_engine_shapes_and_math_name_rapier() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let names = |path: &PathBuf| {
        let text = fs::read_to_string(path).expect("readable");
        let lines = text.lines().map(|line| line.split("//").next().unwrap_or(""));
        lines
            .into_iter()
            .any(|line| ["rapier2d", "parry2d", "glamx"].iter().any(|name| line.contains(name)))
    };
    let naming: Vec<Vec<String>> = sources(&root)
        .iter()
        .filter(|path| names(path))
        .map(|path| module_of(&root, path))
        .collect();
    for allowed in NAMES_RAPIER {
        assert!(naming.iter().any(|module| module.starts_with(&owned(allowed))), "{allowed:?}");
    }
    let others: Vec<_> = naming
        .iter()
        .filter(|module| !NAMES_RAPIER.iter().any(|allowed| module.starts_with(&owned(allowed))))
        .collect();
    assert!(others.is_empty(), "{others:?}");
}

fn owned(module: &[&str]) -> Vec<String> {
    module.iter().map(|&part| part.to_owned()).collect()
}
