//! The measurement noise of a log, from its differences.
//!
//! The second difference of the position without what the known input explains, y\[n\] - 2 y\[n-1\] + y\[n-2\] - k S - c T², holds the noise of
//! three measurements and what the model lacks. Differencing m times more leaves white noise with C(2m+4, m+2) times the
//! variance of a measurement, while what the model lacks is smooth and fades. The estimate is the least over m = 0..=4: from
//! where it no longer falls, it is noise. Rounded positions (a millimetre, say) count with their rounding.

use crate::replay::log::{AxisColumn, AxisLog};

/// Differences beyond the second that are tried.
const ORDERS: usize = 4;

/// Standard deviation of the measurements of an axis \[m or rad\], the input explaining k f + `drift`; `None` where there are
/// too few in a row. Missing measurements part the log.
#[must_use]
pub fn measured(log: &AxisLog, axis: &AxisColumn, k: f64, drift: f64) -> Option<f64> {
    let t = log.period;
    let mut rows: Vec<Option<f64>> = vec![None; axis.position.len()];
    for (n, row) in rows.iter_mut().enumerate().skip(2) {
        if let [Some(y2), Some(y1), Some(y0)] = axis.position[n - 2..=n] {
            let (older, newer) = (axis.moments(n - 2, t), axis.moments(n - 1, t));
            let s = newer.j2 - older.j2 + t * older.j1;
            *row = Some((y0 - y1) - (y1 - y2) - k * s - drift * t * t);
        }
    }
    let (mut least, mut gain) = (f64::INFINITY, 6.0);
    for order in 0..=ORDERS {
        let (sum, count) = rows.iter().flatten().fold((0.0, 0usize), |(sum, count), x| (sum + x * x, count + 1));
        if count >= 10 {
            least = least.min(sum / count as f64 / gain);
        }
        rows = rows.windows(2).map(|pair| pair[1].zip(pair[0]).map(|(new, old)| new - old)).collect();
        // C(2p, p) → C(2p+2, p+1), p = order + 2.
        let p = order as f64 + 2.0;
        gain *= (2.0 * p + 1.0) * (2.0 * p + 2.0) / ((p + 1.0) * (p + 1.0));
    }
    least.is_finite().then(|| least.sqrt())
}
