//! Films that do not close, and the pads that carry them.

use std::fs;

use whirl_solver::film::{Balance, Journal, JournalMotion, Oil, OilFilm, Reach};
use whirl_specs::{CLEARANCES, FILMS};

use crate::workbench::Workbench;

/// Rows of a table of results, by the names of its columns.
struct Rows {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Rows {
    fn read(bench: &Workbench, path: &str) -> Self {
        let text = fs::read_to_string(bench.path(path)).expect(path);
        let mut lines =
            text.lines().map(|line| line.split(',').map(str::to_owned).collect::<Vec<_>>());
        Rows { names: lines.next().expect("names"), rows: lines.collect() }
    }

    /// A number of the row that has this word.
    fn number(&self, word: &str, column: &str) -> f64 {
        let row = self.rows.iter().find(|row| row.iter().any(|own| own == word)).expect(word);
        let place = self.names.iter().position(|own| own == column).expect(column);
        row[place].parse().expect("a number")
    }

    /// K and C of a joint: xx, xy, yx, yy of both.
    fn coefficients(&self, joint: &str) -> [f64; 8] {
        [
            "k_xx_N_m",
            "k_xy_N_m",
            "k_yx_N_m",
            "k_yy_N_m",
            "c_xx_Ns_m",
            "c_xy_Ns_m",
            "c_yx_Ns_m",
            "c_yy_Ns_m",
        ]
        .map(|column| self.number(joint, column))
    }
}

/// Analyses a case, and reads what it has of coefficients.
fn coefficients(bench: &Workbench, case: &str) -> Rows {
    let outcome = bench.whirl(&["coefficients", case, "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    Rows::read(bench, "out/coefficients.csv")
}

/// Lund and Thomsen (1978), as in ross/tests/test_fluid_film_literature.py of petrobras/ross: two grooves of 20° across the load,
/// L/D ½: S, ε, φ (deg), K_xx, K_xy, K_yx, K_yy, B_xx, B_xy, B_yy, x along the load.
const LUND_THOMSEN: [[f64; 10]; 2] = [
    [0.58, 0.477, 51.01, 2.67, 3.7, -0.78, 1.75, 6.96, 1.94, 2.4],
    [0.244, 0.655, 40.25, 4.21, 3.74, -0.13, 1.64, 6.87, 1.82, 1.54],
];

/// Two arcs between two grooves are the film that closes, with its grooves: node by node. What they carry together is that of the table.
#[test]
fn two_arcs_are_a_bore_with_two_grooves() {
    let (radius, length, clearance) = (0.025, 0.025, 2.5e-6);
    for [s, eps, phi, table @ ..] in LUND_THOMSEN {
        let load = 0.02 * 50.0 * 2.0 * radius * length / s * (radius / clearance).powi(2);
        let joint = |name: &str, film: &str| {
            format!(
                "[joint.{name}]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\nlaw = \"reynolds\"\n\
                 parameters = {{ mu_0 = \"20 mPa*s\", sigma = \"1e-6 um\" }}\nradial_clearance = \"2.5 um\"\n\
                 journal_radius = \"25 mm\"\nlength = \"25 mm\"\n[joint.{name}.film]\n{film}\n"
            )
        };
        let case = |joints: &str| {
            format!(
                "title = \"a rotor\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nmass = \"5 kg\"\n\
                 polar_inertia = \"0.01 kg*m^2\"\n{joints}\n[loads.pull]\nbody = \"rotor\"\n\
                 force = [\"{load} N\", \"0 N\", \"0 N\"]\n[analysis.k]\nkind = \"coefficients\"\nspeeds = \"3000 rpm\"\n"
            )
        };
        let groove = |angle: f64| {
            format!(
                "{{ angle = \"{angle} deg\", arc = \"20 deg\", length = \"25 mm\", pressure = \"0 bar\" }}"
            )
        };
        let round = format!(
            "grid = [288, 9]\nopening = {{ one = {}, other = {} }}",
            groove(90.0),
            groove(270.0)
        );
        let pad =
            |from: f64, to: f64| format!("grid = [129, 9]\narc = [\"{from} deg\", \"{to} deg\"]");
        let bench = Workbench::new().file("round.toml", &case(&joint("b", &round))).file(
            "arcs.toml",
            &case(&(joint("b", &pad(280.0, 80.0)) + &joint("above", &pad(100.0, 260.0)))),
        );
        let whole = coefficients(&bench, "round.toml");
        let arcs = coefficients(&bench, "arcs.toml");
        let [round, loaded, above] = [(&whole, "b"), (&arcs, "b"), (&arcs, "above")]
            .map(|(rows, name)| rows.coefficients(name));
        let size = |own: &[f64]| own.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        for k in 0..8 {
            let most = size(&round[k / 4 * 4..][..4]);
            let found = loaded[k] + above[k];
            // What is sheared within the grooves: by the clearance over the radius of the load.
            assert!((found - round[k]).abs() < 2e-4 * most, "{k}: {found} {round:?}");
        }
        // In clearances and loads, at 3000 rpm.
        let omega = 100.0 * std::f64::consts::PI;
        let found = [0, 1, 2, 3, 4, 5, 7].map(|k: usize| {
            let own = (loaded[k] + above[k]) * clearance / load;
            if k < 4 { own } else { own * omega }
        });
        for (found, expected) in found.iter().zip(table) {
            assert!(
                (found - expected).abs() < (0.02 * expected.abs()).max(0.07),
                "S {s}: {found} {expected}"
            );
        }
        let ratio = arcs.number("b", "eccentricity_ratio");
        let angle = arcs.number("b", "e_y_um").atan2(arcs.number("b", "e_x_um")).to_degrees();
        assert!((ratio - eps).abs() < 1.5e-3 && (angle - phi).abs() < 0.2, "{ratio} {angle}");
    }
}

#[test]
fn arcs_and_pads_that_cannot_be_are_refused() {
    let case = include_str!("../../specs/cases/tilting-pad.toml");
    for (from, to, words) in [
        (
            "\"114 deg\", \"174 deg\"",
            "\"114 deg\", \"114 deg\"",
            &["`arc` reaches over 0°", "more than 0°"][..],
        ),
        (
            "\"114 deg\", \"174 deg\"",
            "\"0 deg\", \"360 deg\"",
            &["`arc` reaches over 360°", "leave it out"],
        ),
        (
            "preload = 0.5 }",
            "preload = 0.5, lobes = 2 }",
            &["`lobes` is of a bore that closes", "`preload` of its own"],
        ),
        ("preload = 0.5 }", "lobe_offset = 0.6 }", &["preload", "without one the arc is round"]),
        (
            "arc = [\"114 deg\", \"174 deg\"], preload = 0.5",
            "start = \"1 bar\"",
            &["`start` is an edge of an arc", "add `arc"],
        ),
        (
            "preload = 0.5 }",
            "opening.hole = { angle = \"110 deg\", arc = \"10 deg\", length = \"9 mm\", pressure = \"1 bar\" } }",
            &[
                "reaches beyond the arc of the film, which goes from 114° to 174°",
                "pressures of their own",
            ],
        ),
        (
            "preload = 0.5 }",
            "opening.end = { angle = \"140 deg\", arc = \"10 deg\", length = \"9 mm\", pressure = \"1 bar\" } }",
            &["an opening cannot be called `end`"],
        ),
        (
            "law = \"reynolds\"\nparameters = { mu_0 = \"20 mPa*s\" }\nradial_clearance = \"75 um\"\njournal_radius = \"50 mm\"\n\
             length = \"50 mm\"\nfilm = { arc = [\"114 deg\", \"174 deg\"]",
            "law = \"jfo\"\nradial_clearance = \"75 um\"\njournal_radius = \"50 mm\"\nlength = \"50 mm\"\n\
             film = { start = \"open\", end = \"open\", arc = [\"114 deg\", \"174 deg\"]",
            &["nothing feeds the film `jfo`"],
        ),
        (
            "rocks = true\n",
            "",
            &["`polar_inertia` is of a body that turns", "`centre` is of a body that rocks"],
        ),
        ("polar_inertia = \"1.2e-4 kg*m^2\"\n", "", &["polar_inertia"]),
        (
            "turns = \"no\"\nrocks = true",
            "turns = \"free\"\nrocks = true",
            &["`rocks` is of a body that does not turn"],
        ),
        (
            "bore = { body = \"pad1\" }\n",
            "",
            &["nothing acts on the turn of `pad1` about z", "its pivot"],
        ),
    ] {
        assert!(case.contains(from), "{from}");
        let text = case.replacen(from, to, 1);
        let bench = Workbench::new().file("case.toml", &text);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 2, "{to}: {}", outcome.stdout);
        for word in words {
            assert!(outcome.stderr.contains(word), "{to}: `{word}` is in\n{}", outcome.stderr);
        }
        assert!(outcome.stderr.contains("case.toml:"), "{}", outcome.stderr);
    }
}

/// Pads of the built-in case: angles of their pivots.
const PIVOTS: [f64; 5] = [144.0, 216.0, 288.0, 0.0, 72.0];
const WEIGHT: f64 = 9.81;

/// The built-in case without what turns.
fn still() -> String {
    let case = include_str!("../../specs/cases/tilting-pad.toml");
    let line = "unbalance.disc = { mass = \"6.6 g\", radius = \"100 mm\" }\n";
    assert!(case.contains(line));
    let mut case = case.replace(line, "").replace("0.06 s", "0.5 ms");
    for k in 3..=5 {
        case += &format!("[output.film{k}]\nquantity = \"film\"\njoint = \"film{k}\"\n");
    }
    case
}

/// Every pad by itself, with the film put together by hand: forces, the balance of each pad about its pivot, how it may move.
#[test]
fn pads_stand_in_equilibrium() {
    let bench = Workbench::new().file("case.toml", &still());
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    let history = bench.history("out");
    let last = |name: String| history.last(&name);
    let kernel = FILMS.iter().find(|film| film.origin.name == "reynolds").expect("a film");
    let load = 250.0 * WEIGHT;
    let mut sum = [0.0; 2];
    let rotor = ["x", "y"].map(|axis| 1e-6 * last(format!("{axis}_rotor_um")));
    for (k, pivot) in PIVOTS.into_iter().enumerate() {
        let pad = k + 1;
        let at = pivot.to_radians();
        let named = |letter: &str, joint: &str, unit: &str| {
            ["X", "Y"].map(|axis| last(format!("{letter}{axis}_{joint}{pad}_{unit}")))
        };
        let eccentric = named("E", "film", "um").map(|own| 1e-6 * own);
        let force = named("R", "film", "N");
        let reach = Reach { first: at - 30_f64.to_radians(), arc: Some(60_f64.to_radians()) };
        let mut film = OilFilm::reaching(kernel, [37, 7], [0.05, 0.05], reach).expect("a film");
        film.set("mu_0", 0.02).expect("a parameter");
        let mut journal = Journal::new(film, &CLEARANCES[0], 75e-6).expect("a journal");
        journal.shape(|angle, _| 75e-6 * (1.0 - (angle - at).cos()));
        let (mut oil, mut balance) = (Oil::full(&journal.film), Balance::new(&journal.film));
        // The film turns with its pad: by what the middle of its bore moves about the pivot.
        let held = named("R", "pivot", "N");
        let (sin, cos) = at.sin_cos();
        let [pivot_at, centre] = [0.065, 0.055].map(|radius| [radius * cos, radius * sin]);
        let bore = [0, 1].map(|axis| rotor[axis] - eccentric[axis] + held[axis] / 5e8);
        let turn = (bore[0] * pivot_at[1] - bore[1] * pivot_at[0]) / (0.065 * 0.065);
        let turned = |[x, y]: [f64; 2], by: f64| {
            let (sin, cos) = by.sin_cos();
            [cos * x - sin * y, sin * x + cos * y]
        };
        let motion = JournalMotion {
            displacement: turned(eccentric, -turn),
            omega: 300.0 * std::f64::consts::PI,
            ..JournalMotion::default()
        };
        let found = journal.react(&motion, &mut oil, &mut balance, &mut [0.0]).expect("a film");
        let found = turned([found.forces[0], found.forces[1]], turn);
        for axis in 0..2 {
            let error = (found[axis] - force[axis]).abs();
            assert!(error < 1e-5 * load, "pad {pad}: {found:?} {force:?}");
            sum[axis] += force[axis];
        }
        // What the pivot does to the pad, and what is left about it.
        let weight = [-0.35 * WEIGHT, 0.0];
        for axis in 0..2 {
            let rest = held[axis] - force[axis] + weight[axis];
            assert!(rest.abs() < 1e-4 * load, "pad {pad}: {rest} N");
        }
        let about = |place: [f64; 2], force: [f64; 2]| {
            let arm = [0, 1].map(|axis| place[axis] - pivot_at[axis]);
            arm[0] * force[1] - arm[1] * force[0]
        };
        let own = last(format!("mz_bore_film{pad}_Nm"));
        let moment = about([0.0; 2], force.map(|own| -own)) + own + about(centre, weight);
        assert!(moment.abs() < 1e-6 * load, "pad {pad}: {moment} N m about its pivot, {own}");
        assert!(own > 0.01, "what drags it along: {own}");
        // The middle of its bore moves about the pivot: what is along the line to it, the pivot gives way.
        let along = (bore[0] * pivot_at[0] + bore[1] * pivot_at[1]) / 0.065;
        assert!(along.abs() < 1e-9, "pad {pad}: {along} m");
    }
    assert!((sum[0] / load - 1.0).abs() < 1e-5 && sum[1].abs() < 1e-5 * load, "{sum:?}");
    // Pads carry along the load: the journal sinks along it but for what shears the pads.
    assert!(rotor[0] < -5e-6 && rotor[1].abs() < 0.02 * -rotor[0], "{rotor:?}");
}

/// x of a square system.
fn solved(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).expect("one");
        a.swap(k, pivot);
        b.swap(k, pivot);
        let (row, right) = (a[k].clone(), b[k]);
        for i in (0..n).filter(|i| *i != k) {
            let factor = a[i][k] / row[k];
            for (own, pivot) in a[i][k..].iter_mut().zip(&row[k..]) {
                *own -= factor * pivot;
            }
            b[i] -= factor * right;
        }
    }
    (0..n).map(|k| b[k] / a[k][k]).collect()
}

