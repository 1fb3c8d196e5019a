//! Walks through uniform leaves against the ordinates of leafmodel, and through maps.

use glam::{Vec2, Vec3};
use optics::layers::{Face, Incidence, LayeredLeaf, Ordinates, Resolution, spread};
use optics::{Constituent, Contents, ProspectD, Texel, presets};

use super::LeafLayers;
use super::walk::{Arrival, Chance, Place, Walk};
use crate::material::contents_texture::ContentsTexture;
use crate::material::held::Held;
use crate::material::palette::Palette;
use crate::spectrum::{Lanes, Wavelengths};

const NOWHERE: Place = Place {
    uv: Vec2::ZERO,
    uv_per_m: [Vec2::ZERO; 2],
};

/// Light that has left: its weight, whether on the other side, how far beside its entry, m.
type Left<const N: usize> = (Lanes<N>, bool, Vec2);

/// Follows one ray through a leaf; `None` if nothing leaves.
fn one<const N: usize>(
    (layers, held): (&LeafLayers, &Held),
    place: Place,
    nm: [f32; N],
    wo: Vec3,
    number: u32,
) -> Option<Left<N>> {
    let palette = Palette::default();
    let lit = usize::from(wo.z < 0.0);
    let wavelengths = Wavelengths::new(nm);
    let mut chance = Chance::new([number as f32, 0.5, nm[0], wo.z]);
    let entry = (lit, 100_000, &mut chance);
    let mut walk = Walk::new(layers, (held, &palette), place, &wavelengths, entry);
    // Faces are seen from outside: +z is air.
    let outside = |w: Vec3, face: usize| {
        if face == 0 {
            w
        } else {
            Vec3::new(w.x, w.y, -w.z)
        }
    };
    let entry = walk.cross(lit, &[outside(wo, lit); N], &mut chance);
    if !entry.through {
        return Some((walk.weight(), false, Vec2::ZERO));
    }
    let mut headings = entry.towards.map(|to| outside(to, lit));
    loop {
        let Arrival { face, headings: at } = walk.to_face(headings, &mut chance)?;
        let from = at.map(|heading| outside(-heading, face));
        let crossed = walk.cross(face, &from, &mut chance);
        if crossed.through {
            return Some((walk.weight(), face != lit, walk.offset()));
        }
        headings = crossed.towards.map(|to| outside(to, face));
    }
}

/// Mean and standard error of what is reflected and transmitted at each wavelength.
fn all_shares<const N: usize>(
    leaf: (&LeafLayers, &Held),
    nm: [f32; N],
    wo: Vec3,
    rays: u32,
) -> [[[f64; 2]; 2]; N] {
    let mut sums = [[[0.0_f64; 2]; 2]; N];
    for number in 0..rays {
        if let Some((weight, through, _)) = one(leaf, NOWHERE, nm, wo, number) {
            for (sums, weight) in sums.iter_mut().zip(weight.0) {
                let weight = f64::from(weight);
                sums[usize::from(through)][0] += weight;
                sums[usize::from(through)][1] += weight * weight;
            }
        }
    }
    let n = f64::from(rays);
    sums.map(|sums| {
        sums.map(|[sum, square]| {
            let mean = sum / n;
            [mean, ((square / n - mean * mean) / n).sqrt()]
        })
    })
}

/// The same of one wavelength.
fn shares(layers: &LeafLayers, held: &Held, nm: f32, wo: Vec3, rays: u32) -> [[f64; 2]; 2] {
    let [one] = all_shares((layers, held), [nm], wo, rays);
    one
}

#[test]
fn each_of_eight_wavelengths_from_violet_to_infrared_is_that_of_the_ordinates() {
    let nm = [400.0_f32, 450.0, 550.0, 680.0, 720.0, 900.0, 1450.0, 2200.0];
    let mut greatest = 0.0_f64;
    for name in ["sun-green", "brown-litter"] {
        let contents = presets::by_name(name).expect("a preset").contents;
        let held = Held::Uniform(contents);
        let layers = LeafLayers::new(&held, [0.0, 0.0]);
        let leaf = LayeredLeaf::new(&contents);
        for (cosine, side, face) in [(1.0, 1.0, Face::First), (0.5, -1.0, Face::Last)] {
            let incidence = Incidence::Directional { cosine };
            let sine = (1.0 - cosine * cosine).sqrt();
            let wo = Vec3::new(sine as f32, 0.0, (side * cosine) as f32);
            let found = all_shares((&layers, &held), nm, wo, 60_000);
            for (nm, found) in nm.into_iter().zip(found) {
                let stack = leaf.stack(&ProspectD::coefficients_extrapolated(f64::from(nm)));
                let solved = Ordinates::new(&stack, Resolution::new(16), &[cosine]);
                let fluxes = solved.expect("solved").fluxes(face, &[incidence]);
                let exact = &fluxes.expect("solved for")[0];
                for ([value, error], exact) in
                    found.into_iter().zip([exact.reflected, exact.transmitted])
                {
                    let z = (value - exact) / error;
                    eprintln!(
                        "{name} {nm} {cosine}: {value:.5} ± {error:.5} for {exact:.5}, {z:.2}"
                    );
                    greatest = greatest.max(z.abs());
                }
            }
        }
    }
    // 64 values: the greatest of so many normal deviates is below 4 in 99.6 %.
    assert!(greatest < 4.0, "{greatest}");
}

