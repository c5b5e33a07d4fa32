#pragma once
#include <string>
#include <vector>

#include "catena/core/strategy/request.h"

namespace catena {

class OptionParser;

/// What is asked of a search: --counts-only, --any, neither (pairs).
class WantOptions {
 public:
  void add_to(OptionParser& app);  ///< this object must outlive the parsing
  /// Throws InputError when both are given.
  Request::Want want() const;

 private:
  bool counts_only_ = false, any_only_ = false;
};

/// --no-omit NAME, any number of times.
class NoOmitOption {
 public:
  void add_to(OptionParser& app);  ///< this object must outlive the parsing
  bool given() const { return !names_.empty(); }
  const std::vector<std::string>& names() const { return names_; }
  /// The variant auto with these omissions switched off.
  std::string variant() const;
  /// The same, whose plan also tells how long choosing took.
  std::string variant_that_times_planning() const;

 private:
  std::vector<std::string> names_;
};

}  // namespace catena
