#include "catena/bench/timing/cases.h"

#include <fmt/format.h>

#include <charconv>
#include <regex>

#include "catena/core/error.h"

namespace catena::bench {
namespace {

constexpr std::uint32_t most_all_pairs_device = 150'000;

/// The N of SCENE/n:N.
std::uint64_t size_in(const std::string& label) {
  std::uint64_t n = 0;
  const auto at = label.rfind("/n:") + 3;
  std::from_chars(label.data() + at, label.data() + label.size(), n);
  return n;
}

bool worth_measuring(const VariantInfo& variant, std::uint64_t n, Stage stage, std::uint32_t most_all_pairs) {
  if (variant.unavailable) return false;
  if (!variant.all_pairs) return true;
  return stage != Stage::build && n <= (variant.on_device ? most_all_pairs_device : most_all_pairs);
}

}  // namespace

std::string Case::name() const {
  return fmt::format("{}/{}/{}", label_of(spec), variant.name, name_of(stage));
}

std::vector<Case> cases(const std::vector<WorkloadSpec>& inputs, const std::vector<VariantInfo>& variants,
                        std::uint32_t most_all_pairs) {
  std::vector<Case> all;
  for (const auto& input : inputs) {
    const std::uint64_t n = size_in(label_of(input));
    for (const auto& variant : variants)
      for (const Stage stage : {Stage::build, Stage::find, Stage::whole})
        if (worth_measuring(variant, n, stage, most_all_pairs)) all.push_back({input, variant, stage});
  }
  return all;
}

std::vector<Case> filtered(std::vector<Case> all, const std::string& filter) {
  if (filter.empty()) return all;
  const bool without = filter.front() == '-';
  std::regex pattern;
  try {
    pattern.assign(filter.substr(without ? 1 : 0), std::regex::extended | std::regex::optimize);
  } catch (const std::regex_error&) {
    throw InputError(fmt::format("--benchmark_filter {}: this is no regular expression", filter));
  }
  std::erase_if(all, [&](const Case& c) { return std::regex_search(c.name(), pattern) == without; });
  return all;
}

}  // namespace catena::bench
