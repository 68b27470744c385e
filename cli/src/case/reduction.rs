//! How bodies are reduced: `[reduction]`.

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;

use crate::memory;

/// Bytes that the reductions of a case may take, if it says so.
pub(super) fn memory_limit(file: &Table) -> Option<usize> {
    file.optional_table("reduction")?.read(|table| {
        let text = table.optional_string("memory_limit")?;
        let bytes = memory::read(text.text());
        if bytes.is_none() {
            let message = format!("`memory_limit` cannot be `{}`", text.text());
            let help =
                "write a size such as `memory_limit = \"8 GiB\"`, in MB, GB, TB, MiB, GiB or TiB";
            table.push(text.error_here(Code::BAD_VALUE, message).help(help));
        }
        bytes
    })
}
