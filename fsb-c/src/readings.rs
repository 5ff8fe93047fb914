//! What an estimator of any shape hands out.

use core::mem::MaybeUninit;
use core::slice;

use fsb_core::Estimator;
use fsb_core::estimator::View;

use crate::object::{Object, give, read, room};
use crate::status::{FSB_OK, fsb_status_t};
use crate::values::{fsb_counters_t, fsb_diagnostics_t, fsb_parameter_t, fsb_state_sd_t, fsb_state_t};

/// # Safety
/// The rules at the top of fsb.h.
pub(crate) unsafe fn states<O, const N: usize, const P: usize>(
    estimator: *const O,
    states: *mut fsb_state_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { states_of(read(estimator, Estimator::view), states, N) }
}

/// The states of an estimator, or as many that are invalid.
///
/// # Safety
/// The rules at the top of fsb.h.
#[inline(never)]
unsafe fn states_of(estimator: Result<View<'_>, fsb_status_t>, states: *mut fsb_state_t, count: usize) -> fsb_status_t {
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    let mut room = match unsafe { room(states, count) } {
        Ok(room) => room.iter_mut(),
        Err(status) => return status,
    };
    match estimator {
        Ok(view) => {
            view.states(|status, state| {
                if let Some(place) = room.next() {
                    place.write(fsb_state_t::new(status, state));
                }
            });
            FSB_OK
        }
        Err(status) => {
            fill(room, fsb_state_t::INVALID);
            status
        }
    }
}

/// Writes to the next place. A call of its own keeps the compiler from writing out the loops around it several times.
#[inline(never)]
fn put<T: Copy>(room: &mut slice::IterMut<'_, MaybeUninit<T>>, value: T) {
    if let Some(place) = room.next() {
        place.write(value);
    }
}

fn fill<T: Copy>(mut room: slice::IterMut<'_, MaybeUninit<T>>, value: T) {
    while room.len() > 0 {
        put(&mut room, value);
    }
}

/// # Safety
/// The rules at the top of fsb.h.
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
/// The rules at the top of fsb.h.
pub(crate) unsafe fn parameters<O, const N: usize, const P: usize>(
    estimator: *const O,
    parameters: *mut fsb_parameter_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { parameters_of(read(estimator, Estimator::view), parameters, P) }
}

/// The parameters of an estimator, or as many that are invalid.
///
/// # Safety
/// The rules at the top of fsb.h.
#[inline(never)]
unsafe fn parameters_of(
    estimator: Result<View<'_>, fsb_status_t>,
    parameters: *mut fsb_parameter_t,
    count: usize,
) -> fsb_status_t {
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    let mut room = match unsafe { room(parameters, count) } {
        Ok(room) => room.iter_mut(),
        Err(status) => return status,
    };
    match estimator {
        Ok(view) => {
            view.parameters(|status, parameter| {
                if let Some(place) = room.next() {
                    place.write(fsb_parameter_t::new(status, parameter));
                }
            });
            FSB_OK
        }
        Err(status) => {
            fill(room, fsb_parameter_t::INVALID);
            status
        }
    }
}

/// # Safety
/// The rules at the top of fsb.h.
pub(crate) unsafe fn counters<O, const N: usize, const P: usize>(
    estimator: *const O,
    counters: *mut fsb_counters_t,
) -> fsb_status_t
where
    O: Object<Value = Estimator<N, P>>,
{
    // SAFETY: the pointers come from the C caller, whose contract this is.
    unsafe { counters_of(read(estimator, Estimator::view), counters) }
}

/// The counters of an estimator, or none.
///
/// # Safety
/// The rules at the top of fsb.h.
#[inline(never)]
unsafe fn counters_of(estimator: Result<View<'_>, fsb_status_t>, counters: *mut fsb_counters_t) -> fsb_status_t {
    // SAFETY: the pointer comes from the C caller, whose contract this is.
    unsafe { give(counters, fsb_counters_t::NONE, || Ok([estimator?.counters().into()])) }
}

/// # Safety
/// The rules at the top of fsb.h.
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
