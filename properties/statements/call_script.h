#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/strategy/keeps_answer.h"
#include "catena/properties/generators/dice.h"
#include "catena/properties/statements/shots.h"

namespace catena::properties {

/// What goes wrong in calls, and is the caller's or the machine's fault.
struct Troubles {
  bool any = false;     ///< chains are refused, sinks throw, a chain is asked about that was not built
  bool memory = false;  ///< there is too little of it, too; see FailingAllocations
};

/// One run of drawn calls on one variant, each answer held against the exact one. Where something went wrong
/// the next answer is right all the same, or the variant says that nothing is built.
class CallScript {
 public:
  CallScript(Variant& variant, const std::vector<Shot>& shots, std::uint64_t seed, Collisions (&reused)[2],
             Troubles troubles = {});

  /// What went wrong, with the calls up to there.
  std::optional<std::string> run();

 private:
  using Fault = std::optional<std::string>;
  static constexpr int calls = 24;
  struct SinkThrew {};
  struct CountedEdges;
  struct ThrowingSink;

  template <class... Args>
  void tell(fmt::format_string<Args...> format, Args&&... args) {
    told_ += (told_.empty() ? "" : ", ") + fmt::format(format, std::forward<Args>(args)...);
  }
  const Case& drawn_case() { return shots_[dice_.below(number_of_shots())].test; }
  std::uint32_t number_of_shots() const { return static_cast<std::uint32_t>(shots_.size()); }
  SphereRange some_of(const SphereRange& all, std::uint32_t n);
  std::uint32_t soon() { return dice_.below(1u << dice_.below(7)); }

  template <class Call>
  bool ends(const Call& call);
  Fault call();
  Fault prepare();
  Fault build();
  Fault update();
  Fault look();
  Fault look_at_nothing();
  Fault find();
  Fault find_with_evidence();
  template <class Search>
  Fault answer_of(const Case& test, const Request& request, bool kept, Collisions& found,
                  const Search& search);

  Variant& variant_;
  KeepsAnswer* const keeper_;
  const std::vector<Shot>& shots_;
  Dice dice_;
  Collisions (&reused_)[2];
  const Troubles troubles_;
  Request next_, prepared_;
  std::uint32_t last_ = 0;  ///< that build or update were given last
  bool built_ = false;      ///< it
  std::string told_;
};

/// Leaves a variant prepared for whatever other properties ask.
class PreparedForAll {
 public:
  explicit PreparedForAll(Variant& variant) : variant_(variant) {}
  ~PreparedForAll() { variant_.prepare({}); }
  PreparedForAll(const PreparedForAll&) = delete;
  PreparedForAll& operator=(const PreparedForAll&) = delete;

 private:
  Variant& variant_;
};

}  // namespace catena::properties
