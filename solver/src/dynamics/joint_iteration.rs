//! The iteration of a step in the measures of the joints.
//!
//! Between its joints a machine is all but linear in a step. Newton's correction d = A⁻¹r with kept A = L − NᵀK₀N leaves the
//! residual Nᵀρ, where ρ = F(u + Nd) − F(u) − K₀Nd is what the tangent of the springs did not foresee; the next correction
//! A⁻¹Nᵀρ moves the measures by Zρ, Z = N A⁻¹Nᵀ. So corrections are iterated in the measures, by the laws themselves, until
//! no force is missing, and the coordinates follow at once: d + A⁻¹Nᵀ Σρ. What varies in L is left to the iteration of the
//! step, which judges every state by its own residual.

use whirl_specs::ContactTangent;

use super::system::System;
use crate::linalg::{Columns, Matrix, add_columns, multiply, multiply_transpose_add};

/// Corrections at most.
const MOST: usize = 16;
/// Worst contraction with which the iteration goes on.
const CONTRACTION: f64 = 0.5;

/// Share of the first missing force below which an iteration has done its work, though rounding may hold it up.
const ENOUGH: f64 = 1e-2;

/// How an iteration in the measures ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Followed {
    /// Corrections of the measures.
    pub(super) corrections: usize,
    /// Whether they got smaller.
    pub(super) contracts: bool,
}

/// Z of kept factors, and memory for an iteration. Forces and motions are one value a measure.
pub(super) struct JointIteration {
    first: usize,
    /// N, over the unknowns.
    measures: Matrix,
    /// Z, column after column.
    compliance: Vec<f32>,
    /// What moments are divided by to compare them with forces (m); 1 for forces.
    arms: Vec<f64>,
    /// Motion since the iteration began, and that of a correction.
    moved: Vec<f64>,
    last: Vec<f64>,
    found: Vec<f32>,
    /// Forces before and after a correction, the missing ones, and their sum.
    before: Vec<f64>,
    after: Vec<f64>,
    missing: Vec<f64>,
    collected: Vec<f64>,
}

impl JointIteration {
    /// For a machine whose measures are constant and few enough that Z is less than what it spares, T_b and its transpose.
    pub(super) fn new(system: &System) -> Option<Self> {
        let (machine, springs) = (system.machine, &system.machine.springs);
        let (first, unknowns) = (machine.first_unknown(), machine.active());
        let measured = springs.measured();
        let spared = springs.bores.iter().map(|own| own.rows.data.len()).sum::<usize>();
        let is_less = measured * measured <= 4 * spared + unknowns * unknowns;
        if measured == 0 || !is_less || !springs.measures_are_constant() {
            return None;
        }
        let values = || vec![0.0; measured];
        Some(JointIteration {
            first,
            measures: springs.measures_of(first, unknowns),
            compliance: vec![0.0; measured * measured],
            arms: springs.arms_of_measures(),
            moved: values(),
            last: values(),
            found: vec![0.0; measured],
            before: values(),
            after: values(),
            missing: values(),
            collected: values(),
        })
    }

    /// Makes Z of A⁻¹, column after column; whether single precision holds it.
    pub(super) fn prepare(&mut self, inverse: &[f64]) -> bool {
        let n = self.measures.cols;
        let inverse = Columns { rows: n, cols: n, data: inverse };
        let moved = multiply(self.measures.view(), inverse);
        let measured = self.measures.rows;
        let mut whole = vec![0.0; measured * measured];
        multiply_transpose_add(&mut whole, 1.0, moved.view(), self.measures.view());
        self.compliance.iter_mut().zip(&whole).for_each(|(own, value)| *own = *value as f32);
        self.compliance.iter().all(|own| own.is_finite())
    }

    /// Iterates from a state just evaluated and its correction `d`, until less than `tolerance` (N) is missing at every
    /// spring. The springs are left where they are foreseen; what `d` lacks is A⁻¹ times the forces of
    /// [`JointIteration::add_forces`].
    pub(super) fn follow(
        &mut self,
        system: &mut System,
        tangents: &[ContactTangent],
        a1: f64,
        d: &[f64],
        tolerance: f64,
    ) -> Followed {
        let springs = &system.machine.springs;
        system.springs.mark();
        system.springs.measured_forces(&mut self.before);
        springs.measure(self.first, d, &mut self.last);
        self.moved.copy_from_slice(&self.last);
        self.collected.fill(0.0);
        let (mut first, mut last) = (None, f64::INFINITY);
        for corrections in 1..=MOST {
            system.springs.displace(springs, &self.moved, a1);
            system.springs.measured_forces(&mut self.after);
            let forces = self.after.iter().zip(&self.before);
            self.missing.iter_mut().zip(forces).for_each(|(out, (after, before))| {
                *out = after - before;
            });
            springs.subtract_linear(tangents, &self.last, &mut self.missing);
            let sizes = self.missing.iter().zip(&self.arms).map(|(own, arm)| (own / arm).abs());
            // What is no number is larger than any.
            let size = sizes.fold(0.0, |most: f64, own| if own <= most { most } else { own });
            if !size.is_finite() {
                self.collected.fill(0.0);
                return Followed { corrections, contracts: false };
            }
            if size > CONTRACTION * last && size > tolerance {
                let contracts = first.is_some_and(|first| size <= ENOUGH * first);
                return Followed { corrections, contracts };
            }
            self.collected.iter_mut().zip(&self.missing).for_each(|(sum, own)| *sum += own);
            if size <= tolerance {
                return Followed { corrections, contracts: true };
            }
            first.get_or_insert(size);
            last = size;
            self.correct();
            std::mem::swap(&mut self.before, &mut self.after);
        }
        Followed { corrections: MOST, contracts: false }
    }

    /// Moves the measures by Zρ.
    fn correct(&mut self) {
        let n = self.missing.len();
        self.found.fill(0.0);
        let columns = self.compliance.chunks_exact(n).zip(&self.missing);
        add_columns(&mut self.found, columns.map(|(column, force)| (column, *force as f32)));
        for ((last, moved), found) in self.last.iter_mut().zip(&mut self.moved).zip(&self.found) {
            *last = f64::from(*found);
            *moved += *last;
        }
    }

    /// Writes Nᵀ Σρ, over the unknowns.
    pub(super) fn add_forces(&self, system: &System, out: &mut [f64]) {
        system.machine.springs.add_measured(self.first, &self.collected, out);
    }
}
