//! Sets by place on meshes of free tetrahedra, discs between planes of nodes, and cells of bodies made from dimensions.

use crate::own_mesh::bench;
use crate::workbench::{Outcome, Workbench};

const STEEL: &str = "[material.steel]\nyoungs_modulus = \"206 GPa\"\npoissons_ratio = 0.3\ndensity = \"7850 kg/m^3\"\n";

/// A rotor of free tetrahedra in two bearings, with these tables.
fn rotor(more: &str) -> Outcome {
    let case = format!(
        "title = \"a rotor\"\n{STEEL}
[body.rotor]
turns = \"prescribed\"
speed = \"6000 rpm\"
mesh = \"rotor.msh\"
units = \"mm, N, t\"
material = \"steel\"
modes = 4
axial_restraint = \"FRONT\"

[body.rotor.sets.FRONT]
radius = \"10 mm\"
z = [\"3 mm\", \"11 mm\"]

[body.rotor.sets.BACK]
radius = \"12 mm\"
z = [\"57.3 mm\", \"60.1 mm\"]
{more}
[joint.front]
kind = \"bearing\"
journal = {{ body = \"rotor\", surface = \"FRONT\" }}
law = \"hu2003-nonlinear\"
radial_clearance = \"30 um\"
springs = 24

[joint.back]
kind = \"bearing\"
journal = {{ body = \"rotor\", surface = \"BACK\" }}
law = \"hu2003-nonlinear\"
radial_clearance = \"30 um\"
springs = 24

[march]
time_step = \"1e-5 s\"
steps = 20
"
    );
    bench().file("case.toml", &case).whirl(&["check", "case.toml"])
}

/// The row of a table that `check` prints for a set.
fn row<'a>(said: &'a str, set: &str) -> Vec<&'a str> {
    let line = said.lines().find(|line| line.split_whitespace().next() == Some(set));
    line.unwrap_or_else(|| panic!("{set} in\n{said}")).split_whitespace().collect()
}

#[test]
fn bands_that_cut_free_tetrahedra_have_their_area_and_middle() {
    let outcome = rotor("");
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(!outcome.stderr.contains("cover"), "{}", outcome.stderr);
    assert!(outcome.stdout.contains("node sets of rotor: BACK ("), "{}", outcome.stdout);
    for (set, radius, z) in [("FRONT", 10.0, [3.0, 11.0]), ("BACK", 12.0, [57.3, 60.1])] {
        // Name, nodes, faces, "(12 cut)" as two words, area, share, x, y, z of the middle, and its distance.
        let row = row(&outcome.stdout, set);
        let number = |text: &str| text.trim_matches(['(', ',']).parse::<f64>().unwrap();
        assert!(number(row[3]) > 10.0 && row[4] == "cut)", "{row:?}");
        // Curved faces of quadratic tetrahedra: to a tenth of a percent.
        let exact = std::f64::consts::TAU * radius * (z[1] - z[0]);
        assert!((number(row[5]) / exact - 1.0).abs() < 1e-3, "{row:?} {exact}");
        assert!((number(row[6]) - 100.0).abs() < 0.05, "{row:?}");
        assert!((number(row[9]) - 0.5 * (z[0] + z[1])).abs() < 1e-3 * radius, "{row:?}");
        assert!(number(row[10]) < 1e-3 * radius, "{row:?}");
    }
}

#[test]
fn bands_beyond_the_cylinder_are_warned_of() {
    let outcome = rotor("[body.rotor.sets.LONG]\nradius = \"12 mm\"\nz = [\"25 mm\", \"70 mm\"]\n");
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    // From 25 to 45 and from 55 to 70 mm.
    let warned =
        "the faces of `LONG` cover 77.8 % of the band from z = 25 mm to 70 mm of rotor.msh";
    assert!(outcome.stderr.contains(warned), "{}", outcome.stderr);
    assert!(
        outcome.stderr.contains("; the cylinder of radius 12 mm is from z = "),
        "{}",
        outcome.stderr
    );
    let outcome = rotor("[body.rotor.sets.NONE]\nradius = \"13 mm\"\n");
    assert!(outcome.status == 2 && outcome.stderr.contains("`within` says how far nodes may be"));
}

#[test]
fn discs_and_unbalance_stand_between_planes_of_nodes() {
    let carried = "[body.rotor.disc.wheel]\nmass = \"1 kg\"\npolar_inertia = \"2e-3 kg*m^2\"\n\
        transverse_inertia = \"1e-3 kg*m^2\"\nz = \"31.7 mm\"\n\
        [body.rotor.unbalance.wheel]\nmass = \"1 g\"\nradius = \"9 mm\"\nz = \"31.7 mm\"\n";
    let outcome = rotor(carried);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    // Beyond the end there is none.
    let outcome = rotor(&carried.replace("31.7", "107"));
    assert!(outcome.status == 2 && outcome.stderr.contains("no section of "), "{}", outcome.stderr);
}

/// A shaft made from dimensions in two bushings, with these keys of its dimensions.
fn shaft(dimensions: &str) -> Outcome {
    let case = format!(
        "title = \"a shaft\"\n{STEEL}
[body.rotor]
turns = \"prescribed\"
speed = \"600 rpm\"
material = \"steel\"
modes = 4
axial_restraint = \"JOURNAL1_MIDDLE\"
disc.wheel = {{ mass = \"1 kg\", polar_inertia = \"2e-3 kg*m^2\", transverse_inertia = \"1e-3 kg*m^2\", z = \"400 mm\" }}

[body.rotor.dimensions]
length = \"840 mm\"
diameter = \"20 mm\"
supports = [\"20 mm\", \"820 mm\"]
support_length = \"10 mm\"
{dimensions}
[joint.near]
kind = \"bushing\"
first = {{ body = \"rotor\", sets = \"JOURNAL1_MIDDLE\" }}
stiffness = {{ xx = \"1e8 N/m\", yy = \"1e8 N/m\" }}

[joint.far]
kind = \"bushing\"
first = {{ body = \"rotor\", sets = \"JOURNAL2_MIDDLE\" }}
stiffness = {{ xx = \"1e8 N/m\", yy = \"1e8 N/m\" }}

[march]
time_step = \"1e-4 s\"
steps = 20
"
    );
    Workbench::new().file("case.toml", &case).whirl(&["check", "case.toml"])
}

#[test]
fn cells_of_dimensions_are_quadratic_and_as_long_as_they_may_be() {
    let outcome = shaft("");
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.is_empty(), "{}", outcome.stderr);
    assert!(
        outcome.stdout.contains("rotor: quadratic cells in layers of up to "),
        "{}",
        outcome.stdout
    );
    let coarser = shaft("cells = { tolerance = 0.05 }\n");
    let cells = |said: &str| -> f64 {
        row(said, "rotor").get(1).and_then(|n| n.parse().ok()).unwrap_or(0.0)
    };
    let of = |outcome: &Outcome| {
        let (_, sizes) = outcome.stdout.split_once("elements").expect("a table");
        cells(sizes)
    };
    assert!(of(&coarser) < of(&outcome), "{}", coarser.stdout);
    let linear = shaft("layers_in_support = 2\nlayers_between = 10\ncells = { order = 1 }\n");
    assert_eq!(linear.status, 0, "{}", linear.stderr);
    let warned = "rotor has linear cells in layers of up to 79 mm: bending frequencies are about ";
    assert!(linear.stderr.contains(warned), "{}", linear.stderr);
    for (dimensions, message) in [
        ("cells = { order = 1 }\n", "layers_between"),
        ("cells = { order = 3 }\n", "order"),
        (
            "layers_in_support = 2\nlayers_between = 9\ncells = { tolerance = 0.01 }\n",
            "no layers are chosen by this `tolerance`",
        ),
    ] {
        let outcome = shaft(dimensions);
        assert!(outcome.status == 2 && outcome.stderr.contains(message), "{}", outcome.stderr);
    }
}

/// A ring of 67 sectors, of which one is left out: its faces cover 98.5 % of the band, and their middle is beside the axis by
/// 1.5 % of the radius.
#[test]
fn a_middle_beside_the_axis_is_warned_of_where_nearly_all_is_covered() {
    const SECTORS: usize = 67;
    let mut text = "*NODE\n".to_owned();
    for (k, (layer, sector, radius)) in (0..2 * SECTORS * 2)
        .map(|k| (k / (2 * SECTORS), k / 2 % SECTORS, if k % 2 == 0 { 0.008 } else { 0.01 }))
        .enumerate()
    {
        let (sin, cos) = (std::f64::consts::TAU * sector as f64 / SECTORS as f64).sin_cos();
        let z = 0.004 * layer as f64;
        text += &format!("{}, {:e}, {:e}, {z}\n", k + 1, radius * cos, radius * sin);
    }
    text += "*NSET, NSET=FOOT\n1, 3, 5\n*ELEMENT, TYPE=C3D8I\n";
    let all = |sectors: usize| {
        let cells = (0..sectors).map(|sector| {
            let [own, next] = [2 * sector + 1, 2 * ((sector + 1) % SECTORS) + 1];
            let nodes = [own, own + 1, next + 1, next].into_iter();
            let nodes: Vec<_> = nodes.clone().chain(nodes.map(|own| own + 2 * SECTORS)).collect();
            let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
            format!("{}, {}\n", sector + 1, nodes.join(", "))
        });
        text.clone() + &cells.collect::<String>()
    };
    let case = format!(
        "title = \"a ring\"\n{STEEL}
[body.ring]
turns = \"no\"
mesh = \"ring.inp\"
units = \"m, N, kg\"
material = \"steel\"
modes = 4
held = [\"FOOT\"]

[body.ring.sets.OUTER]
radius = \"10 mm\"

[march]
time_step = \"1e-5 s\"
steps = 20
"
    );
    let of = |sectors: usize| {
        let bench = Workbench::new().file("case.toml", &case).file("ring.inp", &all(sectors));
        bench.whirl(&["check", "case.toml"])
    };
    let whole = of(SECTORS);
    assert_eq!(whole.status, 0, "{}", whole.stderr);
    assert!(!whole.stderr.contains("their middle is"), "{}", whole.stderr);
    let slit = of(SECTORS - 1);
    assert_eq!(slit.status, 0, "{}", slit.stderr);
    let warned = "the faces of `OUTER` cover 98.5 % of the band from its first to its last face of ring.inp, and their middle is \
                  0.15";
    assert!(slit.stderr.contains(warned), "{}", slit.stderr);
}

#[test]
fn a_bar_has_no_cylinders_and_no_axis() {
    let mut text = "*NODE\n".to_owned();
    for (k, [x, y, z]) in
        (0..27).map(|k| [k % 3, k / 3 % 3, k / 9].map(|n| f64::from(n) * 0.01)).enumerate()
    {
        text += &format!("{}, {x}, {y}, {z}\n", k + 1);
    }
    text += "*ELEMENT, TYPE=C3D8I\n";
    for cell in 0..8 {
        let first = cell % 2 + 3 * (cell / 2 % 2) + 9 * (cell / 4) + 1;
        let nodes = [0, 1, 4, 3, 9, 10, 13, 12].map(|own| (first + own).to_string());
        text += &format!("{}, {}\n", cell + 1, nodes.join(", "));
    }
    let outcome = Workbench::new().file("bar.inp", &text).whirl(&["mesh", "bar.inp"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("no cylinders about an axis along z"), "{}", outcome.stdout);
    assert!(!outcome.stdout.contains("axis = ["), "{}", outcome.stdout);
}

/// The rotor with its axis elsewhere: sets of journals that go around another one are errors, and a warning tells of bushings.
#[test]
fn journals_and_bushings_go_around_the_axis() {
    let moved = "[body.rotor]\naxis = [\"0.5 mm\", \"0 mm\"]\n";
    let case = |joint: &str| {
        format!(
            "title = \"a rotor\"\n{STEEL}{moved}turns = \"prescribed\"\nspeed = \"6000 rpm\"\nmesh = \"rotor.msh\"\nunits = \"mm, N, t\"\nmaterial = \"steel\"\nmodes = 4\naxial_restraint = \"FRONT\"\nsets.FRONT = {{ plane = \"0 mm\" }}\nsets.BACK = {{ plane = \"80 mm\" }}\n{joint}"
        )
    };
    let bushing = |name: &str, set: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", sets = \"{set}\" }}\nstiffness = {{ xx = \"1e7 N/m\", yy = \"1e7 N/m\" }}\n"
        )
    };
    let checked =
        |joint: &str| bench().file("case.toml", &case(joint)).whirl(&["check", "case.toml"]);
    let film = "[joint.front]\nkind = \"bearing\"\njournal = { body = \"rotor\", sets = \"FRONT\" }\nlaw = \"ocvirk\"\nradial_clearance = \"50 um\"\njournal_radius = \"10 mm\"\nlength = \"8 mm\"\n";
    let outcome = checked(&format!("{film}{}", bushing("back", "BACK")));
    assert_eq!(outcome.status, 2, "{}", outcome.stdout);
    for words in ["0.5 mm off the axis about which `rotor` turns", "axis = [\"0 mm\", \"0 mm\"]"] {
        assert!(outcome.stderr.contains(words), "{words}: {}", outcome.stderr);
    }
    let outcome = checked(&format!("{}{}", bushing("front", "FRONT"), bushing("back", "BACK")));
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for words in ["0.5 mm off the axis about which it turns", "axis = [\"0 mm\", \"0 mm\"]"] {
        assert!(outcome.stderr.contains(words), "{words}: {}", outcome.stderr);
    }
    // About its own axis nothing is said.
    let right = case(&format!("{}{}", bushing("front", "FRONT"), bushing("back", "BACK")));
    let right = right.replace(moved, "[body.rotor]\n");
    let outcome = bench().file("case.toml", &right).whirl(&["check", "case.toml"]);
    assert!(outcome.status == 0 && !outcome.stderr.contains("off the axis"), "{}", outcome.stderr);
}

/// A surface over all of a shaft, for two bearings by their stations: the reduced stiffness has the rounding of what is stiff within its mesh,
/// which is no reason for it not to be round.
#[test]
fn a_shaft_with_one_surface_for_two_bearings_is_round() {
    let bearing = |name: &str, z: u32| {
        format!(
            "[joint.{name}]\nkind = \"bearing\"\njournal = {{ body = \"r\", surface = \"ALL\" }}\nstations = [\"{z} mm\"]\n\
             law = \"ocvirk\"\nradial_clearance = \"40 um\"\njournal_radius = \"20 mm\"\nlength = \"30 mm\"\n"
        )
    };
    let case = format!(
        "title = \"a shaft\"\n{STEEL}
[body.r]
turns = \"prescribed\"
speed = \"3000 rpm\"
material = \"steel\"
modes = 20
axial_restraint = \"ALL\"
dimensions = {{ length = \"400 mm\", diameter = \"40 mm\", supports = [\"50 mm\", \"350 mm\"], support_length = \"30 mm\", cells = {{ sectors = 16, rings = 3 }} }}
sets.ALL = {{ radius = \"20 mm\", z = [\"0 mm\", \"400 mm\"] }}
{}{}
[loads.weight]
body = \"r\"
sets = [\"ALL\"]
spread = \"mean\"
force = \"-40 N\"
",
        bearing("a", 50),
        bearing("b", 350)
    );
    let outcome = bench().file("case.toml", &case).whirl(&["modes", "case.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(!outcome.stdout.contains("not round"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("backward"), "{}", outcome.stdout);
}
