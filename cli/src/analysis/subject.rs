//! What analyses are of, and which one does what.

use std::f64::consts::TAU;

use whirl_solver::cache::Cache;
use whirl_solver::linear::LinearMachine;
use whirl_text::rounded;

use super::found::Found;
use super::space::{Pictures, Space};
use super::{
    campbell, coefficients, forces, lateral, map, matrices, modes, periodic, response, speeds,
    stability, torsion,
};
use crate::case::{Analysis, AnalysisKind, Case, CaseText};
use crate::errors::Failure;
use crate::signals::Interruption;

/// A case with all that its analyses take.
pub(crate) struct Subject<'a> {
    pub(crate) case: &'a Case,
    /// Its text, for the variants of a lateral analysis, of which there are none without it, and for periodic motions over a key.
    pub(crate) text: Option<&'a CaseText>,
    /// Its machine, for all that have no machine of their own.
    pub(crate) linear: Option<&'a LinearMachine>,
    pub(crate) cache: Option<&'a Cache>,
    pub(crate) interruption: &'a Interruption,
    /// Whether figures are wanted.
    pub(crate) figures: bool,
    /// The machine in space, if its motions are wanted there.
    pub(crate) space: Option<&'a Space<'a>>,
}

impl Subject<'_> {
    /// Whether an analysis builds a machine of its own, with what it looks at.
    pub(crate) fn is_alone(kind: AnalysisKind) -> bool {
        matches!(kind, AnalysisKind::Lateral | AnalysisKind::Forces | AnalysisKind::Periodic)
    }

    /// Whether an analysis reads the case again, with other values.
    pub(crate) fn needs_text(analysis: &Analysis) -> bool {
        analysis.kind == AnalysisKind::Lateral || analysis.periodic.vary.is_some()
    }

    /// The body whose speed an analysis is over, if that is told by one.
    pub(crate) fn speed_of(&self, analysis: &Analysis) -> Option<String> {
        let linear = self.linear?;
        let of = speeds::wanted(self.case, linear, analysis).ok()?.of?;
        Some(linear.machine().bodies[of].name().to_owned())
    }

    /// Speeds (rpm) between which the run of the case takes the body whose speed an analysis is over: one where that is constant, none
    /// where the case has no run or does not tell.
    pub(crate) fn run_speeds(&self, analysis: &Analysis) -> Vec<f64> {
        let Some(linear) = self.linear.filter(|_| self.case.march.is_some()) else {
            return Vec::new();
        };
        let of = speeds::wanted(self.case, linear, analysis).ok().and_then(|own| own.of);
        let machine = &self.case.machine;
        let mut turning = machine.bodies.iter().enumerate().filter(|own| own.1.turns());
        let only = turning.next().filter(|_| turning.next().is_none()).map(|own| own.0);
        let speeds = of.or(only).map(|of| machine.speeds_in(of, self.case.run()));
        let mut ends = speeds.unwrap_or_default();
        ends.iter_mut().for_each(|own| *own = rounded(own.abs() * 60.0 / TAU, 7));
        ends.dedup();
        ends
    }

    /// What an analysis comes to; `warnings` are added to.
    ///
    /// # Errors
    /// As of the analysis; that it was interrupted before anything was done.
    pub(crate) fn found(
        &self,
        analysis: &Analysis,
        warnings: &mut Vec<String>,
    ) -> Result<Found, Failure> {
        let Subject { case, text, cache, interruption, figures, .. } = *self;
        match analysis.kind {
            AnalysisKind::Forces => {
                forces::found(case, analysis, (cache, warnings), interruption, figures)
            }
            AnalysisKind::Lateral => {
                lateral::found((case, text), analysis, (cache, warnings), interruption, figures)
            }
            AnalysisKind::Periodic => {
                periodic::found((case, text), analysis, (cache, warnings), interruption, figures)
            }
            _ => self.of_machine(self.linear.expect("it was built"), analysis),
        }
    }

    fn of_machine(&self, linear: &LinearMachine, analysis: &Analysis) -> Result<Found, Failure> {
        let Subject { case, cache, interruption, figures, space, .. } = *self;
        let pictures = Pictures { figures, cache, space };
        let wanted = speeds::wanted(case, linear, analysis)?;
        let wanted = (analysis, &wanted);
        match analysis.kind {
            AnalysisKind::Modes => modes::found(case, linear, wanted, interruption, pictures),
            AnalysisKind::Campbell => campbell::found(case, linear, wanted, interruption, pictures),
            AnalysisKind::Response => response::found(case, linear, wanted, interruption, pictures),
            AnalysisKind::Coefficients => {
                coefficients::found(case, linear, wanted, interruption, figures)
            }
            AnalysisKind::Stability => {
                stability::found(case, linear, wanted, interruption, figures)
            }
            AnalysisKind::Map => map::found(case, linear, wanted, interruption, figures),
            AnalysisKind::Matrices => matrices::found(case, linear, wanted, interruption),
            AnalysisKind::Torsion => {
                let (train, released) = torsion::released((case, linear), wanted.1.of, cache)?;
                torsion::found((case, linear), &train, wanted, &released, interruption, figures)
            }
            AnalysisKind::Forces | AnalysisKind::Lateral | AnalysisKind::Periodic => {
                unreachable!("they have machines of their own")
            }
        }
    }
}
