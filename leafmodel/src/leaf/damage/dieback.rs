//! Dieback: tissue that has died from the margin inwards, as after drought, salt, frost or
//! leaf scorch.
//!
//! A front sets out from the margin and travels into the blade at a speed of its own at each place:
//! the time t at which it arrives solves the eikonal equation |∇t| = 1 / speed (fast sweeping,
//! \[zhao2005\]), with t on the margin given. Water and what is dissolved in it move in veins, so
//! the speed there may be another than between them. What the front has reached when the share of
//! the blade asked for is behind it is dead.
//!
//! - **In**: a [`Dieback`], margin and veins of the whole leaf, a seed.
//! - **Out**: a [`Front`], painted on a map of contents.
//! - **Always true**: the share of the blade behind the front is that of the plan, within a cell of
//!   the grid along the front; every dead place hangs together with the margin through dead tissue.

use glam::DVec2;

use crate::blade::contents_map::ContentsMap;
use crate::blade::frame::UvFrame;
use crate::blade::mottle::Mottle;
use crate::document::Declared;
use crate::numeric::smooth_step;
use crate::optics::{Constituent, Contents};
use crate::plane::distances::Distances;
use crate::random::{Use, bits};
use crate::shape::outline::Outline;
use crate::venation::network::{VeinSegment, VenationNetwork};

/// How much of a blade has died from its margin, and where.
#[derive(Clone, Copy, Debug, Declared, PartialEq)]
pub struct Dieback {
    /// Share of the blade that is dead.
    #[key("share", required, 0.0..=0.95)]
    pub share: f64,
    /// Where it began: 0 alike along the margin, 1 at the tip alone.
    #[key("from_tip", 0.0..=2.0)]
    pub from_tip: f64,
    /// Speed of the front in veins of the first two orders over that between them: below 1 green is
    /// left along the veins, above 1 the brown runs ahead in them.
    #[key("vein_speed", 0.1..=10.0)]
    pub vein_speed: f64,
    /// How uneven the front is.
    #[key("unevenness", 0.0..=1.0)]
    pub unevenness: f64,
    /// Width of the yellow rim ahead of it.
    #[key("rim_mm", 0.0..=20.0)]
    pub rim_mm: f64,
}

impl Default for Dieback {
    fn default() -> Self {
        Self {
            share: 0.1,
            from_tip: 0.3,
            vein_speed: 1.0,
            unevenness: 0.5,
            rim_mm: 0.8,
        }
    }
}

/// Cells of the grid along the longer side of the leaf.
const CELLS: f64 = 360.0;
/// Distance from a vein over which its speed falls to 1/e of the way, as a share of the leaf's
/// length.
const BESIDE_VEINS: f64 = 0.012;
/// Sizes of patches of unlike speed, as shares of the leaf's length.
const PATCHES: [f64; 2] = [0.11, 0.02];
/// Size of the stretches of margin on which the front sets out late, likewise.
const STRETCH: f64 = 0.16;
/// Rounds of four sweeps, at most: the front needs one for each turn of its way.
const ROUNDS: usize = 24;
/// Width over which dead tissue passes into living, mm.
const EDGE_MM: f64 = 0.12;
/// Depth behind the front over which tissue that died last is darker, mm.
const DARK_MM: f64 = 1.2;

/// Dry matter of a blade between veins, g cm⁻².
const USUAL_DRY_MATTER: f64 = 0.006;

/// When a front arrives, and how fast it is, on a grid over the blade.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Front {
    origin: DVec2,
    cell: f64,
    columns: usize,
    /// As ways at unit speed, mm; row by row.
    times: Vec<f64>,
    speeds: Vec<f64>,
    /// The time now.
    now: f64,
    rim_mm: f64,
}

