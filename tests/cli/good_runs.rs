//! Runs that end well: files, tables, figures, numbers in closed form.

use std::fs;

use crate::workbench::{SHORT, Workbench};

/// Columns that every history of four supports starts with.
const FIRST_COLUMNS: &str = "t_s,theta_rad,omega_rad_s,RX1_N,RY1_N,RX2_N,RY2_N,RX3_N,RY3_N,RX4_N,RY4_N,\
X1_um,Y1_um,X2_um,Y2_um,X3_um,Y3_um,X4_um,Y4_um,EX1_um,EY1_um,EX2_um,EY2_um,EX3_um,EY3_um,EX4_um,EY4_um";

#[test]
fn an_impact_has_the_published_force() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run", "sdnd101"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("results in results/sdnd101"), "{}", outcome.stdout);
    let summary = bench.summary("results/sdnd101");
    let force = summary["supports"][0]["RX_N"]["min"].as_f64().expect("a number");
    // v0 k_contact √(m / (k + k_contact)): the manual gives 9950 N.
    assert!((force + 9950.0).abs() < 1.0, "{force} N");
    let balance = &summary["energy_balance_j"];
    let part = |name: &str| balance[name].as_f64().expect("a number");
    for nothing in ["work_in", "spring_dissipated", "dissipated"] {
        assert_eq!(part(nothing), 0.0, "{nothing}: nothing pushes the mass, nothing brakes it");
    }
    // Positions to ten digits. A step of at most 1 m/s · 20 µs that meets the stop of 1 MN/m or leaves it makes
    // at most ⅛ k d² of energy, others make none.
    let history = bench.history("results/sdnd101");
    let x: Vec<f64> = history.column("X1_um").iter().map(|x| 1e-6 * x).collect();
    let met = x.windows(2).filter(|pair| (pair[0] > 0.0) != (pair[1] > 0.0)).count();
    assert!(met > 2, "met and left {met} times");
    let made = 0.125 * 1e6 * f64::powi(1.0 * 2e-5, 2) * met as f64;
    let last = x[x.len() - 1];
    let stored = 0.5 * 1e6 * last.max(0.0).powi(2);
    let digits = 1e-8;
    assert!((part("strain") - 0.5 * 1e4 * last * last).abs() < digits, "{balance}");
    assert!((part("spring_stored") - stored).abs() < made + digits, "{balance}");
    assert!((part("kinetic") + part("strain") + stored).abs() < made + digits, "{balance}");
    for name in ["laws", "reactions", "displacement"] {
        let svg = fs::read_to_string(bench.path("results/sdnd101").join(format!("{name}.svg")));
        assert!(svg.expect("a figure").starts_with("<svg"));
        let png = fs::read(bench.path("results/sdnd101").join(format!("{name}.png")));
        assert!(png.expect("a figure").starts_with(b"\x89PNG"));
    }
}

#[test]
fn a_bounce_has_the_published_penetration() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run", "sdnd108", "--out", "here/and/there", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let summary = bench.summary("here/and/there");
    let least = summary["supports"][0]["X_um"]["min"].as_f64().expect("a number");
    assert!((-1e-6 * least - 2.74807).abs() < 1e-4, "{least} µm");
    let mut files: Vec<_> = fs::read_dir(bench.path("here/and/there"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").file_name().into_string().expect("UTF-8"))
        .collect();
    files.sort();
    assert_eq!(files, ["about.json", "history.csv", "report.html", "state.bin", "summary.json"]);
}

#[test]
fn a_rub_all_around_has_the_amplitude_of_the_closed_form() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run", "annular-rub"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let summary = bench.summary("results/annular-rub");
    let statistic =
        |column: &str, of: &str| summary["supports"][0][column][of].as_f64().expect("a number");
    // |D| r = m e Ω², D = k + k_c (1 − c/r) − mΩ² + i dΩ, at r = 1.078299 mm, N = k_c (r − c) = 7.8299 N.
    // Steps of 1e-4 s raise Ω² by (ΩΔt)²/6 = 2e-5; with ∂(|D| r)/∂r = 91 kN/m that is 2.5e-6 of r and, times
    // r/(r − c), 3.4e-5 of N. A step may miss the end of the circle by (ΩΔt/2)²/2 = 1.5e-5.
    for axis in ["X_um", "Y_um"] {
        assert!((statistic(axis, "max") / 1078.299 - 1.0).abs() < 2e-5, "{}", outcome.stdout);
        assert!((statistic(axis, "min") / -1078.299 - 1.0).abs() < 2e-5, "{}", outcome.stdout);
    }
    for axis in ["RX_N", "RY_N"] {
        assert!((statistic(axis, "max") / 7.8299 - 1.0).abs() < 6e-5, "{}", outcome.stdout);
    }
    assert_eq!(summary["steady_state"]["reached"], true, "{}", outcome.stdout);
}

