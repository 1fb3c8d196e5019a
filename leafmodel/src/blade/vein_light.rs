//! How much green tissue a texel holds that a vein fills in part.
//!
//! Light that leaves tissue is not linear in what the tissue holds: half a texel of green tissue and
//! half of clear shine more than a whole one with half of the green. So a texel of a coarse map holds
//! the chlorophyll that makes as much light leave it as leaves vein and lamina in the mean.
//!
//! - **Always true**: a texel within a vein, or without any, holds what is there.

use crate::optics::{Constituent, Contents, Pigments, ProspectD};

use super::vein_cover::VeinCover;

/// Wavelength, nm, at which the light is the same. One content can give the mean light of two at one
/// wavelength only: with 560 the red of a maple with 400 texels is too dark by some 10 %, with 650 its
/// green too light by some 6 %.
const NM: f64 = 590.0;

/// Chlorophyll up to which light is tabulated, µg/cm². More than that changes next to nothing.
const MOST: f64 = 160.0;

/// Steps of the table.
const STEPS: usize = 1280;

/// Light that leaves tissue on both sides, by its chlorophyll.
#[derive(Clone, Debug)]
pub(super) struct VeinLight {
    /// R + T at [`NM`] for the chlorophyll 0, `MOST / STEPS` and so on; falling.
    light: Vec<f64>,
}

impl VeinLight {
    /// For tissue that holds, besides chlorophyll, what `lamina` does.
    pub(super) fn of(lamina: &Contents) -> Self {
        let at = ProspectD::coefficients_of(&Pigments::default(), NM);
        let light = (0..=STEPS).map(|step| {
            let mut held = *lamina;
            held[Constituent::Chlorophyll] = step as f64 * (MOST / STEPS as f64);
            let light = at.reflectance_transmittance(&held);
            light.reflectance + light.transmittance
        });
        Self {
            light: light.collect(),
        }
    }

    /// The same cover with the weight that chlorophyll and carotenoids have where the lamina holds
    /// `chlorophyll` and a full vein `factor` times as much.
    pub(super) fn seen(&self, cover: VeinCover, chlorophyll: f64, factor: f64) -> VeinCover {
        let change = (factor - 1.0) * chlorophyll;
        if cover.share >= 1.0 || change == 0.0 || chlorophyll > MOST {
            return cover;
        }
        let vein = chlorophyll + change * (cover.weight / cover.share);
        let light =
            (1.0 - cover.share) * self.light_of(chlorophyll) + cover.share * self.light_of(vein);
        let greens = (self.chlorophyll_of(light) - chlorophyll) / change;
        VeinCover {
            greens: greens.clamp(0.0, 1.0),
            ..cover
        }
    }

    fn light_of(&self, chlorophyll: f64) -> f64 {
        let place = chlorophyll.clamp(0.0, MOST) * (STEPS as f64 / MOST);
        let below = (place as usize).min(STEPS - 1);
        let share = place - below as f64;
        self.light[below] + share * (self.light[below + 1] - self.light[below])
    }

