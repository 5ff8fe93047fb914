//! Variances: rows are not independent, and what is not known of one parameter is not known of the others.

use super::super::reduced::{Estimate, Reduced};
use super::squares::{Squares, both};

const U: usize = 0;
const V: usize = 1;
const F: usize = 2;

/// λ T_row.
const RATE: f64 = 0.1;

/// u is one, v and f swing at the share `of_v` and `of_f` of λ about `mean`.
fn swings(of_v: f64, of_f: f64, mean: f64) -> (super::super::triangle::Triangle, Squares) {
    let rows = (0..4000).map(|n| {
        let t = RATE * f64::from(n);
        [1.0, libm::sin(of_v * t), mean + libm::sin(of_f * t), 1.0]
    });
    both(rows, 0.0)
}

/// How many rows take the place of one independent one, over that at the peak of the noise's spectrum, √2 λ.
fn weight(of_lambda: f64) -> f64 {
    let w = of_lambda * of_lambda;
    if w < 2.0 { (27.0 / 4.0 * w * w / (1.0 + w).powi(3)).max(0.25) } else { 1.0 }
}

const NOTHING: Estimate = Estimate { value: 0.0, variance: 0.0 };

/// The steps of the first rows are those of what the columns before have not explained yet.
fn close(got: f32, expected: f64, what: &str) {
    assert!((f64::from(got) / expected - 1.0).abs() < 0.04, "{what}: {got:e} for {expected:e}");
}

/// The variance of k and of D is that of a row over the energy, weighed by the spectrum of noise where the column swings.
#[test]
fn noise_is_weighed_by_its_spectrum() {
    for of_lambda in [0.2, 0.45, 0.6, 0.8, 1.0, 1.3, 1.5, 3.0] {
        let (triangle, squares) = swings(of_lambda, 0.03, 0.0);
        let reduced = triangle.keep(true, true, (RATE * RATE) as f32);
        let energy = squares.without(&[U]).product(V, V);
        close(reduced.drag(NOTHING, 0.7).variance, 0.7 * weight(of_lambda) / energy, "D");
        let (triangle, squares) = swings(0.03, of_lambda, 0.0);
        let reduced = triangle.keep(true, true, (RATE * RATE) as f32);
        let energy = squares.without(&[U, V]).product(F, F);
        close(reduced.k_variance(0.7), 0.7 * weight(of_lambda) / energy, "k");
    }
}

/// With d left out the mean of ẑ0 tells of k as well; noise as slow as that counts a quarter.
#[test]
fn a_column_left_out_adds_its_own_noise() {
    let of_lambda = 1.2;
    let (triangle, squares) = swings(0.5, of_lambda, 2.0);
    let reduced = triangle.keep(false, false, (RATE * RATE) as f32);
    let energy = squares.product(F, F);
    let swing = squares.without(&[U, V]).product(F, F);
    let by_drag = squares.without(&[U]).product(F, F) - swing;
    let noise = weight(of_lambda) * swing + weight(0.5) * by_drag + 0.25 * (energy - swing - by_drag);
    close(reduced.information(), energy, "information");
    close(reduced.k_variance(0.7), 0.7 * noise / (energy * energy), "k");
}

fn correlated() -> (Reduced, Squares) {
    let rows = (0..500).map(|n| {
        let t = RATE * f64::from(n);
        let v = 0.7 + libm::sin(1.1 * t);
        [1.0, v, 1.5 - 0.4 * v + libm::cos(0.8 * t), 1.0]
    });
    let (triangle, squares) = both(rows, 0.0);
    (triangle.keep(true, true, (RATE * RATE) as f32), squares)
}

