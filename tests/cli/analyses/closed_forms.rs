//! Machines of a few coordinates, from case files: against closed forms.

use std::f64::consts::TAU;
use std::fmt::Write;

use super::{Known, column, numbers, ran, reference, section};
use crate::workbench::Workbench;

/// A matrix of x, y and z of a few nodes on the axis, as a file; `of`: the entry of two nodes along an axis.
pub(super) fn market(nodes: usize, of: &dyn Fn(usize, usize, usize) -> f64) -> String {
    let n = 3 * nodes;
    let mut text = format!("%%MatrixMarket matrix array real general\n{n} {n}\n");
    for (j, i) in (0..n).flat_map(|j| (0..n).map(move |i| (j, i))) {
        let value = if i % 3 == j % 3 { of(i / 3, j / 3, i % 3) } else { 0.0 };
        writeln!(text, "{value:?}").expect("text can be written");
    }
    text
}

/// x, y and z of nodes at these heights (m).
pub(super) fn dofs(heights: &[f64]) -> String {
    let mut text = String::from("node, direction, x [m], y [m], z [m]\n");
    for (node, z) in heights.iter().enumerate() {
        for direction in ["x", "y", "z"] {
            writeln!(text, "{}, {direction}, 0, 0, {z:?}", node + 1).expect("text can be written");
        }
    }
    text
}

fn of_masses(masses: &[f64]) -> String {
    market(masses.len(), &|i, j, _| if i == j { masses[i] } else { 0.0 })
}

/// The only speed above which a machine is unstable (rad/s), and the whirl there (rad/s).
fn threshold(workbench: &Workbench, case: &str, speeds: &str) -> [f64; 2] {
    ran(workbench, &["campbell", case, "--speeds", speeds, "--out", "out", "--no-figures"]);
    let what = column(workbench, "out/campbell.critical.csv", "what");
    let places: Vec<usize> = (0..what.len()).filter(|&own| what[own] == "unstable above").collect();
    let [place] = places[..] else { panic!("{what:?}") };
    let of = |name: &str| numbers(workbench, "out/campbell.critical.csv", name)[place];
    [of("speed_rpm") / 60.0, of("frequency_hz")].map(|hertz| TAU * hertz)
}

fn known(case: &str, quantity: &str) -> Known {
    let own = |known: &Known| known.case == case && known.quantity == quantity;
    reference().into_iter().find(own).expect("a row of the reference")
}

fn agree(found: f64, known: &Known) {
    let apart = (found / known.value - 1.0).abs();
    assert!(apart <= known.tolerance, "{}, {}: {found}, {apart:e}", known.case, known.quantity);
}

/// A beam of Euler without mass, 40 mm thick and 0.8 m long, as the stiffness of its middle against both ends.
#[test]
fn a_shaft_without_mass_in_films_is_unstable_where_the_closed_form_says() {
    let moment = std::f64::consts::PI * 0.04_f64.powi(4) / 64.0;
    let bending = 48.0 * 200e9 * moment / 0.8_f64.powi(3);
    let shape = [-0.5, 1.0, -0.5];
    let along = [[1.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]];
    let stiffness = market(3, &|i, j, axis| match axis {
        2 => 1e8 * along[i][j],
        _ => bending * shape[i] * shape[j],
    });
    // A milligram where the journals are, as no coordinate may be without inertia.
    let workbench = Workbench::new()
        .file("K.mtx", &stiffness)
        .file("M.mtx", &of_masses(&[1e-6, 40.0, 1e-6]))
        .file("dofs.csv", &dofs(&[0.0, 0.4, 0.8]))
        .file("case.toml", include_str!("massless-jeffcott.toml"));
    let [speed, _] = threshold(&workbench, "case.toml", "3500 rpm .. 4500 rpm, 5");
    let known = known("jeffcott in films, massless shaft", "threshold");
    let test = "a_shaft_without_mass_in_films_is_unstable_where_the_closed_form_says";
    let mut section = section("A shaft without mass in oil films", &known.source, test);
    known.holds(&mut section, speed * 60.0 / TAU);
    section.finish();
}

