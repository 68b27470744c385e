//! How long the parts of a step are, where the march chooses them: on a ladder of halves, by what each part is worth.
//!
//! A part is done again as two halves where its local error, or the energy that it makes at a joint, is beyond the tolerance;
//! after some in a row that are far below it the next ones are twice as long. So every part is the step over a power of two,
//! every step ends with a part, and factors are used again.
//!
//! Here all modes count, since which of them a part resolves is what is to be found. The error of a mode is weighed by
//! 1/(1 + β(ωΔt)²): of motion that the part resolves nothing is taken away, and one that it does not, which the estimate
//! takes for many times what it moves, counts with about its amplitude.

use serde::{Deserialize, Serialize};

use crate::bearing::work::{Flow, MOTIONS};
use crate::dynamics::motion::{MovingPart, SMALLEST, TurnRange, larger, ratio};

/// A march that chooses the parts of its steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AutomaticStep {
    /// Local error that a part of a step may have, as a fraction of the largest displacement of the body so far. At the
    /// joints it may make ten times this fraction of the energy in play there.
    pub tolerance: f64,
    /// Longest part (s): what acts faster than that would be passed over.
    pub longest: f64,
}

impl AutomaticStep {
    /// Far below what a sound run may have, 3.5e-3; 59 parts a period.
    pub const TOLERANCE: f64 = 1e-4;
}

impl Default for AutomaticStep {
    fn default() -> Self {
        AutomaticStep { tolerance: AutomaticStep::TOLERANCE, longest: f64::INFINITY }
    }
}

/// The parts that the steps of a march took.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PartsTaken {
    /// Those that were accepted.
    pub parts: usize,
    /// Those that were done again as halves: beyond the tolerance, or not solved.
    pub rejected: usize,
    /// Halvings of a step of the longest and of the shortest that were accepted, cuts where loads begin or end not counted;
    /// none before the first.
    pub halvings: Option<[u32; 2]>,
}

/// Halvings of a step at most: 16 384 parts.
pub(in crate::dynamics) const MOST_HALVINGS: u32 = 14;
/// Energy that a part may make at a joint, as a multiple of the tolerance: a contact of frequency ω that begins in the middle
/// of a part makes (ωΔt)²/4 of what it takes, where motion at ω has a local error of (ωΔt)³/12.
const ENERGY: f64 = 10.0;
/// A part below this fraction of the tolerance might be twice as long, as errors grow with Δt³; after so many in a row it is:
/// more than an oscillation stays near the place where its error is none.
const CALM: f64 = 0.1;
const CALM_PARTS: u32 = 8;
/// Rows that are foreseen where a march begins.
pub(in crate::dynamics) const FORESEEN: u32 = 16;
/// Energy that a row which is foreseen may make at a joint, as a fraction of what is in play there: beyond that it says little of
/// where the machine goes.
const MOST_FORESEEN: f64 = 0.1;

/// What is remembered from part to part.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::dynamics) struct ControlMemory {
    /// Halvings of a step.
    pub(in crate::dynamics) halvings: u32,
    /// Parts in a row that were far below the tolerance, and whether all were so far.
    calm: u32,
    begins: bool,
    /// The parts of the machine by which others are measured; turns are behind them.
    parts: Vec<MovingPart>,
    /// Largest displacement of every part of the machine and of turns so far (m), and the most energy in play at every bearing,
    /// in each of its [`MOTIONS`] (J).
    displacements: Vec<f64>,
    energies: Vec<f64>,
    /// Largest displacement of every part of the machine in the first rows as they were foreseen (m), and for how many of
    /// these rows it still counts.
    foreseen: Vec<f64>,
    rows_ahead: u32,
    /// What turns were so far.
    pub(in crate::dynamics) turned: Vec<TurnRange>,
    pub(in crate::dynamics) taken: PartsTaken,
}

impl ControlMemory {
    /// As it is, with what turns were.
    pub(in crate::dynamics) fn with_turns(&self, turned: &[TurnRange]) -> Self {
        ControlMemory { turned: turned.to_vec(), ..self.clone() }
    }

    /// As it is, with nothing counted yet.
    pub(in crate::dynamics) fn counted_anew(&self) -> Self {
        ControlMemory { taken: PartsTaken::default(), ..self.clone() }
    }
}

/// Chooses the parts of steps.
pub(in crate::dynamics) struct StepControl {
    options: AutomaticStep,
    pub(in crate::dynamics) memory: ControlMemory,
    /// Halvings of a step that lead to parts as long as they may be.
    least: u32,
    /// Of the part that was judged last: displacements at its end, and energies in play.
    displacements: Vec<f64>,
    energies: Vec<f64>,
}

/// What was measured of a part that may be accepted.
pub(in crate::dynamics) struct Measured<'m> {
    /// Local errors by parts of the machine (m), and displacements at the end of the part.
    pub(in crate::dynamics) errors: &'m [f64],
    pub(in crate::dynamics) displacements: &'m [f64],
    /// What was made and flowed by bearings and their [`MOTIONS`], and by bearings the kinetic energy of both bodies without
    /// rotations (J).
    pub(in crate::dynamics) flows: &'m [Flow],
    pub(in crate::dynamics) kinetic: &'m [f64],
    /// Work that is no more than rounding (J).
    pub(in crate::dynamics) rounding: f64,
}

