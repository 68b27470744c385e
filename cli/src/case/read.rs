//! From a case's name or path to a checked [`Case`].

use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use whirl_codegen::document::tree::Tree;
use whirl_codegen::document::{Document, Table};

use super::fields::{self, Fields};
use super::library::{FileStore, load};
use super::start::{Start, StartDraft};
use super::{
    Analysis, Case, CaseText, Figures, JoinedMachine, MarchSettings, Output, analyses, law,
    machine, march, mass, outputs, reduction, start,
};

/// What a case is read for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Purpose {
    /// To be marched, if it does not ask for analyses alone.
    March,
    /// For analyses: it needs no `[march]`.
    Analysis,
    /// To be described: as for analyses where its machine is whole, else as to be marched.
    Check,
}

/// Reads the case that the user called `name`: the path of a file, or a built-in case.
///
/// # Errors
/// Everything that is wrong with the case and the files it includes, each with its place.
pub(crate) fn read(name: &str) -> Result<Case, Diagnostics> {
    draft(name, Purpose::March)?.finish()
}

/// A case with what is wrong with it so far.
pub(crate) struct Draft {
    name: String,
    title: String,
    origin: String,
    sources: Vec<Arc<Source>>,
    figures: Figures,
    fields: Option<Fields>,
    march: Option<MarchSettings>,
    start: Option<StartDraft>,
    memory_limit: Option<usize>,
    outputs: Vec<Output>,
    analyses: Vec<Analysis>,
    /// What is marched, if enough of it is right.
    pub(crate) machine: Option<Box<JoinedMachine>>,
    /// What is wrong.
    pub(crate) errors: Diagnostics,
}

impl Draft {
    /// The case.
    ///
    /// # Errors
    /// Everything that is wrong.
    pub(crate) fn finish(self) -> Result<Case, Diagnostics> {
        let Draft {
            name,
            title,
            origin,
            mut sources,
            figures,
            march,
            outputs,
            analyses,
            fields,
            start,
            memory_limit,
            machine,
            errors,
        } = self;
        let start = start.map_or(Start::Rest, |own| own.start);
        let place = sources[0].clone();
        match (errors.into_result(())?, machine) {
            ((), Some(machine)) => {
                sources.extend(machine.tables());
                Ok(Case {
                    name,
                    title,
                    origin,
                    sources,
                    machine,
                    march,
                    start,
                    memory_limit,
                    outputs,
                    analyses,
                    fields,
                    figures,
                })
            }
            _ => {
                let message = "this case cannot be read";
                Err(Diagnostic::new(&place, Code::BAD_VALUE, None, message).into())
            }
        }
    }
}

/// Reads as much of a case as can be read.
///
/// # Errors
/// Files that cannot be read or are no TOML.
pub(crate) fn draft(name: &str, purpose: Purpose) -> Result<Draft, Diagnostics> {
    let (store, path) = FileStore::find(name)?;
    draft_in(store, &path, None, purpose)
}

/// As [`draft`], of a text.
///
/// # Errors
/// As [`draft`].
pub(crate) fn draft_of(text: &CaseText, purpose: Purpose) -> Result<Draft, Diagnostics> {
    draft_in(FileStore::Given(text), text.path(), None, purpose)
}

/// As [`draft_of`], with other values of some keys.
///
/// # Errors
/// As [`draft`].
pub(crate) fn draft_with(
    text: &CaseText,
    values: Tree,
    purpose: Purpose,
) -> Result<Draft, Diagnostics> {
    draft_in(FileStore::Given(text), text.path(), Some(values), purpose)
}

fn draft_in(
    store: FileStore,
    path: &Path,
    values: Option<Tree>,
    purpose: Purpose,
) -> Result<Draft, Diagnostics> {
    let (tree, sources) = load(store, path, values)?;
    let document = Document::of_case(&sources[0], tree);
    let draft =
        document.root(Case::SHAPE).read(|file| assemble((store, purpose), path, &sources, file));
    Ok(Draft { errors: document.into_errors(), ..draft })
}

