//! States of laws: found spring by spring where the laws are evaluated, so that for all else a law with states is one
//! without.
//!
//! Of a law Q(x, s) with ṡ = g(x, s) a step knows b and h of s = b + h ṡ ([`Hold`]). So s solves
//! F = σ s − b − h g(x, s) = 0, with σ = 1, or 0, b = 0 and h = 1 where the rates are zero. With J = σ − h ∂g/∂s it is
//! ds/dx = J⁻¹ h ∂g/∂x, and the forces have the slopes ∂Q/∂x + ∂Q/∂s ds/dx: those of the step, exactly. Newton's method
//! begins at b + h ṡ_n, so that s is a function of the motion and of what is known, whatever was evaluated before.
//!
//! A state that only integrates, whose rate hangs on no state that does more, has no s of its own where the rate is zero: ∂g/∂s has a
//! row of nothing. It stays as it is known, or, where all is to settle, it is s = h g with a long h, so that its input is where
//! g = 0 and s is what the balance asks of it.

use super::hold::{Hold, LawStates};
use super::law_memory::LawMemory;
use super::placed_law::PlacedLaw;
use super::springs::Springs;

/// Multiples of eps · Σ |terms of F| that rounding may leave in F.
const ROUNDING: f64 = 16.0;
/// Share of Σ |terms| at which F is solved where rounding holds it up.
const SOLVED: f64 = 1e-9;
/// Iterations after which a law has no states.
const MOST: usize = 60;
/// Shortest correction that is tried.
const SHORTEST: f64 = 1.0 / 4096.0;

/// What is known of the states, and memory for one law at all its springs.
pub(super) struct Remembering {
    pub(super) given: LawStates,
    /// By laws where their states begin among all.
    pub(super) first: Vec<usize>,
    /// A row of springs a state: the state before a correction, the correction, and Σ |terms of F| at the beginning.
    before: Vec<f64>,
    correction: Vec<f64>,
    scale: Vec<f64>,
    /// By springs the share of the correction that was taken, the largest F before it over its scale, and whether F is solved.
    taken: Vec<f64>,
    merit: Vec<f64>,
    solved: Vec<bool>,
    /// By states, rows of springs, whether they only integrate, where rates are zero.
    integrates: Vec<bool>,
    /// J with columns beside it, row after row, of one spring.
    system: Vec<f64>,
}

/// σ, b and h of a state, and where it begins to be looked for.
#[derive(Clone, Copy)]
struct Known {
    own: f64,
    known: f64,
    weight: f64,
    guess: f64,
}

impl Known {
    const AT_REST: Known = Known { own: 0.0, known: 0.0, weight: 1.0, guess: 0.0 };

    /// Of a state that has a value.
    fn stays(value: f64) -> Known {
        Known { own: 1.0, known: value, weight: 0.0, guess: value }
    }
}

/// What a law with states gives in a step: rows as those of a law, forces and slopes as without states.
pub(super) struct InStep<'s> {
    pub(super) states: &'s mut [f64],
    pub(super) rates: &'s mut [f64],
    pub(super) relaxes: &'s mut [f64],
    pub(super) forces: &'s mut [f64],
    pub(super) slopes: &'s mut [f64],
}

/// What a law gives at one spring.
#[derive(Clone, Copy)]
struct AtSpring<'o> {
    outputs: &'o [f64],
    forces: usize,
    inputs: usize,
    rows_in: usize,
    springs: usize,
    spring: usize,
}

impl<'o> AtSpring<'o> {
    fn new(law: &PlacedLaw, outputs: &'o [f64], spring: usize) -> Self {
        let bound = &law.bound;
        AtSpring {
            outputs,
            forces: bound.forces.len(),
            inputs: bound.inputs.len(),
            rows_in: bound.rows_in(),
            springs: law.springs,
            spring,
        }
    }

    /// A force by its place among those that the law gives, or its derivative by the input or state at `by` − 1.
    fn force(&self, force: usize, by: usize) -> f64 {
        self.outputs[(force * (1 + self.rows_in) + by) * self.springs + self.spring]
    }

