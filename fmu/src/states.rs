//! States of units, which importers keep, and their bytes.

use crate::component::with;
use crate::instance::NO_STATE;
use crate::slices::{NULL, slice_for, slice_of};
use crate::types::{Component, State, Status};

/// A state of a unit: bytes, from which an instance of any process can go on.
type Bytes = Vec<u8>;

/// Takes a copy of the state, into what `state` points at, if that is one already.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(component: Component, state: *mut State) -> Status {
    // SAFETY: as of all functions here; what `state` points at is null or a state.
    unsafe {
        with(component, |own| {
            let state = state.as_mut().ok_or(NULL)?;
            put(state, own.instance.state()?);
            Ok(())
        })
    }
}

/// Puts bytes where a state is wanted.
///
/// # Safety
/// `state` is null or a state.
unsafe fn put(state: &mut State, bytes: Bytes) {
    // SAFETY: as above.
    match unsafe { state.cast::<Bytes>().as_mut() } {
        Some(own) => *own = bytes,
        None => *state = Box::into_raw(Box::new(bytes)).cast(),
    }
}

/// Goes back to a state.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(component: Component, state: State) -> Status {
    // SAFETY: as of all functions here; `state` is null or a state.
    unsafe {
        with(component, |own| {
            let state = state.cast::<Bytes>().as_ref().ok_or(NULL)?;
            own.instance.restore(state)
        })
    }
}

/// Frees a state.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(component: Component, state: *mut State) -> Status {
    // SAFETY: as of all functions here; what `state` points at is null or a state.
    unsafe {
        with(component, |_| {
            if let Some(state) = state.as_mut().filter(|own| !own.is_null()) {
                drop(Box::from_raw(state.cast::<Bytes>()));
                *state = std::ptr::null_mut();
            }
            Ok(())
        })
    }
}

/// How many bytes a state has.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    component: Component,
    state: State,
    size: *mut usize,
) -> Status {
    // SAFETY: as of all functions here; `state` is null or a state.
    unsafe {
        with(component, |_| {
            let size = size.as_mut().ok_or(NULL)?;
            *size = state.cast::<Bytes>().as_ref().ok_or(NULL)?.len();
            Ok(())
        })
    }
}

/// The bytes of a state.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    component: Component,
    state: State,
    bytes: *mut u8,
    size: usize,
) -> Status {
    // SAFETY: as of all functions here; `state` is null or a state, and there is room for `size` bytes.
    unsafe {
        with(component, |_| {
            let state = state.cast::<Bytes>().as_ref().ok_or(NULL)?;
            if size < state.len() {
                return Err(format!(
                    "the state has {} bytes, and there is room for {size}",
                    state.len()
                ));
            }
            slice_for(bytes, state.len())?.copy_from_slice(state);
            Ok(())
        })
    }
}

/// A state from its bytes.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: Component,
    bytes: *const u8,
    size: usize,
    state: *mut State,
) -> Status {
    // SAFETY: as of all functions here; there are `size` bytes, and what `state` points at is null or a state.
    unsafe {
        with(component, |own| {
            let bytes = slice_of(bytes, size)?.to_vec();
            if !own.instance.knows(&bytes) {
                return Err(NO_STATE.to_owned());
            }
            put(state.as_mut().ok_or(NULL)?, bytes);
            Ok(())
        })
    }
}
