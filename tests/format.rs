//! The scene format: what is accepted means what the book says, what is refused is told in full.

use std::fs;
use std::path::{Path, PathBuf};

use leafmodel::document::report::DocumentErrors;
use renderer::scene::load::{Loaded, load, parse};
use tempfile::TempDir;

mod accepted;
mod book;
mod cameras;
mod instruments;
mod leaves;
mod measured;
mod objects;
mod refused;
mod scatter;
mod schema;
mod tissues;

/// The folder of these tests' own files.
fn own_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("format")
}

fn text_of(name: &str) -> String {
    fs::read_to_string(own_folder().join(name)).expect("the test's own file is there")
}

/// Inclinations of leaves, responses of sensors, a reflectance, and tables of specific absorption: a sound one, one that ends
/// too early, and one below 0.
fn tables() -> [(&'static str, String); 7] {
    let with = |rows: &str| format!("wavelength_nm,absorption_cm2_per_ug\n{rows}");
    let inclined = "density;inclination_deg\n0,5;0\n2;45\n1;90\n";
    let sensor = "nm,red,far\n600,0,0\n650,1,0\n700,0,0.5\n2600,0,0.1\n";
    let multispectral = "nm,red\n600,0\n650,1\n700,0\n";
    let paper = "wavelength_nm,percent\n380,70\n800,90\n";
    [
        ("angles.csv", inclined.to_owned()),
        ("sensor.csv", sensor.to_owned()),
        ("multispectral.csv", multispectral.to_owned()),
        ("paper.csv", paper.to_owned()),
        ("extra.csv", with("400,0.02\n700,0.01\n2500,0\n")),
        ("extra_short.csv", with("400,0.02\n700,0.01\n")),
        ("extra_below_0.csv", with("400,0.02\n700,-0.01\n2500,0\n")),
    ]
}

/// A folder with the files that the scenes of these tests name. Meshes and pictures are only
/// looked up, so they may be empty.
fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("the system has a place for temporary files");
    let write = |name: &str, text: &str| {
        fs::write(folder.path().join(name), text).expect("the folder was just made");
    };
    fs::create_dir(folder.path().join("maps")).expect("the folder was just made");
    for name in [
        "maps/contents.exr",
        "pot.ply",
        "sky.exr",
        "bark.png",
        "glaze.jpg",
    ] {
        write(name, "");
    }
    write(
        "camera.csv",
        "wavelength_nm,r,g,b\n400,0,0.1,0.8\n410,0,-0.02,0.9\n420,0,0.2,1\n",
    );
    for (name, table) in tables() {
        write(name, &table);
    }
    write(
        "margin.svg",
        "<svg xmlns=\"http://www.w3.org/2000/svg\"><path id=\"blade\" d=\"M50 90C90 80 90 30 50 10C10 30 10 80 50 90Z\"/>\
         <path id=\"bow\" d=\"M50 90L90 90L10 20L70 10Z\"/><path id=\"ring\" d=\"M0 0H9V9ZM1 1H2V2Z\"/>\
         <path id=\"open\" d=\"M50 90C90 80 90 30 50 10C10 30 10 60 20 70\"/></svg>",
    );
    // A tetrahedron, and three faces at one edge.
    let corners = "v 0 0 0\nv 10 0 0\nv 0 10 0\nv 0 0 10\n";
    let body = format!("{corners}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    write("body.obj", &body);
    let branched = format!("{corners}v 5 5 1\nf 1 2 4\nf 4 3 1\nf 1 5 4\n");
    write("branched.obj", &branched);
    // Two tetrahedra that share a point.
    let pinched =
        format!("{body}v -10 0 0\nv 0 -10 0\nv 0 0 -10\nf 1 5 6\nf 1 7 5\nf 5 7 6\nf 6 7 1\n");
    write("pinched.obj", &pinched);
    write("no_faces.obj", corners);
    write(
        "places.csv",
        "x_m, y_m, z_m, rotate_z_deg, scale, shape\n0, 0, 0, 0, 1, floor\n1, 2, 3, 90, 0.5, ball\n",
    );
    write(
        "quoted.csv",
        "\"x_m\",\"y_m\",\"z_m\",\"rotate_z_deg\",\"scale\",\"shape\"\n0,0,0,0,1,\"floor\"\n\"1\",2,3,90,0.5,\"ball\"\n",
    );
    write("no_header.csv", "0, 0, 0\n");
    write("no_rows.csv", "x_m, y_m, z_m\n# to come\n");
    write(
        "columns.csv",
        "x_m; y_mm; scale; scale_x; x_m; colour\n0; 0; 1; 1; 0; red\n",
    );
    write(
        "rows.csv",
        "x_m, y_m, z_m, rotate_x_deg, scale, shape\n0, 0, 0, 0, 1, 0\n0, nan, 0, 0, 1, 1\n0, 0, 0, 0, 1\n\
         0, 2e6, 0, 0, 0, bull\n0, 0, 0, left, 1, 2\n",
    );
    write(
        "turned.csv",
        "x_m y_m z_m quaternion_w quaternion_x quaternion_y quaternion_z\n0 0 0 1 1 0 0\n",
    );
    write("latin.csv", "x_m y_m z_m\n");
    fs::write(
        folder.path().join("latin.csv"),
        b"x_m y_m z_m # bl\xe4tter\n",
    )
    .expect("a file");
    write(
        "flood.csv",
        &("x_m y_m z_m\n".to_owned() + &"nan 0 0\n".repeat(1000)),
    );
    let floats = "('x_m', '<f4'), ('y_m', '<f4'), ('z_m', '<f4')";
    let rows: Vec<u8> = [(0.5_f32, 0_u8), (-0.5, 1)]
        .iter()
        .flat_map(|(x, shape)| {
            [x, &0.0, &1.0]
                .map(|number| number.to_le_bytes())
                .concat()
                .into_iter()
                .chain([*shape])
        })
        .collect();
    let array = |name: &str, descr: &str, shape: &str, rows: &[u8]| {
        let path = folder.path().join(name);
        fs::write(path, npy(descr, shape, rows)).expect("the folder was just made");
    };
    array(
        "places.npy",
        &format!("[{floats}, ('shape', '|u1')]"),
        "(2,)",
        &rows,
    );
    array("plain.npy", "'<f4'", "(0, 3)", &[]);
    array("cut.npy", &format!("[{floats}]"), "(9,)", &[]);
    for (name, text) in models() {
        write(name, &text);
    }
    for (name, text) in measured() {
        write(name, &text);
    }
    write("comma.csv", "# commas\nnm;R;T\n400;0,5;0,1\n800;0,6;0,1\n");
    folder
}

/// Spectra of leaves: as spectrometers write them, and some that are refused.
fn measured() -> [(&'static str, String); 9] {
    let every = |skipped: std::ops::Range<u32>, row: &dyn Fn(u32) -> String| {
        let nm = (380..=800).step_by(10).filter(|nm| !skipped.contains(nm));
        nm.map(row).collect::<String>()
    };
    let all = 0..0;
    let leaves = every(all.clone(), &|nm| {
        format!("{},5,9,1,30\n", f64::from(nm) / 1000.0)
    });
    let asd = every(all.clone(), &|nm| format!("{nm}\t0.4\r\n"));
    let svc = every(all, &|nm| format!("{nm}.0 100.00 30.00 30.00\r\n"));
    let holes = every(500..600, &|nm| format!("{nm},0.1,0.1\n"));
    let head = "wavelength_nm,R,T\n";
    [
        (
            "leaves.csv",
            format!("wavelength,oak_R,oak_R_abaxial,oak_T,elm_R\n{leaves}"),
        ),
        ("oak.txt", format!("Wavelength\toak.asd\r\n{asd}")),
        (
            "oak.sig",
            format!("/*** Spectra Vista SIG Data ***/\r\nname= oak.sig\r\ndata= \r\n{svc}"),
        ),
        ("holes.csv", format!("{head}{holes}")),
        (
            "bright.csv",
            format!("{head}380,0.5,0.4\n500,0.7,0.4\n800,0.5,0.4\n"),
        ),
        (
            "dark.csv",
            format!("{head}380,0.5,0.4\n500,-0.1,0.4\n800,0.5,0.4\n"),
        ),
        (
            "falls.csv",
            format!("{head}380,0.5,0.4\n370,0.5,0.4\n800,0.5,0.4\n"),
        ),
        ("short.csv", format!("{head}380,0.5,0.4\n600,0.5,0.4\n")),
        (
            "words.csv",
            format!("{head}380,0.5,0.4\n500,x,0.4\n800,0.5,0.4\n"),
        ),
    ]
}

/// Files of glTF: one triangle, the same with files beside it, and some that are refused.
fn models() -> [(&'static str, String); 5] {
    let buffer = "\"byteLength\":36,\"uri\":\"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"";
    let model = |buffer: &str, other: &str| {
        format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"nodes\":[{{\"mesh\":0}}],\"meshes\":[{{\"primitives\":\
             [{{\"attributes\":{{\"POSITION\":0}}}}]}}],\"accessors\":[{{\"bufferView\":0,\"componentType\":5126,\
             \"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}}],\"bufferViews\":[{{\"buffer\":0,\
             \"byteLength\":36}}],\"buffers\":[{{{buffer}}}]{other}}}"
        )
    };
    let of = |uri: &str| model(&format!("\"byteLength\":36,\"uri\":\"{uri}\""), "");
    let draco = ",\"extensionsRequired\":[\"KHR_draco_mesh_compression\"]";
    [
        ("model.gltf", model(buffer, "")),
        ("apart.gltf", of("maps/apart.bin")),
        ("outside.gltf", of("../secret.bin")),
        ("draco.gltf", model(buffer, draco)),
        ("damaged.gltf", "{\"asset\":\n{\"version\":2}".to_owned()),
    ]
}

/// A file as `np.save` writes it.
fn npy(descr: &str, shape: &str, rows: &[u8]) -> Vec<u8> {
    let literal = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}\n");
    let length = (literal.len() as u16).to_le_bytes();
    let header = [b"\x93NUMPY\x01\x00", length.as_slice(), literal.as_bytes()];
    [header.concat().as_slice(), rows].concat()
}

fn parse_text(text: &str, name: &str, overrides: &[&str]) -> Result<Loaded, DocumentErrors> {
    let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
    parse(text, name, folder().path(), &overrides)
}

fn accept(text: &str, name: &str, overrides: &[&str]) -> Loaded {
    parse_text(text, name, overrides).unwrap_or_else(|errors| panic!("{errors}"))
}

fn refuse(text: &str, name: &str, overrides: &[&str]) -> DocumentErrors {
    match parse_text(text, name, overrides) {
        Ok(_) => panic!("{name} was accepted"),
        Err(errors) => errors,
    }
}

fn codes(errors: &DocumentErrors) -> Vec<&'static str> {
    let errors = errors.errors().iter();
    errors.map(|located| located.error.code()).collect()
}
