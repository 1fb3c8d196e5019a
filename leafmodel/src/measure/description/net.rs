//! The net of fine veins: areoles, and the veinlets that end freely in them.

use crate::measure::statistics::{mean, median, quantile};
use crate::shape::outline::Outline;
use crate::venation::areole::{Areole, Areoles};

/// Turn of a boundary from which on a junction is a corner of its areole, radians: 30°.
const CORNER: f64 = 0.524;

/// Areoles cover at least this share of a blade that has areolation.
const COVERED: f64 = 0.5;

/// Well developed areoles have at most so many sides in the median.
const FEW_SIDES: f64 = 6.0;

/// And their upper quartile of area is at most so many times the lower.
const ALIKE: f64 = 4.0;

/// Poorly developed ones have more sides than this in the median, or areas that differ by more
/// than [`UNLIKE`].
const MANY_SIDES: f64 = 7.0;

/// Ratio of quartiles of area beyond which areoles are poorly developed.
const UNLIKE: f64 = 8.0;

/// Fewer veinlets than this to an areole are none.
const NO_VEINLETS: f64 = 0.1;

/// How well areoles are formed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Areolation {
    /// Veins enclose less than half of the blade.
    Lacking,
    /// Areoles have many sides or are of very unlike size.
    Poor,
    /// They differ in size and shape.
    Moderate,
    /// They have three to six sides and are about equally large.
    Good,
}

/// Veinlets that end freely in areoles.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Veinlets {
    /// Hardly any areole has one.
    Absent,
    /// Most do not branch.
    Unbranched,
    /// Most branch, and those mostly once.
    BranchedOnce,
    /// Most branch more than once.
    Dendritic,
}

/// What the net alone tells.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Net {
    /// Areoles per mm².
    pub areoles_per_mm2: f64,
    /// Share of the blade's area inside areoles.
    pub covered: f64,
    /// Median of longer over shorter axis of areoles.
    pub elongation: Option<f64>,
    /// Median number of sides of areoles: corners are junctions at which the boundary turns by 30°
    /// or more.
    pub sides: Option<f64>,
    /// Upper over lower quartile of the areas of areoles.
    pub area_quartile_ratio: Option<f64>,
    /// Veinlets per areole, each with all its branches.
    pub veinlets_per_areole: Option<f64>,
    /// Free ends per areole.
    pub free_ends_per_areole: Option<f64>,
    /// Share of the veinlets that do not branch, branch once, and more often.
    pub branching: Option<[f64; 3]>,
}

impl Net {
    pub(super) fn new(outline: &Outline, found: &Areoles) -> Self {
        let mut long: Vec<f64> = found.iter().map(|areole| areole.elongation).collect();
        let mut sides: Vec<f64> = (0..found.len())
            .map(|number| found.corners(number, CORNER) as f64)
            .collect();
        let mut areas: Vec<f64> = found.iter().map(|areole| areole.area_mm2).collect();
        let covered: f64 = found.iter().map(|areole: &Areole| areole.area_mm2).sum();
        let inside: Vec<usize> = found
            .veinlets()
            .into_iter()
            .filter(|veinlet| veinlet.areole.is_some())
            .map(|veinlet| veinlet.free_ends)
            .collect();
        let per_areole =
            |count: usize| (!found.is_empty()).then(|| count as f64 / found.len() as f64);
        let share = |holds: &dyn Fn(usize) -> bool| {
            let of: Vec<f64> = inside
                .iter()
                .map(|&n| f64::from(u8::from(holds(n))))
                .collect();
            mean(&of).unwrap_or(0.0)
        };
        let branching = [share(&|n| n == 1), share(&|n| n == 2), share(&|n| n > 2)];
        let upper = quantile(&mut areas, 0.75);
        let ratio = upper.zip(quantile(&mut areas, 0.25)).map(|(u, l)| u / l);
        Self {
            areoles_per_mm2: found.len() as f64 / outline.area(),
            covered: covered / outline.area(),
            elongation: median(&mut long),
            sides: median(&mut sides),
            area_quartile_ratio: ratio.filter(|ratio| ratio.is_finite()),
            veinlets_per_areole: per_areole(inside.len()),
            free_ends_per_areole: per_areole(inside.iter().sum()),
            branching: (!inside.is_empty()).then_some(branching),
        }
    }

    /// How well areoles are formed.
    pub fn areolation(&self) -> Areolation {
        let (Some(sides), Some(ratio)) = (self.sides, self.area_quartile_ratio) else {
            return Areolation::Lacking;
        };
        if self.covered < COVERED {
            Areolation::Lacking
        } else if sides > MANY_SIDES || ratio > UNLIKE {
            Areolation::Poor
        } else if sides <= FEW_SIDES && ratio <= ALIKE {
            Areolation::Good
        } else {
            Areolation::Moderate
        }
    }

