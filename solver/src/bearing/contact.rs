//! Laws that take or give more than Q(h, ḣ): where they act, and what they do at one instant.

use std::ops::Range;

use whirl_specs::{Clearance, ContactState, ContactTangent, Ring};

use super::bore::{Bore, at_springs, journal_radius};
use super::law::ContactLaw;
use super::spin::Spin;
use super::state::{Motion, along, multiply};
use super::{Bearing, arms_of, eccentricity};
use crate::error::Error;
use crate::linalg::Matrix;
use crate::shaft::Shaft;
use crate::support::Support;

/// One plane in which such a law acts: at every spring, or once.
pub(crate) struct ContactPlane {
    /// Which bearing, counted from 0.
    pub(crate) bearing: usize,
    /// Springs, or 1.
    pub(crate) count: usize,
    /// ε_x and ε_y as Σ coefficient · η.
    pub(crate) eccentricity: [Vec<(usize, f64)>; 2],
    /// For every motion of the bore its first row in [`Contacts::bore`]; none if the law does not need it.
    pub(crate) motions: Vec<Option<usize>>,
    /// Radial clearance c (m).
    clearance: f64,
    /// Radius of the journal (m); of no effect where no law needs it and none is known.
    radius: f64,
    /// What moments are divided by to compare them with forces (m).
    arm: f64,
    table: Vec<f64>,
}

/// All such planes, law after law.
pub(crate) struct Contacts {
    pub(crate) laws: Vec<(ContactLaw, Range<usize>)>,
    pub(crate) planes: Vec<ContactPlane>,
    /// Motions of the bores from the support's coordinates (rows × coordinates).
    pub(crate) bore: Matrix,
    /// One column a row of `bore`.
    pub(crate) bore_transposed: Matrix,
    /// How far the journal moves in a plane by a unit of η_j, in the direction in which it does (planes × η).
    pub(crate) arms: Matrix,
}

impl Contacts {
    /// Places the laws, each with its place among all laws, in the bearings that name it.
    ///
    /// Noted in `errors`: a law that needs a radius which nothing gives; bore nodes through which no spline
    /// passes.
    pub(super) fn new(
        kernels: &Clearance,
        laws: Vec<(usize, ContactLaw)>,
        bearings: &[Bearing],
        shaft: &Shaft,
        support: &Support,
        errors: &mut Vec<Error>,
    ) -> Self {
        let mut planes = Vec::new();
        let mut placed = Vec::new();
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for (place, law) in laws {
            let first = planes.len();
            let kind = law.kind;
            let users = bearings.iter().enumerate().filter(|(_, b)| b.law == place);
            for (number, bearing) in users {
                let radius = match radius(&law, (number, bearing), support) {
                    Ok(radius) => radius,
                    Err(error) => {
                        errors.push(error);
                        continue;
                    }
                };
                let needed = kind.bore.iter().zip(law.motions());
                let along_ring = needed.filter(|(_, needed)| *needed).any(|(m, _)| at_springs(*m));
                let bore = match Bore::new(kernels, (number, bearing), support, along_ring) {
                    Ok(bore) => bore,
                    Err(wrong) => {
                        errors.extend(wrong);
                        continue;
                    }
                };
                let count = if kind.each_spring { bearing.angles.len() } else { 1 };
                let mut table = vec![0.0; kind.table * count];
                (kind.prepare)(&bearing.angles[..count.min(bearing.angles.len())], &mut table);
                for &station in &bearing.stations {
                    let mut motions = Vec::new();
                    for (motion, needed) in kind.bore.iter().zip(law.motions()) {
                        motions.push(needed.then_some(rows.len()));
                        if needed {
                            // A motion of the whole ring is that of each of its springs.
                            rows.extend(
                                bore.rows(station, *motion).into_iter().cycle().take(count),
                            );
                        }
                    }
                    planes.push(ContactPlane {
                        bearing: number,
                        count,
                        eccentricity: eccentricity(kernels, bearing, station, shaft),
                        motions,
                        clearance: bearing.clearance,
                        radius: radius.unwrap_or(0.0),
                        arm: radius.filter(|radius| *radius > 0.0).unwrap_or(1.0),
                        table: table.clone(),
                    });
                }
            }
            placed.push((law, first..planes.len()));
        }
        let bore = Matrix::from_fn(rows.len(), support.size(), |i, j| rows[i][j]);
        let bore_transposed = bore.transpose();
        let arms = planes.iter().map(|plane: &ContactPlane| &plane.eccentricity);
        let arms = arms_of(arms, shaft.size());
        Contacts { laws: placed, planes, bore, bore_transposed, arms }
    }

