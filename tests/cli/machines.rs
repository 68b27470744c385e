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

/// Largest distance from the mean in rows from one on, before another.
fn swing(x: &[f64], rows: std::ops::Range<usize>) -> f64 {
    let own = &x[rows];
    let mean = own.iter().sum::<f64>() / own.len() as f64;
    own.iter().fold(0.0, |most, value| f64::max(most, (value - mean).abs()))
}

/// Both critical speeds show in the motion of the discs, with quiet between and beyond them.
#[test]
fn an_unbalanced_rotor_runs_through_two_critical_speeds() {
    let bench = Workbench::new();
    let column = run(&bench, "unbalance");
    let omega = column("omega_rad_s");
    let (x, y) = (column("x_left_um"), column("y_left_um"));
    let amplitude = |from: f64, to: f64| {
        let rows = (0..x.len())
            .filter(|&i| (from..to).contains(&(omega[i] * 30.0 / std::f64::consts::PI)));
        rows.map(|i| x[i].hypot(y[i])).fold(0.0, f64::max)
    };
    let bands = [(500.0, 1500.0), (1800.0, 3200.0), (4500.0, 6500.0), (7000.0, 11_000.0)];
    let [before, first, between, second] = bands.map(|(from, to)| amplitude(from, to));
    assert!(first > 10.0 * before && first > 1.5 * between, "{before} {first} {between}");
    assert!(second > 3.0 * between, "{between} {second}");
}

/// From equilibrium the journal hardly moves until, beyond the threshold of linear theory (6183 rpm), it whirls at half the
/// speed of the shaft.
#[test]
fn a_heavy_rotor_begins_in_equilibrium_and_whirls_in_its_films() {
    let bench = Workbench::new();
    let column = run(&bench, "weight");
    let (t, theta, force) = (column("t_s"), column("theta_rad"), column("RX_left_N"));
    let (x, y) = (column("EX_left_um"), column("EY_left_um"));
    let last = t.len() - 1;
    // Each bearing carries half of the weight of 60 kg from the first row on.
    assert!((force[0] / (30.0 * 9.81) - 1.0).abs() < 1e-2, "{}", force[0]);
    let row = |rpm: f64| ((rpm - 3000.0) / 2500.0 / 1e-4) as usize;
    let quiet = swing(&x, row(5800.0)..row(6000.0));
    let whirling = swing(&x, last - 1000..last);
    assert!(quiet < 8.0 && whirling > 100.0, "{quiet} {whirling}");
    let turned = (theta[last] - theta[last - 1000]) / std::f64::consts::TAU;
    let whirled = revolutions(&x, &y, last - 1000) / turned;
    assert!((whirled - 0.5).abs() < 0.03, "{whirled}");
}

/// A four-stroke cycle is two revolutions, after which the orbits close; on the mean the bearings carry what the loads are.
#[test]
fn a_crank_closes_its_orbits_every_second_revolution() {
    let bench = Workbench::new();
    let column = run(&bench, "crank");
    let cycle = 3000;
    let last = column("t_s").len() - 1;
    for name in ["EX_main1_um", "EY_main2_um"] {
        let own = column(name);
        let apart = (last - cycle..last).map(|i| (own[i] - own[i - cycle]).abs());
        let apart = apart.fold(0.0, f64::max);
        let size = swing(&own, last - cycle..last);
        assert!(size > 20.0 && apart < 0.01 * size, "{name}: {apart} of {size}");
    }
    let mean = |name: &str| column(name)[last - cycle..last].iter().sum::<f64>() / cycle as f64;
    let table = include_str!("../../specs/cases/crank.gas.csv");
    let rows = table.lines().skip(2).map(|line| line.split(", ").nth(1).expect("a force"));
    let forces: Vec<f64> = rows.map(|force| force.parse().expect("a number")).collect();
    // The mean of a periodic curve is that of its rows but the last; the piston's inertia has none.
    let gas = forces[1..].iter().sum::<f64>() / (forces.len() - 1) as f64;
    let carried = mean("RX_main1_N") + mean("RX_main2_N");
    assert!((carried / -gas - 1.0).abs() < 0.02, "{carried} {gas}");
}

/// The teeth carry the couples from the first row on, and the ripple of the motor passes through them.
#[test]
fn gears_carry_what_the_motor_gives() {
    let bench = Workbench::new();
    let column = run(&bench, "geared");
    let (first, second) = (column("omega_rad_s"), column("omega_wheel_rad_s"));
    let moments = column("MZ_mesh_Nm");
    assert!((moments[0] / -320.0 - 1.0).abs() < 1e-3, "{}", moments[0]);
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let half = moments.len() / 2;
    assert!((mean(&moments[half..]) / -320.0 - 1.0).abs() < 0.01, "{}", mean(&moments[half..]));
    assert!(moments[half..].iter().any(|own| (own + 320.0).abs() > 2.0), "the ripple");
    let ratio = mean(&second[half..]) / mean(&first[half..]);
    assert!((ratio / (-23.0 / 67.0) - 1.0).abs() < 1e-3, "{ratio}");
    let turned = |name: &str| column(name).last().copied().expect("a row");
    let angles = turned("theta_wheel_rad") / turned("theta_pinion_rad");
    assert!((angles / (-23.0 / 67.0) - 1.0).abs() < 1e-3, "{angles}");
}

