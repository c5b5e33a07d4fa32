#include "catena/core/writers/writer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

bool writes(const WriterInfo& info, const std::string& extension) {
  return std::ranges::find(info.extensions, extension) != info.extensions.end();
}

}  // namespace

WriterRegistry& WriterRegistry::instance() {
  static WriterRegistry registry;
  return registry;
}

void WriterRegistry::add(WriterInfo info, Write write) {
  for (const Entry& entry : entries_)
    for (const std::string& extension : info.extensions)
      if (writes(entry.info, extension))
        throw std::logic_error(fmt::format("both {} and {} write {}", entry.info.name, info.name, extension));
  entries_.push_back({std::move(info), std::move(write)});
}

std::vector<WriterInfo> WriterRegistry::writers() const {
  std::vector<WriterInfo> sorted;
  for (const Entry& entry : entries_) sorted.push_back(entry.info);
  std::ranges::sort(sorted, {}, &WriterInfo::name);
  return sorted;
}

const WriterRegistry::Entry& WriterRegistry::of(const std::filesystem::path& file) const {
  const std::string extension = lower_case(file.extension().string());
  std::vector<std::string> known;
  for (const Entry& entry : entries_) {
    if (writes(entry.info, extension)) return entry;
    known.insert(known.end(), entry.info.extensions.begin(), entry.info.extensions.end());
  }
  std::ranges::sort(known);
  throw InputError(fmt::format("{}: nothing writes '{}' files; there are: {}{}", file.string(), extension,
                               fmt::join(known, " "), did_you_mean(extension, known)));
}

}  // namespace catena
