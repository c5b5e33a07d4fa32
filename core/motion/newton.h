#pragma once
#include <Eigen/SparseCholesky>

#include "catena/core/motion/derivatives.h"

namespace catena::motion {

/// A function to be minimised.
class Objective {
 public:
  virtual ~Objective() = default;
  virtual double value(const Coordinates& x) const = 0;
  virtual void derivatives(const Coordinates& x, Derivatives& out) const = 0;
};

/// Newton's method, in full steps; where those do not converge, once more from the start with a line search.
/// Full steps first, because they follow a stiff valley that bends, along which a search that wants every
/// step lower can only creep. Where the Hessian is not positive definite a multiple of the identity is added.
/// Buffers and the symbolic factor are kept from call to call.
class Newton {
 public:
  /// Moves `x` to a minimum, until no coordinate moves by more than `tolerance`: the gain of that step being
  /// quadratic, what remains is rounding. False when it did not get there, in 200 full steps and then 200
  /// others, or a value was not finite. O(n + contacts) a step for a chain.
  bool minimise(const Objective& objective, Coordinates& x, double tolerance);

 private:
  bool full_steps(const Objective& objective, Coordinates& x, double tolerance);
  bool descend(const Objective& objective, Coordinates& x, double tolerance);
  bool direction(Coordinates& down);  ///< solves for -gradient; false when no shift helps

  Derivatives derivatives_;
  Eigen::SparseMatrix<double> hessian_;
  std::vector<int> outer_, inner_;  // the pattern that cholesky_ was analysed for
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky_;
};

}  // namespace catena::motion
