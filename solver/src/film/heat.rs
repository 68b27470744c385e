//! One temperature of a film: what shear and flow heat, what the oil carries away and the housing takes.
//!
//! (ρ c_p V + C) dT/dt = λ P − ρ c_p Q (T − T_in) − G (T − T_h), with the loss P, the oil V in the film and what passes through it,
//! Q. The temperature changes slowly: a step has the viscosity of its beginning.

/// No film is hotter (K): far beyond all oil, so that one which nothing cools has a temperature.
const HOTTEST: f64 = 3000.0;
/// A temperature (K) above which no oil lasts: those of minerals crack at some 600 K, perfluorinated ones at 700 K.
pub const OIL_LASTS: f64 = 700.0;

/// Viscosity over the temperature.
#[derive(Debug, Clone, PartialEq)]
pub enum Viscosity {
    /// μ exp(B/(T − T_v) − B/(T₀ − T_v)): μ (Pa·s) at T₀, T₀, T_v and B (K). Vogel, Physik. Z. 22 (1921) 645-646.
    Vogel([f64; 4]),
    /// Rows of temperature (K), ascending, and viscosity (Pa·s): ln μ is straight between them, and the first and the last hold
    /// beyond.
    Table(Vec<[f64; 2]>),
}

impl Viscosity {
    /// Temperatures (K) from and to which it is known.
    pub fn known(&self) -> [f64; 2] {
        match self {
            Viscosity::Vogel([.., without_bound, _]) => [*without_bound, f64::INFINITY],
            Viscosity::Table(rows) => {
                let [first, last] = [rows.first(), rows.last()].map(|own| own.map(|own| own[0]));
                [first.unwrap_or(0.0), last.unwrap_or(f64::INFINITY)]
            }
        }
    }

    /// At a temperature (K), in Pa·s.
    pub fn at(&self, temperature: f64) -> f64 {
        match self {
            Viscosity::Vogel([mu, at, without_bound, b]) => {
                let part = |own: f64| b / (own - without_bound);
                mu * (part(temperature) - part(*at)).exp()
            }
            Viscosity::Table(rows) => {
                let next = rows.partition_point(|row| row[0] <= temperature);
                match (next.checked_sub(1).map(|before| rows[before]), rows.get(next).copied()) {
                    (Some([from, mu]), Some([to, after])) => {
                        mu * (after / mu).powf((temperature - from) / (to - from))
                    }
                    (Some([_, mu]), None) | (None, Some([_, mu])) => mu,
                    (None, None) => f64::NAN,
                }
            }
        }
    }
}

/// What a film is heated and cooled by.
#[derive(Debug, Clone, PartialEq)]
pub struct Heat {
    /// μ(T).
    pub viscosity: Viscosity,
    /// T_in of the oil that enters (K).
    pub inlet: f64,
    /// ρ c_p of the oil (J/(m³ K)).
    pub carried: f64,
    /// λ, the part of the loss that heats the oil.
    pub share: f64,
    /// G (W/K) and T_h (K) of the housing.
    pub housing: [f64; 2],
    /// C of the metal that warms up with the film (J/K).
    pub metal: f64,
}

/// The heat of a film, and where it acts.
#[derive(Debug, Clone)]
pub(super) struct Heated {
    pub(super) heat: Heat,
    /// Place of the viscosity among the parameters, and of the loss among the outputs.
    pub(super) viscosity: usize,
    pub(super) loss: usize,
}

/// What flows through a film (m³/s), what heats it (W), and the oil in it (m³).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Warming {
    /// Q.
    pub flow: f64,
    /// P.
    pub loss: f64,
    /// V.
    pub oil: f64,
}

impl Heat {
    /// The temperature (K) that would balance a loss and a flow. That of a film which nothing cools, as where its journal is in the
    /// middle of an adiabatic one, is 3000 K; where nothing heats it either, that of the inlet.
    pub fn balanced(&self, warming: &Warming) -> f64 {
        let [taken, housing] = self.housing;
        let carried = self.carried * warming.flow;
        let heats = self.share * warming.loss;
        if carried + taken == 0.0 && heats == 0.0 {
            return self.inlet;
        }
        let balanced = (heats + carried * self.inlet + taken * housing) / (carried + taken);
        if balanced < HOTTEST || balanced.is_nan() { balanced } else { HOTTEST }
    }

    /// The temperature (K) at the end of a step (s), from that at its beginning: implicit in what it loses.
    pub fn after(&self, temperature: f64, warming: &Warming, step: f64) -> f64 {
        let [taken, housing] = self.housing;
        let carried = self.carried * warming.flow;
        let held = self.carried * warming.oil + self.metal;
        let heated = self.share * warming.loss + carried * self.inlet + taken * housing;
        (held * temperature + step * heated) / (held + step * (carried + taken))
    }
}

#[cfg(test)]
mod tests {
    use super::Viscosity;

    #[test]
    fn viscosities_are_those_of_their_rows_and_of_vogel() {
        let rows = vec![[313.0, 0.027], [333.0, 0.012], [373.0, 0.0044]];
        let table = Viscosity::Table(rows.clone());
        for [temperature, mu] in rows {
            assert!((table.at(temperature) - mu).abs() < 1e-16);
        }
        let half = (0.027_f64 * 0.012).sqrt();
        assert!((table.at(323.0) / half - 1.0).abs() < 1e-14);
        assert_eq!([table.at(200.0), table.at(500.0)], [0.027, 0.0044]);
        assert_eq!(table.known(), [313.0, 373.0]);
        // 27 mPa s at 40 °C and 4.4 mPa s at 100 °C.
        let vogel = Viscosity::Vogel([0.027, 313.15, 178.15, 797.7]);
        assert_eq!(vogel.at(313.15), 0.027);
        assert!((vogel.at(373.15) / 0.0044 - 1.0).abs() < 5e-3, "{}", vogel.at(373.15));
    }
}
