//! A number that tells scenes apart whose samples must not be mixed.

use std::path::Path;

use super::assets::{self, AssetError};
use super::description::{Film, Mesh, Picture};
use super::load::Loaded;

/// The 64-bit FNV-1a hash of everything that samples depend on: the scene with all defaults and
/// presets, and the bytes of the files that it names. It distinguishes scenes; it is not a
/// cryptographic hash.
///
/// Left out are comments and the order of keys in the file, the number of samples, seed and target
/// noise, which are compared by themselves, and the development of the picture. The folder of the
/// scene at `path` may move.
///
/// # Errors
///
/// [`AssetError`] if a file of the scene cannot be read.
pub fn fingerprint(loaded: &Loaded, path: &Path) -> Result<u64, AssetError> {
    let mut scene = loaded.description.clone();
    scene.source.clear();
    scene.film = Film {
        spp: 1,
        noise: None,
        seed: 0,
        ..scene.film
    };
    scene.picture = Picture::default();
    // What follows from a plant's numbers would be most of the text.
    scene
        .meshes
        .retain(|mesh| !matches!(mesh.value, Mesh::Axes(_)));
    for object in &mut scene.objects {
        if object.value.plant.is_some() {
            object.value.instances = None;
        }
    }
    // Numbers in it have all their digits.
    let mut text = format!("{scene:?}");
    let folder = path.canonicalize().ok();
    if let Some(folder) = folder.as_deref().and_then(Path::parent) {
        // As it is printed within the scene.
        let folder = format!("{:?}", folder.display().to_string());
        let folder = folder.trim_matches('"');
        if folder.len() > 1 {
            text = text.replace(folder, "");
        }
    }
    let mut hash = fnv1a(text.as_bytes());
    for file in &loaded.inputs {
        let bytes = assets::read(file)?;
        hash = go_on(hash, &(bytes.len() as u64).to_le_bytes());
        hash = go_on(hash, &bytes);
    }
    Ok(hash)
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
    use super::*;
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
        let mut loaded = load(&path, &overrides).expect("the scene is right");
        // The default name is the folder's.
        loaded.description.name.clear();
        fingerprint(&loaded, &path).expect("its files are there")
    }

    #[test]
    fn it_tells_what_changes_samples_and_nothing_else() {
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
        ];
        assert_eq!(moved, [usual; 2]);
        let others = [
            of(SCENE, &PLATE.replace("0 0 1", "0 0 2"), &[]),
            of(SCENE, PLATE, &["materials.white.diffuse.reflectance=0.51"]),
            of(SCENE, PLATE, &["film.rgb.filter_radius_px=1"]),
            of(SCENE, PLATE, &["camera.perspective.vertical_fov_deg=31"]),
        ];
        for other in others {
            assert_ne!(other, usual);
        }
    }
}
