//! Files that are no meshes of the formats that are read: what they are, and what makes a mesh of them.

use std::path::Path;

/// What a file is, and what to do with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Foreign {
    /// In words, such as `a STEP file`.
    pub what: &'static str,
    /// The remedy, with the file's own name in commands.
    pub help: String,
}

/// What makes a mesh of a file.
#[derive(Debug, Clone, Copy)]
enum Remedy {
    /// Gmsh reads the mesh.
    Gmsh,
    /// Gmsh reads the shape, and meshes it.
    GmshShape,
    /// Gmsh reads a surface: a volume has to be made of it.
    Surface,
    /// Gmsh reads the blocks, whose nodes stand twice where they meet.
    Plot3d,
    /// The library meshio reads the mesh.
    Meshio,
    /// Something else, in words in which `{}` stands for the file and `{stem}` for its name without extension.
    Other(&'static str),
}

impl Remedy {
    fn text(self, path: &str) -> String {
        let own = Path::new(path);
        let name = own.file_name().map_or(path.into(), |name| name.to_string_lossy());
        let stem = own.file_stem().map_or("mesh".into(), |stem| stem.to_string_lossy());
        let read =
            "read are meshes of Gmsh, Abaqus, CalculiX and Nastran, and universal files (UNV)";
        // Not over the file itself.
        let target =
            if *name == format!("{stem}.msh") { format!("{stem}-41") } else { stem.to_string() };
        match self {
            Remedy::Gmsh => {
                format!("{read}: convert it, `gmsh {name} -save -format msh41 -o {target}.msh`")
            }
            Remedy::Plot3d => format!(
                "{read}: convert it, `gmsh {stem}.p3d -save -format msh41 -o {target}.msh`; blocks that meet are joined by \
                 `merge = \"1e-6 m\"` in the case"
            ),
            Remedy::GmshShape => {
                format!(
                    "it is a shape: mesh it, `gmsh {name} -3 -order 2 -format msh41 -o {target}.msh`"
                )
            }
            Remedy::Surface => format!(
                "it is a surface without a volume: mesh the solid that it was made from, such as its STEP file, \
                 `gmsh {stem}.step -3 -order 2 -format msh41 -o {target}.msh`"
            ),
            Remedy::Meshio => {
                format!(
                    "{read}: convert it, `pip install meshio` and `meshio convert {name} {stem}.inp`"
                )
            }
            Remedy::Other(words) => words.replace("{}", &name).replace("{stem}", &stem),
        }
    }
}

const ANSYS: Remedy = Remedy::Other(
    "read are meshes of Gmsh, Abaqus, CalculiX and Nastran, and universal files (UNV): convert it, `pip install mapdl-archive meshio`, `python -c \
     \"import mapdl_archive; mapdl_archive.Archive('{}').grid.save('{stem}.vtk')\"` and `meshio convert {stem}.vtk \
     {stem}.inp`",
);
const DYNA: Remedy = Remedy::Other(
    "read are meshes of Gmsh, Abaqus, CalculiX and Nastran: export one of these formats from the preprocessor, such as \
     Nastran's from LS-PrePost",
);
const AGAIN: Remedy =
    Remedy::Other("export the mesh itself, as a file of Gmsh, Abaqus, CalculiX or Nastran");
const WEB: Remedy =
    Remedy::Other("download the file itself (the raw one) in place of the page that shows it");

/// First bytes of binary files.
const BINARY: [(&[u8], &str, Remedy); 14] = [
    (b"\x1f\x8b", "compressed by gzip", Remedy::Other("unpack it, `gunzip -k {}`")),
    (b"BZh", "compressed by bzip2", Remedy::Other("unpack it, `bunzip2 -k {}`")),
    (b"\xfd7zXZ", "compressed by xz", Remedy::Other("unpack it, `unxz -k {}`")),
    (b"\x28\xb5\x2f\xfd", "compressed by zstd", Remedy::Other("unpack it, `unzstd {}`")),
    (
        b"PK\x03\x04",
        "a zip archive",
        Remedy::Other("unpack it, `unzip {}`, and name the mesh in it"),
    ),
    (
        b"7z\xbc\xaf\x27\x1c",
        "a 7z archive",
        Remedy::Other("unpack it, `7z x {}`, and name the mesh in it"),
    ),
    (b"Rar!", "a rar archive", Remedy::Other("unpack it, `unrar x {}`, and name the mesh in it")),
    (b"CDF\x01", "a netCDF file, as of Exodus", Remedy::Meshio),
    (b"CDF\x02", "a netCDF file, as of Exodus", Remedy::Meshio),
    (
        b"\xff\xfe",
        "text in UTF-16",
        Remedy::Other("save it in UTF-8, `iconv -f UTF-16 -t UTF-8 {} > {stem}-utf8.inp`"),
    ),
    (
        b"\xfe\xff",
        "text in UTF-16",
        Remedy::Other("save it in UTF-8, `iconv -f UTF-16 -t UTF-8 {} > {stem}-utf8.inp`"),
    ),
    (
        b"\x00\x00\xfe\xff",
        "text in UTF-32",
        Remedy::Other("save it in UTF-8, `iconv -f UTF-32 -t UTF-8 {} > {stem}-utf8.inp`"),
    ),
    (b"%PDF", "a PDF document", AGAIN),
    (b"\x89PNG", "a picture", AGAIN),
];

/// First characters of text files, behind blanks; capitals do not count.
const TEXT: [(&str, &str, Remedy); 38] = [
    (
        "version https://git-lfs",
        "a pointer of Git LFS, not the file itself",
        Remedy::Other("run `git lfs pull`"),
    ),
    (
        "/annex/objects/",
        "a pointer of git-annex, not the file itself",
        Remedy::Other("run `git annex get {}`"),
    ),
    ("<!doctype html", "a web page", WEB),
    ("<html", "a web page", WEB),
    ("# vtk datafile", "a VTK file", Remedy::Meshio),
    ("<vtkfile", "a VTK file in XML", Remedy::Meshio),
    ("<xdmf", "an XDMF file", Remedy::Meshio),
    ("iso-10303-21", "a STEP file", Remedy::GmshShape),
    ("dbrep_drawableshape", "a BREP file of Open Cascade", Remedy::GmshShape),
    ("cascade topology", "a BREP file of Open Cascade", Remedy::GmshShape),
    (
        "**abcdefghijklmnopqrstuvwxyz",
        "a Parasolid file",
        Remedy::Other("it is a shape: export it as STEP, and mesh that"),
    ),
    ("meshversionformatted", "a mesh of Medit", Remedy::Gmsh),
    ("mesh3d", "a mesh of Netgen", Remedy::Meshio),
    ("ndime", "a mesh of SU2", Remedy::Gmsh),
    ("ply\n", "a PLY file", Remedy::Surface),
    ("ply\r", "a PLY file", Remedy::Surface),
    ("off\n", "an OFF file", Remedy::Surface),
    ("(0 ", "a mesh of Fluent", Remedy::Meshio),
    ("(1 ", "a mesh of Fluent", Remedy::Meshio),
    ("(2 ", "a mesh of Fluent", Remedy::Meshio),
    ("/com", "an archive of ANSYS (CDB)", ANSYS),
    ("/prep7", "an archive of ANSYS (CDB)", ANSYS),
    ("/batch", "an input of ANSYS", ANSYS),
    ("nblock", "an archive of ANSYS (CDB)", ANSYS),
    ("*keyword", "an input of LS-DYNA", DYNA),
    ("#radioss", "an input of Radioss", DYNA),
    ("$enter", "an input of PERMAS", Remedy::Meshio),
    (
        "titre",
        "a mesh of Code_Aster",
        Remedy::Other("read it in Salome, and export UNV, which is read: `{stem}.unv`"),
    ),
    (
        "coor_3d",
        "a mesh of Code_Aster",
        Remedy::Other("read it in Salome, and export UNV, which is read: `{stem}.unv`"),
    ),
    ("x3d", "a mesh of LaGriT", Remedy::Meshio),
    ("1c", "a file of results of CalculiX (FRD)", Remedy::Other("name its input, `{stem}.inp`")),
    ("%mesh", "a COMSOL file", Remedy::Other("export it as Nastran from COMSOL")),
    ("# created by comsol", "a mesh of COMSOL", Remedy::Other("export it as Nastran from COMSOL")),
    (
        "simulia",
        "a file of Abaqus that is no input",
        Remedy::Other("write the input, `{stem}.inp`"),
    ),
    ("abaqus_odb", "a database of Abaqus", Remedy::Other("write the input, `{stem}.inp`")),
    ("{", "a JSON file", AGAIN),
    ("[", "a file of settings", AGAIN),
    (
        "//",
        "a script, as of Gmsh",
        Remedy::Other("mesh it, `gmsh {} -3 -order 2 -format msh41 -o {stem}.msh`"),
    ),
];

/// What a file is that is none of the formats that are read; `None` of one that may be.
pub fn foreign(bytes: &[u8], path: &str) -> Option<Foreign> {
    let named =
        |what: &'static str, remedy: Remedy| Some(Foreign { what, help: remedy.text(path) });
    let extension = Path::new(path)
        .extension()
        .map_or(String::new(), |own| own.to_string_lossy().to_lowercase());
    if bytes.starts_with(b"\x89HDF") {
        return match extension.as_str() {
            "cgns" => named("a CGNS file (HDF5)", Remedy::Gmsh),
            "e" | "ex2" | "exo" => named("an Exodus file (HDF5)", Remedy::Meshio),
            "h5" | "hdf5" | "hdf" => named("an HDF5 file, as of MED or XDMF", Remedy::Gmsh),
            _ => named("a MED file of Salome (HDF5)", Remedy::Gmsh),
        };
    }
    if let Some((_, what, remedy)) = BINARY.iter().find(|(first, ..)| bytes.starts_with(first)) {
        return named(what, *remedy);
    }
    let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = String::from_utf8_lossy(&text[..text.len().min(400)]).to_lowercase();
    let xml = start.trim_start();
    let words = match xml.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>")) {
        Some((_, rest)) => rest.trim_start(),
        None => xml,
    };
    if let Some((_, what, remedy)) = TEXT.iter().find(|(first, ..)| words.starts_with(first)) {
        return named(what, *remedy);
    }
    // Comments of LS-DYNA begin with $, as those of Nastran.
    let body = words.lines().map(str::trim).find(|line| !line.is_empty() && !line.starts_with('$'));
    if words.starts_with('$') && body == Some("*keyword") {
        return named("an input of LS-DYNA", DYNA);
    }
    let first = start.lines().next().unwrap_or_default();
    // 80 columns, of which the last eight are a section and a number.
    if first.len() == 80 && first.as_bytes()[72] == b's' && first[73..].trim() == "1" {
        return named("an IGES file", Remedy::GmshShape);
    }
    if words.starts_with("solid") && start.contains("facet") || is_binary_stl(bytes) {
        return named("an STL file", Remedy::Surface);
    }
    if is_plot3d(&start) {
        return named("a PLOT3D file", Remedy::Plot3d);
    }
    let by_name = match extension.as_str() {
        "p3d" | "p3dfmt" | "plot3d" => named("a PLOT3D file", Remedy::Plot3d),
        "cdb" => named("an archive of ANSYS (CDB)", ANSYS),
        "geo" => named("a script of Gmsh", Remedy::GmshShape),
        "step" | "stp" => named("a STEP file", Remedy::GmshShape),
        "iges" | "igs" => named("an IGES file", Remedy::GmshShape),
        "stl" => named("an STL file", Remedy::Surface),
        "med" | "rmed" | "mmed" => named("a MED file", Remedy::Gmsh),
        "vtk" | "vtu" => named("a VTK file", Remedy::Meshio),
        "odb" | "cae" => {
            named("a database of Abaqus", Remedy::Other("write the input, `{stem}.inp`"))
        }
        "op2" | "xdb" | "f06" => {
            named("a file of results of Nastran", Remedy::Other("name its input, `{stem}.bdf`"))
        }
        "frd" => {
            named("a file of results of CalculiX", Remedy::Other("name its input, `{stem}.inp`"))
        }
        _ => None,
    };
    // An extension says nothing of a file that begins as one that is read.
    by_name.filter(|_| !words.starts_with(['*', '$']))
}

