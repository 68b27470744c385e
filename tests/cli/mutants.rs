//! Inputs that are nearly right: cases and meshes cut, spliced and sown with what they do not expect.

use std::fs;
use std::path::{Path, PathBuf};

/// Values and lines that a case does not expect.
const WORDS: &[&str] = &[
    "0",
    "-1",
    "1e308",
    "-0.0",
    "nan",
    "inf",
    "2.5",
    "true",
    "99999999999999999999",
    "1000000000",
    "9999",
    "\"\"",
    "\"x\"",
    "\"0 mm\"",
    "\"-1 mm\"",
    "\"1e300 m\"",
    "\"1e-300 m\"",
    "\"1e9 s\"",
    "\"1e-9 s\"",
    "\"nan mm\"",
    "\"4500 rpm\"",
    "\"1 N\"",
    "[]",
    "[[]]",
    "{}",
    "[1, 2]",
    "{ a = 1 }",
    "\"Nall\"",
    "[\"Nall\", \"Nall\", \"Nall\"]",
    "\"case.toml\"",
    "\"/dev/zero\"",
    "\".\"",
    "2026-11-21",
    "'''",
    "\"\\u0000\"",
    "ε",
    "[[load]]",
    "[shaft.dimensions]",
    "[mass]",
    "[[stop]]",
    "a.b.c = 1",
    "include = \"hu2003.machine.toml\"",
    "include = [\"case.toml\", \"case.toml\"]",
    "law = \"ocvirk\"",
    "motion = \"hu2003\"",
    "number = 9999",
    "side = \"around\"",
];

/// Sebastiano Vigna's SplitMix64.
pub(crate) struct Random(u64);

impl Random {
    /// The stream that belongs to the number of an input.
    pub(crate) fn new(number: u64) -> Self {
        Random(number.wrapping_mul(0xd1b5_4a32_d192_ed03))
    }

    fn below(&mut self, count: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % count as u64) as usize
    }
}

/// A case with one to four changes.
pub(crate) fn case(random: &mut Random, corpus: &[String]) -> String {
    mutant(random, corpus, WORDS, '=')
}

/// One to four changes of lines, whose values stand behind a sign.
fn mutant(random: &mut Random, corpus: &[String], words: &[&str], sign: char) -> String {
    let pick = |random: &mut Random| corpus[random.below(corpus.len())].clone();
    let mut lines: Vec<String> = pick(random).lines().map(str::to_owned).collect();
    for _ in 0..1 + random.below(4) {
        let place = random.below(lines.len().max(1)).min(lines.len());
        let word = words[random.below(words.len())];
        match random.below(8) {
            0 if place < lines.len() => drop(lines.remove(place)),
            1 if place < lines.len() => {
                let line = lines[place].clone();
                lines.insert(random.below(lines.len()), line);
            }
            // Another value behind the same key.
            2..=4 => {
                let parts = lines.get(place).map(|line| line.split(sign).collect::<Vec<_>>());
                if let Some(mut parts) = parts.filter(|parts| parts.len() > 1) {
                    let last = 1 + random.below(parts.len() - 1);
                    parts[last] = word;
                    // A case has one value a line, a mesh several.
                    parts.truncate(if sign == '=' { 2 } else { parts.len() });
                    lines[place] = parts.join(&sign.to_string());
                }
            }
            5 => lines.insert(place, word.to_owned()),
            6 if place < lines.len() => {
                let cut = random.below(lines[place].chars().count() + 1);
                lines[place] = lines[place].chars().take(cut).collect();
            }
            _ => {
                let other = pick(random);
                let other: Vec<&str> = other.lines().collect();
                let start = random.below(other.len().max(1)).min(other.len());
                let some = other[start..].iter().take(1 + random.below(6));
                lines.extend(some.map(|line| (*line).to_owned()));
            }
        }
    }
    lines.join("\n")
}

