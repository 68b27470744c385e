//! Measures of a body: the mean motion of a set of its nodes, as rows over its coordinates.

use crate::body::BodyNode;
use crate::linalg::Matrix;

/// The rigid motion u = U + φ × (x − centre) that fits the motion of a set of nodes best.
#[derive(Debug, Clone, PartialEq)]
pub struct MeanMotion {
    /// Weighted mean of the nodes' positions (m).
    pub centre: [f64; 3],
    /// U along x, y, z by a unit of each coordinate of the body: 3 × n.
    pub displacement: Matrix,
    /// φ about x, y, z by a unit of each coordinate (rad): 3 × n. Zero about a line on which all nodes stand.
    pub rotation: Matrix,
}

/// Share of the largest second moment of the nodes below which they stand on a line, or at one place.
const ON_A_LINE: f64 = 1e-9;

impl MeanMotion {
    /// Of nodes with weights, such as the areas that belong to them; none without nodes of weight.
    pub fn of(nodes: &[(&BodyNode, f64)]) -> Option<MeanMotion> {
        let total: f64 = nodes.iter().map(|(_, weight)| weight).sum();
        let (first, _) = nodes.first().filter(|_| total > 0.0)?;
        let n = first.shapes.cols;
        let mean = |of: &dyn Fn(&BodyNode) -> f64| {
            nodes.iter().map(|(node, weight)| weight * of(node)).sum::<f64>() / total
        };
        let centre = [0, 1, 2].map(|axis| mean(&|node| node.position[axis]));
        let arm = |node: &BodyNode| [0, 1, 2].map(|axis| node.position[axis] - centre[axis]);
        // Σ w (r² 1 − r rᵀ)/Σ w, whose inverse turns Σ w r×u into φ.
        let moment = |i: usize, j: usize| {
            mean(&|node| {
                let r = arm(node);
                let square: f64 = r.iter().map(|x| x * x).sum();
                f64::from(u8::from(i == j)) * square - r[i] * r[j]
            })
        };
        let inverse = pseudo_inverse([0, 1, 2].map(|i| [0, 1, 2].map(|j| moment(i, j))));
        let mut displacement = Matrix::zeros(3, n);
        let mut rotation = Matrix::zeros(3, n);
        for j in 0..n {
            let moved = |node: &BodyNode| [0, 1, 2].map(|axis| node.shapes[(axis, j)]);
            let about = [0, 1, 2].map(|axis| {
                let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                mean(&|node| {
                    arm(node)[next] * moved(node)[last] - arm(node)[last] * moved(node)[next]
                })
            });
            for i in 0..3 {
                displacement[(i, j)] = mean(&|node| moved(node)[i]);
                rotation[(i, j)] = (0..3).map(|k| inverse[i][k] * about[k]).sum();
            }
        }
        Some(MeanMotion { centre, displacement, rotation })
    }

    /// The motion of a point that moves with the set: as a node at `position` (m).
    pub fn node_at(&self, position: [f64; 3]) -> BodyNode {
        let r = [0, 1, 2].map(|axis| position[axis] - self.centre[axis]);
        let shapes = Matrix::from_fn(3, self.displacement.cols, |axis, j| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let turn = |k: usize| self.rotation[(k, j)];
            self.displacement[(axis, j)] + turn(next) * r[last] - turn(last) * r[next]
        });
        BodyNode { position, shapes }
    }
}

