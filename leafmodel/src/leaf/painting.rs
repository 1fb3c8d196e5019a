//! What the tissue of a grown lamina holds, painted over its box.

use glam::DVec2;

use super::error::LeafError;
use super::lamina::Lamina;
use super::plan::LeafPlan;
use crate::blade::ageing::Place;
use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::blade::hairs::HairMesh;
use crate::blade::mesh::BladeMesh;
use crate::blade::senescence::Withering;
use crate::blade::surface::{Bulge, HeldSheet, SurfaceMap, SurfaceOf};
use crate::document::{Declared, RangeError};
use crate::grow_options::GrowOptions;
use crate::mosaic::pattern::LaminaPattern;
use crate::optics::Contents;
use crate::shape::tips::Knob;
use crate::venation::network::VeinSegment;

/// Spacing of the heights that displace a mesh, over its longest edge: that of the edges themselves.
const MESHED_WAVE: f64 = 0.75;

impl GrowOptions<'_> {
    /// What the tissue of a lamina that the plan has brought forth holds, over the [`UvFrame`]
    /// around its margin.
    ///
    /// # Errors
    ///
    /// [`LeafError::Tissue`], [`LeafError::NoRevenue`], [`LeafError::Mosaic`].
    pub fn contents(self, plan: &LeafPlan, lamina: &Lamina) -> Result<ContentsMap, LeafError> {
        plan.check_senescence()?;
        let pattern = self.pattern(plan, lamina)?;
        plan.paint(lamina, pattern.as_ref())
    }

    /// The mosaic of the plan on a lamina that the plan has brought forth, if it has one: the same
    /// on all days and for maps of all sizes.
    ///
    /// # Errors
    ///
    /// [`LeafError::Mosaic`].
    pub fn pattern(
        self,
        plan: &LeafPlan,
        lamina: &Lamina,
    ) -> Result<Option<LaminaPattern>, LeafError> {
        let pattern = plan.mosaic.as_ref();
        let pattern = pattern.map(|pattern| pattern.on_lamina(lamina.intact(), plan.seed, self));
        pattern.transpose().map_err(LeafError::Mosaic)
    }
}

impl LeafPlan {
    /// What the tissue of a lamina that the plan has brought forth holds, with the mosaic that
    /// [`GrowOptions::pattern`] gave for this lamina.
    ///
    /// # Errors
    ///
    /// [`LeafError::Tissue`], [`LeafError::NoRevenue`].
    pub fn paint(
        &self,
        lamina: &Lamina,
        pattern: Option<&LaminaPattern>,
    ) -> Result<ContentsMap, LeafError> {
        let frame = UvFrame::around(lamina.intact().points());
        let veins: Vec<VeinSegment> = lamina.network.segments().collect();
        let place = lamina.place(&frame, &veins);
        let withering = self.withering(lamina, &place)?;
        let mut tissue = self.tissue;
        if let Some(body) = &mut tissue.vein_body {
            body.blade_mm = self.form.thickness_mm;
        }
        let mut map = ContentsMap::paint_layered(
            &place,
            &tissue,
            pattern,
            &self.layers,
            withering.as_ref(),
            self.map_size,
            self.seed,
        )?;
        self.form.margin.thin(&mut map, &frame, lamina.intact());
        if let Some(unevenness) = &self.unevenness {
            unevenness.in_range()?;
            unevenness.apply(&mut map, &frame, lamina.intact(), &veins, self.seed);
        }
        for knob in lamina.intact().knobs() {
            paint_knob(knob, &mut map, &frame);
        }
        if let Some(front) = lamina
            .wounds
            .iter()
            .find_map(|wounds| wounds.front.as_ref())
        {
            front.paint(&mut map, &frame);
        }
        for stain in lamina.wounds.iter().flat_map(|wounds| &wounds.stains) {
            stain.paint(&mut map, &frame);
        }
        Ok(map)
    }

