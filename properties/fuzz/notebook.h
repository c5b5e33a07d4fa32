#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace catena::properties {

/// What a process that may crash or hang is doing, in memory that it shares with the one that watches it: it
/// outlives the crash, and a beat for each check tells work from a hang. Made before the fork.
class Notebook {
 public:
  Notebook();  ///< throws std::system_error when there is no memory to share
  ~Notebook();
  Notebook(const Notebook&) = delete;
  Notebook& operator=(const Notebook&) = delete;

  // The one that works.
  /// A chain, as the text of its file, is about to be checked. More than 16 MiB are cut. The last 32 before
  /// it are kept, but for those of more than 64 KiB.
  void begin(std::string_view chain_file);
  /// This variant is about to be held against this property. Also tells that everything goes on.
  void check(std::string_view variant, std::string_view property);
  void end();  ///< the work ends by itself, well or not

  // The one that watches.
  std::uint64_t beats() const;
  bool ended() const;
  std::string chain_file() const;
  std::vector<std::string> before() const;  ///< what was begun before it, in order
  std::string variant() const;
  std::string property() const;

 private:
  template <std::size_t room>
  struct SharedText;
  struct Page;
  Page* page_;
};

}  // namespace catena::properties
