//! `whirl explain`: what a spec says, what follows from it, and where its generated code lies.

mod clearance;
mod element;
mod equations;
mod form;
mod generated_code;
mod kernels;
mod law;
mod motion;
mod page;
mod plot;

use std::path::Path;

use whirl_codegen::diagnostic::{Code, Diagnostic};
use whirl_specs::{Origin, generated};

use self::page::Page;
use crate::arguments::ExplainArguments;
use crate::errors::Failure;
use crate::figures;
use crate::output::Output;
use crate::spec_file::{self, Spec};

/// The page of a spec, or the Rust generated from it; writes its figure where one is asked for.
///
/// # Errors
/// Nothing is called so; whatever is wrong with the spec; a figure of something that is no law, or that
/// cannot be written; the Rust of a form that is built in; what a build would refuse of one that is not.
pub(crate) fn explain(arguments: &ExplainArguments) -> Result<String, Failure> {
    let (source, origin) = spec_file::find(&arguments.spec)?;
    let spec = Spec::read(&source)?;
    if let Some(path) = &arguments.plot {
        draw(&spec, path)?;
    }
    if arguments.rust { rust(&spec, origin) } else { Ok(page(&spec, origin)) }
}

/// What `whirl check` says of a spec file: its report, without equations and code.
///
/// # Errors
/// Whatever is wrong with the spec, and what a build would refuse of it.
pub(crate) fn check(name: &str) -> Result<String, Failure> {
    let (source, origin) = spec_file::find(name)?;
    let spec = Spec::read(&source)?;
    if origin.is_none() {
        generated_code::module(&spec)?;
    }
    let mut page = head(&spec);
    match &spec {
        Spec::Law(law) => law::check(&mut page, law),
        Spec::Element(element) => element::report(&mut page, element),
        Spec::Form(form) => form::report(&mut page, form),
        Spec::Motion(motion) => motion::report(&mut page, motion),
        Spec::Clearance(clearance) => clearance::report(&mut page, clearance),
    }
    Ok(page.text())
}

fn head(spec: &Spec) -> Page {
    let [name, title, reference] = spec.about();
    let mut page = Page::new(&format!("{} {name}: {title}", spec.kind()));
    page.line(&format!("source: {reference}"));
    page.line(&format!("file: {}", spec.file().path.display()));
    page
}

fn page(spec: &Spec, origin: Option<&Origin>) -> String {
    let mut page = head(spec);
    match spec {
        Spec::Law(law) => law::explain(&mut page, law),
        Spec::Element(element) => element::explain(&mut page, element),
        Spec::Form(form) => form::explain(&mut page, form),
        Spec::Motion(motion) => motion::explain(&mut page, motion),
        Spec::Clearance(clearance) => clearance::explain(&mut page, clearance),
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
        let message = format!("`--plot` draws laws; `{}` is a {}", spec.about()[0], spec.kind());
        let error = Diagnostic::new(spec.file(), Code::BAD_VALUE, None, message);
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
