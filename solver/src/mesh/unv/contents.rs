//! What a universal file holds: nodes, elements, groups, units.

use std::collections::{BTreeMap, BTreeSet};

use super::super::raw::{LinePosition, MeshReport, NodeTable};
use super::kinds::has_orientation;
use super::lines::{Dataset, Stop, expected, three, whole_numbers};

/// An element as it is written.
pub(super) struct Listed {
    pub(super) label: u64,
    pub(super) descriptor: u64,
    pub(super) nodes: Vec<u64>,
    pub(super) place: LinePosition,
}

/// A group as it is written.
pub(super) struct Group {
    pub(super) name: String,
    pub(super) place: LinePosition,
    pub(super) nodes: Vec<u64>,
    pub(super) elements: Vec<u64>,
}

/// All of it.
#[derive(Default)]
pub(super) struct Contents {
    pub(super) elements: Vec<Listed>,
    pub(super) groups: Vec<Group>,
    /// How many of its units of length and of force are 1 m and 1 N, where the file says so.
    pub(super) units: Option<[f64; 2]>,
    /// Coordinate systems, with what they are; none of the global one.
    systems: BTreeMap<i64, Option<&'static str>>,
    /// Whether there are systems of dataset 18.
    older_systems: bool,
    /// Numbers of datasets that say nothing of the mesh.
    pub(super) left_out: BTreeSet<u64>,
    /// Members of groups that are neither nodes nor elements.
    pub(super) other_members: usize,
}

/// Entities of groups.
const NODE: i64 = 7;
const ELEMENT: i64 = 8;
/// Nodes of an element on a line.
const ON_LINE: usize = 8;
/// An element has at most so many nodes.
const MOST_NODES: i64 = 1000;

