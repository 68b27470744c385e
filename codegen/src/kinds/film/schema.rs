//! What a film file may say.

use super::rule;
use crate::document::schema::Shape::{
    Count, Either, Formula, List, Named, Number, Table, Text, Tuple, Words,
};
use crate::document::schema::{HEAD, Key, Shape, key, needed};
use crate::kinds::kind::Kind;

/// What this kind of spec is.
pub(in crate::kinds) const KIND: Kind = Kind {
    name: "film",
    title: "oil film",
    shape: &Table(&[WORD, HEAD, FILM]),
    folder: "films",
    registry: "films",
    entry: "Film",
    effort: 40,
};

const WORD: &[Key] = &[needed("kind", Words(&["film"]), "the kind of spec")];

const FILM: &[Key] = &[
    needed("cell", Table(&[CELL]), "a cell of the developed bore"),
    needed(
        "unknowns",
        VARIABLES,
        "two fields of the nodes, the pressure first: at every node both at least zero and one of them zero",
    ),
    needed("gap", VARIABLES, "one length, given at every node by the motion of the surfaces"),
    needed("speed", VARIABLES, "mean speed of the surfaces around the bore, in the bore's frame"),
    needed("parameters", Named(&Table(&[PARAMETER])), "numbers of a film"),
    key(
        "nodal",
        Named(&Formula),
        "fields that follow at the nodes; interpolated as the unknowns are",
    ),
    key("definitions", Named(&Formula), "names for parts of formulas, evaluated where they stand"),
    needed("stored", Table(&[STORED]), "oil that a node holds"),
    needed("residual", Named(&Table(&[TERM])), "the weak form, linear in the test function v"),
    needed(
        "forces",
        Named(&Table(&[FORCE])),
        "what the film does to the surfaces, per area at the nodes",
    ),
    needed("edges", Named(&Table(&[EDGE])), "what nodes on an edge or an opening may be"),
    key("outputs", Named(&Table(&[OUTPUT])), "integrals over the bore"),
];

const CELL: &[Key] = &[
    needed("around", Count(2, 3), "nodes of a cell around the bore"),
    needed("along", Count(2, 3), "nodes of a cell along the bore"),
];

const VARIABLES: Shape = Named(&Table(&[&[
    needed("unit", Text, "SI unit"),
    key("title", Text, "one-line description"),
]]));

const PARAMETER: &[Key] = &[
    needed("value", Number, "the value, in the unit"),
    needed("unit", Text, "the unit; formulas take it in SI"),
    key("title", Text, "one-line description"),
];

const STORED: &[Key] = &[needed(
    "value",
    Formula,
    "a length: volume per area; the gap in it is the one whose rate Newmark's method has",
)];

const POINTS: Shape = Either(&[Words(&[rule::NODES]), Tuple(&Words(rule::WORDS), 2)]);

const TERM: &[Key] = &[
    needed("value", Formula, "what is integrated"),
    needed("points", POINTS, "`\"nodes\"`, or a rule around and one along"),
];

const FORCE: &[Key] = &[
    needed("on", Text, "the measure of the clearance on which it works"),
    needed("value", Formula, "force per area"),
];

const EDGE: &[Key] = &[
    needed("given", List(&Text), "unknowns whose values are given there"),
    key(
        "complementary",
        Tuple(&Text, 2),
        "`out`, what leaves there, and the unknown that takes turns with it",
    ),
];

const OUTPUT: &[Key] = &[
    needed("unit", Text, "SI unit"),
    key("title", Text, "one-line description"),
    needed("terms", Named(&Table(&[TERM])), "what is added up"),
];
