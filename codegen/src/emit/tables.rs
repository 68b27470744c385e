//! Constant arrays of numbers go around the parser, which takes many times as long for a number as its text
//! does: they are taken out of a file's tokens before and put back as what the parser would have made of them.

use proc_macro2::{Delimiter, Group, Literal, TokenStream, TokenTree};
use syn::punctuated::Punctuated;
use syn::{Expr, ExprArray, ExprLit, ExprUnary, Item, Lit, Token, UnOp};

/// The items with `[]` for the value of every constant that is an array, in modules too; the values come to
/// `taken` in their order. A value lists its entries: `[entry; count]` is none of these.
pub(super) fn take_out(items: TokenStream, taken: &mut Vec<TokenStream>) -> TokenStream {
    // Inside a constant, right behind its `=`, and before the items of a module.
    let (mut constant, mut value, mut module) = (false, false, false);
    let token = |token| {
        let array = std::mem::take(&mut value);
        match token {
            TokenTree::Group(group) => {
                let delimiter = group.delimiter();
                let inside = match delimiter {
                    Delimiter::Bracket if array => {
                        taken.push(inside(group));
                        TokenStream::new()
                    }
                    Delimiter::Brace if std::mem::take(&mut module) => {
                        take_out(inside(group), taken)
                    }
                    _ => {
                        constant &= delimiter != Delimiter::Brace;
                        return TokenTree::Group(group);
                    }
                };
                return TokenTree::Group(Group::new(delimiter, inside));
            }
            TokenTree::Punct(ref sign) => {
                value = constant && sign.as_char() == '=';
                constant &= sign.as_char() != ';';
            }
            TokenTree::Ident(ref word) => {
                constant |= word == "const";
                module |= word == "mod";
            }
            TokenTree::Literal(_) => {}
        }
        token
    };
    items.into_iter().map(token).collect()
}

/// The tokens of a group, which are not shared with it: so none is copied to be read.
fn inside(group: Group) -> TokenStream {
    group.stream()
}

/// Puts the values that [`take_out`] took back.
pub(super) fn put_back(
    items: &mut [Item],
    taken: &mut impl Iterator<Item = TokenStream>,
) -> syn::Result<()> {
    for item in items {
        match item {
            Item::Mod(module) => {
                if let Some((_, items)) = &mut module.content {
                    put_back(items, taken)?;
                }
            }
            Item::Const(constant) => {
                if let Expr::Array(array) = &mut *constant.expr {
                    array.elems = entries(taken.next().unwrap_or_default())?;
                }
            }
            _ => {}
        }
    }
    Ok(())
}

fn entries(values: TokenStream) -> syn::Result<Punctuated<Expr, Token![,]>> {
    let mut entries = Punctuated::new();
    let mut tokens = Vec::new();
    for token in values {
        match token {
            TokenTree::Punct(sign) if sign.as_char() == ',' => entries.push(entry(&mut tokens)?),
            token => tokens.push(token),
        }
    }
    if !tokens.is_empty() {
        entries.push(entry(&mut tokens)?);
    }
    Ok(entries)
}

/// The entry that `tokens` are, which are none then.
fn entry(tokens: &mut Vec<TokenTree>) -> syn::Result<Expr> {
    let attrs = Vec::new;
    Ok(match (tokens.pop(), &tokens[..]) {
        (Some(TokenTree::Literal(size)), []) => number(size),
        (Some(TokenTree::Literal(size)), [TokenTree::Punct(sign)]) if sign.as_char() == '-' => {
            tokens.clear();
            let op = UnOp::Neg(Default::default());
            Expr::Unary(ExprUnary { attrs: attrs(), op, expr: Box::new(number(size)) })
        }
        (Some(TokenTree::Group(group)), []) if group.delimiter() == Delimiter::Bracket => {
            let (bracket_token, elems) = (Default::default(), entries(inside(group))?);
            Expr::Array(ExprArray { attrs: attrs(), bracket_token, elems })
        }
        (last, _) => syn::parse2(tokens.drain(..).chain(last).collect())?,
    })
}

fn number(size: Literal) -> Expr {
    let text = size.to_string();
    // What is kept as it is counts as no whole number, of which arrays are written on fewer lines.
    let whole = text.bytes().all(|byte| byte.is_ascii_digit());
    let lit = if whole { Lit::new(size) } else { Lit::Verbatim(size) };
    Expr::Lit(ExprLit { attrs: Vec::new(), lit })
}

#[cfg(test)]
mod tests {
    use quote::quote;

    use crate::emit::formatted;

    #[test]
    fn arrays_are_written_as_if_they_were_parsed() {
        let entries =
            quote!(-1.0, 0.1234567890123456, 1e-9, 22.0, 3.5e300, -0.0, 0.25, 4.0, 5.0, 6.0);
        let whole = quote!(
            0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22
        );
        let tables = quote! {
            const FEW: [f64; 2] = [1.0, -2.0];
            const NONE: [f64; 0] = [];
            const MANY: [f64; 10] = [#entries];
            const WHOLE: [usize; 23] = [#whole];
            pub const ROWS: [[f64; 10]; 2] = [[#entries], [#entries,]];
            const NAMES: [&str; 2] = ["a", "b"];
            const SUMS: [f64; 2] = [1.0 + 2.0, f64::NAN];
            const fn counts() -> [usize; 2] { let found = [1, 2]; found }
            const ONE: f64 = TABLE[1];
            const BEHIND: &[f64] = &[1.0];
        };
        let file = quote!(#tables pub mod kernels { #tables mod inner { #tables } });
        let parsed = syn::parse2(file.clone()).expect("Rust");
        assert_eq!(formatted(file).expect("Rust"), prettyplease::unparse(&parsed));
        assert!(formatted(quote!(const WRONG: [f64; 2] = [1.0 2.0];)).is_err());
        assert!(formatted(quote!(const WRONG: [f64; 2] = [1.0,, 2.0];)).is_err());
    }
}
