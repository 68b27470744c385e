//! Bodies with meshes: a cup that turns around a rotor or stands, and the reference system by names.

use std::collections::BTreeMap;
use std::fmt::Write;

use super::{march, run};
use crate::workbench::{SHORT, Workbench};

/// Half the breadth of the cup, and of its hole (mm).
const OUTER: i32 = 20;
const INNER: i32 = 10;
/// z from which the cup is hollow (mm).
const BOTTOM: i32 = 50;

/// A square cup as an input file: solid from z = 0 to 50 mm, a square hole from there to 150 mm; its axis at (x, y) mm.
pub(crate) fn cup([x, y]: [i32; 2]) -> String {
    let (step, layer) = (10, 25);
    let mut nodes: BTreeMap<[i32; 3], usize> = BTreeMap::new();
    let mut cells = Vec::new();
    for z in (0..150).step_by(layer) {
        for a in (-OUTER..OUTER).step_by(step as usize) {
            for b in (-OUTER..OUTER).step_by(step as usize) {
                let hole = |at: i32| (-INNER..INNER).contains(&at);
                if z >= BOTTOM && hole(a) && hole(b) {
                    continue;
                }
                let corner =
                    |i: i32, j: i32, k: i32| [a + i * step, b + j * step, z + k * layer as i32];
                let base = [[0, 0], [1, 0], [1, 1], [0, 1]];
                let cell = [0, 1].map(|k| base.map(|[i, j]| corner(i, j, k))).concat();
                let places: Vec<usize> = cell
                    .into_iter()
                    .map(|node| {
                        let next = nodes.len() + 1;
                        *nodes.entry(node).or_insert(next)
                    })
                    .collect();
                cells.push(places);
            }
        }
    }
    let mut text = "*NODE\n".to_owned();
    for ([a, b, z], label) in &nodes {
        let [a, b, z] = [a + x, b + y, *z].map(|mm| 1e-3 * f64::from(mm));
        writeln!(text, "{label}, {a:e}, {b:e}, {z:e}").expect("text");
    }
    text += "*ELEMENT, TYPE=C3D8I, ELSET=ALL\n";
    for (label, cell) in cells.iter().enumerate() {
        let cell: Vec<String> = cell.iter().map(ToString::to_string).collect();
        writeln!(text, "{}, {}", label + 1, cell.join(", ")).expect("text");
    }
    let around =
        |node: &[i32; 3], z: i32| node[2] == z && node[0].abs().max(node[1].abs()) == INNER;
    for (name, of) in [
        ("END", Box::new(|node: &[i32; 3]| *node == [0, 0, 0]) as Box<dyn Fn(&[i32; 3]) -> bool>),
        ("BASE", Box::new(|node: &[i32; 3]| *node == [0, 0, BOTTOM])),
        ("BORE", Box::new(move |node: &[i32; 3]| around(node, 100))),
        ("BORE_LEFT", Box::new(move |node: &[i32; 3]| around(node, 75))),
        ("BORE_RIGHT", Box::new(move |node: &[i32; 3]| around(node, 125))),
        ("TOP", Box::new(|node: &[i32; 3]| *node == [OUTER, 0, 0])),
        ("LOW", Box::new(|node: &[i32; 3]| *node == [-OUTER, 0, 0])),
        ("FOOT1", Box::new(|node: &[i32; 3]| *node == [-OUTER, -OUTER, 0])),
        ("FOOT2", Box::new(|node: &[i32; 3]| *node == [-OUTER, OUTER, 0])),
        ("FOOT3", Box::new(|node: &[i32; 3]| *node == [-OUTER, -OUTER, 150])),
        ("FOOT4", Box::new(|node: &[i32; 3]| *node == [-OUTER, OUTER, 150])),
    ] {
        let labels = nodes.iter().filter(|(node, _)| of(node));
        let labels: Vec<String> = labels.map(|(_, label)| label.to_string()).collect();
        writeln!(text, "*NSET, NSET={name}\n{}", labels.join(",\n")).expect("text");
    }
    text
}

