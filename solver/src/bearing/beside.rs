//! What joints would do if their journals stood or moved a little beside where they do.

use whirl_specs::ContactTangent;

use super::springs::Springs;
use super::state::{SpringState, TurnedRows};

/// Positions and velocities of the planes, from which journals are moved.
pub(crate) struct Poses(Vec<[[f64; 3]; 2]>);

impl SpringState {
    /// Where the journals are.
    pub(crate) fn poses(&self) -> Poses {
        Poses(self.planes.iter().map(|own| [own.position, own.velocity]).collect())
    }

    /// Moves the journal of each plane by so much along both axes of ε (m), and its rate (m/s), from where it was; all else stays.
    pub(crate) fn stand_beside(&mut self, springs: &Springs, from: &Poses, by: &[[[f64; 2]; 2]]) {
        for (plane, (pose, step)) in self.planes.iter_mut().zip(from.0.iter().zip(by)) {
            let moved =
                |own: [f64; 3], step: [f64; 2]| [own[0], own[1] + step[0], own[2] + step[1]];
            plane.position = moved(pose[0], step[0]);
            plane.velocity = moved(pose[1], step[1]);
        }
        self.films.squeezed = true;
        self.respond(springs);
        self.films.squeezed = false;
    }

    /// −∂F/∂ε and −∂F/∂ε̇ of the force of a plane on its journal, along both axes of ε; as [`SpringState::tangent`] has them.
    pub(crate) fn stiffness_and_damping(
        &mut self,
        springs: &Springs,
        plane: usize,
        rate: f64,
        out: &mut ContactTangent,
    ) -> [[[f64; 2]; 2]; 2] {
        self.slope_films(springs);
        let mut both = [0.0, rate].map(|a1| {
            self.tangent(springs, plane, a1, out, &mut TurnedRows::default());
            [1, 2].map(|i| [1, 2].map(|j| -out.ring_ring[i][j]))
        });
        let held = both[0];
        for (row, held) in both[1].iter_mut().zip(&held) {
            row.iter_mut().zip(held).for_each(|(own, held)| *own = (*own - held) / rate);
        }
        both
    }
}
