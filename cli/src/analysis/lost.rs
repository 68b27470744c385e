//! Speeds of a range at which the machine does not stand, as films carry nothing at rest.

use whirl_solver::Error;

use super::words;

/// Those that were left out, and why.
#[derive(Default)]
pub(super) struct Lost {
    speeds: Vec<f64>,
    first: Option<Error>,
}

impl Lost {
    /// Leaves a speed out, if that is because the machine does not stand there.
    ///
    /// # Errors
    /// Any other error.
    pub(super) fn take<T>(
        &mut self,
        speed: f64,
        made: Result<T, Error>,
    ) -> Result<Option<T>, Error> {
        match made {
            Ok(own) => Ok(Some(own)),
            Err(error) if error.is_of_balance() => {
                self.speeds.push(speed);
                self.first.get_or_insert(error);
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// What is said of them, if all is not lost.
    ///
    /// # Errors
    /// Why the machine stands at none of the speeds.
    pub(super) fn words(self, found: bool) -> Result<String, Error> {
        match (self.first, found) {
            (None, _) => Ok(String::new()),
            (Some(error), false) => Err(error),
            (Some(error), true) => {
                let speeds: Vec<String> =
                    self.speeds.iter().map(|own| words::speed(*own)).collect();
                Ok(format!("left out: {} rpm, as {error}\n", speeds.join(", ")))
            }
        }
    }
}
