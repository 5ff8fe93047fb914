//! Figs. 2-7: the core in the loop, as the paper shows it.

use super::figures_compared::{ComparedMoment, figure8, figure9, record_compared};
use super::flight::{Moment, record};
use super::monte_carlo::PilotError;
use super::scenario::{EPSILON_PARAMETER, K, Scenario};
use super::{CorePilot, IdealPilot};
use crate::report::chart::{Chart, Panel, Role, Series};

/// Moments kept of a flight for drawing, at most.
const POINTS: u64 = 20_000;

/// The flights behind the figures, all on the seed of the first run.
#[derive(Clone, Debug)]
pub struct Flights {
    /// The core with noise.
    pub core: Vec<Moment>,
    /// The core without noise.
    pub quiet: Vec<Moment>,
    /// The one that knows k and the state.
    pub ideal: Vec<Moment>,
    /// The paper's form with noise, the derivative-based observer looking on.
    pub compared: Vec<ComparedMoment>,
}

impl Flights {
    /// Flies them.
    ///
    /// # Errors
    /// [`PilotError`] where an estimator refuses the scenario.
    pub fn fly(scenario: &Scenario) -> Result<Self, PilotError> {
        let every = scenario.ticks().div_ceil(POINTS);
        let quiet = Scenario { sigma: 0.0, ..*scenario };
        Ok(Self {
            core: record(scenario, scenario.seed, &mut CorePilot::new(scenario)?, every),
            quiet: record(&quiet, quiet.seed, &mut CorePilot::new(&quiet)?, every),
            ideal: record(scenario, scenario.seed, &mut IdealPilot, every),
            compared: record_compared(scenario, every)?,
        })
    }

    /// The last moment of the core's flight with noise.
    pub fn end(&self) -> Option<&Moment> {
        self.core.last()
    }

    /// Figs. 2-9 with their file names.
    pub fn figures(&self) -> Vec<(&'static str, Chart)> {
        vec![
            ("fig2.svg", self.figure2()),
            ("fig3.svg", self.figure3()),
            ("fig4.svg", self.figure4()),
            ("fig5.svg", self.figure5()),
            ("fig6.svg", self.figure6()),
            ("fig7.svg", self.figure7()),
            ("fig8.svg", figure8(&self.core, &self.compared)),
            ("fig9.svg", figure9(&self.compared)),
        ]
    }

    fn figure2(&self) -> Chart {
        let panel = |axis: usize, label: &str, x_label: &str| {
            let measured = line(&self.core, |m| Some(m.measured[axis]));
            let truth = line(&self.core, |m| Some(m.truth[axis].position));
            let series =
                vec![Series::line("measured", Role::Measured, measured), Series::line("real", Role::Truth, truth)];
            Panel::new(x_label, label, series)
        };
        Chart::new(
            "Fig. 2. Measured positions",
            "What the estimators are given: the positions with white noise, independent on both axes and at every tick.",
            vec![panel(0, "x [m]", ""), panel(1, "y [m]", "t [s]")],
        )
    }

    fn figure3(&self) -> Chart {
        let k = |moments: &[Moment]| line(moments, |m| m.belief.k);
        let paper = self.compared.iter().filter_map(|c| Some((c.moment.t, c.moment.belief.k?)));
        let band = self.core.iter().filter_map(|m| {
            let (k, sd) = m.belief.k.zip(m.belief.k_sd)?;
            Some((m.t, k - 2.0 * sd, k + 2.0 * sd))
        });
        let noisy = vec![
            Series::band("±2 reported sd", Role::Core, band),
            Series::line("paper form", Role::PaperForm, paper),
            Series::line("core", Role::Core, k(&self.core)),
            Series::level("real", Role::Truth, K),
        ];
        let quiet = vec![Series::line("core", Role::Core, k(&self.quiet)), Series::level("real", Role::Truth, K)];
        let range = Some((0.0, self.core.last().map_or(10.0, |m| m.t).max(EPSILON_PARAMETER)));
        let titled = |title: &str, series, x_label: &str, y_range| Panel {
            title: title.to_owned(),
            x_range: range,
            y_range,
            ..Panel::new(x_label, "k [1/kg]", series)
        };
        Chart::new(
            "Fig. 3. Estimated parameter",
            "Without and with measurement noise. No k̂ is handed out before ε = 1 s; the controller uses k0 = 1/kg until then.",
            vec![titled("without noise", quiet, "", Some((1.9, 2.1))), titled("with noise", noisy, "t [s]", None)],
        )
    }

