//! What a motion file may say.

use crate::document::schema::Shape::{Formula, Named, Table, Words};
use crate::document::schema::{HEAD, Key, Shape, key, needed};

/// What this kind of spec is.
pub(in crate::kinds) const KIND: Kind = Kind {
    name: "motion",
    title: "motion of a shaft",
    shape: &Table(&[WORD, HEAD, MOTION]),
    folder: "motion",
    registry: "motions",
    entry: "Motion",
    effort: 1,
};
use crate::kinds::kind::Kind;

const WORD: &[Key] = &[needed("kind", Words(&["motion"]), "the kind of spec")];

const MOTION: &[Key] = &[
    key("kinetic_energy", Formula, "T, from which all else is derived"),
    needed("coordinates", Table(&[COORDINATES]), "the coordinates that the solver marches"),
    needed("tensors", Named(&TENSOR), "constants with their shapes"),
    key("mass", BLOCKS, "M(q), in place of an energy"),
    key("quadratic_velocity", Table(&[ROW]), "Q_v, in place of an energy"),
    key("PF", BLOCKS, "∂(M q̈)/∂q as declared; it must be the derivative"),
    key("B", BLOCKS, "∂Q_v/∂q as declared; it must be the derivative"),
    key("P", BLOCKS, "∂Q_v/∂q̇ as declared; it must be the derivative"),
];

const COORDINATES: &[Key] = &[
    needed("theta", Words(&["scalar"]), "rotation of the shaft"),
    needed("eta", Words(&["vector"]), "flexible coordinates"),
];

const TENSOR: Shape = Words(&["scalar", "vector", "matrix", "symmetric", "skew"]);

const BLOCKS: Shape = Table(&[&[
    key("theta", Table(&[ROW]), "row of the rotation"),
    key("eta", Table(&[ROW]), "row of the flexible coordinates"),
]]);

const ROW: &[Key] = &[
    key("theta", Formula, "column of the rotation"),
    key("eta", Formula, "column of the flexible coordinates"),
];
