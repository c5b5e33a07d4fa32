#include "catena/core/plan/rivals.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace catena {

void Rivals::begin(const Contender& planned, std::uint32_t n) {
  const std::uint64_t turn = turn_;
  std::vector<Known> alone{{planned}};  // before anything is forgotten: memory may end
  *this = {};
  turn_ = turn + 1;
  n_ = n;
  contenders_ = std::move(alone);
}

void Rivals::go_on(const Contender& planned) {
  if (planned == this->planned()) return;
  contenders_[planned_].due = searches_ + first_pause;
  planned_ = place_of(planned);
  contenders_[planned_].lost_times = 0, contenders_[planned_].due = searches_;
  if (!compared_) {
    leader_ = planned_;
    if (tried_ == leader_) tried_ = none;
    own_ = std::min<std::uint64_t>(own_, patience - some);
  }
  ++turn_;
}

void Rivals::join(const std::vector<Contender>& rivals, double worth_ms) {
  for (const Contender& rival : rivals) place_of(rival);
  worth_ms_ = worth_ms;
  joined_ = true;
}

/// Among the contenders; the last where it was none yet.
std::size_t Rivals::place_of(const Contender& who) {
  const auto at = std::ranges::find(contenders_, who, &Known::who);
  const auto place = static_cast<std::size_t>(at - contenders_.begin());
  if (at == contenders_.end()) contenders_.push_back({who});
  return place;
}

std::string Rivals::told_ms() const {
  return fmt::format("took {:.3g} ms where {:.3g} were taken", compared_ms_.first, compared_ms_.second);
}

double Rivals::least() const { return *std::ranges::min_element(recent_); }

void Rivals::begin_trial() {
  const auto sooner = [&](std::size_t k) { return std::pair{contenders_[k].lost_times, k != planned_}; };
  tried_ = none;
  for (std::size_t k = 0; k < contenders_.size(); ++k)
    if (k != leader_ && contenders_[k].due <= searches_ && (tried_ == none || sooner(k) < sooner(tried_)))
      tried_ = k;
  step_ = 0;
  ++turn_;
}

void Rivals::end_trial(bool won) {
  constexpr unsigned most_doublings = 6;
  constexpr double most_lost = 8;  // what takes longer says that something else ran meanwhile
  const double leader_ms = least();
  for (unsigned k = 0; k < step_; ++k) account_.used(best_ms_, leader_ms, most_lost / step_);
  compared_ = true;
  compared_ms_ = won ? std::pair{best_ms_, leader_ms} : std::pair{leader_ms, best_ms_};
  lost_ = won ? leader_ : tried_;
  if (won) leader_ = tried_, contenders_[leader_].lost_times = 0;
  Known& lost = contenders_[lost_];
  lost.due = searches_ + (first_pause << std::min(lost.lost_times++, most_doublings));
  tried_ = none, own_ = 0;
  ++turn_;
}

void Rivals::without(const Contender& who) {
  contenders_[place_of(who)].due = std::numeric_limits<std::uint64_t>::max();
  if (leader() == who) leader_ = planned_, compared_ms_ = {};
  tried_ = none, own_ = 0;
  ++turn_;
}

std::optional<Rivals::Contender> Rivals::take_lost() {
  const std::size_t lost = std::exchange(lost_, none);
  return lost != none ? std::optional(contenders_[lost].who) : std::nullopt;
}

void Rivals::took(double ms) {
  constexpr double far_behind = 2.5, behind = 1.5, much_less = 0.9;
  ++searches_;
  account_.search();
  if (tried_ == none) {
    recent_[own_++ % some] = ms;
    if (own_ >= patience && least() > worth_ms_ && account_.may_try()) begin_trial();
    return;
  }
  best_ms_ = step_ < 2 ? ms : std::min(best_ms_, ms);
  if (++step_ == trial) return end_trial(best_ms_ < much_less * least());
  if (best_ms_ > (step_ == 1 ? far_behind : behind) * least()) end_trial(false);
}

}  // namespace catena
