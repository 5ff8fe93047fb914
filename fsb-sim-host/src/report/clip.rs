//! Cutting lines and areas at the edge of the plot. Coordinates are pixels, y down.

type Point = (f64, f64);

/// A rectangle, edges included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub fn contains(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// The part of the segment inside (Liang and Barsky, 1984).
    fn segment(&self, a: Point, b: Point) -> Option<(Point, Point)> {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (step, room) in
            [(-dx, a.0 - self.left), (dx, self.right - a.0), (-dy, a.1 - self.top), (dy, self.bottom - a.1)]
        {
            if step == 0.0 {
                if room < 0.0 {
                    return None;
                }
            } else if step < 0.0 {
                from = from.max(room / step);
            } else {
                to = to.min(room / step);
            }
        }
        let at = |s: f64| if s == 1.0 { b } else { (a.0 + s * dx, a.1 + s * dy) };
        (from <= to).then(|| (at(from), at(to)))
    }

    /// The parts of a line inside, each in one piece.
    pub fn line(&self, line: &[Point]) -> Vec<Vec<Point>> {
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        for pair in line.windows(2) {
            let Some((a, b)) = self.segment(pair[0], pair[1]) else { continue };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&a) => piece.push(b),
                _ => pieces.push(vec![a, b]),
            }
        }
        pieces
    }

    /// The part of an area inside (Sutherland and Hodgman, 1974); empty when there is none.
    pub fn area(&self, outline: &[Point]) -> Vec<Point> {
        // Signed distances to the four edges, positive inside.
        let inside: [&dyn Fn(Point) -> f64; 4] =
            [&|p| p.0 - self.left, &|p| self.right - p.0, &|p| p.1 - self.top, &|p| self.bottom - p.1];
        let mut area = outline.to_vec();
        for depth in inside {
            let Some(&last) = area.last() else { break };
            let mut cut = Vec::with_capacity(area.len());
            let mut a = last;
            for b in area {
                let (da, db) = (depth(a), depth(b));
                if (da < 0.0) != (db < 0.0) {
                    let s = da / (da - db);
                    cut.push((a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1)));
                }
                if db >= 0.0 {
                    cut.push(b);
                }
                a = b;
            }
            area = cut;
        }
        area
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const UNIT: Rect = Rect { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_line_is_cut_where_it_crosses_the_edge() {
        let cut = UNIT.line(&[(-5.0, 5.0), (5.0, 5.0), (5.0, 15.0), (15.0, 15.0), (-5.0, -5.0)]);
        assert_eq!(cut, [vec![(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)], vec![(10.0, 10.0), (0.0, 0.0)]]);
        assert!(UNIT.line(&[(-1.0, -1.0), (-1.0, 20.0)]).is_empty());
    }

    #[test]
    fn a_covering_area_becomes_the_rectangle() {
        let mut cut = UNIT.area(&[(-50.0, -50.0), (50.0, -50.0), (50.0, 50.0), (-50.0, 50.0)]);
        cut.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(cut, [(0.0, 0.0), (0.0, 10.0), (10.0, 0.0), (10.0, 10.0)]);
        assert!(UNIT.area(&[(20.0, 20.0), (30.0, 20.0), (30.0, 30.0)]).is_empty());
    }

    fn shoelace(p: &[Point]) -> f64 {
        (0..p.len()).map(|i| (p[i], p[(i + 1) % p.len()])).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum::<f64>().abs() / 2.0
    }

    proptest! {
        #[test]
        fn nothing_leaves_the_rectangle(points in prop::collection::vec((-30.0..30.0, -30.0..30.0), 2..40)) {
            let roomy = Rect { left: -1e-9, top: -1e-9, right: 10.0 + 1e-9, bottom: 10.0 + 1e-9 };
            for p in UNIT.line(&points).concat().into_iter().chain(UNIT.area(&points)) {
                prop_assert!(roomy.contains(p));
            }
        }

        /// The clipped area of an upright rectangle is known without clipping it.
        #[test]
        fn areas_come_out_right(l in -20.0..20.0, t in -20.0..20.0, w in 0.1..30.0, h in 0.1..30.0) {
            let (l, t, w, h): (f64, f64, f64, f64) = (l, t, w, h);
            let cut = UNIT.area(&[(l, t), (l + w, t), (l + w, t + h), (l, t + h)]);
            let side = |a: f64, b: f64| (b.min(10.0) - a.max(0.0)).max(0.0);
            prop_assert!((shoelace(&cut) - side(l, l + w) * side(t, t + h)).abs() < 1e-9);
        }
    }
}
