//! Joints whose stiffness and damping depend on the frequency of small motions.
//!
//! The equations are those of what stands still; such a joint adds to them Pᵀ (K(ν) − K(0)) P and Pᵀ (C(ν) − C(0)) P at the
//! frequency ν, P its displacement along x and y of space.

use std::borrow::Cow;

use super::linearised::{Linearised, Standstill};
use super::round::LinearMachine;
use crate::bearing::{Coefficients, OverFrequency};
use crate::error::Error;
use crate::linalg::Matrix;

/// A joint whose coefficients depend on the frequency.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Dependent {
    /// Its place among the joints.
    pub(super) joint: usize,
    /// Displacement of the journal along x and y of space by a unit of each coordinate.
    pub(super) rows: [Vec<f64>; 2],
    /// Its coefficients at the speed of the state.
    pub(super) over: OverFrequency,
}

impl Dependent {
    /// Adds what it does at a frequency beside what it does at rest to C′ and K′.
    pub(super) fn add(&self, frequency: f64, damping: &mut Matrix, stiffness: &mut Matrix) {
        let (own, still) = (self.over.at(frequency), self.over.still());
        let more: Coefficients = std::array::from_fn(|place| own[place] - still[place]);
        for (first, matrix) in [(0, stiffness), (4, damping)] {
            let [xx, xy, yx, yy] = [0, 1, 2, 3].map(|place| more[first + place]);
            let [x, y] = &self.rows;
            for j in 0..x.len() {
                let along = [xx * x[j] + xy * y[j], yx * x[j] + yy * y[j]];
                if along == [0.0; 2] {
                    continue;
                }
                let column = matrix.col_mut(j).iter_mut().zip(x.iter().zip(y));
                column.for_each(|(sum, (x, y))| *sum += along[0] * x + along[1] * y);
            }
        }
    }
}

impl Linearised {
    /// Whether coefficients of joints depend on the frequency of the motion.
    pub fn depends_on_frequency(&self) -> bool {
        !self.dependent.is_empty()
    }

    /// The equations with the coefficients that joints have at a frequency (rad/s): exact for motions of that frequency.
    pub fn at_frequency(&self, frequency: f64) -> Cow<'_, Linearised> {
        if !self.depends_on_frequency() {
            return Cow::Borrowed(self);
        }
        let mut own = Linearised { dependent: Vec::new(), ..self.clone() };
        for joint in &self.dependent {
            joint.add(frequency, &mut own.damping, &mut own.stiffness);
        }
        Cow::Owned(own)
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
}
