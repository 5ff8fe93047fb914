//! Long series reduced to what a pixel can show. Coordinates are pixels here.

use std::collections::{BTreeMap, HashSet};

type Point = (f64, f64);

/// Width in pixels of the strips of a cloud of dots whose extremes are kept.
const STRIP: f64 = 8.0;

/// Stretches of `points` between gaps (a coordinate that is not finite).
pub(super) fn runs(points: &[Point]) -> impl Iterator<Item = &[Point]> {
    points.split(|&(x, y)| !(x.is_finite() && y.is_finite())).filter(|run| !run.is_empty())
}

/// The first, lowest, highest and last point of each pixel column, in their order: a line through them covers the
/// same pixels as the line through all (Jugel et al., "M4", VLDB 2014). A run whose x goes backwards is left alone.
pub(super) fn per_column(run: &[Point]) -> Vec<Point> {
    if run.windows(2).any(|w| w[1].0 < w[0].0) {
        return run.to_vec();
    }
    let mut kept = Vec::new();
    for column in run.chunk_by(|a, b| a.0.floor() == b.0.floor()) {
        let (mut low, mut high) = (0, 0);
        for (i, point) in column.iter().enumerate() {
            if point.1 < column[low].1 {
                low = i;
            }
            if point.1 > column[high].1 {
                high = i;
            }
        }
        let mut picked = [0, low, high, column.len() - 1];
        picked.sort_unstable();
        kept.extend(picked.iter().enumerate().filter(|&(n, i)| n == 0 || picked[n - 1] != *i).map(|(_, &i)| column[i]));
    }
    kept
}

/// The run without points nearer than `tolerance` to the line through their kept neighbours
/// (Douglas and Peucker, 1973).
pub(super) fn simplify(run: &[Point], tolerance: f64) -> Vec<Point> {
    if run.len() < 3 {
        return run.to_vec();
    }
    let mut keep = vec![false; run.len()];
    keep[0] = true;
    keep[run.len() - 1] = true;
    let mut open = vec![(0, run.len() - 1)];
    while let Some((a, b)) = open.pop() {
        let mut farthest = (tolerance, None);
        for i in a + 1..b {
            let d = distance(run[i], run[a], run[b]);
            if d > farthest.0 {
                farthest = (d, Some(i));
            }
        }
        if let Some(i) = farthest.1 {
            keep[i] = true;
            open.extend([(a, i), (i, b)]);
        }
    }
    run.iter().zip(keep).filter(|&(_, keep)| keep).map(|(&point, _)| point).collect()
}

/// Distance of `p` from the segment `a` to `b`.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length2 = dx * dx + dy * dy;
    let s = if length2 > 0.0 { (((p.0 - a.0) * dx + (p.1 - a.1) * dy) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (p.0 - a.0 - s * dx).hypot(p.1 - a.1 - s * dy)
}

/// Dots reduced to one in each pixel and, where that leaves more than `most`, to an even choice of them; the highest
/// and lowest dot of each [`STRIP`] always remain, so that outliers do.
pub(super) fn thin(dots: &[Point], most: usize) -> Vec<Point> {
    let mut taken = HashSet::new();
    let mut kept: Vec<usize> =
        (0..dots.len()).filter(|&i| taken.insert((dots[i].0.floor() as i64, dots[i].1.floor() as i64))).collect();
    if kept.len() > most {
        // Ranked by a scrambled index: a regular stride would beat with the sampling of the data.
        kept.sort_unstable_by_key(|&i| scrambled(i as u64));
        kept.truncate(most);
    }
    kept.extend(outermost(dots));
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| dots[i]).collect()
}

/// Indices of the highest and lowest dot of each strip.
fn outermost(dots: &[Point]) -> impl Iterator<Item = usize> {
    let mut strips: BTreeMap<i64, (usize, usize)> = BTreeMap::new();
    for (i, dot) in dots.iter().enumerate() {
        let (low, high) = strips.entry((dot.0 / STRIP).floor() as i64).or_insert((i, i));
        if dot.1 < dots[*low].1 {
            *low = i;
        }
        if dot.1 > dots[*high].1 {
            *high = i;
        }
    }
    strips.into_values().flat_map(|(low, high)| [low, high])
}

/// A permutation of the 64-bit numbers without visible order (the finaliser of SplitMix64).
fn scrambled(n: u64) -> u64 {
    let n = (n ^ (n >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let n = (n ^ (n >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    n ^ (n >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Random points with x rising over 60 pixels.
    fn rising() -> impl Strategy<Value = Vec<Point>> {
        prop::collection::vec((0.0..60.0, -100.0..100.0), 1..600).prop_map(|mut points| {
            points.sort_by(|a: &Point, b| a.0.total_cmp(&b.0));
            points
        })
    }

    fn ends(points: &[Point]) -> (f64, f64) {
        points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), p| (lo.min(p.1), hi.max(p.1)))
    }

    proptest! {
        #[test]
        fn every_column_keeps_its_extremes_and_ends(points in rising()) {
            let kept = per_column(&points);
            for column in 0..60 {
                let of = |all: &[Point]| -> Vec<Point> {
                    all.iter().copied().filter(|p| p.0.floor() == f64::from(column)).collect()
                };
                let (before, after) = (of(&points), of(&kept));
                prop_assert!(after.len() <= 4);
                prop_assert_eq!(ends(&before), ends(&after));
                prop_assert_eq!((before.first(), before.last()), (after.first(), after.last()));
            }
        }

        #[test]
        fn a_dropped_point_lies_on_the_simplified_line(points in rising()) {
            let kept = simplify(&points, 0.5);
            for &p in &points {
                let nearest = kept.windows(2).map(|w| distance(p, w[0], w[1])).fold(f64::INFINITY, f64::min);
                prop_assert!(nearest <= 0.5 || kept.contains(&p));
            }
        }

        #[test]
        fn thinned_dots_keep_the_outline(points in rising(), most in 1usize..50) {
            let kept = thin(&points, most);
            prop_assert!(kept.len() <= most + 2 * 8);
            for strip in 0..8 {
                let of = |all: &[Point]| -> Vec<Point> {
                    all.iter().copied().filter(|p| (p.0 / STRIP).floor() == f64::from(strip)).collect()
                };
                prop_assert_eq!(ends(&of(&kept)), ends(&of(&points)));
            }
        }
    }

    #[test]
    fn a_straight_line_needs_two_points() {
        let line: Vec<Point> = (0..10_000).map(|i| (f64::from(i) * 0.05, f64::from(i) * 0.02)).collect();
        assert_eq!(simplify(&per_column(&line), 0.1), [line[0], line[9999]]);
    }

    #[test]
    fn gaps_split_a_series() {
        let points = [(f64::NAN, 0.0), (1.0, 1.0), (2.0, 2.0), (3.0, f64::INFINITY), (4.0, 4.0), (5.0, f64::NAN)];
        let split: Vec<_> = runs(&points).collect();
        assert_eq!(split, [&points[1..3], &points[4..5]]);
    }

    #[test]
    fn a_path_that_turns_back_is_not_cut_into_columns() {
        let path = [(0.0, 0.0), (0.2, 5.0), (0.1, -5.0), (0.3, 9.0), (0.4, 1.0)];
        assert_eq!(per_column(&path), path);
    }
}
