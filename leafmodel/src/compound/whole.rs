//! A whole leaf in space: blades, stalks and the place of each blade.

mod ground;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use super::arranged::{CompoundError, CompoundLeaf, PlacedLeaflet, StalkKind, direction};
use super::form::CompoundForm;
use crate::blade::petiole::{Course, PetiolePlan};
use crate::blade::stalk::StalkMesh;
use crate::grow_options::GrowOptions;
use crate::leaf::{Leaf, LeafError, LeafPlan};
use crate::numeric::smooth_step;
use crate::plane::polyline;
use crate::random::{Use, bits, uniform};
use crate::rotation::about;

/// Random numbers for the tilts of leaflets come after those for their seeds.
const FIRST_TILT: u64 = 1 << 32;
/// Relative thickening of the foot of the whole leaf, and its length in radii.
const FOOT: f64 = 0.35;
const FOOT_RADII: f64 = 6.0;
/// Longest piece of an axis in space, as a share of its length.
const PIECE: f64 = 1.0 / 40.0;

/// A blade in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Its index in [`WholeLeaf::blades`].
    pub blade: usize,
    /// From the blade's own frame to the leaf's; may mirror.
    pub to_leaf: DAffine3,
}

/// A simple or compound leaf in space.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeLeaf {
    /// The different blades, each with its petiole or petiolule.
    pub blades: Vec<Leaf>,
    /// The places of blades.
    pub placements: Vec<Placement>,
    /// Petiole, rachis and rachides of pinnae of a compound leaf, if it has any.
    pub axes: Option<StalkMesh>,
    /// The flat arrangement of a compound leaf; `None` for a simple one.
    pub flat: Option<CompoundLeaf>,
}

/// The plans of all blades of a leaf: the leaf's own, or its different leaflets at the size of the
/// largest, each with its own seed and with its petiolule as petiole.
pub fn leaflet_plans(leaflet: &LeafPlan, form: &CompoundForm) -> Vec<LeafPlan> {
    let petiole = PetiolePlan {
        length: form.petiolule,
        radius_mm: Some(form.stalk_radius_mm),
        curl: 0.0,
        course: Course::STRAIGHT,
        section: crate::blade::petiole::Section::default(),
    };
    let variant = |number: u32| LeafPlan {
        seed: bits(leaflet.seed, Use::Leaflet, number.into()),
        petiole: Some(petiole),
        compound: None,
        ..leaflet.clone()
    };
    (0..form.variants).map(variant).collect()
}

impl WholeLeaf {
    /// Grows blades and stalks.
    ///
    /// # Errors
    ///
    /// [`CompoundError`]; for a simple leaf only [`CompoundError::Leaflet`].
    pub fn grow(plan: &LeafPlan) -> Result<Self, CompoundError> {
        Self::grow_with(plan, GrowOptions::default())
    }

    /// As [`WholeLeaf::grow`], with options.
    ///
    /// # Errors
    ///
    /// As [`WholeLeaf::grow`].
    pub fn grow_with(plan: &LeafPlan, options: GrowOptions<'_>) -> Result<Self, CompoundError> {
        let Some(form) = &plan.compound else {
            return Ok(Self::simple(options.leaf(plan)?));
        };
        // Overlap is checked before any veins are grown.
        let flat = form.arrange(plan)?;
        let plans = leaflet_plans(plan, form);
        let blades: Result<Vec<Leaf>, LeafError> =
            plans.iter().map(|plan| options.leaf(plan)).collect();
        Ok(Self::assembled(plan, form, flat, blades?))
    }

    /// A leaf of one blade.
    pub fn simple(leaf: Leaf) -> Self {
        Self {
            blades: vec![leaf],
            placements: vec![Placement {
                blade: 0,
                to_leaf: DAffine3::IDENTITY,
            }],
            axes: None,
            flat: None,
        }
    }

    /// A compound leaf from its different leaflets, grown from [`leaflet_plans`], and its
    /// arrangement. On the ground it lies on three of its points, its axes straight.
    ///
    /// # Panics
    ///
    /// If a leaflet of a leaf on the ground has no petiolule, as those of [`leaflet_plans`] have.
    pub fn assembled(
        plan: &LeafPlan,
        form: &CompoundForm,
        flat: CompoundLeaf,
        blades: Vec<Leaf>,
    ) -> Self {
        let lying = plan.stance.on_ground.then(|| form.flattened());
        let form = lying.as_ref().unwrap_or(form);
        let bend = Bend::new(form, plan.length_mm);
        let mut placements: Vec<_> = (0_u64..)
            .zip(&flat.leaflets)
            .map(|(number, leaflet)| {
                let tilt = [0, 1].map(|which| {
                    let number = FIRST_TILT + 2 * number + which;
                    form.tilt * (2.0 * uniform(plan.seed, Use::Leaflet, number) - 1.0)
                });
                Placement {
                    blade: leaflet.variant as usize,
                    to_leaf: bend.leaflet(leaflet, form, plan.length_mm, tilt),
                }
            })
            .collect();
        let mut axes = StalkMesh::default();
        for (points, radii) in joined_stalks(&flat) {
            axes.append(bend.tube(&points, &radii));
        }
        if lying.is_some() {
            for (placement, leaflet) in placements.iter_mut().zip(&flat.leaflets) {
                ground::join(
                    placement,
                    &blades[placement.blade],
                    bend.place(leaflet.foot),
                );
            }
        }
        let mut whole = Self {
            blades,
            placements,
            axes: (!axes.triangles.is_empty()).then_some(axes),
            flat: Some(flat),
        };
        if lying.is_some() {
            whole.put_on_ground();
        }
        whole
    }
}

