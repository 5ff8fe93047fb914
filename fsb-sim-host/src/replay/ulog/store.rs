//! The wanted topics of a file as columns of numbers.

use crate::progress::Progress;
use crate::replay::flight::FlightError;
use px4_ulog::stream_parser::model::{FlattenedField, FlattenedFieldType};
use px4_ulog::stream_parser::{
    DataMessage, LittleEndianParser, Message, SimpleCallbackResult, read_file_with_simple_callback,
};
use std::collections::BTreeMap;
use std::fs;
use std::io::{ErrorKind, Read};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

/// The first bytes of every ULog file.
const MAGIC: [u8; 7] = [0x55, 0x4c, 0x6f, 0x67, 0x01, 0x12, 0x35];

/// One instance of a topic.
#[derive(Clone, Debug, Default)]
pub struct Topic {
    /// Which instance, from 0.
    pub instance: u8,
    /// The numbers of every field, one per message; booleans as 0 and 1.
    pub fields: BTreeMap<String, Vec<f64>>,
}

impl Topic {
    /// Messages.
    pub fn len(&self) -> usize {
        self.field("timestamp").map_or(0, <[f64]>::len)
    }

    /// A field, where the topic has it.
    pub fn field(&self, name: &str) -> Option<&[f64]> {
        self.fields.get(name).map(Vec::as_slice)
    }
}

/// What was read of a file.
#[derive(Clone, Debug, Default)]
pub struct Store {
    /// Topics that were asked for, by name, each instance.
    pub topics: BTreeMap<String, Vec<Topic>>,
    /// Messages of every topic in the file.
    pub counts: BTreeMap<String, usize>,
    /// Earliest time stamp of any message \[µs\].
    pub start: f64,
    /// Gaps in which the logger lost messages \[s\].
    pub dropouts: Vec<f64>,
    /// The file ends in the middle, or is damaged there: why.
    pub incomplete: Option<String>,
}

impl Store {
    /// Reads the topics `wanted`.
    pub fn read(path: &Path, wanted: &[&str]) -> Result<Self, FlightError> {
        let file = path.display().to_string();
        let size = check(path, &file)?;
        let Some(name) = path.to_str() else {
            return Err(FlightError::Ulog { file, cause: "its name is not UTF-8".into() });
        };
        let progress = Progress::new("bytes of the log", size, size < 20_000_000);
        let mut store = Self { start: f64::INFINITY, ..Self::default() };
        let mut refused = None;
        let ended = guarded(|| {
            read_file_with_simple_callback(name, &mut |message| {
                match message {
                    Message::Data(data) => {
                        progress.advance(data.data.len() as u64 + 3);
                        refused = store.take(data, wanted);
                    }
                    Message::DropoutMessage(lost) => store.dropouts.push(f64::from(lost.duration_ms) / 1000.0),
                    _ => {}
                }
                if refused.is_some() { SimpleCallbackResult::Stop } else { SimpleCallbackResult::KeepReading }
            })
        });
        progress.finish();
        let to_the_end = matches!(ended, Some(Ok(_)));
        store.incomplete = match ended {
            Some(Ok(ended)) => {
                refused.or_else(|| ended.is_incomplete().then(|| "it ends in the middle of a message".to_owned()))
            }
            Some(Err(error)) => Some(error.to_string()),
            None => Some("a message is shorter than its own lengths say".to_owned()),
        };
        match &store.incomplete {
            Some(cause) if store.counts.is_empty() && !to_the_end => {
                Err(FlightError::Ulog { file, cause: cause.clone() })
            }
            _ => Ok(store),
        }
    }

