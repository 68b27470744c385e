//! Motions: every kernel as planned, against the spec's own kinetic energy or declared M and Q_v, evaluated
//! directly, and differences of them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use whirl_codegen::diagnostic::{Located, Source};
use whirl_codegen::expression::{Id, Node, Shape, Symbol, Symmetry};
use whirl_codegen::formula::{Formula, Value, evaluate, parse};
use whirl_codegen::kinds::motion::MotionSpec;
use whirl_codegen::kinds::motion::kernels::{Combination, Group, Planned, ResultKind, planned};
use whirl_codegen::operation::Operand;

use crate::flip::{self, flips_of};
use crate::random::Random;

/// Flexible coordinates; θ comes first.
const N: usize = 3;
const SIZE: usize = 1 + N;
/// States at which kernels are compared.
const POINTS: usize = 4;
/// a1 and a2 of a time step.
const NEWMARK: [f64; 2] = [1.7, 2.3];

/// q, q̇ and q̈, θ first.
type State = [[f64; SIZE]; 3];
const POSITION: usize = 0;
const VELOCITY: usize = 1;
const ACCELERATION: usize = 2;

/// Rows of numbers: 1 × 1, SIZE × 1 or SIZE × SIZE, rows first.
type Rows = Vec<f64>;

/// The formulas of a file, and values for its tensors.
struct Motion {
    formulas: BTreeMap<String, Formula>,
    tensors: BTreeMap<String, Value<f64>>,
}

impl Motion {
    fn new(spec: &MotionSpec, text: &str) -> Self {
        let table: toml::Table = text.parse().expect("a file that was read");
        let mut formulas = BTreeMap::new();
        let mut open: Vec<(String, &toml::Value)> =
            table.iter().map(|(key, value)| (key.clone(), value)).collect();
        while let Some((key, value)) = open.pop() {
            match value {
                toml::Value::Table(inner) => {
                    open.extend(inner.iter().map(|(name, value)| (format!("{key}.{name}"), value)));
                }
                toml::Value::String(text) => {
                    // Titles and names are no formulas.
                    let formula = parse(&Located::alone(&key, text));
                    formulas.extend(formula.ok().map(|formula| (key, formula)));
                }
                _ => {}
            }
        }
        let mut random = Random::new(17, 3);
        let tensors = spec.tensors.iter().map(|tensor| {
            let mut entries = vec![vec![0.0; N]; N];
            entries.iter_mut().flatten().for_each(|entry| *entry = uniform(&mut random));
            let mirrored = |sign: f64| -> Vec<Vec<f64>> {
                let entry = |i: usize, j: usize| entries[i][j] + sign * entries[j][i];
                (0..N).map(|i| (0..N).map(|j| entry(i, j)).collect()).collect()
            };
            let value = match (tensor.shape, tensor.symmetry) {
                (Shape::Scalar | Shape::Truth, _) => Value::Scalar(entries[0][0]),
                (Shape::Vector, _) => Value::Vector(entries[0].clone()),
                (Shape::Matrix, Symmetry::None) => Value::Matrix(entries),
                (Shape::Matrix, Symmetry::Symmetric) => Value::Matrix(mirrored(1.0)),
                (Shape::Matrix, Symmetry::Skew) => Value::Matrix(mirrored(-1.0)),
            };
            (tensor.name.clone(), value)
        });
        Motion { tensors: tensors.collect(), formulas }
    }

    /// The value of everything that a formula may name.
    fn names(&self, state: &State) -> BTreeMap<String, Value<f64>> {
        let mut names = self.tensors.clone();
        for (rates, suffix) in state.iter().zip(["", "_dot", "_ddot"]) {
            names.insert(format!("theta{suffix}"), Value::Scalar(rates[0]));
            names.insert(format!("eta{suffix}"), Value::Vector(rates[1..].to_vec()));
        }
        names
    }

    /// What a formula gives, flat; `None` if the file does not have it.
    fn formula(&self, key: &str, state: &State) -> Option<Rows> {
        let formula = self.formulas.get(key)?;
        Some(match evaluate(formula, &self.names(state)).expect("a value") {
            Value::Scalar(value) => vec![value],
            Value::Vector(entries) => entries,
            Value::Matrix(rows) => rows.concat(),
            Value::Truth(_) => panic!("{key} is a condition"),
        })
    }

    /// Rows declared one a coordinate; what is left out is zero.
    fn declared_rows(&self, key: &str, state: &State) -> Rows {
        let part = |name: &str, size: usize| {
            self.formula(&format!("{key}.{name}"), state).unwrap_or(vec![0.0; size])
        };
        [part("theta", 1), part("eta", N)].concat()
    }

    /// T, where the motion has one.
    fn energy(&self, state: &State) -> Option<f64> {
        self.formula("kinetic_energy", state).map(|value| value[0])
    }

