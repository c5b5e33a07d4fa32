#include "catena/reference/bounds/form.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace catena::reference {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool finite(const Vector64& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
bool has_nan(const Vector64& v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); }
/// Some real number lies between the two.
bool interval(double low, double high) { return low <= high && low < infinity && high > -infinity; }
bool whole_line(double low, double high) { return low == -infinity && high == infinity; }

struct Proper {
  bool operator()(const Everything&) const { return true; }
  bool operator()(const Sphere64& s) const { return (*this)(capsule(s)); }
  bool operator()(const Capsule64& c) const {
    if (has_nan(c.a) || has_nan(c.b)) return false;
    return c.radius == infinity || (c.radius >= 0 && finite(c.a) && finite(c.b));
  }
  bool operator()(const Box64& b) const {
    return interval(b.low.x, b.high.x) && interval(b.low.y, b.high.y) && interval(b.low.z, b.high.z);
  }
  bool operator()(const Slabs64& s) const {
    return finite(s.origin) && std::ranges::all_of(s.slabs, [](const Slab& slab) {
             return finite(slab.direction) && slab.direction != Vector64{0, 0, 0} &&
                    interval(slab.low, slab.high);
           });
  }
};

struct IsEverything {
  bool operator()(const Everything&) const { return true; }
  bool operator()(const Sphere64& s) const { return s.radius == infinity; }
  bool operator()(const Capsule64& c) const { return c.radius == infinity; }
  bool operator()(const Box64& b) const {
    return whole_line(b.low.x, b.high.x) && whole_line(b.low.y, b.high.y) && whole_line(b.low.z, b.high.z);
  }
  bool operator()(const Slabs64& s) const {
    return std::ranges::all_of(s.slabs, [](const Slab& slab) { return whole_line(slab.low, slab.high); });
  }
};

}  // namespace

bool proper(const AnyBound& bound) { return std::visit(Proper{}, bound); }
bool is_everything(const AnyBound& bound) { return std::visit(IsEverything{}, bound); }

}  // namespace catena::reference
