//! States of laws over the coordinates of small motions.

use super::linearised::Standstill;
use super::round::LinearMachine;
use crate::linalg::{FirstOrder, multiply};

impl LinearMachine {
    /// States over the coordinates of small motions as they are seen from space.
    pub(super) fn remembered(&self, at: &Standstill) -> Option<FirstOrder> {
        let found = at.found.remembered.as_ref()?;
        let first = self.machine.first_unknown();
        let kept: Vec<usize> = self.kept(at).into_iter().map(|place| place - first).collect();
        let all: Vec<usize> = (0..found.rates.rows).collect();
        let [mut by_position, by_rate] =
            [&found.by_position, &found.by_rate].map(|own| own.select(&all, &kept));
        let forces = found.forces.select(&kept, &all);
        // q̇ = ż − ΩS z.
        for body in self.turning() {
            let speed = at.speeds[body];
            let Some([once, _]) = self.generators[body].as_ref().filter(|_| speed != 0.0) else {
                continue;
            };
            let block = self.block(at.angles.len(), body);
            let turned = multiply(by_rate.columns(block.clone()), once.view());
            for (place, column) in block.zip(turned.data.chunks_exact(all.len().max(1))) {
                let own = by_position.col_mut(place).iter_mut().zip(column);
                own.for_each(|(sum, turned)| *sum -= speed * turned);
            }
        }
        Some(FirstOrder { rates: found.rates.clone(), by_position, by_rate, forces })
    }
}
