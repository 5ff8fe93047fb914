//! Caller-owned storage, and every check on a pointer.
//!
//! A C caller can hand in anything. NULL, a misaligned pointer, storage that was never initialised and storage of another
//! kind of object are found and answered with a status; a pointer to freed or too little memory cannot be. That it is none
//! is the contract of every function here: a pointer is NULL, misaligned, or leads to as many values of its type as the
//! function says, which nobody else uses (for reading only: changes) during the call.

use core::ffi::c_char;
use core::mem::MaybeUninit;

use crate::config::Refusal;
use crate::status::{FSB_MISALIGNED, FSB_NOT_INITIALISED, FSB_NULL_POINTER, FSB_OK, fsb_status_t};
use crate::version::FSB_VERSION;

/// Opaque storage in C, and the Rust value kept in it.
pub(crate) trait Object {
    /// What is kept: numbers and nothing that must be dropped, so that C may copy and overwrite the storage.
    type Value;
    /// Tells the kinds of objects apart.
    const KIND: u32;
}

/// What stands in the storage. The mark comes first.
#[repr(C)]
pub(crate) struct Marked<V> {
    mark: u32,
    value: V,
}

/// "FSB" and the kind, stirred with the version and the size, which differs between versions in development. One word: it is
/// compared in every call.
const fn mark<O: Object>() -> u32 {
    let version = FSB_VERSION << 12 ^ size_of::<O::Value>() as u32;
    (0x4653_4200 | O::KIND) ^ version.wrapping_mul(0x9e37_79b1)
}

/// Fails to compile where the value does not fit into the storage, or where the storage is more than twice the
/// value's size.
pub(crate) const fn check_storage<O: Object>(size: usize, alignment: usize) {
    assert!(size_of::<O>() == size && align_of::<O>() == alignment, "the constants of fsb.h are those of the storage");
    assert!(mark::<O>() != 0, "that stands for no object");
    assert!(size_of::<Marked<O::Value>>() <= size, "the storage is too small");
    assert!(align_of::<Marked<O::Value>>() <= alignment, "the storage is not aligned enough");
    assert!(2 * size_of::<Marked<O::Value>>() >= size, "the storage is much larger than needed");
}

fn checked<T>(pointer: *const T) -> Result<(), fsb_status_t> {
    if pointer.is_null() {
        Err(FSB_NULL_POINTER)
    } else if !pointer.is_aligned() {
        Err(FSB_MISALIGNED)
    } else {
        Ok(())
    }
}

/// A pointer that may be NULL, but not misaligned.
pub(crate) fn aligned<T>(pointer: *const T) -> Result<(), fsb_status_t> {
    if pointer.is_aligned() { Ok(()) } else { Err(FSB_MISALIGNED) }
}

/// # Safety
/// The contract of this module, for one O.
unsafe fn marked<O: Object>(object: *const O) -> Result<(), fsb_status_t> {
    checked(object)?;
    // SAFETY: not NULL, aligned, and in the caller's storage of O's size. Volatile, because a caller who forgot the
    // initialisation may have left anything in it.
    let found = unsafe { object.cast::<u32>().read_volatile() };
    if found == mark::<O>() { Ok(()) } else { Err(FSB_NOT_INITIALISED) }
}

