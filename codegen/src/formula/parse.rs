//! Tokens → terms, by recursive descent.

use std::ops::Range;

use super::token::{Spanned, Token, tokens};
use super::{Comparison, Formula, LIMITS, SUM, Side, Term, TermKind};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located};

/// Reads a formula or a condition.
///
/// # Errors
/// Every sign that the language does not have, or else the first place where the grammar fails (what
/// follows it could only be guessed).
pub fn parse(text: &Located) -> Result<Formula, Diagnostics> {
    if text.text().len() > LIMITS.length {
        let message = format!("this formula is longer than {} bytes", LIMITS.length);
        let error = text.error(Code::LIMIT, 0..1, message);
        return Err(error.help("split it into pieces or parameters").into());
    }
    let tokens = tokens(text)?;
    let mut parser = Parser { text, tokens: &tokens, next: 0, depth: 0 };
    let root = parser.condition().and_then(|root| parser.end().map(|()| root));
    root.map(|root| Formula { text: text.clone(), root }).map_err(|error| Diagnostics::from(*error))
}

struct Parser<'t> {
    text: &'t Located,
    tokens: &'t [Spanned],
    next: usize,
    depth: usize,
}

type Parsed = Result<Term, Box<Diagnostic>>;

impl Parser<'_> {
    fn peek(&self) -> &Token {
        &self.tokens[self.next].0
    }

    fn span(&self) -> Range<usize> {
        self.tokens[self.next].1.clone()
    }

    fn advance(&mut self) {
        self.next = (self.next + 1).min(self.tokens.len() - 1);
    }

    fn accept(&mut self, sign: &str) -> bool {
        let found = matches!(self.peek(), Token::Sign(s) if *s == sign);
        if found {
            self.advance();
        }
        found
    }

    fn accept_word(&mut self, word: &str) -> bool {
        let found = matches!(self.peek(), Token::Name(name) if name == word);
        if found {
            self.advance();
        }
        found
    }

    fn error(&self, code: Code, span: Range<usize>, message: impl Into<String>) -> Box<Diagnostic> {
        Box::new(self.text.error(code, span, message))
    }

    /// What stands at the next place, for messages.
    fn found(&self) -> String {
        match self.peek() {
            Token::End => "the end of the formula".to_owned(),
            _ => format!("`{}`", &self.text.text()[self.span()]),
        }
    }

    fn deeper(&mut self, inner: impl FnOnce(&mut Self) -> Parsed) -> Parsed {
        if self.depth == LIMITS.depth {
            let message = format!("this formula is nested more than {} deep", LIMITS.depth);
            return Err(self.error(Code::LIMIT, self.span(), message));
        }
        self.depth += 1;
        let term = inner(self);
        self.depth -= 1;
        term
    }

    fn end(&self) -> Result<(), Box<Diagnostic>> {
        let help = match self.peek() {
            Token::End => return Ok(()),
            Token::Sign(")") => "this `)` has no `(`",
            Token::Sign(",") => "`,` stands between arguments of a function only",
            _ => "an operator is missing before it, such as `*`",
        };
        let message = format!("unexpected {}", self.found());
        let error = self.error(Code::SYNTAX, self.span(), message);
        Err(Box::new(error.help(help)))
    }

    fn condition(&mut self) -> Parsed {
        self.chain("or", Self::conjunction, TermKind::Or)
    }

    fn conjunction(&mut self) -> Parsed {
        self.chain("and", Self::negation, TermKind::And)
    }

    fn negation(&mut self) -> Parsed {
        let start = self.span().start;
        if !self.accept_word("not") {
            return self.comparison();
        }
        let inner = self.deeper(Self::negation)?;
        let span = self.whole(start..inner.span.end);
        Ok(Term { kind: TermKind::Not(Box::new(inner)), span })
    }

    fn comparison(&mut self) -> Parsed {
        let first = self.sum()?;
        let mut rest = Vec::new();
        loop {
            let comparison = match self.peek() {
                Token::Sign("<") => Comparison::Less,
                Token::Sign("<=") => Comparison::LessOrEqual,
                Token::Sign(">") => Comparison::Greater,
                Token::Sign(">=") => Comparison::GreaterOrEqual,
                _ => break,
            };
            self.advance();
            rest.push((comparison, self.sum()?));
        }
        let Some((_, last)) = rest.last() else {
            return Ok(first);
        };
        let span = first.span.start..last.span.end;
        Ok(Term { kind: TermKind::Compare(Box::new(first), rest), span })
    }

    fn sum(&mut self) -> Parsed {
        self.sided(["+", "-"], Self::product, TermKind::Sum)
    }

    fn product(&mut self) -> Parsed {
        self.sided(["*", "/"], Self::unary, TermKind::Product)
    }

    fn unary(&mut self) -> Parsed {
        let start = self.span().start;
        if self.accept("+") {
            return self.deeper(Self::unary);
        }
        if !self.accept("-") {
            return self.power();
        }
        let inner = self.deeper(Self::unary)?;
        let span = self.whole(start..inner.span.end);
        Ok(Term { kind: TermKind::Negate(Box::new(inner)), span })
    }

    fn power(&mut self) -> Parsed {
        let base = self.atom()?;
        if !self.accept("^") {
            return Ok(base);
        }
        let exponent = self.deeper(Self::unary)?;
        let span = self.whole(base.span.start..exponent.span.end);
        Ok(Term { kind: TermKind::Power(Box::new(base), Box::new(exponent)), span })
    }

    fn atom(&mut self) -> Parsed {
        let span = self.span();
        match self.peek().clone() {
            Token::Number(value) => {
                self.advance();
                Ok(Term { kind: TermKind::Number(value), span })
            }
            Token::Name(word) if matches!(word.as_str(), "and" | "or" | "not") => {
                let message = format!("expected a number, a name or `(`, found `{word}`");
                Err(self.error(Code::SYNTAX, span, message))
            }
            Token::Name(name) => {
                self.advance();
                match self.peek() {
                    Token::Sign("(") => self.deeper(|parser| parser.call(name, span)),
                    _ => Ok(Term { kind: TermKind::Name(name), span }),
                }
            }
            Token::Sign("(") => self.deeper(Self::parenthesis),
            _ => {
                let message = format!("expected a number, a name or `(`, found {}", self.found());
                Err(self.error(Code::SYNTAX, span, message))
            }
        }
    }

    fn parenthesis(&mut self) -> Parsed {
        let open = self.span();
        self.advance();
        let inner = self.condition()?;
        self.close(&open)?;
        Ok(inner)
    }

    /// The `)` that belongs to the `(` at `open`.
    fn close(&mut self, open: &Range<usize>) -> Result<(), Box<Diagnostic>> {
        if self.accept(")") {
            return Ok(());
        }
        if *self.peek() == Token::End {
            let error = self.error(Code::SYNTAX, open.clone(), "this `(` is not closed");
            return Err(Box::new(error.help("write `)` where it ends")));
        }
        let message = format!("expected an operator or `)`, found {}", self.found());
        Err(self.error(Code::SYNTAX, self.span(), message))
    }

    fn call(&mut self, function: String, name: Range<usize>) -> Parsed {
        let open = self.span();
        self.advance();
        let mut arguments = Vec::new();
        if !matches!(self.peek(), Token::Sign(")")) {
            arguments.push(self.condition()?);
            while self.accept(",") {
                arguments.push(self.condition()?);
            }
        }
        let end = self.span().end;
        self.close(&open)?;
        let span = name.start..end;
        if function == SUM {
            return self.series(span, arguments);
        }
        Ok(Term { kind: TermKind::Call { function, name, arguments }, span })
    }

    /// `sum(j, first, last, body)`
    fn series(&self, span: Range<usize>, arguments: Vec<Term>) -> Parsed {
        let help = "write `sum(j, 0, 8, …)` with a counter of your own name";
        let count = arguments.len();
        let Ok([counter, first, last, body]) = <[Term; 4]>::try_from(arguments) else {
            let message = format!("`{SUM}` takes 4 arguments, not {count}");
            return Err(Box::new(self.error(Code::BAD_CALL, span, message).help(help)));
        };
        let TermKind::Name(name) = counter.kind else {
            let message = "expected the name of a counter";
            return Err(Box::new(self.error(Code::SYNTAX, counter.span, message).help(help)));
        };
        let ends = Box::new([first, last]);
        let kind =
            TermKind::Series { counter: name, name: counter.span, ends, body: Box::new(body) };
        Ok(Term { kind, span })
    }

    /// Parts with a word between them; a part alone is itself.
    fn chain(
        &mut self,
        word: &str,
        part: fn(&mut Self) -> Parsed,
        kind: fn(Vec<Term>) -> TermKind,
    ) -> Parsed {
        let first = part(self)?;
        let mut parts = vec![first];
        while self.accept_word(word) {
            parts.push(part(self)?);
        }
        if parts.len() == 1 {
            return Ok(parts.remove(0));
        }
        let span = self.whole(parts[0].span.start..parts[parts.len() - 1].span.end);
        Ok(Term { kind: kind(parts), span })
    }

    /// Parts with one of two signs between them; a part alone is itself.
    fn sided(
        &mut self,
        [with, against]: [&str; 2],
        part: fn(&mut Self) -> Parsed,
        kind: fn(Vec<(Side, Term)>) -> TermKind,
    ) -> Parsed {
        let mut parts = vec![(Side::With, part(self)?)];
        loop {
            let side = if self.accept(with) {
                Side::With
            } else if self.accept(against) {
                Side::Against
            } else {
                break;
            };
            parts.push((side, part(self)?));
        }
        if parts.len() == 1 {
            return Ok(parts.remove(0).1);
        }
        let span = self.whole(parts[0].1.span.start..parts[parts.len() - 1].1.span.end);
        Ok(Term { kind: kind(parts), span })
    }

    /// The place of a term from its first part to its last, with the parentheses around either: `(a + b)*c`
    /// begins before `a`, whose own place is within them.
    fn whole(&self, span: Range<usize>) -> Range<usize> {
        let text = self.text.text();
        let Range { mut start, mut end } = span;
        let (mut open, mut unopened) = (0_usize, 0);
        for c in text[start..end].chars() {
            match c {
                '(' => open += 1,
                ')' if open > 0 => open -= 1,
                ')' => unopened += 1,
                _ => {}
            }
        }
        // Between a part and its parentheses stand only blanks and others of its parentheses.
        for _ in 0..unopened {
            start = text[..start].rfind('(').unwrap_or(start);
        }
        for _ in 0..open {
            end = text[end..].find(')').map_or(end, |place| end + place + 1);
        }
        start..end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        let error = parse(&Located::alone("formula", text)).unwrap_err();
        error.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn syntax_errors_point_at_the_place() {
        let expected = [
            ("", "formula:1:1: expected a number, a name or `(`, found the end of the formula"),
            ("1 +", "formula:1:4: expected a number, a name or `(`, found the end of the formula"),
            ("2 h", "formula:1:3: unexpected `h` (an operator is missing before it, such as `*`)"),
            ("2h", "formula:1:2: unexpected `h` (an operator is missing before it, such as `*`)"),
            ("(1 + h", "formula:1:1: this `(` is not closed (write `)` where it ends)"),
            ("(1 h)", "formula:1:4: expected an operator or `)`, found `h`"),
            ("1 + h)", "formula:1:6: unexpected `)` (this `)` has no `(`)"),
            (
                "1, 2",
                "formula:1:2: unexpected `,` (`,` stands between arguments of a function only)",
            ),
            ("sin(h,)", "formula:1:7: expected a number, a name or `(`, found `)`"),
            (
                "h and",
                "formula:1:6: expected a number, a name or `(`, found the end of the formula",
            ),
            ("h * and", "formula:1:5: expected a number, a name or `(`, found `and`"),
            ("h**2", "formula:1:2: unexpected `**` (write `^` for a power)"),
            (
                "h² × 2",
                "formula:1:2: unexpected `²` (write `^2`)\nformula:1:4: unexpected `×` (write `*` for a product)",
            ),
            (
                "h == 2",
                "formula:1:3: unexpected `==` (numbers are compared with `<`, `<=`, `>` or `>=`)",
            ),
            (".5*h", "formula:1:1: unexpected `.` (write a digit before the point, as in `0.5`)"),
            ("h; drop", "formula:1:2: unexpected `;` (arguments are separated by `,`)"),
            (
                "std::h",
                "formula:1:4: unexpected `::` (a formula has names and functions, no paths)",
            ),
            ("\u{0}", "formula:1:1: unexpected `\\0`"),
            (
                "1e999",
                "formula:1:1: this number is too large, too small or too long (a number has at most 60 \
                 digits, and a power of ten between e-308 and e308)",
            ),
        ];
        for (text, expected) in expected {
            assert_eq!(message(text), expected, "{text}");
        }
    }

    #[test]
    fn depth_and_length_are_bounded() {
        let deep = "(".repeat(10_000);
        assert!(message(&deep[..1000]).contains("nested more than 64 deep"));
        assert!(message(&deep).contains("longer than 8192 bytes"));
        assert!(message(&"-".repeat(5000)).contains("nested more than 64 deep"));
        assert!(message(&"2^".repeat(3000)).contains("nested more than 64 deep"));
        assert!(message(&"not ".repeat(2000)).contains("nested more than 64 deep"));
        assert!(message(&"f(".repeat(2000)).contains("nested more than 64 deep"));
        assert!(parse(&Located::alone("formula", &format!("h{}", "+h".repeat(4000)))).is_ok());
    }

    #[test]
    fn spans_are_bytes_of_the_text() {
        let formula = parse(&Located::alone("formula", "θ + sin(2*ξ)")).unwrap();
        let TermKind::Sum(parts) = &formula.root.kind else { panic!("a sum") };
        assert_eq!(parts[1].1.span, 5..14);
        let names: Vec<_> = formula.names().into_iter().collect();
        assert_eq!(names, [("theta", 0..2), ("xi", 11..13)]);
        // What is joined has its parentheses, also where they are doubled.
        for (text, joined) in [
            ("a - b*(c - d)", "b*(c - d)"),
            ("1 + (( a)*b )*c", "(( a)*b )*c"),
            ("1 + (a*b)^2", "(a*b)^2"),
        ] {
            let formula = parse(&Located::alone("formula", text)).unwrap();
            let TermKind::Sum(parts) = &formula.root.kind else { panic!("a sum") };
            assert_eq!(&text[parts[1].1.span.clone()], joined);
        }
    }
}
