#pragma once
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace catena::reports {

/// What a run has measured so far, kept as it is measured: one JSON object a line, appended to a file. A run
/// that is interrupted, fails or crashes loses only what was in work, and a later one goes on from here.
///
///   {"run": ...}                     what is measured, by which program, on which machine
///   {"section": NAME, "content": ..., "seconds": s}
///   {"row": ..., "seconds": s}       of `benchmarks`; s: since the timing began
class Journal {
 public:
  using Json = nlohmann::ordered_json;

  /// Keeps nothing.
  Journal() = default;
  /// A new journal. Throws InputError when the file exists, since that is what an interrupted run measured,
  /// and when it cannot be written.
  static Journal begin(const std::string& file, const Json& run);
  /// An interrupted run's. A last line that is not complete is dropped. Throws InputError when there is none,
  /// or it cannot be read.
  static Journal resume(const std::string& file);

  const Json& run() const { return run_; }             ///< as it was begun
  const Json& rows() const { return rows_; }           ///< kept by the runs before this one
  double row_seconds() const { return row_seconds_; }  ///< that they took
  /// The content of a section that was measured before, or what `measure` gives, which is kept.
  Json section(const std::string& name, const std::function<Json()>& measure);
  double section_seconds() const { return section_seconds_; }  ///< of all that were measured before
  bool empty() const { return !kept_; }                        ///< nothing was measured, now or before
  void keep_row(const Json& row, double seconds);
  /// The run is complete and written elsewhere.
  void remove();

 private:
  void append(const Json& line);

  std::string file_;   // empty: nothing is kept
  bool kept_ = false;  // a section or a row
  Json run_, rows_ = Json::array(), sections_ = Json::object();
  double row_seconds_ = 0, section_seconds_ = 0;
};

}  // namespace catena::reports
