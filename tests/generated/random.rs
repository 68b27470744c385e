//! 500 random expressions with their derivatives, emitted into one crate, compiled once and run: the same
//! bits as the tape, and the values of direct evaluation.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::Located;
use whirl_codegen::emit::{Numbers, operand, statements};
use whirl_codegen::expression::{Graph, Id, Relation};
use whirl_codegen::formula::{Formula, Value, evaluate, lower, parse};
use whirl_codegen::operation::Rounded;
use whirl_codegen::schedule::{Program, Request, schedule};
use whirl_codegen::tape::Tape;

const EXPRESSIONS: usize = 500;
const POINTS: usize = 24;
const DEPTH: usize = 5;

/// Numbers that are the same on every run (splitmix64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
}

/// Text of a formula in x and y that has a value for all real x and y.
fn formula(random: &mut Random, depth: usize) -> String {
    if depth == 0 {
        return match random.below(4) {
            0 | 1 => "x".to_owned(),
            2 => "y".to_owned(),
            _ => format!("{}.{}", random.below(9), random.below(999)),
        };
    }
    let kind = random.below(16);
    let mut part = || formula(random, depth - 1);
    match kind {
        0 | 1 => format!("({} + {})", part(), part()),
        2 => format!("({} - {})", part(), part()),
        3 | 4 => format!("{}*{}", part(), part()),
        5 => format!("{}/(2 + ({})^2)", part(), part()),
        6 => format!("-({})", part()),
        7 => format!("({})^2 + 3*({})^4", part(), part()),
        8 => format!("(1 + ({})^2)^(3/2)", part()),
        9 => format!("(2 + sin({}))^(-1/2)", part()),
        10 => format!("(2 + cos({}))^0.3", part()),
        11 => format!("sin({})*cos({})", part(), part()),
        12 => format!("atan({}) + tanh({})", part(), part()),
        13 => format!("exp(tanh({})) + log(1 + ({})^2)", part(), part()),
        14 => format!("max({}, {})", part(), part()),
        _ => format!("min(abs({}), {})", part(), part()),
    }
}

/// An expression: `f` where a < b, else `g`.
struct Case {
    a: Formula,
    b: Formula,
    f: Formula,
    g: Formula,
    program: Program,
}

impl Case {
    fn new(random: &mut Random) -> Self {
        let mut text = |depth| {
            let text = formula(random, depth);
            parse(&Located::alone("random", &text)).unwrap_or_else(|e| panic!("{text}: {e}"))
        };
        let (a, b, f, g) = (text(2), text(2), text(DEPTH), text(DEPTH));
        let mut graph = Graph::new();
        let (x, y) = (graph.scalar("x"), graph.scalar("y"));
        let names = BTreeMap::from([("x".to_owned(), x), ("y".to_owned(), y)]);
        let mut ids: Vec<Id> = Vec::new();
        for formula in [&a, &b, &f, &g] {
            ids.push(lower(formula, &mut graph, &names).expect("it lowers"));
        }
        let mask = graph.compare(Relation::Less, ids[0], ids[1]);
        let value = graph.select(mask, ids[2], ids[3]);
        let by_x = graph.differentiate(value, x).expect("a derivative");
        let by_y = graph.differentiate(value, y).expect("a derivative");
        let outputs = [("value", value), ("by_x", by_x), ("by_y", by_y)];
        let request = Request::flat(&[("x", x), ("y", y)], &outputs);
        let program = schedule(&mut graph, &request).expect("a program");
        Case { a, b, f, g, program }
    }

    /// Direct evaluation; `None` where rounding could take the other branch.
    fn direct(&self, x: f64, y: f64) -> Option<Rounded> {
        let names: BTreeMap<String, Value<Rounded>> = [("x", x), ("y", y)]
            .map(|(name, value)| (name.to_owned(), Value::Scalar(Rounded::new(value))))
            .into();
        let of = |formula: &Formula| evaluate(formula, &names).expect("a value").scalar();
        let (a, b) = (of(&self.a)?, of(&self.b)?);
        let gap = (a.value - b.value).abs();
        let close = gap <= 8.0 * (a.error + b.error);
        if close { None } else { of(if a.value < b.value { &self.f } else { &self.g }) }
    }
}

