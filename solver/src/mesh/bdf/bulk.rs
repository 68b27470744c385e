//! The cards of a file, sorted by what they say.

use std::collections::BTreeMap;

use whirl_specs::Element;
use whirl_text::nearest_in_any_case;

use super::super::raw::{LinePosition, MeshReport};
use super::cells::Cells;
use super::fields::{self, Card, Entry};
use super::files::{Line, Sources, is_command};
use super::known::{Meaning, meaning};
use super::masses::{self, RawMass};
use super::names::Names;
use super::nodes::Grids;
use super::numbers;
use super::properties::Properties;
use super::sets::{self, RawSet};
use super::spiders::{self, Spider};
use super::systems::Systems;
use super::tie_card::{self, Chosen, RawCard};
use super::values::ALIGN;

/// Cards that are read besides those of elements, for hints.
const READ: [&str; 30] = [
    "GRID", "GRDSET", "CORD2R", "CORD2C", "CORD2S", "CORD1R", "CORD1C", "CORD1S", "CTETRA",
    "CHEXA", "CPENTA", "CPYRAM", "MAT1", "PSOLID", "RBE2", "RBE3", "CONM2", "SET1", "SET3",
    "PARAM", "INCLUDE", "ENDDATA", "PLSOLID", "MAT9", "MPC", "MPCADD", "RBAR", "RBAR1", "RBE1",
    "RROD",
];

/// All that a file says of its mesh.
pub(super) struct Bulk {
    pub(super) grids: Grids,
    pub(super) systems: Systems,
    pub(super) cells: Cells,
    pub(super) properties: Properties,
    pub(super) sets: Vec<RawSet>,
    pub(super) spiders: Vec<Spider>,
    pub(super) masses: Vec<RawMass>,
    pub(super) names: Names,
    /// What a density is multiplied by (`PARAM,WTMASS`).
    mass_factor: Option<(f64, LinePosition)>,
    /// Cards that are left out, with their number and the first of them.
    pub(super) left_out: BTreeMap<String, (usize, LinePosition)>,
    /// Whole numbers of these cards, among which are the nodes of elements.
    pub(super) named: Vec<u64>,
    /// Cards that tie nodes.
    pub(super) ties: Vec<RawCard>,
    /// Which equations count.
    pub(super) chosen: Chosen,
    unknown: BTreeMap<String, (usize, LinePosition)>,
    refused: BTreeMap<String, (usize, LinePosition, &'static str, &'static str)>,
}

