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
            let stands = self.in_space(at, body, stands);
            (shape[angle], stands.into_iter().map(Complex64::from).collect::<Vec<_>>())
        });
        let stands = turned.as_ref().map(|own| own.1.as_slice());
        let moved = |point: &BodyNode| {
            let mut moved = along(point, own);
            if let (Some((angle, _)), Some(stands)) = (&turned, stands) {
                let [x, y, _] = along(point, stands);
                moved[0] -= angle * (point.position[1] + y.re);
                moved[1] += angle * (point.position[0] + x.re);
            }
            moved
        };
        points.iter().map(moved).collect()
    }
}

/// The displacement of a point along x, y, z in a motion of its body.
fn along(point: &BodyNode, motion: &[Complex64]) -> [Complex64; 3] {
    let mut moved = [Complex64::ZERO; 3];
    for (column, by) in point.shapes.data.chunks_exact(3).zip(motion) {
        for (own, shape) in moved.iter_mut().zip(column) {
            *own += by * shape;
        }
    }
    moved
}
