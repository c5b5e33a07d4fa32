#pragma once
#include <filesystem>
#include <iosfwd>

#include "catena/core/chain/chain.h"

namespace catena {

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
///     end                             what tells a whole file from a truncated one
///
/// `#` starts a comment; blank lines are skipped. A chain that was `moved` under an arc window is written
/// where it is now: the arc lengths of a reader are those of the written spheres.
///
/// Cost O(n). Throws InputError when the stream or the file cannot be written.
void write_chain(std::ostream& out, const Chain& chain);
void write_chain(const std::filesystem::path& file, const Chain& chain);

}  // namespace catena
