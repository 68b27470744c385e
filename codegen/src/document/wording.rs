//! Where messages about specs and about cases say the same in other words.

use super::tree::{Content, Node};
use crate::diagnostic::{Code, Diagnostic};

/// Whether messages speak to authors of specs or of cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wording {
    /// Strings, arrays, and keys with all that lead to them.
    Spec,
    /// Text, lists, and keys as they stand under their heading.
    Case,
}

impl Wording {
    /// What a value is.
    pub fn of(self, content: &Content) -> &'static str {
        match (self, content) {
            (Wording::Spec, Content::Text(_)) => "a string",
            (Wording::Spec, Content::Number(number)) if number.exact().is_some() => "a number",
            (Wording::Spec, Content::Number(_) | Content::Date) => {
                "a date or a number that is not finite"
            }
            (Wording::Spec, Content::Flag(_)) => "a truth value",
            (Wording::Spec, Content::List(_)) => "an array",
            (Wording::Case, Content::Text(_)) => "text",
            (Wording::Case, Content::Number(number)) if number.whole => "a whole number",
            (Wording::Case, Content::Number(_)) => "a number with a point",
            (Wording::Case, Content::Flag(_)) => "true or false",
            (Wording::Case, Content::Date) => "a date",
            (Wording::Case, Content::List(_)) => "a list",
            (_, Content::Table(_)) => "a table",
        }
    }

    /// The error of a value of another type than `wanted` for the key that messages call `called`.
    pub(super) fn wrong_type(
        self,
        called: &str,
        node: &Node,
        wanted: &str,
        example: &str,
    ) -> Diagnostic {
        let found = self.of(&node.content);
        let (message, help) = match self {
            Wording::Spec => {
                let message = format!("`{called}` must be {wanted}, not {found}");
                // An entry of a list has no key of its own.
                let own = called.rsplit('.').next().unwrap_or(called);
                (
                    message,
                    match own.ends_with(']') {
                        true => format!("write it as `{example}`"),
                        false => format!("write for example `{own} = {example}`"),
                    },
                )
            }
            Wording::Case => {
                let message = format!("`{called}` takes {wanted}, not {found}");
                (message, format!("such as `{called} = {example}`"))
            }
        };
        node.place.error(Code::BAD_VALUE, message).help(help)
    }
}