const STEEL: &str = r#"
[material.steel]
youngs_modulus = "200 GPa"
poissons_ratio = 0.3
density = "7860 kg/m^3"
"#;

/// A rotor in the hole of the cup.
fn rotor(axis: &str, film: &str) -> String {
    format!(
        r#"
[body.rotor]
turns = "prescribed"
speed = "3000 rpm"
axis = {axis}
mass = "0.1 kg"
polar_inertia = "2e-5 kg*m^2"

[joint.film]
kind = "bearing"
journal = {{ body = "rotor" }}
bore = {{ body = "cup", {film} }}
law = "ocvirk"
parameters = {{ mu = "20 mPa*s" }}
radial_clearance = "50 um"
journal_radius = "9.9 mm"
length = "10 mm"
stations = ["100 mm"]
"#
    )
}

/// The film turns the cup, which bushings hold: its angular momentum is what the film has given, wherever the axis
/// of both stands, and with one ring of nodes in its bore or three.
#[test]
fn a_cup_with_a_mesh_is_turned_by_the_film_in_it() {
    let mut speeds = Vec::new();
    let (one, three) = ("sets = \"BORE\"", "sets = [\"BORE_LEFT\", \"BORE\", \"BORE_RIGHT\"]");
    let (here, there) = ("[\"0 mm\", \"0 mm\"]", "[\"30 mm\", \"-40 mm\"]");
    for (axis, at, sets) in [(here, [0, 0], one), (there, [30, -40], one), (here, [0, 0], three)] {
        let case = format!(
            r#"title = "x"
{STEEL}
[body.cup]
turns = "free"
axis = {axis}
mesh = "cup.inp"
material = "steel"
modes = 6
damping = "1e-5 s"
axial_restraint = "END"

[joint.end]
kind = "bushing"
first = {{ body = "cup", sets = "END" }}
stiffness = {{ xx = "1e7 N/m", yy = "1e7 N/m" }}
damping = {{ xx = "1e3 N*s/m", yy = "1e3 N*s/m" }}

[joint.base]
kind = "bushing"
first = {{ body = "cup", sets = "BASE" }}
stiffness = {{ xx = "1e7 N/m", yy = "1e7 N/m" }}
damping = {{ xx = "1e3 N*s/m", yy = "1e3 N*s/m" }}
{}
[loads.push]
body = "rotor"
force = "1 N"
{}"#,
            rotor(axis, sets),
            march("1e-4 s", 1000)
        );
        let done = run(&case, &[("cup.inp", &cup(at))]);
        let torque = done.history.column("MZ_film_Nm");
        let given = |column: &[f64]| -> f64 {
            column.windows(2).map(|pair| -0.5e-4 * (pair[0] + pair[1])).sum()
        };
        let said = done.bench.whirl(&["check", "case.toml"]).stdout;
        let line = said.lines().find(|line| line.starts_with("cup ")).expect("the cup");
        let polar: f64 =
            line.split_whitespace().nth(3).expect("an inertia").parse().expect("kg m²");
        let speed = done.history.column("omega_rad_s");
        let gained = polar * (speed[speed.len() - 1] - speed[0]);
        assert!((gained / given(torque) - 1.0).abs() < 0.01, "{gained} for {}", given(torque));
        assert!(gained > 0.0 && (done.last("RX_film_N") + 1.0).abs() < 0.05);
        speeds.push(speed[speed.len() - 1]);
    }
    let apart = |speed: f64| (speed / speeds[0] - 1.0).abs();
    assert!(apart(speeds[1]) < 1e-6 && apart(speeds[2]) < 1e-3, "{speeds:?}");
}

