//! What can be done with an estimator of any shape; what it hands out is in `readings`. Each function passes its caller's pointers
//! on to `object`.

use core::ffi::c_char;

use fsb_core::Estimator;
use fsb_core::estimator::Learning;

use crate::config::{Configuration, FSB_LEARNING_CONTACT, FSB_LEARNING_OFF, FSB_LEARNING_ON};
use crate::object::{self, Object, aligned, borrow, change, initialised, unnamed};
use crate::status::{FSB_OUT_OF_STEP, FSB_UNKNOWN_VALUE, fsb_status_t};

/// # Safety
/// The rules at the top of fsb.h, here and below.
pub(crate) unsafe fn init<O, C: Configuration, const N: usize, const P: usize>(
    estimator: *mut O,
    config: *const C,
    parameter: *mut *const c_char,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    let outcome = unsafe {
        object::place(estimator, Estimator::unconfigured)
            .and_then(|placed| aligned(parameter.cast_const()).and_then(|()| Ok((placed, borrow(config)?))))
    };
    let outcome = match outcome {
        Ok(((estimator, mark), config)) => config.unshaped().give_to(estimator.configuring(), mark),
        Err(status) => Err(unnamed(status)),
    };
    // SAFETY: as above.
    unsafe { initialised(outcome, parameter) }
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
    unsafe {
        change(estimator, |estimator| estimator.measure_raw(borrow(position.cast())?).map_err(|_| FSB_OUT_OF_STEP))
    }
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
            estimator.apply(borrow(input.cast())?);
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
            estimator.apply_ramp(borrow(from.cast())?, borrow(to.cast())?);
            Ok(())
        })
    }
}
