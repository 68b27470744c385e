//! The planes in which the springs of a law stand: what they see of the bodies as rows over q.

use std::ops::Range;

use whirl_specs::Clearance;

use super::Bearing;
use super::apart::Apart;
use super::bore::between;
use super::gear::{self, Flank, FlankPlane};
use super::other::{MotionKind, OtherMotion};
use super::plane::Plane;
use crate::bodies::{Body, BodyPlace};
use crate::body::BodyNode;

/// The bodies, whose coordinates stand at `places` in q.
#[derive(Clone, Copy)]
pub(super) struct Sites<'a> {
    pub(super) kernels: &'static Clearance,
    pub(super) bodies: &'a [Body],
    pub(super) places: &'a [BodyPlace],
}

impl Sites<'_> {
    /// The plane of a bearing at `station`, of a law by its place.
    pub(super) fn plane(
        &self,
        law: usize,
        (number, bearing): (usize, &Bearing),
        station: f64,
        springs: Range<usize>,
        radius: Option<f64>,
    ) -> Plane {
        let sides = &bearing.sides;
        let [journal, bore] = sides.bodies.map(|body| &self.places[body]);
        let body = &self.bodies[sides.bodies[0]];
        let weights = (self.kernels.axial)(station);
        let mut angle: Vec<(usize, f64)> = Vec::new();
        for ((side, own), sign) in [journal, bore].into_iter().enumerate().zip([1.0, -1.0]) {
            angle.extend(own.rotation.map(|place| (place, sign)));
            angle.extend(sides.sections[side].into_iter().flat_map(|section| {
                let rotation = &self.bodies[sides.bodies[side]].measures()[section].rotation;
                let twist = own.flexible.clone().enumerate();
                twist.map(move |(j, place)| (place, sign * rotation[(2, j)]))
            }));
        }
        angle.retain(|&(_, coefficient)| coefficient != 0.0);
        let [mut x, mut y] = eccentricity(bearing, weights, body.nodes(), &journal.flexible);
        let apart = (sides.apart != [0.0; 2]).then_some(Apart {
            kernels: self.kernels,
            theta: journal.rotation,
            delta: sides.apart,
        });
        if let Some(place) = apart.and_then(|own| own.theta) {
            x.push((place, 0.0));
            y.push((place, 0.0));
        }
        Plane {
            law,
            bearing: number,
            other: None,
            springs,
            rows: [angle, x, y],
            apart,
            flank: None,
            run_out: between(&sides.run_out, weights),
            spin: body.rotation().and_then(|rotation| rotation.spin()),
            clearance: bearing.clearance,
            radius: radius.unwrap_or(0.0),
            arm: radius.filter(|radius| *radius > 0.0).unwrap_or(1.0),
        }
    }

    /// The only plane of another motion of a bearing, of a law by its place.
    pub(super) fn plane_of_other(
        &self,
        law: usize,
        (number, bearing): (usize, &Bearing),
        other: &OtherMotion,
        spring: usize,
    ) -> Plane {
        let [first, second] = bearing.sides.bodies.map(|body| &self.places[body]);
        let body = &self.bodies[bearing.sides.bodies[0]];
        let [x, y] = other.of_first(body, first.flexible.start);
        let turns = other.kind == MotionKind::Tilts;
        let rotations = [(first.rotation, 1.0), (second.rotation, -1.0)].into_iter();
        let angle = rotations.filter_map(|(place, sign)| Some((place.filter(|_| turns)?, sign)));
        Plane {
            law,
            bearing: number,
            other: Some(other.kind),
            springs: spring..spring + 1,
            rows: [angle.collect(), x, y],
            apart: None,
            flank: None,
            run_out: [0.0; 2],
            spin: body.rotation().and_then(|own| own.spin()).filter(|_| turns),
            clearance: bearing.clearance,
            radius: 0.0,
            arm: 1.0,
        }
    }

    /// The plane of a flank of gears, of a law by its place.
    pub(super) fn plane_of_flank(
        &self,
        law: usize,
        (number, bearing): (usize, &Bearing),
        flank: &Flank,
        spring: usize,
    ) -> Plane {
        let places = bearing.sides.bodies.map(|body| &self.places[body]);
        let rotations = gear::rotations(places);
        let nodes = self.bodies[bearing.sides.bodies[0]].nodes();
        let [x, y] = eccentricity(bearing, [0.0, 1.0, 0.0], nodes, &places[0].flexible);
        Plane {
            law,
            bearing: number,
            other: None,
            springs: spring..spring + 1,
            rows: [vec![(rotations[0], 1.0)], x, y],
            apart: None,
            flank: Some(FlankPlane { flank: *flank, rotations }),
            run_out: [0.0; 2],
            spin: None,
            clearance: bearing.clearance,
            radius: flank.radii[0],
            arm: flank.radii[0].abs(),
        }
    }
}

/// ε(z) = Σ A_i(z) ε_i, eqs. (11) to (13), as rows over the journal's body, whose coordinates stand at `place`.
fn eccentricity(
    bearing: &Bearing,
    weights: [f64; 3],
    nodes: &[BodyNode],
    place: &Range<usize>,
) -> [Vec<(usize, f64)>; 2] {
    [0, 1].map(|direction| {
        let row = (0..place.len()).map(|j| {
            let parts = bearing.journal.iter().zip(weights);
            let shape = |node: &usize| nodes[*node].shapes[(direction, j)];
            (place.start + j, parts.map(|(node, weight)| weight * shape(node)).sum())
        });
        row.filter(|&(_, value): &(usize, f64)| value != 0.0).collect()
    })
}
