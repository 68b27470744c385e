//! Cards that tie nodes to one another: `MPC`, rigid bars and bodies, and the spiders `RBE2` and `RBE3`. What they say of
//! nodes of solid elements is read as equations; other cards are refused where they join such nodes.

use std::collections::{BTreeMap, BTreeSet};

use super::super::Tie;
use super::super::raw::{
    Direction, FileDof, FileRow, LinePosition, MeshReport, RawTie, TiePoint, count, eliminate,
    follows_mean, list,
};
use super::bulk::Bulk;
use super::frame::Frame;
use super::spiders::Spider;
use super::systems::Frames;
use super::tie_card::{Chosen, Kind, RawCard};
use super::used::Used;

/// What ties name.
struct Points<'a> {
    bulk: &'a Bulk,
    frames: &'a Frames,
    positions: &'a [[f64; 3]],
    used: &'a Used,
    /// All labels with their grid points, by label.
    labels: Vec<(u64, usize)>,
}

impl Points<'_> {
    /// A node of a card, and the axes of its components; `None` after an error.
    fn point(
        &self,
        label: u64,
        (card, own, at): (&str, u64, LinePosition),
        report: &mut MeshReport,
    ) -> Option<(TiePoint, [[f64; 3]; 3])> {
        let grids = &self.bulk.grids;
        let Some(node) = grids.place_of(label) else {
            if !grids.lost {
                let what = format!("{card} {own} names node {label}, which is not defined");
                report.error(at, what, "add its GRID, or correct the label");
            }
            return None;
        };
        let system = grids.axes(node);
        let frame = match self.frames.get(system) {
            Ok(frame) => frame.unwrap_or(&Frame::BASIC),
            Err(()) => {
                let what = format!(
                    "the components of node {label} are in coordinate system {system}, which is not defined"
                );
                report.error(grids.at(node), what, self.bulk.systems.known());
                return None;
            }
        };
        let place = self.used.place[node];
        let dof = |k: usize| match place != usize::MAX && k < 3 {
            true => FileDof::Cell(3 * place + k),
            false => FileDof::Other(label, k),
        };
        let at = self.positions[node];
        Some((TiePoint { dofs: std::array::from_fn(dof), at }, frame.directions(at)))
    }

    fn is_of_cells(&self, label: u64) -> bool {
        self.used.labels.binary_search_by_key(&label, |(own, _)| *own).is_ok()
    }

    /// The equations of a card; `None` after an error.
    fn rows(&self, card: &RawCard, number: u64, report: &mut MeshReport) -> Option<Vec<FileRow>> {
        let said = (card.name.as_str(), card.label, card.place);
        match &card.kind {
            Kind::Refused(_) => None,
            Kind::Equation(terms) => {
                let mut row = Vec::new();
                for &(node, component, by) in terms {
                    let Some(component) = component else {
                        row.push((FileDof::Other(node, 0), by));
                        continue;
                    };
                    let (point, axes) = self.point(node, said, report)?;
                    let motion = point.motion(&Direction::of(axes, component));
                    row.extend(motion.into_iter().map(|(dof, c)| (dof, by * c)));
                }
                Some(vec![row])
            }
            Kind::Rigid(points) => {
                let mut rows = Vec::new();
                let mut body: Option<TiePoint> = None;
                for (node, own) in points {
                    let (point, axes) = self.point(*node, said, report)?;
                    // A motion of its own, which no node has.
                    let dofs = std::array::from_fn(|k| FileDof::Other(u64::MAX - number, k));
                    let body = *body.get_or_insert(TiePoint { dofs, at: point.at });
                    rows.extend(own.iter().map(|&k| point.follows(&body, &Direction::of(axes, k))));
                }
                Some(rows)
            }
            Kind::Rod(nodes) => {
                let ends =
                    [self.point(nodes[0], said, report)?.0, self.point(nodes[1], said, report)?.0];
                let along: [f64; 3] = std::array::from_fn(|k| ends[1].at[k] - ends[0].at[k]);
                let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
                if length == 0.0 {
                    let what = format!("the nodes of RROD {} are at one place", card.label);
                    report.error(card.place, what, "give it two places, or write MPC");
                    return None;
                }
                let direction = Direction { along: along.map(|x| x / length), turn: false };
                let mut row = ends[1].motion(&direction);
                row.extend(ends[0].motion(&direction).into_iter().map(|(dof, c)| (dof, -c)));
                Some(vec![row])
            }
        }
    }

    /// Those of a spider.
    fn of_spider(&self, spider: &Spider, report: &mut MeshReport) -> Option<Vec<FileRow>> {
        let said = (spider.card(), spider.label, spider.place);
        // What stands on no node is said with its mass, or is nothing to the mesh.
        self.bulk.grids.place_of(spider.reference)?;
        let (body, axes) = self.point(spider.reference, said, report)?;
        let mut others = Vec::new();
        for (weight, own, nodes) in &spider.groups {
            for label in nodes.among(&self.labels).0 {
                let label = self.bulk.grids.label(label);
                if label == spider.reference {
                    continue;
                }
                let (point, axes) = self.point(label, said, report)?;
                // Nodes of solids do not turn.
                let shown = own.iter().filter(|&&k| spider.rigid || k < 3);
                let own: Vec<Direction> = shown.map(|&k| Direction::of(axes, k)).collect();
                others.push((point, own, *weight));
            }
        }
        if spider.rigid {
            let follows = others.iter().flat_map(|(point, own, _)| {
                own.iter().map(|direction| point.follows(&body, direction))
            });
            return Some(follows.collect());
        }
        let own: Vec<Direction> =
            spider.components.iter().map(|&k| Direction::of(axes, k)).collect();
        // Weights that do not add up to motions leave none.
        Some(follows_mean(&body, &own, &others).unwrap_or_default())
    }
}

