//! Inputs that are nearly right: texts of the corpus cut, spliced, repeated and sown with words of the
//! language and of others.

use whirl_codegen::operation::Function;

use crate::random::Random;

/// Words of formulas, besides functions of one number, of spec files, and of neither.
const WORDS: &[&str] = &[
    "h",
    "h_dot",
    "theta",
    "eta",
    "eta_dot",
    "theta_dot",
    "theta_ddot",
    "xi",
    "zeta",
    "xi_a",
    "x",
    "v",
    "A",
    "S",
    "H",
    "u",
    "s",
    "det",
    "det0",
    "pi",
    "c0",
    "K",
    "Q",
    "+",
    "-",
    "*",
    "/",
    "^",
    "(",
    ")",
    ",",
    "<",
    "<=",
    ">",
    ">=",
    " and ",
    " or ",
    "not ",
    "sqrt(",
    "exp(",
    "log(",
    "sin(",
    "cos(",
    "tan(",
    "atan(",
    "sinh(",
    "cosh(",
    "tanh(",
    "abs(",
    "min(",
    "max(",
    "dot(",
    "outer(",
    "transpose(",
    "grad(",
    "div(",
    "eps(",
    "inner(",
    "trace(",
    "sum(",
    "atan2(",
    "0",
    "1",
    "2",
    "0.5",
    "1/2",
    "100",
    "101",
    "1e308",
    "1e-308",
    "1e999",
    "0.1",
    "3.0000000000000000001",
    "123456789012345678901234567890",
    "^2",
    "^-1",
    "^(1/2)",
    "^1.5",
    "^100",
    "^0",
    "1/0",
    "log(0)",
    "sqrt(-1)",
    "'",
    "\"",
    "'''",
    "\"\"\"",
    "\\",
    "\\u202e",
    "#",
    "=",
    "[",
    "]",
    "{",
    "}",
    "[[",
    "]]",
    ".",
    "\n",
    "\r",
    "\t",
    "\0",
    "\u{202e}",
    "\u{2028}",
    "é",
    "θ",
    "θ̇",
    "₀",
    "²",
    "×",
    "🦀",
    "//",
    "/*",
    "*/",
    "r#",
    "r\"",
    "unsafe",
    "fn",
    "type",
    "self",
    "crate",
    "::",
    "!",
    "panic!()",
    "#[doc]",
    "inf",
    "nan",
    "true",
    "false",
    "0x10",
    "1979-05-27",
    "kind",
    "name",
    "title",
    "source",
    "unit",
    "value",
    "pieces",
    "when",
    "engage",
    "jump",
    "smooth",
    "range",
    "inputs",
    "outputs",
    "parameters",
    "definitions",
    "tables",
    "file",
    "coordinates",
    "tensors",
    "mass",
    "PF",
    "B",
    "P",
    "quadratic_velocity",
    "kinetic_energy",
    "nodes",
    "shape",
    "quadrature",
    "rule",
    "degree",
    "points",
    "enhanced",
    "modes",
    "jacobian",
    "scale",
    "abaqus",
    "gmsh",
    "vtk",
    "order",
    "forms",
    "material",
    "matrices",
    "coefficients",
    "scalar",
    "vector",
    "matrix",
    "symmetric",
    "skew",
    "root",
    "accept",
    "mm",
    "m",
    "N",
    "m/s",
    "mm/s",
    "N/mm^1.5",
    "rad",
    "1",
    "Pa",
    "gauss(2)",
    "gauss(4)",
    "triangle(3)",
    "tetrahedron(4)",
    "hexahedron",
    "wedge",
    "pyramid",
    "tetrahedron",
    "centre",
    "point",
];

/// One of [`WORDS`], or a function of one number.
fn word(random: &mut Random) -> String {
    let place = random.below(WORDS.len() + Function::ALL.len());
    match WORDS.get(place) {
        Some(word) => (*word).to_owned(),
        None => format!("{}(", Function::ALL[place - WORDS.len()].name()),
    }
}

/// Longest input; limits of the readers are below it.
const LONGEST: usize = 40_000;

