#include "elements/shell_common/shell_group.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "elements/shell_common/setup.hpp"
#include "simd/isa.hpp"

namespace abut::elements {

// finish_block.isa.cpp, once per instruction set
#define ABUT_DECLARE_FINISH(isa)                                   \
  namespace isa {                                                  \
  void finish_quad_block(const ShellKernelArgs&, std::size_t);     \
  void finish_triangle_block(const ShellKernelArgs&, std::size_t); \
  }
ABUT_DECLARE_FINISH(sse2)
ABUT_DECLARE_FINISH(avx2)
ABUT_DECLARE_FINISH(avx512)
#undef ABUT_DECLARE_FINISH

namespace {

auto choose_finish_block(bool quad) {
  return quad ? simd::of_active_isa(sse2::finish_quad_block, avx2::finish_quad_block, avx512::finish_quad_block)
              : simd::of_active_isa(sse2::finish_triangle_block, avx2::finish_triangle_block, avx512::finish_triangle_block);
}

/// Stress of a shell's frame (xx yy xy yz zx, no zz) in global axes: xx yy zz xy yz zx.
std::array<double, 6> global_stress(const ShellFrame& f, double xx, double yy, double xy, double yz, double zx) {
  const Vec3 columns[3] = {xx * f.axes[0] + xy * f.axes[1] + zx * f.axes[2], xy * f.axes[0] + yy * f.axes[1] + yz * f.axes[2],
                           zx * f.axes[0] + yz * f.axes[1]};
  const auto component = [&](int i, int j) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += columns[k][i] * f.axes[k][j];
    return sum;
  };
  return {component(0, 0), component(1, 1), component(2, 2), component(0, 1), component(1, 2), component(2, 0)};
}

}  // namespace

ShellGroup::ShellGroup(const GroupInput& in, Family family, model::ElementKind kind, int nodes_per_element)
    : in_(in),
      family_(family),
      kind_(kind),
      per_element_(static_cast<std::size_t>(nodes_per_element)),
      constant_count_(nodes_per_element == 4 ? shell_constant::quad_count : shell_constant::triangle_count) {
  part_ = in.part;
  elements_ = std::move(in_.elements);
  layout_.nodes_per_element = nodes_per_element;
  layout_.components = 8;
  layout_.blocks = (size() + lanes - 1) / lanes;
  if (in.model->node_x.size() > std::numeric_limits<std::int32_t>::max() / 3) {
    throw std::length_error("more nodes than a shell group can address");
  }
}

ElementNodes ShellGroup::nodes(Index element) const {
  const auto e = static_cast<std::size_t>(elements_[static_cast<std::size_t>(element)]);
  if (per_element_ == 4) return std::span<const Index>(in_.model->shells.nodes[e]);
  return std::span<const Index>(in_.model->sh3ns.nodes[e]);
}

double ShellGroup::initial_thickness(Index element) const {
  const auto e = static_cast<std::size_t>(elements_[static_cast<std::size_t>(element)]);
  const std::vector<double>& own = per_element_ == 4 ? in_.model->shells.thickness : in_.model->sh3ns.thickness;
  if (e < own.size() && own[e] > 0.0) return own[e];
  const model::Property& property = property_of(in_);
  if (const auto* empty = std::get_if<model::VoidProperty>(&property.data)) return empty->thickness;
  return std::get<model::ShellProperty>(property.data).thickness;
}

std::array<Vec3, 4> ShellGroup::corners(Index element, const Vec3* x) const {
  std::array<Vec3, 4> c{};
  const ElementNodes n = nodes(element);
  for (std::size_t k = 0; k < n.size(); ++k) c[k] = x[n[k]];
  return c;
}

double& ShellGroup::variable(Index element, int which) {
  const auto e = static_cast<std::size_t>(element);
  return state_[((e / lanes) * static_cast<std::size_t>(section_->variables) + static_cast<std::size_t>(which)) * lanes + e % lanes];
}

double ShellGroup::variable(Index element, int which) const { return const_cast<ShellGroup*>(this)->variable(element, which); }

double ShellGroup::constant(Index element, int which) const {
  const auto e = static_cast<std::size_t>(element);
  return constants_[((e / lanes) * constant_count_ + static_cast<std::size_t>(which)) * lanes + e % lanes];
}

