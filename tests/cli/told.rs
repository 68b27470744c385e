//! What a case tells over time, angles and speeds is used as it is told: no row, period or time of it is passed over.

use crate::workbench::Workbench;

/// A rotor of 10 kg on a bushing, told or free to turn, with `more`; steps of `dt` for `duration`.
fn rotor(turns: &str, more: &str, [dt, duration]: [&str; 2]) -> String {
    format!(
        "title = \"a rotor\"\n[body.r]\n{turns}\nmass = \"10 kg\"\npolar_inertia = \"1 kg*m^2\"\n[joint.b]\n\
         kind = \"bushing\"\nfirst = {{ body = \"r\" }}\nstiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
         damping = {{ xx = \"1e4 N*s/m\", yy = \"1e4 N*s/m\" }}\n{more}\n[output.p]\nquantity = \"displacement\"\n\
         body = \"r\"\n[march]\ntime_step = \"{dt}\"\nduration = \"{duration}\"\n"
    )
}

const TOLD: &str = "turns = \"prescribed\"\nspeed = \"600 rpm\"";

#[test]
fn a_pulse_in_a_table_has_its_impulse() {
    let case = "title = \"pulse\"\n[body.m]\nturns = \"no\"\nmass = \"1 kg\"\nstiffness = { x = \"1e3 N/m\", y = \"1e3 N/m\" }\n\
                [loads.p]\nbody = \"m\"\ntable = \"t.csv\"\n[output.v]\nquantity = \"velocity\"\nbody = \"m\"\n\
                [march]\ntime_step = \"1e-4 s\"\nduration = \"0.02 s\"\n";
    for at in ["10.002", "10.0", "10.0437"] {
        let peak: f64 = at.parse().expect("a number");
        let table =
            format!("time [ms], force [N]\n{}, 0\n{peak}, 1e6\n{}, 0\n", peak - 1e-3, peak + 1e-3);
        let bench = Workbench::new().file("case.toml", case).file("t.csv", &table);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let history = bench.history("out");
        let (times, speeds) = (history.column("t_s"), history.column("vx_v_mm_s"));
        for (time, speed) in times.iter().zip(speeds) {
            let since = time - 1e-3 * peak;
            let exact = if since > 2e-6 { 1e3 * (1e3_f64.sqrt() * since).cos() } else { 0.0 };
            // 1 N s on 1 kg, and the shift of the phase by (ωΔt)²/12.
            assert!(since.abs() < 2e-6 || (speed - exact).abs() < 1e-3, "{time}: {speed} {exact}");
        }
    }
}

#[test]
fn a_table_over_an_angle_invents_nothing_between_rows_of_zero() {
    let mut table = "angle [deg], force [N]\n".to_owned();
    for angle in (0..=340).step_by(20).chain([360, 420, 440, 720]) {
        table += &format!("{angle}, {}\n", if angle == 360 { 1e4 } else { 0.0 });
    }
    let load = "[loads.g]\nbody = \"r\"\ntable = \"t.csv\"\nperiod = \"720 deg\"\n";
    let bench = Workbench::new()
        .file("case.toml", &rotor(TOLD, load, ["1e-4 s", "0.1 s"]))
        .file("t.csv", &table);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("out");
    let moved = history.column("theta_rad").iter().zip(history.column("x_p_um"));
    for (angle, x) in moved {
        assert!(angle.to_degrees() > 340.0 - 1e-6 || *x == 0.0, "{x} at {angle}");
    }
    assert!(history.column("x_p_um").iter().any(|x| *x > 1e3));
}

#[test]
fn orders_that_steps_cannot_show_are_refused_with_the_step_that_would_do() {
    let order = "[loads.g]\nbody = \"r\"\nforce = \"100 N\"\norder = 1000\nphase = \"90 deg\"\n";
    let free = "turns = \"free\"\ninitial_speed = \"600 rpm\"";
    let ramp = "turns = \"prescribed\"\nspeed = \"0 rpm\"\nacceleration = \"628.3185307 rad/s^2\"";
    let table = "turns = \"prescribed\"\ntable = \"speeds.csv\"";
    let driven = "turns = \"free\"";
    let drive = "[drives.d]\nbody = \"r\"\ntorque = \"1e3 N*m\"\ntarget_speed = \"600 rpm\"\n";
    let teeth = "[loads.g]\nbody = \"r\"\ntable = \"teeth.csv\"\nperiod = \"0.36 deg\"\n";
    let bench = || {
        Workbench::new()
            .file("speeds.csv", "time [s], speed [rpm]\n0, 0\n0.05, 600\n0.1, 0\n0.2, 9000\n")
            .file("teeth.csv", "angle [deg], force [N]\n0, 100\n0.18, -100\n0.36, 100\n")
    };
    for (turns, more) in [
        (TOLD, order.to_owned()),
        (free, order.to_owned()),
        (ramp, order.to_owned()),
        (table, order.to_owned()),
        (driven, drive.to_owned() + order),
        (TOLD, teeth.to_owned()),
    ] {
        let bench = bench()
            .file("case.toml", &rotor(turns, &more, ["1e-4 s", "0.1 s"]))
            .file("fine.toml", &rotor(turns, &more, ["4.3e-6 s", "0.1 s"]));
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 2, "{turns}: {}", outcome.stdout);
        let said =
            "a period of a load over an angle at 600 rpm of 0.0001 s takes 1 steps of `time_step`";
        assert!(outcome.stderr.contains(said), "{turns}: {}", outcome.stderr);
        assert!(outcome.stderr.contains("write `time_step = \"4.34e-6 s\"`"), "{}", outcome.stderr);
        let outcome = bench.whirl(&["check", "fine.toml"]);
        assert_eq!(outcome.status, 0, "{turns}: {}", outcome.stderr);
    }
    // What is periodic over time has as many.
    let load = "[loads.g]\nbody = \"r\"\ntable = \"t.csv\"\nperiod = \"1 ms\"\n";
    let table = "time [ms], force [N]\n0, 0\n0.5, 10\n1, 0\n";
    let bench = bench().file("case.toml", &rotor(TOLD, load, ["1e-4 s", "0.1 s"]));
    let outcome = bench.file("t.csv", table).whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stdout);
    assert!(
        outcome.stderr.contains("a period of a table over time of 0.001 s"),
        "{}",
        outcome.stderr
    );
}

