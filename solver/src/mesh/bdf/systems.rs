//! Coordinate systems of a file.

use std::collections::{BTreeMap, HashMap};

use super::super::raw::{LinePosition, MeshReport, list};
use super::fields::Card;
use super::frame::{Frame, Kind, Point};
use super::nodes::Grids;

/// What fixes a system: its origin, a point on its z axis, and one in its half plane of x and z.
#[derive(Debug, Clone, Copy)]
enum Through {
    /// Points in another system.
    Points { system: u64, points: [Point; 3] },
    /// Labels of grid points.
    Grids([u64; 3]),
}

#[derive(Debug, Clone)]
struct RawSystem {
    label: u64,
    kind: Kind,
    place: LinePosition,
    through: Through,
}

/// The systems as written.
#[derive(Debug, Default)]
pub(super) struct Systems {
    raw: Vec<RawSystem>,
    index: HashMap<u64, usize>,
}

impl Systems {
    /// Labels of the grid points through which systems go.
    pub(super) fn grids(&self) -> impl Iterator<Item = u64> {
        let grids = self.raw.iter().filter_map(|own| match own.through {
            Through::Grids(labels) => Some(labels),
            Through::Points { .. } => None,
        });
        grids.flatten()
    }

    /// Reads `CORD2R`, `CORD2C`, `CORD2S`.
    pub(super) fn read_points(&mut self, card: &Card, report: &mut MeshReport) {
        let label = report.label(card, 0, "label of the system");
        let system = report.count_or_zero(card, 1, "label of its system");
        let mut points = [[0.0; 3]; 3];
        let mut whole = true;
        for (place, value) in points.iter_mut().flatten().enumerate() {
            match report.real_or_zero(card, 2 + place, "coordinate") {
                Some(read) => *value = read,
                None => whole = false,
            }
        }
        if let (Some(label), Some(system), true) = (label, system, whole) {
            self.add(label, card, Through::Points { system, points }, report);
        }
    }

    /// Reads `CORD1R`, `CORD1C`, `CORD1S`, which hold one system or two.
    pub(super) fn read_grids(&mut self, card: &Card, report: &mut MeshReport) {
        for first in [0, 4] {
            if first > 0 && card.filled_from(first).next().is_none() {
                continue;
            }
            let label = report.label(card, first, "label of the system");
            let grids = [1, 2, 3].map(|at| report.label(card, first + at, "label of a grid point"));
            if let (Some(label), [Some(a), Some(b), Some(c)]) = (label, grids) {
                self.add(label, card, Through::Grids([a, b, c]), report);
            }
        }
    }

    fn add(&mut self, label: u64, card: &Card, through: Through, report: &mut MeshReport) {
        let kind = match card.name.as_bytes().last() {
            Some(b'C') => Kind::Cylindrical,
            Some(b'S') => Kind::Spherical,
            _ => Kind::Rectangular,
        };
        if let Some(&first) = self.index.get(&label) {
            let line = report.line(self.raw[first].place, card.place);
            let what = format!("coordinate system {label} is defined twice");
            report.error(card.place, what, format!("{line} has the first; take one out"));
            return;
        }
        self.index.insert(label, self.raw.len());
        self.raw.push(RawSystem { label, kind, place: card.place, through });
    }

