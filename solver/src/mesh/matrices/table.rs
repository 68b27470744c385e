//! Tables of dofs: a line `node, direction, x, y, z` for each row of the matrices.

use super::super::body_matrices::Slot;
use super::super::placed_nodes::PlacedNodes;
use super::super::raw::{LinePosition, MeshReport};
use super::super::units::MeshUnits;
use super::build::RawDof;

const EXAMPLE: &str = "write `node, direction, x [mm], y [mm], z [mm]`, and below it a line for each row of the matrices, such as \
     `7, x, 0, 12.5, 40`; a mode is `7, mode`";

/// Metres in the units of length that a head may name.
const LENGTHS: [(&str, f64); 6] =
    [("m", 1.0), ("mm", 1e-3), ("cm", 1e-2), ("um", 1e-6), ("in", 0.0254), ("ft", 0.3048)];

/// Reads a table: the dofs in its order, and where their nodes are (m).
pub(super) fn read(
    text: &str,
    file: usize,
    units: &MeshUnits,
    report: &mut MeshReport,
) -> (Vec<RawDof>, PlacedNodes) {
    let (mut dofs, mut nodes) = (Vec::new(), PlacedNodes::default());
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let lines = text.lines().enumerate().map(|(number, text)| (number + 1, text));
    let mut lines = lines
        .map(|(number, text)| (number, text.split('#').next().unwrap_or_default()))
        .filter(|(_, text)| !text.trim().is_empty());
    let Some((number, head)) = lines.next() else {
        let at = LinePosition { file, line: 0, column: 0 };
        report.error(at, "the table of dofs is empty", EXAMPLE);
        return (dofs, nodes);
    };
    let Some(lengths) = lengths(head, (file, number), units, report) else { return (dofs, nodes) };
    for (number, line) in lines {
        let row = Row { cells: cells(line), file, number };
        dofs.extend(row.dof(&lengths, &mut nodes, report));
    }
    (dofs, nodes)
}

/// A cell with its column, from 1.
type Cell<'a> = (&'a str, usize);

/// The cells of a line.
fn cells(line: &str) -> Vec<Cell<'_>> {
    let separator = [';', '\t', ','].into_iter().find(|c| line.contains(*c)).unwrap_or(',');
    let mut start = 0;
    let pieces = line.split(separator).map(|piece| {
        let text = piece.trim_matches(|c: char| c.is_whitespace() || c == '"');
        let before = text.as_ptr() as usize - line.as_ptr() as usize;
        let column = 1 + line[..before.max(start)].chars().count();
        start = before;
        (text, column)
    });
    pieces.collect()
}

/// What a coordinate of the table is multiplied by, of x, y and z; none after an error.
fn lengths(
    head: &str,
    (file, line): (usize, usize),
    units: &MeshUnits,
    report: &mut MeshReport,
) -> Option<[f64; 3]> {
    let cells = cells(head);
    let at = |column: usize| LinePosition { file, line, column };
    let names = ["node", "direction", "x", "y", "z"];
    let name = |text: &str| text.split('[').next().unwrap_or_default().trim().to_ascii_lowercase();
    let right = cells.len() == names.len()
        && cells.iter().zip(names).all(|((text, _), wanted)| name(text) == wanted);
    if !right {
        report.error(at(1), "the columns of a table of dofs are node, direction, x, y, z", EXAMPLE);
        return None;
    }
    let mut lengths = [units.length(1.0); 3];
    for ((text, column), own) in cells[2..].iter().zip(&mut lengths) {
        let Some((_, rest)) = text.split_once('[') else { continue };
        let unit = rest.trim_end_matches(']').trim();
        let Some((_, factor)) = LENGTHS.iter().find(|(name, _)| *name == unit) else {
            let shown: String = unit.chars().take(24).collect();
            let known: Vec<&str> = LENGTHS.iter().map(|(name, _)| *name).collect();
            let help = format!("write one of {}", known.join(", "));
            report.error(at(*column), format!("`{shown}` is no unit of length"), help);
            return None;
        };
        *own = *factor;
    }
    Some(lengths)
}

struct Row<'a> {
    cells: Vec<Cell<'a>>,
    file: usize,
    number: usize,
}

impl Row<'_> {
    fn at(&self, cell: usize) -> LinePosition {
        let column = self.cells.get(cell).map_or(1, |(_, column)| *column);
        LinePosition { file: self.file, line: self.number, column }
    }

    fn text(&self, cell: usize) -> &str {
        self.cells.get(cell).map_or("", |(text, _)| text)
    }

    /// The dof, whose node is placed.
    fn dof(
        &self,
        lengths: &[f64; 3],
        nodes: &mut PlacedNodes,
        report: &mut MeshReport,
    ) -> Option<RawDof> {
        let slot = match self.text(1).to_ascii_lowercase().as_str() {
            "x" => Slot::Translation(0),
            "y" => Slot::Translation(1),
            "z" => Slot::Translation(2),
            "rx" => Slot::Turn(0),
            "ry" => Slot::Turn(1),
            "rz" => Slot::Turn(2),
            "mode" => Slot::Coordinate,
            other => {
                let shown: String = other.chars().take(24).collect();
                let what = format!("`{shown}` is no direction of a dof");
                report.error(self.at(1), what, "write x, y, z, rx, ry, rz or mode");
                return None;
            }
        };
        if self.cells.len() > 5 {
            let what =
                format!("a row of a table of dofs has five values, this has {}", self.cells.len());
            report.error(self.at(5), what, "write numbers with a point, and nothing behind z");
            return None;
        }
        let Some(label) = self.text(0).parse::<u64>().ok() else {
            let shown: String = self.text(0).chars().take(24).collect();
            let what = format!("the node of a dof must be a whole number, found `{shown}`");
            report.error(self.at(0), what, "write its label; of a mode its number");
            return None;
        };
        let dof = RawDof { label, slot, place: self.at(0) };
        let given = (2..5).any(|cell| !self.text(cell).is_empty());
        if slot == Slot::Coordinate || !given {
            return Some(dof);
        }
        let mut place = [0.0; 3];
        for (i, (x, factor)) in place.iter_mut().zip(lengths).enumerate() {
            let text = self.text(2 + i);
            let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
            let Some(value) = value else {
                let shown: String = text.chars().take(24).collect();
                let what = format!(
                    "{} of node {label} must be a number, found `{shown}`",
                    ["x", "y", "z"][i]
                );
                report.error(self.at(2 + i), what, "write it with a point, such as 12.5");
                return None;
            };
            *x = value * factor;
        }
        if let Some(known) = nodes.places.insert(label, place).filter(|known| *known != place) {
            let what = format!(
                "node {label} stands at ({}, {}, {}) m here, and at ({}, {}, {}) m above",
                place[0], place[1], place[2], known[0], known[1], known[2]
            );
            report.error(self.at(2), what, "give the place of a node once, or alike");
        }
        Some(dof)
    }
}
