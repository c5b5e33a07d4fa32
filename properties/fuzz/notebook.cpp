#include "catena/properties/fuzz/notebook.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <new>
#include <system_error>

namespace catena::properties {

/// Text of a most length in shared memory, whole whenever the writer dies: its size is written last.
template <std::size_t room>
struct Notebook::SharedText {
  void set(std::string_view text) {
    size.store(0);
    const std::size_t kept = std::min(text.size(), room);
    std::copy_n(text.data(), kept, at);
    size.store(kept);
  }
  std::string get() const { return {at, size.load()}; }

  std::atomic<std::size_t> size;
  char at[room];
};

struct Notebook::Page {
  std::atomic<std::uint64_t> beats;
  std::atomic<bool> ended;
  SharedText<256> variant, property;
  SharedText<(16u << 20)> chain_file;
  static constexpr std::size_t kept = 32, longest_kept = 64u << 10;
  std::atomic<std::size_t> begun;
  SharedText<longest_kept> before[kept];  ///< a ring
};

Notebook::Notebook() {
  void* const memory =
      mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED)
    throw std::system_error(errno, std::generic_category(), "cannot watch the search");
  page_ = new (memory) Page;  // its memory is zero, and stays untouched where nothing is written
}

Notebook::~Notebook() { munmap(page_, sizeof(Page)); }

void Notebook::begin(std::string_view chain_file) {
  if (const std::size_t begun = page_->begun++; begun > 0) {
    const std::string last = page_->chain_file.get();
    page_->before[(begun - 1) % Page::kept].set(last.size() <= Page::longest_kept ? last : "");
  }
  page_->chain_file.set(chain_file);
  ++page_->beats;
}

void Notebook::check(std::string_view variant, std::string_view property) {
  page_->variant.set(variant);
  page_->property.set(property);
  ++page_->beats;
}

void Notebook::end() { page_->ended = true; }

std::uint64_t Notebook::beats() const { return page_->beats; }
bool Notebook::ended() const { return page_->ended; }
std::string Notebook::chain_file() const { return page_->chain_file.get(); }
std::vector<std::string> Notebook::before() const {
  std::vector<std::string> files;
  const std::size_t done = std::max<std::size_t>(1, page_->begun) - 1;
  for (std::size_t k = done - std::min(done, Page::kept); k < done; ++k)
    if (std::string file = page_->before[k % Page::kept].get(); !file.empty())
      files.push_back(std::move(file));
  return files;
}

std::string Notebook::variant() const { return page_->variant.get(); }
std::string Notebook::property() const { return page_->property.get(); }

}  // namespace catena::properties
