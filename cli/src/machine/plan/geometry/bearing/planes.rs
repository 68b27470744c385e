//! Where a bearing stands along the axis: its planes from left to right.

use whirl_codegen::diagnostic::Located;

use super::super::place::digits;
use super::super::sets::{Bore, Journal, PLANES, same};
use super::comparison::Comparison;
use crate::machine::wording::mm;

/// Where the planes of a bearing stand along the axis.
#[derive(Clone, Copy)]
pub(super) enum Length {
    /// z of the left and the right end.
    Planes([f64; 2]),
    /// All in one, or in order as far as there are some: the journal's may not be known.
    Open,
    /// Not in order, which has been noted.
    Wrong,
}

impl Comparison<'_, '_> {
    /// The planes of journal and bore: in order from left to right.
    pub(super) fn length(&mut self, journal: Option<&Journal>, bore: Option<&Bore>) -> Length {
        let [one_journal, one_bore] =
            [journal.map(|own| same(own.mesh, own.sets)), bore.map(|own| same(own.mesh, own.sets))];
        if let (Some(journal), Some(true)) = (journal, one_journal) {
            let z = journal.planes()[1];
            match (one_bore, self.whole.stations.len()) {
                (Some(true) | None, 1) => {
                    if let Some(bore) = bore {
                        self.one_ring(bore, z, bore.radii()[0]);
                    }
                    return Length::Open;
                }
                (Some(false), 1) => self.alike("bore", "journal", &bore.expect("a bore").sets[0]),
                _ => self.one_set(&journal.sets[0], z),
            }
            return Length::Wrong;
        }
        if let (Some(bore), Some(true)) = (bore, one_bore) {
            match journal {
                Some(journal) => self.alike("journal", "bore", &journal.sets[0]),
                None if self.whole.stations.len() == 1 => {
                    self.one_ring(bore, bore.planes()[1], bore.radii()[0]);
                    return Length::Open;
                }
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
            (None, true) => Length::Open,
            (_, false) => Length::Wrong,
        }
    }

    fn one_set(&mut self, set: &Located, z: f64) {
        let message = format!(
            "`{}` is named for left, middle and right: three rings of springs would act in one plane",
            set.text()
        );
        let help = format!(
            "name the sets at the left end, in the middle and at the right end; for a bearing in one plane, \
             name one set three times in both `journal` and `bore`, and `stations = [\"{}\"]`",
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
    pub(super) fn ordered(
        &mut self,
        key: &str,
        sets: &[Located],
        z: [f64; 3],
        digits: f64,
    ) -> bool {
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
            let help = self.listed(key, names.iter().rev().copied());
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
                self.listed(key, order.map(|i| names[i])),
            ),
            false => (
                format!("the {key} has fewer than three planes: {left}, {middle}, {right}"),
                "name the sets at the left end, in the middle and at the right end".to_string(),
            ),
        };
        self.note(&sets[1], message, help);
        false
    }
}
