//! Where springs stand: every law in the planes of the bearings that name it.

use std::ops::Range;
use std::sync::Arc;

use whirl_specs::{BoreMotion, Clearance, ContactPlace};

use super::Bearing;
use super::apart::Apart;
use super::bore::{Bore, at_springs, between, journal_radius};
use super::bores::Bores;
use super::gear::{self, Flank, FlankPlane, Gear, GearRow};
use super::law::{BoundLaw, SpringLaw};
use super::other::{MotionKind, OtherMotion};
use super::part::Part;
use super::placed_law::PlacedLaw;
use super::plane::Plane;
use super::section::SectionMotion;
use super::springs::Springs;
use super::valid::Measures;
use crate::bodies::{Body, BodyPlace};
use crate::body::BodyNode;
use crate::error::Error;
use crate::linalg::Matrix;

impl Springs {
    /// Places the springs of all bearings between bodies whose coordinates stand at `places` in q.
    ///
    /// # Errors
    /// A law whose inputs no spring has, or that needs a radius which nothing gives; bore nodes through which no
    /// spline passes.
    pub(crate) fn new(
        kernels: &'static Clearance,
        laws: Vec<Box<dyn SpringLaw>>,
        bearings: &[Bearing],
        bodies: &[Body],
        places: &[BodyPlace],
    ) -> Result<Self, Error> {
        let mut placing = Placing {
            kernels,
            bodies,
            places,
            laws: Vec::new(),
            planes: Vec::new(),
            bores: Vec::new(),
            errors: Vec::new(),
        };
        for (place, law) in laws.into_iter().enumerate() {
            let name = law.name().to_owned();
            let users: Vec<Part> =
                Part::all(bearings).into_iter().filter(|part| part.law == place).collect();
            match BoundLaw::new(Arc::from(law), kernels.contacts) {
                Ok(law) => placing.place(&law, &users),
                Err(wrong) => {
                    let bearing = users.first().map(|part| part.number);
                    let (what, help) = (wrong.what, wrong.help);
                    placing.errors.push(Error::Law { law: name, bearing, what, help });
                }
            }
        }
        let Placing { laws, planes, bores, errors, .. } = placing;
        Error::of_all(errors)?;
        let bores: Vec<Bores> = bores.into_iter().map(|own| own.placed(places)).collect();
        let size = places.iter().map(|own| own.flexible.end).max().unwrap_or(0);
        let arms = arms(&planes, places, size);
        let measures = Measures::new(bearings, &laws, &planes);
        Ok(Springs {
            bearings: bearings.len(),
            reach: reach(&planes, bearings, bodies, places, &bores, &arms),
            bores,
            laws,
            planes,
            arms,
            measures,
        })
    }
}

/// Springs that stand so far.
struct Placing<'a> {
    kernels: &'static Clearance,
    bodies: &'a [Body],
    places: &'a [BodyPlace],
    laws: Vec<PlacedLaw>,
    planes: Vec<Plane>,
    bores: Vec<PlacingBores>,
    errors: Vec<Error>,
}

/// The bodies on whose coordinates a row of T_b is: that of the bore, and that of the journal where its section moves in its
/// frame.
#[derive(Clone, Copy, PartialEq)]
struct Joined {
    bore: usize,
    twisted: Option<usize>,
    /// θ of the body of the bore by its place in q, where it is unknown and rows of gears have it.
    turned: Option<usize>,
}

impl Joined {
    fn of(part: &Part, bodies: &[Body], places: &[BodyPlace]) -> Self {
        let [journal, bore] = part.bearing.sides.bodies;
        let sides = &part.bearing.sides;
        let twists = part.other.is_none()
            && (sides.torque_section.is_some() || sides.whole_sections[0].is_some());
        let twists = twists || sides.gear.is_some() && sides.sections[0].is_some();
        let turned =
            places[bore].rotation.filter(|_| sides.gear.is_some() && is_free(&bodies[bore]));
        Joined { bore, twisted: twists.then_some(journal), turned }
    }

    /// All coordinates between the first and the last of both in q.
    fn place(self, places: &[BodyPlace]) -> Range<usize> {
        let mut own = places[self.bore].flexible.clone();
        own.start = self.turned.unwrap_or(own.start);
        let Some(other) = self.twisted.map(|body| places[body].flexible.clone()) else {
            return own;
        };
        match (own.is_empty(), other.is_empty()) {
            (true, _) => other,
            (_, true) => own,
            _ => own.start.min(other.start)..own.end.max(other.end),
        }
    }
}

/// Whether θ of a body is unknown.
fn is_free(body: &Body) -> bool {
    body.rotation().is_some_and(|own| own.given(0.0, false).is_none())
}

/// Rows of T_b so far, and b0 in them.
struct PlacingBores {
    joined: Joined,
    rows: Vec<Vec<f64>>,
    offset: Vec<f64>,
    given: Vec<(usize, usize, f64)>,
}

