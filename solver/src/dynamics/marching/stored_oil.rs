//! Oil that films hold.

use super::march::March;

impl March<'_> {
    /// What films hold after the last step as its balance counts it (m³), by joints with films: by the gap and half a step's
    /// change of it.
    pub fn stored_oil(&self) -> Vec<f64> {
        let springs = &self.machine.springs;
        let films = (0..springs.planes.len())
            .filter(|&plane| springs.laws[springs.planes[plane].law].bound.law.film().is_some());
        films.map(|plane| self.equations.springs.film(springs, plane).stored()).collect()
    }
}
