//! What passes the sections of bodies, and how these move: in the state that stands, and in small motions about it.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use num_complex::Complex64;

use super::excited::{Excited, Part};
use super::linearised::Standstill;
use super::load_orders::HALVES;
use super::round::LinearMachine;
use super::shapes::apply;
use crate::linalg::Matrix;
use crate::section::Section;

/// What is seen at a section: Re(w e^{λt}) of a motion, real of what stands; along x, y, z of space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Along {
    /// m.
    pub z: f64,
    /// Mean displacement of the section at the axis (m).
    pub displacement: [Complex64; 3],
    /// Force of the part at larger z on that at smaller z (N).
    pub force: [Complex64; 3],
    /// Its moment about the point of the section on the axis (N·m).
    pub moment: [Complex64; 3],
}

impl Along {
    /// All it holds, each by a function.
    fn map(&self, of: impl Fn([Complex64; 3]) -> [Complex64; 3]) -> Along {
        let Along { z, displacement, force, moment } = *self;
        Along { z, displacement: of(displacement), force: of(force), moment: of(moment) }
    }

    /// Adds of another one, at the same section, what a function makes of its values.
    fn add(&mut self, other: &Along, of: impl Fn(Complex64) -> Complex64) {
        let pairs = [
            (&mut self.displacement, &other.displacement),
            (&mut self.force, &other.force),
            (&mut self.moment, &other.moment),
        ];
        for (own, other) in pairs {
            own.iter_mut().zip(other).for_each(|(own, other)| *own += of(*other));
        }
    }
}

/// Angles over which sections of a body that is not round are seen: what turns once with the body and is turned once into space has
/// harmonics up to 2 of its angle.
const ANGLES: usize = 6;
const HARMONICS: i32 = 2;

/// Coordinates of a body in its frame with their derivatives, and what acts on the places of its nodes there.
struct Moving {
    /// Ω (rad/s).
    speed: f64,
    /// q, q̇ and q̈.
    q: [Vec<Complex64>; 3],
    /// m/s².
    gravity: [f64; 3],
    /// Places of nodes as they are seen, times their mass (kg·m), by those of the section; nothing of all that is no response to what
    /// turns with the body.
    places: fn(&Section) -> [Complex64; 3],
}

/// Nothing of the places of nodes.
fn nowhere(_: &Section) -> [Complex64; 3] {
    [Complex64::ZERO; 3]
}

/// Those of a body that turns as space sees them: Re((x + iy) e^{iΩt}) and Re((y − ix) e^{iΩt}).
fn circling(section: &Section) -> [Complex64; 3] {
    let [x, y, _] = section.mass.places;
    [Complex64::new(x, y), Complex64::new(y, -x), Complex64::ZERO]
}

/// The same in its frame.
fn fixed(section: &Section) -> [Complex64; 3] {
    let [x, y, _] = section.mass.places;
    [x.into(), y.into(), Complex64::ZERO]
}

/// A motion e^{λt} of all coordinates of [`super::Linearised`] in space, with the gravity (m/s²) that acts with it.
#[derive(Clone, Copy)]
struct Motion<'a> {
    value: Complex64,
    shape: &'a [Complex64],
    gravity: [f64; 3],
}

impl LinearMachine {
    /// What passes the sections of a body as it stands under a gravity (m/s² along x, y, z), displacements at the angle θ = 0;
    /// unbalance is left out. With the motion by what turns with a body that is not round it is the mean over its turns.
    pub fn standing_along(
        &self,
        at: &Standstill,
        body: usize,
        gravity: [f64; 3],
        uneven: Option<&Excited>,
    ) -> Vec<Along> {
        if let Some(excited) = uneven.filter(|own| own.is_of_uneven()) {
            let standing = |part: &&Part| part.order == 0;
            let parts = excited.parts.iter().filter(standing);
            let mut all = self.by_orders((at, excited), parts, body, gravity);
            if let Some(own) = all.remove(&0) {
                return own;
            }
        }
        let place = self.machine.places()[body].flexible.clone();
        let state = &at.found.state;
        let q = [&state.q, &state.v, &state.a].map(|own| {
            let own = self.in_space(at, body, &own[place.clone()]);
            own.into_iter().map(Complex64::from).collect()
        });
        let moving = Moving { speed: at.speeds[body], q, gravity, places: nowhere };
        self.machine.bodies[body].sections().iter().map(|own| moving.seen_at(own)).collect()
    }

    /// What passes the sections of a body in a motion e^{λt}, by its shape over the coordinates of [`super::Linearised`] in space.
    pub fn moving_along(
        &self,
        at: &Standstill,
        body: usize,
        (value, shape): (Complex64, &[Complex64]),
    ) -> Vec<Along> {
        let motion = Motion { value, shape, gravity: [0.0; 3] };
        let mut all = self.seen_along(at, body, motion, false);
        let stands = || vec![(0, self.standing_along(at, body, [0.0; 3], None))];
        self.add_angle((at, body), shape, stands, &mut all);
        all.swap_remove(0).1
    }