/// The rotor and its pads by hand from the coefficients of the films: x, y; then along x and y and about the centre, pad after pad.
/// The motion under a force that turns with the rotor, real and imaginary parts one after the other.
fn by_hand(films: &[[f64; 8]], omega: f64, force: [[f64; 2]; 2], mass: f64) -> Vec<f64> {
    let n = 2 + 3 * films.len();
    let mut whole = vec![vec![0.0; 2 * n]; 2 * n];
    let mut add = |i: usize, j: usize, stiffness: f64, damping: f64| {
        whole[i][j] += stiffness;
        whole[n + i][n + j] += stiffness;
        whole[i][n + j] -= omega * damping;
        whole[n + i][j] += omega * damping;
    };
    for axis in 0..2 {
        add(axis, axis, -mass * omega * omega, 0.0);
    }
    for (k, (own, pivot)) in films.iter().zip(PIVOTS).enumerate() {
        let (sin, cos) = pivot.to_radians().sin_cos();
        let first = 2 + 3 * k;
        for (place, inertia) in [0.35, 0.35, 1.2e-4].into_iter().enumerate() {
            add(first + place, first + place, -inertia * omega * omega, 0.0);
        }
        // Motion along x and y by the turn of the pad: of its bore's middle and of its pivot, seen from its centre.
        let turned = |radius: f64| [-(radius - 0.055) * sin, (radius - 0.055) * cos];
        let (bore, pivot) = (turned(0.0), turned(0.065));
        for i in 0..2 {
            let row = [(i, 1.0), (first + i, -1.0), (first + 2, -bore[i])];
            for j in 0..2 {
                let column = [(j, 1.0), (first + j, -1.0), (first + 2, -bore[j])];
                for (a, x) in row {
                    for (b, y) in column {
                        add(a, b, x * y * own[2 * i + j], x * y * own[4 + 2 * i + j]);
                    }
                }
            }
            let row = [(first + i, 1.0), (first + 2, pivot[i])];
            for (a, x) in row {
                for (b, y) in row {
                    add(a, b, 5e8 * x * y, 0.0);
                }
            }
        }
    }
    let mut right = vec![0.0; 2 * n];
    for axis in 0..2 {
        right[axis] = force[axis][0];
        right[n + axis] = force[axis][1];
    }
    solved(whole, right)
}

