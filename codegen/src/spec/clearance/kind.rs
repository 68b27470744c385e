//! Clearances as a kind of spec.

use std::sync::Arc;

use super::ClearanceSpec;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::spec::kind::{About, Beside, OfAnyKind, SpecKind};
use crate::spec::law::Acts;

impl SpecKind for ClearanceSpec {
    const KIND: &'static str = "clearance";
    const FOLDER: &'static str = "motion";
    const REGISTRY: &'static str = "clearances";
    const ENTRY: &'static str = "Clearance";
    const EFFORT: usize = 20;

    fn read_with(file: &Arc<Source>, _beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        ClearanceSpec::read(file)
    }

    fn about(&self) -> About<'_> {
        let ClearanceSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// Law files have names for all that it says laws may take and give.
    fn check(&self, _all: &[&OfAnyKind]) -> Result<(), Diagnostics> {
        let mut errors = Diagnostics::new();
        for acts in Acts::ALL {
            let known: Vec<&str> =
                acts.inputs().iter().chain(acts.outputs()).map(|quantity| quantity.name).collect();
            for contact in self.contacts_of(acts.word()) {
                let inputs = contact.inputs.iter().map(|input| &input.name);
                let names = inputs.chain(contact.forces.iter().map(|force| &force.name));
                for name in names.filter(|name| !known.contains(&name.as_str())) {
                    let message =
                        format!("law files have no quantity `{name}` for {}", acts.called());
                    let help = format!("they have {}", known.join(", "));
                    let error = Diagnostic::new(&self.file, Code::UNKNOWN_NAME, None, message);
                    errors.push(error.help(help));
                }
            }
        }
        errors.into_result(())
    }
}
