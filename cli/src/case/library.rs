//! Where case files come from: the disk, or the cases built into the program.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, suggest};
use whirl_codegen::document::tree::{Content, Node, Place, Tree};
use whirl_codegen::document::{Table, Wording};
use whirl_specs::LAWS;

use super::embedded::{EMBEDDED_FOLDER, embedded_cases, embedded_file, embedded_files};
use super::text::CaseText;
use crate::text_file;

/// Whether files are read from the disk or among the built-in ones.
#[derive(Debug, Clone, Copy)]
pub(crate) enum FileStore<'a> {
    /// Files of the user.
    Disk,
    /// Files built into the program.
    Embedded,
    /// A text with its files, and those of the user.
    Given(&'a CaseText),
}

impl<'a> FileStore<'a> {
    /// The store and the path of the case that the user called `case`: a path, or a built-in name.
    ///
    /// # Errors
    /// Neither a file nor a built-in case is called so.
    pub(crate) fn find(case: &str) -> Result<(FileStore<'a>, PathBuf), Diagnostics> {
        let path = Path::new(case);
        if path.is_file() {
            return Ok((FileStore::Disk, path.to_path_buf()));
        }
        if embedded_cases().any(|name| name == case) {
            return Ok((
                FileStore::Embedded,
                Path::new(EMBEDDED_FOLDER).join(format!("{case}.toml")),
            ));
        }
        let names: Vec<&str> = embedded_cases().collect();
        let message = if path.is_dir() {
            format!("`{case}` is a folder, not a case file")
        } else {
            format!("there is no file `{case}` and no built-in case of this name")
        };
        let is_law = LAWS.iter().any(|law| law.origin.name == case);
        let help = match is_law {
            true => Some(format!(
                "it is a law: a case takes it as `law = \"{case}\"`, and `whirl explain {case}` shows it"
            )),
            false => suggest(case, &names),
        };
        let source = Source::new(path, "");
        Err(Diagnostic::new(&source, Code::BAD_VALUE, None, message).maybe_help(help).into())
    }

    /// Whether files that it does not have are looked for on the disk.
    pub(crate) fn is_on_disk(self) -> bool {
        !matches!(self, FileStore::Embedded)
    }

    /// Text of the file at `path`.
    ///
    /// # Errors
    /// Why it cannot be read, for people.
    pub(crate) fn read(self, path: &Path) -> Result<Arc<Source>, String> {
        if let FileStore::Given(text) = self
            && let Some(source) = text.file(path)
        {
            return Ok(source);
        }
        match self {
            FileStore::Disk | FileStore::Given(_) => {
                // What is no file, such as a device, may never end.
                if path.exists() && !path.is_file() {
                    return Err(format!("`{}` is not a file", path.display()));
                }
                let source = Source::new(path, text_file::read(path)?);
                if let FileStore::Given(text) = self {
                    text.note(&source);
                }
                Ok(source)
            }
            FileStore::Embedded => embedded_file(path)
                .ok_or_else(|| format!("there is no built-in file `{}`", path.display())),
        }
    }

    /// Text of the file that `beside` names `name`: relative to its folder, or else a built-in file.
    ///
    /// # Errors
    /// Why it cannot be read, for people.
    pub(crate) fn read_beside(self, beside: &Source, name: &str) -> Result<Arc<Source>, String> {
        let path = resolve(beside, name);
        let built_in = || embedded_file(&Path::new(EMBEDDED_FOLDER).join(name));
        match self {
            FileStore::Embedded => self.read(&path),
            FileStore::Given(text) if text.file(&path).is_some() => self.read(&path),
            _ if path.exists() => self.read(&path),
            _ => match built_in() {
                Some(source) => Ok(source),
                None => self.read(&path),
            },
        }
    }

    /// The file that a key of a table names; none where it cannot be read, which is noted.
    pub(crate) fn read_named(self, table: &Table, name: &Located) -> Option<Arc<Source>> {
        let found = self.read_beside(name.source(), name.text());
        let noted = found.map_err(|message| {
            let error = name.error_here(Code::BAD_VALUE, message);
            table.push(error.help(RELATIVE));
        });
        noted.ok()
    }
}

const RELATIVE: &str = "paths are relative to the file that names them";

