#include "catena/reference/peers/peer.h"

#ifdef CATENA_HAS_PEER
#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include <numeric>
#include <random>
#include <vector>

#include "catena/core/hierarchy/box.h"
#endif

// Bullet's dynamic tree of boxes, btDbvt, which its broad phase and its soft bodies are made of: leaves
// inserted one by one, updated when they move, and the tree against itself.
namespace catena::reference {
namespace {

const PeerInfo info{
    .name = "Bullet",
    .summary = "Bullet's btDbvt: a dynamic tree of boxes, by random insertion; update moves leaves",
    .broad_phase = "binary32",
    .source = "libbullet-dev"};

#ifdef CATENA_HAS_PEER

class Bullet final : public Peer {
  /// Parts of Bullet recurse as deep as the tree, which insertion makes as deep as many spheres lie at one
  /// place.
  static constexpr std::uint32_t most_levels = 4096, look_every = 1024;

  /// Inserted in the order of a chain, each leaf would go below the one before it: a tree as deep as the
  /// chain is long.
  void make(const ChainView& chain) override {
    tree_.clear();
    leaves_.resize(chain.size);
    order_.resize(chain.size);
    std::iota(order_.begin(), order_.end(), 0u);
    std::shuffle(order_.begin(), order_.end(), std::minstd_rand());
    for (std::uint32_t k = 0; k < chain.size; ++k) {
      const std::uint32_t i = order_[k];
      leaves_[i] = tree_.insert(volume(chain.spheres[i]), reinterpret_cast<void*>(std::uintptr_t{i}));
      if (k % look_every == 0 && levels_above(leaves_[i]) > most_levels)
        throw CapacityError("Bullet's btDbvt::insert made a tree of more than " +
                            std::to_string(most_levels) + " levels, which its recursion does not hold");
    }
  }

  void move(const ChainView& chain) override {
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      btDbvtVolume moved = volume(chain.spheres[i]);
      tree_.update(leaves_[i], moved);
    }
  }

  void offer(const ChainView&, const Candidates& candidates) override {
    struct Meeting : btDbvt::ICollide {
      explicit Meeting(const Candidates& to) : candidates(to) {}
      void Process(const btDbvtNode* a, const btDbvtNode* b) {
        if (!candidates.enough()) candidates(index(a), index(b));
      }
      const Candidates& candidates;
    } meeting(candidates);
    tree_.selfCollideTT(tree_.m_root, meeting);
  }

  static std::uint32_t index(const btDbvtNode* leaf) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(leaf->data));
  }
  static btDbvtVolume volume(const Sphere& s) {
    const Box box = Box::around(s);
    return btDbvtVolume::FromMM({box.low[0], box.low[1], box.low[2]},
                                {box.high[0], box.high[1], box.high[2]});
  }
  static std::uint32_t levels_above(const btDbvtNode* node) {
    std::uint32_t levels = 0;
    for (; node->parent != nullptr && levels <= most_levels; node = node->parent) ++levels;
    return levels;
  }

  btDbvt tree_;
  std::vector<btDbvtNode*> leaves_;
  std::vector<std::uint32_t> order_;  ///< of insertion
};

[[maybe_unused]] const RegisterPeer<Bullet> registered{info};
#else
[[maybe_unused]] const RegisterAbsentPeer registered{info};
#endif

}  // namespace
}  // namespace catena::reference
