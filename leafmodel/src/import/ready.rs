//! From what a file tells to a network that can be measured.

use crate::document::source::quoted;
use glam::DVec2;

use super::draft::{ABSENT, Draft, Units};
use super::error::ImportError;
use super::faults::{Fault, FaultKind};
use super::{courses, margins, repair, roots};
use crate::measure::Known;
use crate::plane::bounds;
use crate::shape::outline::Outline;
use crate::venation::network::{self, FARTHEST_MM, VeinEdge, VeinNode, VenationNetwork};
use crate::venation::order::{Look, orders};
use crate::venation::planar::PlaneGraph;
use crate::venation::topology::Topology;

/// Segments along a leaf whose file gives none: as many as most leaves of this program have.
const SEGMENTS: f64 = 200.0;

/// What the person who asks knows beyond the file.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wanted {
    /// Millimetres to a unit (a pixel) of the file, finite and above 0; for lengths without a unit.
    pub mm_per_unit: Option<f64>,
    /// Where the petiole is, mm: the node nearest to it is the root.
    pub root: Option<DVec2>,
    /// Whether y points down in the file.
    pub y_down: bool,
}

/// A network from a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The veins, mm. Unknown radii and orders hold the place of numbers and mean nothing.
    pub network: VenationNetwork,
    /// The margins of the file: one, of a compound leaf several, or none.
    pub outlines: Vec<Outline>,
    /// What is known.
    pub known: Known,
    /// Whether orders were not in the file but found from radii.
    pub orders_found: bool,
    /// What is wrong, by kind; none is an error.
    pub faults: Vec<Fault>,
}

impl Draft {
    /// The same with this margin instead of the file's own.
    pub fn within(self, outline: Outline) -> Self {
        Self {
            given: Some(outline),
            ..self
        }
    }

    /// Whether there is a margin.
    pub fn has_margin(&self) -> bool {
        !self.margins.is_empty()
    }

    /// The margins alone.
    ///
    /// # Errors
    ///
    /// [`ImportError`] if a margin is none, or lacks a scale.
    pub fn outlines(mut self, wanted: &Wanted) -> Result<Vec<Outline>, ImportError> {
        self.scale(wanted)?;
        self.made_outlines()
    }

    /// The network.
    ///
    /// Veins outside of all margins, such as the petiole, are left out. Edges that lead away from the
    /// petiole stay as they are: those of a directed file without circles, with radii that do not
    /// grow, where the nodes without an incoming edge come first or each part has one, and one of
    /// these is the node nearest to `wanted.root` if that is given. Others are turned by their
    /// distance from the root along veins. The root is the node nearest to
    /// `wanted.root` or to the margin's base, else the widest end of a vein.
    ///
    /// # Errors
    ///
    /// [`ImportError`]: there are no veins, lengths lack a scale, or faults are such that measuring
    /// makes no sense.
    pub fn network(mut self, wanted: &Wanted) -> Result<Imported, ImportError> {
        if self.edges.is_empty() {
            return Err(ImportError::NoVeins("edges between nodes"));
        }
        let faults = self.senseless();
        if !faults.is_empty() {
            return Err(ImportError::Faulty(faults));
        }
        self.scale(wanted)?;
        courses::drawn(&mut self);
        let far = self.bad_places(" mm", |place| place.abs().max_element() > FARTHEST_MM);
        if far.count > 0 {
            return Err(ImportError::Faulty(vec![far]));
        }
        let outlines = match self.given.take() {
            Some(outline) => vec![outline],
            None => self.made_outlines()?,
        };
        let segment_mm = self.segment_mm.filter(|mm| mm.is_finite() && *mm > 0.0);
        let segment_mm = segment_mm.unwrap_or_else(|| self.usual_segment());
        let mut faults = std::mem::take(&mut self.remarks);
        margins::leave_out_outside(&mut self, &outlines, &mut faults)?;
        let known_radii = self
            .edges
            .iter()
            .all(|edge| edge.radii.iter().all(Option::is_some));
        faults.extend(self.without_radius());
        let has_orders = self.edges.iter().all(|edge| edge.order.is_some());
        let network = if let Some(network) = self.as_it_is(segment_mm, wanted.root) {
            network
        } else {
            repair::mend(&mut self, &mut faults);
            if self.edges.is_empty() {
                return Err(ImportError::NoVeins(
                    "edges with a length; all join a node to itself or nodes at one place",
                ));
            }
            let base = wanted.root.or_else(|| outlines.first().map(Outline::base));
            roots::turned(&self, base, segment_mm, &mut faults)?
        };
        let known = Known {
            radii: known_radii,
            orders: has_orders || known_radii,
        };
        let network = if has_orders || !known_radii {
            network
        } else {
            with_orders(&network)?
        };
        warn_of(&network, &mut faults);
        faults.sort_by_key(|fault| fault.kind);
        Ok(Imported {
            network,
            outlines,
            known,
            orders_found: known.orders && !has_orders,
            faults,
        })
    }

