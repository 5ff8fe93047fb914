//! What the fuzz targets have in common: taking decisions from bytes, and judging what an estimator hands out.

use fsb_core::readout::{Memory, ParameterRule, Readout};
use fsb_core::{Estimator, EstimatorConfig};

/// Decisions taken from bytes, one after the other; `None` when they have run out.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    pub fn word(&mut self) -> Option<u32> {
        let (first, rest) = self.0.split_first_chunk::<4>()?;
        self.0 = rest;
        Some(u32::from_le_bytes(*first))
    }

    /// Any bit pattern, or a number as flights have it.
    pub fn number(&mut self) -> Option<f32> {
        let kind = self.byte()?;
        Some(match kind {
            0..128 => (f32::from(kind) - 64.0) / 16.0,
            128..200 => f32::from(self.byte()?) / 100.0,
            200 => f32::NAN,
            201 => f32::INFINITY,
            202 => f32::MAX,
            203 => f32::MIN_POSITIVE / 4.0,
            204 => 1e5,
            205 => -1e5,
            206 => -0.0,
            _ => f32::from_bits(self.word()?),
        })
    }

    pub fn numbers<const N: usize>(&mut self) -> Option<[f32; N]> {
        let mut all = [0.0; N];
        for each in &mut all {
            *each = self.number()?;
        }
        Some(all)
    }

    /// A configuration, valid or not, but mostly.
    pub fn config<const N: usize, const P: usize>(&mut self) -> Option<EstimatorConfig<N, P>> {
        let bits = self.byte()?;
        let mut config = EstimatorConfig::new([1e-3, 4e-3, 0.01, 0.05][usize::from(bits & 3)]);
        config.substeps = 1 + u32::from(bits >> 2 & 3);
        config.block = [1, 2, 5, 10][usize::from(bits >> 4 & 3)];
        config.readout = if bits & 64 == 0 { Readout::LeastSquares } else { Readout::AbsoluteRatio };
        let bits = self.byte()?;
        config.memory = if bits & 1 == 0 { Memory::Infinite } else { Memory::Fading { tau: 0.3 } };
        config.nominal = [(bits & 2 == 0).then_some(0.7); P];
        config.noise_sd = (bits & 4 == 0).then_some(1e-3);
        config.drift = [if bits & 8 == 0 { 0.0 } else { -9.81 }; N];
        if bits & 16 != 0 {
            config.rule = [ParameterRule { min: 1e-15, max: 1e15, max_relative_sd: 1e3 }; P];
        }
        if bits & 32 != 0 {
            (config.position_limit, config.input_limit) = (1e6, 1e6);
        }
        if bits & 64 != 0 {
            config.turn = u32::from(self.byte()? & 15);
        }
        Some(config)
    }
}

/// Everything that is handed out is a number, and a parameter is positive.
pub fn judge<const N: usize, const P: usize>(estimator: &Estimator<N, P>) {
    for parameter in estimator.parameters().into_iter().flatten() {
        assert!(parameter.value.is_finite() && parameter.value > 0.0, "{parameter:?}");
        assert!(parameter.variance.is_finite() && parameter.variance >= 0.0, "{parameter:?}");
    }
    for state in estimator.states().into_iter().flatten() {
        assert!(state.position.is_finite() && state.velocity.is_finite(), "{state:?}");
    }
}
