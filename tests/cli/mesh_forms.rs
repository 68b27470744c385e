//! Mesh files as they come: without a density, of other formats, in other encodings; and what is said of them.

use crate::workbench::Workbench;

const NODES: [[f64; 3]; 12] = [
    [-6.0, -4.0, 0.0],
    [6.0, -4.0, 0.0],
    [6.0, 4.0, 0.0],
    [-6.0, 4.0, 0.0],
    [-6.0, -4.0, 15.0],
    [6.0, -4.0, 15.0],
    [6.0, 4.0, 15.0],
    [-6.0, 4.0, 15.0],
    [-6.0, -4.0, 30.0],
    [6.0, -4.0, 30.0],
    [6.0, 4.0, 30.0],
    [-6.0, 4.0, 30.0],
];

/// A bar of aluminium in mm, N, t, with what stands behind its Poisson's ratio.
fn bulk(rho: &str) -> String {
    let grid =
        |(at, [x, y, z]): (usize, &[f64; 3])| format!("GRID,{},,{x:?},{y:?},{z:?}\n", at + 1);
    let nodes: String = NODES.iter().enumerate().map(grid).collect();
    format!(
        "{nodes}CHEXA,1,1,1,2,3,4,5,6\n,7,8\nCHEXA,2,1,5,6,7,8,9,10\n,11,12\nCQUAD4,9,9,1,2,3,4\nPSOLID,1,1\n\
         MAT1,1,70000.,,.33{rho}\n"
    )
}

fn abaqus(density: &str) -> String {
    let line = |(at, [x, y, z]): (usize, &[f64; 3])| format!("{}, {x}, {y}, {z}\n", at + 1);
    let nodes: String = NODES.iter().enumerate().map(line).collect();
    format!(
        "*NODE\n{nodes}*ELEMENT, TYPE=C3D8I, ELSET=PSOLID_1\n1, 1,2,3,4,5,6,7,8\n2, 5,6,7,8,9,10,11,12\n\
         *MATERIAL, NAME=MAT1_1\n*ELASTIC\n70000., .33\n{density}*SOLID SECTION, ELSET=PSOLID_1, MATERIAL=MAT1_1\n"
    )
}

/// A case of that bar, or of two of it.
fn case(mesh: &str, bodies: &[&str], material: &str) -> String {
    let body = |name: &&str| {
        format!(
            "[body.{name}]\nturns = \"no\"\nmesh = \"{mesh}\"\nunits = \"mm, N, t\"\n{material}\nmodes = 4\nheld = [\"FOOT\"]\n\
             [body.{name}.sets.FOOT]\nplane = \"0 mm\"\n[body.{name}.sets.TIP]\nplane = \"30 mm\"\n\
             [joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"{name}\", sets = \"TIP\" }}\n\
             stiffness = {{ xx = \"1e5 N/m\", yy = \"1e5 N/m\" }}\n"
        )
    };
    let bodies: String = bodies.iter().map(body).collect();
    format!(
        "title = \"a bar\"\n[material.steel]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\ndensity = \"7850 kg/m^3\"\n\
         {bodies}[march]\ntime_step = \"1e-6 s\"\nsteps = 4\n"
    )
}

/// The material of the case is another one's: it completes none of the file.
#[test]
fn a_density_that_is_missing_is_asked_for_where_it_is_needed() {
    let steel = "material = \"steel\"";
    let regions = "regions = { PSOLID_1 = \"steel\" }";
    for (name, lacking, whole) in [
        ("bar.bdf", bulk(""), bulk(",2.7-9")),
        ("bar.inp", abaqus(""), abaqus("*DENSITY\n2.7e-9\n")),
    ] {
        let bench = Workbench::new()
            .file(name, &lacking)
            .file("steel.toml", &case(name, &["bar"], steel))
            .file("regions.toml", &case(name, &["bar"], regions))
            .file("none.toml", &case(name, &["bar"], ""));
        let found = bench.whirl(&["check", "steel.toml"]);
        assert_eq!(found.status, 2, "{}", found.stdout);
        let words = format!("{name}: material MAT1_1 of 2 cells, such as cell 1, has no density");
        assert!(found.stderr.contains(&words), "{}", found.stderr);
        assert!(found.stderr.contains("by `regions`"), "{}", found.stderr);
        let found = bench.whirl(&["check", "none.toml"]);
        assert_eq!(found.status, 2);
        assert!(found.stderr.contains("such as 7.86e-9 (steel)"), "{}", found.stderr);
        // 12 x 8 x 30 mm of the case's steel, and of the file's aluminium.
        let found = bench.whirl(&["check", "regions.toml"]);
        assert!(
            found.status == 0 && found.stdout.contains("0.022608"),
            "{} {}",
            found.stdout,
            found.stderr
        );
        let found = bench.whirl(&["mesh", name]);
        assert!(
            found.stdout.contains("2 cells hex8i, of MAT1_1, which has no density"),
            "{}",
            found.stdout
        );
        let bench = bench.file(name, &whole);
        let found = bench.whirl(&["check", "steel.toml"]);
        assert!(
            found.status == 0 && found.stdout.contains("0.007776"),
            "{} {}",
            found.stdout,
            found.stderr
        );
    }
}

