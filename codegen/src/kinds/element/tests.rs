//! The shipped elements are proved; each proof fails where it should, and says where.

use std::collections::{BTreeMap, BTreeSet};

use super::demand;
use super::*;
use crate::element::Cell;
use crate::kinds::form::BasisPart;

const HEX8I: &str = include_str!("../../../../specs/elements/hex8i.toml");
const HEX8: &str = include_str!("../../../../specs/elements/hex8.toml");
const WEDGE6: &str = include_str!("../../../../specs/elements/wedge6.toml");

fn read(text: &str) -> Result<ElementSpec, Vec<String>> {
    let file = Source::new("e.toml", text);
    ElementSpec::read(&file).map_err(|errors| errors.iter().map(ToString::to_string).collect())
}

/// The errors of a shipped file in which `from` was replaced by `to`.
fn changed(text: &str, from: &str, to: &str) -> Vec<String> {
    assert!(text.contains(from), "{from}");
    read(&text.replace(from, to)).err().unwrap_or_default()
}

#[test]
fn shipped_elements_are_proved() {
    let hexahedron = read(HEX8I).unwrap();
    assert_eq!((hexahedron.nodes.len(), hexahedron.quadrature.points.len()), (8, 8));
    assert_eq!(hexahedron.enhanced_in("stiffness").unwrap().modes.len(), 3);
    assert!(hexahedron.enhanced_in("mass").is_none());
    assert_eq!(hexahedron.abaqus_order, (0..8).collect::<Vec<_>>());
    let wedge = read(WEDGE6).unwrap();
    assert_eq!((wedge.nodes.len(), wedge.quadrature.points.len()), (6, 6));
    assert_eq!(wedge.vtk_order, [0, 2, 1, 3, 5, 4]);
}

#[test]
fn shape_functions_that_do_not_interpolate_name_both_nodes() {
    let found = changed(HEX8I, "(1 + xi_a*xi)", "(1 - xi_a*xi)");
    assert_eq!(found.len(), 8);
    assert_eq!(
        found[0],
        "e.toml:12:10: the shape function of node 1 is 0 at node 1 (-1, -1, -1), not 1 (a shape function is 1 at its own node and 0 at all others)"
    );
    let found = changed(WEDGE6, "'eta*(1 - zeta)/2'", "'eta*(1 - zeta)'");
    assert_eq!(
        found,
        [
            "e.toml:13:54: the shape function of node 3 is 2 at node 3 (0, 1, -1), not 1 (a shape function is 1 at its own node and 0 at all others)"
        ]
    );
}

#[test]
fn every_wrong_formula_is_reported_even_where_the_cell_is_wrong() {
    let wrong = WEDGE6.replace("'eta*(1 - zeta)/2'", "'ete*(1 - zeta)/2'");
    let wrong = wrong.replace("'eta*(1 + zeta)/2'", "'eta*(1 + zete)/2'");
    let names = ["unknown name `ete`", "unknown name `zete`"];
    let reported = |found: &[String]| names.map(|name| found.iter().any(|own| own.contains(name)));
    let found = read(&wrong).err().unwrap_or_default();
    assert_eq!((found.len(), reported(&found)), (2, [true; 2]), "{found:?}");
    let found = changed(&wrong, "cell = \"wedge\"", "cell = \"wege\"");
    assert_eq!((found.len(), reported(&found)), (3, [true; 2]), "{found:?}");
    assert!(found.iter().any(|own| own.contains("did you mean `wedge`?")), "{found:?}");
    // A formula for all nodes is one mistake, not one a node.
    assert_eq!(changed(HEX8I, "xi_a*xi)", "xi_a*xy)").len(), 1);
}

#[test]
fn shape_functions_that_are_not_complete_say_what_they_sum_to() {
    // Vanishes at every node, so that only the sum shows it.
    let found = changed(WEDGE6, "'xi*(1 - zeta)/2'", "'xi*(1 - zeta)/2 + xi*eta'");
    assert_eq!(found.len(), 3, "{found:?}");
    assert!(
        found[0].contains("sum to 1 + xi*eta, not to 1 (10/9 at the centre (1/3, 1/3, 0))"),
        "{found:?}"
    );
}

