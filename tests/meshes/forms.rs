//! Input of Abaqus and CalculiX as programs write it: elements that are no solids, reduced integration, sets of other
//! sets, gaps, materials of static analyses, other formats.

use std::fs;

use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{ReadMesh, ReadOptions, read};

use crate::{elements, open};

/// Three cells along z.
const NODES: &str = "*NODE\n1, -6, -4, 0\n2, 6, -4, 0\n3, 6, 4, 0\n4, -6, 4, 0\n5, -6, -4, 15\n6, 6, -4, 15\n7, 6, 4, 15\n\
                     8, -6, 4, 15\n9, -6, -4, 30\n10, 6, -4, 30\n11, 6, 4, 30\n12, -6, 4, 30\n";
const CELLS: &str = "11, 1,2,3,4,\n5,6,7,8\n12, 5,6,7,8,\n9,10,11,12\n";

fn found(text: &str) -> ReadMesh {
    open(text.as_bytes(), "bar.inp").unwrap_or_else(|errors| panic!("{errors}"))
}

fn bar(more: &str) -> ReadMesh {
    found(&format!("{NODES}*ELEMENT, TYPE=C3D8I, ELSET=BAR\n{CELLS}{more}"))
}

fn refused(text: &str) -> Vec<String> {
    let errors = open(text.as_bytes(), "bar.inp").map(|_| ()).unwrap_err();
    errors.0.iter().map(|error| format!("{}: {}", error.line, error.what)).collect()
}

fn labels(mesh: &Mesh, set: &str) -> Vec<u64> {
    let nodes = mesh.node_set(set).unwrap_or_else(|error| panic!("{error}"));
    let mut labels: Vec<u64> = nodes.iter().map(|&node| mesh.labels()[node]).collect();
    labels.sort_unstable();
    labels
}

fn warned(read: &ReadMesh) -> Vec<&str> {
    read.warnings
        .iter()
        .map(|warning| warning.what.as_str())
        .filter(|what| !what.contains("long"))
        .collect()
}

