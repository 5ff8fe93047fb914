//! What can be done with an estimator of any shape. Each function passes its caller's pointers on to `object`.

use core::ffi::c_char;

use fsb_core::estimator::Learning;
use fsb_core::{Estimator, EstimatorConfig};

use crate::config::{FSB_LEARNING_CONTACT, FSB_LEARNING_OFF, FSB_LEARNING_ON, Refusal, refusal};
use crate::object::{self, Object, change, give, read, take};
use crate::status::{FSB_OUT_OF_STEP, FSB_UNKNOWN_VALUE, fsb_status_t};
use crate::values::{fsb_counters_t, fsb_diagnostics_t, fsb_parameter_t, fsb_state_sd_t, fsb_state_t};

/// # Safety
/// The rules at the top of fsb.h, here and below.
pub(crate) unsafe fn init<O, C: Copy, const N: usize, const P: usize>(
    estimator: *mut O,
    config: *const C,
    parameter: *mut *const c_char,
    to_core: impl FnOnce(C) -> Result<EstimatorConfig<N, P>, Refusal>,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    let mut name = None;
    // SAFETY: the pointers come from the C caller, whose contract this is.
    let outcome = unsafe {
        object::start(estimator, || {
            let [config] = take(config)?;
            to_core(config).and_then(|config| Estimator::new(&config).map_err(refusal)).map_err(|(status, at)| {
                name = Some(at);
                status
            })
        })
    };
    // SAFETY: as above.
    unsafe { object::name(parameter, name) };
    object::code(outcome)
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn reset<O, const N: usize, const P: usize>(estimator: *mut O) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    unsafe {
        change(estimator, |estimator| {
            estimator.reset();
            Ok(())
        })
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn reset_identifier<O, const N: usize, const P: usize>(estimator: *mut O) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    unsafe {
        change(estimator, |estimator| {
            estimator.reset_identifier();
            Ok(())
        })
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn reinitialise_identifier<O, const N: usize, const P: usize>(estimator: *mut O) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    unsafe {
        change(estimator, |estimator| {
            estimator.reinitialise_identifier();
            Ok(())
        })
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn set_learning<O, const N: usize, const P: usize>(estimator: *mut O, learning: u32) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    unsafe {
        change(estimator, |estimator| {
            estimator.set_learning(match learning {
                FSB_LEARNING_ON => Learning::On,
                FSB_LEARNING_OFF => Learning::Off,
                FSB_LEARNING_CONTACT => Learning::Contact,
                _ => return Err(FSB_UNKNOWN_VALUE),
            });
            Ok(())
        })
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn measure<O, const N: usize, const P: usize>(estimator: *mut O, position: *const f32) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { change(estimator, |estimator| estimator.measure_raw(&take(position)?).map_err(|_| FSB_OUT_OF_STEP)) }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn apply<O, const N: usize, const P: usize>(estimator: *mut O, input: *const f32) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe {
        change(estimator, |estimator| {
            estimator.apply(&take(input)?);
            Ok(())
        })
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn apply_ramp<O, const N: usize, const P: usize>(
    estimator: *mut O,
    from: *const f32,
    to: *const f32,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe {
        change(estimator, |estimator| {
            estimator.apply_ramp(&take(from)?, &take(to)?);
            Ok(())
        })
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn states<O, const N: usize, const P: usize>(
    estimator: *const O,
    states: *mut fsb_state_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    let collect = |estimator: &Estimator<N, P>| {
        let mut all = [fsb_state_t::INVALID; N];
        for (out, (status, state)) in all.iter_mut().zip(estimator.state_status().into_iter().zip(estimator.states())) {
            *out = fsb_state_t::new(status, state);
        }
        all
    };
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { give(states, fsb_state_t::INVALID, || read(estimator, collect)) }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn state_sd<O, const N: usize, const P: usize>(
    estimator: *const O,
    sd: *mut fsb_state_sd_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe {
        give(sd, fsb_state_sd_t::INVALID, || read(estimator, |estimator| estimator.state_sd().map(fsb_state_sd_t::new)))
    }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn parameters<O, const N: usize, const P: usize>(
    estimator: *const O,
    parameters: *mut fsb_parameter_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    let collect = |estimator: &Estimator<N, P>| {
        let mut all = [fsb_parameter_t::INVALID; P];
        let found = estimator.parameter_status().into_iter().zip(estimator.parameters());
        for (out, (status, parameter)) in all.iter_mut().zip(found) {
            *out = fsb_parameter_t::new(status, parameter);
        }
        all
    };
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { give(parameters, fsb_parameter_t::INVALID, || read(estimator, collect)) }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn counters<O, const N: usize, const P: usize>(
    estimator: *const O,
    counters: *mut fsb_counters_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { give(counters, fsb_counters_t::NONE, || read(estimator, |estimator| [estimator.counters().into()])) }
}

/// # Safety
/// As [`init`].
pub(crate) unsafe fn diagnostics<O, const N: usize, const P: usize>(
    estimator: *const O,
    diagnostics: *mut fsb_diagnostics_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe {
        give(diagnostics, fsb_diagnostics_t::INVALID, || {
            read(estimator, |estimator| estimator.diagnostics().map(fsb_diagnostics_t::from))
        })
    }
}
