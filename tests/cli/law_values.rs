//! Laws with the values of their bearings, and with parameters that a case sets: they are what a file with these
//! values gives, bit for bit.

use std::fs;

use serde_json::Value;

use crate::workbench::{Outcome, Workbench};

const OCVIRK: &str = include_str!("../../specs/laws/ocvirk.toml");

/// A law file with other values of some parameters, as a user would edit a copy of it: nothing is taken from the
/// bearing any more.
fn edited(law: &str, values: &[(&str, &str)]) -> String {
    let mut text: String = law
        .lines()
        .filter(|line| !line.starts_with("bearing = "))
        .map(|l| format!("{l}\n"))
        .collect();
    for (name, value) in values {
        let head = format!("[parameters.{name}]\nvalue = ");
        let start = text.find(&head).unwrap_or_else(|| panic!("{name}")) + head.len();
        let end = start + text[start..].find('\n').expect("a line");
        text.replace_range(start..end, value);
    }
    text
}

/// A mass that whirls in what `stop` says.
fn mass(stop: &str) -> String {
    format!(
        "title = \"a journal in a ring\"\n[mass]\nmass = \"2 kg\"\nstiffness = \"1e5 N/m\"\nforce = \"20 N\"\n\
         velocity = \"0.01 m/s\"\nunbalance = {{ eccentricity = \"5 um\", speed = \"300 rad/s\" }}\n\
         [[stop]]\nside = \"around\"\n{stop}\n[march]\ntime_step = \"1e-4 s\"\nsteps = 60\n"
    )
}

/// A short run of the reference machine with these lines under `[springs]`.
fn machine(springs: &str) -> String {
    format!(
        "include = \"hu2003-5.toml\"\ntitle = \"a short run\"\n[springs]\n{springs}\n[march]\nsteps = 12\n"
    )
}

fn fine(outcome: &Outcome) {
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
}

/// History and summary of a case.
fn run(bench: &Workbench, case: &str) -> (String, Value) {
    fine(&bench.whirl(&["run", &format!("{case}.toml"), "--no-figures"]));
    let read = |file: &str| {
        fs::read_to_string(bench.path(&format!("results/{case}/{file}"))).expect("a result")
    };
    (read("history.csv"), serde_json::from_str(&read("summary.json")).expect("JSON"))
}

/// Names and hashes of the laws in a summary.
fn laws(summary: &Value) -> Vec<(String, String)> {
    let kernels = summary["kernels"].as_object().expect("kernels").iter();
    let law = |(name, hash): (&String, &Value)| {
        Some((name.strip_prefix("law/")?.to_string(), hash.as_str().expect("a hash").to_string()))
    };
    kernels.filter_map(law).collect()
}

#[test]
fn a_law_has_the_clearance_of_its_stop_and_the_parameters_of_the_case() {
    let copy = edited(OCVIRK, &[("R", "20"), ("L", "18"), ("c", "0.04"), ("mu", "0.012")]);
    let case = "gap = \"40 um\"\njournal_radius = \"2 cm\"\nlength = \"18 mm\"\nlaw = \"ocvirk\"\n\
                parameters = { mu = \"12 mPa*s\" }";
    let by_name = "law = \"ocvirk\"\n\
                   parameters = { c = \"40 um\", R = \"20 mm\", L = \"18e3 um\", mu = \"12 mPa*s\" }";
    let bench = Workbench::new()
        .file("ocvirk-copy.toml", &copy)
        .file("file.toml", &mass("law = \"ocvirk-copy.toml\""))
        .file("case.toml", &mass(case))
        .file("named.toml", &mass(by_name))
        .file("plain.toml", &mass("law = \"ocvirk\""));
    let [file, case, named, plain] =
        ["file", "case", "named", "plain"].map(|name| run(&bench, name));
    assert_eq!(file.0, case.0, "the values of the stop, and a copy of the file with them");
    assert_eq!(case.0, named.0);
    assert_ne!(file.0, plain.0, "these values matter");
    let [(name, hash)] = laws(&case.1).try_into().expect("one law");
    assert_eq!(name, "ocvirk (R = 20 mm, L = 18 mm, c = 0.04 mm, mu = 0.012 Pa*s)");
    let [(_, other)] = laws(&plain.1).try_into().expect("one law");
    assert_ne!(hash, other);
    let said = bench.whirl(&["check", "case.toml"]);
    fine(&said);
    assert!(
        said.stdout.contains(&format!("stop around, gap 0.00004 m, law {name}\n")),
        "{}",
        said.stdout
    );
}

