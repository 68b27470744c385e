//! A journal and its bore: on one axis, in the same planes, one inside the other.

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located};
use whirl_codegen::spec::law::Acts;
use whirl_solver::Error;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::measure::circle;

use super::super::BearingOutline;
use super::place::{digits, list, mm};
use super::sets::{Bore, Journal, PLANES, goes_around, ring_at, same, spread};
use crate::case;

/// The axes of journal and bore are apart by at most this part of the clearance, which knows nothing of it.
const AXES: f64 = 0.01;
/// Springs stand beyond the ends of a bearing by at most this part of its length.
const BEYOND: f64 = 1e-3;
/// To this part the radius of a made shaft's section is known: see `mesh::shaft`.
const SECTION_DIGITS: f64 = 2e-4;

const ENDS: [&str; 3] = ["left", "middle", "right"];

/// Notes whatever in a bearing does not fit together.
pub(super) fn compare(
    place: usize,
    outline: &BearingOutline,
    shaft: Option<&Mesh>,
    support: Option<&Mesh>,
    errors: &mut Diagnostics,
) {
    let Some(whole) = outline.whole else { return };
    let [journal, bore] = outline.sets;
    let journal = shaft.and_then(|mesh| Journal::find(mesh, journal));
    let bore = support.and_then(|mesh| Bore::find(mesh, bore));
    let mut own = Comparison { place, whole, errors };
    if let Some(journal) = &journal {
        own.on_axis(journal);
    }
    if let Some(bore) = &bore {
        own.radii(bore, journal.as_ref());
    }
    match own.length(journal.as_ref(), bore.as_ref()) {
        Length::Planes(ends) => {
            own.stations(ends);
            if let Some(bore) = &bore {
                own.rings(bore, ends, journal.as_ref());
            }
        }
        Length::OnePlane(z, radius) => own.one_station(z, radius),
        Length::Wrong => {}
    }
}

/// Where the planes of a bearing stand along the axis.
enum Length {
    /// z of the left and the right end.
    Planes([f64; 2]),
    /// All in one, at this z, of a bore of this radius.
    OnePlane(f64, f64),
    /// Not in order, which has been noted.
    Wrong,
}

struct Comparison<'a, 'e> {
    /// Of the bearing, counted from 0.
    place: usize,
    whole: &'a case::Bearing,
    errors: &'e mut Diagnostics,
}

impl Comparison<'_, '_> {
    fn note(&mut self, at: &Located, message: String, help: String) {
        self.errors.push(at.error_here(Code::BAD_VALUE, message).help(help));
    }

    /// Where the case says `key`, or the bearing.
    fn said(&self, key: &str) -> Located {
        self.whole.places.get(key).unwrap_or(&self.whole.table).clone()
    }

    /// How far the axes of journal and bore may be apart.
    fn off_axis(&self, mesh: &Mesh) -> f64 {
        (AXES * self.whole.radial_clearance).max(digits(mesh))
    }

    /// The journal's nodes stand on the axis about which the shaft turns.
    fn on_axis(&mut self, journal: &Journal) {
        let allowed = self.off_axis(journal.mesh);
        for (place, (set, [x, y, _])) in journal.sets.iter().zip(journal.at).enumerate() {
            let earlier = &journal.sets[..place];
            let told = earlier.iter().any(|other| other.text().eq_ignore_ascii_case(set.text()));
            if told || x.hypot(y) <= allowed {
                continue;
            }
            let message = format!(
                "the journal's node `{}` stands at x = {}, y = {}: {} off the axis about which the shaft turns",
                set.text(),
                mm(x),
                mm(y),
                mm(x.hypot(y))
            );
            let help = "name a node on the centre line x = y = 0, or move the mesh so that its axis lies there";
            self.note(set, message, help.to_string());
        }
    }

