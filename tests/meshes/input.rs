//! Input files of Abaqus and CalculiX: files that are included, surfaces, parts and instances, units.

use std::fs;

use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{MeshUnits, ReadOptions, read};

use crate::{elements, open};

const NODES: &str = "*NODE
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
";
const CELLS: &str = "*ELEMENT, TYPE=C3D8I, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

fn cube(more: &str) -> Mesh {
    let text = format!("{NODES}{CELLS}{more}");
    open(text.as_bytes(), "cube.inp").unwrap_or_else(|errors| panic!("{errors}")).mesh
}

fn refused(text: &str, path: &str) -> String {
    open(text.as_bytes(), path).map(|_| ()).unwrap_err().to_string()
}

fn labels(mesh: &Mesh, set: &str) -> Vec<u64> {
    let mut labels: Vec<u64> =
        mesh.node_set(set).unwrap().iter().map(|&node| mesh.labels()[node]).collect();
    labels.sort_unstable();
    labels
}

#[test]
fn surfaces_are_node_sets() {
    let mesh = cube(
        "*SURFACE, NAME=Low\nALL, S1\n*SURFACE, NAME=SIDES, TYPE=ELEMENT\n1, S3\nall, s6\n\
         *SURFACE, TYPE=NODE, NAME=TIPS\n5\n7, 1.0\n",
    );
    assert_eq!(labels(&mesh, "LOW"), [1, 2, 3, 4]);
    assert_eq!(labels(&mesh, "SIDES"), [1, 2, 4, 5, 6, 8]);
    assert_eq!(labels(&mesh, "TIPS"), [5, 7]);
    for (number, known) in [
        (2, [5, 6, 7, 8]),
        (3, [1, 2, 5, 6]),
        (4, [2, 3, 6, 7]),
        (5, [3, 4, 7, 8]),
        (6, [1, 4, 5, 8]),
    ] {
        assert_eq!(labels(&cube(&format!("*SURFACE, NAME=A\n1, S{number}\n")), "A"), known);
    }
}

#[test]
fn faces_of_quadratic_tetrahedra_have_their_middle_nodes() {
    let text = "*NODE\n1,0,0,0\n2,2,0,0\n3,0,2,0\n4,0,0,2\n5,1,0,0\n6,1,1,0\n7,0,1,0\n8,0,0,1\n9,1,0,1\n\
                10,0,1,1\n*ELEMENT, TYPE=C3D10, ELSET=ALL\n1,1,2,3,4,5,6,7,8,9,10\n";
    for (number, known) in [
        (1, [1, 2, 3, 5, 6, 7]),
        (2, [1, 2, 4, 5, 8, 9]),
        (3, [2, 3, 4, 6, 9, 10]),
        (4, [1, 3, 4, 7, 8, 10]),
    ] {
        let text = format!("{text}*SURFACE, NAME=A\nALL, S{number}\n");
        let mesh = open(text.as_bytes(), "t.inp").unwrap_or_else(|errors| panic!("{errors}")).mesh;
        assert_eq!(labels(&mesh, "A"), known);
    }
}

#[test]
fn surfaces_that_are_wrong_are_refused() {
    for (card, what) in [
        (
            "*SURFACE, NAME=A\nAL, S1\n",
            "cube.inp:13:1: no cell and no set of cells is called AL\n  help: did you mean ALL?",
        ),
        (
            "*SURFACE, NAME=A\nALL, S7\n",
            "cube.inp:13:6: hex8i has no face S7\n  help: its faces are S1 to S6",
        ),
        (
            "*SURFACE, NAME=A\nALL, TOP\n",
            "cube.inp:13:6: a face of cells is S1, S2, …, found `TOP`\n  help: write its number",
        ),
        ("*SURFACE, NAME=A, TYPE=NODE\n12\n", "cube.inp:13:1: node 12 is not defined"),
        ("*SURFACE, TYPE=NODE\n1\n", "cube.inp:12:1: *SURFACE needs NAME="),
    ] {
        let found = refused(&format!("{NODES}{CELLS}{card}"), "cube.inp");
        assert!(found.starts_with(what), "{found}");
    }
}

