#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "catena/bench/timing/google/benchmarks.h"
#include "catena/core/commands/command_line.h"
#include "catena/core/commands/guarded_main.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/variant_json.h"
#include "catena/core/environment.h"
#include "catena/core/error.h"
#include "catena/core/input/input.h"
#include "catena/core/output_file.h"
#include "catena/core/readers/file_bytes.h"
#include "catena/core/scenes/scene.h"

namespace {

using namespace catena;

struct Options {
  bool flush_cache = false;
  InputOptions input{.takes_box = true};
  std::vector<std::string> scenes;
  std::vector<std::uint32_t> sizes{1000,    10'000,  20'000,    30'000,    40'000,    50'000,
                                   100'000, 150'000, 1'000'000, 3'000'000, 10'000'000};
};

void add_options(OptionParser& app, Options& options) {
  app.add_option("--scene", options.scenes, "Scene or file; repeatable (default: scenes that strain nothing)")
      .allow_extra_args(false);
  app.add_option("--n", options.sizes, "Spheres; repeatable").allow_extra_args(false);
  app.add_flag("--flush-cache", options.flush_cache, "Empty the device's cache before every sample");
  add_input_options(app, options.input);
}

/// Takes the options that are catena's own; what is left is Google Benchmark's.
std::vector<std::string> take_options(int argc, char** argv, Options& options) {
  auto rest =
      parse_known_options({argv + 1, argv + argc}, [&](OptionParser& app) { add_options(app, options); });
  rest.insert(rest.begin(), argv[0]);
  return rest;
}

/// Of both: Google Benchmark knows of its own alone.
void print_help() {
  Options options;
  fmt::print("{}\n", help_of("catena_bench", [&](OptionParser& app) { add_options(app, options); }));
  benchmark::PrintDefaultHelp();
}

std::string with_n(const std::string& scene, std::uint32_t n) {
  return fmt::format("{}{}n={}", scene, scene.find(':') == std::string::npos ? ':' : ',', n);
}

std::uint32_t size_of(const std::string& scene) { return open_input(scene).animation->frame(0).size(); }

/// Every input at every size: "yarn:seed=2" is measured at each, "yarn:n=500", "serpentine:side=6" and files
/// as they are.
std::vector<bench::WorkloadSpec> inputs(const Options& options) {
  std::vector<std::string> scenes = options.scenes;
  const auto& known = SceneRegistry::instance();
  if (scenes.empty())
    for (const auto& info : known.scenes())
      if (info.strains.empty()) scenes.push_back(info.name);
  std::vector<bench::WorkloadSpec> specs;
  for (const auto& scene : scenes) {
    const auto colon = scene.find(':');
    const bool sized = !known.contains(scene.substr(0, colon)) || scene.find(":n=") != std::string::npos ||
                       scene.find(",n=") != std::string::npos;
    if (sized || (colon != std::string::npos && size_of(with_n(scene, options.sizes[0])) != options.sizes[0]))
      specs.push_back({scene, false, options.input});
    else
      for (const std::uint32_t n : options.sizes) specs.push_back({with_n(scene, n), false, options.input});
  }
  return specs;
}

/// The value of Google Benchmark's own flag --NAME=VALUE, which it does not tell; empty without.
std::string flag(const std::vector<std::string>& rest, const std::string& name) {
  const std::string start = "--" + name + "=";
  std::string value;
  for (const auto& text : rest)
    if (text.starts_with(start)) value = text.substr(start.size());
  return value;
}

/// Adds to the JSON that Google Benchmark wrote what is known of each variant (reports/run_file.md), so that
/// `catena report` takes it for a run file. Its own context would show it on the console, 40 kB of it.
void describe_variants(const std::string& file, const std::vector<bench::Case>& cases) {
  nlohmann::ordered_json own{{"schema", 1}, {"profile", "custom"}};
  for (const auto& c : cases) own["variants"][c.variant.name] = to_json(c.variant);
  // As text: where a spread is none Google Benchmark writes NaN, which Python reads and a strict parser does
  // not.
  const std::string run = read_bytes(file);
  const auto end = run.find_last_of('}');
  if (end == std::string::npos) throw InputError(file + ": Google Benchmark wrote no JSON object");
  write_file(file, fmt::format("{},\n  \"catena\": {}\n}}\n",
                               std::string_view(run).substr(0, run.find_last_not_of(" \n", end - 1) + 1),
                               own.dump()));
}

int run(int argc, char** argv) {
  require_release_build();
  const auto facts = environment();
  Options options;
  auto rest = take_options(argc, argv, options);
  std::vector<char*> pointers;
  for (auto& text : rest) pointers.push_back(text.data());
  int count = static_cast<int>(pointers.size());
  for (const auto& [key, value] : facts) benchmark::AddCustomContext(key, value);
  benchmark::AddCustomContext("device cache", options.flush_cache ? "flushed before every sample" : "warm");
  const auto cases = bench::cases(inputs(options), StrategyRegistry::instance().variants());
  for (const auto& c : cases)
    bench::register_benchmark(c, std::make_shared<bench::Trial>(c.spec, c.variant, options.flush_cache));
  benchmark::Initialize(&count, pointers.data(), print_help);
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  const bool measured = benchmark::RunSpecifiedBenchmarks() > 0;  // it says so itself where none matched
  benchmark::Shutdown();
  if (!measured) return 2;
  const std::string file = flag(rest, "benchmark_out"), format = flag(rest, "benchmark_out_format");
  if (!file.empty() && (format.empty() || format == "json")) describe_variants(file, cases);
  return 0;
}

}  // namespace

/// catena_bench: Google Benchmark's own options and JSON; --benchmark_filter picks by scene/n/variant/stage.
int main(int argc, char** argv) {
  return catena::guarded_main("catena_bench", [&] { return run(argc, argv); });
}