/// Magnets carry the weight, and the unbalance moves the journals as the linear response says; the races stand.
#[test]
fn magnets_hold_a_rotor_at_speed() {
    let bench = Workbench::new();
    let column = run(&bench, "magnetic");
    // Two revolutions at 300 Hz.
    let last = |name: &str| column(name)[column(name).len() - 333..].to_vec();
    let mean = |name: &str| last(name).iter().sum::<f64>() / 333.0;
    let steel = 7800.0 * std::f64::consts::FRAC_PI_4;
    let shaft = 0.12 * 0.03_f64.powi(2) + 0.12 * 0.07_f64.powi(2) + 0.24 * 0.05_f64.powi(2);
    let weight = 9.81 * (steel * shaft + 1.5);
    let carried = mean("RX_front_N") + mean("RX_rear_N");
    assert!((carried / weight - 1.0).abs() < 2e-3, "{carried} of {weight}");
    for name in ["RX_touch_front_N", "RX_touch_rear_N", "omega_race_front_rad_s"] {
        assert!(column(name).iter().all(|own| *own == 0.0), "{name}");
    }
    let outcome = bench.whirl(&["analyse", "magnetic", "response", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let summary = bench.summary("results/magnetic");
    let (points, speeds) = (columns(&bench, "point"), columns(&bench, "speed_rpm"));
    for joint in ["front", "rear"] {
        let at = (0..points.len()).find(|place| {
            points[*place] == format!("joint.{joint}")
                && (speeds[*place].parse::<f64>().expect("rpm") - 18_000.0).abs() < 1e-6
        });
        let exact: f64 = columns(&bench, "x_um")[at.expect("a row")].parse().expect("um");
        let signals = summary["orders"]["signals"].as_array().expect("signals");
        let own = signals.iter().find(|own| own["signal"] == format!("X_{joint}_um"));
        let found = own.expect("a signal")["1X"]["amplitude"].as_f64().expect("um");
        assert!((found / exact - 1.0).abs() < 1e-3, "{joint}: {found} for {exact}");
    }
}

/// Cells of a column of the response in `out`.
fn columns(bench: &Workbench, name: &str) -> Vec<String> {
    crate::analyses::column(bench, "out/response.csv", name)
}

/// Without its front magnets the rotor falls freely, bounces in its touchdown bearing, and turns the race by friction: what the
/// race gains of angular momentum the rotor loses, but for the lever of its own displacement, 1 % of its radius.
#[test]
fn a_rotor_drops_on_its_touchdown_bearing() {
    let bench = Workbench::new();
    let column = run(&bench, "magnetic-drop");
    let (t, x) = (column("t_s"), column("EX_touch_front_um"));
    let first = x.iter().position(|own| *own < -200.0).expect("it falls on its bearing");
    // The front end of a free rod of this mass falls with between g and 1.5 g, less what the rear magnets hold.
    let free = |g: f64| (2.0 * 200e-6 / g).sqrt();
    assert!((free(1.5 * 9.81)..1.6 * free(9.81)).contains(&t[first]), "{}", t[first]);
    let again = x[first..].iter().any(|own| *own > -150.0);
    assert!(again, "it bounces");
    assert!(column("EX_touch_rear_um").iter().all(|own| own.abs() < 60.0), "the rear is held");
    let end = t.len() - 1;
    let rotor = 8.4294e-3 * (300.0 * std::f64::consts::TAU - column("omega_rad_s")[end]);
    let race = 2e-5 * column("omega_race_front_rad_s")[end];
    assert!(race > 5e-3, "{race}");
    assert!((rotor / race - 1.0).abs() < 0.03, "{rotor} {race}");
}

/// The rear race touches nothing: no torque holds its angle, which the mean position of the springs around the front one leaves as
/// it is.
#[test]
fn a_race_that_nothing_touches_is_no_critical_speed() {
    let bench = Workbench::new();
    let speeds = ["--speeds", "18000 rpm .. 22500 rpm, 4"];
    let said = bench.whirl(&[&["response", "magnetic-drop", "--no-figures"], &speeds[..]].concat());
    assert_eq!(said.status, 0, "{}", said.stderr);
    assert!(!said.stdout.contains("is left out"), "{}", said.stdout);
    assert!(said.stdout.contains("order 1 of rotor"), "{}", said.stdout);
    // From 0 rpm on it stands.
    let said = bench.whirl(&[
        "response",
        "magnetic-drop",
        "--speeds",
        "0 rpm .. 6000 rpm, 5",
        "--no-figures",
    ]);
    assert_eq!(said.status, 0, "{}", said.stderr);
    assert!(said.stdout.contains("0 rpm is left out"), "{}", said.stdout);
}
