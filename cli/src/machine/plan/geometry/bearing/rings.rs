//! The rings of nodes of a bore: each around the axis, in one plane, at its journal.

use whirl_codegen::kinds::law::Acts;
use whirl_solver::Error;
use whirl_solver::mesh::measure::circle;

use super::super::place::{digits, list};
use super::super::sets::{Bore, Journal, PLANES, goes_around, ring_at, spread};
use super::comparison::Comparison;
use crate::machine::springs::NAME_A_RING;
use crate::machine::wording::mm;

const ENDS: [&str; 3] = ["left", "middle", "right"];

impl Comparison<'_, '_> {
    /// Whether the nodes of all rings stand around the axis, where springs need it; notes those that do not.
    pub(super) fn around(&mut self, bore: &Bore) -> bool {
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
            self.note(&bore.sets[ring], error.to_string(), NAME_A_RING.to_string());
        }
        all
    }

    /// The ring of a bearing in one plane is around the journal.
    pub(super) fn one_ring(&mut self, bore: &Bore, z: f64, radius: f64) {
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
    pub(super) fn rings(&mut self, bore: &Bore, ends: [f64; 2], journal: Option<&Journal>) {
        let allowed = PLANES * (ends[1] - ends[0]);
        (0..3).for_each(|ring| self.centred(bore, ring));
        let Some(journal) = journal else { return };
        let planes = journal.planes();
        if !self.whole.stations.is_empty() {
            let middle = 0.5 * (planes[0] + planes[2]);
            let apart = (planes[1] - middle).abs();
            if apart > allowed {
                let message = format!(
                    "the journal's middle `{}` at z = {} is {} off the middle between its ends, to which `stations` refer",
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
            Some(sets) => format!("write `bore = {}`, which are there", list(sets)),
            None => {
                let [left, middle, right] = planes.map(mm);
                format!("name the sets around the bore at z = {left}, {middle} and {right}")
            }
        };
        self.note(&bore.sets[worst], message, help);
    }

    /// Whether each ring stands in one plane; notes those that do not.
    pub(super) fn flat(&mut self, bore: &Bore, allowed: f64) -> bool {
        let allowed = allowed.max(digits(bore.mesh));
        let mut all = true;
        for (place, (set, ring)) in bore.sets.iter().zip(&bore.rings).enumerate() {
            let (low, high) = spread(ring);
            let noted = bore.sets[..place].iter().any(|other| other.text() == set.text());
            if high - low <= allowed || noted {
                continue;
            }
            all = false;
            let message = format!(
                "the nodes of `{}` are not in one plane: they are at z = {} to {}",
                set.text(),
                mm(low),
                mm(high)
            );
            self.note(set, message, NAME_A_RING.to_string());
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
            "the nodes of `{}` are on a circle about x = {}, y = {}: {} off the axis of {}",
            set.text(),
            mm(x),
            mm(y),
            mm(x.hypot(y)),
            self.shaft()
        );
        let help = "name the nodes of the bore about x = y = 0, or move the mesh so that its axis lies there";
        self.note(set, message, help.to_string());
    }
}
