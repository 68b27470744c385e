//! The ways of the journals in their bores over the last revolutions.

use std::f64::consts::TAU;

use serde::Serialize;

use super::about::Journal;
use super::encode::Packed;

/// Revolutions that are kept, and points of an orbit at most.
pub(super) const REVOLUTIONS: f64 = 8.0;
const POINTS: usize = 4000;
/// Points of its way over the whole run, at most.
const WAY: usize = 1500;

/// An orbit as a page has it.
#[derive(Debug, Serialize)]
pub(super) struct Orbit {
    title: String,
    /// What moves.
    moved: String,
    columns: [String; 2],
    clearance_um: f64,
    /// Rows of a point.
    every: usize,
    /// Revolutions that the points span; 0 where it does not turn.
    revolutions: f64,
    /// How the body turns: 1, −1 or 0.
    sense: f64,
    /// µm in space, in the order of time.
    x_um: Packed,
    y_um: Packed,
    /// Force on the journal (N), likewise.
    fx_n: Packed,
    fy_n: Packed,
    /// Revolutions before the end.
    before: Packed,
    /// µm in space over the whole run, in the order of time.
    way_x_um: Packed,
    way_y_um: Packed,
    /// Points at which the keyphasor is seen, θ a multiple of 360°: x, y, and revolutions before the end.
    keyphasors: Vec<[f64; 3]>,
}

impl Orbit {
    /// Of x, y, the force along both and, if something turns, the angle of rows up to the end; of what does not turn the
    /// last `rows`.
    pub(super) fn of(
        journal: &Journal,
        [x, y, fx, fy]: [&[f64]; 4],
        angle: Option<&[f64]>,
        rows: usize,
    ) -> Self {
        let count = x.len();
        let last = angle.and_then(|own| own.last().copied()).unwrap_or(0.0);
        let before = |k: usize| angle.map_or(0.0, |own| (last - own[k]).abs() / TAU);
        let turned = before(0);
        let turns = turned > 0.5;
        let from = match turns {
            // A row that is a rounding error too early belongs to it.
            true => (0..count).find(|k| before(*k) <= REVOLUTIONS * (1.0 + 1e-9)).unwrap_or(0),
            false => count.saturating_sub(rows),
        };
        let every = (count - from).div_ceil(POINTS).max(1);
        // The last row is one of them.
        let places: Vec<usize> =
            (from..count).rev().step_by(every).collect::<Vec<usize>>().into_iter().rev().collect();
        let sense = match turns {
            true => (last - angle.map_or(0.0, |own| own[from])).signum(),
            false => 0.0,
        };
        let keyphasors = angle.filter(|_| turns).map_or_else(Vec::new, |angle| {
            let seen = (from + 1..count).filter_map(|k| {
                let part = passage(sense * angle[k - 1], sense * angle[k])?;
                let mix = |all: &[f64]| all[k - 1] + part * (all[k] - all[k - 1]);
                let turned = (last - mix(angle)).abs() / TAU;
                Some([mix(x), mix(y), turned].map(|own| whirl_text::rounded(own, 9)))
            });
            seen.collect()
        });
        let pick = |all: &[f64]| Packed::single(places.iter().map(|k| all[*k]));
        Orbit {
            title: journal.title.clone(),
            moved: journal.moved.clone(),
            columns: journal.columns.clone(),
            clearance_um: journal.clearance_um,
            every,
            revolutions: if turns { before(from) } else { 0.0 },
            sense,
            x_um: pick(x),
            y_um: pick(y),
            fx_n: pick(fx),
            fy_n: pick(fy),
            before: Packed::single(places.iter().map(|k| if turns { before(*k) } else { 0.0 })),
            way_x_um: Packed::single([]),
            way_y_um: Packed::single([]),
            keyphasors,
        }
    }

    /// With its way over the whole run.
    pub(super) fn with(self, way: &[[f64; 2]]) -> Self {
        let [way_x_um, way_y_um] =
            [0, 1].map(|axis| Packed::single(way.iter().map(|own| own[axis])));
        Orbit { way_x_um, way_y_um, ..self }
    }
}

/// The ways of all journals over the whole run, of every few rows one.
pub(super) struct Ways {
    every: usize,
    rows: usize,
    ways: Vec<Vec<[f64; 2]>>,
}

impl Ways {
    /// For about so many rows.
    pub(super) fn new(journals: usize, rows: usize) -> Self {
        Ways { every: rows.div_ceil(WAY).max(1), rows: 0, ways: vec![Vec::new(); journals] }
    }

    /// Adds a row.
    pub(super) fn add(&mut self, row: impl Iterator<Item = [f64; 2]>) {
        if self.rows.is_multiple_of(self.every) {
            self.ways.iter_mut().zip(row).for_each(|(way, own)| way.push(own));
        }
        self.rows += 1;
    }

    /// Of each journal.
    pub(super) fn finish(self) -> Vec<Vec<[f64; 2]>> {
        self.ways
    }
}

/// The part of a step after which a rising angle passes a whole revolution, if it does.
fn passage(before: f64, after: f64) -> Option<f64> {
    let (before, after) = (before / TAU, after / TAU);
    let whole = after.floor();
    (before < whole && after > before).then(|| (whole - before) / (after - before))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn journal() -> Journal {
        Journal {
            moved: "the journal".into(),
            title: "left".into(),
            columns: ["EX_left_um".into(), "EY_left_um".into()],
            forces: ["RX_left_N".into(), "RY_left_N".into()],
            clearance_um: 50.0,
            angle: Some("theta_rad".into()),
        }
    }

    /// Twenty revolutions of a circle, of which eight are kept, and the keyphasor is where cos θ = 1.
    #[test]
    fn the_last_revolutions_are_kept_with_their_keyphasors() {
        for sense in [1.0, -1.0] {
            let angle: Vec<f64> = (0..=2003).map(|k| sense * TAU * f64::from(k) / 100.0).collect();
            let x: Vec<f64> = angle.iter().map(|own| 20.0 * own.cos()).collect();
            let y: Vec<f64> = angle.iter().map(|own| 20.0 * own.sin()).collect();
            let own = Orbit::of(&journal(), [&x, &y, &y, &x], Some(&angle), 100);
            assert!((own.revolutions - 8.0).abs() < 1e-9 && own.sense == sense);
            assert_eq!((own.every, own.keyphasors.len()), (1, 8));
            for (k, [x, y, before]) in own.keyphasors.iter().enumerate() {
                assert!((x - 20.0).abs() < 1e-5 && y.abs() < 1e-5, "{x} {y}");
                assert!((before - (7.03 - k as f64)).abs() < 1e-6, "{before}");
            }
            let still = Orbit::of(&journal(), [&x, &y, &y, &x], None, 100);
            assert_eq!((still.revolutions, still.keyphasors.len()), (0.0, 0));
            assert_eq!((&still.fx_n, &still.fy_n), (&still.y_um, &still.x_um));
            assert_eq!(still.x_um, Packed::single(x[1904..].iter().copied()));
        }
    }
}
