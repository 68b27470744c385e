//! Bodies of matrices in cases: the machine of their mesh, and what is said of matrices that do not do.

use std::fmt::Write;

use whirl_solver::mesh::{Mesh, inp};
use whirl_specs::ELEMENTS;
use whirl_tests::matrices as written;

use super::{march, run};
use crate::bad_input::refused;
use crate::workbench::Workbench;

/// A bar of steel of 20 × 20 × 200 mm along z: 2 × 2 × 10 hexahedra with 20 nodes or 8.
fn bar() -> String {
    bar_with(|label| label, 0.0)
}

/// The bar with other labels of its nodes, which are 1 to 99, turned about its axis by an angle (rad).
pub(super) fn bar_with(label: impl Fn(usize) -> usize, angle: f64) -> String {
    let (sin, cos) = angle.sin_cos();
    let mut text = String::from("*NODE\n");
    let node = |i: usize, j: usize, k: usize| label(1 + i + 3 * j + 9 * k);
    for k in 0..=10 {
        for j in 0..3 {
            for i in 0..3 {
                let [x, y] = [i, j].map(|n| 0.01 * n as f64 - 0.01);
                let [x, y] = [cos * x - sin * y, sin * x + cos * y];
                writeln!(text, "{}, {x}, {y}, {}", node(i, j, k), 0.02 * k as f64).expect("text");
            }
        }
    }
    text += "*ELEMENT, TYPE=C3D8I, ELSET=EALL\n";
    for place in 0..40 {
        let (k, n) = (place / 4, place % 4);
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
        let nodes =
            [0, 1].map(|up| corners.map(|(a, b)| node(n % 2 + a, n / 2 + b, k + up).to_string()));
        writeln!(text, "{}, {}", place + 1, nodes.concat().join(", ")).expect("text");
    }
    text += "*MATERIAL, NAME=STEEL\n*ELASTIC\n2e11, 0.3\n*DENSITY\n7860\n*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n";
    for (name, nodes) in [
        ("FEET", vec![node(0, 0, 0), node(2, 0, 0), node(0, 2, 0), node(2, 2, 0)]),
        ("TIP", vec![node(1, 1, 10)]),
        ("LEFT", vec![node(1, 1, 2)]),
        ("RIGHT", vec![node(1, 1, 8)]),
        ("TOP", vec![node(2, 1, 2)]),
        ("LOW", vec![node(0, 1, 2)]),
    ] {
        let nodes: Vec<String> = nodes.iter().map(ToString::to_string).collect();
        writeln!(text, "*NSET, NSET={name}\n{}", nodes.join(",\n")).expect("text");
    }
    text
}

fn mesh() -> Mesh {
    let elements: Vec<_> = ELEMENTS.iter().collect();
    inp::read(&bar(), "bar.inp", &elements).expect("a mesh").mesh
}

/// Everything that the cases name.
fn files() -> Vec<(&'static str, String)> {
    let mesh = mesh();
    let [k, m] = written::of_mesh(&mesh);
    let punch = written::dmig("KAAX", &k, &mesh) + &written::dmig("MAAX", &m, &mesh);
    vec![
        ("bar.inp", bar()),
        ("K.mtx", written::market(&k, "symmetric")),
        ("M.mtx", written::market(&m, "symmetric")),
        ("dofs.csv", written::dofs(&mesh)),
        ("bar.pch", punch),
        ("bar.bdf", written::grids(&mesh)),
        ("job.sti", written::calculix(&k)),
        ("job.mas", written::calculix(&m)),
        ("job.dof", written::calculix_dofs(&mesh)),
    ]
}

const FORMATS: [&str; 3] = [
    "matrices = { stiffness = \"K.mtx\", mass = \"M.mtx\", dofs = \"dofs.csv\" }",
    "matrices = { dmig = \"bar.pch\", nodes = \"bar.bdf\" }",
    "matrices = { calculix = \"job\", nodes = \"bar.inp\" }",
];

/// Sets of nodes by label, as formats without sets have them.
fn labelled(case: &str) -> String {
    let nodes =
        [("\"TIP\"", 95), ("\"LEFT\"", 23), ("\"RIGHT\"", 77), ("\"TOP\"", 24), ("\"LOW\"", 22)];
    nodes
        .into_iter()
        .fold(case.to_owned(), |case, (set, node)| case.replace(set, &format!("\"NODE_{node}\"")))
}

