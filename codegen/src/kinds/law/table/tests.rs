use std::sync::Arc;

use super::*;
use crate::diagnostic::Diagnostics;
use crate::kinds::law::LawSpec;
use crate::operation::Dual;
use crate::tape::Tape;

/// Points of x³ + x, which rises everywhere, and a row that repeats a value.
const RISING: &str = "\
# a comment
gap [mm],force [N]
0,0
0.5,0.625
1,2
1.5,4.875
2,10
3,10
";

/// Where the input stands: a whole number that changes where the table passes to another cubic.
fn interval(table: &LawTable, input: f64) -> i64 {
    let (input, turns) = match table.turns(input) {
        Some(turns) => (input - turns as f64 * nearest(&table.period()), turns),
        None => (input, 0),
    };
    let place = table.splits.partition_point(|at| nearest(at) <= input);
    let outside = i64::from(table.extend == Extend::Refuse && table.is_outside(input));
    turns * (table.pieces.len() as i64 + 1) + place as i64 - outside * i64::from(i32::MAX)
}

fn law(keys: &str, range: &str, columns: &str) -> Result<LawSpec, Diagnostics> {
    let text = format!(
        "kind = \"law\"\nname = \"t\"\ntitle = \"t\"\nsource = \"s\"\n[inputs]\n\
         h = {{ unit = \"mm\", range = {range} }}\n\
         [tables.f]\nfile = \"f.csv\"\ninput = 'h'\n{keys}\n\
         [outputs.Q]\nunit = \"N\"\nvalue = 'f'\n"
    );
    let columns: Arc<Source> = Source::new("f.csv", columns);
    LawSpec::read_with(&Source::new("law.toml", text), &move |name| {
        if name == "f.csv" { Ok(columns.clone()) } else { Err(format!("no `{name}`")) }
    })
}

fn fine(keys: &str, columns: &str) -> LawSpec {
    law(keys, "[0, 3]", columns).unwrap_or_else(|errors| panic!("{errors}"))
}

fn messages(keys: &str, columns: &str) -> Vec<String> {
    law(keys, "[0, 3]", columns).unwrap_err().iter().map(ToString::to_string).collect()
}

fn value(law: &LawSpec, h: f64) -> f64 {
    law.evaluate(&[h]).unwrap()[0]
}

/// Value and derivative by the tape.
fn taped(law: &LawSpec, h: f64) -> [f64; 2] {
    let tape = Tape::new(&law.program().unwrap());
    let mut rows = [0.0; 2];
    tape.evaluate(1, &[h], &mut rows, &mut vec![0.0; tape.workspace()]);
    rows
}

#[test]
fn the_cubic_passes_through_its_rows_and_is_monotone() {
    let law = fine("", RISING);
    for (h, q) in [(0.0, 0.0), (0.5e-3, 0.625), (1e-3, 2.0), (1.5e-3, 4.875), (2e-3, 10.0)] {
        assert!((value(&law, h) - q).abs() < 1e-13, "{h}");
    }
    let mut last = 0.0;
    for i in 0..=3000 {
        let next = value(&law, f64::from(i) * 1e-6);
        // Rounding of values of at most 10.
        assert!(next >= last - 1e-14, "{i}");
        last = next;
    }
    // Between equal rows it is constant.
    assert!((value(&law, 2.7e-3) - 10.0).abs() < 1e-14);
}

/// Numbers as other programs write them, and lines of separators alone.
#[test]
fn numbers_may_begin_or_end_with_a_point() {
    let plain = fine("", "x [mm],y [N]\n0,-0.5\n1,2\n3,300\n");
    let other = fine("", "x [mm],y [N]\n0.,-.5\n+1.,2.\n.3e1,3.e2\n,,\n,\n");
    for h in [0.0, 0.3e-3, 1.1e-3, 2.5e-3] {
        assert_eq!(value(&plain, h), value(&other, h));
    }
    for wrong in [".", "-.", "1..2", "1..2e3", "1e5.", "e5", ".e5", "1.2.3", ""] {
        let text = format!("x [mm],y [N]\n0,1\n1,{wrong}\n2,3\n");
        assert!(law("", "[0, 2]", &text).is_err(), "{wrong}");
    }
}

#[test]
fn values_are_of_third_order() {
    // e^x on [0, 1] with twice as many rows: the error falls eightfold, in the limit.
    let error = |count: u32| {
        let mut text = "x [mm] y [N]\n".to_owned();
        for i in 0..=count {
            let x = f64::from(i) / f64::from(count);
            text += &format!("{x:.17} {:.17}\n", x.exp());
        }
        let law = law("", "[0, 1]", &text).unwrap();
        (1..500).fold(0.0_f64, |worst, i| {
            let x = f64::from(i) / 500.0;
            worst.max((value(&law, 1e-3 * x) - x.exp()).abs())
        })
    };
    let errors = [error(15), error(30), error(60)];
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((2.8..3.5).contains(&order), "{order}");
    }
}

