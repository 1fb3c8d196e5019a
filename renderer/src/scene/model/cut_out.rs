//! Alpha masks: parts of a mesh where its material is not there are cut out of it.
//!
//! - **In**: triangles with their texture coordinates, and a mask over these.
//! - **Out**: triangles of what is there, whose borders follow the mask's contour at the cutoff.
//! - **Always true**: a triangle without a contour is left as it is, or left out as a whole.
//!
//! A triangle is quartered until its parts are half as large as a texel, in which the mask is taken
//! as linear. So rays, shadows, instruments and exports need not know of masks.

use glam::Vec2;

use super::surfaces::Vertex;
use crate::material::colour_map::ColourTexture;

/// Most triangles into which one part of a model is cut.
pub(super) const MOST_TRIANGLES: usize = 1 << 23;

/// Most triangles into which one triangle is cut.
pub(super) const MOST_OF_ONE: usize = 1 << 18;

/// Greatest size of a triangle that is cut, in texels: few pictures repeat so often.
const LARGE: f32 = 131_072.0;

/// Texels of which the least and the greatest are looked for one by one.
const FEW: i64 = 256;

/// Size, in texels, of a triangle that is not quartered.
const SMALL: f32 = 0.5;

/// Where a material is there.
pub(super) struct Mask {
    alpha: ColourTexture,
    /// What alpha must be at least.
    least: f32,
    levels: Vec<Level>,
}

/// The least and the greatest value of square cells of texels.
struct Level {
    width: usize,
    cells: Vec<[f32; 2]>,
}

impl Vertex {
    fn between(self, other: Self, share: f32) -> Self {
        Self {
            position: self.position.lerp(other.position, share),
            normal: self.normal.lerp(other.normal, share),
            uv: self.uv.lerp(other.uv, share),
            colour: mixed(self.colour, other.colour, share),
            tangent: mixed(self.tangent, other.tangent, share),
        }
    }
}

fn mixed<const N: usize>(one: [f32; N], other: [f32; N], share: f32) -> [f32; N] {
    std::array::from_fn(|i| one[i] + share * (other[i] - one[i]))
}

/// What becomes of a triangle.
pub(super) enum Cut {
    /// It is there as a whole.
    Whole,
    /// These parts of it are there.
    Parts(Vec<[Vertex; 3]>),
}

impl Mask {
    /// A mask that is there where `alpha`, the same in all channels, is at least `least`.
    pub(super) fn new(alpha: ColourTexture, least: f32) -> Self {
        let [width, height] = alpha.size();
        let mut levels = vec![Level {
            width,
            cells: alpha.texels().iter().map(|texel| [texel[0]; 2]).collect(),
        }];
        let mut rows = height;
        while let Some(below) = levels.last().filter(|level| level.cells.len() > 1) {
            let width = below.width.div_ceil(2);
            let mut cells = vec![[f32::MAX, f32::MIN]; width * rows.div_ceil(2)];
            for (number, of) in below.cells.iter().enumerate() {
                let (row, column) = (number / below.width, number % below.width);
                let cell = &mut cells[row / 2 * width + column / 2];
                *cell = [cell[0].min(of[0]), cell[1].max(of[1])];
            }
            rows = rows.div_ceil(2);
            levels.push(Level { width, cells });
        }
        Self {
            alpha,
            least,
            levels,
        }
    }

    /// Cuts a triangle; `None` if it would become more than `most`, or than any may.
    pub(super) fn cut(&self, triangle: [Vertex; 3], most: usize) -> Option<Cut> {
        let is_finite = triangle.iter().all(|corner| corner.uv.is_finite());
        if !is_finite || self.is_there(&triangle) == Some(true) {
            return Some(Cut::Whole);
        }
        if self.span(&triangle) > LARGE {
            return None;
        }
        // They are counted before memory is taken for them.
        let most = most.min(MOST_OF_ONE);
        let (mut steps, mut count) = (0, 0);
        let is_small = self.quarter(
            triangle,
            &mut |_| {
                count += 1;
                count <= most
            },
            &mut || {
                steps += 1;
                steps <= 3 * MOST_OF_ONE
            },
        );
        if !is_small {
            return None;
        }
        let mut parts = Vec::with_capacity(count);
        self.quarter(
            triangle,
            &mut |part| {
                parts.push(part);
                true
            },
            &mut || true,
        );
        Some(Cut::Parts(parts))
    }

