//! What only shows among all specs: each name once, and what one asks of another.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::parallel;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::emit::identifier;
use crate::spec::kind::OfAnyKind;
use crate::spec::list::Spec;

pub(super) fn check(read: Vec<Result<Spec, Diagnostics>>) -> Result<Vec<Spec>, Diagnostics> {
    let mut names = Names::default();
    let mut taken = |spec: Spec| names.take_all(&spec).map(|()| spec);
    let specs = super::all(read.into_iter().map(|spec| spec.and_then(&mut taken)))?;
    let every: Vec<&OfAnyKind> = specs.iter().map(Spec::any).collect();
    super::all(parallel::map(&specs, super::size, |spec| spec.check(&every)))?;
    Ok(specs)
}

/// Names, and modules made from them, that are taken.
#[derive(Default)]
struct Names {
    taken: BTreeMap<(&'static str, String), Arc<Source>>,
}

impl Names {
    fn take_all(&mut self, spec: &Spec) -> Result<(), Diagnostics> {
        let source = spec.about().file;
        spec.names().into_iter().try_for_each(|(what, name)| self.take(what, name, source))
    }

    fn take(
        &mut self,
        what: &'static str,
        name: &str,
        source: &Arc<Source>,
    ) -> Result<(), Diagnostics> {
        let key = (what, identifier(name).to_string());
        if let Some(first) = self.taken.get(&key) {
            let first = first.path.display();
            let message = format!("the {what} `{name}` has the name of the one in `{first}`");
            let error = Diagnostic::new(source, Code::BAD_NAME, None, message);
            return Err(error.help("change it in one of the files").into());
        }
        self.taken.insert(key, source.clone());
        Ok(())
    }
}
