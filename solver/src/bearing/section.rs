//! How whole sections of journal and bore move, and what a sensor sees of both, as rows over the coordinates of their bodies.

use whirl_specs::BoreMotion;

use super::Bearing;
use crate::bodies::Body;
use crate::linalg::Matrix;
use crate::mesh::MeanComponent;

/// A motion of a section, or at a sensor.
#[derive(Clone, Copy)]
pub(super) struct SectionMotion {
    /// The journal's (0) or the bore's.
    pub(super) side: usize,
    of: Of,
}

#[derive(Clone, Copy)]
enum Of {
    /// The mean motion of the nodes of the section.
    Section(MeanComponent),
    /// Where the sensor is, along x or y.
    Sensor(usize),
}

impl SectionMotion {
    /// What a motion of a bore or a section is; none of what a bore does at its springs or as a ring.
    pub(super) fn of(motion: BoreMotion) -> Option<Self> {
        let section = Of::Section;
        let (side, of) = match motion {
            BoreMotion::SectionTurn => (0, section(MeanComponent::Rotation(2))),
            BoreMotion::SectionZ => (0, section(MeanComponent::Displacement(2))),
            BoreMotion::SectionTiltX => (0, section(MeanComponent::Rotation(0))),
            BoreMotion::SectionTiltY => (0, section(MeanComponent::Rotation(1))),
            BoreMotion::MeanZ => (1, section(MeanComponent::Displacement(2))),
            BoreMotion::MeanTiltX => (1, section(MeanComponent::Rotation(0))),
            BoreMotion::MeanTiltY => (1, section(MeanComponent::Rotation(1))),
            BoreMotion::SeenX => (0, Of::Sensor(0)),
            BoreMotion::SeenY => (0, Of::Sensor(1)),
            BoreMotion::BaseX => (1, Of::Sensor(0)),
            BoreMotion::BaseY => (1, Of::Sensor(1)),
            BoreMotion::Radial
            | BoreMotion::Tangential
            | BoreMotion::MeanX
            | BoreMotion::MeanY
            | BoreMotion::MeanTurn
            | BoreMotion::SecondFrame
            | BoreMotion::SecondTurn => return None,
        };
        Some(SectionMotion { side, of })
    }

    /// The row over the coordinates of its body; nothing where it has no such section.
    pub(super) fn row(self, bearing: &Bearing, body: &Body) -> Vec<f64> {
        let sides = &bearing.sides;
        let component = match self.of {
            Of::Section(component) => component,
            Of::Sensor(axis) => {
                let node = sides.sensor[self.side].map(|node| &body.nodes()[node]);
                return node.map_or_else(Vec::new, |node| node.shapes.row(axis));
            }
        };
        let section = match component {
            MeanComponent::Rotation(2) => sides.torque_section,
            _ => sides.whole_sections[self.side],
        };
        let Some(section) = section else { return Vec::new() };
        let section = &body.measures()[section];
        match component {
            MeanComponent::Displacement(axis) => row_of(&section.displacement, axis),
            MeanComponent::Rotation(axis) => row_of(&section.rotation, axis),
        }
    }
}

fn row_of(matrix: &Matrix, i: usize) -> Vec<f64> {
    (0..matrix.cols).map(|j| matrix[(i, j)]).collect()
}
