//! The point from which a run can be resumed, in a file beside its history: where the march was, and of what.

use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};
use whirl_solver::bodies::Body;
use whirl_solver::cache::{Key, instruction_set, pack, unpack, write_whole};
use whirl_solver::dynamics::Checkpoint;

use crate::case::{Case, Start};
use crate::errors::Failure;
use crate::history::{HistoryFile, Written};
use crate::machine::Built;
use crate::results::{CHECKPOINT, Results, STATE, SUMMARY};
use crate::{history, version};

/// Layout of the file.
const LAYOUT: &str = "whirl checkpoint 16";

/// Everything on which the bits of a history depend: what it is, and a hash of it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Identity(Vec<(String, String)>);

impl Identity {
    /// Of a case and its machine, run by this program on this processor.
    pub(crate) fn of(case: &Case, built: &Built) -> Identity {
        let mut parts = vec![
            ("the program".to_string(), version::SOURCES.to_string()),
            ("the kind of processor".to_string(), instruction_set()),
        ];
        for source in &case.sources {
            let name = source.path.file_name().unwrap_or(source.path.as_os_str());
            parts.push((format!("the file `{}`", name.display()), Key::of(&source.text).hex()));
        }
        parts.extend(
            built.law_hashes.iter().map(|(name, hash)| (format!("the law `{name}`"), hash.clone())),
        );
        for body in built.bodies.iter().flat_map(|facts| &facts.bodies) {
            let what = format!("the mesh of the {}, or what is made of it", body.name);
            parts.push((what, body.content.hex()));
        }
        // What is not reduced has its numbers from a mesh, from matrices or from the case.
        let reduced = |name: &str| {
            let mut facts = built.bodies.iter().flat_map(|facts| &facts.bodies);
            facts.any(|own| own.name == name)
        };
        for body in built.machine.bodies.iter().filter(|body| !reduced(body.name())) {
            let content = match body {
                Body::Turning { name: _, shaft, rotation: _ } => Key::of(shaft),
                Body::Standing { name: _, support } => Key::of(support),
            };
            parts.push((format!("what the body `{}` is made of", body.name()), content.hex()));
        }
        if let Start::State(folder) = &case.start {
            let path = Path::new(folder.text()).join(STATE);
            let content = std::fs::read(&path).map_or("none".to_owned(), |own| Key::of(&own).hex());
            parts.push((format!("the state in `{}`", folder.text()), content));
        }
        Identity(parts)
    }

    /// The hash of what it is besides program and processor: files, laws, meshes, the state of its start.
    pub(crate) fn case_hash(&self) -> String {
        Key::of(&self.0.get(2..).unwrap_or_default()).hex()
    }

    /// Of parts by what messages call them, each with a hash or a name.
    pub(crate) fn new(parts: Vec<(String, String)>) -> Identity {
        Identity(parts)
    }

    /// What of this another one has otherwise, or not at all, in words; it may have more.
    pub(crate) fn changed_in(&self, other: &Identity) -> Vec<String> {
        let changed = self.0.iter().filter(|part| !other.0.contains(part));
        changed.map(|(what, _)| what.clone()).collect()
    }

    /// What differs from another, in words.
    fn differences(&self, other: &Identity) -> Vec<String> {
        let has = |all: &Identity, part: &(String, String)| all.0.contains(part);
        let mut found: Vec<String> = Vec::new();
        let changed = self.0.iter().filter(|part| !has(other, part));
        for (what, _) in changed.chain(other.0.iter().filter(|part| !has(self, part))) {
            if !found.contains(what) {
                found.push(what.clone());
            }
        }
        if found.is_empty() && self != other {
            found.push("the order of the files".to_string());
        }
        found
    }
}

/// A run as it stood after a step.
#[derive(Debug, Serialize, Deserialize)]
pub(crate) struct Point {
    identity: Identity,
    /// The history up to it.
    pub(crate) history: Written,
    /// Wall time of the march up to it (s).
    pub(crate) wall: f64,
    /// The march.
    pub(crate) march: Checkpoint,
}

/// Writes the point of a march.
///
/// # Errors
/// It cannot be written; the one before is still there then.
pub(crate) fn write(
    path: &Path,
    identity: &Identity,
    history: Written,
    (march, wall): (Checkpoint, f64),
) -> io::Result<()> {
    let point = Point { identity: identity.clone(), history, wall, march };
    write_whole(path, &pack(&Key::of(&LAYOUT), &point)?)
}

/// The point from which the run in `results` goes on; none where there is no run.
///
/// # Errors
/// It is one of another case or program, it is damaged, or the history is not the one that belongs to it; a history
/// without such a point.
pub(crate) fn read(results: &Results, identity: &Identity) -> Result<Option<Point>, Failure> {
    let folder = || results.folder().to_path_buf();
    let nothing = |reason: String| Failure::NothingToResume { folder: folder(), reason };
    let bytes = match std::fs::read(results.path(CHECKPOINT)) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            if !results.path(history::NAME).exists() {
                return Ok(None);
            }
            let why = match results.path(SUMMARY).exists() {
                true => "because the run is finished",
                false => "because the run was stopped before it wrote the first one",
            };
            let reason = format!("`{}` has no `{CHECKPOINT}` beside it, {why}", history::NAME);
            return Err(nothing(reason));
        }
        Err(error) => return Err(nothing(format!("cannot read `{CHECKPOINT}`: {error}"))),
    };
    let damaged =
        || nothing(format!("`{CHECKPOINT}` is damaged, or of another version of the program"));
    let point = unpack::<Point>(&Key::of(&LAYOUT), &bytes).ok_or_else(damaged)?;
    let refused = |differs| Err(Failure::OtherRun { folder: folder(), differs });
    let differences = point.identity.differences(identity);
    if !differences.is_empty() {
        return refused(differences);
    }
    let path = results.path(history::NAME);
    let length = HistoryFile::open(&path).map(|history| history.length());
    if !length.is_ok_and(|length| length >= point.history.length) {
        return refused(vec![format!("`{}`, which has fewer rows", history::NAME)]);
    }
    match point.history.begins(&path) {
        Ok(true) => Ok(Some(point)),
        Ok(false) => refused(vec![format!("rows of `{}`", history::NAME)]),
        Err(error) => Err(nothing(format!("cannot read `{}`: {error}", history::NAME))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_named_once() {
        let identity = |parts: &[(&str, &str)]| {
            Identity(parts.iter().map(|(a, b)| (a.to_string(), b.to_string())).collect())
        };
        let own = identity(&[("the program", "1"), ("the law `a`", "2"), ("the shaft", "3")]);
        let other = identity(&[("the program", "1"), ("the law `b`", "2"), ("the shaft", "4")]);
        assert_eq!(own.differences(&own), Vec::<String>::new());
        assert_eq!(own.differences(&other), ["the law `a`", "the shaft", "the law `b`"]);
    }
}
