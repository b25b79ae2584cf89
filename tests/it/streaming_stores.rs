//! Outputs that are larger than the caches are stored past them, where blocks are aligned for that.

use unitpack::{Codec, Oct16, Snorm8x3, Snorm16x3, SoaMut};

use unitpack_test::random::Rng;

/// 36 MB of vectors, and no whole number of blocks.
const LEN: usize = 3_000_011;
/// Vectors decoded at once to compare with.
const FEW: usize = 1000;
const SENTINEL: f32 = 7.0;

/// Decodes with each component at its own offset from where it begins.
fn large_equals_small<C: Codec>(offsets: [usize; 3]) {
    let mut rng = Rng::new(LEN as u64);
    let mut codes = vec![C::encode([0.0; 3]); LEN];
    for byte in bytemuck::cast_slice_mut::<_, u8>(&mut codes) {
        *byte = rng.bits() as u8;
    }
    let mut out = [0; 3].map(|_| vec![SENTINEL; LEN + 32]);
    {
        let [x, y, z] = &mut out;
        let [i, j, k] = offsets;
        let v = SoaMut { x: &mut x[i..][..LEN], y: &mut y[j..][..LEN], z: &mut z[k..][..LEN] };
        C::decode_soa(&codes, v).unwrap();
    }
    let mut few = [[SENTINEL; FEW]; 3];
    for (n, codes) in codes.chunks(FEW).enumerate() {
        let [x, y, z] = few.each_mut().map(|c| &mut c[..codes.len()]);
        C::decode_soa(codes, SoaMut { x, y, z }).unwrap();
        for ((out, few), offset) in out.iter().zip(&few).zip(offsets) {
            assert!(out[offset + n * FEW..][..codes.len()] == few[..codes.len()]);
        }
    }
    for (out, offset) in out.iter().zip(offsets) {
        let around = out[..offset].iter().chain(&out[offset + LEN..]);
        assert!(around.copied().eq([SENTINEL; 32]));
    }
}

#[test]
fn large_outputs_equal_small_ones() {
    for start in [0, 1, 13, 31] {
        large_equals_small::<Oct16>([start; 3]);
    }
    large_equals_small::<Oct16>([3, 7, 0]);
    large_equals_small::<Snorm8x3>([0, 16, 8]);
    large_equals_small::<Snorm16x3>([5, 5, 6]);
}
