//! Solid tissue as a material: the half-space is given back, whatever the coat.

use glam::{Vec2, Vec3};
use leafmodel::optics::solid::{ETA, HalfSpace, ReflectanceTable, SCATTERING_PER_MM, Solid};
use leafmodel::optics::{Constituent, Contents, ProspectD};
use renderer::bsdf::Bsdf;
use renderer::bsdf::leaf::Coat;
use renderer::material::Material;
use renderer::material::held::Held;
use renderer::material::palette::Palette;
use renderer::material::solid::{ReflectanceTables, SolidMaterial};
use renderer::sampling::stream::Stream;
use renderer::spectrum::Wavelengths;
use support::chi_square::{ChiSquare, sidak};
use support::directional::{Scattered, directions, integrate};
use support::picture::{mean_of, picture_of};

const POINTS: u32 = 1 << 15;
/// Lanes differ, so that one that leaks into another is seen.
const WAVELENGTHS_NM: [f32; 4] = [550.0, 680.0, 850.0, 1450.0];

fn rind() -> Contents {
    Contents::new(1.0, 7.0, 3.0, 0.0, 0.0, 0.09, 0.008).expect("contents in range")
}

fn material(contents: Contents, optics: Solid, coat: Coat) -> Material {
    let table = ReflectanceTables::default().of(optics.eta);
    let held = Held::Uniform(contents);
    Material::Solid(Box::new(SolidMaterial::new(
        held,
        Palette::default(),
        optics,
        table,
        coat,
    )))
}

fn wavelengths() -> Wavelengths<4> {
    Wavelengths::new(WAVELENGTHS_NM)
}

fn fruit() -> Solid {
    Solid {
        depth_mm: 1.0,
        scattering_per_mm: SCATTERING_PER_MM,
        eta: ETA,
    }
}

fn smooth(eta: f64) -> Coat {
    Coat::new(eta as f32, 0.02, 0.02)
}

fn scattered(bsdf: &Bsdf<'_, 4>, wo: Vec3, lane: usize) -> Scattered {
    integrate(wo, POINTS, |lobe, u| {
        let sample = bsdf.sample(wo, lobe, u)?;
        Some((sample.wi, f64::from(sample.weight.0[lane])))
    })
}

/// Share of Lambertian light that comes back.
fn diffuse(bsdf: &Bsdf<'_, 4>, lane: usize) -> f64 {
    let steps = 32;
    let share = |step: u32| {
        // Cosines at equal flux.
        let mu = ((f64::from(step) + 0.5) / f64::from(steps)).sqrt() as f32;
        let wo = Vec3::new((1.0 - mu * mu).sqrt(), 0.0, mu);
        scattered(bsdf, wo, lane).reflected
    };
    (0..steps).map(share).sum::<f64>() / f64::from(steps)
}

/// Rows of half-spaces in the table of anchors: index, albedo, reflectance at normal and at diffuse
/// incidence.
fn anchors() -> Vec<[f64; 4]> {
    let table = include_str!("data/transport_anchors.csv");
    let rows = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let half_spaces = rows.filter(|row| row.len() == 15 && row[3] == "inf");
    let number = |text: &str| text.parse().expect("a number");
    half_spaces
        .map(|row| [row[1], row[2], row[10], row[12]].map(number))
        .collect()
}

/// A material whose albedo at 1450 nm, in the last lane, is this, by its water alone.
fn watery(optics: Solid, albedo: f64, coat: Coat) -> Material {
    let at = ProspectD::coefficients(1450.0).expect("in range");
    let absorbed = optics.scattering_per_mm * (1.0 - albedo) / albedo;
    let water_cm = absorbed * optics.depth_mm / at.absorption[Constituent::Water];
    let contents = Contents::new(1.0, 0.0, 0.0, 0.0, 0.0, water_cm, 0.0).expect("in range");
    material(contents, optics, coat)
}

#[test]
fn the_material_gives_back_the_half_spaces_of_the_anchors() {
    let anchors = anchors();
    assert_eq!(anchors.len(), 5);
    for [eta, albedo, normal, _] in anchors {
        let material = watery(Solid { eta, ..fruit() }, albedo, smooth(eta));
        let wavelengths = wavelengths();
        let bsdf = material.bsdf(Vec2::ZERO, &wavelengths);
        let found = scattered(&bsdf, Vec3::Z, 3);
        eprintln!("n = {eta}, a = {albedo}: {found:?} for {normal}");
        assert!(
            (found.reflected - normal).abs() < 1e-4,
            "{eta} {albedo}: {found:?}"
        );
        assert_eq!(found.transmitted, 0.0);
    }
}

#[test]
fn under_diffuse_light_the_material_is_somewhat_darker_than_the_half_space() {
    // The half-space reflects more at grazing incidence than a Lambertian tissue: what the model
    // leaves out, in figures.
    let space = HalfSpace::new(ETA);
    for albedo in [0.5, 0.9, 0.99, 0.999] {
        let material = watery(fruit(), albedo, smooth(ETA));
        let wavelengths = wavelengths();
        let bsdf = material.bsdf(Vec2::ZERO, &wavelengths);
        let (found, exact) = (diffuse(&bsdf, 3), space.reflected(albedo, 0.0));
        let short = 1.0 - found / exact.diffuse;
        eprintln!(
            "a = {albedo}: R = {:.4}, diffuse {found:.4} for {:.4}, {:.1} % short",
            exact.normal,
            exact.diffuse,
            100.0 * short
        );
        assert!((0.0..0.07).contains(&short), "{albedo}: {short}");
    }
}

