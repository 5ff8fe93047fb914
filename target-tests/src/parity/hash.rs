//! Every output bit in one number.

use fsb_core::estimator::{AxisState, StateStatus};
use fsb_core::readout::{Parameter, ParameterStatus};

/// FNV-1a over 32-bit words.
#[derive(Clone, Copy, Debug)]
pub struct Hash(pub u64);

impl Hash {
    /// Of nothing.
    pub const START: Self = Self(0xcbf2_9ce4_8422_2325);

    /// Adds a word.
    pub fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds a number's bits.
    pub fn float(&mut self, value: f32) {
        self.word(value.to_bits());
    }

    /// Adds whether there are numbers, and which.
    pub fn floats(&mut self, values: Option<&[f32]>) {
        self.word(u32::from(values.is_some()));
        values.into_iter().flatten().for_each(|&value| self.float(value));
    }

    /// Adds a state, or that there is none.
    pub fn state(&mut self, state: Option<&AxisState>) {
        self.floats(state.map(|state| [state.position, state.velocity]).as_ref().map(<[f32; 2]>::as_slice));
    }

    /// Adds a parameter, or that there is none.
    pub fn parameter(&mut self, parameter: Option<&Parameter>) {
        let all = parameter.map(|known| [known.value, known.variance, known.sd()]);
        self.floats(all.as_ref().map(<[f32; 3]>::as_slice));
    }

    /// Adds why a state may be used or not.
    pub fn state_status(&mut self, status: StateStatus) {
        self.word(match status {
            StateStatus::NotMeasured => 0,
            StateStatus::Settling => 1,
            StateStatus::NoParameter => 2,
            StateStatus::Nominal => 3,
            StateStatus::Identified => 4,
            StateStatus::Held => 5,
            StateStatus::Stale => 6,
            _ => u32::MAX,
        });
    }

    /// Adds why a parameter may be used or not.
    pub fn parameter_status(&mut self, status: ParameterStatus) {
        self.word(match status {
            ParameterStatus::Settling => 0,
            ParameterStatus::Unexcited => 1,
            ParameterStatus::Uncertain => 2,
            ParameterStatus::BelowRange => 3,
            ParameterStatus::Valid => 4,
            ParameterStatus::AboveRange => 5,
            ParameterStatus::Contradicted => 6,
            ParameterStatus::Held => 7,
            ParameterStatus::Faulted => 8,
            _ => u32::MAX,
        });
    }
}
