//! What the tissue of a grown lamina holds, painted over its box.

use super::{Lamina, LeafError, LeafPlan};
use crate::blade::ageing::Place;
use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::blade::hairs::HairMesh;
use crate::blade::mesh::BladeMesh;
use crate::blade::senescence::Withering;
use crate::blade::surface::{SurfaceMap, SurfaceOf};
use crate::blade::tissue::TissueError;
use crate::mosaic::pattern::LaminaPattern;
use crate::venation::network::VeinSegment;

impl LeafPlan {
    /// What the tissue of a lamina that the plan has brought forth holds, over the [`UvFrame`]
    /// around its margin.
    ///
    /// # Errors
    ///
    /// [`LeafError::Mosaic`], [`LeafError::Tissue`], [`LeafError::NoRevenue`];
    /// [`MosaicError::Stopped`](crate::mosaic::MosaicError::Stopped) when `is_stopped` says so.
    pub fn paint(
        &self,
        lamina: &Lamina,
        is_stopped: &dyn Fn() -> bool,
    ) -> Result<ContentsMap, LeafError> {
        self.check_senescence()?;
        let pattern = self.grow_pattern(lamina, is_stopped)?;
        self.paint_with(lamina, pattern.as_ref())
    }

    /// The mosaic of the plan on a lamina that the plan has brought forth, if it has one: the same
    /// on all days and for maps of all sizes.
    ///
    /// # Errors
    ///
    /// [`LeafError::Mosaic`]; [`MosaicError::Stopped`](crate::mosaic::MosaicError::Stopped) when
    /// `is_stopped` says so.
    pub fn grow_pattern(
        &self,
        lamina: &Lamina,
        is_stopped: &dyn Fn() -> bool,
    ) -> Result<Option<LaminaPattern>, LeafError> {
        let pattern = self.mosaic.as_ref();
        let pattern =
            pattern.map(|pattern| pattern.on_lamina(lamina.intact(), self.seed, is_stopped));
        Ok(pattern.transpose()?)
    }

    /// As [`LeafPlan::paint`], with the mosaic that [`LeafPlan::grow_pattern`] gave for this
    /// lamina.
    ///
    /// # Errors
    ///
    /// [`LeafError::Tissue`], [`LeafError::NoRevenue`].
    pub fn paint_with(
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
        for stain in lamina.wounds.iter().flat_map(|wounds| &wounds.stains) {
            stain.paint(&mut map, &frame);
        }
        Ok(map)
    }

    /// The slopes of the faces of a lamina over `frame`, with `size` texels, if the plan has a
    /// surface.
    pub(super) fn surface_of(
        &self,
        lamina: &Lamina,
        frame: &UvFrame,
        size: [u32; 2],
    ) -> Result<Option<SurfaceMap>, TissueError> {
        let Some(plan) = &self.surface else {
            return Ok(None);
        };
        let veins: Vec<VeinSegment> = lamina.network.segments().collect();
        let blade = SurfaceOf {
            frame,
            margin: lamina.outline.points(),
            veins: &veins,
            tissue: &self.tissue,
            form: &self.form,
        };
        SurfaceMap::of(plan, &blade, size).map(Some)
    }

    /// The hairs of the blade made of a lamina, by kind.
    pub(super) fn hairs_of(
        &self,
        lamina: &Lamina,
        blade: &BladeMesh,
    ) -> Result<Vec<HairMesh>, TissueError> {
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
    fn a_mosaic_that_was_grown_once_is_that_of_every_day_and_map_size() {
        let mut plan = find("birch-autumn").expect("a preset").plan();
        plan.venation = find("arcuate").expect("a preset").plan().venation;
        plan.map_size = 40;
        let lamina = plan.grow_lamina().expect("a good plan");
        let plain = plan.paint(&lamina, &|| false).expect("a good plan");
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
        let pattern = plan.grow_pattern(&lamina, &|| false).expect("a good plan");
        let senescence = plan.senescence.expect("it ages");
        for (day, map_size) in [(0.0, 40), (0.0, 30), (24.0, 40)] {
            let plan = LeafPlan {
                senescence: senescence.on_day(day),
                map_size,
                ..plan.clone()
            };
            let map = plan
                .paint_with(&lamina, pattern.as_ref())
                .expect("a good plan");
            assert_eq!(
                map,
                plan.paint(&lamina, &|| false).expect("a good plan"),
                "day {day}, {map_size} texels"
            );
            assert_ne!(map.texels, plain.texels);
        }
    }
}
