//! A march with the machine that it marches.

use std::sync::Arc;

use whirl_cli::errors::Failure;
use whirl_cli::fmu::Made;
use whirl_solver::dynamics::March;

/// A march that owns its machine.
pub(crate) struct Running {
    // Dropped before the machine, in the order in which they stand here.
    march: March<'static>,
    made: Arc<Made>,
}

impl Running {
    /// A march that begins or goes on as `begin` says.
    ///
    /// # Errors
    /// As `begin`.
    pub(crate) fn new(
        made: &Arc<Made>,
        begin: impl for<'m> FnOnce(&'m Made) -> Result<March<'m>, Failure>,
    ) -> Result<Running, Failure> {
        let made = made.clone();
        // SAFETY: what is behind the Arc stays where it is and unchanged for as long as this value has it, which is longer than
        // the march lives: the march is dropped first, and is given out only for as long as the whole is borrowed.
        let machine: &'static Made = unsafe { &*Arc::as_ptr(&made) };
        Ok(Running { march: begin(machine)?, made })
    }

    /// The march.
    pub(crate) fn march(&self) -> &March<'_> {
        &self.march
    }

    /// What is done with the march.
    pub(crate) fn with<T>(&mut self, work: impl FnOnce(&mut March<'_>) -> T) -> T {
        // A march is invariant in the lifetime of its machine: nothing of a shorter one can be put in its place.
        work(&mut self.march)
    }

    /// Its machine.
    pub(crate) fn made(&self) -> &Arc<Made> {
        &self.made
    }
}
