//! The square root, for standard deviations: `libm::sqrtf` is six times as large.

/// √x, to an ulp; NaN where x is negative.
#[inline(never)]
pub(crate) fn root(x: f32) -> f32 {
    if x < 0.0 {
        return f32::NAN;
    }
    let closer = |y: f32| 0.5 * (y + x / y);
    // Half the exponent: within a few per cent. From there Newton's steps come down from above, and end where rounding does,
    // or at what is zero or no finite number.
    let mut y = closer(f32::from_bits((x.to_bits() >> 1) + 0x1fbd_1df5));
    loop {
        let next = closer(y);
        if next < y {
            y = next;
        } else {
            return y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::root;

    /// Against `libm`: an ulp, from the smallest number to the largest.
    #[test]
    fn against_the_exact_one() {
        for bits in (0..f32::INFINITY.to_bits()).step_by(10_007).chain([1, 2, 3, f32::MAX.to_bits()]) {
            let x = f32::from_bits(bits);
            let off = root(x).to_bits().abs_diff(libm::sqrtf(x).to_bits());
            assert!(off <= 1, "{x}: {} for {}", root(x), libm::sqrtf(x));
        }
        assert_eq!([root(0.0), root(4.0), root(f32::INFINITY)], [0.0, 2.0, f32::INFINITY]);
        assert!(root(-1.0).is_nan() && root(f32::NAN).is_nan());
    }
}
