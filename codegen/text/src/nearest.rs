//! The known name that was probably meant.

/// The candidate most like `name`, if one is near enough to be meant: at most a third of its characters inserted,
/// deleted, changed or swapped with their neighbour, or equal but for case.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    nearest_of(name, candidates, |name| name.to_vec())
}

/// As [`nearest`], for names of which the case does not count.
pub fn nearest_in_any_case<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
) -> Option<&'a str> {
    nearest_of(name, candidates, lower)
}

fn nearest_of<'a>(
    name: &str,
    candidates: impl IntoIterator<Item = &'a str>,
    compared: fn(&[char]) -> Vec<char>,
) -> Option<&'a str> {
    const LONGEST: usize = 64;
    let characters = |name: &str| -> Vec<char> { name.chars().take(LONGEST + 1).collect() };
    let name = characters(name);
    let mut best: Option<(usize, &str)> = None;
    for candidate in candidates {
        let other = characters(candidate);
        let longest = name.len().max(other.len());
        let enough = (longest / 3).max(1);
        if other.len().abs_diff(name.len()) > enough || !(2..=LONGEST).contains(&longest) {
            continue;
        }
        let same_but_case = lower(&name) == lower(&other);
        let distance =
            if same_but_case { 0 } else { edit_distance(&compared(&name), &compared(&other)) };
        if distance <= enough && best.is_none_or(|(least, _)| distance < least) {
            best = Some((distance, candidate));
        }
    }
    best.map(|(_, candidate)| candidate)
}

fn lower(name: &[char]) -> Vec<char> {
    name.iter().flat_map(|c| c.to_lowercase()).collect()
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
        let known = ["title", "source", "inputs", "parameters", "h", "h_dot", "JOURNAL1_LEFT"];
        assert_eq!(nearest("tilte", known), Some("title"));
        assert_eq!(nearest("input", known), Some("inputs"));
        assert_eq!(nearest("Title", known), Some("title"));
        assert_eq!(nearest("h_dto", known), Some("h_dot"));
        assert_eq!(nearest("journal1left", known), None);
        assert_eq!(nearest_in_any_case("journal1left", known), Some("JOURNAL1_LEFT"));
        assert_eq!(nearest("k", known), None);
        assert_eq!(nearest("stiffness", known), None);
        assert_eq!(nearest(&"t".repeat(100_000), known), None);
    }
}
