//! The shared library of units for co-simulation: the functions of FMI 2.0.4 for C, around cases that `whirl export` wrote.
//!
//! All variables are real. Calls that are out of place are answered by `fmi2Error`, with the reason for the logger.

#![allow(non_snake_case, reason = "the names are those of the standard")]

mod component;
mod inputs;
mod instance;
mod place;
mod running;
mod types;

use std::ffi::{CStr, c_int};
use std::slice;

pub use types::{
    Boolean, Callbacks, Component, Environment, Integer, Logger, Real, Reference, State, Status,
    Text,
};

use component::{Messages, with};
use instance::Instance;

/// Of pointers and counts that an importer hands over.
const NULL: &str = "a pointer is null";

/// The types of this platform.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> Text {
    c"default".as_ptr()
}

/// The version of the standard.
#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> Text {
    c"2.0".as_ptr()
}

/// Makes an instance; null where that fails, which the logger is told.
///
/// # Safety
/// As the standard says of its arguments; all functions below, too.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    name: Text,
    kind: c_int,
    guid: Text,
    location: Text,
    callbacks: *const Callbacks,
    _visible: Boolean,
    logging: Boolean,
) -> Component {
    // SAFETY: texts are null or end in a zero, the callbacks are null or there.
    let (name, guid, location, callbacks) = unsafe {
        let name = if name.is_null() { c"" } else { CStr::from_ptr(name) };
        (name, component::text(guid), component::text(location), callbacks.as_ref())
    };
    let messages = Messages::new(name, callbacks, logging != 0);
    component::new(messages, || {
        if kind != 1 {
            return Err("this unit is one for co-simulation, not for model exchange".to_owned());
        }
        let guid = guid.ok_or("there is no GUID")?;
        let folder = location.and_then(place::folder);
        let folder = folder.ok_or("the location of the resources is no file URI")?;
        Instance::new(&folder, guid)
    })
}

/// Frees an instance.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(component: Component) {
    // SAFETY: the importer uses it no more.
    unsafe { component::free(component) }
}

/// Whether warnings are told.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    component: Component,
    on: Boolean,
    _count: usize,
    _categories: *const Text,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe {
        with(component, |own| {
            own.messages.all = on != 0;
            Ok(())
        })
    }
}

/// Says when the experiment starts; its end and tolerance have no effect.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    component: Component,
    _tolerance_defined: Boolean,
    _tolerance: Real,
    start: Real,
    _stop_defined: Boolean,
    _stop: Real,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe {
        with(component, |own| {
            own.instance.set_up(start);
            Ok(())
        })
    }
}

/// Begins the initialization.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(component: Component) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |own| own.instance.initialize()) }
}

/// Ends the initialization.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(component: Component) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |own| own.instance.initialized()) }
}

/// Ends the simulation.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(component: Component) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |own| own.instance.terminate()) }
}

/// Makes an instance as it was when it was new.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(component: Component) -> Status {
    // SAFETY: as of all functions here.
    unsafe { with(component, |own| own.instance.reset()) }
}

/// A slice that an importer hands over.
///
/// # Safety
/// `first` is null, or the first of `count` values that are there while the slice is used.
unsafe fn slice_of<'s, T>(first: *const T, count: usize) -> Result<&'s [T], String> {
    match (count, first.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err(NULL.to_owned()),
        // SAFETY: as above.
        _ => Ok(unsafe { slice::from_raw_parts(first, count) }),
    }
}

/// As [`slice_of`], to be written.
///
/// # Safety
/// As there; nothing else reads or writes them meanwhile.
unsafe fn slice_for<'s, T>(first: *mut T, count: usize) -> Result<&'s mut [T], String> {
    match (count, first.is_null()) {
        (0, _) => Ok(&mut []),
        (_, true) => Err(NULL.to_owned()),
        // SAFETY: as above.
        _ => Ok(unsafe { slice::from_raw_parts_mut(first, count) }),
    }
}

/// Values of variables.
///
/// # Safety
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
            let mut pairs = references.iter().zip(values);
            pairs.try_for_each(|(&reference, &value)| own.instance.set(reference, value))
        })
    }
}

/// Sets first derivatives of inputs over the next communication step.
///
/// # Safety
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
        /// As [`fmi2Instantiate`].
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

/// Takes a communication step.
///
/// # Safety
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
        /// As [`fmi2Instantiate`].
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

/// A state of a unit: bytes, from which an instance of any process can go on.
type Bytes = Vec<u8>;

/// Takes a copy of the state, into what `state` points at, if that is one already.
///
/// # Safety
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
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
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    component: Component,
    bytes: *const u8,
    size: usize,
    state: *mut State,
) -> Status {
    // SAFETY: as of all functions here; there are `size` bytes, and what `state` points at is null or a state.
    unsafe {
        with(component, |_| {
            let bytes = slice_of(bytes, size)?.to_vec();
            put(state.as_mut().ok_or(NULL)?, bytes);
            Ok(())
        })
    }
}