    fn force_by_state(&self, force: usize, state: usize) -> f64 {
        self.force(force, 1 + self.inputs + state)
    }

    fn rate(&self, state: usize) -> f64 {
        self.force(self.forces + state, 0)
    }

    fn rate_by_input(&self, state: usize, input: usize) -> f64 {
        self.force(self.forces + state, 1 + input)
    }

    fn rate_by_state(&self, state: usize, by: usize) -> f64 {
        self.force_by_state(self.forces + state, by)
    }

    /// Fills a row of J.
    fn write_row(&self, state: usize, known: Known, row: &mut [f64]) {
        for (by, entry) in row.iter_mut().enumerate() {
            let own = if by == state { known.own } else { 0.0 };
            *entry = own - known.weight * self.rate_by_state(state, by);
        }
    }
}

impl Remembering {
    pub(super) fn new(springs: &Springs) -> Self {
        let mut sum = 0;
        let first = springs.laws.iter().map(|law| {
            let own = sum;
            sum += law.bound.states.len() * law.springs;
            own
        });
        let first = first.collect();
        let rows = springs.most(|law| law.bound.states.len());
        let with_states = || springs.laws.iter().filter(|law| !law.bound.states.is_empty());
        let most = with_states().map(|law| law.springs).max().unwrap_or(0);
        let system = with_states().map(|law| {
            let states = law.bound.states.len();
            states * (states + law.bound.inputs.len().max(1))
        });
        Remembering {
            given: LawStates::beginning(sum),
            first,
            before: vec![0.0; rows],
            correction: vec![0.0; rows],
            scale: vec![0.0; rows],
            taken: vec![0.0; most],
            merit: vec![0.0; most],
            solved: vec![false; most],
            integrates: vec![false; rows],
            system: vec![0.0; system.max().unwrap_or(0)],
        }
    }

    /// What is known of a state of a law at a spring.
    fn known(&self, law: &PlacedLaw, place: usize, state: usize, spring: usize) -> Known {
        let start = law.bound.states[state].start;
        let at = self.first[place] + state * law.springs + spring;
        let begins = start.unwrap_or(0.0);
        let integrates = self.integrates[state * law.springs + spring];
        match self.given.hold {
            Hold::Rest if integrates => {
                Known::stays(self.given.known.get(at).copied().unwrap_or(begins))
            }
            Hold::Settled(long) if integrates => {
                match self.given.known.get(at).copied().filter(|own| own.is_finite()) {
                    Some(value) => Known::stays(value),
                    None => Known { own: 1.0, known: 0.0, weight: long, guess: begins },
                }
            }
            Hold::Rest | Hold::Settled(_) => Known { guess: begins, ..Known::AT_REST },
            Hold::Start => match start {
                None if !integrates => Known::AT_REST,
                _ => Known::stays(begins),
            },
            Hold::Implicit(weight) => {
                let known = self.given.known[at];
                let guess = known + weight * self.given.rates[at];
                Known { own: 1.0, known, weight, guess }
            }
        }
    }

    /// Finds which states at a spring only integrate, of those whose rates are to be zero: no state that does more is in their
    /// rates. Whether there are any.
    fn find_integrating(&mut self, law: &PlacedLaw, place: usize, memory: &LawMemory) -> bool {
        let (n, states) = (law.springs, law.bound.states.len());
        let mut any = false;
        for j in 0..n {
            let given = AtSpring::new(law, &memory.outputs, j);
            loop {
                let does_more = |state: &usize| !self.integrates[state * n + j];
                let next = (0..states).filter(does_more).find(|&state| {
                    let rests = self.known(law, place, state, j).own == 0.0;
                    let by = |other: usize| given.rate_by_state(state, other) == 0.0;
                    rests && (0..states).filter(does_more).all(by)
                });
                let Some(state) = next else { break };
                self.integrates[state * n + j] = true;
                any = true;
            }
        }
        any
    }

