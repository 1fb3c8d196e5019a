//! Maps of the contents of tissue, sampled over the box of a blade.

use glam::DVec2;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::ageing::Place;
use super::coverage::{Coverage, extend};
use super::frame::UvFrame;
use super::layers::{Layer, LayerFields};
use super::mottle::Mottle;
use super::senescence::Withering;
use super::tissue::Tissue;
use super::vein_field::VeinField;
use super::vein_light::VeinLight;
use crate::document::RangeError;
use crate::memory;
use crate::mosaic::pattern::LaminaPattern;
use crate::optics::{Constituent, Texel};
use crate::venation::network::VeinSegment;

/// Contents per leaf area over a [`UvFrame`], as texels.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub struct ContentsMap {
    /// Texels along `u`; the centre of column `i` is at `u = (i + ½) / width`.
    pub width: u32,
    /// Texels along `v`; the centre of row `j` is at `v = (j + ½) / height`.
    pub height: u32,
    /// Row by row from `v = 0`, `width × height` of them.
    #[serde(with = "super::planes")]
    pub texels: Vec<Texel>,
}

impl ContentsMap {
    /// Paints a leaf's tissue.
    ///
    /// The longer side has `map_size` (16 to 8192) texels; the shorter one has as many as make
    /// texels about square. The whole frame is painted. The same input gives the same bits.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for a tissue, vein, frame or map size out of range, by name.
    pub fn paint(
        frame: &UvFrame,
        veins: &[VeinSegment],
        tissue: &Tissue,
        map_size: u32,
        seed: u64,
    ) -> Result<Self, RangeError> {
        let place = Place {
            frame,
            margin: &[],
            veins,
            base: frame.min,
            apex: frame.min + frame.size,
        };
        Self::paint_layered(&place, tissue, None, &[], None, map_size, seed)
    }

    /// As [`ContentsMap::paint`], for a leaf with mosaic, layers and ageing, applied in this order:
    /// the mosaic replaces the tissue's lamina contents, layers change the contents between veins,
    /// the result ages, and finally the factors of veins and the mottle apply.
    ///
    /// The field is computed up to two texels beyond the margin, so that a look-up across the
    /// margin shows no seam. No look-up reaches texels farther out; they repeat the nearest texel
    /// of their row.
    ///
    /// # Errors
    ///
    /// As [`ContentsMap::paint`], and for layers out of range.
    pub fn paint_layered(
        place: &Place<'_>,
        tissue: &Tissue,
        pattern: Option<&LaminaPattern>,
        layers: &[Layer],
        withering: Option<&Withering>,
        map_size: u32,
        seed: u64,
    ) -> Result<Self, RangeError> {
        let (frame, veins) = (place.frame, place.veins);
        layers.iter().try_for_each(Layer::validate)?;
        let valid = (16..=8192).contains(&map_size);
        RangeError::unless(valid, "map_size", f64::from(map_size), "from 16 to 8192")?;
        for value in frame.min.to_array() {
            let valid = value.abs() <= 1e5;
            RangeError::unless(valid, "corner of the frame", value, "within ±100000 mm")?;
        }
        for value in frame.size.to_array() {
            let valid = (1e-3..=1e5).contains(&value);
            RangeError::unless(valid, "side of the frame", value, "from 0.001 to 100000 mm")?;
        }
        let longer = frame.size.max_element();
        let texels_along = |side: f64| (f64::from(map_size) * (side / longer)).ceil() as u32;
        let (width, height) = (texels_along(frame.size.x), texels_along(frame.size.y));
        let texel = frame.size / DVec2::new(f64::from(width), f64::from(height));
        let field = VeinField::new(veins, tissue, texel.max_element())?;
        let painter = Painter {
            frame,
            tissue,
            pattern,
            layers: LayerFields::new(layers, place, seed),
            withering,
            field,
            light: VeinLight::of(&tissue.lamina),
            mottle: (tissue.mottle > 0.0).then(|| Mottle::new(seed, tissue.mottle_scale_mm)),
        };
        let coverage = Coverage::new(place.margin, frame, [width as usize, height as usize]);
        let mut texels = memory::filled(Texel::splat(0.0), width as usize * height as usize);
        let rows = texels.par_chunks_mut(width as usize).enumerate();
        rows.for_each(|(row, texels)| {
            let v = (row as f64 + 0.5) / f64::from(height);
            let mut weights = Vec::new();
            let covered = coverage.row(row);
            let those = texels.iter_mut().enumerate();
            for (column, texel) in those.filter(|(column, _)| covered[*column]) {
                let u = (column as f64 + 0.5) / f64::from(width);
                *texel = painter.texel(DVec2::new(u, v), &mut weights);
            }
            extend(texels, covered);
        });
        Ok(Self {
            width,
            height,
            texels,
        })
    }
}

