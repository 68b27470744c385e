//! What is seen of a joint: measures of its sides as rows over the coordinates of their bodies, and its planes.

use whirl_specs::BoreMotion;

use crate::bearing::{Bearing, MotionKind, Springs, axis_motion};
use crate::bodies::{Body, BodyPlace};
use crate::linalg::dot;
use crate::loads::Position;
use crate::plane_rows::PlaneRows;

/// How the outputs of a bearing are computed.
#[derive(Debug, Clone)]
pub(crate) struct Monitor {
    /// Its name in messages.
    pub(crate) name: String,
    /// What its columns are called by.
    pub(crate) label: String,
    /// Its planes of springs.
    pub(crate) planes: Vec<usize>,
    /// Turns of the sections of journal and bore against the frames of their bodies, as rows over the coordinates of the bodies.
    pub(crate) sections: [Vec<f64>; 2],
    /// The planes in which a law on tilts, or on the whole joint, gives moments about x and y, and in which one gives a force
    /// along z.
    pub(crate) tilts: Option<usize>,
    pub(crate) along: Option<usize>,
    /// Whether its laws turn or brake the journal.
    pub(crate) torque: bool,
    /// The bodies of journal and bore.
    pub(crate) bodies: [usize; 2],
    /// Displacement of the middle journal node along x and y (frame of its body), as rows over the body's
    /// coordinates.
    pub(crate) journal: [Vec<f64>; 2],
    /// Displacement of the bore's axis in the middle ring, as the laws see it: rows over the coordinates of its
    /// body.
    pub(crate) bore: [Vec<f64>; 2],
    /// Run-out of the journal, offset of the bore (m; each in the frame of its body) and how far the body of the
    /// journal stands from the axis of the bore (m, in space).
    run_out: [f64; 2],
    pub(crate) offset: [f64; 2],
    pub(crate) apart: [f64; 2],
    /// Whether the run-out is left out, here and in what the laws see.
    pub(crate) runs_true: bool,
}

impl Monitor {
    /// The run-out of the journal (m, in the frame of its body), where it is not left out.
    pub(crate) fn run_out(&self) -> [f64; 2] {
        if self.runs_true { [0.0; 2] } else { self.run_out }
    }

    /// Of a bearing by its number.
    pub(crate) fn new(
        number: usize,
        bearing: &Bearing,
        bodies: &[Body],
        springs: &Springs,
    ) -> Self {
        let sides = &bearing.sides;
        let [journal, bore] = sides.bodies.map(|body| &bodies[body]);
        let node = &journal.nodes()[bearing.journal[1]];
        let planes_of = |other: Option<MotionKind>| -> Vec<usize> {
            let planes = springs.planes.iter().enumerate();
            let own = planes.filter(|(_, plane)| plane.bearing == number && plane.other == other);
            own.map(|(place, _)| place).collect()
        };
        let planes = planes_of(None);
        let other = |kind: MotionKind, motions: &[BoreMotion]| {
            let acts = |plane: &usize| motions.iter().any(|own| springs.acts_on(*plane, *own));
            let whole = planes.iter().copied().find(acts);
            planes_of(Some(kind)).first().copied().or(whole)
        };
        let (tilts, along) = (
            other(MotionKind::Tilts, &[BoreMotion::SectionTiltX, BoreMotion::SectionTiltY]),
            other(MotionKind::Along, &[BoreMotion::SectionZ]),
        );
        Monitor {
            name: bearing.name.clone(),
            label: bearing.label.clone().unwrap_or_else(|| (number + 1).to_string()),
            torque: planes.iter().any(|&plane| springs.gives_torque(plane)),
            planes,
            sections: [(0, journal), (1, bore)].map(|(side, body)| {
                let row = |section: usize| body.measures()[section].rotation.row(2);
                sides.sections[side].map_or(Vec::new(), row)
            }),
            tilts,
            along,
            bodies: sides.bodies,
            journal: [0, 1].map(|axis| node.shapes.row(axis)),
            bore: match &sides.gear {
                Some(gear) => {
                    let node = &bore.nodes()[gear.second];
                    [0, 1].map(|axis| node.shapes.row(axis))
                }
                None => axis_motion(bearing, bore),
            },
            run_out: sides.run_out[1],
            runs_true: false,
            offset: sides.offset[1],
            apart: sides.apart,
        }
    }

    /// The plane of a law of the whole joint.
    pub(crate) fn whole(&self) -> Option<usize> {
        let others = [self.tilts, self.along].into_iter().flatten();
        others.into_iter().find(|plane| self.planes.contains(plane))
    }

    /// Its planes of all kinds.
    pub(crate) fn all_planes(&self) -> impl Iterator<Item = usize> {
        let others = self.tilts.into_iter().chain(self.along);
        // A law of the whole joint does all in one plane.
        let others = others.filter(|plane| !self.planes.contains(plane));
        self.planes.iter().copied().chain(others)
    }

    /// Displacement of the journal in the frame of its body, and of the bore's axis in that of its own, by values of q (m) or its
    /// rates.
    pub(crate) fn displacements(&self, places: &[BodyPlace], q: &[f64]) -> [[f64; 2]; 2] {
        let [journal, bore] = self.bodies.map(|body| &q[places[body].flexible.clone()]);
        [
            [0, 1].map(|axis| dot(&self.journal[axis], journal)),
            [0, 1].map(|axis| dot(&self.bore[axis], bore)),
        ]
    }

    /// The same in space, run-out and offset included in how far the joint is deformed.
    pub(crate) fn displaced(&self, places: &[BodyPlace], q: &[f64], turned: &Turned) -> Displaced {
        let [journal, bore] = self.displacements(places, q);
        let bore = turned.bore.to_space([0, 1].map(|axis| bore[axis] + self.offset[axis]));
        let journal = turned.journal.to_space(journal);
        let run_out = turned.run_out.to_space(self.run_out());
        let deformation =
            [0, 1].map(|axis| journal[axis] + run_out[axis] + self.apart[axis] - bore[axis]);
        Displaced { journal, deformation }
    }

    /// The displacement of the journal against the bore as rows.
    pub(crate) fn rows(&self) -> PlaneRows {
        let minus = self.bore.each_ref().map(|row| row.iter().map(|own| -own).collect());
        PlaneRows(vec![(self.bodies[0], self.journal.clone()), (self.bodies[1], minus)])
    }
}

/// How the frames of the bodies of a joint are turned, and the journal with its run-out.
pub(crate) struct Turned {
    pub(crate) journal: Position,
    pub(crate) run_out: Position,
    pub(crate) bore: Position,
}

/// Displacements in the middle of a joint (m, along x and y of space).
pub(crate) struct Displaced {
    /// Of the journal, without its run-out.
    pub(crate) journal: [f64; 2],
    /// Of the journal against the bore.
    pub(crate) deformation: [f64; 2],
}