    /// What passes the sections of a body in the response to what turns with one, by orders of that, each with the sections in
    /// their order; of the order 0 the mean under a gravity (m/s²). Of a body that is not round all is seen that its section at every
    /// angle passes on.
    pub fn excited_along(
        &self,
        at: &Standstill,
        excited: &Excited,
        body: usize,
        gravity: [f64; 3],
    ) -> Vec<(f64, Vec<Along>)> {
        let mut all = self.by_orders((at, excited), excited.parts.iter(), body, gravity);
        let turns = self.turns_as_one(at, excited.body, body);
        let is_once = |part: &Part| part.order == HALVES as i32;
        let varies = self.varies_along(excited, body);
        if turns && (varies || excited.parts.iter().any(is_once)) {
            let nothing = vec![Complex64::ZERO; self.kept(at).len()];
            let motion = Motion { value: Complex64::ZERO, shape: &nothing, gravity: [0.0; 3] };
            let (order, places) = match varies {
                true => (0, fixed as fn(&Section) -> [Complex64; 3]),
                false => (HALVES as i32, circling as fn(&Section) -> [Complex64; 3]),
            };
            let own = self.seen_with(at, body, motion, varies, places);
            add(excited, (order, 0), &own, &mut all);
        }
        all.into_iter().map(|(order, own)| (f64::from(order) / HALVES, own)).collect()
    }

    /// Whether what passes the sections of a body varies with its angle.
    fn varies_along(&self, excited: &Excited, body: usize) -> bool {
        excited.uneven.is_some() && self.not_round().any(|own| own == body)
    }

    /// The sum of parts by orders, in halves.
    fn by_orders<'a>(
        &self,
        (at, excited): (&Standstill, &Excited),
        parts: impl Iterator<Item = &'a Part>,
        body: usize,
        gravity: [f64; 3],
    ) -> BTreeMap<i32, Vec<Along>> {
        let uneven = excited.uneven.map_or(0.0, |own| at.speeds[own]);
        let varies = self.varies_along(excited, body);
        let standing = excited.parts.iter().find(|own| own.stands);
        let stands = || match standing {
            Some(own) => {
                let motion =
                    Motion { value: Complex64::ZERO, shape: &own.shape, gravity: [0.0; 3] };
                self.seen_along(at, body, motion, varies)
            }
            None => vec![(0, self.standing_along(at, body, [0.0; 3], None))],
        };
        let mut all = BTreeMap::new();
        for part in parts {
            let order = f64::from(part.order) / HALVES * at.speeds[excited.body];
            let value = Complex64::new(0.0, order + f64::from(part.beside) * uneven);
            let gravity = if part.stands { gravity } else { [0.0; 3] };
            let motion = Motion { value, shape: &part.shape, gravity };
            let mut own = self.seen_along(at, body, motion, varies);
            self.add_angle((at, body), &part.shape, stands, &mut own);
            add(excited, (part.order, part.beside), &own, &mut all);
        }
        all
    }

    /// What passes the sections in a motion, by harmonics of the angle by which the body has turned on: of one that is not round;
    /// otherwise of the order 0 alone.
    fn seen_along(
        &self,
        at: &Standstill,
        body: usize,
        motion: Motion,
        varies: bool,
    ) -> Vec<(i32, Vec<Along>)> {
        self.seen_with(at, body, motion, varies, nowhere)
    }

    fn seen_with(
        &self,
        at: &Standstill,
        body: usize,
        Motion { value, shape, gravity }: Motion,
        varies: bool,
        places: fn(&Section) -> [Complex64; 3],
    ) -> Vec<(i32, Vec<Along>)> {
        let q = shape[self.block(at.angles.len(), body)].to_vec();
        // In the frame of the body, at θ = 0, rates are (λ − ΩS) z.
        let speed = at.speeds[body];
        let rates = |own: &[Complex64]| -> Vec<Complex64> {
            let turned = match self.generators[body].as_ref() {
                Some([generator, _]) if speed != 0.0 => apply(generator, own),
                _ => vec![Complex64::ZERO; own.len()],
            };
            own.iter().zip(&turned).map(|(own, turned)| value * own - speed * turned).collect()
        };
        let once = rates(&q);
        let twice = rates(&once);
        let moved = [q, once, twice];
        let sections = self.machine.bodies[body].sections();
        let seen = |q: [Vec<Complex64>; 3], gravity: [f64; 3]| -> Vec<Along> {
            let moving = Moving { speed, q, gravity, places };
            sections.iter().map(|own| moving.seen_at(own)).collect()
        };
        if !varies {
            return vec![(0, seen(moved, gravity))];
        }
        let on = |k: usize| TAU * k as f64 / ANGLES as f64;
        let samples: Vec<Vec<Along>> = (0..ANGLES)
            .map(|k| {
                let angle = self.stands_at(at, body) + on(k);
                let back = self.own(body, angle, 0.0).expect("a body that turns").back();
                let (sin, cos) = angle.sin_cos();
                let [x, y, z] = gravity;
                let own = [cos * x + sin * y, cos * y - sin * x, z];
                let own = seen(moved.each_ref().map(|own| apply(&back, own)), own);
                let turned = |[x, y, z]: [Complex64; 3]| [cos * x - sin * y, sin * x + cos * y, z];
                own.iter().map(|own| own.map(turned)).collect()
            })
            .collect();
        let harmonic = |m: i32| {
            let mut sum: Vec<Along> =
                samples[0].iter().map(|own| own.map(|_| [Complex64::ZERO; 3])).collect();
            for (k, own) in samples.iter().enumerate() {
                let weight = Complex64::from_polar(1.0 / ANGLES as f64, -f64::from(m) * on(k));
                sum.iter_mut().zip(own).for_each(|(sum, own)| sum.add(own, |own| weight * own));
            }
            (m, sum)
        };
        (-HARMONICS..=HARMONICS).map(harmonic).collect()
    }

    /// Adds what an angle of a motion does: it turns all that stands, by harmonics.
    fn add_angle(
        &self,
        (at, body): (&Standstill, usize),
        shape: &[Complex64],
        stands: impl Fn() -> Vec<(i32, Vec<Along>)>,
        all: &mut [(i32, Vec<Along>)],
    ) {
        let theta = self.machine.places()[body].rotation;
        let Some(place) = at.angles.iter().position(|own| Some(*own) == theta) else { return };
        for ((_, own), (_, stands)) in all.iter_mut().zip(stands()) {
            for (own, stands) in own.iter_mut().zip(stands) {
                own.add(&stands.map(|[x, y, _]| [-y, x, Complex64::ZERO]), |own| {
                    shape[place] * own
                });
            }
        }
    }
}