#[test]
fn an_instance_is_moved_and_turned() {
    let text = format!(
        "*PART, NAME=P\n{NODES}{CELLS}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n0, 0, 5\n\
         1, 0, 0, 1, 0, 9, 90\n*END INSTANCE\n*NSET, NSET=TIP, INSTANCE=P-1\n3\n*END ASSEMBLY\n"
    );
    let read = open(text.as_bytes(), "part.inp").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(read.warnings, []);
    let found = read.mesh.nodes()[2];
    // (1, 1, 5), turned by 90° about the line x = 1, y = 0.
    for (found, known) in found.iter().zip([0.0, 0.0, 5.0]) {
        assert!((found - known).abs() < 1e-15, "{found} {known}");
    }
    assert_eq!(labels(&read.mesh, "TIP"), [3]);
    // Labels of the assembly's own nodes are not those of the part.
    let points = "*NODE\n1, 9, 9, 9\n*NSET, NSET=POINT\n1\n*ELEMENT, TYPE=MASS, ELSET=M\n1, 1\n*END ASSEMBLY";
    let read = open(text.replace("*END ASSEMBLY", points).as_bytes(), "part.inp");
    let read = read.unwrap_or_else(|errors| panic!("{errors}"));
    let warned: Vec<&str> = read.warnings.iter().map(|own| own.what.as_str()).collect();
    assert_eq!(warned, ["nodes of the assembly, and what stands on them, are left out"]);
    assert_eq!((read.mesh.nodes().len(), read.mesh.node_sets().len()), (8, 1));
    // Moved first, then turned: (3, 0, 5) about the same line.
    let aside = text.replace("0, 0, 5\n", "2, -1, 5\n");
    let read = open(aside.as_bytes(), "part.inp").unwrap_or_else(|errors| panic!("{errors}"));
    for (found, known) in read.mesh.nodes()[2].iter().zip([1.0, 2.0, 5.0]) {
        assert!((found - known).abs() < 1e-15, "{found} {known}");
    }
    let two = text.replace("*END ASSEMBLY", "*INSTANCE, NAME=P-2, PART=P\n*END ASSEMBLY");
    assert!(refused(&two, "part.inp").contains("a second *INSTANCE is not read"));
    let wrong = text.replace("0, 0, 5\n", "0, 5\n");
    assert!(refused(&wrong, "part.inp").contains("moved by other numbers"));
}

#[test]
fn files_are_included_and_their_errors_have_their_own_lines() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::create_dir(folder.path().join("parts")).unwrap();
    fs::write(path("parts/nodes.inp"), NODES.replace("*NODE\n", "** data\n")).unwrap();
    fs::write(path("parts/all.inp"), "*INCLUDE, INPUT=cells.inp\n*NSET, NSET=A\n1\n").unwrap();
    fs::write(path("parts/cells.inp"), CELLS).unwrap();
    let text = "*NODE, INPUT=parts/nodes.inp\n*INCLUDE,\nINPUT=\"parts/all.inp\"\n2\n";
    let mesh =
        open(text.as_bytes(), &path("m.inp")).unwrap_or_else(|errors| panic!("{errors}")).mesh;
    assert_eq!((mesh.nodes().len(), mesh.cell_count()), (8, 1));
    assert_eq!(labels(&mesh, "A"), [1, 2]);
    fs::write(path("parts/cells.inp"), CELLS.replace(", 8\n", ", 9\n")).unwrap();
    let found = refused(text, &path("m.inp"));
    let known =
        format!("{}:2:25: cell 1 has node 9, which is not defined", path("parts/cells.inp"));
    assert!(found.starts_with(&known), "{found}");
    fs::write(path("parts/cells.inp"), "*INCLUDE, INPUT=all.inp\n").unwrap();
    let found = refused(text, &path("m.inp"));
    assert!(
        found.contains("cells.inp:1:17: `") && found.contains("would include itself"),
        "{found}"
    );
    let found = refused("*INCLUDE, INPUT=none.inp\n", &path("m.inp"));
    assert!(found.contains("m.inp:1:17: there is no file `"), "{found}");
    assert!(
        refused("*INCLUDE, FILE=none.inp\n", "m.inp")
            .starts_with("m.inp:1:1: *INCLUDE names no file")
    );
    // A file that includes another twice, thirty times over, is not read for ever.
    for level in 0..30 {
        let twice = format!("*INCLUDE, INPUT=l{0}\n*INCLUDE, INPUT=l{0}\n", level + 1);
        fs::write(path(&format!("l{level}")), twice).unwrap();
    }
    fs::write(path("l30"), "** end\n").unwrap();
    let found = refused("*INCLUDE, INPUT=l0\n", &path("m.inp"));
    assert!(found.contains("more than 1000 files are included"), "{found}");
}