struct Painter<'a> {
    frame: &'a UvFrame,
    tissue: &'a Tissue,
    pattern: Option<&'a LaminaPattern>,
    layers: LayerFields<'a>,
    withering: Option<&'a Withering>,
    field: VeinField,
    light: VeinLight,
    mottle: Option<Mottle>,
}

impl Painter<'_> {
    fn texel(&self, uv: DVec2, weights: &mut Vec<f64>) -> Texel {
        let point = self.frame.point(uv);
        let mottle = self.mottle.map_or(0.0, |mottle| mottle.at(point));
        let pattern = self.pattern;
        let cells = pattern.and_then(|pattern| pattern.contents(point, weights));
        let cells = cells.unwrap_or(self.tissue.lamina);
        let living = self.layers.contents(cells, point);
        let lamina = self
            .withering
            .map_or(living, |withering| withering.contents(living, point));
        let greens = Constituent::Chlorophyll;
        let factor = self.tissue.vein_factors[greens];
        let cover = self
            .light
            .seen(self.field.cover(point), lamina[greens], factor);
        self.tissue.contents_of(lamina, cover, mottle).to_texel()
    }
}

#[cfg(test)]
mod tests {
    use std::ops::Range;

    use proptest::prelude::*;

    use super::super::tissue::tests::GREEN;
    use super::*;
    use crate::optics::{Contents, PerConstituent, VeinFactors};
    use properties::fixed;

    const FRAME: UvFrame = UvFrame {
        min: DVec2::new(-3.0, 0.0),
        size: DVec2::new(6.0, 10.0),
    };

    fn vein(from: [f64; 2], to: [f64; 2], radius: f64) -> VeinSegment {
        VeinSegment {
            from: DVec2::from(from),
            to: DVec2::from(to),
            radius_from: radius,
            radius_to: radius,
            order: 1,
        }
    }

    fn paint(veins: &[VeinSegment], tissue: &Tissue, map_size: u32) -> ContentsMap {
        ContentsMap::paint(&FRAME, veins, tissue, map_size, 11).expect("all in range")
    }

    fn at(map: &ContentsMap, column: u32, row: u32) -> Texel {
        map.texels[(row * map.width + column) as usize]
    }

    #[test]
    fn the_longer_side_has_the_map_size_and_texels_are_about_square() {
        let map = paint(&[], &GREEN, 64);
        assert_eq!((map.width, map.height), (39, 64));
        assert_eq!(map.texels.len(), 39 * 64);
        let thin = UvFrame {
            min: DVec2::ZERO,
            size: DVec2::new(100.0, 0.01),
        };
        let map = ContentsMap::paint(&thin, &[], &GREEN, 64, 0).expect("all in range");
        assert_eq!((map.width, map.height), (64, 1));
    }

    #[test]
    fn row_0_lies_at_the_least_y_and_column_0_at_the_least_x() {
        let map = paint(&[vein([-3.0, 0.0], [-3.0, 0.0], 0.5)], &GREEN, 100);
        assert!(at(&map, 0, 0)[Constituent::Chlorophyll] < 20.0);
        for (column, row) in [(map.width - 1, 0), (0, 99), (map.width - 1, 99)] {
            assert_eq!(at(&map, column, row)[Constituent::Chlorophyll], 40.0);
        }
    }

    #[test]
    fn far_from_veins_there_is_exactly_the_lamina() {
        let map = paint(&[vein([0.0, 0.0], [0.0, 10.0], 0.3)], &GREEN, 200);
        let lamina = GREEN.lamina.to_texel();
        for row in 0..map.height {
            for column in 0..map.width {
                let x = -3.0 + 6.0 * (f64::from(column) + 0.5) / f64::from(map.width);
                if x.abs() > 0.3 + 0.1 + 0.05 {
                    assert_eq!(at(&map, column, row), lamina);
                }
            }
        }
    }

