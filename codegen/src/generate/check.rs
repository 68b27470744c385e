//! What one spec asks of others, which only shows among all.

use super::parallel;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, suggest};
use crate::kinds::clearance::ClearanceSpec;
use crate::kinds::element::{ElementSpec, demand};
use crate::kinds::film::FilmSpec;
use crate::kinds::form::{Form, Structure};
use crate::kinds::law::{Acts, LawSpec};
use crate::kinds::list::Specs;
use crate::units::{Dimension, Unit};

pub(super) fn check(specs: &Specs) -> Result<(), Diagnostics> {
    let Specs { forms, elements, laws, motions: _, clearances, films } = specs;
    let forms: Vec<&Form> = forms.iter().flat_map(|set| &set.forms).collect();
    let size = |own: &ElementSpec| own.file.text.len();
    let elements = parallel::map(elements, size, |own| element(own, &forms, elements));
    let laws = laws.iter().map(|own| law(own, clearances));
    let films = films.iter().map(|own| film(own, clearances));
    let clearances = clearances.iter().map(clearance);
    Diagnostics::all(elements.into_iter().chain(laws).chain(clearances).chain(films))?;
    Ok(())
}

/// Its rules integrate what the forms multiply, and its modes go with them.
fn element(own: &ElementSpec, forms: &[&Form], all: &[ElementSpec]) -> Result<(), Diagnostics> {
    enhanced(own, forms)?;
    card(own, all)?;
    demand::prove(own, forms.iter().map(|form| (form.integrated_as(), form.products())))
}

/// Modes can be condensed out of symmetric forms only, and only out of forms that exist.
fn enhanced(element: &ElementSpec, forms: &[&Form]) -> Result<(), Diagnostics> {
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

/// A card of Nastran with so many nodes is read as one element.
fn card(element: &ElementSpec, all: &[ElementSpec]) -> Result<(), Diagnostics> {
    let Some((card, _)) = &element.nastran else { return Ok(()) };
    let nodes = element.nodes.len();
    let same = |other: &&ElementSpec| {
        let theirs = other.nastran.as_ref();
        // Of two elements, the one with the later name is told.
        other.name < element.name
            && other.nodes.len() == nodes
            && theirs.is_some_and(|(theirs, _)| theirs.text().eq_ignore_ascii_case(card.text()))
    };
    let Some(other) = all.iter().find(same) else { return Ok(()) };
    let message =
        format!("`{}` of {nodes} nodes is read as the element `{}`", card.text(), other.name);
    let help = "leave out `[nastran]` in one of the files";
    Err(card.error_here(Code::BAD_NAME, message).help(help).into())
}

/// Clearances give what a law takes and take what it gives.
fn law(law: &LawSpec, clearances: &[ClearanceSpec]) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    clearances.iter().for_each(|clearance| names_of_law(law, clearance, &mut errors));
    errors.into_result(())
}

fn names_of_law(law: &LawSpec, clearance: &ClearanceSpec, errors: &mut Diagnostics) {
    let kinds = || clearance.contacts_of(law.acts.word());
    let inputs: Vec<_> =
        kinds().flat_map(|kind| &kind.inputs).map(|i| (&i.name, &i.unit)).collect();
    let forces: Vec<_> =
        kinds().flat_map(|kind| &kind.forces).map(|f| (&f.name, &f.unit)).collect();
    let taken = law.taken().iter().map(|own| (&own.name, own.unit.dimension(), "gives", &inputs));
    let given = law.given().iter().map(|own| (&own.name, own.unit.dimension(), "takes", &forces));
    for (name, dimension, does, known) in taken.chain(given) {
        let path = clearance.file.path.display();
        let found = known.iter().find(|(own, _)| *own == name);
        let message = match found.map(|(_, unit)| unit_of(unit)) {
            Some(unit) if dimension.fits(&unit) => continue,
            Some(unit) => format!("`{name}` is {dimension} here, but {unit} in `{path}`"),
            None => {
                let called = law.acts.called();
                format!("the clearance of `{path}` {does} no `{name}` of {called}")
            }
        };
        let names: Vec<&str> = known.iter().map(|(own, _)| own.as_str()).collect();
        let listed = || format!("of `[laws.{}]` there are {}", law.acts.word(), names.join(", "));
        let help = suggest(name, &names).unwrap_or_else(listed);
        errors.push(Diagnostic::new(&law.file, Code::UNKNOWN_NAME, None, message).help(help));
    }
}

/// What a unit of a clearance measures.
fn unit_of(text: &str) -> Dimension {
    *Unit::parse(text).unwrap_or_else(|_| panic!("clearances have units: {text}")).dimension()
}

/// Law files have names for all that a clearance says laws may take and give.
fn clearance(own: &ClearanceSpec) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    for acts in Acts::ALL {
        let known: Vec<&str> =
            acts.inputs().iter().chain(acts.outputs()).map(|quantity| quantity.name).collect();
        for contact in own.contacts_of(acts.word()) {
            let inputs = contact.inputs.iter().map(|input| &input.name);
            let names = inputs.chain(contact.forces.iter().map(|force| &force.name));
            for name in names.filter(|name| !known.contains(&name.as_str())) {
                let message = format!("law files have no quantity `{name}` for {}", acts.called());
                let error = Diagnostic::new(&own.file, Code::UNKNOWN_NAME, None, message);
                errors.push(error.help(format!("they have {}", known.join(", "))));
            }
        }
    }
    errors.into_result(())
}

/// Clearances have the measures on which a film's forces work.
fn film(film: &FilmSpec, clearances: &[ClearanceSpec]) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    for (clearance, force) in
        clearances.iter().flat_map(|own| film.forces.iter().map(move |force| (own, force)))
    {
        let names: Vec<&str> = clearance.measures.iter().map(|(name, _)| name.as_str()).collect();
        let on = force.on.text();
        if !names.contains(&on) {
            let path = clearance.file.path.display();
            let message = format!("the clearance of `{path}` has no measure `{on}`");
            errors.push(
                force.on.error_here(Code::UNKNOWN_NAME, message).maybe_help(suggest(on, &names)),
            );
        }
    }
    errors.into_result(())
}
