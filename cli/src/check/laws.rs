//! What `whirl check` says of the laws of a case.

use std::fmt::Write;

use crate::case::LawSource;

/// Of each law, once and in the order in which the case first names them, what stands out; all that is known of it, if it is
/// `wanted`.
pub(super) fn say(text: &mut String, laws: &[LawSource], wanted: bool) {
    let mut listed: Vec<String> = Vec::new();
    let mut remarked = false;
    for law in laws {
        let name = law.name();
        if listed.contains(&name) {
            continue;
        }
        let Some(spec) = law.spec() else { continue };
        if wanted {
            line!(text, "\nlaw {name}: {}\n{}", spec.title, spec.report.to_string().trim_end());
        } else {
            for remark in spec.report.remarks() {
                if !remarked {
                    line!(text, "\nLaws (in full: `--laws`)");
                    remarked = true;
                }
                line!(text, "{name}: {remark}");
            }
        }
        listed.push(name);
    }
}
