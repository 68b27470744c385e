//! What marches of machines with films cannot have.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;

use super::joined_machine::JoinedMachine;
use super::joint::Joint;

/// Notes generalized-α in the table of a march of a machine with films.
pub(super) fn refuse_alpha(march: &Table, machine: &JoinedMachine) {
    let film = |joint: &&Joint| joint.bearing.law.source.film().is_some();
    let Some(joint) = machine.joints.iter().find(film) else { return };
    let message = format!(
        "the joint `{}` has a film, which goes with Newmark's method: what its nodes hold follows from the rates of that",
        joint.name.text()
    );
    let help = "leave `integrator` out, or give the joint a law in place of the film";
    march.push(march.written("integrator").error_here(Code::BAD_VALUE, message).help(help));
}
