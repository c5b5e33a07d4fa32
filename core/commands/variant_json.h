#pragma once
#include <nlohmann/json.hpp>

#include "catena/core/strategy/variant_info.h"

namespace catena {

/// What is known of a variant, for programs that must not take its name apart: the run file's `variants` and
/// `catena list --json`.
/// stages: of each {text, strategy, algorithm, on_host (a host twin), settings: {key: value}, place: "host"
/// or "device"}; arithmetic, exact, has_tree, all_pairs, peer, on_device; hidden: only of a mutant, true.
nlohmann::ordered_json to_json(const VariantInfo& info);

}  // namespace catena
