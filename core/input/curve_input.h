#pragma once
#include <string>

#include "catena/core/chain/chain.h"
#include "catena/core/input/input.h"
#include "catena/core/readers/reader.h"

namespace catena {

/// Adds what the user says to what a file says, in every frame: radii where the file has none, closure.
/// `name` is the file, for errors. Adds to the warnings what had to be assumed, and what the rounding to
/// binary32 has cost. Throws InputError when the options do not fit the file.
void complete(CurveFile& curves, const InputOptions& options, const std::string& name);

/// The chain of the first frame of completed curves, with the file's exclusion rule or that of the options,
/// and the neighbours across joints. Where boxes repeat space, arc lengths are those of the tubes that the
/// box cuts apart (see unwrapped). Throws InputError when it is none.
Chain make_chain(CurveFile curves, const InputOptions& options);

/// Half the median distance of consecutive centres along the strands, the closing step of closed strands
/// included: a usable radius for points without one. 0 when no strand has two spheres. O(n).
double half_median_step(const CurveFile& curves);

/// The exclusion rule that the options ask for, with the extra pairs of `own`; `own` itself when they ask for
/// none. Throws InputError for both windows, a window of 0, or an arc window that is not finite and above 0.
Exclusion chosen_exclusion(const InputOptions& options, const Exclusion& own);

}  // namespace catena
