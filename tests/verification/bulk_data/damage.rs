//! Files of bulk data in which every kind of card that is read stands, with one field damaged.

/// Every card, in free fields, at least once in each of its shapes.
const CARDS: &str = "PARAM,WTMASS,1.
GRDSET,,0,,,,0
CORD2R,7,0,0.,0.,0.,0.,0.,1.
,1.,0.,0.
CORD2C,8,7,0.,0.,0.,0.,0.,1.
,1.,0.,0.
CORD2S,9,8,0.,0.,0.,0.,0.,1.
,1.,0.,0.
CORD1R,10,1,2,3,11,1,2,4
CORD1C,12,1,2,3
CORD1S,13,1,2,3
GRID,1,,0.,0.,0.
GRID,2,,1.,0.,0.
GRID,3,,1.,1.,0.
GRID,4,,0.,1.,0.
GRID,5,7,0.,0.,1.
GRID,6,7,1.,0.,1.
GRID,7,,1.,1.,1.
GRID,8,,0.,1.,1.
GRID,9,,.5,0.,0.
GRID,10,,1.,.5,0.
GRID,11,,.5,1.,0.
GRID,12,,0.,.5,0.
GRID,13,,0.,0.,.5
GRID,14,,1.,0.,.5
GRID,15,,1.,1.,.5
GRID,16,,0.,1.,.5
GRID,17,,.5,0.,1.
GRID,18,,1.,.5,1.
GRID,19,,.5,1.,1.
GRID,20,,0.,.5,1.
GRID,21,8,2.,0.,0.
GRID,22,,2.,0.,1.
GRID,23,,3.,.5,.5,,123
GRID,31,,5.,0.,0.
GRID,32,,6.,0.,0.
GRID,33,,5.,1.,0.
GRID,34,,5.,0.,1.
GRID,35,,5.5,0.,0.
GRID,36,,5.5,.5,0.
GRID,37,,5.,.5,0.
GRID,38,,5.,0.,.5
GRID,39,,5.5,0.,.5
GRID,40,,5.,.5,.5
GRID,51,,5.5,.5,.5
GRID,99,,0.,0.,-5.
CHEXA,101,1,1,2,3,4,5,6
,7,8,9,10,11,12,13,14
,15,16,17,18,19,20
CPENTA,102,2,2,21,3,6,22,7
CHEXA,103,1,21,2,3,31,22,6
,7,34
CPYRAM,104,1,1,2,3,4,99
CTETRA,105,2,31,32,33,34,35,36
,37,38,39,40
CTETRA,106,2,32,33,34,51
CTETRA,107,2,32,33,34,99,,
,,,,40
CPENTA,108,1,1,2,4,5,6,8
,9,,12,13,14,16,17,
,20
MAT1,1,2.+11,,.3,7860.
MAT1,2,7.+10,2.6+10,,2700.
MAT9,3,1.,2.,3.
PSOLID,1,1
PSOLID,2,2,,,,SMECH
PLSOLID,3,3
RBE2,17,99,123,1,THRU,4
RBE2,19,99,123456,5,6,7,8
,1.-6
RBE3,18,,99,123456,1.,123,5,6
,7,2.,123,8,UM,1,123
CONM2,21,99,,5.5,.1,.2,.3
,1.,0.,2.,0.,0.,3.
CONM2,22,1,-1,5.5
SET1,5,1,THRU,9,EXCEPT,4
SET3,6,GRID,1,2,3
MPC,1,1,1,1.,2,1,-1.
MPCADD,2,1
RBAR,41,1,2,123456
RBE1,42,1,123456,UM,2,123
RROD,43,1,2
RSPLINE,44,,1,2,123
RTRPLT,45,1,2,3
CELAS2,46,1.+5,1,1
CBUSH,47,9,1,2
CQUAD4,48,9,1,2,3,4
PSHELL,9,1,.01
SPC1,1,123,1,2
";

/// What stands in a field that is damaged.
const FIELDS: [&str; 36] = [
    "",
    "0",
    "-1",
    "1",
    "2",
    "99",
    "1x",
    "x",
    "1.",
    "-1.",
    "0.",
    "1.+999",
    "1.-999",
    "1.5-3",
    "nan",
    "inf",
    "1e",
    "+",
    "-",
    "*",
    ".",
    "1 2",
    "THRU",
    "EXCEPT",
    "BY",
    "UM",
    "ALPHA",
    "GRID",
    "99999999999999999999",
    "18446744073709551615",
    "123456",
    "é",
    "$",
    "'",
    "\t",
    "1.2.3",
];

/// How the lines are written.
#[derive(Debug, Clone, Copy)]
enum Form {
    Free,
    Small,
    Large,
}

/// A sequence of numbers that a seed fixes (splitmix64).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed)
    }

    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((z ^ (z >> 31)) % limit as u64).unwrap_or(0)
    }
}

/// The names of the cards that are damaged.
pub(crate) fn cards() -> Vec<&'static str> {
    let names = CARDS.lines().filter_map(|line| line.split(',').next());
    let mut names: Vec<&str> = names.filter(|name| !name.is_empty()).collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// The file of a seed: as it is but for one field, or one that was taken out or put in.
pub(crate) fn file(seed: u64) -> String {
    let random = &mut Random::new(seed);
    let mut lines: Vec<Vec<&str>> = CARDS.lines().map(|line| line.split(',').collect()).collect();
    // Cards that are refused as they are would hide all others.
    lines.retain(|line| {
        !["RSPLINE", "RTRPLT", "PLSOLID"].contains(&line[0]) || random.below(40) == 0
    });
    let line = random.below(lines.len());
    let field = random.below(lines[line].len() + 1);
    let piece = FIELDS[random.below(FIELDS.len())];
    match random.below(8) {
        0 if field < lines[line].len() => drop(lines[line].remove(field)),
        1 => lines[line].insert(field, piece),
        _ if field < lines[line].len() => lines[line][field] = piece,
        _ => lines[line].push(piece),
    }
    let form = [Form::Free, Form::Small, Form::Large][random.below(3)];
    let mut text = String::new();
    for line in &lines {
        write(line, form, &mut text);
    }
    text + "ENDDATA\n"
}

fn write(line: &[&str], form: Form, text: &mut String) {
    let (name, fields) = line.split_first().unwrap_or((&"", &[]));
    match form {
        Form::Free => text.push_str(&line.join(",")),
        Form::Small => {
            text.push_str(&format!("{name:<8}"));
            fields.iter().for_each(|field| text.push_str(&format!("{field:>8}")));
        }
        Form::Large => {
            let halves: Vec<&[&str]> = fields.chunks(4).collect();
            for (number, half) in halves.iter().enumerate() {
                let start = if number == 0 { format!("{name}*") } else { "\n*".to_owned() };
                text.push_str(&format!("{start:<8}"));
                half.iter().for_each(|field| text.push_str(&format!("{field:>16}")));
            }
        }
    }
    text.push('\n');
}
