//! Same bytes for any number of threads.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use renderer::image::openexr;
use renderer::integrator::caption::Caption;
use renderer::integrator::develop::develop;
use renderer::integrator::effort::Effort;
use renderer::integrator::layers::Layout;
use renderer::integrator::render::{
    Contact, Ended, Halt, Job, Rendered, begin, go_on, render_until,
};
use renderer::integrator::sample_map::SampleMap;
use renderer::simd::Level;
use support::picture::{mean_of, picture_of, world_of};

const SCENE: &str = "
format = 1
[film.rgb]
size = [40, 30]
spp = 20
[camera.perspective]
position_m = [0, -0.3, 0.2]
look_at_m = [0, 0, 0.02]
vertical_fov_deg = 30
aperture_diameter_mm = 5
[materials.leaf.leaf.contents]
structure = 1.5
chlorophyll_ug_per_cm2 = 40
carotenoids_ug_per_cm2 = 8
water_cm = 0.01
dry_matter_g_per_cm2 = 0.005
[meshes.ball.sphere]
radius_m = 0.05
[meshes.floor.rectangle]
width_m = 1
height_m = 1
[materials.grey.diffuse]
reflectance = 0.4
[objects.floor]
mesh = \"floor\"
material = \"grey\"
position_m = [0, 0, -0.05]
[objects.ball]
mesh = \"ball\"
material = \"leaf\"
[lights.sun.distant]
irradiance_w_m2_nm = { blackbody_k = 5800 }
elevation_deg = 40
azimuth_deg = 100
[lights.sky.constant]
radiance_w_m2_sr_nm = { d65 = 0.05 }
";

/// A picture of so many pixels across and down.
fn job([width, height]: [u32; 2], spp: u32) -> Job {
    Job {
        width,
        height,
        spp,
        seed: 5,
    }
}

/// A picture of the scene on so many threads, and its file.
fn rendered(threads: usize, spp: u32, halt: Halt) -> (Rendered, Vec<u8>) {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads");
    pool.install(|| {
        let (scene, world) = world_of(SCENE);
        let job = job([40, 30], spp);
        let go_on = AtomicBool::new(false);
        let rendered = render_until(&world, &job, &halt, &go_on, &|_| ()).expect("it fits");
        let folder = tempfile::tempdir().expect("a place for temporary files");
        let path = folder.path().join("picture.exr");
        let caption = Caption::of(&scene, &world.view, &world.light_colours);
        openexr::write(&develop(&caption, &job, &rendered), &path).expect("it is written");
        let bytes = std::fs::read(&path).expect("it was just written");
        (rendered, bytes)
    })
}

#[test]
fn a_picture_has_the_same_bytes_on_any_number_of_threads() {
    let (_, one) = rendered(1, 20, Halt::default());
    for threads in [2, 3, 8] {
        let (_, bytes) = rendered(threads, 20, Halt::default());
        assert!(one == bytes, "{threads} threads");
    }
}

#[test]
fn the_effort_is_tried_out_alike_on_any_number_of_threads_and_samples_and_a_given_one_is_kept() {
    // Large enough for a trial.
    let of = |threads: usize, spp: u32, text: &str| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        let (_, world) = world_of(text);
        let job = job([80, 60], spp);
        let go_on = AtomicBool::new(false);
        pool.install(|| begin(&world, &job, None, &go_on))
            .expect("it fits")
            .effort
    };
    let one = of(1, 600, SCENE);
    for (threads, spp) in [(2, 600), (3, 600), (2, 4), (2, 1 << 20)] {
        assert_eq!(
            of(threads, spp, SCENE),
            one,
            "{threads} threads, {spp} samples"
        );
    }
    let text = SCENE.to_owned()
        + "[integrator]\nroulette_below = 0.3\nbranches = 7\nlit_branches = 2\nlight_samples = 3\nsample_skies = false\n";
    let Effort {
        roulette_below,
        branches,
        lit_branches,
        light_samples,
        sample_skies,
    } = of(2, 600, &text);
    assert_eq!(roulette_below, 0.3);
    assert_eq!((branches, lit_branches, light_samples), (7, 2, 3));
    assert!(!sample_skies);
}

