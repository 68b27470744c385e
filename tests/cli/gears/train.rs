//! A train of four bodies with one gear: its case, and its equations written down here.

use std::f64::consts::TAU;

use crate::analyses::{numbers, ran};
use crate::workbench::Workbench;

/// Motor, pinion, wheel, load: polar inertias (kg·m²); masses of pinion and wheel (kg).
pub(super) const INERTIA: [f64; 4] = [1e-2, 2e-3, 32e-3, 0.1];
pub(super) const MASS: [f64; 2] = [2.0, 8.0];
/// Couplings (N·m/rad), bearings (N/m), teeth (N/m).
pub(super) const COUPLINGS: [f64; 2] = [2e4, 5e4];
pub(super) const BEARINGS: [f64; 2] = [5e7, 8e7];
pub(super) const TEETH: f64 = 2e8;
/// Pitch radii (m), pressure angle, ratio.
pub(super) const RADII: [f64; 2] = [0.04, 0.08];
pub(super) const RATIO: f64 = -0.5;

/// θ of motor, pinion, wheel and load; x, y of pinion and wheel.
pub(super) const SIZE: usize = 8;

/// How the machine stands, and what is put in.
#[derive(Clone, Copy)]
pub(super) struct Train {
    /// Angle of the line of centres (deg).
    pub(super) turn: f64,
    /// Pressure angle (deg).
    pub(super) pressure: f64,
    /// N·s/m.
    pub(super) damping: f64,
    /// µm.
    pub(super) backlash: Option<f64>,
    /// rpm of the motor.
    pub(super) speed: f64,
}

pub(super) const PLAIN: Train =
    Train { turn: 90.0, pressure: 20.0, damping: 0.0, backlash: None, speed: 3000.0 };

impl Train {
    pub(super) fn gear(&self) -> String {
        let backlash =
            self.backlash.map_or(String::new(), |own| format!("backlash = \"{own} um\"\n"));
        format!(
            "[joint.mesh]\nkind = \"gear\"\nfirst = {{ body = \"pinion\" }}\nsecond = {{ body = \"wheel\" }}\nteeth = [20, 40]\n\
             pressure_angle = \"{} deg\"\nmesh_stiffness = \"{TEETH} N/m\"\nmesh_damping = \"{} N*s/m\"\n{backlash}\n",
            self.pressure, self.damping
        )
    }

    pub(super) fn bodies(&self) -> [String; 4] {
        let (y, x) = self.turn.to_radians().sin_cos();
        let axis = format!("axis = [\"{:.15} mm\", \"{:.15} mm\"]\n", 120.0 * x, 120.0 * y);
        let body = |name: &str, place: usize, mass: f64, axis: &str, speed: f64| {
            format!(
                "[body.{name}]\nturns = \"free\"\n{axis}mass = \"{mass} kg\"\npolar_inertia = \"{} kg*m^2\"\n\
                 initial_speed = \"{speed} rpm\"\n\n",
                INERTIA[place]
            )
        };
        [
            body("motor", 0, 5.0, "", self.speed),
            body("pinion", 1, MASS[0], "", self.speed),
            body("wheel", 2, MASS[1], &axis, RATIO * self.speed),
            body("load", 3, 20.0, &axis, RATIO * self.speed),
        ]
    }

    pub(super) fn joints(&self) -> [String; 6] {
        let coupling = |name: &str, first: &str, second: &str, k: f64| {
            format!(
                "[joint.{name}]\nkind = \"coupling\"\nfirst = {{ body = \"{first}\" }}\nsecond = {{ body = \"{second}\" }}\n\
                 stiffness = \"{k} N*m/rad\"\n\n"
            )
        };
        let bushing = |body: &str, k: f64| {
            format!(
                "[joint.{body}]\nkind = \"bushing\"\nfirst = {{ body = \"{body}\" }}\n\
                 stiffness = {{ xx = \"{k} N/m\", yy = \"{k} N/m\" }}\n\n"
            )
        };
        [
            coupling("input", "motor", "pinion", COUPLINGS[0]),
            coupling("outgoing", "wheel", "load", COUPLINGS[1]),
            bushing("pinion", BEARINGS[0]),
            bushing("wheel", BEARINGS[1]),
            bushing("motor", 5e7),
            bushing("load", 8e7),
        ]
    }