/// A mass held by a damped spring that turns, and a damper that stands: ω (1 + c/βk).
#[test]
fn damping_that_turns_makes_a_mass_unstable_where_the_closed_form_says() {
    let workbench = Workbench::new()
        .file("K.mtx", &market(2, &|i, j, _| if i == j { 1e6 } else { -1e6 }))
        .file("M.mtx", &of_masses(&[10.0, 10.0]))
        .file("dofs.csv", &dofs(&[0.0, 0.0]))
        .file("case.toml", include_str!("rotating-damping.toml"));
    let [speed, whirl] = threshold(&workbench, "case.toml", "700 rad/s .. 900 rad/s, 5");
    let known = known("rotating damping, 2 dof", "threshold");
    let test = "damping_that_turns_makes_a_mass_unstable_where_the_closed_form_says";
    let mut section = section("Damping that turns", &known.source, test);
    known.holds(&mut section, speed);
    section.compare("whirl there, √(k/m) (rad/s)", 1e5_f64.sqrt(), whirl, 1e-8);
    section.finish();
}

const VISCOSITY: f64 = 0.02;
const RADIUS: f64 = 0.03;
const LENGTH: f64 = 0.03;
const GAP: f64 = 60e-6;

/// The load (N) of the short film at an eccentricity ratio and a speed (rad/s).
fn load(epsilon: f64, omega: f64) -> f64 {
    let rest = 1.0 - epsilon * epsilon;
    let root = (16.0 * epsilon * epsilon + std::f64::consts::PI.powi(2) * rest).sqrt();
    VISCOSITY * omega * RADIUS * LENGTH.powi(3) / (4.0 * GAP * GAP) * epsilon / (rest * rest) * root
}

/// A rigid mass (kg) in a film under a load (N).
fn rigid(mass: f64, load: f64) -> String {
    format!(
        "title = \"a rigid rotor\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"6000 rad/s\"\nmass = \"{mass} kg\"\n\
         polar_inertia = \"1e-3 kg*m^2\"\n[joint.film]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\n\
         law = \"ocvirk\"\nparameters = {{ mu = \"20 mPa*s\" }}\nradial_clearance = \"60 um\"\n\
         journal_radius = \"30 mm\"\nlength = \"30 mm\"\n[loads.weight]\nbody = \"rotor\"\ndirection = \"x\"\n\
         force = \"-{load} N\"\n"
    )
}

/// k_eq and (ω_w/Ω)² of a rigid rotor by coefficients of its film without dimensions, K c/W and C c Ω/W.
fn whirl([k_xx, k_xy, k_yx, k_yy, c_xx, c_xy, c_yx, c_yy]: [f64; 8]) -> [f64; 2] {
    let held = (k_xx * c_yy + k_yy * c_xx - k_xy * c_yx - k_yx * c_xy) / (c_xx + c_yy);
    let square = ((held - k_xx) * (held - k_yy) - k_xy * k_yx) / (c_xx * c_yy - c_xy * c_yx);
    [held, square]
}

/// Coefficients of the film at every speed, without dimensions, and its eccentricity ratios.
fn films(workbench: &Workbench, load: f64, speeds: &str) -> Vec<(f64, [f64; 8])> {
    ran(workbench, &["coefficients", "case.toml", "--speeds", speeds, "--out", "out"]);
    let of = |name: &str| numbers(workbench, "out/coefficients.csv", name);
    let names = [
        "k_xx_N_m",
        "k_xy_N_m",
        "k_yx_N_m",
        "k_yy_N_m",
        "c_xx_Ns_m",
        "c_xy_Ns_m",
        "c_yx_Ns_m",
        "c_yy_Ns_m",
    ];
    let (columns, rpm) = (names.map(of), of("speed_rpm"));
    let rows = of("eccentricity_ratio").into_iter().enumerate().map(|(row, ratio)| {
        let omega = rpm[row] * TAU / 60.0;
        let scale = |k: usize| GAP / load * if k < 4 { 1.0 } else { omega };
        (ratio, std::array::from_fn(|k| columns[k][row] * scale(k)))
    });
    rows.collect()
}