/// A number of blocks by itself and the size of the first, or the size of the only block and coordinates: numbers between blanks,
/// where an input of Abaqus has a keyword.
fn is_plot3d(start: &str) -> bool {
    let mut lines = start.lines().map(str::trim).filter(|line| !line.is_empty());
    let mut line = || lines.next().map_or(Vec::new(), |line| line.split_whitespace().collect());
    let (first, second): (Vec<&str>, Vec<&str>) = (line(), line());
    let sizes = |line: &[&str]| {
        !line.is_empty() && line.iter().all(|own| own.parse().is_ok_and(|own: u32| own > 0))
    };
    let are_numbers = |line: &[&str]| line.iter().all(|own| own.parse::<f64>().is_ok());
    let a_coordinate = second.iter().any(|own| own.contains('.'));
    let blocks = first.len() == 1 && second.len() % 3 == 0 && sizes(&second);
    let block = first.len() == 3 && a_coordinate && are_numbers(&second);
    sizes(&first) && (blocks || block)
}

/// A head of 80 bytes, a count, and 50 bytes a triangle.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count))
}

#[cfg(test)]
mod tests {
    use super::foreign;

    fn what(bytes: &[u8], path: &str) -> Option<(&'static str, String)> {
        foreign(bytes, path).map(|found| (found.what, found.help))
    }