#[test]
fn a_shaft_rubs_and_runs_in_rings() {
    for (law, more) in [("rub-coulomb", ""), ("ocvirk", "journal_radius = \"34 mm\"")] {
        let case = format!(
            "include = \"hu2003-5.toml\"\ntitle = \"a short run\"\n[springs]\nlaw = \"{law}\"\n{more}\n\
             [march]\nsteps = 40\n"
        );
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let summary = bench.summary("results/case");
        let balance = &summary["energy_balance_j"];
        let part = |name: &str| balance[name].as_f64().expect("a number");
        // The balance closes to second order in the step; the loads did some tenths of a joule.
        assert!(part("error").abs() < 1e-3 * part("work_in").abs(), "{law}: {balance}");
    }
}

/// The column of a torque holds the law's own, without the moment of its forces about the axis.
#[test]
fn a_torque_has_a_column_of_its_own() {
    let law = "kind = \"law\"\nname = \"ring\"\ntitle = \"a ring\"\nsource = \"a test\"\n\
               inputs = { e_x = { unit = \"mm\", range = [-2, 2] }, e_y = { unit = \"mm\", range = [-2, 2] } }\n\
               [outputs.F_x]\nunit = \"N\"\nvalue = '-100*e_x'\n\
               [outputs.F_y]\nunit = \"N\"\nvalue = '-50*e_y - 3*e_x'\n\
               [outputs.M_z]\nunit = \"N*mm\"\nvalue = '7*e_x'\n";
    let case = "title = \"a ring with a torque\"\n[mass]\nmass = \"1 kg\"\ndisplacement = \"1 mm\"\n\
                unbalance = { eccentricity = \"0.5 mm\", speed = \"110 rad/s\" }\n\
                [[stop]]\nside = \"around\"\nlaw = \"ring.toml\"\n\
                [march]\ntime_step = \"1e-4 s\"\nsteps = 200\n";
    let bench = Workbench::new().file("ring.toml", law).file("case.toml", case);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("results/case");
    let column = |name: &str| history.column(name);
    for (torque, x) in column("MZ1_Nm").iter().zip(column("EX1_um")) {
        // Ten digits are written; e × F, which is taken off, is as large as 0.3 N·m.
        assert!((torque - 7e-6 * x).abs() < 1e-9, "{torque} N·m at {x} µm");
    }
    let turned = column("EY1_um").iter().any(|y| y.abs() > 100.0);
    assert!(turned, "the forces have a moment about the axis");
}

#[test]
fn a_run_of_the_reference_machine_writes_everything() {
    let bench = Workbench::new().file("case.toml", SHORT);
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("Bearing 4"), "{}", outcome.stdout);
    let history = bench.history_text("results/case");
    assert!(history.starts_with(FIRST_COLUMNS));
    assert_eq!(history.lines().count(), 41);
    let summary = bench.summary("results/case");
    let shaft = &summary["counts"]["shaft"];
    let numbers = |body: &serde_json::Value| {
        let keys =
            ["elements", "nodes", "physical_dofs", "internal_dofs", "retained_dofs", "modes"];
        keys.map(|key| body[key].as_u64().expect("a count"))
    };
    assert_eq!(numbers(shaft), [1824, 1925, 5775, 5748, 27, 50]);
    assert_eq!(numbers(&summary["counts"]["support"]), [2752, 4269, 12807, 12798, 9, 150]);
    assert_eq!(summary["counts"]["coordinates"], 237);
    assert_eq!(summary["counts"]["active"], 226);
    assert_eq!(summary["supports"].as_array().expect("a list").len(), 4);
    let time = &summary["time"];
    for key in
        ["simulated_s", "reduction_wall_s", "march_wall_s", "total_wall_s", "real_time_factor"]
    {
        assert!(time[key].is_f64(), "{key}: {time}");
    }
}

