//! The shared library of units for co-simulation: the functions of FMI 2.0.4 for C, around cases that `whirl export` wrote.
//!
//! All variables are real. Calls that are out of place are answered by `fmi2Error`, with the reason for the logger.

#![allow(non_snake_case, reason = "the names are those of the standard")]

mod component;
mod inputs;
mod instance;
mod place;
mod running;
mod slices;
mod states;
mod step;
mod types;
mod values;

use std::ffi::{CStr, c_int};

pub use types::{
    Boolean, Callbacks, Component, Environment, Integer, Logger, Real, Reference, State, Status,
    Text,
};

pub use states::{
    fmi2DeSerializeFMUstate, fmi2FreeFMUstate, fmi2GetFMUstate, fmi2SerializeFMUstate,
    fmi2SerializedFMUstateSize, fmi2SetFMUstate,
};
pub use step::{
    fmi2CancelStep, fmi2DoStep, fmi2GetBooleanStatus, fmi2GetIntegerStatus, fmi2GetRealStatus,
    fmi2GetStatus, fmi2GetStringStatus,
};
pub use values::{
    fmi2GetBoolean, fmi2GetDirectionalDerivative, fmi2GetInteger, fmi2GetReal,
    fmi2GetRealOutputDerivatives, fmi2GetString, fmi2SetBoolean, fmi2SetInteger, fmi2SetReal,
    fmi2SetRealInputDerivatives, fmi2SetString,
};

use component::{Messages, with};
use instance::Instance;

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

/// Says when the experiment starts and ends; its tolerance has no effect.
///
/// # Safety
/// As [`fmi2Instantiate`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    component: Component,
    _tolerance_defined: Boolean,
    _tolerance: Real,
    start: Real,
    stop_defined: Boolean,
    stop: Real,
) -> Status {
    // SAFETY: as of all functions here.
    unsafe {
        with(component, |own| own.instance.set_up(start, (stop_defined != 0).then_some(stop)))
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
