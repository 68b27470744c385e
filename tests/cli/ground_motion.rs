//! `[ground_motion]`: machines on a ground that is accelerated, against closed forms and against gravity, of which it is one.

use std::fs;

use crate::analyses::{numbers, ran};
use crate::lost_work;
use crate::workbench::Workbench;

/// Standard gravity (m/s²).
const G: f64 = 9.80665;

/// A mass on a spring and a damper far from its stop, for so many steps.
fn mass(more: &str, stiffness: &str, march: &str) -> String {
    format!(
        "title = \"a shaken mass\"\n{more}[mass]\nmass = \"2 kg\"\nstiffness = \"{stiffness}\"\n\
         [[stop]]\nside = \"above\"\ngap = \"10 m\"\nlaw = \"gap-linear-1e6\"\n\
         [march]\n{march}\nforce_tolerance = \"1e-9 N\"\n"
    )
}

const STEPS: &str = "time_step = \"1e-4 s\"\nsteps = 3000";
const SHAKEN: &str = "[ground_motion]\ntable = \"record.csv\"\n";

fn history(bench: &Workbench, name: &str) -> Vec<f64> {
    bench.history("out").column(name).to_vec()
}

fn run(bench: &Workbench, more: &[&str]) -> String {
    let line = [&["run", "case.toml", "--out", "out", "--no-figures"][..], more].concat();
    ran(bench, &line).stdout
}

/// A ground that sets out with a₀ leaves the mass behind: x = −a₀/ω² (1 − cos ωt), seen from it. By the trapezoidal rule ω is
/// (ωΔt)²/12 too small: after a time t that is ωt (ωΔt)²/12 of the amplitude.
#[test]
fn a_mass_on_a_spring_is_left_behind_as_the_closed_form_says() {
    let bench = Workbench::new()
        .file("case.toml", &mass(SHAKEN, "8e3 N/m", STEPS))
        .file("record.csv", "time [s], x [g]\n0, 0.1\n1, 0.1\n");
    run(&bench, &[]);
    let (omega, amplitude) = ((8e3_f64 / 2.0).sqrt(), 0.1 * G / (8e3 / 2.0));
    let (times, found) = (history(&bench, "t_s"), history(&bench, "X1_um"));
    let allowed = amplitude * (omega * 0.3) * (omega * 1e-4) * (omega * 1e-4) / 12.0 * 1.1;
    for (t, own) in times.iter().zip(&found) {
        let known = -amplitude * (1.0 - (omega * t).cos());
        assert!((1e-6 * own - known).abs() < allowed + 1e-12, "{t}: {own}, {known}");
    }
    // In steps that the program chooses, to their tolerance of the motion.
    let march =
        "time_step = \"auto\"\nstep_tolerance = 1e-5\noutput_step = \"2 ms\"\nduration = \"0.3 s\"";
    fs::write(bench.path("case.toml"), mass(SHAKEN, "8e3 N/m", march)).unwrap();
    run(&bench, &[]);
    let (times, found) = (history(&bench, "t_s"), history(&bench, "X1_um"));
    for (t, own) in times.iter().zip(&found) {
        let known = -amplitude * (1.0 - (omega * t).cos());
        assert!((1e-6 * own - known).abs() < 2e-2 * amplitude, "{t}: {own}, {known}");
    }
}

