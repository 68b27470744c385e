//! What does not deserve trust says so, in every way in which a run can end; and what is there is not lost by
//! asking to go on with it.

use std::fs;

use crate::workbench::{SHORT, Workbench};

/// A mass between stops, with a part to be added.
fn case(time_step: &str, steps: usize, law: &str, more: &str) -> String {
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nvelocity = \"1 m/s\"\n{more}\n\
         [[stop]]\nside = \"above\"\ngap = \"1 mm\"\nlaw = \"{law}\"\n\
         [[stop]]\nside = \"below\"\ngap = \"2 mm\"\nlaw = \"{law}\"\n\
         [march]\ntime_step = \"{time_step}\"\nsteps = {steps}\n"
    )
}

fn verdict(bench: &Workbench) -> serde_json::Value {
    let text = fs::read_to_string(bench.path("out/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    summary["verdict"].clone()
}

#[test]
fn quiet_runs_still_say_that_they_are_not_sound() {
    let bench = Workbench::new().file("case.toml", &case("5e-3 s", 100, "gap-linear-1e6", ""));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--quiet", "--no-figures"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (0, ""), "{}", outcome.stderr);
    for words in ["NOT SOUND", "(at stop ", "remedy: set `time_step"] {
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
    }
    let bench = bench.file("case.toml", &case("1e-5 s", 100, "gap-linear-1e6", ""));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--quiet", "--no-figures"]);
    assert_eq!((outcome.stdout.as_str(), outcome.stderr.as_str()), ("", ""));
    assert_eq!(verdict(&bench)["sound"], true);
}

/// What is wrong with a run stays wrong in those that go on from it, however good their own steps are: the state says so by
/// itself.
#[test]
fn what_goes_on_from_an_unsound_run_is_not_sound() {
    let from = |before: &str| format!("{SHORT}\n[start]\nfrom = \"results/{before}\"\n");
    let bench =
        Workbench::new().file("second.toml", &from("first")).file("third.toml", &from("second"));
    let run = |name: &str| {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let verdict = bench.summary(&format!("results/{name}"))["verdict"].clone();
        (verdict, outcome.stderr.contains("whose verdict is NOT SOUND"))
    };
    let goes_on = |name: &str, expected: bool| {
        let (verdict, warned) = run(name);
        let what = verdict["findings"][0]["what"].as_str().unwrap_or_default().to_owned();
        let inherited = what.contains("runs before this one");
        assert!(inherited != expected && warned != expected, "{verdict}");
        assert_eq!(verdict["sound"], expected, "{verdict}");
    };
    let first = |time_step: &str| {
        let text = SHORT.replace("steps = 40", &format!("steps = 40\ntime_step = \"{time_step}\""));
        fs::write(bench.path("first.toml"), text).expect("a file");
        run("first").0["sound"] == true
    };
    assert!(first("7.4e-5 s"));
    goes_on("second", true);
    goes_on("third", true);
    assert!(!first("6e-4 s"));
    goes_on("second", false);
    goes_on("third", false);
    for name in ["first", "second"] {
        fs::remove_file(bench.path(&format!("results/{name}/summary.json"))).expect("a file");
    }
    goes_on("third", false);
    goes_on("second", false);
}

/// √(h/1 mm) has no value beyond the gap.
const NO_NUMBER: &str = "kind = \"law\"\nname = \"root\"\ntitle = \"root of the gap\"\nsource = \"none\"\n\
    [inputs.h]\nunit = \"mm\"\ntitle = \"clearance\"\nrange = [0.1, 3]\n\
    [parameters.k]\nvalue = 1\nunit = \"N\"\ntitle = \"force\"\n\
    [parameters.h_1]\nvalue = 1\nunit = \"mm\"\ntitle = \"one\"\n\
    [outputs.Q]\nunit = \"N\"\ntitle = \"normal force\"\nvalue = 'k*sqrt(h/h_1)'\n";

#[test]
fn a_run_that_diverges_is_not_sound() {
    let bench = Workbench::new()
        .file("case.toml", &case("1e-4 s", 100, "root.law.toml", ""))
        .file("root.law.toml", NO_NUMBER);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    let verdict = verdict(&bench);
    assert_eq!(verdict["sound"], false, "{verdict}");
    let found = &verdict["findings"][0];
    assert_eq!(found["limit"], 100.0, "{found}");
    assert!(found["what"].as_str().expect("words").contains("does not converge"), "{found}");
}

#[test]
fn a_run_that_is_over_is_not_begun_again_by_resuming_it() {
    let bench = Workbench::new().file("case.toml", &case("1e-5 s", 2000, "gap-linear-1e6", ""));
    assert_eq!(bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]).status, 0);
    let read = || fs::read(bench.path("out/history.csv")).expect("a history");
    let before = read();
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    for words in ["`out` cannot be resumed", "because the run is finished", "without `--resume`"] {
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
    }
    assert!(read() == before);
    // A point that nobody can read is no reason to throw the history away either.
    fs::write(bench.path("out/checkpoint.bin"), b"no such thing").expect("it can be written");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("`checkpoint.bin` is damaged"), "{}", outcome.stderr);
    assert!(read() == before);
    assert!(bench.path("out/summary.json").exists());
    // What a run leaves that is killed at once.
    fs::remove_file(bench.path("out/checkpoint.bin")).expect("it is there");
    fs::remove_file(bench.path("out/summary.json")).expect("it is there");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("stopped before it wrote the first one"), "{}", outcome.stderr);
}

