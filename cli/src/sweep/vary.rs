//! The keys that vary: `[vary]` of a sweep file, as far as its own text says whether it is right.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics};
use whirl_codegen::document::tree::{Content, Node, Place, Tree};

use super::random::Random;
use crate::case::refused;
use crate::values::level::{Level, quoted};
use crate::values::range::{Range, is_range};

/// A key of the case with its values.
#[derive(Debug, Clone)]
pub(super) struct Varied {
    /// The tables that it is in and its name, each with where it stands.
    pub(super) path: Vec<(String, Place)>,
    /// These with dots between, as TOML writes them.
    pub(super) name: String,
    /// Where its values stand.
    pub(super) place: Place,
    pub(super) values: Values,
}

/// The values of a key.
#[derive(Debug, Clone)]
pub(super) enum Values {
    /// One after the other.
    Listed(Vec<Level>),
    /// Of a range, as many as it says or, at random, as there are samples.
    Ranged(Range),
    /// Those of a range at shares of its way.
    Shares(Range, Vec<f64>),
    /// Those of a list at these places.
    Places(Vec<Level>, Vec<usize>),
}

impl Varied {
    /// How many values it has; none of a range that does not say it.
    pub(super) fn count(&self) -> Option<usize> {
        match &self.values {
            Values::Listed(levels) => Some(levels.len()),
            Values::Ranged(range) => range.count,
            Values::Shares(_, shares) => Some(shares.len()),
            Values::Places(_, places) => Some(places.len()),
        }
    }

    /// Its `k`-th value, from 0.
    pub(super) fn level(&self, k: usize) -> Level {
        match &self.values {
            Values::Listed(levels) => levels[k].clone(),
            Values::Ranged(range) => range.even(k, range.count.unwrap_or(2)),
            Values::Shares(range, shares) => range.at(shares[k]),
            Values::Places(levels, places) => levels[places[k]].clone(),
        }
    }

    /// Whether its values are those of a range.
    pub(super) fn is_ranged(&self) -> bool {
        matches!(self.values, Values::Ranged(_) | Values::Shares(..))
    }

    /// Whether its values have equal ratios.
    pub(super) fn is_logarithmic(&self) -> bool {
        matches!(&self.values, Values::Ranged(range) if range.logarithmic)
    }

    /// Values of which each stands for all those that the file says alike.
    pub(super) fn written(&self) -> Vec<Level> {
        match &self.values {
            Values::Listed(levels) | Values::Places(levels, _) => levels.clone(),
            Values::Ranged(range) | Values::Shares(range, _) => {
                vec![range.even(0, 2), range.even(1, 2)]
            }
        }
    }

    /// With the values of one coordinate of a Latin hypercube. Those of a list are as often there as each other, to one.
    pub(super) fn sampled(&mut self, random: &mut Random, samples: usize) {
        let shares = random.stratified(samples);
        self.values = match std::mem::replace(&mut self.values, Values::Listed(Vec::new())) {
            Values::Ranged(range) => Values::Shares(range, shares),
            Values::Listed(levels) => {
                let place =
                    |share: f64| ((share * levels.len() as f64) as usize).min(levels.len() - 1);
                let places = shares.into_iter().map(place).collect();
                Values::Places(levels, places)
            }
            sampled => sampled,
        };
    }

    /// An error at its values.
    pub(super) fn error(&self, code: Code, message: impl Into<String>) -> Diagnostic {
        self.place.error(code, message)
    }
}

/// The keys in a table of a sweep, in the order in which they stand there; what is wrong goes to `errors`.
pub(super) fn read(node: &Node, errors: &mut Diagnostics) -> Vec<Varied> {
    let mut all = Vec::new();
    match &node.content {
        Content::Table(tree) => collect(tree, &[], &mut all, errors),
        _ => {
            let help = "write a table `[vary]`, with a line such as `springs.radial_clearance = \"20 um .. 60 um, 9\"`";
            errors.push(node.place.error(Code::BAD_VALUE, "`vary` is a table of keys").help(help));
            return all;
        }
    }
    if all.is_empty() && errors.is_empty() {
        let help =
            "add a key of the case, such as `springs.radial_clearance = \"20 um .. 60 um, 9\"`";
        errors.push(node.place.error(Code::BAD_VALUE, "`[vary]` has no key").help(help));
    }
    all.sort_by_key(|own| own.place.span.start);
    all
}

fn collect(tree: &Tree, path: &[(String, Place)], all: &mut Vec<Varied>, errors: &mut Diagnostics) {
    for (key, (place, node)) in &tree.entries {
        let path = [path, &[(key.clone(), place.clone())]].concat();
        if path.len() == 1 && key == "include" {
            let help = "vary keys of the case, or run a sweep for each file";
            errors.push(place.error(Code::BAD_VALUE, "`include` cannot vary").help(help));
            continue;
        }
        if let Content::Table(inner) = &node.content {
            collect(inner, &path, all, errors);
            continue;
        }
        let name = path.iter().map(|(key, _)| bare(key)).collect::<Vec<_>>().join(".");
        match values(&name, node) {
            Ok(values) => all.push(Varied { path, name, place: node.place.clone(), values }),
            Err(error) => errors.push(*error),
        }
    }
}

fn values(name: &str, node: &Node) -> Result<Values, Box<Diagnostic>> {
    match &node.content {
        Content::Text(text) if is_range(text) => {
            Ok(Values::Ranged(Range::read(text, &node.place)?))
        }
        Content::List(items) if items.is_empty() => {
            let help = format!("write at least one value, or leave out `{name}`");
            let message = format!("`{name}` has no values");
            Err(node.place.error(Code::BAD_VALUE, message).help(help).into())
        }
        Content::List(items) => {
            items.iter().map(level).collect::<Result<_, _>>().map(Values::Listed)
        }
        _ => Ok(Values::Listed(vec![level(node)?])),
    }
}

fn level(node: &Node) -> Result<Level, Box<Diagnostic>> {
    match (refused(node), &node.content) {
        (Some(error), _) => Err(error.into()),
        (None, Content::Text(text)) if is_range(text) => {
            let help = "a range stands alone: `KEY = \"20 um .. 60 um, 9\"`";
            Err(node.place.error(Code::BAD_VALUE, "a list has no ranges").help(help).into())
        }
        _ => Ok(Level::written(node.clone())),
    }
}

/// A key as TOML writes it.
fn bare(key: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !key.is_empty() && key.chars().all(plain) { key.to_owned() } else { quoted(key) }
}
