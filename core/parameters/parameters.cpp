#include "catena/core/parameters/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/parameters/settings.h"
#include "catena/core/parameters/whole_number.h"

namespace catena {

Parameters::Parameters(std::string owner, const std::vector<ParameterInfo>& declared, std::string_view text)
    : owner_(std::move(owner)) {
  std::vector<std::string> known;
  for (const auto& p : declared) {
    values_[p.name] = p.default_value;
    known.push_back(p.name);
  }
  for (auto& [key, value] : parse_settings(owner_, text)) {
    if (!values_.contains(key))
      throw InputError(known.empty() ? fmt::format("{} takes no parameters, got '{}'", owner_, key)
                                     : fmt::format("{} has no parameter '{}'; it has: {}{}", owner_, key,
                                                   fmt::join(known, ", "), did_you_mean(key, known)));
    if (given(key)) throw InputError(fmt::format("{}: '{}' is given twice", owner_, key));
    values_[key] = std::move(value);
    given_.push_back(key);
  }
}

bool Parameters::given(const std::string& key) const { return std::ranges::find(given_, key) != given_.end(); }

const std::string& Parameters::value(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) throw std::logic_error(owner_ + " reads the undeclared parameter " + key);
  return found->second;
}

void Parameters::refuse(const std::string& key, const std::string& wanted) const {
  throw InputError(fmt::format("{}: {}={} must be {}", owner_, key, value(key), wanted));
}

std::uint64_t Parameters::unsigned_integer(const std::string& key, std::uint64_t least, std::uint64_t greatest) const {
  const auto number = whole_number(value(key));
  if (!number || *number < least || *number > greatest)
    refuse(key, fmt::format("a whole number from {} to {}", least, greatest));
  return *number;
}

double Parameters::real(const std::string& key, double least, double greatest) const {
  const std::string& text = value(key);
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !(number >= least && number <= greatest))
    refuse(key, fmt::format("a number from {:g} to {:g}", least, greatest));
  return number;
}

std::string Parameters::choice(const std::string& key, const std::vector<std::string>& allowed) const {
  if (std::ranges::find(allowed, value(key)) == allowed.end())
    refuse(key, fmt::format("one of: {}{}", fmt::join(allowed, ", "), did_you_mean(value(key), allowed)));
  return value(key);
}

std::vector<std::string> Parameters::choices(const std::string& key,
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
