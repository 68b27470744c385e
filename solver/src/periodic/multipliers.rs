//! Multipliers of a periodic motion: eigenvalues of the derivative of its cycle map, and what they say.
//!
//! Modes that steps do not resolve have multipliers of their own: by the average acceleration the modulus of one that is damped is
//! 1 − 4ζT/(ωΔt²) or so, nearer to 1 the longer steps are, where those of the motion are right to O(Δt²). With steps half as
//! long the logarithm of the modulus is four times as large, and from step to step such a change turns by far, near to the
//! other sign: so they are told. Either alone is no proof: what a multiplier near 1 loses may be four times as much by its error.

use num_complex::Complex64;

use super::krylov::Krylov;
use super::weighed::{LinearCycle, Weighed};
use crate::error::Error;
use crate::linalg::ritz_pairs;

/// Products with the derivative at most, where states are many, and how often Ritz values are looked at.
const PRODUCTS: usize = 160;
const LOOKED_AT: usize = 8;
/// What may be left of a Ritz pair: by the steps' own tangents, and by differences.
const LEFT: [f64; 2] = [1e-7, 1e-5];
/// Moduli below which a multiplier is rounding.
const NOTHING: f64 = 1e-12;
/// What steps half as long change of one at most, of its size or of 1; by which factor e^FOURFOLD what is lost may be off four times as
/// much; and how near conjugates are to each other.
const ALIKE: f64 = 0.5;
const NEAR: f64 = 0.02;
const FOURFOLD: f64 = 1.0;
const SAME: f64 = 1e-9;
/// Mean cosine between a change and the same a step later below which steps do not resolve it: five steps and a half a turn.
const JUMPS: f64 = 0.5;
/// Multipliers that are found more of with steps half as long: not all have the same order.
pub(super) const MORE: usize = 8;
/// Moduli above which a multiplier without one of steps half as long is no verdict, where others have one.
const ALONE: f64 = 0.9;

/// A multiplier of a periodic motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Multiplier {
    /// μ.
    pub value: Complex64,
    /// The same with steps half as long, where that was found.
    pub finer: Option<Complex64>,
    /// Of what it is.
    pub kind: MultiplierKind,
}

/// Of what a multiplier is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MultiplierKind {
    /// Of the motion.
    Motion,
    /// Of the phase of a motion with a period of its own: 1, as one that begins later goes on alike.
    Phase,
    /// Of motion that the steps do not resolve: it says how fast that dies in the march, not in the machine.
    Unresolved,
}

/// What multipliers say of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// Changes die.
    Stable,
    /// A change grows to one side: near a fold, another branch of motions begins or ends.
    Diverges,
    /// A change grows and takes the other sign in every cycle: near there the period doubles.
    Doubles,
    /// A change grows and has another frequency: near there a second frequency appears (Neimark and Sacker).
    Wanders,
    /// The largest multiplier is nearer to the unit circle than steps tell.
    Undecided,
}

/// A multiplier with its change of the state at the start, in weighed coordinates.
type Pair = (Complex64, Vec<Complex64>);

/// The largest multipliers of a motion with their changes.
pub(super) struct Largest {
    pairs: Vec<Pair>,
    cycle: Option<LinearCycle>,
}

