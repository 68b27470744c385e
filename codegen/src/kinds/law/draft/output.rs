//! Outputs as they were written.

use super::super::acts::Acts;
use super::variable::{Variable, parse, variable};
use crate::diagnostic::{Code, Diagnostic, Located};
use crate::document::Table;
use crate::formula::Formula;
use crate::units::Quantity;

/// What becomes of a jump between two pieces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::kinds::law) enum Jumps {
    Refused,
    Accepted,
    /// The break moves to the nearest root of the difference of the two pieces.
    Engaged,
}

pub(in crate::kinds::law) struct Output {
    pub(in crate::kinds::law) variable: Variable,
    pub(in crate::kinds::law) pieces: Vec<(Option<Formula>, Formula)>,
    pub(in crate::kinds::law) jumps: Jumps,
    /// Length over which every break is blended, SI, with what it measures and where it stands.
    pub(in crate::kinds::law) smooth: Option<(Quantity, Located)>,
}

/// Reads an output.
pub(super) fn read(table: &Table<'_>, key: &Located, name: String) -> Option<Output> {
    let document = table.document();
    let engage = table.optional_word("engage");
    let jump = table.optional_word("jump");
    let place = ["engage", "jump"]
        .iter()
        .find_map(|key| table.has(key).then(|| table.place(key)))
        .unwrap_or_else(|| key.span());
    let jumps = match (engage, jump) {
        (Some(_), Some(_)) => {
            let message = "`engage` removes the jump that `jump` would accept".to_owned();
            let error = Diagnostic::new(table.source(), Code::BAD_VALUE, place.clone(), message);
            document.push(error.help("keep one of them"));
            Jumps::Accepted
        }
        (Some(_), None) => Jumps::Engaged,
        (None, Some(_)) => Jumps::Accepted,
        (None, None) => Jumps::Refused,
    };
    let smooth = smooth(table);
    if let (Some((_, place)), Some(_)) = (&smooth, jump) {
        let message = "`smooth` removes the jump that `jump` would accept";
        document.push(place.error_here(Code::BAD_VALUE, message).help("keep one of them"));
    }
    let pieces = match (table.has("value"), table.has("pieces")) {
        (true, true) => {
            let message = format!("`{name}` has both a `value` and `pieces`");
            document.push(key.error_here(Code::PIECES, message).help("keep one of them"));
            None
        }
        (false, false) => {
            let message = format!("`{name}` has neither a `value` nor `pieces`");
            let error = key.error_here(Code::MISSING_KEY, message);
            let error = error.help("write for example `value = '1000*h'`");
            table.miss(&["value", "pieces"], error);
            None
        }
        (true, false) => {
            let text = table.string("value");
            text.and_then(|text| parse(document, &text)).map(|value| vec![(None, value)])
        }
        (false, true) => pieces(table, key, &name),
    };
    // Read before any early return, so that none of its keys is unknown.
    let variable = variable(table, key, name, Acts::outputs, "an output");
    Some(Output { variable: variable?, pieces: pieces?, jumps, smooth })
}

/// The length over which breaks are blended; that it fits their inputs is checked where these are known.
fn smooth(table: &Table<'_>) -> Option<(Quantity, Located)> {
    let text = table.optional_string("smooth")?;
    let quantity = match Quantity::parse(text.text()) {
        Ok(quantity) => quantity,
        Err(error) => {
            let found = text.error(error.code, error.span, error.message);
            table.document().push(found.maybe_help(error.help));
            return None;
        }
    };
    if quantity.si() <= 0.0 {
        let error = text.error_here(Code::BAD_VALUE, "`smooth` must be above zero");
        table.document().push(error.help("leave it out to keep the breaks"));
        return None;
    }
    Some((quantity, text))
}

fn pieces(table: &Table<'_>, key: &Located, name: &str) -> Option<Vec<(Option<Formula>, Formula)>> {
    let document = table.document();
    let items = table.items("pieces")?;
    let mut pieces = Vec::with_capacity(items.len());
    let mut fine = true;
    for (place, item) in items.iter().enumerate() {
        let Some(entry) = item.table(&format!("pieces[{}]", place + 1)) else {
            fine = false;
            continue;
        };
        let when = entry.optional_string("when");
        let value = entry.string("value").and_then(|text| parse(document, &text));
        let last = place + 1 == items.len();
        if when.is_none() && !last {
            let message = "this piece has no `when`, so that none after it ever applies";
            let error = Diagnostic::new(table.source(), Code::PIECES, entry.span(), message);
            document.push(error.help("write its condition, such as `when = 'h < 0'`"));
        }
        if let (Some(when), true) = (&when, last) {
            let error = when.error_here(Code::PIECES, "the last piece must apply everywhere else");
            let help = "leave its `when` out, or add a piece `{ value = '0' }`";
            document.push(error.help(help));
        }
        let condition = when.as_ref().map(|text| parse(document, text));
        entry.finish();
        match (value, condition) {
            (Some(value), None) => pieces.push((None, value)),
            (Some(value), Some(Some(condition))) => pieces.push((Some(condition), value)),
            _ => fine = false,
        }
    }
    if items.is_empty() {
        let error = key.error_here(Code::PIECES, format!("`{name}` has no pieces"));
        document.push(error.help("write at least `pieces = [{ value = '0' }]`"));
    }
    (fine && !pieces.is_empty()).then_some(pieces)
}
