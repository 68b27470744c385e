//! Grid points.

use std::collections::HashMap;

use super::super::raw::{LinePosition, MeshReport};
use super::fields::Card;
use super::frame::Point;

/// A grid point as written.
#[derive(Debug, Clone)]
pub(super) struct RawGrid {
    pub(super) label: u64,
    /// Its system; `None` where the field is blank.
    pub(super) system: Option<u64>,
    pub(super) at: Point,
    /// The system of its components; `None` where the field is blank.
    pub(super) axes: Option<u64>,
    pub(super) place: LinePosition,
}

/// What `GRDSET` puts into blank fields.
#[derive(Debug, Clone, Copy)]
struct Defaults {
    system: u64,
    axes: u64,
    place: LinePosition,
}

/// Grid points in the order of the file.
#[derive(Debug, Default)]
pub(super) struct Grids {
    pub(super) list: Vec<RawGrid>,
    index: HashMap<u64, usize>,
    defaults: Option<Defaults>,
    /// Grid points with constraints of their own (PS).
    pub(super) held: usize,
    held_by_default: bool,
    /// Whether a label was lost in an error: what has it is no further error.
    pub(super) lost: bool,
}

impl Grids {
    pub(super) fn read(&mut self, card: &Card, report: &mut MeshReport) {
        let Some(label) = report.label(card, 0, "label of the node") else {
            self.lost = true;
            return;
        };
        let system = card.field(1).map(|_| report.count_or_zero(card, 1, "coordinate system"));
        let mut at = [0.0; 3];
        for (i, value) in at.iter_mut().enumerate() {
            *value = report.real_or_zero(card, 2 + i, "coordinate").unwrap_or(0.0);
        }
        // −1 has a fluid's nodes, which no solid has.
        let axes = card.field(5).filter(|field| field.text != "-1").copied();
        let axes = axes.map(|_| report.count_or_zero(card, 5, "coordinate system"));
        let held = match card.field(6) {
            Some(field) => usize::from(field.text != "0"),
            None => usize::from(self.held_by_default),
        };
        in_residual(card, report);
        let own = RawGrid {
            label,
            system: system.flatten(),
            at,
            axes: axes.flatten(),
            place: card.place,
        };
        if let Some(&first) = self.index.get(&label) {
            // One may stand twice, where two files share it.
            let known = &self.list[first];
            if (known.system, known.at, known.axes) == (own.system, own.at, own.axes) {
                return;
            }
            let line = report.line(self.list[first].place, card.place);
            let what = format!("node {label} is defined twice");
            report.error(
                card.place,
                what,
                format!("{line} has the first; give this one another label"),
            );
            return;
        }
        self.held += held;
        self.index.insert(label, self.list.len());
        self.list.push(own);
    }

    /// Reads `GRDSET`.
    pub(super) fn read_defaults(&mut self, card: &Card, report: &mut MeshReport) {
        let system = report.count_or_zero(card, 1, "coordinate system").unwrap_or(0);
        let axes = report.count_or_zero(card, 5, "coordinate system").unwrap_or(0);
        in_residual(card, report);
        if let Some(first) = self.defaults {
            let line = report.line(first.place, card.place);
            report.error(
                card.place,
                "there is a second GRDSET",
                format!("{line} has the first; take one out"),
            );
            return;
        }
        self.held_by_default = card.field(6).is_some_and(|field| field.text != "0");
        self.defaults = Some(Defaults { system, axes, place: card.place });
    }

    /// System and coordinates of a grid point.
    pub(super) fn raw(&self, label: u64) -> Option<(u64, Point)> {
        let grid = &self.list[*self.index.get(&label)?];
        Some((self.system(grid), grid.at))
    }

    /// The system in which a grid point is given.
    pub(super) fn system(&self, grid: &RawGrid) -> u64 {
        grid.system.or(self.defaults.map(|defaults| defaults.system)).unwrap_or(0)
    }

    /// The system of a grid point's components.
    pub(super) fn axes(&self, index: usize) -> u64 {
        self.list[index].axes.or(self.defaults.map(|defaults| defaults.axes)).unwrap_or(0)
    }

    /// Labels and indices of all, by label.
    pub(super) fn labels(&self) -> Vec<(u64, usize)> {
        let all = self.list.iter().enumerate().map(|(index, grid)| (grid.label, index));
        let mut all: Vec<(u64, usize)> = all.collect();
        all.sort_unstable();
        all
    }

    /// Adds a grid point that no card gives, in the basic system: its label, which is free from `from` on.
    pub(super) fn add(&mut self, from: u64, at: Point, place: LinePosition) -> u64 {
        let mut label = from;
        while self.index.contains_key(&label) {
            label = label.wrapping_add(1).max(1);
        }
        self.index.insert(label, self.list.len());
        self.list.push(RawGrid { label, system: Some(0), at, axes: Some(0), place });
        label
    }

    /// A label above all others, but for those that leave no room.
    pub(super) fn above(&self) -> u64 {
        let labels = self.list.iter().map(|grid| grid.label);
        labels.filter(|label| *label < u64::MAX / 2).max().unwrap_or(0) + 1
    }

    pub(super) fn place_of(&self, label: u64) -> Option<usize> {
        self.index.get(&label).copied()
    }

    pub(super) fn label(&self, index: usize) -> u64 {
        self.list[index].label
    }

    pub(super) fn at(&self, index: usize) -> LinePosition {
        self.list[index].place
    }

    pub(super) fn len(&self) -> usize {
        self.list.len()
    }
}

/// Notes a grid point of a superelement.
fn in_residual(card: &Card, report: &mut MeshReport) {
    if let Some(&field) = card.field(7).filter(|field| field.text != "0") {
        let what = format!(
            "{} puts nodes into superelement {}, which are not read",
            card.name, field.text
        );
        report.error(field.place, what, "write the model without superelements");
    }
}
