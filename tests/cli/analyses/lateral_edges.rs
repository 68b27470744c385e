//! `whirl lateral` of rotors at the edge of what its rules are made for.

use super::lateral::{CASE, bench, lateral, lines};
use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// On supports without stiffness to speak of the rotor moves as a whole, at one end a little more than at the other: its unbalance is
/// between the bearings, and not at an end.
#[test]
fn unbalance_of_a_flat_mode_is_in_the_middle() {
    let case = CASE
        .replace(
            "stiffness = { xx = \"1e6 N/m\", yy = \"0.8e6 N/m\" }",
            "stiffness = { xx = \"1e3 N/m\", yy = \"1e3 N/m\" }",
        )
        .replace(
            "damping = { xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }",
            "damping = { xx = \"1 N*s/m\", yy = \"1 N*s/m\" }",
        )
        .replace("[analysis.api.stages.one]\nstiffness = \"1e5 N/m\"\n", "")
        .replace("kind = \"lateral\"", "kind = \"lateral\"\nunbalance_modes = [1]");
    let case = case.replacen(
        "xx = \"1e3 N/m\", yy = \"1e3 N/m\"",
        "xx = \"1.01e3 N/m\", yy = \"1.01e3 N/m\"",
        1,
    );
    let bench = bench(&case);
    lateral(&bench);
    let of = |name: &str| numbers(&bench, "out/api.unbalance.csv", name);
    let (z, load) = (of("z_mm"), of("load_kg"));
    assert_eq!(z.len(), 1, "{z:?}");
    assert!((z[0] - 750.0).abs() < 1e-6, "{z:?}");
    assert!((load[0] / 88.181_804_016_583_43 - 1.0).abs() < 1e-6, "{load:?}");
}

/// What pulls beside the weight is in W, and a note says so; loads that the case gives are its own.
#[test]
fn loads_above_the_weight_are_named() {
    let pulled =
        format!("{CASE}[loads.belt]\nbody = \"rotor\"\nsets = \"NODE_4\"\nforce = \"5 kN\"\n");
    let said = lateral(&bench(&pulled));
    assert!(said.contains("more than the mass of rotor, 88.18"), "{said}");
    assert!(said.contains("journal_loads"), "{said}");
    let told = pulled.replace(
        "kind = \"lateral\"",
        "kind = \"lateral\"\njournal_loads = { DE = \"432 N\", NDE = \"432 N\" }",
    );
    for case in [&told, CASE] {
        assert!(!lateral(&bench(case)).contains("more than the mass"), "{case}");
    }
}

/// Without damping no amplitude and no scale means anything: the lines do not pass, and a note says why. What falls on one side only is
/// named, too.
#[test]
fn undamped_peaks_do_not_pass() {
    let said = lateral(&bench(CASE));
    assert!(said.contains("unbalance mode 1: peaks that fall to 1/√2 on one side only"), "{said}");
    let case = CASE
        .replace("damping = { xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }\n", "")
        .replace("minimum_speed = \"7000 rpm\"", "minimum_speed = \"500 rpm\"");
    let bench = bench(&case);
    let said = lateral(&bench);
    assert!(said.contains("UNDAMPED peaks"), "{said}");
    let factors = lines(&bench, "mode 1", "amplification factor", "joint.DE 45 deg");
    assert!(factors.iter().any(|own| own.0.is_infinite() && own.3 == "NO"), "{factors:?}");
    let most: Vec<_> = ["joint.DE", "joint.NDE"]
        .iter()
        .flat_map(|at| [45, 135].map(|angle| format!("{at} {angle} deg")))
        .flat_map(|at| lines(&bench, "mode 1", "probe vibration A_max", &at))
        .collect();
    assert!(most.len() == 1 && most[0].0.is_infinite() && most[0].3 == "NO", "{most:?}");
}