#[test]
fn a_warning_of_a_mesh_comes_once_for_all_bodies_of_it() {
    let text = case("bar.bdf", &["one", "two"], "");
    let bench = Workbench::new().file("bar.bdf", &bulk(",2.7-9")).file("case.toml", &text);
    for command in ["check", "run"] {
        let found = bench.whirl(&[command, "case.toml"]);
        assert_eq!(found.status, 0, "{}", found.stderr);
        assert_eq!(found.stderr.matches("1 CQUAD4").count(), 1, "{}", found.stderr);
    }
}

/// A cube of 100 mm in mm, as dataset 164 says.
const UNIVERSAL: &str = "    -1
   164
         5SI: mm (newton)           2
  1.0D+03  1.0D+00  1.0D+00
  2.7315D+02
    -1
    -1
  2411
         1         1         1        11
  0.0D+00  0.0D+00  0.0D+00
         2         1         1        11
  1.0D+02  0.0D+00  0.0D+00
         3         1         1        11
  1.0D+02  1.0D+02  0.0D+00
         4         1         1        11
  0.0D+00  1.0D+02  0.0D+00
         5         1         1        11
  0.0D+00  0.0D+00  1.0D+02
         6         1         1        11
  1.0D+02  0.0D+00  1.0D+02
         7         1         1        11
  1.0D+02  1.0D+02  1.0D+02
         8         1         1        11
  0.0D+00  1.0D+02  1.0D+02
    -1
    -1
  2412
         1       115         1         1         7         8
         1         2         3         4         5         6         7         8
    -1
    -1
  2467
         1         0         0         0         0         0         0         2
FOOT
         7         1         0         0         7         2         0         0
    -1
";

#[test]
fn universal_files_are_read_in_their_own_units() {
    let inverted = UNIVERSAL.replace(
        "         2         3         4         5",
        "         4         3         2         5",
    );
    let bench = Workbench::new().file("cube.unv", UNIVERSAL).file("turned.unv", &inverted);
    let found = bench.whirl(&["mesh", "cube.unv"]);
    assert_eq!(found.status, 0, "{}", found.stderr);
    for word in ["cube.unv: universal file", "dataset 164", "FOOT"] {
        assert!(found.stdout.contains(word), "{word}: {}", found.stdout);
    }
    assert!(found.stderr.contains("in units of 0.001 m"), "{}", found.stderr);
    let found = bench.whirl(&["mesh", "turned.unv"]);
    assert!(found.stdout.contains("turned inside out at a node: 1 cells"), "{}", found.stdout);
}

#[test]
fn files_of_other_formats_and_encodings_are_named() {
    let bench = Workbench::new()
        .file("part.su2", "NDIME= 3\n")
        .file("part.cdb", "/COM,part\n")
        .file("part.msh", "version https://git-lfs.github.com/spec/v1\noid sha256:1\n")
        .file("part.toml", &case("part.su2", &["bar"], ""));
    for (arguments, words) in [
        (
            ["mesh", "part.su2"],
            [
                "this is a mesh of SU2, which is not read",
                "`meshio convert --input-format su2 part.su2 part.inp`",
            ],
        ),
        (["mesh", "part.cdb"], ["this is an archive of ANSYS (CDB)", "mapdl-archive"]),
        (["check", "part.toml"], ["this is a mesh of SU2, which is not read", "part.su2"]),
        (["mesh", "part.msh"], ["this is a pointer of Git LFS", "git lfs pull"]),
    ] {
        let found = bench.whirl(&arguments);
        assert_eq!(found.status, 2, "{}", found.stdout);
        assert!(words.iter().all(|word| found.stderr.contains(word)), "{}", found.stderr);
    }
    let utf16: Vec<u8> =
        [0xff, 0xfe].into_iter().chain(bulk("").bytes().flat_map(|byte| [byte, 0])).collect();
    std::fs::write(bench.path("utf16.toml"), &utf16).expect("a file");
    std::fs::write(bench.path("utf16.bdf"), &utf16).expect("a file");
    for arguments in [["check", "utf16.toml"], ["explain", "utf16.toml"], ["mesh", "utf16.bdf"]] {
        let found = bench.whirl(&arguments);
        assert_eq!(found.status, 2);
        assert!(found.stderr.contains("in UTF-16"), "{}", found.stderr);
    }
    let marked = format!("\u{feff}{}", case("bar.bdf", &["bar"], ""));
    let bench =
        bench.file("marked.toml", &marked).file("bar.bdf", &format!("\u{feff}{}", bulk(",2.7-9")));
    let found = bench.whirl(&["check", "marked.toml"]);
    assert_eq!(found.status, 0, "{}", found.stderr);
}

/// A folder in which nobody writes.
#[test]
#[cfg(target_os = "linux")]
fn a_picture_that_cannot_be_written_is_named() {
    let bench = Workbench::new().file("bar.bdf", &bulk(""));
    let mesh = bench.path("bar.bdf").display().to_string();
    let mut command = bench.command(&["mesh", &mesh, "--picture", "bar.svg"]);
    let output = command.current_dir("/proc").output().expect("the binary runs");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(text.contains("cannot write `bar.svg`"), "{text}");
}
