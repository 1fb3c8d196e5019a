//! The frame of a transport leaf in millimetres, and its outline.

use glam::DVec2;

use super::contour::{contour, first_hit, is_inside, place, smoothed};
use super::leaf::TransportLeaf;
use super::plan::no_outline;
use super::vein_style::VeinStyle;
use crate::document::{Declared, RangeError};
use crate::not_grown::NotGrown;
use crate::shape::outline::{Outline, OutlineError};
use crate::venation::network::VenationNetwork;

/// How far, in cells, smoothing may move a point of the margin from the middle between two cells.
/// The second value is tried if the first gives a margin that crosses itself. Different parts of
/// the margin are at least 0.7 cells apart, so with 0.3 they cannot meet.
const TETHERS: [f64; 2] = [0.45, 0.3];

/// Where a blade lies in the grid of cells, and the scale of the grid. All but the scale is in
/// cells.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) margin: Vec<DVec2>,
    pub(crate) base: DVec2,
    pub(crate) apex: DVec2,
    /// The origin of millimetres: the base of the leaf when full-grown.
    pub(crate) origin: DVec2,
    /// Unit direction of the midrib.
    pub(crate) up: DVec2,
    /// Millimetres per cell.
    pub(crate) scale: f64,
    /// Whether the margin was given, not derived from the cells, so that veins must be kept from
    /// crossing it.
    pub(crate) is_walled: bool,
}

impl Frame {
    pub(crate) fn to_mm(&self, p: DVec2) -> DVec2 {
        let from_origin = p - self.origin;
        DVec2::new(from_origin.perp_dot(self.up), from_origin.dot(self.up)) * self.scale
    }

    /// The inverse of [`Frame::to_mm`].
    pub(crate) fn to_cells(&self, mm: DVec2) -> DVec2 {
        let p = mm / self.scale;
        self.origin + self.up * p.y - self.up.perp() * p.x
    }

    fn outline(&self) -> Result<Outline, OutlineError> {
        let margin = self.margin.iter().map(|&p| self.to_mm(p)).collect();
        Outline::new(margin, self.to_mm(self.base), self.to_mm(self.apex))
    }
}

impl TransportLeaf {
    /// A smooth margin around the cells: base at the origin, below the root; apex where the midrib
    /// meets the margin, `length_mm` (0.001 to 100 000) above the base. If the blade has closed
    /// below the root, the base is the root itself. Holes in the leaf are filled.
    ///
    /// # Errors
    ///
    /// [`NotGrown`] for `length_mm`; [`NotGrown`] if the cells
    /// give no valid margin.
    pub fn outline(&self, length_mm: f64) -> Result<Outline, NotGrown> {
        Ok(self.framed(length_mm)?.1)
    }

    /// Margin and veins at each of the given stages, all at the scale of the full-grown leaf of
    /// this length and with the root in the same place. A stage beyond the last means the
    /// full-grown leaf.
    ///
    /// # Errors
    ///
    /// As [`TransportLeaf::outline`].
    pub(crate) fn at_scale(
        &self,
        length_mm: f64,
        style: VeinStyle,
        stages: &[usize],
    ) -> Result<Vec<(Outline, VenationNetwork)>, NotGrown> {
        style.in_range()?;
        let (grown, _) = self.framed(length_mm)?;
        let widest = self.counts()[0];
        let at = |&stage: &usize| {
            let young = self.at_stage(stage);
            let (frame, outline) = young.framed_in(|frame| {
                frame.origin = grown.origin;
                frame.up = grown.up;
                frame.scale = grown.scale;
            })?;
            let network = young.network_in(&frame, &outline, style, widest);
            Ok((outline, network))
        };
        stages.iter().map(at).collect()
    }

    /// The blade's frame and outline when its midrib has this length.
    pub(crate) fn framed(&self, length_mm: f64) -> Result<(Frame, Outline), NotGrown> {
        let valid = (0.001..=1e5).contains(&length_mm);
        RangeError::unless(valid, "length_mm", length_mm, "0.001 to 100000")?;
        self.framed_in(|frame| frame.scale = length_mm / (frame.apex - frame.base).length())
    }

