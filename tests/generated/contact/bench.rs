//! A law of each kind on a plane, with what its kernels should give.

use whirl_specs::clearances::journal::measures;
use whirl_specs::{
    BoreMotion, CLEARANCES, Contact, ContactPlace, ContactState, ContactTangent, Ring,
};

use crate::hyper::Hyper;
use crate::random::Random;

pub(super) const SPRINGS: usize = 7;
pub(super) const C: f64 = 3.5e-5;
pub(super) const R: f64 = 0.034;
pub(super) const A1: f64 = 27.0;
/// Sizes of lengths (m), of their rates (m/s), and of the speed (rad/s).
pub(super) const SIZES: [f64; 3] = [2e-5, 0.02, 40.0];

pub(super) fn psi(j: usize) -> f64 {
    0.3 + 0.8 * j as f64
}

/// A kind of law on a plane: θ, ε_x, ε_y, then the motions of the bore, row after row.
pub(super) struct Bench {
    pub(super) kind: &'static Contact,
    pub(super) count: usize,
    pub(super) table: Vec<f64>,
}

#[derive(Clone)]
pub(super) struct State {
    pub(super) q: Vec<f64>,
    pub(super) rate: Vec<f64>,
}

/// A measure by its place in what `measures` gives, or something that is no measure.
#[derive(Clone, Copy)]
pub(super) enum Meaning {
    Value(usize),
    Rate(usize),
    Angle,
    Psi,
}

/// Places of the measures: h, s, α, e_x, e_y, e_z, α_x, α_y, e_n, s_mean, y_x, y_y.
pub(super) fn meaning(input: &str) -> Meaning {
    match input {
        "h" => Meaning::Value(0),
        "h_dot" => Meaning::Rate(0),
        "v_t" => Meaning::Rate(1),
        "omega" => Meaning::Rate(2),
        "e_x" => Meaning::Value(3),
        "e_y" => Meaning::Value(4),
        "e_x_dot" => Meaning::Rate(3),
        "e_y_dot" => Meaning::Rate(4),
        "e_z" => Meaning::Value(5),
        "alpha_x" => Meaning::Value(6),
        "alpha_y" => Meaning::Value(7),
        "e_z_dot" => Meaning::Rate(5),
        "alpha_x_dot" => Meaning::Rate(6),
        "alpha_y_dot" => Meaning::Rate(7),
        "e_n" => Meaning::Value(8),
        "e_n_dot" => Meaning::Rate(8),
        "y_x" => Meaning::Value(10),
        "y_y" => Meaning::Value(11),
        "y_x_dot" => Meaning::Rate(10),
        "y_y_dot" => Meaning::Rate(11),
        "theta" => Meaning::Angle,
        "psi" => Meaning::Psi,
        _ => panic!("{input}: a meaning is needed"),
    }
}

pub(super) fn measure_of(force: &str) -> usize {
    let forces = ["Q", "T", "M_z", "F_x", "F_y", "F_z", "M_x", "M_y", "F_n"];
    forces.iter().position(|own| *own == force).expect("known")
}

/// How large an input is.
pub(super) fn size(unit: &str) -> f64 {
    match unit {
        "m" => SIZES[0],
        "m/s" => SIZES[1],
        "rad/s" => SIZES[2],
        _ => 1.0,
    }
}

pub(super) fn is_turn(motion: BoreMotion) -> bool {
    use BoreMotion::{MeanTiltX, MeanTiltY, MeanTurn, SectionTiltX, SectionTiltY, SectionTurn};
    use BoreMotion::{SecondFrame, SecondTurn};
    let of_sections = matches!(motion, SectionTurn | SectionTiltX | SectionTiltY);
    of_sections || matches!(motion, MeanTurn | MeanTiltX | MeanTiltY | SecondFrame | SecondTurn)
}

impl Bench {
    pub(super) fn all() -> Vec<Bench> {
        let kinds = CLEARANCES[0].contacts.iter();
        let benches: Vec<Bench> = kinds
            .map(|kind| {
                let count = if kind.place == ContactPlace::Spring { SPRINGS } else { 1 };
                let angles: Vec<f64> = (0..count).map(psi).collect();
                let mut table = vec![0.0; kind.table * count];
                (kind.prepare)(&angles, &mut table);
                Bench { kind, count, table }
            })
            .collect();
        assert_eq!(benches.len(), 6, "normal forces, springs, rings, joints, sensors and gears");
        benches
    }

    pub(super) fn motions(&self) -> usize {
        self.kind.bore.len()
    }

    pub(super) fn coordinates(&self) -> usize {
        3 + self.motions() * self.count
    }

    pub(super) fn place(&self, motion: usize, j: usize) -> usize {
        3 + motion * self.count + j
    }