    /// A journal fits into its bore, and leaves the clearance.
    fn radii(&mut self, bore: &Bore, journal: Option<&Journal>) {
        let [mean, largest] = bore.radii();
        let c = self.whole.radial_clearance;
        if !(c < mean) {
            let message = format!(
                "`radial_clearance` of {} leaves no journal in a bore whose radius is {}",
                mm(c),
                mm(mean)
            );
            let help = "write the gap between journal and bore, such as \"35 um\"";
            self.note(&self.said("radial_clearance"), message, help.to_string());
        }
        let digits = digits(bore.mesh);
        if let Some(radius) = self.whole.journal_radius.filter(|radius| *radius > largest + digits)
        {
            let message = format!(
                "`journal_radius` of {} is larger than that of the bore, {}",
                mm(radius),
                mm(largest)
            );
            let help = format!("write {} or less, or leave it out", mm(mean - c));
            self.note(&self.said("journal_radius"), message, help);
        }
        let Some(shaft) = journal.and_then(Journal::radius) else { return };
        if shaft * (1.0 - SECTION_DIGITS) > largest + digits {
            let names = [bore.sets, journal.map_or(&[], |own| own.sets)];
            let [bore_name, journal_name] = names.map(|sets| sets[1].text().to_string());
            let message = format!(
                "the bore at `{bore_name}` has a radius of {}, the shaft at `{journal_name}` one of {}: {} more",
                mm(largest),
                mm(shaft),
                mm(shaft - largest)
            );
            let help =
                "name the bore of this journal, or make it larger than the shaft by the clearance";
            self.note(&bore.sets[0], message, help.to_string());
        }
    }

    /// The planes of journal and bore: in order from left to right.
    fn length(&mut self, journal: Option<&Journal>, bore: Option<&Bore>) -> Length {
        let [one_journal, one_bore] =
            [journal.map(|own| same(own.mesh, own.sets)), bore.map(|own| same(own.mesh, own.sets))];
        if let (Some(journal), Some(true)) = (journal, one_journal) {
            let z = journal.planes()[1];
            match (one_bore, self.whole.stations.len()) {
                (Some(true) | None, 1) => {
                    let radius = bore.map_or(f64::INFINITY, |bore| bore.radii()[0]);
                    if let Some(bore) = bore {
                        self.one_ring(bore, z, radius);
                    }
                    return Length::OnePlane(z, radius);
                }
                (Some(false), 1) => self.alike("bore", "journal", &bore.expect("a bore").sets[0]),
                _ => self.one_set(&journal.sets[0], z),
            }
            return Length::Wrong;
        }
        if let (Some(bore), Some(true)) = (bore, one_bore) {
            match journal {
                Some(journal) => self.alike("journal", "bore", &journal.sets[0]),
                None => self.one_set(&bore.sets[0], bore.planes()[1]),
            }
            return Length::Wrong;
        }
        let mut right = true;
        if let Some(own) = journal {
            right &= self.ordered("journal", own.sets, own.planes(), digits(own.mesh));
        }
        // Of rings that are none, the order is open.
        let length = journal.filter(|_| right).map(|own| own.planes()[2] - own.planes()[0]);
        if let Some(own) = bore {
            let allowed = PLANES * length.unwrap_or(own.radii()[0]);
            right &= self.around(own) && self.flat(own, allowed);
            right = right && self.ordered("bore", own.sets, own.planes(), digits(own.mesh));
        }
        match (journal, right) {
            (Some(journal), true) => {
                let [left, _, right] = journal.planes();
                Length::Planes([left, right])
            }
            _ => Length::Wrong,
        }
    }

    fn one_set(&mut self, set: &Located, z: f64) {
        let message = format!(
            "`{}` stands for left, middle and right: three rings of springs would act in one plane",
            set.text()
        );
        let help = format!(
            "name the sets at the left end, in the middle and at the right end; a bearing in one plane says \
             so by one set three times in both `journal` and `bore`, and `stations = [\"{}\"]`",
            mm(z)
        );
        self.note(set, message, help);
    }

    fn alike(&mut self, key: &str, other: &str, set: &Located) {
        let message = format!("the {other} of this bearing is in one plane, the {key} is in three");
        let help = "name one set three times in both, or three different ones in both";
        self.note(set, message, help.to_string());
    }

