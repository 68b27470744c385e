//! What is said of every kind of spec, and of every spec, whatever its kind.

use std::sync::Arc;

use crate::diagnostic::Source;
use crate::document::schema::Shape;

/// One thing for each kind of spec, in the order in which kernels are written: those that others call first.
/// Whatever goes over kinds takes this apart, so that it does not compile where it leaves one out.
#[derive(Debug, Clone, Copy)]
pub struct ByKind<T> {
    /// Bilinear forms.
    pub forms: T,
    /// Finite elements.
    pub elements: T,
    /// Bearing laws.
    pub laws: T,
    /// Motions of a shaft.
    pub motions: T,
    /// Clearances of springs.
    pub clearances: T,
    /// Oil films.
    pub films: T,
}

impl<T> ByKind<T> {
    /// All, in order.
    pub fn in_order(self) -> [T; 6] {
        let ByKind { forms, elements, laws, motions, clearances, films } = self;
        [forms, elements, laws, motions, clearances, films]
    }
}

/// A kind of spec.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Word of the key `kind`.
    pub name: &'static str,
    /// One line that says what its files are.
    pub title: &'static str,
    /// What its files may say.
    pub shape: &'static Shape,
    /// Folder of the files.
    pub folder: &'static str,
    /// Module of the kernels and, in capitals, the registry.
    pub registry: &'static str,
    /// Type of an entry of the registry.
    pub(crate) entry: &'static str,
    /// How long a byte of its text keeps the generator busy, compared with other kinds.
    pub(crate) effort: usize,
}

/// What every spec says about itself.
#[derive(Debug)]
pub struct About<'a> {
    /// The name by which others refer to it.
    pub name: &'a str,
    /// One-line description.
    pub title: &'a str,
    /// Paper and equation, standard, or book.
    pub reference: &'a str,
    /// The file.
    pub file: &'a Arc<Source>,
    /// Other texts that its kernels were made from.
    pub beside: Vec<&'a str>,
}