void ShellGroup::set_up() {
  const auto blocks = static_cast<std::size_t>(layout_.blocks);
  const double density = material_of(in_).density;
  constants_.assign(blocks * constant_count_ * lanes, 0.0);
  last_x_ = in_.model->node_x.data();
  const auto padded = static_cast<Index>(blocks * lanes);
  for (Index e = 0; e < padded; ++e) {
    // Padding repeats the last element, switched off.
    const Index source = std::min(e, size() - 1);
    const std::array<Vec3, 4> x = corners(source, last_x_);
    const std::span<const Vec3> used(x.data(), per_element_);
    const ShellShares share = shares(used, initial_thickness(source), density);
    const auto set = [&](int which, double value) {
      constants_[(static_cast<std::size_t>(e / lanes) * constant_count_ + static_cast<std::size_t>(which)) * lanes +
                 static_cast<std::size_t>(e % lanes)] = value;
    };
    set(shell_constant::regular, share.regular ? 1.0 : 0.0);
    set(shell_constant::active, e < size() ? 1.0 : 0.0);
    for (int k = 0; k < mass_count(); ++k) set(shell_constant::mass + k, share.mass[static_cast<std::size_t>(k)]);
    set(shell_constant::inertia, share.inertia_per_mass);
  }
  std::vector<Index> flat;
  flat.reserve(elements_.size() * per_element_);
  for (Index e = 0; e < size(); ++e) {
    const ElementNodes n = nodes(e);
    flat.insert(flat.end(), n.begin(), n.end());
  }
  chunks_ = ChunkTable(flat, static_cast<int>(per_element_), layout_.components);
  if (!section_) return;

  nodes_.resize(blocks * per_element_ * lanes);
  finish_block_ = choose_finish_block(per_element_ == 4);
  results_.resize(static_cast<std::size_t>(chunks_.size()));
  state_.assign(blocks * static_cast<std::size_t>(section_->variables) * lanes, 0.0);
  for (Index e = 0; e < padded; ++e) {
    const Index source = std::min(e, size() - 1);
    const ElementNodes n = nodes(source);
    for (std::size_t k = 0; k < per_element_; ++k) {
      nodes_[(static_cast<std::size_t>(e / lanes) * per_element_ + k) * lanes + static_cast<std::size_t>(e % lanes)] = 3 * n[k];
    }
    variable(e, shell_state::thickness) = initial_thickness(source);
    variable(e, shell_state::off) = e < size() ? 1.0 : 0.0;
    if (section_->at_rate_thickness >= 0) variable(e, section_->at_rate_thickness) = initial_thickness(source);
    for (int k = 0; section_->at_points >= 0 && k < section_->points; ++k) {
      const int point = section_->at_points + k * section_->point_size;
      variable(e, point + 4) = section_->plastic.a;
      if (section_->temperature) variable(e, point + section_->point_temperature) = section_->plastic.t_ref;
    }
  }
}

void ShellGroup::add_masses(std::span<double> mass, std::span<double> inertia) const {
  for (Index e = 0; e < size(); ++e) {
    const ElementNodes n = nodes(e);
    for (std::size_t k = 0; k < n.size(); ++k) {
      const double share = mass_of_corner(e, static_cast<int>(k));
      mass[static_cast<std::size_t>(n[k])] += share;
      inertia[static_cast<std::size_t>(n[k])] += share * constant(e, shell_constant::inertia);
    }
  }
}

bool ShellGroup::acts_on_small_steps() const {
  using Action = model::StepControl::Action;
  return in_.step_action == Action::remove || in_.step_action == Action::constant;
}

bool ShellGroup::may_delete() const {
  const bool fails = section_ && section_->at_points >= 0 && section_->plastic.eps_max < materials::ShellJohnsonCook{}.eps_max;
  return section_ && (fails || in_.step_action == model::StepControl::Action::remove);
}

double ShellGroup::count_on(std::size_t chunk) const {
  double on = 0.0;
  for (std::size_t b = chunks_.first_block(chunk); b < chunks_.end_block(chunk); ++b) {
    const double* off = state_.data() + (b * static_cast<std::size_t>(section_->variables) + shell_state::off) * lanes;
    for (int l = 0; l < lanes; ++l) on += off[l] > 0.0 ? 1.0 : 0.0;
  }
  return on;
}