/// Reads lines as case control and bulk data; without `BEGIN BULK` they are bulk data.
pub(super) fn read(
    sources: &Sources,
    elements: &[&'static Element],
    report: &mut MeshReport,
) -> Bulk {
    let mut bulk = Bulk {
        grids: Grids::default(),
        systems: Systems::default(),
        cells: Cells::new(elements),
        properties: Properties::default(),
        sets: Vec::new(),
        spiders: Vec::new(),
        masses: Vec::new(),
        names: Names::default(),
        mass_factor: None,
        left_out: BTreeMap::new(),
        named: Vec::new(),
        ties: Vec::new(),
        chosen: Chosen::default(),
        unknown: BTreeMap::new(),
        refused: BTreeMap::new(),
    };
    let begin = sources.lines.iter().position(|line| is_command(sources.text(line), "BEGIN"));
    let (control, lines) = match begin {
        Some(begin) => (&sources.lines[..begin], &sources.lines[begin + 1..]),
        None => (&[][..], &sources.lines[..]),
    };
    let is_begin = |line: &&Line| is_command(sources.text(line), "BEGIN");
    for (number, line) in sources.lines.iter().filter(is_begin).enumerate() {
        if number > 0 || sources.text(line).to_ascii_uppercase().contains("SUPER") {
            let what = "the file has bulk data of superelements, which are not read";
            report.error(
                line.place(),
                what,
                "write the model without superelements, with one BEGIN BULK",
            );
        }
    }
    bulk.chosen.control = begin.is_some();
    for line in control {
        if let Some(comment) = sources.text(line).trim_start().strip_prefix('$') {
            bulk.names.comment(comment);
        }
        if is_command(sources.text(line), "MPC")
            && let Some((_, set)) = sources.text(line).split_once('=')
        {
            let set = set.split('$').next().and_then(|set| numbers::whole(set.trim()));
            bulk.chosen.named.extend(set.map(|set| (set, line.place())));
        }
        if is_command(sources.text(line), "PARAM") {
            fields::each(sources, std::slice::from_ref(line), |entry| {
                if let Entry::Card(card) = entry {
                    bulk.parameter(card, report);
                }
            });
        }
    }
    bulk.sets = sets::of_control(sources, control, report);
    fields::each(sources, lines, |entry| match entry {
        Entry::Card(card) => bulk.card(card, report),
        Entry::Comment(text) => bulk.names.comment(text),
        Entry::Orphan(place, None) => {
            let what = "this line continues no card";
            report.error(
                place,
                what,
                "begin it with the name of a card, or put it below the card that it continues",
            );
        }
        Entry::Orphan(place, Some(other)) => {
            let what = format!(
                "the mark of this continuation is not the only one: {} has it, too",
                report.line(other, place)
            );
            report.error(place, what, "give each continuation a mark of its own");
        }
    });
    bulk.warn(report);
    bulk
}

impl Bulk {
    fn card(&mut self, card: &Card, report: &mut MeshReport) {
        let name = card.name.as_ref();
        match name {
            "GRID" => self.grids.read(card, report),
            "GRDSET" => self.grids.read_defaults(card, report),
            "CORD2R" | "CORD2C" | "CORD2S" => self.systems.read_points(card, report),
            "CORD1R" | "CORD1C" | "CORD1S" => self.systems.read_grids(card, report),
            "MAT1" => {
                let name = self.names.take_material();
                self.properties.read_material(card, name, report);
            }
            "MATT1" => self.properties.read_temperatures(card, report),
            "MAT2" | "MAT3" | "MAT9" | "MAT10" | "MAT11" | "MATHP" | "MATHE" => {
                self.properties.read_other_material(card, report);
            }
            "PSOLID" | "PLSOLID" | "PCOMPS" | "PCOMPLS" => {
                let name = self.names.take_property();
                self.properties.read_solid(card, name, report);
            }
            "RBE2" => self.spiders.extend(spiders::rigid(card, report)),
            "RBE3" => self.spiders.extend(spiders::averaging(card, report)),
            "CONM2" => self.masses.extend(masses::read(card, report)),
            "SET1" | "SET3" => self.sets.extend(sets::of_bulk(card, report)),
            "PARAM" => self.parameter(card, report),
            "BEGIN" => {}
            _ if self.cells.are(name) => self.cells.read(card, report),
            "MPCADD" => {
                let own = |at: usize| numbers::whole(card.field(at)?.text);
                let parts = (1..card.fields.len()).filter_map(own).collect();
                self.chosen.sums.extend(own(0).map(|set| (set, parts)));
            }
            _ => self.other(card, report),
        }
        for (place, what, help) in &card.faults {
            report.error(*place, what, *help);
        }
    }

    /// What a density is multiplied by.
    pub(super) fn mass_factor(&self) -> f64 {
        self.mass_factor.map_or(1.0, |(factor, _)| factor)
    }

    fn parameter(&mut self, card: &Card, report: &mut MeshReport) {
        if card.field(0).is_some_and(|name| name.text.eq_ignore_ascii_case("WTMASS"))
            && let Some(factor) = report.real(card, 1, "WTMASS")
        {
            let place = card.field(1).map_or(card.place, |field| field.place);
            if !(factor > 0.0 && factor.is_finite()) {
                report.error(place, format!("WTMASS is {factor}"), "it must be positive");
                return;
            }
            match self.mass_factor.replace((factor, place)) {
                Some((first, before)) if first != factor => {
                    let what = format!("WTMASS is given twice: {first} and {factor}");
                    let help = format!("{} has the first: keep one", report.line(before, place));
                    report.error(place, what, help);
                }
                _ => {}
            }
        }
    }

    fn other(&mut self, card: &Card, report: &mut MeshReport) {
        if card.name.starts_with('=') {
            let what = "a line that begins with = repeats the card above, which is not read";
            report.error(card.place, what, "write the cards out in full");
            self.grids.lost = true;
            return;
        }
        let word = card.name.split_whitespace().next().unwrap_or_default();
        if word != card.name && (READ.contains(&word) || self.cells.are(word)) {
            let what = format!("`{}` is no card", card.name);
            report.error(card.place, what, ALIGN);
            self.grids.lost |= word.starts_with("GRID");
            return;
        }
        let note = |cards: &mut BTreeMap<String, (usize, LinePosition)>| match cards
            .get_mut(card.name.as_ref())
        {
            Some((number, _)) => *number += 1,
            None => drop(cards.insert(card.name.to_string(), (1, card.place))),
        };
        match meaning(&card.name) {
            Meaning::Control => {}
            Meaning::LeftOut => {
                note(&mut self.left_out);
                // Behind the label of the element or the number of the set.
                let fields = card.fields.iter().skip(1);
                self.named.extend(fields.filter_map(|field| numbers::whole(field.text)));
            }
            Meaning::Unknown => note(&mut self.unknown),
            Meaning::Tie => self.ties.extend(tie_card::read(card, report)),
            Meaning::Refused(what, help) => {
                let entry = self.refused.entry(card.name.to_string());
                entry.or_insert((0, card.place, what, help)).0 += 1;
            }
        }
    }

    /// Says in one line a kind what is left out, and refuses what cannot be.
    fn warn(&mut self, report: &mut MeshReport) {
        for (name, (number, place, what, help)) in &self.refused {
            let all = match number {
                1 => String::new(),
                _ => format!(" ({number} cards)"),
            };
            report.error(*place, format!("{name} {what}{all}"), *help);
        }
        if let Some((_, first)) = self.left_out.values().min_by_key(|(_, place)| *place) {
            let cards = self.left_out.iter().map(|(name, (number, _))| format!("{number} {name}"));
            let cards: Vec<String> = cards.collect();
            let what = format!("left out, as only solid elements are read: {}", cards.join(", "));
            report.warn(*first, what, "");
        }
        if self.grids.held > 0 {
            let what = format!(
                "constraints (PS) of {} are left out",
                super::super::raw::count(self.grids.held, "node")
            );
            report.warn(
                LinePosition::default(),
                what,
                "hold nodes by `mounts` or joints of the case",
            );
        }
        for (name, (number, place)) in &self.unknown {
            let close = nearest_in_any_case(name, READ).map(|close| format!("is {close} meant?"));
            let what = match number {
                1 => format!("{name} is left out"),
                _ => format!("{name} is left out ({number} cards)"),
            };
            report.warn(*place, what, close.unwrap_or_default());
        }
    }
}
