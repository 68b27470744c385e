//! Marches against linear analyses of the same case: what rings down, what grows, and what an unbalance keeps going.
//!
//! A march is second order in its step, so that two of them, with steps h and h/2, give what one without a step would:
//! (4 x(h/2) − x(h))/3.

mod exponents;
mod monodromy;
mod uneven;

use std::f64::consts::TAU;

use nalgebra::Complex;
use whirl_tests::History;

use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;
use exponents::{Window, amplitudes, exponents};

const ZERO: Complex<f64> = Complex::new(0.0, 0.0);

/// A push of a millisecond.
fn push(newtons: f64) -> String {
    format!("time [s], force [N]\n0, 0\n0.0005, {newtons}\n0.001, 0\n")
}

/// A load that pushes a body along x.
fn pushed(body: &str, place: &str) -> String {
    format!("[loads.push]\nbody = \"{body}\"\n{place}\ndirection = \"x\"\ntable = \"push.csv\"\n")
}

/// How a case is marched.
struct March<'a> {
    /// The case without its march.
    case: &'a str,
    /// The longer one of both steps, and how long (s).
    step: f64,
    duration: f64,
    window: Window<'a>,
}

impl March<'_> {
    /// Its histories with both steps.
    fn histories(&self, workbench: Workbench) -> (Workbench, [History; 2]) {
        let text = |step: f64| {
            let (case, duration) = (self.case, self.duration);
            format!(
                "{case}\n[march]\ntime_step = \"{step} s\"\nduration = \"{duration} s\"\n\
                 force_tolerance = \"1e-9 N\"\n"
            )
        };
        let workbench = workbench
            .file("coarse.toml", &text(self.step))
            .file("fine.toml", &text(0.5 * self.step));
        let histories = ["coarse", "fine"].map(|name| {
            let file = format!("{name}.toml");
            ran(&workbench, &["run", &file, "--out", name, "--quiet", "--no-figures"]);
            workbench.history(name)
        });
        (workbench, histories)
    }
}

/// The value without a step.
pub(crate) fn extrapolated([coarse, fine]: [Complex<f64>; 2]) -> Complex<f64> {
    (fine * 4.0 - coarse) / 3.0
}

/// The nearest one.
fn nearest(all: &[Complex<f64>], to: Complex<f64>) -> Complex<f64> {
    let apart = |own: &&Complex<f64>| (**own - to).norm();
    *all.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).expect("an exponent")
}

/// λ of modes as the analysis lists them, with how they whirl.
fn listed(workbench: &Workbench, arguments: &[&str]) -> Vec<(Complex<f64>, String)> {
    let base = ["modes", "fine.toml", "--count", "14", "--out", "modes", "--quiet"];
    ran(workbench, &[&base[..], arguments].concat());
    let [real, imaginary] =
        ["real_1_s", "imaginary_1_s"].map(|name| numbers(workbench, "modes/modes.csv", name));
    let values = real.into_iter().zip(imaginary).map(|(re, im)| Complex::new(re, im));
    values.zip(column(workbench, "modes/modes.csv", "whirl")).collect()
}

/// Which modes a march is held against: those below a frequency (Hz), in a plane or around.
struct Compared {
    below: f64,
    /// Also those that do not whirl.
    planar: bool,
    /// Share of |λ| by which they may differ.
    tolerance: f64,
    count: usize,
}

/// Holds the motion after a push against the modes.
fn rings_as_its_modes(march: &March, newtons: f64, speed: &[&str], compared: &Compared) {
    let workbench = Workbench::new().file("push.csv", &push(newtons));
    let (workbench, histories) = march.histories(workbench);
    let found = histories.map(|own| exponents(&own, &march.window));
    let mut count = 0;
    for (value, whirl) in listed(&workbench, speed) {
        let damping = -value.re / value.norm();
        let whirls = compared.planar || whirl != "-";
        if damping >= 0.1 || value.im > TAU * compared.below || !whirls {
            continue;
        }
        let own = extrapolated(found.each_ref().map(|all| nearest(all, value)));
        let apart = (own - value).norm() / value.norm();
        assert!(apart <= compared.tolerance, "mode {value}: marched {own}, {apart:e} apart");
        assert_eq!(own.re > 0.0, value.re > 0.0, "mode {value} grows or not: marched {own}");
        count += 1;
    }
    assert_eq!(count, compared.count, "modes that were compared");
}

