//! How far coordinates move springs.

use super::Bearing;
use super::bores::Bores;
use super::plane::Plane;
use crate::bodies::{Body, BodyPlace};
use crate::body::BodyNode;
use crate::linalg::Matrix;

/// √(ε_x² + ε_y²) by a unit of each coordinate, one row a plane; zero for rotations.
pub(super) fn arms(planes: &[Plane], places: &[BodyPlace], size: usize) -> Matrix {
    let rotations: Vec<usize> = places.iter().filter_map(|own| own.rotation).collect();
    let rows = planes.iter().map(|plane| {
        let mut arms = vec![0.0_f64; size];
        let [_, x, y] = &plane.rows;
        let both = x.iter().chain(y).filter(|(place, _)| !rotations.contains(place));
        both.for_each(|&(j, coefficient)| arms[j] = arms[j].hypot(coefficient));
        arms
    });
    let rows: Vec<Vec<f64>> = rows.collect();
    Matrix::from_fn(rows.len(), size, |i, j| rows[i][j])
}

/// See [`Springs::reach`].
pub(super) fn reach(
    planes: &[Plane],
    bearings: &[Bearing],
    bodies: &[Body],
    places: &[BodyPlace],
    bores: &[Bores],
    arms: &Matrix,
) -> Vec<f64> {
    let count = |plane: &Plane| plane.springs.len() as f64;
    let mut squares: Vec<f64> = (0..arms.cols)
        .map(|j| planes.iter().zip(arms.col(j)).map(|(plane, arm)| count(plane) * arm * arm).sum())
        .collect();
    let rotations: Vec<usize> = places.iter().filter_map(|own| own.rotation).collect();
    for (body, place) in places.iter().enumerate() {
        let Some(rotation) = place.rotation else { continue };
        let arm = |node: &BodyNode| node.position[0].hypot(node.position[1]);
        let arm = bodies[body].nodes().iter().map(arm).fold(0.0, f64::max);
        let own = planes.iter().filter(|own| bearings[own.bearing].sides.bodies.contains(&body));
        squares[rotation] = arm * arm * own.map(count).sum::<f64>();
    }
    for plane in planes {
        // A moment counts as a force at this arm.
        let twist = plane.rows[0].iter().filter(|(place, _)| !rotations.contains(place));
        twist.for_each(|&(place, part)| squares[place] += (plane.arm * part).powi(2));
    }
    for own in planes.iter().filter_map(|plane| plane.flank) {
        for (place, radius) in own.rotations.into_iter().zip(own.flank.radii) {
            squares[place] += radius * radius;
        }
    }
    for own in bores {
        for (j, place) in own.place.clone().enumerate() {
            if rotations.contains(&place) {
                continue;
            }
            squares[place] += own.rows.col(j).iter().map(|part| part * part).sum::<f64>();
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}
