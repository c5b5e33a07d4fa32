#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "catena/core/executor/large_vector.h"
#include "catena/core/parts/local_chain.h"
#include "catena/cuda/device_buffer.h"
#include "catena/cuda/launch.cuh"
#include "catena/cuda/staging.h"

namespace catena::cuda {

/// Runs of consecutive numbers, as LocalChain has them.
struct NumberRuns {
  const SphereRange* run;
  const std::uint32_t* begin;   ///< of each, and the end
  const std::uint32_t* run_at;  ///< nullptr: they are few
};

/// One thread a sphere.
static __global__ void number_spheres(NumberRuns of, std::uint32_t size, std::uint32_t* id) {
  const std::uint64_t i = std::uint64_t{blockIdx.x} * blockDim.x + threadIdx.x;
  if (i >= size) return;
  std::uint32_t run = of.run_at == nullptr ? 0 : of.run_at[i / parts::LocalChain::stride];
  while (of.begin[run + 1] <= i) ++run;
  id[i] = of.run[run].begin + (static_cast<std::uint32_t>(i) - of.begin[run]);
}

/// The tables by which a device knows neighbours in a part.
class PartTables {
 public:
  /// On their way in the stream when this returns.
  ExclusionView upload(const Chain& whole, const parts::LocalChain& part, Staging& staging,
                       cudaStream_t stream) {
    ExclusionView rule = whole.view().exclusion;
    const ExclusionView of_whole = rule;
    rule.one_open_strand = part.by_number() || part.is_one_open_strand();
    rule.window_alone = rule.one_open_strand && rule.rule == Exclusion::Rule::index_window;
    rule.strand_of = rule.strand_first = rule.extra_row = rule.extra = nullptr;
    rule.strand_closed = nullptr;
    rule.arc = rule.loop_length = nullptr;
    if (rule.rule == Exclusion::Rule::arc_window) {
      double* const there = arc_.reserve(part.size(), stream);
      staging.to_device(there, of_whole.arc, sizeof(double), part.runs(), stream);
      rule.arc = there;
    }
    if (part.by_number() && part.runs().size() > 1 && rule.rule == Exclusion::Rule::index_window)
      upload_numbers(part, rule, staging, stream);
    if (rule.one_open_strand) return rule;
    upload_strands(of_whole, part, rule, staging, stream);
    if (!part.extra().empty()) upload_extra(part, rule, staging, stream);
    CATENA_CUDA(cudaStreamSynchronize(stream));  // before the host's tables are written again
    return rule;
  }

 private:
  void upload_numbers(const parts::LocalChain& part, ExclusionView& rule, Staging& staging,
                      cudaStream_t stream) {
    const auto upload = [&](auto& buffer, const auto& of) {
      return of.empty() ? nullptr : staging.upload(buffer, of.data(), of.size(), stream);
    };
    const NumberRuns runs{upload(run_, part.runs()), upload(first_, part.begins()),
                          upload(row_, part.run_at())};
    std::uint32_t* const id = id_.reserve(part.size(), stream);
    launch(number_spheres, part.size(), 256, stream, runs, part.size(), id);
    rule.id = id;
    rule.ascends_from = part.own().begin, rule.ascends_to = part.own().end;
  }

  void upload_strands(const ExclusionView& of_whole, const parts::LocalChain& part, ExclusionView& rule,
                      Staging& staging, cudaStream_t stream) {
    const std::span<const parts::LocalChain::Piece> pieces = part.pieces();
    host_strand_of_.resize(part.size());
    host_first_.assign(1, 0);
    host_closed_.clear();
    host_loop_.clear();
    for (const parts::LocalChain::Piece& piece : pieces) {
      host_first_.push_back(piece.begin + piece.size);
      host_closed_.push_back(piece.closed);
      if (rule.rule == Exclusion::Rule::arc_window) host_loop_.push_back(of_whole.loop_length[piece.strand]);
    }
    staging.team().for_each_range(
        static_cast<std::uint32_t>(pieces.size()), at_once, [&](std::uint32_t begin, std::uint32_t end) {
          for (std::uint32_t p = begin; p < end; ++p)
            std::fill_n(host_strand_of_.begin() + pieces[p].begin, pieces[p].size, p);
        });
    rule.strand_of = staging.upload(strand_of_, host_strand_of_.data(), host_strand_of_.size(), stream);
    rule.strand_first = staging.upload(first_, host_first_.data(), host_first_.size(), stream);
    rule.strand_closed = staging.upload(closed_, host_closed_.data(), host_closed_.size(), stream);
    if (!host_loop_.empty())
      rule.loop_length = staging.upload(loop_, host_loop_.data(), host_loop_.size(), stream);
  }

  /// Partners of each sphere, both ways, as Topology has them; few spheres have any.
  void upload_extra(const parts::LocalChain& part, ExclusionView& rule, Staging& staging,
                    cudaStream_t stream) {
    host_ends_.assign(part.extra().begin(), part.extra().end());
    for (const Pair& pair : part.extra()) host_ends_.push_back({pair.j, pair.i});
    std::sort(host_ends_.begin(), host_ends_.end());
    host_extra_.clear();
    for (const Pair& end : host_ends_) host_extra_.push_back(end.j);
    host_row_.resize(part.size() + std::size_t{1});
    const auto ends = static_cast<std::uint32_t>(host_ends_.size());
    staging.team().for_each_range(ends + 1, at_once, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t k = begin; k < end; ++k) {  // rows up to a sphere's begin where its first partner is
        const std::size_t from = k == 0 ? 0 : host_ends_[k - 1].i + std::size_t{1},
                          to = k == ends ? host_row_.size() : host_ends_[k].i + std::size_t{1};
        std::fill(host_row_.begin() + static_cast<std::ptrdiff_t>(from),
                  host_row_.begin() + static_cast<std::ptrdiff_t>(std::max(from, to)), k);
      }
    });
    rule.extra_row = staging.upload(row_, host_row_.data(), host_row_.size(), stream);
    rule.extra = staging.upload(extra_, host_extra_.data(), host_extra_.size(), stream);
  }

  static constexpr std::uint32_t at_once = 256;  ///< pieces or partners that one core takes

  LargeVector<std::uint32_t> host_strand_of_, host_row_;
  std::vector<std::uint32_t> host_first_, host_extra_;
  std::vector<Pair> host_ends_;
  std::vector<std::uint8_t> host_closed_;
  std::vector<double> host_loop_;
  DeviceBuffer<std::uint32_t> id_, strand_of_, first_, row_, extra_;
  DeviceBuffer<SphereRange> run_;
  DeviceBuffer<std::uint8_t> closed_;
  DeviceBuffer<double> arc_, loop_;
};

}  // namespace catena::cuda
