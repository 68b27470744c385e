//! Where nodes are along z, and which elements are one shaft.

use std::collections::{BTreeMap, BTreeSet};

use super::fields::File;
use super::model::{Model, ShaftElement};
use super::notes::Notes;

/// Lengths nearer than this part are the same.
pub(super) const SAME: f64 = 1e-9;
/// Ends of a bearing may be so far apart along z (m).
const APART: f64 = 1e-6;

/// A shaft: elements that follow each other without a coupling between them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Shaft {
    /// By node and from the axis outwards.
    pub(super) elements: Vec<ShaftElement>,
    /// z of its nodes (m).
    pub(super) nodes: BTreeMap<usize, f64>,
}

impl Shaft {
    /// The bore at a node (m), 0 of a full shaft.
    pub(super) fn bore(&self, node: usize) -> f64 {
        let left = self.elements.iter().filter(|own| own.n + 1 == node).map(|own| own.inner[1]);
        let right = self.elements.iter().filter(|own| own.n == node).map(|own| own.inner[0]);
        left.chain(right).reduce(f64::min).unwrap_or(0.0)
    }
}

/// Elements that follow each other node by node.
struct Run {
    /// From its first node.
    z: BTreeMap<usize, f64>,
    /// Where its first node is, once that is known.
    start: Option<f64>,
}

/// The shafts of a rotor, by node. What cannot be is noted in the file.
pub(super) fn shafts(file: &File, model: &Model, notes: &mut Notes) -> Vec<Shaft> {
    let lengths = lengths(file, model);
    let mut runs = runs(&lengths);
    place(file, model, &mut runs, notes);
    let cuts: BTreeSet<usize> = model.couplings.iter().map(|own| own.n).collect();
    let mut shafts: Vec<Shaft> = Vec::new();
    for run in &runs {
        let start = run.start.unwrap_or(0.0);
        let mut nodes: BTreeMap<usize, f64> = BTreeMap::new();
        for (&node, &z) in &run.z {
            nodes.insert(node, start + z);
            if cuts.contains(&node) || !run.z.contains_key(&(node + 1)) {
                shafts.push(Shaft { elements: Vec::new(), nodes: std::mem::take(&mut nodes) });
            }
        }
    }
    for element in &model.shaft {
        let holds = |own: &&mut Shaft| {
            own.nodes.contains_key(&element.n) && own.nodes.contains_key(&(element.n + 1))
        };
        if let Some(own) = shafts.iter_mut().find(holds) {
            own.elements.push(element.clone());
        }
    }
    for own in &mut shafts {
        own.elements
            .sort_by(|a, b| (a.n, a.inner[0]).partial_cmp(&(b.n, b.inner[0])).expect("numbers"));
        layers(file, own);
    }
    for coupling in &model.couplings {
        for node in [coupling.n, coupling.n + 1] {
            let bare =
                shafts.iter().any(|own| own.nodes.contains_key(&node) && own.elements.is_empty());
            if bare {
                let what = format!(
                    "`{}`: no shaft element begins or ends at its node {node}",
                    coupling.named.tag
                );
                let help = "a coupling joins two shafts: add an element on that side in Python and save the rotor again";
                file.wrong(coupling.named.place.clone(), what, help);
            }
        }
    }
    shafts
}

/// The length from each node to the next one.
fn lengths(file: &File, model: &Model) -> BTreeMap<usize, f64> {
    let mut lengths: BTreeMap<usize, f64> = BTreeMap::new();
    let shaft = model.shaft.iter().map(|own| (own.n, own.length, &own.named));
    // Their length is none of the equations, and both sides of a joint are at one z.
    let couplings = model.couplings.iter().map(|own| (own.n, 0.0));
    let of_coupling: BTreeSet<usize> = model.couplings.iter().map(|own| own.n).collect();
    for (n, length, named) in shaft {
        if of_coupling.contains(&n) {
            let what = format!("`{}`: a coupling is at the same node {n}", named.tag);
            let help =
                "a shaft beside a coupling has no counterpart: take one of them out in Python";
            file.wrong(named.place.clone(), what, help);
        }
        let known = *lengths.entry(n).or_insert(length);
        if (known - length).abs() > SAME * known {
            let what = format!(
                "`{}` is {length} m long, and another element at its node {n} is {known} m long",
                named.tag
            );
            let help = "layers at one node are of one length: correct them in Python and save the rotor again";
            file.wrong(named.place.clone(), what, help);
        }
    }
    lengths.extend(couplings);
    lengths
}

fn runs(lengths: &BTreeMap<usize, f64>) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    for (&n, &length) in lengths {
        let last = runs.last_mut().and_then(|own| Some((*own.z.get(&n)?, own)));
        match last {
            Some((z, own)) => {
                own.z.insert(n + 1, z + length);
            }
            None => runs.push(Run { z: BTreeMap::from([(n, 0.0), (n + 1, length)]), start: None }),
        }
    }
    runs
}

