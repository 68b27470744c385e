//! The code generated from a spec: where it is, and what each of its functions computes at what cost.

use whirl_codegen::kinds::form::FormSpec;
use whirl_codegen::kinds::list::Spec;
use whirl_codegen::kinds::page::Page;
use whirl_specs::{Origin, generated};

use super::generated_code::{self, SHOWN_ON};

/// Says where the code lies and what its functions do.
pub(super) fn explain(page: &mut Page, spec: &Spec, origin: Option<&Origin>) {
    page.heading("Generated Rust");
    let name = spec.about().name;
    let Some(module) = origin.and_then(|origin| generated::module(origin.spec)) else {
        explain_generated(page, spec);
        return;
    };
    let generated::Module { kind, name: own, file, line, .. } = module;
    page.item(&format!(
        "module whirl_specs::{kind}::{own}, printed by `whirl explain {name} --rust`"
    ));
    page.item(&format!("{}/{file}:{line}", generated::FOLDER));
    say(page, functions(module.text));
    if let Spec::Form(_) = spec {
        page.item(&format!(
            "and in the module of every element, such as `whirl explain {SHOWN_ON} --rust`"
        ));
    }
}

/// The same of a spec that is not built in.
fn explain_generated(page: &mut Page, spec: &Spec) {
    let generated = match generated_code::module(spec) {
        Ok(module) => functions(&module),
        Err(errors) => {
            page.item("none can be generated, so that a build would refuse it:");
            for error in errors.iter() {
                page.paragraph(6, &error.to_string());
            }
            return;
        }
    };
    let path = spec.about().file.path.display();
    page.item(&format!("as a build would generate it, printed by `whirl explain {path} --rust`"));
    page.item(&match spec {
        Spec::Law(_) => {
            "none is needed: the law is evaluated without a compiler, to the same bits".into()
        }
        _ => {
            format!("compiled at the next build if the file lies in `specs/{}`", spec.kind().folder)
        }
    });
    say(page, if let Spec::Form(form) = spec { of_forms(form, generated) } else { generated });
}

/// The functions of these forms: their own, and those of the element on which they are shown.
fn of_forms(spec: &FormSpec, mut generated: Vec<(String, String)>) -> Vec<(String, String)> {
    let all = || spec.forms.iter().chain(&spec.stresses);
    let is_form = |name: &str| all().any(|form| form.name == name);
    let of_form = |name: &str| {
        let shared = name.strip_suffix("_pairs").or_else(|| name.strip_suffix("_points"));
        shared.is_some_and(is_form)
    };
    generated.retain(|(name, _)| is_form(name) || of_form(name));
    for (name, _) in generated.iter_mut().filter(|(name, _)| is_form(name)) {
        name.push_str(&format!(", on the element {SHOWN_ON}"));
    }
    generated
}

fn say(page: &mut Page, functions: Vec<(String, String)>) {
    for (name, about) in functions {
        page.item(&name);
        page.paragraph(6, &about);
    }
}

/// Functions with documentation of their own, equations left out: these stand above.
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
        } else if let Some(rest) = line.strip_prefix("pub ").unwrap_or(line).strip_prefix("fn ") {
            let name: String =
                rest.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            found.push((name, std::mem::take(&mut about)));
        } else if !line.starts_with("#[") {
            about.clear();
        }
    }
    found.retain(|(_, about)| !about.is_empty());
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