#[test]
fn a_node_set_of_an_element_set_has_its_nodes() {
    let read = bar(
        "*ELSET, ELSET=ROOT\n11\n*NSET, NSET=A, ELSET=ROOT\n*NSET, NSET=B, ELSET=bar\n*NSET, NSET=C, ELSET=ROOT\n12\n",
    );
    assert_eq!(labels(&read.mesh, "A"), [1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(labels(&read.mesh, "B").len(), 12);
    assert_eq!(labels(&read.mesh, "C"), [1, 2, 3, 4, 5, 6, 7, 8, 12]);
    let text =
        format!("{NODES}*ELEMENT, TYPE=C3D8I, ELSET=BAR\n{CELLS}*NSET, NSET=A, ELSET=BARR\n");
    assert_eq!(refused(&text), ["19: no set of cells is called BARR"]);
}

/// Lines and faces are left out, and their sets are sets of nodes, as of physical groups of Gmsh.
#[test]
fn elements_that_are_no_solids_are_counted_and_left_out() {
    let text = format!(
        "{NODES}*ELEMENT, TYPE=T3D2, ELSET=Line1\n1, 1, 2\n*ELEMENT, TYPE=CPS4, ELSET=Surface1\n2, 1, 2,\n3, 4\n3, 5, 6, 7, 8\n\
         *ELEMENT, TYPE=C3D8I, ELSET=Volume1\n{CELLS}*ELEMENT, TYPE=MASS, ELSET=M\n90, 9\n*ELEMENT, TYPE=SPRINGA, ELSET=SP\n\
         91, 9, 10\n*ELEMENT, TYPE=S8R, ELSET=SKIN\n92, 1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=B32\n93,1,2,3\n\
         *ELSET, ELSET=foot\n2\n*ELSET, ELSET=MIXED\n3, 11, 90\n*ELSET, ELSET=RANGE, GENERATE\n1, 3\n*ELSET, ELSET=AGAIN\nfoot\n\
         *NSET, NSET=SKIN\n9\n*NSET, NSET=OF_FACES, ELSET=foot\n*SURFACE, NAME=TOP\nSurface1, SPOS\n*SURFACE, NAME=ONE\n3, SNEG\n\
         *MATERIAL, NAME=ST\n*ELASTIC\n2e5, .3\n*SOLID SECTION, ELSET=Line1, MATERIAL=ST\n"
    );
    let read = found(&text);
    let what = "left out, as only solid elements are read: 1 B32, 2 CPS4, 1 MASS, 1 S8R, 1 SPRINGA, 1 T3D2";
    assert_eq!(warned(&read), [what]);
    let sets: Vec<(&str, usize)> =
        read.mesh.element_sets().iter().map(|(name, cells)| (name.as_str(), cells.len())).collect();
    assert_eq!(sets, [("MIXED", 1), ("Volume1", 2)]);
    let mesh = &read.mesh;
    assert_eq!((labels(mesh, "Line1"), labels(mesh, "foot")), (vec![1, 2], vec![1, 2, 3, 4]));
    assert_eq!(labels(mesh, "AGAIN"), [1, 2, 3, 4]);
    assert_eq!(labels(mesh, "RANGE"), [1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(labels(mesh, "Surface1"), [1, 2, 3, 4, 5, 6, 7, 8]);
    assert_eq!(labels(mesh, "SKIN"), [9], "the file has a node set of that name");
    assert_eq!(
        (labels(mesh, "OF_FACES"), labels(mesh, "ONE")),
        (vec![1, 2, 3, 4], vec![5, 6, 7, 8])
    );
    assert_eq!(labels(mesh, "TOP").len(), 8);
}

#[test]
fn reduced_hybrid_and_modified_elements_are_read_as_their_like() {
    for (name, known, words) in [
        ("C3D8R", "hex8i", "13 % lower"),
        ("c3d8rh", "hex8i", "13 % lower"),
        ("C3D8H", "hex8i", "near 0.5"),
        ("C3D8T", "hex8", "temperatures"),
    ] {
        let read = found(&format!("{NODES}*ELEMENT, TYPE={name}\n{CELLS}"));
        assert_eq!((read.mesh.blocks()[0].element.origin.name, read.mesh.cell_count()), (known, 2));
        let warning =
            read.warnings.iter().find(|own| own.what.contains("read as")).expect("a warning");
        assert!(warning.what.starts_with("2 cells of C3D8"), "{}", warning.what);
        assert!(warning.help.contains(words), "{name}: {}", warning.help);
    }
    let brick = "*NODE\n1,0,0,0\n2,2,0,0\n3,2,2,0\n4,0,2,0\n5,0,0,2\n6,2,0,2\n7,2,2,2\n8,0,2,2\n9,1,0,0\n10,2,1,0\n11,1,2,0\n\
                 12,0,1,0\n13,1,0,2\n14,2,1,2\n15,1,2,2\n16,0,1,2\n17,0,0,1\n18,2,0,1\n19,2,2,1\n20,0,2,1\n";
    let cell = "1,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,\n16,17,18,19,20\n";
    for name in ["C3D20R", "c3d20rh"] {
        let read = found(&format!("{brick}*ELEMENT, TYPE={name}\n{cell}"));
        assert_eq!(read.mesh.blocks()[0].element.origin.name, "hex20");
        let warning =
            read.warnings.iter().find(|own| own.what.contains("read as")).expect("a warning");
        assert!(warning.what.starts_with("1 cell of C3D20R"), "{}", warning.what);
        assert!(
            warning.help.contains("3 % lower") && warning.help.contains("0.1 %"),
            "{}",
            warning.help
        );
    }
    let tetrahedron = "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n10,0,1,1\n";
    let read = found(&format!("{tetrahedron}*ELEMENT, TYPE=C3D10M\n1,1,2,3,4,5,6,7,8,9,10\n"));
    assert_eq!(read.mesh.blocks()[0].element.origin.name, "tet10");
    // Solids that are none of these are refused, and say so once.
    let text = format!("{NODES}*ELEMENT, TYPE=C3D27, ELSET=BAR\n{CELLS}");
    let errors = open(text.as_bytes(), "bar.inp").map(|_| ()).unwrap_err().to_string();
    assert!(
        errors.contains("hexahedra of 27 nodes") && !errors.contains("did you mean"),
        "{errors}"
    );
    for name in ["C3D27", "C3D8X", "DC3D8", "AC3D8", "COH3D8", "SC8R", "CCL12", "U1"] {
        let text = format!("{NODES}*ELEMENT, TYPE={name}, ELSET=BAR\n{CELLS}");
        assert_eq!(refused(&text), [format!("14: no element is known for type {name}")]);
    }
}

/// Gmsh writes them into files of every format.
#[test]
fn hexahedra_of_27_nodes_have_a_remedy_in_every_format() {
    let all = || (1..=27).map(|node| (node, [node % 3, node / 3 % 3, node / 9].map(f64::from)));
    let nodes: Vec<String> = (1..=27).map(|node| node.to_string()).collect();
    let grids = all().map(|(node, [x, y, z])| format!("GRID,{node},,{x:?},{y:?},{z:?}\n"));
    let rows: Vec<String> =
        nodes[6..].chunks(8).map(|own| format!(",{}\n", own.join(","))).collect();
    let bulk = format!(
        "{}CHEXA,1,1,{}\n{}",
        grids.collect::<String>(),
        nodes[..6].join(","),
        rows.concat()
    );
    let points = all().map(|(node, [x, y, z])| format!("{node} 1 1 11\n {x:?} {y:?} {z:?}\n"));
    let rows: Vec<String> = nodes.chunks(8).map(|own| format!(" {}\n", own.join(" "))).collect();
    let universal = format!(
        "    -1\n  2411\n{}    -1\n    -1\n  2412\n1 115 1 1 7 27\n{}    -1\n",
        points.collect::<String>(),
        rows.concat()
    );
    for (text, path) in [(bulk, "h.bdf"), (universal, "h.unv")] {
        let errors = open(text.as_bytes(), path).map(|_| ()).unwrap_err().to_string();
        assert!(
            errors.contains("27 nodes") && errors.contains("SecondOrderIncomplete"),
            "{errors}"
        );
    }
}

/// What is missing because of an error is no further error.
#[test]
fn errors_that_follow_from_others_are_not_given() {
    let sets = "*NSET, NSET=A\n1, 99\n*ELSET, ELSET=E\n11, 14\n*NSET, NSET=B, ELSET=E\n*SURFACE, NAME=S\nX, S1\n\
                *MATERIAL, NAME=M\n*SOLID SECTION, ELSET=X, MATERIAL=M\n";
    let first = |text: String| {
        let errors = refused(&text);
        assert_eq!(errors.len(), 1, "{errors:?}");
        errors[0].clone()
    };
    let cells = format!("*ELEMENT, TYPE=C3D8I, ELSET=BAR\n{CELLS}");
    assert!(
        first(format!("*INCLUDE, INPUT=none.inp\n{NODES}{cells}{sets}"))
            .starts_with("1: there is no file")
    );
    assert!(
        first(format!("*NGEN\n1, 5\n{NODES}{cells}{sets}")).starts_with("1: *NGEN is not read")
    );
    let known = sets.replace(", 99", "");
    let types = format!("{NODES}*ELEMENT, TYPE=C3D99, ELSET=X\n{CELLS}{known}");
    assert!(first(types).starts_with("14: no element is known"));
    let parts =
        format!("*PART, NAME=A\n{NODES}{cells}*END PART\n*PART, NAME=B\n{NODES}{cells}*END PART\n");
    assert_eq!(first(parts), "21: a second *PART is not read: both have solid elements");
    let label = format!("{}{cells}", NODES.replace("\n5, ", "\nfive, "));
    assert!(first(label).starts_with("6: label of a node must be"));
}

#[test]
fn ranges_have_gaps_and_nodes_need_no_z() {
    let read =
        bar("*NSET, NSET=A, GENERATE\n1, 20\n*NSET, NSET=B\n1\n*ELSET, ELSET=E\n11.0, 99, 0, -1\n");
    assert_eq!(labels(&read.mesh, "A").len(), 12);
    // As CalculiX has it; meshio writes such sets.
    assert_eq!(
        warned(&read),
        [
            "8 labels of the set A that no node has, left out",
            "3 labels of the set E that no cell has, left out"
        ]
    );
    assert_eq!(read.mesh.element_set("E").expect("a set").len(), 1);
    let text = NODES.replace("*NODE", "*NODE, SYSTEM=R").replace("6, -4, 0\n", "6, -4\n");
    let read = found(&format!(
        "{text}*ELEMENT, TYPE=C3D8I\n{CELLS}*ORIENTATION, NAME=O, SYSTEM=CYLINDRICAL\n0,0,0,0,0,1\n"
    ));
    assert_eq!(read.mesh.nodes()[1], [6.0, -4.0, 0.0]);
    assert_eq!(warned(&read), ["*ORIENTATION is left out"]);
}

/// Materials of static analyses have no density.
#[test]
fn a_material_without_density_is_kept_where_another_may_take_its_place() {
    let section = "*MATERIAL, NAME=ALU\n*ELASTIC\n70000., .33\n*SOLID SECTION, ELSET=BAR, MATERIAL=ALU\n\
                   *MATERIAL, NAME=UNUSED\n*ELASTIC, TYPE=ORTHOTROPIC\n1,2,3\n";
    let read_open = bar(section);
    let material = &read_open.mesh.materials()[read_open.mesh.blocks()[0].material];
    assert_eq!((material.properties["E"], material.lacks()), (7e4, Some("density")));
    let text = format!("{NODES}*ELEMENT, TYPE=C3D8I, ELSET=BAR\n{CELLS}{section}");
    let elements = elements();
    let closed = read(text.into_bytes(), "bar.inp", &ReadOptions::new(&elements));
    let error = closed.map(|_| ()).unwrap_err().to_string();
    assert!(error.starts_with("bar.inp:19:1: material ALU has no *DENSITY"), "{error}");
    // One that is not isotropic has nothing to be kept.
    let read = bar(
        "*MATERIAL, NAME=O\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n1,2,3,4,5,6,7,8\n9\n*SOLID SECTION, ELSET=BAR, MATERIAL=O\n",
    );
    assert!(read.mesh.materials()[read.mesh.blocks()[0].material].properties.is_empty());
    assert_eq!(
        warned(&read),
        ["material O is ENGINEERING CONSTANTS: only isotropic materials are read"]
    );
}

#[test]
fn ties_of_nodes_of_cells_are_read_and_spiders_are_sets() {
    let node = NODES.replace("12, -6", "50, 0, 0, -9\n12, -6");
    let text = |more: &str| {
        format!(
            "{node}*ELEMENT, TYPE=C3D8I, ELSET=BAR\n{CELLS}*NSET, NSET=A\n1, 2\n*SURFACE, NAME=S\nBAR, S1\n{more}"
        )
    };
    for (more, equations) in [
        ("*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n", 1),
        ("*EQUATION\n2\nA, 1, 1., 50, 1, -1.\n", 1),
        ("*MPC\nBEAM, 1, 2\n", 1),
        ("*RIGID BODY, ELSET=BAR, REF NODE=50\n", 3 * 12 - 6),
        ("*COUPLING, REF NODE=1, SURFACE=S, CONSTRAINT NAME=C\n*KINEMATIC\n1, 6\n", 3 * 8 - 6),
        ("*COUPLING, REF NODE=50, SURFACE=S, CONSTRAINT NAME=C\n*KINEMATIC\n", 3 * 8 - 6),
    ] {
        assert_eq!(found(&text(more)).mesh.tie_rows().len(), equations, "{more}");
    }
    for more in ["*TIE, NAME=T\nS, OTHER\n", "*EMBEDDED ELEMENT\nA\n"] {
        let errors = refused(&text(more));
        assert_eq!(errors.len(), 1, "{more}: {errors:?}");
    }
    let read = found(&text(
        "*COUPLING, REF NODE=50, SURFACE=S, CONSTRAINT NAME=C\n*KINEMATIC\n*EQUATION\n2\n1,1,1.,1,1,-1.\n",
    ));
    assert_eq!(labels(&read.mesh, "S"), [1, 2, 3, 4, 5, 6, 7, 8]);
    assert!(warned(&read).iter().any(|what| what.starts_with("*EQUATION is left out")));
}

#[test]
fn byte_order_marks_are_read_and_other_formats_are_named() {
    let text = format!("\u{feff}{NODES}*INCLUDE, INPUT=cells.inp\n");
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    let cells = format!("\u{feff}*ELEMENT, TYPE=C3D8I\n{CELLS}");
    fs::write(path("cells.inp"), cells).unwrap();
    let read = open(text.as_bytes(), &path("bar.inp")).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(read.mesh.cell_count(), 2);
    fs::write(path("cells.inp"), b"\x1f\x8b\x08\0").unwrap();
    let errors = open(text.as_bytes(), &path("bar.inp")).map(|_| ()).unwrap_err();
    assert_eq!(errors.0.len(), 1);
    assert!(
        errors.0[0].what.ends_with("cells.inp` is compressed by gzip, which is not read"),
        "{errors}"
    );
    let utf16: Vec<u8> =
        [0xff, 0xfe].into_iter().chain(NODES.bytes().flat_map(|byte| [byte, 0])).collect();
    let errors = open(&utf16, "bar.inp").map(|_| ()).unwrap_err().to_string();
    assert!(errors.starts_with("bar.inp: this is text in UTF-16, which is not read"), "{errors}");
    let errors = open(b"\x89HDF\r\n\x1a\n", "part.med").map(|_| ()).unwrap_err().to_string();
    assert!(errors.contains("`gmsh part.med -save -format msh41 -o part.msh`"), "{errors}");
    let bulk = "\u{feff}$ part\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\nCTETRA,1,1,1,2,3,4\n";
    let read = open(bulk.as_bytes(), "a.bdf").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(read.mesh.cell_count(), 1);
}