/// The columns of two histories agree to this part of the largest value of each, and to 1e-14 of their units.
fn agree(one: &whirl_tests::History, other: &whirl_tests::History, part: f64) {
    assert_eq!(one.names(), other.names());
    for name in one.names() {
        let (mine, theirs) = (one.column(name), other.column(name));
        let largest = mine.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (a, b) in mine.iter().zip(theirs) {
            assert!((a - b).abs() <= part * largest + 1e-14, "{name}: {a} {b} of {largest}");
        }
    }
}

fn standing(body: &str) -> String {
    format!(
        "title = \"post\"\ngravity = [\"0 m/s^2\", \"-9.81 m/s^2\", \"0 m/s^2\"]\n[body.post]\nturns = \"no\"\n{body}\n\
         modes = 12\ndamping = \"1e-6 s\"\nheld = [\"FEET\"]\n\
         [joint.spring]\nkind = \"bushing\"\nfirst = {{ body = \"post\", sets = \"TIP\" }}\n\
         stiffness = {{ xx = \"1e5 N/m\", yy = \"2e5 N/m\" }}\n\
         [loads.push]\nbody = \"post\"\nsets = [\"RIGHT\"]\nforce = [\"20 N\", \"5 N\", \"0 N\"]\nfrequency = \"300 Hz\"\n{}",
        march("2e-5 s", 400)
    )
}

/// A post on its feet, shaken: from its mesh and from its matrices in each format.
#[test]
fn a_post_of_matrices_moves_as_its_mesh() {
    let all = files();
    let beside: Vec<(&str, &str)> = all.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let feet = "[body.post.sets.FEET]\nplane = \"0 mm\"\n";
    let plane = |case: String| {
        format!("{}\n{feet}", case.replace("\"FEET\"", "\"FOOT\""))
            .replace("sets.FEET", "sets.FOOT")
    };
    let made = run(&plane(standing("mesh = \"bar.inp\"")), &beside);
    for format in FORMATS {
        let found = run(&labelled(&plane(standing(format))), &beside);
        agree(&made.history, &found.history, 1e-9);
    }
}

/// A shaft of matrices in two bushings, pushed while it turns, moves as that of its mesh.
#[test]
fn a_shaft_of_matrices_turns_as_its_mesh() {
    let all = files();
    let beside: Vec<(&str, &str)> = all.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let case = |body: &str| {
        let mut case = format!(
            "title = \"shaft\"\n[body.shaft]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\n{body}\nmodes = 10\n\
             damping = \"1e-6 s\"\nstiffening = false\naxial_restraint = \"LEFT\"\nsection = [\"TOP\", \"LOW\"]\n\
             [loads.push]\nbody = \"shaft\"\nsets = [\"TIP\"]\nforce = [\"20 N\", \"5 N\", \"0 N\"]\nfrequency = \"300 Hz\"\n{}",
            march("2e-5 s", 400)
        );
        for side in ["LEFT", "RIGHT"] {
            write!(
                case,
                "[joint.{}]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", sets = \"{side}\" }}\n\
                 stiffness = {{ xx = \"1e7 N/m\", yy = \"2e7 N/m\" }}\n\
                 damping = {{ xx = \"1e3 N*s/m\", yy = \"1e3 N*s/m\" }}\n",
                side.to_lowercase()
            )
            .expect("text");
        }
        case
    };
    let made = run(&case("mesh = \"bar.inp\""), &beside);
    for format in FORMATS {
        let found = run(&labelled(&case(format)), &beside);
        agree(&made.history, &found.history, 1e-9);
    }
}