/// In bearings that are softer in one direction modes move nearly in a plane: the least damped of them is judged, and unbalance is
/// placed by one of each shape.
#[test]
fn modes_in_a_plane_are_judged_and_place_unbalance() {
    let joint = |name: &str, z: f64| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"r\", z = \"{z} mm\" }}\n\
             stiffness = {{ xx = \"2e7 N/m\", yy = \"3e7 N/m\" }}\ndamping = {{ xx = \"6e2 N*s/m\", yy = \"6e2 N*s/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"unlike bearings\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n[body.r]\nturns = \"prescribed\"\n\
         speed = \"9000 rpm\"\nmass = \"100 kg\"\npolar_inertia = \"1 kg*m^2\"\ntransverse_inertia = \"3 kg*m^2\"\nz = \"400 mm\"\n\
         {}{}[analysis.api]\nkind = \"lateral\"\nminimum_speed = \"9500 rpm\"\nmaximum_speed = \"12000 rpm\"\n",
        joint("l", 0.0),
        joint("q", 1000.0)
    );
    let bench = Workbench::new().file("case.toml", &case);
    lateral(&bench);
    ran(&bench, &["modes", "case.toml", "--speed", "12000 rpm", "--out", "modes", "--quiet"]);
    let [hertz, decrements] =
        ["frequency_hz", "log_decrement"].map(|name| numbers(&bench, "modes/modes.csv", name));
    let least = hertz.iter().zip(&decrements).filter(|own| *own.0 < 200.0);
    let least = least.map(|own| *own.1).fold(f64::INFINITY, f64::min);
    let judged = column(&bench, "out/api.csv", "quantity");
    let place = judged.iter().position(|own| own == "level II log decrement").expect("a line");
    let value = numbers(&bench, "out/api.csv", "value")[place];
    assert!((value / least - 1.0).abs() < 1e-9 && least < 0.05, "{value}, not {least}");
    // The translatory mode, whose journals carry all, and the conical one.
    let names = column(&bench, "out/api.unbalance.csv", "unbalance");
    let count = |name: &str| names.iter().filter(|own| own.as_str() == name).count();
    assert_eq!([count("mode 1"), count("mode 2")], [1, 2], "{names:?}");
}

/// Without gravity in the case the journals carry the weight of the rotor none the less, also where their clearances stand open: the
/// drum's two add up to its 12 kg. Each unbalance stands once.
#[test]
fn the_weight_is_carried_beyond_clearances() {
    let case = "include = \"two-spool.toml\"\n[analysis.api]\nkind = \"lateral\"\nof = \"high\"\nminimum_speed = \"6000 rpm\"\nmaximum_speed = \"9000 rpm\"\n";
    let bench = Workbench::new().file("case.toml", case);
    let said = ran(&bench, &["lateral", "case.toml", "--no-figures", "--out", "out"]).stdout;
    // By statics of the beam on its two bearings, at 200 mm and 550 mm, about its centre of mass.
    let line = said.lines().find(|own| own.starts_with("static loads: ")).expect("loads");
    let loads: Vec<f64> = line.split_whitespace().filter_map(|own| own.parse().ok()).collect();
    assert_eq!(loads.len(), 2, "{line}");
    assert!((loads[0] + loads[1] - 12.0).abs() < 0.01, "{line}");
    assert!(!said.contains("more than the mass"), "{said}");
    let of = |name: &str| numbers(&bench, "out/api.unbalance.csv", name);
    let names = column(&bench, "out/api.unbalance.csv", "unbalance");
    let placed = |mode: &str| -> Vec<[f64; 2]> {
        let (z, phase) = (of("z_mm"), of("phase_deg"));
        (0..z.len()).filter(|&k| names[k] == mode).map(|k| [z[k], phase[k] - phase[0]]).collect()
    };
    assert_ne!(placed("mode 1"), placed("mode 2"));
    assert!(of("load_kg").iter().all(|own| *own > 1.0), "{:?}", of("load_kg"));
}

/// Critical speeds are looked for as far as margins reach, whatever `speeds` are listed: one below them does not pass unseen.
#[test]
fn narrow_speeds_hide_no_critical_speed() {
    let fails = |speeds: &str| {
        let case = CASE
            .replace("kind = \"lateral\"", "kind = \"lateral\"\nunbalance_modes = [2]")
            .replace("speeds = \"0 rpm .. 10000 rpm, 51\"", speeds)
            .replace("minimum_speed = \"7000 rpm\"", "minimum_speed = \"3050 rpm\"");
        let bench = bench(&case);
        let said = lateral(&bench);
        let margins = lines(&bench, "mode 2", "separation margin", "joint.DE 45 deg");
        let first = margins.first().unwrap_or_else(|| panic!("{said}"));
        assert!(said.contains("6.8.2.10 separation margin at joint.DE 45 deg: "), "{said}");
        first.clone()
    };
    let (whole, narrow) = (fails(""), fails("speeds = \"3040 rpm .. 10000 rpm, 20\""));
    assert_eq!((whole.3.as_str(), narrow.3.as_str()), ("NO", "NO"));
    assert!((whole.1 / narrow.1 - 1.0).abs() < 1e-6, "{whole:?} {narrow:?}");
}

/// Variants are of the machine: keys of an analysis would change nothing. A stage without stiffness is none.
#[test]
fn what_would_do_nothing_is_refused() {
    let refused = |case: &str, what: &str| {
        let outcome = bench(case).whirl(&["lateral", "case.toml", "--out", "out"]);
        assert!(outcome.status == 2 && outcome.stderr.contains(what), "{}", outcome.stderr);
    };
    let variant =
        format!("{CASE}[analysis.api.variants.b]\nset = [\"analysis.api.edition = 7\"]\n");
    refused(&variant, "`analysis.api.edition` is a key of an analysis");
    let stage = CASE.replace("stiffness = \"1e5 N/m\"", "stiffness = \"0 N/m\"");
    refused(&stage, "a `stiffness` of 0 N/m is none");
}