/// What nothing holds stays where it is in space: seen from the ground it has minus the way of the ground, twice the integral of
/// a table of straight lines, which the trapezoidal rule takes to (Δt)²/12 of a.
#[test]
fn a_mass_that_nothing_holds_stays_in_space() {
    let record =
        "time [ms]; NS [m/s^2]; EW [g]\n0; 0; 0.5\n100; 3; 0.1\n200; -3; 0.1\n300; 0; 0.1\n";
    let ground = "[ground_motion]\ntable = \"record.csv\"\nx = \"NS\"\ny = \"EW\"\nfactor = 2\n";
    let bench = Workbench::new()
        .file("case.toml", &mass(ground, "0 N/m", STEPS))
        .file("record.csv", record);
    run(&bench, &[]);
    let (times, x) = (history(&bench, "t_s"), history(&bench, "X1_um"));
    let rows = [[0.0, 0.0], [0.1, 3.0], [0.2, -3.0], [0.3, 0.0]];
    // Velocity and way at the end of a line of a.
    let mut at = [0.0, 0.0];
    let mut known = Vec::new();
    for pair in rows.windows(2) {
        let [[from, a], [to, b]] = [pair[0], pair[1]];
        let slope = (b - a) / (to - from);
        let moved = |t: f64| {
            let s = t - from;
            let speed = at[0] + a * s + slope * s * s / 2.0;
            [speed, at[1] + at[0] * s + a * s * s / 2.0 + slope * s * s * s / 6.0]
        };
        let inside = times.iter().filter(|t| **t > from + 1e-9 && **t <= to + 1e-9);
        known.extend(inside.map(|t| -2.0 * moved(*t)[1]));
        at = moved(to);
    }
    assert_eq!(known.len(), x.len());
    for ((t, own), known) in times.iter().zip(&x).zip(&known) {
        assert!((1e-6 * own - known).abs() < 1e-4 * 1e-4 * 6.0, "{t}: {own}, {known}");
    }
    assert!(known.last().is_some_and(|own| own.abs() > 0.05));
}

/// A rigid rotor off the middle of two bushings, with an unbalance.
fn rotor(more: &str) -> String {
    let joint = |name: &str, z: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"{z}\" }}\naxial_stiffness = \"1e6 N/m\"\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"2e6 N/m\", xy = \"1e5 N/m\" }}\ndamping = {{ xx = \"300 N*s/m\", yy = \"300 N*s/m\" }}\n"
        )
    };
    format!(
        "title = \"a rigid rotor\"\n{more}[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"12 kg\"\n\
         z = \"50 mm\"\npolar_inertia = \"0.05 kg*m^2\"\ntransverse_inertia = \"0.4 kg*m^2\"\nmoves_along_z = true\n{}{}\
         [march]\ntime_step = \"1e-4 s\"\nsteps = 1500\nforce_tolerance = \"1e-9 N\"\n",
        joint("left", "-0.3 m"),
        joint("right", "0.3 m")
    )
}

/// Columns of a history without times, angles, what a step took, and the couple that keeps the speed, which is no sum.
fn moved(bench: &Workbench) -> Vec<(String, Vec<f64>)> {
    let text = bench.history_text("out");
    let names = text.lines().next().expect("a head").split(',').map(str::to_owned);
    let others = ["t_s", "theta", "omega", "iterations", "M_"];
    let own = names.filter(|name| !others.iter().any(|other| name.contains(other)));
    own.map(|name| (name.clone(), history(bench, &name))).collect()
}

/// The machine is linear: what the ground does along x, y and z adds up, to the tolerance of the steps.
#[test]
fn motions_along_the_axes_add_up() {
    let record = "time [s], x [m/s^2], y [m/s^2], z [m/s^2]\n0, 0, 1, 0\n0.03, 4, -2, 3\n0.05, -4, 1, -3\n0.1, 0, 0, 0\n";
    let of = |keep: &[usize]| {
        let rows: Vec<String> = record
            .lines()
            .map(|line| {
                let cells: Vec<&str> = line.split(", ").collect();
                let own = std::iter::once(0).chain(keep.iter().copied());
                own.map(|k| cells[k]).collect::<Vec<_>>().join(", ")
            })
            .collect();
        let bench = Workbench::new()
            .file("case.toml", &rotor(SHAKEN))
            .file("record.csv", &(rows.join("\n") + "\n"));
        run(&bench, &[]);
        moved(&bench)
    };
    let (all, x, y, z) = (of(&[1, 2, 3]), of(&[1]), of(&[2]), of(&[3]));
    let mut moving = 0;
    for (k, (name, whole)) in all.iter().enumerate() {
        let peak = whole.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        moving += usize::from(peak > 1e-3);
        for (row, own) in whole.iter().enumerate() {
            let sum = x[k].1[row] + y[k].1[row] + z[k].1[row];
            assert!((own - sum).abs() < 1e-7 * peak + 1e-9, "{name}, row {row}");
        }
    }
    assert!(moving >= 8, "hardly anything moves");
}

