//! Files that are nearly right: cut, spliced and sown with what they do not expect. Each is read or refused, and refusals
//! say something; nothing panics or fills the memory.

use std::path::PathBuf;

use whirl_solver::mesh::matrices::Request;

use super::formats::{as_calculix, as_dmig, as_market};
use super::programs::{Folder, by_labels, by_rows, data};
use super::{Texts, bar, calculix, dmig, market};

/// Words and lines that no file of matrices expects.
const WORDS: &[&str] = &[
    "0",
    "-1",
    "1",
    "2.5",
    "99999999999999999999",
    "18446744073709551615",
    "4294967296",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "1.0D0",
    "1D",
    ".",
    "",
    "x",
    "mode",
    "rz",
    "µ",
    "\u{feff}",
    "1,2,3,4,5,6",
    "1 1 1",
    "%%MatrixMarket matrix array integer symmetric",
    "%%MatrixMarket matrix coordinate real skew-symmetric",
    "9999999999 9999999999 9999999999",
    "DMIG,KAAX,0,6,2,0",
    "DMIG,MAAX,0,1,1,0",
    "DMIG,KAAX,1,1,,1",
    "DMIG*   KAAX                           1               1",
    "*                      1               1 2.500000000D+03",
    "GRID,1,9,1.,2.,3.",
    "ENDDATA",
    "INCLUDE 'body.bdf'",
    "*NODE",
    "*NSET, NSET=A, GENERATE",
    "1, 4000000000, 1",
    "*INCLUDE, INPUT=job.inp",
];

/// Sebastiano Vigna's SplitMix64.
struct Random(u64);

impl Random {
    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count as u64) as usize
    }
}

/// One to four changes of lines.
fn mutant(random: &mut Random, text: &str) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for _ in 0..1 + random.below(4) {
        let place = random.below(lines.len().max(1)).min(lines.len());
        let word = WORDS[random.below(WORDS.len())];
        match random.below(8) {
            0 if place < lines.len() => drop(lines.remove(place)),
            1 if place < lines.len() => {
                let line = lines[place].clone();
                lines.insert(random.below(lines.len()), line);
            }
            // Another word in its place.
            2..=4 if place < lines.len() => {
                let sign = if lines[place].contains(',') { ',' } else { ' ' };
                let mut words: Vec<&str> = lines[place].split(sign).collect();
                let at = random.below(words.len());
                words[at] = word;
                lines[place] = words.join(&sign.to_string());
            }
            5 => lines.insert(place, word.to_owned()),
            6 if place < lines.len() => {
                let cut = random.below(lines[place].chars().count() + 1);
                lines[place] = lines[place].chars().take(cut).collect();
            }
            _ => lines.truncate(place),
        }
    }
    lines.join("\n")
}

fn all(whole: &Texts, request: &Request, count: u64) {
    let names: Vec<PathBuf> = whole.0.keys().cloned().collect();
    let mut refused = 0;
    for number in 0..count {
        let mut random = Random(number.wrapping_mul(0xd1b5_4a32_d192_ed03));
        let mut texts = whole.clone();
        let name = &names[random.below(names.len())];
        let changed = mutant(&mut random, &texts.0[name]);
        texts.0.insert(name.clone(), changed);
        if let Err(errors) = texts.read(request) {
            refused += 1;
            assert!(!errors.0.is_empty() && !errors.to_string().is_empty(), "{number}");
        }
    }
    assert!(refused > count / 4, "{refused} of {count} are refused");
}

/// Two masses on a spring along each axis, in every format.
fn pair() -> [(Texts, Request); 3] {
    let head = "%%MatrixMarket matrix coordinate real symmetric\n6 6 9\n";
    let entries = |diagonal: &str, other: &str| -> [String; 3] {
        let on = (1..=6).map(|i| format!("{i} {i} {diagonal}\n")).collect::<String>();
        let off = |swap: bool| -> String {
            let pair = |i: i32| {
                if swap {
                    format!("{i} {} {other}\n", i + 3)
                } else {
                    format!("{} {i} {other}\n", i + 3)
                }
            };
            (1..=3).map(pair).collect()
        };
        let cards = (0..6).map(|dof| {
            let (node, component) = (1 + dof / 3, 1 + dof % 3);
            let off = if dof < 3 { format!(",2,{component},{other},") } else { String::new() };
            format!("DMIG,NAME,{node},{component},,{node},{component},{diagonal},\n{off}\n")
        });
        [on.clone() + &off(false), on + &off(true), cards.collect()]
    };
    let [k, m] = [entries("1e6", "-1e6"), entries("2.", "0.")];
    let stored = Texts::default()
        .with("K.mtx", format!("{head}{}", k[0]))
        .with("M.mtx", format!("{head}{}", m[0]))
        .with(
            "dofs.csv",
            "node, direction, x [mm], y, z\n1, x, 0, 0, 0\n1, y\n1, z\n2, x, 0, 0, 1\n2, y\n2, z\n",
        );
    let job = Texts::default()
        .with("job.sti", k[1].clone())
        .with("job.mas", m[1].clone())
        .with("job.dof", "1.1\n1.2\n1.3\n2.1\n2.2\n2.3\n")
        .with("job.inp", "*NODE\n1, 0, 0, 0\n2, 0, 0, 1\n*NSET, NSET=A\n1, 2\n");
    let punch = ["KAAX", "MAAX"].iter().zip([&k[2], &m[2]]);
    let punch =
        punch.map(|(name, cards)| format!("DMIG,{name},0,6,2,0\n{}", cards.replace("NAME", name)));
    let cards = Texts::default()
        .with("body.pch", punch.collect::<String>())
        .with("body.bdf", "CEND\nBEGIN BULK\nGRID,1,,0.,0.,0.\nGRID,2,,0.,0.,1.\nSET1,4,1,2\n");
    [(stored, market()), (job, calculix()), (cards, dmig())]
}

