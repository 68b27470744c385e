//! The shipped elements are proved; each proof fails where it should, and says where.

use super::*;

const HEX8I: &str = include_str!("../../../../specs/elements/hex8i.toml");
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
        "e.toml:12:10: the shape function of node 1 is 0 at node 1 (-1, -1, -1), not 1"
    );
    let found = changed(WEDGE6, "'eta*(1 - zeta)/2'", "'eta*(1 - zeta)'");
    assert_eq!(
        found,
        ["e.toml:13:54: the shape function of node 3 is 2 at node 3 (0, 1, -1), not 1"]
    );
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
    assert_eq!(found, ["e.toml:18:8: the rule of a wedge is [\"triangle(…)\", \"gauss(…)\"]"]);
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

    // Linear tetrahedron: one point for the stiffness, four for the mass.
    let rules = "rule = [\"tetrahedron(1)\"]\ndegree = 1\n[quadrature.forms.mass]\n\
                 rule = [\"tetrahedron(4)\"]\ndegree = 2";
    let linear = file("tetrahedron", &corners, &l.map(str::to_owned), rules);
    let element = read(&linear).unwrap();
    assert_eq!(element.rule("stiffness").points.len(), 1);
    assert_eq!(element.rule("mass").points.len(), 4);
}
