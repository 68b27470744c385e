//! Peaks of a response over speed: those of closed forms, whatever speeds a table has.

use num_complex::Complex64;

use super::{column, numbers, ran, section};
use crate::workbench::Workbench;

/// kg, and the static unbalance of 1 g at 100 mm over it (µm).
const MASS: f64 = 10.0;
const ECCENTRICITY: f64 = 10.0;
const RPM: f64 = 30.0 / std::f64::consts::PI;

/// A mass with an unbalance on springs (N/m) and dampers (N·s/m) along x and y.
fn mass(stiffness: [f64; 2], damping: [f64; 2]) -> Workbench {
    let along = |[x, y]: [f64; 2], unit: &str| {
        format!("{{ xx = \"{x:?} {unit}\", yy = \"{y:?} {unit}\" }}")
    };
    let case = format!(
        "title = \"a mass on springs\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"10 kg\"\n\
         polar_inertia = \"0.05 kg*m^2\"\nunbalance.u = {{ mass = \"1 g\", radius = \"100 mm\" }}\n\
         [joint.spring]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\nstiffness = {}\ndamping = {}\n\
         [output.o]\nquantity = \"displacement\"\nbody = \"rotor\"\n",
        along(stiffness, "N/m"),
        along(damping, "N*s/m")
    );
    Workbench::new().file("case.toml", &case)
}

/// A row of the file of peaks.
#[derive(Debug, Clone, PartialEq)]
struct Row {
    speed: f64,
    height: f64,
    factor: f64,
    half_power: [f64; 2],
    by: String,
}

/// The peaks of the mass, and what was printed.
fn peaks(bench: &Workbench, speeds: &str) -> (Vec<Row>, String) {
    let said =
        ran(bench, &["response", "case.toml", "--speeds", speeds, "--out", "out", "--no-figures"]);
    let file = "out/response.peaks.csv";
    let of = |name: &str| numbers(bench, file, name);
    let [speeds, heights, factors] = ["speed_rpm", "major_um", "amplification_factor"].map(of);
    let [below, above] = ["half_power_below_rpm", "half_power_above_rpm"].map(of);
    let by = column(bench, file, "half_power");
    let points = column(bench, file, "point");
    let own = (0..points.len()).filter(|k| points[*k] == "output.o").map(|k| Row {
        speed: speeds[k],
        height: heights[k],
        factor: factors[k],
        half_power: [below[k], above[k]],
        by: by[k].clone(),
    });
    (own.collect(), said.stdout)
}

/// The major semi-axis (µm) at a speed (rad/s) by natural frequencies along x and y, and damping ratios.
fn major(speed: f64, along: [(f64, f64); 2]) -> f64 {
    let [x, y] = along.map(|(omega, zeta)| {
        let r = speed / omega;
        ECCENTRICITY * r * r / Complex64::new(1.0 - r * r, 2.0 * zeta * r)
    });
    // Along y it is a quarter of a turn behind.
    0.5 * ((x + y).norm() + (x - y).norm())
}

/// Bisection: where a function is zero between two places.
fn zero(of: impl Fn(f64) -> f64, [mut a, mut b]: [f64; 2]) -> f64 {
    let sign = of(a) > 0.0;
    for _ in 0..200 {
        let middle = 0.5 * (a + b);
        if (of(middle) > 0.0) == sign { a = middle } else { b = middle }
    }
    0.5 * (a + b)
}

fn near(found: f64, exact: f64, share: f64, what: &str) {
    assert!((found / exact - 1.0).abs() < share, "{what}: {found}, {exact}");
}

