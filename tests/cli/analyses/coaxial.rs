//! Two shafts, one in the other, at two ratios of their speeds: against beams whose gyroscopic terms are scaled.

use std::collections::HashMap;
use std::f64::consts::PI;
use std::fmt::Write;

use super::{numbers, ran, reference, section, source_of};
use crate::workbench::Workbench;

/// Sectors and layers of the mesh of the outer shaft.
const SECTORS: usize = 16;
const LAYERS: usize = 30;

/// The outer shaft in one ring of quadratic hexahedra: bore 250 mm, 300 mm in diameter, from z = 0.5 to 2 m.
fn hollow_shaft() -> String {
    let (mut nodes, mut cells) = (String::from("*NODE\n"), String::new());
    let mut known: HashMap<[usize; 3], usize> = HashMap::new();
    // Places count in halves of a cell: from the bore outwards, around, and along the axis.
    let mut node = |[radial, around, along]: [usize; 3]| {
        let place = [radial, around % (2 * SECTORS), along];
        let next = known.len() + 1;
        *known.entry(place).or_insert_with(|| {
            let radius = 0.125 + 0.0125 * radial as f64;
            let (sin, cos) = (PI * place[1] as f64 / SECTORS as f64).sin_cos();
            let z = 0.5 + 1.5 * along as f64 / (2 * LAYERS) as f64;
            writeln!(nodes, "{next}, {:?}, {:?}, {z:?}", radius * cos, radius * sin)
                .expect("text can be written");
            next
        })
    };
    let corners = [[0, 0], [2, 0], [2, 2], [0, 2]];
    let edges = [[1, 0], [2, 1], [1, 2], [0, 1]];
    for layer in 0..LAYERS {
        for sector in 0..SECTORS {
            let mut of = |places: [[usize; 2]; 4], height: usize| {
                places.map(|[r, a]| node([r, 2 * sector + a, 2 * layer + height]))
            };
            let all = [of(corners, 0), of(corners, 2), of(edges, 0), of(edges, 2), of(corners, 1)];
            let own: Vec<String> = all.as_flattened().iter().map(usize::to_string).collect();
            let number = layer * SECTORS + sector + 1;
            writeln!(cells, "{number}, {},\n{}", own[..10].join(", "), own[10..].join(", "))
                .expect("text can be written");
        }
    }
    format!("{nodes}*ELEMENT, TYPE=C3D20, ELSET=ALL\n{cells}")
}

#[test]
fn modes_of_coaxial_shafts_are_those_of_another_program() {
    let workbench = Workbench::new()
        .file("outer.inp", &hollow_shaft())
        .file("case.toml", include_str!("coaxial.toml"));
    let test = "modes_of_coaxial_shafts_are_those_of_another_program";
    assert_eq!(compare(&workbench, "solid", test), 32);
}

/// Compares both analyses of a case with the reference; how many frequencies were. `how` the bodies are given, in the test called
/// so.
pub(super) fn compare(workbench: &Workbench, how: &str, test: &str) -> usize {
    ran(workbench, &["analyse", "case.toml", "--out", "out"]);
    let all = reference();
    let title = format!("Modes: ross coaxial, {how}");
    let mut section = section(&title, &source_of("ross coaxial"), test);
    for (file, which, speeds) in [
        ("out/both.csv", "both at", [0.0, 200.0]),
        ("out/faster.csv", "outer 1.5 x", [200.0, 400.0]),
    ] {
        let (rpm, hertz) =
            (numbers(workbench, file, "speed_rpm"), numbers(workbench, file, "frequency_hz"));
        for speed in speeds {
            let own = rpm.iter().zip(&hertz).filter(|own| (own.0 * PI / 30.0 - speed).abs() < 1e-6);
            let found: Vec<f64> = own.map(|own| *own.1).collect();
            let state = format!(", {which} {speed:?} rad/s");
            let known = all
                .iter()
                .filter(|own| own.case == "ross coaxial" && own.quantity.ends_with(&state));
            // Bending is slower here than torsion, which beams for lateral motion do not have: modes are one for one.
            for (known, found) in known.zip(&found) {
                known.holds(&mut section, *found);
            }
        }
    }
    let compared = section.count();
    section.finish();
    compared
}

/// Two rotors on springs of their own at 6000 and 4000 rpm: where no orders are asked for, the unbalance of either counts by its own
/// turns. √(k/m)/2π = 50.3292 Hz of the slow one is met where that turns at 3019.75 rpm, the fast one half as fast again.
#[test]
fn each_spool_excites_by_its_own_turns() {
    let rotor = |name: &str, speed: &str, stiffness: &str| {
        format!(
            "[body.{name}]\nturns = \"prescribed\"\nspeed = \"{speed}\"\nmass = \"10 kg\"\npolar_inertia = \"0.1 kg*m^2\"\n\
             [joint.of_{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\" }}\n\
             stiffness = {{ xx = \"{stiffness} N/m\", yy = \"{stiffness} N/m\" }}\n"
        )
    };
    let case = format!(
        "title = \"two spools\"\n{}{}",
        rotor("fast", "6000 rpm", "2.25e6"),
        rotor("slow", "-4000 rpm", "1e6")
    );
    let workbench = Workbench::new().file("case.toml", &case);
    let outcome = ran(
        &workbench,
        &[
            "campbell",
            "case.toml",
            "--speeds",
            "0 rpm .. 12000 rpm, 13",
            "--out",
            "out",
            "--no-figures",
        ],
    );
    assert!(outcome.stdout.contains("order 0.666667: once a turn of slow"), "{}", outcome.stdout);
    let file = "out/campbell.critical.csv";
    let (orders, speeds) =
        (numbers(&workbench, file, "order"), numbers(&workbench, file, "speed_rpm"));
    let whose = super::column(&workbench, file, "once_a_turn_of");
    let own = |k: f64| (k / 10.0_f64).sqrt() * 60.0 / std::f64::consts::TAU;
    for (order, stiffness, name) in
        [(1.0, 2.25e6, ""), (1.0, 1e6, ""), (2.0 / 3.0, 1e6, "slow"), (2.0 / 3.0, 2.25e6, "slow")]
    {
        let exact = own(stiffness) / order;
        let found = (0..orders.len()).filter(|k| {
            (orders[*k] - order).abs() < 1e-12 && (speeds[*k] / exact - 1.0).abs() < 1e-8
        });
        let found: Vec<usize> = found.collect();
        // Forward and backward, or along a line.
        assert!(
            !found.is_empty() && found.iter().all(|k| whose[*k] == name),
            "{exact}: {orders:?} {speeds:?} {whose:?}"
        );
    }
    // Those that are asked for, and no others.
    ran(
        &workbench,
        &[
            "campbell",
            "case.toml",
            "--speeds",
            "0 rpm .. 12000 rpm, 13",
            "--orders",
            "2",
            "--out",
            "asked",
            "--no-figures",
        ],
    );
    let orders = numbers(&workbench, "asked/campbell.critical.csv", "order");
    assert!(!orders.is_empty() && orders.iter().all(|own| *own == 2.0), "{orders:?}");
}
