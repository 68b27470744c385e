//! Reading Nastran's bulk data: what is accepted, what is refused, and what it means.

mod damage;
mod errors;
mod fixtures;
mod hostile;
mod writer;

use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::time::{Duration, Instant};

use whirl_benches::hand::elements::ELEMENTS;
use whirl_solver::error::InputErrors;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::bdf;
use whirl_solver::mesh::format::{MeshUnits, ReadMesh, ReadOptions};

use self::writer::{Form, write};
use crate::bodies::reference;

/// A cube, and a wedge beside it, with much that is left out.
const GOOD: &str = "SOL 103
CEND
TITLE = A cube and a wedge
SET 5 = 1 THRU 4 EXCEPT 2, 9
$HMSET        6        1 \"ends\"
SET 6 = 5,
  6, 800
BEGIN BULK
$HMNAME PROP                   1\"cube\" 4
PARAM,POST,-1
GRID           1              0.      0.      0.
GRID           2              1.      0.      0.
GRID           3              1.    1.+0      0.
GRID*                  4                              0.              1.*
*                     0.
GRID,5,,0.,0.,1.
GRID,6,,1.,0.,1.
GRID           7              1.     1.0   1.E+0
GRID           8                      1.   1.D+0
GRID           9              2.      0.      0.
GRID          10              2.      0.      1.
GRID          20            .666    .333     -5.
CHEXA        101       1       1       2       3       4       5       6
               7       8
CPENTA       102       2       2       9       3       6      10       7
MAT1           1   2.+11              .3   7860.
MAT1           2   7.+10              .3   2700.
PSOLID         1       1
$ Elements and Element Properties for region : wedge
PSOLID         2       2
RBE2          17      20     123       1       2       3
RBE3,18,,20,123456,1.,123,5,6
,7
CONM2         21      20           5.5
CQUAD4       201       3       1       2       3       4
PSHELL         3       1     .01
SPC1           1     123       1       2
ENDDATA
this is not read
";

fn options() -> ReadOptions<'static> {
    ReadOptions::new(&ELEMENTS)
}

fn no_files(_: &Path) -> io::Result<String> {
    Err(io::Error::new(io::ErrorKind::NotFound, "no such file"))
}

fn read(text: &str) -> Result<ReadMesh, InputErrors> {
    bdf::read(text, "cube.bdf", &options(), &no_files)
}

fn good(text: &str) -> ReadMesh {
    read(text).unwrap_or_else(|errors| panic!("{errors}"))
}

fn labels(mesh: &Mesh, set: &str) -> Vec<u64> {
    mesh.node_set(set).unwrap().iter().map(|&node| mesh.labels()[node]).collect()
}

#[test]
fn a_good_file_gives_its_mesh() {
    let ReadMesh { mesh, masses, warnings } = good(GOOD);
    assert_eq!((mesh.nodes().len(), mesh.cell_count(), mesh.origin()), (10, 2, "cube.bdf"));
    assert_eq!((mesh.nodes()[2], mesh.nodes()[6]), ([1.0, 1.0, 0.0], [1.0, 1.0, 1.0]));
    assert_eq!(mesh.nodes()[3], [0.0, 1.0, 0.0]);
    let names: Vec<&str> = mesh.blocks().iter().map(|b| b.element.origin.name).collect();
    assert_eq!(names, ["hex8i", "wedge6"]);
    assert_eq!(mesh.blocks()[0].connectivity, [0, 1, 2, 3, 4, 5, 6, 7]);
    assert_eq!(mesh.blocks()[1].connectivity, [1, 8, 2, 5, 9, 6]);
    assert_eq!(mesh.blocks()[1].labels, [102]);
    let sets: Vec<&str> = mesh.node_sets().keys().map(String::as_str).collect();
    assert_eq!(sets, ["RBE2_17", "RBE3_18", "SET_5", "ends"]);
    assert_eq!((labels(&mesh, "SET_5"), labels(&mesh, "ENDS")), (vec![1, 3, 4, 9], vec![5, 6]));
    assert_eq!(
        (labels(&mesh, "RBE2_17"), labels(&mesh, "RBE3_18")),
        (vec![1, 2, 3], vec![5, 6, 7])
    );
    let sets: Vec<&str> = mesh.element_sets().keys().map(String::as_str).collect();
    assert_eq!(sets, ["cube", "wedge"]);
    let materials: Vec<(&str, f64)> = mesh
        .materials()
        .iter()
        .map(|material| (material.name.as_str(), material.properties["rho"]))
        .collect();
    assert_eq!(materials, [("MAT1_1", 7860.0), ("MAT1_2", 2700.0)]);
    assert_eq!(mesh.materials()[0].properties["E"], 2e11);
    assert_eq!((masses.len(), masses[0].mass, masses[0].at), (1, 5.5, [0.666, 0.333, -5.0]));
    assert_eq!(masses[0].sets, ["RBE2_17", "RBE3_18"]);
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings,
        [
            "cube.bdf:6:1: 1 of the labels of SET 6 are no nodes of solid elements\n  help: a set of elements is \
             of no use; the node set ends has the others",
            "cube.bdf:35:1: left out, as only solid elements are read: 1 CQUAD4, 1 PSHELL, 1 SPC1",
        ]
    );
}

