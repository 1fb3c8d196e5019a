//! Damage to a grown leaf: holes, bites from the margin, tears, mines and dieback, each with its
//! dead tissue.
//!
//! Insects and wind find leaves that have grown, so damage comes after the veins. A hole is one of
//! the mesh, too, and no vein leads through it.
//!
//! - **In**: a lamina with its veins, and how much of each kind of damage there is.
//! - **Out**: the same lamina with bites and tears in its margin, holes, veins cut off at all of
//!   them, and places whose tissue is dead; and how far the lips of tears stand out of the plane.
//! - **Always true**: base, apex and midrib stay; the same plan and seed give the same damage.
//! - **Left out**: growth after the damage, galls, and veins that are left standing in what has been
//!   eaten.

mod dieback;
mod places;
mod stains;
mod tears;

use glam::DVec2;

pub use self::dieback::Dieback;
pub(crate) use self::dieback::Front;
use self::places::Places;
pub(crate) use self::stains::Stain;
use self::tears::Tear;
use crate::document::Declared;
use crate::plane::polygon;
use crate::shape::outline::Outline;
use crate::venation::network::VenationNetwork;

/// How much damage there is. Sizes are medians; single ones differ by about a third.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Damage {
    /// Median diameter of holes.
    #[key("hole_mm", 0.1..=100.0)]
    pub hole_mm: f64,
    /// Median width of bites.
    #[key("bite_mm", 0.2..=200.0)]
    pub bite_mm: f64,
    /// Median width of winding mines at their end; they begin at a fifth of it.
    #[key("mine_mm", 0.1..=20.0)]
    pub mine_mm: f64,
    /// Median length of winding mines; less where there is no room.
    #[key("mine_length_mm", 1.0..=1000.0)]
    pub mine_length_mm: f64,
    /// Median diameter of blotch mines.
    #[key("blotch_mm", 0.2..=100.0)]
    pub blotch_mm: f64,
    /// Median length of tears; less where a thick vein stops them.
    #[key("tear_mm", 0.5..=500.0)]
    pub tear_mm: f64,
    /// Width of their mouths over their length.
    #[key("tear_gape", 0.005..=0.5)]
    pub tear_gape: f64,
    /// Height by which one lip stands above the blade at the mouth, and the other below it, over
    /// their length.
    #[key("tear_lift", 0.0..=0.3)]
    pub tear_lift: f64,
    /// Width of the brown rim about holes, bites and tears.
    #[key("rim_mm", 0.0..=10.0)]
    pub rim_mm: f64,
    /// Holes between the larger veins; fewer where there is no room.
    #[key("holes", 0..=200)]
    pub holes: u32,
    /// Bites from the margin.
    #[key("bites", 0..=100)]
    pub bites: u32,
    /// Winding mines: tissue eaten between the two faces.
    #[key("mines", 0..=50)]
    pub mines: u32,
    /// Blotch mines.
    #[key("blotches", 0..=50)]
    pub blotches: u32,
    /// Tears from the margin inwards along the veins; fewer where there is no room.
    #[key("tears", 0..=100)]
    pub tears: u32,
    /// Tissue that has died from the margin inwards.
    #[key("dieback", block)]
    pub dieback: Option<Dieback>,
}

impl Default for Damage {
    fn default() -> Self {
        Self {
            holes: 0,
            hole_mm: 3.0,
            bites: 0,
            bite_mm: 8.0,
            mines: 0,
            mine_mm: 1.2,
            mine_length_mm: 40.0,
            blotches: 0,
            blotch_mm: 8.0,
            tears: 0,
            tear_mm: 20.0,
            tear_gape: 0.06,
            tear_lift: 0.05,
            rim_mm: 0.3,
            dieback: None,
        }
    }
}

/// What damage has left of a lamina.
#[derive(Clone, Debug, PartialEq)]
pub struct Wounds {
    /// The margin before.
    pub intact: Outline,
    /// The margins of holes, counter-clockwise, mm.
    pub holes: Vec<Vec<DVec2>>,
    /// Where tissue is dead.
    pub(crate) stains: Vec<Stain>,
    /// How far it has died from the margin.
    pub(crate) front: Option<Front>,
    tears: Vec<Tear>,
}

