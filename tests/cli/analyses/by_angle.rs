//! Loads that go by the angle of a body, against closed forms.

use std::f64::consts::TAU;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

const SPEED: f64 = 3000.0 * TAU / 60.0;

/// 20 kg on 1e8 N/m and 5e3 N s/m, with a load along x and what it says.
fn case(load: &str) -> String {
    format!(
        "title = \"a mass under a load by its angle\"\n[body.a]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"20 kg\"\n\
         polar_inertia = \"0.12 kg*m^2\"\n[joint.s]\nkind = \"bushing\"\nfirst = {{ body = \"a\" }}\n\
         stiffness = {{ xx = \"1e8 N/m\", yy = \"1e8 N/m\" }}\ndamping = {{ xx = \"5e3 N*s/m\", yy = \"5e3 N*s/m\" }}\n\
         [loads.gas]\nbody = \"a\"\n{load}\n[output.a]\nquantity = \"displacement\"\nbody = \"a\"\n"
    )
}

/// |x| by a force of 1 N with an order of the rotation.
fn compliance(order: f64) -> f64 {
    let omega = order * SPEED;
    1.0 / (1e8 - 20.0 * omega * omega).hypot(5e3 * omega)
}

/// Orders and amplitudes along x (m) of the output.
fn amplitudes(bench: &Workbench) -> Vec<[f64; 2]> {
    let points = column(bench, "out/response.csv", "point");
    let [order, x] = ["order", "x_um"].map(|own| numbers(bench, "out/response.csv", own));
    let rows = points.iter().zip(order.into_iter().zip(x));
    let rows = rows.filter(|own| own.0 == "output.a");
    rows.map(|(_, (order, x))| [order, 1e-6 * x]).collect()
}

fn responded(load: &str, table: &str) -> (Workbench, String) {
    let bench = Workbench::new().file("case.toml", &case(load)).file("pulse.csv", table);
    let said = ran(&bench, &["response", "case.toml", "--speeds", "3000 rpm", "--out", "out"]);
    (bench, said.stdout)
}

/// Blades and teeth have any number.
#[test]
fn loads_of_any_order_are_of_that_order() {
    for order in [0.5_f64, 1.0, 3.0, 23.0, 23.5, 24.0, 47.0, 60.0, 100.0, 250.5, -47.0] {
        let load = format!("force = [\"1000 N\", \"0 N\", \"0 N\"]\norder = {order:?}");
        let (bench, _) = responded(&load, "");
        let found = amplitudes(&bench);
        assert_eq!(found.len(), 1, "{order}: {found:?}");
        let [own, x] = found[0];
        let exact = 1000.0 * compliance(order.abs());
        assert!(
            own == order.abs() && (x / exact - 1.0).abs() < 1e-9,
            "{order}: {found:?} {exact:e}"
        );
    }
    // Fixed in the body, cos θ sin nθ and sin θ sin nθ are of the orders n − 1 and n + 1.
    let load = "force = [\"1000 N\", \"0 N\", \"0 N\"]\norder = 40\nframe = \"body\"";
    let (bench, _) = responded(load, "");
    let found = amplitudes(&bench);
    assert_eq!(found.iter().map(|own| own[0]).collect::<Vec<_>>(), [39.0, 41.0], "{found:?}");
    for [order, x] in found {
        let exact = 500.0 * compliance(order);
        assert!((x / exact - 1.0).abs() < 1e-9, "{order}: {x:e} {exact:e}");
    }
    // Beside one that has an order: what has none by halves is said.
    let both = "order = 2\nforce = [\"1 N\", \"0 N\", \"0 N\"]\n[loads.slow]\nbody = \"a\"\norder = 1.3\nforce = [\"1 N\", \"0 N\", \"0 N\"]";
    let (bench, said) = responded(both, "");
    assert_eq!(amplitudes(&bench).len(), 1);
    let (_, high) = responded(&both.replace("1.3", "1e10"), "");
    assert!(high.contains("load.slow is left out but for its mean"), "{high}");
    assert!(
        said.contains("load.slow is left out but for its mean") && said.contains("1.3"),
        "{said}"
    );
}

/// A pulse of 6° in two turns, as monotone cubics have it, by sums over a hundred thousand points; and where it is in the mean.
#[test]
fn narrow_pulses_have_all_their_orders() {
    let table = "angle [deg], force [N]\n0, 0\n352, 0\n356, 5000\n358, 0\n720, 0\n";
    let (bench, said) = responded("table = \"pulse.csv\"\nperiod = \"720 deg\"", table);
    // Both pieces are level at their ends: 3t² − 2t³.
    let value = |degrees: f64| -> f64 {
        let smooth = |t: f64| t * t * (3.0 - 2.0 * t);
        match degrees {
            352.0..356.0 => 5000.0 * smooth((degrees - 352.0) / 4.0),
            356.0..358.0 => 5000.0 * smooth((358.0 - degrees) / 2.0),
            _ => 0.0,
        }
    };
    let count = 60_000;
    let amplitude = |order: f64| -> f64 {
        let (mut re, mut im) = (0.0, 0.0);
        for k in 0..count {
            let degrees = 351.0 + 8.0 * (k as f64 + 0.5) / count as f64;
            let angle = order * degrees.to_radians();
            re += value(degrees) * angle.cos();
            im += value(degrees) * angle.sin();
        }
        2.0 * re.hypot(im) / count as f64 * 8.0 / 720.0
    };
    let found = amplitudes(&bench);
    assert!(found.iter().all(|own| own[0] > 0.0) && found.len() > 100, "{}: {said}", found.len());
    let mut compared = 0;
    for [order, x] in found.into_iter().filter(|own| own[0] <= 60.0) {
        let exact = amplitude(order) * compliance(order);
        let size = amplitude(0.5) * compliance(order);
        assert!((x - exact).abs() < 1e-5 * size, "{order}: {x:e} {exact:e}");
        compared += 1;
    }
    assert!(compared >= 90, "{compared}");
}
