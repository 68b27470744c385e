//! What makes a mesh of a file, as commands with the file's own name.

use std::borrow::Cow;
use std::path::Path;

const READ: &str =
    "read are meshes of Gmsh, Abaqus, CalculiX and Nastran, and universal files (UNV)";

/// What makes a mesh of a file.
#[derive(Debug, Clone, Copy)]
pub(super) enum Remedy {
    /// Gmsh reads the mesh.
    Gmsh,
    /// Gmsh reads the shape, and meshes it.
    GmshShape,
    /// It is a surface: a volume has to be made of it.
    Surface,
    /// Gmsh reads the blocks, whose nodes stand twice where they meet.
    Plot3d,
    /// The library meshio reads the mesh: its own name of the format where the extension does not tell, and packages that it
    /// needs beside its own.
    Meshio(Option<&'static str>, &'static str),
    /// Something else, in words in which `{}` stands for the file, `{raw}` for its name in a text of Python and `{stem}` for it
    /// without extension.
    Other(&'static str),
}

/// Meshio knows the format by the extension.
pub(super) const MESHIO: Remedy = Remedy::Meshio(None, "");

impl Remedy {
    pub(super) fn text(self, path: &str) -> String {
        let own = Path::new(path);
        let name = own.file_name().map_or(path.into(), |name| name.to_string_lossy());
        let stem = own.file_stem().map_or("mesh".into(), |stem| stem.to_string_lossy());
        // Not over the file itself.
        let target = |extension: &str| match *name == format!("{stem}.{extension}") {
            true => quoted(&format!("{stem}-new.{extension}")).into_owned(),
            false => quoted(&format!("{stem}.{extension}")).into_owned(),
        };
        let (file, msh) = (quoted(&name), target("msh"));
        match self {
            Remedy::Gmsh => {
                format!("{READ}: convert it, `gmsh {file} -save -format msh41 -o {msh}`")
            }
            Remedy::Plot3d => format!(
                "{READ}: convert it, `gmsh {} -save -format msh41 -o {msh}`; blocks that meet are joined by `merge = \"1e-6 m\"` in \
                 the case",
                quoted(&format!("{stem}.p3d"))
            ),
            Remedy::GmshShape => {
                format!("it is a shape: mesh it, `gmsh {file} -3 -order 2 -format msh41 -o {msh}`")
            }
            Remedy::Surface => format!(
                "it is a surface without a volume: mesh the solid that it was made from, such as its STEP file, `gmsh {} -3 -order 2 \
                 -format msh41 -o {msh}`",
                quoted(&format!("{stem}.step"))
            ),
            Remedy::Meshio(format, packages) => {
                let format = format.map_or(String::new(), |own| format!(" --input-format {own}"));
                format!(
                    "{READ}: convert it, `pip install meshio{packages}` and `meshio convert{format} {file} {}`",
                    target("inp")
                )
            }
            Remedy::Other(words) => {
                words.replace("{}", &file).replace("{raw}", &name).replace("{stem}", &stem)
            }
        }
    }
}

/// As a shell reads it.
fn quoted(name: &str) -> Cow<'_, str> {
    let plain = |c: char| c.is_alphanumeric() || "._-+/=@%".contains(c);
    match name.chars().all(plain) {
        true => name.into(),
        false => format!("'{name}'").into(),
    }
}

pub(super) const ANSYS: Remedy = Remedy::Other(
    "read are meshes of Gmsh, Abaqus, CalculiX and Nastran, and universal files (UNV): convert it, `pip install mapdl-archive meshio`, `python -c \
     \"import mapdl_archive; mapdl_archive.Archive('{raw}').grid.save('{stem}.vtk')\"` and `meshio convert {stem}.vtk \
     {stem}.inp`",
);
pub(super) const DYNA: Remedy = Remedy::Other(
    "read are meshes of Gmsh, Abaqus, CalculiX and Nastran: export one of these formats from the preprocessor, such as \
     Nastran's from LS-PrePost",
);
/// Of what no free program converts.
pub(super) const AGAIN: Remedy =
    Remedy::Other("export the mesh itself, as a file of Gmsh, Abaqus, CalculiX or Nastran");
pub(super) const SHAPE: Remedy = Remedy::Other(
    "it is a shape: export it as STEP, and mesh that, `gmsh {stem}.step -3 -order 2 -format msh41 -o {stem}.msh`",
);
pub(super) const WEB: Remedy =
    Remedy::Other("download the file itself (the raw one) in place of the page that shows it");
pub(super) const ASTER: Remedy =
    Remedy::Other("read it in Salome, and export UNV, which is read: `{stem}.unv`");
pub(super) const COMSOL: Remedy = Remedy::Other("export it as Nastran from COMSOL");
pub(super) const OF_ABAQUS: Remedy = Remedy::Other("write the input, `{stem}.inp`");
pub(super) const OF_CALCULIX: Remedy = Remedy::Other("name its input, `{stem}.inp`");
pub(super) const OF_NASTRAN: Remedy = Remedy::Other("name its input, `{stem}.bdf`");
pub(super) const ELMER: Remedy = Remedy::Other(
    "convert the folder that it is in, `ElmerGrid 2 4 FOLDER`, which writes a file of Gmsh",
);
pub(super) const FOAM: Remedy = Remedy::Other(
    "of a mesh without polyhedra `foamMeshToFluent` writes a file of Fluent in `fluentInterface`, which `meshio convert` makes an \
     input of Abaqus; else mesh the shape anew",
);
pub(super) const FLUENT_HDF: Remedy = Remedy::Other(
    "save it as text in the older format of Fluent, such as `{stem}.msh`, and convert that, `pip install meshio` and `meshio \
     convert {stem}.msh {stem}.inp`",
);
