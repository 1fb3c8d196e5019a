//! What pictures tell of their own error, against the error over seeds.

use renderer::film::Pixel;
use renderer::image::LUMINANCE;
use renderer::integrator::render::Halt;
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

/// Mean over pixels of the variance of luminance over seeds, of what the pictures tell of it, and of
/// what single samples of the channels would tell.
fn variances_of_luminance(text: &str, seeds: u64) -> [f64; 3] {
    let pictures: Vec<_> = (0..seeds).map(|seed| picture_of(text, seed)).collect();
    let mean = |of: &dyn Fn(&Pixel<'_>) -> f64| {
        let values = pictures.iter().flat_map(|picture| {
            let film = &picture.film;
            let all = (0..film.height()).flat_map(|y| (0..film.width()).map(move |x| (x, y)));
            all.map(|(x, y)| of(&film.pixel(x, y)))
        });
        values.sum::<f64>() / (256 * seeds) as f64
    };
    let told = mean(&|pixel| pixel.variance_of_luminance());
    let of_samples = mean(&|pixel| {
        let deviations = LUMINANCE.iter().zip(0..pixel.channels());
        let deviations = deviations.map(|(share, channel)| {
            share
                * pixel
                    .moments(channel)
                    .variance_of_mean(pixel.samples())
                    .sqrt()
        });
        deviations.sum::<f64>().powi(2)
    });
    let mut found = 0.0;
    for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
        let of_seeds: Vec<f64> = pictures
            .iter()
            .map(|picture| picture.film.pixel(x, y).luminance())
            .collect();
        let (_, error) = mean_and_error_of(&of_seeds);
        found += error * error * seeds as f64 / 256.0;
    }
    [found, told, of_samples]
}

#[test]
fn the_variance_of_a_band_is_at_most_twice_that_over_seeds() {
    let room = glowing_room("0.6", 0.4);
    let inside = "position_m = [0.1, 0.2, 0.3]\nlook_at_m = [1, 0, 0]\nvertical_fov_deg = 90";
    for (what, text) in [
        ("room", scene(inside, "roulette_below = 1", &room)),
        ("room without roulette", scene(inside, "", &room)),
    ] {
        for bands in ["bands_nm = [550, 800]", "bands_nm = [550]"] {
            let text = text.replace("bands_nm = [550, 800]", bands);
            let pictures: Vec<_> = (0..24).map(|seed| picture_of(&text, seed)).collect();
            for channel in 0..pictures[0].film.channels() {
                let (mut found, mut reported) = (0.0, 0.0);
                for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
                    let pixels = || pictures.iter().map(|picture| picture.film.pixel(x, y));
                    let means: Vec<f64> = pixels().map(|pixel| pixel.mean(channel)).collect();
                    let (_, error) = mean_and_error_of(&means);
                    found += error * error * 24.0;
                    reported += pixels().map(|pixel| pixel.variance(channel)).sum::<f64>() / 24.0;
                }
                let ratio = reported / found;
                eprintln!("{what}, {bands}, {channel}: {ratio:.2}");
                assert!((0.8..2.0).contains(&ratio), "{what}, {channel}: {ratio}");
            }
        }
    }
}

#[test]
fn the_told_error_of_luminance_is_that_over_seeds() {
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
        // The smoothest of integrands: later batches fill the gaps of earlier ones best, and single
        // samples tell a variance a thousand times too large.
        ("lamp", of_colour(FACING_THE_ORIGIN, "", &lamp), [0.9, 20.0]),
    ] {
        let [found, told, of_samples] = variances_of_luminance(&text, 24);
        let (ratio, of_samples) = (told / found, of_samples / found);
        eprintln!("{what}: told {ratio:.2} of the variance over seeds, samples {of_samples:.2}");
        assert!(ratio > within[0] && ratio < within[1], "{what}: {ratio}");
        assert!(of_samples > ratio, "{what}: {of_samples} by single samples");
    }
}
