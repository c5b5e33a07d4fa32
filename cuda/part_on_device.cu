#include <algorithm>
#include <stdexcept>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/parts/group_boxes.h"
#include "catena/core/strategy/registry.h"
#include "catena/cuda/device.h"
#include "catena/cuda/device_answer.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/part_on_device.h"
#include "catena/cuda/staging.h"
#include "catena/cuda/stream.h"

namespace catena::cuda {
namespace {

/// The tables by which a device knows neighbours in a part.
class PartTables {
 public:
  /// On their way in the stream when this returns.
  ExclusionView upload(const Chain& whole, const parts::LocalChain& part, Staging& staging,
                       cudaStream_t stream) {
    ExclusionView rule = whole.view().exclusion;
    const ExclusionView of_whole = rule;
    rule.one_open_strand = part.is_one_open_strand();
    rule.strand_of = rule.strand_first = rule.extra_row = rule.extra = nullptr;
    rule.strand_closed = nullptr;
    rule.arc = rule.loop_length = nullptr;
    if (rule.rule == Exclusion::Rule::arc_window) {
      double* const there = arc_.reserve(part.size(), stream);
      staging.to_device(there, of_whole.arc, sizeof(double), part.runs(), stream);
      rule.arc = there;
    }
    if (rule.one_open_strand) return rule;
    upload_strands(of_whole, part, rule, staging, stream);
    if (!part.extra().empty()) upload_extra(part, rule, staging, stream);
    CATENA_CUDA(cudaStreamSynchronize(stream));  // before the host's tables are written again
    return rule;
  }

 private:
  void upload_strands(const ExclusionView& of_whole, const parts::LocalChain& part, ExclusionView& rule,
                      Staging& staging, cudaStream_t stream) {
    host_strand_of_.resize(part.size());
    host_first_.assign(1, 0);
    host_closed_.clear();
    host_loop_.clear();
    for (const parts::LocalChain::Piece& piece : part.pieces()) {
      const auto strand = static_cast<std::uint32_t>(host_closed_.size());
      std::fill_n(host_strand_of_.begin() + piece.begin, piece.size, strand);
      host_first_.push_back(piece.begin + piece.size);
      host_closed_.push_back(piece.closed);
      if (rule.rule == Exclusion::Rule::arc_window) host_loop_.push_back(of_whole.loop_length[piece.strand]);
    }
    rule.strand_of = staging.upload(strand_of_, host_strand_of_.data(), host_strand_of_.size(), stream);
    rule.strand_first = staging.upload(first_, host_first_.data(), host_first_.size(), stream);
    rule.strand_closed = staging.upload(closed_, host_closed_.data(), host_closed_.size(), stream);
    if (!host_loop_.empty())
      rule.loop_length = staging.upload(loop_, host_loop_.data(), host_loop_.size(), stream);
  }

  /// Partners of each sphere, both ways, as Topology has them; few spheres have any.
  void upload_extra(const parts::LocalChain& part, ExclusionView& rule, Staging& staging,
                    cudaStream_t stream) {
    host_ends_.assign(part.extra().begin(), part.extra().end());
    for (const Pair& pair : part.extra()) host_ends_.push_back({pair.j, pair.i});
    std::sort(host_ends_.begin(), host_ends_.end(), [](const Pair& a, const Pair& b) { return a.i < b.i; });
    host_row_.resize(part.size() + std::size_t{1});
    host_extra_.clear();
    auto row = host_row_.begin();
    for (const Pair& end : host_ends_) {  // up to its sphere all rows begin here
      const auto to = host_row_.begin() + end.i + 1;
      if (row < to) std::fill(row, to, static_cast<std::uint32_t>(host_extra_.size())), row = to;
      host_extra_.push_back(end.j);
    }
    std::fill(row, host_row_.end(), static_cast<std::uint32_t>(host_extra_.size()));
    rule.extra_row = staging.upload(row_, host_row_.data(), host_row_.size(), stream);
    rule.extra = staging.upload(extra_, host_extra_.data(), host_extra_.size(), stream);
  }

  LargeVector<std::uint32_t> host_strand_of_, host_row_;
  std::vector<std::uint32_t> host_first_, host_extra_;
  std::vector<Pair> host_ends_;
  std::vector<std::uint8_t> host_closed_;
  std::vector<double> host_loop_;
  DeviceBuffer<std::uint32_t> strand_of_, first_, row_, extra_;
  DeviceBuffer<std::uint8_t> closed_;
  DeviceBuffer<double> arc_, loop_;
};

class PartOnDevice final : public parts::PartSearch {
 public:
  PartOnDevice(Place place, const std::string& variant) : place_(place), name_(variant) {
    require_device(place);
    drop();
  }
  ~PartOnDevice() override {
    const DeviceScope scope(place_);
    memory_.reset();
  }

  void build(const Chain& whole, const parts::LocalChain& part, const Request& request,
             const parts::BoxesWanted& boxes) override {
    const DeviceScope scope(place_);
    built_ = false;
    timings_ = {};
    Memory& m = *memory_;
    chain_ = whole.view();
    chain_.size = part.size();
    chain_.strand_count = static_cast<std::uint32_t>(part.pieces().size());
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
    timings_.start_ms += times.start_ms;
  }

  void drop() override {
    const DeviceScope scope(place_);
    built_ = false;
    memory_.reset();
    memory_ = std::make_unique<Memory>(name_ + "(device=" + std::to_string(place_.index) + ")");
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
