#include "catena/bench/timing/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/thrown.h"
#include "catena/reference/compare.h"

namespace catena::bench {

std::string name_of(Stage stage) {
  switch (stage) {
    case Stage::build:
      return "build";
    case Stage::update:
      return "update";
    case Stage::find:
      return "find";
    case Stage::whole:
      return "whole";
    case Stage::resident:
      return "resident";
  }
  throw std::logic_error("no stage");
}

namespace {

/// The device that the variant's stages are on.
Place place_of(const VariantInfo& info) {
  return *std::ranges::find_if(info.places, [](const Place& place) { return place.on_device(); });
}

}  // namespace

const std::string& Trial::prepare() {
  if (variant_ || !reason_.empty()) return reason_;
  try {
    work_ = workload(spec_);
    blaming(info_.name, [this] { warm_up(); });
  } catch (const Error& refused) {
    give_up(refused);
  }
  if (!reason_.empty()) release();
  next_ = 0;
  return reason_;
}

void Trial::warm_up() {
  if (info_.on_device()) device_ = StrategyRegistry::instance().make_device(place_of(info_));
  moving_.clear();
  if (work_->beside) moving_.push_back(&*work_->beside);
  for (const Chain& chain : work_->chains) moving_.push_back(&chain);
  variant_ = work_->make(info_.name, periodic_);
  variant_->build(work_->chains.front());
  standing_ = &work_->chains.front();
  if (!compared_)
    compare();
  else
    variant_->find(*standing_, {}, found_);
}

void Trial::compare() {
  for (std::size_t k = 0; k < work_->chains.size(); ++k) {
    stand_on(work_->chains[k]);
    if (!answers(k)) return;
  }
  if (work_->beside && !info_.all_pairs) {
    missing_ = invented_ = 0;  // counted again
    stand_on(*work_->beside);
    stand_on(work_->chains.front());
    if (!answers(0)) return;
  }
  if (variant_->resident() != nullptr) {
    missing_ = invented_ = 0;  // counted again
    search_resident(work_->chains.front());
    if (!is_answer(0)) return;
    stand_on(work_->chains.front());
  }
  compared_ = true;
}

/// Build and find as one graph on a chain that is on the device already; milliseconds by its clock.
double Trial::search_resident(const Chain& chain) {
  ResidentSearch& search = *variant_->resident();
  standing_ = nullptr;  // the variant's own chain is gone
  const ChainView resident = device_->to_device(chain.view());
  return device_
      ->answer_by_graph(
          chain.size(), {}, found_,
          [&](const ResidentAnswer& answer, StreamHandle stream) {
            search.enqueue_build(resident, {}, stream);
            search.enqueue_find(resident, {}, answer, stream);
          },
          [&](const ResidentState& seen) { search.mend(seen); },
          [&] {
            if (flush_cache_) device_->flush_cache();
          })
      .work_ms;
}

/// Finds on the chain that stands, and says whether the answer may be timed; if not, the reason is set.
bool Trial::answers(std::size_t k) {
  variant_->find(*standing_, {}, found_);
  return is_answer(k);
}

bool Trial::is_answer(std::size_t k) {
  const auto comparison = reference::compare(work_->chains[k], work_->exact[k], found_);
  pairs_ = std::max(pairs_, found_.pair_count);
  missing_ += comparison.missing;
  invented_ += comparison.invented;
  if (comparison.right() || (!info_.exact && comparison.well_formed())) return true;
  at_fault_ = true;
  reason_ =
      fmt::format("wrong answer: {} pairs missing, {} invented", comparison.missing, comparison.invented);
  return false;
}

void Trial::go_to_box_of(const Chain& chain) {
  if (periodic_ != nullptr) periodic_->set_box(*work_->box_of(chain));
}

void Trial::stand_on(const Chain& chain) {
  if (standing_ == &chain) return;
  go_to_box_of(chain);
  updated_ = standing_ != nullptr;
  updated_ ? variant_->update(chain) : variant_->build(chain);
  standing_ = &chain;
}

void Trial::release() {
  variant_.reset();
  periodic_ = nullptr;
  device_.reset();
  work_.reset();
  standing_ = nullptr;
  found_ = {};
}

double Trial::run(Stage stage) {
  if (stage == Stage::update && moving_.size() < 2) throw std::logic_error("update: the input does not move");
  try {
    return blaming(info_.name, [&] { return run_now(stage); });
  } catch (const Error& thrown) {
    give_up(thrown);
    release();
    throw;
  }
}

void Trial::give_up(const Error& because) {
  reason_ = because.what();
  at_fault_ = dynamic_cast<const VariantThrew*>(&because) != nullptr;
}

double Trial::run_now(Stage stage) {
  if (stage == Stage::update) return run_update();
  const Chain& chain = work_->chains[next_];
  next_ = (next_ + 1) % work_->chains.size();
  if (stage == Stage::resident) return search_resident(chain);
  // One that keeps what it found of a frame would answer the next question about it from memory.
  if (stage == Stage::find && work_->chains.size() == 1 && updated_) standing_ = nullptr;
  if (stage == Stage::find) stand_on(chain);
  if (flush_cache_ && device_) device_->flush_cache();
  go_to_box_of(chain);
  const Stopwatch wall;
  if (stage != Stage::find) variant_->build(chain), updated_ = false;
  if (stage != Stage::build) variant_->find(chain, {}, found_);
  const double whole_ms = wall.ms();
  standing_ = &chain;
  if (stage == Stage::whole) return whole_ms;
  const Timings timings = variant_->timings();
  const double own_ms = stage == Stage::build ? timings.build_ms : timings.find_ms;
  // Of few spheres auto builds nothing, and says 0; a sample of zeros would never be long enough.
  return own_ms > 0 ? own_ms : whole_ms;
}

/// From the frame that stands to the next. The first frame is no neighbour of the last and moves from the
/// second.
double Trial::run_update() {
  const std::size_t at = std::ranges::find(moving_, standing_) - moving_.begin();
  const std::size_t next = (at + 1) % moving_.size();
  stand_on(*moving_[next == 0 ? 1 : next - 1]);
  if (flush_cache_ && device_) device_->flush_cache();
  stand_on(*moving_[next]);
  return variant_->timings().build_ms;
}

}  // namespace catena::bench