/// Taken as rigid, matrices have the mass, the centre and the moments of inertia of their mesh.
#[test]
fn rigid_matrices_are_the_rigid_mesh() {
    let all = files();
    let beside: Vec<(&str, &str)> = all.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let case = |body: &str| {
        format!(
            "title = \"rigid\"\n[body.shaft]\nturns = \"prescribed\"\nspeed = \"6000 rpm\"\n{body}\nrigid = true\n\
             [joint.left]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", sets = \"LEFT\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"2e6 N/m\" }}\n\
             [joint.right]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", sets = \"RIGHT\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"2e6 N/m\" }}\n\
             [loads.push]\nbody = \"shaft\"\nsets = [\"TIP\"]\nforce = [\"20 N\", \"5 N\", \"0 N\"]\nfrequency = \"90 Hz\"\n{}",
            march("1e-4 s", 300)
        )
    };
    let made = run(&case("mesh = \"bar.inp\""), &beside);
    let found = run(&labelled(&case(FORMATS[1])), &beside);
    agree(&made.history, &found.history, 1e-9);
}

/// Two discs on a torsion spring, whose turns are dofs: told to speed up, they take the couple of both moments of inertia.
#[test]
fn turns_of_nodes_tie_a_body_to_its_frame() {
    // x, y and rz of two nodes: 2 kg, and 0.01 and 0.03 kg m².
    let dofs =
        "node, direction, x, y, z\n1, x, 0, 0, 0\n1, y\n1, rz\n2, x, 0, 0, 0.1\n2, y\n2, rz\n";
    let head = |symmetry: &str, count: usize| {
        format!("%%MatrixMarket matrix coordinate real {symmetry}\n6 6 {count}\n")
    };
    let files = [
        ("dofs.csv", dofs.to_owned()),
        ("K.mtx", head("symmetric", 3) + "3 3 1e4\n6 6 1e4\n6 3 -1e4\n"),
        ("M.mtx", head("symmetric", 6) + "1 1 2\n2 2 2\n3 3 .01\n4 4 2\n5 5 2\n6 6 .03\n"),
        ("Y.mtx", head("symmetric", 4) + "1 1 2\n2 2 2\n4 4 2\n5 5 2\n"),
        ("H.mtx", head("skew-symmetric", 2) + "2 1 -2\n5 4 -2\n"),
        (
            "load.mtx",
            "%%MatrixMarket matrix array real general\n6 1\n0\n0\n0\n0\n0\n0\n".to_owned(),
        ),
    ];
    let beside: Vec<(&str, &str)> =
        files.iter().map(|(name, text)| (*name, text.as_str())).collect();
    let case = format!(
        "title = \"discs\"\n[body.discs]\nturns = \"prescribed\"\nspeed = \"0 rpm\"\nacceleration = \"100 rad/s^2\"\n\
         damping = \"1e-3 s\"\nstiffening = false\n\
         matrices = {{ stiffness = \"K.mtx\", mass = \"M.mtx\", dofs = \"dofs.csv\", spin_inertia = \"Y.mtx\", \
         spin_coupling = \"H.mtx\", spin_load = \"load.mtx\" }}\n\
         [joint.near]\nkind = \"bushing\"\nfirst = {{ body = \"discs\", sets = \"NODE_1\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n\
         [joint.far]\nkind = \"bushing\"\nfirst = {{ body = \"discs\", sets = \"NODE_2\" }}\n\
         stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\n{}",
        march("1e-4 s", 1000)
    );
    let done = run(&case, &beside);
    let couple = done.last("M_discs_Nm");
    assert!((couple / (100.0 * 0.04) - 1.0).abs() < 1e-6, "{couple} N m");
}

fn bench(case: &str, changed: &[(&str, &str)]) -> Workbench {
    let all = files();
    let bench = all.iter().fold(Workbench::new(), |bench, (name, text)| bench.file(name, text));
    let bench = changed.iter().fold(bench, |bench, (name, text)| bench.file(name, text));
    bench.file("case.toml", case)
}