#[test]
fn units_scale_materials_and_others_are_guessed() {
    let section = "*MATERIAL, NAME=STEEL\n*ELASTIC\n206000, 0.3\n*DENSITY\n7.85e-9\n\
                   *SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n";
    let text = format!("{NODES}{CELLS}{section}");
    let elements = elements();
    let units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let options = ReadOptions { units, ..ReadOptions::new(&elements) };
    let found = read(text.clone().into_bytes(), "cube.inp", &options).unwrap();
    assert_eq!(found.warnings, []);
    let steel = &found.mesh.materials()[0].properties;
    assert!(
        (steel["E"] / 206e9 - 1.0).abs() < 1e-14 && (steel["rho"] / 7850.0 - 1.0).abs() < 1e-14
    );
    assert_eq!(found.mesh.nodes()[6], [1e-3, 1e-3, 1e-3]);
    let found = refused(&text, "cube.inp");
    assert!(found.contains("write `units = \"mm, N, t\"` beside `mesh` in the case"), "{found}");
    // Lengths in mm, and E in GPa: sound is plausible, the density is not.
    let odd = text.replace("206000, 0.3", "206e3, 0.3").replace("7.85e-9", "7.85e-3");
    let read = open(odd.as_bytes(), "cube.inp").unwrap();
    // No usual system has this.
    let said: Vec<&str> = read.warnings.iter().map(|own| own.what.as_str()).collect();
    assert!(said.len() == 1 && said[0].ends_with("which no solid has together"), "{said:?}");
    let inches = text.replace("206000, 0.3", "29.9e6, 0.3").replace("7.85e-9", "7.35e-4");
    assert!(refused(&inches, "cube.inp").contains("units = \"in, lbf, lbf*s^2/in\""));
    let large = NODES.replace("1, 0, 0\n", "300, 0, 0\n");
    let read = open(format!("{large}{CELLS}").as_bytes(), "cube.inp").unwrap();
    assert_eq!(read.warnings[0].what, "the mesh is 300 m long");
    assert!(read.warnings[0].help.contains("`units = \"mm, N, t\"`"));
}

#[test]
fn of_very_many_errors_the_first_are_listed() {
    let mut text = format!("{NODES}{CELLS}");
    (0..100_000)
        .for_each(|label| text += &format!("{}, 1, 2, 3, 4, 5, 6, 7, {}\n", label + 2, label + 9));
    let start = std::time::Instant::now();
    let errors = open(text.as_bytes(), "cube.inp").map(|_| ()).unwrap_err();
    assert_eq!(errors.0.len(), 101);
    assert_eq!(errors.0[100].what, "and 99900 more");
    assert!(start.elapsed() < std::time::Duration::from_secs(20), "{:?}", start.elapsed());
}

#[test]
fn what_is_no_label_and_what_is_far_away_has_a_place_and_a_remedy() {
    for (passage, by, known) in [
        (
            "2, 1, 0, 0",
            "two, 1, 0, 0",
            "cube.inp:3:1: label of a node must be a whole number from 1, found `two`\n  help: write a label such as `17`, or see",
        ),
        (
            "2, 1, 0, 0",
            "2 1 0 0",
            "cube.inp:3:1: label of a node must be a whole number from 1, found `2 1 0 0`\n  help: put commas",
        ),
        (
            "2, 1, 0, 0",
            ", 1, 0, 0",
            "cube.inp:3:1: label of a node must be a whole number from 1, found ``\n  help: write the label there",
        ),
        (
            "1, 1, 2, 3",
            "1, 1, 2.5, 3",
            "cube.inp:11:7: label of a node must be a whole number from 1, found `2.5`\n  help: write a label such as `17`, without",
        ),
        (
            "7, 1, 1, 1",
            "7, 1, 2e7, 1",
            "cube.inp:8:1: node 7 has y = 2e7 m, farther than 1000 km from the origin\n  help: correct the number, or write the units",
        ),
    ] {
        let text = format!("{NODES}{CELLS}");
        assert_eq!(text.matches(passage).count(), 1, "{passage}");
        let found = refused(&text.replace(passage, by), "cube.inp");
        assert!(found.contains(known), "{found}");
    }
}

