//! Counter-based random numbers: a number is a pure function of what names it.
//!
//! Nothing here has state, so a picture cannot depend on threads, tiles or the order of work.

/// A bijection of 32 bits with good avalanche: the `lowbias32` constants of Wellons 2018,
/// "Prospecting for Hash Functions".
#[inline(always)]
pub const fn finalize(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// A hash of two words. Not symmetric; chain it for more words.
#[inline(always)]
pub const fn mix(a: u32, b: u32) -> u32 {
    finalize(a ^ finalize(b.wrapping_add(0x9e37_79b9)).wrapping_mul(0x85eb_ca6b))
}

/// A bijection of 64 bits: the finaliser of SplitMix64 (Steele, Lea, Flood 2014).
#[inline(always)]
pub const fn finalize64(mut x: u64) -> u64 {
    x ^= x >> 30;
    x = x.wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x ^= x >> 27;
    x = x.wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// A hash of two 64-bit words.
#[inline(always)]
pub const fn mix64(a: u64, b: u64) -> u64 {
    finalize64(a ^ finalize64(b.wrapping_add(0x9e37_79b9_7f4a_7c15)))
}

/// 32 random bits to a float in `[0, 1)`, evenly spaced by 2⁻²⁴: never 1, whatever the rounding.
#[inline(always)]
pub const fn unit_f32(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_f32_stays_below_one() {
        assert_eq!(unit_f32(0), 0.0);
        assert_eq!(unit_f32(u32::MAX), 1.0 - f32::EPSILON / 2.0);
    }

    /// Flipping one input bit flips each output bit with probability 1/2. 4096 trials a cell give
    /// σ = 1/128; 32·32·2 cells at 6σ leave a false alarm under 10⁻⁵ and catch a bias of 5 %.
    #[test]
    fn mix_avalanches_in_both_words() {
        for word in 0..2 {
            for bit in 0..32 {
                let mut flips = [0u32; 32];
                for i in 0..4096u32 {
                    let (a, b) = (finalize(2 * i), finalize(2 * i + 1));
                    let (c, d) = if word == 0 {
                        (a ^ (1 << bit), b)
                    } else {
                        (a, b ^ (1 << bit))
                    };
                    let diff = mix(a, b) ^ mix(c, d);
                    for (k, f) in flips.iter_mut().enumerate() {
                        *f += (diff >> k) & 1;
                    }
                }
                for f in flips {
                    let p = f64::from(f) / 4096.0;
                    assert!((p - 0.5).abs() < 6.0 / 128.0, "word {word} bit {bit}: {p}");
                }
            }
        }
    }
}
