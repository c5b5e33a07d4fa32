#pragma once
#include "catena/properties/generators/dice.h"
#include "catena/properties/generators/draft.h"

namespace catena::properties {

void cut_into_strands(Draft&, Dice&);  ///< 1 to 5 strands, some of them empty or of one sphere, some closed
void close_the_strand(Draft&, Dice&);  ///< one closed strand
void widen_the_window(Draft&, Dice&);  ///< an index window above 1: small, about n/2 (cyclic), or beyond n
void measure_by_arc(Draft&, Dice&);    ///< an arc window: pi/2, a random one, or one that reaches everything
void add_joints(Draft&, Dice&);        ///< extra pairs, some given twice or the other way round

/// One of the above, or several.
void change_rule(Draft&, Dice&);

}  // namespace catena::properties
