//! Files that take names from each other in a circle: none of them can be read, tested or moved alone.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use petgraph::algo::tarjan_scc;
use petgraph::graph::DiGraph;

use crate::imports::{Crate, Import};

/// The root files of all crates; but for the firmware's image, whose tasks name what RTIC makes of `main.rs`.
pub const ROOTS: &[&str] = &[
    "model-core/src/lib.rs",
    "firmware/src/lib.rs",
    "omni-gap/src/lib.rs",
    "omni-gap/src/main.rs",
    "host-tests/src/lib.rs",
    "host-tests/chip/src/lib.rs",
    "host-tests/doors/src/lib.rs",
    "host-tests/ground-truth/src/lib.rs",
    "python/src/lib.rs",
    "xtask/src/main.rs",
];

/// Every circle of files below a root file, with what ties it.
pub fn circles(root: &Path, read: &impl Fn(&Path) -> Option<String>) -> Vec<String> {
    let imports = Crate::of(root, read).imports();
    let (mut graph, mut nodes) = (DiGraph::<&PathBuf, &Import>::new(), BTreeMap::new());
    for import in &imports {
        let [from, to] =
            [&import.from, &import.to].map(|file| *nodes.entry(file).or_insert_with(|| graph.add_node(file)));
        graph.add_edge(from, to, import);
    }
    let circle = |files: Vec<_>| {
        let mut ties = BTreeMap::<_, Vec<&str>>::new();
        for tie in
            graph.edge_weights().filter(|tie| [&tie.from, &tie.to].iter().all(|file| files.contains(&nodes[file])))
        {
            ties.entry((&tie.from, &tie.to)).or_default().push(&tie.name);
        }
        let line = |((from, to), names): (_, Vec<&str>)| {
            let (from, to): (&PathBuf, &PathBuf) = (from, to);
            format!("  {} takes {} from {}", from.display(), names.join(", "), to.display())
        };
        let lines: Vec<String> = ties.into_iter().map(line).collect();
        format!("a circle of {} files; give what both need a file of its own:\n{}", files.len(), lines.join("\n"))
    };
    tarjan_scc(&graph).into_iter().filter(|files| files.len() > 1).map(circle).collect()
}

#[cfg(test)]
fn circles_of(files: &[(&str, &str)]) -> Vec<String> {
    circles(Path::new("lib.rs"), &|path| files.iter().find(|(name, _)| Path::new(name) == path).map(|f| f.1.to_owned()))
}

#[test]
fn two_files_that_need_each_other_are_a_circle() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "use crate::b::B; pub struct A(B);"),
        ("b.rs", "pub struct B; fn f() -> Option<super::a::A> { None }"),
    ]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(
        found[0].contains("a.rs takes B, crate::b::B from b.rs")
            && found[0].contains("b.rs takes super::a::A from a.rs")
    );
}

#[test]
fn a_child_that_needs_its_parent_is_a_circle_if_the_parent_needs_it() {
    let child = ("a/b.rs", "use super::A; pub fn f(_: A) {}");
    let needs = circles_of(&[("lib.rs", "mod a;"), ("a.rs", "mod b; pub struct A; fn g() { b::f(A) }"), child]);
    assert_eq!(needs.len(), 1, "{needs:?}");
    let signpost = circles_of(&[("lib.rs", "mod a;"), ("a.rs", "mod b; pub use b::f; pub struct A;"), child]);
    assert_eq!(signpost, [""; 0]);
}

#[test]
fn a_signpost_is_followed_to_the_file_behind_it() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a/mod.rs", "mod deep; pub use deep::D;"),
        ("a/deep.rs", "use crate::b::B; pub struct D(B);"),
        ("b.rs", "use crate::a; pub struct B; fn f() { assert!(matches!(None, Some(a::D(_)))) }"),
    ]);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(found[0].contains("b.rs takes a::D from a/deep.rs"), "{}", found[0]);
}

#[test]
fn what_tests_need_and_what_other_crates_have_ties_nothing() {
    let found = circles_of(&[
        ("lib.rs", "mod a; mod b;"),
        ("a.rs", "use crate::b::B; pub struct A(B);"),
        (
            "b.rs",
            "use std::fmt; pub struct B; #[cfg(test)] mod tests { use crate::a::A; } #[cfg(test)] use crate::a::A;",
        ),
    ]);
    assert_eq!(found, [""; 0]);
}
