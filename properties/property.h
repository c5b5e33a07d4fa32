#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "catena/core/chain/chain.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/strategy/variant.h"
#include "catena/reference/answer.h"

namespace catena::properties {

/// One chain under test with its exact answer, found once and shared by every property and variant.
class Case {
 public:
  Case(Chain of, reference::Answer answer);  ///< `answer` with pairs
  /// Finds the exact answer. Throws PairLimitExceeded past 2^24 pairs.
  static Case of(Chain chain);

  const Chain chain;
  const reference::Answer exact;
  const std::uint64_t number;  ///< no other case of this program has it
};

/// What a property derives from a case, once for all variants that are asked.
template <class Value>
class DerivedFrom {
 public:
  template <class Make>
  const Value& operator()(const Case& test, const Make& make) {
    if (!value_ || number_ != test.number) value_.emplace(make()), number_ = test.number;
    return *value_;
  }

 private:
  std::optional<Value> value_;
  std::uint64_t number_ = 0;
};

/// One variant under test. Properties that need two objects make a second one.
struct Subject {
  VariantInfo info;
  std::function<std::unique_ptr<Variant>()> make;

  /// Its answer must be exactly right. The others are rounded: they may miss and invent pairs, and a property about
  /// the pair set does not apply to them.
  bool exact() const { return info.exact; }

  static Subject of(VariantInfo info);
  static Subject named(const std::string& variant);  ///< throws InputError like StrategyRegistry::describe
  static std::vector<Subject> available(bool with_mutants = false);
};

/// One statement that holds for every valid chain and every variant it applies to. Stateless but for scratch
/// memory.
class Property {
 public:
  virtual ~Property() = default;
  virtual std::string name() const = 0;
  virtual bool applies_to(const Subject&) const { return true; }
  /// True for what fuzzing asks of every chain; the other properties take turns.
  virtual bool every_chain() const { return false; }
  /// nullopt when it holds, else what is wrong in one line. `variant` is an object of the subject that may
  /// have run before on other chains; CapacityError may pass: the caller counts it as a refusal within
  /// declared limits.
  virtual std::optional<std::string> check(const Subject& subject, Variant& variant, const Case& test) = 0;
};

/// All properties, self-registered: a property is one file in properties/.
class PropertyRegistry {
 public:
  using Make = std::function<std::unique_ptr<Property>()>;
  static PropertyRegistry& instance();
  void add(Make make) { makers_.push_back(std::move(make)); }
  std::vector<std::unique_ptr<Property>> make_all() const;  ///< sorted by name

 private:
  std::vector<Make> makers_;
};

/// One object of this at namespace scope registers a property class.
template <class P>
struct RegisterProperty {
  RegisterProperty() {
    PropertyRegistry::instance().add([] { return std::make_unique<P>(); });
  }
};

}  // namespace catena::properties