impl PlacingBores {
    fn placed(self, places: &[BodyPlace]) -> Bores {
        let place = self.joined.place(places);
        let rows = Matrix::from_fn(self.rows.len(), place.len(), |i, j| self.rows[i][j]);
        let offset = self.offset.iter().any(|b0| *b0 != 0.0).then_some(self.offset);
        Bores::new(place, rows, offset, self.given)
    }
}

/// A motion of all bores of a law: rows of T_b, and b0 in them.
#[derive(Clone, Default)]
struct MotionRows {
    rows: Vec<Vec<f64>>,
    offset: Vec<f64>,
}

impl MotionRows {
    /// Whether nothing moves so.
    fn are_zero(&self) -> bool {
        self.rows.iter().flatten().chain(&self.offset).all(|value| *value == 0.0)
    }
}

impl Placing<'_> {
    /// Places a law in the bearings that name it, body of the bores by body.
    fn place(&mut self, law: &BoundLaw, users: &[Part]) {
        let mut all: Vec<Joined> = Vec::new();
        let of = |part: &Part| Joined::of(part, self.bodies, self.places);
        for joined in users.iter().map(of) {
            if !all.contains(&joined) {
                all.push(joined);
            }
        }
        let mut all_users = Vec::with_capacity(all.len());
        for joined in all {
            let users = users.iter().filter(|part| of(part) == joined);
            all_users.push((joined, users.copied().collect::<Vec<Part>>()));
        }
        for (joined, users) in all_users {
            self.place_in(law.clone(), joined, &users);
        }
    }

    /// Places a law in bearings that join the same bodies.
    fn place_in(&mut self, law: BoundLaw, joined: Joined, users: &[Part]) {
        let (body, place) = (joined.bore, joined.place(self.places));
        // A row over the coordinates of one body as one over those of both.
        let wide = |row: Vec<f64>, of: usize| {
            let mut wide = vec![0.0; place.len()];
            if !row.is_empty() {
                let from = self.places[of].flexible.start - place.start;
                wide[from..from + row.len()].copy_from_slice(&row);
            }
            wide
        };
        let (kind, first) = (law.kind, self.planes.len());
        let needed = law.motions();
        let mut motions = vec![MotionRows::default(); kind.bore.len()];
        let mut angles = Vec::new();
        // Of rotations that are given: motion, spring, place in q, coefficient.
        let mut given = Vec::new();
        for part in users {
            let &Part { number, bearing, other, .. } = part;
            if let Some((what, help)) = part.misplaced(kind, self.bodies) {
                let (law, bearing) = (law.law.name().to_owned(), Some(number));
                self.errors.push(Error::Law { law, bearing, what, help });
                continue;
            }
            if let Some(other) = other {
                for ((motion, needed), own) in kind.bore.iter().zip(&needed).zip(&mut motions) {
                    if *needed {
                        own.rows.push(wide(other.of_second(&self.bodies[body], *motion), body));
                        own.offset.push(0.0);
                    }
                }
                let spring = angles.len();
                angles.push(0.0);
                let plane = self.plane_of_other((number, bearing), other, spring);
                self.planes.push(plane);
                continue;
            }
            if let Some(gear) = &bearing.sides.gear {
                let bodies = bearing.sides.bodies.map(|body| &self.bodies[body]);
                for flank in &gear.flanks {
                    for (place_of_motion, motion) in kind.bore.iter().enumerate() {
                        let found =
                            GearRow::new(bearing.sides.sections, (gear, flank), bodies, *motion);
                        let mut row = wide(found.row, bearing.sides.bodies[found.side]);
                        if found.by_rotation != 0.0 {
                            let theta = self.places[body].rotation;
                            match joined.turned {
                                Some(theta) => row[theta - place.start] += found.by_rotation,
                                None => given.extend(theta.map(|theta| {
                                    (place_of_motion, angles.len(), theta, found.by_rotation)
                                })),
                            }
                        }
                        motions[place_of_motion].rows.push(row);
                        motions[place_of_motion].offset.push(found.offset);
                    }
                    let spring = angles.len();
                    angles.push(0.0);
                    let plane = self.plane_of_flank((number, bearing), (gear, flank), spring);
                    self.planes.push(plane);
                }
                continue;
            }
            let radius = self.radius(&law, (number, bearing));
            let along_ring = kind.bore.iter().zip(&needed).any(|(m, own)| *own && at_springs(*m));
            let bore = Bore::new(self.kernels, (number, bearing), &self.bodies[body], along_ring);
            let (radius, bore) = match (radius, bore) {
                (Ok(radius), Ok(bore)) => (radius, bore),
                (radius, bore) => {
                    self.errors.extend(radius.err());
                    self.errors.extend(bore.err().into_iter().flatten());
                    continue;
                }
            };
            let each_spring = kind.place == ContactPlace::Spring;
            let count = if each_spring { bearing.angles.len() } else { 1 };
            for (place, &station) in bearing.stations.iter().enumerate() {
                for ((motion, needed), own) in kind.bore.iter().zip(&needed).zip(&mut motions) {
                    if *needed {
                        let (rows, of, offset) = match SectionMotion::of(*motion) {
                            Some(own) => {
                                let of = bearing.sides.bodies[own.side];
                                (vec![own.row(bearing, &self.bodies[of])], of, vec![0.0])
                            }
                            None => {
                                let rows = bore.rows(place, *motion);
                                (rows, body, bore.offset(station, *motion))
                            }
                        };
                        let rows = rows.into_iter().map(|row| wide(row, of));
                        // A motion of the whole ring is that of each of its springs.
                        let rows: Vec<Vec<f64>> = rows.collect();
                        own.rows.extend(rows.into_iter().cycle().take(count));
                        own.offset.extend(offset.into_iter().cycle().take(count));
                    }
                }
                let start = angles.len();
                angles.extend(bearing.angles.iter().copied().chain([0.0]).take(count));
                let springs = start..angles.len();
                let plane = self.plane((number, bearing), station, springs, radius);
                self.planes.push(plane);
            }
        }
        let mut table = vec![0.0; kind.table * angles.len()];
        (kind.prepare)(&angles, &mut table);
        let bores = self.bores_of(joined);
        let own = &mut self.bores[bores];
        let may_be_none = |motion: &BoreMotion| {
            *motion == BoreMotion::MeanTurn || SectionMotion::of(*motion).is_some()
        };
        let motions = motions.into_iter().zip(&needed).zip(kind.bore);
        let motions = motions.map(|((motion, needed), kind)| {
            // What is rigid has no turn of its own, and the ground has no motion.
            if !needed || may_be_none(kind) && motion.are_zero() {
                return None;
            }
            let first = own.rows.len();
            own.rows.extend(motion.rows);
            own.offset.extend(motion.offset);
            Some(first)
        });
        let motions: Vec<Option<usize>> = motions.collect();
        own.given.extend(given.into_iter().filter_map(|(motion, spring, theta, coefficient)| {
            Some((motions[motion]? + spring, theta, coefficient))
        }));
        let (planes, springs) = (first..self.planes.len(), angles.len());
        self.laws.push(PlacedLaw { bound: law, planes, springs, table, bores, motions });
    }

    /// The place of the bores between bodies, which are added if they are new.
    fn bores_of(&mut self, joined: Joined) -> usize {
        let known = self.bores.iter().position(|own| own.joined == joined);
        known.unwrap_or_else(|| {
            self.bores.push(PlacingBores {
                joined,
                rows: Vec::new(),
                offset: Vec::new(),
                given: Vec::new(),
            });
            self.bores.len() - 1
        })
    }

    /// The plane of a bearing at `station`, of the law that is placed next.
    fn plane(
        &self,
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
            law: self.laws.len(),
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

    /// The only plane of another motion of a bearing, of the law that is placed next.
    fn plane_of_other(
        &self,
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
            law: self.laws.len(),
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

    /// The plane of a flank of gears, of the law that is placed next.
    fn plane_of_flank(
        &self,
        (number, bearing): (usize, &Bearing),
        (_, flank): (&Gear, &Flank),
        spring: usize,
    ) -> Plane {
        let places = bearing.sides.bodies.map(|body| &self.places[body]);
        let rotations = gear::rotations(places);
        let nodes = self.bodies[bearing.sides.bodies[0]].nodes();
        let [x, y] = eccentricity(bearing, [0.0, 1.0, 0.0], nodes, &places[0].flexible);
        Plane {
            law: self.laws.len(),
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

    /// The journal's radius, where it is known.
    fn radius(
        &self,
        law: &BoundLaw,
        (place, bearing): (usize, &Bearing),
    ) -> Result<Option<f64>, Error> {
        let nodes = self.bodies[bearing.sides.bodies[1]].nodes();
        let radius = bearing.journal_radius.or_else(|| journal_radius(bearing, nodes));
        match (radius, law.needs_radius()) {
            (None, Some(name)) => Err(Error::Law {
                law: law.law.name().to_owned(),
                bearing: Some(place),
                what: format!(
                    "needs the journal's radius for {name}, but {} gives none and has no bore to take it from",
                    bearing.name
                ),
                help: "add `journal_radius = \"25 mm\"`, with the radius that the journal has"
                    .to_owned(),
            }),
            _ => Ok(radius),
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

/// √(ε_x² + ε_y²) by a unit of each coordinate, one row a plane; zero for rotations.
fn arms(planes: &[Plane], places: &[BodyPlace], size: usize) -> Matrix {
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
fn reach(
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
