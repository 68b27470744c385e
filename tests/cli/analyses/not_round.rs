//! Shafts that are not round, as matrices: where they are unstable, and what is fixed to them.

use std::f64::consts::TAU;

use nalgebra::Matrix4;

use super::closed_forms::{dofs, market};
use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// A mass of 10 kg on a spring that turns, with these stiffnesses across (N/m), and a damper (N·s/m) that stands.
fn shaft(stiffness: [f64; 2], damper: f64, more: &str) -> Workbench {
    let spring = market(2, &|i, j, axis| {
        let k = [stiffness[0], stiffness[1], 1e6][axis];
        if i == j { k } else { -k }
    });
    let mass = market(2, &|i, j, _| if i == j { 10.0 } else { 0.0 });
    let case = format!(
        "title = \"a mass on a flat shaft\"\n{more}\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"300 rad/s\"\n\
         stiffening = false\nmatrices = {{ stiffness = \"K.mtx\", mass = \"M.mtx\", dofs = \"dofs.csv\" }}\n\
         units = \"m, N, kg\"\nheld = [\"NODE_1\"]\n[joint.ground]\nkind = \"bushing\"\n\
         first = {{ body = \"rotor\", sets = \"NODE_2\" }}\ndamping = {{ xx = \"{damper} N*s/m\", yy = \"{damper} N*s/m\" }}\n\
         [output.mass]\nquantity = \"displacement\"\nbody = \"rotor\"\nset = \"NODE_2\"\n"
    );
    Workbench::new()
        .file("K.mtx", &spring)
        .file("M.mtx", &mass)
        .file("dofs.csv", &dofs(&[0.0, 0.0]))
        .file("case.toml", &case)
}

/// Ω² = ½(s ∓ √(s² − 4ω₁²ω₂²)), s = ω₁² + ω₂² − (c/m)²: between steps of 20 rad/s as between those of 1 rad/s.
#[test]
fn an_interval_of_instability_between_two_speeds_is_found() {
    let (one, two, damper) = (1.0e6, 1.02e6, 20.0);
    let workbench = shaft([one, two], damper, "");
    let sum = (one + two) / 10.0 - (damper / 10.0_f64).powi(2);
    let root = (sum * sum - 4.0 * one * two / 100.0).sqrt();
    let expected = [-1.0, 1.0].map(|sign| (0.5 * (sum + sign * root)).sqrt() * 60.0 / TAU);
    for speeds in ["250 rad/s .. 390 rad/s, 8", "300 rad/s .. 330 rad/s, 31"] {
        ran(
            &workbench,
            &["stability", "case.toml", "--speeds", speeds, "--out", "out", "--no-figures"],
        );
        let found = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm");
        assert_eq!(found.len(), 2, "{speeds}: {found:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{speeds}: {found}, not {expected}");
        }
    }
}

/// The mass on its turning spring, on standing springs as well (N/m): whether a motion grows at a speed (rad/s), by powers of what a
/// period of half a turn makes of (x, y, ẋ, ẏ).
fn grows(turning: [f64; 2], standing: [f64; 2], damper: f64, speed: f64) -> bool {
    const STEPS: usize = 400;
    let (mean, half) = (0.5 * (turning[0] + turning[1]), 0.5 * (turning[0] - turning[1]));
    let slope = |time: f64, of: &Matrix4<f64>| -> Matrix4<f64> {
        let (sin, cos) = (2.0 * speed * time).sin_cos();
        let [xx, xy, yy] =
            [mean + half * cos + standing[0], half * sin, mean - half * cos + standing[1]];
        #[rustfmt::skip]
        let system = Matrix4::new(
            0.0, 0.0, 1.0, 0.0,
            0.0, 0.0, 0.0, 1.0,
            -xx / 10.0, -xy / 10.0, -damper / 10.0, 0.0,
            -xy / 10.0, -yy / 10.0, 0.0, -damper / 10.0,
        );
        system * of
    };
    let step = 0.5 * TAU / speed / STEPS as f64;
    let mut turned = Matrix4::identity();
    for k in 0..STEPS {
        let time = k as f64 * step;
        let first = slope(time, &turned);
        let second = slope(time + 0.5 * step, &(turned + 0.5 * step * first));
        let third = slope(time + 0.5 * step, &(turned + 0.5 * step * second));
        let last = slope(time + step, &(turned + step * third));
        turned += step / 6.0 * (first + 2.0 * second + 2.0 * third + last);
    }
    // x and ẋ of one size.
    let scale = (mean / 10.0).sqrt();
    for (i, j) in (0..2).flat_map(|i| (2..4).map(move |j| (i, j))) {
        turned[(i, j)] *= scale;
        turned[(j, i)] /= scale;
    }
    let mut exponent = 0.0;
    for _ in 0..40 {
        turned *= turned;
        let size = turned.norm();
        turned /= size;
        exponent = 2.0 * exponent + size.ln();
    }
    exponent > 0.0
}

/// Standing springs (N/m) below the mass, as lines of a case; none of no stiffness.
fn support([x, y]: [f64; 2]) -> String {
    if [x, y] == [0.0; 2] {
        return String::new();
    }
    format!(
        "[joint.support]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", sets = \"NODE_2\" }}\n\
         stiffness = {{ xx = \"{x} N/m\", yy = \"{y} N/m\" }}\n"
    )
}

