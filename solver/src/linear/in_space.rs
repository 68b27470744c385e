//! How points of bodies move in small motions, seen from space.

use num_complex::Complex64;

use super::linearised::Standstill;
use super::round::LinearMachine;
use crate::body::BodyNode;

impl LinearMachine {
    /// w (m, along x, y, z of space) of points of a body in a motion Re(w e^{λt}), by its shape over the coordinates of
    /// [`super::Linearised`] as space sees them. Points of a body that turns are those that stand where its nodes are at θ = 0.
    pub fn moved(
        &self,
        at: &Standstill,
        (body, points): (usize, &[BodyNode]),
        shape: &[Complex64],
    ) -> Vec<[Complex64; 3]> {
        let own = &shape[self.block(at.angles.len(), body)];
        let place = &self.machine.places()[body];
        let angle = at.angles.iter().position(|own| Some(*own) == place.rotation);
        // An angle turns the body with the displacement in which it stands.
        let turned = angle.map(|angle| {
            let stands = &at.found.state.q[place.flexible.clone()];
            (shape[angle], self.in_space(at, body, stands))
        });
        let moved = |point: &BodyNode| {
            let along = |axis: usize, by: &dyn Fn(usize) -> Complex64| -> Complex64 {
                (0..own.len()).map(|j| point.shapes[(axis, j)] * by(j)).sum()
            };
            let mut moved = [0, 1, 2].map(|axis| along(axis, &|j| own[j]));
            if let Some((angle, stands)) = &turned {
                let [x, y] =
                    [0, 1].map(|axis| point.position[axis] + along(axis, &|j| stands[j].into()).re);
                moved[0] -= angle * y;
                moved[1] += angle * x;
            }
            moved
        };
        points.iter().map(moved).collect()
    }
}