impl Largest {
    /// Ascending in what they have lost: all of them where states are few.
    ///
    /// # Errors
    /// A step that does not converge; eigenvalues that are not found.
    pub(super) fn of(map: &mut Weighed, y: &[f64], wanted: usize) -> Result<Self, Error> {
        let (mut pairs, cycle) = if map.map.is_small() {
            let (_, monodromy) = map.monodromy(y)?;
            (ritz_pairs(&monodromy)?, None)
        } else {
            let (_, mut cycle) = map.linearised(y)?;
            (of_many(map, &mut cycle, y.len(), wanted)?, Some(cycle))
        };
        pairs.retain(|own| own.0.norm() > NOTHING);
        pairs.sort_by(|(a, _), (b, _)| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
        Ok(Largest { pairs, cycle })
    }

    /// Without their changes.
    pub(super) fn values(&self) -> Vec<Complex64> {
        self.pairs.iter().map(|own| own.0).collect()
    }

    /// With those of steps half as long, where there are some; `map` and `y` as they were found with.
    ///
    /// # Errors
    /// A step that does not converge.
    pub(super) fn with(
        mut self,
        (map, y): (&mut Weighed, &[f64]),
        finer: &[Complex64],
    ) -> Result<Vec<Multiplier>, Error> {
        let values = self.values();
        let mut may_jump = vec![true; values.len()];
        let mut known = vec![false; values.len()];
        loop {
            let all = paired((&values, &may_jump), finer);
            let open = |place: &usize| {
                all[*place].kind == MultiplierKind::Unresolved
                    && values[*place].im >= 0.0
                    && !known[*place]
            };
            let open: Vec<usize> = (0..all.len()).filter(open).collect();
            if open.is_empty() {
                return Ok(all);
            }
            if self.cycle.is_none() {
                self.cycle = Some(map.linearised(y)?.1);
            }
            let cycle = self.cycle.as_mut().expect("it was made");
            for place in open {
                known[place] = true;
                may_jump[place] = map.step_to_step(cycle, &self.pairs[place].1)? < JUMPS;
            }
        }
    }
}

/// The same of a motion whose other states are looked at elsewhere.
///
/// # Errors
/// As [`Largest::of`].
pub(super) fn largest(
    map: &mut Weighed,
    y: &[f64],
    wanted: usize,
) -> Result<Vec<Complex64>, Error> {
    Ok(Largest::of(map, y, wanted)?.values())
}

/// Those that Arnoldi's process finds first: the largest.
fn of_many(
    map: &mut Weighed,
    cycle: &mut LinearCycle,
    size: usize,
    wanted: usize,
) -> Result<Vec<Pair>, Error> {
    let left = LEFT[usize::from(map.map.memory() > 0)];
    let mut krylov = Krylov::new(&first(size));
    loop {
        if let Some(next) = krylov.next() {
            let image = map.change(cycle, next)?;
            krylov.take(image);
        }
        let complete = krylov.next().is_none() || krylov.size() >= PRODUCTS;
        if !complete && !krylov.size().is_multiple_of(LOOKED_AT) {
            continue;
        }
        let mut pairs = ritz_pairs(&krylov.matrix())?;
        pairs.sort_by(|a, b| b.0.norm().total_cmp(&a.0.norm()));
        let beyond = krylov.beyond();
        let last = |own: &Pair| own.1.last().map_or(0.0, |own| own.norm());
        let exact = |own: &&Pair| beyond * last(own) <= left;
        let leading = pairs.iter().take_while(exact).count();
        if complete || leading >= wanted {
            // Those behind one that is not known may have others before them.
            let known = if leading == 0 { pairs.len().min(1) } else { leading };
            pairs.truncate(known);
            return Ok(pairs
                .into_iter()
                .map(|(own, parts)| (own, krylov.vector(&parts)))
                .collect());
        }
    }
}

/// A vector with something of everything, the same every time.
fn first(size: usize) -> Vec<f64> {
    let mut state = 1_u64;
    let next = |_| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..size).map(next).collect()
}

/// Multipliers with those of steps half as long, each of which is taken once, the nearest pairs first: near by themselves, or by
/// the law of what is not resolved, which those obey that may jump from step to step. What has changed beyond that has no other, and
/// a conjugate has the conjugate of its own.
pub(super) fn paired(
    (own, may_jump): (&[Complex64], &[bool]),
    finer: &[Complex64],
) -> Vec<Multiplier> {
    // Of pairs the one above the real axis.
    let stands = |all: &[Complex64]| -> Vec<usize> {
        (0..all.len()).filter(|&place| all[place].im >= 0.0).collect()
    };
    let mut pairs: Vec<(f64, usize, usize, MultiplierKind)> = Vec::new();
    for i in stands(own) {
        for j in stands(finer) {
            let (value, other) = (own[i], finer[j]);
            let size = value.norm().max(NOTHING);
            let apart = (other - value).norm();
            let motion = apart / size;
            let lost = [value, other].map(|own| -own.norm().max(NOTHING).ln());
            let unresolved = (lost[1] / (4.0 * lost[0])).ln().abs();
            // What stands at 1 obeys both.
            let (cost, kind) = match may_jump[i] && unresolved < motion && value.norm() < 0.999 {
                true => (unresolved, MultiplierKind::Unresolved),
                false => (motion, MultiplierKind::Motion),
            };
            let is_alike = match kind {
                MultiplierKind::Unresolved => cost <= FOURFOLD,
                _ => cost <= ALIKE || apart <= NEAR,
            };
            if is_alike {
                pairs.push((cost, i, j, kind));
            }
        }
    }
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut all: Vec<Multiplier> = own
        .iter()
        .map(|value| Multiplier { value: *value, finer: None, kind: MultiplierKind::Motion })
        .collect();
    let mut taken = vec![false; finer.len()];
    for (_, i, j, kind) in pairs {
        if all[i].finer.is_none() && !taken[j] {
            taken[j] = true;
            all[i] = Multiplier { finer: Some(finer[j]), kind, ..all[i] };
        }
    }
    for i in (0..all.len()).filter(|&place| own[place].im < 0.0) {
        let mate = (0..all.len()).find(|&place| {
            own[place].im > 0.0 && (own[place].conj() - own[i]).norm() <= SAME * own[i].norm()
        });
        if let Some(Multiplier { finer, kind, .. }) = mate.map(|place| all[place]) {
            all[i] = Multiplier { finer: finer.map(|own| own.conj()), kind, ..all[i] };
        }
    }
    all
}

