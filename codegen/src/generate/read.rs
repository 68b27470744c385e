//! Spec files by their kinds, each name once.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use super::parallel;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::emit::identifier;
use crate::spec::clearance::ClearanceSpec;
use crate::spec::element::ElementSpec;
use crate::spec::form::FormSpec;
use crate::spec::law::LawSpec;
use crate::spec::motion::MotionSpec;
use crate::spec::read::Document;

/// A spec file.
#[derive(Debug, Clone)]
pub struct SpecFile {
    /// Path in the crate of the specs, such as `laws/hu2003-linear.toml`; its folder says what it can be.
    /// A file that ends in `.csv` holds the columns of a law's table.
    pub path: String,
    /// The text.
    pub text: String,
}

/// All specs, sorted by path.
pub(super) struct Specs {
    pub(super) elements: Vec<ElementSpec>,
    pub(super) forms: Vec<FormSpec>,
    pub(super) laws: Vec<LawSpec>,
    pub(super) clearances: Vec<ClearanceSpec>,
    pub(super) motions: Vec<MotionSpec>,
}

/// Folders, with the kinds of specs that they may hold.
const FOLDERS: [(&str, &[&str]); 4] = [
    ("elements", &["element"]),
    ("forms", &["form"]),
    ("laws", &["law"]),
    ("motion", &["clearance", "motion"]),
];

/// Endings of the names of the files that specs are read from.
pub const ENDINGS: [&str; 2] = ["toml", "csv"];

/// Folders from which specs are read.
pub fn folders() -> impl Iterator<Item = &'static str> {
    FOLDERS.iter().map(|(folder, _)| *folder)
}

impl Specs {
    pub(super) fn read(files: &[SpecFile]) -> Result<Self, Diagnostics> {
        let mut specs = Specs {
            elements: Vec::new(),
            forms: Vec::new(),
            laws: Vec::new(),
            clearances: Vec::new(),
            motions: Vec::new(),
        };
        let mut errors = Diagnostics::new();
        let mut names = Names::default();
        let mut sorted: Vec<&SpecFile> = files.iter().collect();
        sorted.sort_by(|a, b| a.path.cmp(&b.path));
        let (tables, sorted): (Vec<_>, Vec<_>) =
            sorted.into_iter().partition(|file| file.path.ends_with(".csv"));
        let read = parallel::map(&sorted, |file| file.text.len(), |file| Spec::read(file, &tables));
        for spec in read {
            let taken = spec.and_then(|spec| names.take_all(&spec).map(|()| spec));
            match taken {
                Ok(Spec::Element(element)) => specs.elements.push(*element),
                Ok(Spec::Form(form)) => specs.forms.push(form),
                Ok(Spec::Law(law)) => specs.laws.push(*law),
                Ok(Spec::Clearance(clearance)) => specs.clearances.push(*clearance),
                Ok(Spec::Motion(motion)) => specs.motions.push(motion),
                Err(wrong) => errors.append(wrong),
            }
        }
        errors.into_result(specs)
    }
}

/// A spec of any kind.
enum Spec {
    Element(Box<ElementSpec>),
    Form(FormSpec),
    Law(Box<LawSpec>),
    Clearance(Box<ClearanceSpec>),
    Motion(MotionSpec),
}

impl Spec {
    fn read(file: &SpecFile, tables: &[&SpecFile]) -> Result<Self, Diagnostics> {
        let source = Source::new(&file.path, &file.text);
        match kind(&source)? {
            "element" => ElementSpec::read(&source).map(|spec| Spec::Element(Box::new(spec))),
            "form" => FormSpec::read(&source).map(Spec::Form),
            "law" => LawSpec::read_with(&source, &|name| beside(&source, name, tables))
                .map(|spec| Spec::Law(Box::new(spec))),
            "clearance" => ClearanceSpec::read(&source).map(|spec| Spec::Clearance(Box::new(spec))),
            "motion" => MotionSpec::read(&source).map(Spec::Motion),
            other => unreachable!("{other} is not in the table of folders"),
        }
    }
}

/// The file of columns called `name` in the folder of a spec.
fn beside(spec: &Source, name: &str, tables: &[&SpecFile]) -> Result<Arc<Source>, String> {
    let path = spec.path.with_file_name(name);
    let found = tables.iter().find(|file| Path::new(&file.path) == path);
    let found = found.ok_or_else(|| format!("there is no file `{}`", path.display()));
    found.map(|file| Source::new(&file.path, &file.text))
}

/// The kind that a file says it is, among those that its folder may hold.
fn kind(source: &Arc<Source>) -> Result<&'static str, Diagnostics> {
    let folder = source.path.parent().unwrap_or(Path::new(""));
    let Some((_, kinds)) = FOLDERS.iter().find(|(name, _)| folder == Path::new(name)) else {
        let message = format!("no spec is read from the folder `{}`", folder.display());
        let folders: Vec<&str> = FOLDERS.iter().map(|(name, _)| *name).collect();
        let error = Diagnostic::new(source, Code::BAD_VALUE, None, message);
        return Err(error.help(format!("move the file to one of: {}", folders.join(", "))).into());
    };
    let document = Document::parse(source);
    let kind = if document.is_toml() { document.kind(kinds) } else { None };
    document.into_result(kind)
}

/// Names, and modules made from them, that are taken.
#[derive(Default)]
struct Names {
    taken: BTreeMap<(&'static str, String), Arc<Source>>,
}

impl Names {
    fn take_all(&mut self, spec: &Spec) -> Result<(), Diagnostics> {
        match spec {
            Spec::Element(element) => self.take_element(element, &element.file),
            Spec::Form(forms) => self.take_forms(forms, &forms.file),
            Spec::Law(law) => self.take("law", &law.name, &law.file),
            Spec::Clearance(spec) => self.take("clearance", &spec.name, &spec.file),
            Spec::Motion(motion) => self.take("motion", &motion.name, &motion.file),
        }
    }

    /// An element's name, and the Abaqus types that are read as it.
    fn take_element(
        &mut self,
        element: &ElementSpec,
        source: &Arc<Source>,
    ) -> Result<(), Diagnostics> {
        self.take("element", &element.name, source)?;
        element.abaqus.iter().try_for_each(|kind| self.take("Abaqus type", kind.text(), source))
    }

    /// The name of a set of forms, and those of the forms.
    fn take_forms(&mut self, spec: &FormSpec, source: &Arc<Source>) -> Result<(), Diagnostics> {
        self.take("set of forms", &spec.name, source)?;
        spec.forms.iter().try_for_each(|form| self.take("form", &form.name, source))
    }

    fn take(
        &mut self,
        kind: &'static str,
        name: &str,
        source: &Arc<Source>,
    ) -> Result<(), Diagnostics> {
        let key = (kind, identifier(name).to_string());
        if let Some(first) = self.taken.get(&key) {
            let message = format!(
                "the {kind} `{name}` has the name of the one in `{}`",
                first.path.display()
            );
            let error = Diagnostic::new(source, Code::BAD_NAME, None, message);
            return Err(error.help("change it in one of the files").into());
        }
        self.taken.insert(key, source.clone());
        Ok(())
    }
}
