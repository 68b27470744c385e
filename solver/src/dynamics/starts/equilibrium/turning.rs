//! What a turning body adds to the balance of forces: how it moves in its frame while its deflection stands in space, and
//! the deflection by the centrifugal load, which turns with it.

use crate::error::Error;
use crate::linalg::{GeneralisedEigen, Lu, Matrix, dot, generalised_symmetric_eigen, multiply};
use crate::loads::{Load, TimeFunction};
use crate::machine::Machine;
use crate::shaft::Shaft;

/// Share of M beside Y in the projection of [`quarter_turn`]: it decides what coordinates do that move nothing sideways, and
/// costs lateral ones this share of their rotary inertia.
const REGULARISED: f64 = 1e-3;
/// Share of the body's radius of gyration that is on the axis still: so much of a twist a point there moves sideways, as
/// little as the share of M changes.
const ON_AXIS: f64 = 1e-3;
/// Multiples of n · eps of the stiffest eigenvalue of K below which one is none: rounding of a motion that bends nothing.
const RIGID: f64 = 64.0;

/// Share of the largest value of y0 that is rounding of its other ones.
const ROUNDING: f64 = 1e-13;

/// A body at the start.
pub(super) struct TurningStart<'m> {
    pub(super) shaft: &'m Shaft,
    /// L of η̇_s = θ̇ L η_s: −S of a round body.
    pub(super) quarter_turn: Matrix,
    /// L² of η̈_s = θ̇² L² η_s, of a round body: the inertia of what stands in space is then in balance, too.
    pub(super) half_turn: Option<Matrix>,
    /// M R of the rigid motions R of the body, RᵀMR = 1; one column each.
    rigid: Matrix,
    /// θ̇² (y0 − M R Rᵀ y0) at θ̇ = 1.
    centrifugal: Vec<f64>,
}

impl<'m> TurningStart<'m> {
    /// `speed`: at which it turns, or about that (rad/s).
    pub(super) fn new(shaft: &'m Shaft, speed: f64) -> Result<Self, Error> {
        let n = shaft.size();
        let roundness = shaft.roundness()?;
        if roundness.is_round_at(speed) {
            let s = &roundness.generator;
            return Ok(TurningStart::round(shaft, s, multiply(s.view(), s.view())));
        }
        let (rigid, centrifugal) = if n == 0 {
            (Matrix::zeros(0, 0), Vec::new())
        } else {
            let GeneralisedEigen { values, vectors } =
                generalised_symmetric_eigen(&shaft.stiffness, &shaft.mass)?;
            let bound = RIGID * n as f64 * f64::EPSILON * values[n - 1].abs();
            let count = values.iter().take_while(|value| **value <= bound).count();
            let modes = vectors.columns(0..count);
            let rigid = multiply(shaft.mass.view(), modes);
            let mut load = shaft.y0.clone();
            for (inertia, mode) in (0..count).map(|j| (rigid.col(j), vectors.col(j))) {
                let part = dot(mode, &shaft.y0);
                load.iter_mut().zip(inertia).for_each(|(sum, own)| *sum -= part * own);
            }
            (rigid, load)
        };
        let quarter_turn = quarter_turn(shaft)?;
        Ok(TurningStart { shaft, quarter_turn, half_turn: None, rigid, centrifugal })
    }

    /// Of a round body with the generator S of its turns, and S². Of y0 it has what stands, −(Sᵀ)² y0 being what turns: unbalance, and
    /// a mesh off its axis.
    pub(super) fn round(shaft: &'m Shaft, s: &Matrix, square: Matrix) -> Self {
        let turns = square.apply_transpose(&shaft.y0);
        let reach = shaft.y0.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let stands = shaft.y0.iter().zip(turns).map(|(own, turns)| {
            let sum = own + turns;
            // Rounding of what turns is none of it.
            if sum.abs() <= ROUNDING * reach { 0.0 } else { sum }
        });
        let centrifugal = stands.collect();
        TurningStart {
            shaft,
            quarter_turn: Matrix { data: s.data.iter().map(|own| -own).collect(), ..s.clone() },
            half_turn: Some(square),
            rigid: Matrix::zeros(shaft.size(), 0),
            centrifugal,
        }
    }