/// A value beyond the limits of a parameter is refused where the case, the command or a law of its own says it.
#[test]
fn a_value_that_a_parameter_may_not_have_is_refused_at_its_place() {
    let refused = |values: &str, words: &str| {
        let stop = format!("law = \"ocvirk\"\nparameters = {{ {values} }}");
        let bench = Workbench::new().file("case.toml", &mass(&stop));
        let said = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(said.status, 2, "{}", said.stderr);
        assert!(said.stderr.contains(words), "{}", said.stderr);
        assert!(!bench.path("results").exists());
    };
    refused("mu = \"-12 mPa*s\"", "`mu` of the law `ocvirk` has to be above 0 Pa*s, not -12 mPa*s");
    refused("eps_m = 1", "`eps_m` of the law `ocvirk` has to be below 1, not 1");
    refused("c = \"0 um\"", "`c` of the law `ocvirk` has to be above 0 mm, not 0 um");
    let bench = Workbench::new().file("case.toml", &mass("law = \"ocvirk\""));
    let varied = ["sweep", "case.toml", "--vary", "stop.1.parameters.mu=-1 Pa*s .. 1 Pa*s, 3"];
    let said = bench.whirl(&varied);
    assert!(said.stderr.contains("has to be above 0 Pa*s"), "{}", said.stderr);
    // Numbers without a unit vary over ranges, too.
    let varied = ["sweep", "case.toml", "--vary", "stop.1.parameters.eps_m=0.5 .. 0.9, 3"];
    let said = bench.whirl(&[&varied[..], &["--no-figures", "--out", "varied"]].concat());
    assert_eq!(said.status, 0, "{}", said.stderr);
    let table = fs::read_to_string(bench.path("varied/table.csv")).expect("a table");
    for value in ["0.5", "0.7", "0.9"] {
        assert!(table.lines().any(|line| line.split(',').any(|cell| cell == value)), "{table}");
    }
    let copy = edited(OCVIRK, &[("mu", "-0.01")]);
    let bench = bench.file("own.toml", &copy).file("own-case.toml", &mass("law = \"own.toml\""));
    let said = bench.whirl(&["check", "own-case.toml"]);
    assert_eq!(said.status, 2, "{}", said.stderr);
    assert!(
        said.stderr.contains("own.toml") && said.stderr.contains("`mu` has to be above 0 Pa*s"),
        "{}",
        said.stderr
    );
}

/// Values that are those of the file, in whatever unit, need no other law than the compiled one.
#[test]
fn values_of_the_file_leave_a_law_as_it_is() {
    let values = "gap = \"50 um\"\njournal_radius = \"2.5 cm\"\nlaw = \"ocvirk\"\n\
                  parameters = { L = \"0.02 m\", mu = \"20 mPa*s\", eps_m = 0.99, v_0 = \"1 um/s\" }";
    let bench = Workbench::new()
        .file("case.toml", &mass(values))
        .file("plain.toml", &mass("law = \"ocvirk\""))
        .file("copy.toml", OCVIRK)
        .file("file.toml", &mass("law = \"copy.toml\""));
    let [case, plain, file] = ["case", "plain", "file"].map(|name| run(&bench, name));
    assert_eq!((laws(&case.1), case.0), (laws(&plain.1), plain.0));
    assert_eq!(laws(&plain.1)[0].0, "ocvirk");
    assert_eq!(file.0, run(&bench, "plain").0, "compiled and by tape");
}

/// Two bearings of one law with their own clearances; what the case does not say is measured on the meshes.
#[test]
fn every_bearing_has_the_law_with_its_own_values() {
    let bearings = |law: &str, own: &str| {
        let all = [bearing(1, law), bearing(2, law), bearing(3, own), bearing(4, own)];
        machine("") + &all.concat()
    };
    let case = bearings(
        "law = \"ocvirk\"",
        "law = \"ocvirk\"\nradial_clearance = \"40 um\"\nlength = \"20 mm\"",
    );
    let files =
        bearings("law = \"wide.toml\"", "law = \"narrow.toml\"\nradial_clearance = \"40 um\"");
    let bench = Workbench::new()
        .file("wide.toml", &edited(OCVIRK, &[("R", "34"), ("L", "25"), ("c", "0.035687")]))
        .file("narrow.toml", &edited(OCVIRK, &[("R", "33.995687"), ("L", "20"), ("c", "0.04")]))
        .file("case.toml", &case)
        .file("files.toml", &files);
    let (case, files) = (run(&bench, "case"), run(&bench, "files"));
    assert_eq!(case.0, files.0);
    let names: Vec<String> = laws(&case.1).into_iter().map(|(name, _)| name).collect();
    assert_eq!(
        names,
        [
            "ocvirk (R = 33.995687 mm, c = 0.04 mm)",
            "ocvirk (R = 34 mm, L = 25 mm, c = 0.035687 mm)"
        ]
    );
}