    #[test]
    fn files_of_other_formats_are_named() {
        let iges = format!("{:<72}S      1\n", "");
        let mut stl = vec![b' '; 84 + 50];
        stl[80..84].copy_from_slice(&1u32.to_le_bytes());
        for (bytes, path, known, command) in [
            (
                &b"\x89HDF\r\n\x1a\n"[..],
                "a/part.med",
                "a MED file of Salome (HDF5)",
                "`gmsh part.med -save -format msh41 -o part.msh`",
            ),
            (b"/COM,my part\n", "part.cdb", "an archive of ANSYS (CDB)", "Archive('part.cdb')"),
            (b"! ANSYS\n", "part.cdb", "an archive of ANSYS (CDB)", "Archive('part.cdb')"),
            (
                b"# vtk DataFile Version 3.0\n",
                "part.vtk",
                "a VTK file",
                "`meshio convert part.vtk part.inp`",
            ),
            (
                b"<?xml version=\"1.0\"?>\n<VTKFile",
                "p.vtu",
                "a VTK file in XML",
                "`meshio convert p.vtu p.inp`",
            ),
            (
                b"ISO-10303-21;\n",
                "p.stp",
                "a STEP file",
                "`gmsh p.stp -3 -order 2 -format msh41 -o p.msh`",
            ),
            (iges.as_bytes(), "p.igs", "an IGES file", "`gmsh p.igs -3"),
            (b"solid part\n facet normal 0 0 1\n", "p.stl", "an STL file", "without a volume"),
            (&stl, "p", "an STL file", "without a volume"),
            (
                b"version https://git-lfs.github.com/spec/v1\n",
                "part.msh",
                "a pointer of Git LFS, not the file itself",
                "run `git lfs pull`",
            ),
            (b"\x1f\x8b\x08", "p.inp.gz", "compressed by gzip", "`gunzip -k p.inp.gz`"),
            (b"PK\x03\x04", "p.zip", "a zip archive", "`unzip p.zip`"),
            (
                b"\xff\xfe*\0",
                "p.inp",
                "text in UTF-16",
                "`iconv -f UTF-16 -t UTF-8 p.inp > p-utf8.inp`",
            ),
            (b"\n<!DOCTYPE html>", "p.inp", "a web page", "raw"),
            (b"*KEYWORD\n*NODE\n", "p.k", "an input of LS-DYNA", "LS-PrePost"),
            (b"$# LS-DYNA\n*KEYWORD\n*NODE\n", "p.key", "an input of LS-DYNA", "LS-PrePost"),
            (
                b"1\n3 3 3\n0 0 0 \n0 0 0 \n",
                "p.p3d",
                "a PLOT3D file",
                "`gmsh p.p3d -save -format msh41 -o p.msh`",
            ),
            (b" 2\n 2 2 2 4 2 2\n", "p.p3dfmt", "a PLOT3D file", "`gmsh p.p3d -save"),
            (b"1\r\n 2 3 4\r\n 0. 1.\r\n", "p.xyz", "a PLOT3D file", "merge"),
            (b"2 3 4\n 0.0 1.0 -2.5e-1\n", "p", "a PLOT3D file", "merge"),
            (b"(0 \"Fluent\")", "p.msh", "a mesh of Fluent", "`meshio convert p.msh p.inp`"),
        ] {
            let (found, help) = what(bytes, path).unwrap_or_else(|| panic!("{known}"));
            assert_eq!(found, known);
            assert!(help.contains(command), "{help}");
        }
    }

    #[test]
    fn files_that_are_read_are_not_foreign() {
        for (bytes, path) in [
            (&b"*NODE\n1, 0, 0, 0\n"[..], "part.cdb"),
            (b"** a\n*HEADING\n", "a.inp"),
            (b"\xef\xbb\xbf*NODE\n", "a.inp"),
            (b"$MeshFormat\n4.1 0 8\n", "a.med"),
            (b"$ bulk\nGRID,1\n", "a.unv"),
            (b"    -1\n  2411\n", "a.unv"),
            (b"", "a.unv"),
            (b"SOL 101\nCEND\n", "a.dat"),
            (b"GRID,1", "a"),
            (b"1, 0., 0., 0.\n", "nodes.txt"),
            (b"1 2 3\n4 5 6\n", "sets.txt"),
            (b"1\n2 3\n", "numbers"),
            (b"", "a.msh"),
        ] {
            assert_eq!(what(bytes, path), None, "{path}");
        }
    }
}
