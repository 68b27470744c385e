//! Where springs stand: every law in the planes of the bearings that name it.

use std::sync::Arc;

use whirl_specs::{BoreMotion, Clearance, ContactPlace};

use super::Bearing;
use super::bore::{Bore, at_springs, journal_radius};
use super::bores::Bores;
use super::film_shapes::{self, AtRest};
use super::gear::GearRow;
use super::joined::{Joined, MotionRows, PlacingBores};
use super::law::{BoundLaw, SpringLaw};
use super::part::Part;
use super::placed_law::PlacedLaw;
use super::placed_planes::Sites;
use super::plane::Plane;
use super::reach::{arms, reach};
use super::section::SectionMotion;
use super::springs::Springs;
use super::valid::Measures;
use crate::bodies::{Body, BodyPlace};
use crate::error::Error;

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
            sites: Sites { kernels, bodies, places },
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
    sites: Sites<'a>,
    laws: Vec<PlacedLaw>,
    planes: Vec<Plane>,
    bores: Vec<PlacingBores>,
    errors: Vec<Error>,
}

impl Placing<'_> {
    /// Places a law in the bearings that name it, body of the bores by body.
    fn place(&mut self, law: &BoundLaw, users: &[Part]) {
        let mut all: Vec<Joined> = Vec::new();
        let of = |part: &Part| Joined::of(part, self.sites.bodies, self.sites.places);
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
        let (body, place) = (joined.bore, joined.place(self.sites.places));
        // A row over the coordinates of one body as one over those of both.
        let wide = |row: Vec<f64>, of: usize| {
            let mut wide = vec![0.0; place.len()];
            if !row.is_empty() {
                let from = self.sites.places[of].flexible.start - place.start;
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
            if let Some((what, help)) = part.misplaced(kind, self.sites.bodies) {
                let (law, bearing) = (law.law.name().to_owned(), Some(number));
                self.errors.push(Error::Law { law, bearing, what, help });
                continue;
            }
            if let Some(other) = other {
                for ((motion, needed), own) in kind.bore.iter().zip(&needed).zip(&mut motions) {
                    if *needed {
                        own.rows
                            .push(wide(other.of_second(&self.sites.bodies[body], *motion), body));
                        own.offset.push(0.0);
                    }
                }
                let spring = angles.len();
                angles.push(0.0);
                let plane =
                    self.sites.plane_of_other(self.laws.len(), (number, bearing), other, spring);
                self.planes.push(plane);
                continue;
            }
            if let Some(gear) = &bearing.sides.gear {
                let bodies = bearing.sides.bodies.map(|body| &self.sites.bodies[body]);
                for flank in &gear.flanks {
                    for (place_of_motion, motion) in kind.bore.iter().enumerate() {
                        let found =
                            GearRow::new(bearing.sides.sections, (gear, flank), bodies, *motion);
                        let mut row = wide(found.row, bearing.sides.bodies[found.side]);
                        if found.by_rotation != 0.0 {
                            let theta = self.sites.places[body].rotation;
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
                    let plane = self.sites.plane_of_flank(
                        self.laws.len(),
                        (number, bearing),
                        flank,
                        spring,
                    );
                    self.planes.push(plane);
                }
                continue;
            }
            let radius = self.radius(&law, (number, bearing));
            let along_ring = kind.bore.iter().zip(&needed).any(|(m, own)| *own && at_springs(*m));
            let bore = Bore::new(
                self.sites.kernels,
                (number, bearing),
                &self.sites.bodies[body],
                along_ring,
            );
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
                                (vec![own.row(bearing, &self.sites.bodies[of])], of, vec![0.0])
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
                let plane =
                    self.sites.plane(self.laws.len(), (number, bearing), station, springs, radius);
                self.planes.push(plane);
            }
        }
        let mut table = vec![0.0; kind.table * angles.len()];
        (kind.prepare)(&angles, &mut table);
        // The joint of a film has a law of its own.
        let shapes = match (users, &self.planes[first..]) {
            ([part], [plane]) if film_shapes::gives_way(&law, part.bearing) => {
                let own = |row: &Vec<f64>| {
                    let from = self.sites.places[body].flexible.start - place.start;
                    row[from..][..self.sites.bodies[body].size()].to_vec()
                };
                let rows = motions.iter().enumerate();
                let rows = rows.filter_map(|(motion, all)| Some((motion, own(all.rows.first()?))));
                let rows: Vec<(usize, Vec<f64>)> = rows.collect();
                let (radius, clearance) = (plane.radius, plane.clearance);
                let at = AtRest { table: &table, radius, clearance };
                let body = &self.sites.bodies[body];
                film_shapes::shapes_of(&law, part.bearing, body, &rows, &at)
            }
            _ => None,
        };
        let shapes = shapes.map(|(shapes, rows)| {
            (shapes, rows.into_iter().map(|row| wide(row, body)).collect::<Vec<Vec<f64>>>())
        });
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
        let mut motions: Vec<Option<usize>> = motions.collect();
        let shapes = shapes.map(|(shapes, rows)| {
            motions.extend((0..rows.len()).map(|k| Some(own.rows.len() + k)));
            own.offset.extend(rows.iter().map(|_| 0.0));
            own.rows.extend(rows);
            shapes
        });
        own.given.extend(given.into_iter().filter_map(|(motion, spring, theta, coefficient)| {
            Some((motions[motion]? + spring, theta, coefficient))
        }));
        let (planes, springs) = (first..self.planes.len(), angles.len());
        self.laws.push(PlacedLaw { bound: law, planes, springs, table, bores, motions, shapes });
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

    /// The journal's radius, where it is known.
    fn radius(
        &self,
        law: &BoundLaw,
        (place, bearing): (usize, &Bearing),
    ) -> Result<Option<f64>, Error> {
        let nodes = self.sites.bodies[bearing.sides.bodies[1]].nodes();
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