impl StepControl {
    /// Local error that a part may have.
    pub(in crate::dynamics) fn tolerance(&self) -> f64 {
        self.options.tolerance
    }

    /// Of steps of `dt` s of a machine that stands at some displacements, of its parts and of the turns behind them, and has so
    /// many bearings. The first parts are the shortest: over one that is far longer than what acts both errors may be none by
    /// chance.
    pub(in crate::dynamics) fn new(
        options: AutomaticStep,
        dt: f64,
        (displacements, parts): (&[f64], Vec<MovingPart>),
        bearings: usize,
    ) -> Self {
        let is_short = |halvings: &u32| dt <= options.longest * f64::from(1_u32 << halvings);
        let least = (0..MOST_HALVINGS).find(is_short).unwrap_or(MOST_HALVINGS);
        StepControl {
            options,
            least,
            memory: ControlMemory {
                halvings: MOST_HALVINGS,
                calm: 0,
                begins: true,
                parts,
                displacements: displacements.to_vec(),
                energies: vec![0.0; MOTIONS * bearings],
                foreseen: vec![0.0; displacements.len()],
                rows_ahead: FORESEEN,
                turned: Vec::new(),
                taken: PartsTaken::default(),
            },
            displacements: displacements.to_vec(),
            energies: vec![0.0; MOTIONS * bearings],
        }
    }

    /// Goes on as an earlier march did, if that had the same parts; whether it does.
    pub(in crate::dynamics) fn resume_from(&mut self, memory: ControlMemory) -> bool {
        let own = &self.memory;
        let counts = |of: &ControlMemory| [of.displacements.len(), of.energies.len()];
        let fits = memory.parts == own.parts && counts(&memory) == counts(own);
        if fits {
            self.memory = memory;
            self.memory.halvings = self.memory.halvings.max(self.least);
        }
        fits
    }

    /// Whether the first rows are still to be foreseen.
    pub(in crate::dynamics) fn is_new(&self) -> bool {
        self.memory.rows_ahead == FORESEEN
    }

    /// Takes what was measured of a row that is foreseen; whether it says where the machine goes.
    pub(in crate::dynamics) fn foresee(&mut self, measured: &Measured) -> bool {
        let trusted = self.energy_made(measured) <= MOST_FORESEEN;
        if trusted {
            raise(&mut self.memory.foreseen, measured.displacements);
        }
        trusted
    }

    /// Ends a row.
    pub(in crate::dynamics) fn end_row(&mut self) {
        self.memory.rows_ahead = self.memory.rows_ahead.saturating_sub(1);
    }

    /// What is measured of a part over what it may be: the worst of all parts of the machine and bearings.
    pub(in crate::dynamics) fn judge(&mut self, measured: &Measured) -> f64 {
        let tolerance = self.options.tolerance;
        self.displacements.copy_from_slice(measured.displacements);
        let ControlMemory { parts, displacements, foreseen, rows_ahead, .. } = &self.memory;
        let of = |part: usize| match rows_ahead {
            0 => displacements[part],
            _ => larger(displacements[part], foreseen[part]),
        };
        let least = SMALLEST * (0..parts.len()).map(of).fold(0.0, larger);
        let errors = measured.errors.iter().enumerate();
        let errors = errors.map(|(part, error)| ratio(*error, tolerance * larger(of(part), least)));
        let worst = errors.fold(0.0, larger);
        larger(worst, self.energy_made(measured) / (ENERGY * tolerance))
    }

    /// The largest fraction of the energy in play that is made at any bearing.
    fn energy_made(&mut self, measured: &Measured) -> f64 {
        let mut worst = 0.0;
        let kinetic = measured.kinetic.iter().flat_map(|own| [own; MOTIONS]);
        let flows = measured.flows.iter().zip(kinetic).zip(&self.memory.energies);
        for (((flow, kinetic), most), kept) in flows.zip(&mut self.energies) {
            let in_play = flow.flowed + kinetic;
            *kept = in_play;
            let allowed = larger(in_play, SMALLEST * most);
            if !(flow.made <= measured.rounding) {
                worst = larger(worst, ratio(flow.made, allowed));
            }
        }
        worst
    }

    /// Takes the part that was judged last, with so many halvings.
    pub(in crate::dynamics) fn accept(&mut self, judged: f64, halvings: u32) {
        let memory = &mut self.memory;
        raise(&mut memory.displacements, &self.displacements);
        raise(&mut memory.energies, &self.energies);
        let goes_on = judged <= CALM && memory.halvings == halvings;
        memory.calm = if goes_on { memory.calm.saturating_add(1) } else { 0 };
        memory.begins &= goes_on;
        memory.halvings = halvings;
        let taken = &mut memory.taken;
        taken.parts += 1;
        let [least, most] = taken.halvings.unwrap_or([halvings; 2]);
        taken.halvings = Some([least.min(halvings), most.max(halvings)]);
    }

