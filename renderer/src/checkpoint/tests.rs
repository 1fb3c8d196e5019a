use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};

use super::*;
use crate::integrator::caption::Caption;
use crate::integrator::noise::NoiseWatch;
use crate::integrator::render::{Contact, Ended, Job, begin, go_on};
use crate::scene::load::parse;
use crate::scene::world::World;
use crate::spectrum::recorded::FilmKind;

const SCENE: &str = "
    format = 1
    [film.rgb]
    size = [43, 21]
    spp = 8
    sensitivities = \"sony-a7r-iii\"
    [picture]
    white_light = \"sun\"
    [camera.perspective]
    position_m = [0, -3, 1]
    look_at_m = [0, 0, 0]
    vertical_fov_deg = 30
    [meshes.ball.sphere]
    radius_m = 0.5
    [materials.white.diffuse]
    reflectance = 0.7
    [objects.ball]
    mesh = \"ball\"
    material = \"white\"
    [lights.sky.constant]
    radiance_w_m2_sr_nm = 1
    [lights.sun.distant]
    irradiance_w_m2_nm = 1
    elevation_deg = 40
    azimuth_deg = 100
";

/// The scene, and a render of it that ends at sample `spp`.
struct Stage {
    world: World,
    heading: Heading,
}

impl Stage {
    fn new(spp: u32, aim: Option<f64>) -> Self {
        let loaded = parse(SCENE, "stage.toml", Path::new("."), &[]).expect("the scene is right");
        let scene = loaded.description;
        let world = World::build(&scene).expect("it can be built");
        let job = Job {
            width: 43,
            height: 21,
            spp,
            seed: 3,
        };
        let heading = Heading {
            program: PROGRAM.to_owned(),
            scene: 7,
            job,
            whole: None,
            aim,
            caption: Caption::of(&scene, &world.view, &world.light_colours),
        };
        Self { world, heading }
    }

    fn begin(&self) -> Begun {
        let go = AtomicBool::new(false);
        begin(&self.world, &self.heading.job, self.heading.aim, &go).expect("a small film")
    }

    /// Goes on until `blocks` blocks are done; the state is kept in a file after each `every`.
    fn go_on(&self, begun: Begun, blocks: u32, every: u32, file: &Path) -> (Begun, Ended) {
        let (stop, done, kept) = (AtomicBool::new(false), AtomicU32::new(0), AtomicU32::new(0));
        let contact = Contact {
            stop: &stop,
            progress: &|_| {
                if done.fetch_add(1, Ordering::Relaxed) + 1 >= blocks {
                    stop.store(true, Ordering::Relaxed);
                }
            },
            is_due: &|| done.load(Ordering::Relaxed) >= kept.load(Ordering::Relaxed) + every,
            keep: &|begun| {
                write(file, &self.heading, begun).expect("the folder can be written");
                kept.store(done.load(Ordering::Relaxed), Ordering::Relaxed);
            },
        };
        go_on(&self.world, &self.heading.job, begun, None, &contact)
    }

    fn whole(&self) -> Begun {
        let (begun, ended) = self.go_on(self.begin(), u32::MAX, u32::MAX, Path::new("never"));
        assert!(matches!(ended, Ended::Samples | Ended::Noise));
        begun
    }

    /// The samples of a range as a part.
    fn part(&self, folder: &Path, first: u32, end: u32) -> PathBuf {
        let mut heading = self.heading.clone();
        heading.job.spp = end;
        let stage = Self {
            world: World::build(&parsed()).expect("it can be built"),
            heading,
        };
        let begun = stage.begin().from_sample(first);
        let (begun, _) = stage.go_on(begun, u32::MAX, u32::MAX, Path::new("never"));
        let path = folder.join(format!("{first}-{end}.part"));
        write(&path, &stage.heading, &begun).expect("the folder can be written");
        path
    }
}

fn parsed() -> crate::scene::description::Description {
    let loaded = parse(SCENE, "stage.toml", Path::new("."), &[]);
    loaded.expect("the scene is right").description
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a place for temporary files")
}

