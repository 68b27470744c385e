//! Stiffness and damping of bearings with bodies of their own, as their shafts feel them.

use std::fmt::Write;

use whirl_solver::linear::{LinearMachine, Standstill, Through};

use super::facts::COEFFICIENTS;
use super::orders::Orders;
use super::words;
use crate::case::Analysis;
use crate::errors::Failure;
use crate::report::table;

/// Rows of all speeds so far.
pub(super) struct Felt<'a> {
    /// The body whose speed it is.
    of: Option<usize>,
    analysis: &'a Analysis,
    rows: Vec<Vec<String>>,
    file: String,
    /// Those of the last speed.
    last: Vec<(f64, Through)>,
}

impl<'a> Felt<'a> {
    /// None yet.
    pub(super) fn new(of: Option<usize>, analysis: &'a Analysis) -> Self {
        let head = ["bearing", "speed (rpm)", "order"];
        let head = head.iter().chain(&words::OF_PLANE).map(|own| (*own).to_owned()).collect();
        let columns = COEFFICIENTS.join(",");
        let file = format!("speed_rpm,bearing,shaft,bodies,order,frequency_hz,{columns}\n");
        Felt { of, analysis, rows: vec![head], file, last: Vec::new() }
    }

    /// Adds those of a speed (rad/s).
    ///
    /// # Errors
    /// Of linear algebra.
    pub(super) fn add(
        &mut self,
        linear: &LinearMachine,
        speed: f64,
        at: &Standstill,
    ) -> Result<(), Failure> {
        self.last.clear();
        let Some(of) = self.of.filter(|_| speed != 0.0) else { return Ok(()) };
        let ratios = &self.analysis.ratios;
        let both =
            linear.speeds(of, speed, ratios).into_iter().zip(linear.turns_in_one(of, ratios));
        let given = both.enumerate().filter(|(_, own)| own.0.is_some() || own.1.is_some());
        let shafts: Vec<usize> = given.map(|own| own.0).collect();
        let equations = linear.linearised(at)?;
        let orders = if self.analysis.orders.is_empty() { &[1.0] } else { &*self.analysis.orders };
        for &order in orders {
            let frequency = order * speed.abs();
            for own in linear.through((at, &equations), &shafts, frequency)? {
                self.write(speed, order, &own);
                self.last.push((order, own));
            }
        }
        Ok(())
    }

    fn write(&mut self, speed: f64, order: f64, own: &Through) {
        let [k, c] = [own.stiffness, own.damping];
        let values = [k, c].into_iter().flatten().flatten();
        let values: Vec<f64> = values.collect();
        let numbers: Vec<String> = values.iter().map(f64::to_string).collect();
        let (bearing, bodies) = (own.joints.join("+"), own.bodies.join(" "));
        let hertz = order * speed.abs() / std::f64::consts::TAU;
        writeln!(
            self.file,
            "{},{bearing},{},{bodies},{order},{hertz},{}",
            words::rpm(speed),
            own.shaft,
            numbers.join(",")
        )
        .expect("text can be written");
        let mut cells = vec![bearing, words::speed(speed), Orders::rounded(order).to_string()];
        cells.extend(values.iter().map(|value| format!("{value:.4e}")));
        self.rows.push(cells);
    }

    /// Bearings of the last speed by order.
    pub(super) fn last(&self) -> &[(f64, Through)] {
        &self.last
    }

    /// A table for people and a file, if there is such a bearing.
    pub(super) fn told(self) -> Option<(String, String)> {
        (self.rows.len() > 1).then(|| {
            let words = "as seen by the shaft, while pads, rings and other bodies between move at the order of the speed";
            (format!("\n{words}\n\n{}", table(&self.rows)), self.file)
        })
    }
}
