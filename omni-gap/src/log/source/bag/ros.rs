//! # ROS messages: a definition in text, and bytes that are laid out by it
//!
//! One walk over the definition, two wires: CDR of ROS 2 (aligned, either byte order) and the packed form of ROS 1.
//! Wire formats: OMG DDS-XTypes 1.3, 7.4.1 (plain CDR); <https://wiki.ros.org/msg>.

use super::value::{LONGEST_LIST, Told, Value};
use re_cdr::{BigEndian, CdrReader, LittleEndian};
use re_ros_msg::MessageSchema;
use re_ros_msg::message_spec::{ArraySize, BuiltInType, ComplexType, MessageSpecification, Type};
use std::borrow::Cow;
use std::collections::HashMap;

/// The layouts of bytes that a definition can have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Wire {
    /// ROS 2.
    Cdr,
    /// ROS 1.
    Packed,
}

/// A definition, and those of the messages inside it.
#[derive(Debug)]
pub(super) struct Definition {
    wire: Wire,
    main: MessageSpecification,
    // by package and name
    inner: HashMap<(String, String), MessageSpecification>,
}

/// Messages inside messages are no deeper than this in any definition a person wrote.
const DEEPEST: usize = 32;

impl Definition {
    /// Reads a definition in text: that of the message `name`, those of its members behind lines of `=`.
    pub fn parse(name: &str, text: &str, wire: Wire) -> Told<Definition> {
        let schema = MessageSchema::parse(name, text).map_err(|reason| format!("{reason:#}"))?;
        let inner = schema.dependencies.into_iter().map(|spec| (split(&spec.name), spec)).collect();
        Ok(Definition { wire, main: schema.spec, inner })
    }

    /// Reads one message.
    pub fn decode(&self, bytes: &[u8]) -> Told<Value<'_>> {
        match self.wire {
            Wire::Packed => self.fields(&self.main, &mut Packed { rest: bytes }, 0),
            Wire::Cdr => {
                let (head, body) = bytes.split_first_chunk::<4>().ok_or("the message has no CDR header")?;
                match head[1] {
                    0 => self.fields(&self.main, &mut CdrReader::<BigEndian>::new(body), 0),
                    1 => self.fields(&self.main, &mut CdrReader::<LittleEndian>::new(body), 0),
                    other => Err(format!("CDR encapsulation {other}, expected plain CDR (0 or 1)")),
                }
            }
        }
    }

    fn fields<'a>(&'a self, of: &'a MessageSpecification, from: &mut impl Reader, depth: usize) -> Told<Value<'a>> {
        if depth > DEEPEST {
            return Err(format!("{} has itself inside", of.name));
        }
        let field = |field: &'a re_ros_msg::message_spec::Field| {
            Ok((Cow::Borrowed(field.name.as_str()), self.value(of, &field.ty, from, depth)?))
        };
        // an empty message is one byte in ROS 2 (the parser gives it a member for it), and nothing in ROS 1
        let is_empty = |field: &&re_ros_msg::message_spec::Field| field.name == "structure_needs_at_least_one_member";
        let fields = of.fields.iter().filter(|f| self.wire == Wire::Cdr || !is_empty(f));
        fields.map(field).collect::<Told<_>>().map(Value::Fields)
    }

    fn value<'a>(
        &'a self,
        scope: &MessageSpecification,
        ty: &'a Type,
        from: &mut impl Reader,
        depth: usize,
    ) -> Told<Value<'a>> {
        match ty {
            Type::BuiltIn(of) => scalar(of, from),
            Type::Array { ty, size } => {
                let length = match size {
                    ArraySize::Fixed(length) => *length,
                    ArraySize::Bounded(_) | ArraySize::Unbounded => from.u32()? as usize,
                };
                // of whatever there are so many, each takes a byte at least
                if length > from.left() {
                    return Err(format!("a list of {length} in {} bytes", from.left()));
                }
                let is_bytes =
                    matches!(**ty, Type::BuiltIn(BuiltInType::UInt8 | BuiltInType::Byte | BuiltInType::Char));
                if is_bytes && length > LONGEST_LIST {
                    from.skip(length)?;
                    return Ok(Value::Other);
                }
                (0..length).map(|_| self.value(scope, ty, from, depth)).collect::<Told<_>>().map(Value::List)
            }
            Type::Complex(of) => self.inner(scope, of, from, depth),
        }
    }

    fn inner<'a>(
        &'a self,
        scope: &MessageSpecification,
        of: &ComplexType,
        from: &mut impl Reader,
        depth: usize,
    ) -> Told<Value<'a>> {
        let (package, name) = match of {
            ComplexType::Absolute { package, name } => (split(&format!("{package}/{name}")).0, name.as_str()),
            ComplexType::Relative { name } => (split(&scope.name).0, name.as_str()),
        };
        let known = |package: &str| self.inner.get(&(package.to_owned(), name.to_owned()));
        // in ROS 1 a `Header` without its package is that of std_msgs
        let of_header = || (name == "Header").then(|| known("std_msgs")).flatten();
        if let Some(spec) = known(&package).or_else(of_header) {
            return self.fields(spec, from, depth + 1);
        }
        // the built-in times of ROS 1, and of ROS 2 where a definition leaves them out
        let of_time = package == "builtin_interfaces" || self.wire == Wire::Packed;
        let seconds = match name.to_ascii_lowercase().as_str() {
            "time" if of_time && self.wire == Wire::Packed => f64::from(from.u32()?),
            "time" | "duration" if of_time => f64::from(from.i32()?),
            _ => return Err(format!("{package}/{name} is not in the definition")),
        };
        Ok(Value::Number(seconds + 1e-9 * f64::from(from.u32()?)))
    }
}

