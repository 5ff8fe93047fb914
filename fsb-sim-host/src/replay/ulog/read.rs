//! A ULog file as a flight.

use super::frames::{to_attitude, to_body, to_world};
use super::phases::{Airborne, Flags, Signs, flight};
use super::resets::resets;
use super::store::{Store, Topic};
use super::topics::{
    ALLOCATOR, ARMED, ATTITUDE, Chosen, HOVER, LAND, POSITION, WANTED, choose, need, need_field, thrust,
};
use crate::replay::flight::quaternion::Quaternion;
use crate::replay::flight::{AttitudeTrack, Flight, FlightError, HeldInput, HoverThrust, ThrustUnit};
use std::path::Path;

/// PX4 calls a thrust set-point beyond this saturated.
const FULL: f64 = 0.99;

/// Reads the part of a log that flies. `full_thrust` \[N\] is the thrust at a set-point of one: with it the input is in
/// newtons, without it a share of the full thrust.
///
/// # Errors
/// [`FlightError`]: a file that cannot be read, a topic that is not there (with what there is), or no flight in it.
pub fn read(path: &Path, full_thrust: Option<f64>) -> Result<Flight, FlightError> {
    let file = path.display().to_string();
    let store = Store::read(path, &WANTED)?;
    let position = need(&store, &file, "position", POSITION)?;
    let attitude = need(&store, &file, "attitude", ATTITUDE)?;
    let (input, forces) = thrust(&store, &file)?;
    let clock = Clock { start: store.start };

    let mut found = Flight { usable: [true; 3], ..Flight::default() };
    let down = need_field(&position, &file, "height", "z")?;
    let heights: Vec<(f64, f64)> =
        clock.sampled(position.topic).into_iter().zip(down).map(|(t, z)| (t, -z)).filter(|p| p.1.is_finite()).collect();
    let times = clock.published(input.topic);
    let size = |f: &[f64; 3]| f.iter().map(|x| x * x).sum::<f64>().sqrt();
    let sizes: Vec<(f64, f64)> =
        times.iter().copied().zip(forces.iter().map(size)).filter(|p| p.1.is_finite()).collect();
    let landed = clock.flags(&store, LAND, "landed");
    let armed = clock.flags(&store, ARMED, "armed");
    let signs = Signs { height: &heights, thrust: &sizes, landed: landed.as_ref(), armed: armed.as_ref() };
    let damaged = store.incomplete.as_ref().map(|why| format!("the file is damaged, what comes before is used: {why}"));
    let Airborne { from, to, others } = flight(&signs).map_err(|why| {
        let why = damaged.iter().fold(why, |why, damaged| format!("{why}; {damaged}"));
        FlightError::NoFlight { file: file.clone(), why }
    })?;

    let scale = full_thrust.unwrap_or(1.0);
    found.unit = if full_thrust.is_some() { ThrustUnit::Newton } else { ThrustUnit::Normalised };
    found.input = HeldInput::default();
    for (&t, force) in times.iter().zip(&forces) {
        if force.iter().all(|f| f.is_finite()) && found.input.times.last().is_none_or(|&last| t > last) {
            found.input.times.push(t);
            found.input.force.push(to_body(*force).map(|f| scale * f));
        }
    }
    found.attitude = read_attitude(&clock, &attitude, &file)?;
    found.hover = read_hover(&clock, &store);
    let chosen = [&position, &attitude, &input];
    found.notices.extend(chosen.iter().map(|chosen| clock.used(chosen)));
    let (length, in_log) = (to - from, clock.sampled(position.topic).last().copied().unwrap_or(to));
    found.notices.push(format!("flight from {from:.2} s to {to:.2} s ({length:.1} s) of {in_log:.1} s of log"));
    if others > 0 {
        found.notices.push(format!("{others} shorter flights in this log are not used"));
    }
    read_positions(&clock, &position, &file, (from, to), &mut found)?;
    found.notices.extend(saturated(&clock, &store, &sizes, (from, to)));
    if !store.dropouts.is_empty() {
        let total: f64 = store.dropouts.iter().sum();
        found.notices.push(format!("the logger lost messages {} times, {total:.2} s in all", store.dropouts.len()));
    }
    found.notices.extend(damaged);
    Ok(found)
}

/// Times in seconds since the beginning of the log.
struct Clock {
    start: f64,
}

impl Clock {
    fn seconds(&self, microseconds: &[f64]) -> Vec<f64> {
        microseconds.iter().map(|t| (t - self.start) * 1e-6).collect()
    }

    /// When what a message says was so.
    fn sampled(&self, topic: &Topic) -> Vec<f64> {
        let sampled = topic.field("timestamp_sample").filter(|times| times.iter().all(|&t| t > 0.0));
        self.seconds(sampled.or_else(|| topic.field("timestamp")).unwrap_or_default())
    }

    /// When a message was sent: a set-point acts from then on.
    fn published(&self, topic: &Topic) -> Vec<f64> {
        self.seconds(topic.field("timestamp").unwrap_or_default())
    }

    fn flags(&self, store: &Store, name: &'static str, field: &str) -> Option<Flags> {
        let topic = choose(store, name)?.topic;
        let values = topic.field(field)?;
        Some(self.published(topic).into_iter().zip(values.iter().map(|&on| on != 0.0)).collect())
    }

