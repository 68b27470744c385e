//! Input files as Abaqus/CAE writes them: parts, instances and an assembly with names, nodes and sets of its own.

use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::ReadMesh;

use crate::open;

const NODES: &str = "*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n";
const CELLS: &str = "*Element, type=C3D8I\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";
const INSTANCE: &str = "*Instance, name=P-1, part=P\n0., 0., 2.\n*End Instance\n";
const POINT: &str =
    "*Part, name=RP\n*Node\n1, 0., 0., 5.\n*Nset, nset=RefPt_, internal\n1, \n*End Part\n";

fn part() -> String {
    format!(
        "*Part, name=P\n{NODES}{CELLS}*Nset, nset=Set-1, generate\n1, 8, 1\n*Elset, elset=Set-1\n1,\n\
         *Solid Section, elset=Set-1, material=STEEL\n,\n*End Part\n"
    )
}

fn deck(parts: &str, assembly: &str) -> String {
    let material = "*Material, name=STEEL\n*Density\n7850.,\n*Elastic\n2.1e11, 0.3\n";
    format!("*Heading\n{parts}*Assembly, name=Assembly\n{assembly}*End Assembly\n{material}")
}

fn read(parts: &str, assembly: &str) -> ReadMesh {
    let text = deck(parts, assembly);
    open(text.as_bytes(), "a.inp").unwrap_or_else(|errors| panic!("{errors}"))
}

fn refused(parts: &str, assembly: &str) -> String {
    open(deck(parts, assembly).as_bytes(), "a.inp").map(drop).unwrap_err().to_string()
}

fn labels(mesh: &Mesh, set: &str) -> Vec<u64> {
    let nodes = mesh.node_set(set).unwrap_or_else(|error| panic!("{error}")).iter();
    let mut labels: Vec<u64> = nodes.map(|&node| mesh.labels()[node]).collect();
    labels.sort_unstable();
    labels
}

#[test]
fn names_may_have_the_instance_before_a_point() {
    let sets = "*Nset, nset=A\nP-1.Set-1,\n*Nset, nset=B\np-1.3, P-1.4\n*Elset, elset=E\nP-1.1\n\
                *Surface, type=ELEMENT, name=S\nP-1.Set-1, S2\n*Surface, name=L\nP-1.1, S1\n\
                *Surface, type=NODE, name=N\nP-1.Set-1\n*Surface, type=NODE, name=M\nP-1.7\n\
                *Nset, nset=OF, elset=P-1.Set-1\n*Equation\n2\nP-1.1, 1, 1., P-1.2, 1, -1.\n";
    let ReadMesh { mesh, warnings, .. } = read(&part(), &format!("{INSTANCE}{sets}"));
    assert_eq!(warnings, []);
    let all: Vec<u64> = (1..9).collect();
    for (set, known) in [
        ("A", &all[..]),
        ("B", &[3, 4]),
        ("S", &[5, 6, 7, 8]),
        ("L", &[1, 2, 3, 4]),
        ("N", &all),
        ("M", &[7]),
        ("OF", &all),
    ] {
        assert_eq!(labels(&mesh, set), known, "{set}");
    }
    assert_eq!(mesh.element_sets()["E"].len(), 1);
    assert_eq!((mesh.ties().len(), mesh.nodes()[0]), (1, [0.0, 0.0, 2.0]));
    let found = refused(&part(), &format!("{INSTANCE}*Nset, nset=A\nP-2.Set-1\n"));
    assert!(
        found.contains("a.inp:26:1: no instance is called P-2\n  help: did you mean P-1?"),
        "{found}"
    );
    let found = refused(&part(), &format!("{INSTANCE}*Nset, nset=A, instance=Q\n1\n"));
    assert!(found.contains("a.inp:25:25: no instance is called Q\n  help: "), "{found}");
    let found = refused(&part(), &format!("{INSTANCE}*Nset, nset=A\nP-1.Set-7\n"));
    assert!(found.contains("a.inp:26:1: no set of nodes called Set-7 stands above"), "{found}");
}

#[test]
fn a_set_of_the_assembly_is_not_mixed_with_one_of_the_part() {
    let sets = "*Nset, nset=Set-1, instance=P-1\n5, 6\n*Elset, elset=Set-1, instance=P-1\n1\n\
                *Nset, nset=U\nP-1.Set-1\n*Nset, nset=V\nSet-1\n";
    let ReadMesh { mesh, warnings, .. } = read(&part(), &format!("{INSTANCE}{sets}"));
    assert_eq!(warnings, []);
    let all: Vec<u64> = (1..9).collect();
    assert_eq!([labels(&mesh, "Set-1"), labels(&mesh, "V")], [[5, 6], [5, 6]]);
    assert_eq!([labels(&mesh, "P-1.Set-1"), labels(&mesh, "U")], [&all[..], &all]);
    // The section of the part is that of its own set.
    assert_eq!(mesh.materials()[0].name, "STEEL");
    assert_eq!(mesh.element_sets().keys().collect::<Vec<_>>(), ["P-1.Set-1", "Set-1"]);
}

