//! Text files by what they begin with.

use super::binary::EXODUS;
use super::remedy::{
    AGAIN, ANSYS, ASTER, COMSOL, DYNA, ELMER, FOAM, MESHIO, OF_ABAQUS, OF_CALCULIX, Remedy, SHAPE,
    WEB,
};

type Named = (&'static str, Remedy);

/// First characters, behind blanks; capitals do not count.
const FIRST: [(&str, &str, Remedy); 74] = [
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
    ("<!doctype x3d", "an X3D file", Remedy::Surface),
    ("<x3d", "an X3D file", Remedy::Surface),
    ("<!doctype html", "a web page", WEB),
    ("<html", "a web page", WEB),
    ("# vtk datafile", "a VTK file", MESHIO),
    ("<vtkfile", "a VTK file in XML", MESHIO),
    ("<xdmf", "an XDMF file", Remedy::Meshio(Some("xdmf"), " h5py")),
    ("<!doctype xdmf", "an XDMF file", Remedy::Meshio(Some("xdmf"), " h5py")),
    ("<dolfin", "a mesh of DOLFIN (XML)", Remedy::Meshio(Some("dolfin-xml"), "")),
    ("<febio_spec", "an input of FEBio", AGAIN),
    ("<xao", "an XAO file, with the shape of a mesh", SHAPE),
    ("<svg", "a picture", AGAIN),
    ("iso-10303-21", "a STEP file", Remedy::GmshShape),
    ("dbrep_drawableshape", "a BREP file of Open Cascade", Remedy::GmshShape),
    ("cascade topology", "a BREP file of Open Cascade", Remedy::GmshShape),
    ("**abcdefghijklmnopqrstuvwxyz", "a Parasolid file", SHAPE),
    ("meshversionformatted", "a mesh of Medit", Remedy::Gmsh),
    ("mesh3d", "a mesh of Netgen", Remedy::Meshio(Some("netgen"), "")),
    ("ndime", "a mesh of SU2", Remedy::Meshio(Some("su2"), "")),
    ("ply\n", "a PLY file", Remedy::Surface),
    ("ply\r", "a PLY file", Remedy::Surface),
    ("off\n", "an OFF file", Remedy::Surface),
    ("off\r", "an OFF file", Remedy::Surface),
    ("off ", "an OFF file", Remedy::Surface),
    ("coff", "an OFF file", Remedy::Surface),
    ("noff", "an OFF file", Remedy::Surface),
    ("mtllib", "an OBJ file", Remedy::Surface),
    ("tin (", "a surface in WKT", Remedy::Surface),
    ("tin(", "a surface in WKT", Remedy::Surface),
    ("polyhedralsurface", "a surface in WKT", Remedy::Surface),
    ("#vrml", "a VRML file", Remedy::Surface),
    ("#inventor", "a file of Open Inventor", Remedy::Surface),
    ("(0", "a mesh of Fluent", Remedy::Meshio(Some("ansys"), "")),
    ("(1", "a mesh of Fluent", Remedy::Meshio(Some("ansys"), "")),
    ("(2", "a mesh of Fluent", Remedy::Meshio(Some("ansys"), "")),
    ("/com", "an archive of ANSYS (CDB)", ANSYS),
    ("/prep7", "an archive of ANSYS (CDB)", ANSYS),
    ("/batch", "an input of ANSYS", ANSYS),
    ("/title", "an input of ANSYS", ANSYS),
    ("/nopr", "an input of ANSYS", ANSYS),
    ("/clear", "an input of ANSYS", ANSYS),
    ("nblock", "an archive of ANSYS (CDB)", ANSYS),
    ("#radioss", "an input of Radioss", DYNA),
    ("/begin", "an input of Radioss", DYNA),
    ("$enter", "an input of PERMAS", Remedy::Meshio(Some("permas"), "")),
    ("!permas", "an input of PERMAS", Remedy::Meshio(Some("permas"), "")),
    ("titre", "a mesh of Code_Aster", ASTER),
    ("coor_3d", "a mesh of Code_Aster", ASTER),
    ("x3d", "a mesh of LaGriT", MESHIO),
    ("1c", "a file of results of CalculiX (FRD)", OF_CALCULIX),
    ("%mesh", "a COMSOL file", COMSOL),
    ("# created by comsol", "a mesh of COMSOL", COMSOL),
    ("simulia", "a file of Abaqus that is no input", OF_ABAQUS),
    ("abaqus_odb", "a database of Abaqus", OF_ABAQUS),
    ("begin modelpartdata", "a mesh of Kratos", Remedy::Meshio(Some("mdpa"), "")),
    ("begin properties", "a mesh of Kratos", Remedy::Meshio(Some("mdpa"), "")),
    ("begin nodes", "a mesh of Kratos", Remedy::Meshio(Some("mdpa"), "")),
    ("begin table", "a mesh of Kratos", Remedy::Meshio(Some("mdpa"), "")),
    ("control info", "a neutral file of Gambit", AGAIN),
    ("gid post", "a file of results of GiD", AGAIN),
    ("ensight", "a file of EnSight", AGAIN),
    ("v5_cfv2", "a document of CATIA", SHAPE),
    ("setfactory", "a script of Gmsh", Remedy::GmshShape),
    ("merge \"", "a script of Gmsh", Remedy::GmshShape),
    (
        "netcdf ",
        "a netCDF file in text, as of Exodus",
        Remedy::Other(
            "make it a netCDF file, `ncgen -o {stem}.e {}`, and convert that, `pip install meshio netCDF4` and \
             `meshio convert {stem}.e {stem}.inp`",
        ),
    ),
    ("(----tochnog", "an input of Tochnog", AGAIN),
    ("finite element mesh (gridfe)", "a mesh of Diffpack", Remedy::Gmsh),
    ("%% matlab", "a mesh in MATLAB's language", AGAIN),
    ("matlab 5.0 mat", "a file of MATLAB", AGAIN),
    ("#!/", "a script", AGAIN),
    ("{", "a JSON file", AGAIN),
    ("[", "a file of settings", AGAIN),
];

/// Of text that begins so, in its own line behind comments, what it is.
pub(super) fn named(bytes: &[u8], extension: &str) -> Option<Named> {
    const SEEN: usize = 1 << 16;
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(SEEN)]).to_lowercase();
    let xml = start.trim_start();
    let mut words = match xml.strip_prefix("<?xml").and_then(|rest| rest.split_once("?>")) {
        Some((_, rest)) => rest.trim_start(),
        None => xml,
    };
    while let Some((_, rest)) = words.strip_prefix("<!--").and_then(|own| own.split_once("-->")) {
        words = rest.trim_start();
    }
    let first = |words: &str| {
        let found = FIRST.iter().find(|(first, ..)| words.starts_with(first));
        found.map(|&(_, what, remedy)| (what, remedy))
    };
    if let Some(found) = first(words) {
        return Some(found);
    }
    // Behind comments of other formats; `$` and `*` begin comments and cards of those that are read.
    let is_comment = |line: &&str| ["#", "!", "%", "//"].iter().any(|sign| line.starts_with(sign));
    let mut behind = words;
    while let Some((line, rest)) = behind.split_once('\n') {
        if !line.trim().is_empty() && !is_comment(&line.trim()) {
            break;
        }
        behind = rest.trim_start();
    }
    if behind.len() < words.len()
        && !behind.starts_with(['{', '['])
        && let Some(found) = first(behind)
    {
        return Some(found);
    }
    if let Some(found) = by_keywords(words) {
        return Some(found);
    }
    if let Some(found) = by_numbers(&start, behind, extension) {
        return Some(found);
    }
    words.starts_with("//").then_some((
        "a script, as of Gmsh",
        Remedy::Other("mesh it, `gmsh {} -3 -order 2 -format msh41 -o {stem}.msh`"),
    ))
}