    fn used(&self, chosen: &Chosen<'_>) -> String {
        let times = self.published(chosen.topic);
        let span = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
        let rate = if span > 0.0 { (times.len() - 1) as f64 / span } else { 0.0 };
        let of = match chosen.instances {
            1 => String::new(),
            more => format!(", instance {} of {more}", chosen.topic.instance),
        };
        format!("using {} ({rate:.1} Hz{of})", chosen.name)
    }
}

fn read_attitude(clock: &Clock, chosen: &Chosen<'_>, file: &str) -> Result<AttitudeTrack, FlightError> {
    let mut track = AttitudeTrack::default();
    let mut fields = Vec::new();
    for name in ["q[0]", "q[1]", "q[2]", "q[3]"] {
        fields.push(need_field(chosen, file, "attitude", name)?);
    }
    for (n, t) in clock.sampled(chosen.topic).into_iter().enumerate() {
        let numbers: [f64; 4] = std::array::from_fn(|i| fields[i].get(n).copied().unwrap_or(f64::NAN));
        if let Some(px4) = Quaternion::normalised(numbers)
            && track.times.last().is_none_or(|&last| t > last)
        {
            track.times.push(t);
            track.attitude.push(to_attitude(px4));
        }
    }
    Ok(track)
}

fn read_hover(clock: &Clock, store: &Store) -> Vec<HoverThrust> {
    let Some(topic) = choose(store, HOVER).map(|chosen| chosen.topic) else { return Vec::new() };
    let field = |name| topic.field(name).unwrap_or_default();
    let (value, variance, valid) = (field("hover_thrust"), field("hover_thrust_var"), field("valid"));
    let one = |(n, t): (usize, f64)| {
        let value = value.get(n).copied().filter(|v| v.is_finite())?;
        let sd = variance.get(n).map_or(f64::NAN, |v| v.sqrt());
        Some(HoverThrust { t, value, sd, valid: valid.get(n).is_some_and(|&on| on != 0.0) })
    };
    clock.published(topic).into_iter().enumerate().filter_map(one).collect()
}

/// The positions of the flight, resets taken back, and the on-board velocity to compare with.
fn read_positions(
    clock: &Clock,
    chosen: &Chosen<'_>,
    file: &str,
    (from, to): (f64, f64),
    found: &mut Flight,
) -> Result<(), FlightError> {
    let topic = chosen.topic;
    let times = clock.sampled(topic);
    let begin = times.partition_point(|&t| t < from);
    let end = times.partition_point(|&t| t <= to).max(begin);
    let mut field = Vec::new();
    for name in ["x", "y", "z"] {
        field.push(need_field(chosen, file, "position", name)?);
    }
    let valid = |name: &str, n: usize| topic.field(name).and_then(|flags| flags.get(n)).is_none_or(|&on| on != 0.0);
    let horizontal = (begin..end).any(|n| valid("xy_valid", n));
    found.usable = [horizontal, horizontal, true];
    if !horizontal {
        found.notices.push("the horizontal position is never valid: only z is used".into());
    }
    let mut back = [0.0; 3];
    let mut left = resets(topic, begin..end).into_iter().peekable();
    let mut reference = Vec::new();
    for (n, &t) in times.iter().enumerate().take(end).skip(begin) {
        while let Some(reset) = left.next_if(|reset| reset.sample == n) {
            back[reset.axis] += reset.size;
            let axis = ["north", "east", "down"][reset.axis];
            let size = reset.size;
            found.notices.push(format!(
                "the on-board estimator reset the position at t = {t:.2} s, {axis} by {size:.2} m; taken back from there on"
            ));
        }
        let position: [f64; 3] = std::array::from_fn(|i| field[i].get(n).map_or(f64::NAN, |y| y - back[i]));
        let usable = valid("z_valid", n) && (!horizontal || valid("xy_valid", n));
        let filled = if horizontal { position } else { [0.0, 0.0, position[2]] };
        if usable && filled.iter().all(|y| y.is_finite()) && found.times.last().is_none_or(|&last| t > last) {
            found.times.push(t);
            found.position.push(to_world(filled));
            let velocity = ["vx", "vy", "vz"].map(|name| topic.field(name).and_then(|v| v.get(n)).copied());
            let known = velocity.map(|v| v.filter(|v| v.is_finite()).unwrap_or(f64::NAN));
            reference.push(to_world(known).map(|v| v.is_finite().then_some(v)));
        }
    }
    found.reference = Some(reference);
    Ok(())
}

/// A word where the thrust asked for was not to be had.
fn saturated(clock: &Clock, store: &Store, thrust: &[(f64, f64)], (from, to): (f64, f64)) -> Option<String> {
    let inside = |t: f64| t >= from && t <= to;
    let full = thrust.iter().filter(|&&(t, f)| inside(t) && f >= FULL).count();
    let allocator = clock.flags(store, ALLOCATOR, "thrust_setpoint_achieved").unwrap_or_default();
    let missed = allocator.iter().filter(|&&(t, achieved)| inside(t) && !achieved).count();
    (full + missed > 0).then(|| {
        format!(
            "saturated motors: the thrust set-point is at its limit in {full} messages and was not achieved in {missed} more; k is that of \
             the thrust asked for"
        )
    })
}
