//! Stiffness and damping of joints about the state that stands, in space.

use std::array;

use super::dependent::Dependent;
use super::linearised::Standstill;
use super::round::LinearMachine;
use super::varying::ANGLES;
use crate::bearing::OnJournal;
use crate::error::Error;
use crate::loads::Position;
use crate::monitor::Monitor;

/// Share of the coefficients of a joint by which they may vary with an angle unsaid.
const VARIES: f64 = 1e-4;
/// Eccentricity over clearance of a journal that stands in the middle.
const CENTRED: f64 = 1e-6;
/// Stiffness (N/m) that is none.
const NOTHING: f64 = 1e-6;

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
    /// Attitude angle (rad, −π to π), where there is a clearance and the joint carries a load: from the direction of the load
    /// to that of the eccentricity, in the sense in which the journal turns (from x to y at rest).
    pub attitude: Option<f64>,
    /// Of a law of the whole joint K and C of forces and moments against displacements and tilts, in the order x, y, z, about
    /// x, about y (N, N·m; m, rad).
    pub whole: Option<[[[f64; 5]; 5]; 2]>,
}

impl LinearMachine {
    /// Those of all joints, of what stands still where they depend on a frequency. With ε = Aᵀe of a journal that turns with Ω, ε̇ = Aᵀ(ė − ΩJe): K = A (K_ε − Ω C_ε J) Aᵀ.
    pub fn coefficients(&self, at: &Standstill) -> Vec<JointCoefficients> {
        let found = &at.found;
        let joints = self.machine.monitors.iter().zip(&found.eccentricities);
        let joints = joints.zip(found.displacements.iter().zip(&found.forces));
        let joints = joints.map(|((joint, (name, ratio)), (moved, force))| {
            let journal = joint.bodies[0];
            let theta = self.machine.places()[journal].rotation;
            let position = Position::new(theta.map_or(0.0, |theta| found.state.q[theta]));
            let speed = at.speeds[journal];
            let [stiffness, damping] = in_plane(joint, &found.tangents.planes, (position, speed));
            JointCoefficients {
                name: name.clone(),
                label: joint.label.clone(),
                stiffness,
                damping,
                displacement: *moved,
                force: *force,
                eccentricity: *ratio,
                // What stands in the middle has no direction there.
                attitude: ratio
                    .filter(|own| *own > CENTRED)
                    .and_then(|_| attitude(*moved, *force, speed)),
                whole: joint
                    .whole()
                    .map(|plane| whole(found.tangents.planes[plane], speed, position)),
            }
        });
        joints.collect()
    }
}

impl LinearMachine {
    /// The joints whose coefficients depend on the frequency, at a state.
    pub(super) fn dependent(&self, at: &Standstill) -> Result<Vec<Dependent>, Error> {
        let springs = &self.machine.springs;
        let mut found = Vec::new();
        for (joint, monitor) in self.machine.monitors.iter().enumerate() {
            for &plane in &monitor.planes {
                let plane = &springs.planes[plane];
                let law = &springs.laws[plane.law].bound.law;
                let Some(table) = law.over_frequency() else { continue };
                let speed = plane.spin.unwrap_or(at.speeds[monitor.bodies[0]]);
                let rows = self.rows(at, &self.journal(joint));
                found.push(Dependent { joint, rows, over: table.at_speed(speed)? });
            }
        }
        Ok(found)
    }

    /// Names of the joints whose coefficients depend on the frequency.
    pub fn over_frequency(&self) -> Vec<&str> {
        let springs = &self.machine.springs;
        let depends = |plane: &usize| {
            let law = &springs.laws[springs.planes[*plane].law].bound.law;
            law.over_frequency().is_some()
        };
        let joints = self.machine.monitors.iter();
        let joints = joints.filter(|own| own.planes.iter().any(depends));
        joints.map(|own| own.name.as_str()).collect()
    }

    /// Names of the joints whose laws have states: their coefficients are those of motions that are slow beside these.
    pub fn with_states(&self) -> Vec<&str> {
        let springs = &self.machine.springs;
        let has = |plane: &usize| !springs.laws[springs.planes[*plane].law].bound.states.is_empty();
        let joints = self.machine.monitors.iter();
        let joints = joints.filter(|own| own.planes.iter().any(has));
        joints.map(|own| own.name.as_str()).collect()
    }

    /// The same at a frequency (rad/s), where they depend on it.
    ///
    /// # Errors
    /// None of a machine that was made.
    pub fn coefficients_at(
        &self,
        at: &Standstill,
        frequency: f64,
    ) -> Result<Vec<JointCoefficients>, Error> {
        let mut all = self.coefficients(at);
        for own in self.dependent(at)? {
            let [a, b, c, d, e, f, g, h] = own.over.at(frequency);
            let joint = &mut all[own.joint];
            (joint.stiffness, joint.damping) = ([[a, b], [c, d]], [[e, f], [g, h]]);
        }
        Ok(all)
    }
}