/// The axes of a leaf as polylines with radii: petiole and rachis as one, then the pinnae.
pub(crate) fn joined_stalks(leaf: &CompoundLeaf) -> Vec<(Vec<DVec2>, Vec<f64>)> {
    let mut joined: Vec<(Vec<DVec2>, Vec<f64>)> = Vec::new();
    let axes = leaf.stalks.iter();
    for stalk in axes.filter(|stalk| stalk.kind != StalkKind::Petiolule) {
        let (points, radii) = (&stalk.points, &stalk.radii_mm);
        match joined.first_mut() {
            // The rachis goes on where the petiole ends.
            Some((before, before_radii)) if stalk.kind == StalkKind::Rachis => {
                before.extend(&points[1..]);
                before_radii.extend(&radii[1..]);
            }
            Some(_) | None => joined.push((points.clone(), radii.clone())),
        }
    }
    joined
}

/// The plane of a compound leaf, bent to an arc along +y.
struct Bend {
    /// Curvature, 1/mm.
    curvature: f64,
}

impl Bend {
    fn new(form: &CompoundForm, unit: f64) -> Self {
        Self {
            curvature: form.curvature(unit),
        }
    }

    /// The place in space of a point of the plane. Lengths are preserved, as by
    /// [`crate::blade::BladeForm::curl`].
    fn place(&self, p: DVec2) -> DVec3 {
        let angle = self.curvature * p.y;
        if angle.abs() < 1e-6 {
            return DVec3::new(p.x, p.y, -0.5 * angle * p.y);
        }
        let half = libm::sin(0.5 * angle);
        DVec3::new(
            p.x,
            libm::sin(angle) / self.curvature,
            -2.0 * half * half / self.curvature,
        )
    }

    /// The rotation of the plane at a point.
    fn turn(&self, p: DVec2) -> DMat3 {
        about(DVec3::X, -self.curvature * p.y)
    }

    /// From a leaflet's own frame, base at the origin, to the leaf's.
    fn leaflet(
        &self,
        leaflet: &PlacedLeaflet,
        form: &CompoundForm,
        unit: f64,
        [roll, pitch]: [f64; 2],
    ) -> DAffine3 {
        let axis = direction(leaflet.angle - leaflet.from_axis).extend(0.0);
        let raised = about(axis, -form.fold * libm::sin(leaflet.from_axis));
        let turned = about(DVec3::Z, -leaflet.angle);
        let tilted = about(DVec3::Y, roll) * about(DVec3::X, 0.5 * pitch);
        let linear = self.turn(leaflet.foot) * raised * turned * tilted * leaflet.scale;
        let foot = DAffine3::from_mat3_translation(linear, self.place(leaflet.foot));
        let side = if leaflet.mirrored { -1.0 } else { 1.0 };
        // Moves the foot of its petiolule onto the axis.
        foot * DAffine3::from_translation(DVec3::Y * (form.petiolule * unit))
            * DAffine3::from_scale(DVec3::new(side, 1.0, 1.0))
    }

    /// A tube along a polyline of the plane.
    fn tube(&self, points: &[DVec2], radii: &[f64]) -> StalkMesh {
        let whole = polyline::length(points);
        let foot = (FOOT_RADII * radii[0]).min(0.5 * whole);
        let swollen = |along: f64| 1.0 + FOOT * (1.0 - smooth_step(along / foot));
        let (mut placed, mut thick) = (vec![self.place(points[0])], vec![radii[0] * swollen(0.0)]);
        let mut along = 0.0;
        for (pair, ends) in points.windows(2).zip(radii.windows(2)) {
            let length = pair[0].distance(pair[1]);
            let finest = (PIECE * whole).min(0.25 * foot.max(along));
            let pieces = (length / finest).ceil().clamp(1.0, 40.0);
            for i in 1..=pieces as usize {
                let t = i as f64 / pieces;
                placed.push(self.place(pair[0].lerp(pair[1], t)));
                thick.push((ends[0] + (ends[1] - ends[0]) * t) * swollen(along + t * length));
            }
            along += length;
        }
        StalkMesh::tube(&placed, &thick)
            .expect("an axis is an arc of two turns at most, its radii are above 0")
    }
}

#[cfg(test)]
mod tests;
