//! What spec files may say.

use whirl_codegen::element::Cell;
use whirl_codegen::spec::law::{Acts, Quantity};

use super::shape::Shape::{self, Count, Either, Flag, Formula, Known, Number, Table, Text, Words};
use super::shape::{Key, key, list, named, needed, tuple};

/// Keys that every spec has.
fn head(kind: &'static str) -> Vec<Key> {
    vec![
        needed("kind", Words(vec![kind]), "the kind of spec"),
        needed("name", Text, "the name by which others refer to it"),
        needed("title", Text, "one line for people"),
        needed("source", Text, "paper and equation, standard, or book"),
    ]
}

fn spec(kind: &'static str, keys: Vec<Key>) -> Shape {
    Table(head(kind).into_iter().chain(keys).collect())
}

/// Names of inputs or outputs of laws of either kind, each once.
fn quantities(of: fn(Acts) -> &'static [Quantity]) -> Vec<(&'static str, &'static str)> {
    let mut names: Vec<(&str, &str)> = Vec::new();
    for quantity in Acts::ALL.into_iter().flat_map(of) {
        if names.iter().all(|(name, _)| *name != quantity.name) {
            names.push((quantity.name, quantity.title));
        }
    }
    names
}

/// A bearing law.
pub(super) fn law() -> Shape {
    let variable = || {
        vec![
            needed("unit", Text, "unit in which formulas take or give it, such as \"mm\""),
            key("title", Text, "one line for people"),
            key("range", tuple(Number, 2), "where the law is looked at and meant to be used"),
        ]
    };
    let parameter = Table(vec![
        needed("value", Number, "in the unit beside it"),
        needed("unit", Text, "any unit; \"1\" for a pure number"),
        key("title", Text, "one line for people"),
    ]);
    let which = || Either(vec![Text, Count(1)]);
    let column = || {
        let apart = vec![
            needed("column", which(), "its name, or its number from 1"),
            key("unit", Text, "its unit, where the file does not say it"),
        ];
        Either(vec![Text, Count(1), Table(apart)])
    };
    let extend = Words(vec!["constant", "linear", "periodic", "refuse"]);
    let table = Table(vec![
        needed("file", Text, "the file of columns beside this one, such as \"gap.csv\""),
        needed("input", Formula, "what it is looked up by, such as 'h'"),
        key("x", column(), "the column of the input; the first if left out"),
        key("y", column(), "the column of the values; the second if left out"),
        key("extend", extend, "what becomes of inputs outside its rows"),
    ]);
    let piece = Table(vec![
        key("when", Formula, "the condition under which it applies; the last piece has none"),
        needed("value", Formula, "what it gives"),
    ]);
    let mut output = variable();
    output.extend([
        key("value", Formula, "one formula for all inputs"),
        key("pieces", list(piece), "formulas with conditions; the first that holds applies"),
        key("engage", Words(vec!["root"]), "moves breaks to where the pieces meet"),
        key("jump", Words(vec!["accept"]), "keeps jumps"),
        key("smooth", Shape::Quantity("1 um"), "blends pieces over this length of the input"),
    ]);
    spec(
        "law",
        vec![
            needed(
                "inputs",
                Known(quantities(Acts::inputs), Box::new(Table(variable()))),
                "what it depends on",
            ),
            key("parameters", named(parameter), "constants"),
            key(
                "tables",
                named(table),
                "measured curves: monotone cubics through columns of a file",
            ),
            key("definitions", named(Formula), "names for parts of formulas"),
            needed(
                "outputs",
                Known(quantities(Acts::outputs), Box::new(Table(output))),
                "what it gives",
            ),
        ],
    )
}