    #[test]
    fn veins_hold_less_where_the_factor_is_below_one_and_more_where_above() {
        // 101 columns: one is centred on the vein.
        let mut tissue = GREEN;
        tissue.vein_factors = VeinFactors::of(&[
            (Constituent::Structure, 1.4),
            (Constituent::Chlorophyll, 0.3),
            (Constituent::Carotenoids, 2.0),
            (Constituent::Anthocyanins, 0.0),
            (Constituent::Betacyanins, 0.5),
            (Constituent::Betaxanthins, 2.0),
            (Constituent::Brown, 3.0),
            (Constituent::Water, 0.5),
            (Constituent::DryMatter, 2.0),
        ]);
        tissue.lamina = Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 9.0),
            (Constituent::Anthocyanins, 2.0),
            (Constituent::Betacyanins, 3.0),
            (Constituent::Betaxanthins, 4.0),
            (Constituent::Brown, 0.2),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.006),
        ]);
        for radius in [0.05, 0.25, 1.0] {
            let map = paint(&[vein([0.0, 0.0], [0.0, 10.0], radius)], &tissue, 168);
            assert_eq!(map.width, 101);
            let centre = at(&map, 50, 80);
            for (constituent, factor) in *tissue.vein_factors {
                let (own, between) = (centre[constituent], tissue.lamina.to_texel()[constituent]);
                let differs = match factor {
                    ..1.0 => own < between,
                    1.0 => own == between,
                    _ => own > between,
                };
                assert!(differs, "{constituent:?} at {radius} mm");
            }
        }
    }

    #[test]
    fn a_vein_thinner_than_a_texel_adds_the_same_dry_matter_at_any_resolution() {
        // 0.02 mm radius and 0.02 mm sheath, texels from 0.005 to 0.625 mm. At exactly 45° all rows
        // have the same phase, and the texels' diagonals are nearer to each other than the tent
        // filter assumes: the error of a row is at most 2 sinc²(√2) = 9.4 %. At other angles errors
        // of rows are random and nearly cancel over eight rows.
        let tissue = Tissue {
            sheath_width_mm: 0.02,
            ..GREEN
        };
        for (from, to, tolerance) in [
            ([0.013, -5.0], [0.013, 15.0], 0.005),
            ([-2.0, -5.0], [2.0, 15.0], 0.01),
            ([-5.0, -1.0], [5.0, 11.0], 0.04),
            ([-6.0, -1.0], [6.0, 11.0], 0.1),
        ] {
            let veins = [vein(from, to, 0.02)];
            let added = |map_size: u32| {
                let map = paint(&veins, &tissue, map_size);
                let start = map.height / 2 - 4;
                let sum: f64 = (start..start + 8)
                    .flat_map(|row| (0..map.width).map(move |column| (column, row)))
                    .map(|(column, row)| {
                        let held = at(&map, column, row)[Constituent::DryMatter];
                        f64::from(held) - f64::from(0.006_f32)
                    })
                    .sum();
                sum / f64::from(map.width)
            };
            let fine = added(2000);
            for map_size in [16, 37, 100, 333, 1000] {
                let error = added(map_size) / fine - 1.0;
                assert!(error.abs() < tolerance, "{error} at {map_size} for {to:?}");
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same_bits_and_another_seed_another_mottle() {
        let tissue = Tissue {
            mottle: 0.2,
            ..GREEN
        };
        let veins = [vein([0.0, 0.0], [1.0, 9.0], 0.2)];
        let bits = |seed| -> Vec<PerConstituent<u32>> {
            ContentsMap::paint(&FRAME, &veins, &tissue, 64, seed)
                .expect("all in range")
                .texels
                .iter()
                .map(|texel| texel.map(f32::to_bits))
                .collect()
        };
        assert_eq!(bits(1), bits(1));
        assert_ne!(bits(1), bits(2));
    }

    #[test]
    fn sizes_and_frames_out_of_range_are_refused_by_name() {
        let refused = |frame: &UvFrame, map_size| {
            ContentsMap::paint(frame, &[], &GREEN, map_size, 0)
                .expect_err("out of range")
                .path
        };
        assert_eq!(refused(&FRAME, 15), "map_size");
        assert_eq!(refused(&FRAME, 8193), "map_size");
        let nowhere = UvFrame {
            min: DVec2::new(f64::NAN, 0.0),
            ..FRAME
        };
        assert_eq!(refused(&nowhere, 64), "corner of the frame");
        let flat = UvFrame::around(&[DVec2::ZERO, DVec2::X]);
        assert_eq!(refused(&flat, 64), "side of the frame");
    }

    /// A number for each constituent, within a range.
    fn of_each(range: Range<f64>) -> impl Strategy<Value = PerConstituent<f64>> {
        let values = prop::array::uniform::<_, { Constituent::COUNT }>(range);
        values.prop_map(PerConstituent::new)
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn contents_are_finite_and_in_range_everywhere(
            factors in of_each(0.0..100.0),
            shares in of_each(0.0..1.0),
            ends in prop::collection::vec(([-4.0..4.0, -1.0..11.0], [-4.0..4.0, -1.0..11.0], 0.001..20.0), 1..8),
            mottle in 0.0..=1.0,
            full_vein_radius_mm in 0.001..1.0,
        ) {
            let tissue = Tissue {
                lamina: Contents(PerConstituent::from_fn(|constituent| {
                    let [least, most] = constituent.range();
                    least + shares[constituent] * (most - least)
                })),
                vein_factors: VeinFactors(factors),
                full_vein_radius_mm,
                mottle,
                ..GREEN
            };
            let veins: Vec<VeinSegment> = ends.into_iter().map(|(from, to, r)| vein(from, to, r)).collect();
            for texel in paint(&veins, &tissue, 40).texels {
                prop_assert!(texel.iter().all(|(_, value)| value.is_finite() && *value >= 0.0));
                prop_assert!(texel[Constituent::Structure] >= 1.0);
            }
        }
    }
}
