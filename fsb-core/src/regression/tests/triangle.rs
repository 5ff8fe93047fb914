//! The triangle, with all columns and without some.

use super::super::reduced::{Estimate, Reduced, Unknown};
use super::super::triangle::{Row, Triangle};
use super::squares::{Numbers, Squares, both};

const U: usize = 0;
const V: usize = 1;
const F: usize = 2;
const Y: usize = 3;

/// y = 0.8 u + 0.3 v + 1.7 f and something that none of them explains. v and f have a part in common with u and each other.
fn rows(count: u32) -> impl Iterator<Item = Numbers> {
    (0..count).map(|n| {
        let t = f64::from(n);
        let u = 1.0 - libm::exp(-0.1 * (t + 1.0));
        // At rest for a while.
        let v = if n % 97 > 76 { 0.0 } else { 0.4 * u + libm::sin(0.31 * t) };
        let f = 2.0 * u + 0.5 * v + libm::cos(0.17 * t);
        [u, v, f, 0.8 * u + 0.3 * v + 1.7 * f + 0.1 * libm::sin(1.3 * t)]
    })
}

fn close(got: f32, expected: f64, what: &str) {
    let off = (f64::from(got) - expected).abs();
    assert!(off <= 2e-4 * expected.abs().max(0.05), "{what}: {got} for {expected}");
}

/// With what is left when the columns are taken out in f64, for each choice of columns, fading or not.
#[test]
fn it_is_least_squares() {
    for forgetting in [0.0, 0.01] {
        for count in [7, 60, 400] {
            let (triangle, squares) = both(rows(count), forgetting);
            for (disturbance, drag) in [(false, false), (false, true), (true, false), (true, true)] {
                compare(&triangle, &squares, disturbance, drag);
            }
        }
    }
}

fn compare(triangle: &Triangle, squares: &Squares, disturbance: bool, drag: bool) {
    let reduced = triangle.keep(disturbance, drag, 0.01);
    let free: &[usize] = match (disturbance, drag) {
        (false, false) => &[],
        (false, true) => &[V],
        (true, false) => &[U],
        (true, true) => &[U, V],
    };
    let alone = squares.without(free);
    close(reduced.information(), alone.product(F, F), "information");
    let k = alone.product(F, Y) / alone.product(F, F);
    close(reduced.k(), k, "k");
    for k in [k, 1.0, -2.0] {
        let residual = alone.product(Y, Y) - 2.0 * k * alone.product(F, Y) + k * k * alone.product(F, F);
        close(reduced.residual(k as f32), residual, "residual");
        // The others for this k: y - k f by what is left.
        let known = Estimate { value: k as f32, variance: 0.0 };
        let d_of = |left: &Squares, of: usize| (left.product(of, Y) - k * left.product(of, F)) / left.product(of, of);
        let best_drag = if drag { d_of(&squares.without(&free[..free.len() - 1]), V) } else { 0.0 };
        if drag {
            close(reduced.drag(known, 1.0).value, best_drag, "D");
        }
        if disturbance {
            let expected = d_of(squares, U) - best_drag * squares.product(U, V) / squares.product(U, U);
            close(reduced.disturbance(known, best_drag as f32, 1.0).value, expected, "d");
        }
    }
}

/// Σ of the rows, of ẑu and of its square, fading.
#[test]
fn what_is_counted() {
    for forgetting in [0.0_f64, 0.02] {
        let (triangle, _) = both(rows(200), forgetting);
        let [mut count, mut opening, mut constant] = [0.0_f64; 3];
        for [u, ..] in rows(200) {
            for (sum, x) in [(&mut count, 1.0), (&mut opening, u), (&mut constant, u * u)] {
                *sum += x - forgetting * *sum;
            }
        }
        close(triangle.count(), count, "count");
        close(triangle.opening(), opening, "opening");
        close(triangle.constant(), constant, "constant");
    }
}