    fn chlorophyll_of(&self, light: f64) -> f64 {
        let above = self.light.partition_point(|&other| other > light);
        let above = above.clamp(1, STEPS);
        let (more, less) = (self.light[above - 1], self.light[above]);
        let share = if more > less {
            ((more - light) / (more - less)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        ((above - 1) as f64 + share) * (MOST / STEPS as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tissue::tests::GREEN;
    use super::*;
    use crate::blade::contents_map::ContentsMap;
    use crate::blade::frame::UvFrame;
    use crate::optics::Texel;
    use crate::venation::network::VeinSegment;
    use glam::DVec2;

    fn light(held: &Contents, nm: f64) -> f64 {
        let at = ProspectD::coefficients(nm).expect("in range");
        let both = at.reflectance_transmittance(held);
        both.reflectance + both.transmittance
    }

    #[test]
    fn a_vein_in_a_part_of_a_texel_gives_the_mean_light() {
        let lights = VeinLight::of(&GREEN.lamina);
        let [chlorophyll, factor] = [
            GREEN.lamina[Constituent::Chlorophyll],
            GREEN.vein_factors[Constituent::Chlorophyll],
        ];
        let held = |greens: f64| {
            let now = chlorophyll * (1.0 + (factor - 1.0) * greens);
            GREEN.lamina.with(&[(Constituent::Chlorophyll, now)])
        };
        for (weight, share) in [(0.1, 0.1), (0.1, 0.3), (0.5, 0.6), (0.45, 0.5)] {
            let cover = VeinCover {
                share,
                ..VeinCover::of(weight, 0.0)
            };
            let seen = lights.seen(cover, chlorophyll, factor);
            let inside = light(&held(weight / share), NM);
            let mean = (1.0 - share) * light(&held(0.0), NM) + share * inside;
            assert!((light(&held(seen.greens), NM) / mean - 1.0).abs() < 1e-4);
            assert!(seen.greens > weight, "{} of {weight}", seen.greens);
            assert_eq!(seen.weight, weight);
        }
        let whole = VeinCover::of(0.4, 0.0);
        assert_eq!(lights.seen(whole, chlorophyll, factor), whole);
        let part = VeinCover {
            share: 0.5,
            ..whole
        };
        assert_eq!(lights.seen(part, 0.0, factor), part, "nothing green");
        assert_eq!(lights.seen(part, chlorophyll, 1.0), part, "no pale vein");
    }

    /// What a blade holds with a net of squares of 0.4 mm, on a map with this many texels a side.
    fn net(map_size: u32) -> ContentsMap {
        let side = 4.0;
        let frame = UvFrame {
            min: DVec2::ZERO,
            size: DVec2::splat(side),
        };
        let vein = |from: DVec2, to: DVec2| VeinSegment {
            from,
            to,
            radius_from: 0.015,
            radius_to: 0.015,
            order: 3,
        };
        let veins: Vec<VeinSegment> = (0..10)
            .flat_map(|line| {
                let at = 0.2 + 0.4 * f64::from(line);
                let (down, across) = (DVec2::new(at, 0.0), DVec2::new(0.0, at));
                let pieces = (0..20).map(move |i| [0.2 * f64::from(i), 0.2 * f64::from(i + 1)]);
                pieces.flat_map(move |[a, b]| {
                    [
                        vein(down + DVec2::Y * a, down + DVec2::Y * b),
                        vein(across + DVec2::X * a, across + DVec2::X * b),
                    ]
                })
            })
            .collect();
        let tissue = crate::blade::tissue::Tissue {
            full_vein_radius_mm: 0.015,
            sheath_width_mm: 0.05,
            ..GREEN
        };
        ContentsMap::paint(&frame, &veins, &tissue, map_size, 1).expect("in range")
    }

    fn mean_light(texels: &[Texel], nm: f64) -> f64 {
        let of = |texel: &Texel| light(&Contents::from_texel(*texel), nm);
        texels.iter().map(of).sum::<f64>() / texels.len() as f64
    }

    #[test]
    fn a_coarse_map_of_a_fine_net_sends_out_as_much_light_as_a_fine_one() {
        // Texels of 4 µm, and of 200 µm, where a vein with its sheath is 80 µm wide.
        let (fine, coarse) = (net(1000), net(20));
        let of = |nm: f64| {
            let light = mean_light(&fine.texels, nm);
            (mean_light(&coarse.texels, nm) / light - 1.0).abs()
        };
        assert!(of(550.0) < 0.03 && of(600.0) < 0.03);
        // What the fine map holds in the mean over squares of as many texels.
        let mut means = vec![Texel::splat(0.0); 400];
        for (i, texel) in fine.texels.iter().enumerate() {
            let (row, column) = (i / 1000 / 50, i % 1000 / 50);
            let mean = &mut means[row * 20 + column];
            *mean = mean.zip_with(*texel, |sum, value| sum + value / 2500.0);
        }
        for (nm, part) in [(600.0, 0.25), (650.0, 0.6)] {
            let plain = (mean_light(&means, nm) / mean_light(&fine.texels, nm) - 1.0).abs();
            assert!(plain > 0.08, "{plain} at {nm} nm");
            assert!(of(nm) < part * plain, "{} and {plain} at {nm} nm", of(nm));
        }
    }
}