/// A cup that nothing but its feet holds carries the rotor: what they feel is the load.
#[test]
fn a_casing_on_bushings_hands_the_load_to_its_feet() {
    let mut case = format!(
        "title = \"x\"\n{STEEL}\n[body.cup]\nturns = \"no\"\nmesh = \"cup.inp\"\nmaterial = \"steel\"\nmodes = 6\n\
         damping = \"1e-5 s\"\naxial_restraint = \"END\"\n{}\n[loads.push]\nbody = \"rotor\"\nforce = \"-50 N\"\n{}",
        rotor("[\"0 mm\", \"0 mm\"]", "sets = \"BORE\""),
        march("1e-4 s", 2000)
    );
    for foot in 1..=4 {
        write!(
            case,
            "\n[joint.foot{foot}]\nkind = \"bushing\"\nfirst = {{ body = \"cup\", sets = \"FOOT{foot}\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
             damping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n"
        )
        .expect("text");
    }
    let done = run(&case, &[("cup.inp", &cup([0, 0]))]);
    let feet = |unit: &str| -> f64 {
        (1..=4).map(|foot| done.last(&format!("{unit}_foot{foot}_N"))).sum()
    };
    assert!((done.last("RX_film_N") - 50.0).abs() < 0.1, "{}", done.last("RX_film_N"));
    assert!((feet("RX") - 50.0).abs() < 0.1, "{}", feet("RX"));
    // The load acts two thirds of the way to the far feet.
    let far = done.last("RX_foot3_N") + done.last("RX_foot4_N");
    assert!((far - 100.0 / 3.0).abs() < 0.2, "{far}");
}

/// The reference system by names has the same history to the last bit.
#[test]
fn the_reference_system_by_names_has_the_same_history() {
    let done = run(include_str!("reference.toml"), &[]);
    let bench = Workbench::new().file("case.toml", SHORT);
    assert_eq!(bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]).status, 0);
    let (named, short) = (done.bench.history_text("out"), bench.history_text("out"));
    let rows = |text: &str| text.split_once('\n').map(|(_, rows)| rows.to_owned());
    assert_eq!(rows(&named), rows(&short));
    assert!(named.starts_with("t_s,theta_rad,omega_rad_s,RX_1_N,RY_1_N,RX_2_N"));
    let [named, short] = [&done.bench, &bench].map(|bench| bench.summary("out"));
    assert_eq!(named["counts"]["bodies"]["shaft"], short["counts"]["shaft"]);
    assert_eq!(named["counts"]["active"], short["counts"]["active"]);
    assert_eq!(named["counts"]["coordinates"], short["counts"]["coordinates"]);
    assert_eq!(named["fixed_interface_hz"], short["fixed_interface_hz"]);
}

/// A shaft held at one end to the frame that turns, as a blade to its hub: gravity does not act, and nothing moves it but
/// the unbalance of its free end, which bends it outwards as a force of m r Ω² bends a cantilever.
#[test]
fn what_is_held_to_the_turning_frame_bends_outwards() {
    let case = format!(
        "title = \"held\"\n[material.steel]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n\
         density = \"7860 kg/m^3\"\n[body.blade]\nturns = \"prescribed\"\nspeed = \"600 rpm\"\n\
         material = \"steel\"\nmodes = 6\ndamping = \"2e-3 s\"\nheld = [\"ROOT\"]\nmesh = \"blade.inp\"\n\
         [body.blade.unbalance.tip]\nmass = \"10 g\"\nradius = \"20 mm\"\nz = \"100 mm\"\n\
         [joint.guard]\nkind = \"bushing\"\nfirst = {{ body = \"blade\", sets = \"TIP\" }}\n\
         stiffness = {{ xx = \"1 N/m\", yy = \"1 N/m\" }}\n{}",
        march("1e-3 s", 300)
    );
    let done = run(&case, &[("blade.inp", &blade())]);
    let speed = 600.0 * std::f64::consts::PI / 30.0;
    let force = 0.01 * 0.02 * speed * speed;
    // F L³/(3 E I) of a square of 10 mm.
    let bent = force * 0.1_f64.powi(3) / (3.0 * 200e9 * 0.01_f64.powi(4) / 12.0);
    let found = done.last("X_guard_um").hypot(done.last("Y_guard_um"));
    assert!((found / (1e6 * bent) - 1.0).abs() < 0.02, "{found} µm for {} µm", 1e6 * bent);
}