/// Linear analyses have the pads as they are put together by hand, and the bearing has next to no cross-coupling.
#[test]
fn pads_rock_in_linear_analyses() {
    let bench = Workbench::new();
    let analysed = |analysis: &str, speeds: &str| {
        let arguments = [analysis, "tilting-pad", "--speeds", speeds, "--out", "out"];
        let outcome = bench.whirl(&arguments);
        assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
        outcome.stdout
    };
    let said = analysed("stability", "3000 rpm .. 12000 rpm, 2");
    assert!(said.contains("stable at all these speeds") && !said.contains("UNSTABLE"), "{said}");
    analysed("coefficients", "3000 rpm");
    analysed("response", "3000 rpm .. 3001 rpm, 2");
    let rows = Rows::read(&bench, "out/coefficients.csv");
    let films: Vec<[f64; 8]> = (1..=5).map(|k| rows.coefficients(&format!("film{k}"))).collect();
    let omega = 100.0 * std::f64::consts::PI;
    let unbalance = 6.6e-3 * 0.1 * omega * omega;
    let found = by_hand(&films, omega, [[unbalance, 0.0], [0.0, -unbalance]], 250.0);
    let n = found.len() / 2;
    let response = Rows::read(&bench, "out/response.csv");
    let at = |column: &str| {
        let row = response.rows.iter().find(|row| {
            row[0].parse::<f64>().is_ok_and(|own| (own - 3000.0).abs() < 1e-6)
                && row[3] == "output.rotor"
        });
        let place = response.names.iter().position(|own| own == column).expect(column);
        row.expect("a row")[place].parse::<f64>().expect("a number")
    };
    for (axis, name) in ["x_um", "y_um"].into_iter().enumerate() {
        let size = 1e6 * found[axis].hypot(found[n + axis]);
        // By hand it is left out how shear on a pad, and its film's frame, change with its motion: 1 % of a pad's stiffness.
        assert!((at(name) / size - 1.0).abs() < 0.01, "{name}: {} for {size}", at(name));
    }
    // Impedances of the bearing at the speed: rows of the inverse of what unit forces move without the rotor's mass.
    let moved = [[[1.0, 0.0], [0.0, 0.0]], [[0.0, 0.0], [1.0, 0.0]]].map(|force| {
        let own = by_hand(&films, omega, force, 0.0);
        [[own[0], own[n]], [own[1], own[n + 1]]]
    });
    let cross = moved[0][1][0].hypot(moved[0][1][1]) + moved[1][0][0].hypot(moved[1][0][1]);
    let direct = moved[0][0][0].hypot(moved[0][0][1]) + moved[1][1][0].hypot(moved[1][1][1]);
    assert!(cross < 0.02 * direct, "{cross} {direct}");
}

