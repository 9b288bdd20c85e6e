#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "elements/shell_c0/kernel.hpp"
#include "elements/shell_common/setup.hpp"
#include "elements/shell_common/shell_group.hpp"
#include "simd/isa.hpp"
#include "simd/math.hpp"

namespace abut::elements {

// kernel.isa.cpp, once per instruction set
#define ABUT_DECLARE_C0(isa)                                                                           \
  namespace isa {                                                                                      \
  void c0_elastic(const ShellKernelArgs&, const C0Parameters&, double, std::size_t, std::size_t);      \
  void c0_johnson_cook(const ShellKernelArgs&, const C0Parameters&, double, std::size_t, std::size_t); \
  }
ABUT_DECLARE_C0(sse2)
ABUT_DECLARE_C0(avx2)
ABUT_DECLARE_C0(avx512)
#undef ABUT_DECLARE_C0

namespace {

using Kernel = void (*)(const ShellKernelArgs&, const C0Parameters&, double, std::size_t, std::size_t);

Kernel choose_kernel(bool plastic) {
  return plastic ? simd::of_active_isa(sse2::c0_johnson_cook, avx2::c0_johnson_cook, avx512::c0_johnson_cook)
                 : simd::of_active_isa(sse2::c0_elastic, avx2::c0_elastic, avx512::c0_elastic);
}

class ShellC0Group final : public ShellGroup {
 public:
  explicit ShellC0Group(const GroupInput& in) : ShellGroup(in, Family::shell_c0, model::ElementKind::shell3, 3) {
    section_ = make_section(in, false);
    if (section_) {
      const auto& p = std::get<model::ShellProperty>(property_of(in).data);
      if (p.ish3n != 1 && p.ish3n != 2) {
        throw std::invalid_argument("property " + std::to_string(property_of(in).id) + ": triangle formulation " + std::to_string(p.ish3n) +
                                    " does not exist here (Ish3n 1 or 2)");
      }
      parameters_.large_rotation = p.ish3n == 2;
      parameters_.midpoint = in.profile.strain_increment == Profile::StrainIncrement::midpoint;
      parameters_.step_bound = in.profile.element_step == Profile::ElementStep::bound;
      parameters_.nodal_step = in.model->controls.nodal_step;
      damping_ = std::sqrt(1.0 + p.dm * p.dm) - p.dm;
      kernel_ = choose_kernel(section_->at_points >= 0);
    }
    set_up();
  }

 private:
  void run(const ShellKernelArgs& args, std::size_t begin, std::size_t end) const override {
    kernel_(args, parameters_, damping_, begin, end);
  }

  [[nodiscard]] ShellFrame frame(std::span<const Vec3> x) const override {
    Vec<double> c[3];
    for (std::size_t k = 0; k < 3; ++k) c[k] = {x[k].x, x[k].y, x[k].z};
    const C0Geometry<double> g = c0_geometry(c[0], c[1], c[2]);
    return {{Vec3{g.e1.x, g.e1.y, g.e1.z}, Vec3{g.e2.x, g.e2.y, g.e2.z}, Vec3{g.e3.x, g.e3.y, g.e3.z}}, g.area};
  }

  // numerics.md 1.4, 1.5: by corner angle
  [[nodiscard]] ShellShares shares(std::span<const Vec3> x, double t, double density) const override {
    const double area = frame(x).area;
    ShellShares s;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = x[(k + 1) % 3] - x[k], b = x[(k + 2) % 3] - x[k];
      const double angle = simd::angle_of(dot(a, b), norm(cross(a, b)));
      s.mass[k] = density * t * area * angle / std::numbers::pi;
    }
    s.inertia_per_mass = area / 4.5 + t * t / 12.0;
    return s;
  }

  C0Parameters parameters_;
  double damping_ = 1.0;
  Kernel kernel_ = nullptr;
};

}  // namespace

std::unique_ptr<Group> make_shell_c0(const GroupInput& in) { return std::make_unique<ShellC0Group>(in); }

}  // namespace abut::elements
