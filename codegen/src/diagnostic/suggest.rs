//! Help for a name that is not known.

use whirl_text::nearest;

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