#[test]
fn a_render_that_is_interrupted_again_and_again_ends_with_the_same_sums() {
    let folder = folder();
    let file = folder.path().join("x.checkpoint");
    for aim in [None, Some(0.005)] {
        let stage = Stage::new(150, aim);
        let whole = stage.whole();
        let [fewest, most] = whole.film.drawn_range();
        assert_eq!(aim.is_some(), fewest < most, "{fewest} to {most}");
        let mut begun = stage.begin();
        let mut runs = 0;
        // Numbers of blocks without a pattern.
        for blocks in (1_u32..).map(|run| 1 + run * run * 37 % 11) {
            let (next, ended) = stage.go_on(begun, blocks, 5, &file);
            runs += 1;
            write(&file, &stage.heading, &next).expect("the folder can be written");
            begun = read(&file).expect("it was just written").1;
            assert_eq!(begun.film, next.film);
            assert_eq!((begun.rays, begun.elapsed), (next.rays, next.elapsed));
            if ended != Ended::Interrupted {
                break;
            }
        }
        assert!(runs > 5, "{runs} runs");
        assert_eq!(begun.film, whole.film);
        assert_eq!(begun.rays, whole.rays);
        let words = |begun: &Begun| begun.watch.as_ref().map(NoiseWatch::words);
        assert_eq!(words(&begun), words(&whole));
    }
}

#[test]
fn the_film_and_the_lights_are_reported_as_they_were() {
    let folder = folder();
    let stage = Stage::new(8, None);
    let file = folder.path().join("a.checkpoint");
    write(&file, &stage.heading, &stage.begin()).expect("the folder can be written");
    let (heading, _) = read(&file).expect("it was just written");
    let (kept, own) = (&heading.caption, &stage.heading.caption);
    assert_eq!(kept.lights, own.lights);
    assert_eq!(kept.lights.len(), 2);
    assert_eq!(kept.picture, own.picture);
    let observer = |kind: &FilmKind| match kind {
        FilmKind::Rgb { observer, .. } => observer.clone(),
        FilmKind::Spectral { .. } | FilmKind::Sensor(_) => panic!("a film of colour"),
    };
    assert_eq!(observer(&kept.kind), observer(&own.kind));
    assert_eq!(observer(&kept.kind).name(), "sony-a7r-iii");
}

#[test]
fn a_render_that_goes_on_to_more_samples_has_the_sums_of_one_that_wanted_them_at_once() {
    for aim in [None, Some(0.005)] {
        let (few, many) = (Stage::new(40, aim), Stage::new(150, aim));
        let begun = few.whole().up_to(&many.heading.job);
        let (begun, _) = many.go_on(begun, u32::MAX, u32::MAX, Path::new("never"));
        assert_eq!(begun.film, many.whole().film, "aim {aim:?}");
    }
}

#[test]
fn parts_add_up_to_the_whole_in_any_order() {
    let folder = folder();
    let stage = Stage::new(30, None);
    let whole = stage.whole();
    for cuts in [&[0, 30][..], &[0, 1, 30], &[0, 7, 8, 23, 30]] {
        let ranges = cuts.windows(2);
        let mut parts: Vec<_> = ranges
            .map(|ends| stage.part(folder.path(), ends[0], ends[1]))
            .collect();
        parts.rotate_left(1);
        let (heading, merged) = merge(&parts).expect("they are parts of one picture");
        assert_eq!(merged.film, whole.film, "{cuts:?}");
        assert_eq!((merged.rays, heading.job.spp), (whole.rays, 30));
    }
}

