#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace catena {

/// What identifies each sphere in the user's own file: a number (an SWC id, a line) or a text
/// ("A/MSE151/CA"), and the names of the strands. What a label of a format is, ReaderInfo::label says.
///
/// Memory: 16 bytes for every run of consecutive numbers, so nothing a sphere where a file counts its points;
/// a byte and a half and its letters for a text. A reader adds numbers alone or texts alone, one a sphere, in
/// the order of the spheres.
class Labels {
 public:
  void add(std::int64_t number);
  void add(std::string_view text);

  std::uint32_t size() const { return size_; }
  friend bool operator==(const Labels&, const Labels&) = default;

  /// The number that is the label of sphere i, where labels are numbers. O(log runs).
  std::int64_t number_of(std::uint32_t i) const;

  /// The label of sphere i; i itself where there are none. O(log runs). Throws std::out_of_range where there
  /// are labels and i is not of theirs.
  std::string of(std::uint32_t i) const;

  /// True where each is that of one sphere, by a look at the runs of numbers; texts may or may not. O(runs
  /// log runs).
  bool surely_differ() const;

  /// Of the label of sphere i; equal for equal ones. O(letters).
  std::uint64_t hash_of(std::uint32_t i) const;

  /// Those of these spheres, in this order; the names of the strands stay. O(n log runs).
  Labels chosen(std::span<const std::uint32_t> spheres) const;

  std::vector<std::string> strand_names;  ///< one a strand, or none where the file has no names

 private:
  struct Run {
    std::uint32_t first;  ///< sphere
    std::int64_t number;  ///< of that sphere; those after it have the following ones
    friend bool operator==(const Run&, const Run&) = default;
  };
  std::string_view text_of(std::uint32_t i) const;

  std::uint32_t size_ = 0;
  std::vector<Run> runs_;
  static constexpr std::uint32_t block = 16;
  std::string texts_;                       ///< each behind its length, seven bits a byte, the last below 128
  std::vector<std::uint64_t> block_begin_;  ///< of every block of texts
};

}  // namespace catena
