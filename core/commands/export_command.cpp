#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "catena/core/commands/command.h"
#include "catena/core/commands/frame_option.h"
#include "catena/core/commands/input_options.h"
#include "catena/core/commands/output_names.h"
#include "catena/core/commands/show_warnings.h"
#include "catena/core/counted.h"
#include "catena/core/error.h"
#include "catena/core/input/naming.h"
#include "catena/core/input/scene_input.h"
#include "catena/core/notice.h"
#include "catena/core/one_line.h"
#include "catena/core/output_file.h"
#include "catena/core/periodic/periodic.h"
#include "catena/core/readers/number_text.h"
#include "catena/core/strategy/registry.h"
#include "catena/core/thrown.h"
#include "catena/core/writers/writer.h"

namespace catena {
namespace {

/// Files that are whole together: when one fails, those before it that were not there are removed.
class Series {
 public:
  /// Throws InputError where one of several cannot be written, before any is: a folder is in its way, say.
  explicit Series(std::vector<std::string> names) : names_(std::move(names)) {
    namespace fs = std::filesystem;
    std::error_code unknown;
    for (const std::string& name : names_) {
      const fs::file_status was = fs::status(name, unknown);
      targets_.push_back(OutputFile::target(name));
      new_.push_back(!fs::exists(was));
      // What is neither file nor folder may wait to be read.
      if (names_.size() > 1 && (new_.back() || fs::is_regular_file(was) || fs::is_directory(was)))
        OutputFile probe(name);
    }
  }
  ~Series() {
    std::error_code gone;
    for (std::size_t k = 0; k < written_; ++k)
      if (new_[k]) std::filesystem::remove(targets_[k], gone);  // a link to it was there
  }
  Series(const Series&) = delete;
  Series& operator=(const Series&) = delete;

  template <class Write>
  void write(const Write& next) {
    next(names_[written_]);
    ++written_;
  }
  void complete() { written_ = 0; }

 private:
  std::vector<std::string> names_;
  std::vector<std::filesystem::path> targets_;
  std::vector<bool> new_;
  std::size_t written_ = 0;
};

/// `catena export INPUT OUT`: any input in any format that can hold it.
class ExportCommand final : public Command {
 public:
  void configure(OptionParser& app) override {
    app.add_option("INPUT", input_, "A scene (path1:n=150000,frame=3) or a file (neuron.swc)").required();
    app.add_option("OUT", out_, "The file to write: .chain, .catena, .csv, .vtp, .obj or .xyz").required();
    frame_.add_to(app);
    app.add_flag("--contacts", contacts_,
                 "Find the collisions, and write for each sphere what it collides with (.vtp)");
    app.add_option("--variant", variant_, "How to find them (default: aCPU2+CPU2); see catena list");
    add_input_options(app, options_);
    add_tolerance_option(app, options_);
  }

  int run() override {
    const auto& writer = WriterRegistry::instance().of(out_);
    if (contacts_ && !writer.info.contacts)
      throw InputError(fmt::format("{}: {} holds no contacts; export to .vtp, or use detect --pairs", out_,
                                   writer.info.name));
    if (!contacts_ && !variant_.empty())
      throw InputError("--variant finds what --contacts writes; add that, or leave it out");
    if (variant_.empty()) variant_ = "aCPU2+CPU2";
    if (contacts_) search_ = blaming(variant_, [&] { return StrategyRegistry::instance().make(variant_); });
    const Input input = open_input(input_, options_);
    show_warnings(input);
    if (contacts_) periodic_ = put_into_boxes(search_, input.boxes);
    const auto frames = frame_.of(input);
    const std::uint32_t first = frames.first, last = frames.second;
    first_frame_ = written_frame(input_);
    const bool one_file = writer.info.frames || last - first == 1;
    std::vector<std::string> names{out_};
    if (!one_file) {
      names.clear();
      for (std::uint32_t f = first; f < last; ++f) names.push_back(name_of(f));
    }
    for (const std::string& name : names) require_apart(input_, options_.reading, {name});
    say_losses(writer.info, input.animation->frame(first), input);
    const auto frame = [&](std::uint32_t f) { return exported(input, f, f == first); };
    Series series(names);
    for (std::uint32_t f = first; f < last; ++f) {
      series.write([&](const std::string& name) {
        writer.write(name, {f, one_file ? last : f + 1, frame, input.labels, input.joints, input.boxes});
      });
      if (one_file) break;
    }
    series.complete();
    const std::string written = one_file ? out_ : fmt::format("{} ... {}", names.front(), names.back());
    fmt::print("{}: {} of {} as {}\n", one_line(written), counted(last - first, "frame"),
               counted(input.animation->frame(first).size(), "sphere"), writer.info.name);
    return 0;
  }

