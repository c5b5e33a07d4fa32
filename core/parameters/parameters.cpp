#include "catena/core/parameters/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/parameters/settings.h"
#include "catena/core/parameters/whole_number.h"

namespace catena {
namespace {

std::string unknown(const std::string& owner, const std::string& key,
                    const std::vector<ParameterInfo>& declared) {
  if (declared.empty()) return fmt::format("{} takes no parameters, got '{}'", owner, key);
  std::vector<std::string> known;
  for (const ParameterInfo& p : declared) known.push_back(p.name);
  return fmt::format("{} has no parameter '{}'; it has: {}{}", owner, key, fmt::join(known, ", "),
                     did_you_mean(key, known));
}

}  // namespace

Parameters::Parameters(std::string owner, const std::vector<ParameterInfo>& declared, std::string_view text)
    : owner_(std::move(owner)) {
  values_.reserve(declared.size());
  for (const auto& p : declared) values_.push_back({p.name, p.default_value});
  for (auto& [key, text_of_it] : parse_settings(owner_, text)) {
    const auto found = std::ranges::find(values_, key, &Value::key);
    if (found == values_.end()) throw InputError(unknown(owner_, key, declared));
    if (found->given) throw InputError(fmt::format("{}: '{}' is given twice", owner_, key));
    found->text = std::move(text_of_it), found->given = true;
  }
}

bool Parameters::given(std::string_view key) const {
  const auto found = std::ranges::find(values_, key, &Value::key);
  return found != values_.end() && found->given;
}

const std::string& Parameters::value(std::string_view key) const {
  const auto found = std::ranges::find(values_, key, &Value::key);
  if (found == values_.end())
    throw std::logic_error(fmt::format("{} reads the undeclared parameter {}", owner_, key));
  return found->text;
}

void Parameters::refuse(std::string_view key, const std::string& wanted) const {
  throw InputError(fmt::format("{}: {}={} must be {}", owner_, key, value(key), wanted));
}

std::uint64_t Parameters::unsigned_integer(std::string_view key, std::uint64_t least,
                                           std::uint64_t greatest) const {
  const auto number = whole_number(value(key));
  if (!number || *number < least || *number > greatest)
    refuse(key, fmt::format("a whole number from {} to {}", least, greatest));
  return *number;
}

double Parameters::real(std::string_view key, double least, double greatest) const {
  const std::string& text = value(key);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !(number >= least && number <= greatest))
    refuse(key, fmt::format("a number from {:g} to {:g}", least, greatest));
  return number;
}

std::string Parameters::choice(std::string_view key, std::initializer_list<std::string_view> allowed) const {
  const std::string& text = value(key);
  if (std::ranges::find(allowed, text) != allowed.end()) return text;
  return choice(key, std::vector<std::string>(allowed.begin(), allowed.end()));  // which says why not
}

std::string Parameters::choice(std::string_view key, const std::vector<std::string>& allowed) const {
  if (std::ranges::find(allowed, value(key)) == allowed.end())
    refuse(key, fmt::format("one of: {}{}", fmt::join(allowed, ", "), did_you_mean(value(key), allowed)));
  return value(key);
}

std::vector<std::string> Parameters::choices(std::string_view key,
                                             const std::vector<std::string>& allowed) const {
  std::vector<std::string> chosen;
  std::string_view text = value(key);
  if (text == "none") return chosen;
  for (bool more = true; more;) {
    const auto plus = text.find('+');
    chosen.emplace_back(text.substr(0, plus));
    if (std::ranges::find(allowed, chosen.back()) == allowed.end())
      refuse(key, fmt::format("none, or of these, joined by '+': {}{}", fmt::join(allowed, ", "),
                              did_you_mean(chosen.back(), allowed)));
    more = plus != std::string_view::npos;
    if (more) text.remove_prefix(plus + 1);
  }
  return chosen;
}

}  // namespace catena