fn function(place: usize, program: &Program) -> String {
    let statements = statements(program, 0, Numbers::Lanes);
    let outputs = program.outputs.iter().map(|o| operand(program, o.operand, Numbers::Lanes));
    let outputs: Vec<String> = outputs.map(|output| output.to_string()).collect();
    let lines: String = statements.iter().map(|statement| format!("    {statement}\n")).collect();
    format!(
        "fn case{place}<L: Lane>(x: L, y: L) -> [L; 3] {{\n{lines}    [{}]\n}}\n",
        outputs.join(", ")
    )
}

/// Source of a program that prints the bits of all outputs, one line a case and point.
fn source(cases: &[Case], points: &[[f64; 2]]) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../specs/src");
    let mut text = String::from("#![allow(unused, non_snake_case)]\n");
    for module in
        ["columns", "lane", "number", "register", "registers", "sine", "vector", "wide", "x86"]
    {
        let path = root.join(module).with_extension("rs");
        let here = if module == "x86" { "#[cfg(target_arch = \"x86_64\")]\n" } else { "" };
        writeln!(text, "{here}#[path = {path:?}]\nmod {module};").expect("a string");
    }
    text += "use lane::{Lane, Shared};\nuse registers::{Register, Registers};\n";
    for (place, case) in cases.iter().enumerate() {
        text += &function(place, &case.program);
    }
    text += "fn main() {\n    let points = [";
    for [x, y] in points {
        write!(text, "[{x:?}, {y:?}], ").expect("a string");
    }
    text += "];\n    let cases: &[fn(f64, f64) -> [f64; 3]] = &[";
    for place in 0..cases.len() {
        write!(text, "case{place}, ").expect("a string");
    }
    text += "];\n    for case in cases {\n        for [x, y] in points {\n            \
             let [a, b, c] = case(x, y).map(f64::to_bits);\n            \
             println!(\"{a:x} {b:x} {c:x}\");\n        }\n    }\n}\n";
    text
}

/// Builds the program in a crate of its own and gives what it prints.
fn run(source: &str) -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("random-expressions");
    fs::create_dir_all(folder.join("src")).expect("a folder for the crate");
    fs::write(folder.join("src/main.rs"), source).expect("a source file");
    whirl_tests::run_alone(&folder, "random-expressions")
}

#[test]
fn five_hundred_random_expressions() {
    let mut random = Random::new(500);
    let cases: Vec<Case> = (0..EXPRESSIONS).map(|_| Case::new(&mut random)).collect();
    let points: Vec<[f64; 2]> =
        (0..POINTS).map(|_| [4.0 * random.unit() - 2.0, 4.0 * random.unit() - 2.0]).collect();
    let printed = run(&source(&cases, &points));
    let mut lines = printed.lines();
    let rows: Vec<f64> =
        (0..2).flat_map(|axis| points.iter().map(move |point| point[axis])).collect();
    let mut compared = 0;
    for (place, case) in cases.iter().enumerate() {
        let tape = Tape::new(&case.program);
        let (mut taped, mut workspace) = (vec![0.0; 3 * POINTS], vec![0.0; tape.workspace()]);
        tape.evaluate(POINTS, &rows, &mut taped, &mut workspace);
        for (j, [x, y]) in points.iter().enumerate() {
            let line = lines.next().expect("a line for every case and point");
            let compiled: Vec<f64> = line
                .split(' ')
                .map(|bits| f64::from_bits(u64::from_str_radix(bits, 16).expect("bits")))
                .collect();
            for (output, compiled) in compiled.iter().enumerate() {
                let taped = taped[output * POINTS + j];
                // Which NaN an operation gives is not part of its value.
                let same = compiled.to_bits() == taped.to_bits();
                assert!(
                    same || compiled.is_nan() && taped.is_nan(),
                    "case {place}, output {output} at ({x}, {y}): {compiled} ≠ {taped}"
                );
            }
            let Some(direct) = case.direct(*x, *y) else { continue };
            if direct.value.is_finite() && direct.error.is_finite() {
                // Factoring and squaring round in another order; each side stays within its own bound.
                let bound = 4.0 * direct.error + f64::MIN_POSITIVE;
                let off = (compiled[0] - direct.value).abs();
                assert!(off <= bound, "case {place} at ({x}, {y}): {} ≠ {direct:?}", compiled[0]);
                compared += 1;
            }
        }
    }
    assert!(compared > EXPRESSIONS * POINTS * 9 / 10, "only {compared} values could be compared");
}
