//! What a shaft carries that its mesh does not have: rigid discs given by numbers, point masses, unbalance.

use crate::body::BodyNode;
use crate::linalg::{Columns, Matrix, transpose_multiply};
use crate::shaft::Shaft;

/// A rigid disc on the mean motion of a section, its centre of mass on the axis.
#[derive(Debug, Clone, Copy)]
pub struct Disc<'a> {
    /// kg.
    pub mass: f64,
    /// I_p, about the axis (kg·m²).
    pub polar_inertia: f64,
    /// I_d, about a diameter (kg·m²).
    pub diametral_inertia: f64,
    /// z of its centre (m).
    pub z: f64,
    /// Displacement of its centre along x, y, z by a unit of each coordinate: 3 × n.
    pub displacement: &'a Matrix,
    /// Its turns about x and y (rad) by a unit of each coordinate: 2 × n.
    pub tilt: &'a Matrix,
    /// Its turn about z against the frame, n values; none where the section does not twist.
    pub twist: Option<&'a [f64]>,
}

/// A mass at a node, or a part of one, that turns with its section.
#[derive(Debug, Clone, Copy)]
pub struct PointMass<'a> {
    /// kg.
    pub mass: f64,
    /// Where it is before deformation, and how it moves.
    pub node: &'a BodyNode,
    /// Turns of its section about x, y, z (rad) by a unit of each coordinate: 3 × n.
    pub turn: &'a Matrix,
}

/// Unbalance in the plane of a node.
#[derive(Debug, Clone, Copy)]
pub struct Unbalance<'a> {
    /// Mass times eccentricity along x and y of the turning frame (kg·m).
    pub moment: [f64; 2],
    /// How the plane moves.
    pub node: &'a BodyNode,
}

impl Shaft {
    /// The shaft with a disc.
    ///
    /// The lateral motion of a point (a, b, c) of the disc is that of the centre and c·(β, −α) by the tilts α and β, so that Y
    /// and H take ∫ρc² dV = I_d − ½ I_p of them. Of second order a tilt moves the points inwards, and J changes by
    /// (I_d − I_p)(α² + β²): G takes ½ I_p.
    ///
    /// # Panics
    /// If the rows are not of n values.
    pub fn with_disc(mut self, disc: &Disc) -> Shaft {
        let &Disc { mass, polar_inertia, diametral_inertia, z, displacement, tilt, twist } = disc;
        let row = |matrix: &Matrix, i: usize| -> Vec<f64> {
            (0..matrix.cols).map(|j| matrix[(i, j)]).collect()
        };
        let lateral = [row(displacement, 0), row(displacement, 1)];
        let tilts = [row(tilt, 0), row(tilt, 1)];
        let axial = diametral_inertia - 0.5 * polar_inertia;
        self.j0 += polar_inertia;
        let centre = BodyNode { position: [0.0, 0.0, z], shapes: displacement.clone() };
        self.centre_of_mass.add(mass, &centre);
        self.add_mass(mass, &[&lateral[0], &lateral[1], &row(displacement, 2)]);
        self.add_lateral(mass, [&lateral[0], &lateral[1]]);
        self.add_mass(diametral_inertia, &[&tilts[0], &tilts[1]]);
        self.add_lateral(axial, [&tilts[0], &tilts[1]]);
        for tilt in &tilts {
            add_square(&mut self.spin_net, -0.5 * polar_inertia, tilt);
        }
        if let Some(twist) = twist {
            // ½ I_p (θ̇ + twist rate)²; a twist leaves J as it is, so that Y − G takes nothing.
            self.add_mass(polar_inertia, &[twist]);
            add_square(&mut self.spin_inertia, polar_inertia, twist);
            for (g0, twist) in self.g0.iter_mut().zip(twist) {
                *g0 += polar_inertia * twist;
            }
        }
        self
    }

    /// The shaft with a point mass: J0, y0, g0, M, Y, H and the centre of mass. That its centrifugal force stresses the body,
    /// too, is left out.
    ///
    /// Of second order it moves inwards as its section turns: at r = (x, y) from the axis by r·½ω×(ω×r) = −½(u_z² + e²γ²), with
    /// u_z = αy − βx what the tilts move it along z, e² = x² + y² and γ the twist. G takes m of that.
    ///
    /// # Panics
    /// If the node or the turns are of another body.
    pub fn with_point_mass(mut self, point: &PointMass) -> Shaft {
        let &PointMass { mass, node, turn } = point;
        let [x, y, _] = node.position;
        let along: Vec<f64> = (0..turn.cols).map(|j| y * turn[(0, j)] - x * turn[(1, j)]).collect();
        let twist: Vec<f64> = (0..turn.cols).map(|j| turn[(2, j)]).collect();
        add_square(&mut self.spin_net, -mass, &along);
        add_square(&mut self.spin_net, -mass * (x * x + y * y), &twist);
        let [row_x, row_y, row_z] = [0, 1, 2].map(|i| node.shapes.row(i));
        self.j0 += mass * (x * x + y * y);
        self.add_mass(mass, &[&row_x, &row_y, &row_z]);
        self.add_lateral(mass, [&row_x, &row_y]);
        self.centre_of_mass.add(mass, node);
        self.add_moment(&Unbalance { moment: [mass * x, mass * y], node });
        self
    }

