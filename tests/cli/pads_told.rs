//! What is said of pads that are no bearing.

use crate::workbench::Workbench;

/// Two pads across the load carry it by the shear of a film without a gap, or turn over: neither passes for a film.
#[test]
fn films_that_touch_and_pads_that_tip_over_are_told() {
    let pad = |k: usize, angle: f64, half: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        let at = |radius: f64| format!("[\"{} mm\", \"{} mm\"]", radius * cos, radius * sin);
        format!(
            "[body.pad{k}]\nturns = \"no\"\nrocks = true\nmass = \"0.35 kg\"\npolar_inertia = \"1.2e-4 kg*m^2\"\ncentre = {}\n\
             [joint.pivot{k}]\nkind = \"bushing\"\nfirst = {{ body = \"pad{k}\", at = {} }}\n\
             stiffness = {{ xx = \"5e8 N/m\", yy = \"5e8 N/m\" }}\n[joint.film{k}]\nkind = \"bearing\"\n\
             journal = {{ body = \"rotor\" }}\nbore = {{ body = \"pad{k}\" }}\nlaw = \"reynolds\"\n\
             radial_clearance = \"75 um\"\njournal_radius = \"50 mm\"\nlength = \"50 mm\"\n\
             film = {{ arc = [\"{} deg\", \"{} deg\"], preload = 0.5 }}\n",
            at(55.0),
            at(65.0),
            (angle - half).rem_euclid(360.0),
            angle + half
        )
    };
    let machine = |first: f64, half: f64, step: &str| {
        format!(
            "title = \"two pads\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n[body.rotor]\nturns = \"prescribed\"\n\
             speed = \"9000 rpm\"\nmass = \"250 kg\"\npolar_inertia = \"2 kg*m^2\"\n{}{}[start]\nkind = \"equilibrium\"\n\
             [march]\ntime_step = \"{step}\"\nsteps = 40\n",
            pad(1, first, half),
            pad(2, (first + 180.0).rem_euclid(360.0), half)
        )
    };
    let bench = Workbench::new()
        .file("touching.toml", &machine(90.0, 30.0, "5e-6 s"))
        .file("tipped.toml", &machine(180.0, 85.0, "5e-7 s"));
    for (case, unit, said, note) in [
        ("touching", "um", "its surfaces touch", "the smallest gap of the film"),
        ("tipped", "rad", "turn of a bore of a film", "the turn of the bore about its axis"),
    ] {
        let file = format!("{case}.toml");
        let outcome = bench.whirl(&["run", &file, "--no-figures", "--no-report", "--out", case]);
        let summary = bench.summary(case);
        let findings = summary["verdict"]["findings"].as_array().expect("findings");
        let own = findings.iter().find(|own| own["what"].as_str().unwrap_or("").contains(said));
        let own = own.unwrap_or_else(|| panic!("{case}: {findings:?} {}", outcome.stderr));
        assert_eq!(own["unit"], unit);
        let fast = "by more than itself";
        assert!(findings.iter().all(|own| !own["what"].as_str().unwrap_or("").contains(fast)));
        let outcome = bench.whirl(&["modes", &file]);
        assert!(outcome.stdout.contains(note), "{}", outcome.stdout);
    }
    // The built-in machine does neither.
    let outcome = bench.whirl(&["modes", "tilting-pad"]);
    assert!(!outcome.stdout.contains("of the film"), "{}", outcome.stdout);
}

/// Pads over each other, journals of two radii, and a gap as wide as the journal are warned of; the built-in pads are not.
#[test]
fn films_that_can_hardly_be_meant_are_warned_of() {
    let case = include_str!("../../specs/cases/tilting-pad.toml");
    let arc = "arc = [\"186 deg\", \"246 deg\"]";
    let first = |from: &str, to: &str| case.replacen(from, to, 1);
    for (text, said) in [
        (case.to_owned(), ""),
        (
            first(arc, "arc = [\"170 deg\", \"246 deg\"]"),
            "are over each other by 4° on the same part",
        ),
        (
            first("journal_radius = \"50 mm\"", "journal_radius = \"40 mm\""),
            "with radii of 40 and 50 mm",
        ),
        (
            first("radial_clearance = \"75 um\"", "radial_clearance = \"75 mm\""),
            "more than a twentieth of the radius",
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &text);
        let outcome = bench.whirl(&["modes", "case.toml", "--count", "2"]);
        let told = outcome.stderr.contains("warning");
        assert_eq!(told, !said.is_empty(), "{}", outcome.stderr);
        assert!(outcome.stderr.replace('\n', " ").contains(said), "{said}: {}", outcome.stderr);
    }
}