    /// The bulge of a lamina over `frame`, as far as edges of its mesh can carry it.
    pub(super) fn meshed_bulge(&self, lamina: &Lamina, frame: &UvFrame) -> Option<Bulge> {
        let plan = self.surface.as_ref().filter(|plan| plan.bulge_mm > 0.0)?;
        let veins: Vec<VeinSegment> = lamina.network.segments().collect();
        let sheet = HeldSheet {
            frame,
            veins: &veins,
            full_vein_radius_mm: self.tissue.full_vein_radius_mm,
        };
        Some(Bulge::of(plan, &sheet, MESHED_WAVE * self.form.max_edge_mm))
    }

    /// The slopes of the faces of a lamina over `frame`, with `size` texels, that its mesh does not
    /// carry, if the plan has a surface.
    pub(super) fn surface_of(
        &self,
        lamina: &Lamina,
        mesh: &BladeMesh,
        frame: &UvFrame,
        size: [u32; 2],
    ) -> Result<Option<SurfaceMap>, LeafError> {
        let Some(plan) = &self.surface else {
            return Ok(None);
        };
        let veins: Vec<VeinSegment> = lamina.network.segments().collect();
        let withering = if plan.dead_roughness > 0.0 {
            self.withering(lamina, &lamina.place(frame, &veins))?
        } else {
            None
        };
        let blade = SurfaceOf {
            frame,
            margin: lamina.outline.points(),
            veins: &veins,
            tissue: &self.tissue,
            mesh: Some(mesh),
            withering: withering.as_ref(),
            seed: self.seed,
        };
        Ok(Some(SurfaceMap::of(plan, &blade, size)?))
    }

    /// The hairs of the blade made of a lamina, by kind.
    pub(super) fn hairs_of(
        &self,
        lamina: &Lamina,
        blade: &BladeMesh,
    ) -> Result<Vec<HairMesh>, RangeError> {
        if self.hairs.is_empty() {
            return Ok(Vec::new());
        }
        let veins: Vec<VeinSegment> = lamina.network.segments().collect();
        let least_vein_mm = self.form.meshed_vein_radius_mm;
        let kinds = self.hairs.iter();
        kinds
            .map(|kind| kind.grow(blade, &veins, least_vein_mm, self.seed))
            .collect()
    }

    /// How the tissue of a lamina has aged; the cells that its veins supply decide before those of
    /// its margin.
    pub(crate) fn withering(
        &self,
        lamina: &Lamina,
        place: &Place<'_>,
    ) -> Result<Option<Withering>, LeafError> {
        self.check_senescence()?;
        let Some(senescence) = &self.senescence else {
            return Ok(None);
        };
        let deaths = if senescence.needs_cells() {
            self.death_field(lamina)?
        } else {
            None
        };
        let withering = Withering::new(senescence, place, deaths, self.seed);
        withering.ok_or(LeafError::NoRevenue).map(Some)
    }
}

/// Paints a gland over a map. What it holds passes into what is beside it within a seventh of its
/// radius, or a texel.
fn paint_knob(knob: &Knob, map: &mut ContentsMap, frame: &UvFrame) {
    let texel = frame.size / DVec2::new(f64::from(map.width), f64::from(map.height));
    let edge = (knob.radius / 7.0).max(texel.max_element());
    let reach = DVec2::splat(knob.radius + edge);
    let place = |p: DVec2| (p - frame.min) / texel;
    let (low, high) = (place(knob.centre - reach), place(knob.centre + reach));
    let span = |low: f64, high: f64, count: u32| {
        (low.max(0.0) as u32)..((high.max(0.0) as u32 + 1).min(count))
    };
    for row in span(low.y, high.y, map.height) {
        for column in span(low.x, high.x, map.width) {
            let p = frame.min + texel * (DVec2::new(f64::from(column), f64::from(row)) + 0.5);
            let weight = ((knob.radius - p.distance(knob.centre)) / edge + 1.0).clamp(0.0, 1.0);
            if weight > 0.0 {
                let texel = &mut map.texels[(row * map.width + column) as usize];
                let mut now = Contents::from_texel(*texel);
                for (constituent, value) in now.iter_mut() {
                    *value += (knob.contents[constituent] - *value) * weight;
                }
                *texel = now.to_texel();
            }
        }
    }
}

