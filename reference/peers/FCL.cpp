#include "catena/reference/peers/peer.h"

#ifdef CATENA_HAS_PEER
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <vector>
#endif

// FCL, the Flexible Collision Library, in binary64: fcl::Sphere<double> in a DynamicAABBTreeCollisionManager.
// Its boxes have rounded faces, so a pair within some 2^-50 of touching may go either way. It digests every
// valid chain: no binary32 number can overflow or underflow in it.
namespace catena::reference {
namespace {

const PeerInfo info{
    .name = "FCL",
    .summary = "the Flexible Collision Library: a dynamic tree of boxes, which an update refits",
    .broad_phase = "binary64",
    .source = "libfcl-dev"};

#ifdef CATENA_HAS_PEER

class FCL final : public Peer {
  using Object = fcl::CollisionObject<double>;
  using Manager = fcl::DynamicAABBTreeCollisionManager<double>;

  void make(const ChainView& chain) override {
    manager_.reset();
    objects_.clear();
    shapes_.clear();
    // The tree refers to the objects by address, so they must not move once registered.
    objects_.reserve(chain.size);
    std::vector<Object*> pointers;
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      const Sphere& s = chain.spheres[i];
      fcl::Transform3<double> place = fcl::Transform3<double>::Identity();
      place.translation() = fcl::Vector3<double>(s.x, s.y, s.z);
      shapes_.push_back(std::make_shared<fcl::Sphere<double>>(s.radius));
      objects_.emplace_back(shapes_.back(), place);
      objects_.back().setUserData(reinterpret_cast<void*>(std::uintptr_t{i}));
      pointers.push_back(&objects_.back());
    }
    if (chain.size > 1) {  // a tree of one leaf or none has nothing to say
      manager_ = std::make_unique<Manager>();
      manager_->registerObjects(pointers);
      manager_->setup();
    }
  }

  void move(const ChainView& chain) override {
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      const Sphere& s = chain.spheres[i];
      if (shapes_[i]->radius != double{s.radius}) {
        shapes_[i]->radius = s.radius;
        shapes_[i]->computeLocalAABB();
      }
      objects_[i].setTranslation(fcl::Vector3<double>(s.x, s.y, s.z));
      objects_[i].computeAABB();
    }
    if (manager_) manager_->update();
  }

  void offer(const ChainView&, const Candidates& candidates) override {
    manager_->collide(const_cast<Candidates*>(&candidates), &meet);
  }

  static std::uint32_t index(const Object& object) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
  }
  /// True: enough was found.
  static bool meet(Object* a, Object* b, void* candidates) {
    const auto& offered = *static_cast<const Candidates*>(candidates);
    offered(index(*a), index(*b));
    return offered.enough();
  }

  std::vector<std::shared_ptr<fcl::Sphere<double>>> shapes_;
  std::vector<Object> objects_;
  std::unique_ptr<Manager> manager_;  // refers to the objects, so it goes first
};

[[maybe_unused]] const RegisterPeer<FCL> registered{info};
#else
[[maybe_unused]] const RegisterAbsentPeer registered{info};
#endif

}  // namespace
}  // namespace catena::reference
