//! Outputs by request, orders, spectra, and the end at the steady state.

use std::f64::consts::TAU;

use crate::workbench::{SHORT, Workbench};

/// A rigid rotor with an unbalance of 20 g mm in a bushing, shaken at 125 Hz.
const ROTOR: &str = r#"
title = "an unbalance in a bushing"

[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
mass = "2 kg"
polar_inertia = "2e-3 kg*m^2"

[body.rotor.unbalance.one]
z = "0 mm"
mass = "1 g"
radius = "20 mm"
angle = "30 deg"

[joint.front]
kind = "bushing"
first = { body = "rotor" }
stiffness = { xx = "1e6 N/m", yy = "1.2e6 N/m" }
damping = { xx = "400 N*s/m", yy = "400 N*s/m" }

[loads.shake]
body = "rotor"
direction = "x"
force = "10 N"
frequency = "125 Hz"
"#;

/// Everything that can be asked of it.
const OUTPUTS: &str = r#"
[output.u]
quantity = "displacement"
body = "rotor"

[output.v]
quantity = "velocity"
body = "rotor"

[output.turned]
quantity = "displacement"
body = "rotor"
frame = "body"

[output.f]
quantity = "force"
joint = "front"

[output.e]
quantity = "rate"
joint = "front"

[output.energy]
quantity = "energy"
body = "rotor"

[output.power]
quantity = "power"
body = "rotor"

[output.braked]
quantity = "power"
joint = "front"
"#;

const MARCH: &str = "\n[march]\ntime_step = \"5e-5 s\"\nduration = \"0.6 s\"\n";

fn done(bench: &Workbench, arguments: &[&str]) -> String {
    let outcome = bench.whirl(arguments);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    outcome.stdout
}

/// The lines of a history without their last cells.
fn first_cells(text: &str, count: usize) -> String {
    let line = |line: &str| line.split(',').take(count).collect::<Vec<&str>>().join(",") + "\n";
    text.lines().map(line).collect()
}

/// Rows are those of a run without outputs, to the byte, with further cells behind.
#[test]
fn outputs_change_nothing_that_is_computed() {
    let meshed = "\n[output.middle]\nquantity = \"acceleration\"\nbody = \"shaft\"\nset = \"LOAD1\"\n\
                  [output.mean]\nquantity = \"displacement\"\nbody = \"support\"\nset = \"BORE2_MIDDLE\"\n\
                  components = [\"x\", \"z\"]\n[output.three]\nquantity = \"deformation\"\njoint = \"3\"\n";
    for (base, more, names) in [
        (format!("{ROTOR}{MARCH}"), OUTPUTS, "x_u_um,y_u_um,vx_v_mm_s,vy_v_mm_s"),
        (
            SHORT.to_owned(),
            meshed,
            "ax_middle_m_s2,ay_middle_m_s2,x_mean_um,z_mean_um,dx_three_um,dy_three_um",
        ),
    ] {
        let bench =
            Workbench::new().file("base.toml", &base).file("more.toml", &(base.clone() + more));
        done(&bench, &["run", "base.toml", "--no-figures"]);
        done(&bench, &["run", "more.toml", "--no-figures"]);
        let [base, more] =
            ["base", "more"].map(|own| bench.history_text(&format!("results/{own}")));
        let head = base.lines().next().expect("names");
        let asked =
            more.lines().next().expect("names").strip_prefix(head).expect("they come first");
        assert!(asked.starts_with(&format!(",{names}")), "{asked}");
        assert!(first_cells(&more, head.split(',').count()) == base, "other rows");
    }
}

#[test]
fn columns_fit_together() {
    let bench = Workbench::new().file("case.toml", &format!("{ROTOR}{OUTPUTS}{MARCH}"));
    done(&bench, &["run", "case.toml", "--no-figures"]);
    let history = bench.history("results/case");
    let column = |name: &str| history.column(name).to_vec();
    let (x, y) = (column("x_u_um"), column("y_u_um"));
    assert_eq!(x, column("X_front_um"));
    assert_eq!(column("fx_f_N"), column("RX_front_N"));
    let (v, theta) = (column("vx_v_mm_s"), column("theta_rad"));
    let (turned, power) = (column("x_turned_um"), column("power_braked_W"));
    let (fx, fy, ex, ey) =
        (column("fx_f_N"), column("fy_f_N"), column("dvx_e_mm_s"), column("dvy_e_mm_s"));
    let most = v.iter().copied().fold(0.0, f64::max);
    for i in 1..x.len() - 1 {
        // Differences over 10⁻⁴ s of a wave of 125 Hz: (ωΔt)²/6 is a thousandth.
        let difference = 1e-3 * (x[i + 1] - x[i - 1]) / 1e-4;
        assert!((difference - v[i]).abs() < 2e-3 * most, "{i}: {difference} {}", v[i]);
        let (sin, cos) = theta[i].sin_cos();
        assert!((turned[i] - (cos * x[i] + sin * y[i])).abs() < 1e-7 * (1.0 + x[i].abs()));
        let expected = 1e-3 * (fx[i] * ex[i] + fy[i] * ey[i]);
        assert!((power[i] - expected).abs() < 1e-7 * (1.0 + expected.abs()), "{i}");
    }
    let kinetic = history.last("kinetic_energy_J") - 0.5 * 2e-3 * (TAU * 50.0).powi(2);
    let summary = bench.summary("results/case");
    let balance = summary["energy_balance_j"]["kinetic"].as_f64().expect("a number");
    // The balance counts from a start at which only the unbalance is added to the inertia.
    assert!(
        (kinetic - balance).abs() < 1e-6 + 0.5 * 4e-7 * (TAU * 50.0).powi(2),
        "{kinetic} {balance}"
    );
}

/// m e ω² / |k − m ω² + i c ω|, at the angle of the unbalance less the lag.
#[test]
fn the_first_order_is_that_of_the_unbalance() {
    let bench = Workbench::new().file("case.toml", &format!("{ROTOR}{OUTPUTS}{MARCH}"));
    let said = done(&bench, &["run", "case.toml"]);
    assert!(said.contains("orders of the last 2 revolutions: A cos(nθ + φ)"), "{said}");
    let summary = bench.summary("results/case");
    assert_eq!(summary["cycle"], "a common period of rotation and loads");
    let signals = summary["orders"]["signals"].as_array().expect("a list");
    let found = signals.iter().find(|own| own["signal"] == "x_u_um").expect("a signal");
    let omega = TAU * 50.0;
    let (elastic, damper) = (1e6 - 2.0 * omega * omega, 400.0 * omega);
    let amplitude = 1e6 * 2e-5 * omega * omega / elastic.hypot(damper);
    let phase = 30.0 - damper.atan2(elastic).to_degrees();
    let number = |order: &str, key: &str| found[order][key].as_f64().expect("a number");
    assert!((number("1X", "amplitude") / amplitude - 1.0).abs() < 1e-3, "{found} {amplitude}");
    assert!((number("1X", "phase_deg") - phase).abs() < 0.1, "{found} {phase}");
    assert!(number("2X", "amplitude") < 0.01 * amplitude, "{found}");
    let names = bench.listing_of("results/case");
    for name in ["spectrum.svg", "spectrum.png"] {
        assert!(names.iter().any(|own| own.ends_with(name)), "{names:?}");
    }
    assert!(!names.iter().any(|own| own.contains("waterfall")), "{names:?}");
}

#[test]
fn a_run_up_has_a_waterfall() {
    let case = format!("{ROTOR}{MARCH}")
        .replace("speed = \"3000 rpm\"", "speed = \"600 rpm\"\nacceleration = \"6000 rpm/s\"");
    let bench = Workbench::new().file("case.toml", &case);
    done(&bench, &["run", "case.toml"]);
    let svg = std::fs::read_to_string(bench.path("results/case/waterfall.svg")).expect("a figure");
    for words in ["½X", "1X", "2X", "speed (rpm)", "frequency (Hz)"] {
        assert!(svg.contains(words), "{words}");
    }
}

#[test]
fn a_run_stops_at_its_steady_state() {
    let march = MARCH.replace("0.6 s", "1.6 s");
    let bench = Workbench::new()
        .file("case.toml", &format!("{ROTOR}{march}stop_when_steady = true\n"))
        .file("whole.toml", &format!("{ROTOR}{march}"));
    let said = done(&bench, &["run", "case.toml", "--no-figures"]);
    assert!(said.contains("steady from ") && said.contains(", nothing changes any more"), "{said}");
    done(&bench, &["run", "whole.toml", "--no-figures"]);
    let (cut, whole) = (bench.history_text("results/case"), bench.history_text("results/whole"));
    assert!(cut.len() < whole.len() / 2 && whole.starts_with(&cut));
    let [cut, whole] = ["case", "whole"].map(|own| bench.summary(&format!("results/{own}")));
    assert_eq!(cut["march"]["complete"], true);
    for key in ["checked", "reached", "time_s"] {
        assert_eq!(cut["steady_state"][key], whole["steady_state"][key], "{key}");
    }
    let left =
        |summary: &serde_json::Value| summary["steady_state"]["left"].as_f64().expect("left");
    assert!(left(&whole) <= left(&cut) && left(&cut) < 0.01, "{} {}", left(&whole), left(&cut));
    let check = done(&bench, &["check", "case.toml"]);
    for words in ["a cycle is 0.040000 s", "a common period of rotation and loads", "stops at its"]
    {
        assert!(check.contains(words), "{check}");
    }
}

/// The archive for NumPy has every column, and goes with the next run that does not want it.
#[test]
fn an_archive_for_numpy_has_all_columns() {
    let case = "title = \"x\"\n[body.a]\nturns = \"no\"\nmass = \"1 kg\"\nstiffness = { x = \"1e6 N/m\", y = \"1e6 N/m\" }\n\
                [march]\ntime_step = \"1e-4 s\"\nsteps = 20\n";
    let bench = Workbench::new().file("case.toml", case);
    let run = |more: &[&str]| {
        let usual = ["run", "case.toml", "--no-figures", "--out", "out"];
        let outcome = bench.whirl(&[&usual, more].concat());
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    };
    run(&["--npz"]);
    let archive = std::fs::read(bench.path("out/history.npz")).expect("an archive");
    let head = std::fs::read_to_string(bench.path("out/history.csv")).expect("a history");
    for name in head.lines().next().expect("names").split(',') {
        let file = format!("{name}.npy");
        let count = archive.windows(file.len()).filter(|part| *part == file.as_bytes()).count();
        assert_eq!(count, 2, "{name}: in its header and in the directory");
    }
    run(&[]);
    assert!(!bench.path("out/history.npz").exists());
}

/// A mass that meets no stop is joined to nothing: its displacement is what its history is for.
#[test]
fn a_machine_without_joints_and_outputs_has_the_displacements_of_its_rigid_bodies() {
    let case = "title = \"a mass on a spring\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\ndisplacement = \"1 mm\"\n\
        [march]\ntime_step = \"1e-4 s\"\nduration = \"0.1 s\"\n";
    let of = |more: &str| {
        let bench = Workbench::new().file("case.toml", &format!("{case}{more}"));
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        bench.history("out")
    };
    let found = of("");
    assert_eq!(found.rows(), 1000);
    for (t, x) in found.column("t_s").iter().zip(found.column("x_mass_um")) {
        // (ωΔt)²/12 of the phase, 8.3e-6, is the error of the period; 10 rad at the end.
        assert!((x - 1e3 * (100.0 * t).cos()).abs() < 0.1, "{t}: {x}");
    }
    assert!(found.column("y_mass_um").iter().all(|y| *y == 0.0));
    // What is asked for comes alone.
    let energy = of("[output.e]\nquantity = \"energy\"\nbody = \"mass\"\n");
    assert!(!energy.names().iter().any(|own| own == "x_mass_um"), "{:?}", energy.names());
}

/// A damper in series with a spring, in each direction, at every spring of a bearing or once in its middle: the states of the
/// history are the displacements of the history, integrated by the trapezoidal rule.
#[test]
fn states_of_laws_are_in_the_history_by_request() {
    const TAU: f64 = 2e-3;
    let inputs = |names: [&str; 2]| {
        names.map(|own| format!("[inputs.{own}]\nunit = \"mm\"\nrange = [-1, 1]\n")).concat()
    };
    let states = ["u", "v"]
        .map(|own| format!("[states.{own}]\nunit = \"mm\"\nstart = 0\nrange = [-1, 1]\n"))
        .concat();
    let law = format!(
        "kind = \"law\"\nname = \"own\"\ntitle = \"Maxwell elements\"\nsource = \"closed form\"\n{}{states}\
         [parameters.tau]\nvalue = {TAU}\nunit = \"s\"\n[parameters.k]\nvalue = 2e4\nunit = \"N/m\"\n\
         [rates]\nu = '(e_x - u)/tau'\nv = '(e_y - v)/tau'\n\
         [outputs.F_x]\nunit = \"N\"\nvalue = '-k*(2*e_x - u)'\n[outputs.F_y]\nunit = \"N\"\nvalue = '-k*(2*e_y - v)'\n",
        inputs(["e_x", "e_y"])
    );
    let case = |law: &str, of: &str| {
        format!(
            "title = \"a mount\"\n[body.mass]\nturns = \"no\"\nmass = \"2 kg\"\n[joint.mount]\nkind = \"bearing\"\n\
             journal = {{ body = \"mass\" }}\nlaw = \"{law}\"\n{of}\
             [loads.push]\nbody = \"mass\"\nforce = [\"30 N\", \"-20 N\", \"0 N\"]\nfrequency = \"40 Hz\"\n\
             [output.own]\nquantity = \"states\"\njoint = \"mount\"\n\
             [march]\ntime_step = \"1e-4 s\"\nduration = \"0.1 s\"\n"
        )
    };
    let bench = Workbench::new().file("own.toml", &law).file("case.toml", &case("own.toml", ""));
    done(&bench, &["run", "case.toml", "--no-figures"]);
    let found = bench.history("results/case");
    for (state, moved) in [("u_own_um", "EX_mount_um"), ("v_own_um", "EY_mount_um")] {
        let (state, moved) = (found.column(state), found.column(moved));
        assert!(state.iter().any(|own| own.abs() > 100.0));
        for k in 1..found.rows() {
            let rate = |k: usize| (moved[k] - state[k]) / TAU;
            let next = state[k - 1] + 0.5e-4 * (rate(k - 1) + rate(k));
            // Ten digits of up to a millimetre.
            assert!((state[k] - next).abs() < 1e-5, "{k}: {} for {next}", state[k]);
        }
    }
    // A law of springs has its states at each of them.
    let spring = "kind = \"law\"\nname = \"own\"\ntitle = \"a creeping wall\"\nsource = \"closed form\"\n\
                  [inputs.h]\nunit = \"mm\"\nrange = [-1, 1]\n[states.s]\nunit = \"mm\"\nstart = 0\nrange = [-1, 1]\n\
                  [parameters.k]\nvalue = 1e4\nunit = \"N/m\"\n[parameters.t]\nvalue = 0.01\nunit = \"s\"\n[rates]\ns = '(h - s)/t'\n\
                  [outputs.Q]\nunit = \"N\"\nvalue = '-k*(h - s/2)'\n";
    let of = "springs = 8\nradial_clearance = \"50 um\"\nstations = [\"0 mm\"]\n";
    let bench = Workbench::new().file("own.toml", spring).file("case.toml", &case("own.toml", of));
    done(&bench, &["run", "case.toml", "--no-figures"]);
    let found = bench.history("results/case");
    let names: Vec<String> = (1..=8).map(|k| format!("s_own_{k}_um")).collect();
    for name in &names {
        assert!(found.names().contains(name), "{name}: {:?}", found.names());
    }
    // Springs across each other see opposite motions about the clearance.
    let [one, other] = [0, 4].map(|k| found.column(&names[k]).last().copied().expect("a row"));
    assert!((one - other).abs() > 1.0 && (one + other).abs() > 1.0, "{one} {other}");
    let bushing = "title = \"none\"\n[body.a]\nturns = \"no\"\nmass = \"1 kg\"\n[joint.b]\nkind = \"bushing\"\n\
                   first = { body = \"a\" }\nstiffness = { xx = \"1e4 N/m\", yy = \"1e4 N/m\" }\n\
                   [output.own]\nquantity = \"states\"\njoint = \"b\"\n[march]\ntime_step = \"1e-4 s\"\nsteps = 9\n";
    let outcome = Workbench::new().file("case.toml", bushing).whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2);
    assert!(
        outcome.stderr.contains("the law of the joint `b` has no states"),
        "{}",
        outcome.stderr
    );
}
