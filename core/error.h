#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>

#include "catena/core/export.h"

namespace catena {

/// Base of every error that a user can act on. The command line prints what() as one line and exits with 2.
class CATENA_API Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Input that cannot be used: a malformed file, an impossible chain, an unknown name or parameter.
class CATENA_API InputError : public Error {
 public:
  using Error::Error;
};

/// A strategy that cannot run here (no device, library not built in), or not on this input (a declared
/// limit).
class CATENA_API CapacityError : public Error {
 public:
  using Error::Error;
};

/// More pairs were found than the request allows, `where` it is named. Nothing is dropped in silence: `found`
/// is the true number.
class CATENA_API PairLimitExceeded : public Error {
 public:
  PairLimitExceeded(std::uint64_t found, std::uint64_t limit, const std::string& where = {})
      : Error((where.empty() ? "" : where + ": ") + "found " + std::to_string(found) +
              (found == 1 ? " colliding pair" : " colliding pairs") + ", more than the limit of " +
              std::to_string(limit) + "; ask for counts alone, or raise the limit"),
        found_(found),
        limit_(limit) {}
  std::uint64_t found() const noexcept { return found_; }
  std::uint64_t limit() const noexcept { return limit_; }

 private:
  std::uint64_t found_, limit_;
};

}  // namespace catena