    /// Whether the law of a plane turns or brakes the journal: by a moment, or by a force at its surface.
    pub(crate) fn gives_torque(&self, plane: usize) -> bool {
        let turns = |law: &ContactLaw| {
            let mut forces = law.forces.iter().map(|&place| &law.kind.forces[place]);
            forces.any(|force| force.radius || force.unit != "N")
        };
        self.laws.iter().any(|(law, planes)| planes.contains(&plane) && turns(law))
    }

    /// Number of forces: every force that a law gives, at every spring or ring.
    pub(crate) fn forces(&self) -> usize {
        let of_law = |(law, planes): &(ContactLaw, Range<usize>)| {
            let counts = self.planes[planes.clone()].iter().map(|plane| plane.count);
            law.forces.len() * counts.sum::<usize>()
        };
        self.laws.iter().map(of_law).sum()
    }
}

/// The journal's radius, where it is known.
fn radius(
    law: &ContactLaw,
    (place, bearing): (usize, &Bearing),
    support: &Support,
) -> Result<Option<f64>, Error> {
    let radius = bearing.journal_radius.or_else(|| journal_radius(bearing, support));
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

/// What the laws of [`Contacts`] do at one instant. Allocated once, filled at will.
pub(crate) struct ContactsState {
    pub(super) planes: Vec<PlaneState>,
    /// The turn of the journals in their frame, where they spin in it.
    pub(super) spin: Option<Spin>,
    /// Motions of the bores and their rates.
    bore: Vec<f64>,
    bore_dot: Vec<f64>,
    pub(super) law_inputs: Vec<f64>,
    law_outputs: Vec<f64>,
    pub(super) law_workspace: Vec<f64>,
}

/// One plane; rows as in [`whirl_specs::Contact`].
pub(super) struct PlaneState {
    /// θ, ε_x and ε_y as the machine's coordinates give them, and their rates.
    pub(super) position: [f64; 3],
    pub(super) velocity: [f64; 3],
    /// The same in the frame that turns with the journal.
    ring: Ring,
    pub(super) bore: Vec<f64>,
    pub(super) bore_dot: Vec<f64>,
    inputs: Vec<f64>,
    pub(super) forces: Vec<f64>,
    slopes: Vec<f64>,
    ring_force: [f64; 3],
    pub(super) bore_force: Vec<f64>,
}

impl ContactsState {
    /// Memory for the planes.
    pub(crate) fn new(contacts: &Contacts) -> Self {
        let of_law = |(law, planes): &(ContactLaw, Range<usize>)| {
            let kind = law.kind;
            let plane = |plane: &ContactPlane| {
                let row = |rows: usize| vec![0.0; rows * plane.count];
                PlaneState {
                    position: [0.0; 3],
                    velocity: [0.0; 3],
                    ring: Ring::default(),
                    bore: row(kind.bore.len()),
                    bore_dot: row(kind.bore.len()),
                    inputs: row(kind.inputs.len()),
                    forces: row(kind.forces.len()),
                    slopes: row(kind.forces.len() * kind.inputs.len()),
                    ring_force: [0.0; 3],
                    bore_force: row(kind.bore.len()),
                }
            };
            contacts.planes[planes.clone()].iter().map(plane).collect::<Vec<_>>()
        };
        let most = |of: fn(&ContactLaw) -> usize| {
            let rows = contacts.laws.iter().map(|(law, planes)| {
                let counts = contacts.planes[planes.clone()].iter().map(|plane| plane.count);
                of(law) * counts.sum::<usize>()
            });
            rows.max().unwrap_or(0)
        };
        let workspace = contacts.laws.iter().map(|(law, _)| law.law.workspace()).max();
        ContactsState {
            planes: contacts.laws.iter().flat_map(of_law).collect(),
            spin: None,
            bore: vec![0.0; contacts.bore.rows],
            bore_dot: vec![0.0; contacts.bore.rows],
            law_inputs: vec![0.0; most(|law| law.inputs.len())],
            law_outputs: vec![0.0; most(|law| law.forces.len() * (1 + law.inputs.len()))],
            law_workspace: vec![0.0; workspace.unwrap_or(0)],
        }
    }

    /// Computes everything but the tangent from the motion, and the forces tested for convergence (N):
    /// law after law, force after force, plane after plane; moments over the journal's radius.
    pub(crate) fn update(&mut self, contacts: &Contacts, motion: Motion, tested: &mut [f64]) {
        multiply(&contacts.bore, motion.support, &mut self.bore);
        multiply(&contacts.bore, motion.support_dot, &mut self.bore_dot);
        self.spin = motion.spin.map(Spin::new);
        let mut tested = tested.iter_mut();
        for (law, range) in &contacts.laws {
            for place in range.clone() {
                self.move_plane(contacts, place, motion);
            }
            self.act(contacts, law, range.clone());
            for &force in &law.forces {
                let is_moment = law.kind.forces[force].unit != "N";
                for place in range.clone() {
                    let plane = &contacts.planes[place];
                    let scale = if is_moment { 1.0 / plane.arm } else { 1.0 };
                    let row = &self.planes[place].forces[force * plane.count..][..plane.count];
                    row.iter().zip(&mut tested).for_each(|(value, out)| *out = scale * value);
                }
            }
        }
    }

    /// The motion of a plane.
    fn move_plane(&mut self, contacts: &Contacts, place: usize, motion: Motion) {
        let (plane, own) = (&contacts.planes[place], &mut self.planes[place]);
        let [x, y] = &plane.eccentricity;
        own.position = [motion.theta, along(x, motion.eta), along(y, motion.eta)];
        own.velocity = [motion.theta_dot, along(x, motion.eta_dot), along(y, motion.eta_dot)];
        let rows = plane.motions.iter().zip(own.bore.chunks_exact_mut(plane.count.max(1)));
        for ((row, values), rates) in rows.zip(own.bore_dot.chunks_exact_mut(plane.count.max(1))) {
            if let Some(row) = *row {
                values.copy_from_slice(&self.bore[row..row + plane.count]);
                rates.copy_from_slice(&self.bore_dot[row..row + plane.count]);
            }
        }
    }

    /// What a law does in `planes`, from how they move.
    pub(super) fn act(&mut self, contacts: &Contacts, law: &ContactLaw, planes: Range<usize>) {
        for place in planes.clone() {
            let (plane, own) = (&contacts.planes[place], &mut self.planes[place]);
            let c = plane.clearance;
            own.ring = match &self.spin {
                Some(spin) => {
                    let ([_, x, y], [_, x_dot, y_dot]) = (own.position, own.velocity);
                    spin.ring([x, y], [x_dot, y_dot], c)
                }
                None => Ring { position: own.position, velocity: own.velocity, c },
            };
            let state = ContactState {
                table: &plane.table,
                ring: &own.ring,
                radius: plane.radius,
                bore: &own.bore,
                bore_dot: &own.bore_dot,
            };
            (law.kind.evaluate)(plane.count, &state, &mut own.inputs);
        }
        self.evaluate(contacts, law, planes.clone());
        for place in planes {
            let (plane, own) = (&contacts.planes[place], &mut self.planes[place]);
            let state = ContactState {
                table: &plane.table,
                ring: &own.ring,
                radius: plane.radius,
                bore: &own.bore,
                bore_dot: &own.bore_dot,
            };
            let (ring, bore) = (&mut own.ring_force, &mut own.bore_force);
            (law.kind.force)(plane.count, &state, &own.forces, ring, bore);
        }
    }

    /// What a law takes over all its planes, one row an input; the number of springs or rings.
    pub(super) fn gather(
        &mut self,
        contacts: &Contacts,
        law: &ContactLaw,
        planes: Range<usize>,
    ) -> usize {
        let count = |place: usize| contacts.planes[place].count;
        let total: usize = planes.clone().map(count).sum();
        for (&input, row) in law.inputs.iter().zip(self.law_inputs.chunks_exact_mut(total.max(1))) {
            let mut start = 0;
            for place in planes.clone() {
                let n = count(place);
                let values = &self.planes[place].inputs[input * n..(input + 1) * n];
                row[start..start + n].copy_from_slice(values);
                start += n;
            }
        }
        total
    }

    /// Evaluates a law over all its planes at once.
    fn evaluate(&mut self, contacts: &Contacts, law: &ContactLaw, planes: Range<usize>) {
        let count = |place: usize| contacts.planes[place].count;
        let total = self.gather(contacts, law, planes.clone());
        let inputs = &self.law_inputs[..law.inputs.len() * total];
        let outputs = &mut self.law_outputs[..law.forces.len() * (1 + law.inputs.len()) * total];
        law.law.evaluate(total, inputs, outputs, &mut self.law_workspace);
        let mut rows = self.law_outputs.chunks_exact(total.max(1));
        for &force in &law.forces {
            let values = rows.next().expect("a row an output");
            let mut start = 0;
            for place in planes.clone() {
                let n = count(place);
                let own = &mut self.planes[place].forces[force * n..(force + 1) * n];
                own.copy_from_slice(&values[start..start + n]);
                start += n;
            }
            for &input in &law.inputs {
                let values = rows.next().expect("a row a derivative");
                let row = force * law.kind.inputs.len() + input;
                let mut start = 0;
                for place in planes.clone() {
                    let n = count(place);
                    let own = &mut self.planes[place].slopes[row * n..(row + 1) * n];
                    own.copy_from_slice(&values[start..start + n]);
                    start += n;
                }
            }
        }
    }

    /// Generalised forces on (θ, ε_x, ε_y) of a plane: N·m, N, N; ε as the machine's coordinates give it.
    pub(crate) fn plane_force(&self, plane: usize) -> [f64; 3] {
        let force = self.planes[plane].ring_force;
        self.spin.as_ref().map_or(force, |spin| spin.force(force))
    }

    /// Torque on the journal about its own centre in a plane (N·m): the generalised force on θ without the
    /// moment that the forces on the displaced centre have about the axis.
    pub(crate) fn plane_torque(&self, plane: usize) -> f64 {
        let own = &self.planes[plane];
        let ([_, x, y], [moment, along_x, along_y]) = (own.ring.position, own.ring_force);
        moment - (x * along_y - y * along_x)
    }

    /// Adds the generalised forces on θ, η and the support's coordinates.
    pub(crate) fn add_forces(
        &self,
        contacts: &Contacts,
        theta: &mut f64,
        eta: &mut [f64],
        support: &mut [f64],
    ) {
        for (place, (plane, own)) in contacts.planes.iter().zip(&self.planes).enumerate() {
            let ring_force = self.plane_force(place);
            *theta += ring_force[0];
            for (row, value) in plane.eccentricity.iter().zip(&ring_force[1..]) {
                row.iter().for_each(|&(j, coefficient)| eta[j] += coefficient * value);
            }
            for (row, forces) in plane.motions.iter().zip(own.bore_force.chunks(plane.count.max(1)))
            {
                let Some(row) = *row else { continue };
                for (j, &force) in forces.iter().enumerate().filter(|(_, force)| **force != 0.0) {
                    let column = contacts.bore_transposed.col(row + j);
                    support
                        .iter_mut()
                        .zip(column)
                        .for_each(|(sum, coefficient)| *sum += coefficient * force);
                }
            }
        }
    }

    /// Hands |force| projected on a coordinate of the shaft (θ is 0, η_j is 1 + j) to `add`, force by force;
    /// `tested` as [`ContactsState::update`] leaves it.
    pub(crate) fn projected_on_shaft(
        &self,
        contacts: &Contacts,
        place: usize,
        tested: &[f64],
        add: &mut impl FnMut(f64),
    ) {
        let mut tested = tested.iter();
        for (law, planes) in &contacts.laws {
            for &force in &law.forces {
                let is_moment = law.kind.forces[force].unit != "N";
                for number in planes.clone() {
                    let (plane, own) = (&contacts.planes[number], &self.planes[number]);
                    let [_, x, y] = own.ring.position;
                    let arm = match place.checked_sub(1) {
                        None if is_moment => plane.arm,
                        None => plane.radius + x.hypot(y),
                        Some(_) if is_moment => 0.0,
                        Some(j) => contacts.arms[(number, j)],
                    };
                    let forces = tested.by_ref().take(plane.count);
                    forces.for_each(|force| add(arm * force.abs()));
                }
            }
        }
    }

    /// Hands |force| projected on a coordinate of the support to `add`, force by force.
    pub(crate) fn projected_on_support(
        &self,
        contacts: &Contacts,
        coordinate: usize,
        add: &mut impl FnMut(f64),
    ) {
        for (plane, own) in contacts.planes.iter().zip(&self.planes) {
            let forces = own.bore_force.chunks(plane.count.max(1));
            for (row, forces) in plane.motions.iter().zip(forces) {
                let Some(row) = *row else { continue };
                for (j, force) in forces.iter().enumerate() {
                    add((contacts.bore[(row + j, coordinate)] * force).abs());
                }
            }
        }
    }

    /// The derivatives of the generalised forces of a plane of `law`, B + a1 P; see [`ContactTangent`].
    pub(crate) fn tangent(
        &self,
        contacts: &Contacts,
        law: &ContactLaw,
        plane: usize,
        a1: f64,
        out: &mut ContactTangent,
    ) {
        let (own, place) = (&self.planes[plane], &contacts.planes[plane]);
        let state = ContactState {
            table: &place.table,
            ring: &own.ring,
            radius: place.radius,
            bore: &own.bore,
            bore_dot: &own.bore_dot,
        };
        let mut tangent = |a1: f64| {
            (law.kind.tangent)(place.count, &state, &own.forces, &own.slopes, a1, out);
            out.ring_ring
        };
        // B + a1 P is linear in a1. What `out` holds of the bore in the end is of a1 itself.
        let step = if a1 > 0.0 { a1 } else { 1.0 };
        let beyond = self.spin.as_ref().map(|spin| (spin, tangent(a1 + step)));
        let both = tangent(a1);
        if let Some((spin, more)) = beyond {
            let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| (more[i][j] - both[i][j]) / step));
            out.ring_ring = spin.tangent(&both, &rate);
        }
    }
}