impl Lamina {
    /// The lamina as ageing and masks see it; `veins` are its own.
    pub(crate) fn place<'a>(&'a self, frame: &'a UvFrame, veins: &'a [VeinSegment]) -> Place<'a> {
        Place {
            frame,
            margin: self.intact().points(),
            veins,
            base: self.outline.base(),
            apex: self.outline.apex(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mosaic::pattern::{LeafFaces, MosaicPattern};
    use crate::mosaic::plan::MosaicPlan;
    use crate::optics::Constituent;
    use crate::species::find;

    #[test]
    fn a_gland_holds_what_it_should_and_the_tooth_below_it_does_not() {
        let mut plan = find("cottonwood").expect("a preset").plan();
        plan.venation = find("arcuate").expect("a preset").plan().venation;
        plan.map_size = 1000;
        let lamina = plan.grow_lamina().expect("a good plan");
        let map = GrowOptions::default()
            .contents(&plan, &lamina)
            .expect("a good plan");
        let frame = UvFrame::around(lamina.intact().points());
        let at = |p: DVec2| {
            let uv = frame.uv(p);
            let column = (uv.x * f64::from(map.width)) as usize;
            let row = (uv.y * f64::from(map.height)) as usize;
            f64::from(map.texels[row * map.width as usize + column][Constituent::Anthocyanins])
        };
        let knobs = lamina.outline.knobs();
        // 24 teeth a side, some too low at base and apex to bear one.
        assert!((36..=48).contains(&knobs.len()), "{}", knobs.len());
        let green = plan.tissue.lamina[Constituent::Anthocyanins];
        for knob in knobs {
            let held = knob.contents[Constituent::Anthocyanins];
            assert!((at(knob.centre) / held - 1.0).abs() < 1e-6);
            let foot = (knob.feet[0] + knob.feet[1]) * 0.5;
            let inside = knob.centre + (foot - knob.centre).normalize() * 3.0 * knob.radius;
            assert!(at(inside) < 2.0 * green, "{}", at(inside));
        }
    }

    #[test]
    fn a_mosaic_that_was_grown_once_is_that_of_every_day_and_map_size() {
        let mut plan = find("birch-autumn").expect("a preset").plan();
        plan.venation = find("arcuate").expect("a preset").plan().venation;
        plan.map_size = 40;
        let lamina = plan.grow_lamina().expect("a good plan");
        let plain = GrowOptions::default()
            .contents(&plan, &lamina)
            .expect("a good plan");
        let tissue = plan.tissue.lamina;
        plan.mosaic = Some(MosaicPattern {
            plan: MosaicPlan {
                initial_cells: 100,
                days: 5.0,
                types: MosaicPlan::two_types([8.0, 10.0], [0.5, 0.8], 0.25, 0.0),
                ..MosaicPlan::default()
            },
            contents: vec![tissue, tissue.with(&[(Constituent::Chlorophyll, 0.0)])],
            blend_mm: 0.5,
            faces: LeafFaces::Through,
        });
        let pattern = GrowOptions::default()
            .pattern(&plan, &lamina)
            .expect("a good plan");
        let senescence = plan.senescence.expect("it ages");
        for (day, map_size) in [(0.0, 40), (0.0, 30), (24.0, 40)] {
            let plan = LeafPlan {
                senescence: senescence.on_day(day),
                map_size,
                ..plan.clone()
            };
            let map = plan.paint(&lamina, pattern.as_ref()).expect("a good plan");
            assert_eq!(
                map,
                GrowOptions::default()
                    .contents(&plan, &lamina)
                    .expect("a good plan"),
                "day {day}, {map_size} texels"
            );
            assert_ne!(map.texels, plain.texels);
        }
    }
}
