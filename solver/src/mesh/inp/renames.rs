//! Names and labels as an assembly writes them: `P-1.BORE` and `P-1.17` are of the instance `P-1`, and the assembly has nodes and
//! sets of its own. Each becomes a name or a label of one table: nodes beside the part get labels beyond its own, and a set of
//! the part keeps the name of its instance where the assembly has another one of that name.

use std::collections::{BTreeSet, HashMap, HashSet};

use super::super::raw::{MeshReport, did_you_mean};
use super::assembly::{Assembly, Instance};
use super::cards::{Card, Owner, Token};
use super::ties;
use super::values::whole;

/// What a token names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
enum Kind {
    Nodes,
    Cells,
}

/// Other texts for tokens of cards, by card, file, line and column.
#[derive(Default)]
pub(super) struct Renames {
    texts: HashMap<[usize; 4], String>,
    /// Labels beyond this one are not of the part.
    beyond: Option<u64>,
}

impl Renames {
    /// Whether a label is of a node or an element beside the part.
    pub(super) fn is_beside(&self, label: u64) -> bool {
        self.beyond.is_some_and(|beyond| label > beyond)
    }

    /// The cards with these texts.
    pub(super) fn apply<'a>(&'a self, mut cards: Vec<Card<'a>>) -> Vec<Card<'a>> {
        let own: BTreeSet<usize> = self.texts.keys().map(|key| key[0]).collect();
        for place in own {
            let card = &mut cards[place];
            let values = card.parameters.iter_mut().filter_map(|own| own.value.as_mut());
            for token in values.chain(card.lines.iter_mut().flatten()) {
                if let Some(text) = self.texts.get(&key(place, token)) {
                    token.text = text;
                }
            }
        }
        cards
    }
}

fn key(card: usize, token: &Token) -> [usize; 4] {
    [card, token.file, token.line, token.column]
}

/// The texts of an assembly; names of instances that are not there are noted.
pub(super) fn find(assembly: &Assembly, report: &mut MeshReport) -> Renames {
    let mut renames = Renames::default();
    let Some(main) = assembly.instances.iter().find(|own| own.owner == Owner::Part) else {
        return renames;
    };
    let cards = &assembly.cards;
    let declared = |owner: Owner| -> BTreeSet<(Kind, String)> {
        let own = cards.iter().filter(|card| card.owner == owner).flat_map(parameters);
        let own = own.filter(|(.., of)| *of == Use::Definition);
        own.map(|(name, kind, _)| (kind, name.text.to_uppercase())).collect()
    };
    let (of_part, of_assembly) = (declared(Owner::Part), declared(Owner::Assembly));
    let both: BTreeSet<_> = of_part.intersection(&of_assembly).cloned().collect();
    let largest = cards
        .iter()
        .filter(|card| ["NODE", "ELEMENT"].contains(&card.keyword.as_str()))
        .flat_map(|card| &card.lines)
        .filter_map(|line| whole(line.first()?.text))
        .max();
    let step = 10_u64.pow(largest.unwrap_or(0).max(1).ilog10().min(16) + 1);
    renames.beyond = Some(step);
    // Labels of what stands beside the part; another one can only be of the part.
    let beside: HashSet<(Owner, Kind, i64)> = cards
        .iter()
        .filter(|card| card.owner != Owner::Part)
        .filter_map(|card| match card.keyword.as_str() {
            "NODE" => Some((card, Kind::Nodes)),
            "ELEMENT" => Some((card, Kind::Cells)),
            _ => None,
        })
        .flat_map(|(card, kind)| card.lines.iter().map(move |line| (card.owner, kind, line)))
        .filter_map(|(owner, kind, line)| Some((owner, kind, whole(line.first()?.text)?)))
        .collect();
    let shifted = |label: i64, owner: Owner, kind: Kind| {
        let times = match owner {
            Owner::Part => return None,
            Owner::Assembly => 1,
            Owner::Points(k) => k as u64 + 2,
        };
        let own = u64::try_from(label).ok().filter(|_| beside.contains(&(owner, kind, label)))?;
        Some(own.saturating_add(step.saturating_mul(times)).to_string())
    };
    // A set as an instance has it.
    let of_instance = |instance: &Instance, kind: Kind, name: &str| match instance.owner {
        Owner::Part if !both.contains(&(kind, name.to_uppercase())) => name.to_owned(),
        _ => format!("{}.{name}", instance.name.text),
    };
    for (place, card) in cards.iter().enumerate() {
        let own = match card.owner {
            Owner::Points(_) => assembly.instances.iter().find(|own| own.owner == card.owner),
            Owner::Part if both.is_empty() => continue,
            Owner::Part => Some(main),
            Owner::Assembly => None,
        };
        // What the card defines, and what numbers of an assembly are.
        let named = card.value("INSTANCE").and_then(|wanted| {
            let found = called(&assembly.instances, wanted.text);
            if found.is_none() {
                no_instance(assembly, (wanted, wanted.text), report);
            }
            found
        });
        let labels_of = named.map_or(card.owner, |named| named.owner);
        // Nodes and elements of the part keep their labels.
        let is_own =
            card.owner == Owner::Part && ["NODE", "ELEMENT"].contains(&card.keyword.as_str());
        let data = data(card).filter(|_| !is_own);
        for (token, kind, of) in parameters(card).chain(data) {
            let label = whole(token.text);
            let text = match (own, split(token.text)) {
                _ if label.is_some() => {
                    label.filter(|_| of == Use::Label).and_then(|own| shifted(own, labels_of, kind))
                }
                (Some(own), _) => Some(of_instance(own, kind, token.text)),
                (None, Some((before, name))) if of != Use::Definition => {
                    match (called(&assembly.instances, before), whole(name)) {
                        (Some(own), Some(_)) if own.owner == Owner::Part => Some(name.to_owned()),
                        (Some(own), Some(label)) => shifted(label, own.owner, kind),
                        (Some(own), None) => Some(of_instance(own, kind, name)),
                        (None, _) => {
                            if !of_assembly.contains(&(kind, token.text.to_uppercase())) {
                                no_instance(assembly, (*token, before), report);
                            }
                            None
                        }
                    }
                }
                _ => None,
            };
            if let Some(text) = text.filter(|text| text != token.text) {
                renames.texts.insert(key(place, token), text);
            }
        }
    }
    renames
}

