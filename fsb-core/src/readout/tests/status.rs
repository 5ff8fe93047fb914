//! Statuses as they are stored and shown.

use super::super::ParameterStatus;
use crate::snapshot::{Archive, Stored};

const ALL: [ParameterStatus; 9] = [
    ParameterStatus::Settling,
    ParameterStatus::Unexcited,
    ParameterStatus::Uncertain,
    ParameterStatus::BelowRange,
    ParameterStatus::AboveRange,
    ParameterStatus::Faulted,
    ParameterStatus::Contradicted,
    ParameterStatus::Valid,
    ParameterStatus::Held,
];

/// One word, written or read.
struct Word {
    bits: u32,
    reads: bool,
    refused: bool,
}

impl Archive for Word {
    fn word(&mut self, bits: &mut u32) {
        if self.reads {
            *bits = self.bits;
        } else {
            self.bits = *bits;
        }
    }

    fn refuse(&mut self) {
        self.refused = true;
    }
}

/// Each is restored as what it was, whatever was there; a number that is none of them is refused.
#[test]
fn each_is_restored() {
    for status in ALL {
        let mut word = Word { bits: u32::MAX, reads: false, refused: false };
        let mut original = status;
        original.pass(&mut word);
        assert_eq!(original, status);
        for mut before in ALL {
            word.reads = true;
            before.pass(&mut word);
            assert_eq!((before, word.refused), (status, false));
        }
    }
    let mut word = Word { bits: 9, reads: true, refused: false };
    { ParameterStatus::Valid }.pass(&mut word);
    assert!(word.refused);
}

/// No two of them read alike.
#[test]
fn each_has_words_of_its_own() {
    use core::fmt::Write;

    let shown = ALL.map(|status| {
        let mut text = heapless::String::<64>::new();
        write!(text, "{status}").expect("short");
        text
    });
    for (index, text) in shown.iter().enumerate() {
        assert!(!text.is_empty() && shown[..index].iter().all(|other| other != text), "{text}");
    }
}
