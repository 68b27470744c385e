//! Keys of loads that change nothing: said, and only where they do not.

use crate::workbench::Workbench;

/// What `check` warns of two rigid bodies, one of which tilts, with these loads.
fn warned(loads: &str) -> String {
    let case = format!(
        "title = \"two bodies\"\n[body.flat]\nturns = \"no\"\nmass = \"1 kg\"\nstiffness = {{ x = \"1e6 N/m\", y = \"1e6 N/m\" }}\n\
         [body.wheel]\nturns = \"prescribed\"\nspeed = \"600 rpm\"\nmass = \"1 kg\"\npolar_inertia = \"1e-3 kg*m^2\"\n\
         transverse_inertia = \"2e-3 kg*m^2\"\nz = \"0 mm\"\n\
         [joint.flat]\nkind = \"bushing\"\nfirst = {{ body = \"flat\" }}\ndamping = {{ xx = \"10 N*s/m\", yy = \"10 N*s/m\" }}\n\
         [joint.wheel]\nkind = \"bushing\"\nfirst = {{ body = \"wheel\", z = \"0 mm\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
         tilting_stiffness = {{ xx = \"1e4 N*m/rad\", yy = \"1e4 N*m/rad\" }}\n{loads}\
         [march]\ntime_step = \"1e-4 s\"\nduration = \"0.05 s\"\n"
    );
    let outcome = Workbench::new().file("case.toml", &case).whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    outcome.stderr
}

#[test]
fn loads_that_begin_after_the_end_are_said_to_never_act() {
    let load = |body: &str, onset: &str| {
        warned(&format!("[loads.push]\nbody = \"{body}\"\nforce = \"1 N\"\n{onset}\n"))
    };
    for (onset, from) in [
        ("start = \"0.05 s\"", "0.05"),
        ("start = \"2 s\"", "2"),
        ("ramp = [\"60 ms\", \"1 s\"]", "0.06"),
    ] {
        let said = load("flat", onset);
        let wanted = format!(
            "the load `push` begins at {from} s, and the run ends at 0.05 s: it never acts"
        );
        assert!(said.contains(&wanted), "{said}");
    }
    for onset in ["", "start = \"0.049 s\"", "ramp = [\"0.04 s\", \"1 s\"]"] {
        assert!(!load("flat", onset).contains("never acts"), "{onset}");
    }
}

#[test]
fn places_that_make_no_difference_are_said() {
    let load = |body: &str, what: &str| {
        warned(&format!("[loads.push]\nbody = \"{body}\"\n{what}\nz = \"40 mm\"\n"))
    };
    let said = load("flat", "force = \"1 N\"");
    let wanted = "the `z` of the load `push` on `flat` has no effect: without `transverse_inertia` the body does not tilt";
    assert!(said.contains(wanted), "{said}");
    let said = load("wheel", "couple = [\"1 N*m\", \"0 N*m\", \"0 N*m\"]");
    assert!(said.contains("a couple is the same everywhere on a rigid body"), "{said}");
    // A force on a body that tilts has a place.
    assert!(!load("wheel", "force = \"1 N\"").contains("has no effect"));
}