/// A text of `corpus` changed a few times.
pub(crate) fn mutant(corpus: &[String], random: &mut Random) -> String {
    let texts: Vec<&str> = corpus.iter().map(String::as_str).collect();
    let mut text = random.pick(&texts).to_owned();
    let changes = if random.once_in(2) { 1 } else { 1 + random.below(6) };
    for _ in 0..changes {
        text = changed(&text, &texts, random);
        cut(&mut text, LONGEST);
    }
    text
}

fn cut(text: &mut String, length: usize) {
    if text.len() > length {
        let end = (0..=length).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
        text.truncate(end);
    }
}

/// A place between characters.
fn place(text: &str, random: &mut Random) -> usize {
    let place = random.below(text.len() + 1);
    (0..=place).rev().find(|place| text.is_char_boundary(*place)).unwrap_or(0)
}

/// Two places in order, mostly near each other.
fn range(text: &str, random: &mut Random) -> (usize, usize) {
    let start = place(text, random);
    let longest = if random.once_in(4) { text.len() - start } else { 24.min(text.len() - start) };
    let end = start + random.below(longest + 1);
    let end = (start..=end).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(start);
    (start, end)
}

/// The first run of letters, digits, signs of one kind at or behind a place.
fn token(text: &str, random: &mut Random) -> (usize, usize) {
    let word = |c: char| c.is_alphanumeric() || c == '_';
    let from = place(text, random);
    let start = text[from..].find(|c: char| !c.is_whitespace()).map_or(text.len(), |at| from + at);
    let Some(first) = text[start..].chars().next() else { return (start, start) };
    let end = if word(first) {
        text[start..].find(|c| !word(c)).map_or(text.len(), |at| start + at)
    } else {
        start + first.len_utf8()
    };
    (start, end)
}

fn changed(text: &str, corpus: &[&str], random: &mut Random) -> String {
    let mut out = text.to_owned();
    match random.below(12) {
        0 => {
            let mut bytes = out.into_bytes();
            if !bytes.is_empty() {
                let at = random.below(bytes.len());
                bytes[at] ^= 1 << random.below(8);
            }
            out = String::from_utf8_lossy(&bytes).into_owned();
        }
        1 => {
            let (start, end) = range(&out, random);
            out.replace_range(start..end, "");
        }
        2 => {
            let (start, end) = range(&out, random);
            let piece = out[start..end].to_owned();
            let most = if random.once_in(8) { 200 } else { 3 };
            let times = 1 + random.below(most);
            let at = place(&out, random);
            out.insert_str(at, &piece.repeat(times.min(1 + LONGEST / (piece.len() + 1))));
        }
        3 | 4 => {
            let at = place(&out, random);
            out.insert_str(at, &word(random));
        }
        5 | 6 => {
            let (start, end) = token(&out, random);
            out.replace_range(start..end, &word(random));
        }
        7 => {
            let other = random.pick(corpus);
            let (start, end) = token(other, random);
            let piece = other[start..end].to_owned();
            let (start, end) = token(&out, random);
            out.replace_range(start..end, &piece);
        }
        8 => {
            let other = random.pick(corpus);
            let (from, at) = (place(other, random), place(&out, random));
            out = format!("{}{}", &out[..at], &other[from..]);
        }
        9 => {
            let (start, end) = token(&out, random);
            let wrap =
                random.pick(&["sin(", "(", "-(", "exp(", "abs(", "1/(", "2^(", "(h < 1) and ("]);
            let wrapped = format!("{wrap}{})", &out[start..end]);
            out.replace_range(start..end, &wrapped);
        }
        10 => {
            let mut lines: Vec<&str> = text.lines().collect();
            if lines.len() > 1 {
                let (a, b) = (random.below(lines.len()), random.below(lines.len()));
                match random.below(3) {
                    0 => lines.swap(a, b),
                    1 => lines.insert(a, lines[b]),
                    _ => {
                        lines.remove(a);
                    }
                }
            }
            out = lines.join("\n");
        }
        _ => {
            let (start, end) = token(&out, random);
            let number = format!("{}", random.next() as i64 >> random.below(64));
            let number = if random.once_in(2) { number } else { format!("{number}.{}", end) };
            out.replace_range(start..end, &number);
        }
    }
    out
}
