//! The order of boxes along Hilbert's curve, in which neighbours in space are close together.

use rayon::prelude::*;

use super::bounds::Bounds;

/// Bits of each coordinate's place on the curve.
const BITS: u32 = 20;

/// Numbers of the boxes along Hilbert's curve through their centres, ties by number.
pub(super) fn order(boxes: &[Bounds]) -> Vec<u32> {
    let around = Bounds::around(boxes.iter().map(|bounds| bounds.center()));
    // Halves, so that the size of a box over the whole range of f32 does not overflow.
    let half_size = (around.max * 0.5 - around.min * 0.5).max_element();
    let cells = ((1_u32 << BITS) - 1) as f32;
    let mut keys: Vec<_> = boxes
        .par_iter()
        .zip(0_u32..boxes.len() as u32)
        .map(|(bounds, number)| {
            let share = (bounds.center() * 0.5 - around.min * 0.5) / half_size;
            // If the size is 0 the share is NaN, which is converted to 0.
            (
                place_on_curve((share * cells).as_uvec3().to_array()),
                number,
            )
        })
        .collect();
    keys.par_sort_unstable();
    keys.into_iter().map(|(_, number)| number).collect()
}

/// The position of a cell along the curve.
///
/// # Source
///
/// \[skilling2004\], `AxestoTranspose`.
fn place_on_curve(mut cell: [u32; 3]) -> u64 {
    // Undo the rotations of the curve's parts, from the largest part down.
    for bit in (1..BITS).rev() {
        let (high, low) = (1_u32 << bit, (1_u32 << bit) - 1);
        for axis in 0..3 {
            if cell[axis] & high != 0 {
                cell[0] ^= low;
            } else {
                let exchanged = (cell[0] ^ cell[axis]) & low;
                cell[0] ^= exchanged;
                cell[axis] ^= exchanged;
            }
        }
    }
    // Gray code.
    cell[1] ^= cell[0];
    cell[2] ^= cell[1];
    let mut flips = 0;
    for bit in (1..BITS).rev() {
        if cell[2] >> bit & 1 != 0 {
            flips ^= (1_u32 << bit) - 1;
        }
    }
    let mut place = 0;
    for bit in (0..BITS).rev() {
        for part in cell {
            place = place << 1 | u64::from((part ^ flips) >> bit & 1);
        }
    }
    place
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn steps_along_the_curve_lead_to_a_neighbour() {
        // The curve's first 16³ cells are a cube of their own.
        let mut cells: Vec<_> = (0..16_u32.pow(3))
            .map(|i| [i % 16, i / 16 % 16, i / 256])
            .collect();
        cells.sort_unstable_by_key(|&cell| place_on_curve(cell));
        for pair in cells.windows(2) {
            let steps: u32 = (0..3).map(|i| pair[0][i].abs_diff(pair[1][i])).sum();
            assert_eq!(steps, 1, "{pair:?}");
        }
        assert_eq!(place_on_curve(cells[4095]), 4095);
    }

    #[test]
    fn boxes_at_one_point_and_boxes_without_end_have_an_order() {
        let points = |size: f32| -> Vec<_> {
            (0..5)
                .map(|i| Bounds::around([Vec3::splat((i as f32 - 2.0) * size)]))
                .collect()
        };
        for size in [0.0, 1.0, f32::MAX / 2.0] {
            let mut order = order(&points(size));
            order.sort_unstable();
            assert_eq!(order, [0, 1, 2, 3, 4]);
        }
    }
}
