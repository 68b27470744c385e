use super::*;
use crate::expression::{Function, Rational, Relation};

fn ratio(numer: i64, denom: i64) -> Rational {
    Rational::new(numer, denom)
}

/// The text of a program, one instruction a line.
fn listing(program: &Program) -> Vec<String> {
    let name = |operand: Operand| match operand {
        Operand::Constant(value) => format!("{value:?}"),
        other => program.name_of(other).expect("named").to_string(),
    };
    let line = |instruction: &Instruction| {
        let right = match instruction.operation {
            Operation::Add(a, b) => format!("{} + {}", name(a), name(b)),
            Operation::Sub(a, b) => format!("{} - {}", name(a), name(b)),
            Operation::Mul(a, b) => format!("{} * {}", name(a), name(b)),
            Operation::Div(a, b) => format!("{} / {}", name(a), name(b)),
            Operation::Neg(a) => format!("-{}", name(a)),
            Operation::Sqrt(a) => format!("sqrt {}", name(a)),
            Operation::Function(function, a) => format!("{function:?} {}", name(a)),
            Operation::Compare(Relation::Less, a, b) => format!("{} < {}", name(a), name(b)),
            Operation::Select(m, a, b) => format!("{} ? {} : {}", name(m), name(a), name(b)),
            other => format!("{other:?}"),
        };
        format!("{}{} = {right}", "  ".repeat(instruction.stage), instruction.name)
    };
    program.instructions.iter().map(line).collect()
}

#[test]
fn a_polynomial_law_takes_horners_scheme() {
    let mut g = Graph::new();
    let h = g.scalar("h");
    let h2 = g.power(h, ratio(2, 1));
    let one = g.integer(1);
    let q = g.sum(&[(one, ratio(388, 1)), (h, ratio(-18632, 1)), (h2, ratio(217550, 1))]);
    let slope = g.differentiate(q, h).expect("a derivative");
    let root = g.number(ratio(1, 28));
    let engaged = g.compare(Relation::Less, h, root);
    let zero = g.integer(0);
    let (q, slope) = (g.select(engaged, q, zero), g.select(engaged, slope, zero));
    let request = Request::flat(&[("h", h)], &[("Q", q), ("dQ_dh", slope)]);
    let program = schedule(&mut g, &request).expect("a program");
    assert_eq!(
        listing(&program),
        [
            "h_below = h < 0.03571428571428571",
            "Q_part = h * 217550.0",
            "Q_part2 = Q_part - 18632.0",
            "Q_part3 = h * Q_part2",
            "Q_part4 = 388.0 + Q_part3",
            "Q = h_below ? Q_part4 : 0.0",
            "dQ_dh_part = h * 435100.0",
            "dQ_dh_part2 = dQ_dh_part - 18632.0",
            "dQ_dh = h_below ? dQ_dh_part2 : 0.0",
        ]
    );
    assert_eq!(program.total_counts().to_string(), "3 add, 3 mul, 1 compare, 2 select");
}

#[test]
fn values_sit_in_the_first_stage_that_has_what_they_need() {
    let mut g = Graph::new();
    let (psi, theta, x, y, d) =
        (g.scalar("psi"), g.scalar("theta"), g.scalar("x"), g.scalar("y"), g.scalar("d"));
    let (cp, sp) = (g.function(Function::Cos, psi), g.function(Function::Sin, psi));
    let (ct, st) = (g.function(Function::Cos, theta), g.function(Function::Sin, theta));
    // d − cos ψ (cos θ x − sin θ y) − sin ψ (sin θ x + cos θ y), multiplied out.
    let product = |g: &mut Graph, ids: &[Id]| {
        let factors: Vec<_> = ids.iter().map(|id| (*id, ratio(1, 1))).collect();
        g.product(&factors)
    };
    let terms = [
        (d, ratio(1, 1)),
        (product(&mut g, &[cp, ct, x]), ratio(-1, 1)),
        (product(&mut g, &[cp, st, y]), ratio(1, 1)),
        (product(&mut g, &[sp, st, x]), ratio(-1, 1)),
        (product(&mut g, &[sp, ct, y]), ratio(-1, 1)),
    ];
    let h = g.sum(&terms);
    let stages = vec![
        Stage::new("table", &[], 0.0),
        Stage::new("ring", &[], 1.0),
        Stage::new("spring", &[0, 1], 24.0),
    ];
    let input = |name: &str, symbol, stage| Input { name: name.to_string(), symbol, stage };
    let request = Request {
        stages,
        inputs: vec![
            input("psi", psi, 0),
            input("theta", theta, 1),
            input("x", x, 1),
            input("y", y, 1),
            input("d", d, 2),
        ],
        outputs: vec![Output { name: "h".to_string(), expression: h }],
        names: Vec::new(),
    };
    let program = schedule(&mut g, &request).expect("a program");
    assert_eq!(program.counts(0).to_string(), "2 function");
    assert_eq!(program.counts(1).to_string(), "2 add, 4 mul, 2 function");
    assert_eq!(program.counts(2).to_string(), "2 add, 2 mul", "{:#?}", listing(&program));
    let table = program.carried(0, &[1, 2], true);
    let names: Vec<_> = table.iter().filter_map(|operand| program.name_of(*operand)).collect();
    assert_eq!(names, ["cos_psi", "sin_psi"]);
}

