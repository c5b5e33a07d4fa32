#include "catena/bench/enumerate/published.h"

#include <algorithm>

namespace catena::bench {

std::span<const PublishedTable> published_tables() {
  // Copied from the entries at oeis.org as they stood in 2025.
  static const std::vector<PublishedTable> tables{
      {2, WalkTable::self_avoiding, "A001411", "", {1,        4,        12,       36,        100,
                                                    284,      780,      2172,     5916,      16268,
                                                    44100,    120292,   324932,   881500,    2374444,
                                                    6416596,  17245332, 46466676, 124658732, 335116620,
                                                    897697164}},
      {2, WalkTable::contact_free, "A173380", "", {1,        4,        12,      28,     68,      164,
                                                   396,      940,      2244,    5324,   12668,   29940,
                                                   71012,    167468,   396172,  932628, 2201636, 5175268,
                                                   12195660, 28632804, 67374292}},
      {2, WalkTable::contacts, "A336492", "", {0,         0,         0,         8,        32,       152,
                                               512,       1880,      5920,      19464,    59168,    183776,
                                               545392,    1638400,   4778000,   14043224, 40422544, 116977176,
                                               333346928, 953538440, 2695689520}},
      {3,
       WalkTable::self_avoiding,
       "A001412",
       "",
       {1, 6, 30, 150, 726, 3534, 16926, 81390, 387966, 1853886, 8809878, 41934150, 198842742, 943974510,
        4468911678, 21175146054, 100121875974}},
      {3,
       WalkTable::contact_free,
       "A174319",
       "Fisher and Hiley (1961) print 2674926 for 10 steps",
       {1,
        6,
        30,
        126,
        534,
        2214,
        9246,
        38142,
        157974,
        649086,
        2675022,
        10966470,
        45054630,
        184400910,
        755930958,
        3089851782,
        12645783414,
        51635728518,
        211059485310,
        861083848998,
        3516072837894,
        14334995983614,
        58485689950254}}};
  return tables;
}

const PublishedTable* published_table(int dimensions, WalkTable counts) {
  const auto tables = published_tables();
  const auto found = std::ranges::find_if(
      tables, [&](const PublishedTable& t) { return t.dimensions == dimensions && t.counts == counts; });
  return found == tables.end() ? nullptr : &*found;
}

}  // namespace catena::bench
