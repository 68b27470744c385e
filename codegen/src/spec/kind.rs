//! What a kind of spec is: an implementation of `SpecKind` in a folder of its own, and a line in the list of kinds
//! (`codegen/src/spec/list.rs`).

use std::any::Any;
use std::sync::Arc;

use super::page::Page;
use crate::diagnostic::{Diagnostics, Source};
use crate::document::schema::{Described, Shape};

/// Finds the file of a name beside a spec, or says why there is none.
pub(crate) type Beside<'a> = dyn Fn(&str) -> Result<Arc<Source>, String> + 'a;

/// A spec, or programs of one, of a kind that is not known here.
pub(crate) type OfAnyKind = dyn Any + Send + Sync;

/// What is said to people about a spec of some kind.
pub(crate) trait Explained {
    /// Writes what was found about it when it was read.
    fn report(&self, page: &mut Page);

    /// Writes all that it says and all that follows from it, but its code.
    fn explain(&self, page: &mut Page);
}

/// What kernels are made of a spec of some kind.
pub(crate) trait Compiled {
    /// What its kernels compute.
    type Programs: Any + Send + Sync;

    /// What its kernels compute: derived, simplified and in stages.
    fn schedule(&self, all: &[&OfAnyKind]) -> Result<Self::Programs, Diagnostics>;

    /// The module of its kernels, with an item `ENTRY` for the registry. `others`: whose kernels it may call, those of
    /// kinds that are [`CALLED`](SpecKind::CALLED) and those of its own kind before it.
    fn emit(&self, programs: &Self::Programs, others: &[Other<'_>]) -> String;
}

/// A kind of spec: how its files are read, what is said about them, and what kernels are made of them.
pub(crate) trait SpecKind:
    Described + Explained + Compiled + Any + Send + Sync + Sized
{
    /// Word of the key `kind`.
    const KIND: &'static str;
    /// Folder of the files.
    const FOLDER: &'static str;
    /// Module of the kernels and, in capitals, the registry.
    const REGISTRY: &'static str;
    /// Type of an entry of the registry.
    const ENTRY: &'static str;
    /// How long a byte of its text keeps the generator busy, compared with other kinds.
    const EFFORT: usize = 1;
    /// Whether other kinds call its kernels, which are therefore written first.
    const CALLED: bool = false;

    /// Reads a file, derives what follows from it and proves what it declares.
    fn read_with(file: &Arc<Source>, beside: &Beside<'_>) -> Result<Self, Diagnostics>;

    /// What it says about itself.
    fn about(&self) -> About<'_>;

    /// The files beside its own that it was read from.
    fn tables(&self) -> Vec<&Arc<Source>> {
        Vec::new()
    }

    /// Names that no other spec may have, each with what it names.
    fn names(&self) -> Vec<(&'static str, &str)> {
        vec![(Self::KIND, self.about().name)]
    }

    /// Checks what only shows among all specs.
    fn check(&self, _all: &[&OfAnyKind]) -> Result<(), Diagnostics> {
        Ok(())
    }
}

/// Another spec, whose kernels may be called.
#[derive(Clone, Copy)]
pub(crate) struct Other<'a> {
    pub(crate) spec: &'a OfAnyKind,
    pub(crate) programs: &'a OfAnyKind,
    /// The module of its kernels; empty for a spec of the same kind, which is written at the same time.
    pub(crate) text: &'a str,
}

impl<'a> Other<'a> {
    /// The spec, its programs and its text, if it is of this kind.
    pub(super) fn of<K: SpecKind>(&self) -> Option<(&'a K, &'a K::Programs, &'a str)> {
        let spec = self.spec.downcast_ref()?;
        Some((spec, self.programs.downcast_ref()?, self.text))
    }
}

/// A kind of spec.
#[derive(Debug)]
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
    /// See `SpecKind::EFFORT`.
    pub(crate) effort: usize,
    /// Whether other kinds call its kernels.
    pub(crate) called: bool,
}

impl Kind {
    pub(super) const fn of<K: SpecKind>() -> Kind {
        Kind {
            name: K::KIND,
            title: K::TITLE,
            shape: K::SHAPE,
            folder: K::FOLDER,
            registry: K::REGISTRY,
            entry: K::ENTRY,
            effort: K::EFFORT,
            called: K::CALLED,
        }
    }
}

/// What every spec says about itself.
#[derive(Debug)]
pub struct About<'a> {
    /// The name by which others refer to it.
    pub name: &'a str,
    /// One line for people.
    pub title: &'a str,
    /// Paper and equation, standard, or book.
    pub reference: &'a str,
    /// The file.
    pub file: &'a Arc<Source>,
    /// Other texts that its kernels were made from.
    pub beside: Vec<&'a str>,
}