/// Places runs along z: the first one at 0, others where a bearing or a pair of gears joins them with one that is placed.
fn place(file: &File, model: &Model, runs: &mut [Run], notes: &mut Notes) {
    let of = |runs: &[Run], node: usize| runs.iter().position(|own| own.z.contains_key(&node));
    let at = |runs: &[Run], node: usize| {
        let run = &runs[of(runs, node)?];
        Some(run.start? + run.z[&node])
    };
    if let Some(first) = runs.first_mut() {
        first.start = Some(0.0);
    }
    let gears: Vec<usize> = model.discs.iter().filter(|own| own.gear).map(|own| own.n).collect();
    let links = model.bearings.iter().filter_map(|own| Some((own.n, own.link?)));
    let meshes = gears.windows(2).map(|own| (own[0], own[1]));
    let pairs: Vec<(usize, usize)> = links.chain(meshes).collect();
    let mut reached = reached(model, runs);
    loop {
        let next = pairs.iter().flat_map(|own| [*own, (own.1, own.0)]).find_map(|(known, open)| {
            let run = of(runs, open)?;
            let z = at(runs, known)?;
            runs[run].start.is_none().then(|| (run, z - runs[run].z[&open]))
        });
        if let Some((run, start)) = next {
            runs[run].start = Some(start);
            continue;
        }
        // What stands on a support of another one says nothing of where it is.
        let Some(run) = runs.iter().position(|own| own.start.is_none()) else { break };
        runs[run].start = Some(0.0);
        let (first, last) = (runs[run].z.keys().min(), runs[run].z.keys().max());
        let [first, last] = [first, last].map(|own| own.copied().unwrap_or(0));
        let called = format!("the shaft of nodes {first} to {last}");
        if reached.remove(&run) {
            notes.add(format!("{called} begins at z = 0, as in ROSS: no bearing joins it with another shaft itself"));
            continue;
        }
        let before = runs[run - 1].z.keys().max().copied().unwrap_or(0);
        let element = model.shaft.iter().find(|own| own.n == first);
        let what = format!(
            "no element leads from node {before} to {first}, and no bearing joins {called} with the rest"
        );
        let help = "elements follow each other from node to node; a shaft of its own is joined by a bearing with `n_link`";
        file.wrong(element.map(|own| own.named.place.clone()), what, help);
    }
    for bearing in &model.bearings {
        let ends = bearing.link.and_then(|link| Some((at(runs, bearing.n)?, at(runs, link)?)));
        if let Some((a, b)) = ends.filter(|own| (own.0 - own.1).abs() > APART) {
            notes.of(
                &bearing.named.tag,
                format!("its two nodes are at different places, z = {:.6} m and {:.6} m", a, b),
            );
        }
    }
}

/// The runs that stand on supports which the first one reaches, through bearings and masses.
fn reached(model: &Model, runs: &[Run]) -> BTreeSet<usize> {
    // A run counts by its first node.
    let part = |node: usize| {
        let run = runs.iter().find(|own| own.z.contains_key(&node));
        run.and_then(|own| own.z.keys().min().copied()).unwrap_or(node)
    };
    let mut nodes: BTreeSet<usize> =
        runs.first().and_then(|own| own.z.keys().min()).copied().into_iter().collect();
    loop {
        let before = nodes.len();
        for (a, b) in model.bearings.iter().filter_map(|own| Some((part(own.n), part(own.link?)))) {
            if nodes.contains(&a) || nodes.contains(&b) {
                nodes.extend([a, b]);
            }
        }
        if nodes.len() == before {
            let within = |own: &usize| runs[*own].z.keys().min().is_some_and(|n| nodes.contains(n));
            return (0..runs.len()).filter(within).collect();
        }
    }
}

/// Refuses layers that are in each other.
fn layers(file: &File, own: &Shaft) {
    for pair in own.elements.windows(2) {
        let [inside, around] = [&pair[0], &pair[1]];
        let over = |end: usize| inside.outer[end] > around.inner[end] * (1.0 + SAME) + 1e-12;
        if inside.n == around.n && (over(0) || over(1)) {
            let what = format!(
                "`{}` and `{}` overlap between nodes {} and {}: outer diameter {} m, bore {} m",
                inside.named.tag,
                around.named.tag,
                inside.n,
                inside.n + 1,
                inside.outer[usize::from(!over(0))],
                around.inner[usize::from(!over(0))],
            );
            let help = "solids cannot be in the same place: give the outer one the bore that it has, or take one of them out";
            file.wrong(around.named.place.clone(), what, help);
        }
    }
}
