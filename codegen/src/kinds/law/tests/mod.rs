//! Laws in small files.

mod breaks;
mod errors;
mod states;
mod values;

use super::*;
use crate::diagnostic::Source;
use crate::kinds::law::report::Trend;
use crate::operation::Dual;
use crate::rational::Rational;

const HEAD: &str = "\
kind = \"law\"
name = \"test\"
title = \"t\"
source = \"s\"
";

fn read(body: &str) -> Result<LawSpec, Diagnostics> {
    LawSpec::read(&Source::new("law.toml", format!("{HEAD}{body}")))
}

fn messages(body: &str) -> Vec<String> {
    read(body).unwrap_err().iter().map(ToString::to_string).collect()
}

fn paper(engage: &str, polynomial: &str) -> String {
    format!(
        "[inputs.h]
unit = \"mm\"
[parameters]
c0 = {{ value = 35.687, unit = \"um\" }}
[outputs.Q]
unit = \"N\"
{engage}
pieces = [
  {{ when = 'h < c0', value = '{polynomial}' }},
  {{ value = '0' }},
]
"
    )
}

const LINEAR: &str = "233 - 6517*h";
const QUADRATIC: &str = "388 - 18632*h + 217550*h^2";

fn value(law: &LawSpec, inputs: &[f64]) -> f64 {
    law.evaluate(inputs).unwrap()[0]
}
