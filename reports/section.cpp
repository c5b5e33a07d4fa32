#include "catena/reports/section.h"

#include <algorithm>

namespace catena::reports {
namespace {

std::vector<Section>& registry() {
  static std::vector<Section> all;
  return all;
}

}  // namespace

RegisterSection::RegisterSection(std::string name,
                                 std::function<nlohmann::ordered_json(const Profile&)> measure) {
  registry().push_back({std::move(name), std::move(measure)});
}

std::vector<Section> sections() {
  auto sorted = registry();
  std::ranges::sort(sorted, {}, &Section::name);
  return sorted;
}

}  // namespace catena::reports
