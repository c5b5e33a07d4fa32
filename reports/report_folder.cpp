#include "catena/reports/report_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

#include "catena/core/error.h"

namespace catena::reports {
namespace {

namespace fs = std::filesystem;

/// The files of each report that the list tells of, the last one's last: a line "report", then a file a line.
std::vector<std::set<std::string>> reports_in(const fs::path& list) {
  std::vector<std::set<std::string>> reports;
  std::ifstream in(list);
  for (std::string line; std::getline(in, line);) {
    const fs::path file(line);
    if (line == "report")
      reports.emplace_back();
    else if (!reports.empty() && file.is_relative() && std::ranges::find(file, "..") == file.end())
      reports.back().insert(line);
  }
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read to its end", list.string()));
  return reports;
}

/// And its folder, when that is empty then.
void remove_from(const fs::path& folder, const fs::path& file) {
  std::error_code gone;
  fs::remove(folder / file, gone);
  if (file.has_parent_path()) fs::remove(folder / file.parent_path(), gone);
}

}  // namespace

ReportFolder::ReportFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  made_ = fs::create_directories(folder_, failed);
  if (failed)
    throw InputError(fmt::format("cannot make the folder {}: {}", folder_.string(), failed.message()));
  lock_ = open(list().c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (lock_ < 0) throw InputError(fmt::format("cannot write {}: {}", list().string(), std::strerror(errno)));
  if (flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    close(lock_);
    throw InputError(fmt::format(
        "another catena report is writing into {}; wait for it, or give another --output", folder_.string()));
  }
  bool known = !fs::exists(folder_ / "index.html");
  for (const auto& report : reports_in(list())) known |= report.contains("index.html");
  if (known) return;
  close(lock_);
  throw InputError(
      fmt::format("{} holds an index.html that no catena report is known to have written; remove it, or give "
                  "another --output",
                  folder_.string()));
}

ReportFolder::~ReportFolder() {
  std::error_code kept;
  int files = 0;
  if (made_)
    for (fs::directory_iterator at(folder_, kept); at != fs::directory_iterator() && !kept;
         at.increment(kept))
      ++files;
  if (files == 1 && fs::file_size(list(), kept) == 0) fs::remove(list(), kept), fs::remove(folder_, kept);
  close(lock_);
}

std::string ReportFolder::keep_run() {
  std::error_code failed;
  if (!fs::is_regular_file(run_file(), failed)) return "";
  fs::path free;
  int k = 1;
  do free = folder_ / fmt::format("run-{}.json", k++);
  while (fs::exists(fs::symlink_status(free, failed)));
  fs::rename(run_file(), free, failed);
  if (failed)
    throw InputError(fmt::format("cannot rename {} to {}: {}", run_file(), free.string(), failed.message()));
  return free.string();
}

void ReportFolder::remove_reports() {
  for (const auto& report : reports_in(list()))
    for (const auto& file : report) remove_from(folder_, file);
  if (ftruncate(lock_, 0) != 0) throw InputError(fmt::format("cannot write {}", list().string()));
}

void ReportFolder::remove_earlier() {
  auto reports = reports_in(list());
  if (reports.empty()) return;
  const auto last = std::move(reports.back());
  reports.pop_back();
  for (const auto& report : reports)
    for (const auto& file : report)
      if (!last.contains(file)) remove_from(folder_, file);
  std::string text = "report\n";
  for (const auto& file : last) text += file + '\n';
  if (ftruncate(lock_, 0) != 0 ||
      pwrite(lock_, text.data(), text.size(), 0) != static_cast<ssize_t>(text.size()))
    throw InputError(fmt::format("cannot write {}: {}", list().string(), std::strerror(errno)));
}

}  // namespace catena::reports
