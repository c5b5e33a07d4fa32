#include "catena/core/ranks/mpi/shared_output.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include "catena/core/output_file.h"
#include "catena/core/ranks/bytes.h"

namespace catena::ranks {
namespace {

namespace fs = std::filesystem;

/// What rank 0 says.
std::string said_by_first(Communicator& ranks, const std::string& text) {
  const Gathered all = ranks.all_gather(
      ranks.rank() == 0 ? ByteWriter().put_all(std::span(text.data(), text.size())).take() : Bytes());
  const Bytes& first = all->front();
  return {reinterpret_cast<const char*>(first.data()), first.size()};
}

std::string unfinished_name(const std::string& name, const std::string& target) {
  std::error_code unknown;
  const auto status = fs::status(target, unknown);
  if (OutputFile::written_through(target))
    throw InputError(fmt::format("cannot write {}: ranks write a file together, and this is none", name));
  const std::string unfinished = OutputFile::unfinished_beside(target).string();
  std::FILE* const made = std::fopen(unfinished.c_str(), "wx");
  if (made == nullptr) throw InputError(fmt::format("cannot write {}: {}", name, std::strerror(errno)));
  std::fclose(made);
  if (fs::exists(status)) fs::permissions(unfinished, status.permissions() & fs::perms(0777), unknown);
  return unfinished;
}

/// Names of this process, which has one thread that writes, for a signal that may come at any time: as mpirun
/// sends them when it is interrupted.
class Unfinished {
 public:
  static Unfinished& here() {
    static Unfinished names;
    return names;
  }
  void add(const std::string& name) {
    const std::string& kept = *names_.insert(name).first;
    for (auto& place : places_)
      if (place == nullptr) return place = kept.c_str(), void();
  }
  void forget(const std::string& name) {
    const auto kept = names_.find(name);
    if (kept == names_.end()) return;
    for (auto& place : places_)
      if (place == kept->c_str()) place = nullptr;
    names_.erase(kept);
  }
  void remove() const noexcept {
    for (const std::string& name : names_) unlink(name.c_str());
  }

 private:
  Unfinished() {
    for (const int signal : {SIGHUP, SIGINT, SIGTERM})
      if (std::signal(signal, end) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  static void end(int signal) {
    for (const auto& place : here().places_)
      if (const char* const name = place) unlink(name);
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }

  static constexpr std::size_t most = 8;  ///< that a signal removes; a command writes two
  std::set<std::string> names_;
  std::array<std::atomic<const char*>, most> places_{};
};

}  // namespace

void SharedOutput::remove_unfinished() noexcept { Unfinished::here().remove(); }

SharedOutput::SharedOutput(Communicator& ranks, std::string name)
    : ranks_(ranks), name_(std::move(name)), target_(OutputFile::target(name_).string()) {
  if (ranks_.rank() == 0) unfinished_ = unfinished_name(name_, target_);
  try {
    unfinished_ = said_by_first(ranks_, unfinished_);
    Unfinished::here().add(unfinished_);
    file_ = MpiFile(unfinished_, MpiFile::Use::write, name_);
  } catch (...) {
    if (ranks_.rank() == 0) unlink(unfinished_.c_str());
    throw;
  }
}

// Other ranks keep the name: of one that failed this is gone before it knows whether rank 0 will remove the
// file.
SharedOutput::~SharedOutput() {
  if (ranks_.rank() == 0 && !unfinished_.empty()) unlink(unfinished_.c_str());
}

void SharedOutput::append(std::string_view own) {
  std::uint64_t at = written_;
  const auto sizes = all_gather_value(ranks_, std::uint64_t{own.size()});
  for (unsigned rank = 0; rank < ranks_.size(); ++rank) {
    if (rank < ranks_.rank()) at += sizes[rank];
    written_ += sizes[rank];
  }
  file_.write(at, own.data(), own.size());
}

void SharedOutput::close() {
  file_.close();
  ranks_.vote();  // all have written
  if (ranks_.rank() == 0 && std::rename(unfinished_.c_str(), target_.c_str()) != 0)
    throw InputError(fmt::format("cannot write {}: {}", name_, std::strerror(errno)));
  Unfinished::here().forget(unfinished_);
  unfinished_.clear();
}

}  // namespace catena::ranks
