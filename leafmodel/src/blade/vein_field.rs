//! The cover of veins at any point of the lamina.

use glam::DVec2;

use super::tissue::Tissue;
use super::vein_cover::{Covers, Moments, VeinCover};
use super::vein_profile::{Profile, Surplus, strength};
use crate::buckets::Buckets;
use crate::document::RangeError;
use crate::plane::{Lattice, bounds};
use crate::venation::network::VeinSegment;

/// The veins of a leaf in a uniform grid; each cell lists every segment within reach.
///
/// A query looks at one cell only and gives exactly the result of a search over all segments, to
/// the bit.
#[derive(Clone, Debug)]
pub struct VeinField {
    profile: Profile,
    full_radius: f64,
    surplus: Surplus,
    segments: Vec<Segment>,
    lattice: Lattice,
    /// Numbers of the segments that reach into each cell.
    entries: Buckets,
}

/// A vein segment prepared for many distance queries.
#[derive(Clone, Copy, Debug)]
struct Segment {
    from: DVec2,
    along: DVec2,
    /// `1 / |along|²`, or 0 for a segment without length.
    inverse_square: f64,
    radius_from: f64,
    radius_growth: f64,
    reach: f64,
}

impl Segment {
    fn new(vein: &VeinSegment, profile: Profile, surplus: Surplus) -> Self {
        let along = vein.to - vein.from;
        let square = along.length_squared();
        let widest = vein.radius_from.max(vein.radius_to);
        let mut reach = profile.reach(widest);
        if widest > surplus.least_radius() {
            reach = reach.max(profile.excess_reach(widest));
        }
        Self {
            from: vein.from,
            along,
            inverse_square: if square > 0.0 { 1.0 / square } else { 0.0 },
            radius_from: vein.radius_from,
            radius_growth: vein.radius_to - vein.radius_from,
            reach,
        }
    }

    /// Lower left and upper right corner of what the segment and its reach fill.
    fn rectangle(&self) -> [DVec2; 2] {
        let to = self.from + self.along;
        [
            self.from.min(to) - self.reach,
            self.from.max(to) + self.reach,
        ]
    }

    /// Squared distance to the axis, and where along it the point lies: from 0 to 1 beside it, less
    /// or more beyond its ends.
    fn nearest(&self, point: DVec2) -> (f64, f64) {
        let offset = point - self.from;
        let t = offset.dot(self.along) * self.inverse_square;
        (
            (offset - t.clamp(0.0, 1.0) * self.along).length_squared(),
            t,
        )
    }

    fn add_to(&self, covers: &mut Covers, point: DVec2, field: &VeinField) {
        let (profile, full_radius) = (field.profile, field.full_radius);
        let (square, t) = self.nearest(point);
        if square >= self.reach * self.reach {
            return;
        }
        let distance = square.sqrt();
        let radius = self.radius_from + t.clamp(0.0, 1.0) * self.radius_growth;
        let strength = strength(radius, full_radius);
        let weight = Moments {
            mean: strength * profile.weight(distance, radius),
            square: strength * strength * profile.square(distance, radius),
        };
        let is_beside = (0.0..1.0).contains(&t);
        covers.add(
            weight,
            is_beside,
            profile.excess(distance, radius, field.surplus),
        );
    }
}

impl VeinField {
    /// Whether a field of these veins can be made.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for a vein that has a coordinate beyond 10⁵ mm or a radius not above 0 and up
    /// to 1000 mm.
    pub(crate) fn check(veins: impl IntoIterator<Item = VeinSegment>) -> Result<(), RangeError> {
        veins.into_iter().try_for_each(|vein| check(&vein))
    }

    /// Sorts the veins. With `texel_mm` > 0 the field is averaged over texels of that width, so
    /// that veins thinner than a texel are neither lost nor broken; with 0 it is not averaged.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for a tissue out of range, for a vein that has a coordinate beyond 10⁵ mm or
    /// a radius not above 0 and up to 1000 mm, and for a texel below 0 or above 10⁵ mm.
    pub fn new(veins: &[VeinSegment], tissue: &Tissue, texel_mm: f64) -> Result<Self, RangeError> {
        tissue.validate()?;
        let valid = (0.0..=1e5).contains(&texel_mm);
        RangeError::unless(valid, "texel width", texel_mm, "from 0 to 100000 mm")?;
        Self::check(veins.iter().copied())?;
        let profile = Profile {
            sheath: tissue.sheath_width_mm,
            texel: texel_mm,
        };
        let surplus = Surplus::of(tissue);
        let segments: Vec<Segment> = veins
            .iter()
            .map(|vein| Segment::new(vein, profile, surplus))
            .collect();
        let (low, high) = match segments[..] {
            [] => (DVec2::ZERO, DVec2::ZERO),
            _ => bounds(segments.iter().flat_map(Segment::rectangle)),
        };
        let size = high - low;
        // About one cell per segment, with sides not much smaller than the reach of the finest
        // veins, and at most 4096 cells per side.
        let even = (size.x * size.y / segments.len().max(1) as f64).sqrt();
        let cell = even
            .max(0.5 * (profile.sheath + profile.texel))
            .max(size.max_element() / 4096.0);
        let lattice = Lattice::new(low, size, cell);
        // From a cell's centre to its corner, and a little for rounding.
        let corner = cell * std::f64::consts::FRAC_1_SQRT_2 * (1.0 + 1e-9);
        let reached = (0..).zip(&segments).flat_map(|(number, segment)| {
            let [low, high] = segment.rectangle();
            let limit = segment.reach + corner;
            let lattice = &lattice;
            let cells = lattice
                .cells_between(low, high)
                .filter(move |&cell| segment.nearest(lattice.middle(cell)).0 <= limit * limit);
            cells.map(move |cell| (cell, number))
        });
        Ok(Self {
            profile,
            full_radius: tissue.full_vein_radius_mm,
            surplus,
            entries: Buckets::new(lattice.cells(), reached),
            segments,
            lattice,
        })
    }

