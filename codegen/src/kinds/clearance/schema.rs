//! What a clearance file may say.

use crate::document::schema::Shape::{Formula, List, Named, Table, Text, Tuple, Words};
use crate::document::schema::{HEAD, Key, Shape, key, needed};

/// What this kind of spec is.
pub(in crate::kinds) const KIND: Kind = Kind {
    name: "clearance",
    title: "clearance of springs",
    shape: &Table(&[WORD, HEAD, CLEARANCE]),
    folder: "motion",
    registry: "clearances",
    entry: "Clearance",
    effort: 20,
};
use crate::kinds::kind::Kind;

const WORD: &[Key] = &[needed("kind", Words(&["clearance"]), "the kind of spec")];

const CLEARANCE: &[Key] = &[
    needed("spring", COORDINATES, "one angle, fixed, by which the springs of a ring differ"),
    needed("constants", COORDINATES, "lengths: the radial clearance, and the journal's radius"),
    needed("ring", COORDINATES, "an angle and two displacements that the springs of a ring share"),
    needed("radial", COORDINATES, "one displacement, each spring's own"),
    key("tangential", COORDINATES, "one displacement, each spring's own, along the tangent"),
    key(
        "bore",
        COORDINATES,
        "two mean displacements of the bore's ring and its rotation; of its section also a displacement along z and two tilts",
    ),
    key(
        "section",
        COORDINATES,
        "the turn of the journal's section against the frame of its body; also its displacement along z and two tilts",
    ),
    key(
        "sensor",
        COORDINATES,
        "two displacements of the journal's body where a sensor looks at it, in the frame of that body, and two of what it stands on",
    ),
    key(
        "gear",
        COORDINATES,
        "of the second of two gears: the turn of its frame, and its own times the ratio of base radii",
    ),
    key("definitions", Named(&Formula), "names for parts of the formula"),
    needed("clearance", Named(&Formula), "the clearance"),
    needed("axial", Named(&Tuple(&Formula, 3)), "weights of the three rings over the length"),
    needed(
        "apart",
        Named(&Named(&Formula)),
        "by the angle of the journal's body: what two distances of its axis from that of the bore, fixed in space, add to the displacements of the ring",
    ),
    key(
        "measures",
        Named(&Table(&[MEASURE])),
        "what else laws depend on, and their forces work on",
    ),
    key(
        "laws",
        Named(&Table(&[LAWS])),
        "what laws of springs, of rings, of joints and of gears may take and give",
    ),
];

const COORDINATES: Shape = Named(&Table(&[&[
    needed("unit", Text, "SI unit"),
    key("title", Text, "one-line description"),
]]));

const MEASURE: &[Key] = &[
    needed("value", Formula, "a length or an angle"),
    key("title", Text, "one-line description"),
    key("rate", Text, "name of its rate, as laws call it"),
    key("force", Text, "name of the force that works on it"),
];

const LAWS: &[Key] = &[
    needed("inputs", List(&Text), "names that such a law may take"),
    needed("forces", List(&Text), "names that such a law may give"),
];
