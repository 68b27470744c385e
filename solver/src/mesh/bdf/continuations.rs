//! Continuations that do not stand below the lines that they continue: they are found by their marks, in any order of the lines.

use std::borrow::Cow;
use std::collections::HashMap;

use super::cut::Cut;
use super::files::{Line, Sources};

/// Lines in the order in which they continue one another, and those of which it cannot be said, with the line that has the same
/// mark.
pub(super) struct Ordered<'l> {
    pub(super) lines: Cow<'l, [Line]>,
    pub(super) unclear: HashMap<(usize, usize), Line>,
}

/// Whether the mark in the last field of a line asks for a continuation with this name.
pub(super) fn asks_for(mark: &str, name: &str) -> bool {
    let name = bare(name);
    let is = |own: &str| own.eq_ignore_ascii_case(name);
    is(bare(mark)) || behind_first(mark).is_some_and(is)
}

fn bare(mark: &str) -> &str {
    mark.trim_start_matches(['+', '*']).trim()
}

/// The first column of a field of eight may hold anything: only the others count.
fn behind_first(mark: &str) -> Option<&str> {
    let mut letters = mark.chars();
    let first = letters.next()?;
    (first != '+' && first != '*').then(|| letters.as_str().trim()).filter(|rest| !rest.is_empty())
}

/// What a line says of the order.
struct Mark<'a> {
    line: usize,
    /// Its own name, of a continuation.
    name: Option<&'a str>,
    asks: &'a str,
}

/// Goes from the lines as they stand to those in which each continuation follows the line that asks for it.
pub(super) fn ordered<'l>(sources: &Sources, lines: &'l [Line]) -> Ordered<'l> {
    let as_they_stand = Ordered { lines: Cow::Borrowed(lines), unclear: HashMap::new() };
    let is_named = |line: &Line| {
        let text = sources.text(line);
        text.starts_with(['+', '*'])
            && text[1..].starts_with(|c: char| !c.is_whitespace() && c != ',')
    };
    if !lines.iter().any(is_named) {
        return as_they_stand;
    }
    let mut marks: Vec<Mark> = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let text = sources.text(line);
        let text = text.split_once('$').map_or(text, |(text, _)| text);
        if text.trim().is_empty() {
            continue;
        }
        let cut = Cut::new(text);
        let name = cut.continues().then_some(cut.name);
        marks.push(Mark { line: number, name, asks: cut.asks() });
    }
    // Of every line the one that follows, as places among the marks.
    let mut next: Vec<Option<usize>> = vec![None; marks.len()];
    let mut lost: Vec<usize> = Vec::new();
    for place in 0..marks.len() {
        let Some(name) = marks[place].name else { continue };
        let above = place.checked_sub(1).map(|above| (above, marks[above].asks));
        match above {
            Some((above, asks)) if bare(name).is_empty() || asks_for(asks, name) => {
                next[above] = Some(place);
            }
            _ if !bare(name).is_empty() => lost.push(place),
            _ => {}
        }
    }
    let mut asking: HashMap<String, Vec<usize>> = HashMap::new();
    for (place, mark) in marks.iter().enumerate() {
        if next[place].is_none() && !bare(mark.asks).is_empty() {
            let keys = [Some(bare(mark.asks)), behind_first(mark.asks)];
            for key in keys.into_iter().flatten() {
                asking.entry(key.to_ascii_uppercase()).or_default().push(place);
            }
        }
    }
    let mut unclear = HashMap::new();
    let mut moved = vec![false; marks.len()];
    for &place in &lost {
        let name = bare(marks[place].name.unwrap_or_default()).to_ascii_uppercase();
        let Some(parents) = asking.get(&name) else { continue };
        let free: Vec<usize> = parents.iter().copied().filter(|&own| own != place).collect();
        let other = match free[..] {
            [] => continue,
            [parent] if next[parent].is_none() => {
                next[parent] = Some(place);
                moved[place] = true;
                continue;
            }
            [parent] => next[parent].unwrap_or(parent),
            [first, ..] => first,
        };
        let line = lines[marks[place].line];
        unclear.insert((line.file, line.number), lines[marks[other].line]);
    }
    if lost.is_empty() || !moved.contains(&true) && unclear.is_empty() {
        return as_they_stand;
    }
    let mut order: Vec<Line> = Vec::with_capacity(lines.len());
    let mut taken = vec![false; marks.len()];
    let followers: Vec<bool> = {
        let mut own = vec![false; marks.len()];
        next.iter().flatten().for_each(|&place| own[place] = true);
        own
    };
    let mut mark = 0;
    for (number, line) in lines.iter().enumerate() {
        if marks.get(mark).is_none_or(|own| own.line != number) {
            order.push(*line);
            continue;
        }
        let mut at = (!followers[mark]).then_some(mark);
        mark += 1;
        while let Some(place) = at.filter(|&place| !taken[place]) {
            taken[place] = true;
            order.push(lines[marks[place].line]);
            at = next[place];
        }
    }
    // Lines that continue one another in a circle belong to no card.
    match taken.contains(&false) {
        true => as_they_stand,
        false => Ordered { lines: Cow::Owned(order), unclear },
    }
}