#[test]
fn turning_faster_than_the_steps_show_is_refused_whatever_the_cycle_is() {
    let unbalance = "unbalance = { eccentricity = \"1 mm\", speed = \"62831.853 rad/s\" }";
    let text = case("1e-4 s", 5000, "gap-linear-1e6", unbalance) + "cycle_frequency = \"10 Hz\"\n";
    let bench = Workbench::new().file("case.toml", &text);
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("a revolution of the unbalance"), "{}", outcome.stderr);
    // Where the program chooses the steps, rows must show it.
    let text = case("1e-4 s", 0, "gap-linear-1e6", &unbalance.replace("62831.853", "314.159"))
        .replace(
            "time_step = \"1e-4 s\"\nsteps = 0",
            "time_step = \"auto\"\noutput_step = \"5 ms\"\nduration = \"0.4 s\"",
        );
    let bench = bench.file("case.toml", &text);
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("has 4 rows of `output_step`"), "{}", outcome.stderr);
}

/// Runs a case, and gives its verdict.
fn judged(text: &str) -> serde_json::Value {
    let bench = Workbench::new().file("case.toml", text);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    verdict(&bench)
}

/// What is found in a case at a step that does not resolve it, of the part that is named; at a short step it is sound.
fn found_in(case: &dyn Fn(&str) -> String, part: &str) {
    let wrong = judged(&case("4e-4 s"));
    assert_eq!(wrong["sound"], false, "{wrong}");
    let findings = wrong["findings"].as_array().expect("a list");
    let found = findings
        .iter()
        .filter_map(|own| own["what"].as_str())
        .any(|what| what.contains("faster than the step") && what.contains(part));
    assert!(found, "{wrong}");
    let right = judged(&case("1e-5 s"));
    assert_eq!(right["sound"], true, "{right}");
}

/// Two rotors on a coupling, at 1 kHz against each other, of which one swings as a whole.
fn coupled(speeds: [&str; 2], turns: [&str; 2], time_step: &str) -> String {
    let body = |name: &str, turns: &str, speed: &str| {
        format!(
            "[body.{name}]\nturns = \"{turns}\"\nmass = \"10 kg\"\npolar_inertia = \"1e-3 kg*m^2\"\n{speed}\n\
             [joint.held_{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"1e5 N/m\", yy = \"1e5 N/m\" }}\n\
             damping = {{ xx = \"200 N*s/m\", yy = \"200 N*s/m\" }}\n"
        )
    };
    format!(
        "title = \"two rotors on a coupling\"\n{}{}[joint.c]\nkind = \"coupling\"\n\
         first = {{ body = \"a\" }}\nsecond = {{ body = \"b\" }}\nstiffness = \"1.9739e4 N*m/rad\"\n\
         [loads.w]\nbody = \"a\"\nforce = \"-100 N\"\n\
         [march]\ntime_step = \"{time_step}\"\nduration = \"0.2 s\"\n",
        body("a", turns[0], speeds[0]),
        body("b", turns[1], speeds[1])
    )
}