    /// The shaft with unbalance: y0, g0 and the place of the centre of mass only.
    ///
    /// # Panics
    /// If the node is of another body.
    pub fn with_unbalance(mut self, unbalance: &Unbalance) -> Shaft {
        self.add_moment(unbalance);
        self.centre_of_mass.shift(unbalance.moment);
        self
    }

    /// y0 and g0 by what is out of balance.
    fn add_moment(&mut self, unbalance: &Unbalance) {
        let &Unbalance { moment: [u_x, u_y], node } = unbalance;
        let [row_x, row_y] = [0, 1].map(|i| node.shapes.row(i));
        for (j, (x, y)) in row_x.iter().zip(&row_y).enumerate() {
            self.y0[j] += u_x * x + u_y * y;
            self.g0[j] += u_x * y - u_y * x;
        }
    }

    /// M by a mass or moment of inertia with these motions.
    fn add_mass(&mut self, mass: f64, rows: &[&[f64]]) {
        rows.iter().for_each(|row| add_square(&mut self.mass, mass, row));
    }

    /// Y, Y − G and H by a mass that moves sideways along x and y, or by what tilts do alike about x and y.
    fn add_lateral(&mut self, mass: f64, [x, y]: [&[f64]; 2]) {
        for matrix in [&mut self.spin_inertia, &mut self.spin_net] {
            add_square(matrix, mass, x);
            add_square(matrix, mass, y);
        }
        add_product(&mut self.spin_coupling, mass, x, y);
        add_product(&mut self.spin_coupling, -mass, y, x);
    }
}

/// Adds factor · rowᵀrow.
fn add_square(matrix: &mut Matrix, factor: f64, row: &[f64]) {
    add_product(matrix, factor, row, row);
}

