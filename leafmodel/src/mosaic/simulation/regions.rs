//! Divisions on a growing surface: the room decides how many cells divide in each region.

use crate::buckets::Buckets;
use crate::mosaic::live::Live;
use crate::mosaic::patch::PatchFinder;
use crate::mosaic::surface::Surface;
use crate::random::{Use, bits, uniform};

/// Radius of a region around its middle face, in repulsion radii; a region has a few dozen cells.
const REACH: f64 = 3.0;

/// The surface cut into regions, each with the divisions that it has room for.
#[derive(Debug)]
pub(super) struct Regions {
    seed: u64,
    region_of: Vec<u32>,
    /// Divisions that growth up to now has made room for and that are still to come.
    room: Vec<f64>,
    /// Increase of the room at each relaxation event.
    gain: Vec<f64>,
}

impl Regions {
    pub(super) fn new(surface: &Surface, radius: f64, seed: u64) -> Self {
        let count = surface.faces().len();
        let mut region_of = vec![u32::MAX; count];
        let mut regions = 0;
        let mut finder = PatchFinder::new(surface);
        for face in 0..count {
            if region_of[face] != u32::MAX {
                continue;
            }
            for (near, _) in finder
                .patch_of_disc(face as u32, 0.0, REACH * radius)
                .faces()
            {
                let region = &mut region_of[*near as usize];
                if *region == u32::MAX {
                    *region = regions;
                }
            }
            regions += 1;
        }
        Self {
            seed,
            region_of,
            room: vec![0.0; regions as usize],
            gain: vec![0.0; regions as usize],
        }
    }

    /// Lets the surface grow from `old` to `new` within `events` relaxation events.
    pub(super) fn grow(&mut self, old: &Surface, new: &Surface, cell_area: f64, events: u32) {
        self.gain.fill(0.0);
        for (face, &region) in self.region_of.iter().enumerate() {
            let grown = new.area(face as u32) - old.area(face as u32);
            self.gain[region as usize] += grown / (cell_area * f64::from(events));
        }
    }

    /// The cells that divide at an event: in each region as many as have room, drawn with the
    /// cells' rates as weights.
    pub(super) fn due(
        &mut self,
        cells: &[Live],
        event: u64,
        rate: &dyn Fn(&Live) -> f64,
    ) -> Vec<u32> {
        let regions = cells
            .iter()
            .map(|cell| self.region_of[cell.face as usize] as usize);
        let members = Buckets::new(self.room.len(), regions.zip(0_u32..));
        let mut due = Vec::new();
        for (region, members) in members.lists().enumerate() {
            self.room[region] += self.gain[region];
            if self.room[region] < 1.0 || members.is_empty() {
                continue;
            }
            let mut rates: Vec<f64> = members
                .iter()
                .map(|&number| rate(&cells[number as usize]))
                .collect();
            while self.room[region] >= 1.0 {
                let sum: f64 = rates.iter().sum();
                if sum <= 0.0 {
                    break;
                }
                // The remaining room distinguishes the draws of one event.
                let counter = (event << 24) | self.room[region] as u64;
                let key = bits(self.seed, Use::MosaicDivision, region as u64);
                let wanted = uniform(key, Use::MosaicDivision, counter) * sum;
                let mut up_to = 0.0;
                let last = rates.iter().rposition(|&rate| rate > 0.0).unwrap_or(0);
                let chosen = rates.iter().position(|rate| {
                    up_to += rate;
                    wanted < up_to
                });
                let chosen = chosen.unwrap_or(last);
                // A cell divides at most once per event.
                rates[chosen] = 0.0;
                due.push(members[chosen]);
                self.room[region] -= 1.0;
            }
        }
        due.sort_unstable();
        due
    }
}