#[test]
fn torsion_is_judged_by_itself_however_far_a_body_swings() {
    let free = ["initial_speed = \"3010 rpm\"", "initial_speed = \"2990 rpm\""];
    found_in(&|step| coupled(free, ["free", "free"], step), "(rotation of ");
    // Against a rotation that is told: what turns with it is no motion.
    let told = ["initial_speed = \"3010 rpm\"", "speed = \"3000 rpm\""];
    found_in(&|step| coupled(told, ["free", "prescribed"], step), "(rotation of a)");
}

/// A body of 1000 kg, and one of 1 kg that rings at 1 kHz.
fn side_by_side(time_step: &str) -> String {
    format!(
        "title = \"a light body beside a heavy one\"\n\
         [body.heavy]\nturns = \"no\"\nmass = \"1000 kg\"\nstiffness = {{ x = \"1e7 N/m\", y = \"1e7 N/m\" }}\n\
         damping = {{ x = \"1e4 N*s/m\", y = \"1e4 N*s/m\" }}\n\
         [body.light]\nturns = \"no\"\nmass = \"1 kg\"\n\
         stiffness = {{ x = \"3.94784e7 N/m\", y = \"3.94784e7 N/m\" }}\n\
         [loads.w]\nbody = \"heavy\"\nforce = \"-10000 N\"\n\
         [loads.v]\nbody = \"light\"\nforce = \"-100 N\"\n\
         [joint.j]\nkind = \"bushing\"\nfirst = {{ body = \"heavy\" }}\nsecond = {{ body = \"light\" }}\n\
         stiffness = {{ xx = \"1 N/m\", yy = \"1 N/m\" }}\n\
         [march]\ntime_step = \"{time_step}\"\nduration = \"0.2 s\"\n"
    )
}

#[test]
fn a_light_body_is_judged_beside_a_heavy_one_unless_it_hardly_moves() {
    found_in(&side_by_side, "(light)");
    // A hundredth of a thousandth of what the heavy body moves by.
    let still = side_by_side("4e-4 s").replace("\"-100 N\"", "\"-0.1 N\"");
    assert_eq!(judged(&still)["sound"], true);
}

#[test]
fn a_rotor_that_only_turns_on_a_spring_is_sound() {
    let verdict = judged(
        "title = \"a rotor on a torsion spring\"\n\
         [body.a]\nturns = \"free\"\nmass = \"1 kg\"\npolar_inertia = \"1e-3 kg*m^2\"\n\
         [joint.h]\nkind = \"bushing\"\nfirst = { body = \"a\" }\n\
         stiffness = { xx = \"1e6 N/m\", yy = \"1e6 N/m\" }\n\
         [joint.c]\nkind = \"coupling\"\nfirst = { body = \"a\" }\nstiffness = \"10 N*m/rad\"\n\
         [drives.d]\nbody = \"a\"\ntorque = \"1 N*m\"\ntarget_speed = \"3000 rpm\"\n\
         [march]\ntime_step = \"1e-4 s\"\nduration = \"0.2 s\"\n",
    );
    assert_eq!(verdict["sound"], true, "{verdict}");
    // (ωΔt)³/12 at ωΔt = 0.01.
    let error = verdict["measures"]["local_error"].as_f64().expect("a number");
    assert!((1e-8..1e-7).contains(&error), "{verdict}");
}

#[test]
fn a_body_that_leaves_the_machine_is_named() {
    let verdict = judged(
        "title = \"a bushing of negative stiffness\"\n\
         [body.a]\nturns = \"no\"\nmass = \"1 kg\"\n\
         [joint.h]\nkind = \"bushing\"\nfirst = { body = \"a\" }\n\
         stiffness = { xx = \"-1e6 N/m\", yy = \"-1e6 N/m\" }\n\
         [loads.l]\nbody = \"a\"\nforce = \"1 N\"\n\
         [march]\ntime_step = \"1e-4 s\"\nduration = \"0.05 s\"\n",
    );
    assert_eq!(verdict["sound"], false, "{verdict}");
    let found = &verdict["findings"][0];
    assert!(found["what"].as_str().expect("words").contains("larger than the machine (a)"));
    assert_eq!(found["unit"], "m");
    assert!(found["remedy"].as_str().expect("words").contains("negative or missing"), "{found}");
}
