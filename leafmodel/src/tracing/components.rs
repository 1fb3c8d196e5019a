//! Connected sets of pixels: the largest, specks, holes.

use super::grid::{Mask, beside};

/// How the pixels of a set hang together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Joined {
    /// By sides and corners: what is drawn.
    Eight,
    /// By sides alone: what lies between.
    Four,
}

/// A connected set of pixels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Component {
    /// Its cells, in the order in which they were found from the first in the picture's order.
    pub(super) cells: Vec<u32>,
    /// Whether it reaches the frame around the picture.
    pub(super) at_frame: bool,
}

/// Calls `found` for each connected set of cells whose value is `wanted`, by the order of their
/// first cells. The frame takes part only where `wanted` is false.
pub(super) fn each_component(
    set: &Mask,
    wanted: bool,
    joined: Joined,
    mut found: impl FnMut(&Component),
) {
    let steps = set.steps();
    let every = match joined {
        Joined::Eight => 1,
        Joined::Four => 2,
    };
    let mut is_seen = vec![false; set.cells.len()];
    let mut component = Component {
        cells: Vec::new(),
        at_frame: false,
    };
    for first in 0..set.cells.len() {
        if set.cells[first] != wanted || is_seen[first] {
            continue;
        }
        component.cells.clear();
        component.at_frame = false;
        component.cells.push(first as u32);
        is_seen[first] = true;
        let mut next = 0;
        while let Some(&cell) = component.cells.get(next) {
            next += 1;
            let cell = cell as usize;
            if set.is_frame(cell) {
                component.at_frame = true;
                for other in frame_neighbours(set, cell) {
                    if set.cells[other] == wanted && !is_seen[other] {
                        is_seen[other] = true;
                        component.cells.push(other as u32);
                    }
                }
                continue;
            }
            for step in steps.iter().step_by(every) {
                let other = beside(cell, *step);
                if set.cells[other] == wanted && !is_seen[other] {
                    is_seen[other] = true;
                    component.cells.push(other as u32);
                }
            }
        }
        found(&component);
    }
}

/// The neighbours by sides of a cell of the frame.
fn frame_neighbours(set: &Mask, cell: usize) -> impl Iterator<Item = usize> + use<> {
    let (x, y) = (cell % set.stride, cell / set.stride);
    let (stride, rows) = (set.stride, set.rows);
    let sides = [
        (x > 0, -1),
        (x + 1 < stride, 1),
        (y > 0, -(stride as isize)),
        (y + 1 < rows, stride as isize),
    ];
    sides
        .into_iter()
        .filter(|(there, _)| *there)
        .map(move |(_, step)| beside(cell, step))
}

/// Keeps the largest connected part alone; the first of equals.
pub(super) fn keep_largest(set: &mut Mask) {
    let mut largest: Vec<u32> = Vec::new();
    each_component(set, true, Joined::Eight, |component| {
        if component.cells.len() > largest.len() {
            largest.clone_from(&component.cells);
        }
    });
    set.cells.fill(false);
    for cell in largest {
        set.cells[cell as usize] = true;
    }
}

/// Gives the parts of at most `most` pixels the other value, unless they reach the frame; the first
/// cell and the number of pixels of each.
pub(super) fn flip_small(set: &mut Mask, wanted: bool, most: usize) -> Vec<(u32, usize)> {
    let joined = if wanted { Joined::Eight } else { Joined::Four };
    let mut flipped: Vec<u32> = Vec::new();
    let mut small = Vec::new();
    each_component(set, wanted, joined, |component| {
        if component.cells.len() <= most && !component.at_frame {
            small.push((component.cells[0], component.cells.len()));
            flipped.extend(&component.cells);
        }
    });
    for cell in flipped {
        set.cells[cell as usize] = !wanted;
    }
    small
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A set drawn with `#`.
    fn drawn(rows: &[&str]) -> Mask {
        Mask::new(rows[0].len(), rows.len(), |x, y| {
            rows[y].as_bytes()[x] == b'#'
        })
    }

    #[test]
    fn corners_join_what_is_drawn_and_not_what_lies_between() {
        let set = drawn(&["##...", "..#..", "...##", "#...#"]);
        let mut sizes = Vec::new();
        each_component(&set, true, Joined::Eight, |part| {
            sizes.push(part.cells.len());
        });
        assert_eq!(sizes, [6, 1]);
        let ring = drawn(&[".#.", "#.#", ".#."]);
        let mut holes = Vec::new();
        each_component(&ring, false, Joined::Four, |part| holes.push(part.at_frame));
        assert_eq!(holes, [true, false]);
    }

    #[test]
    fn small_parts_and_holes_are_found_and_flipped() {
        let mut set = drawn(&["###..", "#.#.#", "###.."]);
        assert_eq!(flip_small(&mut set, true, 1).len(), 1);
        assert_eq!(flip_small(&mut set, false, 1), [(set.cell(1, 1) as u32, 1)]);
        assert_eq!(set.count(), 9);
        assert_eq!(flip_small(&mut set, false, 100), []);
    }
}
