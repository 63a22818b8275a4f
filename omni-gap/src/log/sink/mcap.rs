//! A run as MCAP: a topic for each group of signals, in JSON with a schema, which Foxglove, PlotJuggler and others plot as it is.

use std::collections::BTreeMap;
use std::io::Cursor;

use mcap::records::MessageHeader;
use mcap::{McapError, Writer};

use crate::log::channel::Channel;
use crate::log::run::Run;

/// A group of signals: what its topic is called, and its signals by the names of their columns.
struct Topic<'a> {
    name: &'static str,
    signals: Vec<(String, &'a Channel)>,
}

/// The bytes of a file with these runs, each below its name.
pub(super) fn bytes(runs: &[(&str, &Run)]) -> Result<Vec<u8>, String> {
    written(runs).map_err(|why| why.to_string())
}

fn written(runs: &[(&str, &Run)]) -> Result<Vec<u8>, McapError> {
    let mut out = Writer::new(Cursor::new(Vec::new()))?;
    for (above, run) in runs {
        for topic in topics(run) {
            let schema = out.add_schema(topic.name, "jsonschema", schema(&topic).to_string().as_bytes())?;
            let prefix = if above.is_empty() { String::new() } else { format!("/{above}") };
            let channel = out.add_channel(schema, &format!("{prefix}/{}", topic.name), "json", &BTreeMap::new())?;
            write_rows(&mut out, channel, run, &topic)?;
        }
    }
    out.finish()?;
    Ok(out.into_inner().into_inner())
}

fn write_rows(out: &mut Writer<Cursor<Vec<u8>>>, channel: u16, run: &Run, topic: &Topic<'_>) -> Result<(), McapError> {
    for (row, t_s) in run.t_s.iter().enumerate() {
        let seen =
            topic.signals.iter().filter_map(|(name, channel)| Some((name.clone(), channel.get(row).ok()?.into())));
        let message: serde_json::Map<String, serde_json::Value> = seen.collect();
        if message.is_empty() {
            continue;
        }
        let time = (t_s * 1e9).round().max(0.0) as u64;
        let header = MessageHeader { channel_id: channel, sequence: row as u32, log_time: time, publish_time: time };
        out.write_to_known_channel(&header, serde_json::Value::Object(message).to_string().as_bytes())?;
    }
    Ok(())
}

/// The signals of a run by what they are of; a run's clock begins where the file's does.
fn topics(run: &Run) -> Vec<Topic<'_>> {
    let mut topics: Vec<Topic<'_>> = Vec::new();
    for (column, channel) in run.signals() {
        let name = topic_of(&column);
        match topics.iter_mut().find(|topic| topic.name == name) {
            Some(topic) => topic.signals.push((column, channel)),
            None => topics.push(Topic { name, signals: vec![(column, channel)] }),
        }
    }
    topics
}

/// The topic of a column of the contract.
fn topic_of(column: &str) -> &'static str {
    match column.trim_end_matches(|c: char| c != '_').trim_end_matches('_') {
        stem if stem.starts_with("wset") => "wheel_speed_set",
        stem if stem.starts_with('u') => "motor_voltage",
        stem if stem.starts_with('i') => "motor_current",
        _ if column.ends_with("_rad_s") && column.starts_with('w') => "wheel_speed",
        _ if ["x_m", "y_m", "theta_rad"].contains(&column) => "pose",
        "vbat" => "battery_voltage",
        _ if column == "gyro_rad_s" => "yaw_rate",
        _ => "other",
    }
}

fn schema(topic: &Topic<'_>) -> serde_json::Value {
    let properties: serde_json::Map<String, serde_json::Value> =
        topic.signals.iter().map(|(name, _)| (name.clone(), serde_json::json!({"type": "number"}))).collect();
    serde_json::json!({"title": topic.name, "type": "object", "properties": properties})
}