#[test]
fn a_rule_without_its_degree_names_the_monomial() {
    assert_eq!(
        changed(WEDGE6, "degree = 2", "degree = 3"),
        ["e.toml:18:8: the rule gives 11/108 for the integral of xi^3 over the wedge, not 1/10 \
          (take more points, or declare `degree = 2`)"]
    );
    let points = "points = [[0, 0, 0, 6], ['1/2', 0, 0, 1]]";
    let found = changed(HEX8I, "rule = [\"gauss(2)\", \"gauss(2)\", \"gauss(2)\"]", points);
    assert_eq!(
        found,
        ["e.toml:15:10: the rule gives 7 for the integral of 1 over the hexahedron, not 8 (the \
          weights must sum to the volume of the reference cell)"]
    );
    let found = changed(WEDGE6, "\"triangle(3)\", \"gauss(2)\"", "\"gauss(2)\", \"gauss(2)\"");
    assert_eq!(
        found,
        [
            "e.toml:18:8: this is no rule of a wedge (write `rule = [\"triangle(…)\", \"gauss(…)\"]`, with numbers of points between the brackets)"
        ]
    );
    let found = changed(WEDGE6, "triangle(3)", "triangle(4)");
    assert!(found[0].contains("there is no rule `triangle(4)` (did you mean"), "{found:?}");
}

#[test]
fn modes_without_their_correction_fail_the_patch_test() {
    for (from, to, at) in [
        ("jacobian = \"centre\"", "jacobian = \"point\"", "e.toml:25:10"),
        ("scale = 'det0/det'\n", "", "e.toml:19:1"),
        ("'1 - zeta^2'", "'zeta - zeta^2'", "e.toml:25:10"),
    ] {
        let found = changed(HEX8I, from, to);
        let all = if to.contains("zeta") { 1 } else { 3 };
        assert_eq!(found.len(), all, "{found:?}");
        assert!(found[0].starts_with(at), "{found:?}");
        assert!(found[0].contains("does not integrate to zero"), "{found:?}");
    }
}

#[test]
fn slips_of_the_pen_are_named() {
    for (from, to, expected) in [
        ("xi_a*xi", "xi_b*xi", "unknown name `xi_b`"),
        ("\"hexahedron\"", "\"hexaedron\"", "did you mean `hexahedron`?"),
        ("[1, 1, -1]", "[1, 1, -2]", "node 3 at (1, 1, -2) lies outside the hexahedron"),
        ("[1, 1, -1]", "[1, -1, -1]", "node 3 is where node 2 is"),
        ("[1, 1, -1]", "[1, 1]", "expected three coordinates"),
        ("type = 12", "type = 1200", "a VTK cell type is below 256"),
        ("type = 12", "type = 12\norder = [1, 2]", "must name every node from 1 to 8 once"),
        ("degree = 3", "degree = 300", "a degree is at most 12"),
        ("modes = ", "mods = ", "did you mean `modes`?"),
        ("jacobian = \"centre\"", "jacobian = \"center\"", "did you mean `centre`?"),
    ] {
        let found = changed(HEX8I, from, to);
        assert!(found.iter().any(|error| error.contains(expected)), "{expected}: {found:?}");
    }
}

#[test]
fn rational_shape_functions_are_proved() {
    let pyramid = "\
kind = \"element\"
name = \"pyramid5\"
title = \"t\"
source = \"s\"
cell = \"pyramid\"
nodes = [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0], [0, 0, 1]]
shape = [
  '(1 - xi - zeta)*(1 - eta - zeta)/(4*(1 - zeta))',
  '(1 + xi - zeta)*(1 - eta - zeta)/(4*(1 - zeta))',
  '(1 + xi - zeta)*(1 + eta - zeta)/(4*(1 - zeta))',
  '(1 - xi - zeta)*(1 + eta - zeta)/(4*(1 - zeta))',
  'zeta',
]
[quadrature]
points = [[0, 0, '1/4', '4/3']]
degree = 1
[abaqus]
types = [\"C3D5\"]
[vtk]
type = 14
";
    let element = read(pyramid).unwrap();
    assert_eq!(element.quadrature.points.len(), 1);
    let found =
        changed(pyramid, "'(1 + xi - zeta)*(1 + eta - zeta)", "'(1 + xi - zeta)*(1 - zeta)");
    assert!(found[0].contains("the shape function of node 3 is 1/2 at node 2"), "{found:?}");
}

/// A file with one formula a node.
fn file(cell: &str, nodes: &[[&str; 3]], shape: &[String], quadrature: &str) -> String {
    let nodes: Vec<String> =
        nodes.iter().map(|[x, y, z]| format!("['{x}', '{y}', '{z}']")).collect();
    let shape: Vec<String> = shape.iter().map(|formula| format!("'{formula}'")).collect();
    format!(
        "kind = \"element\"\nname = \"e\"\ntitle = \"t\"\nsource = \"s\"\ncell = \"{cell}\"\n\
         nodes = [{}]\nshape = [{}]\n[quadrature]\n{quadrature}\n[abaqus]\ntypes = [\"E\"]\n\
         [vtk]\ntype = 1\n",
        nodes.join(", "),
        shape.join(", ")
    )
}