/// A bearing of the reference machine with more lines.
fn bearing(k: usize, more: &str) -> String {
    let sets =
        |word: &str| format!("[\"{word}{k}_LEFT\", \"{word}{k}_MIDDLE\", \"{word}{k}_RIGHT\"]");
    format!("[[bearing]]\njournal = {}\nbore = {}\n{more}\n", sets("JOURNAL"), sets("BORE"))
}

/// A bearing's own parameters come before those of `[springs]`, which belong to the law beside them.
#[test]
fn a_bearings_own_parameters_come_first() {
    let springs = "law = \"rub-coulomb\"\nparameters = { mu = 0.2, k = \"5 kN/mm\" }\n";
    let all = [
        bearing(1, ""),
        bearing(2, "parameters = { mu = 0.1 }"),
        bearing(3, "law = \"gap-linear\""),
        bearing(4, "law = \"radial-gap\"\nparameters = { k = \"1e6 N/m\" }"),
    ];
    let bench = Workbench::new().file("case.toml", &(machine(springs) + &all.concat()));
    let said = bench.whirl(&["check", "case.toml"]);
    fine(&said);
    for (k, law) in [
        (1, "rub-coulomb (k = 5 kN/mm, mu = 0.2)"),
        (2, "rub-coulomb (k = 5 kN/mm, mu = 0.1)"),
        (3, "gap-linear"),
        (4, "radial-gap (k = 1 kN/mm)"),
    ] {
        let line = said.stdout.lines().find(|line| line.starts_with(&format!("bearing {k}:")));
        assert!(
            line.is_some_and(|line| line.contains(&format!(", law {law}, c = "))),
            "{}",
            said.stdout
        );
    }
}

/// A break moved to a root follows the values that the case sets.
#[test]
fn a_root_follows_the_values_of_the_case() {
    let law = "kind = \"law\"\nname = \"root\"\ntitle = \"A line to its root\"\nsource = \"a test\"\n\
               [inputs.h]\nunit = \"mm\"\n\
               [parameters.c]\nvalue = 0.03\nunit = \"mm\"\nbearing = \"radial_clearance\"\n\
               [parameters.k]\nvalue = 6517\nunit = \"N/mm\"\n\
               [outputs.Q]\nunit = \"N\"\nengage = \"root\"\n\
               pieces = [{ when = 'h < c', value = '233 - k*h' }, { value = '0' }]\n";
    let case =
        "law = \"root.toml\"\nradial_clearance = \"40 um\"\nparameters = { k = \"5 kN/mm\" }";
    let bench = Workbench::new().file("root.toml", law).file("case.toml", &machine(case));
    let said = bench.whirl(&["check", "case.toml", "--laws"]);
    fine(&said);
    for words in
        ["law root.toml (c = 0.04 mm, k = 5000 N/mm)", "break at h = 0.0466 mm (moved from 0.04)"]
    {
        assert!(said.stdout.contains(words), "`{words}` is not in:\n{}", said.stdout);
    }
}

/// What stands out of a law is said unasked: a spring that pulls, a negative stiffness, a jump that its file accepts.
#[test]
fn a_check_says_what_stands_out_of_a_law() {
    let law = "kind = \"law\"\nname = \"pull\"\ntitle = \"A snap\"\nsource = \"a test\"\n\
               [inputs.h]\nunit = \"mm\"\nrange = [0, 0.1]\n\
               [outputs.Q]\nunit = \"N\"\njump = \"accept\"\n\
               pieces = [{ when = 'h < 0.03', value = '100*h - 1' }, { value = '0' }]\n";
    let case = machine("law = \"pull.toml\"\nradial_clearance = \"40 um\"");
    let bench = Workbench::new().file("pull.toml", law).file("case.toml", &case);
    let said = bench.whirl(&["check", "case.toml"]);
    fine(&said);
    let (_, found) = said.stdout.split_once("\nLaws (in full: `--laws`)\n").expect("remarks");
    let expected = [
        "pull.toml: `Q` pulls journal and bore together in places: -1 N",
        "pull.toml: `Q` rises with rising h in places: a negative stiffness",
        "pull.toml: `Q` jumps by 2 N at h = 0.03 mm: 2 N with slope 100 N/mm below, 0 N with slope 0 N/mm above",
    ];
    assert_eq!(found.lines().collect::<Vec<_>>(), expected);
}

