#pragma once
#include <string>

namespace catena::reports {

/// While one of these lives, Ctrl-C (and a polite kill) says this line on stderr before the process ends of
/// it.
class SaidIfInterrupted {
 public:
  explicit SaidIfInterrupted(const std::string& line);
  ~SaidIfInterrupted();
  SaidIfInterrupted(const SaidIfInterrupted&) = delete;
  SaidIfInterrupted& operator=(const SaidIfInterrupted&) = delete;
};

}  // namespace catena::reports
