//! Memory of the tangent of the balance.

/// Memory for a tangent over q, column after column.
#[derive(Default)]
pub(super) struct Memory {
    pub(super) by_position: Vec<f64>,
    pub(super) by_rate: Vec<f64>,
    /// Of one load without and with rates, zero but while it is added.
    pub(super) load: [Vec<f64>; 2],
}

impl Memory {
    /// Both parts, zero over so many coordinates.
    pub(super) fn cleared(&mut self, size: usize) -> [&mut Vec<f64>; 2] {
        self.load.iter_mut().for_each(|own| own.resize(size * size, 0.0));
        let parts = [&mut self.by_position, &mut self.by_rate];
        parts.map(|own| {
            own.clear();
            own.resize(size * size, 0.0);
            own
        })
    }
}
