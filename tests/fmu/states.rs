//! States: taken, given back, carried to other instances.

use crate::bench::{Bench, PORT, rotor};
use crate::importer::Instance;

const DT: f64 = 1e-4;

fn names() -> Vec<String> {
    ["X_b_um", "Y_b_um", "RX_b_N", "RY_b_N", "ax_a_m_s2", "theta_rad"].map(str::to_owned).to_vec()
}

/// Steps from one to another with inputs that go on; the outputs after each.
fn marched(unit: &Instance, steps: std::ops::Range<usize>) -> Vec<Vec<f64>> {
    let step = |step: usize| {
        unit.set("load.port.fx", 100.0 * (0.3 * step as f64).sin());
        unit.set_rate("load.port.fy", 10.0 * step as f64);
        unit.set("speed.r", 314.0 + 0.1 * step as f64);
        unit.step(step as f64 * DT, DT);
        unit.all(&names())
    };
    steps.map(step).collect()
}

#[test]
fn a_state_is_gone_back_to_with_the_same_bits() {
    // A film has factors that are kept over steps.
    let film = "[joint.f]\nkind = \"bearing\"\njournal = { body = \"r\" }\nlaw = \"ocvirk\"\n\
                parameters = { mu = \"20 mPa*s\" }\nradial_clearance = \"2 mm\"\njournal_radius = \"30 mm\"\nlength = \"30 mm\"\n";
    for more in [PORT.to_owned(), format!("{film}{PORT}")] {
        let bench = Bench::new(&rotor(&more));
        let folder = bench.unit(&[]);
        let unit = Instance::new(&folder).unwrap().started();
        marched(&unit, 0..37);
        let before = unit.all(&names());
        let state = unit.state();
        let first = marched(&unit, 37..90);
        unit.restore(&state);
        assert_eq!(unit.all(&names()), before);
        assert_eq!(marched(&unit, 37..90), first);
        // Another instance, new, and as if it were in another process.
        let other = Instance::new(&folder).unwrap();
        other.restore(&state);
        assert_eq!(other.all(&names()), before);
        assert_eq!(marched(&other, 37..90), first);
        // The same twice: nothing but what is in it has a part.
        assert_eq!(other.state(), unit.state());
    }
}

#[test]
fn instances_know_nothing_of_each_other() {
    let bench = Bench::new(&rotor(PORT));
    let folder = bench.unit(&[]);
    let alone = marched(&Instance::new(&folder).unwrap().started(), 0..60);
    std::thread::scope(|scope| {
        let work = |shift: f64| {
            let folder = folder.clone();
            scope.spawn(move || {
                let unit = Instance::new(&folder).unwrap().started();
                unit.set("load.port.fz", shift);
                marched(&unit, 0..60)
            })
        };
        let threads = [0.0, 0.0, 50.0].map(work);
        for found in threads.map(|own| own.join().unwrap()) {
            assert_eq!(found, alone);
        }
    });
}

#[test]
fn what_is_no_state_is_refused_and_changes_nothing() {
    let bench = Bench::new(&rotor(PORT));
    let folder = bench.unit(&[]);
    let unit = Instance::new(&folder).unwrap().started();
    marched(&unit, 0..10);
    let (state, before) = (unit.state(), unit.all(&names()));
    for at in (0..state.len()).step_by(97) {
        let mut bad = state.clone();
        bad[at] ^= 1;
        let mut other = std::ptr::null_mut();
        let said = unit.refused(|own| unsafe {
            whirl_fmu::fmi2DeSerializeFMUstate(own, bad.as_ptr(), bad.len(), &mut other)
        });
        assert!(other.is_null());
        assert_eq!(said, "these bytes are no state of this unit", "byte {at}");
    }
    assert_eq!(unit.all(&names()), before);
    marched(&unit, 10..12);
}