impl Bulk {
    /// What its cards tie.
    pub(super) fn tied(
        &mut self,
        frames: &Frames,
        positions: &[[f64; 3]],
        used: &Used,
        report: &mut MeshReport,
    ) -> Vec<Tie> {
        let mut cards = std::mem::take(&mut self.ties);
        self.choose(&mut cards, report);
        let labels = match self.spiders.is_empty() {
            true => Vec::new(),
            false => self.grids.labels(),
        };
        let points = Points { bulk: self, frames, positions, used, labels };
        let mut raw: Vec<RawTie> = Vec::new();
        let mut refused: BTreeMap<&str, Vec<&RawCard>> = BTreeMap::new();
        let mut left: Vec<(String, LinePosition)> = Vec::new();
        for spider in &self.spiders {
            let name = format!("{} {}", spider.card(), spider.label);
            raw.extend(points.of_spider(spider, report).map(|rows| RawTie { name, rows }));
        }
        // Spiders stand for sets, whatever they join.
        let mut wanted: Vec<Option<&RawCard>> = vec![None; raw.len()];
        for (number, card) in cards.iter().enumerate() {
            if let Kind::Refused(nodes) = &card.kind {
                match nodes.iter().filter(|node| points.is_of_cells(**node)).count() {
                    0 | 1 => left.push((card.name.clone(), card.place)),
                    _ => refused.entry(&card.name).or_default().push(card),
                }
                continue;
            }
            let name = format!("{} {}", card.name, card.label);
            if let Some(rows) = points.rows(card, number as u64, report) {
                wanted.push(Some(card));
                raw.push(RawTie { name, rows });
            }
        }
        for (name, own) in refused {
            let labels = list(own.iter().map(|card| card.label));
            let all = match own.len() {
                1 => String::new(),
                number => format!(" ({number} cards)"),
            };
            let what = format!(
                "{name} {labels} ties nodes of elements to one another, which is not read{all}"
            );
            let help = "write it as MPC, RBE2 or RBAR, or let the meshes share nodes";
            report.error(own[0].place, what, help);
        }
        let (ties, idle) = eliminate(raw);
        let idle = wanted.iter().zip(idle).filter_map(|(card, idle)| card.filter(|_| idle));
        left.extend(idle.map(|card| (card.name.clone(), card.place)));
        if let Some((_, first)) = left.first() {
            let mut by_name: BTreeMap<&str, usize> = BTreeMap::new();
            left.iter().for_each(|(name, _)| *by_name.entry(name).or_insert(0) += 1);
            let all: Vec<String> =
                by_name.iter().map(|(name, number)| format!("{number} {name}")).collect();
            let what = format!(
                "left out, as they join no two nodes of solid elements: {}",
                all.join(", ")
            );
            if report.error_count() == 0 {
                report.warn(*first, what, "");
            }
        }
        merged(ties)
    }

    /// Keeps the equations that case control chooses.
    fn choose(&self, cards: &mut Vec<RawCard>, report: &mut MeshReport) {
        let Chosen { control, named, sums } = &self.chosen;
        let sets: BTreeSet<u64> =
            cards.iter().filter(|card| card.name == "MPC").map(|card| card.label).collect();
        let Some(first) = cards.iter().find(|card| card.name == "MPC").map(|card| card.place)
        else {
            return;
        };
        let mut chosen: BTreeSet<u64> = named.keys().copied().collect();
        match (control, named.len()) {
            (false, _) => chosen = sets.clone(),
            (true, 0) => {
                let number = cards.iter().filter(|card| card.name == "MPC").count();
                let what = format!(
                    "{} left out: the case control chooses no set of MPC",
                    count(number, "equation")
                );
                report.warn(first, what, "if they are meant, write MPC = n above BEGIN BULK");
            }
            (true, 1) => {}
            (true, _) => {
                let (_, second) = named.iter().nth(1).expect("there are two");
                let labels = list(named.keys());
                let what = format!("the case control chooses several sets of MPC: {labels}");
                report.error(*second, what, "keep the one that the mesh is to have");
                cards.retain(|card| card.name != "MPC");
                return;
            }
        }
        if !control && sets.len() > 1 {
            let what = format!(
                "the file has several sets of MPC, {}, and no case control that chooses",
                list(&sets)
            );
            report.error(
                first,
                what,
                "keep one of them, or write CEND, MPC = n and BEGIN BULK above",
            );
            cards.retain(|card| card.name != "MPC");
            return;
        }
        let all: BTreeSet<u64> = chosen
            .iter()
            .flat_map(|set| sums.get(set).cloned().unwrap_or_else(|| vec![*set]))
            .collect();
        cards.retain(|card| card.name != "MPC" || all.contains(&card.label));
    }
}

/// Ties of one name as one.
fn merged(ties: Vec<Tie>) -> Vec<Tie> {
    let mut place: BTreeMap<String, usize> = BTreeMap::new();
    let mut own: Vec<Tie> = Vec::new();
    for tie in ties {
        match place.get(&tie.name) {
            Some(&known) => own[known].rows.extend(tie.rows),
            None => {
                place.insert(tie.name.clone(), own.len());
                own.push(tie);
            }
        }
    }
    own
}