#[test]
fn quadratic_elements_are_proved() {
    // Serendipity hexahedron: a mid-edge node has one coordinate zero.
    let mut nodes = Vec::new();
    for zeros in [0, 1] {
        for z in ["-1", "0", "1"] {
            for y in ["-1", "0", "1"] {
                for x in ["-1", "0", "1"] {
                    let node = [x, y, z];
                    let here = node.iter().filter(|c| **c == "0").count();
                    nodes.extend((here == zeros).then_some(node));
                }
            }
        }
    }
    assert_eq!(nodes.len(), 20);
    let axes = ["xi", "eta", "zeta"];
    let shape: Vec<String> = (nodes.iter())
        .map(|node| {
            let factor = |(c, axis): (&&str, &str)| match *c {
                "0" => format!("(1 - {axis}^2)"),
                _ => format!("(1 + {axis}_a*{axis})"),
            };
            let factors: Vec<String> = node.iter().zip(axes).map(factor).collect();
            match node.contains(&"0") {
                true => format!("{}/4", factors.join("*")),
                false => {
                    let rest = "(xi_a*xi + eta_a*eta + zeta_a*zeta - 2)";
                    format!("{}*{rest}/8", factors.join("*"))
                }
            }
        })
        .collect();
    let gauss = "rule = [\"gauss(3)\", \"gauss(3)\", \"gauss(3)\"]\ndegree = 5";
    let hexahedron = file("hexahedron", &nodes, &shape, gauss);
    assert_eq!(read(&hexahedron).unwrap().nodes.len(), 20);
    let found = changed(&hexahedron, "zeta_a*zeta - 2)", "zeta_a*zeta - 1)");
    assert_eq!(found.len(), 8, "{found:?}");

    // Tetrahedron with mid-edge nodes, in the order of Abaqus.
    let corners = [["0", "0", "0"], ["1", "0", "0"], ["0", "1", "0"], ["0", "0", "1"]];
    let l = ["(1 - xi - eta - zeta)", "xi", "eta", "zeta"];
    let mut nodes = corners.to_vec();
    let mut shape: Vec<String> = l.iter().map(|l| format!("{l}*(2*{l} - 1)")).collect();
    let half = |a: &str, b: &str| match (a, b) {
        ("0", "0") => "0",
        ("1", "1") => "1",
        _ => "1/2",
    };
    for (a, b) in [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)] {
        nodes.push(std::array::from_fn(|i| half(corners[a][i], corners[b][i])));
        shape.push(format!("4*{}*{}", l[a], l[b]));
    }
    let rule = "rule = [\"tetrahedron(4)\"]\ndegree = 2";
    assert_eq!(read(&file("tetrahedron", &nodes, &shape, rule)).unwrap().nodes.len(), 10);
}

/// Names and texts of the shipped files.
fn shipped() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../specs/elements");
    let entries = std::fs::read_dir(folder).expect("the shipped elements");
    let mut files: Vec<(String, String)> = entries
        .map(|entry| {
            let path = entry.expect("an entry").path();
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            (name, std::fs::read_to_string(path).expect("a text"))
        })
        .collect();
    files.sort();
    assert!(files.len() >= 8, "{}", files.len());
    files
}

/// What gradients and functions of an element ask of its rules.
fn demanded(text: &str) -> Result<(), Vec<String>> {
    let element = read(text)?;
    let forms = [("stiffness", BasisPart::Gradient), ("mass", BasisPart::Value)];
    demand::prove(&element, forms.map(|(form, part)| (form, BTreeSet::from([(part, part)]))))
        .map_err(|errors| errors.iter().map(ToString::to_string).collect())
}

#[test]
fn every_shipped_element_is_proved_with_its_rules() {
    for (name, text) in shipped() {
        assert_eq!(demanded(&text), Ok(()), "{name}");
    }
}

/// A function that vanishes at every node of any shipped element of the cell.
fn bubble(cell: Cell) -> &'static str {
    match cell {
        Cell::Hexahedron => "(1 - xi^2)*(1 - eta^2)*(1 - zeta^2)",
        Cell::Wedge => "xi*eta*(1 - xi - eta)*(1 - zeta^2)",
        Cell::Tetrahedron => "xi*eta*zeta*(1 - xi - eta - zeta)",
        Cell::Pyramid => "zeta*(1 - zeta)^3",
    }
}