    /// Whether z rises from left to right.
    fn ordered(&mut self, key: &str, sets: &[Located], z: [f64; 3], digits: f64) -> bool {
        let names: Vec<&str> = sets.iter().map(Located::text).collect();
        let rises = |a: f64, b: f64| b - a > digits;
        let places =
            |order: [usize; 3]| order.map(|i| format!("`{}` at z = {}", names[i], mm(z[i])));
        if rises(z[0], z[1]) && rises(z[1], z[2]) {
            return true;
        }
        if rises(z[1], z[0]) && rises(z[2], z[1]) {
            let [left, _, right] = places([0, 1, 2]);
            let message = format!("left and right of the {key} are swapped: {left}, {right}");
            let help = format!("write `{key} = {}`", list(names.iter().rev().copied()));
            self.note(&sets[0], message, help);
            return false;
        }
        let mut order = [0, 1, 2];
        order.sort_by(|&a, &b| z[a].total_cmp(&z[b]));
        let [left, middle, right] = places([0, 1, 2]);
        let distinct = rises(z[order[0]], z[order[1]]) && rises(z[order[1]], z[order[2]]);
        let (message, help) = match distinct {
            true => (
                format!("the {key}'s middle is not between its ends: {left}, {middle}, {right}"),
                format!("write `{key} = {}`", list(order.map(|i| names[i]))),
            ),
            false => (
                format!("the {key} has fewer than three planes: {left}, {middle}, {right}"),
                "name the sets at the left end, in the middle and at the right end".to_string(),
            ),
        };
        self.note(&sets[1], message, help);
        false
    }

    /// Whether the nodes of all rings stand around the axis, where springs need it; notes those that do not.
    fn around(&mut self, bore: &Bore) -> bool {
        if self.whole.law.source.acts() != Acts::Spring {
            return true;
        }
        let mut all = true;
        for (ring, positions) in bore.rings.iter().enumerate() {
            if goes_around(positions) {
                continue;
            }
            all = false;
            let bearing = format!("bearing {}", self.place + 1);
            let error = Error::Bore { bearing, place: self.place, ring, nodes: positions.len() };
            let help = "name a set of nodes all around the bore, in one plane";
            self.note(&bore.sets[ring], error.to_string(), help.to_string());
        }
        all
    }

    /// Rings of springs stand within the bearing, each at its own place.
    fn stations(&mut self, [left, right]: [f64; 2]) {
        let length = right - left;
        let stations = &self.whole.stations;
        let mut found: Vec<Diagnostic> = Vec::new();
        for (place, &z) in stations.iter().enumerate() {
            let key = format!("stations[{place}]");
            let at = self.said(&key);
            let apart = (left - z).max(z - right);
            if apart > BEYOND * length {
                let message = format!(
                    "the station at z = {} is {} outside the bearing, which goes from {} to {}",
                    mm(z),
                    mm(apart),
                    mm(left),
                    mm(right)
                );
                let help = "write a z between these ends, or correct the sets of the bearing";
                found.push(at.error_here(Code::BAD_VALUE, message).help(help));
            } else if stations[..place].iter().any(|other| (other - z).abs() <= BEYOND * length) {
                let message = format!(
                    "a ring of springs stands at z = {} already: it would act twice",
                    mm(z)
                );
                let help = "take one of them out";
                found.push(at.error_here(Code::BAD_VALUE, message).help(help));
            }
        }
        found.into_iter().for_each(|error| self.errors.push(error));
    }

    /// The station of a bearing in one plane is in it.
    fn one_station(&mut self, z: f64, radius: f64) {
        let station = self.whole.stations[0];
        if !((station - z).abs() <= PLANES * radius) {
            let message = format!(
                "the station at z = {} is {} off the plane of the bearing at {}",
                mm(station),
                mm((station - z).abs()),
                mm(z)
            );
            let help = format!("write `stations = [\"{}\"]`, or correct the sets", mm(z));
            self.note(&self.said("stations[0]"), message, help);
        }
    }

