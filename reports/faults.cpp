#include "catena/reports/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace catena::reports {
namespace {

std::vector<std::string>& faults() {
  static std::vector<std::string> all;
  return all;
}

}  // namespace

void note_fault(const std::string& what) {
  if (std::ranges::find(faults(), what) != faults().end()) return;
  faults().push_back(what);
  fmt::print(stderr, "catena report: {}\n", what);
}

const std::vector<std::string>& noted_faults() { return faults(); }

}  // namespace catena::reports