/// The same mesh in the reference's own words and in bulk data.
fn compare(read: &Mesh, wanted: &Mesh, digits: f64) {
    assert_eq!(read.labels(), wanted.labels());
    for (read, wanted) in read.nodes().iter().zip(wanted.nodes()) {
        for (read, wanted) in read.iter().zip(wanted) {
            assert!((read - wanted).abs() <= digits * wanted.abs(), "{read} for {wanted}");
        }
    }
    assert_eq!(read.blocks().len(), wanted.blocks().len());
    for (read, wanted) in read.blocks().iter().zip(wanted.blocks()) {
        assert_eq!(read.element.origin.name, wanted.element.origin.name);
        assert_eq!(read.labels, wanted.labels);
        assert_eq!(read.connectivity, wanted.connectivity);
        assert_eq!(read.material, wanted.material);
    }
    assert_eq!(read.node_sets(), wanted.node_sets());
    assert_eq!(read.materials(), wanted.materials());
}

#[test]
fn the_reference_bodies_are_the_same_in_every_form() {
    for name in ["shaft", "support"] {
        let wanted = reference(name);
        // A number such as -1.2345-3 has as many digits as fit into its columns.
        for (form, digits) in [(Form::Small, 5e-3), (Form::Large, 1e-9), (Form::Free, 0.0)] {
            let ReadMesh { mesh, masses, warnings } = good(&write(&wanted, form));
            assert_eq!((masses, warnings), (vec![], vec![]), "{form:?}");
            compare(&mesh, &wanted, digits);
        }
    }
}

#[test]
fn line_ends_tabs_and_capitals_do_not_matter() {
    let changed = GOOD
        .to_lowercase()
        .replace("grid           9              2.      0.", "grid\t9\t\t2.\t0.")
        .replace("\n", "\r\n");
    let mesh = good(&changed).mesh;
    assert_eq!((mesh.nodes().len(), mesh.cell_count()), (10, 2));
    assert_eq!(mesh.nodes()[8], [2.0, 0.0, 0.0]);
    let bulk = GOOD.split_once("BEGIN BULK\n").unwrap().1;
    assert_eq!(good(bulk).mesh.node_sets().len(), 2);
}

#[test]
fn blank_fields_take_the_defaults() {
    let system = "GRDSET,,7\nCORD2R,7,,0.,0.,10.,0.,0.,11.\n,1.,0.,10.\n";
    let text = GOOD
        .replace("BEGIN BULK\n", &format!("BEGIN BULK\n{system}"))
        .replace("GRID,5,,", "GRID,5,0,");
    let mesh = good(&text).mesh;
    assert_eq!((mesh.nodes()[0][2], mesh.nodes()[4][2], mesh.nodes()[9][2]), (10.0, 1.0, 11.0));
}