#[test]
fn two_paths_go_on_from_a_leaf_in_the_sun_and_one_where_nothing_is_lit() {
    let lit_branches = |text: &str| {
        let (_, world) = world_of(text);
        let job = job([80, 60], 64);
        let begun = begin(&world, &job, None, &AtomicBool::new(false)).expect("it fits");
        begun.effort.lit_branches
    };
    // A leaf that fills the picture, close above what shines through it.
    let close = SCENE
        .replace("vertical_fov_deg = 30", "vertical_fov_deg = 10")
        .replace("mesh = \"ball\"", "mesh = \"floor\"")
        .replace("aperture_diameter_mm = 5\n", "");
    assert_eq!(lit_branches(&close), 2);
    let (in_shade, _) = close.split_once("[lights.sun.distant]").expect("a sun");
    let sky = "[lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n";
    assert_eq!(lit_branches(&[in_shade, sky].concat()), 1);
}

/// What the light of the scene adds up to, bit for bit. It changes when random numbers, estimators
/// or spectra do; then the test prints the new one, and the commit says why.
const LIGHT: u64 = 0x344c_950d_cd70_0517;

#[test]
fn every_level_of_instructions_gives_the_same_committed_light() {
    for level in Level::all() {
        let (_, mut world) = world_of(SCENE);
        world.traced.geometry = world.traced.geometry.at_level(level);
        let job = job([40, 30], 20);
        let go_on = AtomicBool::new(false);
        let rendered =
            render_until(&world, &job, &Halt::default(), &go_on, &|_| ()).expect("it fits");
        let means = (0..3).flat_map(|channel| rendered.film.mean(channel));
        // The 64-bit FNV-1a hash.
        let hash = means
            .flat_map(|mean| mean.to_bits().to_le_bytes())
            .fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
                (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
            });
        assert_eq!(hash, LIGHT, "{}: {hash:#018x}", level.name());
    }
}

#[test]
fn a_picture_that_aims_at_a_noise_has_the_same_bytes_on_any_number_of_threads() {
    let halt = Halt {
        noise: Some(0.02),
        time: None,
    };
    let (first, one) = rendered(1, 200, halt);
    let [fewest, most] = first.film.drawn_range();
    assert!(
        fewest < 100 && most > fewest,
        "{fewest} to {most} samples: some blocks stop early, others go on"
    );
    for threads in [2, 3, 8] {
        let (_, bytes) = rendered(threads, 200, halt);
        assert!(one == bytes, "{threads} threads");
    }
}

#[test]
fn a_block_that_stopped_early_has_the_bits_of_its_first_samples() {
    let halt = Halt {
        noise: Some(0.02),
        time: None,
    };
    let (adaptive, _) = rendered(2, 200, halt);
    let [fewest, most] = adaptive.film.drawn_range();
    let features = 0..adaptive.layout.sums().len();
    for spp in [fewest, most] {
        let (plain, _) = rendered(2, spp, Halt::default());
        let mut same = 0;
        for (x, y) in (0..30).flat_map(|y| (0..40).map(move |x| (x, y))) {
            let (pixel, expected) = (adaptive.film.pixel(x, y), plain.film.pixel(x, y));
            if pixel.samples() == spp {
                let of = |pixel: &renderer::film::Pixel<'_>| {
                    let radiance = [0, 1, 2].map(|channel| pixel.mean(channel));
                    let features: Vec<_> = features.clone().map(|n| pixel.feature(n)).collect();
                    (radiance, pixel.alpha(), features)
                };
                assert_eq!(of(&pixel), of(&expected), "pixel {x}, {y}");
                same += 1;
            }
        }
        assert!(same > 0, "no pixel has {spp} samples");
    }
}

/// The scene rendered by a map of samples, from the first sample or from a target noise on.
fn rendered_by(map: &SampleMap, threads: usize, aim: Option<f64>) -> Rendered {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads");
    pool.install(|| {
        let (_, world) = world_of(SCENE);
        let job = job([40, 30], 60);
        let contact = Contact {
            stop: &AtomicBool::new(false),
            progress: &|_| (),
            is_due: &|| false,
            keep: &|_| (),
        };
        let mut begun = begin(&world, &job, aim, contact.stop).expect("it fits");
        if aim.is_some() {
            (begun, _) = go_on(&world, &job, begun, None, &contact);
        }
        let (begun, ended) = go_on(&world, &job, begun.by_map(map.clone()), None, &contact);
        assert_eq!(ended, Ended::Samples);
        Rendered::new(begun, Layout::new(&world.wavelengths), ended)
    })
}

