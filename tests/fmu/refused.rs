//! Calls and cases that are refused, with the reason, and change nothing.

use std::ptr;

use whirl_fmu::*;

use crate::bench::{Bench, PORT, rotor};
use crate::importer::Instance;

#[test]
fn calls_out_of_place_are_errors_with_reasons() {
    let bench = Bench::new(&rotor(PORT));
    let folder = bench.unit(&["--parameter", "joint.b.stiffness.xx"]);
    let wrong = Instance::of(&folder, "0123").err().unwrap();
    assert_eq!(wrong, ["the GUID is that of another unit than the one in this folder"]);
    let unit = Instance::new(&folder).unwrap();
    let [output, port, stiffness] =
        ["X_b_um", "load.port.fx", "joint.b.stiffness.xx"].map(|name| unit.reference(name));
    let (mut value, one) = (0.0, 1.0);
    let said = unit.refused(|own| unsafe { fmi2GetReal(own, &output, 1, &mut value) });
    assert_eq!(said, "`X_b_um` has no value before the initialization");
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, 0.0, 1e-4, 1) });
    assert_eq!(said, "a unit that is Instantiated cannot be advanced");
    let said = unit.refused(|own| unsafe { fmi2SetReal(own, &output, 1, &one) });
    assert_eq!(said, "`X_b_um` is an output");
    let said = unit.refused(|own| unsafe { fmi2SetReal(own, &port, 1, &f64::NAN) });
    assert_eq!(said, "`load.port.fx` cannot be NaN");
    let said = unit.refused(|own| unsafe { fmi2GetReal(own, &99, 1, &mut value) });
    assert_eq!(said, "there is no variable with the value reference 99");
    let said = unit.refused(|own| unsafe { fmi2GetReal(own, ptr::null(), 1, &mut value) });
    assert_eq!(said, "a pointer is null");
    let said = unit.refused(|own| unsafe { fmi2GetInteger(own, &port, 1, ptr::null_mut()) });
    assert_eq!(said, "all variables are real, and none is an integer");
    let said = unit.refused(|own| unsafe { fmi2SetRealInputDerivatives(own, &port, 1, &2, &one) });
    assert_eq!(said, "inputs have first derivatives, and no higher ones");
    // All or none.
    let (both, values) = ([port, 99], [5.0, 1.0]);
    let said = unit.refused(|own| unsafe { fmi2SetReal(own, both.as_ptr(), 2, values.as_ptr()) });
    assert_eq!(said, "there is no variable with the value reference 99");
    unit.expect(|own| unsafe { fmi2GetReal(own, &port, 1, &mut value) });
    assert_eq!(value, 0.0);
    let said = unit.refused(|own| unsafe { fmi2SetupExperiment(own, 0, 0.0, 0.0, 1, -1.0) });
    assert_eq!(said, "the end at -1 s is not after the start at 0 s");
    let mut state = ptr::null_mut();
    let said = unit
        .refused(|own| unsafe { fmi2DeSerializeFMUstate(own, [7; 10].as_ptr(), 10, &mut state) });
    assert_eq!(said, "these bytes are no state of this unit");
    assert!(state.is_null());
    let unit = unit.started();
    let said = unit.refused(|own| unsafe { fmi2SetReal(own, &stiffness, 1, &one) });
    assert_eq!(said, "the parameter `joint.b.stiffness.xx` is fixed once the unit is initialized");
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, 0.0, 2.5e-4, 1) });
    let words = "a communication step of 2.5e-4 s is no whole number of time steps of 1e-4 s: take 2e-4 s or 3e-4 s";
    assert_eq!(said, words);
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, 0.0, 1e300, 1) });
    assert!(said.contains("has more than 1e7 time steps of 1e-4 s: take shorter ones"), "{said}");
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, 0.1, 1e-4, 1) });
    assert_eq!(said, "the unit stands at 0 s, and the step begins at 0.1 s");
    unit.step(0.0, 3e-4);
    let mut time = 0.0;
    unit.expect(|own| unsafe { fmi2GetRealStatus(own, 2, &mut time) });
    assert_eq!(time, 3.0 * 1e-4);
    unit.expect(|own| unsafe { fmi2Terminate(own) });
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, time, 1e-4, 1) });
    assert_eq!(said, "a unit that is Terminated cannot be advanced");
    // No component at all.
    let status = unsafe { fmi2DoStep(ptr::null_mut(), 0.0, 1.0, 1) };
    assert_eq!(status, Status::Error);
    unsafe { fmi2FreeInstance(ptr::null_mut()) };
}

