//! What oscillates: displacements of the journals, and what else a case wants, with the angles that orders count by.

use whirl_solver::machine::Machine;
use whirl_solver::output::{JointQuantity, Motion, Wanted};

use crate::case::{Case, JointKind};

/// Quantities of one kind that belong together, such as X and Y of a journal.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Oscillation {
    /// The support, the joint or the output.
    pub(crate) title: String,
    /// What it is, such as `displacement`.
    pub(crate) quantity: &'static str,
    /// Its unit.
    pub(crate) unit: &'static str,
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
                unit: "µm",
                columns: ["X", "Y"].map(|axis| (own.column(axis, "um"), axis)).to_vec(),
                angle: angle(case, machine, journal(case, place)),
            });
        }
    }
    for output in machine.outputs() {
        let (body, quantity, unit, labels): (_, _, _, &[&'static str]) = match &output.what {
            Wanted::Motion { body, motion, .. } => match motion {
                Motion::Displacement => (*body, "displacement", "µm", &["x", "y", "z"]),
                Motion::Velocity => (*body, "velocity", "mm/s", &["x", "y", "z"]),
                Motion::Acceleration => (*body, "acceleration", "m/s²", &["x", "y", "z"]),
            },
            Wanted::Joint { joint, quantity, .. } => {
                let (quantity, unit, labels): (_, _, &[&'static str]) = match quantity {
                    JointQuantity::Force => ("force", "N", &["x", "y"]),
                    JointQuantity::Deformation => ("deformation", "µm", &["x", "y"]),
                    JointQuantity::Rate => ("rate", "mm/s", &["x", "y"]),
                    JointQuantity::Torque => ("torque", "N·m", &["z"]),
                    JointQuantity::Twist => ("twist", "rad", &["z"]),
                    JointQuantity::TwistRate => ("twist rate", "rad/s", &["z"]),
                    JointQuantity::Moment => ("moment", "N·m", &["x", "y"]),
                    JointQuantity::Tilt => ("tilt", "rad", &["x", "y"]),
                    JointQuantity::AxialForce => ("axial force", "N", &["z"]),
                    JointQuantity::AxialDeformation => ("axial deformation", "µm", &["z"]),
                };
                (journal(case, *joint), quantity, unit, labels)
            }
            Wanted::Energy { .. }
            | Wanted::Power { .. }
            | Wanted::JointPower { .. }
            | Wanted::Film { .. }
            | Wanted::States { .. } => continue,
        };
        let axes: Vec<usize> = match &output.what {
            Wanted::Motion { components, .. } => components.clone(),
            _ => (0..labels.len()).collect(),
        };
        let columns = output.columns().into_iter().zip(axes.iter().map(|&axis| labels[axis]));
        all.push(Oscillation {
            title: output.name.clone(),
            quantity,
            unit,
            columns: columns.collect(),
            angle: angle(case, machine, body),
        });
    }
    all
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
