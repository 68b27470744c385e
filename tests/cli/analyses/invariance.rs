//! What a machine does not depend on: the order of its bodies, where x points, and how its meshes come.

use std::fmt::Write;

use num_complex::Complex64;
use whirl_solver::mesh::Material;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};

use super::{numbers, ran};
use crate::workbench::Workbench;

/// Share of |λ| by which the same modes may differ.
const SAME: f64 = 1e-9;

/// λ of the modes of a case.
fn values(workbench: &Workbench, arguments: &[&str]) -> Vec<Complex64> {
    ran(workbench, &[&["modes"][..], arguments, &["--count", "12", "--out", "out"]].concat());
    let [re, im] =
        ["real_1_s", "imaginary_1_s"].map(|own| numbers(workbench, "out/modes.csv", own));
    re.into_iter().zip(im).map(|(re, im)| Complex64::new(re, im)).collect()
}

/// Every mode of one has its own in the other.
fn agree(what: &str, a: &[Complex64], b: &[Complex64]) {
    assert!(a.len() >= 8 && a.len() == b.len(), "{what}: {} {}", a.len(), b.len());
    let mut left = b.to_vec();
    for value in a {
        let apart = |own: &Complex64| (own - value).norm();
        let nearest = (0..left.len())
            .min_by(|i, j| apart(&left[*i]).total_cmp(&apart(&left[*j])))
            .expect("one is left");
        let other = left.swap_remove(nearest);
        assert!(apart(&other) <= SAME * value.norm(), "{what}: {value} {other}");
    }
}

/// The case with the tables of its bodies and of its joints in the opposite order.
fn backwards(case: &str) -> String {
    let is_head = |line: &str| line.starts_with('[');
    let of = |line: &str, kind: &str| {
        let name = line.strip_prefix(kind).and_then(|own| own.strip_suffix(']'));
        name.is_some_and(|own| !own.contains('.'))
    };
    let (mut rest, mut bodies, mut joints) = (String::new(), Vec::new(), Vec::new());
    // 0: what is left where it is, 1: of a body, 2: of a joint.
    let mut place = 0;
    for line in case.lines() {
        if of(line, "[body.") {
            bodies.push(String::new());
            place = 1;
        } else if of(line, "[joint.") {
            joints.push(String::new());
            place = 2;
        } else if is_head(line) && !line.starts_with("[body.") {
            place = 0;
        }
        let into = match place {
            1 => bodies.last_mut(),
            2 => joints.last_mut(),
            _ => Some(&mut rest),
        };
        writeln!(into.expect("it was begun"), "{line}").expect("text can be written");
    }
    assert!(bodies.len() > 2 && joints.len() > 2);
    rest.extend(joints.into_iter().rev().chain(bodies.into_iter().rev()));
    rest
}

#[test]
fn bodies_and_joints_may_stand_in_any_order() {
    for (name, case, of, speed) in [
        ("two-spool", include_str!("../../../specs/cases/two-spool.toml"), "low", "6000 rpm"),
        (
            "turbocharger",
            include_str!("../../../specs/cases/turbocharger.toml"),
            "rotor",
            "60000 rpm",
        ),
    ] {
        let workbench =
            Workbench::new().file("as-it-is.toml", case).file("backwards.toml", &backwards(case));
        let [own, other] = ["as-it-is.toml", "backwards.toml"]
            .map(|case| values(&workbench, &[case, "--of", of, "--speeds", speed]));
        agree(name, &own, &other);
    }
}

/// A rotor with gravity in a film and in a bushing that is not the same along any two axes, turned about z by an angle (rad).
fn turned(angle: f64, body: &str) -> String {
    let (sin, cos) = angle.sin_cos();
    let vector = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
    // A X Aᵀ.
    let table = |[xx, xy, yx, yy]: [f64; 4], unit: &str| {
        let columns = [vector(xx, yx), vector(xy, yy)];
        let rows = [0, 1].map(|i| vector(columns[0][i], columns[1][i]));
        let [[xx, xy], [yx, yy]] = rows;
        format!(
            "{{ xx = \"{xx:?} {unit}\", xy = \"{xy:?} {unit}\", yx = \"{yx:?} {unit}\", yy = \"{yy:?} {unit}\" }}"
        )
    };
    let (stiffness, damping) =
        (table([3e6, 4e5, -2e5, 1e6], "N/m"), table([300.0, 20.0, 50.0, 800.0], "N*s/m"));
    let [x, y] = vector(-9.81, 0.0);
    let [f_x, f_y] = vector(20.0, 35.0);
    let unbalance = angle + 0.3;
    format!(
        r#"title = "a rotor"
gravity = ["{x:?} m/s^2", "{y:?} m/s^2", "0 m/s^2"]
[material.steel]
youngs_modulus = "200e9 Pa"
poissons_ratio = 0.3
density = "7860 kg/m^3"
[body.rotor]
turns = "prescribed"
speed = "6000 rpm"
material = "steel"
modes = 20
damping = "2e-6 s"
axial_restraint = "JOURNAL2_MIDDLE"
{body}
[body.rotor.sets.LEFT]
plane = "0 mm"
[body.rotor.sets.RIGHT]
plane = "600 mm"
[body.rotor.disc.one]
mass = "12 kg"
polar_inertia = "0.08 kg*m^2"
transverse_inertia = "0.045 kg*m^2"
z = "210 mm"
[body.rotor.unbalance.one]
mass = "5 g"
radius = "60 mm"
angle = "{unbalance:?} rad"
z = "210 mm"
[loads.pull]
body = "rotor"
sets = ["JOURNAL2_MIDDLE"]
force = ["{f_x:?} N", "{f_y:?} N", "0 N"]
[joint.left]
kind = "bearing"
journal = {{ body = "rotor", sets = "LEFT" }}
law = "ocvirk"
parameters = {{ mu = "20 mPa*s" }}
radial_clearance = "60 um"
journal_radius = "20 mm"
length = "20 mm"
[joint.right]
kind = "bushing"
first = {{ body = "rotor", sets = "RIGHT" }}
stiffness = {stiffness}
damping = {damping}
"#
    )
}

