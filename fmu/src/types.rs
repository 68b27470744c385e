//! The types of FMI 2.0.4 for C, as `fmi2TypesPlatform.h` and `fmi2FunctionTypes.h` declare them.

use std::ffi::{c_char, c_double, c_int, c_uint, c_void};

/// `fmi2Component`: an instance.
pub type Component = *mut c_void;
/// `fmi2ComponentEnvironment`: what the logger of an importer is given.
pub type Environment = *mut c_void;
/// `fmi2FMUstate`.
pub type State = *mut c_void;
/// `fmi2ValueReference`.
pub type Reference = c_uint;
/// `fmi2Real`.
pub type Real = c_double;
/// `fmi2Integer`.
pub type Integer = c_int;
/// `fmi2Boolean`: 0 for false.
pub type Boolean = c_int;
/// `fmi2String`: bytes up to a zero.
pub type Text = *const c_char;

/// `fmi2Status`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub enum Status {
    /// All is well.
    Ok,
    /// Something may be wrong, and was told.
    Warning,
    /// Not done; the unit stands as it did.
    Discard,
    /// Not done; why was told.
    Error,
    /// The library itself failed.
    Fatal,
    /// Never given: nothing is done aside.
    Pending,
}

/// `fmi2CallbackLogger`. It reads the message as `printf` does.
pub type Logger = unsafe extern "C" fn(Environment, Text, Status, Text, Text, ...);

/// `fmi2CallbackFunctions`.
#[derive(Debug, Clone, Copy)]
#[repr(C)]
pub struct Callbacks {
    /// Takes messages.
    pub logger: Option<Logger>,
    /// Not used.
    pub allocate: *mut c_void,
    /// Not used.
    pub free: *mut c_void,
    /// Not used.
    pub step_finished: *mut c_void,
    /// What the logger is given.
    pub environment: Environment,
}
