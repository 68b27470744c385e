//! The list of kinds of specs: reading by kind, folders, schemas, kernels and explanations follow from it.

use std::sync::Arc;

use super::kind::{About, Beside, Compiled, Explained, Kind, OfAnyKind, Other, SpecKind};
use super::page::Page;
use super::{clearance, element, form, law, motion};
use crate::diagnostic::{Diagnostics, Source};
use crate::document::Document;

macro_rules! kinds {
    ($($(#[$about:meta])* $kind:ident($spec:ty)),* $(,)?) => {
        /// All kinds of specs.
        pub static KINDS: &[Kind] = &[$(Kind::of::<$spec>()),*];

        /// A spec that was read without errors, with all that follows from it.
        #[derive(Debug)]
        pub enum Spec {
            $($(#[$about])* $kind(Box<$spec>)),*
        }

        impl Spec {
            /// Reads a file of the kind that it says, which must be one of `kinds`.
            ///
            /// # Errors
            /// Everything wrong with it, each with its place.
            pub fn read(
                file: &Arc<Source>,
                kinds: &[&'static str],
                beside: &Beside<'_>,
            ) -> Result<Spec, Diagnostics> {
                let document = Document::parse(file);
                let kind = if document.is_toml() { document.kind(kinds) } else { None };
                let kind = document.into_result(kind)?;
                $(if kind == <$spec>::KIND {
                    let spec = <$spec as SpecKind>::read_with(file, beside)?;
                    return Ok(Spec::$kind(Box::new(spec)));
                })*
                unreachable!("{kind} is not in the list of kinds")
            }

            /// What kind of spec it is.
            pub fn kind(&self) -> &'static Kind {
                match self { $(Spec::$kind(_) => const { &Kind::of::<$spec>() }),* }
            }

            /// What it says about itself.
            pub fn about(&self) -> About<'_> {
                match self { $(Spec::$kind(spec) => SpecKind::about(&**spec)),* }
            }

            /// The files beside its own that it was read from.
            pub fn tables(&self) -> Vec<&Arc<Source>> {
                match self { $(Spec::$kind(spec) => SpecKind::tables(&**spec)),* }
            }

            /// Writes what was found about it when it was read.
            pub fn report(&self, page: &mut Page) {
                match self { $(Spec::$kind(spec) => Explained::report(&**spec, page)),* }
            }

            /// Writes all that it says and all that follows from it, but its code.
            pub fn explain(&self, page: &mut Page) {
                match self { $(Spec::$kind(spec) => Explained::explain(&**spec, page)),* }
            }
        }

        impl Spec {
            pub(crate) fn names(&self) -> Vec<(&'static str, &str)> {
                match self { $(Spec::$kind(spec) => SpecKind::names(&**spec)),* }
            }

            pub(crate) fn any(&self) -> &OfAnyKind {
                match self { $(Spec::$kind(spec) => &**spec),* }
            }

            pub(crate) fn check(&self, all: &[&OfAnyKind]) -> Result<(), Diagnostics> {
                match self { $(Spec::$kind(spec) => SpecKind::check(&**spec, all)),* }
            }

            /// The programs are of the type that [`Spec::emit`] takes.
            pub(crate) fn schedule(
                &self,
                all: &[&OfAnyKind],
            ) -> Result<Box<OfAnyKind>, Diagnostics> {
                Ok(match self { $(Spec::$kind(spec) => Box::new(spec.schedule(all)?)),* })
            }

            pub(crate) fn emit(&self, programs: &OfAnyKind, others: &[Other<'_>]) -> String {
                match self {
                    $(Spec::$kind(spec) => {
                        spec.emit(programs.downcast_ref().expect("its programs"), others)
                    })*
                }
            }
        }
    };
}

kinds! {
    /// A bearing law.
    Law(law::LawSpec),
    /// A finite element.
    Element(element::ElementSpec),
    /// Bilinear forms.
    Form(form::FormSpec),
    /// The motion of a shaft.
    Motion(motion::MotionSpec),
    /// The clearance of springs.
    Clearance(clearance::ClearanceSpec),
}