#[test]
fn parts_without_solids_or_without_an_instance_are_left_out() {
    let empty = "*Part, name=Q\n*End Part\n";
    let of_empty = "*Instance, name=Q-1, part=Q\n*End Instance\n";
    let of_point = "*Instance, name=RP-1, part=RP\n*End Instance\n";
    let aside = part().replace("name=P\n", "name=Q\n");
    for (parts, instances, warned) in [
        (format!("{}{empty}", part()), INSTANCE.to_owned(), 0),
        (format!("{empty}{}", part()), format!("{of_empty}{INSTANCE}"), 0),
        (format!("{POINT}{}", part()), format!("{of_point}{INSTANCE}"), 0),
        (format!("{}{aside}", part()), INSTANCE.to_owned(), 1),
    ] {
        let ReadMesh { mesh, warnings, .. } = read(&parts, &instances);
        assert_eq!((mesh.nodes().len(), mesh.cell_count()), (8, 1));
        assert_eq!(mesh.nodes()[0], [0.0, 0.0, 2.0]);
        assert_eq!(warnings.len(), warned, "{warnings:?}");
        let what = "the part Q has no *INSTANCE, and is left out";
        assert!(warnings.iter().all(|own| own.what == what && own.line == 21), "{warnings:?}");
    }
    // The mesh of an independent instance stands in the instance.
    let own = format!(
        "*Instance, name=P-1, part=Q\n0, 0, 3\n{NODES}{CELLS}*Nset, nset=I\n1\n*End Instance\n"
    );
    let mesh = read(empty, &format!("{own}*Nset, nset=J, instance=P-1\n2\n")).mesh;
    assert_eq!([labels(&mesh, "I"), labels(&mesh, "J")], [[1], [2]]);
    assert_eq!(mesh.nodes()[0], [0.0, 0.0, 3.0]);
    let two = format!("{INSTANCE}{}", INSTANCE.replace("P-1", "P-2"));
    assert!(refused(&part(), &two).contains("a.inp:25:1: a second *INSTANCE is not read: both"));
    let wrong = INSTANCE.replace("part=P", "part=PP");
    assert!(refused(&part(), &wrong).contains("no part is called PP\n  help: did you mean P?"));
}

/// Nodes of the assembly and of parts that are points have labels of their own.
#[test]
fn reference_points_may_have_the_label_of_a_node_of_the_part() {
    let coupled = |point: &str| {
        format!(
            "*Surface, type=ELEMENT, name=TOP\nP-1.Set-1, S2\n*Coupling, constraint name=C, ref node={point}, surface=TOP\n*Kinematic\n"
        )
    };
    let of_point = "*Instance, name=RP-1, part=RP\n0, 0, 1\n*End Instance\n";
    let node = "*Node\n1, 0., 0., 6.\n*Nset, nset=m_Set-3\n1,\n";
    let mut all = Vec::new();
    for (parts, start, point) in [
        (part() + POINT, format!("{INSTANCE}{of_point}"), "RP-1.1"),
        (part() + POINT, format!("{of_point}{INSTANCE}"), "RP-1.RefPt_"),
        (part(), format!("{INSTANCE}{node}"), "m_Set-3"),
        (part(), format!("{INSTANCE}{node}"), "1"),
    ] {
        let ReadMesh { mesh, warnings, .. } = read(&parts, &format!("{start}{}", coupled(point)));
        assert_eq!(warnings, [], "{point}");
        assert_eq!((mesh.nodes().len(), mesh.ties().len()), (8, 1), "{point}");
        all.push(format!("{:?}", mesh.ties()[0].rows));
    }
    assert!(all.iter().all(|rows| *rows == all[0]), "{all:#?}");
}

#[test]
fn names_may_stand_between_quotation_marks() {
    let part = part().replace("name=P\n", "name=\"P one\"\n").replace("Set-1", "\"Set one\"");
    let assembly = "*Instance, name=\"P 1\", part=\"P one\"\n*End Instance\n*Nset, nset=\"A B\"\n\"P 1\".\"Set one\"\n\
                    *Nset, nset=C\n\"A B\"\n*Surface, type=NODE, name=\"S S\"\n\"A B\"\n\
                    *Surface, name=L\n\"P 1\".\"Set one\", S1\n";
    let mesh = read(&part, assembly).mesh;
    for set in ["A B", "C", "S S", "Set one"] {
        assert_eq!(labels(&mesh, set).len(), 8, "{set}");
    }
    assert_eq!(labels(&mesh, "L"), [1, 2, 3, 4]);
}

