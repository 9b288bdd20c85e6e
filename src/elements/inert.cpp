#include "elements/inert.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace abut::elements {

namespace {

class InertGroup final : public Group {
 public:
  InertGroup(const GroupInput& in, InertElements data)
      : data_(std::move(data)), rigid_counts_(in.profile.part_sums == Profile::PartSums::nodal), counted_(in.elements.size(), 1) {
    part_ = in.part;
    elements_ = in.elements;
    layout_.nodes_per_element = data_.nodes_per_element;
    layout_.components = 4;
    layout_.blocks = (size() + lanes - 1) / lanes;
  }

  [[nodiscard]] Family family() const override { return Family::inert; }
  [[nodiscard]] model::ElementKind kind() const override { return data_.kind; }
  [[nodiscard]] ElementNodes nodes(Index element) const override {
    const auto n = static_cast<std::size_t>(data_.nodes_per_element);
    return std::span(data_.nodes).subspan(static_cast<std::size_t>(element) * n, n);
  }
  void add_masses(std::span<double> mass, std::span<double> /*inertia*/) const override {
    for (std::size_t i = 0; i < data_.nodes.size(); ++i) mass[static_cast<std::size_t>(data_.nodes[i])] += data_.mass[i];
  }
  GroupResult step(const StepInput& in, const StepOutput& out, parallel::ThreadPool& pool) override {
    if (out.slots != nullptr) std::fill_n(out.slots + layout_.offset, layout_.size(), 0.0);
    GroupResult result;
    if (in.part_sums) result.part_sums = part_sums(in.v, in.w, &pool);
    return result;
  }
  void set_rigid(std::span<const std::uint8_t> rigid) override {
    for (std::size_t e = 0; e < counted_.size(); ++e) counted_[e] = rigid_counts_ || rigid[e] == 0 ? 1 : 0;
  }
  [[nodiscard]] ElementOutput output(Index /*element*/) const override { return {}; }
  [[nodiscard]] bool active(Index /*element*/) const override { return true; }
  [[nodiscard]] double thickness(Index /*element*/) const override { return 0.0; }
  [[nodiscard]] PartSums part_sums(const Vec3* v, const Vec3* /*w*/, parallel::ThreadPool* /*pool*/) const override {
    PartSums sums;
    for (Index e = 0; e < size(); ++e) {
      if (counted_[static_cast<std::size_t>(e)] == 0) continue;
      for (int k = 0; k < data_.nodes_per_element; ++k) {
        const double m = data_.mass[index(e, k)];
        const auto node = static_cast<std::size_t>(data_.nodes[index(e, k)]);
        sums.mass += m;
        sums.kinetic_energy += 0.5 * m * squared_norm(v[node]);
        sums.momentum += m * v[node];
      }
    }
    return sums;
  }
  [[nodiscard]] double element_mass(Index element) const override {
    double m = 0.0;
    for (int k = 0; k < data_.nodes_per_element; ++k) m += data_.mass[index(element, k)];
    return m;
  }
  [[nodiscard]] double element_energy(Index /*element*/) const override { return 0.0; }
  [[nodiscard]] std::vector<std::span<double>> history() override { return {}; }

 private:
  [[nodiscard]] std::size_t index(Index e, int k) const {
    return static_cast<std::size_t>(e) * static_cast<std::size_t>(data_.nodes_per_element) + static_cast<std::size_t>(k);
  }

  InertElements data_;
  bool rigid_counts_;
  std::vector<std::uint8_t> counted_;  ///< in the part sums
};

}  // namespace

bool is_void(const GroupInput& in) {
  const auto& m = *in.model;
  const auto& part = m.parts[static_cast<std::size_t>(in.part)];
  return std::holds_alternative<model::LawVoid>(m.materials[static_cast<std::size_t>(part.material)].law);
}

std::unique_ptr<Group> make_inert(const GroupInput& in, InertElements elements) {
  return std::make_unique<InertGroup>(in, std::move(elements));
}

}  // namespace abut::elements
