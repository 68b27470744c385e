//! `whirl modes`, `campbell` and `response` of machines with a body that turns and is not round: against closed forms and
//! Floquet multipliers.

use std::f64::consts::TAU;
use std::fmt::Write;

use num_complex::Complex64;

use crate::analyses::{Known, column, numbers, ran, reference};
use crate::workbench::Workbench;

/// A point mass on a shaft with unequal stiffnesses (N/m) that turns, its hub held; the ground's springs and dampers at the
/// mass in TOML.
pub(crate) fn point_mass(stiffness: [f64; 2], ground: &str, head: &str, speed: &str) -> Workbench {
    // A body that turns is free: the hub beside the mass, which a joint holds, is so light and so stiff that it is none.
    let mut k = String::new();
    for (place, value) in [stiffness[0], stiffness[1], 1e5].into_iter().enumerate() {
        let (one, two) = (place + 1, place + 4);
        writeln!(k, "{one} {one} {value}\n{two} {two} {value}\n{two} {one} -{value}").unwrap();
    }
    let m: String = (1..=6).fold(String::new(), |mut text, place| {
        let value = if place < 4 { 1.0 } else { 1e-3 };
        writeln!(text, "{place} {place} {value}").unwrap();
        text
    });
    let head_of =
        |count: usize| format!("%%MatrixMarket matrix coordinate real symmetric\n6 6 {count}\n");
    let mut dofs = String::from("node,direction,x,y,z\n");
    for node in [1, 2] {
        for axis in ["x", "y", "z"] {
            writeln!(dofs, "{node},{axis},0,0,0").unwrap();
        }
    }
    let case = format!(
        "title = \"a mass on an asymmetric shaft\"\n{head}\n[body.mass]\nturns = \"prescribed\"\nspeed = \"{speed}\"\n\
         units = \"m, N, kg\"\nmodes = 0\nstiffening = false\naxial_restraint = \"NODE_2\"\n\
         matrices = {{ stiffness = \"K.mtx\", mass = \"M.mtx\", dofs = \"dofs.csv\" }}\n\
         [joint.hub]\nkind = \"bushing\"\nfirst = {{ body = \"mass\", sets = \"NODE_2\" }}\n\
         stiffness = {{ xx = \"2e12 N/m\", yy = \"2e12 N/m\" }}\n\
         [joint.ground]\nkind = \"bushing\"\nfirst = {{ body = \"mass\", sets = \"NODE_1\" }}\n{ground}\n\
         [output.mass]\nquantity = \"displacement\"\nbody = \"mass\"\nset = \"NODE_1\"\n"
    );
    Workbench::new()
        .file("case.toml", &case)
        .file("K.mtx", &(head_of(9) + &k))
        .file("M.mtx", &(head_of(6) + &m))
        .file("dofs.csv", &dofs)
}

/// Where it begins and ends to be unstable (rad/s).
fn thresholds(workbench: &Workbench, speeds: &str) -> Vec<f64> {
    let arguments = ["campbell", "case.toml", "--speeds", speeds, "--out", "out", "--no-figures"];
    ran(workbench, &arguments);
    let what = column(workbench, "out/campbell.critical.csv", "what");
    let speeds = numbers(workbench, "out/campbell.critical.csv", "speed_rpm");
    let own = what.iter().zip(speeds).filter(|own| own.0.contains("stable above"));
    own.map(|own| own.1 * TAU / 60.0).collect()
}

fn known<'a>(all: &'a [Known], case: &str, quantity: &str) -> &'a Known {
    let own = all.iter().find(|own| own.case == case && own.quantity.starts_with(quantity));
    own.unwrap_or_else(|| panic!("{case}: {quantity}"))
}

const FREE: &str = "stiffness = { xx = \"1e-6 N/m\", yy = \"1e-6 N/m\" }";

/// In its own frame nothing varies. Also where the range has no speed inside, and only the whirl that locks to the rotation
/// shows that there is one.
#[test]
fn an_asymmetric_shaft_on_round_supports_is_unstable_between_its_critical_speeds() {
    let all = reference();
    let case = "asymmetric shaft, 2 dof";
    let damped = format!("{FREE}\ndamping = {{ xx = \"10 N*s/m\", yy = \"10 N*s/m\" }}");
    for (ground, ends) in [
        (damped.as_str(), ["end 1 of", "end 2 of"]),
        (FREE, ["end 1, undamped", "end 2, undamped"]),
    ] {
        let workbench = point_mass([0.8e4, 1.2e4], ground, "", "100 rad/s");
        for speeds in ["60 rad/s .. 140 rad/s, 9", "85 rad/s .. 115 rad/s, 2"] {
            let found = thresholds(&workbench, speeds);
            assert_eq!(found.len(), 2, "{speeds}: {found:?}");
            for (found, end) in found.iter().zip(ends) {
                let known = known(&all, case, end);
                let apart = (found / known.value - 1.0).abs();
                assert!(apart <= known.tolerance, "{speeds}, {end}: {found}");
            }
        }
    }
}