#[test]
fn parts_that_are_not_the_whole_are_refused_with_the_reason() {
    let folder = folder();
    let at = folder.path();
    let stage = Stage::new(8, None);
    let parts = [(0, 3), (2, 5), (3, 8), (5, 8)].map(|(first, end)| stage.part(at, first, end));
    let [start, middle, rest, end] = &parts;
    let other = |name: &str, change: &dyn Fn(&mut Heading)| {
        let (mut heading, begun) = read(rest).expect("it was just written");
        change(&mut heading);
        let path = at.join(name);
        write(&path, &heading, &begun).expect("the folder can be written");
        path
    };
    let seed = other("seed", &|heading| heading.job.seed = 4);
    let scene = other("scene", &|heading| heading.scene = 8);
    let version = other("version", &|heading| heading.program = "0.0.9".to_owned());
    let unfinished = other("unfinished", &|heading| heading.job.spp = 9);
    let more = other("more", &|heading| heading.whole = Some(16));
    for (parts, reason) in [
        (vec![start, end], "samples 3..5 are missing"),
        (vec![rest], "samples 0..3 are missing"),
        (vec![middle, start, end], "both hold the samples 2..3"),
        (vec![start, rest, start], "both hold the samples 0..3"),
        (vec![start, &seed], "of the seed 4, not 3"),
        (vec![start, &scene], "another state of the scene"),
        (vec![start, &version], "version 0.0.9"),
        (vec![start, &unfinished], "interrupted at 5"),
        (vec![start, &more], "samples 8..16 are missing"),
    ] {
        let parts: Vec<PathBuf> = parts.into_iter().cloned().collect();
        let message = merge(&parts).expect_err(reason).to_string();
        assert!(message.contains(reason), "{message}: {reason}");
    }
}

#[test]
fn damaged_files_are_errors_wherever_the_damage_is() {
    let folder = folder();
    let path = folder.path().join("x.checkpoint");
    let stage = Stage::new(40, Some(0.03));
    write(&path, &stage.heading, &stage.whole()).expect("the folder can be written");
    let bytes = std::fs::read(&path).expect("it was just written");
    let damaged = |bytes: &[u8]| {
        std::fs::write(&path, bytes).expect("the folder can be written");
        read(&path).map(|_| ()).expect_err("it is damaged")
    };
    let step = bytes.len() / 300;
    for place in (0..bytes.len()).step_by(step).chain(0..200) {
        let mut flipped = bytes.clone();
        flipped[place] ^= 1 << (place % 8);
        damaged(&flipped);
        damaged(&bytes[..place]);
    }
    assert!(matches!(damaged(b"toml"), CheckpointError::Foreign { .. }));
    assert!(matches!(
        damaged(&[&bytes[..], b"\0"].concat()),
        CheckpointError::Damaged { .. }
    ));
    let missing = read(&folder.path().join("none")).map(|_| ());
    assert!(matches!(missing, Err(CheckpointError::File { .. })));
}

#[test]
fn a_part_of_an_older_program_is_refused_with_the_version_to_use() {
    let path = folder();
    let path = path.path().join("old.part");
    std::fs::write(&path, include_bytes!("kept/0.1.0.part")).expect("the folder can be written");
    let wanted = format!(
        "{} was written by Lamina 0.1.0: continue it, or merge it, with that version",
        path.display()
    );
    let refused = read(&path).map(|_| ()).expect_err("it is older");
    assert_eq!(refused.to_string(), wanted);
    let refused = merge(&[path]).map(|_| ()).expect_err("it is older");
    assert_eq!(refused.to_string(), wanted);
}

#[test]
fn a_view_and_bands_come_back_as_they_were() {
    let stage = Stage::new(8, Some(0.5));
    let mut heading = stage.heading.clone();
    heading.caption.kind = FilmKind::Spectral {
        bands: vec![crate::spectrum::recorded::Band {
            center_nm: 550.0,
            width_nm: 10.0,
        }],
    };
    let bytes = heading.to_bytes(&Progress::of(&stage.begin()));
    let (read, _) = Heading::from_bytes(&bytes).expect("they were just written");
    assert_eq!(read.caption.camera, heading.caption.camera);
    assert_eq!(
        format!("{:?}", read.caption.kind),
        format!("{:?}", heading.caption.kind)
    );
    assert_eq!((read.aim, read.whole), (heading.aim, heading.whole));
}

#[test]
fn a_file_is_at_most_twice_the_memory_of_its_picture() {
    let folder = folder();
    let path = folder.path().join("x.checkpoint");
    let stage = Stage::new(64, None);
    let begun = stage.whole();
    write(&path, &stage.heading, &begun).expect("the folder can be written");
    let size = std::fs::metadata(&path).expect("it was just written").len();
    // Nineteen channels of 32-bit floats.
    let picture = 43 * 21 * 19 * 4;
    assert!(size <= 2 * picture, "{size} bytes beside {picture}");
}
