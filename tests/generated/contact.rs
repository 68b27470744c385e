//! Kinds of laws, at springs and on whole rings: what their kernels take, give and linearise, against hyper-dual evaluation of the measures and against central differences.

use whirl_specs::clearances::journal::measures;
use whirl_specs::{
    BoreMotion, CLEARANCES, Contact, ContactPlace, ContactState, ContactTangent, Ring,
};

use crate::hyper::Hyper;
use crate::random::Random;

const SPRINGS: usize = 7;
const C: f64 = 3.5e-5;
const R: f64 = 0.034;
const A1: f64 = 27.0;
/// Sizes of lengths (m), of their rates (m/s), and of the speed (rad/s).
const SIZES: [f64; 3] = [2e-5, 0.02, 40.0];

fn psi(j: usize) -> f64 {
    0.3 + 0.8 * j as f64
}

/// A kind of law on a plane: θ, ε_x, ε_y, then the motions of the bore, row after row.
struct Bench {
    kind: &'static Contact,
    count: usize,
    table: Vec<f64>,
}

#[derive(Clone)]
struct State {
    q: Vec<f64>,
    rate: Vec<f64>,
}

/// A measure by its place in what `measures` gives, or something that is no measure.
#[derive(Clone, Copy)]
enum Meaning {
    Value(usize),
    Rate(usize),
    Angle,
    Psi,
}

/// Places of the measures: h, s, α, e_x, e_y, e_z, α_x, α_y, e_n, s_mean.
fn meaning(input: &str) -> Meaning {
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
        "theta" => Meaning::Angle,
        "psi" => Meaning::Psi,
        _ => panic!("{input}: a meaning is needed"),
    }
}

fn measure_of(force: &str) -> usize {
    let forces = ["Q", "T", "M_z", "F_x", "F_y", "F_z", "M_x", "M_y", "F_n"];
    forces.iter().position(|own| *own == force).expect("known")
}

/// How large an input is.
fn size(unit: &str) -> f64 {
    match unit {
        "m" => SIZES[0],
        "m/s" => SIZES[1],
        "rad/s" => SIZES[2],
        _ => 1.0,
    }
}

fn is_turn(motion: BoreMotion) -> bool {
    use BoreMotion::{MeanTiltX, MeanTiltY, MeanTurn, SectionTiltX, SectionTiltY, SectionTurn};
    use BoreMotion::{SecondFrame, SecondTurn};
    let of_sections = matches!(motion, SectionTurn | SectionTiltX | SectionTiltY);
    of_sections || matches!(motion, MeanTurn | MeanTiltX | MeanTiltY | SecondFrame | SecondTurn)
}

impl Bench {
    fn all() -> Vec<Bench> {
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
        assert_eq!(benches.len(), 5, "normal forces, springs, rings, joints and gears");
        benches
    }

    fn motions(&self) -> usize {
        self.kind.bore.len()
    }

    fn coordinates(&self) -> usize {
        3 + self.motions() * self.count
    }

    fn place(&self, motion: usize, j: usize) -> usize {
        3 + motion * self.count + j
    }

    /// Whether a coordinate is an angle.
    fn is_angle(&self, place: usize) -> bool {
        match place.checked_sub(3) {
            None => place == 0,
            Some(own) => is_turn(self.kind.bore[own / self.count]),
        }
    }

    fn random(&self, random: &mut Random) -> State {
        let mut draw = |angle: f64, length: f64| -> Vec<f64> {
            let size = |place| if self.is_angle(place) { angle } else { length };
            (0..self.coordinates()).map(|place| size(place) * (random.unit() - 0.5)).collect()
        };
        let (mut q, rate) = (draw(1e-3, SIZES[0]), draw(SIZES[2], SIZES[1]));
        q[0] = 6.0 * random.unit();
        State { q, rate }
    }

    fn direction(&self, random: &mut Random) -> Vec<f64> {
        let size = |place| if self.is_angle(place) { 0.3 } else { 1e-5 };
        (0..self.coordinates()).map(|place| size(place) * (random.unit() - 0.5)).collect()
    }