/// A built-in case at a constant speed, with hardly any unbalance.
fn round_rotor(name: &str, rpm: f64, unbalances: &[&str], place: &str) -> String {
    let light: String = unbalances.iter().map(|own| format!("{own}.mass = \"1e-7 g\"\n")).collect();
    format!(
        "include = \"{name}.toml\"\n[body.rotor]\nacceleration = \"0 rpm/s\"\nspeed = \"{rpm} rpm\"\n\
         [body.rotor.unbalance]\n{light}{}",
        pushed("rotor", place)
    )
}

/// On both sides of its thresholds, 6183 and 10 783 rpm, it decays or grows as its modes say.
#[test]
fn a_rotor_in_films_rings_as_its_modes() {
    for rpm in [6000.0, 6121.0, 6245.0] {
        let case = round_rotor("weight", rpm, &["disc"], "z = \"100 mm\"");
        let columns = ["X_left_um", "Y_left_um", "X_right_um", "Y_right_um"];
        let window = Window { columns: &columns, from: 0.02, every: 1e-3, count: 8 };
        let march = March { case: &case, step: 5e-5, duration: 0.42, window };
        let compared = Compared { below: 60.0, planar: false, tolerance: 1e-6, count: 1 };
        rings_as_its_modes(&march, 0.2, &["--speed", &format!("{rpm} rpm")], &compared);
    }
    for rpm in [10_782.6 * 0.99, 10_782.6 * 1.01] {
        let case = round_rotor("weight", rpm, &["disc"], "z = \"100 mm\"");
        let columns = ["X_left_um", "Y_left_um", "X_right_um", "Y_right_um"];
        let window = Window { columns: &columns, from: 0.01, every: 5e-4, count: 40 };
        let march = March { case: &case, step: 1e-5, duration: 0.07, window };
        let compared = Compared { below: 95.0, planar: false, tolerance: 1e-3, count: 2 };
        rings_as_its_modes(&march, 1e-3, &["--speed", &format!("{rpm} rpm")], &compared);
    }
}

#[test]
fn flexible_rotors_ring_as_their_modes() {
    let case = round_rotor("unbalance", 6000.0, &["left", "right"], "sets = \"JOURNAL2_MIDDLE\"");
    let columns = ["x_left_um", "y_left_um", "x_right_um", "y_right_um"];
    let window = Window { columns: &columns, from: 0.02, every: 2e-4, count: 24 };
    let march = March { case: &case, step: 2e-5, duration: 0.3, window };
    let compared = Compared { below: 500.0, planar: false, tolerance: 1e-5, count: 7 };
    rings_as_its_modes(&march, 0.2, &["--speed", "6000 rpm"], &compared);

    // On both sides of its threshold, next to which the mode grows or decays by 3e-5 of its frequency, and above.
    for (rpm, tolerance) in [(5308.01 * 0.99, 3e-7), (5308.01 * 1.01, 3e-7), (6000.0, 1e-5)] {
        let case = round_rotor("overhung-disc", rpm, &["wheel"], "sets = \"JOURNAL3_MIDDLE\"");
        let columns =
            ["X_near_um", "Y_near_um", "X_far_um", "Y_far_um", "X_wheel_um", "Y_wheel_um"];
        let window = Window { columns: &columns, from: 0.02, every: 2e-4, count: 20 };
        let march = March { case: &case, step: 2e-5, duration: 0.3, window };
        let compared = Compared { below: 500.0, planar: false, tolerance, count: 4 };
        rings_as_its_modes(&march, 0.2, &["--speed", &format!("{rpm} rpm")], &compared);
    }
}

/// The built-in one, without what drives it and at a constant speed of 20000 rpm.
fn quiet_turbocharger() -> String {
    let built_in = include_str!("../../specs/cases/turbocharger.toml");
    let (machine, _) = built_in.split_once("[march]").expect("a march");
    let kept = machine.lines().filter(|line| {
        !["unbalance", "acceleration", "initial_speed"].iter().any(|own| line.starts_with(own))
    });
    kept.collect::<Vec<_>>().join("\n")
}

