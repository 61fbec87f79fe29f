//! Eight lanes of AVX2.
//!
//! `a > b ? a : b`, which keeps `b` when `a` is NaN, is what `maxps a, b` does, and `minps` likewise: so
//! the operands below stand in the order of the portable tests.
#![allow(
    unsafe_code,
    reason = "intrinsics of an instruction set that is detected at run time"
)]

use super::{Job, LANE_BITS, Lanes, Slots};
use crate::leaf::LeafRay;
use crate::node::{Node, SlabRay, WIDTH};
use crate::triangle::Candidates;
use std::arch::x86_64::*;
use std::sync::LazyLock;

/// Proof that the machine has AVX2, and the instructions for bits that came with it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

impl Avx2 {
    #[inline]
    pub fn detect() -> Option<Self> {
        static DETECTED: LazyLock<Option<Avx2>> = LazyLock::new(Avx2::look);
        *DETECTED
    }

    fn look() -> Option<Self> {
        let has = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("bmi1")
            && is_x86_feature_detected!("bmi2")
            && is_x86_feature_detected!("lzcnt")
            && is_x86_feature_detected!("popcnt");
        has.then_some(Self(()))
    }

    /// Runs `job`, compiled for this instruction set.
    #[inline]
    pub fn run<J: Job>(self, job: J) -> J::Out {
        #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
        fn run<J: Job>(job: J, lanes: Avx2) -> J::Out {
            job.run(lanes)
        }
        // SAFETY: `detect`, the only one to make an `Avx2`, has found these features.
        unsafe { run(job, self) }
    }

    /// Which children the ray may have a hit in, as all bits of their lanes, and from which `t` on.
    #[inline(always)]
    fn slabs(self, node: &Node, ray: &SlabRay, t_cull: f32) -> (__m256, __m256) {
        // SAFETY: `self` is the proof of AVX2. The rows are below 6 whatever the ray (`SlabRay::new`), so that the loads are of rows of `planes`; those are aligned to 32 bytes, being
        // of 32 bytes in a type aligned to 64.
        unsafe {
            let mut t_near = _mm256_setzero_ps();
            let mut t_far = _mm256_set1_ps(t_cull);
            for axis in &ray.axes {
                let rows = node.planes.as_ptr();
                let near = _mm256_load_ps(rows.add(axis.near_row as usize).cast());
                let far = _mm256_load_ps(rows.add(axis.far_row as usize).cast());
                let near = _mm256_sub_ps(near, _mm256_set1_ps(axis.near_origin));
                let far = _mm256_sub_ps(far, _mm256_set1_ps(axis.far_origin));
                let near = _mm256_mul_ps(near, _mm256_set1_ps(axis.near_rcp));
                let far = _mm256_mul_ps(far, _mm256_set1_ps(axis.far_rcp));
                t_near = _mm256_max_ps(near, t_near);
                t_far = _mm256_min_ps(far, t_far);
            }
            (_mm256_cmp_ps::<_CMP_LE_OQ>(t_near, t_far), t_near)
        }
    }
}

impl Lanes for Avx2 {
    #[inline(always)]
    fn nearest_last(
        self,
        node: &Node,
        ray: &SlabRay,
        t_cull: f32,
        keys: &mut Slots,
        words: &mut Slots,
    ) -> usize {
        let (hit, t_near) = self.slabs(node, ray, t_cull);
        // SAFETY: `self` is the proof of AVX2; loads and stores are of arrays of eight.
        unsafe {
            let lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
            let bound = _mm256_andnot_si256(
                _mm256_castps_si256(t_near),
                _mm256_set1_epi32(!(LANE_BITS as i32)),
            );
            let key = _mm256_or_si256(bound, lane);
            // All bits set is behind all keys.
            let ones = _mm256_set1_epi32(-1);
            let missed = _mm256_xor_si256(_mm256_castps_si256(hit), ones);
            let sorted = sort(_mm256_or_si256(key, missed));
            let children = _mm256_loadu_si256(node.children.as_ptr().cast());
            _mm256_storeu_si256(keys.as_mut_ptr().cast(), sorted);
            _mm256_storeu_si256(
                words.as_mut_ptr().cast(),
                _mm256_permutevar8x32_epi32(children, sorted),
            );
            _mm256_movemask_ps(hit).count_ones() as usize
        }
    }