fn no_instance(assembly: &Assembly, (at, name): (Token, &str), report: &mut MeshReport) {
    let names = assembly.instances.iter().map(|own| own.name.text);
    report.error(at, format!("no instance is called {name}"), did_you_mean(name, names));
}

fn called<'i, 'a>(instances: &'i [Instance<'a>], name: &str) -> Option<&'i Instance<'a>> {
    instances.iter().find(|own| own.name.text.eq_ignore_ascii_case(name))
}

/// The name of an instance and what stands behind its point, without quotation marks; none of a number.
fn split(text: &str) -> Option<(&str, &str)> {
    let mut quoted = false;
    let (point, _) = text.char_indices().find(|&(_, c)| {
        quoted ^= c == '"';
        c == '.' && !quoted
    })?;
    let (before, behind) = (text[..point].trim(), text[point + 1..].trim());
    let is_number = before.starts_with(|c: char| c.is_ascii_digit() || "+-".contains(c));
    let (before, behind) = (before.trim_matches('"'), behind.trim_matches('"'));
    (!is_number && !before.is_empty() && !behind.is_empty()).then_some((before, behind))
}

/// What a token is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Use {
    /// The name of a set that the card defines.
    Definition,
    /// The name of a set.
    Name,
    /// A label, or the name of a set.
    Label,
}

type Named<'c, 'a> = (&'c Token<'a>, Kind, Use);

/// The values of parameters that name nodes, cells or sets of them.
fn parameters<'c, 'a>(card: &'c Card<'a>) -> impl Iterator<Item = Named<'c, 'a>> {
    let keyword = card.keyword.as_str();
    card.parameters.iter().filter_map(move |parameter| {
        let value = parameter.value.as_ref()?;
        let if_of =
            |with: [&str; 2]| if with.contains(&keyword) { Use::Definition } else { Use::Name };
        Some(match parameter.name.as_str() {
            "NSET" => (value, Kind::Nodes, if_of(["NODE", "NSET"])),
            "ELSET" => (value, Kind::Cells, if_of(["ELEMENT", "ELSET"])),
            "NAME" if keyword == "SURFACE" => (value, Kind::Nodes, Use::Definition),
            "PIN NSET" | "TIE NSET" | "TIED NSET" | "SURFACE" => (value, Kind::Nodes, Use::Name),
            "REF NODE" | "ROT NODE" => (value, Kind::Nodes, Use::Label),
            _ => return None,
        })
    })
}

/// The same of its lines; of nodes their own labels.
fn data<'c, 'a>(card: &'c Card<'a>) -> impl Iterator<Item = Named<'c, 'a>> {
    let keyword = card.keyword.as_str();
    let of_nodes = card.value("TYPE").is_some_and(|kind| kind.text.eq_ignore_ascii_case("NODE"));
    let ranges = card.parameter("GENERATE").is_some();
    let combined = card.parameter("COMBINE").is_some();
    let (label, name) = (Some((Kind::Nodes, Use::Label)), Some((Kind::Nodes, Use::Name)));
    let cell_label = Some((Kind::Cells, Use::Label));
    let what = move |line: &[Token], at: usize, goes_on: bool| match keyword {
        "NSET" if at < 2 || !ranges => label,
        "ELSET" if at < 2 || !ranges => cell_label,
        "ELEMENT" if at == 0 && !goes_on => cell_label,
        "ELEMENT" => label,
        "NODE" | "KINEMATIC COUPLING" if at == 0 => label,
        "SURFACE" if combined => name,
        "SURFACE" if at == 0 && of_nodes => label,
        "SURFACE" if at == 0 => cell_label,
        // The number of terms stands by itself.
        "EQUATION" if line.len() >= 3 && at.is_multiple_of(3) => label,
        "MPC" if at > 0 => label,
        "TIE" => name,
        _ if ties::is_refused(keyword) => name,
        _ => None,
    };
    // A line that ends with a comma goes on in the next one.
    let goes_on = std::iter::once(false).chain(card.open.iter().copied());
    card.lines.iter().zip(goes_on).flat_map(move |(line, goes_on)| {
        let own = line.iter().enumerate();
        own.filter_map(move |(at, token)| {
            what(line, at, goes_on).map(|(kind, of)| (token, kind, of))
        })
    })
}
