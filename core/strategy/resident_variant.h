#pragma once
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/strategy/device.h"
#include "catena/core/strategy/upload.h"
#include "catena/core/strategy/variant.h"

namespace catena {

/// A variant that is one resident search: it derives from this and enqueues its build and, into an answer
/// that was cleared, its search; building, finding and fetching from the host are made of them here.
class ResidentVariant : public Variant, protected ResidentSearch {
 public:
  explicit ResidentVariant(std::unique_ptr<Device> device, Upload upload = {})
      : device_(std::move(device)), upload_(upload) {}

  void prepare(const Request& request) final { request_ = request; }

  void build(const Chain& chain) final { build_from(chain, {}); }

  /// Builds anew, of a chain that is there but for what moved.
  void update(const Chain& chain, const Moved& moved) final {
    build_from(chain, built_ == chain.size() ? moved : Moved());
  }

  void find(const Chain& chain, const Request& request, Collisions& result) final {
    check(chain);
    const auto fetch = [&] {
      return device_->answer(
          chain.size(), request, result,
          [&](const ResidentAnswer& answer, StreamHandle stream) {
            enqueue_search(chain_, request, answer, stream);
          },
          [&](const ResidentState& seen) { mend(seen); });
    };
    Device::Times times;
    try {
      times = fetch();
    } catch (const CapacityError&) {
      bool more = false;
      device_->run([&](StreamHandle stream) { more = give_back(stream) || more; });
      if (!more) throw;
      times = fetch();
    }
    timings_.find_ms = times.work_ms;
    timings_.transfer_ms = upload_ms_ + times.transfer_ms;
    timings_.start_ms = build_start_ms_ + times.start_ms;
  }

  Timings timings() const final { return timings_; }

  ResidentSearch* resident() final { return this; }

 protected:
  /// Throws std::logic_error unless it is of the size of that of the last build.
  void check(const Chain& chain) const {
    if (built_ != chain.size()) throw std::logic_error("find: not the chain of the last build");
  }
  /// These steps, and what was moved for the last build.
  Plan with_upload_told(Plan steps) const {
    for (Decision& step : upload_.told()) steps.push_back(std::move(step));
    return steps;
  }
  /// Whether the last build was on the host, and there was one.
  bool built() const { return built_.has_value(); }
  void run_on_device(const Device::Work& work) const { device_->run(work); }

  /// Like enqueue_build.
  virtual void enqueue_construction(const ChainView& chain, const Request& request, StreamHandle stream) = 0;
  /// Like enqueue_find, into an answer that was cleared.
  virtual void enqueue_search(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                              StreamHandle stream) = 0;
  /// Gives memory back that the construction took and the search does without; false when there is none.
  virtual bool give_back(StreamHandle) { return false; }

 private:
  void build_from(const Chain& chain, const Moved& moved) {
    built_.reset();
    timings_ = {};
    const Stopwatch watch;
    chain_ = upload_.run(*device_, chain.view(), moved);
    upload_ms_ = watch.ms();
    const auto times = device_->run([&](StreamHandle stream) { enqueue_build(chain_, request_, stream); });
    timings_.build_ms = times.work_ms;
    timings_.transfer_ms = upload_ms_;
    timings_.start_ms = build_start_ms_ = times.start_ms;
    built_ = chain.size();
  }
  void enqueue_build(const ChainView& chain, const Request& request, StreamHandle stream) final {
    built_.reset();  // this object's own chain is no longer the one that was built
    enqueue_construction(chain, request, stream);
  }
  void enqueue_find(const ChainView& chain, const Request& request, const ResidentAnswer& answer,
                    StreamHandle stream) final {
    device_->clear(answer, chain.size, stream);
    enqueue_search(chain, request, answer, stream);
  }

  std::unique_ptr<Device> device_;
  Upload upload_;
  Request request_;
  std::optional<std::uint32_t> built_;
  ChainView chain_{};
  Timings timings_;
  double upload_ms_ = 0, build_start_ms_ = 0;
};

}  // namespace catena