void ShellGroup::run_chunk(ShellKernelArgs args, const StepOutput& out, std::size_t chunk) {
  alignas(64) double scratch[4 * 8 * lanes];  // slots of one block, when nobody asks for them all
  alignas(64) double steps[lanes];
  ShellBook book;
  args.slots = out.slots != nullptr ? out.slots + layout_.offset : scratch;
  args.slot_stride = out.slots != nullptr ? per_element_ * 8 * lanes : 0;
  args.positions = chunks_.positions();
  args.steps = steps;
  double* sums = out.sums != nullptr ? out.sums + chunks_.sum_offset(chunk) : nullptr;
  if (sums != nullptr) std::fill_n(sums, chunks_.nodes(chunk).size() * 8, 0.0);
  ChunkResult& result = results_[chunk];
  const double on = result.on < 0.0 ? count_on(chunk) : result.on;
  const std::size_t first = chunks_.first_block(chunk), end = chunks_.end_block(chunk);
  if (!acts_on_small_steps()) {
    args.sums = sums;
    args.book = &book;
    args.ahead = chunks_.ahead_of(chunk);
    run(args, first, end);
  } else {
    ShellKernelArgs whole = args;
    whole.sums = sums;
    whole.book = &book;
    for (std::size_t b = first; b < end; ++b) {
      run(args, b, b + 1);
      act_on_small_steps(args, b);
      finish_block_(whole, b);
    }
  }
  result = {};
  for (int l = 0; l < lanes; ++l) {
    result.internal += book.internal[l];
    result.hourglass += book.hourglass[l];
    result.removed_energy += book.removed[l];
    const Index element = static_cast<Index>(book.block[l]) * lanes + l;
    if (book.step[l] < result.step || (book.step[l] == result.step && result.step < 1e30 && element < result.element)) {
      result.step = book.step[l];
      result.element = element;
    }
  }
  result.on = 0.0;
  for (const double lane : book.on) result.on += lane;
  result.removed = static_cast<Index>(on - result.on);
}

void ShellGroup::act_on_small_steps(const ShellKernelArgs& args, std::size_t block) {
  double* step = args.steps;
  for (int l = 0; l < lanes; ++l) {
    if (!(in_.step_scale * step[l] <= in_.step_minimum)) continue;
    const auto element = static_cast<Index>(block * lanes + static_cast<std::size_t>(l));
    if (in_.step_action == model::StepControl::Action::constant) {
      if (at_frozen_flag_ >= 0 && variable(element, at_frozen_flag_) == 0.0) variable(element, at_frozen_flag_) = 0.5;
      continue;
    }
    step[l] = 1e30;
    variable(element, shell_state::off) = 0.0;
    for (int i = shell_state::f; i < shell_state::membrane_energy; ++i) variable(element, i) = 0.0;
    double* slots = args.slots + block * args.slot_stride + l;
    for (std::size_t i = 0; i < per_element_ * 8; ++i) slots[i * lanes] = 0.0;
  }
}

GroupResult ShellGroup::step(const StepInput& in, const StepOutput& out, parallel::ThreadPool& pool) {
  GroupResult total;
  last_x_ = in.x;
  if (!section_) {
    if (out.slots != nullptr) std::fill_n(out.slots + layout_.offset, layout_.size(), 0.0);
    if (in.part_sums) total.part_sums = part_sums(in.v, in.w, &pool);
    return total;
  }
  ShellKernelArgs args;
  args.x = &in.x->x;
  args.v = &in.v->x;
  args.w = &in.w->x;
  args.h = in.dt;
  args.section = &*section_;
  args.state = state_.data();
  args.nodes = nodes_.data();
  args.constants = constants_.data();
  if (in.part_sums) share_masses();
  pool.for_ranges(results_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      run_chunk(args, out, c);
      if (in.part_sums) shares_.sum(chunks_, c, in.v, in.w);  // while its nodes are in the caches
    }
  });
  for (std::size_t c = 0; c < results_.size(); ++c) {
    const ChunkResult& r = results_[c];
    if (r.step * in_.step_scale < total.step) {
      total.step = r.step * in_.step_scale;
      total.step_element = r.element;
    }
    total.internal_energy += r.internal;
    total.hourglass_energy += r.hourglass;
    total.removed_energy += r.removed_energy;
    total.removed += r.removed;
    if (r.removed > 0) shares_.valid = false;
    if (total.bad_element == no_index && !std::isfinite(r.internal + r.hourglass)) total.bad_element = first_bad_element(c);
  }
  if (in.part_sums) total.part_sums = shares_.valid ? shares_.total() : part_sums(in.v, in.w, &pool);
  return total;
}

Index ShellGroup::first_bad_element(std::size_t chunk) const {
  const auto begin = static_cast<Index>(chunks_.first_block(chunk) * lanes);
  for (Index e = begin; e < std::min(static_cast<Index>(chunks_.end_block(chunk) * lanes), size()); ++e) {
    if (active(e) && !std::isfinite(element_energy(e))) return e;
  }
  return begin;
}

void ShellGroup::set_rigid(std::span<const std::uint8_t> rigid) {
  if (rigid.size() != elements_.size()) throw std::invalid_argument("set_rigid: one flag per element of the group");
  shares_.valid = false;
  for (std::size_t e = 0; e < rigid.size(); ++e) {
    constants_[((e / lanes) * constant_count_ + shell_constant::active) * lanes + e % lanes] = rigid[e] != 0 ? 0.0 : 1.0;
  }
}

