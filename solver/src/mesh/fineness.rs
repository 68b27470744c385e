//! How long cells of a bent body may be along its axis: errors of its frequencies of bending against a beam with shear.

use std::f64::consts::PI;

/// A body as a beam.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beam {
    /// m.
    pub(super) length: f64,
    /// Area of its section over its second moment (1/m²).
    pub(super) area_over_moment: f64,
    /// κ G/E.
    pub(super) shear: f64,
}

/// How fine the layers of a generated mesh are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// Order of the cells.
    pub order: usize,
    /// The longest layer (m).
    pub longest: f64,
    /// By which part the three lowest frequencies of bending of the free body are too high, at most and about.
    pub error: f64,
}

/// Wave number of the third mode of bending of a free beam, times its length.
const THIRD: f64 = 3.5 * PI;

impl Beam {
    /// Error of the third frequency, with quadratic cells in layers of this length (m).
    ///
    /// Rotations of sections are quadratic over a layer, and their slope is linear: a curvature of wave number β is met but
    /// for (βℓ)⁴/720 of its energy. The slope of the deflection is linear, too, so that the part of the rotations that is
    /// not is sheared: by κGA/EI · β²ℓ⁴/720 of that energy, or at most by the (βℓ)²/12 that a constant curvature costs.
    /// A frequency has half the error of the energy.
    pub(super) fn quadratic_error(&self, layer: f64) -> f64 {
        let wave = (THIRD * layer / self.length).powi(2);
        let sheared = self.shear * self.area_over_moment * layer * layer * wave / 720.0;
        let constant = wave / 12.0;
        0.5 * (wave * wave / 720.0 + sheared * constant / (sheared + constant))
    }

    /// The longest layer with at most this error (m).
    pub(super) fn longest_layer(&self, tolerance: f64) -> f64 {
        let (mut short, mut long) = (0.0, self.length);
        if self.quadratic_error(long) <= tolerance {
            return long;
        }
        // To far more digits than layers are counted in.
        for _ in 0..60 {
            let middle = 0.5 * (short + long);
            if self.quadratic_error(middle) <= tolerance { short = middle } else { long = middle }
        }
        short
    }
}

/// Error of frequencies of bending of a round section of linear cells, in layers of this length (m).
///
/// Hexahedra have modes for bending, wedges around the centre have none: over a layer they keep their slope, and bend by
/// shear, with G A_c ℓ²/12 in place of a moment. Their radius is a ring's part of the whole one.
pub(super) fn linear_error(layer: f64, radius: f64, rings: usize, shear: f64) -> f64 {
    let part = (rings as f64).powi(-2);
    0.5 * part * shear * (layer / radius).powi(2) / 3.0
}
