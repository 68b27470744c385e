//! Trains with gears: modes against equations written down here, marches against a Runge–Kutta integration of the same,
//! backlash, invariances, torsion, and what is refused.

mod marched;
mod shafts;
mod torsion;
mod train;

use std::f64::consts::TAU;

use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;
use train::{BEARINGS, COUPLINGS, INERTIA, PLAIN, RATIO, SIZE, TEETH, Train, masses, modes};

/// All modes of the equations are among those of the machine, which has the four of motor and load on their bearings beside.
#[test]
fn lateral_torsional_modes_are_those_of_the_equations() {
    for turn in [0.0, 90.0, 37.0, 211.0] {
        for pressure in [20.0, -20.0, 14.5] {
            let train = Train { turn, pressure, ..PLAIN };
            let found = modes(&train.case([0.0; 2], ""));
            let expected = train.frequencies();
            assert_eq!(expected.len(), 7, "{expected:?}");
            assert_eq!(found.len(), 7 + 4, "{found:?}");
            for hertz in expected {
                let near = found.iter().map(|own| (own / hertz - 1.0).abs()).fold(1.0, f64::min);
                assert!(near < 1e-9, "{turn}°, {pressure}°: {hertz} Hz of {found:?}");
            }
        }
    }
}

/// With stiff bearings and teeth the wheel and all behind it count by the square of the ratio.
#[test]
fn a_stiff_gear_is_the_equivalent_inertia() {
    let train = PLAIN;
    let stiff = |text: &str| {
        let text = text.replace(&format!("\"{TEETH} N/m\""), "\"1e15 N/m\"");
        let text = text.replace(&format!("\"{} N/m\"", BEARINGS[0]), "\"1e15 N/m\"");
        text.replace(&format!("\"{} N/m\"", BEARINGS[1]), "\"1e15 N/m\"")
    };
    let found = modes(&stiff(&train.case([0.0; 2], "")));
    // Motor, both gears in one, load on a coupling of i² its stiffness: two roots of a quadratic equation.
    let [motor, pinion, wheel, load] = INERTIA;
    let square = RATIO * RATIO;
    let (middle, end) = (pinion + square * wheel, square * load);
    let [k, l] = [COUPLINGS[0], square * COUPLINGS[1]];
    let b = k / motor + (k + l) / middle + l / end;
    let c = k * l * (motor + middle + end) / (motor * middle * end);
    for sign in [-1.0, 1.0] {
        let hertz = (0.5 * (b + sign * (b * b - 4.0 * c).sqrt())).sqrt() / TAU;
        let near = found.iter().map(|own| (own / hertz - 1.0).abs()).fold(1.0, f64::min);
        // What 1e15 N/m still give: k/(r² 1e15).
        assert!(near < 1e-6, "{hertz} Hz: {found:?}");
    }
}

/// The order of bodies and joints, of both gears, and the direction of the machine change nothing.
#[test]
fn the_order_of_sides_and_bodies_changes_nothing() {
    let train = Train { turn: 33.0, ..PLAIN };
    let expected = modes(&train.case([0.0; 2], ""));
    let [motor, pinion, wheel, load] = train.bodies();
    let joints = train.joints().concat();
    let swapped = train
        .gear()
        .replace("first = { body = \"pinion\" }", "first = { body = \"wheel\" }")
        .replace("second = { body = \"wheel\" }", "second = { body = \"pinion\" }")
        .replace("[20, 40]", "[40, 20]");
    for (bodies, gear) in [
        ([&load, &wheel, &pinion, &motor], train.gear()),
        ([&wheel, &motor, &load, &pinion], swapped.clone()),
        ([&motor, &pinion, &wheel, &load], swapped),
    ] {
        let bodies: String = bodies.into_iter().cloned().collect();
        let found = modes(&format!("title = \"a train\"\n{bodies}{joints}{gear}"));
        assert_eq!(found.len(), expected.len());
        for (own, other) in found.iter().zip(&expected) {
            assert!((own / other - 1.0).abs() < 1e-10, "{found:?} {expected:?}");
        }
    }
}

