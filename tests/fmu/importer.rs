//! A small importer: it calls the functions of the library as a program in C would.

use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::path::Path;
use std::sync::Mutex;

use whirl_fmu::*;

/// Messages of one instance.
pub(crate) type Said = Mutex<Vec<(Status, String)>>;

/// An instance of a unit that was unpacked.
pub(crate) struct Instance {
    component: Component,
    names: Vec<String>,
    said: Box<Said>,
}

/// What the library calls; it has no arguments beside the message, which ends as `printf` has it.
unsafe extern "C" fn log(
    environment: *mut c_void,
    _: *const c_char,
    status: Status,
    _: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is the list of messages of an instance that lives, the message a text of C.
    unsafe {
        let said = &*environment.cast::<Said>();
        let message = CStr::from_ptr(message).to_string_lossy().replace("%%", "%");
        said.lock().unwrap().push((status, message));
    }
}

/// The value of an attribute of an element.
pub(crate) fn attribute(element: &str, name: &str) -> Option<String> {
    let (_, rest) = element.split_once(&format!(" {name}=\""))?;
    Some(rest.split('"').next()?.to_owned())
}

impl Instance {
    /// An instance of the unit in a folder; what was said where there is none.
    pub(crate) fn new(folder: &Path) -> Result<Instance, Vec<String>> {
        let description = std::fs::read_to_string(folder.join("modelDescription.xml")).unwrap();
        let guid = attribute(&description, "guid").unwrap();
        Instance::of(folder, &guid)
    }

    /// As [`Instance::new`], with a GUID.
    pub(crate) fn of(folder: &Path, guid: &str) -> Result<Instance, Vec<String>> {
        let description = std::fs::read_to_string(folder.join("modelDescription.xml")).unwrap();
        let variables = description.lines().filter(|line| line.contains("<ScalarVariable"));
        let names = variables.map(|line| attribute(line, "name").unwrap()).collect();
        let said: Box<Said> = Box::default();
        type Fixed =
            unsafe extern "C" fn(*mut c_void, *const c_char, Status, *const c_char, *const c_char);
        // SAFETY: called with the five arguments that it has, on the stack and in registers as without the dots.
        let logger = unsafe { std::mem::transmute::<Fixed, Logger>(log) };
        let callbacks = Callbacks {
            logger: Some(logger),
            allocate: std::ptr::null_mut(),
            free: std::ptr::null_mut(),
            step_finished: std::ptr::null_mut(),
            environment: (&raw const *said).cast_mut().cast(),
        };
        let text = |own: &str| CString::new(own).unwrap();
        let location = format!("file://{}/resources", folder.display());
        let (name, guid, location) = (text("one"), text(guid), text(&location));
        // SAFETY: all texts live until the call returns, the list of messages as long as the instance.
        let component = unsafe {
            fmi2Instantiate(name.as_ptr(), 1, guid.as_ptr(), location.as_ptr(), &callbacks, 0, 1)
        };
        if component.is_null() {
            return Err(said.lock().unwrap().drain(..).map(|own| own.1).collect());
        }
        Ok(Instance { component, names, said })
    }

    /// Through setting up and initialization.
    pub(crate) fn started(self) -> Instance {
        self.expect(|own| unsafe { fmi2SetupExperiment(own, 0, 0.0, 0.0, 0, 0.0) });
        self.expect(|own| unsafe { fmi2EnterInitializationMode(own) });
        self.expect(|own| unsafe { fmi2ExitInitializationMode(own) });
        self
    }

    /// A call that is well.
    pub(crate) fn expect(&self, call: impl FnOnce(Component) -> Status) {
        let status = call(self.component);
        assert_eq!(status, Status::Ok, "{:?}", self.said.lock().unwrap());
    }

    /// A call that is answered by an error; why.
    pub(crate) fn refused(&self, call: impl FnOnce(Component) -> Status) -> String {
        self.said.lock().unwrap().clear();
        let status = call(self.component);
        let said = self.said.lock().unwrap();
        assert_eq!(status, Status::Error, "{said:?}");
        assert_eq!(said.len(), 1, "{said:?}");
        said[0].1.clone()
    }

    /// The value reference of a name.
    pub(crate) fn reference(&self, name: &str) -> u32 {
        let place = self.names.iter().position(|own| own == name);
        place.unwrap_or_else(|| panic!("no `{name}` among {:?}", self.names)) as u32
    }

    pub(crate) fn get(&self, name: &str) -> f64 {
        let (reference, mut value) = (self.reference(name), f64::NAN);
        self.expect(|own| unsafe { fmi2GetReal(own, &reference, 1, &mut value) });
        value
    }

    /// The values of all outputs of these names.
    pub(crate) fn all(&self, names: &[String]) -> Vec<f64> {
        names.iter().map(|name| self.get(name)).collect()
    }

    pub(crate) fn set(&self, name: &str, value: f64) {
        let reference = self.reference(name);
        self.expect(|own| unsafe { fmi2SetReal(own, &reference, 1, &value) });
    }

    pub(crate) fn set_rate(&self, name: &str, value: f64) {
        let (reference, order) = (self.reference(name), 1 as c_int);
        self.expect(|own| unsafe {
            fmi2SetRealInputDerivatives(own, &reference, 1, &order, &value)
        });
    }

    pub(crate) fn step(&self, now: f64, length: f64) {
        self.expect(|own| unsafe { fmi2DoStep(own, now, length, 1) });
    }

    /// Its state as bytes.
    pub(crate) fn state(&self) -> Vec<u8> {
        let (mut state, mut size) = (std::ptr::null_mut(), 0);
        self.expect(|own| unsafe { fmi2GetFMUstate(own, &mut state) });
        self.expect(|own| unsafe { fmi2SerializedFMUstateSize(own, state, &mut size) });
        let mut bytes = vec![0; size];
        self.expect(|own| unsafe { fmi2SerializeFMUstate(own, state, bytes.as_mut_ptr(), size) });
        self.expect(|own| unsafe { fmi2FreeFMUstate(own, &mut state) });
        assert!(state.is_null());
        bytes
    }

    /// Goes on from such bytes.
    pub(crate) fn restore(&self, bytes: &[u8]) {
        let mut state = std::ptr::null_mut();
        self.expect(|own| unsafe {
            fmi2DeSerializeFMUstate(own, bytes.as_ptr(), bytes.len(), &mut state)
        });
        self.expect(|own| unsafe { fmi2SetFMUstate(own, state) });
        self.expect(|own| unsafe { fmi2FreeFMUstate(own, &mut state) });
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: it was made by the library, and is used no more.
        unsafe { fmi2FreeInstance(self.component) }
    }
}

// SAFETY: one thread uses an instance at a time; its messages are behind a lock.
unsafe impl Send for Instance {}
