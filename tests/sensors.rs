//! Films that see as sensors do, and films of more bands than a path carries.

use std::sync::atomic::AtomicBool;

use renderer::checkpoint::{self, Heading, PROGRAM};
use renderer::image::openexr;
use renderer::integrator::caption::Caption;
use renderer::integrator::develop::develop;
use renderer::integrator::layers::Layout;
use renderer::integrator::render::{Begun, Contact, Ended, Job, Rendered, begin, go_on};
use renderer::spectrum::sensor::{Response, Sensor};
use support::picture::{mean_and_error, mean_of, picture_of, world_of};

/// Reflectance of a ground, which rises in the red as that of a leaf does.
const REFLECTANCE: [(f64, f64); 7] = [
    (360.0, 0.02),
    (500.0, 0.06),
    (560.0, 0.16),
    (670.0, 0.04),
    (760.0, 0.52),
    (1300.0, 0.48),
    (2500.0, 0.1),
];

/// A level ground under an even sky of radiance 1: it reflects as much radiance as its reflectance.
fn ground(film: &str, spp: u32) -> String {
    let rows = REFLECTANCE.map(|(nm, value)| format!("[{nm}, {value}]"));
    format!(
        "format = 1\n[film.spectral]\nsize = [8, 8]\nspp = {spp}\n{film}\n\
         [camera.orthographic]\nposition_m = [0, 0, 5]\nlook_at_m = [0, 0, 0]\nup = [0, 1, 0]\n\
         height_m = 1\n[meshes.ground.rectangle]\nwidth_m = 9\nheight_m = 9\n\
         [materials.soil.diffuse]\nreflectance = {{ table = [{}] }}\n\
         [objects.ground]\nmesh = \"ground\"\nmaterial = \"soil\"\n\
         [lights.sky.constant]\nradiance_w_m2_sr_nm = 1\n",
        rows.join(", ")
    )
}

/// The reflectance of the ground at a wavelength in nm.
fn reflectance(nm: f64) -> f64 {
    let above = REFLECTANCE.partition_point(|row| row.0 < nm).clamp(1, 6);
    let (low, high) = (REFLECTANCE[above - 1], REFLECTANCE[above]);
    low.1 + (nm - low.0) / (high.0 - low.0) * (high.1 - low.1)
}

/// Its mean by a response, over steps of 0.01 nm.
fn by_response(response: &Response) -> f64 {
    let [first, last] = response.range_nm();
    let steps = (100.0 * (last - first)) as u32;
    let nm = (0..steps).map(|step| first + (f64::from(step) + 0.5) * 0.01);
    let (sum, all) = nm.fold((0.0, 0.0), |(sum, all), nm| {
        let weight = response.at(nm);
        (sum + weight * reflectance(nm), all + weight)
    });
    sum / all
}

#[test]
fn a_band_of_a_sensor_records_the_mean_radiance_by_its_response() {
    for name in ["sentinel-2a", "landsat-9", "sentinel-2c"] {
        let text = ground(&format!("sensor = \"{name}\""), 64);
        let sensor = Sensor::by_name(name).expect("it is shipped");
        for (channel, band) in sensor.bands().iter().enumerate() {
            let expected = by_response(band);
            let (mean, error) = mean_and_error(&text, channel, 8);
            let off = (mean - expected).abs();
            // The steps of the integral and the parts of the response differ by some 1e-5.
            assert!(
                off < 4.0 * error + 3e-5,
                "{name} {}: {mean} ± {error}, {expected}",
                band.name()
            );
        }
    }
}

#[test]
fn a_band_records_alike_in_a_film_of_few_bands_and_of_many() {
    let many = (0..100).map(|band| (400 + 20 * band).to_string());
    let many: Vec<String> = many.collect();
    let film = |bands: &[String]| format!("bands_nm = [{}]\nband_width_nm = 20", bands.join(", "));
    let all = picture_of(&ground(&film(&many), 32), 1);
    for (group, bands) in many.chunks(32).enumerate() {
        let own = picture_of(&ground(&film(bands), 32), 1);
        for (channel, band) in bands.iter().enumerate() {
            // On a single bounce nothing depends on other bands.
            let of_all = mean_of(&all, 32 * group + channel);
            assert_eq!(of_all, mean_of(&own, channel), "{band}");
        }
    }
}

/// Leaves before each other, so that paths decide by what other bands see.
const LEAVES: &str = "
format = 1
[film.spectral]
size = [20, 12]
spp = 12
sensor = \"enmap-like\"
[camera.perspective]
position_m = [0, -0.3, 0.2]
look_at_m = [0, 0, 0.02]
vertical_fov_deg = 30
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
[objects.floor]
mesh = \"floor\"
material = \"leaf\"
position_m = [0, 0, -0.05]
[objects.ball]
mesh = \"ball\"
material = \"leaf\"
[lights.sun.distant]
irradiance_w_m2_nm = { blackbody_k = 5800 }
elevation_deg = 40
azimuth_deg = 100
";

