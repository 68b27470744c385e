//! Values of variables.

use crate::component::with;
use crate::slices::{slice_for, slice_of};
use crate::types::{Boolean, Component, Integer, Real, Reference, Status, Text};

/// Values of variables.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    component: Component,
    references: *const Reference,
    count: usize,
    values: *mut Real,
) -> Status {
    // SAFETY: as of all functions here; there are `count` of both.
    unsafe {
        with(component, |own| {
            let (references, values) = (slice_of(references, count)?, slice_for(values, count)?);
            for (value, &reference) in values.iter_mut().zip(references) {
                *value = own.instance.get(reference)?;
            }
            Ok(())
        })
    }
}

/// Sets values of inputs and parameters.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    component: Component,
    references: *const Reference,
    count: usize,
    values: *const Real,
) -> Status {
    // SAFETY: as of all functions here; there are `count` of both.
    unsafe {
        with(component, |own| {
            let (references, values) = (slice_of(references, count)?, slice_of(values, count)?);
            own.instance.set(references, values)
        })
    }
}

/// Sets first derivatives of inputs over the next communication step.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    component: Component,
    references: *const Reference,
    count: usize,
    orders: *const Integer,
    values: *const Real,
) -> Status {
    // SAFETY: as of all functions here; there are `count` of all.
    unsafe {
        with(component, |own| {
            let (references, values) = (slice_of(references, count)?, slice_of(values, count)?);
            if slice_of(orders, count)?.iter().any(|order| *order != 1) {
                return Err("inputs have first derivatives, and no higher ones".to_owned());
            }
            let mut pairs = references.iter().zip(values);
            pairs.try_for_each(|(&reference, &value)| own.instance.set_rate(reference, value))
        })
    }
}

/// There are none.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    component: Component,
    _references: *const Reference,
    _count: usize,
    _orders: *const Integer,
    _values: *mut Real,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |_| Err("outputs have no derivatives".to_owned())) }
}

/// There are none.
///
/// # Safety
/// As [`fmi2Instantiate`](crate::fmi2Instantiate).
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    component: Component,
    _unknown: *const Reference,
    _unknowns: usize,
    _known: *const Reference,
    _knowns: usize,
    _seed: *const Real,
    _values: *mut Real,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |_| Err("there are no directional derivatives".to_owned())) }
}

/// Functions for kinds of variables that units have none of: well where none is asked for.
macro_rules! no_variables {
    ($($name:ident, $value:ty, $kind:literal;)*) => {$(
        /// There are no variables of this kind.
        ///
        /// # Safety
        /// As [`fmi2Instantiate`](crate::fmi2Instantiate).
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(
            component: Component,
            _references: *const Reference,
            count: usize,
            _values: $value,
        ) -> Status {
            let none = concat!("all variables are real, and none is ", $kind);
            // SAFETY: as of all functions here.
            unsafe {
                with(component, |_| if count == 0 { Ok(()) } else { Err(none.to_owned()) })
            }
        }
    )*};
}

no_variables! {
    fmi2GetInteger, *mut Integer, "an integer";
    fmi2GetBoolean, *mut Boolean, "a boolean";
    fmi2GetString, *mut Text, "a string";
    fmi2SetInteger, *const Integer, "an integer";
    fmi2SetBoolean, *const Boolean, "a boolean";
    fmi2SetString, *const Text, "a string";
}
