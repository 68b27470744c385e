//! The code made from a spec: where it lies, and what each of its functions computes at what cost.

use whirl_codegen::diagnostic::Diagnostics;
use whirl_codegen::generate::{SpecFile, generate};
use whirl_codegen::spec::form::FormSpec;
use whirl_specs::{ELEMENTS, FORMS, Origin, generated};

use super::page::Page;
use crate::spec_file::{self, Spec};

/// Folder of the specs in which a file of this kind is compiled.
pub(super) fn folder(spec: &Spec) -> &'static str {
    match spec {
        Spec::Law(_) => "laws",
        Spec::Element(_) => "elements",
        Spec::Form(_) => "forms",
        Spec::Motion(_) | Spec::Clearance(_) => "motion",
    }
}

/// Where the kernels of forms are.
pub(super) fn in_elements() -> String {
    let element = ELEMENTS.first().map_or("ELEMENT", |element| element.origin.name);
    format!("in the module of every element, such as `whirl explain {element} --rust`")
}

/// Says where the code lies and what its functions do.
pub(super) fn explain(page: &mut Page, spec: &Spec, origin: Option<&Origin>) {
    page.heading("Generated Rust");
    let name = spec.about()[0];
    let Some(origin) = origin else {
        if matches!(spec, Spec::Law(_)) {
            page.item("none: the law is evaluated without a compiler, to the same bits");
        }
        page.item(&format!(
            "compiled at the next build if the file lies in `specs/{}`",
            folder(spec)
        ));
        if !matches!(spec, Spec::Law(_)) {
            match made(spec) {
                Ok(functions) => say(page, functions),
                Err(errors) => page.paragraph(2, &format!("none can be made from it: {errors}")),
            }
        }
        return;
    };
    let Some(module) = generated::module(origin.spec) else {
        page.paragraph(2, &in_elements());
        return;
    };
    let generated::Module { kind, name: own, file, line, .. } = module;
    page.item(&format!(
        "module whirl_specs::{kind}::{own}, printed by `whirl explain {name} --rust`"
    ));
    page.item(&format!("{}/{file}:{line}", generated::FOLDER));
    say(page, functions(module.text));
}

fn say(page: &mut Page, functions: Vec<(String, String)>) {
    for (name, about) in functions {
        page.item(&name);
        page.paragraph(6, &about);
    }
}

/// The functions that a build would make from a spec that is not built in: an element with the built-in
/// forms, forms on a built-in element.
fn made(spec: &Spec) -> Result<Vec<(String, String)>, Diagnostics> {
    let path = format!("{}/explained.toml", folder(spec));
    let own = SpecFile { path: path.clone(), text: spec.file().text.clone() };
    let mut files = vec![own];
    let built_in =
        |origin: &Origin| SpecFile { path: origin.spec.to_string(), text: origin.text.to_string() };
    let names: Vec<&str> = match spec {
        Spec::Element(_) => {
            files.extend(FORMS.iter().map(built_in));
            Vec::new()
        }
        Spec::Form(form) => {
            // Forms of the same names give way.
            let names: Vec<&str> = form.forms.iter().map(|form| form.name.as_str()).collect();
            let taken = |origin: &&Origin| {
                let other = FormSpec::read(&spec_file::built_in_source(origin));
                origin.name == form.name
                    || other.is_ok_and(|other| {
                        other.forms.iter().any(|own| names.contains(&own.name.as_str()))
                    })
            };
            files.extend(FORMS.iter().filter(|origin| !taken(origin)).map(built_in));
            let plain = ELEMENTS.iter().find(|element| element.origin.name == "hex8");
            files.extend(plain.map(|element| built_in(&element.origin)));
            names
        }
        _ => Vec::new(),
    };
    let mut found = Vec::new();
    for file in generate(&files)? {
        found.extend(functions(&file.text));
    }
    if let Spec::Form(_) = spec {
        let own = |name: &str| name.strip_suffix("_lane").is_some_and(|form| names.contains(&form));
        found.retain(|(name, _)| own(name));
        for (name, about) in &mut found {
            name.push_str(", on the element hex8");
            *about = about.replace(&path, &spec.file().path.display().to_string());
        }
    }
    Ok(found)
}

/// Public functions with their documentation, equations left out: these stand above.
fn functions(module: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let (mut about, mut verbatim) = (String::new(), false);
    for line in module.lines().map(str::trim) {
        if let Some(words) = line.strip_prefix("///") {
            if words.trim_start().starts_with("```") {
                verbatim = !verbatim;
            } else if !verbatim {
                about.push_str(words);
            }
        } else if let Some(rest) = line.strip_prefix("pub fn ") {
            let name: String =
                rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            found.push((name, std::mem::take(&mut about)));
        } else if !line.starts_with("#[") {
            about.clear();
        }
    }
    // What only points elsewhere says nothing of its own.
    found.retain(|(_, about)| !about.is_empty() && !about.contains(": see [`crate::"));
    found
}

#[cfg(test)]
mod tests {
    use super::functions;

    #[test]
    fn functions_are_found_with_their_words() {
        let text = "/// Law.\npub mod law {\n    /// Q of h.\n    ///\n    /// ```text\n    /// Q = h\n    \
                    /// ```\n    ///\n    /// 4 add.\n    #[inline(always)]\n    pub fn value<L: Lane>(h: L) -> L {\n        h\n    }\n    \
                    /// A table.\n    const X: f64 = 1.0;\n    pub fn bare() {}\n}\n";
        assert_eq!(functions(text), [("value".to_string(), " Q of h. 4 add.".to_string())]);
    }
}