/// A bar of 10 × 10 × 100 mm along z about the axis, of 2 × 2 × 10 hexahedra with incompatible modes.
fn blade() -> String {
    let mut text = String::from("*NODE, NSET=ALL\n");
    let node = |i: usize, j: usize, k: usize| 1 + i + 3 * j + 9 * k;
    for k in 0..=10 {
        for j in 0..3 {
            for i in 0..3 {
                let [x, y] = [i, j].map(|n| 0.005 * n as f64 - 0.005);
                text += &format!("{}, {x}, {y}, {}\n", node(i, j, k), 0.01 * k as f64);
            }
        }
    }
    text += "*ELEMENT, TYPE=C3D8I, ELSET=EALL\n";
    for (place, (i, j, k)) in
        (0..10).flat_map(|k| (0..4).map(move |n| (n % 2, n / 2, k))).enumerate()
    {
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
        let nodes = [0, 1].map(|up| corners.map(|(a, b)| node(i + a, j + b, k + up).to_string()));
        text += &format!("{}, {}\n", place + 1, nodes.concat().join(", "));
    }
    let root: Vec<String> = (1..=9).map(|n| n.to_string()).collect();
    text +=
        &format!("*NSET, NSET=ROOT\n{}\n*NSET, NSET=TIP\n{}\n", root.join(", "), node(1, 1, 10));
    text
}

/// A mesh taken as rigid is the body of its numbers, turning or standing, its sets being places on it: a node, and a ring
/// whose mean motion counts.
#[test]
fn a_mesh_taken_as_rigid_is_the_body_of_its_numbers() {
    let [outer, inner] = [OUTER, INNER].map(|half| 2e-3 * f64::from(half));
    let (base, walls) = (0.05, 0.1);
    let area = outer.powi(2) - inner.powi(2);
    let masses = [7860.0 * outer.powi(2) * base, 7860.0 * area * walls];
    let mass = masses[0] + masses[1];
    let centre = (masses[0] * 0.5 * base + masses[1] * (base + 0.5 * walls)) / mass;
    let polar = 7860.0 * (outer.powi(4) * base + (outer.powi(4) - inner.powi(4)) * walls) / 6.0;
    let along =
        |mass: f64, z: f64, length: f64| mass * (length * length / 12.0 + (z - centre).powi(2));
    let across = 0.5 * polar
        + along(masses[0], 0.5 * base, base)
        + along(masses[1], base + 0.5 * walls, walls);
    let case = |turns: &str, body: &str, first: &str, last: &str| {
        let joint = |name: &str, at: &str| {
            format!(
                "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"cup\", {at} }}\n\
                 stiffness = {{ xx = \"1e6 N/m\", yy = \"2e6 N/m\" }}\n\
                 damping = {{ xx = \"400 N*s/m\", yy = \"300 N*s/m\" }}\n"
            )
        };
        format!(
            "title = \"x\"\n{STEEL}[body.cup]\n{turns}\naxis = [\"3 mm\", \"-2 mm\"]\n{body}\n{}{}\
             [loads.pull]\nbody = \"cup\"\n{first}\nforce = \"90 N\"\nfrequency = \"40 Hz\"\n{}",
            joint("near", first),
            joint("far", last),
            march("1e-4 s", 400) + "force_tolerance = \"1e-7 N\"\n"
        )
    };
    let numbers = |polar: &str| {
        format!(
            "mass = \"{mass} kg\"\n{polar}transverse_inertia = \"{across} kg*m^2\"\nz = \"{centre} m\""
        )
    };
    let mesh = cup([3, -2]);
    for (turns, polar) in [
        (
            "turns = \"free\"\ninitial_speed = \"3000 rpm\"",
            format!("polar_inertia = \"{polar} kg*m^2\"\n"),
        ),
        ("turns = \"no\"", String::new()),
    ] {
        let by_mesh = "mesh = \"cup.inp\"\nmaterial = \"steel\"\nrigid = true";
        let meshed = case(turns, by_mesh, "sets = [\"END\"]", "sets = [\"BORE\"]");
        let meshed = run(&meshed, &[("cup.inp", &mesh)]);
        let rigid = case(turns, &numbers(&polar), "z = \"0 mm\"", "z = \"100 mm\"");
        let rigid = run(&rigid, &[]);
        let mut most: f64 = 0.0;
        for joint in ["near", "far"] {
            for column in ["RX", "RY"].map(|name| format!("{name}_{joint}_N")) {
                let (found, exact) =
                    (meshed.history.column(&column), rigid.history.column(&column));
                let largest = exact.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
                let error = found.iter().zip(exact).map(|(a, b)| (a - b).abs());
                let error = error.fold(0.0, f64::max);
                assert!(error < 1e-5, "{column}: {error} of {largest}");
                most = most.max(largest);
            }
        }
        assert!(most > 50.0, "{most}");
    }
}

