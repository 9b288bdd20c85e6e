#include <cmath>
#include <stdexcept>
#include <string>

#include "elements/shell_common/setup.hpp"
#include "elements/shell_common/shell_group.hpp"
#include "elements/shell_q4/geometry.hpp"
#include "elements/shell_q4/parameters.hpp"
#include "simd/isa.hpp"

namespace abut::elements {

// kernel.isa.cpp, once per instruction set
#define ABUT_DECLARE_Q4(isa)                                                                           \
  namespace isa {                                                                                      \
  void q4_elastic(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t);      \
  void q4_johnson_cook(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t); \
  }
ABUT_DECLARE_Q4(sse2)
ABUT_DECLARE_Q4(avx2)
ABUT_DECLARE_Q4(avx512)
#undef ABUT_DECLARE_Q4

namespace {

using Kernel = void (*)(const ShellKernelArgs&, const Q4Parameters&, double, std::size_t, std::size_t);

Kernel choose_kernel(bool plastic) {
  return plastic ? simd::of_active_isa(sse2::q4_johnson_cook, avx2::q4_johnson_cook, avx512::q4_johnson_cook)
                 : simd::of_active_isa(sse2::q4_elastic, avx2::q4_elastic, avx512::q4_elastic);
}

Q4Parameters make_parameters(const GroupInput& in, const model::ShellProperty& p, ShellSection& s) {
  Q4Parameters q;
  if (p.ishell < 1 || p.ishell > 4) {
    throw std::invalid_argument("property " + std::to_string(property_of(in).id) + ": shell formulation " + std::to_string(p.ishell) +
                                " does not exist here (Ishell 1 to 4)");
  }
  q.ishell = p.ishell;
  q.hm = p.hm;
  q.hf = p.hf;
  q.hr = p.hr;
  q.dn = p.dn;
  q.frame_v4 = in.model->shell_frame_v4;
  const bool small_strain = p.ismstr == 1 || (p.ismstr == 3 && p.ishell == 2);
  q.plain_gamma = p.ishell == 2 || (p.ismstr == 1 && p.ishell != 3);
  q.may_freeze = small_strain || (in.step_action == model::StepControl::Action::constant && (p.ismstr == 2 || p.ismstr == 3));
  q.step_bound = in.profile.element_step == Profile::ElementStep::bound;
  q.nodal_step = in.model->controls.nodal_step;
  q.trapezoidal = in.profile.hourglass_energy == Profile::HourglassEnergy::trapezoidal;
  q.homogeneous = in.profile.rotational_hourglass == Profile::RotationalHourglass::homogeneous;
  q.midpoint = in.profile.strain_increment == Profile::StrainIncrement::midpoint;
  q.local_rates = q.may_freeze && q.midpoint;
  q.balanced_warp = in.profile.warped_shell == Profile::WarpedShell::balanced;
  q.plain_pattern = q.balanced_warp && q.plain_gamma;
  q.rotation_correction = in.profile.shell_rotation == Profile::ShellRotation::exact ? 0.125 : 0.25;

  q.at_hourglass = s.variables;
  s.variables += 3;
  if (q.trapezoidal) {
    q.at_hourglass_old = s.variables;
    s.variables += 5;
    if (!s.bending && p.dn > 0.0) {
      q.at_normal_old = s.variables;
      s.variables += 2;
    }
  }
  if (q.may_freeze) {
    q.at_frozen = s.variables;
    s.variables += q.local_rates ? 14 : 7;
    if (s.mean_volume && s.at_volume < 0) {
      s.at_volume = s.variables;
      s.variables += 2;
    }
  }
  return q;
}

class ShellQ4Group final : public ShellGroup {
 public:
  explicit ShellQ4Group(const GroupInput& in) : ShellGroup(in, Family::shell_q4, model::ElementKind::shell4, 4) {
    const auto* property = std::get_if<model::ShellProperty>(&property_of(in).data);
    section_ = make_section(in, property != nullptr && property->ishell == 3);
    if (section_) {
      parameters_ = make_parameters(in, *property, *section_);
      damping_ = std::sqrt(1.0 + property->dm * property->dm) - property->dm;
      kernel_ = choose_kernel(section_->at_points >= 0);
    }
    set_up();
    if (section_ && parameters_.may_freeze) {
      at_frozen_flag_ = parameters_.at_frozen + 6;
      const bool at_once = property->ismstr == 1 || property->ismstr == 3;
      const Index padded = layout_.blocks * lanes;
      for (Index e = 0; at_once && e < padded; ++e) variable(e, at_frozen_flag_) = 0.5;
    }
  }

 private:
  void run(const ShellKernelArgs& args, std::size_t begin, std::size_t end) const override {
    kernel_(args, parameters_, damping_, begin, end);
  }

  [[nodiscard]] ShellFrame frame(std::span<const Vec3> x) const override {
    Vec<double> c[4];
    for (std::size_t k = 0; k < 4; ++k) c[k] = {x[k].x, x[k].y, x[k].z};
    Q4Geometry<double> g;
    q4_frame(in_.model->shell_frame_v4, c[0], c[1], c[2], c[3], g);
    q4_operators(true, g);
    return {{Vec3{g.e1.x, g.e1.y, g.e1.z}, Vec3{g.e2.x, g.e2.y, g.e2.z}, Vec3{g.e3.x, g.e3.y, g.e3.z}}, g.area};
  }

  // numerics.md 1.4, 1.5
  [[nodiscard]] ShellShares shares(std::span<const Vec3> x, double t, double density) const override {
    const double area = frame(x).area;
    ShellShares s;
    s.mass.fill(0.25 * density * t * area);
    s.inertia_per_mass = area / 9.0 + t * t / 12.0;
    s.regular = !(x[2] == x[3]);
    return s;
  }

  Q4Parameters parameters_;
  double damping_ = 1.0;
  Kernel kernel_ = nullptr;
};

}  // namespace

std::unique_ptr<Group> make_shell_q4(const GroupInput& in) { return std::make_unique<ShellQ4Group>(in); }

}  // namespace abut::elements
