//! A ULog file, message by message, as the format's documentation has it.

/// A file under way.
pub struct Writer {
    bytes: Vec<u8>,
    subscribed: Vec<(&'static str, u8)>,
}

impl Writer {
    /// The header, and the formats: name and fields, such as `uint64_t timestamp;float[4] q`.
    pub fn new(formats: &[(&str, &str)]) -> Self {
        let mut bytes = vec![0x55, 0x4c, 0x6f, 0x67, 0x01, 0x12, 0x35, 1];
        bytes.extend(1_000_000u64.to_le_bytes());
        let mut writer = Self { bytes, subscribed: Vec::new() };
        writer.message(b'B', &[0; 40]);
        for (name, fields) in formats {
            writer.message(b'F', format!("{name}:{fields};").as_bytes());
        }
        writer
    }

    fn message(&mut self, kind: u8, content: &[u8]) {
        self.bytes.extend((content.len() as u16).to_le_bytes());
        self.bytes.push(kind);
        self.bytes.extend(content);
    }

    /// A message of a topic's instance at `t` (s): the fields after the time stamp, in order.
    pub fn data(&mut self, topic: &'static str, instance: u8, t: f64, fields: &[Field]) {
        let known = self.subscribed.iter().position(|&of| of == (topic, instance));
        let id = known.unwrap_or_else(|| {
            let id = self.subscribed.len();
            self.subscribed.push((topic, instance));
            let content = [&[instance][..], &(id as u16).to_le_bytes(), topic.as_bytes()].concat();
            self.message(b'A', &content);
            id
        });
        let mut content = (id as u16).to_le_bytes().to_vec();
        content.extend(((5.0e6 + t * 1e6).round() as u64).to_le_bytes());
        for field in fields {
            match field {
                Field::Float(x) => content.extend((*x as f32).to_le_bytes()),
                Field::Byte(x) => content.push(*x),
            }
        }
        self.message(b'D', &content);
    }

    pub fn finish(self) -> Vec<u8> {
        self.bytes
    }
}

/// A number of a message.
#[derive(Clone, Copy)]
pub enum Field {
    Float(f64),
    Byte(u8),
}
