//! Which topics are used: the first that the log has, and of several instances the one with most messages.

use super::store::{Store, Topic};
use crate::replay::flight::FlightError;

/// Where a thrust set-point may stand, best first: topic, its fields along the body's axes (forward, right, down), or the
/// one field that is the thrust itself.
const THRUST: [(&str, Fields); 6] = [
    ("vehicle_thrust_setpoint", Fields::Vector(["xyz[0]", "xyz[1]", "xyz[2]"])),
    ("actuator_controls_0", Fields::Scalar("control[3]")),
    ("vehicle_rates_setpoint", Fields::Vector(["thrust_body[0]", "thrust_body[1]", "thrust_body[2]"])),
    ("vehicle_rates_setpoint", Fields::Scalar("thrust")),
    ("vehicle_attitude_setpoint", Fields::Vector(["thrust_body[0]", "thrust_body[1]", "thrust_body[2]"])),
    ("vehicle_attitude_setpoint", Fields::Scalar("thrust")),
];

pub const POSITION: &str = "vehicle_local_position";
pub const ATTITUDE: &str = "vehicle_attitude";
pub const LAND: &str = "vehicle_land_detected";
pub const ARMED: &str = "actuator_armed";
pub const HOVER: &str = "hover_thrust_estimate";
pub const ALLOCATOR: &str = "control_allocator_status";

/// Every topic that is looked at.
pub const WANTED: [&str; 10] = [
    POSITION,
    ATTITUDE,
    LAND,
    ARMED,
    HOVER,
    ALLOCATOR,
    "vehicle_thrust_setpoint",
    "actuator_controls_0",
    "vehicle_rates_setpoint",
    "vehicle_attitude_setpoint",
];

/// The fields of a thrust set-point.
#[derive(Clone, Copy, Debug)]
enum Fields {
    Vector([&'static str; 3]),
    Scalar(&'static str),
}

/// A topic that was chosen.
pub struct Chosen<'a> {
    pub name: &'static str,
    pub topic: &'a Topic,
    /// Instances of it in the log.
    pub instances: usize,
}

/// The instance of `name` with most messages.
pub fn choose<'a>(store: &'a Store, name: &'static str) -> Option<Chosen<'a>> {
    let all = store.topics.get(name)?;
    let topic = all.iter().max_by_key(|topic| (topic.len(), 255 - topic.instance)).filter(|topic| topic.len() > 0)?;
    Some(Chosen { name, topic, instances: all.len() })
}

/// As [`choose`], with the error that lists what there is.
pub fn need<'a>(
    store: &'a Store,
    file: &str,
    what: &'static str,
    name: &'static str,
) -> Result<Chosen<'a>, FlightError> {
    choose(store, name).ok_or_else(|| FlightError::NoTopic {
        file: file.to_owned(),
        what,
        wanted: name.to_owned(),
        found: store.listing(),
    })
}

/// A field that a chosen topic must have.
pub fn need_field<'a>(
    chosen: &Chosen<'a>,
    file: &str,
    what: &'static str,
    field: &str,
) -> Result<&'a [f64], FlightError> {
    chosen.topic.field(field).ok_or_else(|| FlightError::NoTopic {
        file: file.to_owned(),
        what,
        wanted: format!("{}.{field}", chosen.name),
        found: chosen.topic.fields.keys().cloned().collect::<Vec<_>>().join(", "),
    })
}

/// The thrust set-point in PX4's body frame, forward, right, down, as a share of the full thrust.
pub fn thrust<'a>(store: &'a Store, file: &str) -> Result<(Chosen<'a>, Vec<[f64; 3]>), FlightError> {
    for (name, fields) in THRUST {
        let Some(chosen) = choose(store, name) else { continue };
        let vector = match fields {
            Fields::Vector(names) => match names.map(|field| chosen.topic.field(field)) {
                [Some(x), Some(y), Some(z)] => x.iter().zip(y).zip(z).map(|((&x, &y), &z)| [x, y, z]).collect(),
                _ => continue,
            },
            Fields::Scalar(field) => match chosen.topic.field(field) {
                Some(thrust) => thrust.iter().map(|&f| [0.0, 0.0, -f]).collect(),
                None => continue,
            },
        };
        return Ok((chosen, vector));
    }
    let wanted: Vec<String> = THRUST
        .iter()
        .map(|(name, fields)| match fields {
            Fields::Vector([first, ..]) => format!("{name}.{first}"),
            Fields::Scalar(field) => format!("{name}.{field}"),
        })
        .collect();
    Err(FlightError::NoTopic {
        file: file.to_owned(),
        what: "thrust set-point",
        wanted: wanted.join(", "),
        found: store.listing(),
    })
}