impl Front {
    /// The front in a blade, if any of it is dead.
    pub(super) fn of(
        plan: &Dieback,
        outline: &Outline,
        network: &VenationNetwork,
        seed: u64,
    ) -> Option<Self> {
        if plan.share <= 0.0 {
            return None;
        }
        let frame = UvFrame::around(outline.points());
        let cell = frame.size.max_element() / CELLS;
        // Two cells of open air on each side.
        let wide = 2.0 * cell;
        let origin = frame.min - wide;
        let count = |side: f64| ((side + 2.0 * wide) / cell).ceil() as usize + 1;
        let (columns, rows) = (count(frame.size.x), count(frame.size.y));
        let place =
            |i: usize| origin + cell * DVec2::new((i % columns) as f64, (i / columns) as f64);
        let is_blade: Vec<bool> = (0..columns * rows)
            .map(|i| outline.contains(place(i)))
            .collect();
        let mut front = Self {
            origin,
            cell,
            columns,
            times: vec![f64::INFINITY; columns * rows],
            speeds: vec![1.0; columns * rows],
            now: 0.0,
            rim_mm: plan.rim_mm,
        };
        let length = outline.length();
        let noise =
            |number: u64, size: f64| Mottle::new(bits(seed, Use::Dieback, number), size * length);
        let (coarse, fine) = (noise(0, PATCHES[0]), noise(1, PATCHES[1]));
        let veins = vein_distances(network);
        for (i, speed) in front.speeds.iter_mut().enumerate() {
            let p = place(i);
            let rough = plan.unevenness * (0.9 * coarse.at(p) + 0.35 * fine.at(p));
            let at_vein = veins.as_ref().map_or(0.0, |distances| {
                let inside = p.clamp(frame.min, frame.min + frame.size);
                libm::exp(-distances.at(inside) / (BESIDE_VEINS * length))
            });
            *speed = libm::exp(rough + at_vein * libm::log(plan.vein_speed));
        }
        // A front of even depth that leaves as much behind it would be about so deep.
        let depth = plan.share * outline.area() / outline.perimeter();
        let stretch = noise(2, STRETCH);
        let axis = (outline.apex() - outline.base()) / (length * length);
        for (i, time) in front.times.iter_mut().enumerate() {
            if !is_blade[i] {
                let p = place(i);
                let below_tip = 1.0 - (p - outline.base()).dot(axis);
                let late = 2.0 * plan.unevenness * depth * (1.0 + stretch.at(p));
                *time = plan.from_tip * length * below_tip.max(0.0) + late;
            }
        }
        front.arrive(&is_blade);
        front.now = front.time_of(plan.share, &is_blade);
        Some(front)
    }

    /// Fast sweeping: Gauss-Seidel rounds in the four directions of the grid.
    fn arrive(&mut self, is_blade: &[bool]) {
        let (columns, rows) = (self.columns, self.times.len() / self.columns);
        for _ in 0..ROUNDS {
            let mut change = 0.0_f64;
            for direction in 0..4 {
                for row in 0..rows {
                    let row = if direction & 1 == 0 {
                        row
                    } else {
                        rows - 1 - row
                    };
                    for column in 0..columns {
                        let column = if direction & 2 == 0 {
                            column
                        } else {
                            columns - 1 - column
                        };
                        let i = row * columns + column;
                        if is_blade[i] {
                            let time = self.times[i];
                            let next = self.arrival(i).min(time);
                            if next < time {
                                change = change.max((time - next).min(self.cell));
                                self.times[i] = next;
                            }
                        }
                    }
                }
            }
            if change < 1e-4 * self.cell {
                break;
            }
        }
    }

    /// Godunov's upwind difference: the time from the earlier neighbours. Cells of the blade never
    /// lie on the border of the grid.
    fn arrival(&self, i: usize) -> f64 {
        let earlier = |a: usize, b: usize| self.times[a].min(self.times[b]);
        let x = earlier(i - 1, i + 1);
        let y = earlier(i - self.columns, i + self.columns);
        let way = self.cell / self.speeds[i];
        let (low, high) = (x.min(y), x.max(y));
        if high - low >= way {
            low + way
        } else {
            0.5 * (x + y + (2.0 * way * way - (x - y) * (x - y)).sqrt())
        }
    }