    /// p = ∂T/∂q̇.
    fn momentum(&self, state: &State) -> Option<Rows> {
        self.energy(state)?;
        let energy = |state: &State| vec![self.energy(state).expect("an energy")];
        Some((0..SIZE).map(|i| slope(&energy, state, VELOCITY, &unit(i))[0]).collect())
    }

    /// M u.
    fn mass_times(&self, state: &State, u: &[f64; SIZE]) -> Rows {
        if self.energy(state).is_some() {
            let momentum = |state: &State| self.momentum(state).expect("an energy");
            return slope(&momentum, state, VELOCITY, u);
        }
        let mut rows = vec![0.0; SIZE];
        let names = [("theta", 0..1), ("eta", 1..SIZE)];
        for (row, places) in &names {
            for (column, along) in &names {
                let Some(block) = self.formula(&format!("mass.{row}.{column}"), state) else {
                    continue;
                };
                for (i, place) in places.clone().enumerate() {
                    for (j, by) in along.clone().enumerate() {
                        rows[place] += block[i * along.len() + j] * u[by];
                    }
                }
            }
        }
        rows
    }

    /// Q_v = ∂T/∂q − (∂p/∂q) q̇, or as declared.
    fn quadratic_velocity(&self, state: &State) -> Rows {
        if self.energy(state).is_none() {
            return self.declared_rows("quadratic_velocity", state);
        }
        let energy = |state: &State| vec![self.energy(state).expect("an energy")];
        let momentum = |state: &State| self.momentum(state).expect("an energy");
        let shift = slope(&momentum, state, POSITION, &state[VELOCITY]);
        let force = (0..SIZE).map(|i| slope(&energy, state, POSITION, &unit(i))[0]);
        force.zip(shift).map(|(force, shift)| force - shift).collect()
    }

    /// What a kernel must give.
    fn expected(&self, kernel: &str, state: &State) -> Rows {
        let ma = |state: &State| self.mass_times(state, &state[ACCELERATION]);
        let q_v = |state: &State| self.quadratic_velocity(state);
        let columns = |of: &dyn Fn(usize) -> Rows| -> Rows {
            let columns: Vec<Rows> = (0..SIZE).map(of).collect();
            (0..SIZE).flat_map(|i| columns.iter().map(move |column| column[i])).collect()
        };
        let by = |rows: &dyn Fn(&State) -> Rows, place: usize| {
            columns(&|j| slope(&rows, state, place, &unit(j)))
        };
        match kernel {
            "kinetic_energy" => vec![self.energy(state).expect("an energy")],
            "momentum" => self.momentum(state).expect("an energy"),
            "quadratic_velocity" => q_v(state),
            "mass_times_acceleration" => ma(state),
            "inertia_force" => q_v(state).iter().zip(ma(state)).map(|(q_v, ma)| q_v - ma).collect(),
            "mass" => columns(&|j| self.mass_times(state, &unit(j))),
            "pf" => by(&ma, POSITION),
            "b" => by(&q_v, POSITION),
            "p" => by(&q_v, VELOCITY),
            "tangent" => {
                let parts = ["mass", "pf", "p", "b"].map(|kernel| self.expected(kernel, state));
                let [a1, a2] = NEWMARK;
                let entry =
                    |i: usize| a2 * parts[0][i] + parts[1][i] - a1 * parts[2][i] - parts[3][i];
                (0..SIZE * SIZE).map(entry).collect()
            }
            other => panic!("no yardstick for the kernel {other}"),
        }
    }
}

fn unit(place: usize) -> [f64; SIZE] {
    std::array::from_fn(|i| f64::from(u8::from(i == place)))
}

fn uniform(random: &mut Random) -> f64 {
    (random.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// Central differences of step 1, exact for what is of the second degree along the direction: a kinetic
/// energy is in the velocities, and the motions in specs/ are in the positions too. If one is not, its
/// kernels fail the check as they are.
fn slope(rows: &dyn Fn(&State) -> Rows, state: &State, place: usize, along: &[f64; SIZE]) -> Rows {
    let moved = |step: f64| {
        let mut state = *state;
        state[place].iter_mut().zip(along).for_each(|(x, along)| *x += step * along);
        rows(&state)
    };
    moved(1.0).iter().zip(moved(-1.0)).map(|(above, below)| (above - below) / 2.0).collect()
}

/// Where a sign is flipped.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Flip {
    /// Of a matrix–vector product.
    Product(usize),
    /// Of a dot product.
    Dot(usize),
    /// In the scalars.
    Scalar(flip::Flip),
    /// Of a term in the sums of an output, counted through.
    Term(usize),
}

fn all_flips(Planned { plan, .. }: &Planned) -> Vec<Flip> {
    let terms = |groups: &[Group<Operand>]| groups.iter().map(|group| group.terms.len()).sum();
    let counts = plan.outputs.iter().map(|form| match form {
        Combination::Scalar(_) => 1,
        Combination::Vector(groups) => terms(groups),
        Combination::Matrix { stored, identity, outer } => {
            let outer: usize = outer.iter().map(|(_, groups)| terms(groups)).sum();
            terms(stored) + usize::from(identity.is_some()) + outer
        }
    });
    let places: Vec<usize> = (0..plan.scalars.outputs.len()).collect();
    let mut flips: Vec<Flip> = (0..plan.products.len()).map(Flip::Product).collect();
    flips.extend((0..plan.dots.len()).map(Flip::Dot));
    flips.extend(flips_of(&plan.scalars, &places).into_iter().map(Flip::Scalar));
    flips.extend((0..counts.sum()).map(Flip::Term));
    flips
}

/// A planned kernel at one state, with a sign flipped.
struct Run<'a> {
    kernel: &'a Planned,
    names: &'a BTreeMap<String, Value<f64>>,
    flip: Option<Flip>,
    products: BTreeMap<Id, Vec<f64>>,
    /// Values of the scalar outputs.
    scalars: Vec<f64>,
    /// Terms met so far.
    terms: usize,
}

