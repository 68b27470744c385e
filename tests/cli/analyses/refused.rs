//! What analyses refuse: each with what, where and how to mend it, and nothing written.

use crate::workbench::Workbench;

const ROTOR: &str = r#"
title = "a rotor"
[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
mass = "10 kg"
polar_inertia = "1e-3 kg*m^2"
[body.block]
turns = "no"
mass = "10 kg"
[joint.spring]
kind = "bushing"
first = { body = "rotor" }
second = { body = "block" }
TABLE
[joint.foot]
kind = "bushing"
first = { body = "block" }
stiffness = { xx = "1e6 N/m", yy = "1e6 N/m" }
"#;

const STIFFNESS: &str = "stiffness = { xx = \"1e6 N/m\", yy = \"1e6 N/m\" }";
const HEADS: &str = "speed [rpm], k_xx [N], k_xy [N/m], k_yx [N/m], k_yy [N/m], c_xx [N*s/m], c_xy [N*s/m], \
                     c_yx [N*s/m], c_yy [N/m]\n0, 1, 0, 0, 1, 0, 0, 0, 0\n9000, 1, 0, 0, 1, 0, 0, 0, 0\n";

/// The same as they should be.
const COEFFICIENTS: &str = "k_xx [N/m], k_xy [N/m], k_yx [N/m], k_yy [N/m], \
                            c_xx [N*s/m], c_xy [N*s/m], c_yx [N*s/m], c_yy [N*s/m]";

const PUSH: &str = "time [s], force [N]\n0, 0\n0.01, 5\n0.02, 0\n";

fn refused(case: &str, arguments: &[&str], words: &[&str]) {
    let workbench = Workbench::new().file("case.toml", case).file("table.csv", HEADS);
    let workbench = workbench.file("push.csv", PUSH);
    let outcome = workbench.whirl(arguments);
    assert_eq!(outcome.status, 2, "{arguments:?}: {}{}", outcome.stdout, outcome.stderr);
    for word in words {
        assert!(outcome.stderr.contains(word), "{arguments:?}: `{word}` is in\n{}", outcome.stderr);
    }
    assert!(!workbench.listing().iter().any(|own| own.contains("results")), "nothing is written");
}

#[test]
fn speeds_that_no_machine_has_are_refused() {
    let case = ROTOR.replace("TABLE", STIFFNESS);
    for (speeds, words) in [
        ("1.1e7 rpm", ["no shaft turns with more than 10 million rpm", "--speeds:1:1"]),
        ("0 rpm .. 10 rpm, 1000000000", ["no more than 10000 values", "--speeds:1:1"]),
        ("0 rpm .. 10 rpm, 20000", ["no more than 10000 values", "--speeds:1:1"]),
        ("3000", ["without unit", "0 rpm .. 30000 rpm, 61"]),
        ("3 mm", ["speeds are angular speeds", "0 rpm .. 30000 rpm, 61"]),
    ] {
        refused(&case, &["campbell", "case.toml", "--speeds", speeds], &words);
    }
}

#[test]
fn bodies_that_stand_have_neither_speeds_nor_orders() {
    let case = ROTOR.replace("TABLE", STIFFNESS);
    for kind in ["modes", "campbell", "response", "stability", "coefficients", "map", "torsion"] {
        let words = ["there is no body `block` that turns", "known: `rotor`"];
        refused(&case, &[kind, "case.toml", "--of", "block"], &words);
    }
    let still = case.replace("turns = \"prescribed\"\nspeed = \"3000 rpm\"\n", "turns = \"no\"\n");
    let still = still.replace("polar_inertia = \"1e-3 kg*m^2\"\n", "");
    for kind in ["campbell", "response", "stability", "map", "torsion"] {
        refused(&still, &[kind, "case.toml"], &["nothing turns in `case`", "whirl modes"]);
    }
    for (list, none) in [("[-1]", "-1"), ("[1, 0]", "0"), ("[-0.5, 1]", "-0.5")] {
        let orders = format!("{case}[analysis.own]\nkind = \"campbell\"\norders = {list}\n");
        let what = format!("`orders` takes positive numbers, and {none} is none");
        let words =
            [what.as_str(), "write numbers above zero, such as `orders = [1, 2]`", "case.toml"];
        refused(&orders, &["analyse", "case.toml"], &words);
    }
    let of = format!("{case}[analysis.own]\nkind = \"campbell\"\nof = \"block\"\n");
    refused(&of, &["analyse", "case.toml"], &["block", "case.toml:"]);
}

#[test]
fn columns_of_a_table_with_other_units_are_named() {
    let case = ROTOR.replace("TABLE", "table = \"table.csv\"");
    let words =
        ["`k_xx` of `table.csv` is in N", "`k_xx [N/m]`", "`c_yy` of `table.csv` is in N/m"];
    refused(&case, &["modes", "case.toml"], &words);
}

/// Beside such a joint rounding hides the motions of a machine: as keys at their place, as values of a law by its joint.
#[test]
fn joints_that_hide_the_machine_from_rounding_are_named() {
    for (key, unit, other) in [
        ("stiffness", "N/m", "xx = \"1e300 N/m\", yy = \"1e6 N/m\""),
        ("damping", "N*s/m", "xx = \"1e300 N*s/m\""),
        ("tilting_stiffness", "N*m/rad", "yy = \"1e300 N*m/rad\""),
    ] {
        let case = ROTOR.replace("TABLE", &format!("{key} = {{ {other} }}"));
        let called = other.split(' ').next().expect("a direction");
        let what = format!("`{key}.{called}` of the joint `spring` is 1e300 {unit}");
        let words = [what.as_str(), "write 1e16 in SI units at most", "case.toml:15:"];
        refused(&case, &["modes", "case.toml"], &words);
    }
    let law = "kind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"linear-5x5\"\n\
               parameters = { k_x_x = \"1e300 N/m\", k_y_y = \"1e6 N/m\" }";
    let bushing =
        "kind = \"bushing\"\nfirst = { body = \"rotor\" }\nsecond = { body = \"block\" }\nTABLE";
    let case = ROTOR.replace(bushing, law);
    let words = ["bearing spring with the law linear-5x5 has a stiffness or damping of 1.000e300"];
    refused(&case, &["modes", "case.toml"], &words);
}

#[test]
fn a_machine_that_does_not_stand_says_with_which_speeds() {
    let case = ROTOR.replace("TABLE", STIFFNESS).replace("[joint.foot]", "[joint.other]")
        + "[loads.pull]\nbody = \"rotor\"\nforce = \"1e9 N\"\n";
    let film = case.replace(
        "kind = \"bushing\"\nfirst = { body = \"rotor\" }\nsecond = { body = \"block\" }\nstiffness = { xx = \"1e6 N/m\", yy = \"1e6 N/m\" }",
        "kind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }\n\
         radial_clearance = \"60 um\"\njournal_radius = \"30 mm\"\nlength = \"30 mm\"",
    );
    let words = ["no equilibrium was found with rotor at 3000 rpm", "film", "Lower the loads"];
    let words = &words.map(|own| if own == "film" { "bearing spring" } else { own });
    refused(&film, &["modes", "case.toml"], words);
    refused(&film, &["campbell", "case.toml", "--speeds", "0 rpm .. 3000 rpm, 3"], words);
}

/// A law that gives way at 10 N carries no 98 N; nothing turns, which is said in the place of speeds.
#[test]
fn a_machine_without_bodies_that_turn_says_so_where_it_does_not_stand() {
    let law = "kind = \"law\"\nname = \"own\"\ntitle = \"gives way\"\nsource = \"closed form\"\n[inputs]\n\
               e_x = { unit = \"m\", range = [-1e-3, 1e-3] }\ne_y = { unit = \"m\", range = [-1e-3, 1e-3] }\n\
               [parameters]\nF = { value = 10, unit = \"N\" }\na = { value = 1e-5, unit = \"m\" }\n\
               [outputs.F_x]\nunit = \"N\"\nvalue = '-F*tanh(e_x/a)'\n\
               [outputs.F_y]\nunit = \"N\"\nvalue = '-F*tanh(e_y/a)'\n";
    let case = "title = \"a block\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]\n\
                [body.block]\nturns = \"no\"\nmass = \"10 kg\"\n\
                [joint.hold]\nkind = \"bearing\"\njournal = { body = \"block\" }\nlaw = \"own.toml\"\n";
    let workbench = Workbench::new().file("own.toml", law).file("case.toml", case);
    let outcome = workbench.whirl(&["modes", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}{}", outcome.stdout, outcome.stderr);
    let words = "no equilibrium was found with no body turning: out of balance";
    assert!(outcome.stderr.contains(words), "{}", outcome.stderr);
}

/// An analysis that cannot be done, here forces along a body without a mesh, keeps no other from its results.
#[test]
fn what_the_other_analyses_come_to_is_kept() {
    let case = format!(
        "{}[analysis.along]\nkind = \"forces\"\nspeeds = \"3000 rpm\"\n[analysis.slow]\nkind = \"modes\"\nspeeds = \"3000 rpm\"\n",
        ROTOR.replace("TABLE", STIFFNESS)
    );
    let bench = Workbench::new().file("case.toml", &case);
    let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("the analysis `along` cannot be done"), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("case.toml:"), "{}", outcome.stderr);
    assert!(bench.path("out/slow.csv").is_file());
    assert!(!bench.path("out/along.csv").exists());
}

/// What comes to nothing is named as well, each of them, beside those that cannot be done.
#[test]
fn every_analysis_that_comes_to_nothing_is_named() {
    let whirls = |name: &str| {
        format!(
            "[analysis.{name}]\nkind = \"periodic\"\nself_excited = true\nnear = \"40 Hz\"\nsteps = 60\n"
        )
    };
    let [first, second] = ["first", "second"].map(whirls);
    let rotor = ROTOR.replace("TABLE", STIFFNESS);
    let along = "[analysis.along]\nkind = \"forces\"\nspeeds = \"3000 rpm\"\n";
    for (case, status) in
        [(format!("{rotor}{first}{second}"), 1), (format!("{rotor}{first}{along}{second}"), 2)]
    {
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["analyse", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, status, "{}", outcome.stderr);
        for name in ["first", "second"] {
            let named = format!("the analysis `{name}` comes to nothing");
            assert!(outcome.stderr.contains(&named), "{}", outcome.stderr);
        }
        assert_eq!(outcome.stderr.contains("`along` cannot be done"), status == 2);
    }
}

/// An analysis of a table is named where it cannot be done, also where it is the only one; `whirl check` says so before.
#[test]
fn an_analysis_that_cannot_be_done_is_named_and_foreseen() {
    let rotor = ROTOR.replace("TABLE", STIFFNESS);
    let still = rotor
        .replace("turns = \"prescribed\"\nspeed = \"3000 rpm\"\n", "turns = \"no\"\n")
        .replace("polar_inertia = \"1e-3 kg*m^2\"\n", "");
    let pulled = rotor.replace("[joint.foot]", "[joint.other]")
        + "[loads.pull]\nbody = \"rotor\"\nforce = \"1e9 N\"\n";
    let film = pulled.replace(
        &format!("kind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\nsecond = {{ body = \"block\" }}\n{STIFFNESS}"),
        "kind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }\n\
         radial_clearance = \"60 um\"\njournal_radius = \"30 mm\"\nlength = \"30 mm\"",
    );
    let lateral = "kind = \"lateral\"\nminimum_speed = \"2000 rpm\"\nmaximum_speed = \"3000 rpm\"\n\
                   seals = [\"spring\"]\n";
    for (case, table, words) in [
        (
            &rotor,
            "kind = \"response\"\nspeeds = \"0 rpm .. 3000 rpm, 3\"\n",
            ["no body of `case` has an unbalance", "add `unbalance.NAME"],
        ),
        (&still, "kind = \"campbell\"\n", ["nothing turns in `case`", "turns = \"prescribed\""]),
        (
            &film,
            "kind = \"modes\"\nspeeds = \"3000 rpm\"\n",
            ["no equilibrium was found with rotor at 3000 rpm", "Lower the loads"],
        ),
        (&rotor, lateral, ["`rotor` has no journal", "add a `[joint.NAME]`"]),
        (
            &rotor,
            "kind = \"forces\"\nspeeds = \"3000 rpm\"\n",
            ["no body of `case` can be cut", "give a body a mesh"],
        ),
    ] {
        let case = format!("{case}[analysis.own]\n{table}");
        let named = "the analysis `own` cannot be done";
        refused(&case, &["analyse", "case.toml"], &[named, words[0], words[1], "case.toml:"]);
        let bench = Workbench::new().file("case.toml", &case).file("push.csv", PUSH);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
        let said = outcome.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in [named, words[0], words[1]] {
            assert!(said.contains(word), "{word}: {said}");
        }
    }
    // A load that does not repeat has a place of its own.
    let once = format!(
        "{rotor}[loads.push]\nbody = \"rotor\"\ndirection = \"x\"\ntable = \"push.csv\"\n\
         [analysis.own]\nkind = \"periodic\"\nspeeds = \"3000 rpm\"\n"
    );
    let words = ["load.push goes by a table over time", "give the load a `period`", "[loads.push]"];
    refused(&once, &["analyse", "case.toml"], &words);
    let bench = Workbench::new().file("case.toml", &once).file("push.csv", PUSH);
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    for word in ["the analysis `own` cannot be done", words[0], words[1]] {
        assert!(outcome.stderr.contains(word), "{word}: {}", outcome.stderr);
    }
    // A key that the case has not is shown where it is written.
    let unknown = format!(
        "{rotor}[analysis.own]\nkind = \"periodic\"\nvary = \"body.rotor.sped = 1000 rpm .. 2000 rpm\"\n"
    );
    let words = ["`[body.rotor]` has no key `sped`", "`vary` of [analysis.own]:1:"];
    refused(&unknown, &["analyse", "case.toml"], &words);
    let words = ["nothing turns at 0 rpm", "ask for other speeds"];
    refused(&rotor, &["response", "case.toml", "--speeds", "0 rpm"], &words);
    let sound = format!("{rotor}[analysis.own]\nkind = \"modes\"\n");
    let outcome = Workbench::new().file("case.toml", &sound).whirl(&["check", "case.toml"]);
    assert!(outcome.status == 0 && !outcome.stderr.contains("cannot"), "{}", outcome.stderr);
}

/// A train whose bodies turn as one has no torsion: what would give it some is said.
#[test]
fn a_machine_without_torsion_says_what_twists() {
    let bench = Workbench::new().file("case.toml", &ROTOR.replace("TABLE", STIFFNESS));
    let outcome = bench.whirl(&["torsion", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    for word in ["no mode of torsion", "turn as one", "couplings or gears"] {
        assert!(outcome.stdout.contains(word), "{word}: {}", outcome.stdout);
    }
}

/// Coefficients over the frequency are none of a motion in time, points of a lateral analysis that are not there, and the ratio of a
/// body to itself: each is seen before anything is done.
#[test]
fn what_an_analysis_cannot_have_is_foreseen() {
    let rows = "0, 0, 1e6, 0, 0, 1e6, 9, 0, 0, 9\n0, 1, 3e6, 0, 0, 3e6, 9, 0, 0, 9\n\
                9000, 0, 1e6, 0, 0, 1e6, 9, 0, 0, 9\n9000, 1, 3e6, 0, 0, 3e6, 9, 0, 0, 9\n";
    let table = format!("speed [rpm], frequency_ratio [1], {COEFFICIENTS}\n{rows}");
    let whirls = "unbalance.u = { mass = \"1 g\", radius = \"50 mm\" }\nspeed = \"3000 rpm\"";
    let rotor = ROTOR.replace("speed = \"3000 rpm\"", whirls);
    let periodic = "[analysis.own]\nkind = \"periodic\"\n";
    let lateral = "[analysis.own]\nkind = \"lateral\"\nminimum_speed = \"5000 rpm\"\nmaximum_speed = \"6000 rpm\"\n\
                   probes = [\"joint.none\"]\n";
    let over = rotor.replace("TABLE", "table = \"seal.csv\"");
    for (case, words) in [
        (format!("{over}{periodic}"), ["depend on the frequency", "`whirl.fit_law` in Python"]),
        (
            format!("{}{lateral}", rotor.replace("TABLE", STIFFNESS)),
            ["there is no point", "joint.none"],
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &case).file("seal.csv", &table);
        for (command, status) in [("check", 0), ("analyse", 2)] {
            let outcome = bench.whirl(&[command, "case.toml"]);
            assert_eq!(outcome.status, status, "{}", outcome.stderr);
            for words in words {
                let said = outcome.stderr.contains(words)
                    || command == "check" && words.starts_with("`whirl.fit");
                assert!(said, "{command}: {words}: {}", outcome.stderr);
            }
        }
    }
    let itself = "[analysis.own]\nkind = \"modes\"\nof = \"rotor\"\nratios = { rotor = 2.0 }\n";
    let bench = Workbench::new()
        .file("case.toml", &format!("{}{itself}", rotor.replace("TABLE", STIFFNESS)));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("the speeds are those of `rotor` itself"),
        "{}",
        outcome.stderr
    );
}

/// Of two rotors one always grows: that the other stops to is no stability of the machine.
#[test]
fn a_motion_that_stops_to_grow_beside_another_makes_nothing_stable() {
    let body = |name: &str, mass: &str| {
        format!(
            "[body.{name}]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"{mass}\"\npolar_inertia = \"0.05 kg*m^2\"\n"
        )
    };
    let case = format!(
        "title = \"two\"\n{}{}[joint.a]\nkind = \"bushing\"\nfirst = {{ body = \"a\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", xy = \"1e5 N/m\", yx = \"-1e5 N/m\", yy = \"1e6 N/m\" }}\n\
         [joint.b]\nkind = \"bushing\"\nfirst = {{ body = \"b\" }}\ntable = \"fall.csv\"\n",
        body("a", "10 kg"),
        body("b", "4 kg")
    );
    let rows = "0, 1e6, 1e5, -1e5, 1e6, 100, 0, 0, 100\n9000, 1e6, 0, 0, 1e6, 100, 0, 0, 100\n";
    let table = format!("speed [rpm], {COEFFICIENTS}\n{rows}");
    let bench = Workbench::new().file("case.toml", &case).file("fall.csv", &table);
    let said = bench.whirl(&["stability", "case.toml", "--speeds", "0 rpm .. 9000 rpm, 4"]).stdout;
    assert!(said.contains("one motion stops growing, others do not, above 4500 rpm"), "{said}");
    assert!(said.contains("UNSTABLE at all these speeds"), "{said}");
}

/// What an analysis came to before does not stand for one that comes to nothing now: its files go, and the page says why.
#[test]
fn an_analysis_that_comes_to_nothing_leaves_no_older_results() {
    let case = |damping: &str| {
        format!(
            "title = \"a mass that swings by itself\"\n[body.r]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"4 kg\"\n\
             polar_inertia = \"0.01 kg*m^2\"\nunbalance.u = {{ mass = \"1 g\", radius = \"20 mm\" }}\n\
             [joint.k]\nkind = \"bushing\"\nfirst = {{ body = \"r\" }}\nstiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
             damping = {{ xx = \"{damping} N*s/m\", yy = \"{damping} N*s/m\" }}\n\
             [analysis.cycle]\nkind = \"periodic\"\nmethod = \"accelerated\"\nmarched = 0\ncycles = 3\nbegin = \"rest\"\n"
        )
    };
    // Three cycles are enough for what is damped critically, and by far not for what is hardly damped.
    let workbench =
        Workbench::new().file("case.toml", &case("4000").replace("cycles = 3", "cycles = 400"));
    let outcome = workbench.whirl(&["analyse", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(workbench.path("out/cycle.csv").is_file());
    let workbench = workbench.file("case.toml", &case("0.01"));
    let outcome = workbench.whirl(&["analyse", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    assert!(
        !workbench.path("out/cycle.csv").exists() && !workbench.path("out/cycle.json").exists()
    );
    let page = std::fs::read_to_string(workbench.path("out/report.html")).expect("a page");
    assert!(page.contains("\"failed\":true"), "the page says nothing");
}
