//! The axes of a panel from its data and what the caller asked for.

use super::{
    axis::{Axis, SHORTEST},
    chart::{Chart, ChartError, Panel, Shape},
    ticks::ticks,
};

/// Room above and below the data, as a share of their extent.
const MARGIN: f64 = 0.05;

/// Horizontal and vertical axis of panel `index` of `chart`.
pub(super) fn axes(chart: &Chart, index: usize) -> Result<(Axis, Axis), ChartError> {
    let panel = &chart.panels[index];
    if panel.equal_aspect && panel.log_y {
        return Err(ChartError::EqualAspectLog { title: chart.title.clone(), panel: index + 1 });
    }
    let fixed = |axis: char, range: Option<(f64, f64)>, log: bool| match range {
        None => Ok(None),
        Some((low, high)) => {
            let (lo, hi) = (Axis::unit(log, low), Axis::unit(log, high));
            if hi - lo > (1e-11 * lo.abs().max(hi.abs())).max(SHORTEST) {
                Ok(Some(Axis { lo, hi, log }))
            } else {
                Err(ChartError::Range { title: chart.title.clone(), panel: index + 1, axis, low, high })
            }
        }
    };
    let x_fixed = fixed('x', panel.x_range, false)?;
    let y_fixed = fixed('y', panel.y_range, panel.log_y)?;
    let ((x_lo, x_hi), (y_lo, y_hi)) = extent(panel, x_fixed);
    let x = x_fixed.unwrap_or_else(|| match panel.equal_aspect {
        true => Axis::around(x_lo, x_hi, MARGIN, false),
        false => rounded(Axis::around(x_lo, x_hi, 0.0, false)),
    });
    let y = y_fixed.unwrap_or_else(|| Axis::around(y_lo, y_hi, MARGIN, panel.log_y));
    Ok((x, y))
}

/// The axis with its ends moved out to the next mark where that is near: samples over 10 s end at 10 s - T.
fn rounded(axis: Axis) -> Axis {
    let near = 0.01 * (axis.hi - axis.lo);
    let wider = Axis { lo: axis.lo - near, hi: axis.hi + near, ..axis };
    let marks = ticks(&wider, 10).marks;
    let lo = marks.first().map_or(axis.lo, |mark| mark.0.min(axis.lo));
    let hi = marks.last().map_or(axis.hi, |mark| mark.0.max(axis.hi));
    Axis { lo, hi, ..axis }
}

/// Extent of the drawable data in axis units; inside `window` only, where it is given. Without data low exceeds high.
fn extent(panel: &Panel, window: Option<Axis>) -> ((f64, f64), (f64, f64)) {
    const NONE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut xs, mut ys) = (NONE, NONE);
    let mut take = |x: f64, y: f64| {
        let (x, y) = (Axis::unit(false, x), Axis::unit(panel.log_y, y));
        if x.is_finite() && y.is_finite() && window.is_none_or(|w| w.lo <= x && x <= w.hi) {
            xs = (xs.0.min(x), xs.1.max(x));
            ys = (ys.0.min(y), ys.1.max(y));
        }
    };
    for series in &panel.series {
        match &series.shape {
            Shape::Line(points) | Shape::Dashed(points) | Shape::Dots(points) => {
                points.iter().for_each(|&(x, y)| take(x, y));
            }
            Shape::Band(points) => points.iter().for_each(|&(x, lower, upper)| {
                take(x, lower);
                take(x, upper);
            }),
            Shape::Level(_) => {}
        }
    }
    for series in &panel.series {
        if let Shape::Level(value) = series.shape {
            let y = Axis::unit(panel.log_y, value);
            if y.is_finite() {
                ys = (ys.0.min(y), ys.1.max(y));
            }
        }
    }
    (xs, ys)
}

#[cfg(test)]
mod tests {
    use super::super::chart::{Role, Series};
    use super::*;

    fn one(panel: Panel) -> Result<(Axis, Axis), ChartError> {
        axes(&Chart::new("t", "", vec![panel]), 0)
    }

    #[test]
    fn data_outside_the_window_do_not_stretch_the_other_axis() {
        let line = Series::line("", Role::Truth, [(0.0, 900.0), (1.0, 1.0), (2.0, 3.0), (f64::NAN, 1e9)]);
        let (x, y) = one(Panel { x_range: Some((1.0, 2.0)), ..Panel::new("", "", vec![line]) }).unwrap();
        assert_eq!((x.lo, x.hi), (1.0, 2.0));
        assert!((y.lo - 0.9).abs() < 1e-12 && (y.hi - 3.1).abs() < 1e-12);
    }

    #[test]
    fn an_end_close_to_a_mark_moves_there() {
        for (last, end) in [(9.9999, 10.0), (9.98, 10.0), (9.7, 9.7), (10.0, 10.0)] {
            let line = Series::line("", Role::Truth, [(0.0, 0.0), (last, 1.0)]);
            let (x, _) = one(Panel::new("", "", vec![line])).unwrap();
            assert_eq!((x.lo, x.hi), (0.0, end));
        }
    }

    #[test]
    fn a_level_is_inside() {
        let (_, y) = one(Panel::new("", "", vec![Series::level("", Role::Reference, 2.0)])).unwrap();
        assert!(y.lo < 2.0 && y.hi > 2.0);
    }

    #[test]
    fn impossible_axes_are_refused() {
        let plain = || Panel::new("", "", vec![]);
        for bad in [(1.0, 1.0), (2.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            assert!(matches!(
                one(Panel { y_range: Some(bad), ..plain() }),
                Err(ChartError::Range { axis: 'y', panel: 1, .. })
            ));
        }
        let log = Panel { y_range: Some((0.0, 1.0)), log_y: true, ..plain() };
        assert!(matches!(one(log), Err(ChartError::Range { .. })));
        let equal = Panel { equal_aspect: true, log_y: true, ..plain() };
        assert!(matches!(one(equal), Err(ChartError::EqualAspectLog { .. })));
    }
}