    /// Puts the states behind the inputs of a law, and leaves what the law gives there.
    pub(super) fn find(&mut self, law: &PlacedLaw, place: usize, memory: &mut LawMemory) {
        let (n, states) = (law.springs, law.bound.states.len());
        self.integrates[..states * n].fill(false);
        self.guess(law, place, memory);
        if !matches!(self.given.hold, Hold::Implicit(_)) {
            memory.evaluate(law);
            if self.find_integrating(law, place, memory) {
                self.guess(law, place, memory);
            }
        }
        self.solved[..n].fill(false);
        self.merit[..n].fill(f64::INFINITY);
        self.taken[..n].fill(1.0);
        for iteration in 0..MOST {
            memory.evaluate(law);
            let mut all_solved = true;
            for j in 0..n {
                if !self.solved[j] {
                    self.correct(law, (place, j), memory, iteration == 0);
                    all_solved &= self.solved[j];
                }
            }
            if all_solved {
                return;
            }
        }
    }

    /// Puts where states are looked for from behind the inputs of a law.
    fn guess(&mut self, law: &PlacedLaw, place: usize, memory: &mut LawMemory) {
        let (n, inputs) = (law.springs, law.bound.inputs.len());
        for state in 0..law.bound.states.len() {
            for j in 0..n {
                let guess = self.known(law, place, state, j).guess;
                memory.inputs[(inputs + state) * n + j] = guess;
                (self.before[state * n + j], self.correction[state * n + j]) = (guess, 0.0);
            }
        }
    }

    /// Judges the states at a spring, and corrects them unless they solve F = 0.
    fn correct(
        &mut self,
        law: &PlacedLaw,
        (place, j): (usize, usize),
        memory: &mut LawMemory,
        first: bool,
    ) {
        let (n, inputs, states) = (law.springs, law.bound.inputs.len(), law.bound.states.len());
        let given = AtSpring::new(law, &memory.outputs, j);
        let width = states + 1;
        let (mut left, mut merit) = (0.0, 0.0);
        for state in 0..states {
            let known = self.known(law, place, state, j);
            let value = memory.inputs[(inputs + state) * n + j];
            let missing = (known.weight * given.rate(state) + known.known) - known.own * value;
            let by_inputs =
                (0..inputs).map(|k| given.rate_by_input(state, k) * memory.inputs[k * n + j]);
            let by_states = (0..states)
                .map(|k| given.rate_by_state(state, k) * memory.inputs[(inputs + k) * n + j]);
            let of_rate: f64 = by_inputs.chain(by_states).map(f64::abs).sum();
            let terms = (known.own * value).abs()
                + known.known.abs()
                + known.weight * (given.rate(state).abs() + of_rate);
            let at = state * n + j;
            if first {
                self.scale[at] = terms;
            }
            left = larger(left, share(missing, terms));
            merit = larger(merit, share(missing, self.scale[at]));
            let row = &mut self.system[state * width..][..width];
            given.write_row(state, known, &mut row[..states]);
            row[states] = missing;
        }
        let falls = merit < self.merit[j];
        if left <= ROUNDING * f64::EPSILON || !falls && left <= SOLVED {
            self.solved[j] = true;
            return;
        }
        if falls {
            (self.merit[j], self.taken[j]) = (merit, 1.0);
            eliminate(&mut self.system[..states * width], width);
            for state in 0..states {
                let at = state * n + j;
                self.before[at] = memory.inputs[(inputs + state) * n + j];
                self.correction[at] = self.system[state * width + states];
            }
        } else {
            self.taken[j] = (0.5 * self.taken[j]).max(SHORTEST);
        }
        for state in 0..states {
            let at = state * n + j;
            let moved = self.before[at] + self.taken[j] * self.correction[at];
            memory.inputs[(inputs + state) * n + j] = moved;
        }
    }

    /// Whether all is to settle and the rate of a state that only integrates is not zero, and hangs on nothing.
    fn goes_on(&self, given: &AtSpring, springs: usize, spring: usize) -> bool {
        let states = given.rows_in - given.inputs;
        matches!(self.given.hold, Hold::Settled(_))
            && (0..states).any(|state| {
                self.integrates[state * springs + spring]
                    && given.rate(state) != 0.0
                    && (0..given.inputs).all(|own| given.rate_by_input(state, own) == 0.0)
                    && (0..states).all(|own| given.rate_by_state(state, own) == 0.0)
            })
    }

