#include "catena/reference/fcl.h"

#include "catena/core/error.h"

#ifdef CATENA_HAS_FCL
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "catena/reference/tally.h"
#endif

namespace catena::reference {

#ifndef CATENA_HAS_FCL

std::optional<std::string> fcl_unavailable() { return "catena was built without FCL (libfcl-dev)"; }

Collisions fcl_collisions(const Chain&, const Request&) { throw CapacityError(*fcl_unavailable()); }

#else

namespace {

using Object = fcl::CollisionObject<double>;

struct Callback {
  const Chain& chain;
  Tally tally;

  static std::uint32_t index(const Object& object) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(object.getUserData()));
  }
  static bool meet(Object* a, Object* b, void* self) {
    auto& callback = *static_cast<Callback*>(self);
    const std::uint32_t i = index(*a), j = index(*b);
    if (callback.chain.neighbours(i, j)) return false;
    const fcl::CollisionRequest<double> request;
    fcl::CollisionResult<double> result;
    if (fcl::collide(a, b, request, result) > 0) callback.tally.add(i, j);
    return false;  // go on
  }
};

}  // namespace

std::optional<std::string> fcl_unavailable() { return std::nullopt; }

Collisions fcl_collisions(const Chain& chain, const Request& request) {
  Callback callback{chain, Tally(chain.size(), request)};
  // The tree refers to the objects by address, so they must not move once registered.
  std::vector<Object> objects;
  std::vector<Object*> pointers;
  objects.reserve(chain.size());
  for (std::uint32_t i = 0; i < chain.size(); ++i) {
    const Sphere& s = chain[i];
    fcl::Transform3<double> place = fcl::Transform3<double>::Identity();
    place.translation() = fcl::Vector3<double>(s.x, s.y, s.z);
    objects.emplace_back(std::make_shared<fcl::Sphere<double> >(s.radius), place);
    objects.back().setUserData(reinterpret_cast<void*>(std::uintptr_t{i}));
    pointers.push_back(&objects.back());
  }
  if (chain.size() > 1) {  // a tree of one leaf or none has nothing to say
    fcl::DynamicAABBTreeCollisionManager<double> manager;
    manager.registerObjects(pointers);
    manager.setup();
    manager.collide(&callback, &Callback::meet);
  }
  Answer answer = std::move(callback.tally).finish();
  return {answer.pair_count > 0, answer.pair_count, std::move(answer.count), std::move(answer.pairs)};
}

#endif

}  // namespace catena::reference