#[test]
fn hundreds_of_bands_have_the_same_bytes_on_any_threads_resumed_and_merged() {
    let (description, world) = world_of(LEAVES);
    let job = Job {
        width: 20,
        height: 12,
        spp: 12,
        seed: 5,
    };
    let caption = Caption::of(&description, &world.view, &world.light_colours);
    let heading = Heading {
        program: PROGRAM.to_owned(),
        scene: 1,
        job,
        whole: None,
        aim: None,
        caption: caption.clone(),
    };
    let go = AtomicBool::new(false);
    let contact = Contact {
        stop: &go,
        progress: &|_| (),
        is_due: &|| false,
        keep: &|_| (),
    };
    let pool = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        pool.build().expect("threads can be had")
    };
    let bytes = |begun: Begun| {
        let rendered = Rendered::new(begun, Layout::new(&world.wavelengths), Ended::Samples);
        openexr::encode(&develop(&caption, &job, &rendered))
    };
    let new = || begin(&world, &job, None, &go).expect("a small film");
    let [one, three] = [1, 3].map(|threads| {
        let (begun, _) = pool(threads).install(|| go_on(&world, &job, new(), None, &contact));
        bytes(begun).expect("it can be encoded")
    });
    assert!(one == three, "the number of threads matters");

    let folder = tempfile::tempdir().expect("a folder");
    let kept = |begun: &Begun, heading: &Heading, name: &str| {
        let file = folder.path().join(name);
        checkpoint::write(&file, heading, begun).expect("the folder can be written");
        file
    };
    let ending = |spp| Heading {
        job: Job { spp, ..job },
        ..heading.clone()
    };
    let half = ending(5);
    let (begun, _) = go_on(&world, &half.job, new().up_to(&half.job), None, &contact);
    let file = kept(&begun, &half, "half.checkpoint");
    let (_, begun) = checkpoint::read(&file).expect("it was just written");
    let (begun, _) = go_on(&world, &job, begun.up_to(&job), None, &contact);
    assert!(bytes(begun).expect("it can be encoded") == one, "resumed");

    let first = file;
    let (begun, _) = go_on(&world, &job, new().from_sample(5), None, &contact);
    let second = kept(&begun, &heading, "second.part");
    let merged = checkpoint::merge(&[second, first]);
    let (_, begun) = merged.unwrap_or_else(|error| panic!("{error}"));
    assert!(bytes(begun).expect("it can be encoded") == one, "merged");
}

#[test]
fn a_sensor_in_a_file_records_as_the_shipped_one_and_names_its_bands() {
    let folder = tempfile::tempdir().expect("a folder");
    let sensor = Sensor::by_name("modis-terra").expect("it is shipped");
    // In the order in which the sensor numbers them, which is not that of their wavelengths.
    let mut bands: Vec<&Response> = sensor.bands().iter().collect();
    bands.sort_by_key(|band| band.name().to_owned());
    let names: Vec<&str> = bands.iter().map(|band| band.name()).collect();
    let mut table = format!("nm;{}\n", names.join(";"));
    for nm in 450..=2200 {
        let values = bands.iter().map(|band| band.at(nm.into()).to_string());
        table += &format!("{nm};{}\n", values.collect::<Vec<_>>().join(";"));
    }
    std::fs::write(folder.path().join("own.csv"), table).expect("the folder can be written");
    let picture = |film: &str| {
        let text = ground(film, 16);
        let loaded = renderer::scene::load::parse(&text, "test.toml", folder.path(), &[]);
        let loaded = loaded.unwrap_or_else(|errors| panic!("{errors}"));
        let scene = loaded.description;
        let world = renderer::scene::world::World::build(&scene).expect("it can be built");
        let job = Job {
            width: 8,
            height: 8,
            spp: 16,
            seed: 1,
        };
        let go = AtomicBool::new(false);
        let rendered = renderer::integrator::render::render(&world, &job, &go, &|_| ());
        let caption = Caption::of(&scene, &world.view, &world.light_colours);
        develop(&caption, &job, &rendered.expect("a small film"))
    };
    let shipped = picture("sensor = \"modis-terra\"");
    let own = picture("sensor = { file = \"own.csv\" }");
    let attribute = |name: &str| {
        let found = own.attributes.iter().find(|(own, _)| own == name);
        format!("{:?}", found.expect(name))
    };
    assert!(attribute("lamina:sensor").contains("own.csv"));
    let lines = attribute("lamina:bands");
    assert!(lines.contains("B3 466.0"), "{lines}");
    for (own, shipped) in own.layers.iter().zip(&shipped.layers) {
        assert_eq!(own.name, shipped.name);
        let pairs = own.data.iter().zip(&shipped.data);
        assert!(
            pairs
                .into_iter()
                .all(|(a, b)| (a - b).abs() < 1e-5 * (1.0 + b.abs()))
        );
    }
}
