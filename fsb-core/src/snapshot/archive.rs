//! Writing and reading the fields of a state in their order: one list of fields serves both.

/// Takes fields out of a state, or puts them into it.
pub(crate) trait Archive {
    /// Four bytes.
    fn word(&mut self, bits: &mut u32);
    /// What was read is no value of its field.
    fn refuse(&mut self);
}

/// A state whose fields are known.
pub(crate) trait Stored {
    fn pass(&mut self, archive: &mut dyn Archive);
}

/// The fields of a state, in the order in which they are stored.
macro_rules! stored {
    ($type:ty { $($field:ident),* $(,)? }) => {
        impl $crate::snapshot::Stored for $type {
            fn pass(&mut self, archive: &mut dyn $crate::snapshot::Archive) {
                $($crate::snapshot::Stored::pass(&mut self.$field, archive);)*
            }
        }
    };
}
pub(crate) use stored;

/// The most that any number of a state can be: sums of squares of scaled signals at the limits, over days.
pub(crate) const MOST: f32 = 1e37;

impl Stored for f32 {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut bits = self.to_bits();
        archive.word(&mut bits);
        *self = Self::from_bits(bits);
        // Nothing known yet is the largest number.
        let sound = self.abs() <= MOST || *self == Self::MAX;
        if !sound {
            archive.refuse();
        }
    }
}

impl Stored for u32 {
    fn pass(&mut self, archive: &mut dyn Archive) {
        archive.word(self);
    }
}

macro_rules! small {
    ($($type:ty),+) => {
        $(impl Stored for $type {
            fn pass(&mut self, archive: &mut dyn Archive) {
                let mut bits = u32::from(*self);
                archive.word(&mut bits);
                match Self::try_from(bits) {
                    Ok(value) => *self = value,
                    Err(_) => archive.refuse(),
                }
            }
        })+
    };
}

small!(u8, u16);

impl Stored for bool {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut bits = u32::from(*self);
        archive.word(&mut bits);
        match bits {
            0 => *self = false,
            1 => *self = true,
            _ => archive.refuse(),
        }
    }
}

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn pass(&mut self, archive: &mut dyn Archive) {
        for each in self {
            each.pass(archive);
        }
    }
}

/// As many words whether there is one or not.
impl<T: Stored + Default> Stored for Option<T> {
    fn pass(&mut self, archive: &mut dyn Archive) {
        let mut is_some = self.is_some();
        is_some.pass(archive);
        let mut value = self.take().unwrap_or_default();
        value.pass(archive);
        if is_some {
            *self = Some(value);
        }
    }
}

/// Counts bytes.
pub(super) struct Length(pub usize);

impl Archive for Length {
    fn word(&mut self, _: &mut u32) {
        self.0 += 4;
    }

    fn refuse(&mut self) {}
}

/// Writes; what does not fit is lost.
pub(super) struct Writer<'a> {
    pub words: core::slice::ChunksExactMut<'a, u8>,
}

impl Archive for Writer<'_> {
    fn word(&mut self, bits: &mut u32) {
        if let Some(place) = self.words.next() {
            for (byte, from) in place.iter_mut().zip(bits.to_le_bytes()) {
                *byte = from;
            }
        }
    }

    fn refuse(&mut self) {}
}

/// Reads; `sound` tells afterwards whether all of it may be used.
pub(super) struct Reader<'a> {
    pub words: core::slice::ChunksExact<'a, u8>,
    pub sound: bool,
}

impl Archive for Reader<'_> {
    fn word(&mut self, bits: &mut u32) {
        match self.words.next().and_then(|word| <[u8; 4]>::try_from(word).ok()) {
            Some(word) => *bits = u32::from_le_bytes(word),
            None => self.sound = false,
        }
    }

    fn refuse(&mut self) {
        self.sound = false;
    }
}