/// With floating rings, whose speeds are found; on both sides of its thresholds.
#[test]
fn a_turbocharger_rings_as_its_modes() {
    let machine = quiet_turbocharger();
    let columns = [
        "X_inner1_um",
        "Y_inner1_um",
        "X_inner2_um",
        "Y_inner2_um",
        "X_outer1_um",
        "Y_outer1_um",
        "X_mount1_um",
        "Y_mount1_um",
    ];
    for (rpm, below, duration, tolerance) in [
        (7521.5 * 0.99, 100.0, 0.12, 1e-5),
        (7521.5 * 1.01, 100.0, 0.12, 1e-5),
        (17340.0 * 0.99, 180.0, 0.06, 1e-3),
        (17340.0 * 1.01, 180.0, 0.06, 1e-3),
    ] {
        let speed = format!("{rpm} rpm");
        let case = format!(
            "{}[start]\nkind = \"equilibrium\"\n{}",
            machine.replace("20000 rpm", &speed),
            pushed("rotor", "sets = \"JOURNAL1_MIDDLE\"")
        );
        let window = Window { columns: &columns, from: 0.004, every: 2e-4, count: 30 };
        let march = March { case: &case, step: 1e-5, duration, window };
        let count = if below < 150.0 { 1 } else { 2 };
        let compared = Compared { below, planar: false, tolerance, count };
        rings_as_its_modes(&march, 1e-3, &["--speed", &speed], &compared);
    }
}

/// Beyond these another mode begins to grow, far more slowly than others do already.
#[test]
fn a_turbocharger_grows_as_its_modes() {
    for (rpm, grows) in [(68_670.3 * 0.99, false), (68_670.3 * 1.01, true)] {
        let case = quiet_turbocharger().replace("20000 rpm", &format!("{rpm} rpm"));
        monodromy::grows_as_its_mode(&case, rpm, 111.2, grows);
    }
}

/// Two shafts at two speeds, an intershaft bearing, a damper, a flexible casing.
#[test]
fn a_two_spool_rotor_rings_as_its_modes() {
    let case = format!(
        "include = \"two-spool.toml\"\n[start]\nkind = \"equilibrium\"\n\
         [body.low]\nacceleration = \"0 rpm/s\"\nspeed = \"12000 rpm\"\nunbalance.fan.mass = \"1e-7 g\"\n\
         [body.high]\nacceleration = \"0 rpm/s\"\nspeed = \"18000 rpm\"\nunbalance.drum.mass = \"1e-7 g\"\n{}",
        pushed("low", "sets = \"JOURNAL1_MIDDLE\"")
    );
    let columns = [
        "X_front_um",
        "Y_front_um",
        "X_damper_um",
        "Y_damper_um",
        "X_intershaft_um",
        "Y_intershaft_um",
        "X_drum_um",
        "Y_drum_um",
        "X_rear_um",
        "Y_rear_um",
    ];
    let window = Window { columns: &columns, from: 0.004, every: 1e-4, count: 48 };
    let march = March { case: &case, step: 2e-5, duration: 0.06, window };
    let compared = Compared { below: 310.0, planar: false, tolerance: 1e-3, count: 4 };
    rings_as_its_modes(&march, 1e-3, &["--speed", "18000 rpm"], &compared);

    // On both sides of the threshold of the low-pressure shaft, where the drum whirls faster and grows anyway.
    for rpm in [11_296.5 * 0.99, 11_296.5 * 1.01] {
        let case = case.replace("18000 rpm", &format!("{rpm} rpm"));
        let case = case.replace("12000 rpm", &format!("{} rpm", rpm / 1.5));
        let window = Window { columns: &columns, from: 0.004, every: 4e-4, count: 48 };
        let march = March { case: &case, step: 4e-5, duration: 0.1, window };
        let compared = Compared { below: 50.0, planar: false, tolerance: 1e-4, count: 2 };
        rings_as_its_modes(&march, 1e-5, &["--speed", &format!("{rpm} rpm")], &compared);
    }
}

/// Two shafts on gears between a motor and a fan, all of which turn freely and carry their couples: rotations and bending together.
#[test]
fn a_geared_train_rings_as_its_modes() {
    let pushes = [
        ("wheel", "x"),
        ("wheel", "y"),
        ("pinion", "x"),
        ("motor", "x"),
        ("motor", "y"),
        ("fan", "x"),
        ("fan", "y"),
    ];
    let push = |(place, (body, along)): (usize, &(&str, &str))| {
        let set = if matches!(*body, "wheel" | "pinion") { "sets = \"LOAD1\"\n" } else { "" };
        format!(
            "[loads.push{place}]\nbody = \"{body}\"\n{set}direction = \"{along}\"\ntable = \"push.csv\"\n"
        )
    };
    let case = format!(
        "include = \"geared.toml\"\n[loads.ripple]\ncouple = \"1e-9 N*m\"\n\
         [body.wheel]\nunbalance.teeth.mass = \"1e-7 g\"\n{}",
        pushes.iter().enumerate().map(push).collect::<String>()
    );
    let columns = [
        "EX_mesh_um",
        "EY_mesh_um",
        "EX_wheel1_um",
        "EY_wheel1_um",
        "EX_motor_um",
        "EY_motor_um",
        "EX_fan_um",
        "EY_fan_um",
        "MZ_input_Nm",
    ];
    let window = Window { columns: &columns, from: 0.01, every: 4e-4, count: 30 };
    let march = March { case: &case, step: 1e-5, duration: 0.15, window };
    let compared = Compared { below: 300.0, planar: true, tolerance: 1e-4, count: 6 };
    rings_as_its_modes(&march, 1.0, &["--speed", "2985 rpm", "--of", "motor"], &compared);
}

