//! Small pictures that are kept, and whether a new one shows the same light.
//!
//! A golden holds, for each pixel and channel, the mean over pictures of different seeds and the
//! deviation of one picture from it. A new picture is one more draw: pixels, regions and the whole
//! are compared in units of that deviation. Any change of random numbers passes, any change of
//! light fails that is greater than the noise of a region.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use renderer::image::{Attribute, Layer, Picture, openexr};
use renderer::integrator::render::{Job, render};
use renderer::scene::load::load;
use renderer::scene::world::World;

use crate::chi_square::sidak;

/// Pictures that a golden is made of.
const PICTURES: u64 = 32;
/// Seed of the picture that is compared; those of the golden are 0 to 31.
const SEED: u64 = 1000;
/// Regions across and down.
const REGIONS: [usize; 2] = [4, 3];
/// Deviations from which a pixel counts as far off.
const FAR: f64 = 3.0;
/// Share of pixels that may be far off, over the largest share among the pictures that a golden is
/// made of, each against the others. What is normal depends on the scene: light that few paths find
/// has long tails.
const FAR_MARGIN: f64 = 1.5;
/// Attribute with that largest share.
const FAR_ATTRIBUTE: &str = "farShare";
/// Probability that a right picture fails by its regions.
const LEVEL: f64 = 0.01;
/// Largest change of a region that may go unseen, over its mean: a golden with more noise says too
/// little.
const UNSEEN: f64 = 0.01;
/// Rounding of single precision, as a share of the value.
const ROUNDING: f64 = 1e-5;

/// A scene whose light is kept.
#[derive(Clone, Copy, Debug)]
pub struct Golden<'a> {
    /// Name of the file in `tests/goldens`.
    pub name: &'a str,
    /// The scene's file.
    pub scene: &'a Path,
    /// What is set otherwise, as on the command line.
    pub overrides: &'a [&'a str],
}

/// What a comparison found.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Share of pixels that are far off, the worst channel, and the most that is allowed.
    pub far: [f64; 2],
    /// Deviations of the region that is furthest off, and the most that is allowed.
    pub region: [f64; 2],
    /// Largest change of a region that could go unseen, over its mean: the median over regions and
    /// channels.
    pub unseen: f64,
}

impl Verdict {
    /// Whether the light is the same, as far as a golden that is good enough to tell can say.
    pub fn passes(&self) -> bool {
        self.far[0] <= self.far[1] && self.region[0] <= self.region[1] && self.unseen < UNSEEN
    }
}

impl Golden<'_> {
    /// Renders the scene anew and compares; with `UPDATE_GOLDENS=1` renders the golden itself. A
    /// picture that fails is left in `folder`, beside the golden and their difference in
    /// deviations.
    ///
    /// # Panics
    ///
    /// If the scene does not load, the golden is missing or cannot be read, or the light differs.
    pub fn check(&self, folder: &Path) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("goldens")
            .join(format!("{}.exr", self.name));
        if std::env::var_os("UPDATE_GOLDENS").is_some() {
            openexr::write(&self.made(), &path).expect("the golden can be written");
            return;
        }
        let golden = openexr::read(&path).unwrap_or_else(|error| {
            panic!("{error}; UPDATE_GOLDENS=1 cargo test makes what is missing")
        });
        let picture = self.load().render(SEED);
        let verdict = compare(&golden, &picture);
        eprintln!("{}: {verdict:?}", self.name);
        if !verdict.passes() {
            let kept = keep(&golden, &picture, self.name, folder);
            panic!(
                "{}: the light is not that of the golden: {verdict:?}; see {}",
                self.name,
                kept.display()
            );
        }
    }

    fn load(&self) -> Loaded {
        let overrides: Vec<String> = self.overrides.iter().map(ToString::to_string).collect();
        let loaded = load(self.scene, &overrides).unwrap_or_else(|errors| panic!("{errors}"));
        let film = &loaded.description.film;
        Loaded {
            world: World::build(&loaded.description).expect("the scene can be built"),
            job: Job {
                width: film.width,
                height: film.height,
                spp: film.spp,
                seed: SEED,
            },
        }
    }

    /// Mean and deviation over [`PICTURES`].
    fn made(&self) -> Picture {
        let loaded = self.load();
        let pictures: Vec<Picture> = (0..PICTURES).map(|seed| loaded.render(seed)).collect();
        let mut golden = pictures[0].clone();
        let mut far = 0.0;
        for channel in 0..pictures[0].layers.len() {
            let values = |pixel: usize| -> Vec<f64> {
                let pictures = pictures.iter();
                let value = |picture: &Picture| f64::from(picture.layers[channel].data[pixel]);
                pictures.map(value).collect()
            };
            let mut far_off = vec![0_u32; pictures.len()];
            let pixels = pictures[0].layers[channel].data.len();
            let mut deviations = Vec::with_capacity(pixels);
            for pixel in 0..pixels {
                let values = values(pixel);
                let (mean, deviation) = mean_and_deviation(values.iter());
                for (skip, &value) in values.iter().enumerate() {
                    let others = values[..skip].iter().chain(&values[skip + 1..]);
                    let (mean, deviation) = mean_and_deviation(others);
                    let allowed = FAR * expected(mean, deviation, values.len() - 1);
                    far_off[skip] += u32::from((value - mean).abs() > allowed);
                }
                golden.layers[channel].data[pixel] = mean as f32;
                deviations.push(deviation as f32);
            }
            let most = far_off.into_iter().max().unwrap_or(0);
            far = f64::max(far, f64::from(most) / pixels as f64);
            golden.layers.push(Layer {
                name: format!("deviation.{channel}"),
                data: deviations,
            });
        }
        let command = format!("{} {}", self.scene_name(), self.overrides.join(" "));
        golden.attributes.extend([
            ("scene".to_owned(), Attribute::Text(command)),
            ("pictures".to_owned(), Attribute::Int(PICTURES as i32)),
            (FAR_ATTRIBUTE.to_owned(), Attribute::Double(far)),
        ]);
        golden
    }

    fn scene_name(&self) -> String {
        let folder = self.scene.parent().and_then(Path::file_name);
        folder.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    }
}

