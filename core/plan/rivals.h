#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/export.h"
#include "catena/core/plan/trial_account.h"

namespace catena {

/// Who searches one chain after another the quickest: what a plan chose, or one of some rivals. A plan knows
/// kinds of chains, sizes and machines, and not these; where there are many searches, a few of them tell.
///
/// Now and then a rival takes some searches that follow one another. The first touches memory for the first
/// time and is no measure; whoever takes a tenth less than the leader took just before leads from then on. An
/// account bounds what is lost by those that take more, to some searches and a small share of all that come,
/// and each that lost is tried again ever more seldom. Measured times choose who searches, never the answer.
class CATENA_API Rivals {
 public:
  struct Contender {
    std::string variant;  ///< as SearchPlan::variant
    unsigned threads = 1;
    bool operator==(const Contender&) const = default;
  };
  static constexpr unsigned patience = 5;  ///< searches of the leader before the first trial
  static constexpr unsigned trial = 3;     ///< searches of one that is not far behind

  /// Of n spheres: nothing is known, and the planned one leads. To be called first. Where it throws, all is
  /// as it was.
  void begin(const Contender& planned, std::uint32_t n);
  /// Of as many spheres, for which another may be planned by now: who was found to lead leads on, and the
  /// planned one is tried before long.
  void go_on(const Contender& planned);
  /// None before the first begin.
  const std::optional<std::uint32_t>& spheres() const { return n_; }
  /// The leader has searched for a while without rivals, so that it is worth while to look for them.
  bool expected() const { return !joined_ && own_ >= patience; }
  /// None is tried while the leader takes less than worth_ms.
  void join(const std::vector<Contender>& rivals, double worth_ms);

  /// Another number whenever another is to search, or another is planned: all else is for who looks.
  std::uint64_t turn() const { return turn_; }
  /// Who is to do the next search.
  const Contender& next() const { return contenders_[tried_ != none ? tried_ : leader_].who; }
  const Contender& leader() const { return contenders_[leader_].who; }
  const Contender& planned() const { return contenders_[planned_].who; }
  /// Whether the leader took the planned one's place.
  bool replaced() const { return leader_ != planned_; }
  /// What the leader took, and the planned one or the last that lost, when they were compared last: "took 1
  /// ms where 2 were taken"; 0 where they never were.
  std::string told_ms() const;

  /// next() did a search, which took so many ms and is like those of before.
  void took(double ms);
  /// It cannot search this chain, and is asked no more; not the planned one, which leads where that did.
  void without(const Contender& who);
  /// Who lost since this was asked last, and will not be asked for long.
  std::optional<Contender> take_lost();

 private:
  static constexpr double share = 0.02, first = 4;  ///< of searches, lost by trials
  static constexpr std::size_t none = ~std::size_t{0};
  static constexpr std::uint64_t first_pause = 16;  ///< searches until who lost is tried again
  static constexpr std::size_t some = 3;            ///< searches of the leader that count
  void begin_trial();
  void end_trial(bool won);
  double least() const;

  struct Known {
    Contender who;
    unsigned lost_times = 0;  ///< since it led
    std::uint64_t due = 0;    ///< the search from which it may be tried
  };
  std::size_t place_of(const Contender& who);

  std::optional<std::uint32_t> n_;
  std::vector<Known> contenders_;
  bool joined_ = false;
  std::size_t planned_ = 0, leader_ = 0, tried_ = none, lost_ = none;
  std::array<double, some> recent_{};  ///< of the leader
  std::uint64_t turn_ = 0;
  std::uint64_t searches_ = 0, own_ = 0;  ///< in all; of the leader since the last trial
  unsigned step_ = 0;                     ///< of the trial
  double best_ms_ = 0;                    ///< of the trial
  double worth_ms_ = 0;
  std::pair<double, double> compared_ms_{};
  bool compared_ = false;  ///< who leads was found by a trial
  TrialAccount account_{share, first};
};

}  // namespace catena
