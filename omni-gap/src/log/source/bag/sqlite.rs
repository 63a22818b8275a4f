//! ROS 2 recordings in SQLite (`.db3`), the default of rosbag2 before Iron.
//!
//! Tables: `topics` (name, type, serialization_format), `messages` (topic_id, timestamp, data) and, since Iron,
//! `message_definitions`. Older recordings carry no definitions: those of the usual messages are known.

use super::container::{Container, Seen, Take};
use super::decoder::{Decoder, Described};
use super::rows::Recorded;
use super::usual;
use crate::error::{Error, InputKind, Result};
use rusqlite::config::DbConfig;
use rusqlite::{Connection, OpenFlags, OptionalExtension};
use std::path::{Path, PathBuf};

pub(super) struct Sqlite {
    path: PathBuf,
    database: Connection,
}

/// A topic's row.
struct Topic {
    id: i64,
    of_type: String,
    encoding: String,
}

impl Sqlite {
    pub fn open(path: &Path) -> Result<Sqlite> {
        let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_NO_MUTEX;
        let opened = || {
            let database = Connection::open_with_flags(path, flags)?;
            // rosbag2 writes tables; a view is a program, which need not come to an end
            database.set_db_config(DbConfig::SQLITE_DBCONFIG_ENABLE_VIEW, false)?;
            Ok(database)
        };
        let database = opened().map_err(|reason| broken(path, &reason))?;
        Ok(Sqlite { path: path.into(), database })
    }

    fn topic(&self, name: &str) -> rusqlite::Result<Option<Topic>> {
        let query = "SELECT id, type, serialization_format FROM topics WHERE name = ?1";
        let read = |row: &rusqlite::Row| Ok(Topic { id: row.get(0)?, of_type: row.get(1)?, encoding: row.get(2)? });
        self.database.query_row(query, [name], read).optional()
    }

    /// The definition that the recording carries, with the language that it is written in.
    fn definition(&self, of_type: &str) -> rusqlite::Result<Option<(String, String)>> {
        let there = "SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'message_definitions'";
        if self.database.query_row(there, [], |_| Ok(())).optional()?.is_none() {
            return Ok(None);
        }
        let query = "SELECT encoding, encoded_message_definition FROM message_definitions WHERE topic_type = ?1";
        let found = self.database.query_row(query, [of_type], |row| Ok((row.get(0)?, row.get(1)?))).optional()?;
        Ok(found.filter(|(_, text): &(String, String)| !text.is_empty()))
    }

    fn decoder(&self, topic: &Topic, name: &str) -> Result<Decoder> {
        let carried = self.definition(&topic.of_type).map_err(|reason| broken(&self.path, &reason))?;
        let known = || usual::definition(&topic.of_type).map(|text| ("ros2msg".to_owned(), text));
        let Some((language, text)) = carried.or_else(known) else {
            let problem = format!(
                "topic `{name}` cannot be read: the recording carries no definition of {}, and it is none of the \
                 usual ones: {}",
                topic.of_type,
                usual::names().collect::<Vec<_>>().join(", ")
            );
            let fix = "Convert it where the messages are installed: `ros2 bag convert`, to mcap";
            return Err(Error::input(&self.path, problem, fix).of_kind(InputKind::Missing));
        };
        let described = Described {
            encoding: &topic.encoding,
            language: &language,
            name: &topic.of_type,
            definition: text.as_bytes(),
        };
        Decoder::of(described).map_err(|reason| {
            let fix = "Map another topic, or convert the recording to mcap: `ros2 bag convert`";
            Error::input(&self.path, format!("topic `{name}` cannot be read: {reason}"), fix)
                .of_kind(InputKind::Malformed)
        })
    }
}

impl Container for Sqlite {
    fn topics(&self) -> Result<Vec<Seen>> {
        let query = "SELECT name, type, (SELECT count(*) FROM messages WHERE topic_id = topics.id) FROM topics \
                     ORDER BY name";
        let read = |row: &rusqlite::Row| {
            let messages: i64 = row.get(2)?;
            Ok(Seen { topic: row.get(0)?, of_type: row.get(1)?, messages: usize::try_from(messages).unwrap_or(0) })
        };
        let all = || self.database.prepare(query)?.query_map([], read)?.collect::<rusqlite::Result<Vec<Seen>>>();
        let all = all().map_err(|reason| broken(&self.path, &reason))?;
        Ok(all.into_iter().filter(|seen| seen.messages > 0).collect())
    }

    fn messages(&self, topic: &str, take: &mut Take) -> Result<Option<String>> {
        let broken = |reason| broken(&self.path, &reason);
        let Some(found) = self.topic(topic).map_err(broken)? else { return Ok(None) };
        let decoder = self.decoder(&found, topic)?;
        let query = "SELECT timestamp, data FROM messages WHERE topic_id = ?1 ORDER BY timestamp";
        let mut statement = self.database.prepare(query).map_err(broken)?;
        let mut rows = statement.query([found.id]).map_err(broken)?;
        while let Some(row) = rows.next().map_err(broken)? {
            let at: i64 = row.get(0).map_err(broken)?;
            let bytes = row.get_ref(1).and_then(|data| Ok(data.as_blob()?)).map_err(broken)?;
            let at_ns = u64::try_from(at).unwrap_or(0);
            take(&decoder, Recorded { log_ns: at_ns, publish_ns: at_ns, bytes })?;
        }
        Ok(None)
    }
}

fn broken(path: &Path, reason: &rusqlite::Error) -> Error {
    let fix = "Check the file with `ros2 bag info`; a recording that was cut off is mended by `ros2 bag reindex`";
    Error::input(path, format!("cannot be read as a ROS 2 recording in SQLite: {reason}"), fix)
        .of_kind(InputKind::Malformed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_view_in_the_place_of_a_table_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.db3");
        let tables = "CREATE TABLE topics (id INTEGER, name TEXT, type TEXT, serialization_format TEXT);
                      INSERT INTO topics VALUES (1, '/a', 'b', 'cdr');";
        let one = "SELECT 1 AS topic_id, 2 AS timestamp, x'00' AS data";
        for (kind, is_sound) in [("TABLE", true), ("VIEW", false)] {
            let _ = std::fs::remove_file(&path);
            let made = format!("{tables} CREATE {kind} messages AS {one};");
            Connection::open(&path).unwrap().execute_batch(&made).unwrap();
            let topics = Sqlite::open(&path).unwrap().topics();
            assert_eq!(topics.is_ok_and(|topics| topics.len() == 1), is_sound, "{kind}");
        }
    }
}
