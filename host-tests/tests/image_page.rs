//! What the page of the image takes for granted about the firmware.

use std::path::Path;

use host_tests::image::page::TASKS;

#[test]
fn the_tasks_of_the_page_are_those_of_the_program() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../firmware/src/main.rs");
    let program = std::fs::read_to_string(path).expect("the program is there");
    let after = |line: &str, key: &str| {
        let rest = line.split_once(key)?.1;
        Some(rest.chars().take_while(char::is_ascii_alphanumeric).collect::<String>())
    };
    let bound: Vec<(String, u8)> = program
        .lines()
        .filter_map(|line| Some((after(line, "binds = ")?, after(line, "priority = ")?.parse().ok()?)))
        .collect();
    assert_eq!(bound, TASKS.map(|(name, priority)| (name.to_owned(), priority)));
}
