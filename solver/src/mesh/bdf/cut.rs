//! A line of bulk data cut into fields, of columns or between commas.

/// A line with its name cut off.
pub(super) struct Cut<'a> {
    pub(super) name: &'a str,
    /// Of the name.
    pub(super) column: usize,
    text: &'a str,
    pub(super) free: bool,
    pub(super) wide: bool,
}

impl<'a> Cut<'a> {
    pub(super) fn new(text: &'a str) -> Cut<'a> {
        let free = text.contains(',');
        let (name, column) = match free {
            true => trimmed(text.split(',').next().unwrap_or_default(), 1),
            false => Columns::new(text, 8, 8).next().unwrap_or(("", 1)),
        };
        let wide = name.starts_with('*') || name.ends_with('*');
        Cut { name, column, text, free, wide }
    }

    pub(super) fn continues(&self) -> bool {
        self.name.is_empty() || self.name.starts_with(['+', '*'])
    }

    /// The mark of the continuation that the line asks for, in its last field.
    pub(super) fn asks(&self) -> &'a str {
        let width = if self.wide { 4 } else { 8 };
        let mark = self.pieces().nth(width).map_or("", |(piece, _)| piece);
        if self.free && !mark.starts_with(['+', '*']) { "" } else { mark }
    }

    /// What stands behind the name, with columns.
    pub(super) fn pieces(&self) -> Box<dyn Iterator<Item = (&'a str, usize)> + 'a> {
        if self.free {
            let mut column = 1;
            return Box::new(
                self.text
                    .split(',')
                    .map(move |piece| {
                        let own = trimmed(piece, column);
                        column += piece.chars().count() + 1;
                        own
                    })
                    .skip(1),
            );
        }
        let width = if self.wide { 16 } else { 8 };
        let most = if self.wide { 6 } else { 10 };
        Box::new(Columns::new(self.text, 8, width).take(most).skip(1))
    }
}

/// Without blanks around it, and the column of the rest.
fn trimmed(piece: &str, column: usize) -> (&str, usize) {
    let start = piece.trim_start();
    let blanks = piece[..piece.len() - start.len()].chars().count();
    (start.trim_end(), column + blanks)
}

/// Pieces of so many columns; a tab goes to the next multiple of eight.
struct Columns<'a> {
    text: &'a str,
    width: usize,
    next_width: usize,
    at: usize,
    /// In characters from 0, and as printed.
    character: usize,
    column: usize,
    end: usize,
}

impl<'a> Columns<'a> {
    fn new(text: &'a str, width: usize, next_width: usize) -> Columns<'a> {
        Columns { text, width, next_width, at: 0, character: 0, column: 0, end: 0 }
    }
}

impl<'a> Iterator for Columns<'a> {
    type Item = (&'a str, usize);

    fn next(&mut self) -> Option<(&'a str, usize)> {
        if self.at >= self.text.len() {
            return None;
        }
        self.end += self.width;
        self.width = self.next_width;
        let (from, first) = (self.at, self.character);
        for c in self.text[from..].chars() {
            if self.column >= self.end {
                break;
            }
            self.column = if c == '\t' { (self.column / 8 + 1) * 8 } else { self.column + 1 };
            self.at += c.len_utf8();
            self.character += 1;
        }
        Some(trimmed(&self.text[from..self.at], first + 1))
    }
}
