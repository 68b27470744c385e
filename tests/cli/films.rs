//! Oil films in joints of cases: against tables and closed forms, in marches and analyses, and what is refused.

use std::fs;

use whirl_tests::validation::Section;

use crate::workbench::Workbench;

/// A rotor that does not tilt in one film of this clearance (µm), under a force (N).
fn rotor((clearance, joint): (f64, &str), force: [f64; 2], rest: &str) -> String {
    let [x, y] = force;
    format!(
        r#"title = "a rotor in a film"
[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
mass = "5 kg"
polar_inertia = "0.01 kg*m^2"

[joint.b]
kind = "bearing"
journal = {{ body = "rotor" }}
radial_clearance = "{clearance} um"
journal_radius = "25 mm"
{joint}

[loads.pull]
body = "rotor"
force = ["{x} N", "{y} N", "0 N"]

[start]
kind = "equilibrium"

[march]
time_step = "1e-4 s"
duration = "20 ms"
{rest}"#
    )
}

const FILM: [&str; 2] = ["pmax_f_MPa", "hmin_f_um"];
const OUTPUT: &str = "[output.f]\nquantity = \"film\"\njoint = \"b\"\n";

/// L/D, ε, S, attitude angle (deg), P/p_max: Raimondi and Boyd with their own conditions, on 96 × 16 and 192 × 32 and
/// extrapolated.
const RAIMONDI_BOYD: [[f64; 5]; 6] = [
    [1.0, 0.2, 0.6317699971643594, 73.85558261485416, 0.5281819192596123],
    [1.0, 0.6, 0.12094077283759264, 50.529934366147806, 0.414289071087341],
    [0.5, 0.4, 0.7853979240635097, 61.771055170865345, 0.4423683096174467],
    [0.5, 0.8, 0.09168690358296187, 32.9208985813303, 0.2738316710594379],
    [0.25, 0.2, 7.5780323718984945, 75.37379098304892, 0.49011737332340677],
    [0.25, 0.6, 1.07786789363327, 46.8156215349531, 0.3344399458771235],
];

#[test]
fn films_of_cases_carry_what_the_tables_say() {
    let mut section = Section::new(
        "Journal bearings fed at their widest gap, from case files, on 72 × 7 nodes",
        "Raimondi and Boyd, ASLE Trans. 1 (1958) 159-209, recomputed with their own conditions and extrapolated",
        "cargo test -p whirl-cli --test cli -- films_of_cases_carry_what_the_tables_say",
    );
    for [ratio, eps, s, attitude, p] in RAIMONDI_BOYD {
        let (radius, length) = (0.025, 0.05 * ratio);
        // S = μ N D L/W (R/c)², with so small a clearance that shear, which tables leave out of the load, does not count; the load at
        // such an angle that the widest gap is where the groove is, at 180°.
        let load = 0.02 * 50.0 * 2.0 * radius * length / s * 1e8;
        let (sin, cos) = (-attitude).to_radians().sin_cos();
        let joint = format!(
            "law = \"jfo\"\nlength = \"{length} m\"\nparameters.sigma = \"1e-6 um\"\n\
             film.opening.groove = {{ angle = \"180 deg\", arc = \"4 deg\", length = \"{length} m\", pressure = \"0 bar\" }}"
        );
        let case = rotor((2.5, &joint), [load * cos, load * sin], OUTPUT);
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let history = bench.history("out");
        let [x, y] = ["EX_b_um", "EY_b_um"].map(|own| history.last(own) / 2.5);
        let what = format!("L/D {ratio}, S {s:.4}");
        section.compare(&format!("{what}: ε"), eps, x.hypot(y), 0.004);
        // Of the load to the line of centres.
        let found = y.atan2(x).to_degrees() + attitude;
        section.compare(&format!("{what}: attitude angle (deg)"), attitude, found, 0.004);
        let [pressure, gap] = FILM.map(|own| history.last(own));
        let mean = 1e-6 * load / (2.0 * radius * length);
        section.compare(&format!("{what}: P/p_max"), p, mean / pressure, 0.004);
        assert!((gap - 2.5 * (1.0 - x.hypot(y))).abs() < 0.02, "{gap} µm");
        // It stands still from the first step on.
        let still = history.column("EX_b_um");
        assert!(still.iter().all(|own| (own - still[0]).abs() < 1e-6 * 2.5), "{what}");
    }
    section.finish();
}

/// So short that nothing but what flows along counts, a film is that of the closed form: eccentricity and all coefficients.
#[test]
fn a_short_film_is_that_of_ocvirk() {
    let coefficients = |law: &str| -> Vec<f64> {
        let analysis = "[analysis.k]\nkind = \"coefficients\"\nspeeds = \"3000 rpm\"\n";
        let joint = format!("length = \"2.5 mm\"\n{law}");
        let case = rotor((0.25, &joint), [-16_000.0, 0.0], analysis);
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["coefficients", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let text = fs::read_to_string(bench.path("out/coefficients.csv")).expect("a table");
        let mut rows = text.lines();
        let names: Vec<&str> = rows.next().expect("names").split(',').collect();
        let values: Vec<&str> = rows.next().expect("a row").split(',').collect();
        let numbers = names.iter().zip(&values).filter(|(name, _)| {
            ["eccentricity_ratio", "attitude", "k_", "c_"].iter().any(|own| name.starts_with(own))
        });
        numbers.map(|(_, value)| value.parse().expect("a number")).collect()
    };
    let closed = coefficients("law = \"ocvirk\"\nparameters.mu = \"20 mPa*s\"");
    let film =
        coefficients("law = \"reynolds\"\nparameters.sigma = \"1e-7 um\"\nfilm.grid = [144, 7]");
    assert_eq!((closed.len(), film.len()), (10, 10), "{closed:?} {film:?}");
    let size = closed[2..6].iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    let rates = closed[6..].iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    for (k, (film, closed)) in film.iter().zip(&closed).enumerate() {
        let scale = [closed.abs(), size, rates][usize::from(k > 1) + usize::from(k > 5)];
        assert!((film - closed).abs() < 0.01 * scale, "{k}: {film} against {closed}");
    }
    assert!((0.3..0.5).contains(&closed[0]), "{closed:?}");
}

/// What turns the journal is made into heat, what enters leaves, and both sides have their moments.
/// Bores with lobes: forces of the pressure, along the journal's own normal, and of the shear of a full film and of the flow that the
/// pressure drives, by an independent program (finite volumes on 288 × 48 and 576 × 96 cells, extrapolated; no pressure below zero)
/// at a place of the journal, which loads against them keep there.
const LOBES: [(&str, [f64; 2], [f64; 2]); 4] = [
    ("lobes = 2\npreload = 0.5\nlobe_angle = \"90 deg\"", [-20.0, 15.0], [-95.075, -319.657]),
    ("lobes = 2\npreload = 0.5", [-25.0, 18.0], [408.747, -422.179]),
    ("lobes = 3\npreload = 0.4\nlobe_angle = \"180 deg\"", [-18.0, 12.0], [59.844, -298.265]),
    (
        "lobes = 2\npreload = 0.5\nlobe_angle = \"90 deg\"\nlobe_offset = 0.9",
        [-20.0, 10.0],
        [237.651, -357.764],
    ),
];

/// A film on 25 mm of the journal, with this table.
fn shaped(table: &str) -> String {
    format!(
        "law = \"reynolds\"\nparameters = {{ mu_0 = \"20 mPa*s\", sigma = \"0.01 um\" }}\nlength = \"25 mm\"\n\
         [joint.b.film]\n{table}"
    )
}

#[test]
fn bores_with_lobes_carry_what_another_program_finds() {
    let mut section = Section::new(
        "Bores with lobes, from case files, on 144 × 13 nodes: where the journal stands under the load that another program gives there",
        "Finite volumes of our own on 288 × 48 and 576 × 96 cells, extrapolated, pressures above zero, shear of a full film",
        "cargo test -p whirl-cli --test cli -- bores_with_lobes_carry_what_another_program_finds",
    );
    for (table, place, force) in LOBES {
        let joint = shaped(&format!("grid = [144, 13]\n{table}"));
        let text = rotor((50.0, &joint), force.map(|own| -own), "");
        let bench = Workbench::new().file("case.toml", &text);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{table}: {}", outcome.stderr);
        let history = bench.history("results/case");
        for (axis, exact) in ["X", "Y"].into_iter().zip(place) {
            let found = history.column(&format!("{axis}_b_um"))[0];
            // A thousandth of the clearance where it is largest, by nodes 2.5° apart.
            let what = format!("{}: {axis} (µm)", table.replace('\n', ", ").replace('"', ""));
            section.compare(&what, exact, found, 5e-3);
        }
    }
    section.finish();
}

/// One lobe is a round bore of the clearance c/(1 − m) whose middle is c m/(1 − m) away: the same coefficients, the journal there.
#[test]
fn one_lobe_is_a_round_bore_out_of_the_middle() {
    let [clearance, preload] = [60.0, 0.4];
    let angle = 130.0_f64.to_radians();
    let analysis = "[analysis.k]\nkind = \"coefficients\"\nspeeds = \"3000 rpm\"\n";
    let of = |clearance: f64, table: &str| {
        let text = rotor((clearance, &shaped(table)), [-400.0, 150.0], analysis);
        let bench = Workbench::new().file("case.toml", &text);
        for arguments in [&["run", "case.toml", "--no-figures"][..], &["analyse", "case.toml"]] {
            let outcome = bench.whirl(arguments);
            assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        }
        let history = bench.history("results/case");
        let place = ["X_b_um", "Y_b_um"].map(|own| history.column(own)[0]);
        let file = fs::read_to_string(bench.path("results/case/k.csv")).expect("coefficients");
        let head: Vec<String> =
            file.lines().next().expect("a head").split(',').map(str::to_owned).collect();
        let cells: Vec<f64> = file
            .lines()
            .nth(1)
            .expect("a row")
            .split(',')
            .map(|own| own.parse().unwrap_or(0.0))
            .collect();
        let own = head
            .iter()
            .zip(&cells)
            .filter(|(name, _)| name.starts_with("k_") || name.starts_with("c_"));
        (place, own.map(|(_, own)| *own).collect::<Vec<f64>>())
    };
    let lobe = format!("lobes = 1\npreload = {preload}\nlobe_angle = \"130 deg\"");
    let (place, found) = of(clearance, &lobe);
    let (round, exact) = of(clearance / (1.0 - preload), "");
    assert_eq!(found.len(), 8);
    let away = clearance * preload / (1.0 - preload);
    for (axis, out) in [angle.cos(), angle.sin()].into_iter().enumerate() {
        let apart = place[axis] - (round[axis] - away * out);
        assert!(apart.abs() < 1e-3, "{place:?} {round:?}");
    }
    let most = |own: &[f64]| own.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    for half in [0..4, 4..8] {
        let size = most(&exact[half.clone()]);
        for k in half {
            assert!((found[k] - exact[k]).abs() < 1e-4 * size, "{found:?} {exact:?}");
        }
    }
}

/// A profile by a file and a pocket all around are other ways to say a shape.
#[test]
fn profiles_and_pockets_are_depths_of_the_bore() {
    let place = |joint: String, clearance: f64| {
        let rows: String = (0..=360)
            .map(|k| {
                let within = (f64::from(k) - 90.0 + 90.0).rem_euclid(180.0) - 90.0;
                format!("{k}, {}\n", 50.0 * (1.0 - within.to_radians().cos()))
            })
            .collect();
        let text = rotor((clearance, &joint), [96.674, 321.313], "");
        let bench = Workbench::new()
            .file("case.toml", &text)
            .file("bore.csv", &format!("angle [deg], depth [um]\n{rows}"));
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let history = bench.history("results/case");
        ["X_b_um", "Y_b_um"].map(|own| history.column(own)[0])
    };
    let lobes = place(shaped(LOBES[0].0), 50.0);
    for own in [
        place(shaped("profile = \"bore.csv\""), 50.0),
        place(
            shaped(
                "profile = \"bore.csv\"\n\
                 pocket.around = { angle = \"10 deg\", arc = \"360 deg\", depth = \"7 um\" }",
            ),
            43.0,
        ),
    ] {
        for axis in 0..2 {
            assert!((own[axis] - lobes[axis]).abs() < 5e-3, "{own:?} {lobes:?}");
        }
    }
    // One that is deep carries nothing where it is.
    let deep = "pocket.below = { angle = \"250 deg\", arc = \"60 deg\", length = \"15 mm\", depth = \"0.3 mm\" }";
    let round = place(shaped(""), 50.0);
    let pocket = place(shaped(deep), 50.0);
    assert!(pocket[0].hypot(pocket[1]) > round[0].hypot(round[1]) + 1.0, "{pocket:?} {round:?}");
}

#[test]
fn shapes_of_bores_that_cannot_be_are_refused() {
    for (table, words) in [
        ("preload = 0.5", ["`preload` is of a bore with `lobes`", "add `lobes = 2`"]),
        ("lobes = 3", ["preload", "without one the bore is round"]),
        ("lobes = 2\npreload = 0.5\nlobe_offset = 1.5", ["share of the arc", "lobe_offset = 0.5"]),
        (
            "pocket.p = { angle = \"1 deg\", width = \"0.1 mm\", depth = \"9 um\" }",
            ["no node of the film lies in the pocket `p`", "more nodes in `grid`"],
        ),
        ("profile = \"turns.csv\"", ["goes around the bore more than once", "over one turn"]),
        ("profile = \"in.csv\"", ["leaves a gap of -20 µm", "beyond the round bore"]),
    ] {
        let text = rotor((50.0, &shaped(table)), [10.0, 0.0], "");
        let bench = Workbench::new()
            .file("case.toml", &text)
            .file("turns.csv", "angle [deg], depth [um]\n0, 1\n400, 2\n")
            .file("in.csv", "angle [deg], depth [um]\n0, -70\n180, 2\n");
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 2, "{table}: {}", outcome.stdout);
        assert!(
            outcome.stderr.contains("case.toml:") || outcome.stderr.contains(".csv"),
            "{}",
            outcome.stderr
        );
        for word in words {
            assert!(outcome.stderr.contains(word), "{table}: `{word}` is in\n{}", outcome.stderr);
        }
    }
    let said = Workbench::new()
        .file("case.toml", &rotor((50.0, &shaped(LOBES[2].0)), [10.0, 0.0], ""))
        .whirl(&["check", "case.toml"]);
    for word in ["bore of 3 lobes, the first around 180°, preload 0.4", "gaps from 50 to"] {
        assert!(said.stdout.contains(word), "{word}: {}", said.stdout);
    }
}

#[test]
fn outputs_of_a_film_belong_together() {
    let joint = "law = \"jfo\"\nlength = \"25 mm\"\n[joint.b.film]\ngrid = [96, 9]\nleft = \"0.5 bar\"\n\
                 opening.hole = { angle = \"90 deg\", width = \"6 mm\", length = \"8 mm\", pressure = \"2 bar\" }";
    let bench = Workbench::new().file("case.toml", &rotor((25.0, joint), [-1500.0, 0.0], OUTPUT));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let history = bench.history("out");
    let last = |name: &str| history.last(name);
    let flows = ["left", "right", "hole"].map(|own| last(&format!("q_{own}_f_mL_s")));
    let entering: f64 = flows.iter().filter(|own| **own > 0.0).sum();
    assert!(entering > 0.5 && flows[1] < 0.0, "{flows:?}");
    // In a film that stands: to the digits of the file.
    assert!(flows.iter().sum::<f64>().abs() < 1e-6 * entering, "{flows:?}");
    let omega = 100.0 * std::f64::consts::PI;
    let [own, bore, loss] = ["mz_f_Nm", "mz_bore_f_Nm", "loss_f_W"].map(last);
    // Oil that is pushed in brings work, too.
    let pushed = 1e-6 * (flows[0] * 0.5e5 + flows[2] * 2e5);
    assert!((loss / (-own * omega + pushed) - 1.0).abs() < 0.02, "{own} {loss} {pushed}");
    let [x, y, force_x, force_y] = ["EX_b_um", "EY_b_um", "RX_b_N", "RY_b_N"].map(last);
    let moment = 1e-6 * (x * force_y - y * force_x);
    assert!((own + bore + moment).abs() < 1e-8 * own.abs(), "{own} {bore} {moment}");
    assert!(bore > 0.0 && bore < -own, "{bore} {own}");
    let [p, oil, angle] = ["pmax_f_MPa", "oil_f_mm3", "hmin_angle_f_deg"].map(last);
    let place = y.atan2(x).to_degrees().rem_euclid(360.0);
    assert!(p > 2.4 && (angle - place).abs() < 2.0, "{p} {angle} {place}");
    let whole = std::f64::consts::TAU * 25.0 * 25.0 * 0.025;
    assert!(oil > 0.5 * whole && oil < whole, "{oil} of {whole}");
}

/// A block that moves is another side of the film; steps may be chosen, and a run may be cut.
#[test]
fn films_stand_between_bodies_that_move() {
    let case = r#"title = "a rotor in a block on springs"
gravity = ["-9.81 m/s^2", "0 m/s^2", "0 m/s^2"]
[body.rotor]
turns = "free"
initial_speed = "3000 rpm"
mass = "20 kg"
polar_inertia = "0.05 kg*m^2"
transverse_inertia = "0.4 kg*m^2"
z = "0 mm"
unbalance.u = { mass = "1 g", radius = "50 mm", z = "30 mm" }
[body.block]
turns = "no"
mass = "10 kg"
transverse_inertia = "0.3 kg*m^2"
z = "0 mm"
[joint.front]
kind = "bearing"
journal = { body = "rotor", z = "-100 mm" }
bore = { body = "block", z = "-100 mm" }
law = "jfo"
radial_clearance = "25 um"
journal_radius = "25 mm"
length = "20 mm"
film = { left = "0.2 bar", right = "0.2 bar" }
[joint.rear]
kind = "bearing"
journal = { body = "rotor", z = "100 mm" }
bore = { body = "block", z = "100 mm" }
law = "reynolds"
radial_clearance = "25 um"
journal_radius = "25 mm"
length = "20 mm"
[joint.a]
kind = "bushing"
first = { body = "block", z = "-100 mm" }
stiffness = { xx = "1e7 N/m", yy = "1e7 N/m" }
damping = { xx = "1e3 N*s/m", yy = "1e3 N*s/m" }
[joint.b]
kind = "bushing"
first = { body = "block", z = "100 mm" }
stiffness = { xx = "1e7 N/m", yy = "1e7 N/m" }
damping = { xx = "1e3 N*s/m", yy = "1e3 N*s/m" }
"#;
    let fixed = format!("{case}[march]\ntime_step = \"1e-4 s\"\nduration = \"0.2 s\"\n");
    let chosen = format!(
        "{case}[march]\ntime_step = \"auto\"\nstep_tolerance = 1e-4\noutput_step = \"1e-4 s\"\nduration = \"0.2 s\"\n"
    );
    let bench = Workbench::new().file("fixed.toml", &fixed).file("chosen.toml", &chosen);
    let mut ends = Vec::new();
    for name in ["fixed", "chosen"] {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--out", name]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let history = bench.history(name);
        ends.push(["EX_front_um", "EY_front_um", "EX_rear_um", "EY_rear_um"].map(|own| {
            let all = history.tail(own, 200);
            all.iter().sum::<f64>() / 200.0
        }));
        assert!(history.last("omega_rad_s") < 314.0);
    }
    for (fixed, chosen) in ends[0].iter().zip(&ends[1]) {
        assert!((fixed - chosen).abs() < 0.05, "{ends:?}");
    }
    assert!(ends[0][0].hypot(ends[0][1]) > 1.0, "{ends:?}");
}

#[test]
fn films_are_refused_where_they_cannot_be() {
    let film = "law = \"jfo\"\nlength = \"25 mm\"\nfilm = { left = \"1 bar\", right = \"1 bar\" }";
    let refused = |rest: &str, command: &[&str], words: &[&str]| {
        let text = rotor((25.0, film), [-500.0, 0.0], rest);
        let bench = Workbench::new().file("case.toml", &text);
        let before = bench.listing();
        let outcome = bench.whirl(command);
        assert_eq!(outcome.status, 2, "{command:?}: {} {}", outcome.stdout, outcome.stderr);
        for word in words {
            assert!(outcome.stderr.contains(word), "{word}: {}", outcome.stderr);
        }
        assert_eq!(bench.listing(), before, "{command:?}");
    };
    refused(
        "integrator = \"generalized-alpha\"\n",
        &["run", "case.toml"],
        &["the joint `b` has a film, which goes with Newmark's method", "leave `integrator` out"],
    );
    refused(
        "[analysis.p]\nkind = \"periodic\"\nmethod = \"harmonic\"\n",
        &["analyse", "case.toml"],
        &[
            "has the law jfo",
            "which has states: harmonics are balanced of motions only",
            "`method = ",
        ],
    );
}

/// Oil that leaves at open ends must come from somewhere, whether the film closes around the bore or not; without a fill it may.
#[test]
fn films_that_carry_a_fill_are_fed() {
    let opening = "opening.hole = { angle = \"90 deg\", width = \"6 mm\", length = \"8 mm\", pressure = \"2 bar\" }\n";
    for (law, film, status) in [
        ("jfo", "", 2),
        ("jfo", "left = \"open\"\nright = \"closed\"\n", 2),
        ("jfo", "left = \"0.5 bar\"\n", 0),
        ("jfo", opening, 0),
        ("reynolds", "", 0),
    ] {
        let joint = format!("law = \"{law}\"\nlength = \"25 mm\"\n[joint.b.film]\n{film}");
        let bench =
            Workbench::new().file("case.toml", &rotor((25.0, &joint), [-500.0, 0.0], OUTPUT));
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, status, "{law}, {film}: {}{}", outcome.stdout, outcome.stderr);
        let says =
            outcome.stderr.contains("nothing feeds the film `jfo`: its oil leaves at the ends");
        assert_eq!(says, status == 2, "{law}, {film}: {}", outcome.stderr);
    }
}

