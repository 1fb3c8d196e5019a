//! A number that tells scenes apart whose samples must not be mixed.

use std::path::PathBuf;

use leafmodel::document::tree::{Table, Value};
use leafmodel::document::written::Extent;
use leafmodel::plan_file;

use super::assets::{self, AssetError};
use super::authored::Authored;

/// The 64-bit FNV-1a hash of everything that samples depend on: what the scene's file says, the numbers
/// of presets, both in [`identity`], and the bytes of the files that it names. It distinguishes scenes of one version of the
/// program; it is not a cryptographic hash.
///
/// Left out are comments and the order of keys in the file, the number of samples, seed and target
/// noise, which are compared by themselves, and the development of the picture. The folder of the
/// scene may move.
///
/// # Errors
///
/// [`AssetError`] if a file of the scene cannot be read.
pub(super) fn fingerprint(identity: &str, inputs: &[PathBuf]) -> Result<u64, AssetError> {
    let mut hash = fnv1a(identity.as_bytes());
    for file in inputs {
        let bytes = assets::read(file)?;
        hash = go_on(hash, &(bytes.len() as u64).to_le_bytes());
        hash = go_on(hash, &bytes);
    }
    Ok(hash)
}

/// What a scene's file says, in one form however it is written, and all numbers of its leaves, bodies and
/// plants, which presets may hide.
pub(super) fn identity(tree: &Table, authored: &Authored) -> String {
    let mut text = String::new();
    write_table(&mut text, tree, Nesting::File);
    for leaf in &authored.leaves {
        text += &plan_file::leaf_to_toml(&leaf.name, &leaf.value.plan, Extent::All);
    }
    for solid in &authored.solids {
        text += &solid.value.to_toml(&solid.name);
    }
    for plant in &authored.plants {
        text += &plan_file::plant_to_toml(&plant.name, &plant.value.plan);
    }
    text
}

/// Where a table lies in the file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Nesting {
    File,
    /// A section, the order of whose blocks counts: lights and objects have numbers.
    Section,
    Film,
    Block,
}

/// Keys that samples do not depend on, or that are compared by themselves.
fn is_left_out(depth: Nesting, key: &str) -> bool {
    match depth {
        Nesting::File => key == "picture",
        Nesting::Film => ["spp", "seed", "noise"].contains(&key),
        Nesting::Section | Nesting::Block => false,
    }
}

fn write_table(text: &mut String, table: &Table, depth: Nesting) {
    let mut entries: Vec<_> = table.0.iter().collect();
    if depth != Nesting::Section {
        entries.sort_by_key(|entry| &entry.key);
    }
    entries.retain(|entry| !is_left_out(depth, &entry.key));
    for entry in entries {
        let inner = match depth {
            Nesting::File => Nesting::Section,
            Nesting::Section if ["rgb", "spectral"].contains(&entry.key.as_str()) => Nesting::Film,
            Nesting::Section | Nesting::Film | Nesting::Block => Nesting::Block,
        };
        *text += &format!("{:?}=", entry.key);
        write_value(text, &entry.node.value, inner);
        text.push('\n');
    }
}

/// A value in one form: 1 and 1.0 are the same.
fn write_value(text: &mut String, value: &Value, depth: Nesting) {
    match value {
        Value::Text(own) => *text += &format!("{own:?}"),
        Value::Integer(own) => *text += &own.to_string(),
        Value::Number(own) => *text += &own.to_string(),
        Value::Flag(own) => *text += &own.to_string(),
        Value::Other(_, own) => *text += own,
        Value::List(list) => {
            text.push('[');
            for node in list {
                write_value(text, &node.value, Nesting::Block);
                text.push(',');
            }
            text.push(']');
        }
        Value::Table(table) => {
            text.push('{');
            write_table(text, table, depth);
            text.push('}');
        }
    }
}

/// A hash as files hold it.
pub fn hexadecimal(hash: u64) -> String {
    format!("{hash:016x}")
}

const OFFSET: u64 = 0xcbf2_9ce4_8422_2325;

/// The 64-bit FNV-1a hash of some bytes. It distinguishes them; it is not a cryptographic hash.
pub fn fnv1a(bytes: &[u8]) -> u64 {
    go_on(OFFSET, bytes)
}

fn go_on(start: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(start, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {

    use crate::scene::load::load;

    const SCENE: &str = "
        format = 1
        [film.rgb]
        size = [8, 8]
        spp = 4
        [camera.perspective]
        position_m = [0, -3, 0]
        look_at_m = [0, 0, 0]
        vertical_fov_deg = 30
        [meshes.plate.file]
        path = \"plate.obj\"
        [materials.white.diffuse]
        reflectance = 0.5
        [objects.ball]
        mesh = \"plate\"
        material = \"white\"
        [lights.sky.constant]
        radiance_w_m2_sr_nm = 1
    ";
    const PLATE: &str = "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";

    fn of(text: &str, plate: &str, overrides: &[&str]) -> u64 {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("scene.toml");
        std::fs::write(&path, text).expect("the folder can be written");
        std::fs::write(folder.path().join("plate.obj"), plate).expect("the folder can be written");
        let overrides: Vec<_> = overrides.iter().map(|&text| text.to_owned()).collect();
        let loaded = load(&path, &overrides).expect("the scene is right");
        loaded.fingerprint().expect("its files are there")
    }

    #[test]
    fn it_changes_with_what_changes_samples_and_with_nothing_else() {
        let usual = of(SCENE, PLATE, &[]);
        let moved = [
            of(
                SCENE,
                PLATE,
                &[
                    "film.rgb.spp=64",
                    "film.rgb.seed=3",
                    "picture.exposure_ev=2",
                    "picture.tone=agx",
                ],
            ),
            of(
                &format!("# told\n{SCENE}"),
                PLATE,
                &["materials.white.diffuse.reflectance=0.50"],
            ),
            of(
                &SCENE.replace("vertical_fov_deg = 30", "").replace(
                    "position_m = [0, -3, 0]",
                    "vertical_fov_deg = 30.0\nposition_m = [0.0, -3, 0]",
                ),
                PLATE,
                &[],
            ),
        ];
        assert_eq!(moved, [usual; 3]);
        let others = [
            of(SCENE, &PLATE.replace("0 0 1", "0 0 2"), &[]),
            of(SCENE, PLATE, &["materials.white.diffuse.reflectance=0.51"]),
            of(SCENE, PLATE, &["film.rgb.filter_radius_px=1"]),
            of(
                &SCENE.replace("film.rgb", "film.spectral"),
                PLATE,
                &["film.spectral.bands_nm=[500]"],
            ),
            of(SCENE, PLATE, &["camera.perspective.vertical_fov_deg=31"]),
        ];
        for other in others {
            assert_ne!(other, usual);
        }
    }
}
