#pragma once
#include <string>
#include <vector>

#include "catena/core/thrown.h"

namespace catena::reports {

/// Variants that failed while a report was measured, which goes on without them: what is wrong, in one line
/// that names the variant. Said on standard error at once, each line once.
void note_fault(const std::string& what);
const std::vector<std::string>& noted_faults();

/// Runs `work` of a variant; false when it refuses the chain, and when it throws, which is noted as a fault.
template <class Work>
bool attempt(const std::string& variant, const Work& work) {
  try {
    blaming(variant, work);
    return true;
  } catch (const CapacityError&) {
  } catch (const VariantThrew& fault) {
    note_fault(fault.what());
  }
  return false;
}

}  // namespace catena::reports
