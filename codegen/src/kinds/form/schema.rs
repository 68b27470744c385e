//! What a file of forms may say.

use crate::document::schema::Shape::{Formula, Named, Number, Table, Text, Tuple, Words};
use crate::document::schema::{HEAD, Key, key, needed};

/// What this kind of spec is.
pub(in crate::kinds) const KIND: Kind = Kind {
    name: "form",
    title: "bilinear forms",
    shape: &Table(&[WORD, HEAD, FORM]),
    folder: "forms",
    registry: "forms",
    entry: "Origin",
    effort: 1,
};
use crate::kinds::kind::Kind;

const WORD: &[Key] = &[needed("kind", Words(&["form"]), "the kind of spec")];

const FORM: &[Key] = &[
    needed("material", Named(&Table(&[PROPERTY])), "properties of the material"),
    key("coefficients", Named(&Formula), "formulas over the material"),
    key("matrices", Named(&Tuple(&Tuple(&Number, 3), 3)), "constant 3 × 3 matrices"),
    key("stresses", Named(&Text), "the form of gradients whose stress each is"),
    needed("forms", Named(&Formula), "bilinear in u (trial, columns) and v (test, rows)"),
];

const PROPERTY: &[Key] =
    &[needed("unit", Text, "SI unit"), needed("title", Text, "one-line description")];