/// In a ground that falls nothing has a weight: what hangs in its springs stays where they have no load.
#[test]
fn a_machine_that_falls_with_its_ground_has_no_weight() {
    let more = format!(
        "gravity = [\"-{G} m/s^2\", \"0 m/s^2\", \"3 m/s^2\"]\n{SHAKEN}[start]\nkind = \"equilibrium\"\n"
    );
    let bench = Workbench::new()
        .file("case.toml", &rotor(&more))
        .file("record.csv", "time [s], x [g], z [m/s^2]\n0, -1, 3\n1, -1, 3\n");
    run(&bench, &[]);
    for (name, own) in moved(&bench) {
        assert!(own.iter().all(|own| own.abs() < 1e-9), "{name}");
    }
    // Without the fall the springs carry it, and analyses see both as they are at t = 0.
    ran(
        &bench,
        &["coefficients", "case.toml", "--speed", "3000 rpm", "--out", "fall", "--no-figures"],
    );
    let force = numbers(&bench, "fall/coefficients.csv", "force_x_N");
    assert!(force.iter().all(|own| own.abs() < 1e-9), "{force:?}");
    fs::write(bench.path("record.csv"), "time [s], x [g]\n0, 0\n1, -1\n").unwrap();
    ran(
        &bench,
        &["coefficients", "case.toml", "--speed", "3000 rpm", "--out", "held", "--no-figures"],
    );
    let force: f64 = numbers(&bench, "held/coefficients.csv", "force_x_N").iter().sum();
    assert!((force / (12.0 * G) - 1.0).abs() < 1e-9, "{force}");
}

/// A ground with a constant acceleration is a gravity the other way: for flexible bodies that turn, off-axis masses, bodies that turn
/// freely, films, and the short form; to the tolerance of steps, which round differently.
#[test]
fn a_constant_acceleration_is_a_gravity() {
    let heavy = "gravity = [\"3 m/s^2\", \"-2 m/s^2\", \"0 m/s^2\"]\n";
    let steps = "[march]\nsteps = 150\n";
    let off = "[body.rotor.added.one]\nmass = \"0.3 kg\"\nradius = \"30 mm\"\nz = \"100 mm\"\n";
    for (case, more) in [("unbalance", off), ("hu2003-5", ""), ("turbocharger", ""), ("weight", "")]
    {
        let include = format!("include = \"{case}.toml\"\ntitle = \"{case}\"\n");
        let start = if case == "weight" { "[start]\nkind = \"rest\"\n" } else { "" };
        let none = "gravity = [\"0 m/s^2\", \"0 m/s^2\", \"0 m/s^2\"]\n";
        let bench = Workbench::new()
            .file("case.toml", &format!("{include}{heavy}{more}{start}{steps}"))
            .file("record.csv", "time [s], x [m/s^2], y [m/s^2]\n0, -3, 2\n9, -3, 2\n");
        run(&bench, &[]);
        let weighed = moved(&bench);
        let text = format!("{include}{none}{SHAKEN}{more}{start}{steps}");
        fs::write(bench.path("case.toml"), text).unwrap();
        run(&bench, &[]);
        for ((name, own), (_, other)) in weighed.iter().zip(moved(&bench)) {
            let peak = own.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
            let off = own.iter().zip(&other).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(off <= 1e-5 * peak + 1e-9, "{case}, {name}: {off} of {peak}");
        }
    }
}