#[test]
fn surfaces_are_made_of_others() {
    let mesh = cube(
        "*SURFACE, NAME=LOW\nALL, S1\n*SURFACE, NAME=HIGH\n1, S2\n*SURFACE, NAME=ENDS, COMBINE=UNION\nLOW, HIGH\n\
         *SURFACE, NAME=OUTER\nALL\n*SURFACE, NAME=ONE, COMBINE=INTERSECTION\nENDS, HIGH\n\
         *SURFACE, NAME=REST, COMBINE=DIFFERENCE\nENDS, LOW\n*SURFACE, TYPE=NODE, NAME=N\n5\n7\n\
         *SURFACE, TYPE=NODE, NAME=M\n5\n*SURFACE, TYPE=NODE, NAME=K, COMBINE=DIFFERENCE\nN, M\n",
    );
    assert_eq!(labels(&mesh, "ENDS"), (1..9).collect::<Vec<_>>());
    assert_eq!([labels(&mesh, "ONE"), labels(&mesh, "REST")], [[5, 6, 7, 8], [5, 6, 7, 8]]);
    assert_eq!(labels(&mesh, "K"), [7]);
    for (card, known) in [
        ("COMBINE=UNION\nLOWER", "no surface called LOWER stands above this line"),
        (
            "COMBINE=UNITE\n",
            "COMBINE of *SURFACE is UNION, INTERSECTION or DIFFERENCE, found UNITE",
        ),
        ("CROP\nA\n0, 0, 0, 1, 1, 1", "CROP of *SURFACE is not read"),
    ] {
        let errors = refused(&format!("{NODES}{CELLS}*SURFACE, NAME=A, {card}\n"), "cube.inp");
        assert!(errors.contains(known) && errors.matches("cube.inp").count() == 1, "{errors}");
    }
}

#[test]
fn lines_of_any_system_and_blanks_for_zero_are_read() {
    let text = format!("{NODES}{CELLS}").replace('\n', "\r");
    let read = open(text.as_bytes(), "cube.inp").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!((read.mesh.nodes().len(), read.mesh.cell_count()), (8, 1));
    let text = format!(
        "*PART, NAME=P\n{NODES}{CELLS}*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=P-1, PART=P\n 3., ,\n*END INSTANCE\n\
         *END ASSEMBLY\n"
    );
    let mesh = open(text.as_bytes(), "part.inp").unwrap_or_else(|errors| panic!("{errors}")).mesh;
    assert_eq!(mesh.nodes()[0], [3.0, 0.0, 0.0]);
    let text = text.replace("PART=P\n", "LIBRARY=old\n");
    assert!(
        refused(&text, "part.inp").contains("part.inp:15:22: an *INSTANCE of another analysis")
    );
}

#[test]
fn couplings_and_ties_as_other_programs_write_them_are_read() {
    let mesh = |more: &str| {
        cube(&format!(
            "*NODE, NSET=RP\n90, .5, .5, 9\n*SURFACE, NAME=T\nALL, S2\n*SURFACE, TYPE=NODE, NAME=V\n1\n2\n*NSET, NSET=TN\n1\n{more}"
        ))
    };
    let coupling =
        "*COUPLING, CONSTRAINT NAME=C, REF NODE=RP, SURFACE=T\n*DISTRIBUTING, WEIGHTING METHOD=";
    assert_eq!(mesh(&format!("{coupling}UNIFORM\n")).ties().len(), 0);
    let text = format!(
        "{NODES}90, .5, .5, 9\n{CELLS}*SURFACE, NAME=T\nALL, S2\n{}LINEAR\n",
        coupling.replace("RP", "90")
    );
    assert!(refused(&text, "cube.inp").contains("WEIGHTING METHOD of *DISTRIBUTING is not read"));
    let tied = mesh("*TIE, NAME=B, TIED NSET=TN\nV, T\n");
    // Three displacements of one node.
    assert_eq!(tied.ties()[0].rows.len(), 3);
}