/// What is not known of k goes to D and d by as much as they change with it, and what is not known of D to d.
#[test]
fn what_is_not_known_of_the_others() {
    let (reduced, squares) = correlated();
    let of_k = |variance: f32| Estimate { value: 0.9, variance };
    // How D changes with k, and d with both: by least squares in f64.
    let left = squares.without(&[U]);
    let drag_by_k = -left.product(V, F) / left.product(V, V);
    let by_drag = -squares.product(U, V) / squares.product(U, U);
    let by_k = by_drag * drag_by_k - squares.product(U, F) / squares.product(U, U);
    close(reduced.drag(of_k(0.3), 0.0).variance, drag_by_k * drag_by_k * 0.3, "D by k");
    close(reduced.disturbance(of_k(0.3), 0.2, 0.0).variance, by_k * by_k * 0.3, "d by k");
    let own = 0.25 * 0.7 / squares.product(U, U);
    let drag = f64::from(reduced.drag(of_k(0.0), 0.7).variance);
    close(reduced.disturbance(of_k(0.0), 0.2, 0.7).variance, own + by_drag * by_drag * drag, "d by D");
    let both = f64::from(reduced.drag(of_k(0.3), 0.7).variance);
    close(both as f32, drag + drag_by_k * drag_by_k * 0.3, "D by both");
}

/// What the rule leaves out of ẑv, a share of its squared steps, pulls D by that share of D, and k by all of it at the worst.
#[test]
fn the_rule() {
    let rows = (0..4000).map(|n| {
        let t = RATE * f64::from(n);
        let (v, f) = (0.7 * libm::sin(0.8 * t), libm::cos(1.7 * t));
        [1.0, v, f, 0.9 * f + 0.4 * v]
    });
    let (triangle, squares) = both(rows, 0.0);
    let mut reduced = triangle.keep(true, true, (RATE * RATE) as f32);
    reduced.set_rule(0.3 * triangle.v_steps());
    let energies = [squares.without(&[U]).product(V, V), squares.without(&[U, V]).product(F, F)];
    // Of a sine the steps are its derivative's.
    let share = 0.3 * (0.8 * RATE).powi(2);
    let k = Estimate { value: 0.9, variance: 0.0 };
    close(reduced.drag(k, 0.0).variance, (0.4 * share).powi(2), "D");
    close(reduced.k_variance(0.0), (0.4 * share).powi(2) * energies[0] / energies[1], "k");
}

/// Without D in the model nothing of it is unknown.
#[test]
fn no_drag_no_doubt() {
    let (triangle, squares) = swings(0.5, 1.2, 2.0);
    let reduced = triangle.keep(true, false, (RATE * RATE) as f32);
    close(reduced.disturbance(NOTHING, 0.0, 0.7).variance, 0.25 * 0.7 / squares.product(U, U), "d");
}

/// Rows that say nothing of k, with small residuals, and then ones that do, with large ones: those count.
#[test]
fn residuals_of_the_rows_that_tell() {
    let (still, moving) = (3000_u16, 600_u16);
    let rows = |from: u16| {
        let mut noise = 0.37_f64;
        (from..still + moving).map(move |n| {
            noise = (noise * 97.3 + 0.123).fract();
            let (f, size) = if n < still { (0.0, 0.1) } else { (libm::sin(0.141 * f64::from(n)), 2.0) };
            [1.0, 0.0, f, 0.8 * f + size * libm::sqrt(12.0) * (noise - 0.5)]
        })
    };
    let (triangle, _) = both(rows(0), 0.0);
    let of = |rows: f64| f64::from(triangle.uneven(rows as f32, 0.0));
    let (all, sum) = (f64::from(still + moving), f64::from(still) * 0.01 + f64::from(moving) * 4.0);
    // Twice as many rows would have twice the first part.
    let telling = (of(2.0 * all) - of(all)) / all;
    assert!((telling / 4.0 - 1.0).abs() < 0.1, "{telling}");
    assert!((of(all) / (4.0 * all - sum) - 1.0).abs() < 0.1, "{}", of(all));
    // Σ x⁴/(Σ x²)² of a sine is 3/2 of one over its length.
    let taken = 100.0;
    let worth = of(all) / f64::from(triangle.uneven(all as f32, taken));
    assert!((worth / (1.0 - 150.0 / f64::from(moving)) - 1.0).abs() < 0.02, "{worth}");
    assert_eq!(triangle.uneven(all as f32, 500.0), f32::MAX);
    // All alike: nothing.
    let (triangle, _) = both(rows(still), 0.0);
    assert_eq!(triangle.uneven(f32::from(moving), 0.0), 0.0);
}
