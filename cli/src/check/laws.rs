//! What `whirl check` says of the laws of a case.

use std::fmt::Write;

use crate::case::LawSource;
use crate::law_file::LawFile;

/// Of a law with values of which no built-in kernel can make use.
const BY_TAPE: &str = "its values change what is computed, not only its numbers: it is evaluated operation by operation, at a fifth to a \
                       tenth of the pace of a compiled law, to the same bits";

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
        }
        let by_tape = match law {
            LawSource::Given(own) => {
                !LawFile::new(&own.spec, &own.given).is_ok_and(|own| own.is_compiled())
            }
            _ => false,
        };
        let by_tape = by_tape.then(|| BY_TAPE.to_owned());
        if wanted {
            by_tape.iter().for_each(|own| line!(text, "{own}"));
        } else {
            for remark in spec.report.remarks().into_iter().chain(by_tape) {
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
