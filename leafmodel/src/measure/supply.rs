//! How veins supply a leaf with water, and what is lost when they are cut.
//!
//! Each edge is a pipe with the radii of the vein, in which water flows by Poiseuille's law: a cone
//! between the radii `r` and `s` over the length `l` has the conductance
//! `g = 3 π r³ s³ / (8 μ l (r² + r s + s²))`, which is `π r⁴ / (8 μ l)` for a cylinder
//! (\[sutera1993\]). Water enters at the petiole, the origins of the network, and leaves evenly along
//! all veins. With the drop of pressure `p` from the petiole and `Q` all that leaves, the
//! **conductance** is `K = Q / p̄ = Q² / ∫ p dq`, with the mean drop `p̄` over all that leaves.
//!
//! The integral is exact, so that it does not depend on how finely veins are digitised: the flow in an
//! edge falls evenly along it, so the drop between its ends is that of a pipe from which the water
//! leaves at both ends, in the fractions in which the centre of its resistance parts its length. To the
//! power `Σ qᵢ pᵢ` of these pipes each edge adds one of its own, `l³ / (4 r s (r² + r s + s²))` in units
//! of `8 μ/π`, which is `l³ / 12 r⁴` for a cylinder.
//!
//! A vein holds many conduits far finer than itself, so `K` is far above that of a leaf; ratios
//! between leaves and losses are what it is for.

mod condensed;
#[cfg(test)]
mod tests;

use glam::DVec2;
use rayon::prelude::*;

use self::condensed::{Stretches, System};
use super::bridges;
use super::laplacian::{Factored, Pipe};
use super::subject::Subject;

/// Viscosity of water at 20 °C, 1.0016 mPa s (\[huber2009\]), in megapascal seconds: lengths in mm then give
/// conductances in mm³ s⁻¹ MPa⁻¹.
const VISCOSITY_MPA_S: f64 = 1.0016e-9;

/// Where less of the flow between a pipe's ends than this share has a way around the pipe, that share
/// is a difference of numbers too near to each other: the network is solved anew without the pipe.
const LEAST_AROUND: f64 = 1e-8;

/// Losses below this are rounding.
const ROUNDING: f64 = 1e-12;

/// What is lost when one vein is cut in its middle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// Where, mm: the end of the edge in the middle of the vein.
    pub place: DVec2,
    /// Order of the vein.
    pub order: u8,
    /// Its mean radius, mm.
    pub radius_mm: f64,
    /// Its length from junction to junction, mm.
    pub length_mm: f64,
    /// Share of what leaves that is not supplied any more.
    pub cut_off: f64,
    /// Share of the conductance that is lost to what is still supplied; 0 where something is cut
    /// off, since nothing flows past there then.
    pub lost: f64,
}

/// What is lost without all veins of an order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderLoss {
    /// The order.
    pub order: u8,
    /// Share of the length of all other veins that is cut off.
    pub cut_off: f64,
    /// Share of the conductance that is lost to what is still supplied, by the same outflow; `None`
    /// if nothing is.
    pub lost: Option<f64>,
}

/// The supply of a leaf by its veins.
#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    /// Conductance from the petiole, mm³ s⁻¹ MPa⁻¹.
    pub conductance: f64,
    /// Share of the length of veins that hangs together with the petiole.
    pub supplied: f64,
    /// Share of that length on edges whose cut cuts something off.
    pub bridges: f64,
    /// Cuts through the widest veins, widest first.
    pub cuts: Vec<Cut>,
    /// Losses by order.
    pub orders: Vec<OrderLoss>,
}

