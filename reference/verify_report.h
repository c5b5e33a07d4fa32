#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catena/core/strategy/variant_info.h"
#include "catena/reference/verify.h"

namespace catena::reference {

/// What `catena verify` says of a variant, or a peer, on one frame of one input.
struct VerifyRow {
  std::string input;
  std::uint32_t frame;
  std::uint32_t spheres;
  std::uint64_t exact_pairs;
  const VariantInfo& variant;
  Verification result;
};

/// One JSON object a line, as the rows come; or for people: what is wrong as it comes, and at the end first
/// whether every exact variant is exact, of which it is not decided, then by arithmetic what each input gave,
/// variants of one answer in one line, and what was not asked.
class VerifyReport {
 public:
  explicit VerifyReport(bool json) : json_(json) {}
  void row(const VerifyRow& row);
  void finish() const;
  bool anything_wrong() const { return verdicts_.contains(Verdict::wrong); }
  std::uint64_t undecided() const {
    return verdicts_.contains(Verdict::undecided) ? verdicts_.at(Verdict::undecided) : 0;
  }

  using Figures = std::array<std::string, 4>;  ///< pairs, missing, invented, unenclosed, as printed

 private:
  /// Variants of one arithmetic that gave the same on an input.
  struct Line {
    std::string input;
    Figures figures;
    std::string verdict;
    std::vector<std::string> variants;
  };
  /// Files by their name alone, so that a long path does not push the figures off the screen; the second of a
  /// name by its path.
  std::string label(const VerifyRow& row);
  void gather(const VerifyRow& row);
  static void json_row(const VerifyRow& row);
  void print_headline() const;

  void print_arithmetic(const std::string& arithmetic, const std::vector<Line>& lines) const;

  using Names = std::set<std::string>;
  bool json_;
  std::map<Verdict, std::uint64_t> verdicts_;
  std::map<std::string, std::vector<Line>> lines_;  ///< by arithmetic
  std::map<std::string, Names> variants_,
      absent_;                        ///< by arithmetic; by the reason why they are not available
  Names right_, faulty_, undecided_;  ///< exact variants, on some input
  Names inputs_;
  std::map<std::string, std::string> named_;  ///< the input that is shown by this name
};

}  // namespace catena::reference
