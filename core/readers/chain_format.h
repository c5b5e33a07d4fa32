#pragma once
#include <filesystem>
#include <iosfwd>
#include <span>

#include "catena/core/chain/chain.h"

namespace catena {

// clang-format off
/// Catena's own plain text, `.chain`: everything that Chain is made from, and every float as the shortest
/// text that reads as exactly that float (also -0 and denormals). Reading it back and making a Chain gives
/// the same chain.
///
///     catena-chain 1                  the format and its version
///     window 1                        or: arc_window 1.5707963267948966
///     strand open 3                   or closed; as many lines `x y z radius` follow
///     0 0 0 0.5
///     1 0 0 0.5
///     2 0 0 0.5
///     pairs 1                         extra neighbours, by sphere number from 0; as many lines `i j` follow
///     0 2
///     joints 1                        steps of the tube beside those of the strands: where a branch begins,
///     0 2                             or a loop ends on itself; as many lines `i j`. Neighbours across them
///                                     follow from the rule
///     end                             what tells a whole file from a truncated one
///
/// `#` starts a comment; blank lines are skipped. A chain that was `moved` under an arc window is written
/// where it is now: the arc lengths of a reader are those of the written spheres.
///
/// Extra pairs that follow from the joints (see pairs_across_joints) are not written a second time.
///
/// Cost O(n), and that of pairs_across_joints. Throws InputError when the stream or the file cannot be
/// written, and for a joint that names no sphere.
// clang-format on
void write_chain(std::ostream& out, const Chain& chain, std::span<const Pair> joints = {});
/// The same as a file, whole or not at all; see OutputFile.
void write_chain(const std::filesystem::path& file, const Chain& chain, std::span<const Pair> joints = {});

}  // namespace catena
