#include "init/same_pair.hpp"

#include <algorithm>
#include <iterator>

namespace abut::init {
namespace {

bool at_once(const model::Interface& a, const model::Interface& b) {
  return a.sensor == b.sensor && a.t_start < b.t_stop && b.t_start < a.t_stop;
}

}  // namespace

SamePairs::Side SamePairs::side(Index surface) const {
  Side out;
  for (const model::Segment& s : model_->surfaces[static_cast<std::size_t>(surface)].segments) {
    out.push_back(s.nodes);
    std::sort(out.back().begin(), out.back().end());
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<const model::Interface*> SamePairs::add(const model::Interface& card) {
  Pair pair{card.type.index(), {}};
  if (const auto* t3 = std::get_if<model::InterfaceType3>(&card.type)) {
    pair.second = {side(t3->surface_1), side(t3->surface_2)};
    std::sort(pair.second.begin(), pair.second.end());
  } else {
    const auto set = [&](const auto& one_pass) {
      for (const Index n : one_pass.nodes) pair.second[0].push_back({n, n, n, n});
      std::sort(pair.second[0].begin(), pair.second[0].end());
      pair.second[1] = side(one_pass.surface);
    };
    if (const auto* t5 = std::get_if<model::InterfaceType5>(&card.type)) set(*t5);
    if (const auto* t7 = std::get_if<model::InterfaceType7>(&card.type)) set(*t7);
  }
  std::vector<const model::Interface*>& seen = seen_[std::move(pair)];
  std::vector<const model::Interface*> out;
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(out), [&](const model::Interface* other) { return at_once(*other, card); });
  seen.push_back(&card);
  return out;
}

}  // namespace abut::init
