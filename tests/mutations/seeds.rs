//! Valid files to begin with, and the folder where scenes find what they name.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use renderer::checkpoint::{self, Heading};
use renderer::integrator::caption::Caption;
use renderer::integrator::render::{Halt, Job, begin, render_until};
use support::picture::world_of;
use tempfile::TempDir;

use super::trial::files_of;

pub(super) fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("mutations/corpus")
}

/// The files of a format.
pub(super) fn seeds(name: &str) -> Vec<Vec<u8>> {
    let read = |file| fs::read(file).expect("a committed file");
    files_of(&corpus(), name).into_iter().map(read).collect()
}

/// A folder with every file that the scenes, leaves and sweeps of the corpus name.
pub(super) fn folder() -> TempDir {
    let folder = tempfile::tempdir().expect("a place for temporary files");
    fs::create_dir(folder.path().join("maps")).expect("the folder was just made");
    let format = Path::new(env!("CARGO_MANIFEST_DIR")).join("format");
    let corpus = corpus();
    let files = [
        ("scene.toml", format.join("minimal.toml")),
        ("pot.ply", corpus.join("ply/ascii.ply")),
        ("body.obj", corpus.join("obj/closed.obj")),
        ("sky.exr", corpus.join("exr/plain_half.exr")),
        ("maps/contents.exr", corpus.join("exr/plain_float.exr")),
        ("bark.png", corpus.join("png/rgb.png")),
        ("model.gltf", corpus.join("gltf/square.gltf")),
        ("margin.svg", corpus.join("svg/plain.svg")),
        ("paper.csv", corpus.join("spectrum/commas.csv")),
        ("places.csv", corpus.join("placements/plain.csv")),
        ("places.npy", corpus.join("arrays/fields.npy")),
    ];
    for (name, file) in files {
        fs::copy(file, folder.path().join(name)).expect("a committed file");
    }
    // One that covers all wavelengths of the scenes.
    let paper = "wavelength_nm,percent\n380,70\n800,90\n";
    fs::write(folder.path().join("paper.csv"), paper).expect("the folder was just made");
    let extra = "wavelength_nm,absorption_cm2_per_ug\n400,0.02\n700,0.01\n2500,0\n";
    fs::write(folder.path().join("extra.csv"), extra).expect("the folder was just made");
    folder
}

/// The scene with every key of the format.
pub(super) fn whole_scene() -> Vec<u8> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("format/whole.toml");
    fs::read(file).expect("a committed file")
}

/// Checkpoints of a small render: of all samples, and of one that aims at a noise.
///
/// They are made here: a committed one would be another version's after each change of the format.
pub(super) fn checkpoints() -> Vec<Vec<u8>> {
    let scene =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("format/minimal.toml"));
    let (description, world) = world_of(&scene.expect("a committed file"));
    let folder = tempfile::tempdir().expect("a place for temporary files");
    let of = |aim: Option<f64>| {
        let job = Job {
            width: 40,
            height: 70,
            spp: 2,
            seed: 3,
        };
        let heading = Heading {
            program: checkpoint::PROGRAM.to_owned(),
            scene: 7,
            job,
            whole: None,
            aim,
            caption: Caption::of(&description, &world.view, &world.light_colours),
        };
        let go_on = AtomicBool::new(false);
        let begun = if aim.is_some() {
            begin(&world, &job, aim, &go_on).expect("it fits")
        } else {
            let halt = Halt::default();
            let rendered = render_until(&world, &job, &halt, &go_on, &|_| ());
            rendered.expect("it fits").into_begun()
        };
        let file = folder.path().join("kept");
        checkpoint::write(&file, &heading, &begun).expect("the folder was just made");
        fs::read(file).expect("it was just written")
    };
    vec![of(None), of(Some(0.1))]
}

/// Puts the checksums of a checkpoint's sections right, as far as its lengths are.
pub(super) fn mend_checkpoint(bytes: &mut [u8]) {
    const MAGIC: usize = 16;
    let mut at = MAGIC;
    // Length, checksum, bytes.
    while let Some(length) = bytes.get(at..).and_then(|rest| rest.first_chunk()) {
        let end = usize::try_from(u64::from_le_bytes(*length));
        let end = end.ok().and_then(|length| length.checked_add(at + 12));
        let Some(section) = end.and_then(|end| bytes.get(at + 12..end)) else {
            return;
        };
        let (length, sum) = (section.len(), crc32fast::hash(section).to_le_bytes());
        bytes[at + 8..at + 12].copy_from_slice(&sum);
        at += 12 + length;
    }
}

/// Puts the checksums of a PNG's chunks right, as far as their lengths are.
pub(super) fn mend_png(bytes: &mut [u8]) {
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 4) {
        let length = u32::from_be_bytes([head[0], head[1], head[2], head[3]]) as usize;
        let end = at + 8 + length;
        if end + 4 > bytes.len() {
            return;
        }
        let sum = crc32fast::hash(&bytes[at + 4..end]).to_be_bytes();
        bytes[end..end + 4].copy_from_slice(&sum);
        at = end + 4;
    }
}
