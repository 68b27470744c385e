//! A coordinate system in the basic one, and the positions that are given in it.

/// Coordinates of a point in some system: lengths, and angles in degrees.
pub(super) type Point = [f64; 3];

/// What the coordinates of a system are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Rectangular,
    /// r, θ, z.
    Cylindrical,
    /// r, θ from the axis, φ about it.
    Spherical,
}

impl Kind {
    /// Along the system's own axes.
    fn rectangular(self, [a, b, c]: Point) -> Point {
        match self {
            Kind::Rectangular => [a, b, c],
            Kind::Cylindrical => {
                let (sin, cos) = sin_cos(b);
                [a * cos, a * sin, c]
            }
            Kind::Spherical => {
                let ((sin, cos), (sin_about, cos_about)) = (sin_cos(b), sin_cos(c));
                [a * sin * cos_about, a * sin * sin_about, a * cos]
            }
        }
    }
}

/// Of degrees; exact at whole quarters, where meshes have many nodes.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let turn = degrees.rem_euclid(360.0);
    match turn {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        _ => turn.to_radians().sin_cos(),
    }
}

/// A system in the basic one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    kind: Kind,
    origin: Point,
    axes: [Point; 3],
}

impl Frame {
    pub(super) const BASIC: Frame = Frame {
        kind: Kind::Rectangular,
        origin: [0.0; 3],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
    };

    pub(super) fn position(&self, point: Point) -> Point {
        let own = self.kind.rectangular(point);
        let turned = self.turned(own);
        std::array::from_fn(|i| self.origin[i] + turned[i])
    }

    /// The system's directions at a position: in a cylindrical system along r, θ and z, in a spherical one along
    /// r, θ and φ.
    pub(super) fn directions(&self, position: Point) -> [Point; 3] {
        if self.kind == Kind::Rectangular {
            return self.axes;
        }
        let from = minus(position, self.origin);
        let [x, y, z] = self.axes.map(|axis| dot(from, axis));
        let about = x.hypot(y);
        // On the axis, θ or φ is taken as 0.
        let [cos, sin] = if about > 0.0 { [x / about, y / about] } else { [1.0, 0.0] };
        let own = match self.kind {
            Kind::Spherical => {
                let length = about.hypot(z);
                let [up, out] =
                    if length > 0.0 { [z / length, about / length] } else { [1.0, 0.0] };
                [[out * cos, out * sin, up], [up * cos, up * sin, -out], [-sin, cos, 0.0]]
            }
            _ => [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]],
        };
        own.map(|direction| self.turned(direction))
    }

    /// A vector along the system's axes, in the basic system.
    fn turned(&self, own: Point) -> Point {
        std::array::from_fn(|i| (0..3).map(|k| self.axes[k][i] * own[k]).sum())
    }

    /// `None` where the points lie on a line.
    pub(super) fn through(kind: Kind, [origin, up, aside]: [Point; 3]) -> Option<Frame> {
        let (up, aside) = (minus(up, origin), minus(aside, origin));
        let z = unit(up, 0.0)?;
        let along = dot(aside, z);
        let x = unit(
            std::array::from_fn(|i| aside[i] - along * z[i]),
            1e-9 * dot(aside, aside).sqrt(),
        )?;
        let y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
        let frame = Frame { kind, origin, axes: [x, y, z] };
        frame.axes.iter().flatten().chain(&origin).all(|x| x.is_finite()).then_some(frame)
    }
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|i| a[i] - b[i])
}

fn dot(a: Point, b: Point) -> f64 {
    (0..3).map(|i| a[i] * b[i]).sum()
}

/// `None` where the vector is not longer than `least`.
fn unit(vector: Point, least: f64) -> Option<Point> {
    let length = dot(vector, vector).sqrt();
    (length > least).then(|| vector.map(|x| x / length))
}
