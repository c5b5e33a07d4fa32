#include "catena/core/executor/pair_collector.h"
#include "catena/core/strategy/register.h"

#ifdef CATENA_HAS_FCL
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>
#endif

// FCL, the Flexible Collision Library, in binary64: fcl::Sphere<double> in a DynamicAABBTreeCollisionManager,
// neighbours left out by the chain's rule. It compares |cA - cB| with rA + rB, both rounded, and boxes with
// rounded faces, so a pair within some 2^-50 of touching may go either way. It digests every valid chain: no
// binary32 number can overflow or underflow in it.
namespace catena::reference {
namespace {

#ifdef CATENA_HAS_FCL

std::optional<std::string> unavailable() { return std::nullopt; }

class FCL final : public Variant {
  using Object = fcl::CollisionObject<double>;
  using Manager = fcl::DynamicAABBTreeCollisionManager<double>;

 public:
  void build(const Chain& chain) override {
    const Stopwatch watch;
    manager_.reset();
    objects_.clear();
    // The tree refers to the objects by address, so they must not move once registered.
    objects_.reserve(chain.size());
    std::vector<Object*> pointers;
    for (std::uint32_t i = 0; i < chain.size(); ++i) {
      const Sphere& s = chain[i];
      fcl::Transform3<double> place = fcl::Transform3<double>::Identity();
      place.translation() = fcl::Vector3<double>(s.x, s.y, s.z);
      objects_.emplace_back(std::make_shared<fcl::Sphere<double>>(s.radius), place);
      objects_.back().setUserData(reinterpret_cast<void*>(std::uintptr_t{i}));
      pointers.push_back(&objects_.back());
    }
    if (chain.size() > 1) {  // a tree of one leaf or none has nothing to say
      manager_ = std::make_unique<Manager>();
      manager_->registerObjects(pointers);
      manager_->setup();
    }
    timings_.build_ms = watch.ms();
  }

  void find(const Chain& chain, const Request& request, Collisions& result) override {
    if (objects_.size() != chain.size()) throw std::logic_error("find: not the chain of the last build");
    const Stopwatch watch;
    PairCollector collector(chain.size(), request, result);
    Meeting meeting{chain, collector.lane(0)};
    if (manager_) manager_->collide(&meeting, &Meeting::meet);
    collector.finish();
    timings_.find_ms = watch.ms();
  }

  Timings timings() const override { return timings_; }

 private:
  struct Meeting {
    const Chain& chain;
    PairCollector::Lane& lane;

    static std::uint32_t index(const Object& object) {
      return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
    }
    /// True: enough was found.
    static bool meet(Object* a, Object* b, void* self) {
      auto& meeting = *static_cast<Meeting*>(self);
      const std::uint32_t p = index(*a), q = index(*b), i = std::min(p, q), j = std::max(p, q);
      if (meeting.chain.neighbours(i, j)) return false;
      const fcl::CollisionRequest<double> request;
      fcl::CollisionResult<double> result;
      if (fcl::collide(a, b, request, result) > 0) meeting.lane.collide(i, j);
      return meeting.lane.satisfied();
    }
  };

  std::vector<Object> objects_;
  std::unique_ptr<Manager> manager_;  // refers to the objects, so it goes first
  Timings timings_;
};

#else

std::optional<std::string> unavailable() { return "catena was built without FCL (libfcl-dev)"; }

class FCL final : public Variant {
 public:
  void build(const Chain&) override { throw CapacityError(*unavailable()); }
  void find(const Chain&, const Request&, Collisions&) override { throw CapacityError(*unavailable()); }
  Timings timings() const override { return {}; }
};

#endif

[[maybe_unused]] const bool registered = [] {
  StrategyInfo info;
  info.name = "FCL";
  info.summary = "the Flexible Collision Library: a dynamic tree of boxes in binary64, refined pair by pair";
  info.peer = true;
  info.unavailable = unavailable;
  StrategyRegistry::instance().add_variant(info, {.name = "binary64", .exact = false},
                                           make_strategy<FCL, Variant>);
  return true;
}();

}  // namespace
}  // namespace catena::reference