impl LinearMachine {
    /// Joints whose coefficients at a state depend on the angle of a body that turns, such as that of balls: names of the joint and of
    /// the body of its journal, or of its bore, with the largest share by which an entry differs.
    pub fn varying_joints(&self, at: &Standstill) -> Vec<(String, String, f64)> {
        let machine = self.machine_of(at);
        let theta = |body: usize| machine.places()[body].rotation;
        let joints: Vec<&Monitor> = (machine.monitors.iter())
            .filter(|joint| joint.bodies.iter().any(|body| theta(*body).is_some()))
            .collect();
        let sample = |angle: f64| -> Vec<[[[f64; 2]; 2]; 2]> {
            let on = |_: usize| angle;
            let (state, tangents) = (self.turned_on(at, &on), self.tangents(machine, at, &on));
            let of = |joint: &&Monitor| {
                let journal = joint.bodies[0];
                let position = Position::new(theta(journal).map_or(0.0, |own| state.q[own]));
                in_plane(joint, &tangents.planes, (position, at.speeds[journal]))
            };
            joints.iter().map(of).collect()
        };
        // Damping at the speed of the rotation as stiffness, so that rounding of what is not there counts for nothing.
        let fastest = at.speeds.iter().map(|own| own.abs()).fold(1.0, f64::max);
        let largest = |[k, c]: &[[[f64; 2]; 2]; 2]| {
            let size = |all: &[[f64; 2]; 2]| {
                all.iter().flatten().fold(0.0, |most: f64, own| most.max(own.abs()))
            };
            size(k).max(fastest * size(c))
        };
        let apart = |[a, b]: [&[[[f64; 2]; 2]; 2]; 2]| {
            let change =
                [0, 1].map(|own| [0, 1].map(|i| [0, 1].map(|j| a[own][i][j] - b[own][i][j])));
            let scale = largest(a).max(largest(b));
            if scale > NOTHING { largest(&change) / scale } else { 0.0 }
        };
        let first = sample(0.0);
        let mut most = vec![0.0_f64; joints.len()];
        for angle in ANGLES {
            let own = sample(angle);
            let both = own.iter().zip(&first).map(|(own, first)| apart([own, first]));
            most.iter_mut().zip(both).for_each(|(most, own)| *most = most.max(own));
        }
        let varying = joints.iter().zip(most).filter(|(_, share)| *share > VARIES);
        let told = varying.map(|(joint, share)| {
            let turning = joint.bodies.iter().find(|body| theta(**body).is_some());
            let body = turning.map_or(String::new(), |own| machine.bodies[*own].name().to_owned());
            (joint.name.clone(), body, share)
        });
        told.collect()
    }
}

/// K and C of a joint in space from those of its planes, its journal at a position and a speed.
fn in_plane(
    joint: &Monitor,
    planes: &[[OnJournal; 2]],
    (position, speed): (Position, f64),
) -> [[[f64; 2]; 2]; 2] {
    let mut sums = [[[0.0; 2]; 2]; 2];
    for &plane in &joint.planes {
        for (sum, own) in sums.iter_mut().zip(&planes[plane]) {
            let cells = sum.iter_mut().zip(own).flat_map(|(sum, own)| sum.iter_mut().zip(own));
            cells.for_each(|(sum, own)| *sum += own);
        }
    }
    let [held, damping] = sums;
    // C J: the first column is the second of C, the second minus the first.
    let stiffness = [0, 1].map(|i| {
        let turned = [damping[i][1], -damping[i][0]];
        [0, 1].map(|j| held[i][j] - speed * turned[j])
    });
    [stiffness, damping].map(|own| in_space(position, own))
}

/// From the load, against the force that carries it, to the eccentricity, as a journal turns.
fn attitude(e: [f64; 2], force: [f64; 2], speed: f64) -> Option<f64> {
    let load = force.map(|own| -own);
    let (along, across) = (load[0] * e[0] + load[1] * e[1], load[0] * e[1] - load[1] * e[0]);
    let sense = if speed < 0.0 { -1.0 } else { 1.0 };
    ((along, across) != (0.0, 0.0)).then(|| (sense * across).atan2(along))
}

/// A X Aᵀ.
fn in_space(position: Position, own: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    // Rows of X turned, then columns of that.
    let rows = own.map(|row| position.to_space(row));
    let columns = [0, 1].map(|j| position.to_space([rows[0][j], rows[1][j]]));
    [0, 1].map(|i| [0, 1].map(|j| columns[j][i]))
}

/// K and C in space from K_ε and C_ε of a law of the whole joint, with displacements and tilts turned alike.
fn whole([held, damping]: [OnJournal; 2], speed: f64, position: Position) -> [OnJournal; 2] {
    // Pairs of components that turn with the journal.
    const PAIRS: [usize; 2] = [0, 3];
    let in_space = |own: OnJournal| {
        let turned = |rows: OnJournal| {
            let mut out = rows;
            for first in PAIRS {
                for j in 0..5 {
                    let pair = position.to_space([rows[first][j], rows[first + 1][j]]);
                    [out[first][j], out[first + 1][j]] = pair;
                }
            }
            out
        };
        let transposed = |own: OnJournal| array::from_fn(|i| array::from_fn(|j| own[j][i]));
        transposed(turned(transposed(turned(own))))
    };
    let mut stiffness = held;
    for (row, damping) in stiffness.iter_mut().zip(&damping) {
        for first in PAIRS {
            row[first] -= speed * damping[first + 1];
            row[first + 1] += speed * damping[first];
        }
    }
    [in_space(stiffness), in_space(damping)]
}
