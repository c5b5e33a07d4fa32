#pragma once
#include <filesystem>
#include <string>

namespace catena::reports {

/// The folder of a report. While this lives no other report writes there: two would mix their files. What a
/// report wrote is listed in `.catena-report`, so that the next one removes what it does not replace, and
/// nothing else.
class ReportFolder {
 public:
  /// Makes the folder. Throws InputError when it cannot, when another report is writing there, and when it
  /// holds a page that no report is known to have written.
  explicit ReportFolder(std::filesystem::path folder);
  ~ReportFolder();  ///< removes the folder where it was made and nothing came into it
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  std::string run_file() const { return (folder_ / "run.json").string(); }
  std::string journal() const { return (folder_ / "run.journal").string(); }

  /// Where the run file of an earlier report is, which may be the only copy of what it measured, gets the
  /// first free of the names run-1.json, run-2.json, ... That name; empty: there is none. Throws InputError
  /// when it cannot.
  std::string keep_run();
  /// Removes the files of every report that was written here.
  void remove_reports();
  /// Once a page is complete: removes what earlier reports left and this one did not replace.
  void remove_earlier();

 private:
  std::filesystem::path list() const { return folder_ / ".catena-report"; }

  std::filesystem::path folder_;
  bool made_ = false;
  int lock_ = -1;  // the list, held; the page writer inherits it
};

}  // namespace catena::reports
