//! The built-in machines with their analyses, against numbers that are known otherwise.

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// Files of the analyses of a case, all done at once.
fn analysed(case: &str, files: &[&str]) -> (Workbench, String) {
    let workbench = Workbench::new();
    let said = ran(&workbench, &["analyse", case, "--out", "out"]).stdout;
    for file in files {
        assert!(workbench.path(&format!("out/{file}")).is_file(), "{case}: {file}");
    }
    (workbench, said)
}

/// The closed form of a rigid rotor in Ocvirk's short bearings: the threshold is where ω²c/g = 6.41 at ε = 0.464.
#[test]
fn weight_is_unstable_above_its_threshold() {
    let files = ["campbell.svg", "stability.svg", "coefficients.svg", "response.probes.csv"];
    let (workbench, said) = analysed("weight", &files);
    assert!(said.contains("UNSTABLE above 6183.28 rpm"), "{said}");
    for (file, place) in
        [("out/stability.thresholds.csv", 0), ("out/campbell.critical.csv", usize::MAX)]
    {
        let what = column(&workbench, file, "what");
        let place = match place {
            usize::MAX => what.iter().position(|own| own == "unstable above").expect("a threshold"),
            own => own,
        };
        let speed = numbers(&workbench, file, "speed_rpm")[place];
        assert!((speed - 6183.28).abs() < 0.01, "{file}: {speed}");
    }
    // Each film carries half of the weight at every speed, against it along x.
    let [x, y] =
        ["force_x_N", "force_y_N"].map(|own| numbers(&workbench, "out/coefficients.csv", own));
    for (x, y) in x.iter().zip(&y) {
        assert!((x - 0.5 * 60.0 * 9.81).abs() < 1e-3 && y.abs() < 1e-3, "{x} {y}");
    }
    // ω²c/g at the threshold, by the growth of the least stable mode on both sides of it.
    let speed: f64 = 6183.28 * std::f64::consts::TAU / 60.0;
    assert!((speed * speed * 150e-6 / 9.81 - 6.41).abs() < 0.005);
}

/// Critical speeds are peaks of the response but for damping; the map at the stiffness of the bushings has them as well.
#[test]
fn unbalance_has_its_peaks_at_its_forward_critical_speeds() {
    let (workbench, _) = analysed("unbalance", &["map.svg", "modes.svg", "response.polar.svg"]);
    let file = "out/campbell.critical.csv";
    let whirl = column(&workbench, file, "whirl");
    let speeds = numbers(&workbench, file, "speed_rpm");
    let forward: Vec<f64> =
        whirl.iter().zip(&speeds).filter(|own| own.0 == "forward").map(|own| *own.1).collect();
    let peaks = numbers(&workbench, "out/response.peaks.csv", "speed_rpm");
    assert_eq!((forward.len(), peaks.len()), (2, 8));
    for own in forward {
        assert!(peaks.iter().any(|peak| (peak / own - 1.0).abs() < 2e-3), "{own}: {peaks:?}");
    }
    // Of 1/(2ζ), the amplification of one mass: by the decrement of the first forward mode.
    let decrement = numbers(&workbench, file, "log_decrement")[1];
    let factor = numbers(&workbench, "out/response.peaks.csv", "amplification_factor")[0];
    assert!((factor * decrement / std::f64::consts::PI - 1.0).abs() < 0.02, "{factor} {decrement}");
}

/// A disc with I_p = 2 I_d: the gyroscopic moment raises the frequency of its forward whirl and lowers that of the other.
#[test]
fn the_overhung_disc_splits_with_speed() {
    let (workbench, said) = analysed("overhung-disc", &["response.svg", "modes.svg"]);
    assert!(said.contains("4476.7"), "{said}");
    let file = "out/campbell.csv";
    let whirl = column(&workbench, file, "whirl");
    let [speed, hertz] = ["speed_rpm", "frequency_hz"].map(|own| numbers(&workbench, file, own));
    let at = |rpm: f64, sense: &str| {
        let own = (0..speed.len()).find(|k| (speed[*k] - rpm).abs() < 1e-6 && whirl[*k] == sense);
        hertz[own.expect("a mode")]
    };
    assert!(at(4000.0, "forward") > at(250.0, "forward") + 5.0);
    assert!(at(4000.0, "backward") < at(250.0, "backward") - 5.0);
    // Five of ten modes are far above all that a rotation at these speeds excites.
    let figure = std::fs::read_to_string(workbench.path("out/campbell.svg")).expect("a figure");
    assert!(figure.contains("; 5 more above"));
}

