//! Forces along bodies: against statics, and against the inertia of what they accelerate.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

const CASE: &str = include_str!("forces.toml");
const GRAVITY: f64 = 9.81;
/// Of the shaft: length (m), weight a length with the area of a circle (N/m); where joints and the disc are (m).
const LENGTH: f64 = 1.0;
const JOINTS: [f64; 2] = [0.2, 0.9];
const DISC: f64 = 0.5;
/// Mass, moments of inertia about the axis and a diameter.
const MASS: f64 = 30.0;
const INERTIA: [f64; 2] = [0.2, 0.11];

fn density() -> f64 {
    7810.0 * PI * 0.05_f64.powi(2) / 4.0
}

fn beyond(place: f64, z: f64) -> f64 {
    if place > z + 1e-9 { 1.0 } else { 0.0 }
}

/// Shear and bending are what the weight, the disc and the joints say, whether the shaft turns or not, and whatever its damping
/// does to its deflection.
#[test]
fn a_shaft_carries_its_weight() {
    let workbench = Workbench::new().file("case.toml", CASE);
    for speed in ["0 rpm", "3000 rpm", "-9000 rpm"] {
        ran(&workbench, &["forces", "case.toml", "--speed", speed, "--out", "out"]);
        let of = |name: &str| numbers(&workbench, "out/forces.csv", name);
        let z: Vec<f64> = of("z_mm").iter().map(|own| 1e-3 * own).collect();
        assert!(z.len() > 15, "{z:?}");
        let (shear, moment) = (of("shear_y_N"), of("moment_x_Nm"));
        let weight = density() * GRAVITY;
        let (own, disc) = (weight * LENGTH, MASS * GRAVITY);
        let right = (own * (0.5 * LENGTH - JOINTS[0]) + disc * (DISC - JOINTS[0]))
            / (JOINTS[1] - JOINTS[0]);
        let forces = [(JOINTS[0], own + disc - right), (JOINTS[1], right), (DISC, -disc)];
        for (place, &z) in z.iter().enumerate() {
            let left = LENGTH - z;
            let at = |(own, force): &(f64, f64)| beyond(*own, z) * force;
            let known = -weight * left + forces.iter().map(at).sum::<f64>();
            assert!((shear[place] - known).abs() < 4e-6 * disc, "{z}: {} {known}", shear[place]);
            let at = |(own, force): &(f64, f64)| beyond(*own, z) * force * (own - z);
            let known = 0.5 * weight * left * left - forces.iter().map(at).sum::<f64>();
            assert!((moment[place] - known).abs() < 4e-6 * disc, "{z}: {} {known}", moment[place]);
        }
        for (name, most) in [
            ("shear_x_N", 1e-6 * disc),
            ("moment_y_Nm", 1e-6 * disc),
            ("axial_N", 1e-5 * disc),
            ("torque_Nm", 1e-6 * disc),
        ] {
            let worst = of(name).iter().fold(0.0, |worst: f64, own| worst.max(own.abs()));
            assert!(worst < most, "{name}: {worst}");
        }
    }
}

/// What is seen at a section.
#[derive(Debug, Clone, Copy)]
struct Seen {
    z: f64,
    /// Along or about x and y.
    moved: [Complex64; 2],
    force: [Complex64; 2],
    moment: [Complex64; 2],
}

/// By the values of a column, the sections with amplitudes, in SI.
fn seen(workbench: &Workbench, file: &str, by: &str) -> BTreeMap<String, Vec<Seen>> {
    let amplitude = |name: &str, unit: &str, scale: f64| -> Vec<Complex64> {
        let sizes = numbers(workbench, file, &format!("{name}_{unit}"));
        let phases = numbers(workbench, file, &format!("{name}_deg"));
        let polar =
            |(size, phase): (f64, f64)| Complex64::from_polar(scale * size, phase.to_radians());
        sizes.into_iter().zip(phases).map(polar).collect()
    };
    let both =
        |name: [&str; 2], unit: &str, scale: f64| name.map(|own| amplitude(own, unit, scale));
    let moved = both(["ux", "uy"], "um", 1e-6);
    let force = both(["shear_x", "shear_y"], "N", 1.0);
    let moment = both(["moment_x", "moment_y"], "Nm", 1.0);
    let z = numbers(workbench, file, "z_mm");
    let mut all: BTreeMap<String, Vec<Seen>> = BTreeMap::new();
    for (k, key) in column(workbench, file, by).into_iter().enumerate() {
        let at = |own: &[Vec<Complex64>; 2]| [own[0][k], own[1][k]];
        let (moved, force, moment) = (at(&moved), at(&force), at(&moment));
        all.entry(key).or_default().push(Seen { z: 1e-3 * z[k], moved, force, moment });
    }
    all
}