    /// Gives the parts of a triangle that are there to `take`, and asks `go_on` at each step; false
    /// if one of them refused.
    fn quarter(
        &self,
        triangle: [Vertex; 3],
        take: &mut dyn FnMut([Vertex; 3]) -> bool,
        go_on: &mut dyn FnMut() -> bool,
    ) -> bool {
        let mut open = vec![triangle];
        while let Some(triangle) = open.pop() {
            if !go_on() {
                return false;
            }
            match self.is_there(&triangle) {
                Some(true) if !take(triangle) => return false,
                Some(_) => {}
                None if self.span(&triangle) <= SMALL => {
                    if !self.clipped(triangle).into_iter().flatten().all(&mut *take) {
                        return false;
                    }
                }
                None => {
                    let [a, b, c] = triangle;
                    let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| p.between(q, 0.5));
                    open.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
                }
            }
        }
        true
    }

    /// Size of a triangle in texels.
    fn span(&self, triangle: &[Vertex; 3]) -> f32 {
        let [width, height] = self.alpha.size().map(|count| count as f32);
        let [a, b, c] = triangle.map(|corner| corner.uv * Vec2::new(width, height));
        let extent = a.max(b).max(c) - a.min(b).min(c);
        extent.max_element()
    }

    /// Whether all of a triangle is there, or nothing, if that is sure.
    fn is_there(&self, triangle: &[Vertex; 3]) -> Option<bool> {
        let [least, most] = self.range(triangle);
        if least >= self.least {
            Some(true)
        } else if most < self.least {
            Some(false)
        } else {
            None
        }
    }

    /// Bounds of alpha over a triangle.
    fn range(&self, triangle: &[Vertex; 3]) -> [f32; 2] {
        let [width, height] = self.alpha.size();
        let texel = |uv: Vec2| Vec2::new(uv.x * width as f32, (1.0 - uv.y) * height as f32) - 0.5;
        let [a, b, c] = triangle.map(|corner| texel(corner.uv));
        let (low, high) = (a.min(b).min(c).floor(), a.max(b).max(c).floor() + 1.0);
        let all = || {
            let level = self.levels.last().expect("there is one at least");
            level.cells[0]
        };
        // Far out, or not a number.
        if !(low.abs().max_element() < 1e9 && high.abs().max_element() < 1e9) {
            return all();
        }
        let [x0, y0, x1, y1] = [low.x, low.y, high.x, high.y].map(|number| number as i64);
        let union = |a: [f32; 2], b: [f32; 2]| [a[0].min(b[0]), a[1].max(b[1])];
        let nothing = [f32::MAX, f32::MIN];
        if (x1 - x0 + 1).saturating_mul(y1 - y0 + 1) <= FEW {
            let texels = (y0..=y1).flat_map(|y| (x0..=x1).map(move |x| (x, y)));
            let values = texels.map(|(x, y)| [self.alpha.texel(x, y)[0]; 2]);
            return values.fold(nothing, union);
        }
        if x0 < 0 || y0 < 0 || x1 >= width as i64 || y1 >= height as i64 {
            return all();
        }
        // On the level of which at most three by three cells are needed.
        let number = (x1 - x0).max(y1 - y0).ilog2() as usize;
        let number = number.min(self.levels.len() - 1);
        let level = &self.levels[number];
        let cells = (y0 >> number..=y1 >> number)
            .flat_map(|y| (x0 >> number..=x1 >> number).map(move |x| (x as usize, y as usize)));
        let cells = cells.map(|(x, y)| level.cells[y * level.width + x]);
        cells.fold(nothing, union)
    }

    /// The part of a small triangle that is there: a triangle or two.
    fn clipped(&self, triangle: [Vertex; 3]) -> [Option<[Vertex; 3]>; 2] {
        let above = triangle.map(|corner| self.alpha.at(corner.uv)[0] - self.least);
        let mut polygon: Vec<Vertex> = Vec::with_capacity(4);
        for (this, next) in [(0, 1), (1, 2), (2, 0)] {
            if above[this] >= 0.0 {
                polygon.push(triangle[this]);
            }
            if (above[this] >= 0.0) != (above[next] >= 0.0) {
                let share = above[this] / (above[this] - above[next]);
                polygon.push(triangle[this].between(triangle[next], share));
            }
        }
        [1, 2].map(|second| {
            let pair = polygon.get(second..second + 2)?;
            Some([polygon[0], pair[0], pair[1]])
        })
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::material::colour_map::Wrap;

    /// A square of texture coordinates 0 to 1, as two triangles, of area 1.
    fn square() -> [[Vertex; 3]; 2] {
        let corner = |x: f32, y: f32| Vertex {
            position: Vec3::new(x, y, 0.0),
            normal: Vec3::Z,
            uv: Vec2::new(x, y),
            colour: [1.0; 3],
            tangent: [0.0; 4],
        };
        let [a, b, c, d] = [
            corner(0.0, 0.0),
            corner(1.0, 0.0),
            corner(1.0, 1.0),
            corner(0.0, 1.0),
        ];
        [[a, b, c], [a, c, d]]
    }

    fn area(triangle: &[Vertex; 3]) -> f64 {
        let [a, b, c] = triangle.map(|corner| corner.position.as_dvec3());
        0.5 * (b - a).cross(c - a).z
    }

    /// The area that is there, and the number of triangles.
    fn cut(mask: &Mask) -> (f64, usize) {
        let mut sum = (0.0, 0);
        for triangle in square() {
            match mask.cut(triangle, MOST_TRIANGLES).expect("few triangles") {
                Cut::Whole => sum = (sum.0 + area(&triangle), sum.1 + 1),
                Cut::Parts(parts) => {
                    let areas: Vec<f64> = parts.iter().map(area).collect();
                    assert!(areas.iter().all(|area| *area >= 0.0), "the side is kept");
                    sum = (sum.0 + areas.iter().sum::<f64>(), sum.1 + parts.len());
                }
            }
        }
        sum
    }

    fn disc(side: usize) -> Mask {
        let texels = (0..side * side).map(|number| {
            let place = |at: usize| (at as f32 + 0.5) / side as f32 - 0.5;
            let radius = place(number % side).hypot(place(number / side));
            // Half at a radius of 0.4, falling over four texels.
            let alpha = (0.5 + (0.4 - radius) * side as f32 / 4.0).clamp(0.0, 1.0);
            [alpha; 3]
        });
        Mask::new(
            ColourTexture::new(side, texels.collect(), [Wrap::Clamp; 2]),
            0.5,
        )
    }

    #[test]
    fn what_is_left_of_a_square_is_the_disc_of_its_mask() {
        let expected = std::f64::consts::PI * 0.16;
        for (side, most) in [(64, 3000), (256, 12_000)] {
            let (found, count) = cut(&disc(side));
            assert!(
                (found / expected - 1.0).abs() < 1e-3,
                "{side}: {found}, not {expected}"
            );
            assert!(count < most, "{side}: {count}");
        }
    }

    #[test]
    fn what_is_there_as_a_whole_or_not_at_all_is_not_cut() {
        let even = |alpha: f32| {
            let texels = vec![[alpha; 3]; 4096 * 2];
            Mask::new(ColourTexture::new(4096, texels, [Wrap::Repeat; 2]), 0.5)
        };
        assert_eq!(cut(&even(0.5)), (1.0, 2));
        assert_eq!(cut(&even(0.49)), (0.0, 0));
    }

    #[test]
    fn a_mask_that_repeats_is_cut_wherever_texture_coordinates_lie() {
        let mask = {
            let texels = vec![[1.0; 3], [0.0; 3]];
            Mask::new(ColourTexture::new(2, texels, [Wrap::Repeat; 2]), 0.5)
        };
        let mut found = 0.0;
        for triangle in square() {
            let far = triangle.map(|corner| Vertex {
                uv: 40.0 * corner.uv - 7.0,
                ..corner
            });
            if let Some(Cut::Parts(parts)) = mask.cut(far, MOST_TRIANGLES) {
                found += parts.iter().map(area).sum::<f64>();
            }
        }
        assert!((found - 0.5).abs() < 1e-3, "{found}");
        assert!(
            mask.cut(
                square()[0].map(|c| Vertex {
                    uv: 1e4 * c.uv,
                    ..c
                }),
                1000
            )
            .is_none()
        );
    }
}
