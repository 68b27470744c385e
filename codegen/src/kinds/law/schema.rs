//! What a law file may say.

use super::acts::{Acts, Quantity};
use super::bearing::BearingValue;
use crate::document::schema::Shape::{
    Count, Either, Formula, Known, List, Named, Number, Table, Text, Tuple, Words,
};
use crate::document::schema::{HEAD, Key, Shape, key, needed};
use crate::kinds::kind::Kind;

/// What this kind of spec is.
pub(in crate::kinds) const KIND: Kind = Kind {
    name: "law",
    title: "bearing law",
    shape: &Table(&[WORD, HEAD, LAW]),
    folder: "laws",
    registry: "laws",
    entry: "Law",
    effort: 1,
};

const WORD: &[Key] = &[needed("kind", Words(&["law"]), "the kind of spec")];

const LAW: &[Key] = &[
    needed("inputs", Known(inputs, &Table(&[VARIABLE])), "what it depends on"),
    key(
        "states",
        Named(&Table(&[STATE])),
        "what it remembers: values that change at rates of their own",
    ),
    key("rates", Named(&Formula), "the rates of the states, in their units per second"),
    key(
        "stored",
        Formula,
        "energy stored in its inputs and states, in the units of the file; what else it takes is dissipated",
    ),
    key("parameters", Named(&Table(&[PARAMETER])), "constants"),
    key(
        "tables",
        Named(&Table(&[TABLE])),
        "measured curves: monotone cubics through columns of a file",
    ),
    key("definitions", Named(&Formula), "names for parts of formulas"),
    needed("outputs", Known(outputs, &Table(&[VARIABLE, OUTPUT])), "what it gives"),
    key(
        "valid",
        Named(&Table(&[VALID])),
        "where it may be believed: a run that goes beyond is not sound",
    ),
];

const VARIABLE: &[Key] = &[
    needed("unit", Text, "unit in which formulas take or give it, such as \"mm\""),
    key("title", Text, "one-line description"),
    key("range", Tuple(&Number, 2), "where the law is plotted and analysed"),
];

const STATE: &[Key] = &[
    needed("unit", Text, "any unit; \"1\" for a pure number"),
    needed(
        "start",
        Either(&[Number, Words(&["rest"])]),
        "its value at the start, in its unit; \"rest\": that at which its rate is zero",
    ),
    key("title", Text, "one-line description"),
    key("range", Tuple(&Number, 2), "where the law is plotted and analysed"),
];

const OUTPUT: &[Key] = &[
    key("value", Formula, "one formula for all inputs"),
    key("pieces", List(&Table(&[PIECE])), "formulas with conditions; the first that holds applies"),
    key("engage", Words(&["root"]), "moves breaks to where the pieces meet"),
    key("jump", Words(&["accept"]), "keeps jumps"),
    key("smooth", Text, "blends pieces over this length of the input").like("\"1 um\""),
];

const PIECE: &[Key] = &[
    key("when", Formula, "the condition under which it applies; the last piece has none"),
    needed("value", Formula, "what it gives"),
];

const PARAMETER: &[Key] = &[
    needed("value", Number, "in the unit beside it"),
    needed("unit", Text, "any unit; \"1\" for a pure number"),
    key("title", Text, "one-line description"),
    key("min", Number, "the least value that it may have, in the unit beside it"),
    key("above", Number, "what its value has to be above, in the unit beside it"),
    key("max", Number, "the largest value that it may have, in the unit beside it"),
    key("below", Number, "what its value has to be below, in the unit beside it"),
    key(
        "bearing",
        Words(BearingValue::WORDS),
        "what it is of the bearing, whose value then holds; the one here is for plots and tests",
    ),
];

const VALID: &[Key] = &[
    needed("value", Formula, "what is measured, such as 'sqrt(e_x^2 + e_y^2)/c'"),
    needed("unit", Text, "its unit; \"1\" for a pure number"),
    key("min", Either(&[Number, Formula]), "least value: a number in the unit, or of parameters"),
    key("max", Either(&[Number, Formula]), "largest value: a number in the unit, or of parameters"),
    needed("title", Text, "what the measure is called, for people"),
    needed("help", Text, "what is wrong beyond the limits, and what to do"),
];

const TABLE: &[Key] = &[
    needed("file", Text, "the file of columns beside this one, such as \"gap.csv\""),
    needed("input", Formula, "what it is looked up by, such as 'h'"),
    key("x", COLUMN, "the column of the input; the first if left out"),
    key("y", COLUMN, "the column of the values; the second if left out"),
    key("extend", EXTEND, "what becomes of inputs outside its rows"),
    key(
        "valid_beyond",
        Words(&["below", "above", "both"]),
        "ends of the rows beyond which the extension may be believed",
    ),
];

/// More columns than any file of a moderate length has.
const MOST_COLUMNS: usize = 10_000;

const EXTEND: Shape = Words(&["constant", "linear", "periodic", "refuse"]);

const COLUMN: Shape = Either(&[Text, Count(1, MOST_COLUMNS), Table(&[APART])]);

const APART: &[Key] = &[
    needed("column", Either(&[Text, Count(1, MOST_COLUMNS)]), "its name, or its number from 1"),
    key("unit", Text, "its unit, where the file does not say it"),
];

fn inputs() -> Vec<(&'static str, &'static str)> {
    titles(Acts::inputs)
}

fn outputs() -> Vec<(&'static str, &'static str)> {
    titles(Acts::outputs)
}

/// Names that laws of either kind know, each once, with what they are.
fn titles(of: fn(Acts) -> &'static [Quantity]) -> Vec<(&'static str, &'static str)> {
    let known = super::acts::known(of);
    known.into_iter().map(|(quantity, _)| (quantity.name, quantity.title)).collect()
}