/// Seen from anywhere something varies.
#[test]
fn an_asymmetric_shaft_on_asymmetric_supports_is_that_of_its_multipliers() {
    let all = reference();
    let ground = "stiffness = { xx = \"1500 N/m\", yy = \"-1500 N/m\" }\n\
                  damping = { xx = \"0.5 N*s/m\", yy = \"0.5 N*s/m\" }";
    let workbench = point_mass([0.9e4, 1.1e4], ground, "", "100 rad/s");
    let found = thresholds(&workbench, "80 rad/s .. 96 rad/s, 9");
    for edge in ["edge 1", "edge 2"] {
        let known = known(&all, "asymmetric shaft and ground, 2 dof", edge);
        let fits = |own: &f64| (own / known.value - 1.0).abs() <= known.tolerance;
        assert!(found.iter().any(fits), "{edge}: {found:?}");
    }
}

/// The weight shakes it at twice its speed.
#[test]
fn weight_shakes_an_asymmetric_shaft_twice_a_turn() {
    let all = reference();
    let ground = format!("{FREE}\ndamping = {{ xx = \"4 N*s/m\", yy = \"4 N*s/m\" }}");
    let gravity = "gravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]";
    let workbench = point_mass([0.9e4, 1.1e4], &ground, gravity, "51 rad/s");
    ran(&workbench, &["response", "case.toml", "--speeds", "51 rad/s", "--out", "out"]);
    let of = |name: &str| numbers(&workbench, "out/response.csv", name);
    let points = column(&workbench, "out/response.csv", "point");
    let rows = points.iter().zip(of("order")).zip(of("major_um"));
    let own: Vec<(f64, f64)> =
        rows.filter(|own| own.0.0 == "output.mass").map(|own| (own.0.1, own.1)).collect();
    let case = "weight on an asymmetric shaft, 2 dof";
    for ((order, major), (at, quantity)) in
        own.iter().zip([(0.0, "static amplitude"), (2.0, "amplitude at twice the speed")])
    {
        let known = known(&all, case, quantity);
        assert!(*order == at && (major / known.value - 1.0).abs() <= known.tolerance, "{own:?}");
    }
    assert_eq!(own.len(), 2, "{own:?}");
}

/// A bar of 30 × 24 mm, 40 × 4 × 4 cells.
fn bar() -> String {
    let (cells, sides) = ([4, 4, 40], [0.030, 0.024, 0.8]);
    let at = |i: usize, axis: usize| {
        let middle = if axis < 2 { 0.5 } else { 0.0 };
        (i as f64 / cells[axis] as f64 - middle) * sides[axis]
    };
    let label = |[i, j, k]: [usize; 3]| 1 + i + 5 * (j + 5 * k);
    let mut text = String::from("*NODE\n");
    for k in 0..=40 {
        for j in 0..=4 {
            for i in 0..=4 {
                let place = [at(i, 0), at(j, 1), at(k, 2)];
                writeln!(text, "{}, {}, {}, {}", label([i, j, k]), place[0], place[1], place[2])
                    .unwrap();
            }
        }
    }
    text.push_str("*ELEMENT, TYPE=C3D8I, ELSET=ALL\n");
    let mut number = 0;
    for k in 0..40 {
        for j in 0..4 {
            for i in 0..4 {
                number += 1;
                let corner =
                    |a: usize, b: usize, c: usize| label([i + a, j + b, k + c]).to_string();
                let nodes = [
                    corner(0, 0, 0),
                    corner(1, 0, 0),
                    corner(1, 1, 0),
                    corner(0, 1, 0),
                    corner(0, 0, 1),
                    corner(1, 0, 1),
                    corner(1, 1, 1),
                    corner(0, 1, 1),
                ];
                writeln!(text, "{number}, {}", nodes.join(", ")).unwrap();
            }
        }
    }
    text
}

/// A body with many coordinates.
#[test]
fn a_rectangular_shaft_is_unstable_between_its_critical_speeds() {
    let joint = |name: &str, set: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", sets = \"{set}\" }}\n\
             stiffness = {{ xx = \"1e9 N/m\", yy = \"1e9 N/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"a rectangular shaft\"\n\
         [material.steel]\nyoungs_modulus = \"200e9 Pa\"\npoissons_ratio = 0.3\ndensity = \"7860 kg/m^3\"\n\
         [body.shaft]\nturns = \"prescribed\"\nspeed = \"250 rad/s\"\nmesh = \"bar.inp\"\nunits = \"m, N, kg\"\n\
         material = \"steel\"\nmodes = 12\naxial_restraint = \"LEFT\"\n\
         [body.shaft.sets]\nLEFT = {{ plane = \"0 m\" }}\nRIGHT = {{ plane = \"0.8 m\" }}\n\
         [body.shaft.disc.disc]\nmass = \"10 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n\
         transverse_inertia = \"0.03 kg*m^2\"\nz = \"0.4 m\"\n{}{}",
        joint("left", "LEFT"),
        joint("right", "RIGHT")
    );
    let workbench = Workbench::new().file("case.toml", &case).file("bar.inp", &bar());
    let found = thresholds(&workbench, "200 rad/s .. 320 rad/s, 7");
    let all = reference();
    assert_eq!(found.len(), 2, "{found:?}");
    for (found, end) in found.iter().zip(["end 1", "end 2"]) {
        let known = known(&all, "rectangular shaft 30 x 24", end);
        let apart = (found / known.value - 1.0).abs();
        assert!(apart <= known.tolerance, "{end}: {found}, {apart:e}");
    }
}