impl Subject<'_> {
    /// The supply from the petiole, and what is lost when each of the `widest` widest veins is cut,
    /// one at a time, and when all veins of an order are.
    ///
    /// `None` if radii are not known, no vein begins at an origin, or a conductance is
    /// not finite. Losses by order take a solution
    /// for each order; without known orders there are none.
    pub fn supply(&self, widest: usize) -> Option<Supply> {
        if !self.known.radii {
            return None;
        }
        let (graph, chains) = (self.found.graph(), self.found.chains());
        let roots = self.roots();
        let condensed = |is_reached: &dyn Fn(u32) -> bool| {
            let cut = self.widest_chains(widest, is_reached);
            let is_cut = |chain: u32| cut.binary_search(&chain).is_ok();
            Stretches::new(graph, chains, &roots, is_cut)
        };
        let mut stretches = condensed(&|_| true);
        let is_reached = stretches.reached_chains(chains.len());
        // Chains apart from the petiole are no cuts; most networks have none.
        if is_reached.contains(&false) {
            stretches = condensed(&|chain| is_reached[chain as usize]);
        }
        let whole = stretches.system(|_| true)?;
        let total: f64 = stretches.all.iter().map(|stretch| stretch.length).sum();
        let factored = whole.factored()?;
        let drops = factored.solve(&whole.outflow);
        let power = whole.power(&drops);
        if !(power.is_finite() && power > 0.0) {
            return None;
        }
        let beyond = bridges::beyond(whole.count(), &whole.pipes, &whole.outflow);
        let bridges: f64 = whole
            .stretches
            .iter()
            .zip(&beyond)
            .filter(|(_, beyond)| beyond.is_some())
            .map(|(&stretch, _)| stretches.all[stretch as usize].length)
            .sum();
        let cuts = self.cuts(&stretches, &whole, &factored, (&drops, power), &beyond);
        let orders = if self.known.orders {
            without_orders(&stretches, &whole, &factored)
        } else {
            Vec::new()
        };
        Some(Supply {
            conductance: std::f64::consts::PI / (8.0 * VISCOSITY_MPA_S) * whole.total * whole.total
                / power,
            supplied: whole.total / total,
            bridges: bridges / whole.total,
            cuts,
            orders,
        })
    }

    /// The widest chains among some, ascending by number.
    fn widest_chains(&self, count: usize, among: &dyn Fn(u32) -> bool) -> Vec<u32> {
        let radii = &self.found.chains().radii;
        let mut order: Vec<u32> = (0..radii.len() as u32).filter(|&c| among(c)).collect();
        let wider = |a: &u32, b: &u32| {
            let (a_radius, b_radius) = (radii[*a as usize], radii[*b as usize]);
            b_radius.total_cmp(&a_radius).then(a.cmp(b))
        };
        if count < order.len() {
            order.select_nth_unstable_by(count, wider);
            order.truncate(count);
        }
        order.sort_unstable();
        order
    }

    /// Which nodes of the plane graph are origins.
    fn roots(&self) -> Vec<bool> {
        let origins = &self.network.nodes()[..self.network.origins()];
        let mut places: Vec<[u64; 2]> = origins.iter().map(|node| bits(node.position)).collect();
        places.sort_unstable();
        let nodes = self.found.graph().nodes().iter();
        nodes
            .map(|place| places.binary_search(&bits(*place)).is_ok())
            .collect()
    }

    /// What each cut loses, widest vein first.
    fn cuts(
        &self,
        stretches: &Stretches,
        whole: &System,
        factored: &Factored,
        (drops, power): (&[f64], f64),
        beyond: &[Option<f64>],
    ) -> Vec<Cut> {
        let (chains, graph) = (self.found.chains(), self.found.graph());
        let mut pipe_of = vec![u32::MAX; stretches.all.len()];
        for (pipe, &stretch) in (0..).zip(&whole.stretches) {
            pipe_of[stretch as usize] = pipe;
        }
        let mut scratch = vec![0.0; whole.count()];
        let drop_at = |end: u32| {
            if end == Pipe::GROUND {
                0.0
            } else {
                drops[end as usize]
            }
        };
        let radius = |chain: u32| chains.radii[chain as usize];
        let mut middles = stretches.middles.clone();
        middles.sort_by(|a, b| radius(b.0).total_cmp(&radius(a.0)).then(a.0.cmp(&b.0)));
        let cut = |(chain, stretch): (u32, u32)| {
            let pipe = pipe_of[stretch as usize];
            if pipe == u32::MAX {
                return None; // It hangs together with no petiole.
            }
            let Pipe { ends, conductance } = whole.pipes[pipe as usize];
            let (cut_off, lost) = if let Some(beyond) = beyond[pipe as usize] {
                (beyond / whole.total, 0.0)
            } else {
                // By Sherman and Morrison's formula for one pipe less.
                let between = drop_at(ends[0]) - drop_at(ends[1]);
                let around = 1.0 - conductance * factored.resistance(ends, &mut scratch);
                let more = conductance * between * between / around;
                let lost = more / (power + more);
                if around >= LEAST_AROUND && lost.is_finite() {
                    (0.0, lost)
                } else {
                    (0.0, whole.lost_without(pipe, power))
                }
            };
            let edges = chains.edges(chain);
            let first = &graph.edges()[edges[edges.len() / 2] as usize];
            Some(Cut {
                place: graph.nodes()[first.to as usize],
                order: first.order,
                radius_mm: radius(chain),
                length_mm: chains.lengths[chain as usize],
                cut_off,
                lost,
            })
        };
        middles.into_iter().filter_map(cut).collect()
    }
}

fn without_orders(stretches: &Stretches, whole: &System, factored: &Factored) -> Vec<OrderLoss> {
    let without = |order: u8| {
        let others = whole.total - whole.lengths[usize::from(order)];
        let Some(left) = stretches.system(|stretch| stretch.order != order) else {
            let cut_off = if others > 0.0 { 1.0 } else { 0.0 };
            return OrderLoss {
                order,
                cut_off,
                lost: None,
            };
        };
        let after = left.factored();
        let after = after.map(|after| left.power(&after.solve(&left.outflow)));
        // The same outflow in the whole network.
        let before = whole.power_of(&left, factored);
        OrderLoss {
            order,
            cut_off: Some(1.0 - left.total / others)
                .filter(|lost| *lost >= ROUNDING)
                .unwrap_or(0.0),
            lost: after
                .map(|after| 1.0 - before / after)
                .filter(|lost| lost.is_finite())
                // What is no more than rounding is nothing.
                .map(|lost| if lost < ROUNDING { 0.0 } else { lost }),
        }
    };
    let orders: Vec<u8> = (1..=u8::MAX)
        .filter(|order| whole.lengths[usize::from(*order)] > 0.0)
        .collect();
    orders.into_par_iter().map(without).collect()
}

fn bits(place: DVec2) -> [u64; 2] {
    [place.x.to_bits(), place.y.to_bits()]
}
