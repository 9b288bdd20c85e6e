#include "abut/contact/interface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "contact/enforce/both_sides.hpp"
#include "contact/enforce/one_sided.hpp"
#include "contact/record/recipe.hpp"
#include "contact/record/recorder.hpp"

namespace abut::contact {

namespace {

/// A surface as it was given, from the side that computes with it.
Recipe::Topology topology_of(const Side& side) {
  Recipe::Topology t;
  t.facets.resize(static_cast<std::size_t>(side.facet_count()));
  for (Index f = 0; f < side.facet_count(); ++f) { t.facets[static_cast<std::size_t>(side.listed(f))] = side.surface().facet(f); }
  t.order.assign(side.surface().nodes().begin(), side.surface().nodes().end());
  return t;
}

}  // namespace

/// The model that computes, and what is known about how it came to be.
struct Interface::Made {
  std::unique_ptr<InterfaceModel> model;
  Recipe recipe;  ///< without what the sides of the model know: surfaces, hosted nodes
  std::array<SurfaceFlags, 2> surfaces = {};
  std::uint64_t fingerprint = 0;
  std::size_t needed = 0;  ///< nodes that the host must have at least
  std::unique_ptr<Recorder> recorder = nullptr;
  enum class Stage { idle, searched, evaluated } stage = Stage::idle;
  /// Committed last; NaN after restore(), since the history does not say it.
  double last_step = 0.0;
  double ended = 0.0, step_before = 0.0;  ///< the step that ended when evaluate() was called last, and when it was committed
  std::array<Vec3, 8> searched = {};      ///< where the looked_at() nodes were in search()

  /// Node `k` of a few, spread over both sides; no_index: none.
  [[nodiscard]] Index looked_at(std::size_t k) const {
    const std::span<const Index> nodes = model->side(k % 2).nodes();
    return nodes.empty() ? no_index : nodes[(k / 2) * (nodes.size() - 1) / 3];
  }
  void keep_positions(std::span<const Vec3> x) {
    for (std::size_t k = 0; k < searched.size(); ++k) {
      if (const Index node = looked_at(k); node != no_index) searched[k] = x[static_cast<std::size_t>(node)];
    }
  }
  /// Forces are those of the pairs and positions that search() saw.
  void check_positions(std::span<const Vec3> x) const {
    for (std::size_t k = 0; k < searched.size(); ++k) {
      const Index node = looked_at(k);
      if (node == no_index || std::memcmp(&x[static_cast<std::size_t>(node)], &searched[k], sizeof(Vec3)) == 0) continue;
      throw std::logic_error("contact: evaluate() got other positions than search() in this step (node " + std::to_string(node) +
                             " has moved): search() comes first where nodes have moved");
    }
  }

