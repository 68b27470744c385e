//! External loads on a body, forces and couples: fixed in space, or turning with it.
//!
//! A force F fixed in space at a node with body-frame displacement u and initial position x0 gives
//! Q_η = φᵀAᵀF and Q_θ = (A_θ(x0+u))·F, eq. (26); one fixed to the shaft gives Q_η = φᵀF and
//! Q_θ = (x0+u) × F. A couple M on a section that turns by Ψη against its frame gives Q_η = ΨᵀAᵀM, or ΨᵀM, and Q_θ = M_z:
//! turns are small, so that θ turns every section about z of space.

pub use crate::time_function::{Onset, Release, Target, TimeFunction};

use crate::bodies::BodyPlace;
use crate::body::BodyNode;
use crate::linalg::{Matrix, widely};
use crate::time_function::{Instant, Slope};

/// A force on a node of a body, or a couple on a turn of it, constant in direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Its name; empty, if it has none.
    pub name: String,
    /// The body, by its place in the machine.
    pub body: usize,
    /// What acts, and where.
    pub action: Action,
    /// How it varies.
    pub time_function: TimeFunction,
    /// From when on it acts.
    pub onset: Onset,
    /// In which frame its direction is constant.
    pub frame: Frame,
}

/// What a load does.
#[derive(Debug, Clone, PartialEq)]
pub enum Action {
    /// A force on a point of the body.
    Force {
        /// Where it acts.
        node: BodyNode,
        /// Amplitude (N) along x, y, z.
        force: [f64; 3],
    },
    /// A couple.
    Couple {
        /// Turns about x, y, z (rad), against the frame of the body, by a unit of each coordinate: 3 × n.
        turn: Matrix,
        /// Amplitude (N·m) about x, y, z.
        couple: [f64; 3],
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

impl Action {
    /// Amplitude along x, y, z (N, N·m).
    pub fn amplitude(&self) -> [f64; 3] {
        match self {
            Action::Force { force, .. } => *force,
            Action::Couple { couple, .. } => *couple,
        }
    }

    /// How far a unit of each coordinate moves or turns what the load acts on.
    fn shapes(&self) -> &Matrix {
        match self {
            Action::Force { node, .. } => &node.shapes,
            Action::Couple { turn, .. } => turn,
        }
    }
}

impl Load {
    /// A force on a node, from t = 0.
    pub fn force(
        body: usize,
        node: BodyNode,
        force: [f64; 3],
        time_function: TimeFunction,
        frame: Frame,
    ) -> Load {
        Load::new(body, Action::Force { node, force }, time_function, frame)
    }

    /// A couple on a turn, from t = 0.
    pub fn couple(
        body: usize,
        turn: Matrix,
        couple: [f64; 3],
        time_function: TimeFunction,
        frame: Frame,
    ) -> Load {
        Load::new(body, Action::Couple { turn, couple }, time_function, frame)
    }

    fn new(body: usize, action: Action, time_function: TimeFunction, frame: Frame) -> Load {
        Load { name: String::new(), body, action, time_function, onset: Onset::Start, frame }
    }

    /// The load under a name.
    pub fn named(self, name: &str) -> Load {
        Load { name: name.to_owned(), ..self }
    }

    /// The load from another time on.
    pub fn from(self, onset: Onset) -> Load {
        Load { onset, ..self }
    }

    /// The factor on the amplitude; `released` once the target speed was reached.
    pub(crate) fn factor(&self, at: &Instant, released: bool) -> f64 {
        let factor = self.time_function.factor(at, || self.speed(at), released);
        match self.onset {
            Onset::Start => factor,
            onset => onset.factor(at) * factor,
        }
    }

    /// The speed of that on which it acts (rad/s): θ̇ + Ψ_z η̇ of a couple, so that what it takes of a section's turns is what it works on.
    fn speed(&self, at: &Instant) -> f64 {
        let own = &at.places[self.body];
        let theta = own.rotation.map_or(0.0, |theta| at.v[theta]);
        let Action::Couple { turn, .. } = &self.action else { return theta };
        let about_z = turn.data.as_chunks::<3>().0.iter().map(|turn| turn[2]);
        theta
            + about_z.zip(&at.v[own.flexible.clone()]).map(|(turn, rate)| turn * rate).sum::<f64>()
    }

    /// Whether its direction turns with its body: one fixed to that, but for a couple about the axis.
    pub(crate) fn turns_with_its_body(&self) -> bool {
        let along =
            matches!(self.action, Action::Couple { couple: [x, y, _], .. } if x == 0.0 && y == 0.0);
        self.frame == Frame::Body && !along
    }

    /// Speed at which the load ends, and how.
    pub fn target(&self) -> Option<Target> {
        match self.time_function {
            TimeFunction::UntilSpeed(target) => Some(target),
            _ => None,
        }
    }

    /// Whether θ̇ = `speed` (rad/s) is at the load's target or beyond it.
    pub fn reaches(&self, speed: f64) -> bool {
        self.target().is_some_and(|Target { speed: target, from_above, .. }| match from_above {
            true => speed <= target,
            false => speed >= target,
        })
    }

    /// |F| times how far a unit of a coordinate moves the node, or |M| times how far it turns: what the load could do there at
    /// `factor` times the amplitude, whatever its direction. `coordinate`: that of the body; none for its rotation.
    pub(crate) fn projected(
        &self,
        (amplitude, factor): (&[f64; 3], f64),
        eta: &[f64],
        coordinate: Option<usize>,
    ) -> f64 {
        let reach = match coordinate {
            None => match &self.action {
                Action::Force { node, .. } => {
                    let [x, y] = place(node, eta);
                    x.hypot(y)
                }
                Action::Couple { .. } => 1.0,
            },
            Some(j) => self.action.shapes().col(j).iter().map(|x| x * x).sum::<f64>().sqrt(),
        };
        let force = amplitude.iter().map(|x| x * x).sum::<f64>().sqrt();
        (factor * force).abs() * reach
    }

    /// By how much the factor would change if the angle or the speed that it follows were none, to the first order: rounding of
    /// what it follows leaves it unknown by ε times that.
    pub(crate) fn followed(&self, at: &Instant) -> f64 {
        let followed = match self.time_function.slope(at, || self.speed(at)) {
            Some(Slope::Angle(place, by)) => by * at.q[place],
            Some(Slope::Speed(by)) => by * self.speed(at),
            None => 0.0,
        };
        self.onset.factor(at) * followed
    }

    /// Adds the generalised force at `factor` times the amplitude to those on q; the coordinates of the body stand at
    /// `own`.
    pub(crate) fn add_force(
        &self,
        (amplitude, factor): (&[f64; 3], f64),
        position: &Position,
        q: &[f64],
        own: &BodyPlace,
        out: &mut [f64],
    ) {
        if factor == 0.0 {
            return;
        }
        let [fx, fy, fz] = self.in_body((amplitude, factor), position);
        if let Some(theta) = own.rotation {
            out[theta] += match &self.action {
                // (A_θ(x0+u))·F is the moment of F about the axis, in whichever frame both are written.
                Action::Force { node, .. } => {
                    let [x, y] = place(node, &q[own.flexible.clone()]);
                    x * fy - y * fx
                }
                // θ turns every section about z of space.
                Action::Couple { .. } => fz,
            };
        }
        let shapes = self.action.shapes().data.as_chunks::<3>().0;
        let values = out[own.flexible.clone()].iter_mut().zip(shapes);
        widely(|| {
            values.for_each(|(value, shape)| {
                *value += shape[0] * fx + shape[1] * fy + shape[2] * fz;
            });
        });
    }

    /// Subtracts ∂(generalised force)/∂q + a1 ∂(generalised force)/∂q̇ from a matrix of as many rows as q has, column after
    /// column.
    pub(crate) fn subtract_tangent(
        &self,
        amplitude: &[f64; 3],
        at: &Instant,
        released: bool,
        position: &Position,
        a1: f64,
        matrix: &mut [f64],
    ) {
        let (own, rows, q) = (&at.places[self.body], at.q.len(), at.q);
        let onset = self.onset.factor(at);
        let mut add_column = |place: usize, by: f64| {
            let column = &mut matrix[place * rows..(place + 1) * rows];
            self.add_force((amplitude, -by * onset), position, q, own, column);
        };
        match self.time_function.slope(at, || self.speed(at)) {
            Some(Slope::Angle(place, by)) => add_column(place, by),
            Some(Slope::Speed(by)) => {
                own.rotation.into_iter().for_each(|theta| add_column(theta, a1 * by));
                if let Action::Couple { turn, .. } = &self.action {
                    let about_z = turn.data.as_chunks::<3>().0.iter().map(|turn| turn[2]);
                    let columns = own.flexible.clone().zip(about_z);
                    columns.for_each(|(place, turn)| add_column(place, a1 * by * turn));
                }
            }
            None => {}
        }
        let factor = self.factor(at, released);
        let Some(theta) = own.rotation.filter(|_| factor != 0.0) else { return };
        let [fx, fy, _] = self.in_body((amplitude, factor), position);
        let in_space = self.frame == Frame::Space;
        let is_force = matches!(self.action, Action::Force { .. });
        if let (Action::Force { node, .. }, true) = (&self.action, in_space) {
            let [x, y] = place(node, &q[own.flexible.clone()]);
            // ∂²A/∂θ² = −A in the plane: ∂Q_θ/∂θ = −(x0+u)·AᵀF.
            matrix[theta * (rows + 1)] += x * fx + y * fy;
        }
        let shapes = self.action.shapes();
        for (j, column) in own.flexible.clone().enumerate() {
            let shape = shapes.col(j);
            let turned = shape[0] * fy - shape[1] * fx;
            if is_force {
                matrix[column * rows + theta] -= turned;
            }
            if in_space {
                // ∂(AᵀF)/∂θ = (fy, −fx) in the frame of the body.
                matrix[theta * rows + column] -= turned;
            }
        }
    }

    /// The force or the couple in the frame of the body.
    fn in_body(&self, (amplitude, factor): (&[f64; 3], f64), position: &Position) -> [f64; 3] {
        let [x, y, z] = amplitude.map(|part| factor * part);
        match self.frame {
            Frame::Body => [x, y, z],
            Frame::Space => {
                [position.cos * x + position.sin * y, -position.sin * x + position.cos * y, z]
            }
        }
    }
}

/// x0 + u in the plane, in the frame of the body.
fn place(node: &BodyNode, eta: &[f64]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let moved: f64 =
            eta.iter().enumerate().map(|(j, value)| node.shapes[(axis, j)] * value).sum();
        node.position[axis] + moved
    })
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