/// How fast a free rotor becomes is not known before its run, which says it.
#[test]
fn a_free_rotor_that_outruns_an_order_is_not_sound() {
    let more = "[loads.g]\nbody = \"r\"\nforce = \"1 N\"\norder = 40\n[loads.m]\nbody = \"r\"\ncouple = \"2000 N*m\"\n";
    let bench =
        Workbench::new().file("case.toml", &rotor("turns = \"free\"", more, ["1e-4 s", "0.05 s"]));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let summary = bench.summary("out");
    let findings = summary["verdict"]["findings"].as_array().expect("findings");
    let found = findings.iter().find(|own| {
        own["what"].as_str().is_some_and(|what| what.starts_with("fewest steps in a period"))
    });
    let found = found.unwrap_or_else(|| panic!("{findings:?}"));
    // At 100 rad/s, 4000 rad/s of the load: 15.7 steps, and 23 with 6.8e-5 s.
    assert!((found["value"].as_f64().expect("a number") - 15.72).abs() < 0.02, "{found}");
    assert!(found["remedy"].as_str().is_some_and(|own| own.contains("6.8e-5 s")), "{found}");
}

#[test]
fn a_ramp_has_the_cycle_and_the_steps_of_its_fastest_speed() {
    let cycle = |turns: &str, dt: &str, duration: &str| {
        let bench = Workbench::new()
            .file("case.toml", &rotor(turns, "", [dt, duration]))
            .file("speeds.csv", "time [s], speed [rpm]\n0, 0\n1, 6000\n2, 6000\n");
        let outcome = bench.whirl(&["check", "case.toml"]);
        let said = outcome.stdout.split_once("a cycle is ").map(|(_, rest)| rest);
        let time = said.and_then(|rest| rest.split(" s").next()?.parse::<f64>().ok());
        (outcome.status, time)
    };
    let up = "turns = \"prescribed\"\nspeed = \"60 rpm\"\nacceleration = \"622.0353454 rad/s^2\"";
    assert_eq!(cycle(up, "1e-4 s", "1 s"), (0, Some(0.02)));
    assert_eq!(cycle(up, "1e-3 s", "1 s").0, 2, "20 steps in two revolutions");
    // No further than the run goes, and constant where a table stays as it is.
    let table = "turns = \"prescribed\"\ntable = \"speeds.csv\"";
    assert_eq!(cycle(table, "1e-4 s", "0.5 s"), (0, Some(0.04)));
    assert_eq!(cycle(table, "1e-4 s", "1.5 s"), (0, Some(0.02)));
}

