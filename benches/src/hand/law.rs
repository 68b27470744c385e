//! The two laws of the reference system, written by hand: one pass over the springs without a branch, as many
//! side by side as a register holds.

use std::marker::PhantomData;

use whirl_specs::registers::{Register, Registers, Task};
use whirl_specs::{Lane, Law, Origin, Variable};

const H: Variable = Variable { name: "h", unit: "m", title: "clearance at the spring" };
const Q: Variable = Variable { name: "Q", unit: "N", title: "normal force of one spring" };

const fn law(
    name: &'static str,
    source: &'static str,
    [evaluate, forces]: [whirl_specs::LawKernel; 2],
) -> Law {
    let title = "Springs for the oil film of a journal bearing, by hand";
    let origin = Origin { name, title, source, spec: "", text: "", hash: "" };
    Law {
        origin,
        inputs: &[H],
        outputs: &[Q],
        states: &[],
        evaluate,
        forces: Some(forces),
        skeleton: None,
        forces_skeleton: None,
        stored: None,
        valid: &[],
        measure: |_, _, _| {},
    }
}

/// Q = 233 − 6517 h (N, mm) up to its root, eq. (51).
pub static LINEAR: Law = law("hu2003-linear", "eq. (51)", [evaluate::<Linear>, forces::<Linear>]);

/// Q = 388 − 18632 h + 217550 h² (N, mm) up to its lower root, eq. (52).
pub static NONLINEAR: Law =
    law("hu2003-nonlinear", "eq. (52)", [evaluate::<Nonlinear>, forces::<Nonlinear>]);

/// What a law computes for a lane of springs: Q and ∂Q/∂h.
trait Spring {
    fn spring<L: Lane>(h: L) -> [L; 2];
}

struct Rows<'a, S> {
    h: &'a [f64],
    q: &'a mut [f64],
    slope: &'a mut [f64],
    spring: PhantomData<S>,
}

impl<S: Spring> Task for Rows<'_, S> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let whole = self.h.len() - self.h.len() % L::WIDTH;
        each::<S, L>(&self.h[..whole], &mut self.q[..whole], &mut self.slope[..whole]);
        each::<S, f64>(&self.h[whole..], &mut self.q[whole..], &mut self.slope[whole..]);
    }
}

#[inline(always)]
fn each<S: Spring, L: Register>(h: &[f64], q: &mut [f64], slope: &mut [f64]) {
    let rows = L::chunks(h).iter().zip(L::chunks_mut(q)).zip(L::chunks_mut(slope));
    for ((h, q), slope) in rows {
        let [force, derivative] = S::spring(L::load(h));
        force.store(q);
        derivative.store(slope);
    }
}

fn evaluate<S: Spring>(springs: usize, h: &[f64], out: &mut [f64]) {
    let (q, slope) = out[..2 * springs].split_at_mut(springs);
    Registers::current().run(Rows { h: &h[..springs], q, slope, spring: PhantomData::<S> });
}

fn forces<S: Spring>(springs: usize, h: &[f64], out: &mut [f64]) {
    for (h, q) in h[..springs].iter().zip(out) {
        [*q, _] = S::spring(*h);
    }
}

enum Linear {}

impl Spring for Linear {
    #[inline(always)]
    fn spring<L: Lane>(h: L) -> [L; 2] {
        const SLOPE: f64 = 6517e3;
        const ROOT: f64 = 233.0 / SLOPE;
        let acts = L::le(h, L::splat(ROOT));
        let zero = L::splat(0.0);
        [
            L::select(acts, L::splat(233.0) - h * SLOPE, zero),
            L::select(acts, L::splat(-SLOPE), zero),
        ]
    }
}

enum Nonlinear {}

impl Spring for Nonlinear {
    #[inline(always)]
    fn spring<L: Lane>(h: L) -> [L; 2] {
        const A: f64 = 388.0;
        const B: f64 = -18632e3;
        const C: f64 = 217550e6;
        // The lower root, in the form without cancellation: 2A/(−B + √(B² − 4AC)).
        const ROOT: f64 = 3.573_328_261_276_135e-5;
        let acts = L::le(h, L::splat(ROOT));
        let zero = L::splat(0.0);
        let part = h * C;
        [L::select(acts, (part + B) * h + A, zero), L::select(acts, part + part + B, zero)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn springs_at_rest_carry_what_the_roots_leave() {
        for (law, rest, root) in [(&LINEAR, 0.428, 0.035_752_65), (&NONLINEAR, 0.143, 0.035_733_28)]
        {
            let h = [0.035687e-3, root * 1e-3 - 1e-10, root * 1e-3 + 1e-10];
            let mut out = [0.0; 6];
            (law.evaluate)(3, &h, &mut out);
            assert!((out[0] - rest).abs() < 1e-3, "{}", out[0]);
            assert!(out[1] > 0.0 && out[2] == 0.0 && out[5] == 0.0);
        }
    }
}