/// Calls the multiplier nearest to 1 that of the phase.
pub(super) fn name_phase(all: &mut [Multiplier]) {
    let apart = |own: &Multiplier| (own.value - 1.0).norm();
    let nearest = all.iter_mut().min_by(|a, b| apart(a).total_cmp(&apart(b)));
    if let Some(own) = nearest {
        own.kind = MultiplierKind::Phase;
    }
}

/// How far from the unit circle it must be for a verdict: twice what steps half as long change, and rounding.
pub(super) fn margin(own: &Multiplier) -> f64 {
    const ROUNDING: f64 = 1e-7;
    let apart = own.finer.map_or(0.0, |finer| (own.value.norm() - finer.norm()).abs());
    2.0 * apart + ROUNDING
}

/// The largest multiplier of the motion that is no verdict.
pub(super) fn doubtful(all: &[Multiplier]) -> Option<&Multiplier> {
    let compared = all.iter().any(|own| own.finer.is_some());
    let of_motion = all.iter().filter(|own| own.kind == MultiplierKind::Motion);
    let mut of_motion = of_motion.filter(|own| {
        let alone = compared && own.finer.is_none();
        own.value.norm() >= if alone { ALONE } else { 1.0 - margin(own) }
    });
    of_motion.next()
}

/// What multipliers say: by the largest of the motion.
pub(super) fn stability(all: &[Multiplier]) -> Stability {
    let of_motion = || all.iter().filter(|own| own.kind == MultiplierKind::Motion);
    let beyond = |own: &&Multiplier| own.value.norm() > 1.0 + margin(own);
    if let Some(own) = of_motion().find(beyond) {
        let real = own.value.im.abs() <= 1e-9 * own.value.norm();
        return match (real, own.value.re > 0.0) {
            (true, true) => Stability::Diverges,
            (true, false) => Stability::Doubles,
            (false, _) => Stability::Wanders,
        };
    }
    match doubtful(all) {
        None => Stability::Stable,
        Some(_) => Stability::Undecided,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of the reference machine at 4500 rpm with 360 and 720 steps.
    #[test]
    fn what_steps_do_not_resolve_is_told_by_steps_half_as_long() {
        let real = |value: f64| Complex64::new(value, 0.0);
        let pair = |modulus: f64, angle: f64| Complex64::from_polar(modulus, angle);
        let own = [real(0.797), real(0.795), real(0.453), pair(0.39333, 2.0), pair(0.39333, -2.0)];
        let finer =
            [real(0.404), real(0.399), pair(0.39295, 2.001), pair(0.39295, -2.001), real(0.042)];
        let all = paired((&own, &[true; 8][..own.len()]), &finer);
        use MultiplierKind::{Motion, Unresolved};
        let kinds: Vec<MultiplierKind> = all.iter().map(|own| own.kind).collect();
        assert_eq!(kinds, [Unresolved, Unresolved, Unresolved, Motion, Motion]);
        assert_eq!(all[2].finer, Some(real(0.042)));
        assert_eq!(stability(&all), Stability::Stable);
    }

    /// Numbers of pads on springs with 64 and 128 steps: what is nearly nothing has no part in what others lose, and conjugates are one.
    #[test]
    fn what_is_not_there_has_no_other() {
        let pair = |re: f64, im: f64| [Complex64::new(re, im), Complex64::new(re, -im)];
        let real = |value: f64| Complex64::new(value, 0.0);
        let own = [pair(0.2, 0.21809).to_vec(), vec![real(6.1e-5), real(5.8e-5)]].concat();
        let finer = [vec![real(0.5754), real(0.5761)], pair(0.198, 0.217).to_vec()].concat();
        let all = paired((&own, &[true; 8][..own.len()]), &finer);
        assert_eq!(all[0].finer, Some(finer[2]));
        assert_eq!(all[1].finer, Some(finer[3]));
        assert!(all[2..].iter().all(|own| own.finer.is_none()), "{all:?}");
        assert_eq!(stability(&all), Stability::Stable);
        // One of the largest that is not found again is no verdict.
        let all = paired((&[real(0.95), real(0.3)], &[true; 2]), &[real(0.3)]);
        assert_eq!(stability(&all), Stability::Undecided);
        assert_eq!(doubtful(&all).expect("one").value, real(0.95));
    }

    #[test]
    fn a_multiplier_near_the_circle_is_no_verdict() {
        let one = |value: f64, finer: f64| {
            let own = [Complex64::new(value, 0.0)];
            stability(&paired((&own, &[false]), &[Complex64::new(finer, 0.0)]))
        };
        assert_eq!(one(0.98, 0.985), Stability::Stable);
        assert_eq!(one(0.98, 0.9901), Stability::Undecided);
        assert_eq!(one(1.01, 1.0049), Stability::Undecided);
        assert_eq!(one(1.02, 1.015), Stability::Diverges);
        assert_eq!(one(-1.02, -1.015), Stability::Doubles);
    }
}
