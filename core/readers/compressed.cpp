#include "catena/core/readers/compressed.h"

#include <fmt/format.h>

#ifdef CATENA_HAS_ZLIB
#include <zlib.h>
#endif

#include <algorithm>
#include <limits>

#include "catena/core/counted.h"
#include "catena/core/error.h"

namespace catena {

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1F\x8B"); }

#ifdef CATENA_HAS_ZLIB
namespace {

constexpr uInt most_at_once = std::numeric_limits<uInt>::max();

/// zlib's inflate over data of any size.
class Inflate {
 public:
  /// `window` as inflateInit2 takes it: 15 for zlib, 31 for gzip.
  Inflate(std::string_view bytes, int window) : left_(bytes) {
    if (inflateInit2(&stream_, window) != Z_OK) throw std::bad_alloc();
  }
  ~Inflate() { inflateEnd(&stream_); }
  Inflate(const Inflate&) = delete;
  Inflate& operator=(const Inflate&) = delete;

  enum class State { going_on, member_over, damaged };

  /// Fills up to `size` bytes at `to`; `filled` is how many it were.
  State read(char* to, std::size_t size, std::size_t& filled) {
    feed();
    stream_.next_out = reinterpret_cast<Bytef*>(to);
    stream_.avail_out = static_cast<uInt>(std::min<std::size_t>(size, most_at_once));
    const uInt room = stream_.avail_out;
    const int code = inflate(&stream_, Z_NO_FLUSH);
    filled = room - stream_.avail_out;
    if (code == Z_STREAM_END) return State::member_over;
    return code == Z_OK ? State::going_on : State::damaged;  // also where input is due and none is left
  }

  bool next_member() {
    feed();
    return stream_.avail_in > 0 && inflateReset(&stream_) == Z_OK;
  }

 private:
  void feed() {
    if (stream_.avail_in > 0) return;
    const auto part = left_.substr(0, most_at_once);
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));  // zlib only reads there
    stream_.avail_in = static_cast<uInt>(part.size());
    left_.remove_prefix(part.size());
  }

  std::string_view left_;
  z_stream stream_{};
};

/// The last four bytes of a file of one member: its content's size modulo 2^32. Believed as far as text is
/// likely to be compressed, as damaged bytes must not ask for memory.
std::size_t announced_size(std::string_view bytes) {
  std::uint32_t size = 0;
  for (unsigned byte = 0; bytes.size() >= 18 && byte < 4; ++byte)
    size |= std::uint32_t{static_cast<unsigned char>(bytes[bytes.size() - 4 + byte])} << (8 * byte);
  return static_cast<std::size_t>(std::min<std::uint64_t>(size, std::uint64_t{bytes.size()} * 16));
}

}  // namespace

std::string gunzip(std::string_view bytes, const std::string& file) {
  Inflate member(bytes, 31);
  // One byte more than is announced, so that the end is seen without growing.
  std::string content(announced_size(bytes) + 1, '\0');
  std::size_t size = 0;
  for (;;) {
    if (size == content.size()) content.resize(content.size() + content.size() / 2 + 4096);
    std::size_t filled = 0;
    const auto state = member.read(content.data() + size, content.size() - size, filled);
    size += filled;
    if (state == Inflate::State::damaged)
      throw InputError(
          fmt::format("{}: the gzip data is damaged or cut off after {} of content; check it "
                      "with gzip -t",
                      file, counted(size, "byte")));
    if (state == Inflate::State::member_over && !member.next_member()) break;
  }
  content.resize(size);
  return content;
}

std::string gunzip_head(std::string_view bytes, std::size_t size) {
  Inflate member(bytes, 31);
  std::string content(size, '\0');
  std::size_t done = 0;
  for (bool more = true; more && done < size;) {
    std::size_t filled = 0;
    const auto state = member.read(content.data() + done, size - done, filled);
    done += filled;
    more =
        state == Inflate::State::going_on || (state == Inflate::State::member_over && member.next_member());
  }
  content.resize(done);
  return content;
}

bool append_inflated(std::string_view stream, std::uint64_t size, std::string& content) {
  constexpr std::uint64_t most_compressed = 1032;                 // deflate cannot do better
  if (size > most_compressed * stream.size() + 64) return false;  // before memory is asked for
  Inflate inflate(stream, 15);
  const std::size_t begin = content.size();
  content.resize(begin + size + 1);
  std::size_t done = 0;
  for (;;) {
    std::size_t filled = 0;
    const auto state = inflate.read(content.data() + begin + done, size + 1 - done, filled);
    done += filled;
    if (state == Inflate::State::member_over) break;
    if (state == Inflate::State::damaged || done > size) return false;
  }
  content.resize(begin + done);
  return done == size;
}

#else

std::string gunzip(std::string_view, const std::string& file) {
  throw InputError(
      fmt::format("{}: is compressed, and this catena was built without zlib; unpack it with gunzip, or "
                  "build with zlib1g-dev",
                  file));
}

std::string gunzip_head(std::string_view, std::size_t) { return ""; }

bool append_inflated(std::string_view, std::uint64_t, std::string&) {
  throw InputError("the data is compressed, and this catena was built without zlib; build with zlib1g-dev");
}

#endif

}  // namespace catena