/// Package and name of a message, whether its kind (`msg`) stands between them or not.
fn split(full: &str) -> (String, String) {
    let package = full.split('/').next().unwrap_or_default();
    let name = full.rsplit('/').next().unwrap_or_default();
    (package.to_owned(), name.to_owned())
}

fn scalar<'a>(of: &BuiltInType, from: &mut impl Reader) -> Told<Value<'a>> {
    Ok(Value::Number(match of {
        BuiltInType::Bool | BuiltInType::Byte | BuiltInType::Char | BuiltInType::UInt8 => f64::from(from.u8()?),
        BuiltInType::Int8 => f64::from(from.u8()? as i8),
        BuiltInType::Int16 => f64::from(from.u16()? as i16),
        BuiltInType::UInt16 => f64::from(from.u16()?),
        BuiltInType::Int32 => f64::from(from.i32()?),
        BuiltInType::UInt32 => f64::from(from.u32()?),
        BuiltInType::Int64 => from.u64()? as i64 as f64,
        BuiltInType::UInt64 => from.u64()? as f64,
        BuiltInType::Float32 => f64::from(f32::from_bits(from.u32()?)),
        BuiltInType::Float64 => f64::from_bits(from.u64()?),
        BuiltInType::String(_) => return from.text().map(Value::Text),
        BuiltInType::WString(_) => return Err("wide strings are not read".into()),
    }))
}

/// Numbers out of bytes.
trait Reader {
    fn u8(&mut self) -> Told<u8>;
    fn u16(&mut self) -> Told<u16>;
    fn u32(&mut self) -> Told<u32>;
    fn u64(&mut self) -> Told<u64>;
    fn text(&mut self) -> Told<String>;
    fn skip(&mut self, bytes: usize) -> Told<()>;
    /// Bytes that are left.
    fn left(&self) -> usize;

    fn i32(&mut self) -> Told<i32> {
        self.u32().map(|bits| bits as i32)
    }
}

impl<O: re_cdr::ByteOrder> Reader for CdrReader<'_, O> {
    fn u8(&mut self) -> Told<u8> {
        self.read_u8().map_err(|reason| reason.to_string())
    }

    fn u16(&mut self) -> Told<u16> {
        self.read_u16().map_err(|reason| reason.to_string())
    }

    fn u32(&mut self) -> Told<u32> {
        self.read_u32().map_err(|reason| reason.to_string())
    }

    fn u64(&mut self) -> Told<u64> {
        self.read_u64().map_err(|reason| reason.to_string())
    }

    fn text(&mut self) -> Told<String> {
        self.read_string().map_err(|reason| reason.to_string())
    }

    fn skip(&mut self, bytes: usize) -> Told<()> {
        self.read_bytes(bytes).map(|_| ()).map_err(|reason| reason.to_string())
    }

    fn left(&self) -> usize {
        self.remaining()
    }
}

/// ROS 1: little-endian, nothing between two numbers.
struct Packed<'a> {
    rest: &'a [u8],
}

impl<'a> Packed<'a> {
    fn take(&mut self, bytes: usize) -> Told<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(bytes).ok_or("the message is shorter than its definition")?;
        self.rest = rest;
        Ok(taken)
    }

    fn number<const N: usize>(&mut self) -> Told<[u8; N]> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N)?);
        Ok(bytes)
    }
}

impl Reader for Packed<'_> {
    fn u8(&mut self) -> Told<u8> {
        self.number().map(u8::from_le_bytes)
    }

    fn u16(&mut self) -> Told<u16> {
        self.number().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Told<u32> {
        self.number().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Told<u64> {
        self.number().map(u64::from_le_bytes)
    }

    fn text(&mut self) -> Told<String> {
        let length = self.u32()? as usize;
        self.take(length).map(|bytes| String::from_utf8_lossy(bytes).into_owned())
    }

    fn skip(&mut self, bytes: usize) -> Told<()> {
        self.take(bytes).map(|_| ())
    }

    fn left(&self) -> usize {
        self.rest.len()
    }
}
