//! Who watches a run: hears of its progress, and may end it.

/// Is told what happens while a run is at work, on the thread that runs it. Nothing of it changes what is computed.
pub trait Watch {
    /// The march begins: steps that it has in all, and those that are done where it goes on.
    fn begun(&self, _steps: usize, _first: usize) {}

    /// So many steps are done, up to a time (s). After every step: what takes long should be done now and then only.
    fn progressed(&self, _step: usize, _time: f64) {}

    /// The march has ended.
    fn ended(&self) {}

    /// Whether the run is to end after its step. What is computed by then is kept.
    fn asked(&self) -> bool {
        false
    }

    /// Something to be known of the run, such as where it begins.
    fn note(&self, _words: &str) {}

    /// Something of the run that may be wrong.
    fn warn(&self, _words: &str) {}
}

/// Nobody.
#[derive(Debug, Clone, Copy, Default)]
pub struct Quiet;

impl Watch for Quiet {}
