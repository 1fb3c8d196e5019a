//! A map whose levels halve in size.

use glam::Vec2;
use numerics::memory;

use crate::simd;

/// Maps of `K` numbers a texel, from the finest to one texel; each level averages the one before.
#[derive(Clone, Debug)]
pub(super) struct Levels<const K: usize>(Vec<ReliefLevel<K>>);

#[derive(Clone, Debug)]
struct ReliefLevel<const K: usize> {
    width: usize,
    height: usize,
    /// `K` for each texel.
    numbers: Box<[f32]>,
}

impl<const K: usize> Levels<K> {
    /// The levels above a map of this size, row by row from v = 0, with the `K` numbers of a texel one
    /// after the other.
    pub(super) fn new([width, height]: [usize; 2], numbers: Vec<f32>) -> Self {
        debug_assert_eq!(
            numbers.len(),
            width * height * K,
            "a map fills its rectangle"
        );
        let mut levels = vec![ReliefLevel {
            width,
            height,
            numbers: numbers.into_boxed_slice(),
        }];
        while let Some(next) = levels.last().and_then(ReliefLevel::half) {
            levels.push(next);
        }
        Self(levels)
    }

    /// Texels of the finest level along u and v.
    pub(super) fn size(&self) -> [usize; 2] {
        [self.0[0].width, self.0[0].height]
    }

    /// Texels of the finest level.
    pub(super) fn finest(&self) -> &[[f32; K]] {
        self.0[0].texels()
    }

    /// The numbers at `uv`, linear between levels; level 0 is the finest, and that of a ray without
    /// width.
    pub(super) fn at(&self, uv: Vec2, level: f32) -> [f32; K] {
        let (low, high, share) = self.between(level);
        let fine = low.at(uv);
        if share == 0.0 {
            return fine;
        }
        mix(&fine, &high.at(uv), share)
    }

    /// Prefetches them.
    pub(super) fn prefetch(&self, uv: Vec2, level: f32) {
        let (low, high, _) = self.between(level);
        low.prefetch(uv);
        high.prefetch(uv);
    }

    /// The levels below and above one, and the share of the upper.
    #[inline]
    fn between(&self, level: f32) -> (&ReliefLevel<K>, &ReliefLevel<K>, f32) {
        let last = self.0.len() - 1;
        // Not a number, of a ray without width, is the finest level.
        let level = if level > 0.0 {
            level.min(last as f32)
        } else {
            0.0
        };
        let low = level as usize;
        let high = (low + 1).min(last);
        (&self.0[low], &self.0[high], level - low as f32)
    }
}

fn mix<const K: usize>(a: &[f32; K], b: &[f32; K], share: f32) -> [f32; K] {
    std::array::from_fn(|i| a[i] + (b[i] - a[i]) * share)
}

impl<const K: usize> ReliefLevel<K> {
    fn texels(&self) -> &[[f32; K]] {
        self.numbers.as_chunks().0
    }

    /// The level of half as many texels on each side; `None` for one texel.
    fn half(&self) -> Option<Self> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let [width, height] = [self.width, self.height].map(|side| side.div_ceil(2));
        let mut numbers = memory::untouched(vec![0.0; width * height * K]);
        let finer = self.texels();
        let (texels, _) = numbers.as_chunks_mut::<K>();
        for (row, texels) in texels.chunks_mut(width).enumerate() {
            for (column, texel) in texels.iter_mut().enumerate() {
                let pick = |dx: usize, dy: usize| {
                    let x = (2 * column + dx).min(self.width - 1);
                    let y = (2 * row + dy).min(self.height - 1);
                    &finer[y * self.width + x]
                };
                let upper = mix(pick(0, 0), pick(1, 0), 0.5);
                let lower = mix(pick(0, 1), pick(1, 1), 0.5);
                *texel = mix(&upper, &lower, 0.5);
            }
        }
        Some(Self {
            width,
            height,
            numbers: numbers.into_boxed_slice(),
        })
    }

    /// Prefetches the texels around a place, without the right ones, which mostly lie beside them.
    fn prefetch(&self, uv: Vec2) {
        let (x0, _, _) = neighbours(uv.x, self.width);
        let (y0, y1, _) = neighbours(uv.y, self.height);
        simd::prefetch(self.texels(), y0 * self.width + x0);
        simd::prefetch(self.texels(), y1 * self.width + x0);
    }

    /// Bilinear between texel centres, clamped at the border.
    fn at(&self, uv: Vec2) -> [f32; K] {
        let (x0, x1, share_x) = neighbours(uv.x, self.width);
        let (y0, y1, share_y) = neighbours(uv.y, self.height);
        let texels = self.texels();
        let texel = |x: usize, y: usize| &texels[y * self.width + x];
        let below = mix(texel(x0, y0), texel(x1, y0), share_x);
        let above = mix(texel(x0, y1), texel(x1, y1), share_x);
        mix(&below, &above, share_y)
    }
}

/// The texels on both sides of a place along one axis, and the share of the second.
#[inline]
fn neighbours(share: f32, count: usize) -> (usize, usize, f32) {
    let last = count as u32 - 1;
    let at = (share * count as f32 - 0.5).clamp(0.0, last as f32);
    let low = simd::whole(at, last);
    (low as usize, (low + 1).min(last) as usize, at - low as f32)
}