    fn figure4(&self) -> Chart {
        let panel = |axis: usize, label: &str, x_label: &str| {
            let truth = line(&self.core, |m| Some(m.truth[axis].position));
            let estimate = line(&self.core, |m| Some(m.belief.state[axis]?.0));
            let series =
                vec![Series::line("real", Role::Truth, truth), Series::dashed("estimated", Role::Core, estimate)];
            Panel::new(x_label, label, series)
        };
        Chart::new(
            "Fig. 4. Estimated positions",
            "With measurement noise. The observer's output is used from ε = 0.1 s on.",
            vec![panel(0, "x [m]", ""), panel(1, "y [m]", "t [s]")],
        )
    }

    fn figure5(&self) -> Chart {
        let panel = |axis: usize, label: &str, x_label: &str| {
            let truth = line(&self.core, |m| Some(m.truth[axis].velocity));
            let estimate = line(&self.core, |m| Some(m.belief.state[axis]?.1));
            let series =
                vec![Series::line("real", Role::Truth, truth), Series::dashed("estimated", Role::Core, estimate)];
            // The first moments, on k0 and a few samples, would hide the rest.
            let range = extent(&self.core, |m| m.truth[axis].velocity);
            Panel { y_range: range, ..Panel::new(x_label, label, series) }
        };
        Chart::new(
            "Fig. 5. Estimated velocities",
            "With measurement noise. Between 0.1 s and 1 s the observer predicts with k0, which is half the real k; at 1 s it is \
             put where the identified k says it is.",
            vec![panel(0, "x' [m/s]", ""), panel(1, "y' [m/s]", "t [s]")],
        )
    }

    fn figure6(&self) -> Chart {
        let position = |axis: usize, label: &str| {
            let response = line(&self.core, |m| Some(m.truth[axis].position));
            let reference = line(&self.core, |m| Some(m.reference[axis].position));
            let ideal = line(&self.ideal, |m| Some(m.truth[axis].position));
            let series = vec![
                Series::line("reference", Role::Reference, reference),
                Series::line("k and state known", Role::Truth, ideal),
                Series::dashed("core in the loop", Role::Core, response),
            ];
            Panel::new("", label, series)
        };
        let error = |axis: usize, label: &str, x_label: &str| {
            let of = |moments: &[Moment]| line(moments, |m| Some(m.truth[axis].position - m.reference[axis].position));
            let series = vec![
                Series::line("k and state known", Role::Truth, of(&self.ideal)),
                Series::line("core in the loop", Role::Core, of(&self.core)),
            ];
            Panel::new(x_label, label, series)
        };
        Chart {
            columns: 2,
            ..Chart::new(
                "Fig. 6. Response and reference",
                "With measurement noise, against the reference and against the yardstick: the same controller with the real k, \
                 position and velocity. Below, response less reference.",
                vec![
                    position(0, "x [m]"),
                    position(1, "y [m]"),
                    error(0, "x - x_d [m]", "t [s]"),
                    error(1, "y - y_d [m]", "t [s]"),
                ],
            )
        }
    }

    fn figure7(&self) -> Chart {
        let plane = |moments: &[Moment], of: fn(&Moment) -> (f64, f64)| moments.iter().map(of).collect::<Vec<_>>();
        let reference = plane(&self.core, |m| (m.reference[0].position, m.reference[1].position));
        let real = |m: &Moment| (m.truth[0].position, m.truth[1].position);
        let series = vec![
            Series::line("reference", Role::Reference, reference),
            Series::line("k and state known", Role::Truth, plane(&self.ideal, real)),
            Series::dashed("core in the loop", Role::Core, plane(&self.core, real)),
        ];
        let panel = Panel { equal_aspect: true, ..Panel::new("x [m]", "y [m]", series) };
        Chart::new("Fig. 7. Trajectory in the plane", "With measurement noise.", vec![panel])
    }
}

/// (t, value) of every moment that has one.
pub(super) fn line(moments: &[Moment], value: impl Fn(&Moment) -> Option<f64>) -> Vec<(f64, f64)> {
    moments.iter().filter_map(|moment| Some((moment.t, value(moment)?))).collect()
}

/// The range of a value over a flight and a tenth more; `None` where it does not change.
fn extent(moments: &[Moment], value: impl Fn(&Moment) -> f64) -> Option<(f64, f64)> {
    let (low, high) =
        moments.iter().map(value).fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    let margin = 0.1 * (high - low);
    (margin > 0.0 && margin.is_finite()).then_some((low - margin, high + margin))
}