/// What is missing for what is asked is said where it is asked, with what to do.
#[test]
fn what_is_missing_is_said() {
    let turning = |more: &str| {
        format!(
            "title = \"x\"\n[body.shaft]\nturns = \"prescribed\"\nspeed = \"10 rpm\"\n{}\naxial_restraint = \"LEFT\"\n{more}\n\
             [joint.one]\nkind = \"bushing\"\nfirst = {{ body = \"shaft\", sets = \"LEFT\" }}\n\
             stiffness = {{ xx = \"1e7 N/m\", yy = \"2e7 N/m\" }}\n{}",
            FORMATS[2],
            march("1e-4 s", 10)
        )
    };
    refused(
        &bench(&turning("modes = 3"), &[]),
        &["matrices = {", "job.sti", "no cells", "`stiffening = false`"],
    );
    refused(
        &bench(&turning("stiffening = false"), &[]),
        &["dofs beside those", "add `modes = 20`"],
    );
    // A node that K and M have not.
    let case = labelled(&standing(FORMATS[1])).replace("held = [\"FEET\"]", "held = [\"NODE_1\"]");
    refused(&bench(&case.replace("NODE_95", "NODE_1000"), &[]), &["no node set `NODE_1000`"]);
    // Dofs that boundary conditions took out of the matrices.
    let few = |text: &str, node: &str| -> String {
        text.lines()
            .filter(|line| !line.starts_with(node))
            .map(|line| format!("{line}\n"))
            .collect()
    };
    let dofs = "node, direction, x, y, z\n1, x, 0, 0, 0\n1, y\n1, z\n2, x, 0, 0, 1\n2, y\n";
    let identity = "%%MatrixMarket matrix coordinate real symmetric\n5 5 5\n1 1 1\n2 2 1\n3 3 1\n4 4 1\n5 5 1\n";
    let small = [("dofs.csv", dofs), ("K.mtx", identity), ("M.mtx", identity)];
    let case = standing(FORMATS[0])
        .replace("\"FEET\"", "\"NODE_1\"")
        .replace("\"TIP\"", "\"NODE_2\"")
        .replace("\"RIGHT\"", "\"NODE_2\"");
    let along = case.replace("\"0 N\"", "\"1 N\"");
    refused(&bench(&along, &small), &["the force along z acts on node 2", "keep this dof"]);
    let axial = case.replace(
        "{ xx = \"1e5 N/m\", yy = \"2e5 N/m\" }",
        "{ xx = \"1e5 N/m\", yy = \"2e5 N/m\" }\naxial_stiffness = \"1 N/m\"",
    );
    refused(
        &bench(&axial, &small),
        &["`NODE_2` needs the displacement along z of node 2", "keep this dof"],
    );
    // Sets with nodes that have no dofs.
    let sets = few(&files()[8].1, "95.");
    let (k, m) = (few(&files()[6].1, "nothing"), few(&files()[7].1, "nothing"));
    let cut = |text: &str| -> String {
        let gone = 94 * 3 + 1..=94 * 3 + 3;
        let lines = text.lines().filter_map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [i, j] = [0, 1].map(|place| words[place].parse::<usize>().expect("a place"));
            let new = |place: usize| if place > *gone.end() { place - 3 } else { place };
            (!gone.contains(&i) && !gone.contains(&j))
                .then(|| format!("{} {} {}\n", new(i), new(j), words[2]))
        });
        lines.collect()
    };
    let (k, m) = (cut(&k), cut(&m));
    let changed = [("job.dof", sets.as_str()), ("job.sti", k.as_str()), ("job.mas", m.as_str())];
    refused(
        &bench(&standing(FORMATS[2]), &changed),
        &["1 of the nodes of `TIP` have no dofs", "such as node 95"],
    );
    // No cells, no fields.
    let whole = format!("{}\n[fields]\nframes = 4\n", labelled(&case));
    refused(&bench(&whole, &small), &["no body of this case has a mesh", "`[output.NAME]`"]);
    // Files that are not there, keys that exclude each other, and Y without H.
    for (matrices, words) in [
        ("{ calculix = \"other\", nodes = \"bar.inp\" }", vec!["there is no file", "other.sti"]),
        (
            "{ dmig = \"bar.pch\", calculix = \"job\", nodes = \"bar.inp\" }",
            vec!["exclude each other"],
        ),
        ("{ stiffness = \"K.mtx\", mass = \"M.mtx\" }", vec!["`dofs = \"dofs.csv\"`"]),
        (
            "{ calculix = \"job\", nodes = \"bar.inp\", spin_inertia = \"K.mtx\" }",
            vec!["given without `spin_coupling`", "together"],
        ),
        (
            "{ dmig = \"bar.pch\", nodes = \"bar.bdf\", stiffness = \"KGG\" }",
            vec!["no DMIG `KGG`", "KAAX"],
        ),
    ] {
        refused(&bench(&standing(&format!("matrices = {matrices}")), &[]), &words);
    }
}