impl<'a> Run<'a> {
    fn new(
        kernel: &'a Planned,
        names: &'a BTreeMap<String, Value<f64>>,
        flip: Option<Flip>,
    ) -> Self {
        let plan = &kernel.plan;
        let (products, scalars) = (BTreeMap::new(), Vec::new());
        let mut run = Run { kernel, names, flip, products, scalars, terms: 0 };
        for (place, product) in plan.products.iter().enumerate() {
            let matrix = run.matrix(product.matrix);
            let matrix = if product.transposed { transposed(&matrix) } else { matrix };
            let sign = run.sign(Flip::Product(place));
            let x = run.vector(product.of);
            let value = matrix.iter().map(|row| sign * dot(row, &x)).collect();
            run.products.insert(product.id, value);
        }
        let mut known: BTreeMap<&str, f64> =
            BTreeMap::from([("a1_", NEWMARK[0]), ("a2_", NEWMARK[1])]);
        for (name, value) in names {
            if let Value::Scalar(value) = value {
                known.insert(name, *value);
            }
        }
        for (place, product) in plan.dots.iter().enumerate() {
            let value = dot(&run.vector(product.a), &run.vector(product.b));
            known.insert(&product.name, run.sign(Flip::Dot(place)) * value);
        }
        // Names of vectors and matrices are inputs that nothing uses.
        let inputs: Vec<f64> = (plan.scalars.inputs.iter())
            .map(|input| known.get(input.name.as_str()).copied().unwrap_or(f64::NAN))
            .collect();
        let flip = match flip {
            Some(Flip::Scalar(flip)) => Some(flip),
            _ => None,
        };
        run.scalars = flip::run(&plan.scalars, &inputs, flip);
        run
    }

    fn sign(&self, at: Flip) -> f64 {
        if self.flip == Some(at) { -1.0 } else { 1.0 }
    }

    /// The sign of the next term.
    fn next(&mut self) -> f64 {
        self.terms += 1;
        self.sign(Flip::Term(self.terms - 1))
    }

    fn symbol(&self, id: Id) -> &Value<f64> {
        match self.kernel.graph.node(id) {
            Node::Symbol(Symbol { name, .. }) => &self.names[name],
            other => panic!("{other:?} is no symbol"),
        }
    }

    fn matrix(&self, id: Id) -> Vec<Vec<f64>> {
        if let Node::Transpose(stored) = *self.kernel.graph.node(id) {
            return transposed(&self.matrix(stored));
        }
        let Value::Matrix(rows) = self.symbol(id) else { panic!("no matrix") };
        rows.clone()
    }

    fn vector(&self, id: Id) -> Vec<f64> {
        if let Some(product) = self.products.get(&id) {
            return product.clone();
        }
        let Value::Vector(entries) = self.symbol(id) else { panic!("no vector") };
        entries.clone()
    }

    fn scalar(&self, operand: Operand) -> f64 {
        let outputs = &self.kernel.plan.scalars.outputs;
        let place = outputs.iter().position(|output| output.operand == operand);
        self.scalars[place.expect("a coefficient is an output of the scalars")]
    }

    fn combination(&mut self, groups: &[Group<Operand>]) -> Vec<f64> {
        let mut sum = vec![0.0; N];
        for group in groups {
            for term in &group.terms {
                let sign = self.next() * if term.negative { -1.0 } else { 1.0 };
                let factor = sign * self.scalar(group.coefficient);
                let entries = self.vector(term.id);
                sum.iter_mut().zip(entries).for_each(|(sum, entry)| *sum += factor * entry);
            }
        }
        sum
    }