  /// The recipe as it was before the model was made.
  [[nodiscard]] Recipe whole_recipe() const {
    Recipe r = recipe;
    for (std::size_t k = 0; k < 2; ++k) r.side[k] = topology_of(model->side(k));
    r.collect();
    return r;
  }
  /// What set_surface() was given last.
  [[nodiscard]] SurfaceValues values(std::size_t k) const {
    const SurfaceFlags& given = surfaces[k];
    SurfaceValues v{{}, {}, given.active, given.node_active};
    if (given.stiffness) v.stiffness = model->side(k).listed_stiffness();
    if (given.thickness) v.thickness = model->side(k).listed_thickness();
    return v;
  }
  /// The host's arrays reach to the last node of the interface.
  void check(std::size_t length, const char* what, bool may_be_empty = false) const {
    if (length >= needed || (length == 0 && may_be_empty)) return;
    throw std::invalid_argument("contact: " + std::string(what) + " has " + std::to_string(length) + " nodes, the interface needs " +
                                std::to_string(needed));
  }
  void check(const HostState& host) const {
    check(host.x.size(), "x");
    check(host.v.size(), "v");
    check(host.mass.size(), "mass", true);
    check(host.constrained.size(), "constrained", true);
    if (!std::isfinite(host.time)) throw std::invalid_argument("contact: time must be finite, not " + std::to_string(host.time));
    for (const double step : {host.dt, host.dt_bar_old}) {
      if (step >= 0.0 && std::isfinite(step)) continue;
      throw std::invalid_argument("contact: the step before (dt) must be a finite number >= 0, not " + std::to_string(step));
    }
    // no_index, which is -1, or below the number of entries: one comparison.
    const auto entries = static_cast<std::uint32_t>(host.mobility.size());
    const auto wrong = [entries](Index entry) { return static_cast<std::uint32_t>(entry) + 1U > entries; };
    std::uint32_t any = 0;
    for (const Index entry : host.constrained) any |= wrong(entry) ? 1U : 0U;
    if (any == 0) return;
    const Index entry = *std::find_if(host.constrained.begin(), host.constrained.end(), wrong);
    throw std::invalid_argument("contact: constrained names entry " + std::to_string(entry) + " of " +
                                std::to_string(host.mobility.size()));
  }
  /// Pairs have a stiffness, if only 0: what nobody gave would be no contact without a word.
  void check_stiffness() const {
    const auto given = [this](std::size_t k) { return surfaces[k].stiffness || model->side(k).nodes().empty(); };
    bool nodes = recipe.kind == Recipe::Kind::nodes_to_surface || given(0), facets = given(1);
    if (recipe.kind == Recipe::Kind::both_sides) {
      using Stiffness = BothSidesOptions::Stiffness;
      const Stiffness rule = recipe.both.stiffness;
      if (rule == Stiffness::facet) nodes = true;
      if (rule != Stiffness::facet && recipe.both.stiffness_min > 0.0) return;
      if ((rule == Stiffness::mean || rule == Stiffness::larger) && (nodes || facets)) return;
    }
    if (nodes && facets) return;
    const std::string side = nodes ? "1" : "0";
    throw std::logic_error("contact: side " + side + " has no stiffness: set_surface(" + side +
                           ", ...) gives it, before the first search()");
  }
  /// Steps that the host leaves 0 are those committed; where it says the last one alone, its step is constant.
  [[nodiscard]] HostState with_steps(HostState host) const {
    if (host.dt == 0.0 && std::isnan(last_step) && model->begun()) {
      throw std::logic_error("contact: after restore() the first step must say dt, the step that ended at its time: no history knows it");
    }
    if (host.dt == 0.0 && last_step > 0.0) {
      host.dt = last_step;
      if (host.dt_bar_old == 0.0) host.dt_bar_old = 0.5 * (last_step + step_before);
    }
    if (host.dt_bar_old == 0.0) host.dt_bar_old = host.dt;
    return host;
  }
  [[nodiscard]] std::vector<std::byte> history() const {
    HistoryWriter out(fingerprint);
    model->save(out);
    return out.finish();
  }
};

Interface::Interface(Made made) : made_(std::make_unique<Made>(std::move(made))) {
  Recipe& recipe = made_->recipe;
  recipe.collect();
  made_->fingerprint = recipe.fingerprint();
  made_->needed = recipe.hosted.empty() ? 0 : static_cast<std::size_t>(recipe.hosted.back()) + 1;
  // The sides know these, and few ask: whole_recipe().
  recipe.side = {};
  std::vector<Index>().swap(recipe.hosted);
}
Interface::~Interface() = default;
Interface::Interface(Interface&&) noexcept = default;
Interface& Interface::operator=(Interface&&) noexcept = default;

Interface Interface::two_surfaces(Surface first, Surface second, const Options& options) {
  Recipe recipe;
  recipe.side = {Recipe::Topology(first), Recipe::Topology(second)};
  recipe.options = options;
  return Interface(Made{std::make_unique<OneSided>(std::move(first), std::move(second), options), std::move(recipe)});
}

Interface Interface::nodes_to_surface(std::vector<Index> nodes, std::vector<double> node_stiffness, Surface surface,
                                      const Options& options) {
  Recipe recipe;
  recipe.kind = Recipe::Kind::nodes_to_surface;
  recipe.side[1] = Recipe::Topology(surface);
  recipe.nodes = nodes;
  recipe.node_stiffness = node_stiffness;
  recipe.options = options;
  return Interface(
      Made{std::make_unique<OneSided>(std::move(nodes), std::move(node_stiffness), std::move(surface), options), std::move(recipe)});
}

Interface Interface::both_sides(std::vector<Index> nodes, Surface surface, const BothSidesOptions& options) {
  Recipe recipe;
  recipe.kind = Recipe::Kind::both_sides;
  recipe.side[1] = Recipe::Topology(surface);
  recipe.nodes = nodes;
  recipe.both = options;
  return Interface(Made{std::make_unique<BothSides>(std::move(nodes), std::move(surface), options), std::move(recipe)});
}

void Interface::set_surface(int side, const SurfaceState& state) {
  made_->model->set_surface(side, state);
  made_->surfaces[static_cast<std::size_t>(side)].take(state);
  if (made_->recorder) made_->recorder->surface(side, state);
}

std::vector<Projection> Interface::projections(std::span<const Vec3> x, bool move_surface) const {
  made_->check(x.size(), "x");
  return made_->model->projections(x, move_surface);
}

void Interface::set_executor(Executor executor) { made_->model->set_executor(std::move(executor)); }

std::vector<Finding> Interface::inspect(const HostState& host, double element_step,
                                        const std::array<std::span<const std::int8_t>, 2>& outward, const InspectionLimits& limits) const {
  made_->check(host.x.size(), "x");
  made_->check(host.v.size(), "v", true);
  made_->check(host.mass.size(), "mass", true);
  Recipe recipe = made_->whole_recipe();
  const std::array<SurfaceValues, 2> surfaces{made_->values(0), made_->values(1)};
  const auto half_of = [](const std::vector<double>& thickness, std::vector<double>& gap) {
    for (std::size_t k = 0; k < gap.size() && k < thickness.size(); ++k) gap[k] = 0.5 * thickness[k];
  };
  half_of(surfaces[0].thickness, recipe.both.node_gap);
  half_of(surfaces[1].thickness, recipe.both.facet_gap);
  InspectionInput input;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t facets = recipe.side[k].facets.size();
    if (!outward[k].empty() && outward[k].size() != facets) {
      throw std::invalid_argument("contact: " + std::to_string(outward[k].size()) + " values of outward for " + std::to_string(facets) +
                                  " facets");
    }
    input.side[k] = {recipe.side[k].facets, {}, {}, outward[k]};
    input.side[k].stiffness = surfaces[k].stiffness;
  }
  input.side[0].nodes = recipe.nodes;
  input.both_sides = recipe.kind == Recipe::Kind::both_sides;
  input.pairs = input.both_sides ? &recipe.both : nullptr;
  input.one_pass = recipe.kind != Recipe::Kind::two_surfaces;
  input.gap = input.both_sides ? recipe.both.largest_gap() : recipe.options.gap;
  if (!input.both_sides && recipe.options.automatic_gap) {
    double both = 0.0;
    for (const SurfaceValues& s : surfaces) {
      if (!s.thickness.empty()) both += *std::max_element(s.thickness.begin(), s.thickness.end());
    }
    input.gap = std::max(input.gap, 0.5 * both);
  }
  input.stiffness_scale = recipe.options.stiffness_scale;
  input.x = host.x;
  input.v = host.v;
  input.mass = host.mass;
  input.element_step = element_step;
  return contact::inspect(input, limits);
}