    /// Takes a message in; says why the rest cannot be read if it is too short for its own format.
    fn take(&mut self, message: &DataMessage<'_>, wanted: &[&str]) -> Option<String> {
        let format = message.flattened_format;
        let name = format.message_name.as_str();
        *self.counts.entry(name.to_owned()).or_default() += 1;
        if !wanted.contains(&name) {
            return None;
        }
        let numbers: Option<Vec<f64>> = format.fields.iter().map(|field| number(field, message.data)).collect();
        let Some(numbers) = numbers else {
            return Some(format!("a message of {name} is shorter than its format"));
        };
        let instance = message.multi_id.value();
        let instances = self.topics.entry(name.to_owned()).or_default();
        let index = instances.iter().position(|topic| topic.instance == instance).unwrap_or_else(|| {
            instances.push(Topic { instance, ..Topic::default() });
            instances.len() - 1
        });
        let topic = &mut instances[index];
        for (field, number) in format.fields.iter().zip(numbers) {
            if field.flattened_field_name == "timestamp" && number < self.start {
                self.start = number;
            }
            match topic.fields.get_mut(&field.flattened_field_name) {
                Some(column) => column.push(number),
                None => {
                    topic.fields.insert(field.flattened_field_name.clone(), vec![number]);
                }
            }
        }
        None
    }

    /// Topics of the file with their numbers of messages, for an error message.
    pub fn listing(&self) -> String {
        if self.counts.is_empty() {
            return "no messages".to_owned();
        }
        self.counts.iter().map(|(name, count)| format!("{name} ({count})")).collect::<Vec<_>>().join(", ")
    }
}

/// The file is there and begins as a ULog file does; its size.
fn check(path: &Path, file: &str) -> Result<u64, FlightError> {
    let refuse = |source: std::io::Error| match source.kind() {
        ErrorKind::NotFound => FlightError::NotFound { file: file.to_owned(), expected: "a ULog file (.ulg)" },
        _ => FlightError::NotReadable { file: file.to_owned(), source },
    };
    let mut begin = [0; MAGIC.len()];
    match fs::File::open(path).map_err(refuse)?.read_exact(&mut begin) {
        Ok(()) if begin == MAGIC => fs::metadata(path).map(|data| data.len()).map_err(refuse),
        Err(error) if error.kind() != ErrorKind::UnexpectedEof => Err(refuse(error)),
        _ => Err(FlightError::Ulog { file: file.to_owned(), cause: "it does not begin with `ULog`".into() }),
    }
}

/// A field of a message; `None` where the message is too short for it.
fn number(field: &FlattenedField, data: &[u8]) -> Option<f64> {
    let bytes = data.get(usize::from(field.offset)..)?;
    let long = |width: usize| (bytes.len() >= width).then_some(bytes);
    Some(match field.field_type {
        FlattenedFieldType::Int8 => f64::from(i8::parse(long(1)?)),
        FlattenedFieldType::UInt8 => f64::from(u8::parse(long(1)?)),
        FlattenedFieldType::Char => f64::from(u8::parse(long(1)?)),
        FlattenedFieldType::Bool => f64::from(u8::from(u8::parse(long(1)?) != 0)),
        FlattenedFieldType::Int16 => f64::from(i16::parse(long(2)?)),
        FlattenedFieldType::UInt16 => f64::from(u16::parse(long(2)?)),
        FlattenedFieldType::Int32 => f64::from(i32::parse(long(4)?)),
        FlattenedFieldType::UInt32 => f64::from(u32::parse(long(4)?)),
        FlattenedFieldType::Float => f64::from(f32::parse(long(4)?)),
        FlattenedFieldType::Int64 => i64::parse(long(8)?) as f64,
        FlattenedFieldType::UInt64 => u64::parse(long(8)?) as f64,
        FlattenedFieldType::Double => f64::parse(long(8)?),
    })
}

/// What `read` gives; `None` where it panics, as the parser does on a message that is shorter than the lengths in it. Nothing of
/// that is printed.
fn guarded<T>(read: impl FnOnce() -> T) -> Option<T> {
    let hook = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let done = panic::catch_unwind(AssertUnwindSafe(read)).ok();
    panic::set_hook(hook);
    done
}
