#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "catena/core/parameters/parameters.h"
#include "catena/cuda/staging.h"

namespace catena::cuda {
namespace {

/// Copying is done by as many cores as a memory bus feeds.
Parameters copiers() { return {"staging", {{"threads", "8", "that copy"}}, ""}; }

/// Less is moved by the driver in the time that it takes to share it out.
constexpr std::size_t least = std::size_t{1} << 20;
/// So many bytes are moved by the driver in the time that it takes to pin the chunks.
constexpr std::size_t pays_from = std::size_t{128} << 20;
constexpr std::size_t page = 4096, pages_at_once = 64;

}  // namespace

/// Pinned memory, and when what was last enqueued with it is done.
class Staging::Chunk {
 public:
  /// Throws CudaError where there is no memory to pin.
  Chunk() {
    CATENA_CUDA(cudaEventCreateWithFlags(&done_, cudaEventDisableTiming));
    const cudaError_t code = cudaMallocHost(&memory_, chunk);
    if (code != cudaSuccess) cudaEventDestroy(done_);
    check(code, "cudaMallocHost", __FILE__, __LINE__);
  }
  ~Chunk() {
    cudaEventSynchronize(done_);
    cudaFreeHost(memory_);
    cudaEventDestroy(done_);
  }
  Chunk(const Chunk&) = delete;
  Chunk& operator=(const Chunk&) = delete;

  char* memory() const { return static_cast<char*>(memory_); }
  void move(void* to, const void* from, std::size_t bytes, cudaMemcpyKind kind, cudaStream_t stream) {
    CATENA_CUDA(cudaMemcpyAsync(to, from, bytes, kind, stream));
    CATENA_CUDA(cudaEventRecord(done_, stream));
  }
  void wait() const { CATENA_CUDA(cudaEventSynchronize(done_)); }

 private:
  void* memory_ = nullptr;
  cudaEvent_t done_ = nullptr;
};

Staging::Staging() : team_(copiers()) {}
Staging::~Staging() = default;

void Staging::to_device(void* device, const void* host, std::size_t bytes, cudaStream_t stream) {
  if (bytes == 0) return;
  if (!pins(bytes)) {
    CATENA_CUDA(cudaMemcpyAsync(device, host, bytes, cudaMemcpyHostToDevice, stream));
    return;
  }
  for (std::size_t at = 0, k = 0; at < bytes; at += chunk, ++k) {
    Chunk& of = *chunks_[k % chunks];
    const std::size_t size = std::min(chunk, bytes - at);
    of.wait();
    copy(of.memory(), static_cast<const char*>(host) + at, size);
    of.move(static_cast<char*>(device) + at, of.memory(), size, cudaMemcpyHostToDevice, stream);
  }
}

void Staging::to_device(void* device, const void* host, std::size_t element,
                        std::span<const SphereRange> ranges, cudaStream_t stream, const Seen& seen,
                        std::size_t together) {
  const auto multiple = [&](std::size_t count) { return std::max(together, count / together * together); };
  const std::size_t at_once = multiple(1 << 12);  // elements that one core copies
  const std::size_t most = multiple(chunk / element);
  if (most * element > chunk) throw std::logic_error("Staging: too many elements are to be seen together");
  std::size_t all = 0;
  for (const SphereRange& range : ranges) all += range.size();
  const bool pinned = pins(all * element);
  std::vector<char> pageable(pinned ? 0 : std::min(most, all) * element);
  std::vector<SphereRange> pieces;
  std::size_t at = 0, next = 0, done = 0;  // in the device's array, in the ranges, and in the next of them
  for (std::size_t k = 0; at < all; ++k) {
    pieces.clear();
    std::size_t size = 0;  // of these
    while (size < most && next < ranges.size()) {
      const std::size_t left = ranges[next].size() - done, part = std::min({left, most - size, at_once});
      const auto begin = static_cast<std::uint32_t>(ranges[next].begin + done);
      pieces.push_back({begin, begin + static_cast<std::uint32_t>(part)});
      size += part, done += part;
      if (part == left) ++next, done = 0;
    }
    char* const there = static_cast<char*>(device) + at * element;
    const char* const from = static_cast<const char*>(host);
    if (pinned) {
      Chunk& of = *chunks_[k % chunks];
      of.wait();
      gather(of.memory(), from, element, pieces, seen);
      of.move(there, of.memory(), size * element, cudaMemcpyHostToDevice, stream);
    } else {
      gather(pageable.data(), from, element, pieces, seen);
      CATENA_CUDA(cudaMemcpyAsync(there, pageable.data(), size * element, cudaMemcpyHostToDevice, stream));
      CATENA_CUDA(cudaStreamSynchronize(stream));  // before the memory is used again
    }
    at += size;
  }
}

void Staging::to_host(void* host, const void* device, std::size_t bytes, cudaStream_t stream) {
  if (bytes == 0) return;
  if (!pins(bytes)) {
    CATENA_CUDA(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, stream));
    CATENA_CUDA(cudaStreamSynchronize(stream));
    return;
  }
  const std::size_t all = (bytes + chunk - 1) / chunk;
  const auto size = [&](std::size_t k) { return std::min(chunk, bytes - k * chunk); };
  for (std::size_t k = 0; k < all + chunks; ++k) {
    Chunk& of = *chunks_[k % chunks];
    if (k >= chunks && k - chunks < all) {
      of.wait();
      copy(static_cast<char*>(host) + (k - chunks) * chunk, of.memory(), size(k - chunks));
    }
    if (k < all)
      of.move(of.memory(), static_cast<const char*>(device) + k * chunk, size(k), cudaMemcpyDeviceToHost,
              stream);
  }
}

/// Whether so much goes through chunks, which are there then.
bool Staging::pins(std::size_t bytes) {
  if (bytes < least || refused_) return false;
  if (chunks_[0] == nullptr && by_driver_ < pays_from) {
    by_driver_ += bytes;
    return false;
  }
  try {
    for (auto& chunk : chunks_)
      if (chunk == nullptr) chunk = std::make_unique<Chunk>();
  } catch (const CudaError&) {
    refused_ = true;
  }
  return !refused_;
}

void Staging::gather(char* to, const char* from, std::size_t element, std::span<const SphereRange> ranges,
                     const Seen& seen) const {
  std::vector<std::size_t> at;
  std::size_t size = 0;
  for (const SphereRange& range : ranges) at.push_back(size), size += range.size() * element;
  const auto all = static_cast<std::uint32_t>(ranges.size());
  team_.for_each_range(all, std::max(1u, all / 64), [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t k = begin; k < end; ++k) {
      const char* const of = from + ranges[k].begin * element;
      std::memcpy(to + at[k], of, ranges[k].size() * element);
      if (seen) seen(ranges[k].begin, ranges[k].size(), of);
    }
  });
}

void Staging::copy(char* to, const char* from, std::size_t bytes) const {
  team_.for_each_range(static_cast<std::uint32_t>((bytes + page - 1) / page), pages_at_once,
                       [&](std::uint32_t begin, std::uint32_t end) {
                         const std::size_t first = begin * page;
                         std::memcpy(to + first, from + first, std::min(end * page, bytes) - first);
                       });
}

}  // namespace catena::cuda
