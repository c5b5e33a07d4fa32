#pragma once
#include <functional>
#include <string>
#include <vector>

#include "catena/core/commands/answer_rows.h"
#include "catena/core/readers/labels.h"
#include "catena/core/ranks/communicator.h"
#include "catena/core/ranks/part.h"

namespace catena::ranks {

/// What the user's file calls the spheres and strands of a part.
struct PartNames {
  std::vector<std::string> labels;   ///< one a sphere; none: their numbers
  std::vector<std::string> strands;  ///< one a piece; none: their numbers
};

/// A part, and what its spheres are called.
struct NamedPart {
  Part part;
  PartNames names;
};

/// A part with its names, where the input has some.
NamedPart named_part_of(const Chain& chain, const Labels& labels, std::uint32_t first, std::uint32_t end);

/// Rank 0 cuts the part of each rank and sends it, one after the other, the spheres some at a time: it holds
/// one part besides its own, and no rank holds one twice.
NamedPart scatter(Communicator& ranks, const std::function<NamedPart(unsigned rank)>& cut);

/// A sphere as answers name it, and where it is.
struct Described {
  NamedSphere named;
  Sphere sphere;
};

/// What answers say of the spheres that a rank began with; other ranks ask for it.
class Directory {
 public:
  /// `with_spheres`: it also tells where they are, which takes a copy of all.
  Directory(const NamedPart& part, bool with_spheres);

  /// Of this rank; its sphere is 0 where they are not told.
  Described at(SphereId id) const;
  /// Of any ranks, in the order of `ids`. All ranks call it. O(ids log ids).
  std::vector<Described> of(Communicator& ranks, const std::vector<SphereId>& starts, std::vector<SphereId> ids) const;

 private:
  std::vector<Sphere> spheres_;
  std::vector<Piece> pieces_;
  PartNames names_;
};

}  // namespace catena::ranks
