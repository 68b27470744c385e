//! Whether a sweep can be run: every value is one that the case takes, and some point can be built.

use std::collections::BTreeSet;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics};
use whirl_solver::cache::Key;

use super::definition::Sweep;
use super::identity::Inputs;
use super::points::Point;
use crate::analysis;
use crate::case::{Case, Purpose};
use crate::checkpoint::Identity;
use crate::errors::Failure;
use crate::machine;

impl Sweep {
    /// The case at a point.
    ///
    /// # Errors
    /// Everything that is wrong with it, at the places of its values in the sweep, or in the case.
    pub fn case(&self, point: &Point, warnings: &mut Vec<String>) -> Result<Case, Failure> {
        let purpose = if self.marches { Purpose::March } else { Purpose::Analysis };
        let case = machine::read_with(&self.base, self.tree(point), purpose, warnings)?;
        if self.marches {
            case.marched()?;
        }
        analysis::named(&case, &self.analyses)?;
        Ok(case)
    }

    /// Where the range begins in which an error stands, if it stands in one.
    fn range_of(&self, error: &Diagnostic) -> Option<usize> {
        let span = error.span.as_ref().filter(|_| error.path() == self.source.path)?;
        let within = |place: &Range<usize>| place.start <= span.start && span.end <= place.end;
        let ranged = self.keys.iter().filter(|key| key.is_ranged()).map(|key| &key.place.span);
        ranged.filter(|place| within(place)).map(|place| place.start).next()
    }

    /// Points of which every value of every key is one, with the first values of the other keys.
    fn covering(&self) -> Vec<Point> {
        let mut all = vec![self.at(0, &vec![0; self.axes.len()])];
        for (k, axis) in self.axes.iter().enumerate() {
            for place in 1..axis.count {
                let mut places = vec![0; self.axes.len()];
                places[k] = place;
                all.push(self.at(all.len(), &places));
            }
        }
        all
    }
}

/// Reads the case with every value of every key, and plans its meshes at one point at least. Gives on what the numbers of the
/// sweep depend; `warnings` are added to, each once. `stop` ends it.
///
/// # Errors
/// Values that the case does not take, all of them; why no point can be built; an interruption.
pub(super) fn examine(
    sweep: &Sweep,
    jobs: usize,
    stop: &(dyn Fn() -> bool + Sync),
    warnings: &mut Vec<String>,
) -> Result<Identity, Failure> {
    let points = sweep.covering();
    let found = Mutex::new(Found::default());
    let next = AtomicUsize::new(0);
    thread::scope(|scope| {
        for _ in 0..jobs.min(points.len()) {
            scope.spawn(|| {
                let next = || points.get(next.fetch_add(1, Ordering::Relaxed));
                while let Some(point) = next().filter(|_| !stop()) {
                    let mut warnings = Vec::new();
                    let read = sweep.case(point, &mut warnings);
                    let mut found = found.lock().expect("no reader panics");
                    found.take(point.number(), read, warnings);
                }
            });
        }
    });
    if stop() {
        let reason = "interrupted while the cases of the points were read; nothing was begun";
        return Err(Failure::Unfinished { reason: reason.to_owned(), kept: None, help: None });
    }
    let found = found.into_inner().expect("no reader panics");
    let mut inputs = found.finish(sweep, warnings)?;
    chained(sweep)?;
    inputs.add_bodies(&buildable(sweep)?);
    Ok(inputs.identity(sweep))
}

/// What was found of the points that were read.
#[derive(Default)]
struct Found {
    inputs: Inputs,
    /// By the numbers of points, so that their order is always the same.
    failures: std::collections::BTreeMap<usize, Failure>,
    warnings: BTreeSet<String>,
}

impl Found {
    fn take(&mut self, number: usize, read: Result<Case, Failure>, warnings: Vec<String>) {
        self.warnings.extend(warnings);
        match read {
            Ok(case) => self.inputs.add(&case),
            Err(failure) => drop(self.failures.insert(number, failure)),
        }
    }

    fn finish(self, sweep: &Sweep, warnings: &mut Vec<String>) -> Result<Inputs, Failure> {
        warnings.extend(self.warnings);
        let (mut seen, mut all) = (BTreeSet::new(), Diagnostics::new());
        for failure in self.failures.into_values() {
            let Failure::Input(errors) = failure else { return Err(failure) };
            for error in errors {
                // What is wrong with a range shows at each of its values, and is said once.
                let range = sweep.range_of(&error);
                let place = range.or(error.span.as_ref().map(|span| span.start));
                let message = if range.is_some() { String::new() } else { error.message.clone() };
                if seen.insert((error.path().to_path_buf(), place, message)) {
                    all.push(error);
                }
            }
        }
        all.into_result(())?;
        Ok(self.inputs)
    }
}

/// Sees that points that go on from each other have the same bodies.
///
/// # Errors
/// The first and the last of a chain have others.
fn chained(sweep: &Sweep) -> Result<(), Failure> {
    let (Some(along), Some(axis)) = (sweep.along, sweep.axes.last()) else { return Ok(()) };
    let bodies = |place: usize| -> Result<Vec<Key>, Failure> {
        let mut places = vec![0; sweep.axes.len()];
        *places.last_mut().expect("there is an axis") = place;
        machine::keys(&sweep.case(&sweep.at(place, &places), &mut Vec::new())?)
    };
    // What keeps a point from being built is said where it is run.
    let (Ok(first), Ok(last)) = (bodies(0), bodies(sweep.chain() / along.passes() - 1)) else {
        return Ok(());
    };
    if first == last {
        return Ok(());
    }
    let key = &sweep.keys[axis.keys[0]];
    let message = format!(
        "points cannot continue along `{}`: with it the bodies change, and a state is one of certain bodies",
        key.name
    );
    let error =
        Diagnostic::new(&key.place.source, Code::BAD_VALUE, Some(key.place.span.clone()), message);
    let help = "name another key by `along = \"KEY\"`, or leave `continue` out, so that every point starts as the case does";
    Err(Diagnostics::from(error.help(help)).into())
}

/// The case at the first point whose meshes and sets are right.
///
/// # Errors
/// What is wrong with the first point, if none can be built.
fn buildable(sweep: &Sweep) -> Result<Case, Failure> {
    let mut first = None;
    for point in sweep.covering() {
        let case = sweep.case(&point, &mut Vec::new())?;
        match machine::plan(&case, &mut Vec::new()) {
            Ok(_) => return Ok(case),
            Err(failure) => drop(first.get_or_insert(failure)),
        }
    }
    Err(first.expect("a sweep has a point"))
}
