#include "catena/reports/section.h"

#include <algorithm>

namespace catena::reports {
namespace {

std::vector<Section>& registered() {
  static std::vector<Section> all;
  return all;
}

}  // namespace

RegisterSection::RegisterSection(std::string name,
                                 std::function<nlohmann::ordered_json(const Profile&)> measure) {
  registered().push_back({std::move(name), std::move(measure)});
}

std::vector<Section> sections() {
  auto sorted = registered();
  std::ranges::sort(sorted, {}, &Section::name);
  return sorted;
}

}  // namespace catena::reports
