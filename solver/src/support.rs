//! The reduced support: oscillators that take part in the motion of the bores.

use serde::{Deserialize, Serialize};

use crate::body::{BodyNode, BodySpec, Coordinates, Rayleigh, mode_names};
use crate::centre_of_mass::CentreOfMass;
use crate::error::Error;
use crate::linalg::{
    LinearAlgebraError, Matrix, congruence, generalised_symmetric_eigen, multiply,
};
use crate::measure::MeanMotion;
use crate::mesh::Mesh;
use crate::reduced::{BodyKind, Reduced};
use crate::reduction::{CraigBampton, hertz};
use crate::section::{self, Section};

/// A flexible support in the fixed frame as n oscillators that nothing but their forces couples:
/// ẍ_i + c_i ẋ_i + k_i x_i = f_i (masses are 1 by the scaling of the shapes).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Support {
    /// k = ω² (rad²/s²), n values.
    pub stiffness: Vec<f64>,
    /// c (1/s), n values.
    pub damping: Vec<f64>,
    /// Frequencies of the fixed-interface modes (Hz).
    pub hertz: Vec<f64>,
    /// What each coordinate is, such as `mode 1 (285.5 Hz)`.
    pub coordinates: Vec<String>,
    /// The nodes asked for, in that order.
    pub nodes: Vec<BodyNode>,
    /// The means asked for, in that order.
    pub measures: Vec<MeanMotion>,
    /// Sections, by z.
    pub sections: Vec<Section>,
    /// Its mass, and where that is.
    pub centre_of_mass: CentreOfMass,
}

/// What is seen of a support, over its coordinates.
struct Seen {
    nodes: Vec<BodyNode>,
    measures: Vec<MeanMotion>,
    sections: Vec<Section>,
    weight: CentreOfMass,
}

impl Reduced {
    /// The support, with the constraints, names, damping and nodes of the spec.
    ///
    /// # Errors
    /// Constraints that contradict each other; a mass that is not positive definite.
    ///
    /// # Panics
    /// If the spec outputs a node that this has no shapes of.
    pub fn support(&self, spec: &BodySpec) -> Result<Support, Error> {
        let active = spec.active(&self.reduction)?;
        let nodes: Vec<usize> = self.places(spec).collect();
        let nodes = nodes.iter().map(|&node| self.node(&active, node)).collect();
        let measures = self.measures(&active, spec);
        let weight = self.weight.centre_of_mass(&active);
        let sections = section::active(&self.sections, &active, spec.damping);
        let seen = Seen { nodes, measures, sections, weight };
        Ok(Support::new(&self.reduction, &active, spec.damping, seen)?)
    }
}

impl Support {
    /// Reduces the mesh of a support.
    ///
    /// # Errors
    /// As [`Reduced::new`] and [`Reduced::support`].
    pub fn from_mesh(mesh: &Mesh, spec: &BodySpec) -> Result<Support, Error> {
        Reduced::new(BodyKind::Support, mesh, spec)?.support(spec)
    }

