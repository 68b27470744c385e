//! Laws as a kind of spec.

use std::sync::Arc;

use super::LawSpec;
use crate::diagnostic::{Diagnostics, Source};
use crate::spec::kind::{About, Beside, SpecKind};

impl SpecKind for LawSpec {
    const KIND: &'static str = "law";
    const FOLDER: &'static str = "laws";
    const REGISTRY: &'static str = "laws";
    const ENTRY: &'static str = "Law";

    fn read_with(file: &Arc<Source>, beside: &Beside<'_>) -> Result<Self, Diagnostics> {
        LawSpec::read_with(file, beside)
    }

    fn about(&self) -> About<'_> {
        let LawSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: self.texts().skip(1).collect() }
    }

    fn tables(&self) -> Vec<&Arc<Source>> {
        self.tables.iter().map(|table| &table.file).collect()
    }
}
