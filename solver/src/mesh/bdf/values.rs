//! Values of fields, or what is wrong with them.

use super::super::raw::MeshReport;
use super::fields::{Card, Field};
use super::numbers::{self, WrongNumber};

/// For values that do not stand in their columns.
pub(super) const ALIGN: &str = "a field is 8 columns wide, or 16 where the card's name ends with *: align the values, or put commas between them";

impl MeshReport {
    /// A whole number from 1 in a field that must be filled.
    pub(super) fn label(&mut self, card: &Card, at: usize, of: &str) -> Option<u64> {
        let field = self.filled(card, at, of)?;
        self.label_in(card, &field, of)
    }

    /// A whole number from 1.
    pub(super) fn label_in(&mut self, card: &Card, field: &Field, of: &str) -> Option<u64> {
        match numbers::whole(field.text) {
            Some(label) if label > 0 => Some(label),
            _ => {
                let wanted = "a whole number from 1";
                self.wrong(card, field, of, wanted);
                None
            }
        }
    }

    /// A whole number from 0; 0 where the field is blank.
    pub(super) fn count_or_zero(&mut self, card: &Card, at: usize, of: &str) -> Option<u64> {
        let Some(field) = card.field(at) else { return Some(0) };
        let field = *field;
        let value = numbers::whole(field.text);
        if value.is_none() {
            self.wrong(card, &field, of, "a whole number");
        }
        value
    }

    /// A finite number, where the field is filled.
    pub(super) fn real(&mut self, card: &Card, at: usize, of: &str) -> Option<f64> {
        let field = *card.field(at)?;
        self.real_in(card, &field, of)
    }

    /// As [`MeshReport::real`]; 0 where the field is blank.
    pub(super) fn real_or_zero(&mut self, card: &Card, at: usize, of: &str) -> Option<f64> {
        match card.field(at) {
            None => Some(0.0),
            Some(_) => self.real(card, at, of),
        }
    }

    pub(super) fn real_in(&mut self, card: &Card, field: &Field, of: &str) -> Option<f64> {
        match numbers::real(field.text) {
            Ok(value) => Some(value),
            Err(WrongNumber::TooLarge) => {
                let what = format!("{of} is beyond all numbers: `{}`", field.text);
                self.error(field.place, what, "check its exponent");
                None
            }
            Err(WrongNumber::NoNumber) => {
                self.wrong(card, field, of, "a number");
                None
            }
        }
    }

    fn filled<'a>(&mut self, card: &Card<'a>, at: usize, of: &str) -> Option<Field<'a>> {
        let field = card.field(at).copied();
        if field.is_none() {
            let what = format!("{} lacks the {of}, its field {}", card.name, card.number(at));
            self.error(card.place, what, "fill the field");
        }
        field
    }

    /// Notes a field that is not what it must be.
    pub(super) fn wrong(&mut self, card: &Card, field: &Field, of: &str, wanted: &str) {
        let Field { text, number, .. } = field;
        let mut found: String = text.chars().take(24).collect();
        if found.len() < text.len() {
            found.push('…');
        }
        let what =
            format!("{of} (field {number} of {}) must be {wanted}, found `{found}`", card.name);
        let help = match (text.contains(char::is_whitespace), wanted) {
            (true, _) => ALIGN,
            (false, "a number") => "write it as 0.0115, 1.15E-2 or 1.15-2",
            _ => "see that each value stands in its own columns",
        };
        self.error(field.place, what, help);
    }
}