    fn block(&mut self, form: &Combination<Operand>) -> Vec<Vec<f64>> {
        let Combination::Matrix { stored, identity, outer } = form else { panic!("no matrix") };
        let mut sum = vec![vec![0.0; N]; N];
        let mut add = |factor: f64, entry: &dyn Fn(usize, usize) -> f64| {
            for (i, row) in sum.iter_mut().enumerate() {
                row.iter_mut().enumerate().for_each(|(j, sum)| *sum += factor * entry(i, j));
            }
        };
        for group in stored {
            for term in &group.terms {
                let sign = self.next() * if term.negative { -1.0 } else { 1.0 };
                let matrix = self.matrix(term.id);
                add(sign * self.scalar(group.coefficient), &|i, j| matrix[i][j]);
            }
        }
        if let Some(coefficient) = identity {
            let factor = self.next() * self.scalar(*coefficient);
            add(factor, &|i, j| f64::from(u8::from(i == j)));
        }
        for (left, groups) in outer {
            let (left, right) = (self.vector(*left), self.combination(groups));
            add(1.0, &|i, j| left[i] * right[j]);
        }
        sum
    }

    /// The outputs, flat; matrices by rows.
    fn outputs(mut self) -> Rows {
        let outputs = &self.kernel.plan.outputs;
        let number = |run: &mut Self, form: &Combination<Operand>| {
            let Combination::Scalar(value) = form else { panic!("no number") };
            run.next() * run.scalar(*value)
        };
        let vector = |run: &mut Self, form: &Combination<Operand>| {
            let Combination::Vector(groups) = form else { panic!("no vector") };
            run.combination(groups)
        };
        match (self.kernel.kind(), outputs.as_slice()) {
            (ResultKind::Value, [value]) => vec![number(&mut self, value)],
            (ResultKind::Rows, [first, rest]) => {
                let first = number(&mut self, first);
                [vec![first], vector(&mut self, rest)].concat()
            }
            (ResultKind::Blocks, [corner, row, column, block]) => {
                let corner = number(&mut self, corner);
                let (row, column) = (vector(&mut self, row), vector(&mut self, column));
                let block = self.block(block);
                let below = column.iter().zip(block).map(|(x, rest)| [vec![*x], rest].concat());
                [vec![corner], row].into_iter().chain(below).flatten().collect()
            }
            (kind, outputs) => panic!("{} outputs of {kind:?}", outputs.len()),
        }
    }
}

fn transposed(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..N).map(|i| matrix.iter().map(|row| row[i]).collect()).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Numbers of the order of one, some hundreds added up, differences of them taken three times with step 1.
const ROUNDING: f64 = 4096.0 * f64::EPSILON;

#[test]
fn one_sign_in_any_kernel_of_a_motion_fails_its_check() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/motion");
    let mut paths: Vec<_> = fs::read_dir(&folder)
        .expect("motions")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    let (mut specs, mut missed) = (0, Vec::new());
    for path in paths {
        let text = fs::read_to_string(&path).expect("a readable file");
        if !text.contains("kind = \"motion\"") {
            continue;
        }
        specs += 1;
        let spec = MotionSpec::read(&Source::new(&path, text.clone()));
        let spec = spec.unwrap_or_else(|errors| panic!("{errors}"));
        let motion = Motion::new(&spec, &text);
        let mut random = Random::new(23, 1);
        let states: Vec<State> = (0..POINTS)
            .map(|_| [(); 3].map(|()| [(); SIZE].map(|()| uniform(&mut random))))
            .collect();
        let names: Vec<_> = states.iter().map(|state| motion.names(state)).collect();
        for kernel in planned(&spec).expect("kernels") {
            let expected: Vec<Rows> =
                states.iter().map(|state| motion.expected(kernel.name(), state)).collect();
            let run = |flip| -> Vec<Rows> {
                names.iter().map(|names| Run::new(&kernel, names, flip).outputs()).collect()
            };
            let check = |found: &[Rows]| {
                found.iter().zip(&expected).all(|(found, expected)| {
                    let size = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
                    found.len() == expected.len()
                        && found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= ROUNDING * size)
                })
            };
            let plain = run(None);
            let name = format!("{}: {}", spec.name, kernel.name());
            assert!(
                check(&plain),
                "{name} is not what follows from the file: {plain:?} {expected:?}"
            );
            let (mut caught, mut without_effect) = (0, 0);
            for flip in all_flips(&kernel) {
                let flipped = run(Some(flip));
                if flipped == plain {
                    without_effect += 1;
                } else if check(&flipped) {
                    missed.push(format!("{name}: {flip:?}"));
                } else {
                    caught += 1;
                }
            }
            println!("{name}: {caught} caught, {without_effect} without effect");
            assert!(caught > 0, "{name}: nothing to flip");
        }
    }
    assert!(specs > 0 && missed.is_empty(), "{missed:#?}");
}
