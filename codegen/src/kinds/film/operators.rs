//! The operators of weak forms: `ddx`, `ddz` and `upstream` of a field become names of their own.

use std::ops::Range;

use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::formula::{Formula, Side, Term, TermKind};

/// Names of the lengths of a cell.
pub(super) const LENGTHS: [&str; 2] = ["dx", "dz"];

/// Name of the test function.
pub(super) const TEST: &str = "v";

/// Names with a meaning of their own.
pub(super) const MEANT: [&str; 6] = ["v", "dx", "dz", "ddx", "ddz", "upstream"];

/// The name of what an operator makes of a field; no name of a spec ends so.
pub(super) fn named(operator: &str, field: &str) -> String {
    format!("{operator}_{field}_")
}

/// What the operators of a formula may be applied to.
pub(super) struct Known<'a> {
    /// Fields of the nodes.
    pub(super) fields: &'a [&'a str],
    /// The speed.
    pub(super) speed: &'a str,
    /// Whether there is a test function.
    pub(super) test: bool,
}

/// The formula with names in place of operators.
///
/// # Errors
/// The first operator that is applied to what is no field.
pub(super) fn rewrite(formula: Formula, known: &Known<'_>) -> Result<Formula, Box<Diagnostic>> {
    let Formula { text, root } = formula;
    let error = |span: &Range<usize>, message: String, help: Option<String>| {
        Box::new(text.error(Code::BAD_CALL, span.clone(), message).maybe_help(help))
    };
    let root = term(root, known, &error)?;
    Ok(Formula { text, root })
}

type Refuse<'a> = dyn Fn(&Range<usize>, String, Option<String>) -> Box<Diagnostic> + 'a;
type Rewritten<T> = Result<T, Box<Diagnostic>>;

fn term(old: Term, known: &Known<'_>, error: &Refuse<'_>) -> Rewritten<Term> {
    let Term { kind, span } = old;
    let boxed = |inner: Box<Term>| term(*inner, known, error).map(Box::new);
    let list = |parts: Vec<Term>| -> Rewritten<Vec<Term>> {
        parts.into_iter().map(|part| term(part, known, error)).collect()
    };
    let sides = |parts: Vec<(Side, Term)>| -> Rewritten<Vec<(Side, Term)>> {
        parts.into_iter().map(|(side, part)| Ok((side, term(part, known, error)?))).collect()
    };
    let kind = match kind {
        kind @ (TermKind::Number(_) | TermKind::Name(_)) => kind,
        TermKind::Negate(inner) => TermKind::Negate(boxed(inner)?),
        TermKind::Not(inner) => TermKind::Not(boxed(inner)?),
        TermKind::Sum(parts) => TermKind::Sum(sides(parts)?),
        TermKind::Product(parts) => TermKind::Product(sides(parts)?),
        TermKind::Power(a, b) => TermKind::Power(boxed(a)?, boxed(b)?),
        TermKind::And(parts) => TermKind::And(list(parts)?),
        TermKind::Or(parts) => TermKind::Or(list(parts)?),
        TermKind::Compare(first, rest) => {
            let rest = rest.into_iter().map(|(how, part)| Ok((how, term(part, known, error)?)));
            TermKind::Compare(boxed(first)?, rest.collect::<Rewritten<_>>()?)
        }
        TermKind::Series { counter, name, ends, body } => {
            let [first, last] = *ends;
            let ends = Box::new([term(first, known, error)?, term(last, known, error)?]);
            TermKind::Series { counter, name, ends, body: boxed(body)? }
        }
        TermKind::Call { function, name, arguments } => match function.as_str() {
            "ddx" | "ddz" | "upstream" => {
                TermKind::Name(operator(&function, &arguments, known, &span, error)?)
            }
            _ => TermKind::Call { function, name, arguments: list(arguments)? },
        },
    };
    Ok(Term { kind, span })
}

/// The name of what an operator makes of its arguments.
fn operator(
    operator: &str,
    arguments: &[Term],
    known: &Known<'_>,
    span: &Range<usize>,
    error: &Refuse<'_>,
) -> Rewritten<String> {
    let upstream = operator == "upstream";
    let speed = known.speed;
    let shown =
        if upstream { format!("`upstream(f, {speed})`") } else { format!("`{operator}(f)`") };
    let name = |term: &Term| match &term.kind {
        TermKind::Name(name) => Some(name.clone()),
        _ => None,
    };
    let names: Vec<Option<String>> = arguments.iter().map(name).collect();
    let field = match (names.as_slice(), upstream) {
        ([field], false) => field,
        ([field, Some(second)], true) if second == speed => field,
        _ => {
            return Err(error(
                span,
                format!("this is written {shown}, f a field of the nodes"),
                None,
            ));
        }
    };
    let may_be_test = known.test && !upstream;
    let mut fields = known.fields.to_vec();
    fields.extend(may_be_test.then_some(TEST));
    match field {
        Some(field) if fields.contains(&field.as_str()) => Ok(named(operator, field)),
        other => {
            let message = format!("`{operator}` takes a field of the nodes");
            let help = other.as_ref().and_then(|field| suggest(field, &fields));
            let listed = || format!("fields are {}", fields.join(", "));
            Err(error(&arguments[0].span, message, Some(help.unwrap_or_else(listed))))
        }
    }
}
