//! What passes the sections of bodies, and how these move: in the state that stands, and in small motions about it.

use num_complex::Complex64;

use super::linearised::Standstill;
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

/// Coordinates of a body in its frame with their derivatives, as the frame passes the angle θ = 0: those that space sees.
struct Moving {
    /// Ω (rad/s).
    speed: f64,
    /// q, q̇ and q̈.
    q: [Vec<Complex64>; 3],
    /// m/s².
    gravity: [f64; 3],
    /// 1 of a motion e^{iΩt} with which the places of the body turn, 0 of all others.
    turns: f64,
}

impl LinearMachine {
    /// What passes the sections of a body as it stands under a gravity (m/s² along x, y, z), displacements at the angle θ = 0;
    /// unbalance is left out.
    pub fn standing_along(&self, at: &Standstill, body: usize, gravity: [f64; 3]) -> Vec<Along> {
        let place = self.machine.places()[body].flexible.clone();
        let state = &at.found.state;
        let q = [&state.q, &state.v, &state.a].map(|own| {
            let own = self.in_space(at, body, &own[place.clone()]);
            own.into_iter().map(Complex64::from).collect()
        });
        let moving = Moving { speed: at.speeds[body], q, gravity, turns: 0.0 };
        self.machine.bodies[body].sections().iter().map(|own| moving.seen_at(own)).collect()
    }

    /// What passes the sections of a body in a motion e^{λt}, by its shape over the coordinates of [`super::Linearised`] in
    /// space; `turns`: the motion is the response, once a turn, to what turns with the body, its mesh off the axis included.
    pub fn moving_along(
        &self,
        at: &Standstill,
        body: usize,
        (value, shape): (Complex64, &[Complex64]),
        turns: bool,
    ) -> Vec<Along> {
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
        let (once, gravity) = (rates(&q), [0.0; 3]);
        let twice = rates(&once);
        let turns = f64::from(u8::from(turns));
        let moving = Moving { speed, q: [q, once, twice], gravity, turns };
        let sections = self.machine.bodies[body].sections();
        let mut all: Vec<Along> = sections.iter().map(|own| moving.seen_at(own)).collect();
        // An angle turns all that stands.
        let theta = self.machine.places()[body].rotation;
        if let Some(place) = at.angles.iter().position(|own| Some(*own) == theta) {
            for (own, stands) in all.iter_mut().zip(self.standing_along(at, body, gravity)) {
                let pairs = [
                    (&mut own.displacement, stands.displacement),
                    (&mut own.force, stands.force),
                    (&mut own.moment, stands.moment),
                ];
                for (own, [x, y, _]) in pairs {
                    own[0] -= shape[place] * y;
                    own[1] += shape[place] * x;
                }
            }
        }
        all
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
        // Places that turn with the body are Re((x + iy) e^{iΩt}) and Re((y − ix) e^{iΩt}).
        let [x, y, _] = section.mass.places.map(|own| self.turns * own);
        let turned = [Complex64::new(x, y), Complex64::new(y, -x), Complex64::ZERO];
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
