//! The cell leaf as an outline and a network of veins, like those of any other leaf.

use glam::DVec2;

use super::contour::{contour, first_hit, is_inside, place, smoothed};
use super::leaf::TransportLeaf;
use super::plan::TransportError;
use crate::shape::outline::{Outline, OutlineError};
use crate::venation::network::{VeinEdge, VeinNode, VenationNetwork};
use crate::venation::order;
use crate::venation::topology::Topology;

/// How far a point of the margin may be smoothed away from the middle between two cells, in cells. Other parts of
/// the margin are never nearer than 0.7, so that with the second figure they cannot meet.
const TETHERS: [f64; 2] = [0.45, 0.3];

/// How far a point of a vein may be smoothed away from the centre of its cell, in cells.
const VEIN_TETHER: f64 = 0.4;

/// Rounds of smoothing of veins.
const VEIN_ROUNDS: usize = 3;

/// How veins are drawn from weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VeinStyle {
    /// Radius of the midrib at the base, mm, 0.0001 to 100. Elsewhere `r ∝ w^½`.
    pub base_radius_mm: f64,
    /// Veins that supply fewer cells are left out; with 1 every cell has a vein. 1 to 1 000 000.
    pub least_cells: u32,
}

impl VeinStyle {
    /// Checks every number.
    ///
    /// # Errors
    ///
    /// [`TransportError::OutOfRange`].
    pub fn validate(&self) -> Result<(), TransportError> {
        let radius = self.base_radius_mm;
        check("base_radius_mm", radius, 1e-4, 100.0, "0.0001 to 100 mm")?;
        let least = f64::from(self.least_cells);
        check("least_cells", least, 1.0, 1e6, "1 to 1000000")
    }
}

/// Where the blade lies in the grid.
struct Frame {
    margin: Vec<DVec2>,
    base: DVec2,
    apex: DVec2,
    /// Direction of the midrib.
    up: DVec2,
    /// Millimetres a cell.
    scale: f64,
}

impl Frame {
    fn to_mm(&self, p: DVec2) -> DVec2 {
        let from_base = p - self.base;
        DVec2::new(from_base.perp_dot(self.up), from_base.dot(self.up)) * self.scale
    }

    fn outline(&self) -> Result<Outline, OutlineError> {
        let margin = self.margin.iter().map(|&p| self.to_mm(p)).collect();
        Outline::new(margin, DVec2::ZERO, self.to_mm(self.apex))
    }
}

impl TransportLeaf {
    /// A smooth margin around the cells: base below the root at the origin, apex where the midrib comes to the margin, `length_mm`
    /// above it (0.001 to 100 000). If the blade has closed below the root, the base is the root itself. Holes in the leaf are
    /// filled.
    ///
    /// # Errors
    ///
    /// [`TransportError::OutOfRange`]; [`TransportError::Outline`] should no margin come of it.
    pub fn outline(&self, length_mm: f64) -> Result<Outline, TransportError> {
        Ok(self.framed(length_mm)?.1)
    }

