//! The tests on a board need a section of their own, in which their runner finds them.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    // what the tests' macro asks about
    println!("cargo::rustc-check-cfg=cfg(rust_analyzer)");
    if std::env::var("CARGO_CFG_TARGET_OS").is_ok_and(|system| system == "none") {
        println!("cargo::rustc-link-arg-tests=-Tembedded-test.x");
    }
}
