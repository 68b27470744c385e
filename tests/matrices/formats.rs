//! One body through each format.

use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::support::Support;
use whirl_tests::matrices as written;

use super::{Texts, bar, calculix, close, dmig, market, on_feet, supports_agree};

pub(super) fn as_market(mesh: &Mesh) -> Texts {
    let [k, m] = written::of_mesh(mesh);
    Texts::default()
        .with("K.mtx", written::market(&k, "symmetric"))
        .with("M.mtx", written::market(&m, "general"))
        .with("dofs.csv", written::dofs(mesh))
}

pub(super) fn as_dmig(mesh: &Mesh) -> Texts {
    let [k, m] = written::of_mesh(mesh);
    let punch = written::dmig("KAAX", &k, mesh) + &written::dmig("MAAX", &m, mesh);
    Texts::default().with("body.pch", punch).with("body.bdf", written::grids(mesh))
}

pub(super) fn as_calculix(mesh: &Mesh) -> Texts {
    let [k, m] = written::of_mesh(mesh);
    Texts::default()
        .with("job.sti", written::calculix(&k))
        .with("job.mas", written::calculix(&m))
        .with("job.dof", written::calculix_dofs(mesh))
        .with("job.inp", written::input(mesh))
}

/// A body on feet from its mesh, and from its matrices in every format.
#[test]
fn a_body_of_matrices_is_the_one_of_its_mesh() {
    let mesh = bar();
    let made = Support::from_mesh(&mesh, &on_feet(&mesh, 12)).expect("a body");
    for (name, texts, request) in [
        ("Matrix Market", as_market(&mesh), market()),
        ("DMIG", as_dmig(&mesh), dmig()),
        ("CalculiX", as_calculix(&mesh), calculix()),
    ] {
        let read = texts.mesh(&request);
        assert_eq!(read.placed(), mesh.nodes().len(), "{name}");
        let found = Support::from_mesh(&read, &on_feet(&read, 12)).expect(name);
        assert_eq!(found.hertz.len(), 12);
        for (a, b) in made.hertz.iter().zip(&found.hertz) {
            assert!(close(*a, *b, 1e-9), "{name}: {a} {b} Hz");
        }
        supports_agree(&made, &found, 1e-9);
    }
}

/// Sets of nodes come along, and every node is a set.
#[test]
fn sets_of_nodes_come_along() {
    let mesh = bar();
    let read = as_calculix(&mesh).mesh(&calculix());
    assert_eq!(read.node_sets(), mesh.node_sets());
    assert_eq!(read.node_set("node_7").expect("a node"), [6]);
    assert!(read.node_set("NODE_100000").is_err());
    assert!(read.node_set("NODE_").is_err());
}

/// Numbers in mm, N, t give the body of those in m, N, kg.
#[test]
fn units_are_converted() {
    let mesh = bar();
    let mut texts = as_dmig(&mesh);
    // K in N/mm, M in t, places in mm.
    let [mut k, mut m] = written::of_mesh(&mesh);
    k.values.iter_mut().for_each(|value| *value *= 1e-3);
    m.values.iter_mut().for_each(|value| *value *= 1e-3);
    let punch = written::dmig("KAAX", &k, &mesh) + &written::dmig("MAAX", &m, &mesh);
    let mut grids = "BEGIN BULK\n".to_owned();
    for (label, place) in mesh.labels().iter().zip(mesh.nodes()) {
        let [x, y, z] = place.map(|x| 1e3 * x);
        grids += &format!("GRID,{label},,{x:e},{y:e},{z:e}\n");
    }
    texts = texts.with("body.pch", punch).with("body.bdf", grids);
    let mut request = dmig();
    request.units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let read = texts.mesh(&request);
    let made = Support::from_mesh(&mesh, &on_feet(&mesh, 6)).expect("a body");
    let found = Support::from_mesh(&read, &on_feet(&read, 6)).expect("a body");
    supports_agree(&made, &found, 1e-9);
}

/// What Nastran punches: large fields with D exponents, a scalar point, small fields, comments.
#[test]
fn cards_are_read_in_every_field_width() {
    let small = |fields: &[&str]| {
        let rest: Vec<String> = fields[1..].iter().map(|field| format!("{field:>8}")).collect();
        format!("{:<8}{}\n", fields[0], rest.concat())
    };
    let punch = [
        "$TITLE   = A BODY\n".to_owned(),
        small(&["DMIG", "KAAX", "0", "6", "2", "0"]),
        "DMIG*   KAAX                           1               1\n".to_owned(),
        "*                      1               1 2.500000000D+03\n".to_owned(),
        "*                      2               1-1.500000000D+03\n".to_owned(),
        "DMIG*   KAAX                           2               1\n".to_owned(),
        "*                      2               1 1.500000000D+03\n".to_owned(),
        small(&["DMIG", "KAAX", "9", "0", "", "9", "", "1+4"]),
        "$ the masses\n".to_owned(),
        "DMIG,MAAX,0,1,1,0\n".to_owned(),
        "DMIG,MAAX,1,1,,1,1,2.0\n".to_owned(),
        small(&["DMIG", "MAAX", "2", "1", "", "2", "1", "3.0", ""]),
        small(&["", "9", "", ".5"]),
        small(&["DMIG", "MAAX", "9", "0", "", "9", "", "1.0", ""]),
        small(&["", "2", "1", ".5"]),
    ];
    let texts = Texts::default()
        .with("body.pch", punch.concat())
        .with("body.bdf", "GRID,1,,0.,0.,0.\nGRID,2,,0.,0.,1.\nGRID,3,,0.,0.,2.\n");
    let mesh = texts.mesh(&dmig());
    // Two nodes with a place, and one for the scalar point.
    assert_eq!((mesh.placed(), mesh.nodes().len()), (2, 3));
    let [k, m] = written::of_mesh(&mesh);
    let all: Vec<(usize, usize, f64)> =
        (0..9).flat_map(|j| k.column(j).map(move |(i, v)| (i, j, v)).collect::<Vec<_>>()).collect();
    assert_eq!(
        all,
        [(0, 0, 2500.0), (3, 0, -1500.0), (0, 3, -1500.0), (3, 3, 1500.0), (6, 6, 10_000.0)]
    );
    assert_eq!(m.column(3).collect::<Vec<_>>(), [(3, 3.0), (6, 0.5)]);
}