/// ∫ u dz from the first section to the last; they are 47 mm apart, which costs some 1e-3 in the faster modes.
fn integral(all: &[Seen], axis: usize) -> Complex64 {
    all.windows(2)
        .map(|own| 0.5 * (own[0].moved[axis] + own[1].moved[axis]) * (own[1].z - own[0].z))
        .sum()
}

/// Slope of the displacement at a place, by a parabola through three sections around it.
fn slope(all: &[Seen], place: usize, axis: usize) -> Complex64 {
    let [a, b, c] = [all[place - 1], all[place], all[place + 1]];
    let (h, k) = (b.z - a.z, c.z - b.z);
    let [before, after] =
        [(b.moved[axis] - a.moved[axis]) / h, (c.moved[axis] - b.moved[axis]) / k];
    (before * k + after * h) / (h + k)
}

/// In every mode the force on the end before the first joint is that which accelerates it, and at the disc force and moment change by
/// what its mass and its moments of inertia take.
#[test]
fn forces_of_modes_accelerate_masses() {
    let case = format!("{CASE}\n[analysis.forces]\nkind = \"forces\"\nstations = 400\ncount = 6\n");
    let workbench = Workbench::new().file("case.toml", &case);
    ran(&workbench, &["analyse", "case.toml", "--out", "out"]);
    ran(&workbench, &["modes", "case.toml", "--count", "6", "--out", "modes"]);
    let value = |name: &str| numbers(&workbench, "modes/modes.csv", name);
    let (re, im) = (value("real_1_s"), value("imaginary_1_s"));
    let speed = 3000.0 * TAU / 60.0;
    let all = seen(&workbench, "out/forces.modes.csv", "mode");
    assert_eq!(all.len(), 6);
    let mut checked = 0;
    for (mode, own) in &all {
        let place = mode.parse::<usize>().expect("a number") - 1;
        let value = Complex64::new(re[place], im[place]);
        let largest = own.iter().flat_map(|own| own.moved).map(Complex64::norm).fold(0.0, f64::max);
        // Modes along and about the axis have no shear.
        if largest < 0.5e-6 {
            continue;
        }
        checked += 1;
        let most = own.iter().flat_map(|own| own.force).map(Complex64::norm).fold(0.0, f64::max);
        let before: Vec<Seen> =
            own.iter().copied().filter(|own| own.z < JOINTS[0] - 0.012).collect();
        let [first, last] = [before[0], before[before.len() - 1]];
        for axis in 0..2 {
            // From the end on the displacement goes on as it is at the first section, to first order.
            let turn = (before[1].moved[axis] - first.moved[axis]) / (before[1].z - first.z);
            let end = first.z * (first.moved[axis] - 0.5 * first.z * turn);
            let known = density() * value * value * (integral(&before, axis) + end);
            let apart = (last.force[axis] - known).norm();
            assert!(apart < 4e-3 * most, "{mode}: {apart} {known} of {most}");
        }
        let disc = own.iter().position(|own| own.z > DISC - 1e-6).expect("a section of the disc");
        let [before, at] = [own[disc - 1], own[disc]];
        let between = density() * (at.z - before.z);
        let tilts = [-slope(own, disc, 1), slope(own, disc, 0)];
        let [polar, diametral] = INERTIA;
        let rates = [
            diametral * value * value * tilts[0] + polar * speed * value * tilts[1],
            diametral * value * value * tilts[1] - polar * speed * value * tilts[0],
        ];
        let most_moment =
            own.iter().flat_map(|own| own.moment).map(Complex64::norm).fold(0.0, f64::max);
        for axis in 0..2 {
            let change = at.force[axis] - before.force[axis];
            let mean = 0.5 * (at.moved[axis] + before.moved[axis]);
            let known = value * value * (MASS * at.moved[axis] + between * mean);
            assert!((change - known).norm() < 2e-3 * most, "{mode}: {change} {known}");
            let length = at.z - before.z;
            let by_shear = [length * before.force[1], -length * before.force[0]][axis];
            let change = at.moment[axis] - before.moment[axis] - by_shear;
            assert!(
                (change - rates[axis]).norm() < 1e-2 * most_moment,
                "{mode}: {change} {} of {most_moment}",
                rates[axis]
            );
        }
    }
    assert!(checked >= 4, "{checked}");
}

