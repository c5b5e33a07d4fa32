#pragma once

/// The instruction sets that block searches are compiled for, of which the best that the machine has is taken
/// at run time: AVX-512, AVX2, SSE4 and plain code, or on ARM NEON alone. SSSE3 is older than any machine
/// that runs this; AVX-512's later parts bring these searches nothing; sizes known only at run time (SVE) do
/// not fit a struct of vectors.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
