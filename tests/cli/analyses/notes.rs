//! What analyses say of their own worth: laws beyond their range, motions that are not small, loads that vary, forces that jump.

use super::{numbers, ran};
use crate::workbench::Workbench;

/// A rigid rotor of 10 kg on a law of its own, with more of the case behind.
fn rotor(law: &str, more: &str) -> Workbench {
    let case = format!(
        "title = \"a rigid rotor\"\n{more}\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"10 kg\"\n\
         polar_inertia = \"1e-3 kg*m^2\"\nunbalance.one = {{ mass = \"1 g\", radius = \"100 mm\" }}\n\
         [joint.spring]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nlaw = \"own.toml\"\n\
         radial_clearance = \"60 um\"\njournal_radius = \"30 mm\"\nlength = \"30 mm\"\n"
    );
    Workbench::new().file("own.toml", law).file("case.toml", &case)
}

/// F = −(k + k₃r²) e.
const CUBIC: &str = r#"
kind = "law"
name = "own"
title = "hardening"
source = "closed form"
[inputs]
e_x = { unit = "m", range = [-1e-4, 1e-4] }
e_y = { unit = "m", range = [-1e-4, 1e-4] }
e_x_dot = { unit = "m/s", range = [-1, 1] }
e_y_dot = { unit = "m/s", range = [-1, 1] }
[parameters]
k = { value = 1e6, unit = "N/m" }
k3 = { value = 1e15, unit = "N/m^3" }
d = { value = 100, unit = "N*s/m" }
[valid.r]
value = 'sqrt(e_x^2 + e_y^2)'
unit = "um"
max = 40
title = "eccentricity"
help = "lower the load"
[outputs.F_x]
unit = "N"
value = '-(k + k3*(e_x^2 + e_y^2))*e_x - d*e_x_dot'
[outputs.F_y]
unit = "N"
value = '-(k + k3*(e_x^2 + e_y^2))*e_y - d*e_y_dot'
"#;

/// The number before a word in the line that contains another one.
fn before(text: &str, line: &str, word: &str) -> f64 {
    let own = text.lines().find(|own| own.contains(line));
    let own = own.unwrap_or_else(|| panic!("`{line}` is in\n{text}"));
    let head = &own[..own.find(word).unwrap_or_else(|| panic!("`{word}` is in {own}"))];
    let number = head.split_whitespace().next_back().expect("a word");
    number.parse().unwrap_or_else(|_| panic!("a number: {own}"))
}

/// Along x stiffness rises by 3k₃r², which is a tenth of k at √(0.1 k/3k₃).
#[test]
fn motions_are_small_up_to_where_a_closed_form_says() {
    let workbench = rotor(CUBIC, "");
    let outcome = ran(&workbench, &["modes", "case.toml"]);
    let within = before(&outcome.stdout, "for amplitudes up to", "µm");
    let expected = 1e6 * (0.1 * 1e6 / 3e15_f64).sqrt();
    assert!((within / expected - 1.0).abs() < 0.02, "{within} µm, not {expected}");
    assert!(!outcome.stdout.contains("outside its range of validity"), "{}", outcome.stdout);
}

/// What the response says of amplitudes: 1e-4 kg·m on 10 kg is 10 µm far above the critical speed, where 5.8 are small.
#[test]
fn a_response_that_is_not_small_says_so() {
    let workbench = rotor(CUBIC, "");
    let outcome = ran(&workbench, &["response", "case.toml", "--speeds", "9000 rpm"]);
    let moves = before(&outcome.stdout, "too large for a linear analysis", "µm at");
    let orbit = numbers(&workbench, "results/case/response.csv", "major_um")[0];
    assert!((moves / orbit - 1.0).abs() < 5e-3, "{moves} {orbit}");
    let linear = CUBIC.replace("value = 1e15", "value = 0");
    let outcome = ran(&rotor(&linear, ""), &["response", "case.toml", "--speeds", "9000 rpm"]);
    assert!(!outcome.stdout.contains("too large"), "{}", outcome.stdout);
}

