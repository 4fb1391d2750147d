//! The modules of the tool stand in an order: none imports one that needs it.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The modules that a file imports outside its tests.
fn imports(path: &Path) -> BTreeSet<String> {
    let text = std::fs::read_to_string(path).expect("a source");
    let code = text.split("#[cfg(test)]\nmod tests").next().unwrap_or_default();
    let code = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let named = code.flat_map(|line| line.split("crate::").skip(1));
    named.map(|rest| rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()).collect()
}

#[test]
fn modules_import_in_no_circle() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut left: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let entries = |folder: &Path| std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    for path in entries(&folder) {
        let files = if path.is_dir() { entries(&path).collect() } else { vec![path.clone()] };
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if !["lib", "main"].contains(&&*name) {
            let imported = files.iter().flat_map(|file| imports(file)).filter(|module| *module != name);
            left.entry(name.clone()).or_default().extend(imported.collect::<Vec<_>>());
        }
    }
    assert!(left.len() > 30 && left["frame"].contains("setup"), "{left:?}");
    // Modules that need none of those that are left go, until nothing or a circle remains.
    while let Some(free) = left.iter().find(|(_, needs)| needs.iter().all(|needed| !left.contains_key(needed))) {
        let free = free.0.clone();
        left.remove(&free);
    }
    let circle: Vec<_> = left
        .iter()
        .map(|(name, needs)| (name, needs.iter().filter(|needed| left.contains_key(*needed)).collect::<Vec<_>>()))
        .collect();
    assert!(circle.is_empty(), "{circle:?}");
}
