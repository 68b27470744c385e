//! What is wrong with a file: where, what, and how to mend it.
//!
//! A reader of files collects every error into [`Diagnostics`] and goes on; nothing is printed here.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

/// A file that was read: its path as the user wrote it, and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Path as shown to the user.
    pub path: PathBuf,
    /// The whole text; spans of diagnostics are byte ranges in it.
    pub text: String,
}

impl Source {
    /// A source with `path` (shown in messages, never opened) and `text`.
    pub fn new(path: impl Into<PathBuf>, text: impl Into<String>) -> Arc<Self> {
        Arc::new(Source { path: path.into(), text: text.into() })
    }

    /// Line and column of a byte offset, both from 1; columns count characters.
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let before = &self.text[..floor_boundary(&self.text, offset)];
        let line = before.matches('\n').count() + 1;
        let start = before.rfind('\n').map_or(0, |newline| newline + 1);
        (line, before[start..].chars().count() + 1)
    }
}

/// A stable code, such as `E010`, under which an error can be looked up.
///
/// Codes below `E100` belong to specs and formulas; each user of this module numbers its own from there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Code(pub &'static str);

impl Code {
    /// The file is not TOML.
    pub const TOML: Code = Code("E001");
    /// A key that nothing reads.
    pub const UNKNOWN_KEY: Code = Code("E002");
    /// A key that must be there.
    pub const MISSING_KEY: Code = Code("E003");
    /// A value of the wrong type, or out of its range.
    pub const BAD_VALUE: Code = Code("E004");
    /// A name declared twice, or one that the grammar keeps for itself.
    pub const BAD_NAME: Code = Code("E005");
    /// A formula that the grammar does not allow.
    pub const SYNTAX: Code = Code("E010");
    /// A name in a formula that nothing declares.
    pub const UNKNOWN_NAME: Code = Code("E011");
    /// A function that does not exist, or has another number of arguments.
    pub const BAD_CALL: Code = Code("E012");
    /// Shapes that do not fit, or a condition where a number is wanted.
    pub const SHAPE: Code = Code("E013");
    /// Dimensions that do not fit.
    pub const DIMENSION: Code = Code("E014");
    /// A formula beyond a limit of [`crate::formula::LIMITS`].
    pub const LIMIT: Code = Code("E015");
    /// A division by zero or another operation without a value.
    pub const UNDEFINED: Code = Code("E016");
    /// A unit that is not known.
    pub const UNKNOWN_UNIT: Code = Code("E020");
    /// A quantity of another dimension than wanted.
    pub const WRONG_UNIT: Code = Code("E021");
    /// A law whose value jumps at a break.
    pub const JUMP: Code = Code("E030");
    /// A law whose pieces never apply, or overlap in a way that cannot be followed.
    pub const PIECES: Code = Code("E031");
    /// A law that should engage at a root and has none.
    pub const NO_ROOT: Code = Code("E032");
}

impl fmt::Display for Code {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

/// One error in one file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file.
    pub source: Arc<Source>,
    /// Byte range in the file's text; `None` if the error belongs to the file as a whole.
    pub span: Option<Range<usize>>,
    /// What is wrong, in the user's own names.
    pub message: String,
    /// A few words shown beside the caret; may be empty.
    pub label: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Stable code.
    pub code: Option<Code>,
}

impl Diagnostic {
    /// An error at `span` of `source`.
    pub fn new(
        source: &Arc<Source>,
        code: Code,
        span: impl Into<Option<Range<usize>>>,
        message: impl Into<String>,
    ) -> Self {
        Diagnostic {
            source: source.clone(),
            span: span.into(),
            message: message.into(),
            label: String::new(),
            help: None,
            code: Some(code),
        }
    }

    /// Adds how to mend it.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds how to mend it, if there is anything to say.
    pub fn maybe_help(mut self, help: Option<String>) -> Self {
        self.help = help.or(self.help);
        self
    }