/// The built-in case turns with its unbalance on an orbit that closes, as the linear analysis has it.
#[test]
fn a_rotor_whirls_on_tilting_pads() {
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run", "tilting-pad", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
    let history = bench.history("results/tilting-pad");
    let turn = 133;
    let swing = |name: &str, rows: usize| {
        let tail = history.tail(name, rows);
        let (least, most) = tail.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), own| {
            (f64::min(a, *own), f64::max(b, *own))
        });
        most - least
    };
    for name in ["x_rotor_um", "y_rotor_um"] {
        let [one, five] = [turn, 5 * turn].map(|rows| swing(name, rows));
        assert!(one > 1.0 && (five / one - 1.0).abs() < 0.02, "{name}: {one} {five} µm");
    }
}

/// Five pads of 60°, load on the fourth, as ROSS solves them on 20 × 10 nodes a pad: ross/tests/data/fluid_film/
/// tilt_5pad_isoviscous.json of petrobras/ross (321110c6). The pads above carry nothing there, and are left out here.
#[test]
fn pads_carry_what_another_program_finds() {
    let (clearance, load, omega) = (194.564e-6, 112_814.907, 30.0 * std::f64::consts::PI);
    let angles: [f64; 3] = [198.0, 270.0, 342.0];
    let pad = |(k, angle): (usize, &f64)| {
        let [x, y] = [angle.to_radians().cos(), angle.to_radians().sin()].map(|own| 349.6 * own);
        let (from, to) = (angle - 30.0, (angle + 30.0) % 360.0);
        format!(
            "[body.pad{k}]\nturns = \"no\"\nrocks = true\nmass = \"100 kg\"\npolar_inertia = \"1 kg*m^2\"\n\
             centre = [\"{x} mm\", \"{y} mm\"]\n[joint.pivot{k}]\nkind = \"bushing\"\n\
             first = {{ body = \"pad{k}\", at = [\"{x} mm\", \"{y} mm\"] }}\n\
             stiffness = {{ xx = \"1e14 N/m\", yy = \"1e14 N/m\" }}\n[joint.film{k}]\nkind = \"bearing\"\n\
             journal = {{ body = \"rotor\" }}\nbore = {{ body = \"pad{k}\" }}\nlaw = \"reynolds\"\n\
             parameters = {{ mu_0 = \"19.0062 mPa*s\" }}\nradial_clearance = \"194.564 um\"\n\
             journal_radius = \"199.9996 mm\"\nlength = \"263.144 mm\"\n\
             film = {{ grid = [73, 13], arc = [\"{from} deg\", \"{to} deg\"], preload = 0.3 }}\n"
        )
    };
    let pads: String = angles.iter().enumerate().map(pad).collect();
    let case = format!(
        "title = \"pads\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"900 rpm\"\nmass = \"10000 kg\"\n\
         polar_inertia = \"2 kg*m^2\"\n[loads.pull]\nbody = \"rotor\"\nforce = [\"0 N\", \"{} N\", \"0 N\"]\n{pads}\
         [output.rotor]\nquantity = \"displacement\"\nbody = \"rotor\"\n[output.f]\nquantity = \"film\"\njoint = \"film1\"\n\
         [start]\nkind = \"equilibrium\"\n[march]\ntime_step = \"1e-4 s\"\nduration = \"1 ms\"\n",
        -load
    );
    let bench = Workbench::new().file("case.toml", &case);
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "run"]);
    assert_eq!(outcome.status, 0, "{}{}", outcome.stdout, outcome.stderr);
    let history = bench.history("run");
    let [x, y] = ["x", "y"].map(|own| 1e-6 * history.last(&format!("{own}_rotor_um")) / clearance);
    // Its nodes are 3° apart, which is what its numbers are good for: 1 % of places and pressures, 4 % of coefficients.
    assert!((y / -0.618022 - 1.0).abs() < 0.01 && x.abs() < 2e-3, "{x} {y}");
    let (gap, pressure) = (history.last("hmin_f_um"), history.last("pmax_f_MPa"));
    assert!((gap / 61.885 - 1.0).abs() < 0.01, "{gap} µm");
    assert!((pressure / 4.68839 - 1.0).abs() < 0.01, "{pressure} MPa");
    let outcome =
        bench.whirl(&["coefficients", "case.toml", "--speeds", "900 rpm", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let rows = Rows::read(&bench, "out/coefficients.csv");
    // Of a pad without inertia on a pivot that does not give way: Z − Z t tᵀZ/(tᵀZ t), t along what its bore does as it rocks.
    let mut sum = [[[0.0; 2]; 2]; 2];
    for (k, angle) in angles.iter().enumerate() {
        let own = rows.coefficients(&format!("film{k}"));
        let z = |i: usize, j: usize| [own[2 * i + j], omega * own[4 + 2 * i + j]];
        let (sin, cos) = angle.to_radians().sin_cos();
        let t = [sin, -cos];
        let along = |values: [[f64; 2]; 2]| {
            [0, 1].map(|part| values[0][part] * t[0] + values[1][part] * t[1])
        };
        let right = [0, 1].map(|i| along([z(i, 0), z(i, 1)]));
        let left = [0, 1].map(|j| along([z(0, j), z(1, j)]));
        let whole = along(right);
        let size = whole[0] * whole[0] + whole[1] * whole[1];
        for i in 0..2 {
            for j in 0..2 {
                let ([a, b], [c, d]) = (right[i], left[j]);
                let (re, im) = (a * c - b * d, a * d + b * c);
                let quotient = [
                    (re * whole[0] + im * whole[1]) / size,
                    (im * whole[0] - re * whole[1]) / size,
                ];
                let own = z(i, j);
                sum[i][j][0] += own[0] - quotient[0];
                sum[i][j][1] += own[1] - quotient[1];
            }
        }
    }
    for (axis, stiffness, damping) in
        [(0, 322_066_640.687, 5_415_171.467), (1, 2_571_076_993.88, 19_394_951.765)]
    {
        let [k, c] = [sum[axis][axis][0], sum[axis][axis][1] / omega];
        assert!((k / stiffness - 1.0).abs() < 0.04, "{axis}: {k} N/m for {stiffness}");
        assert!((c / damping - 1.0).abs() < 0.04, "{axis}: {c} N s/m for {damping}");
        // What couples both is left of the shear of the pads.
        assert!(sum[0][1][0].abs().max(sum[1][0][0].abs()) < 5e-3 * k, "{sum:?}");
        // The command says the same, of pads with their inertia on pivots that give way a little.
        let felt = Rows::read(&bench, "out/coefficients.through.csv");
        let letter = ["xx", "yy"][axis];
        let told = [format!("k_{letter}_N_m"), format!("c_{letter}_Ns_m")];
        let told = told.map(|column| felt.number("rotor", &column));
        assert!((told[0] / k - 1.0).abs() < 0.01, "{axis}: {} N/m for {k}", told[0]);
        assert!((told[1] / c - 1.0).abs() < 0.01, "{axis}: {} N s/m for {c}", told[1]);
    }
}