/// A free shaft with a disc and unbalance; `section`: a line of its table.
fn free_shaft(section: &str, disc: &str, unbalance: &str, steps: usize) -> String {
    let bushing = |name: &str, set: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"s\", sets = \"{set}\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"2e7 N/m\" }}\n\
             damping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n"
        )
    };
    format!(
        "title = \"x\"\n{STEEL}[body.s]\nturns = \"free\"\ninitial_speed = \"3000 rpm\"\n\
         material = \"steel\"\nmodes = 60\ndamping = \"1e-6 s\"\n\
         axial_restraint = \"JOURNAL1_MIDDLE\"\n{section}\n\
         disc.w = {{ {disc}, z = \"450 mm\" }}\n\
         unbalance.u = {{ mass = \"{unbalance}\", radius = \"100 mm\", z = \"450 mm\" }}\n\
         [body.s.dimensions]\nlength = \"500 mm\"\ndiameter = \"50 mm\"\n\
         supports = [\"50 mm\", \"300 mm\", \"450 mm\"]\nsupport_length = \"20 mm\"\n\
         layers_in_support = 2\nlayers_between = 6\ncells = {{ order = 1 }}\n{}{}{}",
        bushing("near", "JOURNAL1_MIDDLE"),
        bushing("far", "JOURNAL2_MIDDLE"),
        march("2e-5 s", steps)
    )
}

/// Which frame turns with a free shaft does not change its motion.
#[test]
fn the_frame_of_a_free_shaft_does_not_matter() {
    let disc =
        "mass = \"4 kg\", polar_inertia = \"0.02 kg*m^2\", transverse_inertia = \"0.011 kg*m^2\"";
    let [mean, section] = ["", "section = [\"DRIVE_TOP\", \"DRIVE_BOTTOM\"]"]
        .map(|section| run(&free_shaft(section, disc, "1 g", 2000), &[]));
    for column in ["RX_near_N", "RY_far_N"] {
        let (found, exact) = (mean.history.column(column), section.history.column(column));
        let largest = exact.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let errors = found.iter().zip(exact).map(|(a, b)| (a - b).abs());
        let error = errors.fold(0.0, f64::max);
        assert!(largest > 5.0 && error < 1e-5 * largest, "{column}: {error} of {largest}");
    }
}

/// A disc of a hundred times the inertia of the section beside it, thrown out of balance: the section twists, and terms of
/// second order of the disc's tilt are larger than its inertia.
#[test]
fn a_heavy_disc_on_a_free_shaft_can_be_marched() {
    let disc =
        "mass = \"100 kg\", polar_inertia = \"4 kg*m^2\", transverse_inertia = \"2.1 kg*m^2\"";
    let done = run(&free_shaft("", disc, "1000 g", 2500), &[]);
    assert_eq!(done.bench.summary("out")["verdict"]["sound"], true);
}
