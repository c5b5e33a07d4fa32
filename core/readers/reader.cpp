#include "catena/core/readers/reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/parameters/nearest_name.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/readers/in_order.h"
#include "catena/core/readers/repeated_labels.h"
#include "catena/core/readers/text_lines.h"

namespace catena {
namespace {

/// In front of .gz, as what is packed there is read as if it were not.
std::string extension_of(const std::filesystem::path& file) {
  const std::string extension = lower_case(file.extension().string());
  return extension == ".gz" ? lower_case(file.stem().extension().string()) : extension;
}

std::string extension_of(const std::filesystem::path& file, const ReadOptions& options) {
  if (options.format.empty()) return extension_of(file);
  const std::string format = lower_case(options.format);
  return format.starts_with('.') ? format : fmt::format(".{}", format);
}

bool reads(const ReaderInfo& info, const std::string& extension) {
  return std::ranges::find(info.extensions, extension) != info.extensions.end();
}

void require_options(const ReaderInfo& info, const std::string& file, const ReadOptions& options) {
  const auto refuse = [&](bool given, const char* option) {
    if (given && std::ranges::find(info.options, option) == info.options.end())
      throw InputError(
          fmt::format("{}: {} means nothing for a {} file; leave it out", file, option, info.name));
  };
  refuse(!options.columns.empty(), "--columns");
  refuse(!options.atom.empty(), "--atom");
  refuse(!options.array.empty(), "--array");
  refuse(!options.topology.empty(), "--topology");
}

void check(const CurveFile& curves, const std::string& file) {
  if (curves.spheres.size() >= (std::size_t{1} << 31))
    throw InputError(fmt::format("{}: holds {} points, more than 2^31 - 1", file, curves.spheres.size()));
  // Catena's own format can say "a strand of no spheres"; the others cannot, and an empty curve is of no use.
  if (curves.strand_closed.empty()) throw InputError(fmt::format("{}: holds no points", file));
  for (std::size_t f = 0; f < curves.later_frames.size(); ++f)
    if (curves.later_frames[f].size() != curves.spheres.size())
      throw InputError(fmt::format("{}: frame {} has {}, frame 0 has {}", file, f + 1,
                                   counted(curves.later_frames[f].size(), "point"), curves.spheres.size()));
  if (curves.labels.size() != 0 && curves.labels.size() != curves.spheres.size())
    throw std::logic_error("a reader labels some spheres only");
  if (!curves.labels.strand_names.empty() && curves.labels.strand_names.size() != curves.strand_closed.size())
    throw std::logic_error("a reader names some strands only");
}

}  // namespace

void CurveFile::end_strand(bool closed) {
  const auto end = static_cast<std::uint32_t>(spheres.size());
  if (end == strand_first.back()) return;
  strand_first.push_back(end);
  strand_closed.push_back(closed ? 1 : 0);
}

void CurveFile::choose(std::span<const std::uint32_t> order) {
  put_in_order(spheres, order);
  for (auto& frame : later_frames) put_in_order(frame, order);
  labels = labels.chosen(order);
}

ReaderRegistry& ReaderRegistry::instance() {
  static ReaderRegistry registry;
  return registry;
}

void ReaderRegistry::add(ReaderInfo info, Read read) {
  for (const Entry& entry : entries_)
    for (const std::string& extension : info.extensions)
      if (reads(entry.info, extension))
        throw std::logic_error(fmt::format("both {} and {} read {}", entry.info.name, info.name, extension));
  entries_.push_back({std::move(info), std::move(read)});
}

std::vector<ReaderInfo> ReaderRegistry::readers() const {
  std::vector<ReaderInfo> sorted;
  for (const Entry& entry : entries_) sorted.push_back(entry.info);
  std::ranges::sort(sorted, {}, &ReaderInfo::name);
  return sorted;
}

bool ReaderRegistry::knows(const std::filesystem::path& file) const {
  const std::string extension = extension_of(file);
  return std::ranges::any_of(entries_, [&](const Entry& entry) { return reads(entry.info, extension); });
}

std::vector<std::filesystem::path> ReaderRegistry::files_of(const std::filesystem::path& file,
                                                            const ReadOptions& options) const {
  std::vector<std::filesystem::path> files{file};
  if (!options.topology.empty()) {
    files.emplace_back(options.topology);
    return files;
  }
  const std::string extension = extension_of(file, options);
  for (const Entry& entry : entries_)
    if (entry.info.topology_beside && reads(entry.info, extension))
      files.push_back(entry.info.topology_beside(file));
  return files;
}

CurveFile ReaderRegistry::read(const std::filesystem::path& file, const ReadOptions& options) const {
  require_regular_file(file);  // "no such file" helps more than "no such extension"
  const std::string extension = extension_of(file, options), name = shown_name(file);
  for (const Entry& entry : entries_) {
    if (!reads(entry.info, extension)) continue;
    require_options(entry.info, name, options);
    CurveFile curves = entry.read(file, options);
    check(curves, name);
    if (const auto said = said_of_repeated_labels(curves)) curves.warnings.push_back(*said);
    return curves;
  }
  std::vector<std::string> known;
  for (const Entry& entry : entries_)
    known.insert(known.end(), entry.info.extensions.begin(), entry.info.extensions.end());
  std::ranges::sort(known);
  if (extension.empty())
    throw InputError(fmt::format("{}: has no extension; name its format with --format, one of: {}", name,
                                 fmt::join(known, " ")));
  throw InputError(fmt::format("{}: no reader for {} files; there are readers for: {}; --format names one{}",
                               name, in_quotes(extension), fmt::join(known, " "),
                               did_you_mean(extension, known)));
}

}  // namespace catena
