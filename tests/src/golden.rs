//! Texts that are committed; `WHIRL_RENEW_GOLDEN=1` writes them anew.

use std::env;
use std::fs;
use std::path::Path;

/// The committed text of a file, which is `found` where texts are renewed; empty where there is none.
///
/// # Panics
/// Where it cannot be written.
pub fn committed(path: &Path, found: &str) -> String {
    if env::var_os("WHIRL_RENEW_GOLDEN").is_some() {
        fs::write(path, found).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    }
    fs::read_to_string(path).unwrap_or_default()
}

/// Compares a text with the committed one.
///
/// # Panics
/// With the first line that differs.
pub fn is_as_committed(path: &Path, found: &str) {
    let expected = committed(path, found);
    let first = found.lines().zip(expected.lines()).find(|(found, expected)| found != expected);
    let renew = format!("WHIRL_RENEW_GOLDEN=1 renews {}", path.display());
    assert_eq!(first, None, "first difference; {renew}");
    assert!(found == expected, "one is longer, or ends its lines otherwise; {renew}");
}
