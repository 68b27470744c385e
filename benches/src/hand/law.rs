//! The two laws of the reference system, written by hand: one pass over the springs without a branch.

use whirl_specs::{Law, Origin, Variable};

const H: Variable = Variable { name: "h", unit: "m", title: "clearance at the spring" };
const Q: Variable = Variable { name: "Q", unit: "N", title: "normal force of one spring" };

const fn law(name: &'static str, source: &'static str, evaluate: whirl_specs::LawKernel) -> Law {
    let title = "Springs for the oil film of a journal bearing, by hand";
    let origin = Origin { name, title, source, spec: "", text: "", hash: "" };
    Law { origin, inputs: &[H], outputs: &[Q], evaluate }
}

/// Q = 233 − 6517 h (N, mm) up to its root, eq. (51).
pub static LINEAR: Law = law("hu2003-linear", "eq. (51)", linear);

/// Q = 388 − 18632 h + 217550 h² (N, mm) up to its lower root, eq. (52).
pub static NONLINEAR: Law = law("hu2003-nonlinear", "eq. (52)", nonlinear);

fn rows<'a>(springs: usize, h: &'a [f64], out: &'a mut [f64]) -> Rows<'a> {
    let (q, slope) = out[..2 * springs].split_at_mut(springs);
    Rows { h: &h[..springs], q, slope }
}

struct Rows<'a> {
    h: &'a [f64],
    q: &'a mut [f64],
    slope: &'a mut [f64],
}

fn linear(springs: usize, h: &[f64], out: &mut [f64]) {
    const SLOPE: f64 = 6517e3;
    const ROOT: f64 = 233.0 / SLOPE;
    let Rows { h, q, slope } = rows(springs, h, out);
    for ((&h, q), slope) in h.iter().zip(q).zip(slope) {
        let acts = h <= ROOT;
        *q = if acts { 233.0 - SLOPE * h } else { 0.0 };
        *slope = if acts { -SLOPE } else { 0.0 };
    }
}

fn nonlinear(springs: usize, h: &[f64], out: &mut [f64]) {
    const A: f64 = 388.0;
    const B: f64 = -18632e3;
    const C: f64 = 217550e6;
    // The lower root, in the form without cancellation.
    let root = 2.0 * A / (-B + (B * B - 4.0 * A * C).sqrt());
    let Rows { h, q, slope } = rows(springs, h, out);
    for ((&h, q), slope) in h.iter().zip(q).zip(slope) {
        let acts = h <= root;
        *q = if acts { A + h * (B + h * C) } else { 0.0 };
        *slope = if acts { B + 2.0 * C * h } else { 0.0 };
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