#[test]
fn a_law_by_path_gives_the_bits_of_the_compiled_one() {
    let law = include_str!("../../specs/laws/hu2003-nonlinear.toml");
    let named = |law: &str| format!("{SHORT}\n[springs]\nlaw = \"{law}\"\n");
    let bench = Workbench::new()
        .file("law.toml", law)
        .file("file.toml", &named("law.toml"))
        .file("compiled.toml", &named("hu2003-nonlinear"));
    for case in ["file", "compiled"] {
        let outcome = bench.whirl(&["run", &format!("{case}.toml"), "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    assert_eq!(bench.history_text("results/file"), bench.history_text("results/compiled"));
}

#[test]
fn what_was_computed_is_kept_when_a_step_does_not_converge() {
    // The force pushes the mass onto the place where the law jumps: no displacement balances it.
    let law = "kind = \"law\"\nname = \"jump\"\ntitle = \"jump\"\nsource = \"a test\"\n\n\
               [inputs.h]\nunit = \"m\"\n\n[outputs.Q]\nunit = \"N\"\njump = \"accept\"\n\
               pieces = [{ when = 'h < 0', value = '100' }, { value = '0' }]\n";
    let case = "title = \"a jump\"\n\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e6 N/m\"\n\
                damping = \"1e5 N*s/m\"\nforce = \"50 N\"\n\n\
                [[stop]]\nside = \"above\"\ngap = \"1 um\"\nlaw = \"law.toml\"\n\n\
                [march]\ntime_step = \"1e-2 s\"\nsteps = 100\n";
    let bench = Workbench::new().file("case.toml", case).file("law.toml", law);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "kept"]);
    assert_eq!(outcome.status, 1, "{}{}", outcome.stdout, outcome.stderr);
    assert!(outcome.stderr.contains("does not converge"), "{}", outcome.stderr);
    let summary = bench.summary("kept");
    assert_eq!(summary["march"]["converged"], false);
    assert!(summary["error"].as_str().expect("words").contains("does not converge"));
    assert!(bench.history_text("kept").starts_with("t_s,"));
}

/// One set three times, with the station in its plane: one ring of springs. Where it is in the middle of three, it
/// carries what a bearing of these three does with this station alone.
#[test]
fn a_bearing_in_one_plane_has_one_ring() {
    let z = [24, 476, 928, 1380];
    let bearing = |sets: fn(&str, usize) -> [String; 3]| -> String {
        let table = |k: usize| {
            let [journal, bore] = ["JOURNAL", "BORE"].map(|name| sets(name, k));
            let z = z[k - 1];
            format!(
                "[[bearing]]\njournal = {journal:?}\nbore = {bore:?}\nstations = [\"{z} mm\"]\n"
            )
        };
        (1..=4).map(table).collect()
    };
    let one = bearing(|name, k| [(); 3].map(|()| format!("{name}{k}_MIDDLE")));
    let three =
        bearing(|name, k| ["LEFT", "MIDDLE", "RIGHT"].map(|end| format!("{name}{k}_{end}")));
    // Retained dofs of the ends change the modes: few of them, compared with what the statics say.
    let lines = SHORT.replace("steps = 40", "steps = 400").replace("hu2003-5", "hu2003-1");
    let bench = Workbench::new()
        .file("one.toml", &format!("{lines}{one}"))
        .file("three.toml", &format!("{lines}{three}"));
    let means = ["one", "three"].map(|name| {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let summary = bench.summary(&format!("results/{name}"));
        assert_eq!(summary["counts"]["springs"], 96);
        [0, 1, 2, 3].map(|k| summary["supports"][k]["RX_N"]["mean"].as_f64().expect("a mean"))
    });
    let total: f64 = means[0].iter().sum();
    assert!(total < -1000.0, "the bearings carry the load: {means:?}");
    for (one, three) in means[0].iter().zip(means[1]) {
        // Constraint modes are exact in statics; what still swings differs by the modes left out.
        assert!((one - three).abs() < 1e-4 * total.abs(), "{means:?}");
    }
}

#[test]
fn check_says_what_would_be_run() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["check", "hu2003-5", "--laws"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for words in [
        "226 active coordinates",
        "12807",
        "109 N m until 4500 rpm",
        "load 1 on shaft at each node of LOAD1, LOAD2, LOAD3: 1000 N along x, sine of 37.5 Hz",
        "law hu2003-nonlinear, c = 35.687 µm, 3 rings of 24 springs at z = 463.5, 476, 488.5 mm",
        "moved from 0.035687",
        "5405 steps of 7.4e-5 s",
    ] {
        assert!(outcome.stdout.contains(words), "`{words}` is not in:\n{}", outcome.stdout);
    }
    // What an engineer asks comes first; of a law that has nothing remarkable nothing is said unasked.
    let mut rest = outcome.stdout.as_str();
    for head in
        ["Bodies", "Natural frequencies", "Speeds", "Joints", "Loads", "Time", "Model", "law hu"]
    {
        let place = rest.find(&format!("\n\n{head}"));
        rest = &rest[place.unwrap_or_else(|| panic!("{head} in\n{}", outcome.stdout))..];
    }
    let unasked = bench.whirl(&["check", "hu2003-5"]).stdout;
    assert_eq!(unasked, outcome.stdout.split("\nlaw hu").next().expect("a text"));
    assert!(bench.listing().is_empty());
}

#[test]
fn list_names_what_is_built_in() {
    let outcome = Workbench::new().whirl(&["list"]);
    let names = ["hu2003-5", "sdnd101", "hu2003-linear", "hex8i", "wedge6", "consistent"];
    let elements = ["hex20", "wedge15", "tet4", "tet10", "pyramid5"];
    for name in names.into_iter().chain(elements) {
        assert!(outcome.stdout.contains(name), "`{name}` is not in:\n{}", outcome.stdout);
    }
}

#[test]
fn a_drive_of_either_sign_ends_at_its_target() {
    let speeds = ["", "-"].map(|sign| {
        let case = format!(
            "include = \"hu2003-2.toml\"\ntitle = \"the other way\"\n[drive]\ntorque = \"{sign}109 N*m\"\n\
             target_speed = \"{sign}100 rpm\"\n[march]\nsteps = 60\n"
        );
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        bench.history("results/case").last("omega_rad_s")
    });
    let target = 100.0 * std::f64::consts::TAU / 60.0;
    // The couple stops up to a step late.
    assert!(speeds[0] >= 0.9 * target && speeds[0] < 1.15 * target, "{speeds:?}");
    assert!((speeds[0] + speeds[1]).abs() < 1e-3 * target, "{speeds:?}");
}

/// Rest repeats itself, but a load, a ramp or a drive that is still to come makes it no steady state.
#[test]
fn what_is_still_to_come_is_waited_for() {
    let case = |rest: &str| {
        format!(
            "title = \"a wheel on springs\"\n[body.wheel]\nturns = \"free\"\nmass = \"2 kg\"\n\
             polar_inertia = \"1e-2 kg*m^2\"\n[joint.spring]\nkind = \"bushing\"\nfirst = {{ body = \"wheel\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
             damping = {{ xx = \"2e3 N*s/m\", yy = \"2e3 N*s/m\" }}\n{rest}\n\
             [march]\ntime_step = \"1e-4 s\"\nduration = \"0.8 s\"\ncycle_frequency = \"100 Hz\"\n\
             stop_when_steady = true\n"
        )
    };
    let load = "[loads.push]\nbody = \"wheel\"\nforce = \"100 N\"\n";
    let drive = "[drives.motor]\nbody = \"wheel\"\ntorque = \"0.5 N*m\"\n";
    let turns = "[drives.motor]\nbody = \"wheel\"\ntorque = \"50 N*m\"\ntarget_speed = \"1 rpm\"\n";
    let ends = |rest: &str| -> f64 {
        let bench = Workbench::new().file("case.toml", &case(rest));
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        *bench.history("out").column("t_s").last().expect("a row")
    };
    let at_once = ends(&format!("{turns}{load}"));
    // Seventeen cycles after what is waited for, and one to begin with.
    assert!(at_once < 0.18 + 5e-5, "{at_once}");
    let stepped = ends(&format!("{turns}{load}start = \"0.2 s\"\n"));
    assert!(stepped > 0.2 && stepped < 0.38 + 5e-5, "{stepped}");
    let ramped = ends(&format!("{turns}{load}ramp = [\"0.1 s\", \"0.3 s\"]\n"));
    assert!(ramped > 0.3 && ramped < 0.48, "{ramped}");
    // 4 rad/s after 0.08 s.
    let driven = ends(&format!("{drive}target_speed = \"10 rad/s\"\n{load}"));
    assert!(driven > 0.2 && driven < 0.38, "{driven}");
}
