//! A picture that the user asks for: one file, SVG or PNG by its ending.

use std::path::Path;

use crate::errors::Failure;
use crate::figures;
use crate::output;

/// Whether a file is to be a PNG.
///
/// # Errors
/// It is neither PNG nor SVG.
pub(crate) fn is_png(file: &Path) -> Result<bool, Failure> {
    let ending = file.extension().map(|end| end.to_string_lossy().to_ascii_lowercase());
    match ending.as_deref() {
        Some("svg") => Ok(false),
        Some("png") => Ok(true),
        _ => Err(Failure::Argument {
            message: format!("`{}` is neither an SVG nor a PNG file", file.display()),
            help: format!("write `--picture {}`", file.with_extension("png").display()),
        }),
    }
}

/// Writes an SVG as it is, or as a PNG.
///
/// # Errors
/// Another ending, a file that cannot be written.
pub(crate) fn write(svg: String, file: &Path) -> Result<(), Failure> {
    let failure = |reason: &str| Failure::Output { path: file.into(), reason: reason.into() };
    let content = match is_png(file)? {
        true => figures::png(&svg).ok_or_else(|| failure("the picture has no area"))?,
        false => svg.into_bytes(),
    };
    output::write_file(file, content)
}
