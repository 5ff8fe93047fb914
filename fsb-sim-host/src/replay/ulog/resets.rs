//! Positions that the on-board estimator has reset: a step in the log that nothing flew.

use super::store::Topic;

/// One reset of one axis.
pub struct Reset {
    /// First sample after it.
    pub sample: usize,
    /// PX4's axis: north, east, down.
    pub axis: usize,
    /// What it added \[m\].
    pub size: f64,
}

/// The resets within `samples`, by the counters and the amounts that PX4 logs beside the position.
pub fn resets(topic: &Topic, samples: std::ops::Range<usize>) -> Vec<Reset> {
    let mut found = Vec::new();
    for (axis, counter, amount) in [
        (0, "xy_reset_counter", "delta_xy[0]"),
        (1, "xy_reset_counter", "delta_xy[1]"),
        (2, "z_reset_counter", "delta_z"),
    ] {
        let (Some(counter), Some(amount)) = (topic.field(counter), topic.field(amount)) else { continue };
        for sample in samples.clone().skip(1) {
            let (Some(before), Some(now), Some(&size)) =
                (counter.get(sample - 1), counter.get(sample), amount.get(sample))
            else {
                continue;
            };
            if before != now && size.is_finite() {
                found.push(Reset { sample, axis, size });
            }
        }
    }
    found
}