/// A flexible rotor that turns freely in bearings with states: controllers, filters and amplifiers.
#[test]
fn a_magnetic_rotor_rings_as_its_modes() {
    let push = |set: &str, along: &str| {
        format!(
            "[loads.push{set}]\nbody = \"rotor\"\nsets = \"{set}\"\ndirection = \"{along}\"\ntable = \"push.csv\"\n"
        )
    };
    let case = format!(
        "include = \"magnetic.toml\"\n[body.rotor]\nunbalance.impeller.mass = \"1e-7 g\"\n{}{}",
        push("FRONT", "x"),
        push("REAR", "y")
    );
    let columns = ["EX_front_um", "EY_front_um", "EX_rear_um", "EY_rear_um"];
    let window = Window { columns: &columns, from: 0.02, every: 1e-4, count: 30 };
    let march = March { case: &case, step: 1e-5, duration: 0.08, window };
    let compared = Compared { below: 1600.0, planar: false, tolerance: 1e-5, count: 4 };
    rings_as_its_modes(&march, 1.0, &["--speed", "18000 rpm"], &compared);
}

/// A rotor on five pads, which rock on stiff pivots: the modes of the rotor are well damped, those of the pads are not.
#[test]
fn a_rotor_on_pads_rings_as_its_modes() {
    let pads = 1..=5;
    let outputs: String = (pads.clone())
        .map(|pad| format!("[output.pad{pad}]\nquantity = \"displacement\"\nbody = \"pad{pad}\"\n"))
        .collect();
    let along = ["x", "x", "y", "x", "y"];
    let pushes: String = (pads.clone().zip(along))
        .map(|(pad, along)| {
            format!(
                "[loads.push{pad}]\nbody = \"pad{pad}\"\ndirection = \"{along}\"\ntable = \"push.csv\"\n"
            )
        })
        .collect();
    let case = format!(
        "include = \"tilting-pad.toml\"\n[body.rotor]\nunbalance.disc.mass = \"1e-9 g\"\n{outputs}{pushes}"
    );
    let columns: Vec<String> =
        pads.flat_map(|pad| ["x", "y"].map(|axis| format!("{axis}_pad{pad}_um"))).collect();
    let columns: Vec<&str> = columns.iter().map(String::as_str).collect();
    let window = Window { columns: &columns, from: 1.1e-3, every: 2e-5, count: 30 };
    let march = March { case: &case, step: 2e-6, duration: 3.5e-3, window };
    let compared = Compared { below: 7000.0, planar: true, tolerance: 1e-3, count: 5 };
    rings_as_its_modes(&march, 5.0, &["--speed", "9000 rpm"], &compared);
}

/// The machine of the paper under its static loads: standing, and at speed, where its shaft turns as it is and its modes are those
/// of one that is round: that changes them by 5e-5 (1445 1/s) to 2e-4.
#[test]
fn the_reference_machine_rings_as_its_modes() {
    let columns = ["X1_um", "Y1_um", "X2_um", "Y2_um", "X3_um", "Y3_um", "X4_um", "Y4_um"];
    for (name, speed) in [("hu2003-1", "0 rpm"), ("hu2003-2", "4500 rpm")] {
        let load = |line: &str, values: &str| format!("[[load]]\nsets = [{line}]\n{values}\n");
        let all = "\"LOAD1\", \"LOAD2\", \"LOAD3\"";
        let case = format!(
            "include = \"{name}.toml\"\n[start]\nkind = \"equilibrium\"\nspeed = \"{speed}\"\n\
             [drive]\nacts = false\n{}{}{}",
            load(all, "direction = \"x\"\nforce = \"1000 N\""),
            load("\"LOAD1\"", "direction = \"x\"\ntable = \"push.csv\""),
            load("\"LOAD1\"", "direction = \"y\"\ntable = \"push.csv\"")
        );
        let window = Window { columns: &columns, from: 0.004, every: 2e-4, count: 40 };
        let march = March { case: &case, step: 2e-5, duration: 0.06, window };
        let compared = Compared { below: 400.0, planar: true, tolerance: 2e-4, count: 5 };
        rings_as_its_modes(&march, 0.1, &["--speed", speed], &compared);
    }
}