/// The machine of docs/films.md runs as the page has it.
#[test]
fn the_rotor_of_the_page_on_films_is_marched_and_linearised() {
    let page = include_str!("../../docs/films.md");
    let rest = page.split_once("```toml\n").expect("a block").1;
    let case = rest.split("```").next().expect("its end");
    let bench = Workbench::new().file("rotor.toml", case);
    let outcome = bench.whirl(&["run", "rotor.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
    let named = bench.history("out").names().to_vec();
    for own in ["pmax_left_MPa", "hmin_angle_left_deg", "loss_left_W", "mz_bore_left_Nm"] {
        assert!(named.iter().any(|name| name == own), "{own} in {named:?}");
    }
    let outcome = bench.whirl(&["coefficients", "rotor.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
}

/// A machine that stands still before it is driven, under one pressure all around: nothing flows anywhere.
#[test]
fn films_stand_still_before_they_turn() {
    for film in ["left = \"0.2 bar\", right = \"0.2 bar\"", "left = \"0.2 bar\""] {
        let joint = format!("law = \"jfo\"\nlength = \"20 mm\"\nfilm = {{ {film} }}");
        let case = rotor((25.0, &joint), [-100.0, 0.0], OUTPUT)
            .replace("turns = \"prescribed\"\nspeed", "turns = \"free\"\ninitial_speed")
            .replace("3000 rpm", "0 rpm")
            .replace("[start]\nkind = \"equilibrium\"\n", "");
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let history = bench.history("out");
        // It sinks, and the oil that it presses out holds it.
        let sunk = history.last("EX_b_um");
        assert!(sunk < -1.0 && sunk > -10.0, "{sunk}");
        assert!((history.last("RX_b_N") / 100.0 - 1.0).abs() < 0.05, "{film}");
        assert!(history.last("q_left_f_mL_s") < 0.0 || history.last("q_right_f_mL_s") < 0.0);
    }
}
