//! What a file may say: the keys of its tables, and what each takes.
//!
//! Readers ask for keys through these declarations, and schemas for editors are printed from them. A key
//! that is not declared cannot be read, and neither can a value that its declaration refuses; so what
//! a reader knows and what an editor knows are the same.

use crate::units::Dimension;

/// A key of a table.
#[derive(Debug, Clone, Copy)]
pub struct Key {
    /// The key.
    pub name: &'static str,
    /// What it says, for people.
    pub about: &'static str,
    /// Whether it must be there.
    pub need: Need,
    /// What it takes.
    pub shape: Shape,
    /// A value as it would be written; empty where the shape says enough.
    pub example: &'static str,
}

/// Whether a key must be there.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Need {
    /// It may be left out, or the reader says when it may not.
    Free,
    /// In every such table.
    Always,
    /// In every such table once included files are merged into it.
    Merged,
}

/// What a key takes.
#[derive(Debug, Clone, Copy)]
pub enum Shape {
    /// Text: a name, a title, a path, a unit.
    Text,
    /// A formula, as text.
    Formula,
    /// A quantity with its unit.
    Quantity(Measure),
    /// A number.
    Number,
    /// A number between two others, these left out.
    Between(f64, f64),
    /// A whole number from the first to the second, both allowed.
    Count(usize, usize),
    /// True or false.
    Flag,
    /// One of these words.
    Words(&'static [&'static str]),
    /// One of the words that a registry holds.
    Registered(fn() -> Vec<&'static str>),
    /// A list of any length.
    List(&'static Shape),
    /// A list of this length.
    Tuple(&'static Shape, usize),
    /// Any of these.
    Either(&'static [Shape]),
    /// A table with these keys, in groups, and no others.
    Table(&'static [&'static [Key]]),
    /// A table whose keys are names that the user chooses.
    Named(&'static Shape),
    /// A table whose keys are these names, each with what it is, in ASCII or other spelling (`ḣ`).
    Known(fn() -> Vec<(&'static str, &'static str)>, &'static Shape),
}

/// What a quantity is.
#[derive(Debug, Clone, Copy)]
pub struct Measure {
    /// What it measures.
    pub dimension: Dimension,
    /// As a user would write it.
    pub example: &'static str,
    /// Values allowed.
    pub range: Range,
}

/// Values that a quantity may take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Range {
    /// Any.
    Any,
    /// Greater than zero.
    Positive,
    /// Zero or greater.
    NotNegative,
}

/// A key that may be left out.
pub const fn key(name: &'static str, shape: Shape, about: &'static str) -> Key {
    Key { name, about, need: Need::Free, shape, example: "" }
}

/// A key that must be there.
pub const fn needed(name: &'static str, shape: Shape, about: &'static str) -> Key {
    Key { need: Need::Always, ..key(name, shape, about) }
}

/// A key that must be there once included files are merged.
pub const fn merged(name: &'static str, shape: Shape, about: &'static str) -> Key {
    Key { need: Need::Merged, ..key(name, shape, about) }
}

impl Key {
    /// The key with a value as it would be written in TOML.
    pub const fn like(self, example: &'static str) -> Key {
        Key { example, ..self }
    }
}

/// Keys that every spec has beside its kind.
pub(crate) const HEAD: &[Key] = &[
    needed("name", Shape::Text, "the name by which others refer to it"),
    needed("title", Shape::Text, "one-line description"),
    needed("source", Shape::Text, "paper and equation, standard, or book"),
];

impl Shape {
    /// The shapes that a value may have.
    pub(crate) fn alternatives(&self) -> &[Shape] {
        match self {
            Shape::Either(shapes) => shapes,
            one => std::slice::from_ref(one),
        }
    }

    /// What a key of this table takes, if it is a table that knows the key.
    pub(crate) fn of_key(&self, name: &str) -> Option<&Shape> {
        self.alternatives().iter().find_map(|shape| match shape {
            Shape::Table(_) => shape.key(name).map(|key| &key.shape),
            Shape::Named(inner) | Shape::Known(_, inner) => Some(*inner),
            _ => None,
        })
    }

    /// The keys of this table, if it is one with fixed keys.
    pub fn keys(&self) -> impl Iterator<Item = &'static Key> {
        let groups = self.alternatives().iter().find_map(|shape| match shape {
            Shape::Table(groups) => Some(*groups),
            _ => None,
        });
        groups.unwrap_or_default().iter().copied().flatten()
    }

    /// A key of this table with fixed keys.
    pub(crate) fn key(&self, name: &str) -> Option<&'static Key> {
        self.keys().find(|key| key.name == name)
    }

    /// What the items of this list take.
    pub(crate) fn of_items(&self) -> Option<&Shape> {
        self.alternatives().iter().find_map(|shape| match shape {
            Shape::List(inner) | Shape::Tuple(inner, _) => Some(*inner),
            _ => None,
        })
    }

    /// The words of which a value must be one.
    pub fn words(&self) -> Vec<&'static str> {
        self.alternatives()
            .iter()
            .flat_map(|shape| match shape {
                Shape::Words(words) => words.to_vec(),
                Shape::Registered(words) => words(),
                _ => Vec::new(),
            })
            .collect()
    }

    /// Whether one of the alternatives is so.
    pub(crate) fn admits(&self, fits: impl Fn(&Shape) -> bool) -> bool {
        self.alternatives().iter().any(fits)
    }

    /// Whether a table is a value.
    pub(crate) fn is_table(&self) -> bool {
        self.admits(|shape| matches!(shape, Shape::Table(_) | Shape::Named(_) | Shape::Known(..)))
    }

    /// Whether a table whose keys are names is a value.
    pub(crate) fn names_are_free(&self) -> bool {
        self.admits(|shape| matches!(shape, Shape::Named(_) | Shape::Known(..)))
    }

    /// Whether text is a value.
    pub(crate) fn is_text(&self) -> bool {
        self.admits(|shape| {
            use Shape::{Formula, Quantity, Registered, Text, Words};
            matches!(shape, Text | Formula | Quantity(_) | Words(_) | Registered(_))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The shapes inside a shape.
    fn inner(shape: &Shape) -> Vec<&Shape> {
        match shape {
            Shape::Either(shapes) => shapes.iter().collect(),
            Shape::List(one) | Shape::Tuple(one, _) | Shape::Named(one) | Shape::Known(_, one) => {
                vec![one]
            }
            Shape::Table(_) => shape.keys().map(|key| &key.shape).collect(),
            _ => Vec::new(),
        }
    }

    fn walk(shape: &Shape) {
        let names: Vec<&str> = shape.keys().map(|key| key.name).collect();
        for (place, name) in names.iter().enumerate() {
            assert!(!names[..place].contains(name), "`{name}` is declared twice");
        }
        // The readers take the first table or list of several shapes.
        let alternatives = shape.alternatives().iter();
        let composed = alternatives.filter(|shape| !inner(shape).is_empty()).count();
        assert!(composed <= 1 || !matches!(shape, Shape::Either(_)), "{shape:?}");
        inner(shape).into_iter().for_each(walk);
    }

    #[test]
    fn declarations_are_not_ambiguous() {
        crate::kinds::list::KINDS.in_order().into_iter().for_each(|kind| walk(kind.shape));
    }
}
