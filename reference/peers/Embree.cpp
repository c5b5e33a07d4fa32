#include "catena/reference/peers/peer.h"

#ifdef CATENA_HAS_PEER
#include <embree3/rtcore.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cfenv>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <type_traits>
#include <vector>

#include "catena/core/hierarchy/box.h"
#endif

// Embree, Intel's ray tracer, as it is used for collisions: spheres are user primitives of one dynamic scene,
// and rtcCollide holds the scene against itself. Its manual has two ways for what moves: boxes are refitted
// in a tree that took longer to build, or the tree is built again at low quality. It leaves out what is
// beyond 1.844e18, and Debian's build ends the program where a scene has no extent; so scenes are scaled to
// size 1, by a power of two, and points widened.
namespace catena::reference {
namespace {

const PeerInfo refit{.name = "Embree",
                     .summary = "Embree's rtcCollide: a wide tree of boxes, which an update refits",
                     .broad_phase = "binary32",
                     .source = "libembree-dev"};
const PeerInfo rebuild{
    .name = "EmbreeRebuild",
    .summary = "Embree's rtcCollide: a wide tree of boxes, built fast, and again by an update",
    .broad_phase = "binary32",
    .source = "libembree-dev"};

#ifdef CATENA_HAS_PEER

struct Release {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
/// As the program's own: while one lives, nothing is flushed to zero.
class UsualArithmetic {
 public:
  UsualArithmetic() { std::fegetenv(&before_), std::fesetenv(FE_DFL_ENV); }
  ~UsualArithmetic() { std::fesetenv(&before_); }
  UsualArithmetic(const UsualArithmetic&) = delete;
  UsualArithmetic& operator=(const UsualArithmetic&) = delete;

 private:
  std::fenv_t before_;
};
template <class Handle>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Release>;

/// `quality` says how Embree updates: RTC_BUILD_QUALITY_REFIT, or builds again.
template <RTCBuildQuality quality>
class Embree final : public Peer {
  static constexpr float least_extent = 0x1p-60f;  ///< outweighs what scaling rounds, and has a normal square

  void make(const ChainView& chain) override {
    on_one_core([&] {
      if (!device_) device_.reset(rtcNewDevice("set_affinity=0"));
      require();
      scene_.reset(rtcNewScene(device_.get()));
      rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
      rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_DYNAMIC);
      geometry_ = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
      rtcSetGeometryBuildQuality(geometry_, quality);
      rtcSetGeometryUserPrimitiveCount(geometry_, chain.size);
      rtcSetGeometryUserData(geometry_, this);
      rtcSetGeometryBoundsFunction(geometry_, bounds, nullptr);
      rtcAttachGeometry(scene_.get(), geometry_);
      rtcReleaseGeometry(geometry_);  // the scene's now
      commit(chain);
    });
  }

  void move(const ChainView& chain) override {
    on_one_core([&] { commit(chain); });
  }

  void offer(const ChainView&, const Candidates& candidates) override {
    Offered offered(candidates);
    on_one_core([&] { rtcCollide(scene_.get(), scene_.get(), collide, &offered); });
    require();
    offered.decide();
  }

  /// Embree's own `threads=1` would hold all of this process to one core for as long as its device lives.
  template <class Work>
  void on_one_core(const Work& work) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one_thread_.execute(work);
  }

  void commit(const ChainView& chain) {
    make_boxes(chain);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(scene_.get());
    require();
  }

  void require() const {
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE)
      throw CapacityError("Embree failed with its error " + std::to_string(error) +
                          (error == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory" : ""));
  }

  /// Embree computes with subnormal numbers flushed to zero, in callbacks too; so boxes are made before.
  void make_boxes(const ChainView& chain) {
    const double scale = scale_for(chain);
    // No centre is beyond the greatest float, so boxes cut there meet as before.
    const auto widened = [scale](float end, float side) {
      constexpr float greatest = std::numeric_limits<float>::max();
      const auto scaled = static_cast<float>(std::clamp(end, -greatest, greatest) * scale);
      return scaled + side * (std::fabs(scaled) * 0x1p-23f +
                              least_extent);  // also of a point: scaled up, it has no extent
    };
    boxes_.resize(chain.size);
    for (std::uint32_t i = 0; i < chain.size; ++i) {
      const Box box = Box::around(chain.spheres[i]);
      RTCBounds& to = boxes_[i];
      to.lower_x = widened(box.low[0], -1), to.upper_x = widened(box.high[0], +1);
      to.lower_y = widened(box.low[1], -1), to.upper_y = widened(box.high[1], +1);
      to.lower_z = widened(box.low[2], -1), to.upper_z = widened(box.high[2], +1);
    }
  }
  static void bounds(const RTCBoundsFunctionArguments* asked) {
    *asked->bounds_o = static_cast<const Embree*>(asked->geometryUserPtr)->boxes_[asked->primID];
  }
  static double scale_for(const ChainView& chain) {
    double greatest = 0;
    for (const Sphere& s : std::span(chain.spheres, chain.size))
      greatest = std::max({greatest, std::fabs(double{s.x}) + s.radius, std::fabs(double{s.y}) + s.radius,
                           std::fabs(double{s.z}) + s.radius});
    return greatest > 0 ? std::ldexp(1.0, -std::ilogb(greatest) - 1) : 1;
  }

  /// What Embree found, kept until there is enough to be worth the change of arithmetic.
  class Offered {
   public:
    explicit Offered(const Candidates& candidates) : candidates_(candidates) { pairs_.reserve(most); }

    /// A pair comes from both ends. Embree may call from several threads at once, by its manual.
    void take(std::span<const RTCCollision> collisions) {
      const std::lock_guard lock(mutex_);
      for (const RTCCollision& met : collisions)
        if (met.primID0 < met.primID1) pairs_.push_back({met.primID0, met.primID1});
      if (pairs_.size() >= most) decide();
    }
    void decide() {
      const UsualArithmetic usual;
      for (const Pair& pair : pairs_) {
        if (candidates_.enough()) break;
        candidates_(pair.i, pair.j);
      }
      pairs_.clear();
    }

   private:
    static constexpr std::size_t most = 4096;
    const Candidates& candidates_;
    std::vector<Pair> pairs_;
    std::mutex mutex_;
  };
  static void collide(void* to, RTCCollision* collisions, unsigned count) {
    static_cast<Offered*>(to)->take({collisions, count});
  }

  tbb::task_arena one_thread_{1};
  Owned<RTCDevice> device_;
  Owned<RTCScene> scene_;
  RTCGeometry geometry_ = nullptr;  ///< the scene's
  std::vector<RTCBounds> boxes_;
};

[[maybe_unused]] const RegisterPeer<Embree<RTC_BUILD_QUALITY_REFIT>> registered{refit};
[[maybe_unused]] const RegisterPeer<Embree<RTC_BUILD_QUALITY_LOW>> registered_rebuild{rebuild};
#else
[[maybe_unused]] const RegisterAbsentPeer registered{refit}, registered_rebuild{rebuild};
#endif

}  // namespace
}  // namespace catena::reference
