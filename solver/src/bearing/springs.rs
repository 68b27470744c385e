//! All springs of a machine.

use whirl_specs::{BoreMotion, ContactVariable};

use super::bores::Bores;
use super::placed_law::PlacedLaw;
use super::plane::Plane;
use super::valid::{Measure, Measures};
use crate::linalg::Matrix;

/// All springs of a machine, law after law.
pub struct Springs {
    /// Number of bearings and stops.
    pub(crate) bearings: usize,
    pub(crate) laws: Vec<PlacedLaw>,
    pub(crate) planes: Vec<Plane>,
    /// The bores of every body that has some.
    pub(crate) bores: Vec<Bores>,
    /// √Σ of the squares of how far a unit of each coordinate of q moves the springs (a rotation: at the farthest
    /// node of its body that is known). A force that is missing at every spring in its own way is missing as this many
    /// in the coordinate's row.
    pub(crate) reach: Vec<f64>,
    /// How far the journal moves in a plane by a unit of a coordinate, in the direction in which it does (planes ×
    /// q; rotations have none).
    pub(super) arms: Matrix,
    /// Where the laws may be believed.
    pub(super) measures: Measures,
}

impl Springs {
    /// Number of springs; a law that acts once a plane has one there.
    pub fn count(&self) -> usize {
        self.laws.iter().map(|law| law.springs).sum()
    }

    /// Number of states of all laws, one a spring each.
    pub(crate) fn states(&self) -> usize {
        self.laws.iter().map(|law| law.bound.states.len() * law.springs).sum()
    }

    /// Whether a journal has a run-out.
    pub(crate) fn have_run_out(&self) -> bool {
        self.planes.iter().any(|plane| plane.run_out != [0.0; 2])
    }

    /// The first plane whose law has states, among those that are asked for.
    pub(crate) fn remembering(&self, asked: impl Fn(&Plane) -> bool) -> Option<&Plane> {
        let states = |plane: &&Plane| !self.laws[plane.law].bound.states.is_empty();
        self.planes.iter().filter(states).find(|plane| asked(plane))
    }

    /// The first plane that has a film, among those that are asked for.
    pub(crate) fn with_film(&self, asked: impl Fn(&Plane) -> bool) -> Option<&Plane> {
        let film = |plane: &&Plane| self.laws[plane.law].bound.law.film().is_some();
        self.planes.iter().filter(film).find(|plane| asked(plane))
    }

    /// The bearing of a force among those tested for convergence.
    pub(crate) fn bearing_of(&self, force: usize) -> Option<usize> {
        let mut first = 0;
        let law = self.laws.iter().position(|law| {
            let count = law.bound.forces.len() * law.springs;
            let found = force < first + count;
            first += if found { 0 } else { count };
            found
        })?;
        let spring = (force - first) % self.laws[law].springs;
        let own = &self.planes[self.laws[law].planes.clone()];
        own.iter().find(|plane| plane.springs.contains(&spring)).map(|plane| plane.bearing)
    }

    /// Number of forces tested for convergence: every force that a law gives, at every spring.
    pub(crate) fn forces(&self) -> usize {
        self.laws.iter().map(|law| law.bound.forces.len() * law.springs).sum()
    }

    /// Values of the law that has the most, with so many rows a law and a value a spring.
    pub(super) fn most(&self, rows: impl Fn(&PlacedLaw) -> usize) -> usize {
        self.laws.iter().map(|law| rows(law) * law.springs).max().unwrap_or(0)
    }

    /// Whether any law depends on how fast a bore moves.
    pub(crate) fn needs_rates(&self) -> bool {
        self.laws.iter().any(|law| law.bound.needs_rates())
    }

    /// Whether the law of a plane turns or brakes the journal: by a moment, or by a force at its surface.
    pub(crate) fn gives_torque(&self, plane: usize) -> bool {
        let law = &self.laws[self.planes[plane].law].bound;
        let mut forces = law.forces.iter().map(|&place| &law.kind.forces[place]);
        // What tilts acts through no turn of the section.
        let turns = |force: &ContactVariable| {
            force.bore.iter().any(|&motion| law.kind.bore[motion] == BoreMotion::SectionTurn)
        };
        forces.any(|force| force.radius || force.unit != "N" && turns(force))
    }

    /// Whether the law of a plane gives a force or a moment on a motion of a bore or a section.
    pub(crate) fn acts_on(&self, plane: usize, motion: BoreMotion) -> bool {
        let law = &self.laws[self.planes[plane].law].bound;
        let place = law.kind.bore.iter().position(|own| *own == motion);
        let acts = |motion: usize| {
            law.forces.iter().any(|&force| law.kind.forces[force].bore.contains(&motion))
        };
        place.is_some_and(acts)
    }

    /// Whether the law of a plane gives a moment by the angle between both sides.
    pub(crate) fn may_twist(&self, plane: usize) -> bool {
        let law = &self.laws[self.planes[plane].law].bound;
        let angle = law.inputs.iter().any(|&place| law.kind.inputs[place].name == "theta");
        self.planes[plane].flank.is_some() || angle && self.gives_torque(plane)
    }

    /// The measures by which the laws of the bearings may be believed, in the order of [`SpringState::worst`](super::SpringState::worst).
    pub fn measures(&self) -> &[Measure] {
        &self.measures.all
    }
}
