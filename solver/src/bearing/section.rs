//! How whole sections of journal and bore move, as rows over the coordinates of their bodies.

use whirl_specs::BoreMotion;

use super::Bearing;
use crate::bodies::Body;
use crate::linalg::Matrix;
use crate::mesh::MeanComponent;

/// A motion of a section, by the mean motion of its nodes.
#[derive(Clone, Copy)]
pub(super) struct SectionMotion {
    /// The journal's (0) or the bore's.
    pub(super) side: usize,
    component: MeanComponent,
}

impl SectionMotion {
    /// What a motion of a bore or a section is; none of what a bore does at its springs or as a ring.
    pub(super) fn of(motion: BoreMotion) -> Option<Self> {
        let (side, component) = match motion {
            BoreMotion::SectionTurn => (0, MeanComponent::Rotation(2)),
            BoreMotion::SectionZ => (0, MeanComponent::Displacement(2)),
            BoreMotion::SectionTiltX => (0, MeanComponent::Rotation(0)),
            BoreMotion::SectionTiltY => (0, MeanComponent::Rotation(1)),
            BoreMotion::MeanZ => (1, MeanComponent::Displacement(2)),
            BoreMotion::MeanTiltX => (1, MeanComponent::Rotation(0)),
            BoreMotion::MeanTiltY => (1, MeanComponent::Rotation(1)),
            BoreMotion::Radial
            | BoreMotion::Tangential
            | BoreMotion::MeanX
            | BoreMotion::MeanY
            | BoreMotion::MeanTurn
            | BoreMotion::SecondFrame
            | BoreMotion::SecondTurn => return None,
        };
        Some(SectionMotion { side, component })
    }

    /// The row over the coordinates of its body; nothing where it has no such section.
    pub(super) fn row(self, bearing: &Bearing, body: &Body) -> Vec<f64> {
        let sides = &bearing.sides;
        let section = match self.component {
            MeanComponent::Rotation(2) => sides.torque_section,
            _ => sides.whole_sections[self.side],
        };
        let Some(section) = section else { return Vec::new() };
        let section = &body.measures()[section];
        match self.component {
            MeanComponent::Displacement(axis) => row_of(&section.displacement, axis),
            MeanComponent::Rotation(axis) => row_of(&section.rotation, axis),
        }
    }
}

fn row_of(matrix: &Matrix, i: usize) -> Vec<f64> {
    (0..matrix.cols).map(|j| matrix[(i, j)]).collect()
}
