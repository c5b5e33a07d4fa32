#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "catena/core/parameters/whole_number.h"

namespace catena {

/// For an option's transform(): a whole number from `least`, as 1000000 or 1e6. By itself CLI11 takes -5 for
/// 2^64 - 5, and 010 for 8.
inline CLI::Validator whole_number_option(std::uint64_t least = 0) {
  return CLI::Validator(
      [least](std::string& text) {
        const auto number = whole_number(text);
        if (!number || *number < least) return fmt::format("{} is not a whole number from {}", text, least);
        text = std::to_string(*number);
        return std::string();
      },
      "");
}

}  // namespace catena
