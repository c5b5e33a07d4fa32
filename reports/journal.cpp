#include "catena/reports/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "catena/core/error.h"
#include "catena/core/strategy/timings.h"

namespace catena::reports {
namespace {

[[noreturn]] void fail(const std::string& file) {
  throw InputError(fmt::format("cannot write {}: {}", file, std::strerror(errno)));
}

/// To its end, whatever interrupts it.
bool write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written > 0)
      text.remove_prefix(static_cast<std::size_t>(written));
    else if (written == 0)
      return errno = ENOSPC, false;
    else if (errno != EINTR)
      return false;
  }
  return true;
}

bool has_seconds(const Journal::Json& line) {
  return line.contains("seconds") && line["seconds"].is_number();
}

}  // namespace

Journal Journal::begin(const std::string& file, const Json& run) {
  const int made = open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (made < 0 && errno == EEXIST)
    throw InputError(fmt::format(
        "{} holds what an interrupted run measured; go on with --resume, or remove it to begin anew", file));
  if (made < 0) fail(file);
  close(made);
  Journal journal;
  journal.file_ = file;
  journal.run_ = run;
  journal.append({{"run", run}});
  return journal;
}

Journal Journal::resume(const std::string& file) {
  std::ifstream in(file);
  if (!in)
    throw InputError(fmt::format("{}: there is no interrupted run to resume; leave out --resume", file));
  Journal journal;
  journal.file_ = file;
  std::uintmax_t whole = 0;  // bytes of complete lines
  for (std::string text; std::getline(in, text) && !in.eof(); whole += text.size() + 1) {
    const Json line = Json::parse(text, nullptr, false);
    if (line.is_discarded()) break;
    if ((line.contains("row") && !has_seconds(line)) ||
        (line.contains("section") &&
         !(line["section"].is_string() && line.contains("content") && has_seconds(line))))
      throw InputError(fmt::format("{}: no run can be resumed from it; remove it to begin anew", file));
    if (line.contains("run")) journal.run_ = line["run"];
    if (line.contains("row")) journal.rows_.push_back(line["row"]), journal.row_seconds_ = line["seconds"];
    if (line.contains("section")) {
      journal.sections_[line["section"].get<std::string>()] = line["content"];
      journal.section_seconds_ += line["seconds"].get<double>();
    }
  }
  if (in.bad()) throw InputError(fmt::format("{}: cannot be read to its end", file));  // to be cut there
  journal.kept_ = !journal.rows_.empty() || !journal.sections_.empty();
  if (!journal.run_.is_object())
    throw InputError(fmt::format("{}: no run can be resumed from it; remove it to begin anew", file));
  std::error_code failed;
  std::filesystem::resize_file(file, whole, failed);
  if (failed) throw InputError(fmt::format("cannot write {}: {}", file, failed.message()));
  return journal;
}

Journal::Json Journal::section(const std::string& name, const std::function<Json()>& measure) {
  if (sections_.contains(name)) return sections_[name];
  const Stopwatch watch;
  Json content = measure();
  append({{"section", name}, {"content", content}, {"seconds", watch.ms() / 1000}});
  kept_ = true;
  return content;
}

void Journal::keep_row(const Json& row, double seconds) {
  append({{"row", row}, {"seconds", row_seconds_ + seconds}});
  kept_ = true;
}

void Journal::remove() {
  if (!file_.empty()) unlink(file_.c_str());
  file_.clear();
}

void Journal::append(const Json& line) {
  if (file_.empty()) return;
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  const int out = open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (out < 0) fail(file_);
  const bool all = write_all(out, text);
  const int reason = errno;
  close(out);
  errno = reason;
  if (!all) fail(file_);
}

}  // namespace catena::reports
