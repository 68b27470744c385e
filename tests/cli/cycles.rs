//! The cycle of a case that gives no `cycle_frequency`: the period after which rotation and loads are as they were.

use crate::workbench::Workbench;

/// A rotor at 3000 rpm, 20 ms a revolution, with `more`.
fn rotor(more: &str) -> String {
    format!(
        "title = \"a rotor on a bushing\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"2 kg\"\n\
         polar_inertia = \"2e-3 kg*m^2\"\n[joint.front]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1.2e6 N/m\" }}\n{more}\n\
         [march]\ntime_step = \"1e-4 s\"\nduration = \"1 s\"\n"
    )
}

fn load(name: &str, more: &str) -> String {
    format!("[loads.{name}]\nbody = \"rotor\"\n{more}\n")
}

/// What `whirl check` says of the cycle.
fn cycle(bench: &Workbench, file: &str) -> (f64, String) {
    let outcome = bench.whirl(&["check", file]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let said = |before: &str| {
        let (_, rest) = outcome.stdout.split_once(before).expect("the cycle");
        rest.split(['\n']).next().expect("a line").to_owned()
    };
    let time = said("a cycle is ");
    (time.trim_end_matches(" s").parse().expect("a number"), said("the cycle is "))
}

#[test]
fn the_cycle_is_a_period_of_all_loads() {
    let gas = "angle [deg], force [N]\n0, 0\n200, 40\n720, 0\n";
    let third = "angle [deg], force [N]\n0, 0\n200, 40\n1080, 0\n";
    let shake = "time [s], force [N]\n0, 0\n0.01, 40\n0.03, 0\n";
    let gas_load = load("gas", "table = \"gas.csv\"\nperiod = \"720 deg\"");
    let half = load("half", "force = \"10 N\"\norder = 0.5");
    let sine = load("sine", "force = \"10 N\"\nfrequency = \"50 Hz\"");
    let told = "table = \"speeds.csv\"";
    let cases = [
        (rotor(&load("twice", "force = \"10 N\"\norder = 2")), 0.04, "two revolutions"),
        (rotor(&gas_load), 0.04, "two revolutions"),
        (rotor(&half), 0.04, "two revolutions"),
        (
            rotor(&load("third", "table = \"third.csv\"\nperiod = \"1080 deg\"")),
            0.06,
            "a common period of rotation and loads",
        ),
        (
            rotor(&load("quarter", "force = \"10 N\"\norder = 0.25")),
            0.08,
            "a common period of rotation and loads",
        ),
        (rotor(&(gas_load.clone() + &sine)), 0.04, "a common period of rotation and loads"),
        (rotor(&(half.clone() + &sine)), 0.04, "a common period of rotation and loads"),
        (
            rotor(&load("shake", "table = \"shake.csv\"\nperiod = \"30 ms\"")),
            0.06,
            "a common period of rotation and loads",
        ),
        // At the speed with which the table ends.
        (rotor(&half).replace("speed = \"3000 rpm\"", told), 0.08, "two revolutions"),
    ];
    let bench = Workbench::new()
        .file("gas.csv", gas)
        .file("third.csv", third)
        .file("shake.csv", shake)
        .file("speeds.csv", "time [s], speed [rpm]\n0, 0\n0.1, 3000\n0.2, 1500\n");
    for (k, (case, ..)) in cases.iter().enumerate() {
        std::fs::write(bench.path(&format!("case{k}.toml")), case).expect("written");
    }
    let found: Vec<(f64, String)> =
        (0..cases.len()).map(|k| cycle(&bench, &format!("case{k}.toml"))).collect();
    let expected: Vec<(f64, String)> =
        cases.iter().map(|(_, time, called)| (*time, (*called).to_owned())).collect();
    assert_eq!(found, expected);
}

#[test]
fn without_a_common_period_the_check_says_so() {
    let bench = Workbench::new()
        .file("case.toml", &rotor(&load("slip", "force = \"10 N\"\norder = 0.7071068")));
    assert_eq!(cycle(&bench, "case.toml"), (0.04, "two revolutions".to_owned()));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert!(outcome.stdout.contains("rotation and loads have no common period"));
}

/// Of a couple over the speed, a motor's curve, the fastest row says how long a revolution takes.
#[test]
fn a_rotor_driven_over_its_speed_has_a_cycle_in_either_form() {
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let line = |start: &str| {
        machine.lines().find(|line| line.starts_with(start)).expect("a line of the machine")
    };
    let short = machine
        .replace(line("torque"), "table = \"motor.csv\"")
        .replace(line("target_speed"), "")
        .replace(line("release"), "")
        .replace(line("cycle_frequency"), "steps = 2000");
    let named = rotor("[drives.motor]\nbody = \"rotor\"\ntable = \"motor.csv\"\n")
        .replace("turns = \"prescribed\"\nspeed", "turns = \"free\"\ninitial_speed");
    let bench = Workbench::new()
        .file("motor.csv", "speed [rpm], couple [N*m]\n0, 100\n4400, 90\n4500, 0\n")
        .file("short.toml", &format!("title = \"a shaft and its motor\"\n{short}"))
        .file("named.toml", &named);
    for name in ["short.toml", "named.toml"] {
        assert_eq!(cycle(&bench, name), (0.026667, "two revolutions".to_owned()));
    }
}

/// A rotor that only its start turns has the speed of its start, and a load over two of its revolutions that cycle.
#[test]
fn a_rotor_that_no_couple_turns_has_a_cycle_by_its_start() {
    let case = "title = \"x\"\n[body.rotor]\nturns = \"free\"\ninitial_speed = \"1000 rpm\"\nmass = \"10 kg\"\n\
                polar_inertia = \"0.1 kg*m^2\"\n[joint.m]\nkind = \"bushing\"\nfirst = { body = \"rotor\" }\n\
                stiffness = { xx = \"1e6 N/m\", yy = \"1e6 N/m\" }\n[loads.half]\nbody = \"rotor\"\nforce = \"10 N\"\n\
                order = 0.5\n[march]\ntime_step = \"2e-4 s\"\nsteps = 3000\n";
    let bench = Workbench::new().file("case.toml", case);
    let said = bench.whirl(&["check", "case.toml"]).stdout;
    assert!(said.contains("a cycle is 0.120000 s"), "{said}");
    let driven = "[drives.brake]\nbody = \"rotor\"\ntorque = \"-1 N*m\"\ntarget_speed = \"-500 rpm\"\n[march]";
    let bench = Workbench::new().file("case.toml", &case.replace("[march]", driven));
    let said = bench.whirl(&["check", "case.toml"]).stdout;
    assert!(said.contains("a cycle is 0.240000 s"), "{said}");
}

/// A target that is never reached asks for no steps and has no cycle; one of a speed that is told does.
#[test]
fn a_target_that_stands_for_never_asks_for_no_short_steps() {
    let case = |speed: &str, target: &str| {
        let text = format!(
            "title = \"x\"\n[body.rotor]\nturns = \"free\"\n{speed}mass = \"1 kg\"\npolar_inertia = \"0.01 kg*m^2\"\n\
             [joint.b]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\n\
             stiffness = {{ xx = \"1e4 N/m\", yy = \"1e4 N/m\" }}\ndamping = {{ xx = \"20 N*s/m\", yy = \"20 N*s/m\" }}\n\
             [drives.motor]\nbody = \"rotor\"\ntorque = \"0.1 N*m\"\ntarget_speed = \"{target}\"\n\
             [march]\ntime_step = \"1e-3 s\"\nduration = \"0.2 s\"\n"
        );
        Workbench::new().file("case.toml", &text).whirl(&["run", "case.toml", "--no-figures"])
    };
    for target in ["2000 rad/s", "100000 rpm"] {
        let never = case("", target);
        assert_eq!(never.status, 0, "{}", never.stderr);
        assert!(never.stdout.contains("verdict: sound"), "{}", never.stdout);
    }
    let told = case("initial_speed = \"2000 rad/s\"\n", "100000 rpm");
    assert!(told.status == 2 && told.stderr.contains("at least 23"), "{}", told.stderr);
}