    /// The case with couples (N·m) on motor and load.
    pub(super) fn case(&self, couples: [f64; 2], rest: &str) -> String {
        let load = |body: &str, couple: f64| {
            format!("[loads.{body}]\nbody = \"{body}\"\ncouple = \"{couple} N*m\"\n\n")
        };
        let loads = load("motor", couples[0]) + &load("load", couples[1]);
        let (bodies, joints) = (self.bodies().concat(), self.joints().concat());
        format!("title = \"a train\"\n\n{bodies}{}{joints}{loads}{rest}", self.gear())
    }

    /// Flanks: e_n as a row over the coordinates, on which the force is −k ⟨e_n − b/2⟩ with backlash.
    pub(super) fn flanks(&self) -> Vec<[f64; SIZE]> {
        let (y, x) = self.turn.to_radians().sin_cos();
        let flank = |alpha: f64, sense: f64| {
            let (sin, cos) = alpha.to_radians().sin_cos();
            // Along the line of centres and across it.
            let n = [sin * x - sense * cos * y, sin * y + sense * cos * x];
            let [r, s] = RADII.map(|radius| sense * radius * cos);
            [0.0, r, s, 0.0, n[0], n[1], -n[0], -n[1]]
        };
        match self.backlash {
            None => vec![flank(self.pressure, 1.0)],
            Some(_) => vec![flank(self.pressure, 1.0), flank(self.pressure, -1.0)],
        }
    }

    /// q̈ of the equations in space.
    pub(super) fn acceleration(
        &self,
        q: &[f64; SIZE],
        v: &[f64; SIZE],
        couples: [f64; 2],
    ) -> [f64; SIZE] {
        let mut force = [0.0; SIZE];
        (force[0], force[3]) = (couples[0], couples[1]);
        for (k, [a, b]) in COUPLINGS.into_iter().zip([[0, 1], [2, 3]]) {
            force[a] -= k * (q[a] - q[b]);
            force[b] += k * (q[a] - q[b]);
        }
        for (k, first) in BEARINGS.into_iter().zip([4, 6]) {
            force[first] -= k * q[first];
            force[first + 1] -= k * q[first + 1];
        }
        for row in self.flanks() {
            let [e, rate] = [q, v].map(|x| row.iter().zip(x).map(|(row, x)| row * x).sum::<f64>());
            let own = match self.backlash {
                None => -TEETH * e - self.damping * rate,
                Some(b) if e > 0.5e-6 * b => {
                    let overlap = e - 0.5e-6 * b;
                    // Damping rises over the first 2 µm.
                    let damping = self.damping * f64::min(overlap / 2e-6, 1.0);
                    -f64::max(TEETH * overlap + damping * rate, 0.0)
                }
                Some(_) => 0.0,
            };
            force.iter_mut().zip(row).for_each(|(sum, row)| *sum += own * row);
        }
        let inertia = masses();
        [0, 1, 2, 3, 4, 5, 6, 7].map(|i| force[i] / inertia[i])
    }

