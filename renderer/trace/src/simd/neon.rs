//! AArch64: NEON, which every such processor has.

use std::arch::aarch64::{
    float32x4_t, uint32x4_t, vaddq_f32, vaddvq_u32, vandq_u32, vbslq_f32, vcgtq_f32, vcleq_f32,
    vcltq_f32, vdivq_f32, vdupq_n_f32, vld1q_f32, vld1q_u32, vmulq_f32, vst1q_f32, vsubq_f32,
};

use super::eight::{Eight, LANES, Row, of_two_rows};
use super::wide::Halves;

#[derive(Clone, Copy)]
pub(super) struct Neon;

type Pair = [float32x4_t; 2];

#[inline(always)]
fn halves(a: Pair, b: Pair, f: impl Fn(float32x4_t, float32x4_t) -> float32x4_t) -> Pair {
    [f(a[0], b[0]), f(a[1], b[1])]
}

#[inline(always)]
fn bits(masks: [uint32x4_t; 2]) -> u32 {
    const PLACES: [u32; 4] = [1, 2, 4, 8];
    // SAFETY: NEON is part of AArch64; the array has the four numbers that are read.
    let [low, high] =
        masks.map(|mask| unsafe { vaddvq_u32(vandq_u32(mask, vld1q_u32(PLACES.as_ptr()))) });
    low | high << 4
}

// In all of the following:
// SAFETY: NEON is part of AArch64; rows have the eight numbers that are read and written.
impl Eight for Neon {
    type F = Pair;

    #[inline(always)]
    fn splat(self, value: f32) -> Pair {
        [unsafe { vdupq_n_f32(value) }; 2]
    }

    #[inline(always)]
    fn load(self, row: &Row) -> Pair {
        let (low, high) = row.0.split_at(LANES / 2);
        unsafe { [vld1q_f32(low.as_ptr()), vld1q_f32(high.as_ptr())] }
    }

    #[inline(always)]
    fn store(self, row: Pair) -> Row {
        let mut stored = Row([0.0; LANES]);
        let (low, high) = stored.0.split_at_mut(LANES / 2);
        unsafe {
            vst1q_f32(low.as_mut_ptr(), row[0]);
            vst1q_f32(high.as_mut_ptr(), row[1]);
        }
        stored
    }

    of_two_rows! { Pair:
        add(a, b) -> Pair { halves(a, b, |a, b| unsafe { vaddq_f32(a, b) }) }
        sub(a, b) -> Pair { halves(a, b, |a, b| unsafe { vsubq_f32(a, b) }) }
        mul(a, b) -> Pair { halves(a, b, |a, b| unsafe { vmulq_f32(a, b) }) }
        div(a, b) -> Pair { halves(a, b, |a, b| unsafe { vdivq_f32(a, b) }) }
        // FMIN and FMAX treat NaN differently from the trait, so values are compared and selected
        // instead.
        less(a, b) -> Pair { halves(a, b, |a, b| unsafe { vbslq_f32(vcltq_f32(a, b), a, b) }) }
        greater(a, b) -> Pair { halves(a, b, |a, b| unsafe { vbslq_f32(vcgtq_f32(a, b), a, b) }) }
        at_most(a, b) -> u32 { bits([0, 1].map(|half| unsafe { vcleq_f32(a[half], b[half]) })) }
        below(a, b) -> u32 { bits([0, 1].map(|half| unsafe { vcltq_f32(a[half], b[half]) })) }
    }
}

impl Halves for Neon {}
