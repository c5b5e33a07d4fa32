#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/readers/labels.h"
#include "catena/core/strategy/request.h"

namespace catena {

/// A frame that is to be written: its chain, and perhaps what was found in it (counts and pairs).
struct ExportedFrame {
  Chain chain;
  const Collisions* found = nullptr;
  const PeriodicBox* box = nullptr;  ///< in which that was found
};

/// The frames [first, last) that go into one file.
struct ExportedFrames {
  std::uint32_t first, last;
  std::function<ExportedFrame(std::uint32_t)> at;  ///< asked once for each, in their order
  const Labels& labels;
  std::span<const Pair> joints{};        ///< of the file that they come from, see CurveFile
  std::span<const PeriodicBox> boxes{};  ///< one a frame of the input, one for all, or none; see Input
};

/// What a writer says of itself: which files it makes, and what these can hold.
struct WriterInfo {
  std::string name;                     ///< "OBJ lines"
  std::vector<std::string> extensions;  ///< {".obj"}, lower case
  /// What the format can hold: radii, the exclusion rule, several frames, what was found, a periodic box.
  bool radii, rule, frames, contacts, box;
  bool labels = false;  ///< likewise, and the names of strands
  std::string summary;  ///< one line for `catena list`
  /// What it can hold, too: by joints another rule than the file's finds neighbours across them.
  bool joints = false;
  /// Strands are lines between points: read back, closed ones follow open ones, and those of one or two
  /// spheres are open.
  bool lines = false;
};

/// All writers of the program, self-registered before main.
class WriterRegistry {
 public:
  /// Writes the file whole or not at all. Throws InputError when it cannot be written.
  using Write = std::function<void(const std::filesystem::path&, const ExportedFrames&)>;
  static WriterRegistry& instance();
  void add(WriterInfo info, Write write);
  std::vector<WriterInfo> writers() const;  ///< sorted by name

  struct Entry {
    WriterInfo info;
    Write write;
  };
  /// The writer for the extension of this file. Throws InputError that names those that there are.
  const Entry& of(const std::filesystem::path& file) const;

 private:
  std::vector<Entry> entries_;
};

/// One object of this at namespace scope registers a writer file.
struct RegisterWriter {
  RegisterWriter(WriterInfo info, WriterRegistry::Write write) {
    WriterRegistry::instance().add(std::move(info), std::move(write));
  }
};

}  // namespace catena