bool ShellGroup::active(Index element) const { return !section_ || variable(element, shell_state::off) > 0.0; }

double ShellGroup::thickness(Index element) const {
  return section_ ? variable(element, shell_state::thickness) : initial_thickness(element);
}

double ShellGroup::element_mass(Index element) const {
  double mass = 0.0;
  for (int k = 0; k < layout_.nodes_per_element; ++k) mass += mass_of_corner(element, k);
  return mass;
}

double ShellGroup::element_energy(Index element) const {
  if (!section_) return 0.0;
  return variable(element, shell_state::membrane_energy) + variable(element, shell_state::bending_energy) +
         variable(element, shell_state::hourglass_energy);
}

std::vector<std::span<double>> ShellGroup::history() {
  if (state_.empty()) return {};
  shares_.valid = false;  // whoever restores a history may change which elements are on
  for (ChunkResult& r : results_) r.on = -1.0;
  return {std::span<double>(state_)};
}

std::array<double, 6> ShellGroup::layer_stress(Index element, ShellLayer layer) const {
  if (!section_) return {};
  const auto value = [&](int which) { return variable(element, which); };
  using Kind = ShellLayer::Kind;
  const bool has_points = section_->at_points >= 0;
  int point = layer.kind == Kind::point ? layer.point - 1 : -1;
  if (has_points && layer.kind == Kind::upper) point = section_->points - 1;
  if (has_points && layer.kind == Kind::lower) point = 0;

  std::array<double, 3> in_plane{};  // xx yy xy
  if (point >= 0) {
    if (point >= section_->points) return {};
    for (int c = 0; c < 3; ++c) {
      // LAW1 keeps no points: its stress is linear through the thickness, F + 12 zeta M.
      in_plane[static_cast<std::size_t>(c)] =
          has_points ? std::min(1.0, value(shell_state::off)) * value(section_->at_points + point * section_->point_size + c)
                     : value(shell_state::f + c) + 12.0 * section_->zeta[point] * value(shell_state::m + c);
    }
  } else {
    const double mean = layer.kind == Kind::bending ? 0.0 : 1.0;
    const double moment = layer.kind == Kind::lower ? -6.0 : 6.0;
    for (int c = 0; c < 3; ++c)
      in_plane[static_cast<std::size_t>(c)] = mean * value(shell_state::f + c) + moment * value(shell_state::m + c);
  }
  const double shear = layer.kind == Kind::bending ? 0.0 : 1.0;
  const std::array<Vec3, 4> x = corners(element, last_x_);
  return global_stress(frame(std::span<const Vec3>(x.data(), per_element_)), in_plane[0], in_plane[1], in_plane[2],
                       shear * value(shell_state::f + 3), shear * value(shell_state::f + 4));
}

ElementOutput ShellGroup::output(Index element) const {
  ElementOutput o;
  const std::array<Vec3, 4> x = corners(element, last_x_);
  const ShellFrame f = frame(std::span<const Vec3>(x.data(), per_element_));
  o.thickness = thickness(element);
  o.volume = f.area * o.thickness;
  o.density = o.volume > 0.0 ? element_mass(element) / o.volume : 0.0;
  if (!section_) return o;
  o.off = variable(element, shell_state::off);
  o.membrane_energy = variable(element, shell_state::membrane_energy);
  o.bending_energy = variable(element, shell_state::bending_energy);
  o.internal_energy = o.membrane_energy + o.bending_energy;
  o.hourglass_energy = variable(element, shell_state::hourglass_energy);
  for (std::size_t i = 0; i < 8; ++i) o.resultants[i] = variable(element, static_cast<int>(i));
  const auto [xx, yy, xy, yz, zx] = std::array{o.resultants[0], o.resultants[1], o.resultants[2], o.resultants[3], o.resultants[4]};
  o.pressure = -(xx + yy) / 3.0;
  o.von_mises = std::sqrt(xx * xx + yy * yy - xx * yy + 3.0 * xy * xy);
  o.stress = global_stress(f, xx, yy, xy, yz, zx);
  for (int k = 0; section_->at_points >= 0 && k < section_->points; ++k) {
    const double p = variable(element, section_->at_points + k * section_->point_size + 3);
    o.plastic_min = k == 0 ? p : std::min(o.plastic_min, p);
    o.plastic_max = k == 0 ? p : std::max(o.plastic_max, p);
  }
  return o;
}

}  // namespace abut::elements