#[test]
fn a_slip_in_any_shape_function_names_its_node() {
    for (name, text) in shipped() {
        let element = read(&text).unwrap();
        for (place, function) in element.shape.iter().enumerate() {
            let node = place + 1;
            let formula = function.text.text();
            let quoted = format!("'{formula}'");
            if text.matches(&quoted).count() != 1 || text.contains("xi_a") {
                continue;
            }
            let slipped = |term: &str| changed(&text, &quoted, &format!("'{formula} + {term}'"));
            let found = slipped("1/1000");
            let expected = format!("the shape function of node {node} is ");
            assert!(found.len() == 1 && found[0].contains(&expected), "{name}: {found:?}");
            let found = slipped(&format!("{}/1000", bubble(element.cell)));
            let expected = format!(" at node {node})");
            assert!(found.iter().all(|error| error.ends_with(&expected)), "{name}: {found:?}");
            assert!(found[0].contains("the shape functions sum to "), "{name}: {found:?}");
        }
    }
}

#[test]
fn completeness_is_what_the_file_claims() {
    for (name, text) in shipped() {
        let quadratic = matches!(name.as_str(), "hex20" | "wedge15" | "tet10");
        assert_eq!(read(&text).unwrap().complete, if quadratic { 2 } else { 1 }, "{name}");
        let (from, degree) = match quadratic {
            true => ("complete = 2", 3),
            false => ("\n[quadrature]\n", 2),
        };
        let claim = format!("\ncomplete = {degree}\n");
        let to = if quadratic { claim } else { claim + from };
        let found = changed(&text, from, &to);
        let expected = "the shape functions times ";
        assert!(found.iter().all(|error| error.contains(expected)), "{name}: {found:?}");
        assert!(!found.is_empty(), "{name}");
    }
}

#[test]
fn rules_that_fall_short_of_a_form_name_the_nodes() {
    let files: BTreeMap<String, String> = shipped().into_iter().collect();
    let refused = |name: &str, from: &str, to: &str| -> String {
        let text = &files[name];
        assert!(text.contains(from), "{name}: {from}");
        match demanded(&text.replace(from, to)) {
            Ok(()) => "fine".to_owned(),
            Err(errors) => errors.join("\n"),
        }
    };
    let three = "\"gauss(3)\", \"gauss(3)\", \"gauss(3)\"]\ndegree = 5";
    let two = "\"gauss(2)\", \"gauss(2)\", \"gauss(2)\"]\ndegree = 3";
    let found = refused("hex20", three, two);
    assert!(
        found.contains("which occurs in `stiffness` in the product of the gradient of node "),
        "{found}"
    );
    assert!(found.contains("write `reduced = true`"), "{found}");
    let found = refused("hex20", three, &format!("{two}\nreduced = true"));
    assert!(found.contains("in the determinant of the gradients of node "), "{found}");
    assert!(found.contains("a patch of distorted cells fails under constant strain"), "{found}");
    let affine = format!("{two}\nreduced = true\npatch_test = \"affine\"");
    assert_eq!(refused("hex20", three, &affine), "fine");
    let found = refused("tet10", "patch_test = \"affine\"\n", "");
    assert!(found.contains("in the determinant of the gradients of node "), "{found}");
    let found = refused("pyramid5", "\"pyramid(4)\"", "\"pyramid(1)\"");
    assert!(found.contains("for the integral of "), "{found}");
}

#[test]
fn what_is_no_polynomial_is_no_shape_function() {
    let found = changed(HEX8I, "(1 + xi_a*xi)", "(1 + xi_a*sin(pi*xi/2))");
    assert_eq!(found.len(), 1);
    assert!(found[0].contains("expected a polynomial in xi, eta and zeta"), "{found:?}");
    let found = changed(WEDGE6, "degree = 2", "degree = 2\npatch_tst = \"any\"");
    assert!(found[0].contains("did you mean `patch_test`?"), "{found:?}");
}

#[test]
fn elements_that_differ_in_their_modes_integrate_the_other_forms_alike() {
    let [plain, enhanced, wedge] = [HEX8, HEX8I, WEDGE6].map(|text| read(text).unwrap());
    assert!(enhanced.integrates_as(&plain, "mass") && plain.integrates_as(&enhanced, "mass"));
    assert!(!enhanced.integrates_as(&plain, "stiffness"));
    assert!(!plain.integrates_as(&enhanced, "stiffness"));
    assert!(!wedge.integrates_as(&plain, "mass"));
    // The same functions at other points are other sums.
    let points = ["gauss(2)\", \"gauss(2)\", \"gauss(2)", "gauss(3)\", \"gauss(3)\", \"gauss(3)"];
    assert!(HEX8.contains(points[0]));
    let finer = read(&HEX8.replace(points[0], points[1])).unwrap();
    assert!(!finer.integrates_as(&plain, "mass") && finer.integrates_as(&finer, "mass"));
}