/// Entries and lines that a mesh does not expect.
const ENTRIES: &[&str] = &[
    "0",
    "-1",
    "1",
    "8",
    "99999999999999999999",
    "18446744073709551615",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "1.0D0",
    "1D",
    "1.",
    ".",
    "",
    " ",
    "x",
    "ALL",
    "all",
    "*",
    "**",
    "*NODE",
    "*ELEMENT",
    "*ELEMENT, TYPE=C3D8",
    "*ELEMENT, TYPE=C3D8R, ELSET=ALL",
    "*ELEMENT, TYPE=C3D20R",
    "*ELEMENT, TYPE=C3D4",
    "*NSET, NSET=ALL, GENERATE",
    "*NSET, NSET=A\nA",
    "*ELSET, ELSET=ALL\nALL",
    "1, 4000000000, 1",
    "4, 1, -1",
    "1, 4, 0",
    "*INCLUDE, INPUT=/dev/zero",
    "*INCLUDE, INPUT=cube.inp",
    "*SURFACE, NAME=A\nALL, S1",
    "*SURFACE, NAME=A, TYPE=NODE",
    "*INSTANCE, NAME=A\n0, 0, 1",
    "$Nodes",
    "$EndNodes",
    "$Elements",
    "$EndElements",
    "$MeshFormat",
    "$Entities\n1 1 1 1",
    "2.2 1 8",
    "4.1 1 8",
    "*SOLID SECTION",
    "*MATERIAL",
    "*MATERIAL, NAME=",
    "*ELASTIC\n1, 0.5",
    "*ELASTIC\n200e9, 0.49999999",
    "*DENSITY\n-1",
    "*STEP",
    "*HEADING",
    "TYPE=",
    "NSET",
    "ELSET=ALL",
    "\u{feff}",
    "\u{e4}",
    "\0",
    "\r",
    "\t",
    "'",
    "\"",
];

/// Small meshes to begin with.
pub(crate) fn meshes() -> Vec<String> {
    let cube = "*HEADING\nA cube and a wedge\n** nodes\n*Node, nset=All\n1, 0, 0, 0\n2, 1., 0, 0\n\
        3, 1.0D0, 1e0, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n9, 2, 0, 0\n10, 2, 0, 1\n\
        *ELEMENT, TYPE=C3D8I, ELSET=CUBE\n101, 1, 2, 3, 4,\n5, 6, 7, 8\n*ELEMENT, TYPE=C3D6, ELSET=WEDGE\n\
        102, 2, 9, 3, 6, 10, 7\n*NSET, NSET=BOTTOM, GENERATE\n1, 4\n*NSET, NSET=Ends\nBOTTOM, 5,\n6\n\
        *NSET, NSET=ODD, GENERATE\n1, 9, 2\n*ELSET, ELSET=ALL\nCUBE, 102\n*MATERIAL, NAME=Steel\n\
        *ELASTIC, TYPE=ISOTROPIC\n200e9, 0.3\n*DENSITY\n7860\n*SOLID SECTION,\n ELSET=ALL, MATERIAL=STEEL\n1.\n\
        *STEP\n*STATIC\n*END STEP\n";
    let tetrahedra = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n5, 1, 1, 1\n\
        *ELEMENT, TYPE=C3D4, ELSET=A\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=C3D4, ELSET=B\n2, 2, 3, 4, 5\n\
        *MATERIAL, NAME=M\n*DENSITY\n7860\n*ELASTIC\n200e9, 0.3\n*MATERIAL, NAME=N\n*DENSITY\n2700\n*ELASTIC\n\
        70e9, 0.33\n*SOLID SECTION, ELSET=A, MATERIAL=M\n*SOLID SECTION, ELSET=B, MATERIAL=N\n";
    vec![cube.to_owned(), tetrahedra.to_owned()]
}

/// Small meshes of Gmsh to begin with.
pub(crate) fn gmsh_meshes() -> Vec<String> {
    let older = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"low\"\n3 2 \"all\"\n\
        $EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n$Elements\n4\n\
        1 15 2 3 1 1\n2 2 2 1 1 1 2 3\n3 4 2 2 1 1 2 3 4\n4 4 2 2 1 2 3 4 5\n$EndElements\n";
    let newer = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 1\n1 0 0 0 1 3\n1 0 0 0 1 1 0 1 1 0\n\
        1 0 0 0 1 1 1 1 2 1 1\n$EndEntities\n$Nodes\n1 5 1 5\n3 1 0 5\n1\n2\n3\n4\n5\n0 0 0\n1 0 0\n0 1 0\n\
        0 0 1\n1 1 1\n$EndNodes\n$Elements\n3 4 1 4\n0 1 15 1\n1 1\n2 1 2 1\n2 1 2 3\n3 1 4 2\n3 1 2 3 4\n\
        4 2 3 4 5\n$EndElements\n$Periodic\n0\n$EndPeriodic\n";
    vec![older.to_owned(), newer.to_owned()]
}

