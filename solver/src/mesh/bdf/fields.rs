//! Lines of bulk data as cards: a name, and fields of eight or sixteen columns, or between commas.

use std::borrow::Cow;

use super::super::raw::LinePosition;
use super::continuations::{Ordered, asks_for, ordered};
use super::cut::Cut;
use super::files::{Line, Sources};

/// A field with its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Field<'a> {
    /// Without blanks around it; empty where the field is blank.
    pub(super) text: &'a str,
    pub(super) place: LinePosition,
    /// As Nastran counts fields of a line, the name being the first.
    pub(super) number: usize,
}

/// A card with its continuations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Card<'a> {
    /// In capitals, without the asterisk.
    pub(super) name: Cow<'a, str>,
    pub(super) place: LinePosition,
    /// Eight a line, blank ones among them.
    pub(super) fields: Vec<Field<'a>>,
    /// What is wrong with its lines: to be reported where the card is read.
    pub(super) faults: Vec<(LinePosition, String, &'static str)>,
    /// What the last line says about its continuation.
    marker: &'a str,
}

impl<'a> Card<'a> {
    /// A field, from 0 behind the name, unless it is blank.
    pub(super) fn field(&self, at: usize) -> Option<&Field<'a>> {
        self.fields.get(at).filter(|field| !field.text.is_empty())
    }

    /// The field's number as Nastran counts.
    pub(super) fn number(&self, at: usize) -> usize {
        self.fields.get(at).map_or(at + 2, |field| field.number)
    }

    /// Filled fields from one on.
    pub(super) fn filled_from(&self, at: usize) -> impl Iterator<Item = &Field<'a>> {
        self.fields.iter().skip(at).filter(|field| !field.text.is_empty())
    }
}

/// What stands in bulk data.
pub(super) enum Entry<'c, 'a> {
    Card(&'c Card<'a>),
    /// A comment, without the sign before it.
    Comment(&'a str),
    /// A continuation of nothing, or of more than one line: the other line with its mark.
    Orphan(LinePosition, Option<LinePosition>),
}

/// Goes over the cards and comments of lines of bulk data. A comment between the lines of a card comes behind it.
pub(super) fn each<'a>(sources: &'a Sources, lines: &[Line], mut take: impl FnMut(Entry<'_, 'a>)) {
    let mut open: Option<Card<'a>> = None;
    let mut comments: Vec<&'a str> = Vec::new();
    let Ordered { lines, unclear } = ordered(sources, lines);
    for line in lines.iter() {
        let text = sources.text(line);
        let (text, comment) = match text.split_once('$') {
            Some((text, comment)) => (text, Some(comment)),
            None => (text, None),
        };
        if text.trim().is_empty() {
            comments.extend(comment);
            continue;
        }
        let cut = Cut::new(text);
        if cut.continues() {
            let other = unclear.get(&(line.file, line.number));
            match &mut open {
                Some(card) if other.is_none() => card.extend(&cut, line),
                _ => take(Entry::Orphan(line.place(), other.map(Line::place))),
            }
            continue;
        }
        if let Some(card) = open.take() {
            take(Entry::Card(&card));
        }
        comments.drain(..).for_each(|comment| take(Entry::Comment(comment)));
        // meshio writes `CTETRA_` of quadratic elements.
        let name = cut.name.trim_end_matches('*').trim_end().trim_end_matches('_');
        let mut card = Card {
            name: match name.bytes().any(|c| c.is_ascii_lowercase()) {
                true => Cow::Owned(name.to_ascii_uppercase()),
                false => Cow::Borrowed(name),
            },
            place: LinePosition { column: cut.column, ..line.place() },
            fields: Vec::with_capacity(8),
            faults: Vec::new(),
            marker: "",
        };
        card.extend(&cut, line);
        open = Some(card);
    }
    if let Some(card) = open {
        take(Entry::Card(&card));
    }
    comments.into_iter().for_each(|comment| take(Entry::Comment(comment)));
}

impl<'a> Card<'a> {
    fn extend(&mut self, cut: &Cut<'a>, line: &Line) {
        let bare = |text: &'a str| text.trim_start_matches(['+', '*']).trim();
        let (wanted, found) = (bare(self.marker), bare(cut.name));
        let both = cut.continues() && !wanted.is_empty() && !found.is_empty();
        if both && !asks_for(self.marker, found) {
            let what = format!(
                "this continuation is marked {found}, but the line above asks for {wanted}"
            );
            let help = "put continuations directly below the lines that they continue, or leave the marks blank";
            self.faults.push((line.place(), what, help));
        }
        let place = |column: usize| LinePosition { column, ..line.place() };
        let blank = |number: usize| Field { text: "", place: line.place(), number };
        // A line of four wide fields may be the only one of its pair.
        if !cut.wide {
            while !self.fields.len().is_multiple_of(8) {
                self.fields.push(blank(0));
            }
        }
        let width = if cut.wide { 4 } else { 8 };
        let first = if self.fields.len() % 8 == 4 { 6 } else { 2 };
        self.marker = "";
        let mut taken = 0;
        for (piece, column) in cut.pieces() {
            if taken < width {
                let number = first + taken;
                self.fields.push(Field { text: piece, place: place(column), number });
            } else if taken == width && (piece.starts_with(['+', '*']) || !cut.free) {
                self.marker = piece;
            } else if cut.free && !piece.is_empty() {
                let what = format!("{} has more than {width} values in a line", self.name);
                let help = match cut.wide {
                    true => "go on in the next line, which begins with *,",
                    false => "go on in the next line, which begins with a comma",
                };
                self.faults.push((place(column), what, help));
                break;
            }
            taken += 1;
        }
        (taken..width).for_each(|at| self.fields.push(blank(first + at)));
    }
}
