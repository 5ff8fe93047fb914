//! The vehicle and its path in space.

use super::record::Sample;
use super::scenario::Scenario;
use crate::hexarotor::vector::{Vector, add_scaled, cross, difference, norm, scaled, sum};
use crate::hexarotor::{Hexarotor, Quaternion};
use crate::report::chart::Role;
use crate::report::scene::{Line3, Scene};

/// Sides of the circle that stands for a rotor.
const SIDES: usize = 18;
/// Vehicles drawn, at most.
const VEHICLES: usize = 7;

/// The path wanted, the path flown, and the vehicle at some instants.
pub fn scene(scenario: &Scenario, samples: &[Sample]) -> Scene {
    let wanted: Vec<Vector> = samples.iter().map(|sample| sample.moment.wanted.position.value).collect();
    let flown: Vec<Vector> = samples.iter().map(|sample| sample.moment.truth.position).collect();
    let larger = (0.06 * extent(&flown) / scenario.plant.frame.arm).max(1.0);
    let mut lines = vec![
        Line3 { role: Role::Reference, width: 1.25, points: wanted },
        Line3 { role: Role::Core, width: 1.5, points: flown },
    ];
    // The scenario has been flown: its vehicle can be made.
    if let Ok(vehicle) = Hexarotor::new(&scenario.plant) {
        let axes = vehicle.allocator().frame().axes();
        let arm = larger * scenario.plant.frame.arm;
        for sample in apart(samples, 3.0 * arm) {
            lines.extend(drawn(axes, arm, sample.moment.truth.position, &sample.moment.truth.attitude));
        }
    }
    let size = if larger > 1.01 { format!(", drawn {larger:.1} times as large as it is") } else { String::new() };
    Scene {
        title: "Vehicle and path".to_owned(),
        caption: format!(
            "Grey: the path wanted; blue: the path flown; the vehicle at some instants{size}, its first arm vermilion, each \
             rotor's disc at right angles to its thrust. Drag the large view to turn it."
        ),
        lines,
    }
}

/// Diagonal of the box around `points`.
fn extent(points: &[Vector]) -> f64 {
    let side = |i: usize| {
        let values = points.iter().map(|point| point[i]);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        (high - low).max(0.0)
    };
    norm([side(0), side(1), side(2)])
}

/// The first sample, and the later ones that are far enough from all before, the last among the candidates.
fn apart(samples: &[Sample], distance: f64) -> Vec<&Sample> {
    let mut chosen: Vec<&Sample> = samples.last().into_iter().collect();
    for sample in samples.iter().rev() {
        let far =
            |other: &&Sample| norm(difference(sample.moment.truth.position, other.moment.truth.position)) >= distance;
        if chosen.len() < VEHICLES && chosen.iter().all(far) {
            chosen.push(sample);
        }
    }
    chosen
}

/// Arms and rotors in the world.
fn drawn(axes: &[Vector; 6], arm: f64, at: Vector, attitude: &Quaternion) -> Vec<Line3> {
    let world = |p: Vector| sum(at, attitude.rotate(p));
    let mut lines = Vec::with_capacity(12);
    for (i, axis) in axes.iter().enumerate() {
        let (sin, cos) = (i as f64 * std::f64::consts::FRAC_PI_3).sin_cos();
        let along = [cos, sin, 0.0];
        let tip = scaled(arm, along);
        let role = if i == 0 { Role::PaperForm } else { Role::Truth };
        lines.push(Line3 { role, width: 1.5, points: vec![at, world(tip)] });
        let across = cross(*axis, along);
        let point = |side: usize| {
            let (sin, cos) = (side as f64 * std::f64::consts::TAU / SIDES as f64).sin_cos();
            let offset = add_scaled(scaled(0.42 * arm * cos, along), 0.42 * arm * sin, across);
            world(sum(tip, offset))
        };
        lines.push(Line3 { role, width: 0.75, points: (0..=SIDES).map(point).collect() });
    }
    lines
}
