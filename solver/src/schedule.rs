//! A rotation that is told over time: angle, speed and acceleration at any instant.

use crate::error::Error;

/// θ(t), piece by piece a polynomial. Before the first row and after the last one the speed stays as it is there.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    /// Starts of the pieces (s), ascending; the first one begins long before.
    starts: Vec<f64>,
    /// θ = Σ cₖ τᵏ, τ from the start of the piece.
    coefficients: Vec<[f64; 6]>,
    /// Times at which θ̈ jumps (s), ascending.
    jumps: Vec<f64>,
}

impl Schedule {
    /// Of speeds over time, rows (s, rad/s): linear between the rows, the angle their exact integral from θ = 0 at t = 0.
    ///
    /// # Errors
    /// Fewer than two rows, times that do not rise, values that are no numbers.
    pub fn of_speeds(rows: &[[f64; 2]]) -> Result<Schedule, Error> {
        rising(rows)?;
        let mut angle = 0.0;
        let mut pieces = Vec::with_capacity(rows.len());
        for pair in rows.windows(2) {
            let ([t, speed], [next, to]) = (pair[0], pair[1]);
            let rate = (to - speed) / (next - t);
            pieces.push((t, [angle, speed, 0.5 * rate, 0.0, 0.0, 0.0]));
            angle += 0.5 * (speed + to) * (next - t);
        }
        let [last, speed] = rows[rows.len() - 1];
        pieces.push((last, [angle, speed, 0.0, 0.0, 0.0, 0.0]));
        let mut schedule = Schedule::of_pieces(pieces);
        let [before, ..] = schedule.at(0.0);
        schedule.coefficients.iter_mut().for_each(|own| own[0] -= before);
        let rates = || schedule.coefficients.iter().map(|own| own[2]);
        let jumps = std::iter::once(0.0).chain(rates()).zip(rates()).zip(&schedule.starts);
        // Rows on one line have one slope but for rounding.
        let jump = |a: f64, b: f64| (a - b).abs() > 1e-9 * a.abs().max(b.abs());
        schedule.jumps = jumps.filter(|((a, b), _)| jump(*a, *b)).map(|(_, time)| *time).collect();
        Ok(schedule)
    }

    /// Of a motion that is known at times (s), as rows of time, θ, θ̇ and θ̈: polynomials of fifth degree between them, which
    /// have all three at both ends.
    ///
    /// # Errors
    /// As [`Schedule::of_speeds`].
    pub fn of_motion(rows: &[[f64; 4]]) -> Result<Schedule, Error> {
        rising(rows)?;
        let mut pieces = Vec::with_capacity(rows.len());
        for pair in rows.windows(2) {
            let ([t, q, v, a], [next, ..]) = (pair[0], pair[1]);
            let h = next - t;
            // What is missing at the end of the parabola of the start.
            let dq = pair[1][1] - (q + h * (v + 0.5 * h * a));
            let dv = pair[1][2] - (v + h * a);
            let da = pair[1][3] - a;
            let c3 = (10.0 * dq - 4.0 * h * dv + 0.5 * h * h * da) / h.powi(3);
            let c4 = (-15.0 * dq + 7.0 * h * dv - h * h * da) / h.powi(4);
            let c5 = (6.0 * dq - 3.0 * h * dv + 0.5 * h * h * da) / h.powi(5);
            pieces.push((t, [q, v, 0.5 * a, c3, c4, c5]));
        }
        let [last, q, v, _] = rows[rows.len() - 1];
        // At the last row itself the acceleration is that of the row.
        pieces.push((last + f64::EPSILON * last.abs(), [q, v, 0.0, 0.0, 0.0, 0.0]));
        Ok(Schedule::of_pieces(pieces))
    }

    fn of_pieces(pieces: Vec<(f64, [f64; 6])>) -> Schedule {
        let (starts, coefficients) = pieces.into_iter().unzip();
        Schedule { starts, coefficients, jumps: Vec::new() }
    }

    /// The time (s) from which on the speed stays as it is.
    pub(crate) fn last(&self) -> f64 {
        let turns_evenly = |own: &[f64; 6]| own[2..].iter().all(|value| *value == 0.0);
        let changing = self.coefficients.iter().rposition(|own| !turns_evenly(own));
        let even = changing.map_or(0, |last| last + 1);
        self.starts.get(even).or(self.starts.last()).copied().unwrap_or(0.0)
    }

    /// Times (s) at which the acceleration jumps.
    pub(crate) fn jumps(&self) -> &[f64] {
        &self.jumps
    }

