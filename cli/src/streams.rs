//! Standard output and standard error. What cannot be written there is no panic.

use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

use crate::errors::Failure;

/// Writes `text` to standard output. A pipe that is closed at its other end is no error: the reader has all that it
/// wants, and the command ends as it would have.
///
/// # Errors
/// [`Failure::StandardOutput`] where it cannot be written, such as on a full device.
pub(crate) fn say(text: &str) -> Result<(), Failure> {
    write(&mut io::stdout().lock(), text)
        .map_err(|error| Failure::StandardOutput { reason: error.to_string() })
}

/// What `work` gives, once the warnings that it adds to a list are written to standard error: each once, though two
/// bodies have the same mesh.
pub(crate) fn warned<T>(work: impl FnOnce(&mut Vec<String>) -> T) -> T {
    let mut warnings = Vec::new();
    let made = work(&mut warnings);
    for (place, warning) in warnings.iter().enumerate() {
        if !warnings[..place].contains(warning) {
            warn(warning);
        }
    }
    made
}

/// Writes a warning to standard error, as far as that can be written.
pub(crate) fn warn(what: impl Display) {
    note(format_args!("warning: {what}"));
}

/// Writes a line to standard error, as far as that can be written.
pub(crate) fn note(line: impl Display) {
    print_error(&format!("{line}\n"));
}

/// Writes `text` to standard error, as far as that can be written: there is no other place to report why not.
pub(crate) fn print_error(text: &str) {
    let _ = write(&mut io::stderr().lock(), text);
}

fn write(stream: &mut dyn Write, text: &str) -> io::Result<()> {
    match stream.write_all(text.as_bytes()).and_then(|()| stream.flush()) {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stream on which every write fails in one way.
    struct Failing(ErrorKind);

    impl Write for Failing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn a_closed_pipe_is_no_error_and_a_full_device_is_one() {
        assert!(write(&mut Failing(ErrorKind::BrokenPipe), "words").is_ok());
        let error = write(&mut Failing(ErrorKind::StorageFull), "words").unwrap_err();
        assert_eq!(error.kind(), ErrorKind::StorageFull);
        let mut written = Vec::new();
        write(&mut written, "words").unwrap();
        assert_eq!(written, b"words");
    }
}
