//! A journal in a film that has a temperature.

use super::balance::Balance;
use super::heat::{Heat, Heated, Warming};
use super::journal::Journal;
use super::openings::WrongFilm;

/// Parameter of a film's spec that changes with the temperature, and the integral that heats.
const VISCOSITY: &str = "mu_0";
const LOSS: &str = "loss";

impl Journal {
    /// Gives the film a temperature.
    ///
    /// # Errors
    /// A film without viscosity or loss.
    pub fn warm(&mut self, heat: Heat) -> Result<(), WrongFilm> {
        let kernel = self.film.kernel;
        let viscosity = kernel.parameters.iter().position(|own| own.name == VISCOSITY);
        let loss = kernel.outputs.iter().position(|own| own.name == LOSS);
        match (viscosity, loss) {
            (Some(viscosity), Some(loss)) => {
                self.heated = Some(Heated { heat, viscosity, loss });
                Ok(())
            }
            _ => Err(WrongFilm {
                what: format!(
                    "the film `{}` has no parameter `{VISCOSITY}` or no output `{LOSS}`, by which it is heated",
                    kernel.origin.name
                ),
                help: "leave `heat` out, or take a film that has both, such as `jfo`".to_owned(),
            }),
        }
    }

    /// What heats and cools the film, if it has a temperature.
    pub fn heat(&self) -> Option<&Heat> {
        self.heated.as_ref().map(|own| &own.heat)
    }

    /// Gives the oil the viscosity that it has at a temperature (K).
    pub fn heat_to(&self, temperature: f64, balance: &mut Balance) {
        if let Some(Heated { heat, viscosity, .. }) = &self.heated {
            balance.set_parameter(*viscosity, heat.viscosity.at(temperature));
        }
    }

    /// What warms a film as it was solved last, from its integrals after [`Journal::forces`]: what enters passes through it, or, of
    /// films that carry no fill, what leaves.
    pub fn warming(&self, balance: &mut Balance, outputs: &[f64]) -> Warming {
        let film = &self.film;
        let [enters, leaves] = balance.exchanged(film);
        let flow = if film.carries_fill() { enters } else { leaves };
        let loss = self.heated.as_ref().map_or(0.0, |own| outputs[own.loss]);
        Warming { flow, loss, oil: balance.oil(film) }
    }
}
