#pragma once
#include <optional>
#include <string>
#include <utility>

#include "catena/core/commands/frame_option.h"
#include "catena/core/input/input.h"
#include "catena/core/ranks/named_part.h"
#include "catena/core/ranks/rank_search.h"
#include "catena/core/readers/binary_chain.h"

namespace catena::ranks {

/// A scene or a file, opened by ranks: of a .catena file each reads its part, of a scene each makes its part,
/// unless an arc window needs the spheres before it, a tolerance all, or a box their images; anything else is
/// read by rank 0, which sends each its part. All ranks call every function. Throws as open_input and
/// BinaryChain do.
class RankInput {
 public:
  /// Opens a file of which parts can be read.
  using Open = std::function<BinaryChain(const std::string& name)>;

  RankInput(Communicator& ranks, const std::string& spec, const InputOptions& options, const Open& open);

  const std::string& name() const { return spec_; }
  /// Of that frame, as messages have it.
  std::string name_of(std::uint32_t frame) const;
  /// The frames [first, last) that the option names.
  std::pair<std::uint32_t, std::uint32_t> frames(const FrameOption& option) const;
  /// The spheres of this rank in that frame: as many as the others have, give or take one.
  NamedPart part(std::uint32_t frame) const;
  /// The box that repeats space in that frame, on every rank; null where none does. Rank 0 has the whole
  /// chain then.
  std::optional<PeriodicBox> box(std::uint32_t frame) const;
  /// The whole chain in that frame, on rank 0; none on others.
  std::optional<Chain> whole(std::uint32_t frame) const;

 private:
  enum class Source : std::uint8_t { rank_0, file, scene };  ///< where each rank has its part from
  Source decide(const InputOptions& options);

  Communicator& ranks_;
  std::string spec_;
  Source source_ = Source::rank_0;
  std::optional<Input> input_;  ///< on rank 0, unless the source is a file; on all where it is a scene
  std::optional<BinaryChain> file_;
};

/// What collides in that frame, of which `part` is this rank's, in its box where it has one: by search or
/// search_in_box; call it within together.
RankAnswer search_frame(Communicator& ranks, const RankInput& input, std::uint32_t frame,
                        const std::optional<PeriodicBox>& box, Part part, const RankOptions& options,
                        RankWork& work);

}  // namespace catena::ranks
