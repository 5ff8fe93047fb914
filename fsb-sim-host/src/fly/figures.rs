//! The figures of a flight, and of many.

use super::many::Flights;
use super::record::{Errors, Flight, NAMES, Sample, truths};
use crate::hexarotor::vector::norm;
use crate::report::chart::{Chart, Panel, Role, Series};

const SYMBOLS: [&str; 4] = ["m [kg]", "I_x [kg m²]", "I_y [kg m²]", "I_z [kg m²]"];

/// All figures, in order.
pub fn figures(flights: &Flights) -> Vec<Chart> {
    let flight = &flights.first;
    let mut figures =
        vec![parameters(flight), errors(flight), tracking(flight), path(flight), velocities(flight), rates(flight)];
    figures.push(thrusts(flight));
    if flights.runs.len() > 1 {
        figures.push(distribution(flights));
    }
    figures
}

fn line(samples: &[Sample], value: impl Fn(&Sample) -> Option<f64>) -> Vec<(f64, f64)> {
    samples.iter().map(|sample| (sample.moment.t, value(sample).unwrap_or(f64::NAN))).collect()
}

/// Time below the last row of a grid only.
fn t_label(index: usize, panels: usize, columns: usize) -> &'static str {
    if index + columns >= panels { "t [s]" } else { "" }
}

fn parameters(flight: &Flight) -> Chart {
    let samples = &flight.samples;
    let panels = (0..4).map(|i| {
        let estimate = |s: &Sample| s.belief.parameters[i].map(|p| f64::from(p.value));
        let band = samples.iter().filter_map(|s| {
            let p = s.belief.parameters[i]?;
            let (value, reach) = (f64::from(p.value), 2.0 * f64::from(p.sd()));
            Some((s.moment.t, value - reach, value + reach))
        });
        let truth = line(samples, |s| Some(truths(&s.moment)[i]));
        // The wide band of the first moments would hide the rest.
        let (low, high) = truth.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), p| (l.min(p.1), h.max(p.1)));
        let series = vec![
            Series::band("± 2 sd", Role::Core, band),
            Series::line("true", Role::Truth, truth),
            Series::line("estimated", Role::Core, line(samples, estimate)),
        ];
        let panel = Panel::new(t_label(i, 4, 2), SYMBOLS[i], series);
        Panel { y_range: Some((0.85 * low, 1.15 * high)), ..panel }
    });
    let caption = "Estimated mass and moments of inertia with two reported standard deviations. A gap: not valid yet.";
    Chart { columns: 2, ..Chart::new("Parameters", caption, panels.collect()) }
}

fn errors(flight: &Flight) -> Chart {
    let of = |errors: &[Errors], i: usize| -> Vec<(f64, f64)> {
        errors.iter().map(|e| (e.t, e.all()[i].map_or(f64::NAN, f64::abs))).collect()
    };
    let panel = |title: &str, errors: &[Errors], which: std::ops::Range<usize>| {
        let series = which.map(|i| Series::line(NAMES[i], Role::Nth(i), of(errors, i))).collect();
        Panel {
            title: title.to_owned(),
            log_y: true,
            y_range: Some((1e-4, 100.0)),
            ..Panel::new("t [s]", "error [%]", series)
        }
    };
    let mut panels = vec![panel("body angles, gyroscopic term", &flight.errors, 0..4)];
    if let Some(errors) = &flight.small_angle {
        panels.push(panel("the paper's small angles, same flight", errors, 1..4));
    }
    let caption = "Magnitude of the errors in percent of the truth at the time.";
    Chart { columns: 2, ..Chart::new("Errors of the parameters", caption, panels) }
}

fn tracking(flight: &Flight) -> Chart {
    let samples = &flight.samples;
    let panel = |x: &str, y: &str, ours: fn(&Sample) -> f64, index: usize| {
        let theirs = line(samples, |s| Some(1e3 * s.yardstick[index]));
        let series = vec![
            Series::line("on the estimates", Role::Core, line(samples, |s| Some(1e3 * ours(s)))),
            Series::line("yardstick", Role::Truth, theirs),
        ];
        Panel { log_y: true, ..Panel::new(x, y, series) }
    };
    let panels = vec![
        panel("", "distance [mm]", |s| norm(s.moment.position_error()), 0),
        panel("t [s]", "angle [mrad]", |s| norm(s.moment.attitude_error()), 1),
    ];
    let caption = "Distance and angle from the reference: flown on the estimates, and by the same law on the true parameters \
                   and the true state.";
    Chart::new("Tracking", caption, panels)
}

