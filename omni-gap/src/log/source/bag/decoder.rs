//! # How the messages of a topic are read: by the encoding that its recorder named

use super::ros::{Definition, Wire};
use super::value::{Told, Value};
use prost_reflect::{DescriptorPool, DynamicMessage, MessageDescriptor, ReflectMessage};
use std::borrow::Cow;

/// Reads the messages of one topic.
#[derive(Debug)]
pub(super) enum Decoder {
    Ros(Definition),
    Json,
    Protobuf(MessageDescriptor),
}

/// What a recording says of a topic's messages.
#[derive(Debug, Clone, Copy)]
pub(super) struct Described<'a> {
    /// How their bytes are laid out: `cdr`, `ros1`, `json` or `protobuf`.
    pub encoding: &'a str,
    /// What their definition is written in: `ros2msg`, `ros1msg`, `protobuf`, or anything where none is needed.
    pub language: &'a str,
    /// Their type.
    pub name: &'a str,
    pub definition: &'a [u8],
}

impl Decoder {
    pub fn of(described: Described) -> Told<Decoder> {
        let Described { encoding, language, name, definition } = described;
        let text = || std::str::from_utf8(definition).map_err(|_| "its definition is not UTF-8".to_owned());
        match (encoding, language) {
            ("cdr", "ros2msg") => Definition::parse(name, text()?, Wire::Cdr).map(Decoder::Ros),
            ("ros1", "ros1msg") => Definition::parse(name, text()?, Wire::Packed).map(Decoder::Ros),
            ("json", _) => Ok(Decoder::Json),
            ("protobuf", _) => {
                let pool = DescriptorPool::decode(definition).map_err(|reason| reason.to_string())?;
                let found = pool.get_message_by_name(name);
                found.map(Decoder::Protobuf).ok_or_else(|| format!("{name} is not in its definition"))
            }
            _ => Err(format!(
                "its messages are `{encoding}` by a definition in `{language}`; read are cdr with ros2msg, ros1 with \
                 ros1msg, protobuf and json"
            )),
        }
    }

    /// Reads one message.
    pub fn decode(&self, bytes: &[u8]) -> Told<Value<'_>> {
        match self {
            Decoder::Ros(definition) => definition.decode(bytes),
            Decoder::Json => serde_json::from_slice(bytes).map(of_json).map_err(|reason| reason.to_string()),
            Decoder::Protobuf(of) => {
                let message = DynamicMessage::decode(of.clone(), bytes).map_err(|reason| reason.to_string())?;
                Ok(of_message(&message))
            }
        }
    }
}

fn of_json(value: serde_json::Value) -> Value<'static> {
    use serde_json::Value as Json;
    match value {
        Json::Null => Value::Other,
        Json::Bool(is) => Value::Number(f64::from(u8::from(is))),
        Json::Number(number) => number.as_f64().map_or(Value::Other, Value::Number),
        Json::String(text) => Value::Text(text),
        Json::Array(list) => Value::List(list.into_iter().map(of_json).collect()),
        Json::Object(fields) => {
            Value::Fields(fields.into_iter().map(|(name, value)| (Cow::Owned(name), of_json(value))).collect())
        }
    }
}

fn of_message(message: &DynamicMessage) -> Value<'static> {
    let descriptor = message.descriptor();
    let field = |field: prost_reflect::FieldDescriptor| {
        // a part that was left out is no number
        let is_there = message.has_field(&field) || !field.supports_presence();
        let value = if is_there { of_protobuf(&message.get_field(&field)) } else { Value::Other };
        (Cow::Owned(field.name().to_owned()), value)
    };
    Value::Fields(descriptor.fields().map(field).collect())
}

fn of_protobuf(value: &prost_reflect::Value) -> Value<'static> {
    use prost_reflect::Value as Field;
    match value {
        Field::Bool(is) => Value::Number(f64::from(u8::from(*is))),
        Field::I32(number) | Field::EnumNumber(number) => Value::Number(f64::from(*number)),
        Field::I64(number) => Value::Number(*number as f64),
        Field::U32(number) => Value::Number(f64::from(*number)),
        Field::U64(number) => Value::Number(*number as f64),
        Field::F32(number) => Value::Number(f64::from(*number)),
        Field::F64(number) => Value::Number(*number),
        Field::String(text) => Value::Text(text.clone()),
        Field::Message(message) => of_message(message),
        Field::List(list) => Value::List(list.iter().map(of_protobuf).collect()),
        Field::Bytes(_) | Field::Map(_) => Value::Other,
    }
}
