//! A machine as linear analyses take it: its bodies exactly round.

use std::ops::Range;

use crate::bodies::{Body, Rotation};
use crate::error::Error;
use crate::linalg::{Matrix, multiply};
use crate::machine::Machine;
use crate::roundness::Roundness;

/// A machine whose turning bodies have the means of their tensors over turns.
pub struct LinearMachine {
    pub(super) machine: Machine,
    /// As it is: at rest nothing needs to be round.
    pub(super) still: Machine,
    /// By body S and S², of one that turns.
    pub(super) generators: Vec<Option<[Matrix; 2]>>,
    /// By body S of one that stands, as far as its rows show how it turns.
    pub(super) senses: Vec<Option<Matrix>>,
    /// By body how round it was, of one that turns.
    pub(super) roundness: Vec<Option<Roundness>>,
}

impl LinearMachine {
    /// Makes the bodies round, and leaves out what turns with them: unbalance.
    ///
    /// # Errors
    /// A body that turns and is not round.
    pub fn new(mut machine: Machine) -> Result<LinearMachine, Error> {
        let still = machine.clone();
        let (mut generators, mut senses, mut all) = (Vec::new(), Vec::new(), Vec::new());
        for body in &mut machine.bodies {
            let Body::Turning { name, shaft, rotation } = body else {
                let support = body.support().expect("a body that stands");
                senses.push(support.roundness().ok().map(|own| own.generator));
                generators.push(None);
                all.push(None);
                continue;
            };
            let roundness = shaft.roundness()?;
            let generator = if turns(rotation) {
                if !roundness.is_round_at(0.0) {
                    let (body, lack) = (name.clone(), roundness.lack());
                    return Err(Error::NotRound { body, lack });
                }
                roundness.generator.clone()
            } else {
                // Its frame stands, and so do its coordinates.
                roundness.generator.clone()
            };
            let square = multiply(generator.view(), generator.view());
            if turns(rotation) {
                *shaft = shaft.mean_over_turns(&generator, &square);
            }
            senses.push(None);
            generators.push(Some([generator, square]));
            all.push(Some(roundness));
        }
        Ok(LinearMachine { machine, still, generators, senses, roundness: all })
    }

    /// The machine with its round bodies.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// How round a body was, if it turns.
    pub fn roundness(&self, body: usize) -> Option<&Roundness> {
        self.roundness[body].as_ref()
    }

    /// Speeds of all bodies with body `of` at `speed` (rad/s): those of `ratios` by their ratio to it, others with a given
    /// speed in the ratio in which the machine has them, where it has one; of those left the speed is to be found.
    pub fn speeds(&self, of: usize, speed: f64, ratios: &[Option<f64>]) -> Vec<Option<f64>> {
        let given = |body: usize| {
            let rotation = self.machine.bodies[body].rotation()?;
            rotation.given(0.0, false).map(|own| own[1])
        };
        let own = given(of).filter(|own| *own != 0.0);
        let bodies = 0..self.machine.bodies.len();
        let speeds = bodies.map(|body| {
            self.machine.bodies[body].rotation().filter(|own| turns(own))?;
            if body == of {
                return Some(speed);
            }
            match (ratios.get(body).copied().flatten(), given(body), own) {
                (Some(ratio), ..) => Some(ratio * speed),
                (None, Some(other), Some(own)) => Some(other / own * speed),
                (None, other, _) => other,
            }
        });
        speeds.collect()
    }

    /// Bodies whose frames turn, by their places.
    pub fn turning(&self) -> impl Iterator<Item = usize> {
        let bodies = self.machine.bodies.iter().enumerate();
        bodies.filter(|(_, body)| body.rotation().is_some_and(turns)).map(|(place, _)| place)
    }

    /// Where the coordinates of a body stand among those of small motions, of which so many angles come first.
    pub(super) fn block(&self, angles: usize, body: usize) -> Range<usize> {
        let (place, first) = (&self.machine.places()[body].flexible, self.machine.rotations());
        angles + place.start - first..angles + place.end - first
    }
}

/// Whether the frame of a body turns.
pub(super) fn turns(rotation: &Rotation) -> bool {
    !matches!(rotation, Rotation::Held | Rotation::Spinning { .. })
}
