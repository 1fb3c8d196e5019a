//! x86-64: SSE2, which every such processor has, and AVX2 with what came with it (FMA, BMI).

use std::arch::asm;
use std::arch::x86_64::{
    __m128, __m256, _CMP_LE_OQ, _CMP_LT_OQ, _MM_HINT_T0, _mm_add_ps, _mm_cmple_ps, _mm_cmplt_ps,
    _mm_div_ps, _mm_load_ps, _mm_max_ps, _mm_min_ps, _mm_movemask_ps, _mm_mul_ps, _mm_prefetch,
    _mm_set1_ps, _mm_store_ps, _mm_sub_ps, _mm256_add_ps, _mm256_castps_si256, _mm256_castsi256_ps,
    _mm256_cmp_ps, _mm256_cmpgt_epi32, _mm256_div_ps, _mm256_fmadd_ps, _mm256_load_ps,
    _mm256_max_epi32, _mm256_max_ps, _mm256_min_epi32, _mm256_min_ps, _mm256_movemask_ps,
    _mm256_mul_ps, _mm256_set1_ps, _mm256_store_ps, _mm256_sub_ps,
};

use super::eight::{Eight, LANES, Row, of_two_rows};
use super::wide::{Halves, Task};

/// Size of a cache line, bytes.
const CACHE_LINE: usize = 64;

/// The instructions of AVX2, FMA and BMI; made by [`with_avx2`] alone.
#[derive(Clone, Copy)]
pub(super) struct Avx2(());

#[derive(Clone, Copy)]
pub(super) struct Sse2;

/// Runs a task compiled for AVX2, FMA and BMI.
///
/// # Safety
///
/// [`has_avx2`] is true.
#[target_feature(enable = "avx2,fma,bmi1,bmi2")]
#[inline(never)]
pub(super) unsafe fn with_avx2<T: Task>(task: T) -> T::Output {
    task.run(Avx2(()))
}

/// Whether the processor has all that [`with_avx2`] is compiled for.
pub(super) fn has_avx2() -> bool {
    std::arch::is_x86_feature_detected!("avx2")
        && std::arch::is_x86_feature_detected!("fma")
        && std::arch::is_x86_feature_detected!("bmi1")
        && std::arch::is_x86_feature_detected!("bmi2")
}

/// See [`super::prefetch`].
#[inline(always)]
pub(super) fn prefetch<T>(slice: &[T], place: usize) {
    let start = slice.as_ptr().wrapping_add(place).cast::<i8>();
    let mut at = 0;
    while at < size_of::<T>() {
        // SAFETY: SSE is part of x86-64, and a prefetch of any address affects timing only.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(start.wrapping_add(at)) };
        at += CACHE_LINE;
    }
}

// In all of the following: SAFETY: `Avx2` exists only below `with_avx2`, whose caller has detected
// it. Rows are 32-byte aligned.
impl Eight for Avx2 {
    type F = __m256;

    #[inline(always)]
    fn splat(self, value: f32) -> __m256 {
        unsafe { _mm256_set1_ps(value) }
    }

    #[inline(always)]
    fn load(self, row: &Row) -> __m256 {
        unsafe { _mm256_load_ps(row.0.as_ptr()) }
    }

    #[inline(always)]
    fn store(self, row: __m256) -> Row {
        let mut stored = Row([0.0; LANES]);
        unsafe { _mm256_store_ps(stored.0.as_mut_ptr(), row) };
        stored
    }

    of_two_rows! { __m256:
        add(a, b) -> __m256 { unsafe { _mm256_add_ps(a, b) } }
        sub(a, b) -> __m256 { unsafe { _mm256_sub_ps(a, b) } }
        mul(a, b) -> __m256 { unsafe { _mm256_mul_ps(a, b) } }
        div(a, b) -> __m256 { unsafe { _mm256_div_ps(a, b) } }
        // MINPS and MAXPS return the second operand if either is NaN, as the trait requires.
        less(a, b) -> __m256 { unsafe { _mm256_min_ps(a, b) } }
        greater(a, b) -> __m256 { unsafe { _mm256_max_ps(a, b) } }
        at_most(a, b) -> u32 { unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b)) as u32 } }
        below(a, b) -> u32 { unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a, b)) as u32 } }
    }
}

