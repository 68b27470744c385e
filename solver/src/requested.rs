//! Machines with outputs by request: which there can be, and the names of their columns.

use crate::bearing::Plane;
use crate::error::Error;
use crate::history::History;
use crate::machine::Machine;
use crate::output::{Output, Owner, Wanted};

impl Machine {
    /// Outputs by request.
    pub fn outputs(&self) -> &[Output] {
        &self.outputs
    }

    /// The machine with outputs, whose columns follow all others of its history.
    ///
    /// # Errors
    /// An output of a body or joint that there is not, of a point with other coordinates than its body, along an axis
    /// that there is not, or with a column that is there already.
    pub fn with_outputs(mut self, outputs: Vec<Output>) -> Result<Machine, Error> {
        let wrong = |name: &str, what: &str| Err(Error::Machine(format!("output {name}: {what}")));
        for Output { name, what } in &outputs {
            match what.owner() {
                Owner::Body(body) if body >= self.bodies.len() => {
                    return wrong(name, "there is no such body");
                }
                Owner::Joint(joint) if joint >= self.monitors.len() => {
                    return wrong(name, "there is no such joint");
                }
                _ => {}
            }
            if let Wanted::States { joint, states, places } = what {
                let planes =
                    self.monitors[*joint].planes.iter().map(|own| &self.springs.planes[*own]);
                let has =
                    |own: &Plane| self.springs.laws[own.law].bound.states.len() == states.len();
                let found: usize = planes.clone().map(|own| own.springs.len()).sum();
                if found != *places || !planes.clone().all(has) {
                    return wrong(name, "the law of the joint has other states");
                }
            }
            if let Wanted::Motion { body, point, components, .. } = what {
                if point.shapes.cols != self.bodies[*body].size() {
                    return wrong(name, "its point has other coordinates than the body");
                }
                if components.iter().any(|&axis| axis > 2) {
                    return wrong(name, "the axes are 0, 1 and 2");
                }
            }
        }
        self.outputs = outputs;
        let mut names = History::for_machine(&self).names().to_vec();
        names.sort_unstable();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(twice) => wrong(&twice[0], "there are two columns of this name"),
            None => Ok(self),
        }
    }
}