    #[inline(always)]
    fn any_order(self, node: &Node, ray: &SlabRay, t_cull: f32, words: &mut Slots) -> usize {
        let (hit, _) = self.slabs(node, ray, t_cull);
        // SAFETY: `self` is the proof of AVX2; a mask of eight lanes is below 256; the load of the order is of
        // eight bytes, the store of an array of eight.
        unsafe {
            let mask = _mm256_movemask_ps(hit) as usize & 255;
            let order = _mm256_cvtepu8_epi32(_mm_loadl_epi64(PACKED[mask].as_ptr().cast()));
            let children = _mm256_loadu_si256(node.children.as_ptr().cast());
            _mm256_storeu_si256(
                words.as_mut_ptr().cast(),
                _mm256_permutevar8x32_epi32(children, order),
            );
            mask.count_ones() as usize
        }
    }

    #[inline(always)]
    fn triangles(self, rows: &[f32], n: usize, pick: [usize; 3], ray: &LeafRay) -> Candidates {
        let vertices = pick[0].max(pick[1]).max(pick[2]) + 1;
        let s = &ray.shear;
        assert!(rows.len() >= (3 * vertices - 1) * n + WIDTH && s.kx.max(s.ky).max(s.kz) < 3);
        // SAFETY: `self` is the proof of AVX2. The last of the eight numbers read is number
        // (3 · vertex + axis) n + 7, where vertex < `vertices` and axis < 3: below the length that was asserted.
        let mut found = unsafe { line_through(rows.as_ptr(), n, pick, ray) };
        found.mask &= u32::MAX >> (32 - n);
        found
    }

    #[inline(always)]
    fn prefetch(self, at: *const u8) {
        for line in 0..4 {
            // SAFETY: a prefetch neither reads nor faults, whatever the address.
            unsafe { _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(line * CACHE_LINE).cast()) };
        }
    }
}

const CACHE_LINE: usize = 64;

/// Sorts eight unsigned numbers: the network of 19 comparators in six layers (Knuth 1998, The Art of
/// Computer Programming vol. 3, §5.3.4).
///
/// # Safety
/// The machine has AVX2.
#[inline(always)]
unsafe fn sort(v: __m256i) -> __m256i {
    // Each lane meets its partner's number, and lanes of `MAX` take the larger.
    macro_rules! layer {
        ($v:expr, $partner:expr, $max:literal) => {{
            let (v, p) = ($v, $partner);
            _mm256_blend_epi32::<$max>(_mm256_min_epu32(v, p), _mm256_max_epu32(v, p))
        }};
    }
    // SAFETY: the caller has AVX2.
    unsafe {
        // 0-2, 1-3, 4-6, 5-7.
        let v = layer!(v, _mm256_shuffle_epi32::<0b01_00_11_10>(v), 0b1100_1100);
        // 0-4, 1-5, 2-6, 3-7.
        let v = layer!(v, _mm256_permute2x128_si256::<1>(v, v), 0b1111_0000);
        // 0-1, 2-3, 4-5, 6-7.
        let v = layer!(v, _mm256_shuffle_epi32::<0b10_11_00_01>(v), 0b1010_1010);
        // 2-4, 3-5.
        let order = _mm256_setr_epi32(0, 1, 4, 5, 2, 3, 6, 7);
        let v = layer!(v, _mm256_permutevar8x32_epi32(v, order), 0b0011_0000);
        // 1-4, 3-6.
        let order = _mm256_setr_epi32(0, 4, 2, 6, 1, 5, 3, 7);
        let v = layer!(v, _mm256_permutevar8x32_epi32(v, order), 0b0101_0000);
        // 1-2, 3-4, 5-6.
        let order = _mm256_setr_epi32(0, 2, 1, 4, 3, 6, 5, 7);
        layer!(v, _mm256_permutevar8x32_epi32(v, order), 0b0101_0100)
    }
}