#[test]
fn an_integrating_sphere_finds_the_tables_reflectance_below_any_coat() {
    let table = ReflectanceTable::new(ETA, 0.0);
    for coat in [
        smooth(1.33),
        Coat::new(ETA as f32, 0.3, 0.3),
        Coat::new(1.45, 0.6, 0.6),
    ] {
        let material = material(rind(), fruit(), coat);
        for (lane, nm) in WAVELENGTHS_NM.map(f64::from).into_iter().enumerate() {
            let wavelengths = wavelengths();
            let bsdf = material.bsdf(Vec2::ZERO, &wavelengths);
            let at = ProspectD::coefficients(nm).expect("in range");
            let expected = table.at(fruit().albedo_of(at.absorption_of_leaf(&rind())));
            for wo in [Vec3::Z, Vec3::NEG_Z] {
                let found = scattered(&bsdf, wo, lane);
                assert!(
                    (found.reflected - expected).abs() < 1e-3 && found.transmitted == 0.0,
                    "{nm} nm: {found:?}, not {expected}"
                );
            }
        }
    }
}

#[test]
fn tissue_that_absorbs_nothing_is_invisible_in_a_white_furnace() {
    let nothing = Contents::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0).expect("in range");
    for alpha in [0.1, 0.3, 0.8] {
        let material = material(nothing, fruit(), Coat::new(1.45, alpha, alpha));
        let wavelengths = wavelengths();
        let bsdf = material.bsdf(Vec2::ZERO, &wavelengths);
        for wo in directions() {
            let found = scattered(&bsdf, wo, 1);
            assert!(
                (found.total() - 1.0).abs() < 1e-3,
                "{alpha} {wo}: {found:?}"
            );
        }
    }
}

#[test]
fn solid_tissue_is_reciprocal_and_sends_nothing_through() {
    let material = material(rind(), fruit(), Coat::new(1.4, 0.2, 0.2));
    let wavelengths = wavelengths();
    let bsdf = material.bsdf(Vec2::ZERO, &wavelengths);
    for i in 0..5000 {
        let [a, b, c, d] = Stream::new(3, 0, 0, i).next4();
        let direction = |u: f32, v: f32| {
            let z = 1.0 - 2.0 * u;
            let phi = 2.0 * std::f32::consts::PI * v;
            let radius = (1.0 - z * z).sqrt();
            Vec3::new(radius * phi.cos(), radius * phi.sin(), z)
        };
        let (wo, wi) = (direction(a, b), direction(c, d));
        let (there, back) = (bsdf.eval(wo, wi).0[2], bsdf.eval(wi, wo).0[2]);
        assert!((there - back).abs() <= 1e-4 * there.max(back), "{wo} {wi}");
        assert!(wo.z * wi.z > 0.0 || there == 0.0, "{wo} {wi}: {there}");
    }
}

#[test]
fn solid_tissue_is_sampled_as_its_density_says() {
    const CHI_SQUARE: ChiSquare = ChiSquare {
        rings: 20,
        spokes: 40,
        draws: 200_000,
        midpoints: 24,
    };
    let directions = [
        Vec3::Z,
        Vec3::new(-0.8, 0.36, 0.48),
        Vec3::new(0.48, -0.6, -0.64),
    ];
    let level = sidak(0.01, directions.len());
    let material = material(rind(), fruit(), Coat::new(1.38, 0.25, 0.25));
    let wavelengths = wavelengths();
    let bsdf = material.bsdf(Vec2::ZERO, &wavelengths);
    for (number, wo) in directions.into_iter().enumerate() {
        let outcome = CHI_SQUARE.run(
            |draw| {
                let [lobe, x, y, _] = Stream::new(number as u64, draw as u32, 0, 0).next4();
                let sample = bsdf.sample(wo, lobe, Vec2::new(x, y));
                sample.map(|sample| sample.wi)
            },
            |wi| bsdf.pdf(wo, wi),
        );
        assert!(outcome.p_value > level, "wo = {wo}: {outcome}");
    }
}

#[test]
fn a_body_that_absorbs_nothing_is_invisible_under_an_even_sky_and_a_pigmented_one_is_not() {
    let scene = |contents: &str| {
        format!(
            "format = 1\n[film.spectral]\nsize = [16, 16]\nspp = 16\nbands_nm = [680, 750]\nband_width_nm = 0\n\
             [camera.perspective]\nposition_m = [0, -1, 0.3]\nlook_at_m = [0, 0, 0]\nvertical_fov_deg = 8\n\
             [integrator]\nroulette_below = 0\n[lights.sky.constant]\nradiance_w_m2_sr_nm = 2\n\
             [solids.fruit]\nmap_size = 64\n[solids.fruit.shape.rounded_cube]\nside_mm = 80\ncorner_radius_mm = 20\n\
             [solids.fruit.contents]\n{contents}\n[objects.fruit]\nsolid = \"fruit\"\n"
        )
    };
    let bare = picture_of(&scene(""), 1);
    for channel in 0..2 {
        // Standard error some 2e-3: light samples and bounces are weighed against each other.
        let mean = mean_of(&bare, channel);
        assert!((mean - 2.0).abs() < 8e-3, "{mean}");
    }
    let green = picture_of(&scene("chlorophyll_ug_per_cm2 = 30"), 1);
    let (red, infrared) = (mean_of(&green, 0), mean_of(&green, 1));
    assert!(red < 0.8 * infrared && infrared < 2.0, "{red} {infrared}");
}
