//! What a build would generate from a spec that is not built in.

use std::path::Path;

use whirl_codegen::diagnostic::Diagnostics;
use whirl_codegen::generate::{SpecFile, generate};
use whirl_codegen::kinds::list::Spec;
use whirl_specs::{ELEMENTS, FORMS, Origin};

use crate::spec_file;

/// The element on which forms are shown.
pub(super) const SHOWN_ON: &str = "hex8";

/// The module that a build would generate if the file lay in its folder: an element's with the built-in forms; forms'
/// with that of the element [`SHOWN_ON`] behind it, which has them alone.
///
/// # Errors
/// What a build would refuse, at the places where the user finds it.
pub(super) fn module(spec: &Spec) -> Result<String, Diagnostics> {
    let own = |path: &Path, text: &str, ending: &str| {
        let name = path.with_extension(ending);
        let name = name.file_name().unwrap_or_default().to_string_lossy();
        SpecFile { path: format!("{}/{name}", spec.kind().folder), text: text.to_string() }
    };
    let built_in =
        |origin: &Origin| SpecFile { path: origin.spec.to_string(), text: origin.text.to_string() };
    let file = spec.about().file;
    let mut files = vec![own(&file.path, &file.text, "toml")];
    match spec {
        Spec::Law(law) => {
            let tables = law.tables.iter().map(|table| &table.file);
            files.extend(tables.map(|file| own(&file.path, &file.text, "csv")));
        }
        Spec::Element(_) => files.extend(FORMS.iter().map(built_in)),
        Spec::Form(_) => {
            let shown_on = ELEMENTS.iter().filter(|element| element.origin.name == SHOWN_ON);
            files.extend(shown_on.map(|element| built_in(&element.origin)));
        }
        _ => {}
    }
    let generated = generate(&files).map_err(|errors| at_home(errors, spec, &files[0].path))?;
    let registry = spec.kind().registry;
    let shown = |name: &str| match name.strip_suffix(".rs") {
        Some("elements") if matches!(spec, Spec::Form(_)) => true,
        name => name == Some(registry),
    };
    let texts = generated.iter().filter(|file| shown(&file.name));
    Ok(texts.map(|file| file.text.as_str()).collect())
}

/// The errors at the files as the user knows them: `own` is the path that stood for the spec.
fn at_home(errors: Diagnostics, spec: &Spec, own: &str) -> Diagnostics {
    let mut found = Diagnostics::new();
    for mut error in errors {
        if error.path() == Path::new(own) {
            error.source = spec.about().file.clone();
        } else if let Some(origin) =
            spec_file::built_in().find(|origin| error.path() == Path::new(origin.spec))
        {
            error.source = spec_file::built_in_source(origin);
        }
        found.push(error);
    }
    found
}
