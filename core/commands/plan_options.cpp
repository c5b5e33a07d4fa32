#include "catena/core/commands/plan_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catena/core/commands/command_line.h"
#include "catena/core/error.h"
#include "catena/core/plan/omissions.h"

namespace catena {

void WantOptions::add_to(OptionParser& app) {
  app.add_flag("--counts-only", counts_only_, "Find counts, keep no pairs");
  app.add_flag("--any", any_only_, "Only whether anything collides");
}

Request::Want WantOptions::want() const {
  if (any_only_ && counts_only_)
    throw InputError("--any finds neither counts nor pairs; leave out --counts-only, --counts and --pairs");
  return any_only_ ? Request::Want::any : counts_only_ ? Request::Want::counts : Request::Want::pairs;
}

void NoOmitOption::add_to(OptionParser& app) {
  app.add_option("--no-omit", names_, "Do what auto would leave out; may be given several times")
      .type_name("NAME")
      .allow_extra_args(false)
      .one_of(omission_names());
}

std::string NoOmitOption::variant() const {
  return given() ? fmt::format("auto(keep={})", fmt::join(names_, "+")) : "auto";
}

std::string NoOmitOption::variant_that_times_planning() const {
  return fmt::format("auto(planning=timed{})",
                     given() ? fmt::format(",keep={}", fmt::join(names_, "+")) : "");
}

}  // namespace catena
