//! All kinds of specs.

use std::sync::Arc;

use super::clearance::{self, ClearanceSpec};
use super::element::{self, ElementSpec};
use super::film::{self, FilmSpec};
use super::form::{self, FormSpec};
use super::kind::{About, ByKind, Kind};
use super::law::{self, LawSpec};
use super::motion::{self, MotionSpec};
use super::page::Page;
use super::read::FindFile;
use crate::diagnostic::{Diagnostics, Source};
use crate::document::Document;

/// What each kind is.
pub const KINDS: ByKind<Kind> = ByKind {
    forms: form::KIND,
    elements: element::KIND,
    laws: law::KIND,
    motions: motion::KIND,
    clearances: clearance::KIND,
    films: film::KIND,
};

/// How a file of each kind is read.
const READERS: ByKind<fn(&Arc<Source>, &FindFile<'_>) -> Result<Spec, Diagnostics>> = ByKind {
    forms: |file, _| FormSpec::read(file).map(Box::new).map(Spec::Form),
    elements: |file, _| ElementSpec::read(file).map(Box::new).map(Spec::Element),
    laws: |file, beside| LawSpec::read_with(file, beside).map(Box::new).map(Spec::Law),
    motions: |file, _| MotionSpec::read(file).map(Box::new).map(Spec::Motion),
    clearances: |file, _| ClearanceSpec::read(file).map(Box::new).map(Spec::Clearance),
    films: |file, _| FilmSpec::read(file).map(Box::new).map(Spec::Film),
};

/// The specs of a project, a list a kind.
#[derive(Debug, Default)]
pub(crate) struct Specs {
    pub(crate) forms: Vec<FormSpec>,
    pub(crate) elements: Vec<ElementSpec>,
    pub(crate) laws: Vec<LawSpec>,
    pub(crate) motions: Vec<MotionSpec>,
    pub(crate) clearances: Vec<ClearanceSpec>,
    pub(crate) films: Vec<FilmSpec>,
}

impl Specs {
    pub(crate) fn push(&mut self, spec: Spec) {
        match spec {
            Spec::Form(form) => self.forms.push(*form),
            Spec::Element(element) => self.elements.push(*element),
            Spec::Law(law) => self.laws.push(*law),
            Spec::Motion(motion) => self.motions.push(*motion),
            Spec::Clearance(clearance) => self.clearances.push(*clearance),
            Spec::Film(film) => self.films.push(*film),
        }
    }
}

/// A spec that was read without errors, with all that follows from it.
#[derive(Debug)]
pub enum Spec {
    /// Bilinear forms.
    Form(Box<FormSpec>),
    /// A finite element.
    Element(Box<ElementSpec>),
    /// A bearing law.
    Law(Box<LawSpec>),
    /// The motion of a shaft.
    Motion(Box<MotionSpec>),
    /// The clearance of springs.
    Clearance(Box<ClearanceSpec>),
    /// An oil film.
    Film(Box<FilmSpec>),
}

/// The same with a spec, whatever its kind.
macro_rules! whatever {
    ($own:expr, $spec:ident => $of_it:expr) => {
        match $own {
            Spec::Form($spec) => $of_it,
            Spec::Element($spec) => $of_it,
            Spec::Law($spec) => $of_it,
            Spec::Motion($spec) => $of_it,
            Spec::Clearance($spec) => $of_it,
            Spec::Film($spec) => $of_it,
        }
    };
}

impl Spec {
    /// Reads a file of the kind that it says, which must be one of those called `kinds`.
    ///
    /// # Errors
    /// Everything wrong with it, each with its place.
    pub fn read(
        file: &Arc<Source>,
        kinds: &[&'static str],
        beside: &FindFile<'_>,
    ) -> Result<Spec, Diagnostics> {
        let document = Document::parse(file);
        let kind = if document.is_toml() { document.kind(kinds) } else { None };
        let kind = document.into_result(kind)?;
        let mut readers = KINDS.in_order().into_iter().zip(READERS.in_order());
        let (_, read) = readers.find(|(own, _)| own.name == kind).expect("a kind of the list");
        read(file, beside)
    }

    /// What kind of spec it is.
    pub fn kind(&self) -> Kind {
        match self {
            Spec::Form(_) => KINDS.forms,
            Spec::Element(_) => KINDS.elements,
            Spec::Law(_) => KINDS.laws,
            Spec::Motion(_) => KINDS.motions,
            Spec::Clearance(_) => KINDS.clearances,
            Spec::Film(_) => KINDS.films,
        }
    }

    /// What it says about itself.
    pub fn about(&self) -> About<'_> {
        whatever!(self, spec => spec.about())
    }

    /// Names that no other spec may have, each with what it names.
    pub(crate) fn names(&self) -> Vec<(&'static str, &str)> {
        match self {
            Spec::Form(form) => form.names(),
            Spec::Element(element) => element.names(),
            Spec::Law(_) | Spec::Motion(_) | Spec::Clearance(_) | Spec::Film(_) => {
                vec![(self.kind().name, self.about().name)]
            }
        }
    }

    /// Writes what was found about it when it was read.
    pub fn report(&self, page: &mut Page) {
        whatever!(self, spec => spec.report(page));
    }

    /// Writes all that it says and all that follows from it, but its code.
    pub fn explain(&self, page: &mut Page) {
        whatever!(self, spec => spec.explain(page));
    }
}
