//! Impacts and rubs: a run is sound as far as its peaks are right.

use crate::workbench::Workbench;

/// An unbalanced rotor of 1 kg that strikes the wall all around, with friction; two springs of 1e6 N/m touch at a time.
fn rub(time_step: f64) -> String {
    format!(
        "title = \"a rub\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"120 rad/s\"\nmass = \"1 kg\"\n\
         polar_inertia = \"0.01 kg*m^2\"\n[body.rotor.unbalance.u]\nmass = \"20 g\"\nradius = \"100 mm\"\n\
         [joint.b]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\n\
         stiffness = {{ xx = \"1e4 N/m\", yy = \"1e4 N/m\" }}\n\
         damping = {{ xx = \"20 N*s/m\", yy = \"20 N*s/m\" }}\n\
         [joint.rub]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nsprings = 24\nlaw = \"rub-coulomb\"\n\
         radial_clearance = \"1 mm\"\njournal_radius = \"100 mm\"\nparameters = {{ k = \"1e3 N/mm\", mu = 0.1 }}\n\
         [march]\ntime_step = \"{time_step:e} s\"\nduration = \"0.1 s\"\nforce_tolerance = \"1e-6 N\"\n"
    )
}

/// Whether a run of so many steps a contact is sound, its share of energy created, and the peaks of the first contacts (N).
fn run(steps: f64) -> (bool, f64, Vec<f64>) {
    let contact = std::f64::consts::PI / 2e6_f64.sqrt();
    let bench = Workbench::new().file("case.toml", &rub(contact / steps));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("results/case");
    let forces = history.column("RX_rub_N").iter().zip(history.column("RY_rub_N"));
    let mut peaks = vec![0.0_f64];
    for force in forces.map(|(x, y)| f64::hypot(*x, *y)) {
        match (force > 0.0, peaks.last_mut()) {
            (true, Some(peak)) => *peak = peak.max(force),
            (false, Some(peak)) if *peak > 0.0 => peaks.push(0.0),
            _ => {}
        }
    }
    peaks.truncate(4);
    assert!(peaks.iter().all(|peak| *peak > 0.0), "{peaks:?}");
    let verdict = &bench.summary("results/case")["verdict"];
    let share = verdict["measures"]["energy_made_share"].as_f64().expect("a share");
    (verdict["sound"] == true, share, peaks)
}

/// docs/physics.md, What an impact costs: peaks are off by half of the energy that is created, and their rows stand beside them.
#[test]
fn a_rub_is_sound_as_long_as_its_peaks_are_right() {
    let (sound, _, right) = run(160.0);
    assert!(sound);
    for (steps, sound) in [(40.0, true), (20.0, true), (12.0, true), (8.0, false), (5.0, false)] {
        let (found, share, peaks) = run(steps);
        assert_eq!(found, sound, "{steps} steps a contact: {share}");
        // (ωΔt)²/6 on average, at most (ωΔt)²/4, of a contact; up to four springs touch where it is deep, not two.
        let square = (std::f64::consts::PI / steps).powi(2);
        assert!(share > square / 12.0 && share < square / 2.0, "{steps}: {share} of {square}");
        // Each is off by up to (ωΔt)²/8 by the energy lost, as much by the row that stands beside the peak, and as much again
        // by the speed that the contact before left; twice that with four springs.
        for (peak, right) in peaks.iter().zip(&right) {
            let off = 1.0 - peak / right;
            assert!(off.abs() < 0.75 * square, "{steps}: {off} of {square}");
        }
        // At the limit (ωΔt)² is 0.12: the mean lies between (ωΔt)²/8, that of energy and rows, and (ωΔt)²/4, the most.
        let mean = peaks.iter().zip(&right).map(|(a, b)| 1.0 - a / b).sum::<f64>() / 4.0;
        assert!(if sound { mean < 0.03 } else { mean > 0.015 }, "{steps}: {mean}");
    }
}
