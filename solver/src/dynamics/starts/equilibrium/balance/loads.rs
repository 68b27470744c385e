//! The loads of the balance.

use super::Balance;
use crate::equations::{instant, placed};
use crate::loads::{Frame, Load};

impl Balance<'_> {
    /// Loads at t = 0: those fixed in space as far as they act, and of those that turn with a body what stands in space all the
    /// same, along z and about it, and the couple of the rest on the rotation.
    pub(super) fn loads(&mut self) {
        let machine = self.machine;
        self.equations.load.fill(0.0);
        self.load_sizes.fill(0.0);
        let mut one = vec![0.0; machine.size()];
        for load in &machine.loads {
            let (place, position) = placed(machine, load, &self.state.q);
            let now = instant(machine, 0.0, &self.state);
            let factor = load.factor(&now, machine.ends(load, &self.state.v));
            for (part, last) in self.parts(load) {
                let share = if load.frame == Frame::Space { self.share } else { 1.0 };
                load.add_force((&part, share * factor), &position, &self.state.q, place, &mut one);
                for (row, own) in one.iter_mut().enumerate() {
                    let own = std::mem::take(own);
                    if row < last {
                        self.equations.load[row] += own;
                        self.load_sizes[row] += own.abs();
                    }
                }
            }
        }
    }

    /// What of a load's amplitude acts, and on how many of the first coordinates: all that is fixed in space, and what acts along z
    /// and about it in any frame, on all; of what turns in the plane the couple on the rotations.
    pub(super) fn parts(&self, load: &Load) -> Vec<([f64; 3], usize)> {
        let (size, rotations) = (self.machine.size(), self.machine.rotations());
        let [x, y, z] = load.action.amplitude();
        match load.frame {
            Frame::Space => vec![([x, y, z], size)],
            Frame::Body => vec![([0.0, 0.0, z], size), ([x, y, 0.0], rotations)],
        }
    }
}
