//! The machine: two reduced bodies, the motion that couples them to the rotation, springs and loads.

use whirl_specs::{Clearance, Motion};

use crate::bearing::{Bearing, SpringLaw, Springs, axis_motion};
use crate::error::Error;
use crate::loads::Load;
use crate::shaft::Shaft;
use crate::support::Support;

/// Whether θ is an unknown of the machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rotation {
    /// θ follows from its equation of motion.
    Free,
    /// θ stays 0: the frame of the shaft stands still.
    Held,
    /// The frame of the shaft stands still, and the shaft turns in it from angle 0: its coordinates are those
    /// of points that do not turn with it, such as the centre of a mass, while laws get the angle and the
    /// speed.
    Spinning {
        /// rad/s.
        speed: f64,
    },
}

/// What a machine is made from.
pub struct MachineParts {
    /// The shaft.
    pub shaft: Shaft,
    /// The support.
    pub support: Support,
    /// How rotation and deformation of the shaft are coupled.
    pub motion: &'static Motion,
    /// Whether the shaft turns.
    pub rotation: Rotation,
    /// The kernels of the clearance.
    pub clearance: &'static Clearance,
    /// The laws of the springs.
    pub laws: Vec<Box<dyn SpringLaw>>,
    /// Journals in their bores.
    pub bearings: Vec<Bearing>,
    /// External loads.
    pub loads: Vec<Load>,
}

/// A machine ready to be marched. Its coordinates are q = {θ, η, x_b}.
pub struct Machine {
    /// The shaft.
    pub shaft: Shaft,
    /// The support.
    pub support: Support,
    /// How rotation and deformation of the shaft are coupled.
    pub motion: &'static Motion,
    /// Whether the shaft turns.
    pub rotation: Rotation,
    /// The springs of all bearings.
    pub springs: Springs,
    /// External loads.
    pub loads: Vec<Load>,
    /// The outputs of each bearing.
    pub(crate) monitors: Vec<Monitor>,
}

/// How the outputs of a bearing are computed.
pub(crate) struct Monitor {
    /// Its planes of springs.
    pub(crate) planes: Vec<usize>,
    /// Whether its laws turn or brake the journal.
    pub(crate) torque: bool,
    /// Displacement of the middle journal node along x and y (frame of the shaft), as rows over η.
    pub(crate) journal: [Vec<f64>; 2],
    /// Displacement of the bore's axis in the middle ring, as the laws see it: rows over the support's
    /// coordinates.
    pub(crate) bore: [Vec<f64>; 2],
}

impl Machine {
    /// Puts a machine together.
    ///
    /// # Errors
    /// A law that takes what no spring has, bore nodes without a spline, a motion that takes a tensor
    /// which the shaft does not have; a shaft that spins in a support that is not rigid.
    pub fn new(parts: MachineParts) -> Result<Self, Error> {
        let MachineParts { shaft, support, motion, rotation, clearance, laws, bearings, loads } =
            parts;
        for tensor in motion.tensors {
            if shaft.tensor(tensor.name).is_none() {
                return Err(Error::Machine(format!(
                    "the motion {} takes a tensor called {}; a shaft has J0, y0, g0, M, Y and H",
                    motion.origin.name, tensor.name
                )));
            }
        }
        if matches!(rotation, Rotation::Spinning { .. }) && support.size() > 0 {
            let what = "a shaft that spins in a frame at rest needs a rigid support".to_owned();
            return Err(Error::Machine(what));
        }
        let springs = Springs::new(clearance, laws, &bearings, &shaft, &support)?;
        let monitors = bearings
            .iter()
            .enumerate()
            .map(|(number, bearing)| {
                let node = &shaft.nodes[bearing.journal[1]];
                let planes = springs.planes.iter().enumerate();
                let planes = planes.filter(|(_, plane)| plane.bearing == number);
                let planes: Vec<usize> = planes.map(|(place, _)| place).collect();
                Monitor {
                    torque: planes.iter().any(|&plane| springs.gives_torque(plane)),
                    planes,
                    journal: [0, 1]
                        .map(|axis| (0..shaft.size()).map(|j| node.shapes[(axis, j)]).collect()),
                    bore: axis_motion(&bearing.bore[1], &support),
                }
            })
            .collect();
        Ok(Machine { shaft, support, motion, rotation, springs, loads, monitors })
    }

    /// Number of coordinates that are marched: the 226 of the reference system.
    pub fn active(&self) -> usize {
        self.size() - self.first_unknown()
    }

    /// Place in q from which on coordinates are unknown: 0, or 1 where θ is given.
    pub fn first_unknown(&self) -> usize {
        usize::from(self.rotation != Rotation::Free)
    }

    /// Angle (rad) and speed (rad/s) of the shaft in its frame at time `t` (s).
    pub(crate) fn spin(&self, t: f64) -> Option<[f64; 2]> {
        match self.rotation {
            Rotation::Spinning { speed } => Some([speed * t, speed]),
            Rotation::Free | Rotation::Held => None,
        }
    }

    /// Places of θ, η and x_b in q: 1 + n_s + n_b.
    pub fn size(&self) -> usize {
        1 + self.shaft.size() + self.support.size()
    }

    /// What coordinate `place` of q is.
    pub(crate) fn coordinate(&self, place: usize) -> String {
        let shaft = self.shaft.size();
        match place {
            0 => "rotation angle of the shaft".to_owned(),
            _ if place <= shaft => format!("shaft, {}", self.shaft.coordinates[place - 1]),
            _ => format!("support, {}", self.support.coordinates[place - 1 - shaft]),
        }
    }

    /// The tensors of the motion, in its order.
    pub(crate) fn tensors(&self) -> Vec<&[f64]> {
        let tensor = |name| self.shaft.tensor(name).expect("checked when the machine was made");
        self.motion.tensors.iter().map(|fact| tensor(fact.name)).collect()
    }
}
