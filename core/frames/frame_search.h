#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/export.h"
#include "catena/core/frames/frame_answer.h"
#include "catena/core/frames/kept_list.h"
#include "catena/core/frames/list_policy.h"
#include "catena/core/frames/moved_cells.h"
#include "catena/core/frames/moving_row.h"
#include "catena/core/plan/omissions.h"
#include "catena/core/plan/trial_account.h"
#include "catena/core/strategy/moved.h"
#include "catena/core/strategy/plan.h"

namespace catena {

/// Searches a frame by what is known of the last one that was searched: its spheres and its pairs. What a
/// frame has in common with it is seen in `update`, which allocates nothing once warm; `find` searches what
/// is left. Measured times choose the way, never the answer.
class CATENA_API FrameSearch {
 public:
  enum class Way {
    full,      ///< all is searched
    unmoved,   ///< the answer is that of the last frame
    parts,     ///< what moved is searched
    shifted,   ///< what came in is searched
    kept_list  ///< near pairs are compared
  };

  struct Learned {
    double ms = 0;
    bool measured = false;
  };

  /// `always`: a way that can be gone is, whatever it costs; for tests, on short chains too. `list` and
  /// `cells` are what a test may have broken.
  FrameSearch(const Omissions& omissions, bool always,
              std::unique_ptr<KeptList> list = std::make_unique<KeptList>(),
              std::unique_ptr<MovedCells> cells = std::make_unique<MovedCells>());
  virtual ~FrameSearch() = default;

  /// A first frame. `follow`: others are expected.
  void begin(bool follow);
  /// Others are, or one came: what is found now is of use later. Else a caller may search without telling.
  bool expected() const { return frames_; }
  /// A frame went by that is none of its business: what it knows is of an earlier one.
  void passed();
  /// The next frame, and the way in which find will search it, as far as that can be.
  Way update(const Chain& chain, const Moved& moved);
  /// `here` answers for this chain, `search` builds and answers for any other; `build_ms` is what building
  /// this one took where the way is full.
  void find(const Chain& chain, const Request& request, Collisions& result, const FullSearch& here,
            const FullSearch& search, double build_ms);
  /// The same, of all spheres, into an answer of its own, of which what did not change is not written again:
  /// a frame that moved little costs no more than what moved. Pairs may be there where counts are asked for.
  /// Stays until the next call of any function but plan and way.
  const Collisions& find_kept(const Chain& chain, const Request& request, const FullSearch& here,
                              const FullSearch& search, double build_ms);

  /// What was decided for the last frame; nothing for a first frame alone.
  Plan plan() const;
  /// Of the last frame; full where find had to leave the way that update had chosen.
  Way way() const { return way_; }
  /// About how many pairs it keeps at most that nobody asked for; half a GiB of them, unless a test says
  /// less.
  void keep_at_most(std::uint64_t pairs) { most_pairs_ = pairs; }

 protected:
  // What a test may break.
  virtual bool find_changes(std::span<const Sphere> before, std::span<const Sphere> now, std::uint32_t most,
                            std::vector<SphereRange>& ranges) const;
  virtual std::optional<std::int64_t> find_shift(std::span<const Sphere> before, std::span<const Sphere> now,
                                                 std::uint32_t most, std::int64_t guess) const;

 private:
  /// Why all is searched, where it is.
  enum class Why {
    not_kept,  ///< no pairs of the frame before are known
    crowded,   ///< as they were too many
    another,   ///< it is no earlier frame of this chain
    doubt,     ///< a full search is to be measured again
    no_list,   ///< one was to be made, and could not
    unlike
  };
  std::string why_full() const;
  Way choose(const Chain& chain, const Moved& moved);
  double least_ms(double runs);
  std::optional<Way> take_shift(const Moved& moved, const Chain& chain);
  std::optional<Way> choose_shift(const Chain& chain);
  std::int64_t farthest_shift(const Chain& chain) const;
  Way go_shifted(std::int64_t s);
  std::optional<Way> choose_list(const Chain& chain);
  bool comparable(const Chain& chain) const;
  bool can_shift(const Chain& chain) const;
  bool take(const Moved& moved, std::uint32_t n);
  void remember(const Chain& chain);
  void forget() { answered_ = false; }
  bool search(const Chain& chain, const Request& request, Collisions& result, const FullSearch& here,
              const FullSearch& search, double build_ms);
  bool search_all(const Chain& chain, const Request& request, Collisions& result, const FullSearch& full,
                  double build_ms, bool keep);
  bool search_by_list(const Chain& chain, const Request& request, Collisions& result,
                      const FullSearch& search);
  bool search_changes(const Chain& chain, const Request& request, Collisions& result,
                      const FullSearch& search);
  void settle(double ms);
  void heed_full_search();
  bool worth_keeping(const Request& request) const;
  bool knows_plain(const Request& request) const;
  void learn_plain(const Request& request);

  const Omissions omissions_;
  const bool always_;
  Way way_ = Way::full;
  bool frames_ = false;    ///< more than one frame, or others are expected
  bool answered_ = false;  ///< row_ and answer_ are those of the last frame that was searched
  bool behind_ = false;    ///< an update since was not searched
  bool updated_ = false;   ///< the last frame is not a first one
  std::uint64_t most_pairs_ = std::uint64_t{1} << 26;
  bool crowded_ = false;  ///< the last frame that was counted had more
  bool in_vain_ = false;  ///< pairs of this frame were looked for to be kept, and were more
  Why why_ = Why::unlike;
  bool can_shift_ = false, can_keep_ = false;  ///< frames of the last chain, by its rule
  MovingRow row_;
  FrameAnswer answer_;
  std::vector<std::uint32_t> places_;  ///< of its pairs that are searched again
  std::vector<Pair> fresh_;            ///< what that found
  std::uint64_t topology_ = 0;
  std::uint32_t window_ = 0;  ///< of a chain whose only rule it is; 0: another rule
  std::vector<SphereRange> ranges_;
  std::uint64_t moved_ = 0;  ///< spheres of ranges_
  std::int64_t shift_ = 0;
  std::unique_ptr<KeptList> list_;
  ListPolicy policy_;
  bool by_list_ = false;              ///< answer_ is as the list's last find left it
  double holds_ms_ = 0;               ///< what it took to see that the list holds
  double move_ = 0;                   ///< of a frame, at most
  double radius_ = 0;                 ///< of spheres, about
  double skin_ = 0, inner_skin_ = 0;  ///< wanted of the next list
  TrialAccount looks_, lists_;        ///< of looking for what frames have in common; of kept lists
  double beside_ms_ = 0;              ///< the full search that lists are held against
  unsigned doubt_ = 0;  ///< frames since the last full search that took about as long as that was thought to
  double update_ms_ = 0;              ///< of this frame
  Learned run_, cell_sphere_{4e-6};   ///< of a run that changed, by the tree; of any sphere, by cells
  bool by_cells_ = false;             ///< the next such search; then, the last one
  double full_ms_ = 0, find_ms_ = 0;  ///< of the last full search; of this frame's
  double plain_ms_ = 0;               ///< of a full search for what is asked alone, that leaves nothing
  Request::Want plain_want_{};        ///< what that was
  bool made_ = false;                 ///< a list was, of this frame
  std::size_t compared_ = 0;          ///< of this frame: runs that changed, or near pairs
};

}  // namespace catena
