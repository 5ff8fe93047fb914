//! Take-off and landing: the part of a log that flies.
//!
//! PX4's land detector says "not landed" as soon as the thrust rises, and "landed" a second or more after the touch-down: a
//! vehicle that still stands, its weight on its legs, would be read as a heavier one. So of the time between its two words
//! only that is used in which the vehicle is [`CLEAR`] above the height at which it stood when it took off, and, at the
//! end, until [`CLEAR`] above where it stands afterwards.

/// Height above the ground from which on a vehicle is clear of it \[m\]: beyond the play of legs and of the height estimate.
pub const CLEAR: f64 = 0.2;
/// A flight worth the name lasts so long \[s\].
pub const SHORTEST: f64 = 1.0;
/// Below this share of the full thrust nothing flies.
const IDLE: f64 = 0.05;

/// A flag and the time from which on it holds \[s\].
pub type Flags = Vec<(f64, bool)>;

/// What tells flight from ground.
pub struct Signs<'a> {
    /// Times \[s\] and heights \[m\], up.
    pub height: &'a [(f64, f64)],
    /// Times \[s\] and sizes of the thrust.
    pub thrust: &'a [(f64, f64)],
    /// The land detector's word for "on the ground", if the log has it.
    pub landed: Option<&'a Flags>,
    /// Whether the motors are armed, if the log has it.
    pub armed: Option<&'a Flags>,
}

/// A part that flies.
pub struct Airborne {
    /// \[s\]
    pub from: f64,
    /// \[s\]
    pub to: f64,
    /// How many others the log has.
    pub others: usize,
}

/// The longest part that flies, or why there is none.
pub fn flight(signs: &Signs<'_>) -> Result<Airborne, String> {
    if signs.armed.is_some_and(|armed| armed.iter().all(|&(_, on)| !on)) {
        return Err("the motors are never armed".into());
    }
    if signs.landed.is_some_and(|landed| landed.iter().all(|&(_, on)| on)) {
        return Err("the land detector never leaves the ground".into());
    }
    if signs.thrust.iter().all(|&(_, f)| f < IDLE) {
        return Err("the thrust set-point never leaves idle".into());
    }
    let airborne = |t: f64| {
        let on_ground = signs.landed.is_some_and(|landed| holds(landed, t).unwrap_or(true));
        let disarmed = signs.armed.is_some_and(|armed| !holds(armed, t).unwrap_or(true));
        !on_ground && !disarmed && (signs.landed.is_some() || value(signs.thrust, t) >= IDLE)
    };
    let mut longest: Option<(f64, f64)> = None;
    let (mut begin, mut flights) = (0, 0);
    while begin < signs.height.len() {
        if !airborne(signs.height[begin].0) {
            begin += 1;
            continue;
        }
        let mut end = begin;
        while end < signs.height.len() && airborne(signs.height[end].0) {
            end += 1;
        }
        // Where it stood before and where it stands afterwards; a log that begins or ends in the air has neither.
        let ground = |index: Option<usize>| index.map(|index| signs.height[index].1);
        let before = ground(begin.checked_sub(1));
        let after = ground((end < signs.height.len()).then_some(end));
        if let Some(found) = clear(&signs.height[begin..end], before, after) {
            flights += usize::from(found.1 - found.0 >= SHORTEST);
            if longest.is_none_or(|longest| found.1 - found.0 > longest.1 - longest.0) {
                longest = Some(found);
            }
        }
        begin = end;
    }
    match longest {
        Some((from, to)) if to - from >= SHORTEST => Ok(Airborne { from, to, others: flights - 1 }),
        Some((from, to)) => Err(format!("only {:.1} s in the air, {SHORTEST} s are needed", to - from)),
        None => Err(format!("the vehicle never is {CLEAR} m above where it stood")),
    }
}

/// The part of `height` that is clear of the ground that was left, up to where it is no longer clear of either.
fn clear(height: &[(f64, f64)], before: Option<f64>, after: Option<f64>) -> Option<(f64, f64)> {
    let above = |ground: Option<f64>, at: f64| ground.is_none_or(|ground| at >= ground + CLEAR);
    let from = height.iter().position(|&(_, at)| above(before, at))?;
    // The estimate of the height may have drifted, or the place be another one: the higher of the two grounds counts, where
    // the vehicle was above it at all.
    let ground = match (before, after) {
        (Some(b), Some(a)) => Some(a.max(b)),
        (_, after) => after,
    };
    let to = height.iter().rposition(|&(_, at)| above(ground, at)).or_else(|| height.iter().rposition(|_| true))?;
    (to > from).then(|| (height[from].0, height[to].0))
}

/// The flag at `t`; `None` before the first word.
fn holds(flags: &Flags, t: f64) -> Option<bool> {
    flags.partition_point(|&(time, _)| time <= t).checked_sub(1).map(|index| flags[index].1)
}

fn value(track: &[(f64, f64)], t: f64) -> f64 {
    track.partition_point(|&(time, _)| time <= t).checked_sub(1).map_or(0.0, |index| track[index].1)
}
