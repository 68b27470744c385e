//! The frame of a body that turns freely: the one in which small deformations have no angular momentum about the axis.
//!
//! Any one equation between the coordinates ties the frame to the body, such as that one section does not turn in it. The
//! inertia that θ̇ then has is that of what follows the section at once: a light section before a heavy disc leaves next to
//! nothing, and terms of second order that a linear deformation leaves out make M(q) indefinite. With g0·η = 0 it is J0, that
//! of the whole body.

use crate::linalg::{Matrix, congruence, multiply};
use crate::shaft::Shaft;

impl Shaft {
    /// The shaft with coordinate `follows` given by the others from g0·η = 0, so that it is none any more. A body whose g0
    /// does not know that coordinate stays as it is.
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn in_mean_frame(mut self, follows: usize) -> Shaft {
        let n = self.size();
        let pivot = self.g0[follows];
        if pivot == 0.0 {
            return self;
        }
        let old = |column: usize| column + usize::from(column >= follows);
        let transform = Matrix::from_fn(n, n - 1, |i, j| match i == follows {
            true => -self.g0[old(j)] / pivot,
            false => f64::from(u8::from(i == old(j))),
        });
        for matrix in [&mut self.mass, &mut self.stiffness, &mut self.damping] {
            *matrix = congruence(matrix, &transform).symmetric_part();
        }
        for matrix in [&mut self.spin_inertia, &mut self.spin_net] {
            *matrix = congruence(matrix, &transform).symmetric_part();
        }
        self.spin_coupling = congruence(&self.spin_coupling, &transform).skew_part();
        self.y0 = transform.apply_transpose(&self.y0);
        self.g0 = vec![0.0; n - 1];
        self.coordinates.remove(follows);
        let nodes = self.nodes.iter_mut().chain([&mut self.centre_of_mass.node]);
        let shapes = nodes.map(|node| &mut node.shapes);
        for rows in shapes {
            *rows = multiply(rows.view(), transform.view());
        }
        self.measures = self.measures.iter().map(|own| own.over(&transform)).collect();
        self.sections = self.sections.iter().map(|own| own.over(&transform)).collect();
        self
    }
}
