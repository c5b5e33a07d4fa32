#include <algorithm>
#include <span>
#include <stdexcept>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/parts/group_boxes.h"
#include "catena/core/strategy/registry.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_answer.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/part_on_device.h"
#include "catena/cuda/part_tables.cuh"
#include "catena/cuda/staging.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {
namespace {

class PartOnDevice final : public parts::PartSearch {
 public:
  PartOnDevice(Place place, const std::string& variant) : place_(place), name_(variant) {
    require_device(place);
    const DeviceScope scope(place_);
    memory();
  }
  ~PartOnDevice() override {
    const DeviceScope scope(place_);
    memory_.reset();
  }

  parts::LocalChain::Neighbours knows() const override { return parts::LocalChain::Neighbours::by_number; }
  void build(const Chain& whole, const parts::LocalChain& part, const Request& request,
             const parts::BoxesWanted& boxes) override {
    const DeviceScope scope(place_);
    built_ = false;
    timings_ = {};
    Memory& m = memory();
    chain_ = whole.view();
    chain_.size = part.size();
    chain_.strand_count =
        static_cast<std::uint32_t>(part.by_number() ? part.runs().size() : part.pieces().size());
    chain_.extra_count = static_cast<std::uint32_t>(2 * part.extra().size());
    chain_.topology = 0;
    Sphere* const there = m.spheres.reserve(part.size(), m.stream);
    Staging::Seen enclose;
    if (boxes.boxes != nullptr)
      enclose = [&](std::size_t first, std::size_t count, const void* spheres) {
        parts::enclose_groups({static_cast<const Sphere*>(spheres), count}, boxes.group,
                              boxes.boxes + (first - part.runs()[0].begin) / boxes.group);
      };
    m.staging.to_device(there, whole.spheres().data(), sizeof(Sphere), part.runs(), m.stream, enclose,
                        boxes.group);
    chain_.spheres = there;
    chain_.exclusion = m.tables.upload(whole, part, m.staging, m.stream);
    do {
      timings_.build_ms = m.timer.time(
          m.stream, [&] { m.search->enqueue_build(chain_, request, static_cast<cudaStream_t>(m.stream)); });
    } while (m.timer.is_start(timings_.build_ms, timings_.start_ms));
    built_ = true;
  }

  void find(const parts::LocalChain& part, const Request& request, Collisions& result,
            std::span<std::uint32_t> count) override {
    if (!built_ || part.size() != chain_.size) throw std::logic_error("find: not the part of the last build");
    const DeviceScope scope(place_);
    Memory& m = *memory_;
    const DeviceAnswer::CountsTo counts{part.own().begin, count};
    const auto times = m.answer.fetch(
        chain_.size, request, result,
        [&](const ResidentAnswer& answer, StreamHandle stream) {
          m.search->enqueue_find(chain_, request, answer, stream);
        },
        [&](const ResidentState& seen) { m.search->mend(seen); }, m.stream, m.staging, &counts);
    timings_.find_ms = times.work_ms;
    timings_.transfer_ms = times.transfer_ms;
    timings_.start_ms = times.start_ms;
  }

  void drop() override {
    const DeviceScope scope(place_);
    built_ = false;
    memory_.reset();
  }

  Timings timings() const override { return timings_; }

 private:
  /// All that is of a device.
  struct Memory {
    explicit Memory(const std::string& name)
        : variant(StrategyRegistry::instance().make(name)), search(variant->resident()) {}
    Stream stream;
    EventTimer timer;
    Staging staging;
    DeviceBuffer<Sphere> spheres;
    PartTables tables;
    DeviceAnswer answer;
    std::unique_ptr<Variant> variant;
    ResidentSearch* search;
  };

  /// Taken where there is none: a build that finds no room for it may come again.
  Memory& memory() {
    if (!memory_)
      memory_ = std::make_unique<Memory>(name_ + "(device=" + std::to_string(place_.index) + ")");
    return *memory_;
  }

  const Place place_;
  const std::string name_;
  std::unique_ptr<Memory> memory_;
  ChainView chain_{};  ///< the part that was built last, on the device
  bool built_ = false;
  Timings timings_;
};

}  // namespace

std::unique_ptr<parts::PartSearch> make_part_on_device(Place place, const std::string& variant) {
  return std::make_unique<PartOnDevice>(place, variant);
}

}  // namespace catena::cuda