    /// Runge and Kutta's fourth order from rest in space but for the speeds, in steps of `dt` s.
    pub(super) fn integrated(&self, couples: [f64; 2], dt: f64, steps: usize) -> [f64; SIZE] {
        let speed = self.speed * TAU / 60.0;
        let mut q = [0.0; SIZE];
        let mut v = [speed, speed, RATIO * speed, RATIO * speed, 0.0, 0.0, 0.0, 0.0];
        let add = |x: &[f64; SIZE], y: &[f64; SIZE], h: f64| -> [f64; SIZE] {
            std::array::from_fn(|i| x[i] + h * y[i])
        };
        for _ in 0..steps {
            let k1 = (v, self.acceleration(&q, &v, couples));
            let at = |k: &([f64; SIZE], [f64; SIZE]), h: f64| (add(&q, &k.0, h), add(&v, &k.1, h));
            let next = |k: &([f64; SIZE], [f64; SIZE]), h: f64| {
                let (q, v) = at(k, h);
                (v, self.acceleration(&q, &v, couples))
            };
            let k2 = next(&k1, 0.5 * dt);
            let k3 = next(&k2, 0.5 * dt);
            let k4 = next(&k3, dt);
            let mean = |of: fn(&([f64; SIZE], [f64; SIZE])) -> [f64; SIZE], i: usize| {
                (of(&k1)[i] + 2.0 * of(&k2)[i] + 2.0 * of(&k3)[i] + of(&k4)[i]) / 6.0
            };
            q = std::array::from_fn(|i| q[i] + dt * mean(|k| k.0, i));
            v = std::array::from_fn(|i| v[i] + dt * mean(|k| k.1, i));
        }
        q
    }

    /// det(K − ω²M), scaled by rows.
    pub(super) fn determinant(&self, omega: f64) -> f64 {
        let inertia = masses();
        let mut a = [[0.0; SIZE]; SIZE];
        for j in 0..SIZE {
            let mut unit = [0.0; SIZE];
            unit[j] = 1.0;
            let column = self.acceleration(&unit, &[0.0; SIZE], [0.0; 2]);
            for i in 0..SIZE {
                // In coordinates of mass 1.
                a[i][j] = -column[i] * (inertia[i] / inertia[j]).sqrt() / (omega * omega);
            }
            a[j][j] -= 1.0;
        }
        let mut determinant = 1.0;
        for k in 0..SIZE {
            let pivot =
                (k..SIZE).max_by(|i, j| a[*i][k].abs().total_cmp(&a[*j][k].abs())).expect("rows");
            if pivot != k {
                a.swap(pivot, k);
                determinant = -determinant;
            }
            determinant *= a[k][k];
            for i in k + 1..SIZE {
                let factor = a[i][k] / a[k][k];
                let first = a[k];
                a[i].iter_mut().zip(first).skip(k).for_each(|(own, first)| *own -= factor * first);
            }
        }
        determinant
    }

    /// Frequencies above 1 Hz at which the determinant changes its sign, or touches zero twice (Hz).
    pub(super) fn frequencies(&self) -> Vec<f64> {
        let mut all = Vec::new();
        let at = |hertz: f64| self.determinant(TAU * hertz);
        let mut low = 1.0;
        while low < 5000.0 {
            let mut ends = [low, low * 1.0007];
            if at(ends[0]) * at(ends[1]) < 0.0 {
                for _ in 0..60 {
                    let middle = 0.5 * (ends[0] + ends[1]);
                    let place = usize::from(at(ends[0]) * at(middle) < 0.0);
                    ends[place] = middle;
                }
                all.push(ends[0]);
            }
            low *= 1.0007;
        }
        all
    }
}

pub(super) fn masses() -> [f64; SIZE] {
    let [a, b, c, d] = INERTIA;
    [a, b, c, d, MASS[0], MASS[0], MASS[1], MASS[1]]
}

/// Frequencies of a case at 3000 rpm of the motor (Hz).
pub(super) fn modes(case: &str) -> Vec<f64> {
    let bench = Workbench::new().file("case.toml", case);
    let arguments = ["--speed", "3000 rpm", "--of", "motor", "--count", "20", "--out", "out"];
    ran(&bench, &[&["modes", "case.toml"][..], &arguments].concat());
    numbers(&bench, "out/modes.csv", "frequency_hz")
}
