//! Diagnostics as text for people.

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};

use super::Diagnostic;
use super::source::floor_boundary;

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
