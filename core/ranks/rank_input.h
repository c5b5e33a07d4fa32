#pragma once
#include <optional>
#include <utility>

#include "catena/core/commands/frame_option.h"
#include "catena/core/input/input.h"
#include "catena/core/readers/binary_chain.h"
#include "catena/core/ranks/named_part.h"

namespace catena::ranks {

/// A scene or a file, opened by ranks: of a .catena file each reads its part, anything else is read by rank 0, which sends
/// each its part. All ranks call every function. Throws as open_input and BinaryChain do.
class RankInput {
 public:
  /// Opens a file of which parts can be read.
  using Open = std::function<BinaryChain(const std::string& name)>;

  RankInput(Communicator& ranks, const std::string& spec, const InputOptions& options, const Open& open);

  /// The frames [first, last) that the option names.
  std::pair<std::uint32_t, std::uint32_t> frames(const FrameOption& option) const;
  /// The spheres of this rank in that frame: as many as the others have, give or take one.
  NamedPart part(std::uint32_t frame) const;
  /// The whole chain in that frame, on rank 0; none on others.
  std::optional<Chain> whole(std::uint32_t frame) const;

 private:
  Communicator& ranks_;
  std::optional<Input> input_;
  std::optional<BinaryChain> file_;
};

}  // namespace catena::ranks
