#include "output/erosion_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "model/topology.hpp"

namespace abut::output {

void ErosionWatch::begin(const cycle::Snapshot& first) {
  parts_.resize(first.model->parts.size());
  for (Part& part : parts_) part.elements = 0;
  for (const auto& g : first.groups) parts_[static_cast<std::size_t>(g->part())].elements += g->size();
}

void ErosionWatch::cycle(const cycle::Snapshot& now) {
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    if (now.parts[p].eroded != parts_[p].gone) say(now, p);
  }
}

void ErosionWatch::persist(state::Archive& a) {
  a.each_growing(parts_, [&a](Part& part) {
    a(part.gone);
    a(part.finding);
    a(part.first);
  });
}

Id ErosionWatch::first_deleted(const cycle::Snapshot& now, std::size_t part) {
  Id first = 0;
  for (const auto& g : now.groups) {
    for (Index e = 0; g->part() == static_cast<Index>(part) && e < g->size(); ++e) {
      if (g->active(e)) continue;
      const Id id = model::element_id(*now.model, {g->kind(), g->elements()[static_cast<std::size_t>(e)]});
      first = first == 0 ? id : std::min(first, id);
    }
  }
  return first;
}

void ErosionWatch::say(const cycle::Snapshot& now, std::size_t p) {
  Part& part = parts_[p];
  part.gone = now.parts[p].eroded;
  const Id id = now.model->parts[p].id;
  const auto add = [&](const char* code, std::string text) {
    log_->push_back({{Severity::warning, code, {}, std::move(text)}, 0, now.state->times.t, now.state->times.cycle, 0.0, {}, {}});
  };
  if (part.finding == no_index) {
    part.finding = static_cast<Index>(log_->size());
    part.first = first_deleted(now, p);
    add(deleted, {});
  }
  RunFinding& f = (*log_)[static_cast<std::size_t>(part.finding)];
  f.measure = part.gone;
  f.diagnostic.message =
      fmt::format("from time {:.6g} (cycle {}) on: {} of {} elements of part {} are deleted, the first is element {}. [{}]", f.time,
                  f.cycle, part.gone, part.elements, id, part.first, deleted);
  if (part.gone < part.elements) return;
  const bool nothing_left = std::all_of(parts_.begin(), parts_.end(), [](const Part& q) { return q.gone >= q.elements; });
  add("run.part_deleted",
      fmt::format("at time {:.6g} (cycle {}): the last element of part {} is deleted, {}. [run.part_deleted]", now.state->times.t,
                  now.state->times.cycle, id,
                  nothing_left ? "and with it the last one of the model: from here on masses fly without forces between them"
                               : "its masses fly on without forces between them"));
  log_->back().measure = part.gone;
}

}  // namespace abut::output
