//! Laws as a kind of spec.

use std::sync::Arc;

use super::LawSpec;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source, suggest};
use crate::spec::clearance::ClearanceSpec;
use crate::spec::kind::{About, Beside, OfAnyKind, SpecKind};
use crate::units::{Dimension, Unit};

impl SpecKind for LawSpec {
    const KIND: &'static str = "law";
    const FOLDER: &'static str = "laws";
    const REGISTRY: &'static str = "laws";
    const ENTRY: &'static str = "Law";

    fn read_with(file: &Arc<Source>, beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        LawSpec::read_with(file, beside)
    }

    fn about(&self) -> About<'_> {
        let LawSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: self.texts().skip(1).collect() }
    }

    fn tables(&self) -> Vec<&Arc<Source>> {
        self.tables.iter().map(|table| &table.file).collect()
    }

    /// Clearances give what it takes and take what it gives.
    fn check(&self, all: &[&OfAnyKind]) -> Result<(), Diagnostics> {
        let mut errors = Diagnostics::new();
        for clearance in all.iter().filter_map(|spec| spec.downcast_ref::<ClearanceSpec>()) {
            check_names(self, clearance, &mut errors);
        }
        errors.into_result(())
    }
}

fn check_names(law: &LawSpec, clearance: &ClearanceSpec, errors: &mut Diagnostics) {
    let kinds = || clearance.contacts_of(law.acts.word());
    let inputs: Vec<_> =
        kinds().flat_map(|kind| &kind.inputs).map(|i| (&i.name, &i.unit)).collect();
    let forces: Vec<_> =
        kinds().flat_map(|kind| &kind.forces).map(|f| (&f.name, &f.unit)).collect();
    let taken = law.inputs.iter().map(|own| (&own.name, own.unit.dimension(), "gives", &inputs));
    let given = law.outputs.iter().map(|own| (&own.name, own.unit.dimension(), "takes", &forces));
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