    /// The ring of a bearing in one plane is around the journal.
    fn one_ring(&mut self, bore: &Bore, z: f64, radius: f64) {
        if self.around(bore) && self.flat(bore, PLANES * radius) {
            self.centred(bore, 0);
            let apart = (bore.planes()[0] - z).abs();
            if !(apart <= PLANES * radius) {
                let set = &bore.sets[0];
                let message = format!(
                    "the bore's `{}` at z = {} is {} beside the journal at {}",
                    set.text(),
                    mm(bore.planes()[0]),
                    mm(apart),
                    mm(z)
                );
                let help = format!("name a set of nodes around the bore at z = {}", mm(z));
                self.note(set, message, help);
            }
        }
    }

    /// Each ring of a bore is in its plane, around the axis, and there where the journal is.
    fn rings(&mut self, bore: &Bore, ends: [f64; 2], journal: Option<&Journal>) {
        let allowed = PLANES * (ends[1] - ends[0]);
        (0..3).for_each(|ring| self.centred(bore, ring));
        let Some(journal) = journal else { return };
        let planes = journal.planes();
        if !self.whole.stations.is_empty() {
            let middle = 0.5 * (planes[0] + planes[2]);
            let apart = (planes[1] - middle).abs();
            if apart > allowed {
                let message = format!(
                    "the journal's middle `{}` at z = {} is {} off the middle between its ends, from where \
                     `stations` are reckoned",
                    journal.sets[1].text(),
                    mm(planes[1]),
                    mm(apart)
                );
                let help = format!("name a node at z = {}, or leave `stations` out", mm(middle));
                self.note(&journal.sets[1], message, help);
            }
        }
        let apart = |ring: usize| (bore.planes()[ring] - planes[ring]).abs();
        let Some(worst) = (0..3).find(|&ring| !(apart(ring) <= allowed)) else { return };
        let message = format!(
            "the bore's {} `{}` at z = {} is {} beside the journal's `{}` at {}",
            ENDS[worst],
            bore.sets[worst].text(),
            mm(bore.planes()[worst]),
            mm(apart(worst)),
            journal.sets[worst].text(),
            mm(planes[worst])
        );
        let meant: Option<Vec<&str>> =
            planes.iter().map(|&z| ring_at(bore.mesh, z, allowed)).collect();
        let help = match meant {
            Some(sets) => format!("write `bore = {}`, which stand there", list(sets)),
            None => {
                let [left, middle, right] = planes.map(mm);
                format!("name the sets around the bore at z = {left}, {middle} and {right}")
            }
        };
        self.note(&bore.sets[worst], message, help);
    }

    /// Whether each ring stands in one plane; notes those that do not.
    fn flat(&mut self, bore: &Bore, allowed: f64) -> bool {
        let allowed = allowed.max(digits(bore.mesh));
        let mut all = true;
        for (place, (set, ring)) in bore.sets.iter().zip(&bore.rings).enumerate() {
            let (low, high) = spread(ring);
            let told = bore.sets[..place].iter().any(|other| other.text() == set.text());
            if high - low <= allowed || told {
                continue;
            }
            all = false;
            let message = format!(
                "the nodes of `{}` do not stand in one plane: they are at z = {} to {}",
                set.text(),
                mm(low),
                mm(high)
            );
            let help = "name a set of nodes all around the bore, in one plane";
            self.note(set, message, help.to_string());
        }
        all
    }

    /// A ring has its centre on the axis, as far as its nodes are on a circle.
    fn centred(&mut self, bore: &Bore, ring: usize) {
        let points: Vec<[f64; 2]> = bore.rings[ring].iter().map(|[x, y, _]| [*x, *y]).collect();
        let Some(circle) = circle(&points) else { return };
        let [x, y] = circle.centre;
        if x.hypot(y) <= self.off_axis(bore.mesh).max(circle.deviation) {
            return;
        }
        let set = &bore.sets[ring];
        let message = format!(
            "the nodes of `{}` stand on a circle about x = {}, y = {}: {} off the axis of the shaft",
            set.text(),
            mm(x),
            mm(y),
            mm(x.hypot(y))
        );
        let help = "name the nodes of the bore about x = y = 0, or move the mesh so that its axis lies there";
        self.note(set, message, help.to_string());
    }
}
