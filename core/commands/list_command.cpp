#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "catena/core/commands/command.h"
#include "catena/core/commands/json_line.h"
#include "catena/core/commands/variant_json.h"
#include "catena/core/readers/reader.h"
#include "catena/core/scenes/scene.h"
#include "catena/core/scenes/setup.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/writers/writer.h"

namespace catena {
namespace {

/// `catena list`: variants, scenes and readers; what is not available here, and why.
class ListCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_flag("--json", json_, "One JSON object, in one line");
  }

  int run() override {
    json_ ? print_json() : print_text();
    return 0;
  }

 private:
  static void print_parameters(const std::vector<ParameterInfo>& parameters) {
    for (const auto& p : parameters) fmt::print("      {}={}  {}\n", p.name, p.default_value, p.meaning);
  }

  /// Those that are not common to all, as they stand there.
  static std::vector<ParameterInfo> own(std::vector<ParameterInfo> parameters,
                                        const std::vector<ParameterInfo>& common) {
    const auto same = [](const ParameterInfo& a, const ParameterInfo& b) {
      return a.name == b.name && a.default_value == b.default_value && a.meaning == b.meaning;
    };
    std::erase_if(parameters, [&](const ParameterInfo& p) {
      return std::ranges::any_of(common, [&](const ParameterInfo& c) { return same(p, c); });
    });
    return parameters;
  }

  /// Exact, and says what it left out; asked of the variant itself.
  static bool gives_evidence(const VariantInfo& v) {
    if (!v.exact || v.unavailable) return false;
    try {
      return StrategyRegistry::instance().make(v.name)->evidence() != Accounting::none;
    } catch (const std::exception&) {
      return false;  // it cannot be made here, as who runs it is told
    }
  }

  static void print_text() {
    const auto& strategies = StrategyRegistry::instance();
    fmt::print(
        "Strategies (construction+traversal, or one complete in itself; parameters as in name(key=value))\n");
    for (const auto& name : strategies.strategy_names()) {
      const auto& info = strategies.strategy(name);
      fmt::print("  {:<12} {}\n", name, info.summary);
      print_parameters(info.parameters);
    }
    fmt::print(
        "\nVariants (robust arithmetic unless /literal or /double is written; evidence: `verify --certify` "
        "proves "
        "the answer by it)\n");
    for (const auto& v : strategies.variants())
      if (v.unavailable)
        fmt::print("  {:<30} not available: {}\n", v.name, *v.unavailable);
      else if (gives_evidence(v))
        fmt::print("  {:<30} evidence\n", v.name);
      else
        fmt::print("  {}\n", v.name);
    fmt::print("\nScenes (name:key=value,...); every scene takes\n");
    const auto& common = SceneSetup::declared();
    print_parameters(common);
    fmt::print("      frame=F  this frame alone, of one that moves\n  and, or with another default,\n");
    for (const auto& scene : SceneRegistry::instance().scenes()) {
      fmt::print("  {:<13} {}\n", scene.name, scene.summary);
      if (!scene.strains.empty()) fmt::print("      hard because {}\n", scene.strains);
      print_parameters(own(scene.parameters, common));
    }
    fmt::print("\nReaders (by file extension)\n");
    for (const auto& reader : ReaderRegistry::instance().readers())
      fmt::print("  {:<12} {}: {}; labels: {}\n", fmt::to_string(fmt::join(reader.extensions, " ")),
                 reader.name, reader.summary, reader.label);
    fmt::print("\nWriters (catena export)\n");
    for (const auto& writer : WriterRegistry::instance().writers())
      fmt::print("  {:<12} {}: {}\n", fmt::to_string(fmt::join(writer.extensions, " ")), writer.name,
                 writer.summary);
  }

  static nlohmann::json to_json(const std::vector<ParameterInfo>& parameters) {
    auto list = nlohmann::json::array();
    for (const auto& p : parameters)
      list.push_back({{"name", p.name}, {"default", p.default_value}, {"meaning", p.meaning}});
    return list;
  }

  static void print_json() {
    nlohmann::json out;
    const auto& strategies = StrategyRegistry::instance();
    for (const auto& name : strategies.strategy_names()) {
      const auto& info = strategies.strategy(name);
      out["strategies"].push_back(
          {{"name", name}, {"summary", info.summary}, {"parameters", to_json(info.parameters)}});
    }
    for (const auto& v : strategies.variants()) {
      nlohmann::json item(catena::to_json(v));
      item["name"] = v.name;
      item["device"] = v.on_device();
      item["evidence"] = gives_evidence(v);
      item["unavailable"] = v.unavailable ? nlohmann::json(*v.unavailable) : nlohmann::json();
      out["variants"].push_back(item);
    }
    for (const auto& s : SceneRegistry::instance().scenes())
      out["scenes"].push_back({{"name", s.name},
                               {"summary", s.summary},
                               {"strains", s.strains},
                               {"settings", s.settings},
                               {"parameters", to_json(s.parameters)}});
    for (const auto& r : ReaderRegistry::instance().readers())
      out["readers"].push_back({{"name", r.name},
                                {"extensions", r.extensions},
                                {"summary", r.summary},
                                {"label", r.label},
                                {"options", r.options}});
    for (const auto& w : WriterRegistry::instance().writers())
      out["writers"].push_back({{"name", w.name}, {"extensions", w.extensions}, {"summary", w.summary}});
    fmt::print("{}\n", json_line(out));
  }

  bool json_ = false;
};

const RegisterCommand<ListCommand> registered(
    "list", "Variants, scenes and readers; what is not available here and why");

}  // namespace
}  // namespace catena
