//! What is wrong with a file before it is parsed.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostic, Source};

/// Most bytes of a file, and most names joined by dots in a key: each opens a table in a table.
const LONGEST: usize = 256 * 1024;
const MOST_JOINED: usize = 64;

/// A file that is too long, or keys whose tables would fill the memory.
pub(super) fn beyond_limits(source: &Arc<Source>) -> Option<Diagnostic> {
    if source.text.len() > LONGEST {
        let message = format!("a file is at most {LONGEST} bytes long");
        return Some(Diagnostic::new(source, Code::LIMIT, None, message));
    }
    let place = deep_key(&source.text)?;
    let message = format!("this key joins more than {MOST_JOINED} names by dots");
    Some(Diagnostic::new(source, Code::LIMIT, place..place + 1, message))
}

/// Where a key joins too many names: dots between names with nothing else between them but blanks.
fn deep_key(text: &str) -> Option<usize> {
    let (mut dots, mut quote) = (0, None);
    for (place, c) in text.char_indices() {
        match (quote, c) {
            (Some(_), '\n') => (dots, quote) = (0, None),
            (Some(open), c) if c == open => quote = None,
            (Some(_), _) => {}
            (None, '"' | '\'') => quote = Some(c),
            (None, '.') => dots += 1,
            (None, ' ' | '\t' | '_' | '-') => {}
            (None, c) if c.is_ascii_alphanumeric() => {}
            (None, _) => dots = 0,
        }
        if dots > MOST_JOINED {
            return Some(place);
        }
    }
    None
}