void Interface::search(const HostState& given) {
  made_->check(given);
  made_->check_stiffness();
  const HostState host = made_->with_steps(given);
  if (made_->recorder) made_->recorder->search(host);
  made_->model->search(host);
  made_->keep_positions(host.x);
  made_->stage = Made::Stage::searched;
}

StepResult Interface::evaluate(const HostState& given, std::span<Vec3> force, std::span<double> stiffness) {
  if (made_->stage != Made::Stage::searched) throw std::logic_error("contact: evaluate() needs a search() before it in the same step");
  made_->check(given);
  made_->check(force.size(), "force");
  made_->check(stiffness.size(), "stiffness");
  made_->check_positions(given.x);
  const HostState host = made_->with_steps(given);
  if (made_->recorder) made_->recorder->evaluate(host, force, stiffness);
  const StepResult result = made_->model->evaluate(host, force, stiffness);
  if (made_->recorder) made_->recorder->result(result, force, stiffness);
  made_->ended = host.dt;
  made_->stage = Made::Stage::evaluated;
  return result;
}

void Interface::commit(double dt) {
  if (made_->stage != Made::Stage::evaluated) throw std::logic_error("contact: commit() needs an evaluate() before it in the same step");
  if (!(dt >= 0.0) || !std::isfinite(dt)) {
    throw std::invalid_argument("contact: the step that is committed must be a finite number >= 0, not " + std::to_string(dt));
  }
  if (made_->recorder) made_->recorder->commit(dt);
  made_->model->commit();
  made_->step_before = made_->ended;
  made_->last_step = dt;
  made_->stage = Made::Stage::idle;
}

void Interface::clear(std::span<Vec3> force, std::span<double> stiffness) const {
  made_->check(force.size(), "force");
  made_->check(stiffness.size(), "stiffness");
  made_->model->clear(force, stiffness);
}

void Interface::add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const {
  made_->check(normal.size(), "normal");
  made_->check(tangential.size(), "tangential");
  made_->model->add_nodal_forces(normal, tangential);
}

void Interface::add_nodal_area(std::span<const Vec3> x, std::span<double> area) const {
  made_->check(x.size(), "x");
  made_->check(area.size(), "area");
  made_->model->add_nodal_area(x, area);
}

void Interface::add_nodal_contact(std::span<NodalContact> nodes) const {
  made_->check(nodes.size(), "nodes");
  made_->model->add_nodal_contact(nodes);
}

std::span<const Index> Interface::nodes_in_contact() const { return made_->model->nodes_in_contact(); }
std::span<const Index> Interface::nodes_crossed() const { return made_->model->nodes_crossed(); }
std::span<const Index> Interface::nodes_lost() const { return made_->model->nodes_lost(); }

std::vector<std::byte> Interface::history() const { return made_->history(); }

void Interface::restore(std::span<const std::byte> history) {
  HistoryReader in(history, made_->fingerprint);
  made_->model->load(in);
  in.finish();
  made_->stage = Made::Stage::idle;
  made_->last_step = std::numeric_limits<double>::quiet_NaN();
  if (made_->recorder) made_->recorder->history(history);
}

void Interface::record(std::ostream& log, std::string_view label) {
  made_->recorder =
      std::make_unique<Recorder>(log, made_->whole_recipe(), std::array{made_->values(0), made_->values(1)}, made_->history(), label);
}

void Interface::stop_recording() { made_->recorder.reset(); }

}  // namespace abut::contact