#[test]
fn mutants_of_small_files_are_read_or_refused() {
    for (texts, request) in pair() {
        if let Err(errors) = texts.read(&request) {
            panic!("{errors}");
        }
        all(&texts, &request, 4000);
    }
}

#[test]
fn mutants_of_whole_bodies_are_read_or_refused() {
    let mesh = bar();
    all(&as_market(&mesh), &market(), 40);
    all(&as_calculix(&mesh), &calculix(), 40);
    all(&as_dmig(&mesh), &dmig(), 40);
}

/// Bytes with some changed, words of four bytes set to other numbers, or cut.
fn mutant_of_bytes(random: &mut Random, bytes: &[u8]) -> Vec<u8> {
    const NUMBERS: [i32; 12] =
        [0, 1, -1, 2, 24, 37, 65535, 65537, 131_072, i32::MAX, i32::MIN, 0x7ff0_0000];
    let mut own = bytes.to_vec();
    for _ in 0..1 + random.below(3) {
        match random.below(8) {
            0 => own.truncate(random.below(own.len().max(1))),
            1..=2 if !own.is_empty() => {
                let at = random.below(own.len());
                own[at] = random.below(256) as u8;
            }
            _ if own.len() >= 4 => {
                // Most of what is at the beginning counts most.
                let words = own.len() / 4;
                let reach = [words, words.min(20)][random.below(2)];
                let at = 4 * random.below(reach);
                let number = NUMBERS[random.below(NUMBERS.len())];
                let number = [number.to_le_bytes(), number.to_be_bytes()][random.below(2)];
                own[at..at + 4].copy_from_slice(&number);
            }
            _ => {}
        }
    }
    own
}

/// What other programs wrote: lines and fields of texts, bytes and words of binary files.
#[test]
fn mutants_of_files_of_other_programs_are_read_or_refused() {
    let op4 = |name: &str| by_rows(&format!("{name}:KAA"), &format!("{name}:MAA"));
    let mut all: Vec<(Request, String)> = Vec::new();
    for kind in ["dense", "bigmat", "nonbigmat"] {
        for order in ["text", "little", "big"] {
            let name = format!("yeti-{kind}-{order}.op4");
            all.push((op4(&name), name));
        }
    }
    for kind in ["input", "labels"] {
        all.push((by_labels(kind), format!("{kind}_STIF1.mtx")));
    }
    let mtx = ["coordinate_STIF1.mtx", "coordinate_MASS1.mtx"];
    all.push((by_rows(mtx[0], mtx[1]), mtx[1].to_owned()));
    for (request, name) in all {
        let whole = data(&name);
        let text = String::from_utf8(whole.clone()).ok();
        let mut refused = 0;
        for number in 0..300 {
            let mut random = Random(number ^ 0x5eed_0000_0000_0000);
            let changed = match &text {
                Some(text) if number % 2 == 0 => mutant(&mut random, text).into_bytes(),
                Some(text) => mutant_of_fields(&mut random, text),
                None => mutant_of_bytes(&mut random, &whole),
            };
            if let Err(errors) = Folder::default().with(&name, changed).read(&request) {
                refused += 1;
                assert!(!errors.0.is_empty() && !errors.to_string().is_empty(), "{name} {number}");
            }
        }
        assert!(refused > 60, "{name}: {refused} of 300 are refused");
    }
}

/// One to three fields of a text changed, each without a change of its width.
fn mutant_of_fields(random: &mut Random, text: &str) -> Vec<u8> {
    let mut own = text.as_bytes().to_vec();
    for _ in 0..1 + random.below(3) {
        // Heads are at the beginning.
        let reach = [own.len(), own.len().min(120)][random.below(2)];
        let at = random.below(reach);
        let field = |byte: &u8| byte.is_ascii_digit() || b".-+ED".contains(byte);
        let start = own[..at].iter().rposition(|byte| !field(byte)).map_or(0, |place| place + 1);
        let end = at + own[at..].iter().position(|byte| !field(byte)).unwrap_or(0);
        let word = WORDS[random.below(WORDS.len())].as_bytes();
        for (place, byte) in own[start..end.max(start)].iter_mut().enumerate() {
            *byte = word.get(place).copied().filter(u8::is_ascii).unwrap_or(b' ');
        }
    }
    own
}