/// A finite element.
pub(super) fn element() -> Shape {
    let exact = || Either(vec![Number, Formula]);
    let rule = || {
        vec![
            key("rule", list(Text), "a product of named rules, such as [\"gauss(2)\", …]"),
            key("points", list(tuple(exact(), 4)), "xi, eta, zeta and weight of every point"),
            needed("degree", Count(0), "every monomial up to this degree is integrated exactly"),
            key("reduced", Flag, "true: fewer points than the products of the form need"),
            key("patch_test", Words(vec!["any", "affine"]), "cells that must pass the patch test"),
        ]
    };
    let mut quadrature = rule();
    quadrature.push(key("forms", named(Table(rule())), "rules of single forms"));
    let order =
        || key("order", list(Count(1)), "this element's nodes in the order of the other program");
    let enhanced = Table(vec![
        needed("forms", list(Text), "forms in which the modes take part"),
        needed("modes", list(Formula), "functions of xi, eta, zeta"),
        needed("jacobian", Words(vec!["centre", "point"]), "which turns their gradients"),
        key("scale", Formula, "factor of their gradients over det and det0"),
    ]);
    spec(
        "element",
        vec![
            needed("cell", Words(Cell::NAMES.to_vec()), "the reference cell"),
            needed("nodes", list(tuple(exact(), 3)), "reference coordinates of the nodes"),
            needed(
                "shape",
                Either(vec![Formula, list(Formula)]),
                "one formula over xi_a, eta_a, zeta_a, or one a node",
            ),
            key("complete", Count(0), "degree of polynomials reproduced; 1 if left out"),
            needed("quadrature", Table(quadrature), "how forms are integrated"),
            key("enhanced", enhanced, "incompatible modes"),
            needed(
                "abaqus",
                Table(vec![
                    needed("types", list(Text), "element types of Abaqus and CalculiX"),
                    order(),
                ]),
                "how mesh files call it",
            ),
            needed(
                "vtk",
                Table(vec![needed("type", Count(0), "VTK cell type"), order()]),
                "how pictures call it",
            ),
        ],
    )
}

/// Bilinear forms.
pub(super) fn form() -> Shape {
    let property =
        Table(vec![needed("unit", Text, "SI unit"), needed("title", Text, "one line for people")]);
    spec(
        "form",
        vec![
            needed("material", named(property), "properties of the material"),
            key("coefficients", named(Formula), "formulas over the material"),
            key("matrices", named(tuple(tuple(Number, 3), 3)), "constant 3 × 3 matrices"),
            needed("forms", named(Formula), "bilinear in u (trial, columns) and v (test, rows)"),
        ],
    )
}

/// A motion.
pub(super) fn motion() -> Shape {
    let row = || {
        vec![
            key("theta", Formula, "column of the rotation"),
            key("eta", Formula, "column of the flexible coordinates"),
        ]
    };
    let blocks = || {
        Table(vec![
            key("theta", Table(row()), "row of the rotation"),
            key("eta", Table(row()), "row of the flexible coordinates"),
        ])
    };
    let tensor = Words(vec!["scalar", "vector", "matrix", "symmetric", "skew"]);
    let coordinates = Table(vec![
        needed("theta", Words(vec!["scalar"]), "rotation of the shaft"),
        needed("eta", Words(vec!["vector"]), "flexible coordinates"),
    ]);
    spec(
        "motion",
        vec![
            key("kinetic_energy", Formula, "T, from which all else is derived"),
            needed("coordinates", coordinates, "the coordinates that the solver marches"),
            needed("tensors", named(tensor), "constants with their shapes"),
            key("mass", blocks(), "M(q), in place of an energy"),
            key("quadratic_velocity", Table(row()), "Q_v, in place of an energy"),
            key("PF", blocks(), "∂(M q̈)/∂q as declared; it must be the derivative"),
            key("B", blocks(), "∂Q_v/∂q as declared; it must be the derivative"),
            key("P", blocks(), "∂Q_v/∂q̇ as declared; it must be the derivative"),
        ],
    )
}

/// A clearance.
pub(super) fn clearance() -> Shape {
    let coordinate = || {
        named(Table(vec![
            needed("unit", Text, "SI unit"),
            key("title", Text, "one line for people"),
        ]))
    };
    let measure = Table(vec![
        needed("value", Formula, "a length or an angle"),
        key("title", Text, "one line for people"),
        key("rate", Text, "name of its rate, as laws call it"),
        key("force", Text, "name of the force that works on it"),
    ]);
    let laws = Table(vec![
        needed("inputs", list(Text), "names that such a law may take"),
        needed("forces", list(Text), "names that such a law may give"),
    ]);
    spec(
        "clearance",
        vec![
            needed(
                "spring",
                coordinate(),
                "one angle, fixed, by which the springs of a ring differ",
            ),
            needed(
                "constants",
                coordinate(),
                "lengths: the radial clearance, and the journal's radius",
            ),
            needed(
                "ring",
                coordinate(),
                "an angle and two displacements that the springs of a ring share",
            ),
            needed("radial", coordinate(), "one displacement, each spring's own"),
            key(
                "tangential",
                coordinate(),
                "one displacement, each spring's own, along the tangent",
            ),
            key("bore", coordinate(), "two mean displacements of the bore's ring and its rotation"),
            key("definitions", named(Formula), "names for parts of the formula"),
            needed("clearance", named(Formula), "the clearance"),
            needed("axial", named(tuple(Formula, 3)), "weights of the three rings over the length"),
            key("measures", named(measure), "what else laws depend on, and their forces work on"),
            key("laws", named(laws), "what laws of springs and of rings may take and give"),
        ],
    )
}
