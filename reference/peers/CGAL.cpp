#include "catena/reference/peers/peer.h"

#ifdef CATENA_HAS_PEER
#include <CGAL/box_intersection_d.h>

#include <cmath>
#include <limits>
#include <vector>

#include "catena/core/hierarchy/box.h"
#endif

// CGAL's box_self_intersection_d, a hybrid of segment trees and sweeps (Zomorodian and Edelsbrunner 2002), on
// boxes in binary32. It has no structure to build but the boxes, and cannot stop early. Under the GPL: built
// in only when asked for.
namespace catena::reference {
namespace {

const PeerInfo info{.name = "CGAL",
                    .summary = "CGAL's box_self_intersection_d: streamed segment trees and sweeps of boxes",
                    .broad_phase = "binary32",
                    .source = "under the GPL, so only with -DCATENA_CGAL=ON, and libcgal-dev"};

#ifdef CATENA_HAS_PEER

class CGALBoxes final : public Peer {
  /// CGAL's concept of a box; small, as its manual advises for sequences that are sorted in place.
  class SphereBox {
   public:
    using NT = float;
    using ID = std::uint32_t;
    SphereBox(const Sphere& s, std::uint32_t i) : box_(Box::around(s)), id_(i) {}
    static int dimension() { return 3; }
    ID id() const { return id_; }
    /// CGAL takes no infinite end. No centre is beyond the greatest float, so boxes cut there meet as before.
    NT min_coord(int axis) const { return std::max(box_.low[axis], -std::numeric_limits<float>::max()); }
    NT max_coord(int axis) const { return std::min(box_.high[axis], std::numeric_limits<float>::max()); }

   private:
    Box box_;
    ID id_;
  };

  void make(const ChainView& chain) override {
    boxes_.clear();
    boxes_.reserve(chain.size);
    for (std::uint32_t i = 0; i < chain.size; ++i) boxes_.emplace_back(chain.spheres[i], i);
  }

  void offer(const ChainView&, const Candidates& candidates) override {
    sorted_ = boxes_;  // each search begins with the chain's order, and sorts
    CGAL::box_self_intersection_d(sorted_.begin(), sorted_.end(),
                                  [&](const SphereBox& a, const SphereBox& b) {
                                    if (!candidates.enough()) candidates(a.id(), b.id());
                                  });
  }

  std::vector<SphereBox> boxes_, sorted_;
};

[[maybe_unused]] const RegisterPeer<CGALBoxes> registered{info};
#else
[[maybe_unused]] const RegisterAbsentPeer registered{info};
#endif

}  // namespace
}  // namespace catena::reference