/// Keywords that stand somewhere in the first lines.
fn by_keywords(words: &str) -> Option<Named> {
    let begins = |with: &[&str]| {
        words.lines().any(|line| with.iter().any(|own| line.trim_start().starts_with(own)))
    };
    // No keyword of Abaqus has an underscore.
    let dyna = [
        "*keyword",
        "*element_solid",
        "*element_shell",
        "*section_s",
        "*mat_",
        "*control_",
        "*set_node",
    ];
    if words.starts_with(['$', '*']) && begins(&dyna) {
        return Some(("an input of LS-DYNA", DYNA));
    }
    if words.starts_with('*') {
        let own =
            words.lines().find(|line| !line.trim_start().starts_with('*')).unwrap_or_default();
        let mut own = own.split_whitespace();
        let point =
            own.next() == Some("g") && own.filter(|own| own.parse::<f64>().is_ok()).count() == 4;
        return (point
            || words.lines().next().is_some_and(|line| line.starts_with("* flac3d grid")))
        .then_some(("a grid of FLAC3D", Remedy::Meshio(Some("flac3d"), "")));
    }
    if words.starts_with('$') {
        return None;
    }
    if words.contains("foamfile") || words.starts_with("/*") && words.contains("openfoam") {
        return Some(("a file of OpenFOAM", FOAM));
    }
    if words.starts_with("solid") && words.contains("facet") {
        return Some(("an STL file", Remedy::Surface));
    }
    if words.starts_with("mesh") && words.contains("dimension") && words.contains("elemtype") {
        return Some(("a mesh of GiD", AGAIN));
    }
    if begins(&["variables"]) && begins(&["zone"]) {
        return Some(("a file of Tecplot", Remedy::Meshio(Some("tecplot"), "")));
    }
    if begins(&["nblock,"]) || begins(&["/prep7"]) {
        return Some(("an archive of ANSYS (CDB)", ANSYS));
    }
    if words.starts_with("format") && words.contains("ensight") {
        return Some(("a file of EnSight", AGAIN));
    }
    None
}

