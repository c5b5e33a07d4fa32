#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "catena/reference/verify.h"

namespace catena::reference {

/// One line of `catena verify`: a variant, or a peer, on one frame of one input.
struct VerifyRow {
  std::string input;
  std::uint32_t frame;
  std::uint32_t spheres;
  std::uint64_t exact_pairs;
  std::string variant;
  Verification result;
};

/// Prints rows as they come: a table with a summary, or one JSON object a line. Widths come from the names
/// that will be printed, so that nothing has to wait for the last row.
class VerifyReport {
 public:
  VerifyReport(bool json, const std::vector<std::string>& inputs, const std::vector<std::string>& variants);
  void row(const VerifyRow& row);
  void finish() const;
  bool anything_wrong() const { return verdicts_.contains(Verdict::wrong); }

 private:
  void table_row(const VerifyRow& row) const;
  void json_row(const VerifyRow& row) const;

  bool json_;
  std::size_t input_width_, variant_width_;
  std::map<Verdict, std::uint64_t> verdicts_;
};

}  // namespace catena::reference
