//! Tables of analyses as files for other programs, where they are wanted: the columns and numbers of their CSV.

use std::io;

use crate::arguments::AnalysisOutput;
use crate::matlab;
use crate::parquet::{GROUP, Parquet, Values};
use crate::version;

/// Which of them are wanted.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TableFiles {
    parquet: bool,
    mat: bool,
}

impl TableFiles {
    /// Those of a command.
    pub(crate) fn of(arguments: &AnalysisOutput) -> Self {
        TableFiles { parquet: arguments.parquet, mat: arguments.mat }
    }

    /// The option of one that is wanted, if one is.
    pub(crate) fn option(self) -> Option<&'static str> {
        let both = [(self.parquet, "--parquet"), (self.mat, "--mat")];
        both.into_iter().find(|own| own.0).map(|own| own.1)
    }

    /// Those of a file, if it is a table.
    pub(crate) fn made(self, file: &str, content: &[u8]) -> Vec<(String, Vec<u8>)> {
        let name = file.strip_suffix(".csv");
        let (Some(name), true) = (name, self.option().is_some()) else { return Vec::new() };
        let text = String::from_utf8_lossy(content);
        let Some((names, columns)) = columns(&text) else { return Vec::new() };
        let mut files = Vec::new();
        if self.parquet {
            let written = parquet(&names, &columns).expect("memory can be written");
            files.push((format!("{name}.parquet"), written));
        }
        if self.mat {
            files.push((format!("{name}.mat"), mat(&names, &columns)));
        }
        files
    }
}

fn parquet(names: &[String], columns: &[Values]) -> io::Result<Vec<u8>> {
    let mut file = Parquet::new(Vec::new(), names.to_vec())?;
    let count = columns.first().map_or(0, Values::count);
    // A table without rows has its columns, too.
    for start in (0..count.max(1)).step_by(GROUP) {
        let own = start..(start + GROUP).min(count);
        file.add(&columns.iter().map(|all| all.part(own.clone())).collect::<Vec<Values>>())?;
    }
    file.finish(&format!("whirl {}", version::PACKAGE))
}

fn mat(names: &[String], columns: &[Values]) -> Vec<u8> {
    const NAMES: &str = "columns";
    let mut bytes = matlab::head();
    bytes.extend(matlab::texts(NAMES, names.iter().map(String::as_str)));
    for (name, column) in matlab::variables(names, &[NAMES]).iter().zip(columns) {
        match column {
            Values::Numbers(own) => {
                bytes.extend(matlab::doubles(name, [own.len(), 1], own.iter().copied()));
            }
            Values::Texts(own) => bytes.extend(matlab::texts(name, own.iter().map(String::as_str))),
            Values::Whole(_) => unreachable!("all numbers are doubles"),
        }
    }
    bytes
}

/// Names and values of a CSV; none of what is no table. A column is one of numbers if each of its cells is one or empty.
fn columns(text: &str) -> Option<(Vec<String>, Vec<Values>)> {
    let mut lines = text.lines().map(cells);
    let names = lines.next()?;
    let rows: Vec<Vec<String>> = lines.collect();
    if rows.iter().any(|row| row.len() != names.len()) {
        return None;
    }
    let column = |place: usize| {
        let own = || rows.iter().map(|row| row[place].as_str());
        let number = |cell: &str| if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() };
        let numbers: Option<Vec<f64>> = own().map(number).collect();
        numbers.map_or_else(|| Values::Texts(own().map(str::to_owned).collect()), Values::Numbers)
    };
    let values = (0..names.len()).map(column).collect();
    Some((names, values))
}

/// The cells of a line; `"` encloses those with commas, and is doubled within.
fn cells(line: &str) -> Vec<String> {
    let (mut all, mut own, mut within) = (Vec::new(), String::new(), false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if within && letters.next_if_eq(&'"').is_some() => own.push('"'),
            '"' => within = !within,
            ',' if !within => all.push(std::mem::take(&mut own)),
            _ => own.push(letter),
        }
    }
    all.push(own);
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_numbers_texts_or_missing() {
        let text = "speed_rpm,whirl,\"a, \"\"b\"\"\"\n1e3,forward,\n-2.5,,3\n";
        let (names, values) = columns(text).unwrap();
        assert_eq!(names, ["speed_rpm", "whirl", "a, \"b\""]);
        assert_eq!(values[0], Values::Numbers(vec![1000.0, -2.5]));
        assert_eq!(values[1], Values::Texts(vec!["forward".to_owned(), String::new()]));
        let Values::Numbers(last) = &values[2] else { panic!("{:?}", values[2]) };
        assert!(last[0].is_nan() && last[1] == 3.0);
        assert!(columns("a,b\n1\n").is_none() && columns("").is_none());
        let files = TableFiles { parquet: true, mat: true };
        let names = |file: &str, text: &str| -> Vec<String> {
            files.made(file, text.as_bytes()).into_iter().map(|own| own.0).collect()
        };
        assert_eq!(names("modes.csv", text), ["modes.parquet", "modes.mat"]);
        assert_eq!(names("modes.csv", "a,b\n"), ["modes.parquet", "modes.mat"]);
        assert!(names("modes.svg", text).is_empty());
    }
}
