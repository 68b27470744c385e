//! The lines of a file with those of the files that it includes, in the order in which they count.

use std::collections::HashMap;
use std::path::{Component, Path, PathBuf};

use super::super::raw::{LinePosition, MeshReport};

/// Gives the text of an included file.
pub type Load<'a> = &'a dyn Fn(&Path) -> std::io::Result<String>;

/// Files include files that include files, but not deeper than this.
const DEEPEST: usize = 32;

/// The texts of all files.
pub(super) struct Sources {
    texts: Vec<String>,
    /// Index of the first text among the files of the report.
    first: usize,
    pub(super) lines: Vec<Line>,
}

/// Where a line is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Line {
    pub(super) file: usize,
    /// From 1.
    pub(super) number: usize,
    start: usize,
    end: usize,
}

impl Line {
    pub(super) fn place(&self) -> LinePosition {
        LinePosition { file: self.file, line: self.number, column: 1 }
    }
}

impl Sources {
    pub(super) fn text(&self, line: &Line) -> &str {
        &self.texts[line.file - self.first][line.start..line.end]
    }
}

/// All lines of the last file of the report up to `ENDDATA`, with what `INCLUDE` names in its place.
pub(super) fn read(text: &str, load: Load<'_>, report: &mut MeshReport) -> Sources {
    let first = report.files.len() - 1;
    let main = PathBuf::from(&report.files[first]);
    let mut reader = Reader {
        sources: Sources { texts: vec![text.to_owned()], first, lines: Vec::new() },
        taken: HashMap::from([(normal(&main), None)]),
        load,
        report,
        ended: false,
    };
    reader.file(first, &main, 0);
    reader.sources
}

struct Reader<'a, 'r> {
    sources: Sources,
    /// Every file, with the line that includes it; the main file has none.
    taken: HashMap<PathBuf, Option<LinePosition>>,
    load: Load<'a>,
    report: &'r mut MeshReport,
    ended: bool,
}

impl Reader<'_, '_> {
    fn file(&mut self, file: usize, path: &Path, depth: usize) {
        let lines = lines(&self.sources.texts[file - self.sources.first], file);
        let mut lines = lines.into_iter();
        while let Some(line) = lines.next() {
            let text = self.sources.text(&line);
            if is_command(text, "ENDDATA") {
                self.ended = true;
            } else if is_command(text, "INCLUDE") {
                let mut name = text.trim_start()[7..].trim().to_owned();
                // A name in quotation marks may go on in the next lines.
                while opens_quote(&name) {
                    let Some(next) = lines.next() else { break };
                    name.push_str(self.sources.text(&next).trim());
                }
                self.include(&name, line.place(), path, depth);
            } else {
                self.sources.lines.push(line);
            }
            if self.ended {
                return;
            }
        }
    }

    fn include(&mut self, written: &str, place: LinePosition, from: &Path, depth: usize) {
        let bare = written.trim_start_matches('=').trim();
        let quoted = bare.strip_prefix(['\'', '"']);
        let name = match quoted {
            Some(rest) => rest.split(['\'', '"']).next().unwrap_or_default(),
            None => bare.split('$').next().unwrap_or_default(),
        };
        let name = name.trim().replace('\\', "/");
        if name.is_empty() {
            self.report.error(place, "INCLUDE names no file", "write INCLUDE 'part.bdf'");
            return;
        }
        let path = from.parent().unwrap_or(Path::new("")).join(&name);
        if depth == DEEPEST {
            let what = format!("{name} is included {DEEPEST} files deep");
            self.report.error(place, what, "include it from a file further up");
            return;
        }
        if let Some(first) = self.taken.get(&normal(&path)) {
            let (what, help) = match first {
                Some(first) if first.file == place.file => (
                    format!("{name} is included twice"),
                    format!("take one out: line {} has the first", first.line),
                ),
                Some(first) => (
                    format!("{name} is included twice, or includes itself"),
                    format!(
                        "take one out: line {} of {} has the first",
                        first.line, self.report.files[first.file]
                    ),
                ),
                None => (
                    format!("{name} includes itself"),
                    "take the line out: files must not include each other in a circle".to_owned(),
                ),
            };
            self.report.error(place, what, help);
            return;
        }
        self.taken.insert(normal(&path), Some(place));
        match (self.load)(&path) {
            Ok(text) => {
                let file = self.report.files.len();
                self.sources.texts.push(text);
                self.report.files.push(path.display().to_string());
                self.file(file, &path, depth + 1);
            }
            Err(error) => {
                let what = format!("cannot read {}: {error}", path.display());
                let help = "the name counts from the folder of the file that includes it";
                self.report.error(place, what, help);
            }
        }
    }
}

fn lines(text: &str, file: usize) -> Vec<Line> {
    let mut start = 0;
    let mut lines = Vec::new();
    for (number, piece) in text.split_inclusive('\n').enumerate() {
        let end = start + piece.trim_end_matches(['\n', '\r']).len();
        lines.push(Line { file, number: number + 1, start, end });
        start += piece.len();
    }
    lines
}

/// Whether a line begins with this word, which nothing but a blank, a comma, a quotation mark or `=` may follow.
pub(super) fn is_command(line: &str, word: &str) -> bool {
    let line = line.trim_start();
    let head = line.get(..word.len());
    head.is_some_and(|head| head.eq_ignore_ascii_case(word))
        && line[word.len()..]
            .chars()
            .next()
            .is_none_or(|next| next.is_whitespace() || "'\"=,$".contains(next))
}

fn opens_quote(name: &str) -> bool {
    let name = name.trim_start_matches('=').trim_start();
    name.strip_prefix(['\'', '"']).is_some_and(|rest| !rest.contains(['\'', '"']))
}

/// Without `.` and `..`, so that a file has one name.
fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir
                if matches!(normal.components().next_back(), Some(Component::Normal(_))) =>
            {
                normal.pop();
            }
            _ => normal.push(part),
        }
    }
    normal
}
