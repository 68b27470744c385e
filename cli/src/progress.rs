//! Progress on stderr: a bar with the time left on a terminal, nothing elsewhere.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

/// A line that says what is being done, until it is dropped.
pub(crate) struct Spinner(ProgressBar);

/// Says `what` is being done.
pub(crate) fn spinner(what: &str) -> Spinner {
    let bar = ProgressBar::new_spinner().with_message(what.to_string());
    bar.enable_steady_tick(Duration::from_millis(100));
    Spinner(bar)
}

impl Drop for Spinner {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// A bar of steps.
pub(crate) struct Steps(ProgressBar);

/// A bar of `steps` time steps.
pub(crate) fn steps(steps: usize) -> Steps {
    let bar = ProgressBar::new(steps as u64);
    let style =
        ProgressStyle::with_template("{wide_bar} {pos}/{len} steps, {per_sec}, {eta} left; {msg}");
    if let Ok(style) = style {
        bar.set_style(style);
    }
    Steps(bar)
}

impl Steps {
    /// `step` steps are done, up to `time` s.
    pub(crate) fn done(&self, step: usize, time: f64) {
        // Formatting the time takes longer than a step; a hundredth of the steps is often enough to look.
        const LOOKS: usize = 64;
        if step.is_multiple_of(LOOKS) && !self.0.is_hidden() {
            self.0.set_position(step as u64);
            self.0.set_message(format!("t = {:.1} ms", 1e3 * time));
        }
    }
}

impl Drop for Steps {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}
