//! A line cut into dashes. Coordinates are pixels.

type Point = (f64, f64);

/// Dashes of length `on` with gaps of length `off` along `line`; `None` when there would be more than `most`.
pub(super) fn dashes(line: &[Point], on: f64, off: f64, most: usize) -> Option<Vec<Vec<Point>>> {
    let length: f64 = line.windows(2).map(|w| (w[1].0 - w[0].0).hypot(w[1].1 - w[0].1)).sum();
    if length > (on + off) * most as f64 {
        return None;
    }
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut drawing = true;
    let mut left = on;
    let mut piece: Vec<Point> = line.first().copied().into_iter().collect();
    for pair in line.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let span = (b.0 - a.0).hypot(b.1 - a.1);
        let mut gone = 0.0;
        while span - gone > left {
            gone += left;
            let s = gone / span;
            let turn = (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1));
            if drawing {
                piece.push(turn);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![turn];
            }
            drawing = !drawing;
            left = if drawing { on } else { off };
        }
        left -= span - gone;
        if drawing {
            piece.push(b);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    Some(pieces)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_line() {
        let cut = dashes(&[(0.0, 0.0), (20.0, 0.0)], 6.0, 4.0, 100).unwrap();
        assert_eq!(cut, [vec![(0.0, 0.0), (6.0, 0.0)], vec![(10.0, 0.0), (16.0, 0.0)]]);
    }

    #[test]
    fn a_dash_goes_round_a_corner() {
        let cut = dashes(&[(0.0, 0.0), (3.0, 0.0), (3.0, 17.0)], 6.0, 4.0, 100).unwrap();
        assert_eq!(cut, [vec![(0.0, 0.0), (3.0, 0.0), (3.0, 3.0)], vec![(3.0, 7.0), (3.0, 13.0)]]);
    }

    #[test]
    fn too_many_are_refused() {
        assert!(dashes(&[(0.0, 0.0), (1001.0, 0.0)], 6.0, 4.0, 100).is_none());
    }
}