/// A row that cannot be right, or from before the window opens, changes nothing.
#[test]
fn rows_that_cannot_be_right() {
    let good = Row { zu: 1.0, minus_zv: 0.5, z0: 2.0, z2: 3.0 };
    let (before, _) = both(rows(50), 0.0);
    for row in [
        Row { zu: f32::NAN, ..good },
        Row { minus_zv: 1.1e14, ..good },
        Row { z0: f32::INFINITY, ..good },
        Row { z2: -1.1e14, ..good },
        Row { zu: 1e-16, ..good },
        Row { zu: 0.0, ..good },
    ] {
        let mut triangle = before;
        assert!(!triangle.add(&row, 0.1), "{row:?}");
        assert_eq!(triangle.keep(true, true, 0.01), before.keep(true, true, 0.01));
        assert_eq!(triangle.count(), before.count());
    }
    for row in [good, Row { zu: 1e-14, ..good }, Row { zu: -1.0, ..good }, Row { z2: 0.9e14, ..good }] {
        let mut triangle = before;
        assert!(triangle.add(&row, 0.0), "{row:?}");
        assert_eq!(triangle.count(), before.count() + 1.0);
    }
}

/// A velocity counts as one where its variance is more than 1e-6 of its mean square, and than (1e-6 m/s)².
#[test]
fn what_moves() {
    for u in [1.0, 3.0] {
        let moving = |mean: f64, swing: f64| {
            let rows = (0..500).map(|n| [u, u * (mean + swing * libm::sin(0.3 * f64::from(n))), 1.0, 1.0]);
            both(rows, 0.0).0.is_moving()
        };
        assert!(moving(10.0, 0.017) && !moving(10.0, 0.012));
        assert!(moving(-2.0, 0.0034) && !moving(-2.0, 0.0024));
        assert!(moving(0.0, 1.7e-6) && !moving(0.0, 1.2e-6) && !moving(0.0, 0.0));
    }
}

/// What a term left out puts into k, D and d: what its column, added to the right-hand side, changes in them.
#[test]
fn what_is_left_out() {
    const BY: f64 = 0.7;
    let shifted = |by: usize| rows(400).map(move |row| [row[U], row[V], row[F], row[Y] + BY * row[by]]);
    let reduced = |triangle: Triangle, disturbance, drag| triangle.keep(disturbance, drag, 0.01);
    for (disturbance, drag) in [(false, false), (false, true), (true, false), (true, true)] {
        let before = reduced(both(rows(400), 0.0).0, disturbance, drag);
        for (column, kept) in [(U, disturbance), (V, drag)] {
            let after = reduced(both(shifted(column), 0.0).0, disturbance, drag);
            let by = |of: usize| if of == column { (BY * BY) as f32 } else { 0.0 };
            let unknown = Unknown { disturbance_variance: by(U), drag_variance: by(V) };
            let expected = |change: f32| if kept { 0.0 } else { f64::from(change * change) };
            // For one k, so that what goes into D and d is what goes there directly.
            let k = Estimate { value: 1.0, variance: 0.0 };
            let drags = [before.drag(k, 1.0).value, after.drag(k, 1.0).value];
            close(before.k_untold(&unknown), expected(after.k() - before.k()), "k");
            close(before.drag_untold(&unknown), expected(drags[1] - drags[0]), "D");
            if disturbance {
                let d = |of: &Reduced, drag: f32| of.disturbance(k, drag, 1.0).value;
                let change = d(&after, drags[1]) - d(&before, drags[0]);
                close(before.disturbance_untold(&unknown), expected(change), "d");
            }
        }
    }
}

/// A force that is constant but for rounding, and noise: what the first row of the triangle takes is all of it, and k what the mean says.
#[test]
fn next_to_parallel() {
    let mut noise = 0.37_f64;
    let rows = (0..2000).map(|n| {
        // Any irregular numbers.
        noise = (noise * 97.3 + 0.123).fract();
        let f = 3.0 * (1.0 + 2e-7 * f64::from(n % 3));
        [1.0, 0.0, f, 0.7 * f + 1e-2 * (noise - 0.5)]
    });
    let (triangle, squares) = both(rows, 0.0);
    let all_but_k = squares.product(2, 3) / squares.product(2, 2);
    let found = f64::from(triangle.keep(false, false, 0.01).k());
    assert!((found / all_but_k - 1.0).abs() < 3e-7, "{found} {all_but_k}");
}
