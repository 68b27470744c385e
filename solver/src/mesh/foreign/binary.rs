//! Files that are no text.

use super::remedy::{AGAIN, MESHIO, Remedy, SHAPE};

type Named = (&'static str, Remedy);

/// First bytes of files.
const FIRST: [(&[u8], &str, Remedy); 26] = [
    (b"\x1f\x8b", "compressed by gzip", Remedy::Other("unpack it, `gunzip -k {}`")),
    (b"\x1f\x9d", "compressed by compress", Remedy::Other("unpack it, `uncompress {}`")),
    (b"BZh", "compressed by bzip2", Remedy::Other("unpack it, `bunzip2 -k {}`")),
    (b"\xfd7zXZ", "compressed by xz", Remedy::Other("unpack it, `unxz -k {}`")),
    (b"\x28\xb5\x2f\xfd", "compressed by zstd", Remedy::Other("unpack it, `unzstd {}`")),
    (b"\x04\x22\x4d\x18", "compressed by lz4", Remedy::Other("unpack it, `unlz4 {}`")),
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
    (b"@(#)ADF", "a CGNS file (ADF)", Remedy::Gmsh),
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
    // A version from 1 to 4 and the keyword `Dimension`, either byte order.
    (b"\x01\0\0\0\x01\0\0\0\x03\0\0\0", "a mesh of Medit (binary)", MESHIO),
    (b"\x01\0\0\0\x02\0\0\0\x03\0\0\0", "a mesh of Medit (binary)", MESHIO),
    (b"\x01\0\0\0\x03\0\0\0\x03\0\0\0", "a mesh of Medit (binary)", MESHIO),
    (b"\x01\0\0\0\x04\0\0\0\x03\0\0\0", "a mesh of Medit (binary)", MESHIO),
    (b"\xe6\xe7\xf6\x51", "a grid of FLAC3D (binary)", MESHIO),
    (b"#!TDV", "a file of Tecplot (binary)", AGAIN),
    (b"PS\0\0", "a Parasolid file (binary)", SHAPE),
    (b"ACIS Bin", "an ACIS file (binary)", SHAPE),
    (b"3D Geometry File Format", "a file of Rhino", SHAPE),
    (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1", "a document of a CAD program", SHAPE),
    (b"glTF", "a glTF file", Remedy::Surface),
    (b"%PDF", "a PDF document", AGAIN),
    (b"\x89PNG", "a picture", AGAIN),
];

/// Names that a file of HDF5 has in it, with what it is then.
const OF_HDF: [(&[u8], &str, Remedy); 7] = [
    (b"tstt", "a mesh of MOAB (HDF5)", Remedy::Meshio(None, " h5py")),
    (b"INFOS_GENERALES", "a MED file of Salome (HDF5)", Remedy::Gmsh),
    (b"ENS_MAA", "a MED file of Salome (HDF5)", Remedy::Gmsh),
    (b"HDF5 MotherNode", "a CGNS file (HDF5)", Remedy::Gmsh),
    (b"CGNSLibraryVersion", "a CGNS file (HDF5)", Remedy::Gmsh),
    (b"num_nod_per_el", "an Exodus file (HDF5)", EXODUS),
    (
        b"VTKHDF",
        "a VTK file (HDF5)",
        Remedy::Other(
            "save it in ParaView as `{stem}.vtu`, and convert that, `pip install meshio` and `meshio convert {stem}.vtu {stem}.inp`",
        ),
    ),
];

pub(super) const EXODUS: Remedy = Remedy::Meshio(Some("exodus"), " netCDF4");

/// So many bytes of a file are searched for names.
const SEARCHED: usize = 1 << 20;

pub(super) fn named(bytes: &[u8], path: &str, extension: &str) -> Option<Named> {
    if bytes.starts_with(b"\x89HDF\r\n\x1a\n") || bytes.starts_with(b"\x89HDF") {
        return Some(of_hdf(bytes, path, extension));
    }
    if bytes.starts_with(b"CDF\x01")
        || bytes.starts_with(b"CDF\x02")
        || bytes.starts_with(b"CDF\x05")
    {
        // Others hold tables.
        let exodus = holds(bytes, b"num_nod") || holds(bytes, b"coord") || bytes.len() < 64;
        return Some(match exodus {
            true => ("a netCDF file, as of Exodus", EXODUS),
            false => ("a netCDF file that is no mesh of Exodus", AGAIN),
        });
    }
    if bytes.get(257..262) == Some(b"ustar") {
        return Some((
            "a tar archive",
            Remedy::Other("unpack it, `tar xf {}`, and name the mesh in it"),
        ));
    }
    if is_stl(bytes) {
        return Some(("an STL file", Remedy::Surface));
    }
    let found = FIRST.iter().find(|(first, ..)| bytes.starts_with(first));
    found.map(|&(_, what, remedy)| (what, remedy))
}

/// By what it holds, and by its extension where that leaves it open.
fn of_hdf(bytes: &[u8], path: &str, extension: &str) -> Named {
    if let Some(&(_, what, remedy)) = OF_HDF.iter().find(|(name, ..)| holds(bytes, name)) {
        return (what, remedy);
    }
    let path = path.to_ascii_lowercase();
    match extension {
        _ if path.ends_with(".cas.h5") || path.ends_with(".msh.h5") => {
            ("a mesh of Fluent (HDF5)", super::remedy::FLUENT_HDF)
        }
        "cgns" => ("a CGNS file (HDF5)", Remedy::Meshio(None, " h5py")),
        "e" | "ex2" | "exo" => ("an Exodus file (HDF5)", EXODUS),
        "h5m" => ("a mesh of MOAB (HDF5)", Remedy::Meshio(None, " h5py")),
        "hmf" => ("an HMF file (HDF5)", Remedy::Meshio(None, " h5py")),
        "med" | "rmed" | "mmed" => ("a MED file of Salome (HDF5)", Remedy::Gmsh),
        _ => (
            "an HDF5 file, as of the numbers of an XDMF file",
            Remedy::Other(
                "if there is a file `{stem}.xdmf` beside it, convert that, `pip install meshio h5py` and `meshio convert {stem}.xdmf \
                 {stem}.inp`; else export the mesh as a file of Gmsh, Abaqus, CalculiX or Nastran",
            ),
        ),
    }
}

fn holds(bytes: &[u8], name: &[u8]) -> bool {
    bytes[..bytes.len().min(SEARCHED)].windows(name.len()).any(|own| own == name)
}

/// A head of 80 bytes, a count, and 50 bytes a triangle.
fn is_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|count| count.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count))
}
