//! The lights of a day against the irradiances that they are made of.

use glam::{Vec2, Vec3};

use super::sky::SkyLight;
use super::spctrl2::Atmosphere;
use super::*;
use crate::spectrum::{Curve, Wavelengths};

/// Wavelengths from the ultraviolet to the end of the films, at rows of the table and between.
const NM: [f32; 8] = [370.0, 405.0, 450.0, 560.0, 695.0, 850.0, 1240.0, 2200.0];

fn day(elevation_deg: f64, turbidity: f64, ground_albedo: f64) -> Daylight {
    Daylight {
        elevation: elevation_deg.to_radians(),
        azimuth: 0.7,
        atmosphere: Atmosphere {
            turbidity,
            ground_albedo,
            ..Atmosphere::default()
        },
        ..Daylight::default()
    }
}

fn days() -> [Daylight; 4] {
    [
        day(90.0, 2.0, 0.0),
        day(45.0, 3.0, 0.2),
        day(12.0, 5.0, 0.8),
        day(1.0, 10.0, 0.2),
    ]
}

/// Points of a square, evenly: a lattice whose lines do not fall onto the borders of tables.
fn lattice(count: usize) -> impl Iterator<Item = Vec2> {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    (0..count).map(move |i| {
        let x = (i as f64 + 0.5) * GOLDEN;
        Vec2::new(x.fract() as f32, ((i as f64 + 0.5) / count as f64) as f32)
    })
}

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    let off = (found / expected - 1.0).abs();
    assert!(
        off < tolerance,
        "{what}: {found}, not {expected}, off by {off}"
    );
}

/// Sums of radiance × cosine over density of the sky's own samples, above and below the horizon.
fn irradiance_of_samples(sky: &SkyLight, count: usize) -> [[f64; 8]; 2] {
    let mut sums = [[0.0; 8]; 2];
    for u in lattice(count) {
        if let Some(sample) = sky.sample(&Wavelengths::new(NM), u) {
            let half = usize::from(sample.wi.z < 0.0);
            for (sum, radiance) in sums[half].iter_mut().zip(sample.radiance.0) {
                *sum += f64::from(radiance * sample.wi.z.abs() / sample.pdf) / count as f64;
            }
        }
    }
    sums
}

#[test]
fn a_horizontal_surface_gets_the_diffuse_irradiance_of_spctrl2_at_every_wavelength() {
    for day in days() {
        let (_, sky) = day.lights();
        let rows = day.atmosphere.irradiance(day.elevation);
        let diffuse = curve(&rows, |row| row.diffuse);
        let direct = curve(&rows, |row| row.direct);
        let [above, below] = irradiance_of_samples(&sky, 1 << 18);
        for (i, nm) in NM.into_iter().enumerate() {
            let expected = f64::from(diffuse.at(nm));
            // Between the table's directions the sky is linear.
            assert_near(above[i], expected, 1e-3, &format!("{day:?} at {nm} nm"));
            // The ground sends up its share of what it gets.
            let up = libm::sin(day.elevation);
            let sent = day.atmosphere.ground_albedo * (f64::from(direct.at(nm)) * up + expected);
            assert!(
                (below[i] - sent).abs() <= 1e-3 * sent,
                "{}, not {sent}",
                below[i]
            );
        }
    }
}

#[test]
fn a_surface_that_faces_the_sun_gets_the_direct_irradiance_of_spctrl2_at_every_wavelength() {
    for day in days() {
        let (sun, _) = day.lights();
        let direct = curve(&day.atmosphere.irradiance(day.elevation), |row| row.direct);
        let mut sums = [0.0; 8];
        let count = 1 << 14;
        for u in lattice(count) {
            let sample = sun.sample(&Wavelengths::new(NM), u);
            let cos = sample.wi.dot(day.towards_sun().as_vec3());
            for (sum, radiance) in sums.iter_mut().zip(sample.radiance.0) {
                *sum += f64::from(radiance * cos / sample.pdf) / count as f64;
            }
        }
        for (sum, nm) in sums.into_iter().zip(NM) {
            let expected = f64::from(direct.at(nm));
            assert_near(sum, expected, 2e-3, &format!("{day:?} at {nm} nm"));
        }
    }
}

