//! What the law of a plane does to the section of its journal, beside the forces in the plane.

use std::array;

use whirl_specs::{BoreMotion, ContactTangent};

use super::section::SectionMotion;
use super::springs::Springs;
use super::state::SpringState;
use crate::linalg::dot;

/// Tilts of the journal's section about x and y of its body.
const TILTS: [BoreMotion; 2] = [BoreMotion::SectionTiltX, BoreMotion::SectionTiltY];

/// A matrix over the displacement of a journal along x, y and z and its tilts about x and y.
pub(crate) type OnJournal = [[f64; 5]; 5];

impl Springs {
    /// −∂F/∂ε of what a plane does to its journal, from its tangent; zero of what its kind of law does not act on.
    pub(crate) fn on_journal(&self, plane: usize, tangent: &ContactTangent) -> OnJournal {
        let placed = &self.laws[self.planes[plane].law];
        let (law, motions) = (&placed.bound, placed.motions.len());
        let of_section = [BoreMotion::SectionZ, TILTS[0], TILTS[1]]
            .map(|wanted| law.kind.bore.iter().position(|own| *own == wanted));
        // Of the ring, or of the section.
        let place = |i: usize| match i {
            0 | 1 => (Some(1 + i), None),
            _ => (None, of_section[i - 2]),
        };
        array::from_fn(|i| {
            array::from_fn(|j| match (place(i), place(j)) {
                ((Some(i), _), (Some(j), _)) => -tangent.ring_ring[i][j],
                ((Some(i), _), (_, Some(b))) => -tangent.ring_bore[i * motions + b],
                ((_, Some(b)), (Some(j), _)) => -tangent.bore_ring[3 * b + j],
                ((_, Some(a)), (_, Some(b))) => -tangent.bore_bore[a * motions + b],
                _ => 0.0,
            })
        })
    }
}

impl SpringState {
    /// Torque on the journal about its own centre in a plane (N·m): the generalised force on θ without the
    /// moment that the forces on the displaced centre have about the axis, and without the part about the axis of a moment on
    /// the tilted section.
    pub(crate) fn plane_torque(&self, springs: &Springs, plane: usize) -> f64 {
        let own = &self.planes[plane];
        let ([_, x, y], [moment, along_x, along_y]) = (own.ring.position, own.ring_force);
        let torque = moment - (x * along_y - y * along_x);
        match TILTS.map(|tilt| self.motion_and_force(springs, plane, tilt)) {
            [Some([a_x, m_x]), Some([a_y, m_y])] => torque - (a_x * m_y - a_y * m_x),
            _ => torque,
        }
    }

    /// Moments on the journal's section about x and y of its body (N·m), of a law on tilts or on the whole joint.
    pub(crate) fn tilting_moment(&self, springs: &Springs, plane: usize) -> [f64; 2] {
        if springs.planes[plane].other.is_some() {
            let [_, x, y] = self.plane_force(plane);
            return [x, y];
        }
        TILTS.map(|tilt| self.motion_and_force(springs, plane, tilt).map_or(0.0, |[_, m]| m))
    }

    /// Force on the journal's section along z (N), of a law along z or on the whole joint.
    pub(crate) fn axial_force(&self, springs: &Springs, plane: usize) -> f64 {
        if springs.planes[plane].other.is_some() {
            return self.plane_force(plane)[1];
        }
        let found = self.motion_and_force(springs, plane, BoreMotion::SectionZ);
        found.map_or(0.0, |[_, force]| force)
    }

    /// Tilts of the journal's section against the bore's about x and y (rad), along axes that turn with the body of the
    /// bore, of a law on tilts or on the whole joint.
    pub(crate) fn tilt(&self, springs: &Springs, plane: usize) -> [f64; 2] {
        let names = match springs.planes[plane].other {
            Some(_) => ["e_x", "e_y"],
            None => ["alpha_x", "alpha_y"],
        };
        let [x, y] = names.map(|name| self.input(springs, plane, name));
        let turned = self.motion_and_force(springs, plane, BoreMotion::MeanTurn);
        let (sin, cos) = turned.map_or(0.0, |[turn, _]| turn).sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    }

    /// Displacement of the journal's section against the bore's along z (m), of a law along z or on the whole joint.
    pub(crate) fn axial(&self, springs: &Springs, plane: usize) -> f64 {
        let name = if springs.planes[plane].other.is_some() { "e_x" } else { "e_z" };
        self.input(springs, plane, name)
    }

    /// What the kind of law of a plane may take under a name, at its only spring; 0 where it may not.
    fn input(&self, springs: &Springs, plane: usize, name: &str) -> f64 {
        let plane = &springs.planes[plane];
        let law = &springs.laws[plane.law];
        let place = law.bound.kind.inputs.iter().position(|own| own.name == name);
        let row = place.map(|place| place * law.springs + plane.springs.start);
        row.map_or(0.0, |row| self.laws[plane.law].inputs[row])
    }

    /// A motion at the only spring of a plane and the generalised force on it, whether the body can move so or not; none
    /// where the kind of law has no such motion.
    fn motion_and_force(
        &self,
        springs: &Springs,
        plane: usize,
        motion: BoreMotion,
    ) -> Option<[f64; 2]> {
        let plane = &springs.planes[plane];
        let law = &springs.laws[plane.law];
        let place = law.bound.kind.bore.iter().position(|own| *own == motion)?;
        let (row, own) = (place * law.springs + plane.springs.start, &self.laws[plane.law]);
        Some([own.bore[row], own.bore_force[row]])
    }

    /// Power on the section of the journal that moves in its frame (W), by rates of q.
    pub(crate) fn power_on_section(&self, springs: &Springs, plane: usize, v: &[f64]) -> f64 {
        let plane = &springs.planes[plane];
        let law = &springs.laws[plane.law];
        let (bores, forces) = (&springs.bores[law.bores], &self.laws[plane.law].bore_force);
        let v = &v[bores.place.clone()];
        let mut power = 0.0;
        for (motion, first) in law.motions.iter().enumerate() {
            if SectionMotion::of(law.bound.kind.bore[motion]).is_none_or(|own| own.side != 0) {
                continue;
            }
            let Some(first) = *first else { continue };
            for j in plane.springs.clone() {
                let rate = dot(bores.transposed.col(first + j), v);
                power += forces[motion * law.springs + j] * rate;
            }
        }
        power
    }
}