/// Twice the ground, twice the motion; and the check says what it is.
#[test]
fn points_of_a_sweep_have_their_ground() {
    let record = "time [s], x [g]\n0, 0\n0.05, 0.2\n0.1, -0.2\n0.2, 0\n";
    let bench = Workbench::new()
        .file("case.toml", &mass(SHAKEN, "8e3 N/m", STEPS))
        .file("record.csv", record);
    let vary = ["--vary", "ground_motion.factor=[1, 2]", "--no-figures"];
    ran(&bench, &[&["sweep", "case.toml", "--out", "swept"][..], &vary].concat());
    let most = numbers(&bench, "swept/table.csv", "X1_um.max");
    assert!(most[0] > 1.0 && (most[1] / most[0] - 2.0).abs() < 1e-8, "{most:?}");
    fs::write(bench.path("case.toml"), rotor(SHAKEN)).unwrap();
    let text = ran(&bench, &["check", "case.toml"]).stdout;
    assert!(
        text.contains("ground motion by table `record.csv`: up to 1.961 m/s² along x"),
        "{text}"
    );
}

/// A run that is killed within a record goes on to the bytes of one that never was.
#[test]
fn a_killed_run_on_shaken_ground_is_resumed() {
    let mut record = "time [s], x [g]\n".to_owned();
    for row in 0..400 {
        let time = 3.7e-3 * f64::from(row);
        record += &format!("{time}, {}\n", 0.3 * (17.0 * time).sin() * (41.0 * time).cos());
    }
    let case =
        lost_work::case(lost_work::MANY, "").replacen("[[stop]]", &format!("{SHAKEN}[[stop]]"), 1);
    let bench = Workbench::new().file("case.toml", &case).file("record.csv", &record);
    lost_work::begin_and_kill(&bench);
    lost_work::resumes(&bench);
}

/// A record ends: no cycle goes on after it.
#[test]
fn a_record_has_no_periodic_motion() {
    let analyses = "[analysis.cycle]\nkind = \"periodic\"\n\
                    [analysis.own]\nkind = \"periodic\"\nself_excited = true\nnear = \"20 Hz\"\n";
    let bench = Workbench::new()
        .file("case.toml", &format!("{}{analyses}", rotor(SHAKEN)))
        .file("record.csv", "time [s], x [g]\n0, 0\n0.05, 0.2\n0.1, 0\n");
    for (command, status) in [("analyse", 2), ("check", 0)] {
        let outcome = bench.whirl(&[command, "case.toml"]);
        assert_eq!(outcome.status, status, "{}", outcome.stderr);
        for words in [
            "the analysis `cycle` cannot be done: the motion of the ground goes by a table over time",
            "leave out `[ground_motion]`",
            "the analysis `own` cannot be done: the motion of the ground drives the machine",
        ] {
            assert!(outcome.stderr.contains(words), "{command}: {words}: {}", outcome.stderr);
        }
    }
}

#[test]
fn what_is_wrong_with_a_record_is_said_at_its_place() {
    let wrong = [
        ("time [s], x [mm]\n0, 1\n1, 1\n", "", "the column `x` measures", "x [g]"),
        ("time [g], x [g]\n0, 1\n1, 1\n", "", "the column `time` measures", "time [s]"),
        ("time [s], x [g]\n0, 1\n0, 1\n", "", "rise from row to row", "sort the rows"),
        ("time [s], a [g]\n0, 1\n1, 1\n", "", "has no column `x`, `y` or `z`", "x = \"NS\""),
        ("time [s], NS [g]\n0, 1\n1, 1\n", "x = \"NW\"\n", "NW", "NS"),
        ("t [s], x [g]\n0, 1\n1, 1\n", "", "time", "t"),
        ("time [s], x [g]\n0, 1\n", "", "2 to", "rows"),
    ];
    for (record, more, message, help) in wrong {
        let bench = Workbench::new()
            .file("case.toml", &mass(&format!("{SHAKEN}{more}"), "8e3 N/m", STEPS))
            .file("record.csv", record);
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{record}: {}", outcome.stderr);
        for words in [message, help] {
            assert!(outcome.stderr.contains(words), "{record}: {words}: {}", outcome.stderr);
        }
        assert!(!bench.path("out").exists());
    }
    let bench = Workbench::new().file("case.toml", &mass(SHAKEN, "8e3 N/m", STEPS));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("record.csv"), "{}", outcome.stderr);
    // A mass moves along x and y alone.
    let bench = bench.file("record.csv", "time [s], x [g], z [g]\n0, 1, 1\n1, 1, 1\n");
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert!(
        outcome.stderr.contains("`[ground_motion]` along z has no effect"),
        "{}",
        outcome.stderr
    );
}

