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

/// The groups of a run that have signals.
fn topics(run: &Run) -> impl Iterator<Item = Topic<'_>> {
    let groups = run.signals_by_group().into_iter().filter(|(_, signals)| !signals.is_empty());
    groups.map(|(group, signals)| Topic { name: name_of(group), signals })
}

/// What the topic of a group is called.
fn name_of(group: &str) -> &'static str {
    match group {
        "u" => "motor_voltage",
        "i" => "motor_current",
        "w" => "wheel_speed",
        "pose" => "pose",
        "wset" => "wheel_speed_set",
        "vbat" => "battery_voltage",
        "gyro" => "yaw_rate",
        _ => "other",
    }
}

fn schema(topic: &Topic<'_>) -> serde_json::Value {
    let properties: serde_json::Map<String, serde_json::Value> =
        topic.signals.iter().map(|(name, _)| (name.clone(), serde_json::json!({"type": "number"}))).collect();
    serde_json::json!({"title": topic.name, "type": "object", "properties": properties})
}