/// k r + k₃r³ = 120 N at 44 µm, beyond the 40 µm of the law.
#[test]
fn a_law_beyond_its_range_is_named_with_value_limit_and_remedy() {
    let load = "[loads.pull]\nbody = \"rotor\"\ndirection = \"x\"\nforce = \"120 N\"";
    let outcome = ran(&rotor(CUBIC, load), &["coefficients", "case.toml"]);
    let at = before(&outcome.stdout, "outside its range of validity", " um, limit");
    let force = |r: f64| 1e6 * r + 1e15 * r.powi(3);
    assert!((force(1e-6 * at) / 120.0 - 1.0).abs() < 1e-2, "{at} µm");
    assert!(outcome.stdout.contains("limit 40 um. Remedy: lower the load"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("eccentricity"), "{}", outcome.stdout);
}

const LOADS: &str = r#"
[loads.shake]
body = "rotor"
direction = "x"
force = "100 N"
frequency = "50 Hz"
phase = "90 deg"
[loads.rising]
body = "rotor"
direction = "x"
force = "30 N"
ramp = ["0 s", "1 s"]
[loads.later]
body = "rotor"
direction = "x"
force = "1000 N"
start = "1 s"
[loads.gas]
body = "rotor"
direction = "y"
table = "gas.csv"
period = "720 deg"
[loads.shaken]
body = "rotor"
direction = "y"
force = "500 N"
order = 1
phase = "90 deg"
"#;

/// sin(90°) of 100 N and all of 30 N along x; along y the mean of a table that is straight between its rows, and nothing of an order.
#[test]
fn loads_that_vary_count_as_the_output_says() {
    let workbench = rotor(CUBIC, LOADS)
        .file("gas.csv", "angle [deg], force [N]\n0, 10\n180, 10\n360, 10\n540, 10\n720, 10\n");
    let outcome = ran(&workbench, &["coefficients", "case.toml", "--out", "out"]);
    let force = |axis: &str| numbers(&workbench, "out/coefficients.csv", axis)[0];
    let (x, y) = (force("force_x_N"), force("force_y_N"));
    assert!((x / -130.0 - 1.0).abs() < 1e-6 && (y / -10.0 - 1.0).abs() < 1e-6, "{x} {y}");
    for words in [
        "note: load.shake varies in time: its value at t = 0 is used",
        "note: load.rising is used in full, as at the end of its ramp",
        "note: load.later is left out, as it starts only at 1 s",
    ] {
        assert!(outcome.stdout.contains(words), "{words}\n{}", outcome.stdout);
    }
    // What goes by the angle is in the response, and its mean is not.
    ran(&workbench, &["response", "case.toml", "--speeds", "3000 rpm", "--out", "out"]);
    let orders = numbers(&workbench, "out/response.csv", "order");
    assert!(orders.contains(&1.0) && !orders.contains(&0.0), "{orders:?}");
}

/// A block that holds back with 5 N whichever way it slides has no damping at rest; sliding, it has.
#[test]
fn a_force_that_jumps_where_the_machine_stands_is_refused() {
    let smooth = "value = '-(k + k3*(e_x^2 + e_y^2))*e_x - d*e_x_dot'";
    let jumps = "jump = \"accept\"\npieces = [{ when = 'e_x_dot > 0', value = '-(k + k3*(e_x^2 + e_y^2))*e_x - f' }, \
                 { value = '-(k + k3*(e_x^2 + e_y^2))*e_x + f' }]";
    let friction = CUBIC
        .replace(smooth, jumps)
        .replace("[parameters]", "[parameters]\nf = { value = 5, unit = \"N\" }");
    let outcome = rotor(&friction, "").whirl(&["modes", "case.toml"]);
    assert_ne!(outcome.status, 0, "{}", outcome.stdout);
    assert!(outcome.stderr.contains("jumps by 1.000e1 N"), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("rotor at 3000 rpm"), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("smooth"), "{}", outcome.stderr);
}

/// The unbalance of a mass that spins in its frame turns with it: the disc stands in the middle of its ring.
#[test]
fn the_unbalance_of_a_mass_that_spins_is_no_static_load() {
    let workbench = Workbench::new();
    let outcome = ran(&workbench, &["coefficients", "annular-rub", "--out", "out"]);
    let stands = numbers(&workbench, "out/coefficients.csv", "e_x_um");
    assert!(!stands.is_empty() && stands.iter().all(|own| *own == 0.0), "{stands:?}");
    assert!(!outcome.stdout.contains("varies in time"), "{}", outcome.stdout);
}
