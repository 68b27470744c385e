//! Text → tokens.

use std::ops::Range;

use crate::rational::Rational;

use crate::diagnostic::{Code, Diagnostics, Located};
use crate::units::decimal;

/// What a token is.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Number(Rational),
    Name(String),
    /// `+ - * / ^ ( ) , < <= > >=`
    Sign(&'static str),
    End,
}

/// A token and its byte range.
pub(super) type Spanned = (Token, Range<usize>);

/// Longer signs first.
const SIGNS: &[(&str, &str)] = &[
    ("<=", "<="),
    (">=", ">="),
    ("≤", "<="),
    ("≥", ">="),
    ("<", "<"),
    (">", ">"),
    ("+", "+"),
    ("-", "-"),
    ("−", "-"),
    ("*", "*"),
    ("·", "*"),
    ("⋅", "*"),
    ("/", "/"),
    ("^", "^"),
    ("(", "("),
    (")", ")"),
    (",", ","),
];

/// Signs of other languages, and what to write instead. Longer ones first.
const FOREIGN: &[(&str, &str)] = &[
    ("**", "write `^` for a power"),
    ("²", "write `^2`"),
    ("³", "write `^3`"),
    ("×", "write `*` for a product"),
    ("÷", "write `/`"),
    ("√", "write `sqrt(…)`"),
    ("&&", "write `and`"),
    ("||", "write `or`"),
    ("!", "write `not`"),
    ("==", "numbers are compared with `<`, `<=`, `>` or `>=`"),
    ("=", "numbers are compared with `<`, `<=`, `>` or `>=`"),
    (";", "arguments are separated by `,`"),
    ("::", "a formula has names and functions, no paths"),
    ("[", "use `(` and `)`"),
    ("{", "use `(` and `)`"),
    (".", "write a digit before the point, as in `0.5`"),
];

const GREEK: &[(char, &str)] = &[
    ('α', "alpha"),
    ('β', "beta"),
    ('γ', "gamma"),
    ('δ', "delta"),
    ('ε', "eps"),
    ('ϵ', "eps"),
    ('ζ', "zeta"),
    ('η', "eta"),
    ('θ', "theta"),
    ('ϑ', "theta"),
    ('κ', "kappa"),
    ('λ', "lambda"),
    ('μ', "mu"),
    ('µ', "mu"),
    ('ν', "nu"),
    ('ξ', "xi"),
    ('π', "pi"),
    ('ρ', "rho"),
    ('σ', "sigma"),
    ('τ', "tau"),
    ('φ', "phi"),
    ('ϕ', "phi"),
    ('χ', "chi"),
    ('ψ', "psi"),
    ('ω', "omega"),
    ('Δ', "Delta"),
    ('Λ', "Lambda"),
    ('Σ', "Sigma"),
    ('Φ', "Phi"),
    ('Ψ', "Psi"),
    ('Ω', "Omega"),
];

/// Letters that carry a dot, or two, in one character.
const DOTTED: &[(char, &str)] = &[
    ('ė', "e_dot"),
    ('ḣ', "h_dot"),
    ('ṁ', "m_dot"),
    ('ṗ', "p_dot"),
    ('ṙ', "r_dot"),
    ('ẇ', "w_dot"),
    ('ẋ', "x_dot"),
    ('ẏ', "y_dot"),
    ('ż', "z_dot"),
    ('ẍ', "x_ddot"),
    ('ÿ', "y_ddot"),
];

fn letter(c: char) -> Option<&'static str> {
    let found = GREEK.iter().chain(DOTTED).find(|(letter, _)| *letter == c);
    found.map(|(_, ascii)| *ascii)
}

/// The name at the start of `text` in ASCII, and its length in bytes.
fn take_name(text: &str) -> Option<(String, usize)> {
    let first = text.chars().next()?;
    if !(first.is_ascii_alphabetic() || letter(first).is_some()) {
        return None;
    }
    let mut name = String::new();
    let mut length = 0;
    for c in text.chars() {
        match c {
            'a'..='z' | 'A'..='Z' | '0'..='9' | '_' => name.push(c),
            '₀'..='₉' => name.push(char::from(b'0' + (c as u32 - '₀' as u32) as u8)),
            '\u{307}' => name.push_str("_dot"),
            '\u{308}' => name.push_str("_ddot"),
            _ => match letter(c) {
                Some(ascii) => name.push_str(ascii),
                None => break,
            },
        }
        length += c.len_utf8();
    }
    Some((name, length))
}

/// The whole text as a name in ASCII.
pub(super) fn name(text: &str) -> Option<String> {
    take_name(text).filter(|(_, length)| *length == text.len()).map(|(name, _)| name)
}

/// The tokens of a formula; the last is [`Token::End`].
pub(super) fn tokens(formula: &Located) -> Result<Vec<Spanned>, Diagnostics> {
    let text = formula.text();
    let mut tokens = Vec::new();
    let mut errors = Diagnostics::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let first = rest.chars().next().unwrap_or(' ');
        let (token, length) = if first.is_whitespace() {
            (None, first.len_utf8())
        } else if let Some((value, length)) = decimal(rest) {
            if value.is_none() {
                let message = "this number is too large, too small or too long";
                let help =
                    "a number has at most 60 digits, and a power of ten between e-308 and e308";
                errors.push(formula.error(Code::LIMIT, at..at + length, message).help(help));
            }
            (value.map(Token::Number), length)
        } else if let Some((name, length)) = take_name(rest) {
            (Some(Token::Name(name)), length)
        } else if rest.starts_with("**") {
            (None, foreign(formula, at, &mut errors))
        } else if let Some((sign, plain)) = SIGNS.iter().find(|(sign, _)| rest.starts_with(sign)) {
            (Some(Token::Sign(plain)), sign.len())
        } else {
            (None, foreign(formula, at, &mut errors))
        };
        tokens.extend(token.map(|token| (token, at..at + length)));
        at += length;
    }
    tokens.push((Token::End, text.len()..text.len()));
    errors.into_result(tokens)
}

/// Reports a sign that the language does not have; its length.
fn foreign(formula: &Located, at: usize, errors: &mut Diagnostics) -> usize {
    let rest = &formula.text()[at..];
    let known = FOREIGN.iter().find(|(sign, _)| rest.starts_with(sign));
    let first = rest.chars().next().map_or(1, char::len_utf8);
    let length = known.map_or(first, |(sign, _)| sign.len());
    let sign = rest[..length].escape_debug();
    let error = formula.error(Code::SYNTAX, at..at + length, format!("unexpected `{sign}`"));
    errors.push(error.maybe_help(known.map(|(_, help)| (*help).to_owned())));
    length
}