fn assemble(
    (store, purpose): (FileStore, Purpose),
    path: &Path,
    sources: &[Arc<Source>],
    file: &Table,
) -> Draft {
    let title = file.text_or_none("title");
    let origin = file.optional_string("source");
    let figures = figures(store, file);
    let start = start::read(file);
    let machine = machine(store, file, start.as_ref()).map(Box::new);
    let known = machine.as_deref();
    if let (Some(start), Some(known)) = (&start, known) {
        start::check(file, start, known);
    }
    let goes_on = start.as_ref().is_some_and(StartDraft::goes_on);
    let is_marched = match purpose {
        Purpose::March => true,
        Purpose::Analysis => false,
        Purpose::Check => !MACHINES.iter().any(|own| file.gives(own)),
    };
    if is_marched && !file.gives("analysis") {
        // In the order in which the file would have them.
        file.demand("title");
        file.demand("march");
    }
    let march = march::read(file, known, goes_on);
    let outputs = outputs::read(file, known);
    let analyses = analyses::read(file, known);
    let fields = fields::read(file, known);
    if let (Some(fields), Some(march), false) = (&fields, &march, goes_on) {
        let beyond = fields.times_beyond([0.0, march.duration()]);
        beyond.into_iter().for_each(|error| file.push(error));
    }
    let memory_limit = reduction::memory_limit(file);
    Draft {
        name: case_name(path),
        title: title.text().to_string(),
        origin: origin.map_or(String::new(), |text| text.text().to_string()),
        sources: sources.to_vec(),
        figures,
        march,
        start,
        memory_limit,
        outputs,
        analyses,
        fields,
        machine,
        errors: Diagnostics::new(),
    }
}

fn case_name(path: &Path) -> String {
    path.file_stem().map_or_else(|| "case".to_string(), |stem| stem.to_string_lossy().into_owned())
}

/// Keys of which each case has one: what there is to be looked at without a march.
const MACHINES: [&str; 4] = ["body", "shaft", "support", "mass"];

/// Keys of a machine that a case of one mass has no use for.
const OF_A_MACHINE: [&str; 7] =
    ["material", "shaft", "support", "springs", "bearing", "drive", "load"];

fn machine(store: FileStore, file: &Table, start: Option<&StartDraft>) -> Option<JoinedMachine> {
    let goes_on = start.is_some_and(StartDraft::goes_on);
    match JoinedMachine::is_in(file) {
        Some(true) => return JoinedMachine::read(store, file, goes_on),
        None => return None,
        Some(false) => {}
    }
    if !file.gives("mass") && !OF_A_MACHINE[1..].iter().any(|key| file.gives(key)) {
        file.absent(
            "body",
            "describe a machine by a table `[body.NAME]` for each body and a table `[joint.NAME]` for each joint, by the \
             short forms `[shaft]`, `[support]`, `[[bearing]]` and `[drive]`, or by one `[mass]`; or `include` a file that \
             has it",
        );
        file.pass_over("material");
        file.pass_over("gravity");
        file.pass_over("ground_motion");
        return None;
    }
    if !file.gives("mass") {
        let speed = start.and_then(|own| own.speed);
        let short = machine::read(store, file, speed, goes_on);
        if let Some(short) = &short {
            short.check(file, goes_on);
        }
        return short;
    }
    if file.gives("shaft") {
        file.conflict("mass", "shaft");
        // Which of both is meant, is open: neither is read as if it were.
        OF_A_MACHINE.iter().for_each(|key| file.pass_over(key));
    }
    mass::read(store, file)
}

fn figures(store: FileStore, file: &Table) -> Figures {
    let read = |figures: &Table| Figures {
        laws: figures
            .texts("laws")
            .iter()
            .filter_map(|name| law::find(store, figures, name))
            .collect(),
        law: figures.optional_count("law"),
        reactions: figures.optional_count("reactions"),
        eccentricity: figures.optional_count("eccentricity"),
        rotation: figures.optional_count("rotation"),
    };
    file.in_table("figures", read).unwrap_or_default()
}
