//! Parts, instances and the assembly: which of their cards make the mesh, and whose labels they have.

use super::super::raw::{MeshReport, did_you_mean};
use super::cards::{Card, Owner, Token};
use super::instance::{self, Motion};
use super::{ties, types};

/// Keywords around parts and their instances.
pub(super) const PARTS: [&str; 6] =
    ["PART", "END PART", "ASSEMBLY", "END ASSEMBLY", "INSTANCE", "END INSTANCE"];

/// An instance of a part.
pub(super) struct Instance<'a> {
    pub(super) name: Token<'a>,
    pub(super) owner: Owner,
    motion: Motion,
}

/// The cards that make the mesh, with the instances that they belong to.
pub(super) struct Assembly<'a> {
    pub(super) cards: Vec<Card<'a>>,
    pub(super) instances: Vec<Instance<'a>>,
    /// Whether cards tie nodes, which may be points beside the solids.
    pub(super) tied: bool,
}

impl Assembly<'_> {
    /// How the nodes of cards are moved.
    pub(super) fn motion(&self, owner: Owner) -> Motion {
        let own = self.instances.iter().find(|instance| instance.owner == owner);
        own.map_or(Motion::default(), |instance| instance.motion)
    }
}

/// Where a card stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Model,
    Part(usize),
    Assembly,
    Instance(usize),
}

/// What is known of an instance before its cards are sorted.
struct Found<'a> {
    name: Token<'a>,
    part: Option<usize>,
    solid: bool,
    motion: Motion,
}

/// Sorts the cards of a file. One instance at most may have solid elements: of more, labels stand twice, and nothing else can be
/// said of the file, which is noted.
pub(super) fn read<'a>(all: Vec<Card<'a>>, report: &mut MeshReport) -> Option<Assembly<'a>> {
    let tied = all.iter().any(|card| ties::is_tie(&card.keyword));
    let parts: Vec<&Card> = heads(&all, "PART");
    if parts.is_empty()
        && !all.iter().any(|card| ["ASSEMBLY", "INSTANCE"].contains(&card.keyword.as_str()))
    {
        return Some(Assembly { cards: all, instances: Vec::new(), tied });
    }
    let places = places(&all);
    let names: Vec<Token> = parts.iter().map(|part| name(part)).collect();
    let solid: Vec<bool> =
        (0..parts.len()).map(|k| has_solids(&all, &places, Place::Part(k))).collect();
    let mut found: Vec<Found> = Vec::new();
    let help = "merge them into one part, or write a file for each body";
    for (k, card) in heads(&all, "INSTANCE").into_iter().enumerate() {
        let part = part_of(card, &names, report);
        let solid =
            part.is_some_and(|part| solid[part]) || has_solids(&all, &places, Place::Instance(k));
        if solid && found.iter().any(|other| other.solid) {
            let what = "a second *INSTANCE is not read: both have solid elements";
            report.error(card.place, what, help);
            return None;
        }
        found.push(Found { name: name(card), part, solid, motion: instance::motion(card, report) });
    }
    if let Some((second, _)) = parts.iter().zip(&solid).filter(|(_, solid)| **solid).nth(1)
        && found.is_empty()
    {
        let what = "a second *PART is not read: both have solid elements";
        report.error(second.place, what, help);
        return None;
    }
    let none = found.is_empty();
    let main = found.iter().position(|instance| instance.solid).unwrap_or(0);
    let owner = |k: usize| owner_of(k, main);
    let of_part = |k: usize| -> Vec<Owner> {
        let own = (0..found.len()).filter(|&own| found[own].part == Some(k));
        if none { vec![Owner::Part] } else { own.map(owner).collect() }
    };
    for (k, name) in names.iter().enumerate().filter(|(k, _)| solid[*k] && of_part(*k).is_empty()) {
        let what = format!("the part {} has no *INSTANCE, and is left out", name.text);
        report.warn(parts[k].place, what, "add one, if it belongs to the body");
    }
    let mut cards: Vec<Card> = Vec::with_capacity(all.len());
    for (card, place) in all.into_iter().zip(places) {
        // Points of a part stand once for each instance.
        let owners = match place {
            Place::Model => vec![Owner::Part],
            Place::Assembly => vec![Owner::Assembly],
            Place::Instance(k) => vec![owner(k)],
            Place::Part(k) => of_part(k),
        };
        let of_points = ["NODE", "NSET", "ELEMENT", "ELSET"].contains(&card.keyword.as_str());
        let mut owners =
            owners.into_iter().filter(|owner| of_points || !matches!(owner, Owner::Points(_)));
        let Some(last) = owners.next_back() else { continue };
        cards.extend(owners.map(|owner| Card { owner, ..card.clone() }));
        cards.push(Card { owner: last, ..card });
    }
    let instances = found.into_iter().enumerate();
    let instances = instances
        .map(|(k, own)| Instance { name: own.name, owner: owner_of(k, main), motion: own.motion })
        .collect();
    Some(Assembly { cards, instances, tied })
}

fn owner_of(instance: usize, main: usize) -> Owner {
    if instance == main { Owner::Part } else { Owner::Points(instance) }
}

fn heads<'c, 'a>(all: &'c [Card<'a>], keyword: &str) -> Vec<&'c Card<'a>> {
    all.iter().filter(|card| card.keyword == keyword).collect()
}

fn name<'a>(card: &Card<'a>) -> Token<'a> {
    card.value("NAME").unwrap_or(Token { text: "", ..card.place })
}

/// The part of an instance; one that is not there is noted.
fn part_of(card: &Card, names: &[Token], report: &mut MeshReport) -> Option<usize> {
    if let Some(library) = card.parameter("LIBRARY") {
        let what = "an *INSTANCE of another analysis (LIBRARY) is not read";
        report.error(library.place, what, "write its part into this file, with *PART and PART=");
    }
    let wanted = card.value("PART")?;
    let found = names.iter().position(|name| name.text.eq_ignore_ascii_case(wanted.text));
    if found.is_none() && !names.is_empty() {
        let help = did_you_mean(wanted.text, names.iter().map(|name| name.text));
        report.error(wanted, format!("no part is called {}", wanted.text), help);
    }
    found
}

fn places(all: &[Card]) -> Vec<Place> {
    let mut places = Vec::with_capacity(all.len());
    let (mut parts, mut instances) = (0, 0);
    // An instance stands in an assembly.
    let (mut place, mut around) = (Place::Model, Place::Model);
    for card in all {
        match card.keyword.as_str() {
            "PART" => {
                place = Place::Part(parts);
                parts += 1;
            }
            "ASSEMBLY" => (place, around) = (Place::Assembly, Place::Assembly),
            "INSTANCE" => {
                place = Place::Instance(instances);
                instances += 1;
            }
            _ => {}
        }
        places.push(place);
        match card.keyword.as_str() {
            "END PART" => place = Place::Model,
            "END INSTANCE" => place = around,
            "END ASSEMBLY" => (place, around) = (Place::Model, Place::Model),
            _ => {}
        }
    }
    places
}

fn has_solids(all: &[Card], places: &[Place], of: Place) -> bool {
    all.iter().zip(places).any(|(card, place)| {
        *place == of
            && card.keyword == "ELEMENT"
            && card.value("TYPE").is_none_or(|kind| types::may_be_solid(kind.text))
    })
}