    /// The cover of veins at a point in millimetres: that of the strongest vein nearby, and where the
    /// field is averaged over texels that of others beside it.
    #[must_use]
    pub fn cover(&self, point: DVec2) -> VeinCover {
        // No vein reaches points outside the grid; the segments of the nearest cell give 0 there.
        let cell = self.lattice.cell(point);
        let mut covers = Covers::default();
        for &index in self.entries.list(cell) {
            self.segments[index as usize].add_to(&mut covers, point, self);
        }
        covers.all()
    }
}

fn check(vein: &VeinSegment) -> Result<(), RangeError> {
    for value in [vein.from.x, vein.from.y, vein.to.x, vein.to.y] {
        let valid = value.abs() <= 1e5;
        RangeError::unless(valid, "vein coordinate", value, "within ±100000 mm")?;
    }
    for value in [vein.radius_from, vein.radius_to] {
        let valid = value > 0.0 && value <= 1000.0;
        RangeError::unless(valid, "vein radius", value, "above 0, to 1000 mm")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::tissue::tests::GREEN;
    use super::*;
    use properties::fixed;

    fn vein(from: [f64; 2], to: [f64; 2], radius_from: f64, radius_to: f64) -> VeinSegment {
        VeinSegment {
            from: DVec2::from(from),
            to: DVec2::from(to),
            radius_from,
            radius_to,
            order: 1,
        }
    }

    fn over_all(field: &VeinField, point: DVec2) -> VeinCover {
        let mut covers = Covers::default();
        for segment in &field.segments {
            segment.add_to(&mut covers, point, field);
        }
        covers.all()
    }

    fn any_vein() -> impl Strategy<Value = VeinSegment> {
        let place = || [-10.0..10.0, -10.0..10.0];
        let length = || [-3.0..3.0, -3.0..3.0];
        let radius = || 0.01..0.8;
        (place(), length(), radius(), radius()).prop_map(|(from, along, start, end)| {
            vein(from, [from[0] + along[0], from[1] + along[1]], start, end)
        })
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn the_grid_gives_what_a_search_over_all_veins_gives(
            veins in prop::collection::vec(any_vein(), 0..60),
            points in prop::collection::vec([-14.0..14.0, -14.0..14.0], 100),
            texel in prop::sample::select(vec![0.0, 0.05, 1.0]),
        ) {
            let field = VeinField::new(&veins, &GREEN, texel).expect("all in range");
            // Ends of veins are tested too, since the formula of the distance changes there.
            let ends = veins.iter().flat_map(|vein| [vein.from, vein.to]);
            for point in points.into_iter().map(DVec2::from).chain(ends) {
                prop_assert_eq!(field.cover(point), over_all(&field, point));
            }
        }
    }

    #[test]
    fn a_vein_covers_its_axis_by_its_strength_and_nothing_far_away() {
        let veins = [
            vein([0.0, 0.0], [0.0, 10.0], 0.5, 0.5),
            vein([5.0, 0.0], [5.0, 10.0], 0.0625, 0.0625),
        ];
        let field = VeinField::new(&veins, &GREEN, 0.0).expect("all in range");
        let at = |x| field.cover(DVec2::new(x, 5.0));
        assert_eq!((at(0.0).weight, at(0.0).excess), (1.0, 1.0));
        assert_eq!((at(5.0).weight, at(5.0).excess), (0.5, 0.0));
        assert_eq!(at(2.0), VeinCover::NONE);
        assert_eq!(at(1e4), VeinCover::NONE);
    }

    #[test]
    fn a_tapering_vein_has_the_radius_of_the_nearest_point_of_its_axis() {
        let veins = [vein([0.0, 0.0], [10.0, 0.0], 0.25, 1.25)];
        let field = VeinField::new(&veins, &GREEN, 0.0).expect("all in range");
        assert_eq!(field.cover(DVec2::new(5.0, 0.0)).excess, 2.0);
        assert_eq!(field.cover(DVec2::new(5.0, 0.75)).weight, 1.0);
    }

    #[test]
    fn a_vein_without_length_is_a_dot() {
        let field = VeinField::new(&[vein([1.0, 1.0], [1.0, 1.0], 0.25, 0.25)], &GREEN, 0.0)
            .expect("all in range");
        assert_eq!(field.cover(DVec2::new(1.2, 1.0)).weight, 1.0);
        assert_eq!(field.cover(DVec2::new(2.0, 1.0)), VeinCover::NONE);
    }

    #[test]
    fn veins_out_of_range_are_refused() {
        for (bad, field) in [
            (
                vein([f64::NAN, 0.0], [1.0, 0.0], 0.1, 0.1),
                "vein coordinate",
            ),
            (vein([0.0, 0.0], [1.0, 1e6], 0.1, 0.1), "vein coordinate"),
            (vein([0.0, 0.0], [1.0, 0.0], 0.0, 0.1), "vein radius"),
            (
                vein([0.0, 0.0], [1.0, 0.0], 0.1, f64::INFINITY),
                "vein radius",
            ),
        ] {
            let error = VeinField::new(&[bad], &GREEN, 0.0).expect_err("out of range");
            assert_eq!(error.path, field);
        }
        assert!(VeinField::new(&[], &GREEN, f64::NAN).is_err());
    }
}