/// The area of the bore that a spring stands for is that of its bearing: 2π·34.035687 mm·25 mm over 3 × 24.
#[test]
fn the_area_of_a_spring_is_that_of_its_bearing() {
    let bench = Workbench::new().file("case.toml", &machine("law = \"greenwood-tripp\""));
    let said = bench.whirl(&["check", "case.toml"]);
    fine(&said);
    let area = std::f64::consts::TAU * 34.035687 * 25.0 / 72.0;
    let name = said.stdout.split("law greenwood-tripp (A = ").nth(1).expect("the area");
    let found: f64 = name.split(' ').next().expect("a number").parse().expect("a number");
    assert!((found - area).abs() < 1e-10 * area, "{found} {area}");
}

/// The ends of a journal in one plane are no length: a law that takes one asks for the key.
#[test]
fn a_value_that_nothing_gives_is_asked_for() {
    let case = |more: &str| {
        let one_plane = "[[bearing]]\njournal = [\"JOURNAL1_MIDDLE\", \"JOURNAL1_MIDDLE\", \"JOURNAL1_MIDDLE\"]\n\
                       bore = [\"BORE1_MIDDLE\", \"BORE1_MIDDLE\", \"BORE1_MIDDLE\"]\nstations = [\"24 mm\"]\n";
        machine("") + one_plane + "law = \"ocvirk\"\n" + more + &bearing(4, "")
    };
    let bench = Workbench::new()
        .file("case.toml", &case(""))
        .file("key.toml", &case("length = \"21 mm\"\n"))
        .file("named.toml", &case("parameters = { L = \"21 mm\" }\n"));
    let before = bench.listing();
    for command in ["check", "run"] {
        let outcome = bench.whirl(&[command, "case.toml"]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        for words in ["case.toml:11:8", "takes `L` from its bearing", "add `length = \"…\"`"] {
            assert!(outcome.stderr.contains(words), "`{words}` is not in:\n{}", outcome.stderr);
        }
        assert_eq!(bench.listing(), before);
    }
    for file in ["key.toml", "named.toml"] {
        let said = bench.whirl(&["check", file]);
        fine(&said);
        assert!(
            said.stdout.contains("law ocvirk (R = 34 mm, L = 21 mm, c = 0.035687 mm)"),
            "{}",
            said.stdout
        );
    }
}

/// A force whose derivative is 0/0 where the machine stands: analyses and a run name the law, and give no number.
#[test]
fn a_law_without_a_derivative_is_named() {
    let input =
        |name: &str, unit: &str| format!("[inputs.{name}]\nunit = \"{unit}\"\nrange = [-1, 1]\n");
    let law = format!(
        "kind = \"law\"\nname = \"rooted\"\ntitle = \"t\"\nsource = \"s\"\n{}{}{}[parameters]\nk = {{ value = 100, unit = \"N/mm\" }}\n\
         c = {{ value = 100, unit = \"um\" }}\n[outputs.F_x]\nunit = \"N\"\nvalue = '-k*e_x'\n[outputs.F_y]\nunit = \"N\"\n\
         value = '-k*e_y - 0.05*e_y_dot*sqrt((e_x^2+e_y^2)/c^2)'\n",
        input("e_x", "mm"),
        input("e_y", "mm"),
        input("e_y_dot", "mm/s")
    );
    let case = "title = \"a rotor\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"20 kg\"\npolar_inertia = \"0.1 kg*m^2\"\n\
                [joint.a]\nkind = \"bearing\"\njournal = { body = \"rotor\" }\nlaw = \"rooted.toml\"\n[start]\nkind = \"equilibrium\"\n\
                [march]\ntime_step = \"20 us\"\nsteps = 5\n";
    let bench = Workbench::new().file("rooted.toml", &law).file("case.toml", case);
    for command in ["coefficients", "modes", "matrices", "run"] {
        let outcome = bench.whirl(&[command, "case.toml"]);
        assert!(outcome.status != 0, "{command}: {}", outcome.stdout);
        for words in ["rooted", "without a finite derivative", "sqrt(max(x^2, a^2))"] {
            let all = format!("{}{}", outcome.stdout, outcome.stderr);
            assert!(all.contains(words), "{command}: `{words}` is not in {all}");
        }
    }
    // Off zero, as the message says, the same law has its stiffness.
    let bench = bench
        .file("rooted.toml", &law.replace("(e_x^2+e_y^2)/c^2", "max((e_x^2+e_y^2)/c^2, 1e-12)"));
    let outcome = bench.whirl(&["coefficients", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("1.0000e5"), "{}", outcome.stdout);
}
