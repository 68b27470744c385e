//! The built-in machines of several bodies.

use crate::workbench::Workbench;

/// Runs a built-in machine, which is sound; columns of its history by name.
fn run(bench: &Workbench, case: &str) -> impl Fn(&str) -> Vec<f64> {
    let outcome = bench.whirl(&["run", case, "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
    let history = bench.history(&format!("results/{case}"));
    move |name: &str| history.column(name).to_vec()
}

/// Revolutions of a point (x, y) about the origin from a row on.
fn revolutions(x: &[f64], y: &[f64], from: usize) -> f64 {
    let angles: Vec<f64> = x.iter().zip(y).skip(from).map(|(x, y)| y.atan2(*x)).collect();
    let turn = std::f64::consts::TAU;
    let moved = angles.windows(2).map(|pair| pair[1] - pair[0]);
    moved.map(|own| own - turn * (own / turn).round()).sum::<f64>() / turn
}

/// Its rings turn far slower than the shaft, and the films whirl slower than it turns.
#[test]
fn a_turbocharger_whirls_in_its_floating_rings() {
    let bench = Workbench::new();
    let column = run(&bench, "turbocharger");
    let (t, theta, omega) = (column("t_s"), column("theta_rad"), column("omega_rad_s"));
    let last = t.len() - 1;
    let exact = (20_000.0 + 200_000.0 * t[last]) * std::f64::consts::PI / 30.0;
    assert!((omega[last] / exact - 1.0).abs() < 1e-9, "{}", omega[last]);
    for ring in ["omega_ring1_rad_s", "omega_ring2_rad_s"] {
        let ratio = column(ring)[last] / omega[last];
        assert!((0.1..0.35).contains(&ratio), "{ring}: {ratio}");
    }
    let from = last * 3 / 4;
    let turned = (theta[last] - theta[from]) / std::f64::consts::TAU;
    let whirled = revolutions(&column("EX_inner1_um"), &column("EY_inner1_um"), from) / turned;
    assert!((0.1..0.7).contains(&whirled), "{whirled} revolutions of the film a revolution");
}

/// Both spools run up as prescribed; what the damper's journal hands to the casing is what its own bearing brings, less
/// the centring spring and its inertia, and every joint carries unbalance.
#[test]
fn two_spools_run_up_in_one_casing() {
    let bench = Workbench::new();
    let column = run(&bench, "two-spool");
    let last = column("t_s").len() - 1;
    let rpm = std::f64::consts::PI / 30.0;
    assert!((column("omega_rad_s")[last] / (12_000.0 * rpm) - 1.0).abs() < 1e-9);
    assert!((column("omega_high_rad_s")[last] / (18_000.0 * rpm) - 1.0).abs() < 1e-9);
    for joint in ["front", "damper", "intershaft", "drum", "rear"] {
        let largest = |name: String| column(&name).iter().fold(0.0, |m: f64, x| m.max(x.abs()));
        assert!(largest(format!("RX_{joint}_N")) > 10.0, "{joint}");
        assert!(largest(format!("EX_{joint}_um")) < 100.0, "{joint}");
    }
}

/// The disc's unbalance of 0.16 kg mm: far below the critical speed the force grows as the square of the speed.
#[test]
fn an_overhung_disc_runs_up() {
    let bench = Workbench::new();
    let column = run(&bench, "overhung-disc");
    let (t, omega) = (column("t_s"), column("omega_rad_s"));
    let (x, y) = (column("EX_wheel_um"), column("EY_wheel_um"));
    let amplitude = |from: f64, to: f64| {
        let rows = (0..t.len()).filter(|&i| (from..to).contains(&omega[i]));
        rows.map(|i| x[i].hypot(y[i])).fold(0.0, f64::max)
    };
    let [slow, fast] = [amplitude(150.0, 200.0), amplitude(300.0, 400.0)];
    assert!(slow > 1.0 && fast > 2.0 * slow, "{slow} {fast}");
    assert!(revolutions(&x, &y, t.len() / 2) > 0.0, "it whirls forward");
}