/// A point, and its columns along x and y.
type Points<'a> = &'a [(&'a str, [&'a str; 2])];

/// Holds the motion that goes on with the rotation against the response to the same unbalance.
fn whirls_as_its_response(march: &March, rpm: f64, body: &str, points: Points, tolerance: f64) {
    let (workbench, histories) = march.histories(Workbench::new().file("push.csv", &push(0.0)));
    let turn = Complex::new(0.0, rpm * TAU / 60.0);
    let own = histories.map(|history| {
        let all = exponents(&history, &march.window);
        amplitudes(&history, &march.window, &all, turn)
    });
    let speed = format!("{rpm} rpm");
    let arguments =
        ["response", "fine.toml", "--speeds", &speed, "--of", body, "--out", "response"];
    ran(&workbench, &arguments);
    let words = |name: &str| column(&workbench, "response/response.csv", name);
    let values = |name: &str| numbers(&workbench, "response/response.csv", name);
    let rows: Vec<_> = words("body").into_iter().zip(words("point")).collect();
    let amplitude = [values("x_um"), values("y_um")];
    let phase = [values("x_phase_deg"), values("y_phase_deg")];
    for (point, columns) in points {
        let row = rows.iter().position(|own| own.0 == body && own.1 == *point);
        let row = row.unwrap_or_else(|| panic!("{point} in {rows:?}"));
        for axis in 0..2 {
            let place = march.window.columns.iter().position(|own| own == &columns[axis]);
            let place = place.expect("a column");
            let marched = extrapolated(own.each_ref().map(|own| own[place]));
            let known = Complex::from_polar(amplitude[axis][row], phase[axis][row].to_radians());
            let apart = (marched - known).norm() / known.norm();
            assert!(known != ZERO, "{point}");
            assert!(
                apart <= tolerance,
                "{point}, {axis}: marched {marched}, not {known}: {apart:e}"
            );
        }
    }
}

#[test]
fn slow_rotors_whirl_as_their_response() {
    for rpm in [1000.0, 2000.0] {
        let case = format!(
            "include = \"unbalance.toml\"\n[body.rotor]\nacceleration = \"0 rpm/s\"\nspeed = \"{rpm} rpm\"\n"
        );
        let columns = ["x_left_um", "y_left_um", "x_right_um", "y_right_um"];
        let window = Window { columns: &columns, from: 0.02, every: 2e-4, count: 24 };
        let march = March { case: &case, step: 2e-5, duration: 0.3, window };
        let points: Points = &[
            ("output.left", ["x_left_um", "y_left_um"]),
            ("output.right", ["x_right_um", "y_right_um"]),
        ];
        whirls_as_its_response(&march, rpm, "rotor", points, 1e-4);
    }
    let case = "include = \"overhung-disc.toml\"\n[body.rotor]\nacceleration = \"0 rpm/s\"\nspeed = \"1500 rpm\"\n";
    let columns = ["X_near_um", "Y_near_um", "X_far_um", "Y_far_um", "X_wheel_um", "Y_wheel_um"];
    let window = Window { columns: &columns, from: 0.02, every: 2e-4, count: 20 };
    let march = March { case, step: 2e-5, duration: 0.3, window };
    let points: Points =
        &[("joint.wheel", ["X_wheel_um", "Y_wheel_um"]), ("joint.far", ["X_far_um", "Y_far_um"])];
    whirls_as_its_response(&march, 1500.0, "rotor", points, 1e-4);

    // In films, so little that they stay linear.
    let case = "include = \"weight.toml\"\n[body.rotor]\nacceleration = \"0 rpm/s\"\nspeed = \"3000 rpm\"\n\
                unbalance.disc.mass = \"0.01 g\"\n";
    let columns = ["X_left_um", "Y_left_um", "X_right_um", "Y_right_um"];
    let window = Window { columns: &columns, from: 0.02, every: 1e-3, count: 8 };
    let march = March { case, step: 5e-5, duration: 0.42, window };
    let points: Points = &[("joint.left", ["X_left_um", "Y_left_um"])];
    whirls_as_its_response(&march, 3000.0, "rotor", points, 1e-4);
}