#[test]
fn even_directions_find_the_same_sky_as_its_samples_and_its_density_integrates_to_one() {
    for day in days() {
        let (_, mut sky) = day.lights();
        let mut found = [0.0; 8];
        let mut density = 0.0;
        let count = 1 << 19;
        for u in lattice(count) {
            let z = 1.0 - 2.0 * u.y;
            let (sin, cos) = libm::sincosf(2.0 * std::f32::consts::PI * u.x);
            let radius = (1.0 - z * z).sqrt();
            let wi = Vec3::new(radius * cos, radius * sin, z);
            let (radiance, pdf) = sky.towards(wi, &Wavelengths::new(NM));
            let area = 4.0 * std::f64::consts::PI / count as f64;
            density += f64::from(pdf) * area;
            for (sum, radiance) in found.iter_mut().zip(radiance.0) {
                *sum += f64::from(radiance * z.max(0.0)) * area;
            }
        }
        assert!((density - 1.0).abs() < 2e-3, "{density}");
        let [above, _] = irradiance_of_samples(&sky, 1 << 18);
        for (found, drawn) in found.into_iter().zip(above) {
            assert_near(found, drawn, 1e-3, &format!("{day:?}"));
        }
        // A tabulated sky is the same.
        let film = crate::spectrum::recorded::FilmKind::Rgb {
            range_nm: [400.0, 780.0],
            observer: crate::spectrum::observer::Observer::Cie1931,
        };
        let sampler = crate::spectrum::WavelengthSampler::new(&film);
        let drawn = sampler.draw::<8>(0.4, 0);
        let wi = Vec3::new(0.6, 0.0, 0.8);
        let free = sky.towards(wi, &drawn).0;
        sky.tabulate(sampler.grid());
        // A table holds means, which differ where a row of the sky's spectrum lies within a share.
        for (mean, free) in sky.towards(wi, &drawn).0.0.into_iter().zip(free.0) {
            assert!((mean / free - 1.0).abs() < 1e-4, "{mean} {free}");
        }
    }
}

#[test]
fn a_direction_to_the_sun_or_sky_has_the_density_and_radiance_that_are_reported_for_it() {
    let day = day(30.0, 3.0, 0.3);
    let (sun, sky) = day.lights();
    let wavelengths = Wavelengths::new(NM);
    let mut across_a_border = 0;
    for u in lattice(2300) {
        let sample = sky
            .sample(&wavelengths, u)
            .expect("all directions are bright");
        let (radiance, pdf) = sky.towards(sample.wi, &wavelengths);
        assert_eq!(radiance, sky.seen_towards(sample.wi, &wavelengths));
        let same = (pdf / sample.pdf - 1.0).abs() < 1e-3
            && (radiance.0[3] / sample.radiance.0[3] - 1.0).abs() < 1e-2;
        across_a_border += usize::from(!same);
        let sample = sun.sample(&wavelengths, u);
        let (radiance, pdf) = sun
            .towards(sample.wi, &wavelengths)
            .expect("it is on the disc");
        // Near the limb a rounded direction is another place on the disc.
        if u.x < 0.98 {
            assert!((pdf / sample.pdf - 1.0).abs() < 5e-3, "{u}: {pdf}");
            assert!(
                (radiance.0[0] / sample.radiance.0[0] - 1.0).abs() < 1e-2,
                "{u}"
            );
        }
    }
    // Rounding may carry a direction at the edge of a cell into the next one.
    assert!(across_a_border <= 4, "{across_a_border} differ");
    // Half the disc's radius and one and a half radii off its middle.
    let middle = sun.sample(&wavelengths, Vec2::ZERO);
    for (degrees, is_on_the_disc) in [
        (0.1325_f32, true),
        (0.26, true),
        (0.27, false),
        (90.0, false),
    ] {
        let across = middle.wi.any_orthonormal_vector();
        let (sin, cos) = degrees.to_radians().sin_cos();
        let wi = middle.wi * cos + across * sin;
        let found = sun.towards(wi, &wavelengths);
        assert_eq!(found.is_some(), is_on_the_disc, "{degrees}");
        if degrees == 0.1325 {
            // √0.75 to the power of the law: 0.766 at 370 nm as at 416, then less of a fall.
            let (radiance, _) = found.expect("it is on the disc");
            for (i, exponent) in [(1, 0.679), (3, 0.4984), (5, 0.3205)] {
                let share = radiance.0[i] / middle.radiance.0[i];
                let expected = 0.75_f32.powf(0.5 * exponent);
                assert!((share - expected).abs() < 1e-2, "{share}, not {expected}");
            }
        }
    }
    assert!(sun.towards(-middle.wi, &wavelengths).is_none());
}

