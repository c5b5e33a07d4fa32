#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "catena/bench/timing/workload.h"
#include "catena/core/error.h"
#include "catena/core/strategy/registry.h"

namespace catena::bench {

enum class Stage {
  build,    ///< build(), as the variant times it (CUDA events on a device), or by wall time where it says 0;
            ///< in a box with the images that it takes
  update,   ///< update(), likewise, from one frame of a moving input to the next
  find,     ///< find(), likewise
  whole,    ///< wall time around build and find, with every transfer
  resident  ///< build and find as one graph of a chain that is on the device, the answer left there
};
std::string name_of(Stage stage);

/// One variant on one workload: made anew, warmed up and held against the exact reference, then timed.
class Trial {
 public:
  /// `flush_cache` empties the device's cache before every run of a device variant.
  Trial(WorkloadSpec spec, VariantInfo variant, bool flush_cache = false)
      : spec_(std::move(spec)), info_(std::move(variant)), flush_cache_(flush_cache) {}

  /// Makes the variant and runs it once; the first time on every chain, each compared with the reference, and
  /// of a moving input also after an update. Returns why there is nothing to time: it refuses the input, or
  /// throws, or its answer is wrong and its arithmetic does not excuse that. Empty when it may be timed.
  /// Nothing is done when it is ready already.
  const std::string& prepare();
  /// Gives the variant's memory back; what was compared is kept.
  void release();

  /// Milliseconds of one run of a stage on the next chain of the workload. Only when prepare() gave no
  /// reason, and an update only of an input that moves. Throws VariantThrew, or an Error of the variant, and
  /// prepare() gives it as its reason from then on.
  double run(Stage stage);

  /// The reason that prepare() gives is the variant's fault, not a refusal: it threw, or its answer is wrong.
  bool at_fault() const { return at_fault_; }
  const std::string& reason() const { return reason_; }  ///< that prepare() gave last

  std::uint64_t pairs() const { return pairs_; }        ///< found, the most of any chain
  std::uint64_t missing() const { return missing_; }    ///< over all chains
  std::uint64_t invented() const { return invented_; }  ///< over all chains
  double transfer_ms() const { return variant_ ? variant_->timings().transfer_ms : 0; }  ///< of the last run
  const WorkloadSpec& spec() const { return spec_; }
  const VariantInfo& info() const { return info_; }

 private:
  void warm_up();
  void give_up(const Error& because);
  void compare();
  bool answers(std::size_t k);
  bool is_answer(std::size_t k);
  double run_now(Stage stage);
  double search_resident(const Chain& chain);
  double run_update();
  void stand_on(const Chain& chain);
  void go_to_box_of(const Chain& chain);

  WorkloadSpec spec_;
  VariantInfo info_;
  bool flush_cache_, compared_ = false, at_fault_ = false;
  std::string reason_;
  std::shared_ptr<const Workload> work_;
  std::unique_ptr<Variant> variant_;
  Periodic* periodic_ = nullptr;  // the variant, where a box repeats space
  std::unique_ptr<Device> device_;
  Collisions found_;
  std::size_t next_ = 0;              // of the chains
  std::vector<const Chain*> moving_;  // the frames that an update goes through, each beside the one before it
  const Chain* standing_ = nullptr;   // of the last build or update
  bool updated_ = false;              // it was an update
  std::uint64_t pairs_ = 0, missing_ = 0, invented_ = 0;
};

}  // namespace catena::bench