    /// Whether a coordinate is an angle.
    pub(super) fn is_angle(&self, place: usize) -> bool {
        match place.checked_sub(3) {
            None => place == 0,
            Some(own) => is_turn(self.kind.bore[own / self.count]),
        }
    }

    pub(super) fn random(&self, random: &mut Random) -> State {
        let mut draw = |angle: f64, length: f64| -> Vec<f64> {
            let size = |place| if self.is_angle(place) { angle } else { length };
            (0..self.coordinates()).map(|place| size(place) * (random.unit() - 0.5)).collect()
        };
        let (mut q, rate) = (draw(1e-3, SIZES[0]), draw(SIZES[2], SIZES[1]));
        q[0] = 6.0 * random.unit();
        State { q, rate }
    }

    pub(super) fn direction(&self, random: &mut Random) -> Vec<f64> {
        let size = |place| if self.is_angle(place) { 0.3 } else { 1e-5 };
        (0..self.coordinates()).map(|place| size(place) * (random.unit() - 0.5)).collect()
    }

    pub(super) fn with<T>(&self, state: &State, run: impl FnOnce(&ContactState) -> T) -> T {
        let three = |values: &[f64]| [values[0], values[1], values[2]];
        let ring = Ring { position: three(&state.q), velocity: three(&state.rate), c: C };
        run(&ContactState {
            stride: self.count,
            table: &self.table,
            ring: &ring,
            radius: R,
            bore: &state.q[3..],
            bore_dot: &state.rate[3..],
        })
    }

    pub(super) fn inputs(&self, state: &State) -> Vec<f64> {
        let mut inputs = vec![f64::NAN; self.kind.rows * self.count];
        self.with(state, |state| (self.kind.evaluate)(self.count, state, &mut inputs));
        inputs
    }

    /// A smooth law in which every force depends on every input: the force m of inputs z, and its slopes.
    pub(super) fn law(&self, m: usize, z: &[f64]) -> (f64, Vec<f64>) {
        let n = z.len();
        let w: Vec<f64> =
            z.iter().zip(self.kind.inputs).map(|(z, own)| z / size(own.unit)).collect();
        let linear = |i: usize| 1.0 + 0.3 * i as f64 - 0.7 * m as f64;
        let mixed = |i: usize| 0.2 - 0.05 * (i * (m + 1)) as f64;
        let mut force = 3.0;
        let mut slopes = vec![0.0; n];
        for i in 0..n {
            let next = (i + 1) % n;
            force += linear(i) * w[i] + mixed(i) * w[i] * w[next];
            slopes[i] += linear(i) + mixed(i) * w[next];
            slopes[next] += mixed(i) * w[i];
        }
        let slopes = slopes.iter().zip(self.kind.inputs).map(|(s, own)| s / size(own.unit));
        (force, slopes.collect())
    }

    /// Rows of forces and of slopes.
    pub(super) fn laws(&self, state: &State) -> (Vec<f64>, Vec<f64>) {
        let (n, inputs) = (self.kind.inputs.len(), self.inputs(state));
        let mut forces = vec![0.0; self.kind.forces.len() * self.count];
        let mut slopes = vec![0.0; self.kind.forces.len() * n * self.count];
        for j in 0..self.count {
            let z: Vec<f64> = (0..n).map(|i| inputs[i * self.count + j]).collect();
            for m in 0..self.kind.forces.len() {
                let (force, by) = self.law(m, &z);
                forces[m * self.count + j] = force;
                for (i, slope) in by.into_iter().enumerate() {
                    slopes[(m * n + i) * self.count + j] = slope;
                }
            }
        }
        (forces, slopes)
    }

    pub(super) fn force(&self, state: &State) -> Vec<f64> {
        let (forces, _) = self.laws(state);
        let (mut ring, mut bore) = ([0.0; 3], vec![f64::NAN; self.motions() * self.count]);
        self.with(state, |state| {
            (self.kind.force)(self.count, state, &forces, &mut ring, &mut bore);
        });
        ring.into_iter().chain(bore).collect()
    }

    /// B + a1·P times a direction.
    pub(super) fn tangent(&self, state: &State, direction: &[f64]) -> Vec<f64> {
        let (forces, slopes) = self.laws(state);
        let (n, motions) = (self.count, self.motions());
        let mut t = ContactTangent::new(n, motions);
        self.with(state, |state| {
            (self.kind.tangent)(n, state, &forces, &slopes, A1, &mut t);
        });
        let mut product = vec![0.0; self.coordinates()];
        for (sum, row) in product.iter_mut().zip(&t.ring_ring) {
            for (entry, along) in row.iter().zip(direction) {
                *sum += entry * along;
            }
        }
        for j in 0..n {
            for a in 0..motions {
                let own = self.place(a, j);
                for i in 0..3 {
                    product[i] += t.ring_bore[(i * motions + a) * n + j] * direction[own];
                    product[own] += t.bore_ring[(3 * a + i) * n + j] * direction[i];
                }
                for b in 0..motions {
                    let entry = t.bore_bore[(a * motions + b) * n + j];
                    product[own] += entry * direction[self.place(b, j)];
                }
            }
        }
        product
    }

