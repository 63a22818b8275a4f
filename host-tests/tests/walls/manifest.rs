//! What a manifest depends on, for itself; what only its tests use does not ship and is not counted.

use crate::finding::Finding;
use crate::tree::Source;

/// Every dependency with its line (from 1): of the crate, of its build script, of a target.
pub fn dependencies(manifest: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut listed = false;
    for (k, line) in manifest.lines().enumerate() {
        let line = line.split('#').next().unwrap_or("").trim();
        if let Some(table) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
            let parts: Vec<&str> = table.split('.').map(str::trim).collect();
            listed = parts.last().is_some_and(|last| counts(last));
            if let [.., above, name] = parts[..]
                && counts(above)
            {
                found.push((k + 1, bare(name))); // [dependencies.name]
            }
        } else if let Some((key, _)) = line.split_once('=')
            && listed
        {
            found.push((k + 1, bare(key.split('.').next().unwrap_or(key)))); // name = …, name.workspace = …
        }
    }
    found
}

/// Every dependency but those allowed.
pub fn others_than(allowed: &[&str], manifest: &Source) -> Vec<Finding> {
    let others = dependencies(&manifest.text).into_iter().filter(|(_, name)| !allowed.contains(&name.as_str()));
    let listed = allowed.join(", ");
    let what = |name| format!("depends on `{name}`, only {listed} may be; write it here, or move what needs it out");
    others.map(|(line, name)| Finding { file: manifest.path.clone(), line, what: what(name) }).collect()
}

fn counts(table: &str) -> bool {
    table == "dependencies" || table == "build-dependencies"
}

fn bare(key: &str) -> String {
    key.trim().trim_matches('"').into()
}

#[test]
fn dependencies_of_every_form_are_found_and_those_of_tests_are_not() {
    let manifest = "[package]\nname = 'x'\n[dependencies]\nlibm = \"0.2\"  # maths\nserde.workspace = true\n\n\
                    [dependencies.rand]\nversion = \"1\"\n[dev-dependencies]\nproptest = \"1\"\n\
                    [target.'cfg(unix)'.dependencies]\nlibc = \"1\"\n[build-dependencies]\n\"cc\" = \"1\"\n[lints]\nworkspace = true";
    let expected = [(4, "libm"), (5, "serde"), (7, "rand"), (12, "libc"), (14, "cc")];
    assert_eq!(dependencies(manifest), expected.map(|(line, name)| (line, name.to_string())));
}

#[test]
fn one_other_dependency_is_one_finding() {
    let manifest =
        Source { path: "Cargo.toml".into(), text: "[dependencies]\nlibm = \"0.2\"\ncrc = \"3\"\nnum = \"1\"".into() };
    let found = others_than(&["libm", "crc"], &manifest);
    assert_eq!(found.len(), 1);
    assert!(found[0].to_string().starts_with("Cargo.toml:4: depends on `num`, only libm, crc"), "{}", found[0]);
}