    /// Every system in the basic one; those that were refused are missing, which is no further error of what
    /// stands in them.
    pub(super) fn resolve(&self, grids: &Grids, report: &mut MeshReport) -> Frames {
        let mut frames = Frames {
            known: BTreeMap::from([(0, Some(Frame::BASIC))]),
            broken: report.error_count() > 0,
        };
        let mut in_chain = vec![false; self.raw.len()];
        for start in 0..self.raw.len() {
            // A chain may be as long as the file: no recursion.
            let mut chain = vec![start];
            while let Some(&at) = chain.last() {
                let own = &self.raw[at];
                in_chain[at] = true;
                if frames.known.contains_key(&own.label) {
                    chain.pop();
                    continue;
                }
                match self.next(own, grids, &frames, report) {
                    Next::Frame(frame) => {
                        frames.known.insert(own.label, frame);
                        chain.pop();
                    }
                    Next::Wants(other) => match in_chain[other] {
                        false => chain.push(other),
                        true => {
                            let from = chain.iter().position(|&above| above == other);
                            let circle = &chain[from.unwrap_or(0)..];
                            let labels = list(circle.iter().map(|&at| self.raw[at].label));
                            let what = match circle.len() {
                                1 => format!("coordinate system {labels} is given in itself"),
                                _ => format!(
                                    "the coordinate systems {labels} are given in one another in a circle"
                                ),
                            };
                            let help = "give one of them in the basic system, 0";
                            report.error(self.raw[circle[0]].place, what, help);
                            for &at in circle {
                                frames.known.insert(self.raw[at].label, None);
                            }
                        }
                    },
                }
            }
        }
        frames
    }

    fn next(
        &self,
        own: &RawSystem,
        grids: &Grids,
        frames: &Frames,
        report: &mut MeshReport,
    ) -> Next {
        let RawSystem { label, place, kind, through } = own;
        let points = match *through {
            Through::Points { system, points } => match frames.known.get(&system) {
                Some(Some(frame)) => points.map(|point| frame.position(point)),
                Some(None) => return Next::Frame(None),
                None => match self.index.get(&system) {
                    Some(&other) => return Next::Wants(other),
                    None => {
                        let what = format!(
                            "coordinate system {label} is given in system {system}, which is not defined"
                        );
                        report.error(*place, what, self.known());
                        return Next::Frame(None);
                    }
                },
            },
            Through::Grids(labels) => {
                let mut points = [[0.0; 3]; 3];
                for (point, grid) in points.iter_mut().zip(labels) {
                    let Some((system, at)) = grids.raw(grid) else {
                        if grids.lost {
                            return Next::Frame(None);
                        }
                        let what = format!(
                            "coordinate system {label} stands on node {grid}, which is not defined"
                        );
                        report.error(*place, what, "add its GRID, or correct the label");
                        return Next::Frame(None);
                    };
                    match frames.known.get(&system) {
                        Some(Some(frame)) => *point = frame.position(at),
                        Some(None) => return Next::Frame(None),
                        None => match self.index.get(&system) {
                            Some(&other) => return Next::Wants(other),
                            // Reported with the grid points.
                            None => return Next::Frame(None),
                        },
                    }
                }
                points
            }
        };
        let frame = Frame::through(*kind, points);
        if frame.is_none() {
            let what = format!("the three points of coordinate system {label} lie on a line");
            let help = "give its origin, another point on its z axis, and a point beside that axis";
            report.error(*place, what, help);
        }
        Next::Frame(frame)
    }

    /// A hint with the systems that there are.
    pub(super) fn known(&self) -> String {
        match self.raw.is_empty() {
            true => "add its CORD2R, CORD2C or CORD2S; there are none".to_owned(),
            false => {
                let labels = list(self.raw.iter().map(|own| own.label));
                format!("add its card, or correct the label; there are 0, {labels}")
            }
        }
    }
}

enum Next {
    Frame(Option<Frame>),
    Wants(usize),
}

/// Systems in the basic one; `None` for those that were refused.
#[derive(Debug)]
pub(super) struct Frames {
    known: BTreeMap<u64, Option<Frame>>,
    /// Whether a card may have been refused before it had a label.
    broken: bool,
}

impl Frames {
    /// `Err` where there is no such system.
    pub(super) fn get(&self, label: u64) -> Result<Option<&Frame>, ()> {
        match self.known.get(&label) {
            Some(frame) => Ok(frame.as_ref()),
            None if self.broken => Ok(None),
            None => Err(()),
        }
    }
}