    /// Adds the words beside the caret.
    pub fn label(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// Path of the file as shown to the user.
    pub fn path(&self) -> &Path {
        &self.source.path
    }
}

/// `path:line:column: message (help)` on one line, for logs; [`render`] shows the place.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.path().display())?;
        if let Some(span) = &self.span {
            let (line, column) = self.source.line_column(span.start);
            write!(f, ":{line}:{column}")?;
        }
        write!(f, ": {}", self.message)?;
        match &self.help {
            Some(help) => write!(f, " ({help})"),
            None => Ok(()),
        }
    }
}

/// Every error found in one or more files, in the order of their places once sorted.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// No errors yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one.
    pub fn push(&mut self, diagnostic: Diagnostic) {
        self.list.push(diagnostic);
    }

    /// Adds all of another collection.
    pub fn append(&mut self, other: Diagnostics) {
        self.list.extend(other.list);
    }

    /// Whether nothing is wrong.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Number of errors.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// The errors.
    pub fn iter(&self) -> std::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// `Ok(value)` if nothing is wrong, else the errors sorted by file and place.
    pub fn into_result<T>(mut self, value: T) -> Result<T, Diagnostics> {
        if self.is_empty() {
            return Ok(value);
        }
        self.sort();
        Err(self)
    }

    /// Sorts by file and place; what belongs to a whole file comes last.
    pub fn sort(&mut self) {
        let place = |d: &Diagnostic| d.span.as_ref().map_or(usize::MAX, |span| span.start);
        self.list.sort_by(|a, b| (a.path(), place(a)).cmp(&(b.path(), place(b))));
    }

    /// All errors as text: see [`render`].
    pub fn render(&self) -> String {
        render(&self.list, Colours::Never)
    }
}

impl fmt::Display for Diagnostics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.render())
    }
}

impl std::error::Error for Diagnostics {}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Diagnostics { list: vec![diagnostic] }
    }
}

impl IntoIterator for Diagnostics {
    type Item = Diagnostic;
    type IntoIter = std::vec::IntoIter<Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter()
    }
}

/// Whether rendered text carries terminal colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Colours {
    /// Plain text.
    #[default]
    Never,
    /// ANSI escapes.
    Always,
}

/// More errors than this are counted, not shown.
const MOST_SHOWN: usize = 50;

/// Errors as text: code, message, `file:line:column`, the line with a caret under the place, help.
/// Ends with a newline unless there is nothing to show.
pub fn render(diagnostics: &[Diagnostic], colours: Colours) -> String {
    let renderer = match colours {
        Colours::Never => Renderer::plain(),
        Colours::Always => Renderer::styled(),
    };
    let mut out = String::new();
    for diagnostic in diagnostics.iter().take(MOST_SHOWN) {
        if !out.is_empty() {
            out.push('\n');
        }
        out.push_str(&renderer.render(&[group(diagnostic)]));
        out.push('\n');
    }
    if diagnostics.len() > MOST_SHOWN {
        let rest = diagnostics.len() - MOST_SHOWN;
        out.push_str(&format!("\n… and {rest} more errors\n"));
    }
    out
}

fn group(diagnostic: &Diagnostic) -> Group<'_> {
    let mut title = Level::ERROR.primary_title(diagnostic.message.as_str());
    if let Some(code) = diagnostic.code {
        title = title.id(code.0);
    }
    let path = diagnostic.path().display().to_string();
    let text = diagnostic.source.text.as_str();
    let mut group = match &diagnostic.span {
        Some(span) => {
            let start = floor_boundary(text, span.start);
            let end = floor_boundary(text, span.end).max(start);
            let mut annotation = AnnotationKind::Primary.span(start..end);
            if !diagnostic.label.is_empty() {
                annotation = annotation.label(diagnostic.label.as_str());
            }
            title.element(Snippet::source(text).path(path).annotation(annotation))
        }
        None => title.element(annotate_snippets::Origin::path(path)),
    };
    if let Some(help) = &diagnostic.help {
        group = group.element(Level::HELP.message(help.as_str()));
    }
    group
}

fn floor_boundary(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}

