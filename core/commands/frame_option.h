#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/input/input.h"

namespace catena {

class OptionParser;

/// The --frame option of a command: one frame of an animated input, or all of them.
class FrameOption {
 public:
  /// Adds --frame to a subcommand; this object must outlive the parsing.
  void add_to(OptionParser& app);
  /// Throws InputError where one of several inputs has no such frame, before work on the first. As
  /// check_inputs.
  void check(const std::vector<std::string>& specs, const InputOptions& options) const;
  /// The frames [first, last) of this input. Throws InputError when the value is no frame of it.
  std::pair<std::uint32_t, std::uint32_t> of(const Input& input) const;
  /// The same of an input of this name that has so many.
  std::pair<std::uint32_t, std::uint32_t> of(const std::string& name, std::uint32_t frames) const;

 private:
  std::string text_ = "0";
};

}  // namespace catena