/// Formats that begin with numbers between blanks, where an input of Abaqus has a keyword and commas.
fn by_numbers(start: &str, behind: &str, extension: &str) -> Option<Named> {
    let first = start.lines().next().unwrap_or_default().trim_end();
    // 80 columns, of which the last eight are a section and a number.
    if first.len() == 80
        && first.is_ascii()
        && first.as_bytes()[72] == b's'
        && first[73..].trim().parse() == Ok(1)
    {
        return Some(("an IGES file", Remedy::GmshShape));
    }
    let lines = behind.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines: Vec<Vec<&str>> =
        lines.take(3).map(|line| line.split_whitespace().collect()).collect();
    let [one, two, ..] = &lines[..] else { return None };
    let whole = |line: &[&str]| -> Option<Vec<i64>> {
        line.iter()
            .map(|own| own.parse().ok())
            .collect::<Option<Vec<i64>>>()
            .filter(|own| !own.is_empty())
    };
    let numbers = |line: &[&str]| line.iter().all(|own| own.parse::<f64>().is_ok());
    let decimals = |line: &[&str]| numbers(line) && line.iter().any(|own| own.contains('.'));
    if one[0] == "v" && one.len() >= 4 && numbers(&one[1..4])
        || one.len() == 2 && one[0] == "o" && two[0] == "v"
    {
        return Some(("an OBJ file", Remedy::Surface));
    }
    if lines.get(2).is_some_and(|three| three[0] == "26" && three.len() >= 6)
        && one[0] == "25"
        && whole(one).is_some()
    {
        return Some(("a neutral file of Patran", AGAIN));
    }
    let head = whole(one)?;
    match (&head[..], two.len()) {
        ([nodes, cells, _, _, _], 4) if *nodes > 0 && *cells > 0 && numbers(two) => {
            Some(("a mesh of AVS (UCD)", Remedy::Meshio(Some("avsucd"), "")))
        }
        ([_, _, _, _, _, _, _], 3) if head.iter().all(|own| *own >= 0) && numbers(two) => {
            Some(("a mesh in UGRID", Remedy::Meshio(Some("ugrid"), "")))
        }
        ([nodes, 3, _, 0 | 1], 4..)
            if *nodes > 0 && numbers(two) && (extension == "node" || decimals(two)) =>
        {
            Some(("a mesh of TetGen", Remedy::Meshio(Some("tetgen"), "")))
        }
        ([cells, 4 | 10, 0 | 1], 5..) if *cells > 0 && extension == "ele" => {
            Some(("a mesh of TetGen", Remedy::Meshio(Some("tetgen"), "")))
        }
        _ if is_plot3d(&head, two) => Some(("a PLOT3D file", Remedy::Plot3d)),
        _ => None,
    }
}

