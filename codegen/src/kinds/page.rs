//! A page of text for the terminal: headings, lines, and columns that line up.

/// Characters after which running text is broken.
const WIDTH: usize = 100;

/// Text being written.
#[derive(Debug)]
pub struct Page {
    text: String,
}

impl Page {
    /// A page that begins with a line.
    pub fn new(first: &str) -> Self {
        Page { text: format!("{first}\n") }
    }

    /// All that was written.
    pub fn text(self) -> String {
        self.text
    }

    /// A heading after an empty line.
    pub fn heading(&mut self, heading: &str) {
        self.text.push('\n');
        self.line(heading);
    }

    /// A line at the margin.
    pub fn line(&mut self, line: &str) {
        self.text.push_str(line.trim_end());
        self.text.push('\n');
    }

    /// A line below a heading; equations are not broken, so that they can be copied.
    pub fn item(&mut self, item: &str) {
        self.line(&format!("  {item}"));
    }

    /// Lines below a heading, their columns filled up to the same widths, the last as it is.
    pub fn columns(&mut self, rows: &[Vec<String>]) {
        let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            // The last cell of a row reaches as far as it likes.
            let cells = rows.iter().filter(|row| row.len() > column + 1);
            cells.map(|row| row[column].chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for row in rows {
            // A column that is empty everywhere takes no width.
            let cells = row.iter().zip(&widths).enumerate();
            let cells = cells.filter(|(place, (_, width))| **width > 0 || place + 1 == row.len());
            let cells = cells.map(|(_, (cell, width))| format!("{cell:<width$}"));
            self.item(&cells.collect::<Vec<_>>().join("  "));
        }
    }

    /// Running text below a heading, broken between words.
    pub fn paragraph(&mut self, indent: usize, text: &str) {
        let margin = " ".repeat(indent);
        let mut line = margin.clone();
        for word in text.split_whitespace() {
            let full = line.chars().count() + 1 + word.chars().count() > WIDTH;
            if full && line.len() > margin.len() {
                self.line(&line);
                line.clone_from(&margin);
            }
            if line.len() > margin.len() {
                line.push(' ');
            }
            line.push_str(word);
        }
        self.line(&line);
    }
}

/// A count with its noun.
pub(crate) fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_and_paragraphs_break() {
        let mut page = Page::new("title");
        let row = |cells: &[&str]| cells.iter().map(|cell| (*cell).to_string()).collect();
        page.columns(&[row(&["a", "bb", "c"]), row(&["aaa", "b", "long"]), row(&["whole line"])]);
        page.paragraph(4, &"word ".repeat(30));
        let text = page.text();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines[1], "  a    bb  c");
        assert_eq!(lines[2], "  aaa  b   long");
        assert_eq!(lines[3], "  whole line");
        assert!(lines[4].starts_with("    word word") && lines[4].len() <= WIDTH);
        assert_eq!(lines.len(), 6);
    }
}
