//! The observer that knows from the first sample on what the whole flight tells.
//!
//! On the way k, drag and disturbance become known one by one, and until then the velocity is that of a poorer model. How good the
//! model is shows only where it is there from the beginning: the flight once more, through the core's observer, with the
//! values at its end. A missed measurement is replaced by the prediction.

use super::feed::{AxisTrace, Column};
use fsb_core::estimator::AxisState;
use fsb_core::moments::InputMoments;
use fsb_core::observer::{Gains, ObserverDesign};
use fsb_core::regression::{AxisTerms, DragModel, DragObserver, Term};
use fsb_core::window::Window;
use fsb_core::{ConfigError, Tuning};

/// One axis from its first measurement at or after sample `start` on; `drift` is c \[m/s²\].
pub(super) fn observe(
    tuning: Tuning,
    period: f64,
    column: &Column<'_>,
    start: usize,
    (k, terms, drift): (f32, AxisTerms, f64),
) -> Result<AxisTrace, ConfigError> {
    let design = ObserverDesign::new(tuning, period)?;
    let of = |term: Term| term.value().unwrap_or(0.0);
    let model = DragModel::new(k, of(terms.drag), drift as f32 + of(terms.disturbance), &design);
    let samples = column.position.len().min(column.input.len());
    let mut trace = AxisTrace { state: vec![None; samples], innovation: vec![None; samples] };
    let mut observer = DragObserver::default();
    let (mut window, mut gains, mut begun) = (Window::START, Gains::FIRST, false);
    for n in start..samples {
        let measured = column.position[n].map(|y| y as f32);
        if !begun {
            if let Some(y) = measured {
                observer.start(y);
                begun = true;
            }
            continue;
        }
        let held = (column.input[n - 1], column.input[n - 1]);
        let (from, to) = column.ramps.and_then(|ramps| ramps.get(n - 1)).copied().unwrap_or(held);
        let moments = InputMoments { j1: ((from + to) / 2.0) as f32, j2: ((2.0 * from + to) / 6.0) as f32 };
        let m1 = gains.m1();
        design.step(&mut window);
        gains = Gains::at(&window, &design);
        let y = measured.unwrap_or_else(|| observer.predict(moments, &model, m1));
        observer.correct(y, moments, &model, m1, gains.t_l2());
        observer.fold();
        let state = observer.state();
        trace.state[n] = Some(AxisState { position: state.position(0.0, &gains), velocity: state.velocity(&design) });
        trace.innovation[n] = measured.map(|_| state.innovation());
    }
    Ok(trace)
}