/// A number of blocks by itself and the size of the first, or the size of the only block and coordinates.
fn is_plot3d(head: &[i64], second: &[&str]) -> bool {
    let sizes = second.iter().all(|own| own.parse().is_ok_and(|own: u32| own > 0));
    let a_coordinate = second.iter().any(|own| own.contains('.'));
    let are_numbers = second.iter().all(|own| own.parse::<f64>().is_ok());
    let blocks = head.len() == 1 && second.len().is_multiple_of(3) && sizes;
    let block = head.len() == 3 && a_coordinate && are_numbers;
    head.iter().all(|own| *own > 0) && (blocks || block)
}

/// By the extension, of a file that says nothing itself.
pub(super) fn by_name(name: &str, extension: &str) -> Option<Named> {
    if ["mesh.header", "mesh.nodes", "mesh.elements", "mesh.boundary"].contains(&name) {
        return Some(("a mesh of Elmer", ELMER));
    }
    Some(match extension {
        "p3d" | "p3dfmt" | "plot3d" => ("a PLOT3D file", Remedy::Plot3d),
        "cdb" => ("an archive of ANSYS (CDB)", ANSYS),
        "k" | "key" | "dyn" => ("an input of LS-DYNA", DYNA),
        "geo" => ("a script of Gmsh", Remedy::GmshShape),
        "step" | "stp" => ("a STEP file", Remedy::GmshShape),
        "iges" | "igs" => ("an IGES file", Remedy::GmshShape),
        "x_t" | "x_b" | "xmt_txt" | "xmt_bin" | "xmt" => ("a Parasolid file", SHAPE),
        "sat" | "sab" => ("an ACIS file", SHAPE),
        "stl" => ("an STL file", Remedy::Surface),
        "obj" => ("an OBJ file", Remedy::Surface),
        "ply" => ("a PLY file", Remedy::Surface),
        "off" => ("an OFF file", Remedy::Surface),
        "med" | "rmed" | "mmed" => ("a MED file", Remedy::Gmsh),
        "mesh" => ("a mesh of Medit", Remedy::Gmsh),
        "meshb" => ("a mesh of Medit (binary)", MESHIO),
        "vtk" | "vtu" => ("a VTK file", MESHIO),
        "xdmf" | "xmf" => ("an XDMF file", Remedy::Meshio(Some("xdmf"), " h5py")),
        "e" | "exo" | "ex2" => ("an Exodus file", EXODUS),
        "cgns" => ("a CGNS file", Remedy::Gmsh),
        "su2" => ("a mesh of SU2", MESHIO),
        "vol" => ("a mesh of Netgen", MESHIO),
        "node" | "ele" => ("a mesh of TetGen", MESHIO),
        "mdpa" => ("a mesh of Kratos", MESHIO),
        "f3grid" => ("a grid of FLAC3D", MESHIO),
        "ugrid" => ("a mesh in UGRID", MESHIO),
        "avs" => ("a mesh of AVS (UCD)", MESHIO),
        "post" | "dato" => ("an input of PERMAS", Remedy::Meshio(Some("permas"), "")),
        "tec" => ("a file of Tecplot", MESHIO),
        "cas" => ("a mesh of Fluent", Remedy::Meshio(Some("ansys"), "")),
        "neu" => ("a neutral file of Gambit or Patran", AGAIN),
        "mphtxt" | "mphbin" => ("a mesh of COMSOL", COMSOL),
        "mail" => ("a mesh of Code_Aster", ASTER),
        "odb" | "cae" => ("a database of Abaqus", OF_ABAQUS),
        "op2" | "xdb" | "f06" => ("a file of results of Nastran", super::remedy::OF_NASTRAN),
        "frd" => ("a file of results of CalculiX", OF_CALCULIX),
        "hm" => ("a file of HyperMesh", AGAIN),
        _ => return None,
    })
}
