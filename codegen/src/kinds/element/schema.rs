//! What an element file may say.

use crate::document::schema::Shape::{
    Count, Either, Flag, Formula, List, Named, Number, Table, Text, Tuple, Words,
};
use crate::document::schema::{HEAD, Key, Shape, key, needed};
use crate::element::Cell;
use crate::kinds::kind::Kind;

/// Most nodes of an element, points of a rule, and modes: far above any element in use.
pub(super) const MOST: usize = 64;

/// Highest degree of completeness.
pub(super) const MOST_COMPLETE: usize = 4;

/// Highest degree of a rule that is proved.
pub(super) const HIGHEST_DEGREE: usize = 12;

/// What this kind of spec is.
pub(in crate::kinds) const KIND: Kind = Kind {
    name: "element",
    title: "finite element",
    shape: &Table(&[WORD, HEAD, ELEMENT]),
    folder: "elements",
    registry: "elements",
    entry: "Element",
    effort: 1,
};

const WORD: &[Key] = &[needed("kind", Words(&["element"]), "the kind of spec")];

/// A number, or a formula without names.
const EXACT: Shape = Either(&[Number, Formula]);

const ELEMENT: &[Key] = &[
    needed("cell", Words(&Cell::NAMES), "the reference cell"),
    needed("nodes", List(&Tuple(&EXACT, 3)), "reference coordinates of the nodes"),
    needed(
        "shape",
        Either(&[Formula, List(&Formula)]),
        "one formula over xi_a, eta_a, zeta_a, or one a node",
    ),
    key("complete", Count(0, MOST_COMPLETE), "degree of polynomials reproduced; 1 if left out"),
    needed("quadrature", Table(&[RULE, RULES]), "how forms are integrated"),
    key("enhanced", Table(&[ENHANCED]), "incompatible modes"),
    needed("abaqus", Table(&[ABAQUS, ORDER]), "how mesh files call it"),
    key("gmsh", Table(&[GMSH, ORDER]), "how Gmsh calls it"),
    key("nastran", Table(&[NASTRAN, ORDER]), "how Nastran's bulk data call it"),
    needed("vtk", Table(&[VTK, ORDER]), "how pictures call it"),
];

const RULE: &[Key] = &[
    key("rule", List(&Text), "a product of named rules, such as [\"gauss(2)\", …]"),
    key("points", List(&Tuple(&EXACT, 4)), "xi, eta, zeta and weight of every point"),
    needed(
        "degree",
        Count(0, HIGHEST_DEGREE),
        "every monomial up to this degree is integrated exactly",
    ),
    key("reduced", Flag, "true: fewer points than the products of the form need"),
    key("patch_test", Words(&["any", "affine"]), "cells that must pass the patch test"),
];

const RULES: &[Key] = &[key("forms", Named(&Table(&[RULE])), "rules of single forms")];

const ENHANCED: &[Key] = &[
    needed("forms", List(&Text), "forms in which the modes take part"),
    needed("modes", List(&Formula), "functions of xi, eta, zeta"),
    needed("jacobian", Words(&["centre", "point"]), "which turns their gradients"),
    key("scale", Formula, "factor of their gradients over det and det0"),
];

const ABAQUS: &[Key] = &[needed("types", List(&Text), "element types of Abaqus and CalculiX")];

const GMSH: &[Key] = &[needed("type", Count(0, u8::MAX as usize), "element type of Gmsh")];
const NASTRAN: &[Key] = &[needed("card", Text, "card of Nastran, such as CHEXA")];

const VTK: &[Key] = &[needed("type", Count(0, u8::MAX as usize), "VTK cell type")];

const ORDER: &[Key] = &[key(
    "order",
    List(&Count(1, MOST)),
    "this element's nodes in the order of the other program",
)];