#[test]
fn powers_roots_and_reciprocals_are_shared() {
    let mut g = Graph::new();
    let (x, y) = (g.scalar("x"), g.scalar("y"));
    let a = g.power(x, ratio(7, 2));
    let b = g.product(&[(x, ratio(-2, 1)), (y, ratio(1, 1))]);
    let c = g.power(x, ratio(-1, 1));
    let request = Request::flat(&[("x", x), ("y", y)], &[("a", a), ("b", b), ("c", c)]);
    let program = schedule(&mut g, &request).expect("a program");
    let counts = program.total_counts();
    assert_eq!((counts.div, counts.sqrt, counts.mul), (1, 1, 5), "{:#?}", listing(&program));
}

#[test]
fn opposite_sums_are_computed_once() {
    let mut g = Graph::new();
    let (x, y) = (g.scalar("x"), g.scalar("y"));
    let (a, b) = (g.sub(x, y), g.sub(y, x));
    let (a, b) = (g.function(Function::Exp, a), g.power(b, ratio(3, 1)));
    let request = Request::flat(&[("x", x), ("y", y)], &[("a", a), ("b", b)]);
    let program = schedule(&mut g, &request).expect("a program");
    assert_eq!(program.total_counts().add, 2, "{:#?}", listing(&program));
}

#[test]
fn numbers_are_rounded_to_nearest() {
    for (numer, denom) in [(1, 10), (1, 3), (233, 6517), (35_687, 1_000_000_000), (-2, 7)] {
        let nearest = numer as f64 / denom as f64;
        assert_eq!(crate::rational::nearest(&ratio(numer, denom)).to_bits(), nearest.to_bits());
    }
}

#[test]
fn errors_name_the_symbol_and_the_output() {
    let mut g = Graph::new();
    let (x, v) = (g.scalar("x"), g.vector("v"));
    let error = schedule(&mut g, &Request::flat(&[], &[("Q", x)])).expect_err("no input");
    assert_eq!(error.to_string(), "`x` is used in `Q` but is not among the inputs");
    let error = schedule(&mut g, &Request::flat(&[], &[("Q", v)])).expect_err("a vector");
    assert!(matches!(error, ScheduleError::NotScalar { .. }));
    let stages = vec![Stage::new("a", &[], 1.0), Stage::new("b", &[], 1.0)];
    let y = g.scalar("y");
    let sum = g.add(x, y);
    let input = |name: &str, symbol, stage| Input { name: name.to_string(), symbol, stage };
    let request = Request {
        stages,
        inputs: vec![input("x", x, 0), input("y", y, 1)],
        outputs: vec![Output { name: "s".to_string(), expression: sum }],
        names: Vec::new(),
    };
    assert!(matches!(schedule(&mut g, &request), Err(ScheduleError::NoStage { .. })));
}

#[test]
fn deep_and_long_expressions_do_not_overflow_the_stack() {
    let mut g = Graph::new();
    let x = g.scalar("x");
    let one = g.integer(1);
    let mut deep = x;
    for _ in 0..20_000 {
        deep = g.function(Function::Tanh, deep);
        deep = g.add(deep, one);
    }
    let powers: Vec<_> = (0..900).map(|n| (g.power(x, ratio(n, 1)), ratio(n + 1, 7))).collect();
    let long = g.sum(&powers);
    let request = Request::flat(&[("x", x)], &[("deep", deep), ("long", long)]);
    let program = schedule(&mut g, &request).expect("a program");
    assert!(program.instructions.len() > 40_000);
}