fn path(flight: &Flight) -> Chart {
    let samples = &flight.samples;
    let mut panels = Vec::with_capacity(6);
    for (i, (position, angle)) in
        [("x [m]", "roll [rad]"), ("y [m]", "pitch [rad]"), ("z [m]", "yaw [rad]")].into_iter().enumerate()
    {
        let wanted = line(samples, |s| Some(s.moment.wanted.position.value[i]));
        let flown = line(samples, |s| Some(s.moment.truth.position[i]));
        let euler = line(samples, |s| Some(s.moment.wanted.euler.value[i]));
        let turned = line(samples, |s| Some(s.moment.truth.attitude.euler()[i]));
        for (label, wanted, flown) in [(position, wanted, flown), (angle, euler, turned)] {
            let series =
                vec![Series::line("flown", Role::Core, flown), Series::dashed("reference", Role::Truth, wanted)];
            panels.push(Panel::new(t_label(2 * i, 6, 2), label, series));
        }
    }
    Chart { columns: 2, ..Chart::new("Position and attitude", "What is wanted and what is flown.", panels) }
}

fn velocities(flight: &Flight) -> Chart {
    let truth: fn(&Sample, usize) -> f64 = |s, i| s.moment.truth.velocity[i];
    let estimate: fn(&Sample, usize) -> Option<f64> = |s, i| s.belief.velocity.map(|v| f64::from(v[i]));
    three(flight, "Velocities", ["x' [m/s]", "y' [m/s]", "z' [m/s]"], "error [mm/s]", truth, estimate)
}

fn rates(flight: &Flight) -> Chart {
    let truth: fn(&Sample, usize) -> f64 = |s, i| s.moment.truth.body_rates[i];
    let estimate: fn(&Sample, usize) -> Option<f64> = |s, i| s.belief.rates.map(|v| f64::from(v[i]));
    three(flight, "Body rates", ["ω_x [rad/s]", "ω_y [rad/s]", "ω_z [rad/s]"], "error [mrad/s]", truth, estimate)
}

fn three(
    flight: &Flight,
    title: &str,
    labels: [&str; 3],
    error: &str,
    truth: fn(&Sample, usize) -> f64,
    estimate: fn(&Sample, usize) -> Option<f64>,
) -> Chart {
    let samples = &flight.samples;
    let mut panels = Vec::with_capacity(6);
    for (i, label) in labels.into_iter().enumerate() {
        let series = vec![
            Series::line("estimated", Role::Core, line(samples, |s| estimate(s, i))),
            Series::line("true", Role::Truth, line(samples, |s| Some(truth(s, i)))),
        ];
        panels.push(Panel::new(t_label(2 * i, 6, 2), label, series));
        let off = line(samples, |s| Some(1e3 * (estimate(s, i)? - truth(s, i))));
        panels.push(Panel::new(t_label(2 * i, 6, 2), error, vec![Series::line("", Role::Core, off)]));
    }
    let caption = "Estimated from positions alone and true, and the difference on a scale of its own.";
    Chart { columns: 2, ..Chart::new(title, caption, panels) }
}

fn thrusts(flight: &Flight) -> Chart {
    let series = (0..6)
        .map(|i| {
            let thrust = line(&flight.samples, |s| Some(s.moment.thrusts[i]));
            Series::line(&format!("rotor {}", i + 1), Role::Nth(i), thrust)
        })
        .collect();
    Chart::new(
        "Thrusts",
        "Commanded thrust of each rotor, within its limits.",
        vec![Panel::new("t [s]", "[N]", series)],
    )
}

fn distribution(flights: &Flights) -> Chart {
    let sorted = |values: Vec<f64>| {
        let mut values: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).map(f64::abs).collect();
        values.sort_by(f64::total_cmp);
        let count = values.len() as f64;
        values.into_iter().enumerate().map(move |(i, value)| (100.0 * (i as f64 + 0.5) / count, value))
    };
    let errors = (0..4).map(|i| {
        let values = flights.runs.iter().filter_map(|run| run.error(i)).collect();
        Series::line(NAMES[i], Role::Nth(i), sorted(values))
    });
    let runs = |value: fn(&super::many::RunEnd) -> f64| sorted(flights.runs.iter().map(value).collect());
    let tracking = vec![
        Series::line("distance [mm]", Role::Nth(0), runs(|run| 1e3 * run.tracking[0])),
        Series::line("angle [mrad]", Role::Nth(1), runs(|run| 1e3 * run.tracking[1])),
        Series::line("velocity error [mm/s]", Role::Nth(2), runs(|run| 1e3 * run.velocity)),
    ];
    let panel = |title: &str, y: &str, series| Panel {
        title: title.to_owned(),
        log_y: true,
        x_range: Some((0.0, 100.0)),
        ..Panel::new("flights [%]", y, series)
    };
    let panels =
        vec![panel("parameters at the end", "error [%]", errors.collect()), panel("rms from 6 s on", "", tracking)];
    let caption = format!("{} flights: so many of a hundred are at or below the line.", flights.runs.len());
    Chart { columns: 2, ..Chart::new("Distribution over the flights", &caption, panels) }
}