/// A flat shaft on supports of two stiffnesses: it grows where one whirl or the other is as fast as the shaft, and where both together
/// are twice as fast; all of that lies between two speeds that are 500 rpm apart, or within 100 rpm of one of them.
#[test]
fn all_intervals_between_two_speeds_are_found_with_what_is_stable_between_them() {
    let cases = [
        ([1.0e6, 1.15e6], [2.0e5, 4.0e5], 20.0, 3),
        ([1.0e6, 1.02e6], [0.0, 3.0e5], 8.0, 3),
        ([1.0e6, 1.3e6], [1.0e5, 9.0e5], 5.0, 4),
        ([1.0e6, 1.15e6], [0.0, 0.0], 20.0, 1),
    ];
    for (turning, standing, damper, count) in cases {
        let workbench = shaft(turning, damper, &support(standing));
        for speeds in ["500 rpm .. 9500 rpm, 19", "1000 rpm .. 7000 rpm, 4"] {
            ran(
                &workbench,
                &["stability", "case.toml", "--speeds", speeds, "--out", "out", "--no-figures"],
            );
            let found = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm");
            let what = column(&workbench, "out/stability.thresholds.csv", "what");
            assert_eq!(found.len(), 2 * count, "{turning:?} {speeds}: {found:?}");
            for (k, (rpm, what)) in found.iter().zip(&what).enumerate() {
                assert_eq!(what, ["unstable above", "stable above"][k % 2], "{found:?}");
                let [below, above] = [1.0 - 1e-5, 1.0 + 1e-5]
                    .map(|share| grows(turning, standing, damper, share * rpm * TAU / 60.0));
                assert_eq!([below, above], [k % 2 == 1, k % 2 == 0], "{turning:?}: {rpm} rpm");
            }
            // Nothing grows elsewhere.
            let inside = |rpm: f64| found.chunks(2).any(|own| own[0] < rpm && rpm < own[1]);
            for rpm in (100..900).map(|k| 10.0 * f64::from(k) + 5.0) {
                let own = grows(turning, standing, damper, rpm * TAU / 60.0);
                assert_eq!(own, inside(rpm), "{turning:?}: {rpm} rpm, {found:?}");
            }
        }
    }
}

/// The first of these shafts over ranges that begin or end within an interval, or next to its end.
#[test]
fn intervals_are_found_from_any_ends_of_a_range() {
    let (turning, standing, damper) = ([1.0e6, 1.15e6], [2.0e5, 4.0e5], 20.0);
    let workbench = shaft(turning, damper, &support(standing));
    for (speeds, count) in [
        ("3400 rpm .. 3670 rpm, 2", 4),
        ("3000 rpm .. 3721.42 rpm, 2", 6),
        ("3000 rpm .. 3721.41 rpm, 2", 5),
        ("3000 rpm .. 3583.02 rpm, 2", 4),
    ] {
        ran(
            &workbench,
            &["stability", "case.toml", "--speeds", speeds, "--out", "out", "--no-figures"],
        );
        let found = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm");
        let what = column(&workbench, "out/stability.thresholds.csv", "what");
        assert_eq!(found.len(), count, "{speeds}: {found:?}");
        for (rpm, what) in found.iter().zip(&what) {
            let [below, above] = [1.0 - 1e-5, 1.0 + 1e-5]
                .map(|share| grows(turning, standing, damper, share * rpm * TAU / 60.0));
            let begins = what == "unstable above";
            assert_eq!([below, above], [!begins, begins], "{speeds}: {rpm} rpm");
        }
    }
}

/// What is fixed to the shaft turns with it: it moves nothing but once a turn.
#[test]
fn a_force_fixed_to_the_shaft_acts_once_a_turn_only() {
    let of = |load: &str| {
        let more = format!("gravity = [\"-9.81 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n{load}");
        let workbench = shaft([1.0e6, 1.2e6], 500.0, &more);
        ran(&workbench, &["response", "case.toml", "--speeds", "100 rad/s", "--out", "out"]);
        let of = |name: &str| numbers(&workbench, "out/response.csv", name);
        let (orders, points) = (of("order"), column(&workbench, "out/response.csv", "point"));
        let sizes = [of("x_um"), of("y_um")];
        [0.0, 1.0, 2.0].map(|order| {
            let is_own = |row: &usize| orders[*row] == order && points[*row] == "output.mass";
            (0..orders.len()).find(is_own).map(|row| [sizes[0][row], sizes[1][row]])
        })
    };
    let fixed = "[loads.fixed]\nbody = \"rotor\"\nsets = [\"NODE_2\"]\nforce = [\"300 N\", \"50 N\", \"0 N\"]\nframe = \"body\"\n";
    let (without, with) = (of(""), of(fixed));
    assert!(without[1].is_none() && with[1].is_some(), "{without:?} {with:?}");
    for order in [0, 2] {
        let (Some(a), Some(b)) = (without[order], with[order]) else {
            panic!("{without:?} {with:?}")
        };
        for axis in 0..2 {
            assert!((a[axis] - b[axis]).abs() < 1e-6 * a[0].abs(), "{order}: {a:?} {b:?}");
        }
    }
}
