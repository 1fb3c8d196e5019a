use optics::pigments::{AnthocyaninMix, ChlorophyllMix};
use optics::{Contents, Pigments, presets};

use super::*;
use crate::material::contents_texture::ContentsTexture;
use crate::material::palette::Palettes;
use crate::simd::Level;
use crate::spectrum::recorded::FilmKind;
use crate::spectrum::{Lanes, WavelengthSampler};
use glam::Vec3;

fn at(nm: f32) -> Wavelengths<4> {
    Wavelengths::new([nm; 4])
}

fn palettes() -> [Pigments; 6] {
    std::array::from_fn(|i| match i {
        0 => Pigments::default(),
        1 => Pigments {
            chlorophyll: Some(ChlorophyllMix::bands(3.1)),
            ..Pigments::default()
        },
        _ => Pigments {
            anthocyanins: Some(AnthocyaninMix {
                shares: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
                shift_nm: 5.0 * i as f64,
                blue_fraction: 0.0,
            }),
            ..Pigments::default()
        },
    })
}

#[test]
fn tissue_has_the_same_bits_at_every_level_of_instructions() {
    let green = presets::by_name("sun-green").expect("a preset").contents;
    let texels = (0..32 * 32).map(|i| {
        let share = (i * 7 % 32) as f32 / 31.0;
        green.to_texel().map(|held| held * (0.7 + 0.3 * share))
    });
    let map = ContentsTexture::new(32, 32, texels.collect());
    let coats = [Coat::new(1.45, 0.3, 0.3), Coat::new(1.38, 0.5, 0.4)];
    let sampler = WavelengthSampler::new(&FilmKind::Rgb {
        range_nm: [400.0, 2500.0],
        observer: crate::spectrum::observer::Observer::Cie1931,
    });
    let wavelengths = sampler.draw::<8>(0.3, 0);
    let of = |level: Level| {
        let mut palettes = Palettes::on(sampler.grid());
        let palette = palettes.of(&Pigments::default()).at_level(level);
        let tissue = LeafTissue::Held(Held::Map(map.clone()));
        let mut leaf =
            LeafMaterial::new(tissue, palette, None, coats.clone()).spreading(Vec2::splat(0.05));
        leaf.tabulate(sampler.grid());
        let at = |i: usize| {
            let uv = Vec2::new(0.618_034 * i as f32, 0.414_214 * i as f32).fract();
            let lanes = leaf.tissue_at(uv, &wavelengths).to_lanes();
            lanes.map(|lanes| lanes.0.map(f32::to_bits))
        };
        (0..200).map(at).collect::<Vec<_>>()
    };
    let levels = Level::all();
    let first = of(levels[0]);
    assert!(first.iter().any(|tissue| *tissue != first[0]));
    for level in &levels[1..] {
        assert_eq!(of(*level), first, "{}", level.name());
    }
}

#[test]
fn along_a_path_prospect_gives_what_the_exact_model_gives() {
    let green = Contents::new(1.6, 45.0, 10.0, 0.5, 0.1, 0.011, 0.006).expect("a leaf");
    let mut known = Palettes::default();
    for pigments in &palettes()[..3] {
        let palette = known.of(pigments);
        for step in 0..1000 {
            let nm = 395.0 + 2.13 * step as f32;
            let held = green.to_texel();
            let (r, t) = palette.lanes(&at(nm)).reflectance_transmittance(&held);
            let exact = ProspectD::coefficients_of(pigments, f64::from(nm))
                .reflectance_transmittance(&green);
            assert!(
                (f64::from(r[0]) - exact.reflectance).abs() < 1e-6,
                "R at {nm} nm"
            );
            assert!(
                (f64::from(t[3]) - exact.transmittance).abs() < 1e-6,
                "T at {nm} nm"
            );
        }
    }
}

