//! Laws on other motions of the sides of a bearing than their displacement in a plane: tilts, and displacement along z.
//!
//! A law of rings sees e_x, e_y and ω. Tilts about x and y turn with a body as displacements along x and y do, so that
//! the same kernels serve, with the rows of tilts in the place of those of displacements. What the derivative after θ of
//! the turned tilts adds to the row of θ is the part about z of the moment, of second order.

use crate::bodies::Body;
use crate::linalg::Matrix;
use whirl_specs::BoreMotion;

/// A motion of the sides of a bearing, other than in its plane, on which a law of rings acts as it does on a
/// displacement: once, at a section of each body.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherMotion {
    /// Which motion.
    pub kind: MotionKind,
    /// The sections of both sides among the measures of their bodies; none on the ground.
    pub sections: [Option<usize>; 2],
    /// Which of the laws given to `Springs::new`.
    pub law: usize,
}

/// What of a section moves, in place of its displacement along x and y.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionKind {
    /// Tilts about x and y. The law has 1 m for 1 rad, and N for N·m: those at an arm of 1 m.
    Tilts,
    /// Displacement along z, in place of that along x. It does not turn with its body.
    Along,
}

impl OtherMotion {
    /// The motion along x and y of a section of the body on the first side (0) or the second, as rows over its coordinates;
    /// none of it where the body has no section.
    fn rows(&self, side: usize, body: &Body) -> [Vec<f64>; 2] {
        let none = || vec![0.0; body.size()];
        let Some(section) = self.sections[side] else { return [none(), none()] };
        let section = &body.measures()[section];
        let row = |matrix: &Matrix, i: usize| (0..matrix.cols).map(|j| matrix[(i, j)]).collect();
        match self.kind {
            MotionKind::Tilts => [0, 1].map(|axis| row(&section.rotation, axis)),
            MotionKind::Along => [row(&section.displacement, 2), none()],
        }
    }

    /// Of the first side, as a plane has them: places in q from `first` on.
    pub(super) fn of_first(&self, body: &Body, first: usize) -> [Vec<(usize, f64)>; 2] {
        self.rows(0, body).map(|row| {
            let placed = row.into_iter().enumerate().map(|(j, value)| (first + j, value));
            placed.filter(|&(_, value)| value != 0.0).collect()
        })
    }

    /// Of the second side, as a motion of a bore.
    pub(super) fn of_second(&self, body: &Body, motion: BoreMotion) -> Vec<f64> {
        let [x, y] = self.rows(1, body);
        match (motion, self.kind, self.sections[1]) {
            (BoreMotion::MeanX, ..) => x,
            (BoreMotion::MeanY, ..) => y,
            // The axes of the tilts turn with the section.
            (BoreMotion::MeanTurn, MotionKind::Tilts, Some(section)) => {
                let rotation = &body.measures()[section].rotation;
                (0..rotation.cols).map(|j| rotation[(2, j)]).collect()
            }
            _ => vec![0.0; body.size()],
        }
    }
}
