//! Every preset of leaf colours at every angle and roughness: nothing is made, what is not absorbed
//! comes back, and both ways are one.

use glam::{Vec2, Vec3};
use leafmodel::optics::ProspectD;
use leafmodel::optics::presets::ALL;
use renderer::bsdf::leaf::{Coat, LeafBsdf, LeafShape, Tissue, usual_abaxial_ratio};
use renderer::sampling::stream::Stream;
use renderer::spectrum::Lanes;
use support::directional::directions;

const POINTS: u32 = 1 << 13;
const ROUGHNESSES: [f32; 5] = [0.05, 0.15, 0.3, 0.6, 1.0];
/// From the blue to the water bands, nm.
const NM: [f64; 8] = [450.0, 550.0, 680.0, 720.0, 800.0, 1200.0, 1650.0, 2200.0];

fn coats(alpha: f32) -> [Coat; 2] {
    [
        Coat::new(1.45, alpha, alpha),
        Coat::new(1.4, (1.5 * alpha).min(1.0), alpha),
    ]
}

/// R and T of a preset by lanes.
fn spectra(contents: &leafmodel::optics::Contents) -> [Lanes<8>; 2] {
    let at = |lane: usize| {
        let coefficients = ProspectD::coefficients(NM[lane]).expect("within the table");
        coefficients.reflectance_transmittance(contents)
    };
    [
        Lanes::from_fn(|lane| at(lane).reflectance as f32),
        Lanes::from_fn(|lane| at(lane).transmittance as f32),
    ]
}

/// All light that a leaf scatters from a direction, by lanes.
fn scattered(leaf: &LeafBsdf<'_, 8>, wo: Vec3) -> [f64; 8] {
    let mut sums = [0.0; 8];
    for point in 0..POINTS {
        let [lobe, x, y, _] = Stream::new(17, 0, 0, point).next4();
        if let Some(sample) = leaf.sample(wo, lobe, Vec2::new(x, y)) {
            for (sum, weight) in sums.iter_mut().zip(sample.weight.0) {
                *sum += f64::from(weight) / f64::from(POINTS);
            }
        }
    }
    sums
}

/// Of what passes the coat the tissue absorbs what it does of light along the normal, and of light at
/// a slant a little less, since it is scattered nearer to the face, to as much more as it lets less
/// through.
#[test]
fn every_preset_absorbs_what_its_faces_say_at_every_angle_and_roughness() {
    assert!(ALL.len() >= 19, "{}", ALL.len());
    let (mut worst, mut compared, mut bounded) = (0.0_f64, 0, 0);
    for alpha in ROUGHNESSES {
        let coats = coats(alpha);
        for preset in &ALL {
            let [r, t] = spectra(&preset.contents);
            let ratio = usual_abaxial_ratio(r, t);
            let shape = LeafShape::of(&preset.contents);
            let tissue = Tissue::new(&coats, &shape, r, t, ratio);
            let leaf = LeafBsdf::new(&coats, &shape, tissue);
            for wo in directions() {
                let found = scattered(&leaf, wo);
                let face = usize::from(wo.z < 0.0);
                let albedo = coats[face].albedo();
                let [normal, here] = [albedo.normal(), albedo.at(wo)].map(f64::from);
                for lane in 0..8 {
                    let [r, t, ratio] = [r, t, ratio].map(|of| f64::from(of.0[lane]));
                    let reflected = if face == 0 { r } else { ratio * r };
                    let name = preset.name;
                    let total = found[lane];
                    assert!(total < 1.0 + 1e-3, "{name} {alpha} {wo}: {total}");
                    // A coat that alone reflects more than the leaf is told of by the program.
                    if r < f64::from(coats[0].albedo().normal()) + 1e-3 {
                        bounded += 1;
                        continue;
                    }
                    let along = (1.0 - reflected - t) / (1.0 - normal);
                    let found = (1.0 - total) / (1.0 - here);
                    compared += 1;
                    if wo.z.abs() > 0.999 {
                        worst = worst.max((found - along).abs());
                        assert!(
                            (found - along).abs() < 2e-3,
                            "{name}, roughness {alpha}, {} nm, {wo}: {found} for {along}",
                            NM[lane]
                        );
                    }
                    let bounds = 0.68 * along - 2e-3..(1.0 + 0.6 * t) * along + 4e-3;
                    assert!(
                        bounds.contains(&found),
                        "{name}, roughness {alpha}, {} nm, {wo}: {found} for {along}",
                        NM[lane]
                    );
                }
            }
        }
    }
    eprintln!("{compared} compared, {bounded} bounded, greatest deviation {worst:.1e}");
    assert!(compared > 5 * bounded);
}

#[test]
fn every_preset_is_reciprocal_at_every_roughness() {
    let mut worst = 0.0_f32;
    for alpha in ROUGHNESSES {
        let coats = coats(alpha);
        for (number, preset) in ALL.iter().enumerate() {
            let [r, t] = spectra(&preset.contents);
            let ratio = usual_abaxial_ratio(r, t);
            let shape = LeafShape::of(&preset.contents);
            let tissue = Tissue::new(&coats, &shape, r, t, ratio);
            let leaf = LeafBsdf::new(&coats, &shape, tissue);
            for i in 0..400 {
                let [a, b, c, d] = Stream::new(23, number as u32, 0, i).next4();
                let direction = |u: f32, v: f32| {
                    let z = 1.0 - 2.0 * u;
                    let (sin, cos) = libm::sincosf(std::f32::consts::TAU * v);
                    let radius = (1.0 - z * z).sqrt();
                    Vec3::new(radius * cos, radius * sin, z)
                };
                let (wo, wi) = (direction(a, b), direction(c, d));
                let (there, back) = (leaf.eval(wo, wi), leaf.eval(wi, wo));
                for (there, back) in there.0.into_iter().zip(back.0) {
                    let off = (there - back).abs() / there.max(back).max(1e-6);
                    worst = worst.max(off);
                    assert!(off <= 1e-4, "{}: {wo} {wi}: {there} {back}", preset.name);
                }
            }
        }
    }
    eprintln!("greatest relative difference {worst:.1e}");
}