#[test]
fn derivatives_agree_three_ways_beyond_the_ends_too() {
    let ring = "psi [deg]\tk [1]\n0\t3\n90\t5\n200\t4\n270\t1\n360\t3\n";
    let psi = "kind = \"law\"\nname = \"t\"\ntitle = \"t\"\nsource = \"s\"\n\
               [inputs]\npsi = { unit = \"rad\", range = [-7, 14] }\n\
               [tables.f]\nfile = \"f.csv\"\ninput = 'psi'\nextend = \"periodic\"\n\
               [parameters]\nF = { value = 1, unit = \"N\" }\n[outputs.Q]\nunit = \"N\"\nvalue = 'F*f^2'\n";
    let columns = Source::new("f.csv", ring);
    let ring = LawSpec::read_with(&Source::new("law.toml", psi), &|_| Ok(columns.clone())).unwrap();
    let wide = |extend: &str| {
        law(&format!("extend = \"{extend}\""), "[-2, 5]", RISING).unwrap_or_else(|e| panic!("{e}"))
    };
    for (law, low, high) in
        [(wide("linear"), -2e-3, 5e-3), (wide("constant"), -2e-3, 5e-3), (ring, -7.0, 14.0)]
    {
        let width = high - low;
        for i in 0..97 {
            let x = low + width * (f64::from(i) + 0.37) / 97.0;
            let dual = law.evaluate(&[Dual::variable(x)]).unwrap()[0];
            let [q, slope] = taped(&law, x);
            let steep = 30.0 / width;
            // A few roundings of values of at most 25, and of arguments that pass a tangent.
            assert!((q - dual.value).abs() < 1e-12 * 25.0, "{x}: {q} {}", dual.value);
            assert!((slope - dual.slope).abs() < 1e-11 * steep, "{x}: {slope} {}", dual.slope);
            // Central differences of a cubic: the error is a quarter for half the step.
            let central =
                |step: f64| (value(&law, x + step) - value(&law, x - step)) / (2.0 * step);
            let steps = [2e-4 * width, 1e-4 * width];
            let interval =
                |x: f64| interval(&law.tables[0], x / law.inputs[0].unit.factor().to_f64());
            if interval(x - steps[0]) != interval(x + steps[0]) {
                continue;
            }
            let errors = steps.map(|step| (central(step) - dual.slope).abs());
            let rounding = 1e-14 * 25.0 / steps[1];
            assert!(errors[1] <= 0.26 * errors[0] + rounding, "{x}: {errors:?}");
        }
    }
}

#[test]
fn outside_the_rows_the_mode_decides() {
    let of = |extend: &str| law(&format!("extend = \"{extend}\""), "[-1, 4]", RISING).unwrap();
    let (constant, linear) = (of("constant"), of("linear"));
    assert_eq!(value(&constant, -1e-3), 0.0);
    assert_eq!(taped(&constant, 4e-3), [10.0, 0.0]);
    // The parabola through the first three rows has the slope 0.5 at the first.
    assert!((value(&linear, -1e-3) + 0.5).abs() < 1e-14);
    assert!((taped(&linear, -1e-3)[1] - 500.0).abs() < 1e-10);
    let refused = fine("", RISING);
    assert!(value(&refused, -1e-6).is_nan() && taped(&refused, 3.1e-3)[0].is_nan());
    assert!(value(&refused, 0.0) == 0.0 && taped(&refused, 3e-3)[0] == 10.0);
    let found = law("", "[0, 4]", RISING).unwrap_err().to_string();
    assert!(found.contains("the rows of `f.csv` end at 3"), "{found}");
}