impl CaseText {
    /// The text of a file.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn of_file(path: &Path) -> Result<Self, Diagnostics> {
        let source = FileStore::Disk.read(path).map_err(|message| {
            Diagnostic::new(&Source::new(path, ""), Code::BAD_VALUE, None, message)
        })?;
        Ok(CaseText::at(path, source.text.as_str()))
    }

    /// The case that is called `name`: a path, relative to the folder of `beside` if there is one, or a built-in case, with all
    /// that is built in beside it.
    ///
    /// # Errors
    /// Nothing is called so; it cannot be read.
    pub(crate) fn find(name: &str, beside: Option<&Source>) -> Result<Self, Diagnostics> {
        let path = beside.map_or_else(|| PathBuf::from(name), |own| resolve(own, name));
        if path.is_file() {
            return CaseText::of_file(&path);
        }
        match FileStore::find(name)? {
            (FileStore::Embedded, path) => {
                let source = FileStore::Embedded.read(&path).expect("a file that is built in");
                let own = CaseText::at(&path, source.text.as_str());
                let with = |own: CaseText, (path, text)| own.with_path(path, text);
                Ok(embedded_files().fold(own, with))
            }
            // It stands where the command is run, not beside the file that names it.
            (_, path) => CaseText::of_file(&path),
        }
    }
}

/// A path as `beside` names it: relative to the folder of that file.
pub(crate) fn resolve(beside: &Source, path: &str) -> PathBuf {
    beside.path.parent().unwrap_or(Path::new("")).join(path)
}

/// Keys of tables that exclude each other.
const INSTEAD: &[(&str, &[&str])] = &[
    ("shaft", &["mesh", "dimensions"]),
    ("support", &["mesh", "dimensions"]),
    ("body.*", &["mesh", "dimensions", "mass"]),
    ("shaft", &["units", "dimensions"]),
    ("shaft", &["merge", "dimensions"]),
    ("support", &["units", "dimensions"]),
    ("support", &["merge", "dimensions"]),
    ("body.*", &["units", "dimensions", "mass"]),
    ("body.*", &["merge", "dimensions", "mass"]),
    ("drive", &["section", "top"]),
    ("drive", &["section", "bottom"]),
    ("drive", &["table", "torque"]),
    ("drive", &["table", "target_speed"]),
    ("drive", &["table", "release"]),
    ("drives.*", &["section", "top"]),
    ("drives.*", &["section", "bottom"]),
    ("drives.*", &["table", "torque"]),
    ("drives.*", &["table", "target_speed"]),
    ("drives.*", &["table", "release"]),
    ("loads.*", &["force", "couple"]),
    ("body.*", &["table", "speed"]),
    ("body.*", &["table", "acceleration"]),
    ("march", &["steps", "duration"]),
];

/// Files that include each other deeper than this do so in a circle or by mistake.
const DEEPEST_INCLUDE: usize = 8;

/// More files than this are included by mistake, such as by files that include each other twice.
const MOST_FILES: usize = 64;

/// The tree of `path` with everything it includes, and the files read, the case first. `values` hold in place of those of the
/// files.
///
/// # Errors
/// Every file that cannot be read or is not TOML.
pub(crate) fn load(
    store: FileStore,
    path: &Path,
    values: Option<Tree>,
) -> Result<(Tree, Vec<Arc<Source>>), Diagnostics> {
    let source = match store {
        FileStore::Given(text) => text.source(),
        _ => store.read(path).map_err(|message| {
            Diagnostic::new(&Source::new(path, ""), Code::BAD_VALUE, None, message)
        })?,
    };
    let mut sources = vec![source.clone()];
    let mut errors = Diagnostics::new();
    let mut tree = load_source(store, &source, 0, &mut sources, &mut errors);
    if let FileStore::Given(text) = store
        && let Some(values) = text.varied()
    {
        let varied = load_source(store, &values, 0, &mut sources, &mut errors);
        tree = replaced(tree, varied, &mut errors);
        sources.push(values);
    }
    if let Some(values) = values {
        tree = replaced(tree, values, &mut errors);
    }
    errors.into_result((tree, sources))
}

/// A tree with `values` in place of its own.
fn replaced(tree: Tree, mut values: Tree, errors: &mut Diagnostics) -> Tree {
    in_lists(&mut values, &tree, errors);
    in_order(&mut values, &tree);
    values.merge(tree, INSTEAD);
    values
}

