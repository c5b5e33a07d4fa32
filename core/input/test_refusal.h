#pragma once
#include <gtest/gtest.h>

#include <string>

#include "catena/core/error.h"
#include "catena/core/input/input.h"

namespace catena {

/// What is said against an input; "" where it opens.
inline std::string refusal(const std::string& spec, const InputOptions& options = {}) {
  try {
    open_input(spec, options);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

#define EXPECT_REFUSAL(part, ...) \
  EXPECT_NE(refusal(__VA_ARGS__).find(part), std::string::npos) << "got: " << refusal(__VA_ARGS__)

}  // namespace catena
