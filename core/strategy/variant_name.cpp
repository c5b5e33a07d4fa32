#include "catena/core/strategy/variant_name.h"

#include "catena/core/error.h"

namespace catena {
namespace {

StageName stage(std::string_view text) {
  const auto open = text.find('(');
  if (open == std::string_view::npos && text.find(')') == std::string_view::npos) return {std::string(text)};
  if (open == std::string_view::npos || text.find(')') != text.size() - 1)
    throw InputError("'" + std::string(text) + "': write parameters as name(key=value,...)");
  const std::string_view name = text.substr(0, open);
  return {std::string(name), parse_settings(name, text.substr(open + 1, text.size() - open - 2))};
}

/// Where this character is first outside of parentheses.
std::size_t find_outside(std::string_view text, char wanted) {
  int depth = 0;
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (depth == 0 && text[k] == wanted) return k;
    depth += (text[k] == '(') - (text[k] == ')');
  }
  return std::string_view::npos;
}

}  // namespace

std::string StageName::settings_text() const { return text_of(settings); }

std::string StageName::text() const {
  return settings.empty() ? strategy : strategy + "(" + settings_text() + ")";
}

VariantName VariantName::parse(std::string_view text) {
  VariantName name;
  if (const auto slash = find_outside(text, '/'); slash != std::string_view::npos) {
    name.arithmetic = text.substr(slash + 1);
    if (name.arithmetic.empty()) throw InputError("'" + std::string(text) + "': no arithmetic after the '/'");
    text = text.substr(0, slash);
  }
  const auto plus = find_outside(text, '+');
  name.stages.push_back(stage(text.substr(0, plus)));
  if (plus != std::string_view::npos) name.stages.push_back(stage(text.substr(plus + 1)));
  return name;
}

std::string VariantName::text() const {
  std::string text;
  for (const StageName& s : stages) {
    if (!text.empty()) text += '+';
    text += s.text();
  }
  return arithmetic.empty() ? text : text + "/" + arithmetic;
}

VariantName VariantName::plain() const {
  VariantName name = *this;
  for (StageName& s : name.stages) s.settings.clear();
  return name;
}

}  // namespace catena
