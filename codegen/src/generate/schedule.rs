//! What the kernels of every spec compute.

use super::{Scheduled, parallel};
use crate::diagnostic::Diagnostics;
use crate::spec::kind::OfAnyKind;
use crate::spec::list::Spec;

pub(super) fn schedule(specs: Vec<Spec>) -> Result<Vec<Scheduled>, Diagnostics> {
    let every: Vec<&OfAnyKind> = specs.iter().map(Spec::any).collect();
    let programs = parallel::map(&specs, super::size, |spec| spec.schedule(&every));
    let programs = super::all(programs)?;
    let both = specs.into_iter().zip(programs);
    Ok(both.map(|(spec, programs)| Scheduled { spec, programs }).collect())
}