#[test]
fn a_uniform_leaf_with_smooth_faces_is_the_layers_of_leafmodel() {
    for name in ["sun-green", "red-maple-scarlet", "brown-litter"] {
        let contents = presets::by_name(name).expect("a preset").contents;
        let held = Held::Uniform(contents);
        let layers = LeafLayers::new(&held, [0.0, 0.0]);
        let leaf = LayeredLeaf::new(&contents);
        for nm in [550.0_f32, 680.0, 800.0] {
            let stack = leaf.stack(&ProspectD::coefficients_extrapolated(f64::from(nm)));
            let solved = Ordinates::new(&stack, Resolution::new(16), &[1.0, 0.5]).expect("solved");
            for (cosine, side, face) in [(1.0, 1.0, Face::First), (0.5, -1.0, Face::Last)] {
                let incidence = Incidence::Directional { cosine };
                let exact = &solved.fluxes(face, &[incidence]).expect("solved for")[0];
                let sine = (1.0 - cosine * cosine).sqrt();
                let wo = Vec3::new(sine as f32, 0.0, (side * cosine) as f32);
                let found = shares(&layers, &held, nm, wo, 60_000);
                for ([value, error], exact) in
                    found.into_iter().zip([exact.reflected, exact.transmitted])
                {
                    let z = (value - exact) / error;
                    assert!(
                        z.abs() < 3.5,
                        "{name} {nm} {cosine}: {value} ± {error} for {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_leaf_that_absorbs_nothing_loses_nothing_however_rough_its_faces() {
    let clear = Contents::NOTHING.with(&[
        (Constituent::Structure, 1.6),
        (Constituent::Water, 1e-9),
        (Constituent::DryMatter, 1e-12),
    ]);
    let held = Held::Uniform(clear);
    for alpha in [0.0, 0.3, 0.9] {
        let layers = LeafLayers::new(&held, [alpha, alpha]);
        for wo in [Vec3::Z, Vec3::new(0.8, 0.0, -0.6)] {
            for number in 0..3000 {
                let (weight, ..) =
                    one((&layers, &held), NOWHERE, [550.0], wo, number).expect("all light leaves");
                assert!((weight.0[0] - 1.0).abs() < 1e-4, "{alpha}: {}", weight.0[0]);
            }
        }
    }
}

#[test]
fn a_leaf_without_water_and_dry_matter_is_that_of_the_ordinates() {
    let nothing = Contents::NOTHING.with(&[(Constituent::Structure, 1.5)]);
    let green = nothing.with(&[(Constituent::Chlorophyll, 40.0)]);
    let hair = nothing.with(&[(Constituent::Water, 1e-30)]);
    for contents in [nothing, green, hair] {
        let held = Held::Uniform(contents);
        let layers = LeafLayers::new(&held, [0.0, 0.0]);
        let at = ProspectD::coefficients(550.0).expect("in the table");
        let [exact, _] = LayeredLeaf::new(&contents)
            .faces(&at, Resolution::FAST)
            .normal;
        let found = shares(&layers, &held, 550.0, Vec3::Z, 20_000);
        for ([value, error], exact) in found.into_iter().zip([exact.reflected, exact.transmitted]) {
            let z = (value - exact) / error;
            assert!(z.abs() < 3.5, "{value} ± {error} for {exact}");
        }
    }
    // As `lamina optics --layers` has it.
    let [reflected, transmitted] = shares(
        &LeafLayers::new(&Held::Uniform(nothing), [0.0, 0.0]),
        &Held::Uniform(nothing),
        550.0,
        Vec3::Z,
        20_000,
    );
    assert!((reflected[0] - 0.503).abs() < 0.015 && (transmitted[0] - 0.497).abs() < 0.015);
}

#[test]
fn a_map_of_one_value_is_the_uniform_leaf() {
    let contents = presets::by_name("sun-green").expect("a preset").contents;
    let map = ContentsTexture::new(4, 4, vec![contents.to_texel(); 16]);
    let [uniform, mapped] = [Held::Uniform(contents), Held::Map(map)].map(|held| {
        let layers = LeafLayers::new(&held, [0.3, 0.3]);
        shares(&layers, &held, 550.0, Vec3::Z, 40_000)
    });
    for ([one, first], [other, second]) in uniform.into_iter().zip(mapped) {
        let error = first.hypot(second);
        assert!((one - other).abs() < 3.5 * error, "{one} {other} ± {error}");
    }
}

#[test]
fn light_spreads_sideways_across_a_step_of_pigment() {
    // Without pigment left of the middle, with much right of it; 1 mm wide. Light that enters in
    // the clear half is the less the nearer to the step it enters, and light that enters in the
    // dark half gets more through than deep in it.
    let green = presets::by_name("sun-green").expect("a preset").contents;
    let clear = green.with(&[
        (Constituent::Chlorophyll, 0.0),
        (Constituent::Carotenoids, 0.0),
    ]);
    let columns = 64;
    let texels: Vec<Texel> = (0..columns)
        .map(|column| if column < 32 { clear } else { green }.to_texel())
        .collect();
    let held = Held::Map(ContentsTexture::new(columns, 1, texels));
    let layers = LeafLayers::new(&held, [0.0, 0.0]);
    let rays = 20_000;
    let through = |x_mm: f32| {
        let place = Place {
            uv: Vec2::new(0.5 + x_mm, 0.5),
            uv_per_m: [Vec2::new(1000.0, 0.0), Vec2::ZERO],
        };
        let sum: f64 = (0..rays)
            .filter_map(|number| one((&layers, &held), place, [680.0], Vec3::Z, number))
            .filter(|(_, through, _)| *through)
            .map(|(weight, ..)| f64::from(weight.0[0]))
            .sum();
        sum / f64::from(rays)
    };
    let found = [-0.45, -0.1, -0.03, 0.03, 0.1, 0.45].map(through);
    assert!(found.is_sorted_by(|one, other| one > other), "{found:?}");
    // Far from the step both are uniform leaves.
    for (found, contents) in [(found[0], clear), (found[5], green)] {
        let leaf = LayeredLeaf::new(&contents);
        let at = ProspectD::coefficients(680.0).expect("in the table");
        let [exact, _] = leaf.faces(&at, Resolution::FAST).normal;
        let off = (found - exact.transmitted).abs();
        assert!(
            off < 0.02 * exact.transmitted + 0.004,
            "{found} for {exact:?}"
        );
    }
}

#[test]
fn light_comes_as_far_sideways_as_the_photons_of_leafmodel() {
    let contents = presets::by_name("sun-green").expect("a preset").contents;
    let held = Held::Uniform(contents);
    let layers = LeafLayers::new(&held, [0.0, 0.0]);
    let leaf = LayeredLeaf::new(&contents);
    let thickness_mm = layers.thickness_m.map(|m| 1e3 * f64::from(m));
    for (nm, wo, face) in [
        (550.0_f32, Vec3::Z, Face::First),
        (800.0, Vec3::NEG_Z, Face::Last),
    ] {
        let stack = leaf.stack(&ProspectD::coefficients_extrapolated(f64::from(nm)));
        let exact = spread(&stack, &thickness_mm, face, Incidence::NORMAL, 200_000, 5)
            .expect("the normal is in range");
        // Weight, weight × distance², and the squares for the error of their ratio.
        let mut sums = [[0.0_f64; 5]; 2];
        for number in 0..60_000 {
            if let Some((weight, through, offset)) =
                one((&layers, &held), NOWHERE, [nm], wo, number)
            {
                let w = f64::from(weight.0[0]);
                let far = w * 1e6 * f64::from(offset.length_squared());
                let sum = &mut sums[usize::from(through)];
                for (sum, term) in sum.iter_mut().zip([w, far, w * w, w * far, far * far]) {
                    *sum += term;
                }
            }
        }
        for ([w, far, ww, wf, ff], exact) in
            sums.into_iter().zip([exact.reflected, exact.transmitted])
        {
            let value = far / w;
            let error = (ff - 2.0 * value * wf + value * value * ww).sqrt() / w;
            let z = (value - exact.value) / error.hypot(exact.standard_error);
            eprintln!("{nm} nm: {value:.5} ± {error:.5} mm², {exact:?}, z {z:.2}");
            assert!(z.abs() < 3.5, "{nm}: {value} ± {error} for {exact:?}");
        }
    }
}