    /// The frame after `settle` has adjusted it, and the outline in it.
    fn framed_in(&self, settle: impl Fn(&mut Frame)) -> Result<(Frame, Outline), NotGrown> {
        let steps = contour(self.cells());
        let midrib = self.midrib();
        let mut result = Err(OutlineError::NoMidrib);
        for tether in TETHERS {
            let Some(mut frame) = self.frame(smoothed(&steps, tether), &midrib) else {
                continue;
            };
            settle(&mut frame);
            result = frame.outline().map(|outline| (frame, outline));
            if result.is_ok() {
                break;
            }
        }
        result.map_err(no_outline)
    }

    /// The frame with base and apex where the midrib, continued backwards from its first cell and
    /// onwards from its last, meets the margin.
    fn frame(&self, margin: Vec<DVec2>, midrib: &[usize]) -> Option<Frame> {
        let centre = |v: &usize| place(self.cells()[*v]);
        let inside = |v: &usize| is_inside(&margin, centre(v));
        let first = midrib.iter().position(inside)?;
        let last = midrib.iter().rposition(inside)?;
        let step_to = |i: usize| match i.checked_sub(1) {
            Some(before) => centre(&midrib[i]) - centre(&midrib[before]),
            None => DVec2::Y,
        };
        let start = centre(&midrib[first]);
        let below = first_hit(&margin, start, -step_to(first))?;
        // In a blade that has closed around the petiole the base lies inside the margin.
        let closed = (start - below).length() > 1.0;
        let base = if closed { start } else { below };
        let apex = first_hit(&margin, centre(&midrib[last]), step_to(last))?;
        let up = (apex - base).try_normalize()?;
        Some(Frame {
            margin,
            base,
            apex,
            origin: base,
            up,
            scale: 1.0,
            is_walled: false,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::blade::BladeForm;
    use crate::blade::mesh::BladeMesh;
    use crate::transport::{TransportPlan, example};

    const STYLE: VeinStyle = VeinStyle {
        base_radius_mm: 0.6,
        least_cells: 3,
    };

    fn leaves() -> Vec<TransportLeaf> {
        let grown = |plan: TransportPlan| plan.grow(1).expect("a good plan");
        let uneven = TransportPlan {
            noise: 0.4,
            ..TransportPlan::default()
        };
        let mut leaves: Vec<TransportLeaf> = (1..=5).filter_map(example).map(grown).collect();
        leaves.push(grown(uneven));
        leaves
    }

    #[test]
    fn margins_keep_the_area_of_the_cells_and_start_at_the_root() {
        for leaf in leaves() {
            let outline = leaf.outline(80.0).expect("a margin");
            let network = leaf.network(80.0, STYLE).expect("veins");
            let cell = network.segment_mm() * network.segment_mm();
            let ratio = outline.area() / (leaf.cells().len() as f64 * cell);
            // Holes are filled, which adds a few cells.
            assert!((0.99..1.02).contains(&ratio), "{ratio}");
            assert_eq!(outline.base(), DVec2::ZERO);
            assert!(outline.apex().x.abs() < 1e-9 && (outline.apex().y - 80.0).abs() < 1e-9);
        }
    }

    #[test]
    fn margins_and_veins_of_mirrored_leaves_are_exact_mirror_images() {
        for leaf in leaves().into_iter().filter(TransportLeaf::is_mirrored) {
            let key = |p: DVec2| [p.x.to_bits(), (p.y + 0.0).to_bits()];
            let sorted = |points: Vec<DVec2>| {
                let mut keys: Vec<[u64; 2]> = points.into_iter().map(key).collect();
                keys.sort_unstable();
                keys
            };
            let image = |p: &DVec2| DVec2::new(0.0 - p.x, p.y);
            let outline = leaf.outline(50.0).expect("a margin");
            let network = leaf.network(50.0, STYLE).expect("veins");
            let veins: Vec<DVec2> = network.nodes().iter().map(|node| node.position).collect();
            for points in [outline.points().to_vec(), veins] {
                let images = points.iter().map(image).collect();
                let points = points.iter().map(|p| *p + DVec2::ZERO).collect();
                assert_eq!(sorted(points), sorted(images));
            }
        }
    }

    #[test]
    fn veins_lie_on_the_blade_taper_and_start_as_wide_as_asked() {
        for leaf in leaves() {
            let outline = leaf.outline(80.0).expect("a margin");
            let network = leaf.network(80.0, STYLE).expect("veins");
            assert_eq!(network.validate(), Ok(()));
            assert_eq!(
                (network.components(), network.loops(), network.origins()),
                (1, 0, 1)
            );
            assert!(
                network.nodes()[1..]
                    .iter()
                    .all(|node| outline.contains(node.position))
            );
            assert_eq!(network.edges()[0].radius_from, 0.6);
            let finest = 0.6 * (3.0 / leaf.cells().len() as f64).sqrt();
            for edge in network.edges() {
                assert!(edge.radius_to >= finest * (1.0 - 1e-12) && edge.radius_from <= 0.6);
            }
            let order = |order: u8| network.edges().iter().filter(|e| e.order == order).count();
            assert!(order(1) > 5 && order(2) > 5);
            let every = VeinStyle {
                least_cells: 1,
                ..STYLE
            };
            let all = leaf.network(80.0, every).expect("veins").nodes().len();
            assert!(all as f64 > 0.95 * leaf.cells().len() as f64 && all <= leaf.cells().len() + 1);
        }
    }

    #[test]
    fn a_blade_that_closes_around_the_petiole_is_attached_at_the_root() {
        let plan = TransportPlan {
            alpha: 0.64,
            beta: 0.15,
            epsilon: 6.0,
            noise: 0.2,
            noise_cells: 12.0,
            ladder: crate::transport::Ladder::Equal(20),
            ..TransportPlan::default()
        };
        let leaf = plan.grow(3).expect("a good plan");
        let below = super::super::Cell::new(0, -1);
        assert!(leaf.cells().contains(&below), "this one does");
        let outline = leaf.outline(80.0).expect("a margin");
        let network = leaf.network(80.0, STYLE).expect("veins");
        assert!(outline.distance_to_margin(outline.base()) > 5.0 * network.segment_mm());
        let root = network.edges().iter().filter(|edge| edge.from == 0);
        assert!(root.count() > 2 && network.nodes()[0].position == DVec2::ZERO);
        assert_eq!(network.validate(), Ok(()));
    }

    #[test]
    fn every_example_can_be_meshed_like_any_other_leaf() {
        let form = BladeForm {
            fold: 0.3,
            curl: 0.4,
            ruffle: 0.01,
            ruffle_waves: 3.0,
            pleat: 0.0,
            relief: 0.5,
            thickness_mm: 0.2,
            margin: crate::blade::MarginThickness::EVEN,
            closed: false,
            max_edge_mm: 3.0,
            meshed_vein_radius_mm: 0.1,
        };
        for leaf in leaves() {
            let outline = leaf.outline(60.0).expect("a margin");
            let network = leaf.network(60.0, STYLE).expect("veins");
            let mesh = BladeMesh::build(&outline, &network, &form).expect("a mesh");
            assert_eq!(mesh.validate(outline.area()), Ok(()));
        }
    }

    #[test]
    fn the_smallest_leaves_have_margins_and_bad_numbers_are_refused() {
        let plan = TransportPlan {
            epsilon: 0.5,
            ..TransportPlan::default()
        };
        let root = plan.grow(0).expect("a good plan");
        assert_eq!(root.cells().len(), 1);
        assert!(root.outline(10.0).is_ok());
        assert!(
            root.network(10.0, STYLE)
                .is_ok_and(|network| network.edges().len() <= 1)
        );
        let refused = |length: f64, style: VeinStyle| {
            let message = root.network(length, style).expect_err("out of range");
            message.to_string()
        };
        assert!(refused(0.0, STYLE).starts_with("length_mm is 0, outside 0.001"));
        let thin = VeinStyle {
            base_radius_mm: f64::NAN,
            ..STYLE
        };
        assert!(refused(10.0, thin).starts_with("base_radius_mm is NaN"));
        let none = VeinStyle {
            least_cells: 0,
            ..STYLE
        };
        assert!(refused(10.0, none).starts_with("least_cells is 0"));
    }
}
