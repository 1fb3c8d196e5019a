//! What pictures tell of their own error, against the error over seeds.

use renderer::film::{Film, Pixel, Series};
use renderer::integrator::render::{Halt, Rendered};
use renderer::spectrum::rgb::LUMINANCE;
use support::picture::{mean_and_error_of, mean_of, picture_of, picture_until};

use crate::radiometry::{FACING_THE_ORIGIN, GREY_FLOOR, assert_agrees, glowing_room, scene};

#[test]
fn stopping_at_a_noise_leaves_the_mean_as_it_is_and_reaches_the_noise() {
    let blocks = glowing_room("0.6", 0.4);
    let camera = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 90";
    // Every pixel's radiance is 1, and roulette at every bounce makes paths of very different
    // lengths of it.
    let text = scene(camera, "roulette_below = 1", &blocks).replace("spp = 64", "spp = 4096");
    for aim in [0.1, 0.05, 0.03] {
        let halt = Halt {
            noise: Some(aim),
            time: None,
        };
        let pictures: Vec<_> = (0..16)
            .map(|seed| picture_until(&text, seed, &halt))
            .collect();
        let what = format!("room, noise {aim}");
        let means: Vec<f64> = pictures.iter().map(|picture| mean_of(picture, 0)).collect();
        assert_agrees(&what, mean_and_error_of(&means), 1.0);
        let (mut square, mut estimate, mut spp) = (0.0, 0.0, 0.0);
        for picture in &pictures {
            let squares = picture.film.map(|pixel| (pixel.mean(0) - 1.0).powi(2));
            square += squares.iter().sum::<f64>() / squares.len() as f64;
            let noise = picture.noise.expect("it was watched");
            estimate += noise.reached.expect("there were enough samples").powi(2);
            spp += picture.film.drawn() as f64 / squares.len() as f64;
        }
        let count = pictures.len() as f64;
        // Relative to radiance and a tenth of the picture's mean.
        let error = (square / count).sqrt() / 1.1;
        let estimate = (estimate / count).sqrt();
        eprintln!(
            "{what}: error {error:.4}, estimate {estimate:.4}, {:.0} samples",
            spp / count
        );
        // Here samples are nearly independent, so the estimate has no margin, and blocks that stop
        // at a low one are picked. 4,096 pixels tell errors to 1.1 %: four of that, twice, leave 10
        // %.
        assert!(error <= 1.1 * aim && error <= 1.1 * estimate, "{what}");
        assert!(error >= 0.4 * aim, "{what}: samples are wasted");
    }
}

/// Means over pixels and seeds of the variance that pictures report, of what single samples of the
/// channel would report, or of all channels alike, and of the variance over seeds.
fn variances(pictures: &[Rendered], series: Series) -> [f64; 3] {
    let pixels = |film: &Film| f64::from(film.width() * film.height());
    let mean = |of: &dyn Fn(&Film) -> Vec<f64>| {
        let sums = pictures
            .iter()
            .map(|picture| of(&picture.film).iter().sum::<f64>());
        sums.sum::<f64>() / (pixels(&pictures[0].film) * pictures.len() as f64)
    };
    let reported = mean(&|film| film.variance(series));
    let deviation = |pixel: &Pixel<'_>, channel: usize| {
        let moments = pixel.moments(channel);
        moments.variance_of_mean(pixel.samples()).sqrt()
    };
    let of_samples = mean(&|film| {
        film.map(|pixel| match series {
            Series::Channel(channel) => deviation(pixel, channel).powi(2),
            Series::Luminance => {
                let all = LUMINANCE.iter().zip(0..pixel.channels());
                let all = all.map(|(share, channel)| share * deviation(pixel, channel));
                all.sum::<f64>().powi(2)
            }
        })
    });
    let means: Vec<Vec<f64>> = pictures
        .iter()
        .map(|picture| {
            picture.film.map(|pixel| match series {
                Series::Channel(channel) => pixel.mean(channel),
                Series::Luminance => pixel.luminance(),
            })
        })
        .collect();
    let over_seeds = (0..means[0].len()).map(|pixel| {
        let of_seeds: Vec<f64> = means.iter().map(|means| means[pixel]).collect();
        let (_, error) = mean_and_error_of(&of_seeds);
        error * error * pictures.len() as f64
    });
    let found = over_seeds.sum::<f64>() / means[0].len() as f64;
    [reported, of_samples, found]
}