#[test]
fn tabulated_leaves_are_what_they_are_at_any_wavelength() {
    let red = Contents::new(1.6, 5.0, 5.0, 20.0, 0.1, 0.011, 0.006).expect("a leaf");
    let sampler = WavelengthSampler::new(&FilmKind::Rgb {
        range_nm: [400.0, 780.0],
        observer: crate::spectrum::observer::Observer::Cie1931,
    });
    let mut known = Palettes::on(sampler.grid());
    let texel = red.to_texel();
    for pigments in &palettes() {
        for tissue in [
            LeafTissue::Held(Held::Uniform(red)),
            LeafTissue::Held(Held::Map(ContentsTexture::new(1, 1, vec![texel]))),
        ] {
            let mut leaf = LeafMaterial::new(
                tissue,
                known.of(pigments),
                Some(Abaxial::Ratio(
                    Curve::from_points(&[(400.0, 1.7), (700.0, 1.0)]).into(),
                )),
                [Coat::new(1.45, 0.3, 0.3), Coat::new(1.4, 0.4, 0.4)],
            );
            leaf.tabulate(sampler.grid());
            for u in [0.0, 0.3, 0.999] {
                let drawn = sampler.draw::<8>(u, 0);
                let free = Wavelengths::new(drawn.nm);
                let (wo, wi) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, -0.8));
                for wi in [wi, -wi] {
                    let got = leaf.bsdf_at(&Site::of(Vec2::ZERO), &drawn).eval(wo, wi);
                    let expected = leaf.bsdf_at(&Site::of(Vec2::ZERO), &free).eval(wo, wi);
                    for lane in 0..8 {
                        let error = (got.0[lane] - expected.0[lane]).abs();
                        assert!(error <= 1e-7, "{} nm: {error}", drawn.nm[lane]);
                    }
                }
            }
        }
    }
}

#[test]
fn whether_a_coat_reflects_too_much_is_a_matter_of_the_palette() {
    // In the blue form anthocyanins absorb at 655 nm, where PROSPECT-D's hardly do.
    let red = Contents::new(2.0, 0.0, 0.0, 100.0, 0.0, 0.0, 0.0).expect("a leaf");
    let mut known = Palettes::default();
    let mut exceeds = |pigments: &Pigments| {
        let leaf = LeafMaterial::new(
            LeafTissue::Held(Held::Uniform(red)),
            known.of(pigments),
            Some(Abaxial::Ratio(Curve::Constant(1.0).into())),
            [Coat::new(1.6, 0.3, 0.3), Coat::new(1.6, 0.3, 0.3)],
        );
        leaf.coat_exceeds_reflectance([655.0, 660.0]).is_some()
    };
    let blue = Pigments {
        anthocyanins: Some(AnthocyaninMix {
            shares: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0],
            shift_nm: 0.0,
            blue_fraction: 1.0,
        }),
        ..Pigments::default()
    };
    assert!(!exceeds(&Pigments::default()));
    assert!(exceeds(&blue));
}

/// What the adaxial and the abaxial face absorb of light at normal incidence.
fn absorbed(coats: &[Coat; 2], r: f64, t: f64) -> [f32; 2] {
    let [r, t] = [r, t].map(|share| Lanes([share as f32]));
    let tissue = Tissue::new(coats, &LeafShape::EVEN, r, t, usual_abaxial_ratio(r, t));
    let [r_a, r_b, t_ab, t_ba, ..] = tissue.to_lanes().map(|lanes| lanes.0[0]);
    let passed = coats.each_ref().map(|coat| 1.0 - coat.albedo().normal());
    [
        passed[0] * (1.0 - r_a - t_ab),
        passed[1] * (1.0 - r_b - t_ba),
    ]
}