/// ω/√(1 − 2ζ²) with 1/(2ζ√(1 − ζ²)) eccentricities; half power where r⁴ (1 − 2/h²) − 2 (1 − 2ζ²) r² + 1 = 0. Tables of any
/// speeds give the same, to the eighth digit, as peaks are found to 1e-9 of the speed, and half powers to 1e-10 of the height.
#[test]
fn peaks_of_one_mass_do_not_depend_on_the_speeds_of_the_table() {
    let test = "peaks_of_one_mass_do_not_depend_on_the_speeds_of_the_table";
    let mut section = section("Peaks of a Jeffcott rotor", "closed form", test);
    let omega = (1e6_f64 / MASS).sqrt();
    for zeta in [1e-5, 0.002, 0.05, 0.3] {
        let damping = 2.0 * zeta * omega * MASS;
        let bench = mass([1e6, 1e6], [damping, damping]);
        let speed = omega / (1.0_f64 - 2.0 * zeta * zeta).sqrt();
        let height = 0.5 / (zeta * (1.0_f64 - zeta * zeta).sqrt());
        let off =
            |own: f64| major(own, [(omega, zeta); 2]) / ECCENTRICITY - height / 2.0_f64.sqrt();
        let below = zero(off, [0.1 * speed, speed]);
        let above = zero(off, [speed, 20.0 * speed]);
        let mut rows = Vec::new();
        for speeds in [
            "0 rpm .. 20000 rpm, 2",
            "0 rpm .. 20000 rpm, 7",
            "0 rpm .. 20000 rpm, 83",
            "111 rpm .. 19997 rpm, 3",
            "-20000 rpm .. 0 rpm, 5",
        ] {
            let (found, _) = peaks(&bench, speeds);
            let [own] = found.as_slice() else { panic!("{zeta}, {speeds}: {found:?}") };
            assert_eq!(own.by, "both", "{zeta}, {speeds}: {own:?}");
            let sides = [0, 1].map(|side| own.half_power[side].abs());
            rows.push((own.speed.abs(), own.height, own.factor, sides[0].min(sides[1])));
        }
        assert!(rows[1..3].iter().all(|own| *own == rows[0]), "{rows:?}");
        for own in &rows {
            near(own.0, speed * RPM, 1e-6 * zeta, "speed");
            near(own.1, ECCENTRICITY * height, 1e-8, "height");
            near(own.2, speed / (above - below), 1e-6, "factor");
            near(own.3, below * RPM, 1e-6 * zeta, "half power");
        }
        section.compare(&format!("ζ = {zeta}: speed (rpm)"), speed * RPM, rows[0].0, 1e-6);
        section.compare(
            &format!("ζ = {zeta}: height (µm)"),
            ECCENTRICITY * height,
            rows[0].1,
            1e-8,
        );
        section.compare(&format!("ζ = {zeta}: AF"), speed / (above - below), rows[0].2, 1e-6);
    }
    section.finish();
}

/// Supports that are not alike: a peak for each, by the major axis of the ellipse, far apart and near each other.
#[test]
fn supports_that_are_not_alike_have_a_peak_each() {
    for (ratio, zeta) in [(1.5, 0.002), (1.5, 0.03), (1.02, 2e-4), (1.0002, 1e-6)] {
        let omega = [1e6, ratio * 1e6].map(|own: f64| (own / MASS).sqrt());
        let bench = mass([1e6, ratio * 1e6], omega.map(|own| 2.0 * zeta * own * MASS));
        let of = |speed: f64| major(speed, omega.map(|own| (own, zeta)));
        let exact = omega.map(|own| {
            // The slope is zero where both sides of a small step are alike.
            let step = 1e-3 * zeta * own;
            let ends = [own * (1.0 - 0.5 * zeta), own * (1.0 + 0.5 * zeta)];
            zero(|speed| of(speed + step) - of(speed - step), ends)
        });
        for speeds in ["0 rpm .. 9000 rpm, 2", "1000 rpm .. 8000 rpm, 19"] {
            let (found, _) = peaks(&bench, speeds);
            assert_eq!(found.len(), 2, "{ratio}, {zeta}, {speeds}: {found:?}");
            for (own, exact) in found.iter().zip(exact) {
                near(own.speed, exact * RPM, 1e-3 * zeta, "speed");
                near(own.height, of(exact), 1e-5, "height");
                let half = own.half_power.map(|own| of(own / RPM) * 2.0_f64.sqrt());
                near(half[0], own.height, 1e-5, "half power below");
                near(half[1], own.height, 1e-5, "half power above");
                let factor = own.speed / (own.half_power[1] - own.half_power[0]);
                near(own.factor, factor, 1e-9, "factor");
            }
        }
    }
}