/// Unbalance moves both shafts through the teeth, as the equations say, and has one order.
#[test]
fn unbalance_acts_through_the_teeth() {
    let train = Train { turn: 50.0, ..PLAIN };
    let unbalance = "unbalance.own = { mass = \"3 g\", radius = \"40 mm\" }\n";
    let case = train.case([0.0; 2], "");
    let case = case.replacen("[body.pinion]\n", &format!("[body.pinion]\n{unbalance}"), 1);
    let bench = Workbench::new().file("case.toml", &case);
    let arguments = ["response", "case.toml", "--speeds", "3000 rpm", "--of", "motor"];
    ran(&bench, &[&arguments[..], &["--out", "out", "--no-figures"]].concat());
    // (K − ω²M) u of unit forces on the pinion along x and y: X = F (u_x − i u_y).
    let omega = 3000.0 * TAU / 60.0;
    let inertia = masses();
    let mut columns = [[0.0; SIZE]; SIZE];
    for (j, column) in columns.iter_mut().enumerate() {
        let mut unit = [0.0; SIZE];
        unit[j] = 1.0;
        let force = train.acceleration(&unit, &[0.0; SIZE], [0.0; 2]);
        *column = std::array::from_fn(|i| -force[i] * inertia[i]);
        column[j] -= omega * omega * inertia[j];
    }
    let solved = |place: usize| -> [f64; SIZE] {
        // Symmetric: rows are columns.
        let mut a = columns;
        let mut x = [0.0; SIZE];
        x[place] = 1.0;
        for k in 0..SIZE {
            let (first, own) = (a[k], x[k]);
            for i in k + 1..SIZE {
                let factor = a[i][k] / first[k];
                a[i].iter_mut().zip(first).for_each(|(sum, part)| *sum -= factor * part);
                x[i] -= factor * own;
            }
        }
        for k in (0..SIZE).rev() {
            let rest: f64 = (k + 1..SIZE).map(|j| a[k][j] * x[j]).sum();
            x[k] = (x[k] - rest) / a[k][k];
        }
        x
    };
    let force = 3e-3 * 0.04 * omega * omega;
    let (along, across) = (solved(4), solved(5));
    let points = column(&bench, "out/response.csv", "point");
    let orders = numbers(&bench, "out/response.csv", "order");
    assert!(orders.iter().all(|own| *own == 1.0), "{orders:?}");
    for (name, first) in [("joint.pinion", 4), ("joint.wheel", 6)] {
        let place = points.iter().position(|own| own == name).expect("a point");
        for (k, axis) in ["x_um", "y_um"].into_iter().enumerate() {
            let exact = 1e6 * force * along[first + k].hypot(across[first + k]);
            let found = numbers(&bench, "out/response.csv", axis)[place];
            assert!((found / exact - 1.0).abs() < 1e-6, "{name} {axis}: {found} {exact}");
        }
    }
}

/// A pinion by a table of its speed drives a wheel that turns freely: the wheel follows by its teeth, in the ratio at every row.
#[test]
fn a_wheel_follows_a_pinion_by_a_table() {
    let body = |name: &str, keys: &str, inertia: &str| {
        format!(
            "[body.{name}]\n{keys}\nmass = \"2 kg\"\npolar_inertia = \"{inertia} kg*m^2\"\n\
             [joint.of_{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"4e7 N/m\", yy = \"4e7 N/m\" }}\ndamping = {{ xx = \"3000 N*s/m\", yy = \"3000 N*s/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"gears by a table\"\n{}{}[joint.m]\nkind = \"gear\"\nfirst = {{ body = \"p\" }}\nsecond = {{ body = \"w\" }}\n\
         teeth = [20, 30]\nmesh_stiffness = \"2e7 N/m\"\nmesh_damping = \"5000 N*s/m\"\n\
         [march]\ntime_step = \"0.05 ms\"\nduration = \"0.1 s\"\n",
        body("p", "turns = \"prescribed\"\ntable = \"s.csv\"", "0.003"),
        body("w", "turns = \"free\"\naxis = [\"0 mm\", \"-50 mm\"]", "0.001")
    );
    let bench = Workbench::new()
        .file("case.toml", &case)
        .file("s.csv", "time [s], speed [rpm]\n0, 600\n0.03, 900\n0.07, -500\n0.2, -500\n");
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("out");
    let (first, last) = (history.column("omega_w_rad_s")[0], history.last("omega_w_rad_s"));
    let rpm = std::f64::consts::TAU / 60.0;
    assert!((first / (-400.0 * rpm) - 1.0).abs() < 0.02, "{first}");
    assert!((last / (500.0 * 2.0 / 3.0 * rpm) - 1.0).abs() < 1e-3, "{last}");
}
