//! The modules of kernels as text, in an order in which what is called is written before what calls it.

use super::{Kernels, Scheduled, parallel};
use crate::spec::kind::Other;

/// Forms first: the kernels of elements call them, so that their text counts for the hashes of elements.
pub(super) fn emit(scheduled: Vec<Scheduled>) -> Vec<Kernels> {
    let (called, others): (Vec<_>, Vec<_>) =
        scheduled.into_iter().partition(|own| own.spec.kind().called);
    let first = texts(&called, &[]);
    let known: Vec<Other> = called.iter().zip(&first).map(|(own, text)| own.other(text)).collect();
    let rest = texts(&others, &known);
    let specs = called.into_iter().chain(others).map(|own| own.spec);
    specs.zip(first.into_iter().chain(rest)).map(|(spec, text)| Kernels { spec, text }).collect()
}

/// The text of each, which may call what is `known` and what stands before it.
fn texts(scheduled: &[Scheduled], known: &[Other<'_>]) -> Vec<String> {
    let places: Vec<usize> = (0..scheduled.len()).collect();
    let size = |place: &usize| super::size(&scheduled[*place].spec);
    parallel::map(&places, size, |place| {
        let before = scheduled[..*place].iter().map(|own| own.other(""));
        let others: Vec<Other> = known.iter().copied().chain(before).collect();
        let Scheduled { spec, programs } = &scheduled[*place];
        spec.emit(&**programs, &others)
    })
}

impl Scheduled {
    fn other<'a>(&'a self, text: &'a str) -> Other<'a> {
        Other { spec: self.spec.any(), programs: &*self.programs, text }
    }
}