 private:
  ExportedFrame exported(const Input& input, std::uint32_t f, bool first) {
    ExportedFrame frame{input.animation->frame(f)};
    // What holds all frames is read back with the neighbours of its first.
    if (first || !WriterRegistry::instance().of(out_).info.frames) say_lost_arcs(frame.chain);
    if (!search_) return frame;
    frame.box = box_of(input.boxes, f);
    go_to_frame(periodic_, input.boxes, f);
    naming(fmt::format("{} frame {}", input_, first_frame_ + f), [&] {
      blaming(variant_, [&] {
        if (first) search_->prepare({});
        first ? search_->build(frame.chain) : search_->update(frame.chain);
        search_->find(frame.chain, {}, found_);
      });
    });
    frame.found = &found_;
    return frame;
  }

  /// out.vtp as out_3.vtp: the numbered series that ParaView opens as one.
  std::string name_of(std::uint32_t frame) const {
    const std::filesystem::path out(out_);
    return (out.parent_path() /
            fmt::format("{}_{}{}", out.stem().string(), first_frame_ + frame, out.extension().string()))
        .string();
  }

  /// More than numbers, in place of which catena's own do.
  static bool has_names(const Labels& labels) {
    bool numbers = std::ranges::all_of(labels.strand_names, is_integer);
    for (std::uint32_t i = 0; i < labels.size() && numbers; ++i) numbers = is_integer(labels.of(i));
    return !numbers;
  }

  void say_losses(const WriterInfo& info, const Chain& chain, const Input& input) const {
    const auto say = [&](const char* what) {
      notice("catena", fmt::format("{}: {} holds no {}", out_, info.name, what));
    };
    if (!info.radii) say("radii; give them with --radius when it is read");
    const Exclusion& rule = chain.exclusion();
    if (!info.rule && (rule.rule != Exclusion::Rule::index_window || rule.window != 1))
      say("exclusion rule; give it with --window or --arc-window when it is read");
    if (!info.rule && !rule.extra_pairs.empty()) say("neighbours across joints; .chain does");
    if (info.rule && !info.joints && !input.joints.empty())
      say("joints, across which another --window or --arc-window finds neighbours; .chain does");
    if (!info.labels && has_names(input.labels)) say("labels, nor names of strands; export to .csv");
    if (info.lines) say_lost_strands(info, chain);
    if (!info.box && !input.boxes.empty()) say("box; give it with --box when it is read, or export to .xyz");
  }

  /// Of lines between points only their ends tell where a strand begins.
  void say_lost_strands(const WriterInfo& info, const Chain& chain) const {
    const auto& [first, closed] = chain.strands();
    bool any_closed = false, open_behind = false, small = false;
    for (std::uint32_t s = 0; s < chain.strand_count(); ++s) {
      const std::uint32_t size = first[s + 1] - first[s];
      open_behind |= any_closed && !closed[s] && size > 0;
      any_closed |= closed[s] != 0 && size > 0;
      small |= closed[s] != 0 && size > 0 && size < 3;
    }
    if (small)
      notice("catena", fmt::format("{}: {} holds no closed strand of one or two spheres; it is read as open",
                                   out_, info.name));
    if (open_behind)
      notice("catena",
             fmt::format(
                 "{}: {} holds no order of strands: closed ones are read after open ones, and their spheres "
                 "have other numbers then; .chain and .csv keep them",
                 out_, info.name));
  }

  /// No format has arc lengths but those of the spheres in it; frames keep those of frame 0, and a thinned
  /// chain those of the whole. Once, of the first frame whose neighbours may be others when it is read.
  void say_lost_arcs(const Chain& chain) {
    const ExclusionView view = chain.view().exclusion;
    if (said_arcs_ || view.rule != Exclusion::Rule::arc_window) return;
    const Chain read({chain.spheres().begin(), chain.spheres().end()}, chain.strands(), chain.exclusion());
    const ExclusionView then = read.view().exclusion;
    if (std::equal(view.arc, view.arc + chain.size(), then.arc) &&
        std::equal(view.loop_length, view.loop_length + chain.strand_count(), then.loop_length))
      return;
    said_arcs_ = true;
    notice("catena", fmt::format("{}: {} holds no arc lengths of another frame, nor of spheres left out; who "
                                 "are neighbours is measured anew when it is read",
                                 out_, WriterRegistry::instance().of(out_).info.name));
  }

  std::string input_, out_, variant_;
  FrameOption frame_;
  InputOptions options_{.takes_box = true};
  bool contacts_ = false, said_arcs_ = false;
  std::uint32_t first_frame_ = 0;  ///< of the scene, where the input is one frame of it
  std::unique_ptr<Variant> search_;
  Periodic* periodic_ = nullptr;  ///< search_, where a box repeats space
  Collisions found_;
};

const RegisterCommand<ExportCommand> registered(
    "export", "Write a scene or file as .chain, .catena, .csv, .vtp, .obj or .xyz");

}  // namespace
}  // namespace catena
