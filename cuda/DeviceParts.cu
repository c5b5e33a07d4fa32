#include <algorithm>
#include <limits>
#include <string>

#include "catena/core/parts/parted_search.h"
#include "catena/core/strategy/register.h"
#include "catena/cuda/call.h"
#include "catena/cuda/device.h"
#include "catena/cuda/part_on_device.h"

namespace catena::cuda {
namespace {

/// What DeviceHybrid takes of a device for a sphere, its answer with a few pairs included; where they are
/// more and memory runs out, parts become smaller.
constexpr std::uint64_t bytes_a_sphere = 128;
/// A shorter part keeps a device waiting for launches.
constexpr std::uint32_t least_part = 1u << 20;

std::uint32_t count_devices(const Parameters& parameters) {
  int there = 0;
  CATENA_CUDA(cudaGetDeviceCount(&there));
  const auto asked = static_cast<std::uint32_t>(parameters.unsigned_integer("devices", 0, 1024));
  if (asked > static_cast<std::uint32_t>(there)) require_device(Place::device(asked - 1));
  return asked == 0 ? static_cast<std::uint32_t>(there) : asked;
}

/// Spheres that each of some searches has room for on every device.
std::uint64_t room(const Parameters& parameters, std::uint32_t devices, std::uint64_t searches) {
  std::uint64_t bytes = parameters.unsigned_integer("memory", 0, 1u << 30) << 20;
  if (bytes == 0) bytes = std::numeric_limits<std::uint64_t>::max();
  for (std::uint32_t k = 0; k < devices; ++k) {
    const DeviceScope scope(Place::device(k));
    std::size_t free = 0, total = 0;
    CATENA_CUDA(cudaMemGetInfo(&free, &total));
    bytes = std::min<std::uint64_t>(bytes, free / 10 * 9);
  }
  return std::max<std::uint64_t>(1,
                                 std::min<std::uint64_t>(bytes / searches / bytes_a_sphere, (1u << 31) - 1));
}

/// DeviceParts: a chain in parts, each with what may touch it, searched as by DeviceHybrid. A part a device
/// where they all fit; else part after part, some at a time on each device, so that one is moved while
/// another is searched.
template <class Arithmetic>
class DeviceParts final : public Variant {
 public:
  explicit DeviceParts(const Parameters& parameters)
      : DeviceParts(parameters, count_devices(parameters),
                    static_cast<std::uint32_t>(parameters.unsigned_integer("searches", 1, 16))) {}

  void prepare(const Request& request) override { request_ = request; }
  void build(const Chain& chain) override { search_.build(chain, request_); }
  void find(const Chain& chain, const Request& request, Collisions& result) override {
    search_.find(chain, request, result);
  }
  Timings timings() const override { return search_.timings(); }
  Plan plan() const override { return search_.plan(); }
  std::vector<WorkDone> work() const override { return search_.work(); }

 private:
  DeviceParts(const Parameters& parameters, std::uint32_t devices, std::uint32_t searches)
      : team_({"DeviceParts", {{"threads", "0", "that part the chain"}}, ""}),
        search_(searches_on(devices, searches), options_of(parameters, devices, searches), team_) {}

  /// The first ones on a device each.
  static std::vector<std::unique_ptr<parts::PartSearch>> searches_on(std::uint32_t devices,
                                                                     std::uint32_t each) {
    std::vector<std::unique_ptr<parts::PartSearch>> searches;
    for (std::uint32_t k = 0; k < devices * each; ++k)
      searches.push_back(make_part_on_device(Place::device(k % devices), "DeviceHybrid"));
    return searches;
  }
  static parts::PartedSearch::Options options_of(const Parameters& parameters, std::uint32_t devices,
                                                 std::uint32_t searches) {
    const auto parts = static_cast<std::uint32_t>(parameters.unsigned_integer("parts", 0, 1u << 20));
    return {.partition = parts::partition_options(parameters),
            .parts = parts == 0 ? devices : parts,
            .least_part = parts == 0 ? least_part : 1,
            .room = room(parameters, devices, searches),
            .room_is_guessed = true};
  }

  const Team team_;
  Request request_;
  parts::PartedSearch search_;
};

const RegisterVariant<DeviceParts, Robust> registered{
    {.name = "DeviceParts",
     .summary = "the chain in parts on all devices, part after part where it is larger than their memory",
     .place = Place::device(),
     .parameters = {{"devices", "0", "how many, the first ones; 0: all"},
                    {"memory", "0", "MiB to take of each device; 0: what is free"},
                    {"parts", "0", "how many at least; 0: a part a device"},
                    {"searches", "4", "parts at a time on a device, where they take turns"},
                    {"group", "32", "consecutive spheres that stay together; by space an eighth of that"},
                    {"order", "measured", "parts in chain order or by space, or as measured"}},
     .unavailable = unavailable}};

}  // namespace
}  // namespace catena::cuda
