//! What a component of C is: an instance with its name and its logger. Nothing unwinds beyond this file.

use std::any::Any;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::instance::Instance;
use crate::types::{Callbacks, Component, Environment, Logger, Status, Text};

/// An instance, and where its messages go.
pub(crate) struct Own {
    pub(crate) instance: Instance,
    pub(crate) messages: Messages,
}

/// Where messages go.
pub(crate) struct Messages {
    logger: Option<Logger>,
    environment: Environment,
    name: CString,
    /// Whether warnings are wanted, too.
    pub(crate) all: bool,
}

impl Messages {
    pub(crate) fn new(name: &CStr, callbacks: Option<&Callbacks>, all: bool) -> Messages {
        let logger = callbacks.and_then(|own| own.logger);
        let environment = callbacks.map_or(std::ptr::null_mut(), |own| own.environment);
        Messages { logger, environment, name: name.to_owned(), all }
    }

    /// Tells a message.
    pub(crate) fn tell(&self, status: Status, message: &str) {
        let category =
            if status == Status::Warning { c"logStatusWarning" } else { c"logStatusError" };
        let Some(logger) = self.logger else { return };
        // The logger reads it as a format.
        let message = message.trim_end().replace('\0', " ").replace('%', "%%");
        let message = CString::new(message).unwrap_or_default();
        // SAFETY: the importer gave this function for this purpose; all texts end in a zero and live until it returns.
        unsafe {
            logger(
                self.environment,
                self.name.as_ptr(),
                status,
                category.as_ptr(),
                message.as_ptr(),
            );
        }
    }
}

/// Does work with a component, tells what it warns of and why it fails.
///
/// # Safety
/// `component` is null, or one that [`new`] made and that was not freed, used by no other thread meanwhile.
pub(crate) unsafe fn with(
    component: Component,
    work: impl FnOnce(&mut Own) -> Result<(), String>,
) -> Status {
    // SAFETY: as above.
    let Some(own) = (unsafe { component.cast::<Own>().as_mut() }) else { return Status::Error };
    let done = catch_unwind(AssertUnwindSafe(|| work(own)));
    let warnings = std::mem::take(&mut own.instance.warnings);
    for warning in warnings.iter().filter(|_| own.messages.all) {
        own.messages.tell(Status::Warning, warning);
    }
    match done {
        Ok(Ok(())) => Status::Ok,
        Ok(Err(reason)) => {
            own.messages.tell(Status::Error, &reason);
            Status::Error
        }
        Err(panic) => {
            let message =
                format!("the library has failed, which is a fault in it: {}", words(&*panic));
            own.messages.tell(Status::Fatal, &message);
            Status::Fatal
        }
    }
}

/// Makes a component as `work` says; null where that fails, which is told.
pub(crate) fn new(
    messages: Messages,
    work: impl FnOnce() -> Result<Instance, String>,
) -> Component {
    let reason = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(instance)) => {
            let mut own = Own { instance, messages };
            let warnings = std::mem::take(&mut own.instance.warnings);
            for warning in warnings.iter().filter(|_| own.messages.all) {
                own.messages.tell(Status::Warning, warning);
            }
            return Box::into_raw(Box::new(own)).cast();
        }
        Ok(Err(reason)) => reason,
        Err(panic) => words(&*panic),
    };
    messages.tell(Status::Error, &reason);
    std::ptr::null_mut()
}

/// Frees a component.
///
/// # Safety
/// As of [`with`]; it is not used any more.
pub(crate) unsafe fn free(component: Component) {
    if !component.is_null() {
        // SAFETY: as above.
        let own = unsafe { Box::from_raw(component.cast::<Own>()) };
        let _ = catch_unwind(AssertUnwindSafe(|| drop(own)));
    }
}

/// A text of C; none where there is none, or it is no UTF-8.
///
/// # Safety
/// `text` is null, or ends in a zero and stays for as long as what is given back is used.
pub(crate) unsafe fn text<'t>(text: Text) -> Option<&'t str> {
    // SAFETY: as above.
    (!text.is_null()).then(|| unsafe { CStr::from_ptr::<'t>(text as *const c_char) })?.to_str().ok()
}

/// What a panic says.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|own| (*own).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no reason".to_owned())
}