const DIMENSIONS: &str = "[body.rotor.dimensions]\nlength = \"600 mm\"\ndiameter = \"40 mm\"\nsupports = [\"60 mm\", \"210 mm\"]\n\
                          support_length = \"20 mm\"\nlayers_in_support = 4\nlayers_between = 24\n\
                          cells = { sectors = 6, rings = 2, order = 1 }\n";

/// The mesh of these.
fn shaft() -> Mesh {
    let shaft = SolidShaft {
        length: 0.6,
        diameter: 0.04,
        supports: vec![0.06, 0.21],
        support_length: 0.02,
        layers_in_support: 4,
        layers_between: 24,
        loads: Vec::new(),
        sections: Vec::new(),
        section: SectionCells { sectors: 6, rings: 2, order: 1 },
        material: Material::isotropic("steel", 200e9, 0.3, 7860.0).expect("a material"),
    };
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    shaft.mesh(&elements).expect("a mesh")
}

/// As a file, turned about z by an angle (rad), in units of so many m.
fn file(mesh: &Mesh, angle: f64, unit: f64) -> String {
    let (sin, cos) = angle.sin_cos();
    let mut text = String::from("*NODE\n");
    for (place, [x, y, z]) in mesh.nodes().iter().enumerate() {
        let [x, y, z] = [cos * x - sin * y, sin * x + cos * y, *z].map(|own| own / unit);
        writeln!(text, "{}, {x:?}, {y:?}, {z:?}", place + 1).expect("text can be written");
    }
    let labels = |nodes: &[usize]| {
        nodes.iter().map(|own| (own + 1).to_string()).collect::<Vec<_>>().join(", ")
    };
    let mut cell = 0;
    for block in mesh.blocks() {
        let kind = match block.element.nodes {
            6 => "C3D6",
            8 => "C3D8I",
            other => panic!("a cell of {other} nodes"),
        };
        writeln!(text, "*ELEMENT, TYPE={kind}, ELSET=ALL").expect("text can be written");
        for nodes in block.cells() {
            cell += 1;
            writeln!(text, "{cell}, {}", labels(nodes)).expect("text can be written");
        }
    }
    for (name, nodes) in mesh.node_sets().iter().filter(|own| own.1.len() == 1) {
        writeln!(text, "*NSET, NSET={name}\n{}", labels(nodes)).expect("text can be written");
    }
    text
}

/// Modes at 3000 rpm, and the orbits under unbalance.
fn motions(workbench: &Workbench, case: &str) -> (Vec<Complex64>, Vec<[f64; 2]>) {
    let modes = values(workbench, &[case, "--speeds", "3000 rpm"]);
    ran(workbench, &["response", case, "--speeds", "3000 rpm", "--no-figures", "--out", "out"]);
    let of = |name: &str| numbers(workbench, "out/response.csv", name);
    let orbits = of("major_um").into_iter().zip(of("minor_um"));
    (modes, orbits.map(|(major, minor)| [major, minor]).collect())
}

fn both_agree(
    what: &str,
    own: &(Vec<Complex64>, Vec<[f64; 2]>),
    other: &(Vec<Complex64>, Vec<[f64; 2]>),
) {
    agree(what, &own.0, &other.0);
    assert!(own.1.len() == 2 && other.1.len() == 2);
    for (a, b) in own.1.iter().flatten().zip(other.1.iter().flatten()) {
        assert!((a / b - 1.0).abs() < 1e-8, "{what}: {a} {b}");
    }
}

/// x may point anywhere: all that stands in space is turned, the mesh of six sectors stays or is turned, too.
#[test]
fn a_machine_turned_about_its_axis_moves_alike() {
    let mesh = shaft();
    let read = "mesh = \"shaft.inp\"\nunits = \"m, N, kg\"";
    let mut workbench = Workbench::new().file("case.toml", &turned(0.0, DIMENSIONS));
    let own = motions(&workbench, "case.toml");
    for angle in [0.7, 2.9] {
        workbench = workbench
            .file("turned.toml", &turned(angle, DIMENSIONS))
            .file("with-mesh.toml", &turned(angle, read))
            .file("shaft.inp", &file(&mesh, angle, 1.0));
        for case in ["turned.toml", "with-mesh.toml"] {
            both_agree(&format!("{case} by {angle}"), &own, &motions(&workbench, case));
        }
    }
}

/// A file of the mesh that dimensions make, in m or in mm.
#[test]
fn a_mesh_from_a_file_moves_as_the_same_from_dimensions() {
    let mesh = shaft();
    let read = |file: &str, units: &str| format!("mesh = \"{file}\"\nunits = \"{units}\"");
    let workbench = Workbench::new()
        .file("case.toml", &turned(0.0, DIMENSIONS))
        .file("metres.toml", &turned(0.0, &read("metres.inp", "m, N, kg")))
        .file("metres.inp", &file(&mesh, 0.0, 1.0))
        .file("millimetres.toml", &turned(0.0, &read("millimetres.inp", "mm, N, t")))
        .file("millimetres.inp", &file(&mesh, 0.0, 1e-3));
    let own = motions(&workbench, "case.toml");
    for case in ["metres.toml", "millimetres.toml"] {
        both_agree(case, &own, &motions(&workbench, case));
    }
}
