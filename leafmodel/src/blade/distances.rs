//! How far it is to the nearest of many segments, fast at millions of points.

use std::f64::consts::SQRT_2;

use glam::DVec2;

use super::frame::UvFrame;

/// Distances to segments over a frame.
///
/// A quadtree over the frame keeps for each square the segments that may be nearest to one of its
/// points. A distance changes by at most the way walked, so a segment can be nearest somewhere in a
/// square of half diagonal *h* only if it is at most 2 *h* further from the centre than the nearest
/// one is there. The lists of the last squares are short, and the least distance to a segment of
/// the list is the exact one at every point of the frame.
#[derive(Clone, Debug)]
pub(crate) struct Distances {
    segments: Vec<[DVec2; 2]>,
    centre: DVec2,
    half_side: f64,
    squares: Vec<Square>,
    /// Numbers of segments, list after list.
    candidates: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
enum Square {
    /// Place of the first of four quarters: west before east, south before north.
    Parted(u32),
    /// First candidate and the place after the last.
    Whole(u32, u32),
}

/// Lists of this length or shorter are not divided further.
const SHORT: usize = 12;
/// Greatest depth of division, since many segments may meet in one point.
const DEEPEST: u32 = 11;
/// Length of all lists after which squares are divided no further: distances stay exact, only
/// slower. A thousand segments far smaller than the last squares would fill millions of lists.
const MOST_CANDIDATES: usize = 1 << 24;

impl Distances {
    /// Builds the quadtree over the frame, within which distances may be queried.
    pub(crate) fn new(segments: Vec<[DVec2; 2]>, frame: &UvFrame) -> Self {
        let all: Vec<u32> = (0..segments.len() as u32).collect();
        let (centre, half_side) = (frame.min + 0.5 * frame.size, 0.5 * frame.size.max_element());
        let mut field = Self {
            segments,
            centre,
            half_side,
            squares: vec![Square::Whole(0, 0)],
            candidates: Vec::new(),
        };
        field.part(0, centre, half_side, &all, DEEPEST);
        field
    }

    /// Fills the square at a place with those of its parent's candidates that can be nearest in it.
    fn part(
        &mut self,
        place: usize,
        centre: DVec2,
        half_side: f64,
        of_parent: &[u32],
        deeper: u32,
    ) {
        let distances: Vec<f64> = of_parent
            .iter()
            .map(|&segment| self.square(segment, centre).sqrt())
            .collect();
        let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
        // Rounding must not lose a segment at the very bound.
        let reach = (least + 2.0 * SQRT_2 * half_side) * (1.0 + 1e-12);
        let own: Vec<u32> = of_parent
            .iter()
            .zip(&distances)
            .filter(|&(_, &distance)| distance <= reach)
            .map(|(&segment, _)| segment)
            .collect();
        let is_full = self.candidates.len() > MOST_CANDIDATES;
        if own.len() <= SHORT || deeper == 0 || is_full {
            let first = self.candidates.len() as u32;
            self.candidates.extend(own);
            self.squares[place] = Square::Whole(first, self.candidates.len() as u32);
            return;
        }
        let quarters = self.squares.len();
        self.squares[place] = Square::Parted(quarters as u32);
        self.squares.resize(quarters + 4, Square::Whole(0, 0));
        let quarter_side = 0.5 * half_side;
        for (quarter, (east, north)) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)]
            .into_iter()
            .enumerate()
        {
            let centre = centre + quarter_side * DVec2::new(east, north);
            self.part(quarters + quarter, centre, quarter_side, &own, deeper - 1);
        }
    }

    /// Squared distance of a point to a segment.
    fn square(&self, segment: u32, p: DVec2) -> f64 {
        let [from, to] = self.segments[segment as usize];
        let (along, offset) = (to - from, p - from);
        let length = along.length_squared();
        let share = if length > 0.0 {
            (offset.dot(along) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        (offset - share * along).length_squared()
    }

    /// Distance of a point of the frame (mm) to the nearest segment; infinite if there are none.
    pub(crate) fn at(&self, p: DVec2) -> f64 {
        let (mut centre, mut half_side) = (self.centre, self.half_side);
        let mut place = 0;
        loop {
            match self.squares[place] {
                Square::Parted(quarters) => {
                    let (east, north) = (p.x >= centre.x, p.y >= centre.y);
                    place = quarters as usize + usize::from(east) + 2 * usize::from(north);
                    half_side *= 0.5;
                    let toward = |yes: bool| if yes { half_side } else { -half_side };
                    centre += DVec2::new(toward(east), toward(north));
                }
                Square::Whole(first, end) => {
                    return self.candidates[first as usize..end as usize]
                        .iter()
                        .map(|&segment| self.square(segment, p))
                        .fold(f64::INFINITY, f64::min)
                        .sqrt();
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::testing::fixed;

    const FRAME: UvFrame = UvFrame {
        min: DVec2::new(-10.0, 0.0),
        size: DVec2::new(20.0, 30.0),
    };

    fn exhaustive(field: &Distances, p: DVec2) -> f64 {
        (0..field.segments.len() as u32)
            .map(|segment| field.square(segment, p))
            .fold(f64::INFINITY, f64::min)
            .sqrt()
    }

    proptest! {
        #![proptest_config(fixed(1000))]
        #[test]
        fn distances_are_those_of_a_search_over_all_segments(
            ends in prop::collection::vec((-10.0..10.0, 0.0..30.0, -3.0..3.0, -3.0..3.0), 1..40),
            points in prop::collection::vec((-10.0..10.0, 0.0..30.0), 50),
        ) {
            let segments: Vec<[DVec2; 2]> = ends.iter()
                .map(|&(x, y, dx, dy)| [DVec2::new(x, y), DVec2::new(x + dx, y + dy)]).collect();
            let field = Distances::new(segments, &FRAME);
            for (x, y) in points {
                let p = DVec2::new(x, y);
                prop_assert_eq!(field.at(p), exhaustive(&field, p));
            }
        }
    }

    #[test]
    fn segments_that_meet_in_one_point_are_all_kept() {
        let spokes = (0..64).map(|spoke| {
            let direction = DVec2::from_angle(f64::from(spoke) * 0.1);
            [
                DVec2::new(0.1, 15.0),
                DVec2::new(0.1, 15.0) + 12.0 * direction,
            ]
        });
        let field = Distances::new(spokes.collect(), &FRAME);
        for step in 0..100 {
            let p = DVec2::new(0.1, 15.0) + 1e-4 * DVec2::from_angle(f64::from(step));
            assert_eq!(field.at(p), exhaustive(&field, p));
        }
    }

    #[test]
    fn a_crowd_of_tiny_segments_does_not_fill_the_memory() {
        let crowd = (0..3000).map(|i| {
            let from = DVec2::new(0.1, 15.0) + 1e-6 * DVec2::from_angle(f64::from(i));
            [from, from + DVec2::splat(1e-8)]
        });
        let field = Distances::new(crowd.collect(), &FRAME);
        assert!(field.candidates.len() < 2 * MOST_CANDIDATES);
        for p in [DVec2::new(9.0, 29.0), DVec2::new(-9.0, 1.0), DVec2::ZERO] {
            assert_eq!(field.at(p), exhaustive(&field, p));
        }
    }

    #[test]
    fn without_segments_everything_is_infinitely_far() {
        assert_eq!(
            Distances::new(Vec::new(), &FRAME).at(DVec2::ONE),
            f64::INFINITY
        );
    }
}
