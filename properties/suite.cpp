#include "catena/properties/suite.h"

#include <fmt/format.h>

#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/thrown.h"

namespace catena::properties {
namespace {

constexpr std::uint32_t longest_for_all_pairs = 600;

}  // namespace

Suite::Suite(std::vector<Subject> subjects) {
  for (Subject& subject : subjects) {
    auto variant = blaming(subject.info.name, subject.make);
    runners_.push_back({std::move(subject), std::move(variant)});
  }
  for (auto& property : PropertyRegistry::instance().make_all())
    (property->every_chain() ? always_ : in_turn_).push_back(std::move(property));
}

std::vector<std::string> Suite::variants() const {
  std::vector<std::string> names;
  for (const Runner& runner : runners_) names.push_back(runner.subject.info.name);
  return names;
}

Subject Suite::subject(const std::string& variant) const {
  for (const Runner& runner : runners_)
    if (runner.subject.info.name == variant) return runner.subject;
  throw std::logic_error("not a variant of this suite: " + variant);
}

std::optional<Finding> Suite::check(const Case& test) {
  ++tally_.chains;
  for (Runner& runner : runners_)
    for (auto* group : {&always_, &in_turn_})
      for (auto& property : *group)
        if (auto finding = check(*property, runner, test)) return finding;
  return std::nullopt;
}

std::vector<Finding> Suite::check_all(const Case& test) {
  ++tally_.chains;
  std::vector<Finding> findings;
  for (Runner& runner : runners_)
    for (auto* group : {&always_, &in_turn_})
      for (auto& property : *group)
        if (auto finding = check(*property, runner, test)) findings.push_back(std::move(*finding));
  return findings;
}

std::optional<Finding> Suite::check_some(const Case& test, std::uint64_t turn) {
  ++tally_.chains;
  for (Runner& runner : runners_) {
    if (!runner.subject.exact() && turn % 4 != 0) continue;
    for (auto& property : always_)
      if (auto finding = check(*property, runner, test)) return finding;
    if (in_turn_.empty()) continue;
    if (auto finding = check(*in_turn_[turn % in_turn_.size()], runner, test)) return finding;
  }
  return std::nullopt;
}

std::optional<Finding> Suite::check_always(const Case& test) {
  ++tally_.chains;
  for (Runner& runner : runners_)
    if (runner.subject.exact())
      for (auto& property : always_)
        if (auto finding = check(*property, runner, test)) return finding;
  return std::nullopt;
}

std::optional<Finding> Suite::check(Property& property, Runner& runner, const Case& test) {
  const Subject& subject = runner.subject;
  if (subject.info.all_pairs && test.chain.size() > longest_for_all_pairs) return std::nullopt;
  if (!property.applies_to(subject)) return std::nullopt;
  ++tally_.checks;
  if (watch_) watch_(subject, property);
  try {
    auto what = failure(property, subject, *runner.variant, test);
    if (!what) return std::nullopt;
    return Finding{subject.info.name, property.name(), std::move(*what)};
  } catch (const CapacityError&) {
    ++tally_.refusals;
    return std::nullopt;
  }
}

bool Suite::repeats(const Finding& finding, const Chain& chain) const {
  for (const Runner& runner : runners_) {
    if (runner.subject.info.name != finding.variant) continue;
    for (const auto* group : {&always_, &in_turn_})
      for (const auto& property : *group)
        if (property->name() == finding.property) try {
            const auto fresh = runner.subject.make();
            return failure(*property, runner.subject, *fresh, Case::of(chain)).has_value();
          } catch (const CapacityError&) {
            return false;
          }
  }
  return false;
}

std::optional<std::string> Suite::failure(Property& property, const Subject& subject, Variant& variant,
                                          const Case& test) {
  try {
    return property.check(subject, variant, test);
  } catch (const CapacityError&) {
    throw;
  } catch (...) {
    return "threw: " + thrown_words();
  }
}

}  // namespace catena::properties
