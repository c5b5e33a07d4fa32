#pragma once
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "catena/core/export.h"

namespace catena {

/// One parameter of a strategy or scene.
struct CATENA_API ParameterInfo {
  std::string name, default_value, meaning;
};

/// key=value parameters as written by the user, over declared defaults. Values are read with their type; a
/// value that does not parse or lies outside its range is an InputError that names owner, key, value and
/// range.
class CATENA_API Parameters {
 public:
  Parameters() = default;
  /// `text` is "key=value,key=value" or empty. Throws InputError for an unknown, repeated or malformed key.
  Parameters(std::string owner, const std::vector<ParameterInfo>& declared, std::string_view text);

  std::uint64_t unsigned_integer(std::string_view key, std::uint64_t least, std::uint64_t greatest) const;
  double real(std::string_view key, double least, double greatest) const;
  std::string choice(std::string_view key, std::initializer_list<std::string_view> allowed) const;
  std::string choice(std::string_view key, const std::vector<std::string>& allowed) const;
  /// Several of them, joined by '+'; none of them for "none".
  std::vector<std::string> choices(std::string_view key, const std::vector<std::string>& allowed) const;
  /// False when the value is the default one.
  bool given(std::string_view key) const;

 private:
  struct Value {
    std::string key, text;
    bool given = false;
  };
  const std::string& value(std::string_view key) const;
  [[noreturn]] void refuse(std::string_view key, const std::string& wanted) const;

  std::string owner_;
  std::vector<Value> values_;  ///< in the order declared; few, so that each is looked for among all
};

}  // namespace catena
