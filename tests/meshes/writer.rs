//! Writes meshes in the formats of Gmsh, from its documentation and not from what reads them.

use whirl_solver::mesh::Mesh;

/// How a file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Text,
    Little,
    Big,
}

/// What is written: text with blanks, or numbers in binary.
struct Out {
    kind: Kind,
    bytes: Vec<u8>,
}

impl Out {
    fn line(&mut self, text: &str) {
        self.bytes.extend(text.as_bytes());
        self.bytes.push(b'\n');
    }

    fn put(&mut self, text: String, little: &[u8]) {
        match self.kind {
            Kind::Text => self.bytes.extend(format!("{text} ").as_bytes()),
            Kind::Little => self.bytes.extend(little),
            Kind::Big => self.bytes.extend(little.iter().rev()),
        }
    }

    fn int(&mut self, value: usize) {
        self.put(value.to_string(), &i32::try_from(value).unwrap().to_le_bytes());
    }

    fn size(&mut self, value: u64) {
        self.put(value.to_string(), &value.to_le_bytes());
    }

    fn real(&mut self, value: f64) {
        self.put(format!("{value:e}"), &value.to_le_bytes());
    }

    fn end(&mut self) {
        if self.kind == Kind::Text {
            self.bytes.push(b'\n');
        }
    }
}

/// A file of this mesh: its blocks as volumes 1, 2, …, of which groups are called `BLOCK1`, …; its node sets as
/// groups of points.
pub(crate) fn gmsh(mesh: &Mesh, version: u32, kind: Kind) -> Vec<u8> {
    let mut out = Out { kind, bytes: Vec::new() };
    out.line("$MeshFormat");
    let binary = usize::from(kind != Kind::Text);
    out.line(&format!("{} {binary} 8", if version == 2 { "2.2" } else { "4.1" }));
    if binary == 1 {
        out.int(1);
        out.line("");
    }
    out.line("$EndMeshFormat");
    out.line("$Periodic");
    out.line("1 2 3 is passed over");
    out.line("$EndPeriodic");
    let (blocks, sets) = (mesh.blocks().len(), mesh.node_sets());
    out.line(&format!("$PhysicalNames\n{}", blocks + sets.len()));
    sets.keys().enumerate().for_each(|(set, name)| out.line(&format!("0 {} \"{name}\"", set + 1)));
    (1..=blocks).for_each(|block| out.line(&format!("3 {block} \"BLOCK{block}\"")));
    out.line("$EndPhysicalNames");
    if version == 2 {
        version_2(mesh, &mut out)
    } else {
        version_4(mesh, &mut out)
    }
    out.bytes
}

/// Cells of a block in Gmsh's order: its type, labels and labels of nodes.
fn cells(mesh: &Mesh, block: usize) -> (u8, Vec<(u64, Vec<u64>)>) {
    let block = &mesh.blocks()[block];
    // For these elements Gmsh has the order of the reference shaft and support.
    let number = match block.element.nodes {
        8 => 5,
        6 => 6,
        nodes => panic!("{nodes} nodes"),
    };
    let labels = |cell: &[usize]| cell.iter().map(|&node| mesh.labels()[node]).collect();
    (number, block.labels.iter().copied().zip(block.cells().map(labels)).collect())
}

fn version_2(mesh: &Mesh, out: &mut Out) {
    out.line(&format!("$Nodes\n{}", mesh.nodes().len()));
    for (label, position) in mesh.labels().iter().zip(mesh.nodes()) {
        out.int(usize::try_from(*label).unwrap());
        position.iter().for_each(|x| out.real(*x));
        out.end();
    }
    out.line(if out.kind == Kind::Text { "$EndNodes" } else { "\n$EndNodes" });
    let mut all: Vec<(u8, usize, usize, u64, Vec<u64>)> = Vec::new();
    let mut next = 1_000_000;
    for (set, members) in mesh.node_sets().values().enumerate() {
        for &node in members {
            all.push((15, set + 1, set + 1, next, vec![mesh.labels()[node]]));
            next += 1;
        }
    }
    for block in 0..mesh.blocks().len() {
        let (number, cells) = cells(mesh, block);
        all.extend(cells.into_iter().map(|(l, nodes)| (number, block + 1, block + 1, l, nodes)));
    }
    out.line(&format!("$Elements\n{}", all.len()));
    for (number, group, entity, label, nodes) in all {
        let label = usize::try_from(label).unwrap();
        match out.kind {
            Kind::Text => [label, usize::from(number), 2].into_iter().for_each(|x| out.int(x)),
            _ => [usize::from(number), 1, 2, label].into_iter().for_each(|x| out.int(x)),
        }
        [group, entity].into_iter().for_each(|x| out.int(x));
        nodes.iter().for_each(|node| out.int(usize::try_from(*node).unwrap()));
        out.end();
    }
    out.line(if out.kind == Kind::Text { "$EndElements" } else { "\n$EndElements" });
}

fn version_4(mesh: &Mesh, out: &mut Out) {
    let (blocks, sets) = (mesh.blocks().len(), mesh.node_sets());
    out.line("$Entities");
    [sets.len(), 0, 0, blocks].into_iter().for_each(|count| out.size(count as u64));
    out.end();
    for (dimension, count) in [(0, sets.len()), (3, blocks)] {
        for tag in 1..=count {
            out.int(tag);
            (0..if dimension == 0 { 3 } else { 6 }).for_each(|_| out.real(0.5));
            out.size(1);
            out.int(tag);
            if dimension == 3 {
                out.size(0);
            }
            out.end();
        }
    }
    out.line("$EndEntities\n$Nodes");
    let count = mesh.nodes().len() as u64;
    [1, count, 1, count].into_iter().for_each(|value| out.size(value));
    // With coordinates on the entity, which are passed over.
    [3, 1, 1].into_iter().for_each(|value| out.int(value));
    out.size(count);
    mesh.labels().iter().for_each(|label| out.size(*label));
    for position in mesh.nodes() {
        position.iter().chain(&[0.1, 0.2, 0.3]).for_each(|x| out.real(*x));
    }
    out.line("\n$EndNodes\n$Elements");
    let points: usize = sets.values().map(Vec::len).sum();
    let all = (points + mesh.cell_count()) as u64;
    [(sets.len() + blocks) as u64, all, 1, all].into_iter().for_each(|value| out.size(value));
    let mut next = 1_000_000;
    for (set, members) in sets.values().enumerate() {
        [0, set + 1, 15].into_iter().for_each(|value| out.int(value));
        out.size(members.len() as u64);
        for &node in members {
            out.size(next);
            out.size(mesh.labels()[node]);
            next += 1;
        }
    }
    for block in 0..blocks {
        let (number, cells) = cells(mesh, block);
        [3, block + 1, usize::from(number)].into_iter().for_each(|value| out.int(value));
        out.size(cells.len() as u64);
        for (label, nodes) in cells {
            out.size(label);
            nodes.into_iter().for_each(|node| out.size(node));
        }
        out.end();
    }
    out.line("\n$EndElements");
}