    /// The support of a reduction. Where retained dofs stay free after elimination, its modes are
    /// those of the reduced body with these dofs free, otherwise the fixed-interface modes themselves.
    ///
    /// `seen`: over the active coordinates.
    ///
    /// # Errors
    /// The mass of the reduction is not positive definite.
    fn new(
        reduction: &CraigBampton,
        active: &Coordinates,
        damping: Rayleigh,
        mut seen: Seen,
    ) -> Result<Support, LinearAlgebraError> {
        let mass = congruence(&reduction.mass, &active.transform);
        let stiffness = congruence(&reduction.stiffness, &active.transform);
        let n = mass.rows;
        let hertz_fixed = reduction.hertz.clone();
        if mass == Matrix::identity(n) && is_diagonal(&stiffness) {
            let squares = (0..n).map(|i| stiffness[(i, i)]).collect();
            return Ok(Support::of_oscillators(
                (squares, damping),
                (active.names.clone(), hertz_fixed),
                seen,
            ));
        }
        let mut eigen =
            generalised_symmetric_eigen(&stiffness.symmetric_part(), &mass.symmetric_part())?;
        for j in 0..n {
            let column = eigen.vectors.col_mut(j);
            let largest =
                column.iter().fold(0.0, |a: f64, &b| if b.abs() > a.abs() { b } else { a });
            if largest < 0.0 {
                column.iter_mut().for_each(|value| *value = -*value);
            }
        }
        for node in seen.nodes.iter_mut().chain([&mut seen.weight.node]) {
            node.shapes = multiply(node.shapes.view(), eigen.vectors.view());
        }
        seen.measures = seen.measures.iter().map(|own| own.over(&eigen.vectors)).collect();
        seen.sections = seen.sections.iter().map(|own| own.over(&eigen.vectors)).collect();
        // A rigid motion's ω² is 0 but for rounding, of either sign.
        let squares: Vec<f64> = eigen.values.iter().map(|value| value.max(0.0)).collect();
        let frequencies: Vec<f64> = squares.iter().map(|&square| hertz(square)).collect();
        let names = mode_names(&frequencies);
        Ok(Support::of_oscillators((squares, damping), (names, hertz_fixed), seen))
    }

    fn of_oscillators(
        (squares, damping): (Vec<f64>, Rayleigh),
        (names, hertz): (Vec<String>, Vec<f64>),
        seen: Seen,
    ) -> Support {
        let Seen { nodes, measures, sections, weight } = seen;
        let support = Support::oscillators(squares, damping, names, nodes);
        Support { hertz, measures, sections, centre_of_mass: weight, ..support }
    }

    /// A support that does not move: no coordinates, and nodes at `positions` (m).
    pub fn rigid(positions: &[[f64; 3]]) -> Support {
        let node = |&position| BodyNode { position, shapes: Matrix::zeros(3, 0) };
        Support::oscillators(
            Vec::new(),
            Rayleigh::default(),
            Vec::new(),
            positions.iter().map(node).collect(),
        )
    }

    /// A point mass held by a spring and a damper a direction (x, y); its nodes at `positions` (m) all
    /// move with it.
    ///
    /// `mass`: kg, > 0; `stiffness`: N/m; `damping`: N·s/m.
    pub fn lumped(
        mass: f64,
        stiffness: [f64; 2],
        damping: [f64; 2],
        positions: &[[f64; 3]],
    ) -> Support {
        let shape = 1.0 / mass.sqrt();
        let shapes = Matrix { rows: 3, cols: 2, data: vec![shape, 0.0, 0.0, 0.0, shape, 0.0] };
        let centre = positions.first().copied().unwrap_or_default();
        let node = BodyNode { position: centre, shapes: shapes.clone() };
        Support {
            stiffness: stiffness.map(|k| k / mass).to_vec(),
            damping: damping.map(|c| c / mass).to_vec(),
            hertz: Vec::new(),
            coordinates: vec!["mass x".to_owned(), "mass y".to_owned()],
            nodes: positions
                .iter()
                .map(|&position| BodyNode { position, shapes: shapes.clone() })
                .collect(),
            measures: Vec::new(),
            sections: Vec::new(),
            centre_of_mass: CentreOfMass { mass, node },
        }
    }

    /// Number of coordinates n.
    pub fn size(&self) -> usize {
        self.stiffness.len()
    }

    fn oscillators(
        squares: Vec<f64>,
        damping: Rayleigh,
        coordinates: Vec<String>,
        nodes: Vec<BodyNode>,
    ) -> Support {
        Support {
            damping: squares.iter().map(|k| damping.alpha + damping.beta * k).collect(),
            centre_of_mass: CentreOfMass::none(squares.len()),
            stiffness: squares,
            hertz: Vec::new(),
            coordinates,
            nodes,
            measures: Vec::new(),
            sections: Vec::new(),
        }
    }
}