#[test]
fn floating_rings_whirl_in_the_turbocharger() {
    let (workbench, _) = analysed("turbocharger", &["campbell.svg", "stability.svg", "modes.svg"]);
    let stable = column(&workbench, "out/stability.csv", "stable");
    let speeds = numbers(&workbench, "out/stability.csv", "speed_rpm");
    let first = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm")[0];
    for (stable, speed) in stable.iter().zip(speeds) {
        assert_eq!(stable == "true", speed < first, "{speed} {first}");
    }
    // Both films whirl below half of the speed, as the march shows.
    let whirls = column(&workbench, "out/stability.csv", "whirl");
    assert!(stable.iter().zip(&whirls).all(|(stable, own)| stable == "true" || own == "forward"));
}

/// Between springs without clearance the map has the critical speeds of both spools; their ratio is that of the case.
#[test]
fn the_two_spools_have_a_diagram_and_a_map() {
    let (workbench, said) =
        analysed("two-spool", &["campbell.svg", "campbell.roots.svg", "map.svg"]);
    assert!(said.contains("speed of low"), "{said}");
    // What grows from the lowest speeds on has no threshold among those of further motions, and is said none the less.
    let said = ran(&workbench, &["stability", "two-spool", "--out", "out", "--no-figures"]).stdout;
    assert!(said.contains("UNSTABLE at 30 of these 31 speeds: at "), "{said}");
    // No mean position of a shaft that is round, whatever the films hold without load.
    ran(
        &workbench,
        &[
            "response",
            "two-spool",
            "--speeds",
            "12000 rpm .. 18000 rpm, 3",
            "--out",
            "out",
            "--no-figures",
        ],
    );
    let orders = numbers(&workbench, "out/response.csv", "order");
    let sizes = numbers(&workbench, "out/response.csv", "major_um");
    assert!(
        orders.iter().all(|own| *own == 1.0) && sizes.iter().all(|own| *own < 200.0),
        "{orders:?} {sizes:?}"
    );
    assert!(sizes.iter().filter(|own| **own > 1.0).count() > sizes.len() / 2, "{sizes:?}");
    let whirl = column(&workbench, "out/map.csv", "whirl");
    let speeds = numbers(&workbench, "out/map.csv", "speed_rpm");
    assert!(whirl.iter().any(|own| own == "backward"));
    // Held by hardly anything, all are slow; torsion of the shaft does not see the springs.
    let torsion = speeds.iter().filter(|own| (*own / 7401.35 - 1.0).abs() < 1e-4).count();
    assert_eq!(torsion, 41);
}

#[test]
fn the_crank_is_analysed_with_what_varies() {
    let (workbench, said) = analysed("crank", &["campbell.svg", "response.svg"]);
    assert!(
        said.contains("crank is not round") && said.contains("stable at all these speeds"),
        "{said}"
    );
    // The gas force acts every second turn: half orders.
    let orders = numbers(&workbench, "out/response.csv", "order");
    assert!(orders.contains(&0.5) && orders.contains(&2.5));
}

/// Five variants of one machine, whose modes differ by the loads and laws of the springs.
#[test]
fn the_paper_s_machine_is_analysed_at_speed() {
    let mut first = Vec::new();
    for case in ["hu2003-1", "hu2003-2", "hu2003-3", "hu2003-4", "hu2003-5"] {
        let (workbench, said) = analysed(case, &["campbell.svg", "modes.csv", "modes.svg"]);
        assert!(said.contains("stable at all these speeds"), "{said}");
        let speeds = numbers(&workbench, "out/modes.csv", "speed_rpm");
        assert!(speeds.iter().all(|own| (own - 4500.0).abs() < 1e-9) && speeds.len() == 10);
        first.push(numbers(&workbench, "out/modes.csv", "frequency_hz")[0]);
    }
    // The drive says nothing at a speed that is told: 1 and 2 are one machine there.
    assert!((first[0] / first[1] - 1.0).abs() < 1e-9, "{first:?}");
}
