//! The parts of a machine, each of which is judged by itself: every body by its root mean square displacement, and every
//! rotation that joints hold elastically. Turns that nothing holds are others (`turns`).

use std::ops::Range;

use super::masses::{known_mass, mass};
use super::moving_part::MovingPart;
use super::turns::FreeTurn;
use crate::bearing::Tied;
use crate::equations::{Equations, State};
use crate::linalg::{Matrix, dot};
use crate::machine::{Body, Machine};
use crate::trains::Trains;

/// A part of a machine, and how its motion is measured (m).
pub(in crate::dynamics) struct Part {
    /// Its body.
    pub(in crate::dynamics) body: usize,
    /// Where its coordinates stand among the unknowns.
    pub(in crate::dynamics) place: Range<usize>,
    weight: Weight,
}

enum Weight {
    /// √(J0/m) of an angle (m), and m.
    Angle(f64, f64),
    /// The mass matrix and the mass.
    Mass(Matrix, f64),
    /// The mass, where the mass matrix is the identity.
    Identity(f64),
}

impl Part {
    /// Whether it is the rotation of its body.
    pub(in crate::dynamics) fn turns(&self) -> bool {
        matches!(self.weight, Weight::Angle(..))
    }

    pub(in crate::dynamics) fn moving(&self) -> MovingPart {
        MovingPart { body: self.body, turns: self.turns() }
    }

    /// The most that a displacement of it says of how far it moves (m): one radian, as what turns further slips, and what it swings by
    /// meanwhile is not less.
    pub(in crate::dynamics) fn most(&self) -> f64 {
        match self.weight {
            Weight::Angle(radius, _) => radius,
            Weight::Mass(..) | Weight::Identity(_) => f64::INFINITY,
        }
    }

    /// The size of a motion, over the unknowns (m).
    pub(in crate::dynamics) fn measure(&self, x: &[f64]) -> f64 {
        let x = &x[self.place.clone()];
        match &self.weight {
            Weight::Angle(radius, _) => x[0].abs() * radius,
            Weight::Mass(matrix, mass) => {
                let columns = x.iter().enumerate();
                let square: f64 = columns.map(|(j, x_j)| x_j * dot(matrix.col(j), x)).sum();
                // Rounding may leave a little less than nothing; what is no number stays that.
                (if square < 0.0 { 0.0 } else { square } / mass).sqrt()
            }
            Weight::Identity(mass) => (dot(x, x) / mass).sqrt(),
        }
    }

    /// What the square of a size is multiplied by to make it twice a kinetic energy (kg).
    pub(in crate::dynamics) fn mass(&self) -> f64 {
        match self.weight {
            Weight::Angle(_, mass) | Weight::Mass(_, mass) | Weight::Identity(mass) => mass,
        }
    }

    /// Kinetic energy of what is no rotation at these rates of the unknowns (J); that of a rotation is not counted.
    pub(in crate::dynamics) fn kinetic_energy(&self, rates: &[f64]) -> f64 {
        match self.weight {
            Weight::Angle(..) => 0.0,
            Weight::Mass(_, mass) | Weight::Identity(mass) => {
                0.5 * mass * self.measure(rates).powi(2)
            }
        }
    }
}

/// The parts of a machine, and what their angles are counted from.
pub(in crate::dynamics) struct Parts {
    first: usize,
    pub(in crate::dynamics) all: Vec<Part>,
    /// Turns that nothing elastic holds.
    pub(in crate::dynamics) turns: Vec<FreeTurn>,
    groups: Vec<Group>,
}

/// Rotations that joints couple elastically.
struct Group {
    /// Places in q, with J0 and the speed at which each turns where the group turns with 1 rad/s.
    members: Vec<(usize, f64, f64)>,
    from: From,
}

/// What the angles of a group are counted from: they grow without bound where nothing holds them.
enum From {
    /// Nothing: a spring ties the group to what stands.
    Ground,
    /// A rotation that is given, at a place of q, times a ratio.
    Given(usize, f64),
    /// Their own mean, weighted by inertia.
    Mean,
}

impl Parts {
    /// Of a machine whose tangent was just evaluated at rest.
    pub(in crate::dynamics) fn new(equations: &Equations) -> Self {
        let machine = equations.machine;
        let first = machine.first_unknown();
        let groups = groups(equations);
        let mut all = Vec::new();
        for (number, (body, place)) in machine.bodies.iter().zip(machine.places()).enumerate() {
            let within = place.flexible.start - first..place.flexible.end - first;
            let weight = match body {
                Body::Turning { shaft, .. } => {
                    let mass = mass(body, shaft);
                    let held = place.rotation.filter(|&theta| {
                        let mut groups = groups.iter();
                        groups.any(|group| group.judges() && group.has(theta))
                    });
                    if let Some(theta) = held.filter(|_| mass > 0.0) {
                        let weight = Weight::Angle((shaft.j0 / mass).sqrt(), mass);
                        let place = theta - first..theta - first + 1;
                        all.push(Part { body: number, place, weight });
                    }
                    Weight::Mass(shaft.mass.clone(), mass)
                }
                Body::Standing { .. } => Weight::Identity(known_mass(body).unwrap_or(1.0)),
            };
            if !within.is_empty() {
                all.push(Part { body: number, place: within, weight });
            }
        }
        let free = groups.iter().filter(|group| matches!(group.from, From::Mean));
        let together = free.filter_map(|group| FreeTurn::new(machine, &group.members));
        // What couplings tie together loosely may swing by itself while its angles run away from the rest.
        let loose =
            groups.iter().filter(|group| !matches!(group.from, From::Ground) && group.judges());
        let alone = loose.flat_map(|group| &group.members);
        let alone = alone
            .filter_map(|&(place, inertia, _)| FreeTurn::new(machine, &[(place, inertia, 1.0)]));
        let turns = together.chain(alone).collect();
        Parts { first, all, turns, groups }
    }