    fn with<T>(&self, state: &State, run: impl FnOnce(&ContactState) -> T) -> T {
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

    fn inputs(&self, state: &State) -> Vec<f64> {
        let mut inputs = vec![f64::NAN; self.kind.rows * self.count];
        self.with(state, |state| (self.kind.evaluate)(self.count, state, &mut inputs));
        inputs
    }

    /// A smooth law in which every force depends on every input: the force m of inputs z, and its slopes.
    fn law(&self, m: usize, z: &[f64]) -> (f64, Vec<f64>) {
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
    fn laws(&self, state: &State) -> (Vec<f64>, Vec<f64>) {
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

    fn force(&self, state: &State) -> Vec<f64> {
        let (forces, _) = self.laws(state);
        let (mut ring, mut bore) = ([0.0; 3], vec![f64::NAN; self.motions() * self.count]);
        self.with(state, |state| {
            (self.kind.force)(self.count, state, &forces, &mut ring, &mut bore);
        });
        ring.into_iter().chain(bore).collect()
    }

    /// B + a1·P times a direction.
    fn tangent(&self, state: &State, direction: &[f64]) -> Vec<f64> {
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
    fn hyper(&self, state: &State, j: usize, first: &[f64], second: &[f64]) -> [Hyper; 10] {
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
            motion(BoreMotion::SecondFrame),
            motion(BoreMotion::SecondTurn),
            constant(C),
            constant(R),
        )
    }

    fn unit(&self, place: usize) -> Vec<f64> {
        (0..self.coordinates()).map(|i| f64::from(u8::from(i == place))).collect()
    }

    /// Inputs of spring j and their changes along a direction, with the rates following.
    fn exact_inputs(&self, state: &State, j: usize, direction: &[f64]) -> Vec<[f64; 2]> {
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
    fn exact(&self, state: &State, direction: &[f64]) -> [Vec<f64>; 2] {
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
    fn difference(&self, a: &[f64], b: &[f64]) -> f64 {
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

/// Rounding in sums over springs and inputs of terms that cancel by up to a factor of 1000: the slip by
/// R θ̇ is that much larger than the rates of the lengths.
const ROUNDING: f64 = 50.0 * 1000.0 * f64::EPSILON;

#[test]
fn inputs_follow_from_the_measures() {
    let mut random = Random::new(11);
    for bench in Bench::all() {
        for _ in 0..20 {
            let state = bench.random(&mut random);
            let inputs = bench.inputs(&state);
            for j in 0..bench.count {
                let exact = bench.exact_inputs(&state, j, &vec![0.0; bench.coordinates()]);
                for (i, ([value, _], own)) in exact.iter().zip(bench.kind.inputs).enumerate() {
                    let error = (inputs[i * bench.count + j] - value).abs();
                    // Slip is R θ̇ with the rest lost in it; a rate of a length is θ̇ times one.
                    let size =
                        size(own.unit).max(R * SIZES[2] * f64::from(u8::from(own.unit == "m/s")));
                    assert!(
                        error <= 32.0 * f64::EPSILON * size.max(6.0),
                        "{}: {error:e}",
                        own.name
                    );
                }
            }
        }
    }
}

#[test]
fn forces_and_tangent_follow_from_the_measures() {
    let mut random = Random::new(12);
    for bench in Bench::all() {
        for _ in 0..20 {
            let state = bench.random(&mut random);
            let d = bench.direction(&mut random);
            let [force, tangent] = bench.exact(&state, &d);
            let error = bench.difference(&bench.force(&state), &force);
            assert!(error <= ROUNDING, "{}: force {error:e}", bench.kind.name);
            let error = bench.difference(&bench.tangent(&state, &d), &tangent);
            assert!(error <= ROUNDING, "{}: tangent {error:e}", bench.kind.name);
        }
    }
}

#[test]
fn central_differences_of_the_forces_approach_the_tangent_as_the_step_squared() {
    let mut random = Random::new(13);
    for bench in Bench::all() {
        for _ in 0..20 {
            let state = bench.random(&mut random);
            let d = bench.direction(&mut random);
            let tangent = bench.tangent(&state, &d);
            let moved = |step: f64| {
                let shift = |values: &[f64], by: f64| -> Vec<f64> {
                    values.iter().zip(&d).map(|(value, d)| value + by * d).collect()
                };
                State { q: shift(&state.q, step), rate: shift(&state.rate, step * A1) }
            };
            let error = |step: f64| {
                let (ahead, behind) = (bench.force(&moved(step)), bench.force(&moved(-step)));
                let slope: Vec<f64> =
                    ahead.iter().zip(&behind).map(|(a, b)| (a - b) / (2.0 * step)).collect();
                bench.difference(&slope, &tangent)
            };
            let (coarse, fine) = (error(0.1), error(0.01));
            let ratio = coarse / fine;
            assert!(
                (ratio / 100.0 - 1.0).abs() < 0.05,
                "{}: coarse {coarse:e}, fine {fine:e}",
                bench.kind.name
            );
        }
    }
}

/// A motion of shaft and bore together does no work: forces on the two are equal and opposite.
#[test]
fn reactions_on_shaft_and_bore_are_equal_and_opposite() {
    let mut random = Random::new(14);
    for bench in Bench::all() {
        for _ in 0..20 {
            let mut state = bench.random(&mut random);
            let (sin, cos) = state.q[0].sin_cos();
            let force = bench.force(&state);
            let scale = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            for [x, y] in [[1.0, 0.0], [0.0, 1.0]] {
                // ε in the turning frame; the bore's motion as its own coordinates see it.
                let mut motion = vec![0.0, cos * x + sin * y, cos * y - sin * x];
                // That of the second gear is in a frame of its own.
                let frame = BoreMotion::SecondFrame;
                let frame = bench.kind.bore.iter().position(|own| *own == frame);
                let (turned, upright) =
                    frame.map_or((0.0, 1.0), |own| state.q[bench.place(own, 0)].sin_cos());
                for own in bench.kind.bore {
                    motion.extend((0..bench.count).map(|j| match own {
                        BoreMotion::Radial => psi(j).cos() * x + psi(j).sin() * y,
                        BoreMotion::Tangential => psi(j).cos() * y - psi(j).sin() * x,
                        BoreMotion::MeanX => upright * x + turned * y,
                        BoreMotion::MeanY => upright * y - turned * x,
                        _ => 0.0,
                    }));
                }
                let work: f64 = force.iter().zip(&motion).map(|(f, m)| f * m).sum();
                assert!(work.abs() <= 64.0 * f64::EPSILON * scale, "{}: {work}", bench.kind.name);
            }
            // Along z, and tilts of both sections alike.
            let [a_x, a_y] = [[cos, -sin], [sin, cos]];
            for together in [
                [(BoreMotion::SectionZ, 1.0), (BoreMotion::MeanZ, 1.0)].to_vec(),
                [
                    (BoreMotion::SectionTiltX, a_x[0]),
                    (BoreMotion::SectionTiltY, a_x[1]),
                    (BoreMotion::MeanTiltX, 1.0),
                ]
                .to_vec(),
                [
                    (BoreMotion::SectionTiltX, a_y[0]),
                    (BoreMotion::SectionTiltY, a_y[1]),
                    (BoreMotion::MeanTiltY, 1.0),
                ]
                .to_vec(),
            ] {
                let at = |wanted: BoreMotion| bench.kind.bore.iter().position(|own| *own == wanted);
                let terms = together
                    .iter()
                    .filter_map(|&(motion, part)| Some(part * force[bench.place(at(motion)?, 0)]));
                let work: f64 = terms.sum();
                assert!(work.abs() <= 64.0 * f64::EPSILON * scale, "{}: {work}", bench.kind.name);
            }
            // A turn about the axis, wherever both stand: the moment e × F that the forces leave is a couple on the bore.
            let place = |wanted: BoreMotion| {
                bench.kind.bore.iter().position(|own| *own == wanted).map(|a| bench.place(a, 0))
            };
            if let [Some(x), Some(y), Some(turn)] =
                [BoreMotion::MeanX, BoreMotion::MeanY, BoreMotion::MeanTurn].map(place)
            {
                let mut motion = vec![0.0; bench.coordinates()];
                (motion[0], motion[turn]) = (1.0, 1.0);
                (motion[x], motion[y]) = (-state.q[y], state.q[x]);
                // The tilts of a bore that turns are about axes that turn with it.
                if let [Some(x), Some(y)] =
                    [BoreMotion::MeanTiltX, BoreMotion::MeanTiltY].map(place)
                {
                    (motion[x], motion[y]) = (-state.q[y], state.q[x]);
                }
                let terms = force.iter().zip(&motion).map(|(f, m)| f * m);
                let (work, size) =
                    terms.fold((0.0, 0.0), |(sum, size), own| (sum + own, size + f64::abs(own)));
                let sizes = scale * state.q[1].hypot(state.q[2]).max(state.q[x].hypot(state.q[y]));
                let allowed = 64.0 * f64::EPSILON * (size + sizes);
                assert!(f64::abs(work) <= allowed, "{}: {work}", bench.kind.name);
            }
            // A turn about the centre of a journal that stands there, in a bore as close as touching.
            (state.q[1], state.q[2]) = (0.0, 0.0);
            use BoreMotion::{MeanTiltX, MeanTiltY, MeanX, MeanY};
            let means = [MeanX, MeanY, MeanTiltX, MeanTiltY].map(place);
            means.into_iter().flatten().for_each(|place| state.q[place] = 0.0);
            let force = bench.force(&state);
            let mut motion = vec![1.0, 0.0, 0.0];
            for own in bench.kind.bore {
                let turn = match own {
                    BoreMotion::Tangential => R,
                    BoreMotion::MeanTurn => 1.0,
                    // Teeth roll off.
                    BoreMotion::SecondTurn => -1.0,
                    _ => 0.0,
                };
                motion.extend(vec![turn; bench.count]);
            }
            let work: f64 = force.iter().zip(&motion).map(|(f, m)| f * m).sum();
            let scale = force.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            assert!(work.abs() <= 64.0 * f64::EPSILON * scale, "{}: {work}", bench.kind.name);
            // Normal forces meet in the centre.
            let turns = bench.kind.forces.iter().any(|force| force.radius || force.unit != "N");
            assert!(!turns || force[0].abs() > 1e-3, "{}: there is a torque", bench.kind.name);
        }
    }
}

/// Forces work on what their measures say, whether laws may take them or not.
#[test]
fn every_force_has_the_row_of_its_measure() {
    let mut random = Random::new(16);
    for bench in Bench::all() {
        let state = bench.random(&mut random);
        let rows = bench.inputs(&state);
        let still = vec![0.0; bench.coordinates()];
        assert_eq!(bench.kind.measures.len(), bench.kind.forces.len());
        for (force, row) in bench.kind.forces.iter().zip(bench.kind.measures) {
            for j in 0..bench.count {
                let exact = bench.hyper(&state, j, &still, &still)[measure_of(force.name)].0.re;
                let error = (rows[row * bench.count + j] - exact).abs();
                assert!(error <= 1e-15 * exact.abs().max(1e-3), "{}: {error:e}", force.name);
            }
        }
    }
}

/// What the springs of a plane give does not depend on which others lie beside them in the rows.
#[test]
fn planes_of_a_law_lie_side_by_side() {
    let mut random = Random::new(15);
    for bench in Bench::all().into_iter().filter(|bench| bench.kind.place == ContactPlace::Spring) {
        let state = bench.random(&mut random);
        let (n, whole) = (bench.count, bench.force(&state));
        let (inputs, (forces, slopes)) = (bench.inputs(&state), bench.laws(&state));
        let mut found = vec![f64::NAN; inputs.len()];
        let mut bore = vec![f64::NAN; bench.motions() * n];
        let (mut ring, mut t) = ([0.0; 3], ContactTangent::new(n, bench.motions()));
        bench.with(&state, |state| {
            (bench.kind.tangent)(n, state, &forces, &slopes, A1, &mut t);
        });
        for part in [0..3, 3..n] {
            let (first, count) = (part.start, part.len());
            let (mut own, mut tangent) = ([0.0; 3], ContactTangent::new(count, bench.motions()));
            bench.with(&state, |state| {
                let state = ContactState {
                    table: &state.table[first..],
                    bore: &state.bore[first..],
                    bore_dot: &state.bore_dot[first..],
                    ..*state
                };
                (bench.kind.evaluate)(count, &state, &mut found[first..]);
                (bench.kind.force)(count, &state, &forces[first..], &mut own, &mut bore[first..]);
                let (forces, slopes) = (&forces[first..], &slopes[first..]);
                (bench.kind.tangent)(count, &state, forces, slopes, A1, &mut tangent);
            });
            ring.iter_mut().zip(own).for_each(|(sum, force)| *sum += force);
            let rows = tangent.ring_bore.chunks(count).zip(t.ring_bore.chunks(n));
            rows.for_each(|(own, whole)| assert_eq!(own, &whole[part.clone()]));
        }
        assert_eq!(found, inputs, "{}", bench.kind.name);
        assert_eq!(bore, whole[3..], "{}", bench.kind.name);
        let scale = whole[..3].iter().fold(0.0, |m: f64, f| m.max(f.abs()));
        for (own, whole) in ring.iter().zip(&whole) {
            assert!((own - whole).abs() <= 64.0 * f64::EPSILON * scale, "{}", bench.kind.name);
        }
    }
}