/// By the coefficients of the film, and by the eigenvalues of a rotor whose mass is that of the threshold.
#[test]
fn thresholds_of_a_rigid_rotor_in_a_short_film_are_those_of_the_closed_form() {
    let omega = 6000.0;
    let test = "thresholds_of_a_rigid_rotor_in_a_short_film_are_those_of_the_closed_form";
    let source = super::source_of("ocvirk eps 0.05");
    let mut section = section("A rigid rotor in a short film at its threshold", &source, test);
    for epsilon in [0.05, 0.1, 0.2, 0.4, 0.5, 0.6] {
        let case = format!("ocvirk eps {epsilon}");
        let ratio = known(&case, "whirl ratio at the threshold of a rigid rotor");
        let mass = known(&case, "m omega^2 c/W at the threshold");
        let load = load(epsilon, omega);
        let weight = mass.value * load / (GAP * omega * omega);
        let workbench = Workbench::new().file("case.toml", &rigid(weight, load));
        let own = films(&workbench, load, "4000 rad/s .. 6000 rad/s, 2")[1];
        assert!((own.0 / epsilon - 1.0).abs() < 1e-6, "{epsilon}");
        let [held, square] = whirl(own.1);
        agree(square.sqrt(), &ratio);
        agree(held / square, &mass);
        let [speed, whirl] = threshold(&workbench, "case.toml", "5700 rad/s .. 6300 rad/s, 3");
        for (known, found) in
            [(&ratio, whirl / speed), (&mass, mass.value * (speed / omega).powi(2))]
        {
            let what = format!("ε {epsilon}: {}", known.quantity);
            section.compare(&what, known.value, found, known.tolerance);
        }
    }
    section.finish();
}

/// Beyond, no mass is unstable: the whirl that would be neutral has no real frequency.
#[test]
fn a_rigid_rotor_far_out_in_a_short_film_is_always_stable() {
    let known = known("ocvirk", "eccentricity ratio beyond which a rigid rotor is always stable");
    let load = load(0.756, 6000.0);
    let workbench = Workbench::new().file("case.toml", &rigid(1.0, load));
    let all = films(&workbench, load, "5900 rad/s .. 6100 rad/s, 21");
    let squares: Vec<[f64; 2]> = all.iter().map(|own| [own.0, whirl(own.1)[1]]).collect();
    let pair = squares.windows(2).find(|pair| pair[0][1] < 0.0 && pair[1][1] >= 0.0);
    let [a, b] = pair.expect("a change of the sign") else { unreachable!() };
    agree(a[0] - a[1] * (b[0] - a[0]) / (b[1] - a[1]), &known);
}

#[test]
fn the_built_in_rotor_in_films_stands_at_its_threshold_where_the_closed_form_says() {
    let workbench = Workbench::new();
    let [speed, whirl] = threshold(&workbench, "weight", "3000 rpm .. 9000 rpm, 5");
    agree(speed * 60.0 / TAU, &known("case weight", "threshold"));
    agree(whirl / speed, &known("case weight", "whirl ratio there"));
    let there = format!("{speed} rad/s");
    ran(&workbench, &["coefficients", "weight", "--speeds", &there, "--out", "out"]);
    for ratio in numbers(&workbench, "out/coefficients.csv", "eccentricity_ratio") {
        agree(ratio, &known("case weight", "eccentricity ratio there"));
    }
}

/// The force that turns with the reference machine is none; what stands is held by its bearings.
#[test]
fn joints_carry_what_stands_in_space() {
    let workbench = Workbench::new()
        .file("case.toml", "include = \"hu2003-2.toml\"\ntitle = \"at constant speed\"\n");
    ran(&workbench, &["coefficients", "case.toml", "--speeds", "4500 rpm", "--out", "out"]);
    let known = known("reference machine", "RY of support 1 at 4500 rpm, static in space");
    agree(numbers(&workbench, "out/coefficients.csv", "force_y_N")[0], &known);
    // A rigid rotor hangs in its film: the film carries the load.
    let load = load(0.4, 6000.0);
    let workbench = Workbench::new().file("case.toml", &rigid(1.0, load));
    ran(&workbench, &["coefficients", "case.toml", "--speeds", "6000 rad/s", "--out", "out"]);
    let of = |name: &str| numbers(&workbench, "out/coefficients.csv", name)[0];
    let [x, y] = [of("force_x_N"), of("force_y_N")];
    assert!((x / load - 1.0).abs() < 1e-6 && (y / load).abs() < 1e-6, "{x} {y} {load}");
}