/// For each mask the lanes in it, in their order; then zeros.
static PACKED: [[u8; WIDTH]; 256] = {
    let mut table = [[0; WIDTH]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut at) = (0, 0);
        while lane < WIDTH {
            if mask >> lane & 1 == 1 {
                table[mask][at] = lane as u8;
                at += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// The test of [`crate::triangle::test_lanes`] for eight triangles, whose rows have `n` numbers.
///
/// # Safety
/// The machine has AVX2, and eight numbers can be read from each row of the vertices in `pick` on.
#[inline(always)]
unsafe fn line_through(rows: *const f32, n: usize, pick: [usize; 3], ray: &LeafRay) -> Candidates {
    let s = &ray.shear;
    // SAFETY: as the caller promises; stores are of arrays of eight.
    unsafe {
        let ox = _mm256_set1_ps(ray.o[s.kx]);
        let oy = _mm256_set1_ps(ray.o[s.ky]);
        let oz = _mm256_set1_ps(ray.o[s.kz]);
        let (sx, sy) = (_mm256_set1_ps(s.sx), _mm256_set1_ps(s.sy));
        macro_rules! vertex {
            ($v:literal) => {{
                let at = rows.add(3 * pick[$v] * n);
                let z = _mm256_sub_ps(_mm256_loadu_ps(at.add(s.kz * n)), oz);
                let x = _mm256_sub_ps(_mm256_loadu_ps(at.add(s.kx * n)), ox);
                let y = _mm256_sub_ps(_mm256_loadu_ps(at.add(s.ky * n)), oy);
                let x = _mm256_sub_ps(x, _mm256_mul_ps(sx, z));
                let y = _mm256_sub_ps(y, _mm256_mul_ps(sy, z));
                (x, y, z)
            }};
        }
        macro_rules! cross {
            ($a:expr, $b:expr, $c:expr, $d:expr) => {
                _mm256_sub_ps(_mm256_mul_ps($a, $b), _mm256_mul_ps($c, $d))
            };
        }
        let ((x0, y0, z0), (x1, y1, z1), (x2, y2, z2)) = (vertex!(0), vertex!(1), vertex!(2));
        let u = cross!(x2, y1, y2, x1);
        let v = cross!(x0, y2, y0, x2);
        let w = cross!(x1, y0, y1, x0);
        let lowest = _mm256_min_ps(w, _mm256_min_ps(u, v));
        let highest = _mm256_max_ps(w, _mm256_max_ps(u, v));
        let zero = _mm256_setzero_ps();
        let one_sign = _mm256_or_ps(
            _mm256_cmp_ps::<_CMP_GE_OQ>(lowest, zero),
            _mm256_cmp_ps::<_CMP_LE_OQ>(highest, zero),
        );
        let mut out = Candidates {
            mask: _mm256_movemask_ps(one_sign) as u32,
            ..Candidates::default()
        };
        let [weights, depths] = [&mut out.weights, &mut out.depths];
        _mm256_storeu_ps(weights[0].as_mut_ptr(), u);
        _mm256_storeu_ps(weights[1].as_mut_ptr(), v);
        _mm256_storeu_ps(weights[2].as_mut_ptr(), w);
        _mm256_storeu_ps(depths[0].as_mut_ptr(), z0);
        _mm256_storeu_ps(depths[1].as_mut_ptr(), z1);
        _mm256_storeu_ps(depths[2].as_mut_ptr(), z2);
        out
    }
}
