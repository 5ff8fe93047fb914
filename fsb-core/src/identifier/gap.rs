//! Gaps in the measurements, filled with predictions, and how long they may be.

/// As many measurements in a row may come to be missing by chance where most of them are.
const SHORT: u32 = 32;

/// So many measurements in a row that were predicted are too many for the identifier's window, which would learn from the
/// predictions: 1/λ of the observer, whose memory that is. It forgets a late start in `late_settle` measurements, 8/λ.
pub(crate) fn longest_gap(late_settle: u32) -> u32 {
    (late_settle / 8).max(SHORT)
}
