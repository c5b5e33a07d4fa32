#include "catena/reference/peers/peer.h"

#ifdef CATENA_HAS_PEER
#include <nanoflann.hpp>
#endif

// nanoflann, a k-d tree of centres. Each sphere looks for the centres within twice its own radius, where
// every sphere that it collides with and that is not larger must be; so a few large spheres do not make all
// others look far. In binary64, where no square of binary32 numbers overflows or underflows.
namespace catena::reference {
namespace {

const PeerInfo info{.name = "nanoflann",
                    .summary = "a k-d tree of centres, searched within twice each radius",
                    .broad_phase = "binary64",
                    .source = "libnanoflann-dev"};

#ifdef CATENA_HAS_PEER

class Nanoflann final : public Peer {
  /// How nanoflann reads the centres: where they lie.
  struct Centres {
    ChainView chain{};
    std::size_t kdtree_get_point_count() const { return chain.size; }
    double kdtree_get_pt(std::uint32_t i, std::size_t axis) const {
      const Sphere& s = chain.spheres[i];
      return axis == 0 ? s.x : axis == 1 ? s.y : s.z;
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
      return false;  // it is nanoflann's to find
    }
  };
  using Metric = nanoflann::L2_Simple_Adaptor<double, Centres, double, std::uint32_t>;
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<Metric, Centres, 3, std::uint32_t>;

  void make(const ChainView& chain) override {
    centres_.chain = chain;
    tree_.reset();
    tree_ = std::make_unique<Tree>(3, centres_);  // leaves of 10, the default
  }

  void offer(const ChainView& chain, const Candidates& candidates) override {
    centres_.chain = chain;
    for (std::uint32_t i = 0; i < chain.size && !candidates.enough(); ++i) {
      const Sphere& s = chain.spheres[i];
      const double centre[] = {s.x, s.y, s.z};
      NoLarger near(chain, candidates, i);
      tree_->radiusSearchCustomCallback(centre, near, nanoflann::SearchParams(0, 0, false));
    }
  }

  /// Takes what is near sphere i and not larger; of equal ones what comes later, so that a pair is met once.
  class NoLarger {
   public:
    NoLarger(const ChainView& chain, const Candidates& candidates, std::uint32_t i)
        : chain_(chain), candidates_(candidates), i_(i) {
      const double reach = 2.0 * chain.spheres[i].radius;
      square_ =
          reach * reach * (1 + 0x1p-40) + std::numeric_limits<double>::min();  // it asks for less, and rounds
    }
    bool addPoint(double, std::uint32_t j) {
      const float own = chain_.spheres[i_].radius, other = chain_.spheres[j].radius;
      if (other < own || (other == own && i_ < j)) candidates_(i_, j);
      return true;
    }
    double worstDist() const { return square_; }
    bool full() const { return true; }
    std::size_t size() const { return 0; }

   private:
    const ChainView& chain_;
    const Candidates& candidates_;
    std::uint32_t i_;
    double square_;
  };

  Centres centres_;
  std::unique_ptr<Tree> tree_;
};

[[maybe_unused]] const RegisterPeer<Nanoflann> registered{info};
#else
[[maybe_unused]] const RegisterAbsentPeer registered{info};
#endif

}  // namespace
}  // namespace catena::reference
