//! The list of files in a recording's `metadata.yaml`, read event by event: no tree is made of the rest, in which names may stand for lists of
//! names and lists lie as deep in each other as they like.

use saphyr_parser::{Event, Parser, ScanError};

/// Where the list stands.
pub(super) const LIST: [&str; 2] = ["rosbag2_bagfile_information", "relative_file_paths"];

/// A mapping or sequence that the reader is in; of a mapping the key whose value comes next.
enum Level {
    Mapping(Option<String>),
    Sequence,
}

/// The files that the first document lists, as they are written there; none where it has no list of texts in that place.
pub(super) fn listed(text: &str) -> Result<Option<Vec<String>>, ScanError> {
    let mut levels: Vec<Level> = Vec::new();
    let mut list: Option<Vec<String>> = None;
    for event in Parser::new_from_str(text) {
        let event = event?.0;
        let in_list = levels.len() > LIST.len() && is_at_list(&levels[..LIST.len()]);
        match event {
            Event::MappingStart(..) | Event::SequenceStart(..) | Event::Alias(_) if in_list => return Ok(None),
            Event::MappingStart(..) => levels.push(Level::Mapping(None)),
            Event::SequenceStart(..) => {
                if levels.len() == LIST.len() && is_at_list(&levels) {
                    list = Some(Vec::new());
                }
                levels.push(Level::Sequence);
            }
            Event::Scalar(text, ..) => {
                if in_list {
                    list.get_or_insert_default().push(text.clone().into_owned());
                }
                passed(&mut levels, &text);
            }
            Event::Alias(_) => passed(&mut levels, ""),
            Event::MappingEnd | Event::SequenceEnd => {
                levels.pop();
                passed(&mut levels, "");
            }
            Event::DocumentEnd => break,
            Event::Nothing | Event::StreamStart | Event::StreamEnd | Event::DocumentStart(_) => {}
        }
    }
    Ok(list)
}

/// Whether these levels lead to the list.
fn is_at_list(levels: &[Level]) -> bool {
    levels.iter().zip(LIST).all(|(level, name)| matches!(level, Level::Mapping(Some(key)) if key == name))
}

/// A node is over: in a mapping it was a key, or the value of one.
fn passed(levels: &mut [Level], text: &str) {
    if let Some(Level::Mapping(key)) = levels.last_mut() {
        *key = if key.is_none() { Some(text.to_owned()) } else { None };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(text: &str) -> Option<Vec<String>> {
        listed(text).unwrap_or_else(|why| panic!("{text:?}: {why}"))
    }

    #[test]
    fn the_list_is_found_among_other_keys_and_nowhere_else() {
        let sound = "rosbag2_bagfile_information:\n  version: 5\n  duration: {nanoseconds: 7}\n  topics:\n    - a: [b, c]\n  \
                     relative_file_paths:\n    - a_0.db3\n    - \"a b.db3\"\n  files: [{path: x}]\nother: 1\n";
        assert_eq!(list(sound), Some(vec!["a_0.db3".to_owned(), "a b.db3".to_owned()]));
        for elsewhere in ["a: 1", "", "- a", "relative_file_paths: [a]", "x:\n  relative_file_paths: [a]\n"] {
            assert_eq!(list(elsewhere), None, "{elsewhere:?}");
        }
        let within = "rosbag2_bagfile_information:\n  relative_file_paths:\n";
        assert_eq!(list(&format!("{within}    - [a]\n")), None);
        assert_eq!(list(&format!("{within}    - {{a: b}}\n")), None);
        assert_eq!(list(&format!("x: &x a\n{within}    - *x\n")), None);
        assert_eq!(list(&format!("{within}    []\n")), Some(Vec::new()));
        assert!(listed("a: [").is_err());
    }

    #[test]
    fn names_that_stand_for_names_and_lists_within_lists_take_no_more_than_their_text() {
        let ten = |name: &str| [name; 10].join(",");
        let line = |k: usize| format!("a{k}: &a{k} [{}]\n", ten(&format!("*a{}", k - 1)));
        let bomb = format!("a0: &a0 [{}]\n", ten("x")) + &(1..20).map(line).collect::<String>();
        assert_eq!(list(&bomb), None);
        assert_eq!(list(&"- ".repeat(50_000)), None);
        assert!(listed(&format!("a: {}", "[".repeat(50_000))).is_err());
    }
}
