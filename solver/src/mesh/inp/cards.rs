//! The text of an input file as cards: a keyword line with parameters, and its lines of data.

use super::piece::Piece;

/// A piece of a line with its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Token<'a> {
    /// Without blanks around it.
    pub(super) text: &'a str,
    /// The file, as the report numbers them.
    pub(super) file: usize,
    /// From 1.
    pub(super) line: usize,
    /// In characters, from 1.
    pub(super) column: usize,
}

/// `NAME=value` or `NAME` on a keyword line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Parameter<'a> {
    /// In capitals.
    pub(super) name: String,
    /// Where it stands.
    pub(super) place: Token<'a>,
    /// Without quotation marks.
    pub(super) value: Option<Token<'a>>,
}

/// A keyword line (with its continuations) and the data below it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Card<'a> {
    /// In capitals, without the asterisk, single blanks between words; empty for data before the first
    /// keyword.
    pub(super) keyword: String,
    /// Where the keyword stands.
    pub(super) place: Token<'a>,
    /// Parameters in order.
    pub(super) parameters: Vec<Parameter<'a>>,
    /// Data lines as tokens; the empty token after a comma at the end of a line is left out.
    pub(super) lines: Vec<Vec<Token<'a>>>,
    /// Which of these lines end with a comma.
    pub(super) open: Vec<bool>,
    /// Whose nodes and sets it names.
    pub(super) owner: Owner,
}

/// Whose labels a card has: those of nodes of the assembly are not those of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Owner {
    /// The part that is read, or a file without parts.
    Part,
    /// The assembly, beside its instances.
    Assembly,
    /// An instance without solid elements, by its number.
    Points(usize),
}

impl<'a> Card<'a> {
    fn new(keyword: String, place: Token<'a>, parameters: Vec<Parameter<'a>>) -> Card<'a> {
        let (lines, open) = (Vec::new(), Vec::new());
        Card { keyword, place, parameters, lines, open, owner: Owner::Part }
    }

    /// The parameter called `name` (in capitals).
    pub(super) fn parameter(&self, name: &str) -> Option<&Parameter<'a>> {
        self.parameters.iter().find(|parameter| parameter.name == name)
    }

    /// The value of a parameter.
    pub(super) fn value(&self, name: &str) -> Option<Token<'a>> {
        self.parameter(name)?.value
    }
}

/// Splits pieces of text into cards, which may go on from one piece to the next. Comments (`**`) and blank lines
/// are dropped.
pub(super) fn cards(pieces: &[Piece]) -> Vec<Card<'_>> {
    let mut cards: Vec<Card> = Vec::new();
    let mut continued = false;
    let lines = pieces.iter().flat_map(|piece| {
        let numbered = piece.text().lines().enumerate();
        numbered.map(move |(after, line)| (piece.file, piece.first_line + after, line))
    });
    for (file, number, line) in lines {
        let trimmed = line.trim();
        if trimmed.is_empty() || trimmed.starts_with("**") {
            continue;
        }
        let mut tokens = tokens(line, file, number);
        let open = tokens.last().is_some_and(|token| token.text.is_empty());
        if open {
            tokens.pop();
        }
        if continued {
            if let Some(card) = cards.last_mut() {
                card.parameters.extend(tokens.into_iter().map(parameter));
            }
            continued = open;
        } else if trimmed.starts_with('*') {
            let mut tokens = tokens.into_iter();
            let place = tokens.next().unwrap_or(Token { text: "*", file, line: number, column: 1 });
            let words = place.text.trim_start_matches('*').to_uppercase();
            let keyword = words.split_whitespace().collect::<Vec<_>>().join(" ");
            cards.push(Card::new(keyword, place, tokens.map(parameter).collect()));
            continued = open;
        } else {
            if cards.is_empty() {
                let place = Token { text: "", file, line: number, column: 1 };
                cards.push(Card::new(String::new(), place, Vec::new()));
            }
            if let Some(card) = cards.last_mut() {
                card.lines.push(tokens.into_iter().map(unquoted).collect());
                card.open.push(open);
            }
        }
    }
    cards
}

/// Pieces between the commas of a line; commas between quotation marks do not count.
pub(super) fn tokens(line: &str, file: usize, number: usize) -> Vec<Token<'_>> {
    let mut tokens = Vec::new();
    let (mut start, mut column, mut quoted) = (0, 1, false);
    let mut start_column = 1;
    let mut push = |from: usize, to: usize, column: usize| {
        let piece = &line[from..to];
        let blanks = piece.chars().take_while(|c| c.is_whitespace()).count();
        tokens.push(Token { text: piece.trim(), file, line: number, column: column + blanks });
    };
    for (at, c) in line.char_indices() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => {
                push(start, at, start_column);
                (start, start_column) = (at + 1, column + 1);
            }
            _ => {}
        }
        column += 1;
    }
    push(start, line.len(), start_column);
    tokens
}

pub(super) fn parameter(token: Token<'_>) -> Parameter<'_> {
    let Some((name, value)) = token.text.split_once('=') else {
        let words: Vec<&str> = token.text.split_whitespace().collect();
        return Parameter { name: words.join(" ").to_uppercase(), place: token, value: None };
    };
    let blanks = value.chars().take_while(|c| c.is_whitespace()).count();
    let column = token.column + name.chars().count() + 1 + blanks;
    let words: Vec<&str> = name.split_whitespace().collect();
    Parameter {
        name: words.join(" ").to_uppercase(),
        place: token,
        value: Some(unquoted(Token { text: value.trim(), column, ..token })),
    }
}

/// Without the quotation marks around a name; a name of an instance and one of a set may have their own.
fn unquoted(token: Token<'_>) -> Token<'_> {
    let inner = token.text.strip_prefix('"').and_then(|text| text.strip_suffix('"'));
    let inner = inner.filter(|inner| !inner.contains('"'));
    Token { text: inner.map_or(token.text, str::trim), ..token }
}

#[cfg(test)]
mod tests {
    use super::super::super::raw::MeshReport;
    use super::super::include::pieces;
    use super::*;

    #[test]
    fn keyword_lines_continue_and_data_keeps_its_place() {
        let text = "** comment\n*Solid   section, elset=\"A, B\",\n  MATERIAL = Steel\n 1.0,\n\n  2, é, 3\n";
        let pieces = pieces(text, "a.inp", &mut MeshReport::new("a.inp"));
        let cards = cards(&pieces);
        assert_eq!(cards.len(), 1);
        let card = &cards[0];
        assert_eq!(card.keyword, "SOLID SECTION");
        assert_eq!(card.parameter("ELSET").unwrap().value.unwrap().text, "A, B");
        let material = card.parameter("MATERIAL").unwrap().value.unwrap();
        assert_eq!((material.text, material.line, material.column), ("Steel", 3, 14));
        assert_eq!(card.lines[0], [Token { text: "1.0", file: 0, line: 4, column: 2 }]);
        let last = card.lines[1][2];
        assert_eq!((last.text, last.line, last.column), ("3", 6, 9));
    }

    #[test]
    fn data_before_any_keyword_is_kept() {
        let pieces = pieces("1, 2\n", "a.inp", &mut MeshReport::new("a.inp"));
        assert_eq!(cards(&pieces)[0].keyword, "");
    }
}
