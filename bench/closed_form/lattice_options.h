#pragma once
#include "catena/bench/closed_form/lattice_box.h"
#include "catena/core/commands/command_line.h"

namespace catena::bench {

/// What a command asks about a lattice whose pairs a formula knows, and about its answer.
struct LatticeOptions {
  LatticeBox box;
  bool counts_only = false, json = false;

  void add_to(OptionParser& app, int greatest_side) {
    app.add_option("--side", box.side, "Points along each of three axes; side^3 spheres")
        .range(1, greatest_side)
        .capture_default_str();
    app.add_option("--reach", box.reach, "Spheres of points so many steps apart touch exactly")
        .range(0, 1000)
        .capture_default_str();
    app.add_flag("--face-centred", box.face_centred, "The face-centred lattice instead of the cubic one");
    app.add_flag("--rods", box.rods, "A bundle: each row a strand of its own");
    app.add_flag("--counts-only", counts_only, "Compare counts, keep no pairs");
    app.add_flag("--json", json, "One JSON object");
  }

  Request request() const {
    return {.want = counts_only ? Request::Want::counts : Request::Want::pairs};
  }
};

}  // namespace catena::bench
