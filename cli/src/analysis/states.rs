//! The states of a machine at the speeds of an analysis, one from the other; those at which it does not stand are left out, as
//! films carry nothing at rest.

use whirl_solver::Error;
use whirl_solver::linear::{LinearMachine, Standstill, StateDoubts};

use super::found::nothing;
use super::speeds::Wanted;
use super::words;
use crate::case::Analysis;
use crate::errors::Failure;
use crate::signals::Interruption;

/// How the speeds ended.
pub(super) struct Ended {
    /// What is said of speeds that were left out, and of what limits the worth of the states, a line each.
    pub(super) notes: String,
    /// Whether some were not done.
    pub(super) interrupted: bool,
}

/// Does something in the state at every speed. Where `work` says that it was interrupted, its speed counts as not done.
///
/// # Errors
/// The machine stands at none of them, none was done, or `work` fails.
pub(super) fn at_each_speed(
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    work: &mut dyn FnMut(f64, &Standstill) -> Result<(), Failure>,
) -> Result<Ended, Failure> {
    let (mut near, mut lost): (Option<(f64, Standstill)>, _) = (None, Lost::default());
    let mut states = StateDoubts::default();
    let mut done = 0;
    for &speed in wanted.speeds.iter().take_while(|_| !interruption.asked()) {
        let speeds = match wanted.of {
            Some(of) => linear.speeds(of, speed, &analysis.ratios),
            None => Vec::new(),
        };
        let before = near.as_ref().map(|own| &own.1);
        if let Some(at) = lost.take(speed, linear.standing(&speeds, before))? {
            match work(speed, &at) {
                Err(Failure::Machine(Error::Interrupted)) => break,
                own => own?,
            }
            states.take(linear, speed, &at);
            near = Some((speed, at));
        }
        done += 1;
    }
    let lost = lost.words(near.is_some())?;
    let Some((speed, at)) = &near else { return Err(nothing()) };
    let notes = lost + &words::doubts(&states.told(linear, Some((*speed, at))));
    Ok(Ended { notes, interrupted: done < wanted.speeds.len() })
}

/// Those that were left out, and why.
#[derive(Default)]
struct Lost {
    speeds: Vec<f64>,
    last: Option<Error>,
}

impl Lost {
    /// Leaves a speed out, if that is because the machine does not stand there.
    ///
    /// # Errors
    /// Any other error.
    fn take<T>(&mut self, speed: f64, made: Result<T, Error>) -> Result<Option<T>, Error> {
        match made {
            Ok(own) => Ok(Some(own)),
            Err(error) if error.is_of_balance() => {
                self.speeds.push(speed);
                self.last = Some(error);
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// What is said of them, if all is not lost.
    ///
    /// # Errors
    /// Why the machine stands at none of the speeds.
    fn words(self, found: bool) -> Result<String, Error> {
        match (self.last, found) {
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
