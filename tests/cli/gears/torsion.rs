//! What `whirl torsion` says of a train, and what is refused.

use super::train::{PLAIN, RADII};
use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;

/// Modes with their torsion, critical speeds, separation and torques.
#[test]
fn torsion_names_modes_critical_speeds_and_torques() {
    let rest = "[analysis.train]\nkind = \"torsion\"\nof = \"motor\"\nspeeds = \"0 rpm .. 12000 rpm, 7\"\norders = [1, 3]\n\
                operation = \"2900 rpm .. 3100 rpm\"\nmargin = 0.15\ncount = 4\n";
    let case = PLAIN.case([100.0, 200.0], rest);
    let bench = Workbench::new().file("case.toml", &case);
    let said = ran(&bench, &["analyse", "case.toml", "--out", "out"]).stdout;
    let own = numbers(&bench, "out/train.modes.csv", "frequency_hz");
    let bodies = column(&bench, "out/train.modes.csv", "body");
    let first: Vec<f64> =
        (0..own.len()).filter(|k| bodies[*k] == "motor").map(|k| own[k]).collect();
    assert_eq!(first.len(), 4);
    let expected = PLAIN.frequencies();
    for hertz in &first {
        assert!(expected.iter().any(|other| (hertz / other - 1.0).abs() < 1e-9), "{hertz}");
    }
    // The first two modes of a chain have one node and two.
    assert!((first[0] / expected[0] - 1.0).abs() < 1e-9, "{said}");
    let shares = numbers(&bench, "out/train.modes.csv", "torsional_share");
    assert!(shares.iter().all(|own| (0.1..=1.0).contains(own)), "{shares:?}");
    // Orders of both shafts: 1 and 3 times the speed, and half of that of the wheel.
    let what = column(&bench, "out/train.interference.csv", "what");
    let orders = numbers(&bench, "out/train.interference.csv", "order");
    let speeds = numbers(&bench, "out/train.interference.csv", "speed_rpm");
    let hertz = numbers(&bench, "out/train.interference.csv", "frequency_hz");
    let mut found = 0;
    for k in (0..what.len()).filter(|k| what[*k] == "critical speed") {
        assert!((hertz[k] / (orders[k] * speeds[k] / 60.0) - 1.0).abs() < 1e-9);
        found += 1;
    }
    let within =
        |order: f64| first.iter().filter(|hertz| **hertz * 60.0 / order <= 12000.0).count();
    assert_eq!(found, [1.0, 3.0, 0.5, 1.5, 20.0].map(within).into_iter().sum::<usize>(), "{said}");
    // 3 × motor at 2900 to 3100 rpm is 145 to 155 Hz, and the first mode 1.3 % below that.
    assert!(said.contains("in operation, less than 15 %"), "{said}");
    assert!((1.0 - first[0] / 145.0 - 0.01303).abs() < 1e-5, "{first:?}");
    assert!(said.contains("mode 1 is 1.3 % from 3 × motor"), "{said}");
    let of = |name: &str| numbers(&bench, "out/train.torques.csv", name);
    let joints = column(&bench, "out/train.torques.csv", "joint");
    assert_eq!(joints, ["mesh", "input", "outgoing"]);
    let force = 100.0 / (RADII[0] * 20_f64.to_radians().cos());
    for (found, expected) in [
        (of("torque_on_first_Nm"), [-100.0, -100.0, 200.0]),
        (of("torque_on_second_Nm"), [-200.0, 100.0, -200.0]),
    ] {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
        }
    }
    assert!((of("force_of_teeth_N")[0] / force - 1.0).abs() < 1e-6);
    for file in ["train.csv", "train.svg", "train.png"] {
        assert!(bench.path(&format!("out/{file}")).is_file(), "{file}");
    }
}

/// Speeds that are prescribed hold no end of a train: modes are those of free bodies, and the run says so.
#[test]
fn prescribed_speeds_hold_no_end_of_a_train() {
    let free = PLAIN.case([0.0; 2], "");
    let given = |name: &'static str, speed: f64| {
        let from = format!("initial_speed = \"{speed} rpm\"\n");
        move |text: String| {
            let (head, tail) = text.split_once(&format!("[body.{name}]")).expect("a body");
            let tail = tail.replacen("turns = \"free\"", "turns = \"prescribed\"", 1);
            format!("{head}[body.{name}]{}", tail.replacen(&from, &from.replace("initial_", ""), 1))
        }
    };
    let one = given("motor", 3000.0)(free.clone());
    let all = given("load", -1500.0)(given("wheel", -1500.0)(given("pinion", 3000.0)(one.clone())));
    let torsion = |case: &str| {
        let bench = Workbench::new().file("case.toml", case);
        let arguments = ["torsion", "case.toml", "--of", "motor", "--count", "4", "--out", "out"];
        let said = ran(&bench, &arguments).stdout;
        (numbers(&bench, "out/torsion.modes.csv", "frequency_hz"), said)
    };
    let (expected, said) = torsion(&free);
    assert!(!said.contains("turns freely in these modes"), "{said}");
    for case in [one, all] {
        let case = case.replace("[loads.motor]", "[loads.motors]");
        let (found, said) = torsion(&case);
        assert_eq!(found.len(), expected.len());
        assert!(found.iter().zip(&expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-10), "{found:?}");
        assert!(
            said.contains("motor turns freely in these modes, though its speed is prescribed"),
            "{said}"
        );
    }
}

