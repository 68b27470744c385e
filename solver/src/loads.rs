//! External loads on a body: fixed in space, or turning with it.
//!
//! A force F fixed in space at a node with body-frame displacement u and initial position x0 gives
//! Q_η = φᵀAᵀF and Q_θ = (A_θ(x0+u))·F, eq. (26); one fixed to the shaft gives Q_η = φᵀF and
//! Q_θ = (x0+u) × F.

use crate::bodies::BodyPlace;
use crate::body::BodyNode;

/// A force on a node of a body, constant in direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// The body, by its place in the machine.
    pub body: usize,
    /// The node.
    pub node: BodyNode,
    /// Amplitude (N) along x, y, z.
    pub force: [f64; 3],
    /// How it varies.
    pub time_function: TimeFunction,
    /// In which frame its direction is constant.
    pub frame: Frame,
}

/// How a load varies in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeFunction {
    /// Constant from t = 0.
    Constant,
    /// sin(2π f t + φ).
    Sine {
        /// f (Hz).
        frequency: f64,
        /// φ (rad).
        phase: f64,
    },
    /// Constant until a step starts with θ̇ at the target or beyond it, as seen from rest; zero from then on.
    UntilSpeed {
        /// Target of θ̇ (rad/s); negative where the shaft is driven that way.
        target: f64,
    },
}

/// In which frame the direction of a load is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Frame {
    /// The fixed frame.
    Space,
    /// The frame that turns with the body.
    Body,
}

impl Load {
    /// The factor on the amplitude at time `t` (s); `released` once the target speed was reached.
    pub(crate) fn factor(&self, t: f64, released: bool) -> f64 {
        match self.time_function {
            TimeFunction::Constant => 1.0,
            TimeFunction::Sine { frequency, phase } => {
                (std::f64::consts::TAU * frequency * t + phase).sin()
            }
            TimeFunction::UntilSpeed { .. } => f64::from(!released),
        }
    }

    /// Whether a step that starts with θ̇ = `speed` (rad/s) finds the load's target reached.
    pub(crate) fn reaches(&self, speed: f64) -> bool {
        match self.time_function {
            TimeFunction::UntilSpeed { target } => speed * target.signum() >= target.abs(),
            TimeFunction::Constant | TimeFunction::Sine { .. } => false,
        }
    }

    /// |F| times how far a unit of a coordinate moves the node: what the load could do there, whatever its
    /// direction. `coordinate`: that of the body; none for its rotation.
    pub(crate) fn projected(&self, factor: f64, eta: &[f64], coordinate: Option<usize>) -> f64 {
        let reach = match coordinate {
            None => {
                let [x, y] = self.place(eta);
                x.hypot(y)
            }
            Some(j) => self.node.shapes.col(j).iter().map(|x| x * x).sum::<f64>().sqrt(),
        };
        let force = self.force.iter().map(|x| x * x).sum::<f64>().sqrt();
        (factor * force).abs() * reach
    }

    /// Adds the generalised force at `factor` times the amplitude to those on q; the coordinates of the body stand at
    /// `place`.
    pub(crate) fn add_force(
        &self,
        factor: f64,
        position: &Position,
        q: &[f64],
        place: &BodyPlace,
        out: &mut [f64],
    ) {
        if factor == 0.0 {
            return;
        }
        let [fx, fy, fz] = self.body_force(factor, position);
        if let Some(theta) = place.rotation {
            let [x, y] = self.place(&q[place.flexible.clone()]);
            // (A_θ(x0+u))·F is the moment of F about the axis, in whichever frame both are written.
            out[theta] += x * fy - y * fx;
        }
        for (j, value) in out[place.flexible.clone()].iter_mut().enumerate() {
            let shape = self.node.shapes.col(j);
            *value += shape[0] * fx + shape[1] * fy + shape[2] * fz;
        }
    }

    /// Subtracts ∂(generalised force)/∂q from a matrix of as many rows as q has, column after column.
    pub(crate) fn subtract_tangent(
        &self,
        factor: f64,
        position: &Position,
        q: &[f64],
        place: &BodyPlace,
        matrix: &mut [f64],
    ) {
        let Some(theta) = place.rotation.filter(|_| factor != 0.0) else { return };
        let ([fx, fy, _], rows) = (self.body_force(factor, position), q.len());
        let in_space = self.frame == Frame::Space;
        if in_space {
            let [x, y] = self.place(&q[place.flexible.clone()]);
            // ∂²A/∂θ² = −A in the plane: ∂Q_θ/∂θ = −(x0+u)·AᵀF.
            matrix[theta * (rows + 1)] += x * fx + y * fy;
        }
        for (j, column) in place.flexible.clone().enumerate() {
            let shape = self.node.shapes.col(j);
            let turned = shape[0] * fy - shape[1] * fx;
            matrix[column * rows + theta] -= turned;
            if in_space {
                // ∂(AᵀF)/∂θ = (fy, −fx) in the frame of the body.
                matrix[theta * rows + column] -= turned;
            }
        }
    }

    /// The force in the frame of the body.
    fn body_force(&self, factor: f64, position: &Position) -> [f64; 3] {
        let [x, y, z] = self.force.map(|part| factor * part);
        match self.frame {
            Frame::Body => [x, y, z],
            Frame::Space => {
                [position.cos * x + position.sin * y, -position.sin * x + position.cos * y, z]
            }
        }
    }

    /// x0 + u in the plane, in the frame of the body.
    fn place(&self, eta: &[f64]) -> [f64; 2] {
        [0, 1].map(|axis| {
            let moved: f64 =
                eta.iter().enumerate().map(|(j, value)| self.node.shapes[(axis, j)] * value).sum();
            self.node.position[axis] + moved
        })
    }
}

/// sin θ and cos θ.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Position {
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Position {
    pub(crate) fn new(theta: f64) -> Self {
        let (sin, cos) = theta.sin_cos();
        Position { sin, cos }
    }

    /// A(θ)·(x, y): from the frame of the body to the fixed frame.
    pub(crate) fn to_space(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }
}