/// A leaf under an even sky.
const LEAF: &str = "
[meshes.sheet.rectangle]
width_m = 0.2
height_m = 0.2
[materials.leaf.leaf]
adaxial = { eta = 1.45, alpha = 0.3 }
[materials.leaf.leaf.measured]
reflectance = { table = [[550, 0.15], [800, 0.45]] }
transmittance = { table = [[550, 0.1], [800, 0.45]] }
[objects.leaf]
mesh = \"sheet\"
material = \"leaf\"
rotate_deg = [35, 20, 0]
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
";

/// A ball on the ground, under an even sky.
const BALL: &str = "
[materials.skin.plastic]
reflectance = 0.5
roughness = 0.3
[materials.ground.diffuse]
reflectance = 0.3
[meshes.ball.sphere]
radius_m = 0.05
segments = 32
[meshes.ground.rectangle]
width_m = 3
height_m = 3
[objects.ball]
mesh = \"ball\"
material = \"skin\"
position_m = [0, 0, 0.05]
[objects.ground]
mesh = \"ground\"
material = \"ground\"
[lights.sky.constant]
radiance_w_m2_sr_nm = 1
";

#[test]
fn the_variance_of_a_band_is_at_most_twice_that_over_seeds() {
    let room = glowing_room("0.6", 0.4);
    let inside = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 90";
    let from_above =
        "position_m = [0.3, -0.5, 0.3]\nlook_at_m = [0, 0, 0.03]\nvertical_fov_deg = 16";
    for (what, text, samples) in [
        (
            "room",
            scene(inside, "roulette_below = 1", &room),
            &[16, 64][..],
        ),
        ("room without roulette", scene(inside, "", &room), &[64]),
        ("leaf", scene(FACING_THE_ORIGIN, "", LEAF), &[16, 64, 256]),
        ("ball", scene(from_above, "", BALL), &[16, 64]),
    ] {
        for bands in ["bands_nm = [550, 800]", "bands_nm = [550]"] {
            for spp in samples {
                let text = text.replace("bands_nm = [550, 800]", bands);
                let text = text.replace("spp = 64", &format!("spp = {spp}"));
                let pictures: Vec<_> = (0..24).map(|seed| picture_of(&text, seed)).collect();
                for channel in 0..pictures[0].film.channels() {
                    let [reported, of_samples, found] =
                        variances(&pictures, Series::Channel(channel));
                    let [ratio, of_samples] = [reported, of_samples].map(|all| all / found);
                    eprintln!("{what}, {bands}, {spp}, {channel}: {ratio:.2}, {of_samples:.2}");
                    assert!((0.9..2.0).contains(&ratio), "{what}, {channel}: {ratio}");
                }
            }
        }
    }
}

#[test]
fn the_reported_error_of_luminance_is_that_over_seeds() {
    let of_colour = |camera: &str, integrator: &str, blocks: &str| {
        let text = scene(camera, integrator, blocks);
        let bands = "[film.spectral]\nsize = [16, 16]\nspp = 64\nbands_nm = [550, 800]\nband_width_nm = 0\n";
        text.replace(bands, "[film.rgb]\nsize = [16, 16]\nspp = 128\n")
    };
    let room = glowing_room("0.6", 0.4);
    let inside = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 90";
    let floor = GREY_FLOOR.replace("{ table = [[550, 0.25], [800, 0.75]] }", "0.5");
    let lamp = format!(
        "{floor}[meshes.lamp.rectangle]\nwidth_m = 0.5\nheight_m = 0.5\n\
         [materials.black.diffuse]\nreflectance = 0\n\
         [objects.lamp]\nmesh = \"lamp\"\nmaterial = \"black\"\nrotate_deg = [180, 0, 0]\n\
         position_m = [0.8, 0.1, 0.6]\n\
         [lights.lamp.area]\nobject = \"lamp\"\nradiance_w_m2_sr_nm = 1\n"
    );
    for (what, text, within) in [
        // Paths that roulette ends at every bounce are nearly independent.
        (
            "room",
            of_colour(inside, "roulette_below = 1", &room),
            [0.9, 1.4],
        ),
        // The smoothest of integrands: the second half of the samples fills the gaps of the first best, and
        // single samples report a variance a thousand times too large.
        ("lamp", of_colour(FACING_THE_ORIGIN, "", &lamp), [0.9, 4.0]),
    ] {
        let pictures: Vec<_> = (0..24).map(|seed| picture_of(&text, seed)).collect();
        let [told, of_samples, found] = variances(&pictures, Series::Luminance);
        let (ratio, of_samples) = (told / found, of_samples / found);
        eprintln!("{what}: told {ratio:.2} of the variance over seeds, samples {of_samples:.2}");
        assert!(ratio > within[0] && ratio < within[1], "{what}: {ratio}");
        assert!(of_samples > ratio, "{what}: {of_samples} by single samples");
    }
}