    /// Counts a part that is done again.
    pub(in crate::dynamics) fn reject(&mut self) {
        (self.memory.calm, self.memory.begins) = (0, false);
        self.memory.taken.rejected += 1;
    }

    /// Makes the next part twice as long where that is due, at a place in the step in units of the shortest part.
    pub(in crate::dynamics) fn lengthen(&mut self, at: u32) {
        let memory = &mut self.memory;
        let is_due = memory.calm >= CALM_PARTS || memory.begins && memory.calm > 0;
        if is_due && memory.halvings > self.least {
            let twice = 1 << (MOST_HALVINGS - memory.halvings + 1);
            if at.is_multiple_of(twice) {
                (memory.halvings, memory.calm) = (memory.halvings - 1, 0);
            }
        }
    }
}

fn raise(so_far: &mut [f64], own: &[f64]) {
    so_far.iter_mut().zip(own).for_each(|(most, own)| *most = larger(*most, *own));
}

#[cfg(test)]
mod tests {
    use super::*;

    const AUTOMATIC: AutomaticStep = AutomaticStep { tolerance: 1e-3, longest: 0.3 };

    fn parts(count: usize) -> Vec<MovingPart> {
        (0..count).map(|body| MovingPart { body, turns: false }).collect()
    }

    fn control() -> StepControl {
        StepControl::new(AUTOMATIC, 1.0, (&[2.0, 1e-6], parts(2)), 1)
    }

    fn judged(control: &mut StepControl, errors: [f64; 2], made: f64, kinetic: f64) -> f64 {
        control.judge(&Measured {
            errors: &errors,
            displacements: &[2.0, 1e-6],
            flows: &[Flow::default(), Flow { made, flowed: 0.5, moved: 0.0 }],
            kinetic: &[kinetic],
            rounding: 1e-12,
        })
    }

    #[test]
    fn errors_count_by_what_moves_and_energies_by_what_is_in_play() {
        let mut control = control();
        let near = |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-12, "{found}");
        near(judged(&mut control, [4e-4, 0.0], 0.0, 0.0), 0.2);
        // Of what hardly moves, a thousandth of what moves most.
        near(judged(&mut control, [0.0, 1e-6], 0.0, 0.0), 0.5);
        near(judged(&mut control, [0.0; 2], 1e-2, 1.5), 0.5);
        assert_eq!(judged(&mut control, [0.0; 2], 1e-12, 0.0), 0.0);
        assert!(judged(&mut control, [f64::NAN, 1.0], 1.0, 1.0).is_nan());
        // A thousandth of what was in play once, where less is now; what was not accepted was not.
        judged(&mut control, [0.0; 2], 0.0, 1e6);
        near(judged(&mut control, [0.0; 2], 0.01, 0.0), 2.0);
        judged(&mut control, [0.0; 2], 0.0, 999.5);
        control.accept(0.0, 2);
        near(judged(&mut control, [0.0; 2], 0.01, 0.0), 1.0);
    }

    #[test]
    fn parts_become_longer_where_they_are_calm_and_fit() {
        let mut control = control();
        assert_eq!(control.memory.halvings, MOST_HALVINGS);
        let whole = 1 << MOST_HALVINGS;
        let mut calm = |halvings: u32, at: u32, judged: f64| {
            control.accept(judged, halvings);
            (0..CALM_PARTS - 1).for_each(|_| control.accept(0.1, halvings));
            control.lengthen(at);
            let now = control.memory.halvings;
            (now, control.memory.taken.halvings)
        };
        // The first part is one of another length, or none that is calm.
        assert_eq!(calm(3, whole, 0.0).0, 3);
        assert_eq!(calm(3, whole, 0.0).0, 2);
        assert_eq!(calm(3, whole / 4, 0.0).0, 3);
        // Where the longer part would begin at no multiple of itself.
        assert_eq!(calm(3, whole / 8, 0.0).0, 3);
        // A quarter of the step is the longest that it may take.
        assert_eq!(calm(3, whole / 4, 0.2), (3, Some([3, 3])));
        assert_eq!(calm(2, whole, 0.0).0, 2);
        assert_eq!(calm(2, whole, 0.0), (2, Some([2, 3])));
    }

    #[test]
    fn what_is_remembered_goes_on_within_the_limits() {
        let mut other = StepControl::new(AutomaticStep::default(), 1.0, (&[0.0; 2], parts(2)), 1);
        other.accept(0.0, 0);
        let mut control = control();
        assert!(control.resume_from(other.memory.counted_anew()));
        assert_eq!((control.memory.halvings, control.memory.taken), (2, PartsTaken::default()));
    }
    /// With other parts, or as many of which some are turns, nothing is what it was.
    #[test]
    fn what_other_parts_did_is_not_gone_on_with() {
        for (count, displacements) in [(2, vec![7.0; 3]), (1, vec![7.0; 2]), (3, vec![7.0; 3])] {
            let other = StepControl::new(AUTOMATIC, 1.0, (&displacements, parts(count)), 1).memory;
            let mut control = control();
            let before = control.memory.clone();
            assert!(!control.resume_from(other));
            assert_eq!(control.memory, before);
        }
    }
}