    /// All measures of spring j in numbers that carry derivatives along two directions.
    pub(super) fn hyper(
        &self,
        state: &State,
        j: usize,
        first: &[f64],
        second: &[f64],
    ) -> [Hyper; 12] {
        let at = |i: usize| Hyper::new(state.q[i], first[i], second[i]);
        let constant = |value: f64| Hyper::new(value, 0.0, 0.0);
        let motion = |wanted: BoreMotion| {
            let found = self.kind.bore.iter().position(|own| *own == wanted);
            found.map_or(constant(0.0), |motion| at(self.place(motion, j)))
        };
        measures(
            constant(psi(j)),
            at(0),
            at(1),
            at(2),
            motion(BoreMotion::Radial),
            motion(BoreMotion::Tangential),
            motion(BoreMotion::MeanX),
            motion(BoreMotion::MeanY),
            motion(BoreMotion::MeanTurn),
            motion(BoreMotion::MeanZ),
            motion(BoreMotion::MeanTiltX),
            motion(BoreMotion::MeanTiltY),
            motion(BoreMotion::SectionTurn),
            motion(BoreMotion::SectionZ),
            motion(BoreMotion::SectionTiltX),
            motion(BoreMotion::SectionTiltY),
            motion(BoreMotion::SeenX),
            motion(BoreMotion::SeenY),
            motion(BoreMotion::BaseX),
            motion(BoreMotion::BaseY),
            motion(BoreMotion::SecondFrame),
            motion(BoreMotion::SecondTurn),
            constant(C),
            constant(R),
        )
    }

    pub(super) fn unit(&self, place: usize) -> Vec<f64> {
        (0..self.coordinates()).map(|i| f64::from(u8::from(i == place))).collect()
    }

    /// Inputs of spring j and their changes along a direction, with the rates following.
    pub(super) fn exact_inputs(&self, state: &State, j: usize, direction: &[f64]) -> Vec<[f64; 2]> {
        let along = self.hyper(state, j, direction, &state.rate);
        let input = |name: &str| match meaning(name) {
            Meaning::Value(place) => [along[place].0.re, along[place].0.eps1],
            Meaning::Rate(place) => {
                let x = along[place].0;
                [x.eps2, x.eps1eps2 + A1 * x.eps1]
            }
            Meaning::Angle => [state.q[0], direction[0]],
            Meaning::Psi => [psi(j), 0.0],
        };
        self.kind.inputs.iter().map(|own| input(own.name)).collect()
    }

    /// Generalised forces, and their change along a direction.
    pub(super) fn exact(&self, state: &State, direction: &[f64]) -> [Vec<f64>; 2] {
        let mut all = [vec![0.0; self.coordinates()], vec![0.0; self.coordinates()]];
        for j in 0..self.count {
            let inputs = self.exact_inputs(state, j, direction);
            let z: Vec<f64> = inputs.iter().map(|[value, _]| *value).collect();
            let own: Vec<usize> =
                (0..3).chain((0..self.motions()).map(|b| self.place(b, j))).collect();
            for (m, force) in self.kind.forces.iter().enumerate() {
                let (f, slopes) = self.law(m, &z);
                let df: f64 = slopes.iter().zip(&inputs).map(|(s, [_, dz])| s * dz).sum();
                for &i in &own {
                    let x = self.hyper(state, j, direction, &self.unit(i))[measure_of(force.name)];
                    all[0][i] += f * x.0.eps2;
                    all[1][i] += df * x.0.eps2 + f * x.0.eps1eps2;
                }
            }
        }
        all
    }

    /// Largest difference, each over the largest value of its kind (angle or length).
    pub(super) fn difference(&self, a: &[f64], b: &[f64]) -> f64 {
        let mut worst = 0.0_f64;
        for angle in [true, false] {
            let places: Vec<usize> =
                (0..self.coordinates()).filter(|&i| self.is_angle(i) == angle).collect();
            let scale = places.iter().fold(f64::MIN_POSITIVE, |m, &i| m.max(b[i].abs()));
            for i in places {
                worst = worst.max((a[i] - b[i]).abs() / scale);
            }
        }
        worst
    }
}