    /// Faults with which nothing can be measured.
    fn senseless(&self) -> Vec<Fault> {
        let mut loose = Fault::new(FaultKind::LooseEnd);
        for (edge, node) in &self.loose {
            loose.named(|| format!("{edge}: node {}", quoted(node)));
        }
        if loose.count == 0 {
            for (number, edge) in self.edges.iter().enumerate() {
                if edge.ends.contains(&ABSENT) {
                    loose.named(|| format!("edge {number} names no node at one end"));
                }
            }
        }
        let places = self.bad_places("", |place| !place.is_finite());
        let mut radii = Fault::new(FaultKind::BadRadius);
        for (number, edge) in self.edges.iter().enumerate() {
            if let Some(bad) = edge.bad_radius() {
                let [from, to] = edge.ends.map(|end| {
                    if end == ABSENT {
                        "?".to_owned()
                    } else {
                        self.name(end)
                    }
                });
                radii.named(|| {
                    let place = self.bad_radii.get(&number);
                    let place = place.map_or_else(String::new, |place| format!("{place}: "));
                    format!("{place}edge {number} from node {from} to {to} has the radius {bad}")
                });
            }
        }
        let all = [loose, places, radii].into_iter();
        all.filter(|fault| fault.count > 0).collect()
    }

    /// Edges without a radius, if others have one.
    fn without_radius(&self) -> Option<Fault> {
        let mut fault = Fault::new(FaultKind::NoRadius);
        for edge in self.edges.iter().filter(|edge| edge.radii.contains(&None)) {
            fault.named(|| {
                let [from, to] = edge.ends.map(|end| self.name(end));
                format!("from node {from} to {to}")
            });
        }
        (fault.count > 0 && fault.count < self.edges.len()).then_some(fault)
    }

    /// Nodes at places that are bad; `unit` is that of the places.
    fn bad_places(&self, unit: &str, is_bad: impl Fn(DVec2) -> bool) -> Fault {
        let mut fault = Fault::new(FaultKind::BadPlace);
        for (number, &place) in (0..).zip(&self.places).filter(|(_, place)| is_bad(**place)) {
            let DVec2 { x, y } = place;
            fault.named(|| format!("node {} is at ({x}, {y}){unit}", self.name(number)));
        }
        fault
    }

    /// Lengths in millimetres, y up.
    fn scale(&mut self, wanted: &Wanted) -> Result<(), ImportError> {
        let factor = |units: Units, given: Option<f64>, what| match (
            units.some_lack,
            units.some_have,
            given,
        ) {
            (true, true, _) => Err(ImportError::MixedUnits(what)),
            (false, ..) => Ok(1.0),
            (true, false, Some(factor)) => Ok(factor),
            (true, false, None) => Err(ImportError::NoScale(what)),
        };
        let places = factor(self.place_units, wanted.mm_per_unit, "places")?;
        let radii = factor(self.radius_units, wanted.mm_per_unit, "radii")?;
        let turn = if self.is_y_down || wanted.y_down {
            -1.0
        } else {
            1.0
        };
        let of_places = if self.place_units.some_lack {
            places
        } else {
            self.place_mm.unwrap_or(1.0)
        };
        let lengths = factor(self.length_units, Some(of_places), "lengths")?;
        for length in self.lengths.values_mut() {
            *length *= lengths;
        }
        let image = |p: DVec2| DVec2::new(p.x * places, turn * p.y * places);
        if places != 1.0 || turn != 1.0 {
            for place in &mut self.places {
                *place = image(*place);
            }
            for point in self.courses.values_mut().flatten() {
                *point = image(*point);
            }
            for margin in &mut self.margins {
                for point in &mut margin.points {
                    *point = image(*point);
                }
                margin.base = margin.base.map(image);
                margin.apex = margin.apex.map(image);
            }
        }
        if radii != 1.0 {
            for edge in &mut self.edges {
                edge.radii = edge.radii.map(|radius| radius.map(|radius| radius * radii));
            }
        }
        Ok(())
    }

