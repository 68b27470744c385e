//! Faces of reference cells.

use num_traits::Zero;

use super::algebraic::{Algebraic, Field};
use super::cell::Cell;
use super::quadrature::{Point, Quadrature};
use super::rules;
use crate::expression::Rational;

/// A flat face of a reference cell: x(s, t) = origin + s·along₀ + t·along₁, whose normal along₀ × along₁ points
/// out of the cell.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Face {
    /// 3 corners (s, t ≥ 0, s + t ≤ 1) or 4 (−1 ≤ s, t ≤ 1).
    pub(crate) corners: usize,
    pub(crate) origin: [Rational; 3],
    /// ∂x/∂s and ∂x/∂t.
    pub(crate) along: [[Rational; 3]; 2],
}

impl Face {
    /// From its corners, anticlockwise as seen from outside: a triangle or a parallelogram.
    fn new(corners: &[[i64; 3]]) -> Self {
        let half = i64::from(corners.len() == 4) + 1;
        let edge = |to: usize| {
            [0, 1, 2].map(|axis| Rational::new(corners[to][axis] - corners[0][axis], half))
        };
        let along = [edge(1), edge(corners.len() - 1)];
        let origin = [0, 1, 2].map(|axis| {
            let corner = Rational::from(corners[0][axis]);
            match corners.len() {
                4 => corner + &along[0][axis] + &along[1][axis],
                _ => corner,
            }
        });
        Face { corners: corners.len(), origin, along }
    }

    /// A rule over the face, as points of the cell: the one that integrates functions complete to a degree, times the
    /// area of a flat face that they map, exactly.
    pub(crate) fn rule(&self, complete: u32) -> Quadrature {
        let names: &[&str] = match (self.corners, complete) {
            (3, ..=1) => &["triangle(3)"],
            (3, 2) => &["triangle(6)"],
            (3, _) => &["triangle(7)"],
            (_, ..=1) => &["gauss(2)"; 2],
            (_, 2) => &["gauss(3)"; 2],
            _ => &["gauss(4)"; 2],
        };
        let mut field = Field::default();
        // The third coordinate, of which the face has none, is the one point 0 with the weight 2.
        let flat = [names, &["gauss(1)"]].concat();
        let factors = rules::factors(&mut field, &flat).expect("named rules");
        let title = names.join(" × ");
        let mut rule = Quadrature::new(title, field, factors, 0, 0..0).expect("three coordinates");
        let half = Rational::new(1, 2);
        rule.points = (rule.points.iter())
            .map(|Point { at: [s, t, _], weight }| Point {
                at: [0, 1, 2].map(|axis| self.at(axis, [s, t])),
                weight: weight.times(&half),
            })
            .collect();
        rule
    }

    fn at(&self, axis: usize, coordinates: [&Algebraic; 2]) -> Algebraic {
        let mut sum = Algebraic::rational(self.origin[axis].clone());
        for (along, coordinate) in self.along.iter().zip(coordinates) {
            if !along[axis].is_zero() {
                sum.add(coordinate, &along[axis]);
            }
        }
        sum
    }
}

impl Cell {
    /// Its faces.
    pub(crate) fn faces(self) -> Vec<Face> {
        let corners: &[&[[i64; 3]]] = match self {
            Cell::Hexahedron => &[
                &[[-1, -1, -1], [-1, 1, -1], [1, 1, -1], [1, -1, -1]],
                &[[-1, -1, 1], [1, -1, 1], [1, 1, 1], [-1, 1, 1]],
                &[[-1, -1, -1], [1, -1, -1], [1, -1, 1], [-1, -1, 1]],
                &[[1, 1, -1], [-1, 1, -1], [-1, 1, 1], [1, 1, 1]],
                &[[-1, 1, -1], [-1, -1, -1], [-1, -1, 1], [-1, 1, 1]],
                &[[1, -1, -1], [1, 1, -1], [1, 1, 1], [1, -1, 1]],
            ],
            Cell::Wedge => &[
                &[[0, 0, -1], [0, 1, -1], [1, 0, -1]],
                &[[0, 0, 1], [1, 0, 1], [0, 1, 1]],
                &[[0, 0, -1], [1, 0, -1], [1, 0, 1], [0, 0, 1]],
                &[[0, 1, -1], [0, 0, -1], [0, 0, 1], [0, 1, 1]],
                &[[1, 0, -1], [0, 1, -1], [0, 1, 1], [1, 0, 1]],
            ],
            Cell::Tetrahedron => &[
                &[[0, 0, 0], [0, 1, 0], [1, 0, 0]],
                &[[0, 0, 0], [1, 0, 0], [0, 0, 1]],
                &[[0, 0, 0], [0, 0, 1], [0, 1, 0]],
                &[[1, 0, 0], [0, 1, 0], [0, 0, 1]],
            ],
            Cell::Pyramid => &[
                &[[-1, -1, 0], [-1, 1, 0], [1, 1, 0], [1, -1, 0]],
                &[[-1, -1, 0], [1, -1, 0], [0, 0, 1]],
                &[[1, -1, 0], [1, 1, 0], [0, 0, 1]],
                &[[1, 1, 0], [-1, 1, 0], [0, 0, 1]],
                &[[-1, 1, 0], [-1, -1, 0], [0, 0, 1]],
            ],
        };
        corners.iter().map(|corners| Face::new(corners)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_enclose_their_cell() {
        for name in Cell::NAMES {
            let cell = Cell::named(name).expect("a known cell");
            // ∫ x·n dA = 3 V, and ∫ n dA = 0.
            let (mut volume, mut closed) = (Rational::zero(), [0, 1, 2].map(|_| Rational::zero()));
            for face in cell.faces() {
                let [a, b] = &face.along;
                let normal = [0, 1, 2].map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    &a[j] * &b[k] - &a[k] * &b[j]
                });
                for complete in 1..=3 {
                    let rule = face.rule(complete);
                    let mut area = Algebraic::default();
                    for point in &rule.points {
                        area.add(&point.weight, &Rational::from(1));
                        // All points lie in one plane.
                        let mut height = Algebraic::default();
                        for ((at, origin), n) in point.at.iter().zip(&face.origin).zip(&normal) {
                            height.add(&at.minus(&Algebraic::rational(origin.clone())), n);
                        }
                        assert!(height.is_zero(), "{name}");
                    }
                    let exact =
                        if face.corners == 4 { Rational::from(4) } else { Rational::new(1, 2) };
                    assert_eq!(area.as_rational(), Some(exact), "{name}");
                }
                let scale = if face.corners == 4 { Rational::from(4) } else { Rational::new(1, 2) };
                for axis in 0..3 {
                    volume += &scale * &normal[axis] * &face.origin[axis];
                    closed[axis] += &scale * &normal[axis];
                }
                assert!(cell.contains(&face.origin), "{name}");
            }
            assert_eq!(volume, Rational::from(3) * cell.monomial([0; 3]), "{name}");
            assert!(closed.iter().all(Rational::is_zero), "{name}");
        }
    }
}
