//! The network of veins of a transport leaf.

use glam::DVec2;

use super::blade::Frame;
use super::contour::place;
use super::leaf::TransportLeaf;
use super::vein_style::VeinStyle;
use crate::document::Declared;
use crate::not_grown::NotGrown;
use crate::shape::outline::Outline;
use crate::venation::network::{VeinEdge, VeinNode, VenationNetwork};
use crate::venation::order;
use crate::venation::topology::Topology;

/// How far, in cells, smoothing may move a point of a vein from the centre of its cell.
const VEIN_TETHER: f64 = 0.4;

/// Rounds of smoothing of veins.
const VEIN_ROUNDS: usize = 3;

impl TransportLeaf {
    /// The veins, in the frame of [`TransportLeaf::outline`] for the same length.
    ///
    /// A vein runs through the cells that it supplies; smoothing moves it from their centres by
    /// less than half a cell. The first node is the base. Vein orders are assigned as in any other
    /// network.
    ///
    /// # Errors
    ///
    /// As [`TransportLeaf::outline`].
    pub fn network(&self, length_mm: f64, style: VeinStyle) -> Result<VenationNetwork, NotGrown> {
        style.in_range()?;
        let (frame, outline) = self.framed(length_mm)?;
        Ok(self.network_in(&frame, &outline, style, self.counts()[0]))
    }

    /// The veins in a frame. A vein that supplies `widest` cells has the radius that `style` gives
    /// for the base.
    pub(crate) fn network_in(
        &self,
        frame: &Frame,
        outline: &Outline,
        style: VeinStyle,
        widest: u32,
    ) -> VenationNetwork {
        let places = self.vein_places(style.least_cells, |from, to| {
            frame.is_walled && outline.is_crossed_by(frame.to_mm(from), frame.to_mm(to))
        });
        let width = |v: usize| {
            let share = f64::from(self.counts()[v]) / f64::from(widest);
            style.base_radius_mm * share.sqrt()
        };
        let mut nodes = vec![VeinNode {
            position: frame.to_mm(frame.base),
            born: 0,
        }];
        let mut pairs: Vec<[u32; 2]> = Vec::new();
        let mut flows = vec![width(0)];
        let mut radii = Vec::new();
        let mut numbers: Vec<Option<u32>> = vec![None; self.cells().len()];
        // Where smoothing has moved the margin past the root's centre, the base takes its place.
        for v in self.root_to_tip() {
            let parent = self.parent(v).and_then(|p| numbers[p]);
            let position = frame.to_mm(places[v]);
            let lies_inside = outline.contains(position);
            let lies_above = (places[v] - frame.base).dot(frame.up) > 0.0;
            if self.parent(v).is_none() && !(lies_inside && lies_above) {
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
        let orders = order::orders(
            &topology,
            &positions,
            &radii,
            &base_to_tip,
            &[],
            order::Look::Segments,
        );
        let edges = (0..).zip(&pairs).map(|(edge, &[from, to])| {
            let radius_to = radii[edge as usize];
            // A lateral starts with its own radius; only a vein that continues tapers between its
            // nodes.
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
        network.expect("a tree whose weights fall from root to tip is a network")
    }

    /// The places of veins: the centres of cells, smoothed along each vein. Where `is_barred`
    /// rejects the straight way between two smoothed places, the centres are kept.
    fn vein_places(
        &self,
        least_cells: u32,
        is_barred: impl Fn(DVec2, DVec2) -> bool,
    ) -> Vec<DVec2> {
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
                // The axis of a mirrored leaf is straight, and its widest branch may be one of a
                // pair.
                (Some(p), Some(next)) if !(self.is_mirrored() && cells[v].m == 0) => {
                    let moved = 0.5 * (places[v] + 0.5 * (places[p] + places[next]));
                    centres[v] + (moved - centres[v]).clamp_length_max(VEIN_TETHER)
                }
                _ => places[v],
            };
            places = (0..cells.len()).map(smooth).collect();
        }
        loop {
            let moved = |v: usize| places[v] != centres[v];
            let ways = (1..cells.len()).filter_map(|v| Some((v, self.parent(v)?)));
            let barred: Vec<(usize, usize)> = ways
                .filter(|&(v, p)| (moved(v) || moved(p)) && is_barred(places[p], places[v]))
                .collect();
            if barred.is_empty() {
                return places;
            }
            for (v, p) in barred {
                places[v] = centres[v];
                places[p] = centres[p];
            }
        }
    }
}
