//! The map from the flat lamina into space, with all that has happened to the blade.

use glam::{DMat3, DVec2, DVec3};

use super::settled::Settled;
use crate::blade::form::Bending;
use crate::blade::plan::BladeForm;
use crate::blade::pleats::Pleats;
use crate::shape::outline::Outline;
use crate::venation::conformal_map::ConformalMap;
use crate::venation::network::VeinSegment;

/// Distance over which slopes of the form are measured, as a share of the leaf's length.
const NEARBY: f64 = 1e-4;

/// The form of a blade, and where it has come to lie.
#[derive(Debug)]
pub(in crate::blade) struct Posture<'s> {
    bending: Bending,
    nearby: f64,
    base: DVec2,
    settled: Option<&'s Settled>,
}

impl<'s> Posture<'s> {
    pub(in crate::blade) fn new(
        form: &BladeForm,
        outline: &Outline,
        (map, veins): (ConformalMap, &[VeinSegment]),
        settled: Option<&'s Settled>,
    ) -> Self {
        let pleats = Pleats::new(form, outline, veins);
        Self {
            bending: Bending::new(form, outline, map).pleated(pleats),
            nearby: NEARBY * outline.length(),
            base: outline.base(),
            settled,
        }
    }

    /// The place in space, mm, of the point at `height` (mm, towards the adaxial side) above the
    /// flat point `p`.
    pub(in crate::blade) fn place(&self, p: DVec2, height: f64) -> DVec3 {
        let Some(settled) = self.settled else {
            return self.bending.place(p, height);
        };
        let [at, across, along] = self.sheet(p, settled);
        settled.turned(at + height * across.cross(along).normalize_or(DVec3::Z))
    }

    /// The frame of the stalk: its place, and the directions across the leaf, along it and upwards.
    pub(in crate::blade) fn base(&self) -> (DVec3, DMat3) {
        let Some(settled) = self.settled else {
            return (DVec3::ZERO, DMat3::IDENTITY);
        };
        let [at, across, along] = self.sheet(self.base, settled);
        let along = along.normalize_or(DVec3::Y);
        let up = across.cross(along).normalize_or(DVec3::Z);
        let frame = DMat3::from_cols(along.cross(up), along, up);
        (settled.turned(at), settled.turn() * frame)
    }

    /// Angle by which the stalk has sagged.
    pub(in crate::blade) fn sag(&self) -> f64 {
        self.settled.map_or(0.0, Settled::sag)
    }

    /// Whether the leaf lies on the ground.
    pub(in crate::blade) fn on_ground(&self) -> bool {
        self.settled.is_some_and(Settled::on_ground)
    }

    /// A point of the sheet, and its derivatives by the flat coordinates.
    fn sheet(&self, p: DVec2, settled: &Settled) -> [DVec3; 3] {
        let slope = |axis: DVec2| {
            let step = self.nearby * axis;
            let ends = self.bending.place(p + step, 0.0) - self.bending.place(p - step, 0.0);
            ends / (2.0 * self.nearby)
        };
        let form = [self.bending.place(p, 0.0), slope(DVec2::X), slope(DVec2::Y)];
        settled.carried(p, form)
    }
}