/// The candidate most like `name`, if one is near enough to be meant: at most a third of its
/// characters inserted, deleted, changed or swapped with their neighbour, or equal but for case.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const LONGEST: usize = 64;
    let name: Vec<char> = name.chars().take(LONGEST + 1).collect();
    if name.len() > LONGEST {
        return None;
    }
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other: Vec<char> = candidate.chars().take(LONGEST + 1).collect();
        let longest = name.len().max(other.len());
        let enough = (longest / 3).max(1);
        if other.len().abs_diff(name.len()) > enough || other.len() > LONGEST || longest < 2 {
            continue;
        }
        let same_but_case = name
            .iter()
            .flat_map(|c| c.to_lowercase())
            .eq(other.iter().flat_map(|c| c.to_lowercase()));
        let distance = if same_but_case { 0 } else { edit_distance(&name, &other) };
        if distance <= enough && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// "did you mean `x`?" or the list of what is known, for the help of an unknown name.
pub fn suggest(name: &str, candidates: &[&str]) -> Option<String> {
    const MOST_LISTED: usize = 16;
    if let Some(near) = nearest(name, candidates.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    match candidates.len() {
        0 => None,
        1..=MOST_LISTED => Some(format!("known: {}", quoted(candidates))),
        _ => Some(format!("known: {}, …", quoted(&candidates[..MOST_LISTED]))),
    }
}

fn quoted(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// Insertions, deletions, changes and swaps of neighbours that lead from `a` to `b`.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (above[j] + 1).min(row[j - 1] + 1).min(above[j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rendering_shows_the_place_and_the_help() {
        let source = Source::new("laws/a.toml", "name = \"a\"\nvalue = '1 + × 2'\n");
        let diagnostic = Diagnostic::new(&source, Code::SYNTAX, 24..26, "unexpected `×`")
            .label("not an operator")
            .help("write `*` for a product");
        let expected = "\
error[E010]: unexpected `×`
 --> laws/a.toml:2:14
  |
2 | value = '1 + × 2'
  |              ^ not an operator
  |
  = help: write `*` for a product
";
        assert_eq!(Diagnostics::from(diagnostic.clone()).render(), expected);
        assert_eq!(
            diagnostic.to_string(),
            "laws/a.toml:2:14: unexpected `×` (write `*` for a product)"
        );
    }

    #[test]
    fn spans_outside_the_text_or_inside_a_character_do_not_panic() {
        let source = Source::new("x", "ä");
        for span in [1..1, 0..1, 5..9, 2..2] {
            let text = Diagnostics::from(Diagnostic::new(&source, Code::TOML, span, "m")).render();
            assert!(text.contains("x:1:"), "{text}");
        }
        let whole = Diagnostics::from(Diagnostic::new(&source, Code::TOML, None, "m")).render();
        assert_eq!(whole, "error[E001]: m\n--> x\n");
    }

    #[test]
    fn results_are_sorted_by_place() {
        let source = Source::new("x", "abcdef");
        let mut all = Diagnostics::new();
        all.push(Diagnostic::new(&source, Code::TOML, None, "whole"));
        all.push(Diagnostic::new(&source, Code::TOML, 4..5, "late"));
        all.push(Diagnostic::new(&source, Code::TOML, 1..2, "early"));
        let sorted = all.into_result(()).unwrap_err();
        let messages: Vec<&str> = sorted.iter().map(|d| d.message.as_str()).collect();
        assert_eq!(messages, ["early", "late", "whole"]);
    }

    #[test]
    fn the_nearest_name_is_found() {
        let known = ["title", "source", "inputs", "parameters", "h", "h_dot"];
        assert_eq!(nearest("tilte", known), Some("title"));
        assert_eq!(nearest("input", known), Some("inputs"));
        assert_eq!(nearest("Title", known), Some("title"));
        assert_eq!(nearest("h_dto", known), Some("h_dot"));
        assert_eq!(nearest("k", known), None);
        assert_eq!(nearest("stiffness", known), None);
        assert_eq!(nearest(&"t".repeat(100_000), known), None);
    }
}
