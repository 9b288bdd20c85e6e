#include "run/loaded_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string_view>
#include <utility>
#include <variant>

#include "core/fingerprint.hpp"
#include "init/contact_inspection.hpp"
#include "init/contact_setup.hpp"
#include "model/build.hpp"
#include "output/summary.hpp"
#include "run/oriented_deck.hpp"

namespace abut {
namespace {

template <std::size_t N>
ElementTable table_of(ElementKind kind, std::span<const Id> ids, const model::Elements<N>& e) {
  return {kind, static_cast<int>(N), ids, e.part, {e.nodes.empty() ? nullptr : e.nodes.front().data(), e.nodes.size() * N}};
}

void describe_parts(Model::Impl& m) {
  const model::Model& model = m.model;
  for (const model::Part& p : model.parts) {
    PartInfo info{p.id, p.title, 0, 0};
    if (p.property != no_index) info.property_id = model.properties[static_cast<std::size_t>(p.property)].id;
    if (p.material != no_index) info.material_id = model.materials[static_cast<std::size_t>(p.material)].id;
    m.parts.push_back(std::move(info));
  }
  for (const model::Interface& i : model.interfaces) {
    InterfaceInfo info;
    info.id = i.id;
    info.title = i.title;
    info.type = std::string(output::interface_type(i));
    info.stiffness_scale = i.stfac;
    info.friction = i.friction;
    info.gap = i.gap;
    info.surface = model::surfaces_of(i);
    if (const auto* t5 = std::get_if<model::InterfaceType5>(&i.type)) info.nodes = t5->nodes;
    if (const auto* t7 = std::get_if<model::InterfaceType7>(&i.type)) info.nodes = t7->nodes;
    m.interfaces.push_back(std::move(info));
  }
}

std::shared_ptr<const Model::Impl> load(const deck::DeckPair& pair, const std::filesystem::path& path, const ReadOptions& options,
                                        Diagnostics& findings) {
  const auto start = std::chrono::steady_clock::now();
  auto m = std::make_shared<Model::Impl>();
  m->path = path;
  m->options = options;
  m->last_run = 1 + static_cast<int>(pair.restarts.size());
  m->files = pair.starter.files;
  const auto add_files = [&m](const deck::Deck& deck) { m->files.insert(m->files.end(), deck.files.begin(), deck.files.end()); };
  add_files(pair.engine);
  const int run = options.run == 0 ? m->last_run : options.run;
  if (run < 1 || run > m->last_run) {
    findings.error("model.no_engine", {path.string(), 0, {}, {}, 0, 0}, fmt::format("there is no Engine deck of run {}", run));
  }
  if (!findings.has_errors()) {
    for (int n = 2; n <= run; ++n) add_files(pair.restarts[static_cast<std::size_t>(n) - 2]);
    m->model = model::build(pair, findings, run);
  } else {
    (void)model::build(pair, findings, options.run == 0 ? run : 1);  // all faults of a deck in one go
  }
  if (findings.has_errors()) throw InputError(std::move(findings));
  init::settle_initial_penetrations(m->model, findings);
  if (findings.has_errors()) throw InputError(std::move(findings));
  if (options.orient) {
    const std::vector<init::TurnedSurface> turned = init::orient_contacts(m->model);
    for (const init::TurnedSurface& t : turned) findings.add(init::to_diagnostic(m->model, t));
    if (!options.write_deck.empty()) {
      std::vector<std::string> decks{path.string()};
      decks.insert(decks.end(), pair.starter.files.begin(), pair.starter.files.end());
      decks.insert(decks.end(), pair.engine.files.begin(), pair.engine.files.end());
      for (const deck::Deck& deck : pair.restarts) decks.insert(decks.end(), deck.files.begin(), deck.files.end());
      run::write_oriented_deck(path, decks, options.write_deck, m->model, turned);
    }
  }
  m->findings = findings.all();
  Fingerprint fingerprint;
  for (const std::string& text : pair.starter.texts) fingerprint.add(text);
  fingerprint.byte(options.orient ? 1 : 0);
  m->fingerprint = fingerprint.value();
  Fingerprint engines;
  const auto add_engine = [&](const deck::Deck& deck) {
    for (const std::string& text : deck.texts) engines.add(text);
    m->engine_fingerprint.push_back(engines.value());
  };
  add_engine(pair.engine);
  for (const deck::Deck& deck : pair.restarts) add_engine(deck);
  describe_parts(*m);
  m->read_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return m;
}

}  // namespace

Model Model::read(const std::filesystem::path& starter, const ReadOptions& options) {
  if (!options.write_deck.empty() && !options.orient) {
    throw RunError(fmt::format("nothing to write to '{}': --write-deck keeps what --orient auto turns", options.write_deck.string()));
  }
  Diagnostics findings;
  const deck::DeckPair pair = deck::read(starter, findings);
  return Model(load(pair, starter, options, findings));
}

Model Model::from_text(const DeckText& text, const ReadOptions& options) {
  if (!options.write_deck.empty()) throw RunError("write_deck needs a deck that was read from a file");
  Diagnostics findings;
  deck::DeckPair pair;
  pair.starter = deck::read_starter_text(text.starter, text.name + "_0000.rad", findings);
  int number = 0;
  for (const std::string& engine : text.engines) {
    deck::Deck deck = deck::read_engine_text(engine, fmt::format("{}_{:04}.rad", text.name, ++number), findings);
    if (number == 1) {
      pair.engine = std::move(deck);
      pair.has_engine = true;
    } else {
      pair.restarts.push_back(std::move(deck));
    }
  }
  return Model(load(pair, {}, options, findings));
}

const std::string& Model::name() const { return impl_->model.name; }
const std::string& Model::title() const { return impl_->model.title; }
const Units& Model::units() const { return impl_->model.units; }
double Model::end_time() const { return impl_->model.controls.t_end; }
int Model::run_number() const { return impl_->model.controls.run_number; }
int Model::last_run_number() const { return impl_->last_run; }
const std::filesystem::path& Model::path() const { return impl_->path; }
std::span<const std::string> Model::files() const { return impl_->files; }
std::span<const Diagnostic> Model::findings() const { return impl_->findings; }
std::uint64_t Model::fingerprint() const { return impl_->fingerprint; }
std::span<const Id> Model::node_ids() const { return impl_->ids(ElementKind::none); }
std::span<const Vec3> Model::coordinates() const { return impl_->model.node_x; }
std::span<const PartInfo> Model::parts() const { return impl_->parts; }
std::span<const SurfaceInfo> Model::surfaces() const { return impl_->surfaces(); }

namespace {

std::mutex making;  // what a model shows only when it is asked for

}  // namespace

const std::vector<Id>& Model::Impl::ids(ElementKind kind) const {
  const std::lock_guard lock(making);
  std::shared_ptr<const std::vector<Id>>& made = ids_[static_cast<std::size_t>(kind)];
  if (made == nullptr) {
    const std::array<const model::Ids*, 5> all{&model.node_id, &model.shells.id, &model.sh3ns.id, &model.bricks.id, &model.tetras.id};
    made = std::make_shared<const std::vector<Id>>(all[static_cast<std::size_t>(kind)]->all());
  }
  return *made;
}

const std::vector<SurfaceInfo>& Model::Impl::surfaces() const {
  const std::lock_guard lock(making);
  if (surfaces_ == nullptr) {
    std::vector<SurfaceInfo> all;
    for (const model::Surface& s : model.surfaces) {
      SurfaceInfo info{s.id, s.title, {}};
      info.facets.reserve(s.segments.size());
      for (const model::Segment& segment : s.segments) info.facets.push_back(segment.nodes);
      all.push_back(std::move(info));
    }
    surfaces_ = std::make_shared<const std::vector<SurfaceInfo>>(std::move(all));
  }
  return *surfaces_;
}

std::span<const InterfaceInfo> Model::interfaces() const { return impl_->interfaces; }
std::size_t Model::element_count() const { return static_cast<std::size_t>(output::element_count(impl_->model)); }

ElementTable Model::elements(ElementKind kind) const {
  switch (kind) {
    case ElementKind::shell4:
      return table_of(kind, impl_->ids(kind), impl_->model.shells);
    case ElementKind::shell3:
      return table_of(kind, impl_->ids(kind), impl_->model.sh3ns);
    case ElementKind::brick:
      return table_of(kind, impl_->ids(kind), impl_->model.bricks);
    case ElementKind::tetra:
      return table_of(kind, impl_->ids(kind), impl_->model.tetras);
    case ElementKind::none:
      break;
  }
  return {};
}

Profile run::profile_of(Rules rules) { return rules == Rules::reference ? Profile::reference() : Profile::standard(); }

const model::Interface& run::interface_of(const model::Model& model, Id id, std::string_view choice) {
  for (const model::Interface& i : model.interfaces) {
    if (i.id == id) return i;
  }
  throw RunError(fmt::format("{} of interface {}: the deck has no such interface", choice, id));
}

void run::check_choices(const model::Model& model, const Choices& choices) {
  for (const InterfaceChoice& c : choices.interfaces) {
    const std::string name = "the choice '" + to_string(c) + "'";
    if (c.interface_id != 0 && std::holds_alternative<model::InterfaceType7>(interface_of(model, c.interface_id, name).type)) {
      throw RunError(name + ": it is of TYPE7, whose card has all its settings (Gapmin, Igap, Inacti, VIS_s)");
    }
    if (c.damping && !(*c.damping >= 0.0 && *c.damping <= 1.0)) throw RunError(name + ": damping is a fraction of critical, 0 to 1");
    if (c.depth_limit && !(*c.depth_limit > 0.0 && std::isfinite(*c.depth_limit))) throw RunError(name + ": depth is a length > 0");
    if (c.start_duration && !(*c.start_duration >= 0.0 && std::isfinite(*c.start_duration))) {
      throw RunError(name + ": start is a time >= 0");
    }
  }
  for (const model::Interface& i : model.interfaces) {
    const InterfaceChoice c = init::choice_of(choices.interfaces, i.id);
    const std::string name = fmt::format("the choices for interface {}", i.id);
    if (c.automatic_gap.value_or(false) && choices.rules == Rules::reference) {
      throw RunError(name + ": gap=auto needs the closest points of the standard rule set");
    }
    const contact::Initial initial = c.initial.value_or(contact::Initial::keep);
    if (c.start_duration.value_or(0.0) > 0.0 && (initial == contact::Initial::project || initial == contact::Initial::ignore)) {
      throw RunError(name + ": a gradual start pushes initial penetrations out; it cannot be had with initial=project or ignore");
    }
  }
}

Model run::projected(const Model& model, const Choices& choices) {
  const auto moves = [&](const model::Interface& i) {
    return init::choice_of(choices.interfaces, i.id).initial == contact::Initial::project;
  };
  const std::vector<model::Interface>& interfaces = model.impl().model.interfaces;
  if (std::none_of(interfaces.begin(), interfaces.end(), moves)) return model;
  auto moved = std::make_shared<Model::Impl>(model.impl());
  Diagnostics findings;
  init::project_initial_penetrations(moved->model, choices.interfaces, findings);
  for (const Diagnostic& d : findings.all()) moved->findings.push_back(d);
  return Model::of(std::move(moved));
}

cycle::RunOptions run::options_of(const Choices& choices, int threads) {
  cycle::RunOptions options;
  options.threads = threads;
  options.profile = profile_of(choices.rules);
  options.contacts = choices.interfaces;
  return options;
}

}  // namespace abut