    /// Takes states, rates, forces and their slopes from what a law gives where its states were found.
    pub(super) fn condense(
        &mut self,
        law: &PlacedLaw,
        place: usize,
        memory: &LawMemory,
        own: InStep<'_>,
    ) {
        let (bound, n) = (&law.bound, law.springs);
        let (inputs, states) = (bound.inputs.len(), bound.states.len());
        own.states.copy_from_slice(&memory.inputs[inputs * n..][..states * n]);
        let width = states + inputs;
        for j in 0..n {
            let given = AtSpring::new(law, &memory.outputs, j);
            for state in 0..states {
                own.rates[state * n + j] = given.rate(state);
                own.relaxes[state * n + j] = -given.rate_by_state(state, state);
                let known = self.known(law, place, state, j);
                let row = &mut self.system[state * width..][..width];
                given.write_row(state, known, &mut row[..states]);
                for (input, entry) in row[states..].iter_mut().enumerate() {
                    *entry = known.weight * given.rate_by_input(state, input);
                }
            }
            eliminate(&mut self.system[..states * width], width);
            // A law whose states are not found has no force, nor one of which a state goes on for ever, whatever its inputs are.
            let found = self.solved[j] && !self.goes_on(&given, n, j);
            let lost = if found { 0.0 } else { f64::NAN };
            for (k, &force) in bound.forces.iter().enumerate() {
                own.forces[force * n + j] = given.force(k, 0) + lost;
                for (by, &input) in bound.inputs.iter().enumerate() {
                    let by_states = (0..states).map(|state| {
                        given.force_by_state(k, state) * self.system[state * width + states + by]
                    });
                    let slope = given.force(k, 1 + by) + by_states.sum::<f64>();
                    own.slopes[(force * bound.kind.inputs.len() + input) * n + j] = slope;
                }
            }
        }
    }
}

/// |a|/b; 0 of nothing.
fn share(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a.abs() / b }
}

/// The larger of two; what is no number is larger than any.
fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

/// Replaces the columns B beside J, row after row of `width` values, by J⁻¹B, with the largest pivots; no numbers where J has
/// no inverse.
fn eliminate(system: &mut [f64], width: usize) {
    let states = system.len() / width;
    for pivot in 0..states {
        let size = |row: &usize| system[row * width + pivot].abs();
        let best = (pivot..states).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(pivot);
        if best != pivot {
            for column in 0..width {
                system.swap(pivot * width + column, best * width + column);
            }
        }
        let divisor = system[pivot * width + pivot];
        for column in pivot..width {
            system[pivot * width + column] /= divisor;
        }
        for row in (0..states).filter(|row| *row != pivot) {
            let factor = system[row * width + pivot];
            for column in pivot..width {
                system[row * width + column] -= factor * system[pivot * width + column];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_beside_a_matrix_are_solved() {
        // J = [[0, 2, 1], [1, -1, 3], [4, 0, 0.5]], x = [[1, -2], [3, 0.25], [-1, 5]].
        let j = [[0.0, 2.0, 1.0], [1.0, -1.0, 3.0], [4.0, 0.0, 0.5]];
        let x = [[1.0, -2.0], [3.0, 0.25], [-1.0, 5.0]];
        let mut system = Vec::new();
        for row in j {
            system.extend(row);
            system.extend([0, 1].map(|c| (0..3).map(|k| row[k] * x[k][c]).sum::<f64>()));
        }
        eliminate(&mut system, 5);
        for (row, x) in system.chunks_exact(5).zip(x) {
            for (found, exact) in row[3..].iter().zip(x) {
                assert!((found - exact).abs() < 1e-14, "{found} for {exact}");
            }
        }
        let mut singular = vec![1.0, 2.0, 1.0, 2.0, 4.0, 3.0];
        eliminate(&mut singular, 3);
        assert!(!singular[2].is_finite() && !singular[5].is_finite());
    }
}