/// A mesh of Gmsh with one to four changes.
pub(crate) fn gmsh_mesh(random: &mut Random, corpus: &[String]) -> String {
    mutant(random, corpus, ENTRIES, ' ')
}

/// A mesh with one to four changes.
pub(crate) fn mesh(random: &mut Random, corpus: &[String]) -> String {
    mutant(random, corpus, ENTRIES, ',')
}

/// Values and lines that bulk data do not expect.
const FIELDS: &[&str] = &[
    "0",
    "-1",
    "1",
    "8",
    "99999999999999999999",
    "18446744073709551615",
    "1.+308",
    "1.+999",
    "1.5-3",
    "nan",
    "inf",
    "1.0D0",
    ".",
    "",
    " ",
    "x",
    "+",
    "*",
    "THRU",
    "EXCEPT",
    "BY",
    "GRID,1",
    "GRID*,2,,1.,2.",
    "GRDSET,,7",
    "CORD1R,7,1,2,3,8,4,5,6",
    "CORD2S,8,7,0.,0.,0.,0.,0.,1.",
    ",1.,0.,0.",
    "CHEXA,9,1,1,2,3,4",
    "CTETRA,9,1,1,2,3,4",
    "RBE2,1,2,123,1,THRU,9",
    "RBE3,1,,2,123,1.,123,1",
    "CONM2,3,1,7,1.",
    "MAT1,1,1.,1.,.3",
    "PSOLID,1,7",
    "SET 5 = 1 THRU 9",
    "INCLUDE '/dev/zero'",
    "BEGIN BULK",
    "ENDDATA",
    "$HMNAME PROP 1\"",
    "$HMMOVE 1",
    "$ 1THRU9",
    "$",
    "\u{feff}",
    "\u{e4}",
    "\0",
    "\r",
    "\t",
];

/// Small bulk data to begin with.
pub(crate) fn bulk_data() -> Vec<String> {
    let cube = "SOL 103\nCEND\nSET 5 = 1 THRU 4 EXCEPT 2,\n 9\nBEGIN BULK\nGRDSET,,7\nCORD2C,7,8,0.,0.,0.,0.,0.,1.\n\
        ,1.,0.,0.\nCORD2R,8,,0.,0.,1.,0.,1.,1.\n,1.,0.,0.\nGRID,1,0,0.,0.,0.\nGRID,2,0,1.,0.,0.\nGRID,3,0,1.,1.+0,0.\n\
        GRID,4,0,0.,1.,0.\nGRID*,5,0,0.,0.,*\n*,1.\nGRID,6,0,1.,0.,1.\nGRID,7,0,1.,1.,1.\nGRID,8,0,0.,1.,1.\n\
        GRID,9,,2.,0.,0.\nGRID,10,,2.,0.,1.\nCHEXA,101,1,1,2,3,4,5,6\n,7,8\nCPENTA,102,2,2,9,3,6,10,7\n\
        RBE2,17,20,123,1,THRU,4\nRBE3,18,,20,123,1.,123,5,6\nGRID,20\nCONM2,21,20,,5.5\nMAT1,1,2.+11,,.3,7860.\n\
        PSOLID,1,1\nPSOLID,2,1\nENDDATA\n";
    let tetrahedra = "$HMNAME PROP 1\"all\"\nGRID,1\nGRID,2,,1.\nGRID,3,,0.,1.\nGRID,4,,0.,0.,1.\nGRID,5,,1.,1.,1.\n\
        CTETRA,1,1,1,2,3,4\nCTETRA,2,1,2,3,4,5\nMAT1,1,2.+11,7.7+10,,7860.\nPSOLID,1,1\nCTRIA3,9,2,1,2,3\n";
    vec![cube.to_owned(), tetrahedra.to_owned()]
}

/// Bulk data with one to four changes.
pub(crate) fn bulk(random: &mut Random, corpus: &[String]) -> String {
    mutant(random, corpus, FIELDS, ',')
}

/// The texts of all cases in a folder.
pub(crate) fn cases(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry"));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    paths.sort();
    let cases = paths.iter().filter(|path| path.extension().is_some_and(|end| end == "toml"));
    cases.map(|path| fs::read_to_string(path).expect("a text")).collect()
}
