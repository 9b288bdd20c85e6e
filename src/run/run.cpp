#include "abut/run.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <utility>

#include "output/animation_fields.hpp"
#include "output/element_lookup.hpp"
#include "output/summary.hpp"
#include "run/session.hpp"

namespace abut {

Run::Run(const Model& model, const RunSettings& settings) : impl_(std::make_unique<Impl>(model, settings)) {}
Run::Run(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Run::Run(Run&&) noexcept = default;
Run& Run::operator=(Run&& other) noexcept {
  Run old(std::move(other));
  impl_.swap(old.impl_);
  return *this;
}

Run::~Run() {
  if (impl_ == nullptr) return;
  try {
    impl_->finish(Outcome::Kind::stopped, "stopped by the caller");
  } catch (const std::exception&) {  // a late write error: nobody is left to hear of it
  }
}

bool Run::advance() { return impl_->advance(); }

bool Run::advance_to(double time, const Callback& after_each) {
  while (!is_over() && Run::time() <= time) {
    if (!impl_->advance()) break;
    if (after_each && !after_each(*this)) break;
  }
  return !is_over();
}

bool Run::advance_to_end(const Callback& after_each) { return advance_to(std::numeric_limits<double>::infinity(), after_each); }

const Outcome& Run::finish(Outcome::Kind kind, std::string_view message) { return impl_->finish(kind, message); }
bool Run::is_over() const { return impl_->over; }
const Outcome& Run::outcome() const { return impl_->outcome; }

const Model& Run::model() const { return impl_->model; }
double Run::time() const { return impl_->cycle->state().times.t; }
std::int64_t Run::cycle() const { return impl_->cycle->state().times.cycle; }
double Run::step() const { return impl_->cycle->state().times.h_minus; }
double Run::force_time() const { return time() - step(); }
const StepController& Run::controller() const { return impl_->cycle->controller(); }
std::uint64_t Run::hash() const { return impl_->cycle->hash(); }

std::span<const Vec3> Run::positions() const { return impl_->cycle->state().x; }
std::span<const Vec3> Run::displacements() const { return impl_->cycle->state().u; }
std::span<const Vec3> Run::velocities() const { return impl_->cycle->velocities(); }
std::span<const Vec3> Run::angular_velocities() const { return impl_->cycle->angular_velocities(); }
std::span<const Vec3> Run::accelerations() const { return impl_->cycle->state().a; }
std::span<const Vec3> Run::contact_forces() const { return impl_->cycle->state().f_contact; }
std::span<const double> Run::masses() const { return impl_->cycle->state().mass; }
std::span<Vec3> Run::edit_velocities() { return impl_->cycle->edit_velocities(); }
std::span<Vec3> Run::edit_angular_velocities() { return impl_->cycle->edit_angular_velocities(); }

const Balance& Run::balance() const { return impl_->cycle->balance(); }
std::span<const InterfaceResult> Run::interfaces() const { return impl_->cycle->interface_results(); }
const History& Run::history() const { return impl_->history; }
std::span<const Diagnostic> Run::initial_findings() const { return impl_->info.findings; }
std::span<const ContactFinding> Run::contact_findings() const { return *impl_->info.contact; }
std::span<const RunFinding> Run::findings() const { return *impl_->info.during; }
const std::filesystem::path& Run::output() const { return impl_->settings.output; }
std::vector<PhaseTime> Run::timings() const { return impl_->timings(); }

namespace {

const output::AnimationFields& all_fields() {
  static const output::AnimationFields fields = output::every_animation_field();
  return fields;
}

template <class Field>
const Field& find(const std::vector<Field>& fields, std::string_view name, std::string_view what) {
  std::string names;
  for (const Field& field : fields) {
    if (field.name == name) return field;
    names += (names.empty() ? "" : ", ") + field.name;
  }
  throw std::invalid_argument(fmt::format("'{}' is not a field of {}; there are {}", name, what, names));
}

template <class Field>
std::vector<std::string> names_of(const std::vector<Field>& fields) {
  std::vector<std::string> names;
  for (const Field& field : fields) names.push_back(field.name);
  return names;
}

}  // namespace

std::vector<std::string> Run::node_field_names() { return names_of(all_fields().nodes); }
std::vector<std::string> Run::element_field_names() { return names_of(all_fields().cells); }

std::vector<double> Run::node_field(std::string_view name) const {
  const output::NodeField& field = find(all_fields().nodes, name, "nodes");
  const cycle::Snapshot now = impl_->cycle->view();
  const auto components = static_cast<std::size_t>(field.components);
  std::vector<double> values(now.state->x.size() * components);
  for (std::size_t n = 0; n < now.state->x.size(); ++n) field.write(now, n, values.data() + n * components);
  return values;
}

std::vector<double> Run::element_field(ElementKind kind, std::string_view name) const {
  const output::CellField& field = find(all_fields().cells, name, "elements");
  const cycle::Snapshot now = impl_->cycle->view();
  const output::ElementLookup lookup(*now.model, now.groups);
  const auto components = static_cast<std::size_t>(field.components);
  const std::size_t count = model().elements(kind).size();
  std::vector<double> values(count * components, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t e = 0; e < count; ++e) {
    const output::ElementPlace place = lookup.find(kind, static_cast<Index>(e));
    if (!place.exists()) continue;
    const elements::Group& group = *now.groups[static_cast<std::size_t>(place.group)];
    const output::ElementSample sample{group.output(place.element), group.element_mass(place.element), &group, place.element, now.state};
    if (sample.output.off != 0.0) field.write(sample, values.data() + e * components);
  }
  return values;
}

std::string to_string(const Outcome& outcome) { return output::outcome_text(outcome); }

}  // namespace abut
