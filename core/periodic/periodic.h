#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// A search in space that a box repeats, by any variant: i and j collide when they are no neighbours and i
/// overlaps some image of j, |ci - (cj + n * edges)|^2 <= (ri + rj)^2, exactly, on the stored spheres and the
/// box (see image_overlaps). Each pair comes once, with the ids of the chain; a sphere never meets its own
/// images. The width of the box is at least twice the largest sum of two radii, so that no two images of one
/// sphere are both within reach, but where both touch.
///
/// How: spheres are put into one box, and those within reach of a face get images on the other side, for one
/// of each two opposite shifts, so that a pair across a face is met once. An image's centre is seldom a
/// number in binary32, so it is rounded and its radius enlarged by what that may cost; the variant searches
/// this chain, and what it finds of moved spheres is decided again, exactly. So the answer is that of the
/// definition for every variant that is exact.
///
/// find costs the variant's search for pairs, whatever is wanted, and O(1) a pair found; but for yes or no,
/// which a build was prepared for, the chain is searched first as it is stored: that is the answer where it
/// is yes, and where no image of the chain reaches another. A flood of pairs is searched in parts, and only
/// those that are wanted are kept. Each frame is searched for itself.
class Periodic final : public Variant {
 public:
  Periodic(std::unique_ptr<Variant> variant, const PeriodicBox& box)
      : variant_(std::move(variant)), next_box_(box) {}

  /// Spheres that the last build added for the faces of the box.
  std::uint32_t images() const { return static_cast<std::uint32_t>(ghosts_.size()); }

  void prepare(const Request& request) override { prepared_ = request; }
  /// For the next build.
  void set_box(const PeriodicBox& box) { next_box_ = box; }

  /// Throws InputError for a box that is too narrow (see check_box), and a sphere more than 2^20 boxes away.
  void build(const Chain& chain) override;
  void update(const Chain& chain, const Moved&) override { build(chain), follows_ = true; }
  void find(const Chain& chain, const Request& request, Collisions& result) override;
  Timings timings() const override { return timings_; }
  Plan plan() const override;
  std::vector<WorkDone> work() const override { return variant_->work(); }
  std::string answered_by() const override { return variant_->answered_by(); }

 private:
  struct Ghost {
    std::uint32_t sphere;
    Shift shift;
  };
  struct Search {
    const Chain& chain;
    const Request& request;
    Collisions& result;
  };

  std::optional<bool> known_as_stored(const Chain& chain);
  void build_images(const Chain& chain);
  bool knows(const Request& request) const;
  void put_into_box(const Chain& chain);
  std::array<double, 3> margins(const Chain& chain) const;
  void add_ghosts(const Chain& chain);
  Sphere image(const Sphere& sphere, const Shift& shift) const;
  Chain chain_of_images(const Chain& chain) const;
  std::string images_in_words() const;
  void search(const Search& search, SphereRange queries);
  void meet(const Search& search, const Pair& candidate) const;
  bool collide(const Chain& chain, std::uint32_t i, std::uint32_t j, const Shift& shift) const;

  std::unique_ptr<Variant> variant_;
  PeriodicBox next_box_, box_;          ///< for the next build, and of the last one
  Request prepared_, asked_;            ///< for the next build, and of the last one
  std::optional<std::uint32_t> built_;  ///< spheres of the last build; nothing after one that threw
  std::optional<bool> known_;           ///< the answer to asked_, where it was found before there were images
  bool follows_ = false;                ///< the last build was an update
  bool images_built_ = false;           ///< by the variant, which has the chain as it is stored else
  bool tight_ = false;                  ///< two images of one sphere may both touch another
  bool apart_ = false;  ///< the chain is so short beside the box that no image of it reaches another
  std::array<double, 3> origin_{};
  std::vector<Shift> home_;  ///< of each sphere, into the box
  std::vector<Sphere> spheres_;
  std::vector<Ghost> ghosts_;
  Chain images_;  ///< the chain's spheres in the box, then the ghosts
  Collisions candidates_;
  Timings timings_;
};

/// Makes this a search in the boxes of an input, and goes to that of its first frame. Null where there is
/// none: the variant stays what it was.
Periodic* put_into_boxes(std::unique_ptr<Variant>& variant, std::span<const PeriodicBox> boxes);

/// The box of the next frame to be built, where there is one for each; `periodic` may be null.
void go_to_frame(Periodic* periodic, std::span<const PeriodicBox> boxes, std::uint32_t frame);

}  // namespace catena
