//! What is expected of gusts, in variances: by least squares in f64.

use super::super::axis::Axis;
use super::super::config::{DragConfig, Identify};
use super::super::design::{AxisDesign, Common};
use super::super::pooled::read;
use super::super::reduced::Estimate;
use super::squares::both;

const U: usize = 0;
const V: usize = 1;
const F: usize = 2;

const SD: f64 = 0.4;
const LAMBDA: f64 = 2.0;
/// λ T_row = 0.1: rows of scale one, that of a row being taken out of what gusts add to it.
const ROW: f64 = 0.05;

fn common(disturbance_sd: Option<f64>) -> Common {
    Common::new(&DragConfig::<1> { disturbance_sd, ..DragConfig::new(0.01) }).expect("valid")
}

fn close(got: f32, expected: f64, what: &str) {
    assert!((f64::from(got) / expected - 1.0).abs() < 1e-3, "{what}: {got:e} for {expected:e}");
}

/// Rows without a residual but for k = 0.8, D = 0.3, d = 0.2: what is not known of them is what gusts do.
fn axis(mean: f64, common: &Common) -> (Axis, super::squares::Squares) {
    let scale = 1.0 / f64::from(common.per_scale);
    let rows = (0..4000).map(|n| {
        let t = 0.1 * f64::from(n);
        let (v, f) = (0.7 * libm::sin(0.5 * t), mean + libm::sin(0.8 * t));
        [1.0, v, f, 0.8 * f + 0.3 * v + 0.2].map(|x| scale * x)
    });
    let (triangle, squares) = both(rows, 0.0);
    let mut axis = Axis::start(AxisDesign::new(0.0, Identify::BOTH).expect("valid"));
    (axis.triangle, axis.excited) = (triangle, true);
    axis.reduced = triangle.keep(true, true, common.row_rate2);
    axis.reduced.set_gusts(&common.gusts, triangle.constant());
    (axis, squares)
}

/// A row counts with 2 g²/(λ T_row), and what a controller may answer with 3/8 g² over the mean square of k f left.
#[test]
fn of_k() {
    let common = common(Some(SD));
    let (axis, squares) = axis(2.0, &common);
    let mut axes = [axis];
    let found = read(&mut axes, &common);
    let left = squares.without(&[U, V]).product(F, F);
    let constant = squares.product(U, U);
    let scale2 = 1.0 / f64::from(common.per_scale2);
    let random = 2.0 * SD * SD / (LAMBDA * ROW) * scale2 / left;
    let answered = 0.375 * SD * SD * constant / (0.8 * left);
    close(found.value, 0.8, "k");
    close(found.variance, random + answered * answered, "of k");
}

/// D likewise, and what goes with the velocity: g²/λ over its mean square left. d without that.
#[test]
fn of_drag_and_disturbance() {
    let common = common(Some(SD));
    let (axis, squares) = axis(0.0, &common);
    let (reduced, k) = (axis.reduced, Estimate { value: 0.8, variance: 0.0 });
    let row = 2.0 * SD * SD / (LAMBDA * ROW) / f64::from(common.per_scale2);
    let (left, constant) = (squares.without(&[U]).product(V, V), squares.product(U, U));
    let carried = SD * SD / LAMBDA * constant / left;
    close(reduced.drag(k, 0.0).variance, row / left + carried * carried, "of D");
    let by_drag = squares.product(U, V) / constant;
    let expected = row / constant + by_drag * by_drag * (row / left + carried * carried);
    close(reduced.disturbance(k, 0.0, 0.0).variance, expected, "of d");
}

/// Where none are expected nothing changes, to the last bit.
#[test]
fn none() {
    let common = common(None);
    let (axis, _) = axis(2.0, &common);
    let plain = axis.triangle.keep(true, true, common.row_rate2);
    assert_eq!(axis.reduced, plain);
}
