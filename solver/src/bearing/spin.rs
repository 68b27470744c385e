//! A journal that spins in a frame at rest: its coordinates u stand in that frame, while the kernels of a
//! clearance write everything in the frame that turns with it, ε = A(φ)ᵀ u.

use whirl_specs::Ring;

/// The turn between both frames at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spin {
    angle: f64,
    speed: f64,
    sin: f64,
    cos: f64,
}

impl Spin {
    /// `angle`: φ (rad); `speed`: φ̇ (rad/s).
    pub(super) fn new([angle, speed]: [f64; 2]) -> Self {
        let (sin, cos) = angle.sin_cos();
        Spin { angle, speed, sin, cos }
    }

    /// The ring of a clearance `c` (m) from u (m) and u̇ (m/s): ε = Aᵀu, ε̇ = Aᵀ(u̇ − φ̇ ẑ×u).
    pub(super) fn ring(&self, u: [f64; 2], u_dot: [f64; 2], c: f64) -> Ring {
        let rate = [u_dot[0] + self.speed * u[1], u_dot[1] - self.speed * u[0]];
        let ([x, y], [x_dot, y_dot]) = (self.to_journal(u), self.to_journal(rate));
        Ring { position: [self.angle, x, y], velocity: [self.speed, x_dot, y_dot], c }
    }

    /// Aᵀ x.
    fn to_journal(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x + self.sin * y, -self.sin * x + self.cos * y]
    }

    /// A x.
    fn to_frame(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y]
    }

    /// Moment and force on (θ, ε) as those on (θ, u).
    pub(super) fn force(&self, [moment, x, y]: [f64; 3]) -> [f64; 3] {
        let [x, y] = self.to_frame([x, y]);
        [moment, x, y]
    }

    /// The derivatives of moment and force on (θ, u) after u, A ((B + a1 P) Aᵀ + P Ȧᵀ), from B + a1 P and P after
    /// ε. Those after θ, which is given, are zero.
    pub(super) fn tangent(&self, both: &[[f64; 3]; 3], rate: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
        let mut out = [[0.0; 3]; 3];
        for axis in 0..2 {
            let mut unit = [0.0; 2];
            unit[axis] = 1.0;
            let moved = self.to_journal(unit);
            // −φ̇ Aᵀ(ẑ×u).
            let turned = self.to_journal([self.speed * unit[1], -self.speed * unit[0]]);
            let [moment, along_x, along_y] = [0, 1, 2].map(|row| {
                let elastic = both[row][1] * moved[0] + both[row][2] * moved[1];
                elastic + rate[row][1] * turned[0] + rate[row][2] * turned[1]
            });
            let [x, y] = self.to_frame([along_x, along_y]);
            out[0][1 + axis] = moment;
            out[1][1 + axis] = x;
            out[2][1 + axis] = y;
        }
        out
    }
}
