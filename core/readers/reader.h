#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "catena/core/chain/exclusion.h"
#include "catena/core/pair.h"
#include "catena/core/sphere.h"

namespace catena {

/// What a file says: points along strands, perhaps radii, perhaps joints between strands. Not yet a chain.
struct CurveFile {
  std::vector<Sphere> spheres;                 ///< radius 0 where the file has none
  bool has_radii = false;
  std::vector<std::uint32_t> strand_first{0};  ///< strands + 1 offsets
  std::vector<std::uint8_t> strand_closed;     ///< one flag a strand
  std::vector<Pair> joints;                    ///< spheres of different strands that are neighbours along the tube
  Exclusion exclusion;                         ///< the file's own rule (catena's format), else window 1
  std::vector<std::string> warnings;

  void end_strand(bool closed = false);  ///< the spheres since the last call become a strand; none: nothing
};

struct ReaderInfo {
  std::string name;                     ///< "SWC neuron"
  std::vector<std::string> extensions;  ///< {".swc"}, lower case
  std::string summary;                  ///< one line for `catena list`
};

/// All readers of the program, self-registered before main.
class ReaderRegistry {
 public:
  /// Throws InputError "file:line: reason" for anything malformed; never crashes, never returns half a file.
  using Read = std::function<CurveFile(const std::filesystem::path&)>;
  static ReaderRegistry& instance();
  void add(ReaderInfo info, Read read);
  std::vector<ReaderInfo> readers() const;  ///< sorted by name
  bool knows(const std::filesystem::path& file) const;
  /// Throws InputError when the extension is unknown or the file cannot be read.
  CurveFile read(const std::filesystem::path& file) const;

 private:
  struct Entry {
    ReaderInfo info;
    Read read;
  };
  std::vector<Entry> entries_;
};

/// One object of this at namespace scope registers a reader file.
struct RegisterReader {
  RegisterReader(ReaderInfo info, ReaderRegistry::Read read) {
    ReaderRegistry::instance().add(std::move(info), std::move(read));
  }
};

}  // namespace catena