/// Adds harmonics beside an order and a harmonic to sums by orders.
fn add(
    excited: &Excited,
    (order, beside): (i32, i32),
    own: &[(i32, Vec<Along>)],
    all: &mut BTreeMap<i32, Vec<Along>>,
) {
    for (m, own) in own {
        let Some((order, seen)) = excited.seen_at(order, beside + m) else { continue };
        let nothing = || own.iter().map(|own| own.map(|_| [Complex64::ZERO; 3])).collect();
        let sum: &mut Vec<Along> = all.entry(order).or_insert_with(nothing);
        sum.iter_mut().zip(own).for_each(|(sum, own)| sum.add(own, |own| seen.of(own)));
    }
}

impl Moving {
    fn seen_at(&self, section: &Section) -> Along {
        let [q, rates, accelerations] = &self.q;
        let strained: Vec<Complex64> =
            q.iter().zip(rates).map(|(q, rate)| q + section.damping * rate).collect();
        let mut force = three(&section.force, &strained);
        let mut moment = three(&section.moment, &strained);
        let (once, twice) = (2.0 * self.speed, self.speed * self.speed);
        if let Some(stressed) = &section.stressed {
            for (own, rows) in [&mut force, &mut moment].into_iter().zip(stressed) {
                let by_stress = three(rows, q);
                own.iter_mut().zip(by_stress).for_each(|(own, more)| *own += twice * more);
            }
        }
        let turned = (self.places)(section);
        // Σ m (a − g) over the nodes of the section, and by their places x and y.
        let [sum, by_x, by_y] = [0, 1, 2].map(|arm| {
            let moved = &section.mass.moved[arm];
            let [own, rate, place] = [accelerations, rates, q].map(|own| three(moved, own));
            let gravity = self.gravity.map(|own| section.mass.moments[arm] * own);
            [
                own[0] - once * rate[1] - twice * place[0] - gravity[0],
                own[1] + once * rate[0] - twice * place[1] - gravity[1],
                own[2] - gravity[2],
            ]
        });
        for axis in 0..3 {
            force[axis] -= sum[axis] - twice * turned[axis];
        }
        moment[0] -= by_y[2];
        moment[1] += by_x[2];
        moment[2] -= by_x[1] - by_y[0];
        let displacement = three(&section.motion.displacement, q);
        Along { z: section.z(), displacement, force, moment }
    }
}

fn three(rows: &Matrix, own: &[Complex64]) -> [Complex64; 3] {
    let all = apply(rows, own);
    std::array::from_fn(|axis| all[axis])
}