    /// The veins, in the frame of [`TransportLeaf::outline`] for the same length.
    ///
    /// A vein runs through the centres of the cells it supplies, but for less than half a cell by which it is smoothed. The first node is
    /// the base. Orders are given as to any other network.
    ///
    /// # Errors
    ///
    /// As [`TransportLeaf::outline`].
    pub fn network(
        &self,
        length_mm: f64,
        style: VeinStyle,
    ) -> Result<VenationNetwork, TransportError> {
        style.validate()?;
        let radius = style.base_radius_mm;
        let (frame, outline) = self.framed(length_mm)?;
        let places = self.vein_places(style.least_cells);
        let widest = f64::from(self.counts()[0]);
        let width = |v: usize| radius * (f64::from(self.counts()[v]) / widest).sqrt();

        let mut nodes = vec![VeinNode {
            position: DVec2::ZERO,
            born: 0,
        }];
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        let mut flows = vec![radius];
        let mut radii = Vec::new();
        let mut numbers: Vec<Option<u32>> = vec![None; self.cells().len()];
        // Where the margin has been smoothed past the root's centre, the base stands for it.
        for v in self.root_to_tip() {
            let parent = self.parent(v).and_then(|p| numbers[p]);
            let position = frame.to_mm(places[v]);
            let lies_inside = outline.contains(position);
            if self.parent(v).is_none() && !(lies_inside && position.y > 0.0) {
                numbers[v] = Some(0);
                continue;
            }
            let from = if self.parent(v).is_none() {
                Some(0)
            } else {
                parent
            };
            let Some(from) = from else { continue };
            if self.counts()[v] < style.least_cells || !lies_inside {
                continue;
            }
            let number = nodes.len() as u32;
            numbers[v] = Some(number);
            nodes.push(VeinNode {
                position,
                born: self.generations()[v],
            });
            pairs.push([from, number]);
            radii.push(width(v));
            flows.push(width(v));
        }
        let positions: Vec<DVec2> = nodes.iter().map(|node| node.position).collect();
        let topology = Topology::new(nodes.len(), &pairs);
        let base_to_tip: Vec<u32> = (0..nodes.len() as u32).collect();
        let orders = order::orders(&topology, &positions, &radii, &base_to_tip);
        let edges = (0..).zip(&pairs).map(|(edge, &[from, to])| {
            let radius_to = radii[edge as usize];
            // A lateral starts as wide as it goes on; only the vein itself tapers where it gives one off.
            let continues = orders.continuations[from as usize] == Some(edge);
            VeinEdge {
                from,
                to,
                radius_from: if continues {
                    flows[from as usize]
                } else {
                    radius_to
                },
                radius_to,
                order: orders.edges[edge as usize],
            }
        });
        let network = VenationNetwork::from_parts(nodes, edges.collect(), frame.scale);
        Ok(network.expect("a tree whose weights fall from root to tip is a network"))
    }

    fn framed(&self, length_mm: f64) -> Result<(Frame, Outline), TransportError> {
        let range = "0.001 to 100000 (millimetres)";
        check("length_mm", length_mm, 0.001, 100_000.0, range)?;
        let steps = contour(self.cells());
        let midrib = self.midrib();
        let mut result = Err(OutlineError::NoMidrib);
        for tether in TETHERS {
            let Some(mut frame) = self.frame(smoothed(&steps, tether), &midrib) else {
                continue;
            };
            frame.scale = length_mm / (frame.apex - frame.base).length();
            result = frame.outline().map(|outline| (frame, outline));
            if result.is_ok() {
                break;
            }
        }
        Ok(result?)
    }

    /// Base and apex: where the midrib comes to the margin, back from its first cell inside and on from its last.
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
        // A blade that has closed around the petiole is attached inside the margin.
        let closed = (start - below).length() > 1.0;
        let base = if closed { start } else { below };
        let apex = first_hit(&margin, centre(&midrib[last]), step_to(last))?;
        let up = (apex - base).try_normalize()?;
        Some(Frame {
            margin,
            base,
            apex,
            up,
            scale: 1.0,
        })
    }

    /// Where veins run: cells' centres, smoothed along each vein.
    fn vein_places(&self, least_cells: u32) -> Vec<DVec2> {
        let cells = self.cells();
        let centres: Vec<DVec2> = cells.iter().map(|&cell| place(cell)).collect();
        let mut main = vec![None; cells.len()];
        for v in (1..cells.len()).filter(|&v| self.counts()[v] >= least_cells) {
            if let Some(p) = self.parent(v) {
                let wider = |best: usize| self.counts()[v] > self.counts()[best];
                if main[p].is_none_or(wider) {
                    main[p] = Some(v);
                }
            }
        }
        let mut places = centres.clone();
        for _ in 0..VEIN_ROUNDS {
            let smooth = |v: usize| match (self.parent(v), main[v]) {
                // The axis of a mirrored leaf is straight, and its widest branch may be one of a pair.
                (Some(p), Some(next)) if !(self.is_mirrored() && cells[v].m == 0) => {
                    let moved = 0.5 * (places[v] + 0.5 * (places[p] + places[next]));
                    centres[v] + (moved - centres[v]).clamp_length_max(VEIN_TETHER)
                }
                _ => places[v],
            };
            places = (0..cells.len()).map(smooth).collect();
        }
        places
    }
}

fn check(
    key: &'static str,
    value: f64,
    low: f64,
    high: f64,
    range: &'static str,
) -> Result<(), TransportError> {
    let good = (low..=high).contains(&value);
    good.then_some(())
        .ok_or(TransportError::OutOfRange { key, value, range })
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
            relief: 0.5,
            thickness_mm: 0.2,
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