    /// Length of a segment where the file gives none, above 0: a fraction of the extent of the veins,
    /// so that it depends neither on how finely they are digitised nor on the margin.
    fn usual_segment(&self) -> f64 {
        let (low, high) = bounds(self.places.iter().copied());
        let extent = (high - low).max_element();
        if extent > 0.0 { extent / SEGMENTS } else { 1.0 }
    }

    /// The network with the directions of the file, if they lead away from the petiole and nothing
    /// has to be mended.
    fn as_it_is(&self, segment_mm: f64, root: Option<DVec2>) -> Option<VenationNetwork> {
        if !self.is_directed {
            return None;
        }
        let mut is_led_to = vec![false; self.places.len()];
        let mut is_left = is_led_to.clone();
        for edge in &self.edges {
            is_left[edge.ends[0] as usize] = true;
            is_led_to[edge.ends[1] as usize] = true;
        }
        // Nothing grows from a bare node.
        if is_led_to
            .iter()
            .zip(&is_left)
            .any(|(to, left)| !to && !left)
        {
            return None;
        }
        if let Some(root) = root {
            let away = |node: usize| (self.places[node] - root).length_squared();
            let least = |nodes: &mut dyn Iterator<Item = usize>| {
                nodes.map(away).fold(f64::INFINITY, f64::min)
            };
            let count = self.places.len();
            if least(&mut (0..count).filter(|&node| !is_led_to[node])) > least(&mut (0..count)) {
                return None;
            }
        }
        // Starts come first, as origins do, or each part has one; a bare node behind the first start
        // has to be left out.
        let starts = is_led_to.iter().filter(|led_to| !**led_to).count();
        let first = is_led_to.iter().take_while(|led_to| !**led_to).count();
        let born = |node: usize| self.born.get(node).copied().unwrap_or(0);
        let nodes = self.places.iter().enumerate();
        let nodes = nodes.map(|(node, &position)| VeinNode {
            position,
            born: born(node),
        });
        let edges = self.vein_edges(segment_mm);
        let network = VenationNetwork::from_parts(nodes.collect(), edges, segment_mm).ok()?;
        let leads_away = starts == first || (first > 0 && starts == network.components());
        leads_away.then_some(network)
    }

    /// The edges, with numbers in place of what is unknown.
    pub(super) fn vein_edges(&self, segment_mm: f64) -> Vec<VeinEdge> {
        let unknown = 0.1 * segment_mm;
        let edges = self.edges.iter().map(|edge| {
            let [start, end] = edge.radii;
            VeinEdge {
                from: edge.ends[0],
                to: edge.ends[1],
                radius_from: start.or(end).unwrap_or(unknown),
                radius_to: end.or(start).unwrap_or(unknown),
                order: edge.order.unwrap_or(1),
            }
        });
        edges.collect()
    }
}

/// The same network with orders by width and branching.
fn with_orders(network: &VenationNetwork) -> Result<VenationNetwork, ImportError> {
    let ends = network::ends(network.edges());
    let topology = Topology::new(network.nodes().len(), &ends);
    let broken = |_| ImportError::NoVeins("edges without circles");
    let sorted = topology.base_to_tip().map_err(broken)?;
    let places: Vec<DVec2> = network.nodes().iter().map(|node| node.position).collect();
    let radii: Vec<f64> = network
        .edges()
        .iter()
        .map(|edge| edge.radius_from)
        .collect();
    let segment_mm = network.segment_mm();
    let look = Look::Length { segment_mm };
    let found = orders(&topology, &places, &radii, &sorted, &[], look);
    let mut edges = network.edges().to_vec();
    for (edge, order) in edges.iter_mut().zip(found.edges) {
        edge.order = order.max(1);
    }
    VenationNetwork::from_parts(network.nodes().to_vec(), edges, segment_mm)
        .map_err(|error| ImportError::malformed("network", error.to_string()))
}

/// Faults that a valid network can have.
fn warn_of(network: &VenationNetwork, faults: &mut Vec<Fault>) {
    let plane = PlaneGraph::new(network);
    for (kind, places) in [
        (FaultKind::Crossing, plane.crossing_places()),
        (FaultKind::Touch, plane.touch_places()),
        (FaultKind::Apart, &roots::parts_without_petiole(network)),
    ] {
        if !places.is_empty() {
            let mut fault = Fault::new(kind);
            for &place in places {
                fault.at(place);
            }
            faults.push(fault);
        }
    }
}
