//! What the readers of all kinds of specs do alike.

use std::sync::Arc;

use crate::diagnostic::{Code, Diagnostics, Located, Source};
use crate::document::schema::Shape;
use crate::document::{Document, Table, plain_name};
use crate::formula;
use crate::units::{Unit, UnitError};

/// Finds the file of a name beside a spec, or says why there is none.
pub(crate) type FindFile<'a> = dyn Fn(&str) -> Result<Arc<Source>, String> + 'a;

/// What a spec says of itself, as far as it does.
pub(super) struct Head {
    pub(super) name: Option<Located>,
    title: Option<Located>,
    reference: Option<Located>,
}

impl Head {
    /// Name, title and reference, if all are there.
    pub(super) fn texts(self) -> Option<[String; 3]> {
        let text = |text: Located| text.text().to_owned();
        Some([text(self.name?), text(self.title?), text(self.reference?)])
    }

    /// Notes a name that is not made of characters that are `fine`.
    pub(super) fn check(&self, document: &Document<'_>, fine: fn(char) -> bool, message: &str) {
        let Some(name) = &self.name else { return };
        if name.text().is_empty() || !name.text().chars().all(fine) {
            let error = name.error_here(Code::BAD_NAME, message);
            document.push(error.help(plain_name(name.text(), fine)));
        }
    }
}

/// What `read` makes of a file, if it is TOML, and of its head.
pub(super) fn spec<T>(
    file: &Arc<Source>,
    shape: &'static Shape,
    read: impl for<'d> FnOnce(&'d Document<'d>, Table<'d>, Head) -> Option<T>,
) -> Result<T, Diagnostics> {
    let document = Document::parse(file);
    if !document.is_toml() {
        return document.into_result(None);
    }
    let root = document.root(shape);
    root.word("kind");
    let [name, title, reference] = ["name", "title", "source"].map(|key| root.string(key));
    let spec = read(&document, root, Head { name, title, reference });
    document.into_result(spec)
}

/// The name that a key is, if formulas may use it and `free` says nothing against it.
pub(super) fn name(
    document: &Document<'_>,
    key: &Located,
    free: impl FnOnce(String) -> Result<String, String>,
) -> Option<String> {
    let refuse = |message| {
        document.push(key.error_here(Code::BAD_NAME, message).help("choose another name"));
    };
    formula::name(key.text()).and_then(free).map_err(refuse).ok()
}

/// The unit that a text is.
pub(super) fn unit(document: &Document<'_>, text: &Located) -> Option<Unit> {
    let refuse = |error: UnitError| {
        let found = text.error(error.code, error.span, error.message);
        document.push(found.maybe_help(error.help));
    };
    Unit::parse(text.text()).map_err(refuse).ok()
}
