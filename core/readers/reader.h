#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "catena/core/chain/exclusion.h"
#include "catena/core/pair.h"
#include "catena/core/periodic/periodic_box.h"
#include "catena/core/readers/labels.h"
#include "catena/core/readers/point_rounding.h"
#include "catena/core/readers/read_options.h"
#include "catena/core/sphere.h"

namespace catena {

/// What a file says: points along strands, perhaps radii, perhaps joints between strands. Not yet a chain.
struct CurveFile {
  CurveFile() = default;
  explicit CurveFile(const ReadOptions& options) : rounding(options) {}

  std::vector<Sphere> spheres;  ///< radius 0 where the file has none
  bool has_radii = false;
  std::vector<std::uint32_t> strand_first{0};  ///< strands + 1 offsets
  std::vector<std::uint8_t> strand_closed;     ///< one flag a strand
  bool is_tree = false;                        ///< its strands are branches, none of which can be closed
  /// Steps beside those of the strands: branches, and loops that end on themselves.
  std::vector<Pair> joints;
  Exclusion exclusion;       ///< the file's own rule (catena's format), else window 1
  std::vector<std::vector<Sphere>> later_frames;  ///< the same spheres, moved; empty: a file of one frame
  std::vector<PeriodicBox> boxes;  ///< one a frame, or one for all; none: space does not repeat
  bool box_is_periodic = true;     ///< false: the file has a box, but does not say that space repeats it
  Labels labels;                   ///< of the spheres; none: their numbers from 0
  PointRounding rounding;
  std::vector<std::string> warnings;  ///< without the file's name: "line 3: ..." or "..."

  /// Adds a sphere to the frame under way, rounded to binary32.
  void add_point(double x, double y, double z, float radius = 0) {
    (later_frames.empty() ? spheres : later_frames.back()).push_back(rounding.round(x, y, z, radius));
  }
  /// One whose radius is told later, or which may be left out; rounding.settle() counts what it has lost.
  void add_open_point(double x, double y, double z) { spheres.push_back(rounding.round_open(x, y, z)); }
  /// What is added from here on is the next frame's.
  void begin_later_frame() { later_frames.emplace_back(); }
  /// Keeps these spheres alone, in this order, in every frame and with their labels; the strands are the
  /// caller's.
  void choose(std::span<const std::uint32_t> order);
  void end_strand(bool closed = false);  ///< the spheres since the last call become a strand; none: nothing
};

/// What a reader says of itself: which files it takes, and how users are told of them.
struct ReaderInfo {
  std::string name;                     ///< "SWC neuron"
  std::vector<std::string> extensions;  ///< {".swc"}, lower case
  std::string summary;                  ///< one line for `catena list`
  std::string label;                    ///< what identifies a sphere: "sample id", "line"
  /// Of "--columns", "--atom", "--array", "--topology" those that mean something here.
  std::vector<std::string> options{};
  /// Where a file's topology lies that no option names; none: the reader looks for no such file.
  std::function<std::filesystem::path(const std::filesystem::path&)> topology_beside{};
};

/// All readers of the program, self-registered before main.
class ReaderRegistry {
 public:
  /// Throws InputError "file:line: reason" for anything malformed; never crashes, never returns half a file.
  using Read = std::function<CurveFile(const std::filesystem::path&, const ReadOptions&)>;
  static ReaderRegistry& instance();
  void add(ReaderInfo info, Read read);
  std::vector<ReaderInfo> readers() const;              ///< sorted by name
  bool knows(const std::filesystem::path& file) const;  ///< by its extension, or that in front of .gz
  /// The files that read() would open: this one, and its topology where an option names it or it lies beside.
  std::vector<std::filesystem::path> files_of(const std::filesystem::path& file,
                                              const ReadOptions& options = {}) const;
  /// `-` is standard input. Throws InputError when the extension, or the format of the options, is unknown,
  /// the file cannot be read, or the options are not for its reader.
  CurveFile read(const std::filesystem::path& file, const ReadOptions& options = {}) const;

 private:
  struct Entry {
    ReaderInfo info;
    Read read;
  };
  std::vector<Entry> entries_;
};

/// The Read of a reader that is a class: made from file and options, asked once for its curves().
template <class Reader>
CurveFile read_by(const std::filesystem::path& file, const ReadOptions& options) {
  return Reader(file, options).curves();
}

/// One object of this at namespace scope registers a reader file.
struct RegisterReader {
  RegisterReader(ReaderInfo info, ReaderRegistry::Read read) {
    ReaderRegistry::instance().add(std::move(info), std::move(read));
  }
};

}  // namespace catena
