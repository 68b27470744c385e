//! Elements as a kind of spec.

use std::sync::Arc;

use super::{ElementSpec, demand};
use crate::diagnostic::{Code, Diagnostics, Source, suggest};
use crate::spec::form::{Form, FormSpec, Structure};
use crate::spec::kind::{About, Beside, OfAnyKind, SpecKind};

impl SpecKind for ElementSpec {
    const KIND: &'static str = "element";
    const FOLDER: &'static str = "elements";
    const REGISTRY: &'static str = "elements";
    const ENTRY: &'static str = "Element";

    fn read_with(file: &Arc<Source>, _beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        ElementSpec::read(file)
    }

    fn about(&self) -> About<'_> {
        let ElementSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// Its name, and the types of Abaqus and Gmsh that are read as it.
    fn names(&self) -> Vec<(&'static str, &str)> {
        let types = self.abaqus.iter().map(|name| ("Abaqus type", name.text()));
        let gmsh = self.gmsh_name.iter().map(|name| ("Gmsh type", name.as_str()));
        std::iter::once((Self::KIND, self.name.as_str())).chain(types).chain(gmsh).collect()
    }

    /// Its rules integrate what the forms multiply, and its modes go with them.
    fn check(&self, all: &[&OfAnyKind]) -> Result<(), Diagnostics> {
        let forms: Vec<&Form> = of_forms(all).flat_map(|set| &set.forms).collect();
        check_enhanced(self, &forms)?;
        check_card(self, all.iter().filter_map(|spec| spec.downcast_ref()))?;
        demand::prove(self, forms.iter().map(|form| (form.integrated_as(), form.products())))
    }
}

pub(super) fn of_forms<'a>(all: &[&'a OfAnyKind]) -> impl Iterator<Item = &'a FormSpec> {
    all.iter().filter_map(|spec| spec.downcast_ref())
}

/// A card of Nastran with so many nodes is read as one element.
fn check_card<'a>(
    element: &ElementSpec,
    mut all: impl Iterator<Item = &'a ElementSpec>,
) -> Result<(), Diagnostics> {
    let Some((card, _)) = &element.nastran else { return Ok(()) };
    let nodes = element.nodes.len();
    let same = |other: &&ElementSpec| {
        let theirs = other.nastran.as_ref();
        // Of two elements, the one with the later name is told.
        other.name < element.name
            && other.nodes.len() == nodes
            && theirs.is_some_and(|(theirs, _)| theirs.text().eq_ignore_ascii_case(card.text()))
    };
    let Some(other) = all.find(same) else { return Ok(()) };
    let message =
        format!("`{}` of {nodes} nodes is read as the element `{}`", card.text(), other.name);
    let help = "leave out `[nastran]` in one of the files";
    Err(card.error_here(Code::BAD_NAME, message).help(help).into())
}

/// Modes can be condensed out of symmetric forms only, and only out of forms that exist.
fn check_enhanced(element: &ElementSpec, forms: &[&Form]) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    for name in element.enhanced.iter().flat_map(|enhanced| &enhanced.forms) {
        let message = match forms.iter().find(|form| form.name == name.text()) {
            None => format!("there is no form `{}`", name.text()),
            Some(form) if form.structure != Structure::Symmetric => format!(
                "enhanced modes cannot be condensed out of `{}`: it is not a symmetric form that \
                 couples the components of u",
                name.text()
            ),
            Some(_) => continue,
        };
        let names: Vec<&str> = forms.iter().map(|form| form.name.as_str()).collect();
        let help = suggest(name.text(), &names);
        errors.push(name.error_here(Code::FORM, message).maybe_help(help));
    }
    errors.into_result(())
}