/// The value in the storage, to be read.
///
/// # Safety
/// The contract of this module, for one O.
pub(crate) unsafe fn read<'a, O: Object<Value: 'a>, R>(
    object: *const O,
    with: impl FnOnce(&'a O::Value) -> R,
) -> Result<R, fsb_status_t> {
    // SAFETY: the same contract.
    unsafe { marked(object) }?;
    // SAFETY: the mark says that `start` put a value of this type here, and nobody changes it during the call.
    Ok(with(unsafe { &(*object.cast::<Marked<O::Value>>()).value }))
}

/// The value in the storage, to be changed.
///
/// # Safety
/// The contract of this module, for one O.
pub(crate) unsafe fn change<O: Object>(
    object: *mut O,
    with: impl FnOnce(&mut O::Value) -> Result<(), fsb_status_t>,
) -> fsb_status_t {
    // SAFETY: the same contract.
    if let Err(status) = unsafe { marked(object.cast_const()) } {
        return status;
    }
    // SAFETY: the mark says that `start` put a value of this type here, and nobody else uses it during the call.
    code(with(unsafe { &mut (*object.cast::<Marked<O::Value>>()).value }))
}

/// Puts a new value into the storage. Where `make` fails the storage is marked as not initialised.
///
/// # Safety
/// The contract of this module, for one O.
pub(crate) unsafe fn start<O: Object>(
    object: *mut O,
    make: impl FnOnce() -> Result<O::Value, Refusal>,
) -> Result<(), Refusal> {
    checked(object.cast_const()).map_err(unnamed)?;
    match make() {
        Ok(value) => {
            // SAFETY: not NULL, in the caller's storage, aligned for the value and large enough (`check_storage`).
            unsafe { object.cast::<Marked<O::Value>>().write(Marked { mark: mark::<O>(), value }) };
            Ok(())
        }
        Err(refusal) => {
            // SAFETY: as above; the mark comes first.
            unsafe { object.cast::<u32>().write(0) };
            Err(refusal)
        }
    }
}

/// A refusal that no parameter of a configuration is the cause of.
pub(crate) const fn unnamed(status: fsb_status_t) -> Refusal {
    (status, core::ptr::null())
}

/// A new value put into the storage, and the place for the mark that makes it an object; until then it is marked as none.
///
/// # Safety
/// The contract of this module, for one O.
pub(crate) unsafe fn place<'a, O: Object>(
    object: *mut O,
    make: impl FnOnce() -> O::Value,
) -> Result<(&'a mut O::Value, Mark<'a>), fsb_status_t> {
    checked(object.cast_const())?;
    let object = object.cast::<Marked<O::Value>>();
    // SAFETY: not NULL, in the caller's storage, aligned for the value and large enough (`check_storage`).
    let marked = unsafe {
        (&raw mut (*object).mark).write(0);
        (&raw mut (*object).value).write(make());
        &mut *object
    };
    Ok((&mut marked.value, Mark { place: &mut marked.mark, mark: mark::<O>() }))
}

/// The mark of an object, and where it belongs.
pub(crate) struct Mark<'a> {
    place: &'a mut u32,
    mark: u32,
}

impl Mark<'_> {
    /// From now on it is an object.
    pub(crate) fn put(self) {
        *self.place = self.mark;
    }
}

/// The caller's value, to be read.
///
/// # Safety
/// The contract of this module, for one T that nobody changes during the call; any bits will do for it.
pub(crate) unsafe fn borrow<'a, T>(from: *const T) -> Result<&'a T, fsb_status_t> {
    checked(from)?;
    // SAFETY: not NULL, aligned, and a value stands there.
    Ok(unsafe { &*from })
}

/// Copies N values from the caller.
///
/// # Safety
/// The contract of this module, for N values of T; T is made of numbers, so that any bits will do.
pub(crate) unsafe fn take<T: Copy, const N: usize>(from: *const T) -> Result<[T; N], fsb_status_t> {
    checked(from)?;
    // SAFETY: not NULL, aligned, and N values stand there.
    Ok(unsafe { from.cast::<[T; N]>().read() })
}

/// Copies N values to the caller: those of `make`, or where it fails N times `invalid`, so that nothing old is
/// left there.
///
/// # Safety The contract of this module, for N values of T.
pub(crate) unsafe fn give<T: Copy, const N: usize>(
    to: *mut T,
    invalid: T,
    make: impl FnOnce() -> Result<[T; N], fsb_status_t>,
) -> fsb_status_t {
    if let Err(status) = checked(to.cast_const()) {
        return status;
    }
    let (values, status) = match make() {
        Ok(values) => (values, FSB_OK),
        Err(status) => ([invalid; N], status),
    };
    // SAFETY: not NULL, aligned, and there is room for N values.
    unsafe { to.cast::<[T; N]>().write(values) };
    status
}

/// Room for `count` values of the caller.
///
/// # Safety
/// The contract of this module, for so many values of T.
pub(crate) unsafe fn room<'a, T: Copy>(to: *mut T, count: usize) -> Result<&'a mut [MaybeUninit<T>], fsb_status_t> {
    checked(to.cast_const())?;
    // SAFETY: not NULL, aligned, and there is room for so many values, which nobody else uses during the call.
    Ok(unsafe { core::slice::from_raw_parts_mut(to.cast(), count) })
}

/// The status of an initialisation. Hands out the name of the parameter at fault, or NULL, where the caller gave a place for it.
///
/// # Safety
/// The contract of this module, for one pointer.
#[inline(never)]
pub(crate) unsafe fn initialised(outcome: Result<(), Refusal>, parameter: *mut *const c_char) -> fsb_status_t {
    let (status, name) = outcome.err().unwrap_or(unnamed(FSB_OK));
    if checked(parameter.cast_const()).is_ok() {
        // SAFETY: not NULL, aligned, and there is room for a pointer.
        unsafe { parameter.write(name) };
    }
    status
}

/// The status of an outcome.
pub(crate) fn code(outcome: Result<(), fsb_status_t>) -> fsb_status_t {
    match outcome {
        Ok(()) => FSB_OK,
        Err(status) => status,
    }
}