    /// Whether most areoles have veinlets, and how those branch.
    pub fn veinlets(&self) -> Veinlets {
        let [never, once, more] = match (self.veinlets_per_areole, self.branching) {
            (Some(count), Some(branching)) if count >= NO_VEINLETS => branching,
            _ => return Veinlets::Absent,
        };
        if never >= once + more {
            Veinlets::Unbranched
        } else if once >= more {
            Veinlets::BranchedOnce
        } else {
            Veinlets::Dendritic
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::venation::areole::areoles;
    use crate::venation::network::VenationNetwork;
    use crate::venation::testing::{hexagons, network, poplar, rectangle, squares};

    fn net(blade: &Outline, network: &VenationNetwork) -> Net {
        Net::new(blade, &areoles(network))
    }

    #[test]
    fn squares_have_four_sides_hexagons_six_and_both_are_well_developed() {
        let blade = rectangle((0.0, 0.0), (4.0, 4.0));
        let four = net(&blade, &squares(8, 0.5));
        assert_eq!(four.sides, Some(4.0));
        assert!((four.covered - 1.0).abs() < 1e-9, "{}", four.covered);
        assert_eq!(four.areolation(), Areolation::Good);
        assert_eq!(four.veinlets(), Veinlets::Absent);
        // Corners of the lattice's rim with two edges are none: most hexagons lie inside.
        let six = net(&blade, &hexagons(9, 0.25));
        assert_eq!(six.sides, Some(6.0));
        assert_eq!(six.areolation(), Areolation::Good);
    }

    #[test]
    fn few_areoles_on_a_large_blade_are_no_areolation_and_unlike_ones_are_poor() {
        let blade = rectangle((0.0, 0.0), (20.0, 20.0));
        assert_eq!(
            net(&blade, &squares(8, 0.5)).areolation(),
            Areolation::Lacking
        );
        // Rows of squares and of strips ten times as high.
        let mut places = Vec::new();
        let mut edges = Vec::new();
        let heights = [0.0, 1.0, 11.0, 12.0, 22.0, 23.0, 33.0];
        for (row, height) in heights.into_iter().enumerate() {
            for column in 0..8_u32 {
                let node = places.len() as u32;
                places.push(DVec2::new(f64::from(column), height));
                if column > 0 {
                    edges.push([node - 1, node]);
                }
                if row > 0 {
                    edges.push([node - 8, node]);
                }
            }
        }
        let blade = rectangle((0.0, 0.0), (7.0, 33.0));
        let unlike = net(&blade, &network(&places, &edges));
        assert_eq!(unlike.area_quartile_ratio, Some(10.0));
        assert_eq!(unlike.areolation(), Areolation::Poor);
    }

    #[test]
    fn veinlets_are_counted_with_their_branches() {
        // A square cell with a veinlet that forks twice, a cell with a straight one, an empty one.
        let places: Vec<DVec2> = [
            (0.0, 0.0),
            (4.0, 0.0),
            (4.0, 4.0),
            (0.0, 4.0),
            (8.0, 0.0),
            (8.0, 4.0),
            (12.0, 0.0),
            (12.0, 4.0),
            (2.0, 0.0),
            (2.0, 1.0),
            (1.0, 2.0),
            (3.0, 2.0),
            (2.5, 3.0),
            (3.5, 3.0),
            (6.0, 0.0),
            (6.0, 2.0),
        ]
        .map(DVec2::from)
        .to_vec();
        let edges = [
            [0, 8],
            [8, 1],
            [1, 2],
            [2, 3],
            [0, 3],
            [1, 14],
            [14, 4],
            [4, 5],
            [2, 5],
            [4, 6],
            [6, 7],
            [5, 7],
            [8, 9],
            [9, 10],
            [9, 11],
            [11, 12],
            [11, 13],
            [14, 15],
        ];
        let blade = rectangle((0.0, 0.0), (12.0, 4.0));
        let found = net(&blade, &network(&places, &edges));
        assert_eq!(found.veinlets_per_areole, Some(2.0 / 3.0));
        assert_eq!(found.free_ends_per_areole, Some(4.0 / 3.0));
        assert_eq!(found.branching, Some([0.5, 0.0, 0.5]));
    }

    #[test]
    fn a_free_end_of_the_areoles_is_an_end_of_a_veinlet() {
        for seed in 1..4 {
            let (_, veins) = poplar(seed);
            let found = areoles(&veins);
            let ends = found.free_endings().filter(|end| end.areole.is_some());
            let veinlets = found.veinlets();
            let inside = veinlets.iter().filter(|veinlet| veinlet.areole.is_some());
            assert_eq!(
                inside.map(|veinlet| veinlet.free_ends).sum::<usize>(),
                ends.count()
            );
        }
    }
}
