//! `whirl explain`: what a spec says, what follows from it, and where its generated code lies.

mod generated_code;
mod kernels;
mod matrices;
mod plot;

use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Source};
use whirl_codegen::kinds::kind::About;
use whirl_codegen::kinds::list::Spec;
use whirl_codegen::kinds::page::Page;
use whirl_specs::{Origin, generated};

use crate::arguments::ExplainArguments;
use crate::errors::Failure;
use crate::figures;
use crate::output::Output;
use crate::spec_file;

/// The page of a spec, or the Rust generated from it; writes its figure where one is asked for.
///
/// # Errors
/// Nothing is called so; whatever is wrong with the spec; a figure of something that is no law, or that
/// cannot be written; the Rust of a form that is built in; what a build would refuse of one that is not.
pub(crate) fn explain(arguments: &ExplainArguments) -> Result<String, Failure> {
    let (source, origin) = spec_file::find(&arguments.spec)?;
    let spec = spec_file::read(&source)?;
    if let Some(path) = &arguments.plot {
        draw(&spec, path)?;
    }
    if arguments.rust { rust(&spec, origin) } else { Ok(page(&spec, origin)) }
}

/// The page of the spec called `name`, as [`explain`] prints it.
///
/// # Errors
/// Nothing is called so; whatever is wrong with the spec.
pub(crate) fn of_name(name: &str) -> Result<String, Failure> {
    let (source, origin) = spec_file::find(name)?;
    of_source(&source, origin)
}

/// The page of a spec.
///
/// # Errors
/// Whatever is wrong with it.
pub(crate) fn of_source(source: &Arc<Source>, origin: Option<&Origin>) -> Result<String, Failure> {
    Ok(page(&spec_file::read(source)?, origin))
}

/// What `whirl check` says of a spec file: its report, without equations and code.
///
/// # Errors
/// Whatever is wrong with the spec, and what a build would refuse of it.
pub(crate) fn check(name: &str) -> Result<String, Failure> {
    let (source, origin) = spec_file::find(name)?;
    let spec = spec_file::read(&source)?;
    if origin.is_none() {
        generated_code::module(&spec)?;
    }
    let mut page = head(&spec);
    spec.report(&mut page);
    Ok(page.text())
}

fn head(spec: &Spec) -> Page {
    let About { name, title, reference, file, .. } = spec.about();
    let mut page = Page::new(&format!("{} {name}: {title}", spec.kind().name));
    page.line(&format!("source: {reference}"));
    page.line(&format!("file: {}", file.path.display()));
    page
}

fn page(spec: &Spec, origin: Option<&Origin>) -> String {
    let mut page = head(spec);
    spec.explain(&mut page);
    match spec {
        Spec::Law(law) => plot::explain(&mut page, law),
        Spec::Element(element) => matrices::explain(&mut page, element),
        _ => {}
    }
    kernels::explain(&mut page, spec, origin);
    page.text()
}

fn rust(spec: &Spec, origin: Option<&Origin>) -> Result<String, Failure> {
    match origin.and_then(|origin| generated::module(origin.spec)) {
        Some(module) => Ok(module.text.to_string()),
        None => Ok(generated_code::module(spec)?),
    }
}

/// Writes the figure of a law as SVG and PNG: `path` with either ending.
fn draw(spec: &Spec, path: &Path) -> Result<(), Failure> {
    let Spec::Law(law) = spec else {
        let About { name, file, .. } = spec.about();
        let message =
            format!("`--plot` draws laws; `{name}` is of the kind `{}`", spec.kind().name);
        let error = Diagnostic::new(file, Code::BAD_VALUE, None, message);
        return Err(Failure::Input(error.help("leave `--plot` out").into()));
    };
    let Some(stem) = path.file_stem().map(|stem| stem.to_string_lossy().into_owned()) else {
        let reason = "it names no file".to_string();
        return Err(Failure::Output { path: path.to_path_buf(), reason });
    };
    let mut output = Output::open(path.parent().unwrap_or(Path::new("")))?;
    figures::draw_law(law, &stem, &mut output);
    output.commit()?;
    Ok(())
}