/// A scene that is ready to be rendered.
struct Loaded {
    world: World,
    job: Job,
}

impl Loaded {
    fn render(&self, seed: u64) -> Picture {
        let job = Job { seed, ..self.job };
        let rendered =
            render(&self.world, &job, &AtomicBool::new(false), &|_| ()).expect("a small film fits");
        let layers = (0..rendered.layout.beauty).map(|channel| Layer {
            name: format!("mean.{channel}"),
            data: rendered.film.mean(channel),
        });
        Picture {
            width: job.width,
            height: job.height,
            layers: layers.collect(),
            attributes: vec![("spp".to_owned(), Attribute::Int(job.spp as i32))],
        }
    }
}

/// How a picture's channels `mean.0` … lie to a golden's mean and deviation.
///
/// # Panics
///
/// If the two are of different sizes or channels, or the golden is none.
pub fn compare(golden: &Picture, picture: &Picture) -> Verdict {
    assert_eq!(
        [golden.width, golden.height],
        [picture.width, picture.height],
        "the golden has another size"
    );
    let (width, height) = (picture.width as usize, picture.height as usize);
    let regions = REGIONS[0] * REGIONS[1];
    let tests = regions * picture.layers.len();
    let allowed = two_sided(sidak(LEVEL, tests));
    let Some(Attribute::Double(far)) = golden.attribute(FAR_ATTRIBUTE) else {
        panic!("{FAR_ATTRIBUTE} is missing");
    };
    let mut verdict = Verdict {
        far: [0.0, FAR_MARGIN * far],
        region: [0.0, allowed],
        unseen: 0.0,
    };
    let mut unseen = Vec::new();
    for channel in 0..picture.layers.len() {
        let differences = differences(golden, picture, channel);
        let far = differences.iter().filter(|d| d.0.abs() > FAR * d.1).count();
        verdict.far[0] = verdict.far[0].max(far as f64 / differences.len() as f64);
        let mut sums = vec![[0.0; 3]; regions];
        for (pixel, &(difference, deviation, mean)) in differences.iter().enumerate() {
            let column = pixel % width * REGIONS[0] / width;
            let row = pixel / width * REGIONS[1] / height;
            let sum = &mut sums[row * REGIONS[0] + column];
            sum[0] += difference;
            sum[1] += deviation * deviation;
            sum[2] += mean;
        }
        for [difference, variance, mean] in sums {
            let off = difference.abs() / variance.sqrt();
            verdict.region[0] = verdict.region[0].max(off);
            unseen.push(allowed * variance.sqrt() / mean.abs());
        }
    }
    unseen.sort_by(f64::total_cmp);
    verdict.unseen = unseen[unseen.len() / 2];
    verdict
}

