//! The known name that was probably meant.

/// The candidate most like `name`, if one is near enough to be meant: at most a third of its
/// characters inserted, deleted, changed or swapped with their neighbour, or equal but for case.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    const LONGEST: usize = 64;
    let name: Vec<char> = name.chars().take(LONGEST + 1).collect();
    if name.len() > LONGEST {
        return None;
    }
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other: Vec<char> = candidate.chars().take(LONGEST + 1).collect();
        let longest = name.len().max(other.len());
        let enough = (longest / 3).max(1);
        if other.len().abs_diff(name.len()) > enough || other.len() > LONGEST || longest < 2 {
            continue;
        }
        let same_but_case = name
            .iter()
            .flat_map(|c| c.to_lowercase())
            .eq(other.iter().flat_map(|c| c.to_lowercase()));
        let distance = if same_but_case { 0 } else { edit_distance(&name, &other) };
        if distance <= enough && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// "did you mean `x`?" or the list of what is known, for the help of an unknown name.
pub fn suggest(name: &str, candidates: &[&str]) -> Option<String> {
    const MOST_LISTED: usize = 16;
    if let Some(near) = nearest(name, candidates.iter().copied()) {
        return Some(format!("did you mean `{near}`?"));
    }
    match candidates.len() {
        0 => None,
        1..=MOST_LISTED => Some(format!("known: {}", quoted(candidates))),
        _ => Some(format!("known: {}, …", quoted(&candidates[..MOST_LISTED]))),
    }
}

fn quoted(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    quoted.join(", ")
}

/// Insertions, deletions, changes and swaps of neighbours that lead from `a` to `b`.
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let mut before = vec![0; b.len() + 1];
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 1..=a.len() {
        let mut row = vec![i; b.len() + 1];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            row[j] = (above[j] + 1).min(row[j - 1] + 1).min(above[j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                row[j] = row[j].min(before[j - 2] + 1);
            }
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_name_is_found() {
        let known = ["title", "source", "inputs", "parameters", "h", "h_dot"];
        assert_eq!(nearest("tilte", known), Some("title"));
        assert_eq!(nearest("input", known), Some("inputs"));
        assert_eq!(nearest("Title", known), Some("title"));
        assert_eq!(nearest("h_dto", known), Some("h_dot"));
        assert_eq!(nearest("k", known), None);
        assert_eq!(nearest("stiffness", known), None);
        assert_eq!(nearest(&"t".repeat(100_000), known), None);
    }
}