/// A record that does not begin and end at rest, and one beside the run, are warned of; one that does is not.
#[test]
fn records_that_leave_the_ground_moving_are_warned_of() {
    let head = "time [s], x [g]\n";
    for (rows, words) in [
        ("0, 0\n0.1, 1\n0.2, 0\n", &[][..]),
        // The run ends before it.
        ("0, 0\n0.1, 1\n0.4, 1\n", &[]),
        ("0, 0\n0.1, 1\n", &["ends at 0.1 s with 9.807 m/s² along x"]),
        ("0.1, 1\n0.2, 0\n", &["begins with 9.807 m/s² along x"]),
        ("-1, 0\n0.1, 1\n0.2, 0\n", &["what is before t = 0 does not act"]),
        ("5, 1\n6, 0\n", &["begins at 5 s, and the run ends at", "begins with 9.807 m/s²"]),
    ] {
        let bench = Workbench::new()
            .file("case.toml", &mass(SHAKEN, "8e3 N/m", STEPS))
            .file("record.csv", &format!("{head}{rows}"));
        let said = ran(&bench, &["check", "case.toml"]).stderr;
        assert_eq!(said.matches("the record `record.csv`").count(), words.len(), "{rows}: {said}");
        words.iter().for_each(|own| assert!(said.contains(own), "{own} in {said}"));
    }
}

/// Records of instruments that write decimal commas are read as those with points; one without names is refused.
#[test]
fn records_may_have_decimal_commas() {
    let points = "time [s], x [g]\n0, 0\n0.1, 0.25\n0.2, -0.5\n";
    let bench = Workbench::new()
        .file("case.toml", &mass(SHAKEN, "8e3 N/m", STEPS))
        .file("record.csv", points);
    run(&bench, &[]);
    let known = bench.history_text("out");
    let semicolons = points.replace(',', ";").replace('.', ",");
    fs::write(bench.path("record.csv"), semicolons).unwrap();
    run(&bench, &[]);
    assert!(bench.history_text("out") == known);
    let checked = ran(&bench, &["check", "case.toml"]).stdout;
    assert!(
        checked.contains("ground motion by table `record.csv`: up to 4.903 m/s² along x"),
        "{checked}"
    );
    fs::write(bench.path("record.csv"), "0, 0\n0.1, 0.25\n").unwrap();
    let refused = bench.whirl(&["check", "case.toml"]);
    assert_eq!(refused.status, 2);
    assert!(refused.stderr.contains("no line of names"), "{}", refused.stderr);
}

/// What changes over time is told as the reason where no steady state is, and what stays as it is changes nothing.
#[test]
fn a_record_that_changes_late_is_why_nothing_is_steady() {
    let march = "time_step = \"1e-3 s\"\nduration = \"4 s\"\ncycle_frequency = \"10 Hz\"";
    let record = |rows: &str| format!("time [s], x [g]\n0, 0.1\n{rows}");
    let case =
        mass(SHAKEN, "8e3 N/m", march).replace("stiffness", "damping = \"100 N*s/m\"\nstiffness");
    let bench = Workbench::new().file("case.toml", &case).file("record.csv", &record("50, 0.1\n"));
    assert!(run(&bench, &[]).contains("steady from "));
    fs::write(bench.path("record.csv"), record("3, 0.1\n3.1, 0\n")).unwrap();
    let said = run(&bench, &[]);
    let why = "not steady: what is given over time changes until 3.1 s, and the run ends less than 17 cycles later";
    assert!(said.contains(why), "{said}");
}