/// Adds factor · leftᵀright.
fn add_product(matrix: &mut Matrix, factor: f64, left: &[f64], right: &[f64]) {
    assert!(left.len() == matrix.rows && right.len() == matrix.cols, "rows over the coordinates");
    let row = |data| Columns { rows: 1, cols: matrix.rows, data };
    let product = transpose_multiply(row(left), row(right));
    for (entry, value) in matrix.data.iter_mut().zip(product.data) {
        *entry += factor * value;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::centre_of_mass::CentreOfMass;

    const MASS: f64 = 7.0;

    /// Coordinates x, y, α, β, γ of a rigid body on the axis.
    fn body() -> Shaft {
        let zeros = Matrix::zeros(5, 5);
        Shaft {
            j0: 0.0,
            y0: vec![0.0; 5],
            g0: vec![0.0; 5],
            mass: zeros.clone(),
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            spin_inertia: zeros.clone(),
            spin_net: zeros.clone(),
            spin_coupling: zeros,
            hertz: Vec::new(),
            coordinates: ["x", "y", "α", "β", "γ"].map(str::to_owned).to_vec(),
            nodes: Vec::new(),
            measures: Vec::new(),
            sections: Vec::new(),
            centre_of_mass: CentreOfMass::none(5),
        }
    }

    /// T of the tensors.
    fn energy(shaft: &Shaft, speed: f64, eta: &[f64], rate: &[f64]) -> f64 {
        let product = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        let j = shaft.j0 + 2.0 * product(&shaft.y0, eta) + product(eta, &shaft.spin_net.apply(eta));
        let g = product(&shaft.g0, rate) - product(rate, &shaft.spin_coupling.apply(eta));
        let own = product(rate, &shaft.mass.apply(rate));
        0.5 * speed * speed * j + speed * g + 0.5 * own
    }

    /// T of masses at `points`, turned by the vector (α, β, γ) and moved by (x, y), in a frame that turns at `speed`; by
    /// the difference of their places.
    fn rigid(points: &[([f64; 3], f64)], speed: f64, eta: &[f64], rate: &[f64]) -> f64 {
        let place = |point: &[f64; 3], t: f64| -> [f64; 3] {
            let q: Vec<f64> = eta.iter().zip(rate).map(|(eta, rate)| eta + t * rate).collect();
            let turn = [q[2], q[3], q[4]];
            let angle = turn.iter().map(|v| v * v).sum::<f64>().sqrt();
            let cross = |a: [f64; 3], b: [f64; 3]| {
                [0, 1, 2].map(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
            };
            let once = cross(turn, *point);
            let twice = cross(turn, once);
            let (first, second) = match angle > 0.0 {
                true => (angle.sin() / angle, 2.0 * (0.5 * angle).sin().powi(2) / angle.powi(2)),
                false => (1.0, 0.5),
            };
            let own: [f64; 3] =
                std::array::from_fn(|i| point[i] + first * once[i] + second * twice[i]);
            let (x, y) = (own[0] + q[0], own[1] + q[1]);
            let (sin, cos) = (speed * t).sin_cos();
            [cos * x - sin * y, sin * x + cos * y, own[2]]
        };
        let step = 1e-4;
        let one = |(point, mass): &([f64; 3], f64)| {
            let (before, after) = (place(point, -step), place(point, step));
            let square: f64 = (0..3).map(|i| ((after[i] - before[i]) / (2.0 * step)).powi(2)).sum();
            0.5 * mass * square
        };
        points.iter().map(one).sum()
    }

    /// States with the second-order terms of T one at a time, and all at once.
    fn states() -> Vec<([f64; 5], [f64; 5])> {
        let small = 2e-3;
        let unit = |j: usize, size: f64| std::array::from_fn(|i| if i == j { size } else { 0.0 });
        let mut states: Vec<([f64; 5], [f64; 5])> =
            (0..5).map(|j| (unit(j, small), [0.0; 5])).collect();
        states.extend((0..5).map(|j| ([0.0; 5], unit(j, small))));
        for (i, j) in [(0, 1), (1, 0), (2, 3), (3, 2), (0, 3), (2, 4)] {
            states.push((unit(i, small), unit(j, small)));
        }
        states.push((
            [0.7, -0.4, 0.9, 0.5, -0.3].map(|v| small * v),
            [0.5, 0.8, -0.6, 0.7, 0.4].map(|v| small * v),
        ));
        states
    }

    #[test]
    fn a_disc_has_the_energy_of_a_rigid_body() {
        // Six masses on the axes: as stiff a body as any, with ∫ρa² = ∫ρb².
        let (radius, height) = (0.3, 0.4);
        let mut points = Vec::new();
        for sign in [-1.0, 1.0] {
            points.push(([sign * radius, 0.0, 0.0], MASS / 6.0));
            points.push(([0.0, sign * radius, 0.0], MASS / 6.0));
            points.push(([0.0, 0.0, sign * height], MASS / 6.0));
        }
        let lateral = 2.0 * MASS / 6.0 * radius * radius;
        let displacement = Matrix::from_fn(3, 5, |i, j| f64::from(u8::from(i == j && i < 2)));
        let tilt = Matrix::from_fn(2, 5, |i, j| f64::from(u8::from(j == i + 2)));
        let shaft = body().with_disc(&Disc {
            mass: MASS,
            polar_inertia: 2.0 * lateral,
            diametral_inertia: lateral + 2.0 * MASS / 6.0 * height * height,
            z: 0.2,
            displacement: &displacement,
            tilt: &tilt,
            twist: Some(&[0.0, 0.0, 0.0, 0.0, 1.0]),
        });
        let centre = &shaft.centre_of_mass;
        assert_eq!((centre.mass, centre.node.position), (MASS, [0.0, 0.0, 0.2]));
        let speed = 1.0;
        let still = rigid(&points, speed, &[0.0; 5], &[0.0; 5]);
        for (eta, rate) in states() {
            let found = energy(&shaft, speed, &eta, &rate) - shaft.j0 / 2.0;
            let expected = rigid(&points, speed, &eta, &rate) - still;
            // Terms of third order are missing, and differences round.
            assert!((found - expected).abs() < 1e-8, "{eta:?} {rate:?}: {found:e} {expected:e}");
        }
        assert!((shaft.j0 / 2.0 - still).abs() < 1e-7 * still);
    }

    /// Turns about x, y, z by the coordinates α, β, γ.
    fn turns_of_body() -> Matrix {
        Matrix::from_fn(3, 5, |i, j| f64::from(u8::from(j == i + 2)))
    }

    /// A point of the section at the origin.
    fn on_section([x, y]: [f64; 2]) -> BodyNode {
        let turns = [[1.0, 0.0, 0.0, 0.0, -y], [0.0, 1.0, 0.0, 0.0, x], [0.0, 0.0, y, -x, 0.0]];
        BodyNode { position: [x, y, 0.0], shapes: Matrix::from_fn(3, 5, |i, j| turns[i][j]) }
    }

    /// A ring of masses is a disc without thickness: I_p = m e², I_d = ½ m e².
    #[test]
    fn masses_around_the_axis_are_the_disc_with_their_inertias() {
        let (turn, radius) = (turns_of_body(), 0.15);
        for count in [3, 4, 7] {
            let each = MASS / f64::from(count);
            let ring = (0..count).fold(body(), |shaft, k| {
                let (sin, cos) =
                    (0.2 + std::f64::consts::TAU * f64::from(k) / f64::from(count)).sin_cos();
                let node = on_section([radius * cos, radius * sin]);
                shaft.with_point_mass(&PointMass { mass: each, node: &node, turn: &turn })
            });
            let inertia = MASS * radius * radius;
            let displacement = Matrix::from_fn(3, 5, |i, j| f64::from(u8::from(i == j && i < 2)));
            let tilt = Matrix::from_fn(2, 5, |i, j| turn[(i, j)]);
            let disc = body().with_disc(&Disc {
                mass: MASS,
                polar_inertia: inertia,
                diametral_inertia: 0.5 * inertia,
                z: 0.0,
                displacement: &displacement,
                tilt: &tilt,
                twist: Some(&[0.0, 0.0, 0.0, 0.0, 1.0]),
            });
            for name in ["J0", "y0", "g0", "M", "Y", "W", "H"] {
                let [ring, disc] = [&ring, &disc].map(|own| own.tensor(name).expect("a tensor"));
                for (ring, disc) in ring.iter().zip(disc) {
                    // Rounding of sums of as many terms.
                    assert!((ring - disc).abs() < 1e-14 * MASS, "{count} {name}: {ring} {disc}");
                }
            }
        }
    }

    #[test]
    fn a_single_mass_off_the_axis_has_the_centrifugal_energy_of_a_rigid_body() {
        let turn = turns_of_body();
        let node = on_section([0.2, -0.15]);
        let shaft = body().with_point_mass(&PointMass { mass: MASS, node: &node, turn: &turn });
        let points = [(node.position, MASS)];
        let still = rigid(&points, 1.0, &[0.0; 5], &[0.0; 5]);
        for (eta, _) in states() {
            let found = energy(&shaft, 1.0, &eta, &[0.0; 5]) - 0.5 * shaft.j0;
            let expected = rigid(&points, 1.0, &eta, &[0.0; 5]) - still;
            // Terms of third order are missing, and differences round.
            assert!((found - expected).abs() < 3e-8, "{eta:?}: {found:e} {expected:e}");
        }
    }

    #[test]
    fn a_point_mass_has_its_own_energy_and_unbalance_the_part_of_it_that_is_linear() {
        let position = [0.2, -0.15, 0.4];
        // Turns about the origin, of first order.
        let turns = [
            [1.0, 0.0, 0.0, position[2], -position[1]],
            [0.0, 1.0, -position[2], 0.0, position[0]],
            [0.0, 0.0, position[1], -position[0], 0.0],
        ];
        let shapes = Matrix::from_fn(3, 5, |i, j| turns[i][j]);
        let node = BodyNode { position, shapes };
        let turn = turns_of_body();
        let shaft = body().with_point_mass(&PointMass { mass: MASS, node: &node, turn: &turn });
        let speed = 3.0;
        for (eta, rate) in states() {
            let [eta, rate] = [eta, rate].map(|values| values.map(|value| 100.0 * value));
            let [u, v] = [&eta, &rate].map(|values| node.shapes.apply(values));
            let (x, y) = (position[0] + u[0], position[1] + u[1]);
            let velocity = [v[0] - speed * y, v[1] + speed * x, v[2]];
            let linear = 0.5 * MASS * velocity.iter().map(|v| v * v).sum::<f64>();
            // The way inwards, which is of second order.
            let [along, twist] = [position[1] * eta[2] - position[0] * eta[3], eta[4]];
            let square = position[0].powi(2) + position[1].powi(2);
            let inwards = along.powi(2) + square * twist.powi(2);
            let expected = linear - 0.5 * MASS * speed * speed * inwards;
            let found = energy(&shaft, speed, &eta, &rate);
            assert!((found - expected).abs() < 1e-13 * expected, "{eta:?} {rate:?}");
        }
        let unbalance = Unbalance { moment: [MASS * position[0], MASS * position[1]], node: &node };
        let only = body().with_unbalance(&unbalance);
        assert_eq!((&only.y0, &only.g0), (&shaft.y0, &shaft.g0));
        assert_eq!(Shaft { y0: vec![0.0; 5], g0: vec![0.0; 5], ..only }, body());
    }
}
