#pragma once
#include <memory>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/strategy/moved.h"
#include "catena/core/strategy/request.h"
#include "catena/core/strategy/variant.h"

namespace catena {

class KeepsAnswer;

/// Frame after frame of a chain, each searched by what it has in common with the last one (the variant
/// `auto`). The answer stays here, so that of a frame which moved little no more is written than what moved:
/// Variant::find fills the caller's vectors, n counts and all pairs, each time.
class CATENA_API Film {
 public:
  /// What is asked of each frame, of all its spheres.
  explicit Film(Request::Want want = Request::Want::pairs);
  ~Film();
  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;

  /// The answer to the next frame, valid until the one after it. `moved`: in what it differs from the last
  /// frame, where the caller knows; what is not told is compared bit by bit. Throws as Variant::build and
  /// Variant::find do. O(1) for an unmoved frame that was told of. Where counts are asked for, pairs may be
  /// there.
  const Collisions& next(const Chain& chain, const Moved& moved = {});

  /// What searched the last frame: its times, and its plan.
  const Variant& variant() const { return *variant_; }

 private:
  Request request_;
  std::unique_ptr<Variant> variant_;
  KeepsAnswer* keeper_;  ///< the same
  bool begun_ = false;
};

}  // namespace catena
