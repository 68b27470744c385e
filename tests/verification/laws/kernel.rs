//! Compiled laws at one point, by the names of inputs and outputs.

use whirl_specs::{LAWS, Law};

/// A law of the registry.
#[derive(Clone, Copy)]
pub(super) struct Kernel(&'static Law);

impl Kernel {
    pub(super) fn named(name: &str) -> Self {
        let law = LAWS.iter().find(|law| law.origin.name == name);
        Kernel(law.unwrap_or_else(|| panic!("no law `{name}`")))
    }

    /// All outputs, each followed by its derivatives, at one point, SI; inputs without a value are zero.
    fn rows(self, inputs: &[(&str, f64)]) -> Vec<f64> {
        let Kernel(law) = self;
        let mut values = vec![0.0; law.inputs.len()];
        for (name, value) in inputs {
            let place = law.inputs.iter().position(|input| input.name == *name);
            values[place.unwrap_or_else(|| panic!("no input `{name}`"))] = *value;
        }
        let mut rows = vec![f64::NAN; law.outputs.len() * (1 + law.inputs.len())];
        (law.evaluate)(1, &values, &mut rows);
        rows
    }

    /// One output, SI.
    pub(super) fn value(self, output: &str, inputs: &[(&str, f64)]) -> f64 {
        self.rows(inputs)[self.row(output)]
    }

    /// ∂output/∂input, SI.
    pub(super) fn slope(self, output: &str, by: &str, inputs: &[(&str, f64)]) -> f64 {
        let place = self.0.inputs.iter().position(|input| input.name == by);
        self.rows(inputs)[self.row(output) + 1 + place.unwrap_or_else(|| panic!("no `{by}`"))]
    }

    fn row(self, output: &str) -> usize {
        let place = self.0.outputs.iter().position(|other| other.name == output);
        place.unwrap_or_else(|| panic!("no output `{output}`")) * (1 + self.0.inputs.len())
    }
}

/// ∫ f from a to b by the trapezoidal rule after x = tanh(π/2 sinh t) (Takahasi and Mori): converges
/// exponentially even where f has powers such as 1.5 at the ends.
pub(super) fn integral(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = ((a + b) / 2.0, (b - a) / 2.0);
    let step = 1.0 / 64.0;
    (-256..=256)
        .map(|i| {
            let t = step * f64::from(i);
            let inner = std::f64::consts::FRAC_PI_2 * t.sinh();
            let weight = std::f64::consts::FRAC_PI_2 * t.cosh() / inner.cosh().powi(2);
            if weight < 1e-300 {
                0.0
            } else {
                step * half * weight * f(middle + half * inner.tanh())
            }
        })
        .sum()
}
