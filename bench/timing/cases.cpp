#include "catena/bench/timing/cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "catena/core/commands/input_options.h"
#include "catena/core/error.h"

namespace catena::bench {
namespace {

constexpr std::uint32_t most_all_pairs_device = 150'000;

bool worth_measuring(const WorkloadFacts& facts, const VariantInfo& variant, Stage stage,
                     std::uint32_t most_all_pairs) {
  if (variant.unavailable || (stage == Stage::update && facts.frames < 2)) return false;
  if (stage == Stage::resident && facts.in_box) return false;  // the images are made on the host
  if (stage == Stage::resident && !variant.resident) return false;
  if (!variant.all_pairs) return true;
  return stage != Stage::build && stage != Stage::update &&
         facts.n <= (variant.on_device() ? most_all_pairs_device : most_all_pairs);
}

/// A run file is JSON, and so is what an interrupted run left: with other bytes in it a name would name
/// nothing.
void require_utf8(const std::string& name) {
  try {
    nlohmann::json(name).dump();
  } catch (const nlohmann::json::type_error&) {
    throw InputError(fmt::format(
        "{}: this name is not UTF-8, which a run file needs; rename it, or give a link to it", name));
  }
}

}  // namespace

std::string Case::name() const { return fmt::format("{}/{}/{}", facts.label, variant.name, name_of(stage)); }

std::vector<Case> cases(const std::vector<WorkloadSpec>& inputs, const std::vector<VariantInfo>& variants,
                        std::uint32_t most_all_pairs) {
  std::vector<Case> all;
  require_names_apart(inputs);
  for (const auto& input : inputs) {
    require_utf8(input.input);
    std::ranges::for_each(arguments_of(input.options), require_utf8);
    const WorkloadFacts facts = facts_of(input);
    for (const auto& variant : variants)
      for (const Stage stage : {Stage::build, Stage::update, Stage::find, Stage::whole, Stage::resident})
        if (worth_measuring(facts, variant, stage, most_all_pairs))
          all.push_back({input, facts, variant, stage});
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
