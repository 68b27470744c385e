//! Stiffness and damping of joints about the state that stands, in space.

use super::linearised::Standstill;
use super::round::LinearMachine;
use crate::loads::Position;

/// What a joint does against small motions of its journal, its bore at rest: −∂F/∂e and −∂F/∂ė of the force on the journal, row
/// the force along x or y of space, column the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct JointCoefficients {
    /// Its name in messages.
    pub name: String,
    /// By what its columns are called.
    pub label: String,
    /// K (N/m).
    pub stiffness: [[f64; 2]; 2],
    /// C (N·s/m).
    pub damping: [[f64; 2]; 2],
    /// Displacement of the journal against the bore (m).
    pub displacement: [f64; 2],
    /// The force on the journal that it carries there (N).
    pub force: [f64; 2],
    /// Eccentricity over clearance, where there is one.
    pub eccentricity: Option<f64>,
}

impl LinearMachine {
    /// Those of all joints. With ε = Aᵀe of a journal that turns with Ω, ε̇ = Aᵀ(ė − ΩJe): K = A (K_ε − Ω C_ε J) Aᵀ.
    pub fn coefficients(&self, at: &Standstill) -> Vec<JointCoefficients> {
        let found = &at.found;
        let joints = self.machine.monitors.iter().zip(&found.eccentricities);
        let joints = joints.zip(found.displacements.iter().zip(&found.forces));
        let joints = joints.map(|((joint, (name, ratio)), (moved, force))| {
            let mut sums = [[[0.0; 2]; 2]; 2];
            for &plane in &joint.planes {
                for (sum, own) in sums.iter_mut().zip(&found.tangents.planes[plane]) {
                    let cells = sum.iter_mut().flatten().zip(own.iter().flatten());
                    cells.for_each(|(sum, own)| *sum += own);
                }
            }
            let journal = joint.bodies[0];
            let theta = self.machine.places()[journal].rotation;
            let position = Position::new(theta.map_or(0.0, |theta| found.state.q[theta]));
            let [held, damping] = sums;
            let speed = at.speeds[journal];
            // C J: the first column is the second of C, the second minus the first.
            let stiffness = [0, 1].map(|i| {
                let turned = [damping[i][1], -damping[i][0]];
                [0, 1].map(|j| held[i][j] - speed * turned[j])
            });
            JointCoefficients {
                name: name.clone(),
                label: joint.label.clone(),
                stiffness: in_space(position, stiffness),
                damping: in_space(position, damping),
                displacement: *moved,
                force: *force,
                eccentricity: *ratio,
            }
        });
        joints.collect()
    }
}

/// A X Aᵀ.
fn in_space(position: Position, own: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    // Rows of X turned, then columns of that.
    let rows = own.map(|row| position.to_space(row));
    let columns = [0, 1].map(|j| position.to_space([rows[0][j], rows[1][j]]));
    [0, 1].map(|i| [0, 1].map(|j| columns[j][i]))
}
