//! Figs. 8 and 9: the FSB observer against the derivative-based one (ADB).

use super::ComparedPilot;
use super::figures::line;
use super::flight::{Moment, fly};
use super::monte_carlo::PilotError;
use super::scenario::Scenario;
use crate::paper_form::AdbEstimator;
use crate::report::chart::{Chart, Panel, Role, Series};

/// A moment of the paper's loop with what both observers hold.
#[derive(Clone, Copy, Debug)]
pub struct ComparedMoment {
    /// The moment; its belief is the paper's form.
    pub moment: Moment,
    /// x1, x2 of (53)-(54), x and y.
    pub fsb: [[f64; 2]; 2],
    /// x1, x2 of (66), x and y.
    pub adb: [[f64; 2]; 2],
    /// Position [m] and velocity [m/s] by (67), x and y.
    pub adb_state: [Option<(f64, f64)>; 2],
    /// The same, had it known the real k from the start.
    pub adb_state_real_k: [Option<(f64, f64)>; 2],
}

/// The paper's loop on the scenario's seed, every `every`-th moment.
pub(super) fn record_compared(scenario: &Scenario, every: u64) -> Result<Vec<ComparedMoment>, PilotError> {
    let mut pilot = ComparedPilot::new(scenario)?;
    let (last, every) = (scenario.ticks(), every.max(1));
    let mut moments = Vec::new();
    fly(scenario, scenario.seed, &mut pilot, |moment, pilot| {
        if moment.tick % every == 0 || moment.tick == last {
            moments.push(ComparedMoment {
                moment: *moment,
                fsb: [0, 1].map(|axis| pilot.paper.observer_states(axis).unwrap_or_default()),
                adb: [0, 1].map(|axis| pilot.adb[axis].states()),
                adb_state: states(&pilot.adb),
                adb_state_real_k: states(&pilot.adb_real_k),
            });
        }
    });
    Ok(moments)
}

/// Position and velocity of both axes by (67).
fn states(adb: &[AdbEstimator; 2]) -> [Option<(f64, f64)>; 2] {
    [0, 1].map(|axis| adb[axis].position().zip(adb[axis].velocity()))
}

impl ComparedMoment {
    /// Position and velocity errors of one of the derivative-based observers.
    fn error(&self, axis: usize, state: [Option<(f64, f64)>; 2]) -> Option<(f64, f64)> {
        let (truth, (position, velocity)) = (self.moment.truth[axis], state[axis]?);
        Some((position - truth.position, velocity - truth.velocity))
    }
}

/// Fig. 8.
pub(super) fn figure8(core: &[Moment], compared: &[ComparedMoment]) -> Chart {
    let panel = |axis: usize, rate: bool, label: &str, x_label: &str| {
        let pick = move |(position, velocity): (f64, f64)| if rate { velocity } else { position };
        let of = |error: &dyn Fn(&ComparedMoment) -> Option<(f64, f64)>| -> Vec<(f64, f64)> {
            compared.iter().filter_map(|c| Some((c.moment.t, pick(error(c)?)))).collect()
        };
        let series = vec![
            Series::line("ADB", Role::Rival, of(&|c| c.error(axis, c.adb_state))),
            Series::dashed("ADB, real k from the start", Role::Rival, of(&|c| c.error(axis, c.adb_state_real_k))),
            Series::line("FSB, paper form", Role::PaperForm, of(&|c| c.moment.state_error(axis))),
            Series::line("FSB, core", Role::Core, line(core, |m| Some(pick(m.state_error(axis)?)))),
        ];
        // The first second, on k0, is tens of times larger than what follows.
        Panel { y_range: Some(if rate { (-1.0, 1.0) } else { (-0.4, 0.4) }), ..Panel::new(x_label, label, series) }
    };
    Chart {
        columns: 2,
        ..Chart::new(
            "Fig. 8. Estimation errors of the FSB and the ADB observer",
            "With measurement noise; each observer uses k0 until 1 s and the identified k from then on. The ADB observer looks on \
             in the loop that the paper's form flies; the core flies its own on the same noise. What k0 left behind fades with \
             λ in the paper's observer, with 1/t² in the ADB one, and is removed at once in the core. With the real k from the \
             start the ADB observer does as well as the others. The vertical range cuts off the first second.",
            vec![
                panel(0, false, "x error [m]", ""),
                panel(1, false, "y error [m]", ""),
                panel(0, true, "x' error [m/s]", "t [s]"),
                panel(1, true, "y' error [m/s]", "t [s]"),
            ],
        )
    }
}

/// Fig. 9.
pub(super) fn figure9(compared: &[ComparedMoment]) -> Chart {
    let panel = |of: fn(&ComparedMoment) -> [[f64; 2]; 2],
                 state: usize,
                 role: Role,
                 title: &str,
                 label: &str,
                 x_label: &str| {
        let series = ["x axis", "y axis"].iter().enumerate().map(|(axis, name)| {
            let points = compared.iter().map(|c| (c.moment.t, of(c)[axis][state]));
            if axis == 0 { Series::line(name, role, points) } else { Series::dashed(name, role, points) }
        });
        Panel { title: title.to_owned(), ..Panel::new(x_label, label, series.collect()) }
    };
    Chart {
        columns: 2,
        ..Chart::new(
            "Fig. 9. State variables of the FSB and the ADB observer",
            "The states of (53)-(54) stay bounded; those of (66) grow without bound, as the square of the time on a bounded \
             position and faster under force.",
            vec![
                panel(|c| c.fsb, 0, Role::PaperForm, "FSB", "x1 [m]", ""),
                panel(|c| c.adb, 0, Role::Rival, "ADB", "x1 [m s]", ""),
                panel(|c| c.fsb, 1, Role::PaperForm, "", "x2 [m/s]", "t [s]"),
                panel(|c| c.adb, 1, Role::Rival, "", "x2 [m s²]", "t [s]"),
            ],
        )
    }
}