/// A coupling between displaced axes carries the couple alone, so that the frequency is that of two inertias on one axis; it says so.
#[test]
fn a_coupling_between_displaced_axes_carries_the_couple_alone() {
    for (axis, apart) in [("0 mm", false), ("180 mm", true)] {
        let case = format!(
            "title = \"two bodies\"\n[body.first]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\nmass = \"10 kg\"\n\
             polar_inertia = \"0.1 kg*m^2\"\n[body.second]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\n\
             axis = [\"0 mm\", \"{axis}\"]\nmass = \"10 kg\"\npolar_inertia = \"0.05 kg*m^2\"\n\
             [joint.between]\nkind = \"coupling\"\nfirst = {{ body = \"first\" }}\nsecond = {{ body = \"second\" }}\n\
             stiffness = \"1e4 N*m/rad\"\n\
             [joint.one]\nkind = \"bushing\"\nfirst = {{ body = \"first\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"2e7 N/m\" }}\n\
             [joint.other]\nkind = \"bushing\"\nfirst = {{ body = \"second\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"2e7 N/m\" }}\n"
        );
        let bench = Workbench::new().file("case.toml", &case);
        let said = ran(&bench, &["torsion", "case.toml", "--of", "first", "--out", "out"]).stdout;
        let found = numbers(&bench, "out/torsion.modes.csv", "frequency_hz");
        let expected = (1e4 * (1.0 / 0.1 + 1.0 / 0.05_f64)).sqrt() / std::f64::consts::TAU;
        assert!((found[0] / expected - 1.0).abs() < 1e-9, "{found:?}, not {expected}");
        let words = "the axes of first and second are 180 mm apart: the coupling between carries the couple between them and no force";
        assert_eq!(said.contains(words), apart, "{said}");
    }
}

#[test]
fn gears_that_cannot_be_are_refused() {
    let case = PLAIN.case([0.0; 2], "[march]\ntime_step = \"5e-6 s\"\nsteps = 10\n");
    let axis = "axis = [\"0.000000000000007 mm\", \"120.000000000000000 mm\"]\n";
    assert!(case.contains(axis), "{case}");
    let prescribed = case
        .replace("turns = \"free\"", "turns = \"prescribed\"")
        .replace("initial_speed", "speed")
        .replace("\"-1500 rpm\"", "\"-1499 rpm\"");
    for (text, message, help) in [
        (
            case.replace("[20, 40]", "[20, 40.5]"),
            "`teeth` are two whole numbers",
            "teeth = [20, 40]",
        ),
        (case.replace("[20, 40]", "[20]"), "`teeth` are two whole numbers", "teeth = [20, 40]"),
        (case.replace("teeth = [20, 40]\n", ""), "`teeth` is missing", "pitch_radii"),
        (
            case.replace("mesh_stiffness = \"200000000 N/m\"\n", ""),
            "`mesh_stiffness` is missing",
            "along the line of action",
        ),
        (case.replace(axis, ""), "turn about one axis, where no gear can join them", "axis = ["),
        (
            case.replace("teeth = [20, 40]", "pitch_radii = [\"40 mm\", \"90 mm\"]"),
            "are 120 mm apart, and the pitch radii say 130 mm",
            "\"130 mm\"]",
        ),
        (
            case.replace("[20, 40]\n", "[20, 40]\npitch_radii = [\"40 mm\", \"79 mm\"]\n"),
            "the ratio of the pitch radii is",
            "leave `pitch_radii` out",
        ),
        (
            case.replace("[20, 40]\n", "[20, 20]\ninternal = true\n"),
            "an internal gear is larger",
            "sizes",
        ),
        (case.replace("\"20 deg\"", "\"60 deg\""), "less than 45°", "pressure_angle"),
        (case.replace("[20, 40]\n", "[20, 40]\nbacklash = \"-20 um\"\n"), "`backlash`", ""),
        (prescribed, "`wheel` turns with -1499 rpm and `pinion` with 3000 rpm", "-1500 rpm"),
        (
            case.replace("initial_speed = \"-1500 rpm\"", "initial_speed = \"1500 rpm\""),
            "has the ratio -0.5",
            "leave the `initial_speed` out of `[body.wheel]`",
        ),
        (
            case.replace("second = { body = \"wheel\" }\nteeth", "teeth"),
            "the ground does not turn",
            "turns = \"free\"",
        ),
        (
            case.replacen("kind = \"bushing\"", "kind = \"bearing\"\nlaw = \"gear-mesh\"", 1)
                .replacen(
                    "first = { body = \"pinion\" }\nstiffness",
                    "journal = { body = \"pinion\" }\nx",
                    1,
                ),
            "is a law of the teeth of gears",
            "kind = \"gear\"",
        ),
    ] {
        let bench = Workbench::new().file("case.toml", &text);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 2, "{message}: {}", outcome.stdout);
        for part in [message, help] {
            assert!(outcome.stderr.contains(part), "{part}: {}", outcome.stderr);
        }
        assert!(outcome.stderr.contains("case.toml:"), "{}", outcome.stderr);
    }
}

/// A wheel without an `initial_speed` starts with that of its teeth.
#[test]
fn speeds_follow_through_the_teeth() {
    let case = PLAIN.case([0.0; 2], "[march]\ntime_step = \"5e-6 s\"\nsteps = 10\n");
    let (head, tail) = case.split_once("[body.wheel]").expect("a wheel");
    let left_out = tail.replacen("initial_speed = \"-1500 rpm\"\n", "", 1);
    let bench = Workbench::new().file("case.toml", &format!("{head}[body.wheel]{left_out}"));
    let said = ran(&bench, &["check", "case.toml"]).stdout;
    assert!(said.contains("wheel: free, from -1500 rpm"), "{said}");
    assert!(said.contains("speed ratio -0.5, pitch radii 40 and 80 mm"), "{said}");
}
