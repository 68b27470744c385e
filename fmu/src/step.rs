//! Communication steps, and what is asked of them.

use std::ffi::c_int;

use crate::component::{self, with};
use crate::types::{Boolean, Component, Integer, Real, Status, Text};

/// Takes a communication step.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    component: Component,
    now: Real,
    length: Real,
    _no_way_back: Boolean,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |own| own.instance.step(now, length)) }
}

/// Nothing is done aside that could be ended.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(component: Component) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |_| Err("no step is under way".to_owned())) }
}

/// `fmi2LastSuccessfulTime` and `fmi2Terminated` of `fmi2StatusKind`.
const LAST_TIME: c_int = 2;
const TERMINATED: c_int = 3;

/// The time up to which steps were solved.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(
    component: Component,
    kind: c_int,
    value: *mut Real,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe {
        answered(component, |own| {
            let value = value.as_mut().filter(|_| kind == LAST_TIME)?;
            *value = own.instance.time();
            Some(())
        })
    }
}

/// Whether a unit wants to end the simulation: none does.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    component: Component,
    kind: c_int,
    value: *mut Boolean,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe {
        answered(component, |_| {
            *value.as_mut().filter(|_| kind == TERMINATED)? = 0;
            Some(())
        })
    }
}

/// Answers a question of state; `fmi2Discard` where there is no answer.
///
/// # Safety
/// As [`with`].
unsafe fn answered(
    component: Component,
    work: impl FnOnce(&mut component::Own) -> Option<()>,
) -> Status {
    let mut known = false;
    // SAFETY: as above.
    let status = unsafe {
        with(component, |own| {
            known = work(own).is_some();
            Ok(())
        })
    };
    if status == Status::Ok && !known { Status::Discard } else { status }
}

/// Functions for questions of state that only a unit which works aside could answer.
macro_rules! no_answers {
    ($($name:ident, $value:ty;)*) => {$(
        /// Nothing is done aside of which it could be asked.
        ///
        /// # Safety
        /// As [`fmi2Instantiate`](crate::fmi2Instantiate).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(component: Component, _kind: c_int, _value: $value) -> Status {
            // SAFETY: as of all functions here.
            unsafe { answered(component, |_| None) }
        }
    )*};
}

no_answers! {
    fmi2GetStatus, *mut Status;
    fmi2GetIntegerStatus, *mut Integer;
    fmi2GetStringStatus, *mut Text;
}
