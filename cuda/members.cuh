#pragma once
#include <cstdint>

namespace catena::cuda {

/// Which spheres of a chain a DeviceSphereCells sorts, asked on the device: of members.asked() numbers k
/// that come in an order of its own, sphere members.sphere(k) where members.takes(k); about
/// members.expected() of them, and not one unless members.any(). Where only the device knows that they are
/// all spheres, members.all() says so. A search of them has at most members.most_search_blocks thread
/// blocks: more even out what some have to do, but each 1000 take 1.3 us though none has anything.
struct AllSpheres {
  static constexpr std::uint32_t threads = 256, most_blocks = 1056, most_search_blocks = 4224;
  std::uint32_t size;
  __device__ bool any() const { return true; }
  __device__ std::uint32_t asked() const { return size; }
  __device__ std::uint32_t sphere(std::uint32_t k) const { return k; }
  __device__ bool takes(std::uint32_t) const { return true; }
  __device__ std::uint32_t expected() const { return size; }
};

/// The calling thread's share of 0 .. count - 1.
template <class Body>
__device__ void for_each_of_mine(std::uint32_t count, const Body& body) {
  for (std::uint64_t k = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; k < count;
       k += std::uint64_t{gridDim.x} * blockDim.x)
    body(static_cast<std::uint32_t>(k));
}
/// Sphere members.sphere(k), or 0 where there is no such member: then `in` is false. Without a branch, so
/// that what several of these read is on its way together. At least one is asked for.
struct Member {
  template <class Members>
  __device__ Member(const Members& members, std::uint32_t asked, std::uint64_t k) {
    const auto at = static_cast<std::uint32_t>(k < asked ? k : asked - 1);
    in = (k < asked) & members.takes(at);
    sphere = in ? members.sphere(at) : 0;
  }
  Member() = default;
  bool in;
  std::uint32_t sphere;
};
/// The same for members, some at a time: of each first get(sphere), then use(sphere, what it got), so that
/// what the first ones read is on its way together.
template <class Members, class Get, class Use>
__device__ void for_members_together(const Members& members, const Get& get, const Use& use) {
  if constexpr (requires { members.all(); })
    if (members.all()) return for_members_together(AllSpheres{members.size}, get, use);
  constexpr std::uint32_t together = 4;
  const std::uint32_t asked = members.asked();
  const std::uint64_t step = std::uint64_t{gridDim.x} * blockDim.x;
  for (std::uint64_t first = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x; first < asked;
       first += together * step) {
    Member member[together];
    decltype(get(0u)) got[together];
#pragma unroll
    for (std::uint32_t k = 0; k < together; ++k) member[k] = Member(members, asked, first + k * step);
#pragma unroll
    for (std::uint32_t k = 0; k < together; ++k)
      if (member[k].in) got[k] = get(member[k].sphere);
#pragma unroll
    for (std::uint32_t k = 0; k < together; ++k)
      if (member[k].in) use(member[k].sphere, got[k]);
  }
}
template <class Members, class Body>
__device__ void for_each_member(const Members& members, const Body& body) {
  for_each_of_mine(members.asked(), [&](std::uint32_t k) {
    if (members.takes(k)) body(members.sphere(k));
  });
}

}  // namespace catena::cuda