// The bits of numbers that are not negative are ordered as the numbers are, and those of a negative
// one come before. Integers are compared within a cycle, floating-point numbers on some processors
// within four. SAFETY: as above.
impl Halves for Avx2 {
    #[inline(always)]
    fn mul_add_half(self, a: __m256, b: __m256, c: __m256) -> __m256 {
        unsafe { _mm256_fmadd_ps(a, b, c) }
    }

    #[inline(always)]
    fn greater_half(self, a: __m256, b: __m256) -> __m256 {
        unsafe {
            let (a, b) = (_mm256_castps_si256(a), _mm256_castps_si256(b));
            _mm256_castsi256_ps(_mm256_max_epi32(a, b))
        }
    }

    #[inline(always)]
    fn less_half(self, a: __m256, b: __m256) -> __m256 {
        unsafe {
            let (a, b) = (_mm256_castps_si256(a), _mm256_castps_si256(b));
            _mm256_castsi256_ps(_mm256_min_epi32(a, b))
        }
    }

    #[inline(always)]
    fn at_most_half(self, a: __m256, b: __m256) -> u32 {
        unsafe {
            let (a, b) = (_mm256_castps_si256(a), _mm256_castps_si256(b));
            sign_bits(_mm256_castsi256_ps(_mm256_cmpgt_epi32(a, b))) ^ 0xff
        }
    }
}

/// The sign of each lane. By the one instruction for it: of two results side by side the compiler
/// makes a chain of five others, for which a walk waits longer.
///
/// # Safety
///
/// As [`with_avx2`].
#[inline]
#[target_feature(enable = "avx2")]
unsafe fn sign_bits(row: __m256) -> u32 {
    let bits: u32;
    // SAFETY: it reads one register and writes another.
    unsafe {
        asm!(
            "vmovmskps {bits:e}, {row}",
            bits = lateout(reg) bits,
            row = in(ymm_reg) row,
            options(pure, nomem, nostack, preserves_flags),
        );
    }
    bits
}

/// Applies a four-lane operation to both halves.
#[inline(always)]
fn halves(a: [__m128; 2], b: [__m128; 2], f: impl Fn(__m128, __m128) -> __m128) -> [__m128; 2] {
    [f(a[0], b[0]), f(a[1], b[1])]
}

#[inline(always)]
fn bits(mask: [__m128; 2]) -> u32 {
    // SAFETY: SSE is part of x86-64.
    let [low, high] = mask.map(|half| unsafe { _mm_movemask_ps(half) } as u32);
    low | high << 4
}

// In all of the following: SAFETY: SSE and SSE2 are part of x86-64. Rows are 32-byte aligned, so
// both halves are 16-byte aligned.
impl Eight for Sse2 {
    type F = [__m128; 2];

    #[inline(always)]
    fn splat(self, value: f32) -> Self::F {
        [unsafe { _mm_set1_ps(value) }; 2]
    }

    #[inline(always)]
    fn load(self, row: &Row) -> Self::F {
        let (low, high) = row.0.split_at(LANES / 2);
        unsafe { [_mm_load_ps(low.as_ptr()), _mm_load_ps(high.as_ptr())] }
    }

    #[inline(always)]
    fn store(self, row: Self::F) -> Row {
        let mut stored = Row([0.0; LANES]);
        let (low, high) = stored.0.split_at_mut(LANES / 2);
        unsafe {
            _mm_store_ps(low.as_mut_ptr(), row[0]);
            _mm_store_ps(high.as_mut_ptr(), row[1]);
        }
        stored
    }

    of_two_rows! { Self::F:
        add(a, b) -> Self::F { halves(a, b, |a, b| unsafe { _mm_add_ps(a, b) }) }
        sub(a, b) -> Self::F { halves(a, b, |a, b| unsafe { _mm_sub_ps(a, b) }) }
        mul(a, b) -> Self::F { halves(a, b, |a, b| unsafe { _mm_mul_ps(a, b) }) }
        div(a, b) -> Self::F { halves(a, b, |a, b| unsafe { _mm_div_ps(a, b) }) }
        less(a, b) -> Self::F { halves(a, b, |a, b| unsafe { _mm_min_ps(a, b) }) }
        greater(a, b) -> Self::F { halves(a, b, |a, b| unsafe { _mm_max_ps(a, b) }) }
        at_most(a, b) -> u32 { bits(halves(a, b, |a, b| unsafe { _mm_cmple_ps(a, b) })) }
        below(a, b) -> u32 { bits(halves(a, b, |a, b| unsafe { _mm_cmplt_ps(a, b) })) }
    }
}

impl Halves for Sse2 {}
