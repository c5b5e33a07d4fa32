#include "catena/core/policies/GPU2.h"

#include "catena/core/executor/host_traversal.h"
#include "catena/core/strategy/register.h"

namespace catena {
namespace {

/// GPU2 with its per-sphere visits run by the host executor.
template <class Arithmetic>
using GPU2OnHost = HostTraversal<Arithmetic, policy::GPU2>;

const RegisterTraversal<GPU2OnHost, Robust, Literal, Double> registered{
    {.name = "GPU2@host",
     .summary = "each sphere against the tree, explicit stack",
     .parameters = {HostExecutor::threads_parameter()},
     .promises = {.same_order = true}}};

}  // namespace
}  // namespace catena