/// As it stands and in the mean over a turn, the shear along a shaft that is not round is what its weight, its disc and its joints
/// say; twice a turn that of the response changes at the disc by what moves its mass.
#[test]
fn forces_along_a_rectangular_shaft_are_those_of_statics_in_the_mean() {
    const GRAVITY: f64 = 9.81;
    let joint = |name: &str, set: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", sets = \"{set}\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"2e7 N/m\" }}\ndamping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"a rectangular shaft\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]\n\
         [material.steel]\nyoungs_modulus = \"200e9 Pa\"\npoissons_ratio = 0.3\ndensity = \"7860 kg/m^3\"\n\
         [body.shaft]\nturns = \"prescribed\"\nspeed = \"100 rad/s\"\nmesh = \"bar.inp\"\nunits = \"m, N, kg\"\n\
         material = \"steel\"\nmodes = 12\naxial_restraint = \"LEFT\"\n\
         [body.shaft.sets]\nLEFT = {{ plane = \"0 m\" }}\nRIGHT = {{ plane = \"0.8 m\" }}\n\
         [body.shaft.disc.disc]\nmass = \"10 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n\
         transverse_inertia = \"0.03 kg*m^2\"\nz = \"0.4 m\"\n{}{}",
        joint("left", "LEFT"),
        joint("right", "RIGHT")
    );
    let workbench = Workbench::new().file("case.toml", &case).file("bar.inp", &bar());
    ran(&workbench, &["forces", "case.toml", "--speed", "100 rad/s", "--out", "out"]);
    let weight = 7860.0 * 0.030 * 0.024 * GRAVITY;
    let (whole, disc) = (0.8 * weight, 10.0 * GRAVITY);
    let known = |z: f64| {
        let beyond = |place: f64| f64::from(u8::from(place > z + 1e-9));
        let reaction = 0.5 * (whole + disc);
        reaction * (beyond(0.0) + beyond(0.8)) - disc * beyond(0.4) - weight * (0.8 - z)
    };
    let along = |file: &str, order: Option<f64>| -> Vec<[Complex64; 3]> {
        let of = |name: &str| numbers(&workbench, file, name);
        let polar = |name: &str, unit: &str| -> Vec<Complex64> {
            let sizes = of(&format!("{name}_{unit}"));
            match order {
                None => sizes.into_iter().map(Complex64::from).collect(),
                Some(_) => {
                    let phases = of(&format!("{name}_deg"));
                    let both = sizes.into_iter().zip(phases);
                    both.map(|(size, own)| Complex64::from_polar(size, own.to_radians())).collect()
                }
            }
        };
        let (z, shear, moved) = (of("z_mm"), polar("shear_y", "N"), polar("uy", "um"));
        let orders = order.map(|_| of("order"));
        let is_own = |row: &usize| orders.as_ref().is_none_or(|own| Some(own[*row]) == order);
        let rows = (0..z.len()).filter(is_own);
        rows.map(|row| [(1e-3 * z[row]).into(), shear[row], 1e-6 * moved[row]]).collect()
    };
    for (file, order) in [("out/forces.csv", None), ("out/forces.response.csv", Some(0.0))] {
        let rows = along(file, order);
        assert!(rows.len() > 30, "{file}: {}", rows.len());
        for [z, shear, _] in rows {
            let known = known(z.re);
            // Of what varies with the angle, reduction leaves fast motions out.
            assert!((shear - known).norm() < 1e-3 * disc, "{file} {z}: {shear}, not {known}");
        }
    }
    let twice = along("out/forces.response.csv", Some(2.0));
    let at = twice.iter().position(|own| own[0].re > 0.4 - 1e-6).expect("a section of the disc");
    let [before, at] = [twice[at - 1], twice[at]];
    let between = weight / GRAVITY * (at[0] - before[0]);
    let square = (2.0 * 100.0_f64).powi(2);
    let moved = 10.0 * at[2] + 0.5 * between * (at[2] + before[2]);
    let (change, known) = (at[1] - before[1], -square * moved);
    assert!((change - known).norm() < 1e-2 * known.norm(), "{change}, not {known}");
}
