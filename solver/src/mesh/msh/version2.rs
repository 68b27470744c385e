//! Nodes and elements of version 2.

use super::super::raw::{LinePosition, MeshReport};
use super::contents::{Contents, Run, element_type, label};
use super::cursor::{Cursor, DAMAGED, Stop};

/// Tags that an element may have: group, entity, partitions.
const MOST_TAGS: i64 = 10_000;

/// `$Nodes`, and `$ParametricNodes`, which have the entity that a node is on with its place there behind the coordinates.
pub(super) fn nodes(
    contents: &mut Contents,
    cursor: &mut Cursor,
    parametric: bool,
    report: &mut MeshReport,
) -> Result<(), Stop> {
    let count = counted(cursor, "nodes", 4, if parametric { 36 } else { 28 })?;
    contents.nodes.positions.reserve(count);
    for _ in 0..count {
        cursor.peek_text();
        let place = cursor.place();
        let node = positive(cursor, "the label of a node")?;
        let mut position = [0.0; 3];
        for value in &mut position {
            *value = cursor.real("a coordinate")?;
        }
        if parametric {
            let dimension = cursor.whole("the dimension of an entity")?;
            cursor.whole("the label of an entity")?;
            // Points and volumes have none.
            for _ in 0..if (1..=2).contains(&dimension) { dimension } else { 0 } {
                cursor.real("a parametric coordinate")?;
            }
        }
        contents.node(node, position, place, report);
    }
    cursor.end()
}

/// `$Elements`.
pub(super) fn elements(contents: &mut Contents, cursor: &mut Cursor) -> Result<(), Stop> {
    let count = counted(cursor, "elements", 4, 8)?;
    let mut read = 0;
    while read < count {
        if cursor.is_text() {
            cursor.peek_text();
            let place = cursor.place();
            let element = positive(cursor, "the label of an element")?;
            let kind = cursor.whole("an element type")?;
            let tags = tag_count(cursor)?;
            one(contents, cursor, kind, tags, Some((element, place)))?;
            read += 1;
        } else {
            let kind = cursor.whole("an element type")?;
            let follow = cursor.whole("the number of elements of a type")?;
            let tags = tag_count(cursor)?;
            let left = count - read;
            match usize::try_from(follow).ok().filter(|follow| (1..=left).contains(follow)) {
                Some(follow) => {
                    for _ in 0..follow {
                        one(contents, cursor, kind, tags, None)?;
                    }
                    read += follow;
                }
                None => {
                    let what = format!("{follow} elements are to follow, where {left} are left");
                    return Err(cursor.stop(what, DAMAGED));
                }
            }
        }
    }
    cursor.end()
}

/// An element, of which the label may have been read.
fn one(
    contents: &mut Contents,
    cursor: &mut Cursor,
    number: i64,
    tags: usize,
    known: Option<(u64, LinePosition)>,
) -> Result<(), Stop> {
    let kind = element_type(number, cursor)?;
    let (element, place) = match known {
        Some(known) => known,
        None => (positive(cursor, "the label of an element")?, cursor.place()),
    };
    let (mut group, mut entity) = (0, 0);
    for tag in 0..tags {
        let value = cursor.whole("a tag of an element")?;
        match tag {
            0 => group = value.abs(),
            1 => entity = value,
            _ => {}
        }
    }
    let same = |run: &&mut Run| {
        run.kind == kind
            && run.entity == entity
            && run.groups.first().copied().unwrap_or(0) == group
    };
    let count = kind.nodes;
    let run = match contents.runs.last_mut().filter(same) {
        Some(run) => run,
        None => {
            let groups = if group == 0 { Vec::new() } else { vec![group] };
            contents.runs.push(Run::new(kind, entity, groups));
            let last = contents.runs.len() - 1;
            &mut contents.runs[last]
        }
    };
    for _ in 0..count {
        run.nodes.push(positive(cursor, "the label of a node")?);
    }
    run.labels.push(element);
    run.places.push(place);
    Ok(())
}

fn tag_count(cursor: &mut Cursor) -> Result<usize, Stop> {
    let tags = cursor.whole("the number of tags")?;
    match usize::try_from(tags).ok().filter(|_| tags <= MOST_TAGS) {
        Some(tags) => Ok(tags),
        None => Err(cursor.stop(format!("an element has {tags} tags"), DAMAGED)),
    }
}

/// The number of things of a section, which is text in all files.
fn counted(cursor: &mut Cursor, of: &str, words: usize, bytes: usize) -> Result<usize, Stop> {
    let count = cursor.written(&format!("the number of {of}"))?;
    let Ok(count) = u64::try_from(count) else {
        return Err(cursor.stop(format!("{count} {of}"), DAMAGED));
    };
    if !cursor.is_text() {
        cursor.end_line();
    }
    let count = cursor.room(count, of, words, bytes)?;
    cursor.promised = format!("{count} {of}");
    Ok(count)
}

fn positive(cursor: &mut Cursor, of: &str) -> Result<u64, Stop> {
    let value = cursor.whole(of)?;
    match u64::try_from(value) {
        Ok(value) => label(value, of, cursor),
        Err(_) => Err(cursor.stop(
            format!("{of} is {value}"),
            "labels are whole numbers from 1: is the file of another version than its header says?",
        )),
    }
}
