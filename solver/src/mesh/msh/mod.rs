//! Meshes of Gmsh: versions 4.1 and 2.2, text and binary with either byte order.
//!
//! Solids become cells. A physical group of volumes is an element set and a node set; one of surfaces, curves or
//! points is a node set: of its nodes that belong to solids. Groups without a name are called `VOLUME_3`,
//! `SURFACE_3`, `CURVE_3` and `POINT_3` by their tags. Points, lines and faces themselves are left out, and so
//! are sections that say nothing of the mesh. Materials come from the case.

mod assemble;
mod contents;
mod cursor;
mod kinds;
mod version2;
mod version4;

use self::assemble::assemble;
use self::contents::Contents;
use self::cursor::{Cursor, DAMAGED, Encoding, Stop};
use super::raw::{MeshReport, Remedies};
use super::reading::{ReadMesh, ReadOptions};
use crate::error::InputErrors;

const REMEDIES: Remedies = Remedies {
    no_cells: "mesh the volume (`gmsh -3`); where there are physical groups, Gmsh saves these only: add a \
               `Physical Volume`",
    no_section: "files of Gmsh have no materials: write `material = \"…\"`, or `regions` by physical groups, in \
                 the case",
    lacks: |name, symbol, _| (format!("material {name} has no {symbol}"), String::new()),
};

/// Reads a mesh; `path` is used in messages only.
///
/// # Errors
/// All that is wrong, with line and column in files of text, and how to fix it.
pub fn read(bytes: &[u8], path: &str, options: &ReadOptions) -> Result<ReadMesh, InputErrors> {
    let mut report = MeshReport::new(path);
    let mut contents = Contents::new();
    if let Err(stop) = sections(bytes, &mut contents, &mut report) {
        report.error(stop.place, stop.what, stop.help);
        return Err(report.into_errors());
    }
    assemble(contents, options.elements, &mut report).finish(&REMEDIES, options, report)
}

/// Versions of the format that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Version {
    Two,
    Four,
}

fn sections(bytes: &[u8], contents: &mut Contents, report: &mut MeshReport) -> Result<(), Stop> {
    let mut cursor = Cursor::new(bytes);
    let mut version = None;
    let mut seen = (false, false);
    loop {
        let word = cursor.peek();
        if word.is_empty() {
            break;
        }
        let Some(name) = word.strip_prefix(b"$").filter(|name| !name.starts_with(b"End")) else {
            let word =
                String::from_utf8_lossy(&word[..word.len().min(24)]).escape_debug().to_string();
            let what = format!("expected a section such as $Nodes, found `{word}`");
            return Err(cursor.stop(what, DAMAGED));
        };
        cursor.section = String::from_utf8_lossy(name).into_owned();
        if matches!(name, b"NOD" | b"ELM") {
            return Err(old(&cursor, "1"));
        }
        cursor.take(word);
        match (name, version) {
            (b"MeshFormat", None) => version = Some(header(&mut cursor)?),
            (b"MeshFormat", Some(_)) => {
                let help = "a file holds one mesh: split it";
                return Err(cursor.stop("another mesh begins here", help));
            }
            (b"Comments", _) => cursor.skip_section()?,
            (_, None) => {
                let help = "a file of Gmsh begins with $MeshFormat: export it again";
                return Err(cursor.stop("there is no $MeshFormat above", help));
            }
            (b"PhysicalNames", _) => contents.physical_names(&mut cursor)?,
            (known, Some(version)) => {
                if version == Version::Four
                    && matches!(
                        known,
                        b"Entities" | b"PartitionedEntities" | b"Nodes" | b"Elements"
                    )
                    && !cursor.is_text()
                {
                    cursor.end_line();
                }
                match (known, version) {
                    (b"Entities", Version::Four) => {
                        version4::entities(contents, &mut cursor, false)?;
                    }
                    (b"PartitionedEntities", Version::Four) => {
                        version4::entities(contents, &mut cursor, true)?;
                    }
                    (b"Nodes", Version::Four) => version4::nodes(contents, &mut cursor, report)?,
                    (b"Nodes", Version::Two) => {
                        version2::nodes(contents, &mut cursor, false, report)?;
                    }
                    (b"ParametricNodes", Version::Two) => {
                        version2::nodes(contents, &mut cursor, true, report)?;
                    }
                    (b"Elements", Version::Four) => version4::elements(contents, &mut cursor)?,
                    (b"Elements", Version::Two) => version2::elements(contents, &mut cursor)?,
                    _ => cursor.skip_section()?,
                }
                seen.0 |= [b"Nodes".as_slice(), b"ParametricNodes"].contains(&known);
                seen.1 |= known == b"Elements";
            }
        }
    }
    for (there, name) in [(seen.0, "$Nodes"), (seen.1, "$Elements")] {
        if !there {
            let help = DAMAGED;
            return Err(cursor.stop(format!("the file ends without {name}"), help));
        }
    }
    Ok(())
}

/// `$MeshFormat`: version, text or binary, bytes of labels, and byte order.
fn header(cursor: &mut Cursor) -> Result<Version, Stop> {
    let number = cursor.written_real("the version of the format")?;
    let version = match number {
        4.1 => Version::Four,
        2.0..=2.2 => Version::Two,
        _ => return Err(old(cursor, &number.to_string())),
    };
    let binary = cursor.written("0 for text or 1 for binary")?;
    if !matches!(binary, 0 | 1) {
        let what = format!("the kind of file is {binary}");
        return Err(cursor.stop(what, "0 is text and 1 is binary: export the file again"));
    }
    let wide = cursor.written("the bytes of a label")?;
    let wide = usize::try_from(wide).unwrap_or(0);
    match binary {
        0 => {}
        1 if wide == 8 || (wide == 4 && version == Version::Four) => {
            cursor.end_line();
            cursor.encoding = Encoding::Binary { big_endian: false, wide };
            let one = cursor.whole("the number 1, which shows the byte order")?;
            cursor.encoding = match one {
                1 => Encoding::Binary { big_endian: false, wide },
                0x0100_0000 => Encoding::Binary { big_endian: true, wide },
                _ => {
                    let what = "the bytes after the header are no 1 in either byte order";
                    let help = "was the file changed by a transfer as text? Export it again, or as text \
                                (`Mesh.Binary = 0`)";
                    return Err(cursor.stop(what, help));
                }
            };
        }
        _ => {
            let what = format!("binary files with {wide} bytes a number are not read");
            return Err(cursor.stop(what, "export as text (`Mesh.Binary = 0`)"));
        }
    }
    cursor.end()?;
    Ok(version)
}

fn old(cursor: &Cursor, version: &str) -> Stop {
    let help = "write version 4.1 or 2.2: `gmsh FILE -save -format msh41 -o NEW.msh`";
    cursor.stop(format!("version {version} of Gmsh's format is not read"), help)
}
