//! Six axes as a flight controller has them: x, y, z sharing 1/m, and φ, θ, ψ with their own 1/I, on another tuning.

use fsb_core::estimator::{AxisState, OutOfStep};
use fsb_core::readout::Parameter;
use fsb_core::{Estimator, EstimatorConfig, EstimatorDesign, Tuning};

use crate::scenario::{DRIFT, Tick};

/// The estimators of both tunings.
#[derive(Clone, Debug)]
pub struct Six {
    /// 1/m.
    pub translation: Estimator<3, 1>,
    /// 1/Ix, 1/Iy, 1/Iz.
    pub rotation: Estimator<3, 3>,
}

/// Bytes of state, the designs (constants, which could be in flash) not counted.
pub const STATE_BYTES: usize =
    size_of::<Six>() - size_of::<EstimatorDesign<3, 1>>() - size_of::<EstimatorDesign<3, 3>>();
/// Bytes of the designs.
pub const DESIGN_BYTES: usize = size_of::<Six>() - STATE_BYTES;

/// The configurations at a control period of 1 ms.
pub fn configs(block: u32, substeps: u32) -> (EstimatorConfig<3, 1>, EstimatorConfig<3, 3>) {
    let mut translation = EstimatorConfig::new(1e-3);
    translation.block = block;
    translation.substeps = substeps;
    translation.drift = [DRIFT[0], DRIFT[1], DRIFT[2]];
    translation.nominal = [Some(0.5)];
    let mut rotation = EstimatorConfig::new(1e-3);
    rotation.block = block;
    rotation.substeps = substeps;
    // What the configuration recommends for the second of two estimators of three axes, where a block has room for both.
    rotation.turn = if block == 1 || block >= 8 { 4 } else { 3 % block };
    rotation.identifier = Tuning::from_lambda(4.0);
    rotation.observer = Tuning::from_lambda(20.0);
    rotation.nominal = [Some(50.0); 3];
    (translation, rotation)
}

impl Six {
    /// Everything on: both tunings, six observers, six identifiers, mass and three inertias with their variance.
    pub fn new(block: u32, substeps: u32) -> Self {
        let (translation, rotation) = configs(block, substeps);
        Self {
            translation: Estimator::new(&translation).expect("a good configuration"),
            rotation: Estimator::new(&rotation).expect("a good configuration"),
        }
    }
}

/// One axis alone, block length 1.
pub fn one() -> Estimator<1, 1> {
    Estimator::new(&EstimatorConfig::new(1e-3)).expect("a good configuration")
}

/// A tick's first half, by itself so that it can be counted and disassembled.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn six_measure(six: &mut Six, [x, y, z, p, q, r]: &[f32; 6]) -> Result<(), OutOfStep> {
    six.translation.measure_raw(&[*x, *y, *z])?;
    six.rotation.measure_raw(&[*p, *q, *r])
}

/// A tick's second half.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn six_apply(six: &mut Six, &[x, y, z, p, q, r]: &[f32; 6]) {
    six.translation.apply(&[x, y, z]);
    six.rotation.apply(&[p, q, r]);
}

/// What the controller reads.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn six_states(six: &Six) -> [Option<AxisState>; 6] {
    let ([x, y, z], [p, q, r]) = (six.translation.states(), six.rotation.states());
    [x, y, z, p, q, r]
}

/// What else the controller reads: k with its variance.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn six_parameters(six: &Six) -> [Option<Parameter>; 4] {
    let ([mass], [x, y, z]) = (six.translation.parameters(), six.rotation.parameters());
    [mass, x, y, z]
}

/// One axis: a tick's first half.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn one_measure(one: &mut Estimator<1, 1>, y: f32) -> Result<(), OutOfStep> {
    one.measure_raw(&[y])
}

/// One axis: a tick's second half.
#[inline(never)]
#[unsafe(no_mangle)]
pub fn one_apply(one: &mut Estimator<1, 1>, input: f32) {
    one.apply(&[input]);
}

/// The positions with NaN for what is missing.
pub fn raw(tick: &Tick) -> [f32; 6] {
    tick.positions.unwrap_or([None; 6]).map(|y| y.unwrap_or(f32::NAN))
}