/// Difference, its deviation and the golden's mean for each pixel; what is not finite is infinitely
/// far off.
fn differences(golden: &Picture, picture: &Picture, channel: usize) -> Vec<(f64, f64, f64)> {
    let layer = |picture: &Picture, name: &str| {
        let name = format!("{name}.{channel}");
        let layer = picture.layer(&name);
        layer.unwrap_or_else(|| panic!("{name} is missing")).clone()
    };
    let (mean, deviation) = (layer(golden, "mean"), layer(golden, "deviation"));
    let new = layer(picture, "mean");
    let pixels = new.data.iter().zip(&mean.data).zip(&deviation.data);
    pixels
        .map(|((&new, &mean), &deviation)| {
            let [new, mean, deviation] = [new, mean, deviation].map(f64::from);
            let scatter = expected(mean, deviation, PICTURES as usize);
            let difference = new - mean;
            if difference.is_finite() && scatter.is_finite() {
                (difference, scatter, mean)
            } else {
                (f64::INFINITY, f64::from(f32::MIN_POSITIVE), 0.0)
            }
        })
        .collect()
}

/// Deviation of one more picture from the mean of `count`, which has an error too, and rounding.
fn expected(mean: f64, deviation: f64, count: usize) -> f64 {
    deviation * (1.0 + 1.0 / count as f64).sqrt()
        + ROUNDING * mean.abs()
        + f64::from(f32::MIN_POSITIVE)
}

fn mean_and_deviation<'a>(values: impl Iterator<Item = &'a f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let squares: f64 = values.map(|value| (value - mean) * (value - mean)).sum();
    (mean, (squares / (count - 1.0)).sqrt())
}

/// Deviations beyond which a normal variate lies with probability `level`, on both sides together.
fn two_sided(level: f64) -> f64 {
    let (mut low, mut high) = (0.0, 40.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if libm::erfc(middle / std::f64::consts::SQRT_2) > level {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Writes picture, golden and difference into a folder, and gives its name.
fn keep(golden: &Picture, picture: &Picture, name: &str, folder: &Path) -> PathBuf {
    let folder = folder.join(name);
    std::fs::create_dir_all(&folder).expect("a folder for what failed");
    let mut difference = picture.clone();
    for (channel, layer) in difference.layers.iter_mut().enumerate() {
        let differences = differences(golden, picture, channel);
        layer.data = differences.iter().map(|d| (d.0 / d.1) as f32).collect();
    }
    for (file, picture) in [
        ("picture.exr", picture),
        ("golden.exr", golden),
        ("deviations.exr", &difference),
    ] {
        openexr::write(picture, &folder.join(file)).expect("what failed can be written");
    }
    folder
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_normal_variate_lies_beyond_1_96_deviations_in_one_case_of_twenty() {
        assert!((two_sided(0.05) - 1.959_964).abs() < 1e-5);
    }

    const PIXELS: usize = 8 * 6;

    fn picture(layers: &[(&str, f32)]) -> Picture {
        let layers = layers.iter().map(|&(name, value)| Layer {
            name: name.to_owned(),
            data: vec![value; PIXELS],
        });
        Picture {
            width: 8,
            height: 6,
            layers: layers.collect(),
            attributes: vec![(FAR_ATTRIBUTE.to_owned(), Attribute::Double(0.1))],
        }
    }

    #[test]
    fn the_same_light_passes_whatever_its_sign() {
        for mean in [0.5, -0.5] {
            let golden = picture(&[("mean.0", mean), ("deviation.0", 0.0)]);
            // Off by half of what rounding may do.
            let off = picture(&[("mean.0", mean * (1.0 + 0.5e-5))]);
            let verdict = compare(&golden, &off);
            assert!(verdict.passes(), "{verdict:?}");
            assert!(verdict.unseen > 0.0, "{verdict:?}");
        }
    }

    #[test]
    fn one_pixel_that_is_not_finite_does_not_pass() {
        let golden = picture(&[("mean.0", 0.5), ("deviation.0", 0.001)]);
        let same = picture(&[("mean.0", 0.5)]);
        assert!(compare(&golden, &same).passes());
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            let mut spoilt = same.clone();
            spoilt.layers[0].data[20] = bad;
            assert!(!compare(&golden, &spoilt).passes(), "{bad} in the picture");
            for layer in 0..2 {
                let mut spoilt = golden.clone();
                spoilt.layers[layer].data[20] = bad;
                assert!(!compare(&spoilt, &same).passes(), "{bad} in layer {layer}");
            }
        }
    }

    #[test]
    fn a_golden_too_noisy_to_show_one_percent_does_not_pass() {
        let same = picture(&[("mean.0", 0.5)]);
        for (deviation, passes) in [(0.002, true), (0.2, false)] {
            let golden = picture(&[("mean.0", 0.5), ("deviation.0", deviation)]);
            let verdict = compare(&golden, &same);
            assert_eq!(verdict.passes(), passes, "{verdict:?}");
        }
    }
}
