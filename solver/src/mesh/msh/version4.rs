//! Entities, nodes and elements of version 4.1.

use super::super::raw::MeshReport;
use super::contents::{Contents, Run, dimension, element_type, label};
use super::cursor::{Cursor, DAMAGED, Stop};

/// `$Entities`, and `$PartitionedEntities`, which have more to say of each.
pub(super) fn entities(
    contents: &mut Contents,
    cursor: &mut Cursor,
    partitioned: bool,
) -> Result<(), Stop> {
    if partitioned {
        cursor.size("the number of partitions")?;
        let ghosts = cursor.count("ghost entities", 2, 8)?;
        for _ in 0..2 * ghosts {
            cursor.whole("a ghost entity")?;
        }
    }
    let mut counts = [0; 4];
    for (count, of) in counts.iter_mut().zip(["points", "curves", "surfaces", "volumes"]) {
        *count = cursor.count(of, 4, 12)?;
    }
    cursor.promised = format!(
        "{} points, {} curves, {} surfaces and {} volumes",
        counts[0], counts[1], counts[2], counts[3]
    );
    for (dimension, count) in counts.into_iter().enumerate() {
        for _ in 0..count {
            let tag = cursor.whole("the tag of an entity")?;
            if partitioned {
                cursor.whole("the dimension of a parent")?;
                cursor.whole("the tag of a parent")?;
                tags(cursor, "partitions")?;
            }
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                cursor.real("a bound of an entity")?;
            }
            let groups = tags(cursor, "physical groups")?;
            if dimension > 0 {
                tags(cursor, "bounding entities")?;
            }
            let groups = groups.into_iter().map(i64::abs).collect();
            contents.groups_of.insert((dimension, tag), groups);
        }
    }
    cursor.end()
}

fn tags(cursor: &mut Cursor, of: &str) -> Result<Vec<i64>, Stop> {
    let count = cursor.count(of, 1, 4)?;
    (0..count).map(|_| cursor.whole("a tag")).collect()
}

/// `$Nodes`.
pub(super) fn nodes(
    contents: &mut Contents,
    cursor: &mut Cursor,
    report: &mut MeshReport,
) -> Result<(), Stop> {
    let (blocks, count) = head(cursor, "nodes", 4, 32)?;
    contents.nodes.positions.reserve(count);
    let mut left = count;
    let mut labels = Vec::new();
    for _ in 0..blocks {
        let dimension = dimension(cursor.whole("the dimension of an entity")?, cursor)?;
        cursor.whole("the tag of an entity")?;
        let parametric = cursor.whole("0 or 1 for coordinates on the entity")? != 0;
        let own = taken(&mut left, count, "nodes", cursor)?;
        labels.clear();
        for _ in 0..own {
            cursor.peek_text();
            let place = cursor.place();
            let of = "the label of a node";
            let value = cursor.size(of)?;
            labels.push((label(value, of, cursor)?, place));
        }
        for &(label, place) in &labels {
            let mut position = [0.0; 3];
            for value in &mut position {
                *value = cursor.real("a coordinate")?;
            }
            for _ in 0..if parametric { dimension } else { 0 } {
                cursor.real("a coordinate on an entity")?;
            }
            contents.node(label, position, place, report);
        }
    }
    all_taken(left, count, "nodes", cursor)
}

/// `$Elements`.
pub(super) fn elements(contents: &mut Contents, cursor: &mut Cursor) -> Result<(), Stop> {
    let (blocks, count) = head(cursor, "elements", 2, 16)?;
    let mut left = count;
    for _ in 0..blocks {
        let dimension = dimension(cursor.whole("the dimension of an entity")?, cursor)?;
        let entity = cursor.whole("the tag of an entity")?;
        let kind = element_type(cursor.whole("an element type")?, cursor)?;
        let own = taken(&mut left, count, "elements", cursor)?;
        cursor.room(own as u64, "elements", 1 + kind.nodes, 8)?;
        let groups = contents.groups_of.get(&(dimension, entity)).cloned().unwrap_or_default();
        let nodes = kind.nodes;
        let mut run = Run::new(kind, entity, groups);
        for _ in 0..own {
            cursor.peek_text();
            run.places.push(cursor.place());
            let of = "the label of an element";
            let value = cursor.size(of)?;
            run.labels.push(label(value, of, cursor)?);
            for _ in 0..nodes {
                run.nodes.push(cursor.size("the label of a node")?);
            }
        }
        contents.runs.push(run);
    }
    all_taken(left, count, "elements", cursor)
}

/// Numbers of blocks and of things in a section.
fn head(cursor: &mut Cursor, of: &str, words: usize, bytes: usize) -> Result<(usize, usize), Stop> {
    let blocks = cursor.count("blocks", 4, 12)?;
    let count = cursor.count(of, words, bytes)?;
    cursor.size("the smallest label")?;
    cursor.size("the largest label")?;
    cursor.promised = format!("{count} {of}");
    Ok((blocks, count))
}

/// The number of things in a block, of those that are left.
fn taken(left: &mut usize, count: usize, of: &str, cursor: &mut Cursor) -> Result<usize, Stop> {
    let own = cursor.size(&format!("the number of {of} of a block"))?;
    match usize::try_from(own).ok().and_then(|own| Some((own, left.checked_sub(own)?))) {
        Some((own, rest)) => {
            *left = rest;
            Ok(own)
        }
        None => {
            let section = &cursor.section;
            let what =
                format!("a block of ${section} says {own} {of}, where {left} of {count} are left");
            Err(cursor.stop(what, DAMAGED))
        }
    }
}

fn all_taken(left: usize, count: usize, of: &str, cursor: &mut Cursor) -> Result<(), Stop> {
    if left > 0 {
        cursor.peek();
        let what = format!("${} says {count} {of}, but its blocks lack {left}", cursor.section);
        return Err(cursor.stop(what, DAMAGED));
    }
    cursor.end()
}
