//! Rigid bodies given by numbers: displacements of the centre along x and y and, where it may tilt, two tilts.
//!
//! A body that turns has its coordinates in the frame that turns with it. With tilts α about x and β about y, the
//! frame turning at θ̇, T = ½I_d((α̇ − θ̇β)² + (β̇ + θ̇α)²) + ½I_p(θ̇²(1 − α² − β²) − θ̇(αβ̇ − βα̇)) to second order, so
//! that J gets (I_d − I_p)(α² + β²), and g gets (I_d − ½I_p)(−β, α).

use crate::body::BodyNode;
use crate::linalg::Matrix;
use crate::shaft::Shaft;
use crate::support::Support;

/// A rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidBody {
    /// m (kg), > 0.
    pub mass: f64,
    /// I_p (kg·m²) about the axis; of no effect on a body that does not turn.
    pub polar_inertia: f64,
    /// I_d (kg·m²) about x and y through the centre; a body without does not tilt.
    pub transverse_inertia: Option<f64>,
    /// Its centre (m), among the nodes of the body.
    pub centre: [f64; 3],
    /// To the ground along x and y (N/m), of a body that does not turn.
    pub stiffness: [f64; 2],
    /// To the ground along x and y (N·s/m), of a body that does not turn.
    pub damping: [f64; 2],
}

impl RigidBody {
    /// As a body that turns, with nodes at `positions` (m, from its axis).
    pub fn turning(&self, positions: &[[f64; 3]]) -> Shaft {
        let (mass, polar) = (self.mass, self.polar_inertia);
        // What M, Y − G, and Y and H have of each pair of coordinates.
        let mut pairs = vec![[mass, mass, mass]];
        if let Some(own) = self.transverse_inertia {
            pairs.push([own, own - polar, own - 0.5 * polar]);
        }
        let n = 2 * pairs.len();
        let diagonal = |which: usize| {
            let values: Vec<f64> = pairs.iter().flat_map(|own| [own[which]; 2]).collect();
            Matrix::from_diagonal(&values)
        };
        let mut coupling = Matrix::zeros(n, n);
        for (pair, own) in pairs.iter().enumerate() {
            let (x, y) = (2 * pair, 2 * pair + 1);
            (coupling[(x, y)], coupling[(y, x)]) = (own[2], -own[2]);
        }
        Shaft {
            j0: polar,
            y0: vec![0.0; n],
            g0: vec![0.0; n],
            mass: diagonal(0),
            stiffness: Matrix::zeros(n, n),
            damping: Matrix::zeros(n, n),
            spin_inertia: diagonal(2),
            spin_net: diagonal(1),
            spin_coupling: coupling,
            hertz: Vec::new(),
            coordinates: self.names(),
            nodes: positions.iter().map(|&position| self.node(position, &[1.0; 4])).collect(),
            measures: Vec::new(),
        }
    }

    /// As a body that does not turn, with nodes at `positions` (m).
    pub fn standing(&self, positions: &[[f64; 3]]) -> Support {
        let own = self.transverse_inertia.unwrap_or(1.0);
        let inertias = [self.mass, self.mass, own, own];
        let scales = inertias.map(|inertia| 1.0 / inertia.sqrt());
        let n = self.names().len();
        let by_mass = |values: [f64; 2]| {
            let values = [values[0] / self.mass, values[1] / self.mass, 0.0, 0.0];
            values[..n].to_vec()
        };
        Support {
            stiffness: by_mass(self.stiffness),
            damping: by_mass(self.damping),
            hertz: Vec::new(),
            coordinates: self.names(),
            nodes: positions.iter().map(|&position| self.node(position, &scales)).collect(),
            measures: Vec::new(),
        }
    }

    fn names(&self) -> Vec<String> {
        let all = ["centre x", "centre y", "tilt about x", "tilt about y"];
        let count = if self.transverse_inertia.is_some() { 4 } else { 2 };
        all[..count].iter().map(|&name| name.to_owned()).collect()
    }

    /// A node that moves with the body; `scales`: displacement or tilt by a unit of each coordinate.
    fn node(&self, position: [f64; 3], scales: &[f64; 4]) -> BodyNode {
        let [x, y, z] = [0, 1, 2].map(|axis| position[axis] - self.centre[axis]);
        let columns = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -z, y], [z, 0.0, -x]];
        let n = self.names().len();
        let shapes = Matrix::from_fn(3, n, |i, j| scales[j] * columns[j][i]);
        BodyNode { position, shapes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn body() -> RigidBody {
        RigidBody {
            mass: 4.0,
            polar_inertia: 0.5,
            transverse_inertia: Some(0.25),
            centre: [0.1, 0.0, 0.2],
            stiffness: [1e4, 2e4],
            damping: [8.0, 0.0],
        }
    }

    #[test]
    fn nodes_move_as_a_rigid_body_does() {
        let position = [0.3, -0.1, 0.5];
        let shapes = &body().turning(&[position]).nodes[0].shapes;
        // α × r and β × r, with r from the centre.
        let expected = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -0.3, -0.1], [0.3, 0.0, -0.2]];
        for (j, column) in expected.iter().enumerate() {
            for (i, value) in column.iter().enumerate() {
                assert!((shapes[(i, j)] - value).abs() < 1e-15, "{i} {j}");
            }
        }
    }

    #[test]
    fn a_standing_body_has_its_mass_and_its_springs() {
        let body = RigidBody { transverse_inertia: None, ..body() };
        let standing = body.standing(&[[0.0; 3]]);
        assert_eq!(standing.stiffness, [2500.0, 5000.0]);
        assert_eq!(standing.damping, [2.0, 0.0]);
        assert_eq!(standing.nodes[0].shapes[(1, 1)].powi(2), 0.25);
    }

    /// The energy of the motion specs with these tensors is that of the angular velocity in the axes of the body.
    #[test]
    fn the_energy_of_tilts_is_that_of_a_rigid_body() {
        let body = body();
        let shaft = body.turning(&[]);
        let (tilt, rate, speed) = ([3e-4, -2e-4], [5e-2, 7e-2], 40.0);
        let (eta, eta_dot) = ([0.0, 0.0, tilt[0], tilt[1]], [0.0, 0.0, rate[0], rate[1]]);
        let product = |matrix: &Matrix, a: &[f64; 4], b: &[f64; 4]| -> f64 {
            (0..4)
                .flat_map(|i| (0..4).map(move |j| (i, j)))
                .map(|(i, j)| a[i] * matrix[(i, j)] * b[j])
                .sum()
        };
        // g = g0 − Hη, so that g·η̇ = −η̇ᵀHη.
        let found = 0.5 * speed * speed * product(&shaft.spin_net, &eta, &eta)
            - speed * product(&shaft.spin_coupling, &eta_dot, &eta)
            + 0.5 * product(&shaft.mass, &eta_dot, &eta_dot);
        let own = body.transverse_inertia.unwrap_or_default();
        let across = (rate[0] - speed * tilt[1]).powi(2) + (rate[1] + speed * tilt[0]).powi(2);
        let along = -speed * speed * (tilt[0].powi(2) + tilt[1].powi(2))
            - speed * (tilt[0] * rate[1] - tilt[1] * rate[0]);
        let exact = 0.5 * own * across + 0.5 * body.polar_inertia * along;
        assert!((found / exact - 1.0).abs() < 1e-12, "{found} for {exact}");
    }
}