#[test]
fn the_sky_is_brightest_around_the_sun_and_bluer_in_the_zenith_than_at_the_horizon() {
    let day = day(30.0, 2.5, 0.2);
    let (_, sky) = day.lights();
    let wavelengths = Wavelengths::new(NM);
    let at = |wi: Vec3| sky.towards(wi.normalize(), &wavelengths).0.0;
    let sun = day.towards_sun().as_vec3();
    let (near, opposite) = (at(sun), at(Vec3::new(-sun.x, -sun.y, sun.z)));
    assert!(near[3] > 3.0 * opposite[3], "{near:?} {opposite:?}");
    let horizon = at(Vec3::new(-sun.x, -sun.y, 0.02));
    let zenith = at(Vec3::new(0.01, 0.0, 1.0));
    assert!(
        zenith[2] / zenith[4] > 1.3 * horizon[2] / horizon[4],
        "{zenith:?} {horizon:?}"
    );
}

#[test]
fn a_covered_sky_gives_its_irradiance_and_is_three_times_as_bright_in_the_zenith() {
    let irradiance = Curve::from_points(&[(400.0, 0.5), (800.0, 1.5)]);
    let sky = SkyLight::overcast(&irradiance, 0.3);
    let [above, below] = irradiance_of_samples(&sky, 1 << 18);
    for (i, nm) in NM.into_iter().enumerate() {
        let expected = f64::from(irradiance.at(nm));
        assert_near(above[i], expected, 1e-3, &format!("from above at {nm} nm"));
        assert_near(
            below[i],
            0.3 * expected,
            1e-3,
            &format!("from below at {nm} nm"),
        );
    }
    let wavelengths = Wavelengths::new(NM);
    for elevation in [1.0_f32, 30.0, 60.0, 90.0] {
        let (sin, cos) = libm::sincosf(elevation.to_radians());
        let wi = Vec3::new(0.6 * cos, -0.8 * cos, sin);
        let expected = f64::from(3.0 * (1.0 + 2.0 * sin) / (7.0 * std::f32::consts::PI));
        let found = f64::from(sky.towards(wi, &wavelengths).0.0[3] / irradiance.at(NM[3]));
        assert_near(found, expected, 2e-3, &format!("{elevation} degrees high"));
    }
}

#[test]
fn a_factor_brightens_sun_and_sky_alike() {
    let usual = day(30.0, 3.0, 0.2);
    let [before, after] = [1.0, 2.5].map(|scale| Daylight { scale, ..usual }.lights());
    for nm in NM {
        let [sun, twice] = [&before, &after].map(|(sun, _)| f64::from(sun.irradiance().at(nm)));
        assert_near(twice, 2.5 * sun, 1e-5, &format!("sun at {nm} nm"));
    }
    let [before, after] = [&before.1, &after.1].map(|sky| irradiance_of_samples(sky, 1 << 12));
    for (before, after) in before.iter().flatten().zip(after.iter().flatten()) {
        assert_near(*after, 2.5 * before, 1e-4, "sky and ground");
    }
}

#[test]
fn a_forest_makes_the_sky_green_on_its_side_alone() {
    let forest = Daylight {
        forest: Some(2.0),
        ..day(50.0, 3.0, 0.2)
    };
    let wavelengths = Wavelengths::new([550.0, 450.0, 660.0, 850.0, 1.0, 1.0, 1.0, 1.0]);
    let (_, sky) = forest.lights();
    let at = |azimuth: f32, elevation: f32| {
        let (sin, cos) = libm::sincosf(elevation.to_radians());
        let (y, x) = libm::sincosf(azimuth);
        sky.towards(Vec3::new(x * cos, y * cos, sin), &wavelengths)
            .0
            .0
    };
    let [green, blue, red, infrared, ..] = at(2.0, 30.0);
    assert!(green > 2.0 * blue && green > 2.0 * red && infrared > 2.0 * green);
    let [green, blue, ..] = at(2.0 + std::f32::consts::PI, 40.0);
    assert!(blue > green, "the open side is blue");
}