    /// Writes the displacement of the unknowns in a state, angles counted as their groups have it.
    pub(in crate::dynamics) fn displacement(&self, state: &State, out: &mut [f64]) {
        out.copy_from_slice(&state.q[self.first..]);
        for group in &self.groups {
            let from = group.zero(|place| state.q[place]);
            group
                .members
                .iter()
                .for_each(|(place, _, ratio)| out[place - self.first] -= ratio * from);
        }
    }

    /// Makes a motion of the unknowns, in which given rotations do not move, one whose angles are counted as their groups
    /// have them.
    pub(in crate::dynamics) fn refer(&self, motion: &mut [f64]) {
        let first = self.first;
        for group in &self.groups {
            let of = |place: usize| if place < first { 0.0 } else { motion[place - first] };
            let from = group.zero(of);
            group
                .members
                .iter()
                .for_each(|(place, _, ratio)| motion[place - first] -= ratio * from);
        }
    }
}

impl Group {
    fn has(&self, theta: usize) -> bool {
        self.members.iter().any(|(place, ..)| *place == theta)
    }

    /// Whether its angles say anything: a body that turns freely by itself has none.
    fn judges(&self) -> bool {
        !matches!(self.from, From::Mean) || self.members.len() > 1
    }

    /// What its angles are counted from, where each stands at an angle by its place in q.
    fn zero(&self, angle: impl Fn(usize) -> f64) -> f64 {
        match self.from {
            From::Ground => 0.0,
            From::Given(place, ratio) => ratio * angle(place),
            From::Mean => {
                let members = || self.members.iter();
                let inertia: f64 =
                    members().map(|(_, inertia, ratio)| inertia * ratio * ratio).sum();
                let weighed =
                    members().map(|(place, inertia, ratio)| inertia * ratio * angle(*place));
                weighed.sum::<f64>() / inertia
            }
        }
    }
}

/// The rotations that are unknown, in groups.
fn groups(equations: &Equations) -> Vec<Group> {
    let machine = equations.machine;
    let (first, rotations) = (machine.first_unknown(), machine.rotations());
    // The sides of the planes whose law twists them, as places in q with the speeds that go together: two, or one against what
    // stands. Teeth tie what they turn even where they do not touch at the start.
    let springs = &machine.springs;
    let twists = |plane: &usize| {
        springs.may_twist(*plane)
            && (springs.gear_ratio(*plane).is_some() || equations.torsion(*plane) != 0.0)
    };
    let sides = (0..springs.planes.len()).filter(twists).map(|own| springs.tied(own, rotations));
    let sides: Vec<Tied> = sides.collect();
    let mut trains = Trains::new(rotations);
    let (mut ground, mut given) = (Vec::new(), Vec::new());
    for own in &sides {
        match own[..] {
            [(only, _)] => ground.push(only),
            // Rotations that are given couple no others.
            [(a, of_a), (b, of_b)] if a.min(b) < first => {
                let ratio = if a > b { of_a / of_b } else { of_b / of_a };
                given.push((a.max(b), a.min(b), ratio));
            }
            [(a, of_a), (b, of_b)] => trains.tie([a, b], of_b / of_a),
            _ => {}
        }
    }
    let names = (first..rotations).filter(|&place| trains.train(place) == place);
    names
        .map(|name| {
            let places = (first..rotations).filter(|&place| trains.train(place) == name);
            let mut tied = given.iter().filter(|(own, ..)| trains.train(*own) == name);
            let from = match (places.clone().any(|place| ground.contains(&place)), tied.next()) {
                (true, _) => From::Ground,
                (false, Some(&(own, place, ratio))) => {
                    From::Given(place, ratio / trains.ratio(own))
                }
                (false, None) => From::Mean,
            };
            let member = |place: usize| (place, inertia(machine, place), trains.ratio(place));
            Group { members: places.map(member).collect(), from }
        })
        .collect()
}

/// J0 of the body of a rotation.
fn inertia(machine: &Machine, place: usize) -> f64 {
    machine.bodies[machine.owner(place).body].shaft().map_or(0.0, |shaft| shaft.j0)
}

/// The largest displacement that can be meant (m): the diagonal of the box of its points and at least 1 m; 1 km
/// where all its points are one.
pub(in crate::dynamics) fn largest_sensible(machine: &Machine) -> f64 {
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for node in machine.bodies.iter().flat_map(Body::nodes) {
        for (axis, x) in node.position.into_iter().enumerate() {
            ends[0][axis] = ends[0][axis].min(x);
            ends[1][axis] = ends[1][axis].max(x);
        }
    }
    let extent = (0..3).map(|axis| ends[1][axis] - ends[0][axis]);
    let diagonal = extent.map(|own| own.max(0.0).powi(2)).sum::<f64>().sqrt();
    if diagonal > 0.0 { diagonal.max(1.0) } else { 1000.0 }
}