impl Damage {
    /// The margin after the damage, with veins cut off, and what has been done.
    pub(super) fn done_to(
        &self,
        intact: &Outline,
        network: &mut VenationNetwork,
        seed: u64,
    ) -> (Outline, Wounds) {
        let mut places = Places::new(intact, network, seed);
        let (bitten, bites) = places.bites(self.bites, self.bite_mm);
        let mut bitten = bitten;
        let gape_and_lift = [self.tear_gape, self.tear_lift];
        let (tears, rips) = places.tears(&mut bitten, self.tears, self.tear_mm, gape_and_lift);
        let holes = places.holes(self.holes, self.hole_mm);
        let mut stains = places.mines(self.mines, self.mine_mm, self.mine_length_mm);
        stains.extend(places.blotches(self.blotches, self.blotch_mm));
        if self.rim_mm > 0.0 {
            let margins = bites.into_iter().chain(rips.iter().cloned());
            let edges = margins.chain(holes.iter().map(|hole| {
                let mut around = hole.clone();
                around.push(hole[0]);
                around
            }));
            stains.extend(edges.map(|edge| Stain::rim(edge, self.rim_mm)));
        }
        let front = self
            .dieback
            .as_ref()
            .and_then(|plan| Front::of(plan, intact, network, seed));
        // Veins begin and may end on the margin itself, after rounding on either side of it.
        let is_left = |p: DVec2| bitten.contains(p) || bitten.distance_to_margin(p) < 1e-6;
        network.cut(|from, to| {
            [from, to, (from + to) * 0.5].into_iter().all(is_left)
                && !holes.iter().chain(&rips).any(|gap| touches(gap, from, to))
        });
        let knobs = intact.knobs().iter().copied();
        let knobs = knobs.filter(|knob| bitten.contains(knob.centre)).collect();
        let bitten = bitten.with_knobs(knobs);
        let wounds = Wounds {
            intact: intact.clone(),
            holes,
            stains,
            front,
            tears,
        };
        (bitten, wounds)
    }
}

impl VenationNetwork {
    /// Keeps the edges between places for which `stays` says so, and the nodes that they join.
    fn cut(&mut self, stays: impl Fn(DVec2, DVec2) -> bool) {
        let place = |node: u32| self.nodes[node as usize].position;
        let mut edges = std::mem::take(&mut self.edges);
        edges.retain(|edge| stays(place(edge.from), place(edge.to)));
        let mut used = vec![false; self.nodes.len()];
        used[..self.origins as usize].fill(true);
        for edge in &edges {
            used[edge.from as usize] = true;
            used[edge.to as usize] = true;
        }
        let mut number = vec![0; self.nodes.len()];
        let mut count = 0;
        for (node, used) in used.iter().enumerate() {
            number[node] = count;
            count += u32::from(*used);
        }
        let mut is_used = used.iter();
        self.nodes
            .retain(|_| is_used.next().copied().unwrap_or(false));
        for edge in &mut edges {
            edge.from = number[edge.from as usize];
            edge.to = number[edge.to as usize];
        }
        self.edges = edges;
    }
}

/// Whether a piece of vein reaches into a hole.
fn touches(hole: &[DVec2], from: DVec2, to: DVec2) -> bool {
    polygon::contains(hole, from)
        || polygon::contains(hole, to)
        || polygon::is_crossed_by(hole, from, to)
}

impl Wounds {
    /// Area of the holes, mm².
    pub(crate) fn holes_area(&self) -> f64 {
        let holes = self.holes.iter();
        holes.map(|hole| polygon::signed_area(hole)).sum()
    }

    /// How far the blade stands above the plane that it had, mm, at a flat point: at the lips of
    /// tears.
    pub(crate) fn height(&self, p: DVec2) -> f64 {
        self.tears.iter().map(|tear| tear.height(p)).sum()
    }
}

#[cfg(test)]
mod tests;
