#include "catena/core/motion/contact.h"

namespace catena::motion {

double ContactResponse::energy(const Coordinates& x, std::span<const Pair> pairs) const {
  double sum = 0;
  for (const Pair& p : pairs) {
    const double depth = reach - (node(x, p.j) - node(x, p.i)).norm();
    if (depth > 0) sum += depth * depth;
  }
  return stiffness / 2 * sum;
}

void ContactResponse::add_derivatives(const Coordinates& x, std::span<const Pair> pairs,
                                      Derivatives& out) const {
  for (const Pair& p : pairs) {
    const Eigen::Vector3d apart = node(x, p.j) - node(x, p.i);
    const double distance = apart.norm(), depth = reach - distance;
    if (depth <= 0 || distance == 0) continue;
    const Eigen::Vector3d t = apart / distance;
    const Eigen::Matrix3d along = t * t.transpose();
    const Eigen::Matrix3d h = stiffness * (along - depth / distance * (Eigen::Matrix3d::Identity() - along));
    out.add_gradient(p.i, stiffness * depth * t), out.add_gradient(p.j, -stiffness * depth * t);
    out.add_block(p.i, p.i, h), out.add_block(p.j, p.j, h), out.add_block(p.j, p.i, -h);
  }
}

}  // namespace catena::motion