#[test]
fn by_a_map_of_samples_each_block_has_the_bits_of_so_many() {
    // Five by four blocks, the lowest of fewer pixels; what is beyond the job's 60 counts as 60.
    let wanted = |x: u32, y: u32| [3, 37, 80][((x / 8 + y / 8) % 3) as usize];
    let values: Vec<f32> = (0..30)
        .flat_map(|y| (0..40).map(move |x| wanted(x, y) as f32))
        .collect();
    let map = SampleMap::new(40, &values).expect("it is a map");
    let plain = [3, 37, 60].map(|spp| rendered(2, spp, Halt::default()).0);
    let check = |by_map: &Rendered, least: u32| {
        for (x, y) in (0..30).flat_map(|y| (0..40).map(move |x| (x, y))) {
            let pixel = by_map.film.pixel(x, y);
            assert_eq!(pixel.samples(), wanted(x, y).min(60).max(least), "{x}, {y}");
            let same = plain.iter().map(|plain| plain.film.pixel(x, y));
            for same in same.filter(|same| same.samples() == pixel.samples()) {
                let of = |pixel: &renderer::film::Pixel<'_>| [0, 1, 2].map(|c| pixel.mean(c));
                assert_eq!(of(&pixel), of(&same), "{x}, {y}");
            }
        }
    };
    for threads in [1, 3] {
        check(&rendered_by(&map, threads, None), 0);
    }
    // All blocks stop at 32 samples for an error of 1; then the map leads them on.
    check(&rendered_by(&map, 2, Some(1.0)), 32);
}

#[test]
fn a_picture_that_ran_out_of_time_is_that_of_its_sample_count() {
    for noise in [None, Some(0.2)] {
        let halt = Halt {
            noise,
            time: Some(Duration::from_millis(300)),
        };
        let (stopped, bytes) = rendered(2, 1 << 20, halt);
        // A picture of 1,200 pixels takes hours for a million samples, and some blocks are not done
        // for 0.2 at once.
        let [_, most] = stopped.film.drawn_range();
        if noise.is_none() {
            assert_eq!(stopped.ended, Ended::Time);
        }
        let (_, again) = rendered(1, most, Halt { noise, time: None });
        assert!(bytes == again, "{most} samples, noise {noise:?}");
    }
}

#[test]
fn a_scene_a_thousand_kilometres_away_is_the_scene_at_the_origin() {
    let moved = |offset: [f64; 3]| {
        let place = |line: &str| {
            let (key, list) = line.split_once(" = ")?;
            let list = list.strip_prefix('[')?.strip_suffix(']')?;
            let numbers = list.split(", ").map(|n| n.parse::<f64>().ok());
            let numbers: Option<Vec<f64>> = numbers.collect();
            let sums = numbers?.into_iter().zip(offset).map(|(n, by)| n + by);
            let sums: Vec<String> = sums.map(|sum| format!("{sum:?}")).collect();
            let is_place = matches!(key, "position_m" | "look_at_m");
            is_place.then(|| format!("{key} = [{}]", sums.join(", ")))
        };
        // The ball has its place by default.
        let text = SCENE.replace(
            "mesh = \"ball\"\n",
            "mesh = \"ball\"\nposition_m = [0, 0, 0]\n",
        );
        let lines = text.lines();
        let lines = lines.map(|line| place(line).unwrap_or_else(|| line.to_owned()));
        picture_of(&lines.collect::<Vec<_>>().join("\n"), 3)
    };
    let here = moved([0.0; 3]);
    let away = moved([999_999.0, -999_999.0, 999_999.0]);
    for channel in 0..3 {
        let [here, away] = [&here, &away].map(|rendered| mean_of(rendered, channel));
        assert!(
            (away / here - 1.0).abs() < 1e-5,
            "channel {channel}: {away} and {here}"
        );
    }
}
