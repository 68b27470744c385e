//! The units of a description, as FMI defines them: a factor on products of powers of SI base units.

use whirl_codegen::units::Unit;

use super::xml::attribute;

/// The element of a unit, whose base units the standard calls by the same names. One with powers that are
/// no whole numbers is only named.
pub(super) fn element(text: &str) -> String {
    let name = attribute("name", text);
    let base = Unit::parse(text).ok().and_then(|unit| {
        let exponents = unit.dimension().exponents();
        if exponents.iter().any(|(_, own)| !own.is_integer()) {
            return None;
        }
        let mut all = String::new();
        for (base, exponent) in exponents {
            let exponent = exponent.to_integer();
            if exponent != 0 {
                all += &attribute(base, &exponent.to_string());
            }
        }
        let factor = unit.to_si(1.0);
        if factor != 1.0 {
            all += &attribute("factor", &format!("{factor:?}"));
        }
        Some(all)
    });
    match base {
        Some(base) => format!("    <Unit{name}><BaseUnit{base}/></Unit>\n"),
        None => format!("    <Unit{name}/>\n"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_powers_of_base_units() {
        let pairs = [
            ("N", r#"<Unit name="N"><BaseUnit m="1" kg="1" s="-2"/></Unit>"#),
            ("um", r#"<Unit name="um"><BaseUnit m="1" factor="1e-6"/></Unit>"#),
            ("rad/s", r#"<Unit name="rad/s"><BaseUnit s="-1" rad="1"/></Unit>"#),
            ("V", r#"<Unit name="V"><BaseUnit m="2" kg="1" s="-3" A="-1"/></Unit>"#),
            ("K", r#"<Unit name="K"><BaseUnit K="1"/></Unit>"#),
            ("1", r#"<Unit name="1"><BaseUnit/></Unit>"#),
            ("N/mm^1.5", r#"<Unit name="N/mm^1.5"/>"#),
        ];
        for (unit, expected) in pairs {
            assert_eq!(element(unit).trim(), expected);
        }
    }
}
