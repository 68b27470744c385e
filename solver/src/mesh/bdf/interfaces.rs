//! Node sets of a file, and masses on them.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::super::raw::{MeshReport, count, list};
use super::super::reading::AddedMass;
use super::bulk::Bulk;
use super::frame::Frame;
use super::spiders::Spider;
use super::systems::Frames;
use super::used::Used;

/// What other parts of a machine may be joined to, and what the nodes carry.
pub(super) struct Interfaces {
    pub(super) sets: BTreeMap<String, Vec<usize>>,
    pub(super) masses: Vec<AddedMass>,
    /// Names of sets in capitals.
    taken: HashSet<String>,
}

pub(super) fn find(
    bulk: &Bulk,
    frames: &Frames,
    positions: &[[f64; 3]],
    used: &Used,
    report: &mut MeshReport,
) -> Interfaces {
    let mut found = Interfaces { sets: BTreeMap::new(), masses: Vec::new(), taken: HashSet::new() };
    found.add_sets(bulk, used, report);
    let spiders = found.add_spiders(bulk, used, report);
    found.add_masses(bulk, frames, positions, used, &spiders, report);
    found
}

impl Interfaces {
    /// Adds a set under this name, or under the plain one where the name is taken; names are compared without
    /// regard to case.
    fn add(&mut self, name: Option<&str>, plain: String, nodes: Vec<usize>) -> String {
        let name = name.filter(|name| !self.taken.contains(&name.to_uppercase()));
        let name = name.map_or(plain, str::to_owned);
        self.taken.insert(name.to_uppercase());
        let set = self.sets.entry(name.clone()).or_default();
        let known: HashSet<usize> = set.iter().copied().collect();
        set.extend(nodes.into_iter().filter(|node| !known.contains(node)));
        name
    }

    fn add_sets(&mut self, bulk: &Bulk, used: &Used, report: &mut MeshReport) {
        for set in &bulk.sets {
            let (nodes, missing) = set.members.among(&used.labels);
            // A set may be one of elements, whose labels are not those of nodes.
            if nodes.is_empty() {
                continue;
            }
            let plain = format!("{}_{}", set.card, set.label);
            let name = self.add(bulk.names.set(set.label), plain, nodes);
            if missing > 0 {
                let (card, label) = (set.card, set.label);
                let what = format!(
                    "{missing} of the labels of {card} {label} are no nodes of solid elements"
                );
                let help = match set.of_nodes {
                    true => format!("the node set {name} has the others"),
                    false => format!(
                        "a set of elements is of no use; the node set {name} has the others"
                    ),
                };
                report.warn(set.place, what, help);
            }
        }
    }

    /// Sets of spiders, by the label of their reference node.
    fn add_spiders(
        &mut self,
        bulk: &Bulk,
        used: &Used,
        report: &mut MeshReport,
    ) -> HashMap<u64, Vec<String>> {
        // A component that holds a single spider, and nothing else, is named after its purpose.
        let mut components: HashMap<u64, usize> = HashMap::new();
        for (component, _) in
            bulk.cells.list.iter().filter_map(|cell| bulk.names.component(cell.label))
        {
            components.insert(component, 1);
        }
        let mut first_of: HashMap<u64, &Spider> = HashMap::new();
        for spider in &bulk.spiders {
            let label = spider.label;
            if let Some(first) = first_of.insert(label, spider) {
                let line = report.line(first.place, spider.place);
                let what = format!("element {label} is defined twice");
                let help = format!("{line} has the first; give this one another label");
                report.error(spider.place, what, help);
            }
            if let Some((component, _)) = bulk.names.component(spider.label) {
                *components.entry(component).or_default() += 1;
            }
        }
        let mut by_reference: HashMap<u64, Vec<String>> = HashMap::new();
        let mut empty = Vec::new();
        for spider in &bulk.spiders {
            let plain = format!("{}_{}", spider.card(), spider.label);
            let (nodes, missing) = spider.nodes.among(&used.labels);
            if nodes.is_empty() {
                empty.push(spider);
                continue;
            }
            let component = bulk.names.component(spider.label);
            let name = component.filter(|(own, _)| components[own] == 1).map(|(_, name)| name);
            let name = self.add(name, plain, nodes);
            if missing > 0 {
                let (card, label) = (spider.card(), spider.label);
                let what = format!("{missing} nodes of {card} {label} are in no solid element");
                report.warn(spider.place, what, format!("the node set {name} has the others"));
            }
            by_reference.entry(spider.reference).or_default().push(name.clone());
            if spider.weighted {
                let what = format!("the weights of RBE3 {} are not applied", spider.label);
                report.warn(spider.place, what, "the motion of a set is its mean by area");
            }
        }
        if let Some(first) = empty.first() {
            let what = format!(
                "{} without a node in a solid element, left out: {}",
                count(empty.len(), "spider"),
                list(empty.iter().map(|spider| format!("{} {}", spider.card(), spider.label)))
            );
            report.warn(first.place, what, "");
        }
        by_reference
    }

    fn add_masses(
        &mut self,
        bulk: &Bulk,
        frames: &Frames,
        positions: &[[f64; 3]],
        used: &Used,
        spiders: &HashMap<u64, Vec<String>>,
        report: &mut MeshReport,
    ) {
        for raw in &bulk.masses {
            let name = format!("CONM2_{}", raw.label);
            let missing = |report: &mut MeshReport, what: String, help: String| {
                report.error(raw.place, format!("CONM2 {} {what}", raw.label), help);
            };
            let Some(node) = bulk.grids.place_of(raw.node) else {
                if bulk.grids.lost {
                    continue;
                }
                let what = format!("stands on node {}, which is not defined", raw.node);
                missing(report, what, "add its GRID, or correct the label".to_owned());
                continue;
            };
            let frame = match raw.system.map(|system| (system, frames.get(system))) {
                None => &Frame::BASIC,
                Some((_, Ok(Some(frame)))) => frame,
                Some((_, Ok(None))) => continue,
                Some((system, Err(()))) => {
                    let what =
                        format!("is given in coordinate system {system}, which is not defined");
                    missing(report, what, bulk.systems.known());
                    continue;
                }
            };
            let at = positions[node];
            let axes = frame.directions(at);
            let turned = |own: [f64; 3]| -> [f64; 3] {
                std::array::from_fn(|i| (0..3).map(|k| axes[k][i] * own[k]).sum())
            };
            let offset = turned(raw.offset);
            let factor = bulk.mass_factor();
            let rows = raw.inertia.map(turned);
            let inertia: [[f64; 3]; 3] = std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    factor * (0..3).map(|k| axes[k][i] * rows[k][j]).sum::<f64>()
                })
            });
            let mut sets = spiders.get(&raw.node).cloned().unwrap_or_default();
            if let Ok(own) = used.labels.binary_search_by_key(&raw.node, |(label, _)| *label) {
                sets.push(self.add(None, name.clone(), vec![used.labels[own].1]));
            }
            self.masses.push(AddedMass {
                name,
                mass: factor * raw.mass,
                at: match raw.system {
                    None => raw.offset,
                    Some(_) => std::array::from_fn(|i| at[i] + offset[i]),
                },
                inertia,
                sets,
            });
        }
    }
}