fn is_diagonal(matrix: &Matrix) -> bool {
    (0..matrix.cols)
        .all(|j| matrix.col(j).iter().enumerate().all(|(i, &value)| i == j || value == 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two modes and a retained dof, with coupling by inertia.
    fn reduction() -> CraigBampton {
        let mass =
            Matrix { rows: 3, cols: 3, data: vec![1.0, 0.0, 0.3, 0.0, 1.0, -0.2, 0.3, -0.2, 2.0] };
        CraigBampton {
            hertz: vec![10.0, 20.0],
            retained: vec![vec![(1, 1.0)]],
            shapes: Matrix::from_fn(3, 3, |i, j| 1.0 + (i * 3 + j) as f64),
            mass,
            stiffness: Matrix::from_diagonal(&[4e3, 1.6e4, 9e3]),
        }
    }

    /// With the one node there is.
    fn oscillators(reduction: &CraigBampton, active: &Coordinates, damping: Rayleigh) -> Support {
        let node = BodyNode::new(reduction, active, &[[0.0; 3]], 0);
        let weight = CentreOfMass { mass: 3.0, node: node.clone() };
        let seen = Seen { nodes: vec![node], measures: Vec::new(), sections: Vec::new(), weight };
        let support = Support::new(reduction, active, damping, seen).unwrap();
        assert_eq!(support.centre_of_mass.node, support.nodes[0]);
        support
    }

    fn coordinates(columns: &[usize]) -> Coordinates {
        let all = ["a", "b", "c"];
        Coordinates {
            transform: Matrix::identity(3).select(&[0, 1, 2], columns),
            names: columns.iter().map(|&j| all[j].to_owned()).collect(),
        }
    }

    #[test]
    fn held_retained_dofs_leave_the_fixed_interface_modes() {
        let damping = Rayleigh { alpha: 2.0, beta: 1e-4 };
        let support = oscillators(&reduction(), &coordinates(&[0, 1]), damping);
        assert_eq!(support.stiffness, [4e3, 1.6e4]);
        assert_eq!(support.damping, [2.4, 3.6]);
        assert_eq!(support.coordinates, ["a", "b"]);
        assert_eq!(support.nodes[0].shapes.data, [1.0, 4.0, 7.0, 2.0, 5.0, 8.0]);
    }

    #[test]
    fn oscillators_answer_a_force_as_the_coupled_body_does() {
        let (reduction, active) = (reduction(), coordinates(&[0, 1, 2]));
        let support = oscillators(&reduction, &active, Rayleigh::default());
        // Displacement of the node along x under a unit force there, at rest and at high frequency.
        let row: Vec<f64> = (0..3).map(|j| reduction.shapes[(0, j)]).collect();
        let answer = |matrix: &Matrix| {
            let mut lu = crate::linalg::Lu::new(3);
            lu.factor(&matrix.data).unwrap();
            let mut x = row.clone();
            lu.solve_in_place(&mut x);
            crate::linalg::dot(&row, &x)
        };
        let shapes = &support.nodes[0].shapes;
        let sum = |weigh: &dyn Fn(f64) -> f64| -> f64 {
            (0..3).map(|j| shapes[(0, j)].powi(2) * weigh(support.stiffness[j])).sum()
        };
        let (soft, light) = (sum(&|k| 1.0 / k), sum(&|_| 1.0));
        assert!((soft / answer(&reduction.stiffness) - 1.0).abs() < 1e-12);
        assert!((light / answer(&reduction.mass) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_lumped_support_has_its_own_mass_and_spring() {
        let support = Support::lumped(4.0, [1e4, 2e4], [8.0, 0.0], &[[0.0; 3]; 2]);
        assert_eq!(support.stiffness, [2500.0, 5000.0]);
        assert_eq!(support.damping, [2.0, 0.0]);
        // Under a force F along x: x = φ² F / ω² = F / k.
        let shapes = &support.nodes[1].shapes;
        assert_eq!(shapes[(0, 0)].powi(2) / support.stiffness[0], 1e-4);
        assert_eq!(Support::rigid(&[[0.0; 3]; 3]).size(), 0);
    }
}
