#include "catena/bench/timing/trial.h"

#include <fmt/format.h>

#include <algorithm>

#include "catena/core/error.h"
#include "catena/reference/compare.h"

namespace catena::bench {

std::string name_of(Stage stage) {
  return stage == Stage::build ? "build" : stage == Stage::find ? "find" : "whole";
}

const std::string& Trial::prepare() {
  if (variant_ || !reason_.empty()) return reason_;
  try {
    work_ = workload(spec_);
    variant_ = StrategyRegistry::instance().make(info_.name);
    variant_->build(work_->chains.front());
    if (!compared_)
      compare();
    else
      variant_->find(work_->chains.front(), {}, found_);
    if (flush_cache_ && info_.on_device) mover_ = StrategyRegistry::instance().make_mover();
  } catch (const Error& refused) {
    reason_ = refused.what();
  }
  if (!reason_.empty()) release();
  next_ = 0;
  return reason_;
}

void Trial::compare() {
  for (std::size_t k = 0; k < work_->chains.size(); ++k) {
    const Chain& chain = work_->chains[k];
    if (k > 0) variant_->update(chain);
    variant_->find(chain, {}, found_);
    const auto comparison = reference::compare(chain, work_->exact[k], found_);
    pairs_ = std::max(pairs_, found_.pair_count);
    missing_ += comparison.missing;
    invented_ += comparison.invented;
    if (comparison.right() || (info_.arithmetic != Robust::name && comparison.well_formed())) continue;
    reason_ =
        fmt::format("wrong answer: {} pairs missing, {} invented", comparison.missing, comparison.invented);
    return;
  }
  compared_ = true;
}

void Trial::release() {
  variant_.reset();
  mover_.reset();
  work_.reset();
  found_ = {};
}

double Trial::run(Stage stage) {
  const Chain& chain = work_->chains[next_];
  next_ = (next_ + 1) % work_->chains.size();
  if (mover_) mover_->flush_cache();
  if (stage == Stage::find && work_->chains.size() > 1)
    variant_->update(chain);  // another chain than last time
  const Stopwatch wall;
  if (stage != Stage::find) variant_->update(chain);
  if (stage != Stage::build) variant_->find(chain, {}, found_);
  if (stage == Stage::whole) return wall.ms();
  const Timings timings = variant_->timings();
  return stage == Stage::build ? timings.build_ms : timings.find_ms;
}

}  // namespace catena::bench