#[test]
fn errors_point_into_the_file_of_columns() {
    for (keys, columns, expected) in [
        (
            "",
            "a [mm], b [N]\n1, 2\n0.5, 3\n",
            "f.csv:3:1: the inputs of a table rise, but 0.5 follows 1 (turn the rows around)",
        ),
        (
            "",
            "a [mm], b [N]\n1, 2\n2, 3x\n",
            "f.csv:3:4: expected a number, found `3x` (write numbers with a point, such as `0.035` or `3.5e-2`)",
        ),
        (
            "",
            "a [mm], b [N]\n1, 2\n2\n",
            "f.csv:3:1: this line has 1 value, but column 2 is read (write a value for each column, with commas between)",
        ),
        (
            "",
            "a, b [N]\n1, 2\n2, 3\n",
            "f.csv:1:1: the column `a` has no unit (write it behind the name, as in `time [s]` or `h [mm]`; a pure number has the unit `[1]`)",
        ),
        ("", "a [mmm], b [N]\n1, 2\n2, 3\n", "f.csv:1:4: unknown unit `mmm` (did you mean `mm`?)"),
        (
            "",
            "a [N], b [N]\n1, 2\n2, 3\n",
            "law.toml:9:10: this is a length, but its column is a force, in `N`",
        ),
        (
            "",
            "a [mm], b [mm]\n1, 2\n2, 3\n",
            "law.toml:13:10: `Q` is a force, but this is a length (a parameter with a unit is missing as a factor; a number as a factor takes any unit)",
        ),
        (
            "",
            "a [mm], b [N]\n0,0, 230,5\n1, 460\n",
            "f.csv:2:1: this line has 4 values, but the line of names has 2 columns (write numbers with a point, as `0.5`; commas separate columns, unless `;` does)",
        ),
        (
            "",
            "a [mm]; b [N]\n0,0; 230\n1; 460\n",
            "f.csv:2:1: expected a number, found `0,0` (write numbers with a point, such as `0.035` or `3.5e-2`)",
        ),
        (
            "x = { column = 1, unit = \"um\" }",
            "a [mm], b [N]\n1, 2\n2, 3\n",
            "law.toml:10:16: the column `a` is in `mm` by its name, and in `um` where it is named (leave the `unit` out, or take it from the line of names)",
        ),
        (
            "x = { column = 1, unit = \"mm\" }",
            "0,0, 230,5\n0,5, 460,5\n",
            "law.toml:8:9: `f.csv` has 4 columns and no line of names (say which to read, as `x = 1` and `y = 2`; numbers are written with a point, not a comma)",
        ),
        (
            "",
            "a [mm], b [N]\n1, 2\n",
            "f.csv: a table has 2 to 128 rows of numbers, this has 1 (what stays the same takes two rows with equal values)",
        ),
        (
            "x = \"c\"",
            "a [mm], b [N]\n1, 2\n2, 3\n",
            "law.toml:10:6: `f.csv` has no column `c` (known: `a`, `b`)",
        ),
        ("y = 3", "a [mm], b [N]\n1, 2\n2, 3\n", "law.toml:10:5: `f.csv` has no column 3"),
        (
            "extend = \"periodic\"",
            "a [mm], b [N]\n1, 2\n2, 3\n",
            "f.csv:3:4: a periodic table ends with the value it starts with: 2, not 3",
        ),
    ] {
        assert_eq!(messages(keys, columns), [expected], "{columns}");
    }
    let commented = fine("", "a [mm], b [N] # names\n0, 0 # at rest\n# none\n3, 10,# \"a\", 5\n");
    assert!((value(&commented, 1.5e-3) - 5.0).abs() < 1e-13);
    let plain = fine(
        "x = { column = 2, unit = \"um\" }\ny = { column = 1, unit = \"kN\" }",
        "0.001 0\r\n0.003; 2000\r\n0.004\t3000\r\n".replace("; ", " ").as_str(),
    );
    assert!((value(&plain, 2e-3) - 3.0).abs() < 1e-13);
}

/// A table may be believed between its rows, and beyond the ends at which it says so.
#[test]
fn a_table_is_believed_within_its_rows() {
    let limits = |more: &str| {
        let text = format!(
            "kind = \"law\"\nname = \"t\"\ntitle = \"t\"\nsource = \"s\"\n[inputs.h]\nunit = \"mm\"\n\
             [tables.film]\nfile = \"film.csv\"\ninput = '2*h'\n{more}\n[outputs.Q]\nunit = \"N\"\nvalue = 'film'\n"
        );
        let columns = Source::new("film.csv", "gap [um], force [N]\n0, 30\n20, 10\n40, 30\n");
        let law = LawSpec::read_with(&Source::new("law.toml", text), &|_| Ok(columns.clone()));
        let law = law.unwrap_or_else(|errors| panic!("{errors}"));
        law.valid.iter().map(|own| (own.name.clone(), own.limits)).collect::<Vec<_>>()
    };
    let near = |a: f64, b: f64| (a - b).abs() < 1e-9 * 4e-5;
    for extend in ["", "extend = \"constant\"", "extend = \"linear\""] {
        let [(name, [first, last])] = limits(extend).try_into().unwrap();
        assert!(name == "film" && near(first, 0.0) && near(last, 4e-5), "{first} {last}");
        let above = limits(&format!("{extend}\nvalid_beyond = \"above\""));
        assert!(near(above[0].1[0], 0.0) && above[0].1[1] == f64::INFINITY);
        let below = limits(&format!("{extend}\nvalid_beyond = \"below\""));
        assert!(near(below[0].1[1], 4e-5) && below[0].1[0] == f64::NEG_INFINITY);
        assert_eq!(limits(&format!("{extend}\nvalid_beyond = \"both\"")), []);
    }
    assert_eq!(limits("extend = \"periodic\""), []);
}