#[test]
fn the_usual_ratio_of_green_leaves_is_the_measured_mean() {
    // Noda et al., 19 groups of broad leaves.
    let measured = [(450.0, 1.74), (550.0, 1.55), (680.0, 1.65), (800.0, 0.97)];
    let green = ["sun-green", "shade-thin", "dark-evergreen"].map(|name| {
        let preset = presets::by_name(name);
        preset.expect("a preset").contents
    });
    for (nm, expected) in measured {
        let at = ProspectD::coefficients(nm).expect("a wavelength in range");
        let ratios = green.map(|contents| {
            let leaf = at.reflectance_transmittance(&contents);
            let [r, t] = [leaf.reflectance, leaf.transmittance].map(|share| Lanes([share as f32]));
            f64::from(usual_abaxial_ratio(r, t).0[0])
        });
        let mean = ratios.iter().sum::<f64>() / 3.0;
        assert!((mean / expected - 1.0).abs() < 0.05, "{mean} at {nm} nm");
    }
}

#[test]
fn the_usual_ratio_takes_absorption_from_neither_face() {
    let coats = [Coat::new(1.45, 0.3, 0.3), Coat::new(1.45, 0.45, 0.45)];
    let mut least = f32::INFINITY;
    for preset in presets::ALL {
        for nm in 400..=2500 {
            let leaf = ProspectD::coefficients(f64::from(nm))
                .expect("a wavelength in range")
                .reflectance_transmittance(&preset.contents);
            let [above, below] = absorbed(&coats, leaf.reflectance, leaf.transmittance);
            assert!(above > 0.0, "{} at {nm} nm", preset.name);
            assert!(
                below >= 0.63 * above,
                "{} at {nm} nm: {below} of {above}",
                preset.name
            );
            least = least.min(below / above);
        }
    }
    // The bound is that of leaves that let nothing through; these do.
    assert!((0.75..1.0).contains(&least), "{least}");
    let [above, below] = absorbed(&coats, 0.45, 0.40);
    assert!((above - 0.15).abs() < 1e-5, "{above}");
    assert!((0.12..0.15).contains(&below), "{below}");
}

#[test]
fn the_albedo_is_that_of_the_face_seen() {
    let leaf = LeafMaterial::new(
        LeafTissue::Measured {
            reflectance: Curve::Constant(0.1),
            transmittance: Curve::Constant(0.1),
        },
        Palette::default(),
        None,
        [Coat::new(1.0, 0.3, 0.3), Coat::new(1.0, 0.3, 0.3)],
    );
    let bsdf = leaf.bsdf_at(&Site::of(Vec2::ZERO), &at(550.0));
    // A = 0.8: ρ = 1.6272.
    let [above, below] = [Vec3::Z, -Vec3::Z].map(|wo| bsdf.albedo(wo).0[0]);
    // Of diffuse light a little less goes through, and more is sent back by the lower face.
    assert!((above - 0.2).abs() < 0.02, "{above}");
    assert!((below - 0.262_72).abs() < 0.02, "{below}");
}

#[test]
fn a_measured_abaxial_face_reflects_what_was_measured_even_where_the_other_is_black() {
    let line = |points: &[(f64, f64)]| Curve::from_points(points);
    let abaxial = line(&[(400.0, 0.3), (700.0, 0.3)]);
    let leaf = LeafMaterial::new(
        LeafTissue::Measured {
            reflectance: line(&[(400.0, 0.0), (500.0, 0.0), (501.0, 0.5), (700.0, 0.5)]),
            transmittance: Curve::Constant(0.1),
        },
        Palette::default(),
        Some(Abaxial::Reflectance(abaxial.into())),
        [Coat::new(1.0, 0.3, 0.3), Coat::new(1.0, 0.3, 0.3)],
    );
    for nm in [450.0, 500.0, 500.3, 500.5, 500.9, 600.0] {
        let [_, r_b, _, t_ba, ..] = leaf.tissue_at(Vec2::ZERO, &at(nm)).to_lanes();
        assert!((r_b.0[0] - 0.3).abs() < 1e-6 && (t_ba.0[0] - 0.1).abs() < 1e-6);
        let bsdf = leaf.bsdf_at(&Site::of(Vec2::ZERO), &at(nm));
        let below = bsdf.albedo(-Vec3::Z).0[0];
        assert!((below - 0.4).abs() < 0.03, "{nm} nm: {below}");
    }
}
