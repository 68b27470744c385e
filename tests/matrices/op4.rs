//! OUTPUT4 as it is documented, in every layout.

use std::fmt::Write;

use whirl_solver::sparse::SparseColumns;

/// How the values of a column are listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layout {
    /// As one run.
    Dense,
    /// As strings with their length and row in two numbers.
    Big,
    /// As strings with both packed into one number.
    Packed,
}

/// As what a file is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Written {
    Text,
    /// With words of four bytes.
    Binary {
        big_endian: bool,
    },
    /// With words of eight bytes.
    Wide {
        big_endian: bool,
    },
}

impl Written {
    pub(super) const ALL: [Written; 5] = [
        Written::Text,
        Written::Binary { big_endian: false },
        Written::Binary { big_endian: true },
        Written::Wide { big_endian: false },
        Written::Wide { big_endian: true },
    ];
}

/// Values that stand behind each other in a column, with the first row.
fn strings(column: &[(usize, f64)], layout: Layout) -> Vec<(usize, Vec<f64>)> {
    let mut all: Vec<(usize, Vec<f64>)> = Vec::new();
    for &(row, value) in column {
        match all.last_mut() {
            Some((first, values)) if layout == Layout::Dense => {
                values.resize(row - *first, 0.0);
                values.push(value);
            }
            Some((first, values)) if *first + values.len() == row => values.push(value),
            _ => all.push((row, vec![value])),
        }
    }
    all
}

/// A matrix.
pub(super) fn op4(
    name: &str,
    matrix: &SparseColumns,
    form: i64,
    layout: Layout,
    written: Written,
    single: bool,
) -> Vec<u8> {
    let (height, width) = (matrix.height as i64, matrix.width() as i64);
    let rows = if layout == Layout::Big { -height } else { height };
    let kind = if single { 1 } else { 2 };
    let mut file = Output { written, single, bytes: Vec::new() };
    file.head([width, rows, form, kind], name);
    for j in 0..matrix.width() {
        let column: Vec<(usize, f64)> = matrix.column(j).collect();
        let all = strings(&column, layout);
        if all.is_empty() {
            continue;
        }
        file.column(j as i64 + 1, &all, layout);
    }
    file.last(width + 1);
    file.bytes
}

struct Output {
    written: Written,
    single: bool,
    bytes: Vec<u8>,
}

impl Output {
    /// Words of a value.
    fn words(&self) -> i64 {
        if self.single || matches!(self.written, Written::Wide { .. }) { 1 } else { 2 }
    }

    fn big_endian(&self) -> bool {
        matches!(
            self.written,
            Written::Binary { big_endian: true } | Written::Wide { big_endian: true }
        )
    }

    fn ordered(&self, little: &[u8]) -> Vec<u8> {
        let mut own = little.to_vec();
        if self.big_endian() {
            own.reverse();
        }
        own
    }

    fn whole(&self, numbers: &[i64]) -> Vec<u8> {
        let one = |number: &i64| match self.written {
            Written::Wide { .. } => self.ordered(&number.to_le_bytes()),
            _ => self.ordered(&(*number as i32).to_le_bytes()),
        };
        numbers.iter().flat_map(one).collect()
    }

    fn reals(&self, values: &[f64]) -> Vec<u8> {
        let one = |value: &f64| match self.written {
            Written::Binary { .. } if self.single => self.ordered(&(*value as f32).to_le_bytes()),
            _ => self.ordered(&value.to_le_bytes()),
        };
        values.iter().flat_map(one).collect()
    }

    fn record(&mut self, content: &[u8]) {
        let length = self.ordered(&(content.len() as u32).to_le_bytes());
        self.bytes.extend(length.iter().chain(content).chain(&length));
    }

    fn head(&mut self, numbers: [i64; 4], name: &str) {
        if self.written == Written::Text {
            let [a, b, c, d] = numbers;
            let format = if self.single { "1P,8E15.8" } else { "1P,3D23.16" };
            self.bytes.extend(format!("{a:8}{b:8}{c:8}{d:8}{name:<8}{format}\n").bytes());
            return;
        }
        let mut content = self.whole(&numbers);
        let (one, other) = name.split_at(name.len().min(4));
        match self.written {
            // Four characters a word.
            Written::Wide { .. } => content.extend(format!("{one:<8}{other:<8}").bytes()),
            _ => content.extend(format!("{name:<8}").bytes()),
        }
        self.record(&content);
    }

    fn column(&mut self, column: i64, all: &[(usize, Vec<f64>)], layout: Layout) {
        let heads = match layout {
            Layout::Dense => 0,
            Layout::Big => 2,
            Layout::Packed => 1,
        };
        let values: i64 = all.iter().map(|(_, own)| own.len() as i64).sum();
        let text = self.written == Written::Text;
        // Of runs in a text the values are counted.
        let words = if text && layout == Layout::Dense { 1 } else { self.words() };
        let count = values * words + heads * all.len() as i64;
        let row = if layout == Layout::Dense { all[0].0 as i64 + 1 } else { 0 };
        let mut content = self.whole(&[column, row, count]);
        let mut lines = format!("{column:8}{row:8}{count:8}\n");
        for (first, own) in all {
            let (length, row) = (own.len() as i64 * words + 1, *first as i64 + 1);
            let numbers = match layout {
                Layout::Dense => vec![],
                Layout::Big => vec![length, row],
                Layout::Packed => vec![(length << 16) + row],
            };
            content.extend(self.whole(&numbers));
            content.extend(self.reals(own));
            if !numbers.is_empty() {
                numbers.iter().for_each(|own| write!(lines, "{own:8}").expect("text"));
                lines.push('\n');
            }
            let of_line = if self.single { 8 } else { 3 };
            for values in own.chunks(of_line) {
                values.iter().for_each(|own| lines.push_str(&self.field(*own)));
                lines.push('\n');
            }
        }
        match text {
            true => self.bytes.extend(lines.bytes()),
            false => self.record(&content),
        }
    }

    /// A value as Fortran writes it.
    fn field(&self, value: f64) -> String {
        let (digits, width, letter) = if self.single { (8, 15, 'E') } else { (16, 23, 'D') };
        let value = if self.single { f64::from(value as f32) } else { value };
        let text = format!("{value:.digits$e}");
        let (own, exponent) = text.split_once('e').expect("an exponent");
        let exponent: i32 = exponent.parse().expect("a number");
        let sign = if exponent < 0 { '-' } else { '+' };
        format!("{:>width$}", format!("{own}{letter}{sign}{:02}", exponent.abs()))
    }

    fn last(&mut self, column: i64) {
        match self.written {
            Written::Text => self
                .bytes
                .extend(format!("{column:8}{:8}{:8}\n{}\n", 1, 1, self.field(1.0)).bytes()),
            _ => {
                let mut content = self.whole(&[column, 1, self.words()]);
                content.extend(self.reals(&[1.0]));
                self.record(&content);
            }
        }
    }
}