#[test]
fn units_start_when_their_case_does() {
    let bench = Bench::new(&rotor(PORT));
    let unit = Instance::new(&bench.unit(&[])).unwrap();
    unit.expect(|own| unsafe { fmi2SetupExperiment(own, 0, 0.0, 2.0, 0, 0.0) });
    unit.expect(|own| unsafe { fmi2EnterInitializationMode(own) });
    let said = unit.refused(|own| unsafe { fmi2ExitInitializationMode(own) });
    assert_eq!(said, "this unit starts at 0 s, not at 2 s");
}

/// No step goes beyond the end that the importer has told.
#[test]
fn units_end_when_they_are_told() {
    let bench = Bench::new(&rotor(PORT));
    let unit = Instance::new(&bench.unit(&[])).unwrap();
    unit.expect(|own| unsafe { fmi2SetupExperiment(own, 0, 0.0, 0.0, 1, 7e-4) });
    unit.expect(|own| unsafe { fmi2EnterInitializationMode(own) });
    unit.expect(|own| unsafe { fmi2ExitInitializationMode(own) });
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, 0.0, 8e-4, 1) });
    assert_eq!(said, "a communication step of 8e-4 s from 0 s goes beyond the end at 0.0007 s");
    unit.step(0.0, 4e-4);
    unit.step(4e-4, 3e-4);
    let said = unit.refused(|own| unsafe { fmi2DoStep(own, 7e-4, 1e-4, 1) });
    assert!(said.contains("goes beyond the end"), "{said}");
}

/// A value that the case refuses is told with what the case says of it.
#[test]
fn values_that_no_case_takes_are_refused() {
    let bench = Bench::new(&rotor(PORT));
    let unit = Instance::new(&bench.unit(&["--parameter", "body.r.mass"])).unwrap();
    unit.set("body.r.mass", -3.0);
    unit.expect(|own| unsafe { fmi2EnterInitializationMode(own) });
    let said = unit.refused(|own| unsafe { fmi2ExitInitializationMode(own) });
    assert!(said.contains("mass"), "{said}");
    unit.set("body.r.mass", 5.0);
    unit.expect(|own| unsafe { fmi2ExitInitializationMode(own) });
}

#[test]
fn units_that_were_changed_are_none() {
    let bench = Bench::new(&rotor(PORT));
    let folder = bench.unit(&[]);
    let manifest = folder.join("resources/unit.json");
    let whole = std::fs::read_to_string(&manifest).unwrap();
    for (bad, word) in [
        (whole.replace("case/case.toml", "case/other.toml"), "other.toml"),
        (whole.replace("\"program\": \"", "\"program\": \"0"), "another version"),
        (whole[..40].to_owned(), "unit.json"),
    ] {
        std::fs::write(&manifest, bad).unwrap();
        let said = Instance::new(&folder).err().unwrap().join("\n");
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn exports_that_cannot_be_write_nothing() {
    let bench = Bench::new(&rotor(PORT));
    let case = bench.path("case.toml");
    let case = case.to_str().unwrap();
    let refused: [&[&str]; 6] = [
        &["--parameter", "joint.b.stiffness.zz"],
        &["--parameter", "title"],
        &["--parameter", "body.r.mass", "--parameter", "body.r.mass"],
        &["--parameter", "march.steps"],
        &["--parameter", "joint.b"],
        &["--parameter", ""],
    ];
    for more in refused {
        assert!(!bench.exports(case, more), "{more:?}");
        assert!(!bench.path("unit.fmu").exists(), "{more:?}");
    }
    assert!(!bench.exports("no-such-case", &[]));
}

#[test]
fn libraries_of_other_versions_are_refused() {
    let bench = Bench::new(&rotor(PORT));
    let case = bench.path("case.toml");
    bench.file("other", "another library");
    let other = bench.path("other");
    for library in [other.to_str().unwrap(), "/no/such/library"] {
        assert!(!bench.exports(case.to_str().unwrap(), &["--library", library]), "{library}");
    }
    assert!(!bench.path("unit.fmu").exists());
}