/// A shaft that its start turns, in short form and by name.
#[test]
fn short_and_named_forms_have_one_cycle() {
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let line = |start: &str| {
        machine.lines().find(|line| line.starts_with(start)).expect("a line of the machine")
    };
    let short = machine
        .replace("[drive]", "[drive]\nacts = false")
        .replace(line("cycle_frequency"), "steps = 2000");
    let case = format!("title = \"a shaft\"\n{short}\n[start]\nspeed = \"3000 rpm\"\n");
    let named = rotor("turns = \"free\"\ninitial_speed = \"3000 rpm\"", "", ["1e-4 s", "0.2 s"]);
    let bench = Workbench::new().file("short.toml", &case).file("named.toml", &named);
    for name in ["short.toml", "named.toml"] {
        let outcome = bench.whirl(&["check", name]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let said = "a cycle is 0.040000 s";
        assert!(outcome.stdout.contains(said), "{name}: {}", outcome.stdout);
        assert!(outcome.stdout.contains("the cycle is two revolutions"), "{name}");
    }
}

/// Frames at times of a run that goes on: counted as rows of tables are.
#[test]
fn times_of_fields_count_from_the_first_start() {
    let mesh = include_str!("bodies/surfaces.toml");
    let joints = "[joint.left]\nkind = \"bushing\"\nfirst = { body = \"rotor\", sets = \"JOURNAL1_MIDDLE\" }\n\
                  second = { body = \"block\", sets = \"BORE1_MIDDLE\" }\nstiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\n\
                  [joint.right]\nkind = \"bushing\"\nfirst = { body = \"rotor\", sets = \"JOURNAL2_MIDDLE\" }\n\
                  second = { body = \"block\", sets = \"BORE2_MIDDLE\" }\nstiffness = { xx = \"1e7 N/m\", yy = \"1e7 N/m\" }\n";
    let case = format!("{mesh}\n{joints}");
    let times =
        |times: &str| format!("{case}[start]\nfrom = \"first\"\n[fields]\ntimes = [{times}]\n");
    let bench = Workbench::new().file("first.toml", &case);
    let outcome = bench.whirl(&["run", "first.toml", "--no-figures", "--out", "first"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let rows = bench.history("first").column("t_s").to_vec();
    let (end, step) = (rows[rows.len() - 1], rows[1] - rows[0]);
    let asked = end + 10.0 * step;
    std::fs::write(bench.path("on.toml"), times(&format!("\"{asked} s\""))).expect("written");
    let outcome = bench.whirl(&["run", "on.toml", "--no-figures", "--out", "on"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let listed = std::fs::read_to_string(bench.path("on/fields/rotor.pvd")).expect("a list");
    let frames: Vec<f64> = listed
        .lines()
        .filter_map(|line| line.split_once("timestep=\"")?.1.split('"').next()?.parse().ok())
        .collect();
    assert!(frames.len() == 1 && (frames[0] - asked).abs() < 1e-6 * step, "{listed}");
    // What the run does not reach is refused, before anything is written.
    for given in [0.5 * end, 2.0 * end + 2.0 * step] {
        std::fs::write(bench.path("on.toml"), times(&format!("\"{given} s\""))).expect("written");
        for arguments in [&["check", "on.toml"][..], &["run", "on.toml", "--out", "other"]] {
            let outcome = bench.whirl(arguments);
            assert_eq!(outcome.status, 2, "{}", outcome.stderr);
            assert!(outcome.stderr.contains("`times` has "), "{}", outcome.stderr);
        }
        assert!(!bench.path("other/history.csv").exists());
    }
}