/// What a range cuts is no peak but said to be largest at its end; where one side of a peak is cut, the other one counts twice.
#[test]
fn a_range_that_cuts_a_peak_says_so() {
    let (omega, zeta) = ((1e6_f64 / MASS).sqrt(), 0.01);
    let damping = 2.0 * zeta * omega * MASS;
    let bench = mass([1e6, 1e6], [damping, damping]);
    for (speeds, end) in [
        ("0 rpm .. 3019 rpm, 30", "at 3019 rpm"),
        ("0 rpm .. 3019 rpm, 3", "at 3019 rpm"),
        ("3021 rpm .. 9000 rpm, 4", "at 3021 rpm"),
    ] {
        let (found, said) = peaks(&bench, speeds);
        assert!(found.is_empty(), "{speeds}: {found:?}");
        assert!(said.contains("no peak in this range"), "{said}");
        assert!(said.contains("largest at an end of the range, which is no peak"), "{said}");
        assert!(said.contains(&format!("output.o {end}")), "{said}");
    }
    for (speeds, side, word) in
        [("0 rpm .. 3025 rpm, 3", 0, "below"), ("3015 rpm .. 9000 rpm, 3", 1, "above")]
    {
        let (found, said) = peaks(&bench, speeds);
        let [own] = found.as_slice() else { panic!("{speeds}: {found:?}") };
        assert_eq!(own.by, word);
        let factor = own.speed / (2.0 * (own.speed - own.half_power[side]).abs());
        near(own.factor, factor, 1e-12, "factor");
        assert!(own.half_power[1 - side].is_nan(), "{own:?}");
        assert!(said.contains(&format!("(by the side {word})")), "{said}");
        assert!(said.contains("on one side only"), "{said}");
    }
}

/// Without damping nothing but rounding limits a peak: it has a speed, and no height; a table that meets it leaves it out.
#[test]
fn undamped_peaks_are_named() {
    let bench = mass([1e5, 1e5], [0.0, 0.0]);
    for speeds in
        ["0 rad/s .. 310 rad/s, 7", "0 rad/s .. 200 rad/s, 3", "10 rad/s .. 100.5 rad/s, 2"]
    {
        let (found, said) = peaks(&bench, speeds);
        let [own] = found.as_slice() else { panic!("{speeds}: {found:?}") };
        near(own.speed, 100.0 * RPM, 1e-8, "speed");
        assert!(own.height.is_infinite() && own.factor.is_infinite() && own.by == "undamped");
        assert!(said.contains("UNDAMPED peaks: joint.spring at 954.93 rpm"), "{said}");
        assert_eq!(
            said.contains("954.93 rpm is left out"),
            speeds.ends_with("200 rad/s, 3"),
            "{said}"
        );
    }
    // One direction without damping leaves the peak of the other as it is.
    let bench = mass([1e5, 4e5], [0.0, 40.0]);
    let (found, _) = peaks(&bench, "0 rad/s .. 310 rad/s, 12");
    let by: Vec<&str> = found.iter().map(|own| own.by.as_str()).collect();
    assert_eq!(by, ["undamped", "both"]);
    near(found[1].speed, 200.0 * RPM, 1e-3, "damped");
}

/// The unbalance of a round machine does not excite what whirls backwards, however light its damping is.
#[test]
fn backward_modes_of_round_machines_have_no_peaks() {
    let bench = Workbench::new();
    ran(&bench, &["analyse", "overhung-disc", "--out", "out", "--no-figures"]);
    let file = "out/campbell.critical.csv";
    let (what, whirl) = (column(&bench, file, "what"), column(&bench, file, "whirl"));
    let speeds = numbers(&bench, file, "speed_rpm");
    let of = |sense: &str| -> Vec<f64> {
        let own = (0..speeds.len()).filter(|k| what[*k] == "critical speed" && whirl[*k] == sense);
        own.map(|k| speeds[k]).collect()
    };
    let peaks = numbers(&bench, "out/response.peaks.csv", "speed_rpm");
    let is_at = |own: f64| peaks.iter().any(|peak| (peak / own - 1.0).abs() < 5e-3);
    let (backward, forward) = (of("backward"), of("forward"));
    assert!(!backward.is_empty() && !forward.is_empty());
    assert!(backward.iter().all(|own| !is_at(*own)), "{backward:?} {peaks:?}");
    assert!(forward.iter().filter(|own| **own > 600.0).all(|own| is_at(*own)), "{peaks:?}");
}
