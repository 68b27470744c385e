//! What a sweep file may say.

use whirl_codegen::document::schema::Shape::{
    Count, Either, Flag, List, Named, Number, Table, Text, Words,
};
use whirl_codegen::document::schema::{Key, Shape, key, needed};

use super::definition::Sweep;

/// Points of a sweep: more take longer than anybody waits, or are a mistake.
pub(super) const MOST_POINTS: usize = 1_000_000;
/// The largest seed: TOML's whole numbers end at 2^63 − 1.
const LARGEST_SEED: usize = i64::MAX as usize;

impl Sweep {
    /// One line that says what the file is.
    pub(crate) const TITLE: &'static str = "a sweep: a case with keys that vary";
    /// The table of the whole file.
    pub(crate) const SHAPE: &'static Shape = &Table(&[SWEEP]);
}

const SWEEP: &[Key] = &[
    key("title", Text, "one-line description"),
    needed("case", Text, "the path of a case file, or the name of a built-in case")
        .like("\"hu2003-5\""),
    needed(
        "vary",
        Named(&VARIED),
        "keys of the case with their values: a range as \"20 um .. 60 um, 9\", or a list",
    ),
    key("together", List(&List(&Text)), "keys that vary in step, as many as there are in a list")
        .like("[[\"springs.radial_clearance\", \"load.1.force\"]]"),
    key(
        "samples",
        Count(2, MOST_POINTS),
        "points of a Latin hypercube over all keys, in place of all combinations",
    )
    .like("200"),
    key("seed", Count(0, LARGEST_SEED), "of the Latin hypercube; 0 if left out").like("1"),
    key(
        "continue",
        Words(&["up", "down", "both"]),
        "starts points as the one before ended, along rising values, falling ones, or both",
    ),
    key("along", Text, "the key along which it is continued; the last one if left out")
        .like("\"load.1.force\""),
    key(
        "analyse",
        Either(&[Text, List(&Text)]),
        "analyses of the case that are done at every point, in place of a run",
    )
    .like("[\"stability\"]"),
    key("march", Flag, "with `analyse`: whether points are run as well; false if left out"),
    key(
        "keep",
        Words(&["nothing", "histories"]),
        "of every point beside its row; nothing if left out",
    ),
];

/// Tables of a case within each other, down to the deepest key; at the end values.
const VARIED: Shape = within!(within!(within!(within!(within!(within!(VALUES))))));
/// One value, a range of them, or a list.
const VALUES: Shape = Either(&[Text, Number, Flag, List(&VALUE)]);
const VALUE: Shape = Either(&[Text, Number, Flag, List(&Text)]);

/// Values, or a table with such.
macro_rules! within {
    ($inner:expr) => {
        Either(&[Text, Number, Flag, List(&VALUE), Named(&$inner)])
    };
}
use within;