    /// η_c at a speed (rad/s) and its derivative by that, both n values:
    /// (K − θ̇² (W − 2 P)) η_c = θ̇² (1 − M R Rᵀ) y0 with P = M R RᵀM.
    ///
    /// The centrifugal load is taken without the force and the couples that it has on the whole body, which are those of
    /// unbalance: they turn, and bearings carry them. So η_c has no rigid motion, and P, which adds to rigid motions alone,
    /// changes nothing of it but makes it unique.
    pub(super) fn centrifugal(&self, speed: f64) -> Result<[Vec<f64>; 2], Error> {
        let n = self.shaft.size();
        if speed == 0.0 || self.centrifugal.iter().all(|load| *load == 0.0) {
            return Ok([vec![0.0; n], vec![0.0; n]]);
        }
        // W − 2 P.
        let mut net = self.shaft.spin_net.clone();
        for column in (0..self.rigid.cols).map(|j| self.rigid.col(j)) {
            for j in 0..n {
                for i in 0..n {
                    net[(i, j)] -= 2.0 * column[i] * column[j];
                }
            }
        }
        let stiffness = &self.shaft.stiffness;
        let matrix = Matrix::from_fn(n, n, |i, j| stiffness[(i, j)] - speed * speed * net[(i, j)]);
        let mut lu = Lu::new(n);
        lu.factor(&matrix.data)?;
        let mut own: Vec<f64> = self.centrifugal.iter().map(|load| speed * speed * load).collect();
        lu.solve_in_place(&mut own);
        let loads = self.centrifugal.iter().zip(net.apply(&own));
        let mut slope: Vec<f64> = loads.map(|(load, net)| 2.0 * speed * (load + net)).collect();
        lu.solve_in_place(&mut slope);
        Ok([own, slope])
    }
}

/// L of η̇ = θ̇ L η, the motion in the frame of a deflection that stands in space: A_θ θ̇ φη + A φη̇ = 0.
///
/// Of a body that is not round there is no such motion; projected on sideways motions it is Y L = H, which is exact where the
/// section at every z moves as a whole; M, by which it may be projected, too, has the rotary inertia of tilts that H has not.
/// Points on the axis at which motion is known count as masses as large as the body, so that tilts of thin discs, of which Y and H
/// have nothing, follow at the journals. A share of M settles coordinates without a sideways motion: they stay where they are in
/// the frame.
fn quarter_turn(shaft: &Shaft) -> Result<Matrix, Error> {
    let n = shaft.size();
    if n == 0 {
        return Ok(Matrix::zeros(0, 0));
    }
    let (y, m) = (&shaft.spin_inertia, &shaft.mass);
    let mut square = Matrix::from_fn(n, n, |i, j| y[(i, j)] + REGULARISED * m[(i, j)]);
    let mut turned = Matrix::from_fn(n, n, |i, j| {
        // A share of M moves as its lateral part does.
        (1.0 + REGULARISED) * shaft.spin_coupling[(i, j)]
    });
    let near = ON_AXIS * size(shaft);
    let on_axis =
        shaft.nodes.iter().filter(|node| node.position[0].hypot(node.position[1]) <= near);
    let largest = (0..n).map(|i| m[(i, i)]).fold(0.0, f64::max);
    for node in on_axis {
        let [row_x, row_y] = [0, 1].map(|axis| node.shapes.row(axis));
        let reach = row_x.iter().chain(&row_y).fold(0.0, |most: f64, own| most.max(own.abs()));
        let mass = if reach > 0.0 { largest / (reach * reach) } else { 0.0 };
        for j in 0..n {
            for i in 0..n {
                square[(i, j)] += mass * (row_x[i] * row_x[j] + row_y[i] * row_y[j]);
                turned[(i, j)] += mass * (row_x[i] * row_y[j] - row_y[i] * row_x[j]);
            }
        }
    }
    let mut lu = Lu::new(n);
    lu.factor(&square.data)?;
    lu.solve_in_place(&mut turned.data);
    Ok(turned)
}

/// Radius of gyration about the axis (m), or how far the nodes are from the origin where the mass is not known.
fn size(shaft: &Shaft) -> f64 {
    let mass = shaft.centre_of_mass.mass;
    if mass > 0.0 {
        return (shaft.j0 / mass).sqrt();
    }
    let all = shaft.nodes.iter().flat_map(|node| node.position);
    all.fold(0.0, |most: f64, own| most.max(own.abs()))
}

/// The speed (rad/s) at which the couples over the speed end that act on the rotation at place `theta` of q: where a motor
/// turns without a load, or where its table ends.
pub(super) fn idle_speed(machine: &Machine, theta: usize) -> Option<f64> {
    let on_it = |load: &&Load| machine.places()[load.body].rotation == Some(theta);
    let idle = machine.loads.iter().filter(on_it).filter_map(|load| match &load.time_function {
        TimeFunction::OverSpeed(curve) => curve.last_fall().or_else(|| curve.driven_end()),
        _ => None,
    });
    largest(idle)
}

/// The largest in size.
pub(super) fn largest(all: impl Iterator<Item = f64>) -> Option<f64> {
    all.reduce(|most, own| if own.abs() > most.abs() { own } else { most })
}