/// Lets tables stand where the case has them: by their places bodies, joints and outputs have their order.
fn in_order(values: &mut Tree, tree: &Tree) {
    for (key, (place, node)) in &mut values.entries {
        let Some((heading, own)) = tree.entries.get(key) else { continue };
        if let (Content::Table(values), Content::Table(inner)) = (&mut node.content, &own.content) {
            (*place, node.place) = (heading.clone(), own.place.clone());
            in_order(values, inner);
        }
    }
}

/// Makes lists of those tables of `varied` that count the tables of a list: with `load.2.force`, all loads as `tree` has them, the
/// second one with another force.
fn in_lists(varied: &mut Tree, tree: &Tree, errors: &mut Diagnostics) {
    for (key, (_, own)) in &mut varied.entries {
        let Some((_, node)) = tree.entries.get(key) else { continue };
        let Content::Table(changes) = &mut own.content else { continue };
        match &node.content {
            Content::Table(inner) => in_lists(changes, inner, errors),
            Content::List(items) => {
                let mut items = items.clone();
                for (number, (place, change)) in std::mem::take(&mut changes.entries) {
                    let count = items.len();
                    let found = number.parse::<usize>().ok().and_then(|k| k.checked_sub(1));
                    let Some(item) = found.and_then(|place| items.get_mut(place)) else {
                        let message = format!("there is no `{key}.{number}`");
                        let help = format!(
                            "`{key}` is a list: write `{key}.1` for its first entry, up to `{key}.{count}`"
                        );
                        errors.push(place.error(Code::BAD_VALUE, message).help(help));
                        continue;
                    };
                    match (change.content, &mut item.content) {
                        (Content::Table(mut change), Content::Table(inner)) => {
                            in_lists(&mut change, inner, errors);
                            change.merge(std::mem::take(inner), &[]);
                            *inner = change;
                        }
                        (content, _) => *item = Node { place: change.place, content },
                    }
                }
                own.content = Content::List(items);
            }
            _ => {}
        }
    }
}

fn load_source(
    store: FileStore,
    source: &Arc<Source>,
    depth: usize,
    sources: &mut Vec<Arc<Source>>,
    errors: &mut Diagnostics,
) -> Tree {
    let (mut tree, mut found) = Tree::parse(source);
    tree.each(&mut |_, node| refused(node).into_iter().for_each(|error| found.push(error)));
    if !found.is_empty() {
        errors.append(found);
        return Tree::default();
    }
    let Some((_, include)) = tree.entries.remove("include") else {
        return tree;
    };
    for (place, name) in include_names(include, errors) {
        if depth == DEEPEST_INCLUDE {
            errors.push(
                place
                    .error(Code::BAD_VALUE, "files include each other too deeply")
                    .help("look for a file that includes itself"),
            );
            continue;
        }
        if sources.len() == MOST_FILES {
            let message = format!("a case is made of at most {MOST_FILES} files");
            errors.push(
                place.error(Code::LIMIT, message).help("look for files that include each other"),
            );
            break;
        }
        match store.read_beside(source, &name) {
            Ok(included) => {
                sources.push(included.clone());
                let included = load_source(store, &included, depth + 1, sources, errors);
                tree.merge(included, INSTEAD);
            }
            Err(message) => errors.push(place.error(Code::BAD_VALUE, message).help(RELATIVE)),
        }
    }
    tree
}

/// What is wrong with a value that no key takes.
pub(crate) fn refused(node: &Node) -> Option<Diagnostic> {
    let (message, help) = match &node.content {
        Content::Number(number) if number.float().is_some() => return None,
        Content::Number(number) if number.whole => (
            "this whole number is too large",
            "whole numbers lie between -9223372036854775808 and 9223372036854775807",
        ),
        Content::Number(_) => {
            ("a finite number is needed here", "write a number such as `0.3` or `1e-3`")
        }
        Content::Date => ("a date has no meaning here", "write it as text, between quotes"),
        _ => return None,
    };
    Some(node.place.error(Code::BAD_VALUE, message).help(help))
}

fn include_names(include: Node, errors: &mut Diagnostics) -> Vec<(Place, String)> {
    let list = match include.content {
        Content::List(list) => list,
        _ => vec![include],
    };
    let mut names = Vec::with_capacity(list.len());
    for node in list {
        match node.content {
            Content::Text(name) => names.push((node.place, name)),
            other => errors.push(node.place.error(
                Code::BAD_VALUE,
                format!("`include` takes the path of a file, not {}", Wording::Case.of(&other)),
            )),
        }
    }
    names
}