/// At the disc the shear of the response changes by what its mass takes and its unbalance gives.
#[test]
fn forces_of_a_response_are_those_of_unbalance_and_masses() {
    let unbalance = 1.5e-3;
    let case = format!(
        "{CASE}\n[body.rotor.unbalance.one]\nmass = \"15 g\"\nradius = \"100 mm\"\nz = \"500 mm\"\n"
    );
    let workbench = Workbench::new().file("case.toml", &case);
    ran(&workbench, &["forces", "case.toml", "--speed", "3000 rpm", "--out", "out"]);
    let all = seen(&workbench, "out/forces.response.csv", "order");
    let own = &all["1"];
    let disc = own.iter().position(|own| own.z > DISC - 1e-6).expect("a section of the disc");
    let [before, at] = [own[disc - 1], own[disc]];
    let square = (3000.0 * TAU / 60.0_f64).powi(2);
    let between = density() * (at.z - before.z);
    let gives = [Complex64::new(unbalance, 0.0), Complex64::new(0.0, -unbalance)];
    for (axis, gives) in gives.into_iter().enumerate() {
        let change = at.force[axis] - before.force[axis];
        let mean = 0.5 * (at.moved[axis] + before.moved[axis]);
        let known = -square * (MASS * at.moved[axis] + between * mean + gives);
        assert!((change - known).norm() < 1e-4 * square * unbalance, "{change} {known}");
    }
}

/// A bearing on a step from a hollow part to a thinner one that is solid: what passes just beyond is the load at the end and the weight
/// of the thin part, however the nodes of the step share what the bearing carries.
#[test]
fn a_bearing_on_a_step_acts_before_it() {
    let case = "title = \"a step\"\ngravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n\
        [material.s]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\ndensity = \"7800 kg/m^3\"\n\
        [body.r]\nturns = \"prescribed\"\nspeed = \"1000 rpm\"\nmaterial = \"s\"\nmodes = 12\n\
        sections = [{ length = \"400 mm\", outer = \"80 mm\", inner = \"20 mm\" }, { length = \"200 mm\", outer = \"40 mm\" }]\n\
        [joint.a]\nkind = \"bushing\"\nfirst = { body = \"r\", z = \"0 mm\" }\nstiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }\n\
        [joint.b]\nkind = \"bushing\"\nfirst = { body = \"r\", z = \"400 mm\" }\nstiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }\n\
        [loads.f]\nbody = \"r\"\nz = \"600 mm\"\nforce = [\"0 N\", \"1000 N\", \"0 N\"]\n\
        [analysis.f]\nkind = \"forces\"\nstations = 7\n";
    let bench = Workbench::new().file("case.toml", case);
    ran(&bench, &["analyse", "case.toml", "--out", "out", "--no-figures"]);
    let of = |name: &str| numbers(&bench, "out/f.csv", name);
    let place = of("z_mm").iter().position(|z| (z - 400.0).abs() < 1e-6).expect("the step");
    let weight = 9.81 * 7800.0 * 0.2 * std::f64::consts::PI * 0.02 * 0.02;
    assert!((of("shear_y_N")[place] / 1000.0 - 1.0).abs() < 1e-4, "{:?}", of("shear_y_N"));
    // The circle is one of cells.
    assert!((of("shear_x_N")[place] / -weight - 1.0).abs() < 1e-2, "{:?}", of("shear_x_N"));
}

#[test]
fn what_cannot_be_cut_is_told() {
    let workbench = Workbench::new();
    let outcome = workbench.whirl(&["forces", "weight"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("no body of `weight` can be cut"), "{}", outcome.stderr);
    let outcome = ran(&workbench, &["forces", "turbocharger", "--out", "out"]);
    assert!(outcome.stdout.contains("ring1 has no sections"), "{}", outcome.stdout);
}
