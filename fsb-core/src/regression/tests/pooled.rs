//! When k counts as valid: the same rules as for one parameter alone.

use super::super::axis::Axis;
use super::super::config::{DragConfig, Identify};
use super::super::design::{AxisDesign, Common};
use super::super::pooled::Pooled;
use super::super::triangle::{Row, Triangle};
use crate::readout::{ParameterRule, ParameterStatus};

/// λ T_row = 0.1, k within 0.5..=2, valid from 5 % on.
fn common() -> Common {
    let config = DragConfig::<1> {
        identify: [Identify::NOTHING_ELSE],
        rule: ParameterRule { min: 0.5, max: 2.0, max_relative_sd: 0.05 },
        ..DragConfig::new(0.01)
    };
    Common::new(&config).expect("valid")
}

/// Rows that say k, to about `relative_sd`.
fn axis(k: f32, relative_sd: f32, common: &Common) -> Axis {
    const ROWS: u16 = 600;
    let mut triangle = Triangle::default();
    // A residual of square e² over n independent rows leaves k to e/(f √n), f² being ½ here and a row worth λ T_row/0.79.
    let error = relative_sd * k * libm::sqrtf(0.5 * f32::from(ROWS) / common.colour);
    for n in 0..ROWS {
        let t = f32::from(n);
        let z0 = libm::sinf(0.141 * t);
        let z2 = k * z0 + error * core::f32::consts::SQRT_2 * libm::sinf(1.9 * t + 0.4);
        let scale = 1.0 / common.per_scale;
        let row = Row { zu: scale, minus_zv: 0.0, z0: scale * z0, z2: scale * z2 };
        assert!(triangle.add(&row, 0.0));
    }
    let own = AxisDesign::new(0.0, Identify::NOTHING_ELSE).expect("valid");
    let reduced = triangle.keep(false, false, common.row_rate2);
    let mut axis = Axis::start(own);
    (axis.triangle, axis.reduced, axis.excited) = (triangle, reduced, true);
    axis
}

fn settled(pooled: &mut Pooled, k: f32, relative_sd: f32) -> ParameterStatus {
    let common = common();
    pooled.settle(&mut [axis(k, relative_sd, &common)], true, &common);
    let newest = pooled.newest();
    let found = libm::sqrtf(newest.variance) / newest.value;
    assert!((newest.value / k - 1.0).abs() < 0.02 && (found / relative_sd - 1.0).abs() < 0.05, "{newest:?} {found}");
    pooled.status
}

#[test]
fn status_and_hysteresis() {
    use ParameterStatus::{AboveRange, BelowRange, Uncertain, Valid};

    for k in [0.6, 1.0, 1.9] {
        let mut pooled = Pooled::default();
        let mut status = |k: f32, relative_sd: f32| settled(&mut pooled, k, relative_sd);
        assert_eq!(status(k, 0.058), Uncertain, "{k}");
        assert_eq!(status(k, 0.042), Valid, "{k}");
        assert_eq!(status(k, 0.09), Valid, "{k}: up to twice");
        assert_eq!(status(k, 0.115), Uncertain, "{k}");
        assert_eq!(status(k, 0.09), Uncertain, "{k}");
        assert_eq!(status(2.2, 0.01), AboveRange, "{k}");
        assert_eq!(status(0.45, 0.01), BelowRange, "{k}");
        assert_eq!(status(k, 0.042), Valid, "{k}");
    }
}

/// Credible in range, up to a standard deviation as large as k.
#[test]
fn credible() {
    for (k, relative_sd, expected) in [
        (0.6, 0.9, true),
        (1.9, 0.9, true),
        (0.6, 1.15, false),
        (1.9, 1.15, false),
        (0.4, 0.01, false),
        (2.2, 0.01, false),
    ] {
        let common = common();
        let mut pooled = Pooled::default();
        pooled.settle(&mut [axis(k, relative_sd, &common)], true, &common);
        assert_eq!(pooled.credible().is_some(), expected, "{k} {relative_sd}: {:?}", pooled.newest());
    }
}

/// No rows: nothing is known, and what was known stays what it was.
#[test]
fn without_information() {
    let common = common();
    let mut pooled = Pooled::default();
    let nothing = || Axis::start(AxisDesign::default());
    pooled.settle(&mut [nothing()], true, &common);
    assert_eq!((pooled.status, pooled.credible()), (ParameterStatus::Unexcited, None));
    settled(&mut pooled, 1.0, 0.04);
    let before = pooled.newest();
    pooled.settle(&mut [nothing()], true, &common);
    assert_eq!((pooled.newest(), pooled.status), (before, ParameterStatus::Valid));
}
