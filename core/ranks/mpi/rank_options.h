#pragma once
#include <string>

#include "catena/core/commands/input_options.h"
#include "catena/core/commands/plan_options.h"
#include "catena/core/ranks/rank_search.h"

namespace catena::ranks {

/// What a user may say of a search by ranks, whatever the command.
class SearchOptions {
 public:
  void add_to(OptionParser& app);        ///< this object must outlive the parsing
  void add_input_to(OptionParser& app);  ///< also what may be said of an input, for a command that has one

  /// Throws InputError for an unknown variant or order.
  RankOptions of(Request request) const;
  const std::string& variant() const { return variant_; }
  const InputOptions& input() const { return input_; }

 private:
  std::string variant_ = "auto", order_ = parts::order_names().front();
  InputOptions input_{.takes_box = true};
};

}  // namespace catena::ranks