/// Weights in pounds and inches are masses after WTMASS; two of E, G and ν give the third.
#[test]
fn materials_follow_from_what_is_given() {
    let text = GOOD
        .replace("PARAM,POST,-1", "PARAM,WTMASS,.5")
        .replace(
            "MAT1           1   2.+11              .3",
            "MAT1           1           8.+10     .25",
        )
        .replace(
            "MAT1           2   7.+10              .3",
            "MAT1           2   7.+10 2.8+10        ",
        );
    let read = good(&text);
    let values = |material: usize| {
        let properties = &read.mesh.materials()[material].properties;
        ["E", "nu", "rho"].map(|symbol| properties[symbol])
    };
    assert_eq!((values(0), values(1)), ([2e11, 0.25, 3930.0], [7e10, 0.25, 1350.0]));
    assert_eq!(read.masses[0].mass, 2.75);
}

#[test]
fn elements_without_a_material_may_be_left_open() {
    let text = GOOD.replace("PSOLID         2       2\n", "");
    assert!(read(&text).is_err());
    let open = bdf::read(&text, "cube.bdf", &ReadOptions { open: true, ..options() }, &no_files)
        .unwrap()
        .mesh;
    let names: Vec<&str> = open.materials().iter().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["MAT1_1", "MAT1_2", ""]);
    assert_eq!(open.element_set("PSOLID_2").unwrap().len(), 1);
}

/// Included files count from the folder of the one that includes them; their errors name them.
#[test]
fn files_include_files() {
    let (start, rest) = GOOD.split_once("CHEXA").unwrap();
    let main = format!("{start}INCLUDE 'parts/\n   cells.bdf'\n");
    let with = |cells: &str, end: &str| {
        let files = BTreeMap::from([
            (
                "models/parts/cells.bdf".to_owned(),
                format!("$ cells\nCHEXA{cells}include more/end.bdf\n"),
            ),
            ("models/parts/more/end.bdf".to_owned(), end.to_owned()),
        ]);
        let load = |path: &Path| {
            files.get(path.to_str().unwrap()).cloned().ok_or(io::ErrorKind::NotFound.into())
        };
        bdf::read(&main, "models/cube.bdf", &options(), &load).map_err(|errors| errors.to_string())
    };
    let (cells, end) = rest.split_once("MAT1").unwrap();
    let end = format!("MAT1{end}");
    assert_eq!(with(cells, &end).unwrap().mesh.cell_count(), 2);
    let help = "take the line out: files must not include each other in a circle";
    assert_eq!(
        with(cells, &end.to_string().replace("ENDDATA", "INCLUDE '../../cube.bdf'")).unwrap_err(),
        format!("models/parts/more/end.bdf:13:1: ../../cube.bdf includes itself\n  help: {help}")
    );
    assert_eq!(
        with(&cells.replace("10       7", "99       7"), &end.replace("7860.", "heavy"))
            .unwrap_err(),
        "models/parts/cells.bdf:4:1: element 102 has node 99, which is not defined\n  help: add its GRID, or correct \
         the label\nmodels/parts/more/end.bdf:1:44: density ρ (field 6 of MAT1) must be a number, found `heavy`\n  \
         help: write it as 0.0115, 1.15E-2 or 1.15-2"
    );
    let twice = "INCLUDE '../cells.bdf'\n";
    assert_eq!(
        with(cells, &end.to_string().replace("ENDDATA", twice)).unwrap_err(),
        "models/parts/more/end.bdf:13:1: ../cells.bdf is included twice, or includes itself\n  help: take one out: \
         line 23 of models/cube.bdf has the first"
    );
}

/// As files that share an interface have it; what differs in any field is another node.
#[test]
fn a_grid_may_stand_twice() {
    let grid = "GRID           9              2.      0.      0.\n";
    assert_eq!(GOOD.matches(grid).count(), 1);
    let twice = good(&GOOD.replace(grid, &format!("{grid}GRID,9,,2.,0.,0.\n"))).mesh;
    let once = good(GOOD).mesh;
    assert_eq!((twice.nodes(), twice.labels()), (once.nodes(), once.labels()));
    assert!(read(&GOOD.replace(grid, &format!("{grid}GRID,9,,2.,0.,0.,3\n"))).is_err());
}

