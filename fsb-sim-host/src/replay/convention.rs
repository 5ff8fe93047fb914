//! Whether positions, attitude and force speak of the same directions.
//!
//! In a log whose attitude is the other way round (world to body), or whose z points down, gravity still tells a k, and nothing
//! looks wrong. But an axis then accelerates against its force: alone, with drag and disturbance left free, it has a negative k
//! that explains its motion.

use super::fit::{Row, Terms, fit};

/// A k of one axis counts as opposed from this share of the pooled one on, …
const OPPOSED: f64 = -0.3;
/// … where it leaves less than this share of the acceleration's variation.
const EXPLAINED: f64 = 0.5;
/// In less than so many time constants 1/λ of the identifier chance explains a motion as well: of the recorded flights that this
/// was tried on, no piece of that length has an axis that seems opposed.
const SHORTEST: f64 = 4.0;

/// A line for the axes that move against their force; `rows` are those of the named axes, filtered with λT = `step`, `k` the one
/// of all together.
pub(super) fn opposed(names: &[&str], rows: &[Vec<Row>], k: f64, step: f64) -> Option<String> {
    let against: Vec<&str> = names
        .iter()
        .zip(rows)
        .filter(|(_, rows)| rows.len() as f64 * step >= SHORTEST && moves_against(rows, k))
        .map(|(&name, _)| name)
        .collect();
    (!against.is_empty()).then(|| {
        format!(
            "{}: the motion goes against the force. Is the attitude one of body to world, are its columns named rightly, and does \
             z point up? What is identified is not to be trusted",
            against.join(", ")
        )
    })
}

fn moves_against(rows: &[Row], k: f64) -> bool {
    let count = rows.len() as f64;
    let mean = rows.iter().map(|row| row.z2).sum::<f64>() / count;
    let spread = (rows.iter().map(|row| (row.z2 - mean).powi(2)).sum::<f64>() / count).sqrt();
    fit(&[rows.to_vec()], Terms { drag: true, disturbance: true })
        .is_some_and(|alone| alone.k < OPPOSED * k && alone.rms < EXPLAINED * spread)
}
