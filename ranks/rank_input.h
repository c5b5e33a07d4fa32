#pragma once
#include <optional>
#include <utility>

#include "catena/core/commands/frame_option.h"
#include "catena/core/input/input.h"
#include "catena/ranks/named_part.h"

namespace catena::ranks {

/// A scene or a file, opened by ranks: rank 0 reads it and sends each its part. All ranks call every function. Throws
/// as open_input does, on rank 0.
class RankInput {
 public:
  RankInput(Communicator& ranks, const std::string& spec, const InputOptions& options);

  /// The frames [first, last) that the option names.
  std::pair<std::uint32_t, std::uint32_t> frames(const FrameOption& option) const;
  /// The spheres of this rank in that frame: as many as the others have, give or take one.
  NamedPart part(std::uint32_t frame) const;
  /// On rank 0; null on others.
  const Input* whole() const { return input_ ? &*input_ : nullptr; }

 private:
  Communicator& ranks_;
  std::optional<Input> input_;
};

}  // namespace catena::ranks
