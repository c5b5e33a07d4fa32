#include "catena/reports/faults.h"

#include <algorithm>

#include "catena/core/notice.h"

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
  notice("catena report", what);
}

const std::vector<std::string>& noted_faults() { return faults(); }

}  // namespace catena::reports
