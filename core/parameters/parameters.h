#pragma once
#include <cstdint>
#include <map>
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

  std::uint64_t unsigned_integer(const std::string& key, std::uint64_t least, std::uint64_t greatest) const;
  double real(const std::string& key, double least, double greatest) const;
  std::string choice(const std::string& key, const std::vector<std::string>& allowed) const;
  /// Several of them, joined by '+'; none of them for "none".
  std::vector<std::string> choices(const std::string& key, const std::vector<std::string>& allowed) const;
  /// False when the value is the default one.
  bool given(const std::string& key) const;

 private:
  const std::string& value(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& wanted) const;

  std::string owner_;
  std::map<std::string, std::string> values_;
  std::vector<std::string> given_;
};

}  // namespace catena