/// As in Abaqus: faces that no other cell has, not those between a set and the rest.
#[test]
fn a_surface_of_cells_without_a_face_has_the_outer_ones() {
    let more = "9, 0, 0, 2\n10, 1, 0, 2\n11, 1, 1, 2\n12, 0, 1, 2\n";
    let cells = "*Element, type=C3D8I, elset=A\n1, 1, 2, 3, 4, 5, 6, 7, 8\n*Element, type=C3D8I, elset=B\n\
                 2, 5, 6, 7, 8, 9, 10, 11, 12\n*Element, type=C3D8I, elset=C\n3, 9, 10, 11, 12, 13, 14, 15, 16\n";
    let last = "13, 0, 0, 3\n14, 1, 0, 3\n15, 1, 1, 3\n16, 0, 1, 3\n";
    let tied = "*Nset, nset=N\n1\n*Tie, name=T\nN, SB\n";
    let text = format!(
        "{NODES}{more}{last}{cells}*Surface, name=SA\nA\n*Surface, name=SB\n2,\n*Surface, name=ALL\n,\n{tied}"
    );
    let ReadMesh { mesh, warnings, .. } =
        open(text.as_bytes(), "a.inp").unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(labels(&mesh, "SA"), (1..9).collect::<Vec<_>>());
    assert_eq!(labels(&mesh, "SB"), (5..13).collect::<Vec<_>>());
    assert_eq!(labels(&mesh, "ALL").len(), 16);
    // Node 1 is 1 m below the sides of cell 2, and would be on its lower face.
    assert!(warnings.iter().any(|own| own.what.contains("1 node of N is farther")), "{warnings:?}");
}

#[test]
fn lines_go_on_and_orders_of_sets_do_not_count() {
    let text = format!(
        "{}*Element, type = C3D8I,\n elset=A\n1, 1, 2, 3, 4,\n 5, 6, 7, 8\n*Nset, nset=X,\n unsorted\n1, 2,\n3,\n\n\
         *Nset , nset = Y , Unsorted\n4,5\n*Elset, elset=E, generate, internal\n1, 1\n",
        NODES.replace("*Node", "*Node,\n nset=ALL")
    );
    let mesh = open(text.as_bytes(), "a.inp").unwrap_or_else(|errors| panic!("{errors}")).mesh;
    assert_eq!(labels(&mesh, "X"), [1, 2, 3]);
    assert_eq!(labels(&mesh, "Y"), [4, 5]);
    assert_eq!((labels(&mesh, "ALL").len(), mesh.element_sets()["E"].len()), (8, 1));
}

/// A rigid part has surfaces and sets that cards of the assembly name, and says nothing of the solids.
#[test]
fn rigid_parts_are_left_out_with_what_stands_on_them() {
    let rigid = "*Part, name=R\n*Node\n1, 0, 0, 9\n2, 1, 0, 9\n3, 1, 1, 9\n4, 0, 1, 9\n9, 0, 0, 8\n\
                 *Element, type=R3D4\n1, 1, 2,\n3, 4\n*Nset, nset=RefPt_\n9,\n*Elset, elset=All\n1\n*End Part\n";
    let instance = "*Instance, name=R-1, part=R\n*End Instance\n";
    let body = "*Rigid Body, ref node=R-1.RefPt_, elset=R-1.All\n";
    let analytical = "*Rigid Body, ref node=R-1.9, analytical surface=R-1.RigidSurface_\n";
    let surface = "*Surface, type=ELEMENT, name=T\nR-1.All, SPOS\n";
    for more in
        [String::new(), surface.to_owned(), format!("{surface}{body}"), analytical.to_owned()]
    {
        let ReadMesh { mesh, warnings, .. } =
            read(&(part() + rigid), &format!("{INSTANCE}{instance}{more}"));
        assert_eq!((mesh.nodes().len(), mesh.cell_count(), mesh.ties().len()), (8, 1, 0));
        assert_eq!(mesh.node_sets().keys().collect::<Vec<_>>(), ["Set-1"]);
        let warned: Vec<&str> = warnings.iter().map(|own| own.what.as_str()).collect();
        assert_eq!(warned[0], "left out, as only solid elements are read: 1 R3D4", "{warned:?}");
        assert!(
            warned.len() == 1 || warned[1].starts_with("*RIGID BODY is left out"),
            "{warned:?}"
        );
    }
}

/// Without nodes of its own an assembly can only mean those of the part.
#[test]
fn labels_of_an_assembly_without_nodes_are_of_the_part() {
    let mesh = read(&part(), &format!("{INSTANCE}*Nset, nset=A\n3, 4\n*Elset, elset=E\n1\n")).mesh;
    assert_eq!((labels(&mesh, "A"), mesh.element_sets()["E"].len()), (vec![3, 4], 1));
}