    /// θ (rad), θ̇ (rad/s) and θ̈ (rad/s²) at time t (s).
    pub fn at(&self, t: f64) -> [f64; 3] {
        self.in_piece(self.starts.partition_point(|start| *start <= t), t)
    }

    /// The same, where the acceleration jumps that until t, which a sum of steps may miss by rounding.
    pub(crate) fn until(&self, t: f64) -> [f64; 3] {
        let rounding = 1e-12 * t.abs();
        self.in_piece(self.starts.partition_point(|start| *start < t - rounding), t)
    }

    /// In the piece before the start at place `after`.
    fn in_piece(&self, after: usize, t: f64) -> [f64; 3] {
        let piece = after.saturating_sub(1);
        let tau = t - self.starts[piece];
        let [c0, c1, c2, c3, c4, c5] = self.coefficients[piece];
        if after == 0 {
            return [c0 + c1 * tau, c1, 0.0];
        }
        let angle = c0 + tau * (c1 + tau * (c2 + tau * (c3 + tau * (c4 + tau * c5))));
        let speed = c1 + tau * (2.0 * c2 + tau * (3.0 * c3 + tau * (4.0 * c4 + tau * 5.0 * c5)));
        let rate = 2.0 * c2 + tau * (6.0 * c3 + tau * (12.0 * c4 + tau * 20.0 * c5));
        [angle, speed, rate]
    }
}

fn rising<const N: usize>(rows: &[[f64; N]]) -> Result<(), Error> {
    let wrong = |what: &str| Err(Error::Machine(format!("a rotation over time {what}")));
    if rows.len() < 2 {
        return wrong("has two rows at least");
    }
    if rows.iter().flatten().any(|value| !value.is_finite()) {
        return wrong("has values that are no numbers");
    }
    if rows.windows(2).any(|pair| pair[1][0] <= pair[0][0]) {
        return wrong("has times that rise");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_integrated_exactly_from_zero() {
        let schedule = Schedule::of_speeds(&[[-1.0, 4.0], [1.0, 8.0], [3.0, 2.0]]).expect("rises");
        assert_eq!(schedule.at(0.0), [0.0, 6.0, 2.0]);
        assert_eq!(schedule.at(1.0), [7.0, 8.0, -3.0]);
        assert_eq!(schedule.at(3.0), [17.0, 2.0, 0.0]);
        assert_eq!(schedule.at(5.0), [21.0, 2.0, 0.0]);
        assert_eq!(schedule.at(-2.0), [-9.0, 4.0, 0.0]);
    }

    #[test]
    fn accelerations_jump_at_every_kink_the_first_and_the_last_row_included() {
        let rows = [[-1.0, 4.0], [1.0, 8.0], [2.0, 10.0], [3.0, 2.0]];
        let schedule = Schedule::of_speeds(&rows).expect("rises");
        // The row at 1 s is on the line between its neighbours.
        assert_eq!(schedule.jumps(), [-1.0, 2.0, 3.0]);
        // A table that ends level has no jump at its last row.
        let level = Schedule::of_speeds(&[[0.0, 5.0], [1.0, 7.0], [4.0, 7.0]]).expect("rises");
        assert_eq!(level.jumps(), [0.0, 1.0]);
    }

    #[test]
    fn a_motion_is_met_at_its_rows_and_smooth_between() {
        let exact = |t: f64| [t, t.sin(), t.cos(), -t.sin()];
        let rows: Vec<[f64; 4]> = (0..20).map(|i| exact(0.1 * f64::from(i))).collect();
        let schedule = Schedule::of_motion(&rows).expect("rises");
        for i in 0..190 {
            let t = 0.01 * f64::from(i);
            let [_, q, v, a] = exact(t);
            let found = schedule.at(t);
            let allowed = [1e-9, 1e-8, 1e-6];
            for ((found, exact), allowed) in found.iter().zip([q, v, a]).zip(allowed) {
                assert!((found - exact).abs() < allowed, "{t}: {found} for {exact}");
            }
        }
        for [t, q, v, a] in rows {
            let found = schedule.at(t);
            assert!((found[0] - q).abs() + (found[1] - v).abs() + (found[2] - a).abs() < 1e-11);
        }
    }

    #[test]
    fn times_that_do_not_rise_are_refused() {
        assert!(Schedule::of_speeds(&[[0.0, 1.0]]).is_err());
        assert!(Schedule::of_speeds(&[[0.0, 1.0], [0.0, 2.0]]).is_err());
        assert!(Schedule::of_motion(&[[0.0; 4], [1.0, f64::NAN, 0.0, 0.0]]).is_err());
    }
}