impl Contents {
    /// Coordinate systems, which nodes may name before they stand.
    pub(super) fn systems(&mut self, data: &mut Dataset) -> Result<(), Stop> {
        self.older_systems |= data.number == 18;
        if data.number != 2420 {
            return Ok(());
        }
        data.demand("the number of a part")?;
        data.demand("the name of a part")?;
        while data.line().is_some_and(|(_, own)| !own.trim().is_empty()) {
            data.back();
            let (_, head) = data.whole("a coordinate system", 2)?;
            data.demand("the name of a coordinate system")?;
            let mut rows = [[0.0; 3]; 4];
            for row in &mut rows {
                *row = data.reals("a row of a coordinate system")?;
            }
            let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]];
            let near = rows
                .iter()
                .flatten()
                .zip(unit.iter().flatten())
                .all(|(a, b)| (a - b).abs() < 1e-12);
            let what = match head[1] {
                0 if near => None,
                0 => Some("displaced or turned"),
                1 => Some("cylindrical"),
                _ => Some("spherical"),
            };
            self.systems.insert(head[0], what);
        }
        Ok(())
    }

    /// One dataset.
    pub(super) fn dataset(
        &mut self,
        data: &mut Dataset,
        nodes: &mut NodeTable,
        report: &mut MeshReport,
    ) -> Result<(), Stop> {
        match data.number {
            15 => self.short_nodes(data, nodes, report),
            781 | 2411 => self.nodes(data, nodes, report),
            780 | 2412 => self.elements(data),
            2417 | 2429 | 2430 | 2432 => self.groups(data, 2),
            2435 | 2452 | 2467 | 2477 => self.groups(data, 4),
            164 => self.units(data),
            // What the file is, and what was read before.
            18 | 151 | 2420 => Ok(()),
            other => {
                self.left_out.insert(other);
                Ok(())
            }
        }
    }

    /// The elements of a dataset, if it has some.
    pub(super) fn elements_only(&mut self, data: &mut Dataset) -> Result<(), Stop> {
        match data.number {
            780 | 2412 => self.elements(data),
            _ => Ok(()),
        }
    }

    /// A node on two lines, of double precision.
    fn nodes(
        &mut self,
        data: &mut Dataset,
        nodes: &mut NodeTable,
        report: &mut MeshReport,
    ) -> Result<(), Stop> {
        while let Some((place, line)) = data.line() {
            let head = whole_numbers(line);
            let head = head.filter(|own| own.len() >= 2 && own[0] > 0);
            let Some(head) = head else { return Err(expected(place, "the label of a node", line)) };
            let at = data.reals("the coordinates of a node")?;
            self.node((head[0], head[1]), at, place, nodes, report)?;
        }
        Ok(())
    }

    /// A node on a line.
    fn short_nodes(
        &mut self,
        data: &mut Dataset,
        nodes: &mut NodeTable,
        report: &mut MeshReport,
    ) -> Result<(), Stop> {
        while let Some((place, line)) = data.line() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let whole = |k: usize| words.get(k).and_then(|own| own.parse::<i64>().ok());
            let at = words.get(4..).and_then(|own| three(&own.join(" ")));
            let (Some(label), Some(system), Some(at)) =
                (whole(0).filter(|own| *own > 0), whole(1), at)
            else {
                return Err(expected(place, "a node with its coordinates", line));
            };
            self.node((label, system), at, place, nodes, report)?;
        }
        Ok(())
    }

    fn node(
        &mut self,
        (label, system): (i64, i64),
        at: [f64; 3],
        place: LinePosition,
        nodes: &mut NodeTable,
        report: &mut MeshReport,
    ) -> Result<(), Stop> {
        let known = match self.systems.get(&system) {
            Some(known) => *known,
            // Files without systems number the global one so.
            None if system == 0 || (system == 1 && !self.older_systems) => None,
            None if self.older_systems => Some("in dataset 18, which is not read"),
            None => Some("not defined in dataset 2420"),
        };
        if let Some(what) = known {
            let what =
                format!("node {label} is in the coordinate system {system}, which is {what}");
            return Err(Stop {
                place,
                what,
                help: "export the nodes in the global Cartesian system",
            });
        }
        if nodes.named.add(label.unsigned_abs(), place, report).is_some() {
            nodes.positions.push(at);
        }
        Ok(())
    }

    fn elements(&mut self, data: &mut Dataset) -> Result<(), Stop> {
        while let Some((place, line)) = data.line() {
            let head = whole_numbers(line);
            let head = head.filter(|own| own.len() >= 6 && own[0] > 0 && own[1] >= 0);
            let Some(head) = head else { return Err(expected(place, "an element", line)) };
            let (label, descriptor) = (head[0].unsigned_abs(), head[1].unsigned_abs());
            let count = head[head.len() - 1];
            if !(1..=MOST_NODES).contains(&count) {
                return Err(expected(place, "an element with the number of its nodes", line));
            }
            if has_orientation(descriptor) {
                data.demand("the orientation of a beam")?;
            }
            let count = count.unsigned_abs() as usize;
            let mut nodes: Vec<u64> = Vec::with_capacity(count);
            while nodes.len() < count {
                let wanted = (count - nodes.len()).min(ON_LINE);
                let (place, numbers) = data.whole("the nodes of an element", 1)?;
                let fits = numbers.len() == wanted && numbers.iter().all(|own| *own > 0);
                if !fits {
                    let what = format!("{wanted} nodes of element {label} should stand here");
                    return Err(Stop { place, what, help: super::lines::DAMAGED });
                }
                nodes.extend(numbers.iter().map(|own| own.unsigned_abs()));
            }
            self.elements.push(Listed { label, descriptor, nodes, place });
        }
        Ok(())
    }

    /// Groups, whose members have so many numbers each.
    fn groups(&mut self, data: &mut Dataset, width: usize) -> Result<(), Stop> {
        while let Some((place, line)) = data.line() {
            let head = whole_numbers(line);
            let count = head
                .as_ref()
                .filter(|own| own.len() >= 2)
                .and_then(|own| usize::try_from(own[own.len() - 1]).ok());
            let (Some(head), Some(count)) = (head, count) else {
                return Err(expected(place, "a group with the number of its members", line));
            };
            let (_, name) = data.demand("the name of a group")?;
            let name = match name.trim() {
                "" => format!("GROUP_{}", head[0]),
                name => name.to_owned(),
            };
            let mut group = Group { name, place, nodes: Vec::new(), elements: Vec::new() };
            let mut read = 0;
            while read < count {
                let (place, numbers) = data.whole("the members of a group", width)?;
                if numbers.len() % width != 0 || numbers.len() / width > count - read {
                    let what = format!(
                        "members of a group have {width} numbers each, and {} are left",
                        count - read
                    );
                    return Err(Stop { place, what, help: super::lines::DAMAGED });
                }
                for member in numbers.chunks_exact(width) {
                    let label = member[1].unsigned_abs();
                    match member[0] {
                        NODE => group.nodes.push(label),
                        ELEMENT => group.elements.push(label),
                        _ => self.other_members += 1,
                    }
                    read += 1;
                }
            }
            self.groups.push(group);
        }
        Ok(())
    }

    /// Factors from SI to the units of the file.
    fn units(&mut self, data: &mut Dataset) -> Result<(), Stop> {
        data.demand("the number of a system of units")?;
        let (place, line) = data.demand("the factors of units")?;
        // A unit of a picometre to one of a thousand kilometres.
        let likely = 1e-6..=1e12;
        match three(line) {
            Some([length, force, _]) if likely.contains(&length) && likely.contains(&force) => {
                self.units = Some([length, force]);
                Ok(())
            }
            _ => Err(expected(place, "the factors of units", line)),
        }
    }
}
