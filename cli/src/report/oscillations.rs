//! What oscillates: displacements of the journals, and what else a case wants, with the angles that orders count by.

use whirl_solver::machine::Machine;
use whirl_solver::output::Owner;

use crate::case::{Case, JointKind};

/// Quantities of one kind that belong together, such as X and Y of a journal.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Oscillation {
    /// The support, the joint or the output.
    pub(crate) title: String,
    /// What it is, such as `displacement`.
    pub(crate) quantity: &'static str,
    /// Its unit.
    pub(crate) unit: String,
    /// Columns of the history, each with what it is called by in figures.
    pub(crate) columns: Vec<(String, &'static str)>,
    /// The column of the angle about which its orders are counted: that of its body or, if it stands, of the first body
    /// that turns; none where nothing turns.
    pub(crate) angle: Option<String>,
}

/// All of a case.
pub(crate) fn oscillations(case: &Case, machine: &Machine) -> Vec<Oscillation> {
    let mut all = Vec::new();
    for (place, own) in case.supports().iter().enumerate() {
        // Stops are all around one mass, and a coupling does not move.
        let shown = match spin(case) {
            Some(spins) => place == 0 && spins,
            None => case.machine.joints[place].kind != JointKind::Coupling,
        };
        if shown {
            all.push(Oscillation {
                title: own.title.clone(),
                quantity: "displacement",
                unit: "µm".to_owned(),
                columns: ["X", "Y"].map(|axis| (own.column(axis, "um"), axis)).to_vec(),
                angle: angle(case, machine, journal(case, place)),
            });
        }
    }
    for output in machine.outputs() {
        let Some((quantity, axes)) = output.what.oscillates() else { continue };
        let body = match output.what.owner() {
            Owner::Body(body) => body,
            Owner::Joint(joint) => journal(case, joint),
        };
        let columns = output.described();
        // A joint may have the name as well.
        let is_joint = all.iter().any(|own| own.title == output.name);
        let title = if is_joint { format!("output {}", output.name) } else { output.name.clone() };
        all.push(Oscillation {
            title,
            quantity,
            unit: columns.first().map_or("", |own| shown_unit(&own.unit)).to_owned(),
            columns: columns.into_iter().map(|own| own.name).zip(axes).collect(),
            angle: angle(case, machine, body),
        });
    }
    all
}

/// A unit as people write it.
pub(crate) fn shown_unit(unit: &str) -> &str {
    match unit {
        "um" => "µm",
        "N*m" => "N·m",
        "m/s^2" => "m/s²",
        other => other,
    }
}

/// The body of the journal of a support or joint.
fn journal(case: &Case, place: usize) -> usize {
    case.machine.joints[place].sides[0].body.unwrap_or(0)
}

/// Whether the one mass of a case turns; none of other machines.
fn spin(case: &Case) -> Option<bool> {
    case.machine.is_mass().then(|| case.machine.bodies[0].spin().is_some())
}

/// The column of the angle of a body, or of the first one that turns.
pub(crate) fn angle(case: &Case, machine: &Machine, body: usize) -> Option<String> {
    if spin(case) == Some(false) {
        return None;
    }
    let first = machine.turning().next()?;
    Some(match machine.turning().any(|own| own == body) && body != first {
        true => format!("theta_{}_rad", machine.bodies[body].name()),
        false => "theta_rad".to_string(),
    })
}