/// The inverse of a symmetric matrix of second moments; zero along directions in which it has none.
fn pseudo_inverse(matrix: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    let whole = Matrix::from_fn(3, 3, |i, j| matrix[i][j]);
    let Ok(eigen) = crate::linalg::symmetric_eigen(&whole) else { return [[0.0; 3]; 3] };
    let largest = eigen.values.iter().copied().fold(0.0, f64::max);
    let mut inverse = [[0.0; 3]; 3];
    for (k, value) in eigen.values.iter().enumerate() {
        if *value > ON_A_LINE * largest {
            let vector = eigen.vectors.col(k);
            for i in 0..3 {
                for j in 0..3 {
                    inverse[i][j] += vector[i] * vector[j] / value;
                }
            }
        }
    }
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Nodes that move as one rigid body by three displacements and three rotations about the origin.
    fn rigid(places: &[[f64; 3]]) -> Vec<BodyNode> {
        let node = |&[x, y, z]: &[f64; 3]| {
            let rows = [
                [1.0, 0.0, 0.0, 0.0, z, -y],
                [0.0, 1.0, 0.0, -z, 0.0, x],
                [0.0, 0.0, 1.0, y, -x, 0.0],
            ];
            BodyNode { position: [x, y, z], shapes: Matrix::from_fn(3, 6, |i, j| rows[i][j]) }
        };
        places.iter().map(node).collect()
    }

    const PLACES: [[f64; 3]; 4] =
        [[0.3, 0.1, 0.2], [0.2, -0.25, 0.1], [-0.1, 0.3, 0.5], [0.28, -0.12, -0.3]];

    #[test]
    fn a_set_that_moves_as_one_body_has_its_motion() {
        let nodes = rigid(&PLACES);
        let weights = [1.0, 2.0, 0.5, 3.0];
        let weighted: Vec<(&BodyNode, f64)> = nodes.iter().zip(weights).collect();
        let mean = MeanMotion::of(&weighted).expect("four nodes");
        for place in [[0.0; 3], [0.7, -0.4, 0.9]] {
            let (found, exact) = (mean.node_at(place), &rigid(&[place])[0]);
            for (found, exact) in found.shapes.data.iter().zip(&exact.shapes.data) {
                assert!((found - exact).abs() < 1e-12, "{found} for {exact}");
            }
        }
        for j in 0..6 {
            for i in 0..3 {
                let exact = f64::from(u8::from(j == 3 + i));
                assert!((mean.rotation[(i, j)] - exact).abs() < 1e-12);
            }
        }
    }

    /// Of motions that are not rigid it is the best fit: what is left is orthogonal to every rigid motion.
    #[test]
    fn what_is_left_of_any_motion_has_no_force_and_no_moment() {
        let mut nodes = rigid(&PLACES);
        for (k, node) in nodes.iter_mut().enumerate() {
            node.shapes = Matrix::from_fn(3, 2, |i, j| (1.7 * (3 * k + i) as f64 + j as f64).sin());
        }
        let weights = [1.0, 2.0, 0.5, 3.0];
        let weighted: Vec<(&BodyNode, f64)> = nodes.iter().zip(weights).collect();
        let mean = MeanMotion::of(&weighted).expect("four nodes");
        for j in 0..2 {
            let (mut force, mut moment) = ([0.0; 3], [0.0; 3]);
            for (node, weight) in &weighted {
                let fitted = mean.node_at(node.position);
                let left =
                    [0, 1, 2].map(|i| weight * (node.shapes[(i, j)] - fitted.shapes[(i, j)]));
                let r = node.position;
                for i in 0..3 {
                    let (next, last) = ((i + 1) % 3, (i + 2) % 3);
                    force[i] += left[i];
                    moment[i] += r[next] * left[last] - r[last] * left[next];
                }
            }
            assert!(force.iter().chain(&moment).all(|x| x.abs() < 1e-12), "{force:?} {moment:?}");
        }
    }

    #[test]
    fn nodes_on_a_line_do_not_turn_about_it() {
        let nodes = rigid(&[[0.0; 3], [0.0, 0.0, 0.4]]);
        let mean = MeanMotion::of(&[(&nodes[0], 1.0), (&nodes[1], 1.0)]).expect("two nodes");
        assert!((mean.rotation[(0, 3)] - 1.0).abs() < 1e-12);
        assert!(mean.rotation[(2, 5)].abs() < 1e-12);
        assert!(MeanMotion::of(&[]).is_none() && MeanMotion::of(&[(&nodes[0], 0.0)]).is_none());
    }
}
