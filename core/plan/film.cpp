#include "catena/core/plan/film.h"

#include "catena/core/strategy/keeps_answer.h"
#include "catena/core/strategy/registry.h"

namespace catena {

Film::Film(Request::Want want)
    : request_{.want = want, .frames_follow = true},
      variant_(StrategyRegistry::instance().make("auto")),
      keeper_(&dynamic_cast<KeepsAnswer&>(*variant_)) {
  variant_->prepare(request_);
}

Film::~Film() = default;
Film::Film(Film&&) noexcept = default;
Film& Film::operator=(Film&&) noexcept = default;

const Collisions& Film::next(const Chain& chain, const Moved& moved) {
  begun_ ? variant_->update(chain, moved) : variant_->build(chain);
  begun_ = true;
  return keeper_->find_kept(chain, request_);
}

}  // namespace catena