    /// The time at which a share of the blade is behind the front.
    fn time_of(&self, share: f64, is_blade: &[bool]) -> f64 {
        let times = self.times.iter().zip(is_blade);
        let mut times: Vec<f64> = times
            .filter(|(_, is)| **is)
            .map(|(time, _)| *time)
            .collect();
        times.sort_unstable_by(f64::total_cmp);
        let dead = (share * times.len() as f64) as usize;
        times.get(dead).or(times.last()).copied().unwrap_or(0.0)
    }

    /// How far a place lies behind the front, mm; below 0 ahead of it.
    pub(super) fn depth(&self, p: DVec2) -> f64 {
        let rows = self.times.len() / self.columns;
        let place = (p - self.origin) / self.cell;
        let most = DVec2::new((self.columns - 2) as f64, (rows - 2) as f64);
        let low = place.floor().clamp(DVec2::ZERO, most);
        let share = (place - low).clamp(DVec2::ZERO, DVec2::ONE);
        let corner = low.y as usize * self.columns + low.x as usize;
        let between = |values: &[f64]| {
            let along = |i: usize| values[i] + (values[i + 1] - values[i]) * share.x;
            let (below, above) = (along(corner), along(corner + self.columns));
            below + (above - below) * share.y
        };
        (self.now - between(&self.times)) * between(&self.speeds)
    }

    /// What tissue at this depth has become.
    fn turned(&self, living: Contents, depth: f64) -> Contents {
        let mut yellow = living;
        // Chlorophyll goes before carotenoids do.
        yellow[Constituent::Chlorophyll] *= 0.15;
        yellow[Constituent::Carotenoids] *= 0.75;
        yellow[Constituent::Water] *= 0.8;
        let mut dead = living;
        for (constituent, value) in dead.iter_mut() {
            *value *= match constituent {
                Constituent::Chlorophyll => 0.015,
                Constituent::Carotenoids | Constituent::Water => 0.1,
                Constituent::Anthocyanins => 0.3,
                Constituent::Structure => 1.35,
                Constituent::Betacyanins
                | Constituent::Betaxanthins
                | Constituent::Brown
                | Constituent::DryMatter
                | Constituent::Proteins
                | Constituent::CarbonBased
                | Constituent::Extra => 1.0,
            };
        }
        // What died last is darkest; the oldest has bleached.
        // Veins, which hold more dry matter, brown more.
        let thick = (living.all_dry_matter() / USUAL_DRY_MATTER).clamp(0.7, 2.5);
        let brown = (0.9 + 0.8 * libm::exp(-depth.max(0.0) / DARK_MM)) * thick;
        dead[Constituent::Brown] = dead[Constituent::Brown].max(brown);
        let is_dead = smooth_step(depth / EDGE_MM + 0.5);
        let is_yellow = if self.rim_mm > 0.0 {
            smooth_step(1.0 + depth / self.rim_mm)
        } else {
            0.0
        };
        let mut now = living;
        for (constituent, value) in now.iter_mut() {
            let alive = *value + (yellow[constituent] - *value) * is_yellow;
            *value = alive + (dead[constituent] - alive) * is_dead;
        }
        now
    }

    /// Paints it over a map.
    pub(crate) fn paint(&self, map: &mut ContentsMap, frame: &UvFrame) {
        let size = DVec2::new(f64::from(map.width), f64::from(map.height));
        for row in 0..map.height {
            for column in 0..map.width {
                let uv = (DVec2::new(f64::from(column), f64::from(row)) + 0.5) / size;
                let depth = self.depth(frame.point(uv));
                if depth > -self.rim_mm - EDGE_MM {
                    let texel = &mut map.texels[(row * map.width + column) as usize];
                    *texel = self.turned(Contents::from_texel(*texel), depth).to_texel();
                }
            }
        }
    }
}

/// Distances to the larger veins, if there are any.
fn vein_distances(network: &VenationNetwork) -> Option<Distances> {
    let major: Vec<VeinSegment> = network.segments().filter(|vein| vein.order <= 2).collect();
    let lines: Vec<[DVec2; 2]> = major.iter().map(|vein| [vein.from, vein.to]).collect();
    (!lines.is_empty()).then(|| Distances::new(lines))
}