#[test]
fn masses_are_in_units_of_the_file() {
    let units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let text = GOOD
        .replace("CONM2         21      20           5.5", "CONM2,21,20,,5.5-3,,,2.\n,4.,,5.,,,6.")
        .replace("2.+11 ", "2.+5  ")
        .replace("7.+10 ", "7.+4  ")
        .replace(" 7860.", "7.86-9")
        .replace("2700.", "2.7-9");
    let read = bdf::read(&text, "cube.bdf", &ReadOptions { units, ..options() }, &no_files);
    let read = read.unwrap_or_else(|errors| panic!("{errors}"));
    let mass = &read.masses[0];
    assert!((mass.mass - 5.5).abs() < 1e-14 && (mass.at[2] + 3e-3).abs() < 1e-17);
    assert!((mass.inertia[2][2] - 6e-3).abs() < 1e-17);
    assert!((read.mesh.materials()[0].properties["rho"] - 7860.0).abs() < 1e-9);
    assert!((read.mesh.nodes()[8][0] - 2e-3).abs() < 1e-17);
}

/// In a spherical system the offset and the inertia of a mass are along r, θ and φ at its node.
#[test]
fn a_mass_in_a_spherical_system_has_the_directions_of_its_node() {
    // From (1, 2, 3), with its axes: z along y, x along z, so that y is along x.
    let system = "CORD2S,7,,1.,2.,3.,1.,3.,3.\n,1.,2.,4.\nGRID,20,,3.,4.,4.\n";
    let text = GOOD.replace("GRID          20            .666    .333     -5.\n", system).replace(
        "CONM2         21      20           5.5",
        "CONM2,21,20,7,5.5,.3,.6,.9\n,4.,,5.,,,6.",
    );
    let mass = &good(&text).masses[0];
    // In the system the node is at (1, 2, 2): r = 3, and 2/3 of it along its z.
    let (about, r) = (5.0_f64.sqrt(), 3.0);
    let own = [
        [1.0 / r, 2.0 / r, 2.0 / r],
        [2.0 / r * 1.0 / about, 2.0 / r * 2.0 / about, -about / r],
        [-2.0 / about, 1.0 / about, 0.0],
    ];
    // Own x, y, z are z, x, y of the basic system.
    let directions = own.map(|[x, y, z]| [y, z, x]);
    for i in 0..3 {
        let moved: f64 = (0..3).map(|k| [0.3, 0.6, 0.9][k] * directions[k][i]).sum();
        let exact = [3.0, 4.0, 4.0][i] + moved;
        assert!((mass.at[i] - exact).abs() < 1e-14, "{i}: {} for {exact}", mass.at[i]);
        for j in 0..3 {
            let exact: f64 =
                (0..3).map(|k| [4.0, 5.0, 6.0][k] * directions[k][i] * directions[k][j]).sum();
            let found = mass.inertia[i][j];
            assert!((found - exact).abs() < 1e-14, "{i} {j}: {found} for {exact}");
        }
    }
}

/// A card of systems on grid points holds two of them.
#[test]
fn the_second_system_of_a_card_counts() {
    let systems = "CORD1R,7,1,5,2,8,2,1,3\nGRID,9,8,.25,.5,2.\n";
    let text = GOOD.replace("GRID           9              2.      0.      0.\n", systems);
    // Origin at node 2 (1, 0, 0), z from there to node 1: −x; node 3 (1, 1, 0) in the half plane of x: y; and y = z × x: −z.
    let position = good(&text).mesh.nodes()[8];
    for (found, exact) in position.iter().zip([-1.0, 0.25, -0.5]) {
        assert!((found - exact).abs() < 1e-15, "{position:?}");
    }
}

/// 3·10⁵ degrees of freedom take half a second; what grew with the square of the file would take minutes.
#[test]
fn large_files_are_read_in_time() {
    let text = writer::many(&reference("shaft"), 53);
    let start = Instant::now();
    let mesh = good(&text).mesh;
    assert!(mesh.dof_count() > 300_000);
    assert!(start.elapsed() < Duration::from_secs(20), "{:?}", start.elapsed());
}
