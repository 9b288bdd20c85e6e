#include "abut/contact/interface.hpp"

#include "contact/enforce/both_sides.hpp"
#include "contact/enforce/one_sided.hpp"

namespace abut::contact {

Interface::Interface(std::unique_ptr<InterfaceModel> model) : model_(std::move(model)) {}
Interface::~Interface() = default;
Interface::Interface(Interface&&) noexcept = default;
Interface& Interface::operator=(Interface&&) noexcept = default;

Interface Interface::two_surfaces(Surface first, Surface second, const Options& options) {
  return Interface(std::make_unique<OneSided>(std::move(first), std::move(second), options));
}

Interface Interface::nodes_to_surface(std::vector<Index> nodes, std::vector<double> node_stiffness, Surface surface,
                                      const Options& options) {
  return Interface(std::make_unique<OneSided>(std::move(nodes), std::move(node_stiffness), std::move(surface), options));
}

Interface Interface::both_sides(std::vector<Index> nodes, Surface surface, const BothSidesOptions& options) {
  return Interface(std::make_unique<BothSides>(std::move(nodes), std::move(surface), options));
}

void Interface::set_surface(int side, const SurfaceState& state) { model_->set_surface(side, state); }
std::vector<Projection> Interface::projections(std::span<const Vec3> x, bool move_surface) const {
  return model_->projections(x, move_surface);
}
void Interface::set_executor(Executor executor) { model_->set_executor(std::move(executor)); }
void Interface::search(const HostState& host) { model_->search(host); }
StepResult Interface::evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) {
  return model_->evaluate(host, force, stiffness);
}
void Interface::commit(double dt) { model_->commit(dt); }
void Interface::add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const { model_->add_nodal_forces(normal, tangential); }
void Interface::add_nodal_area(std::span<const Vec3> x, std::span<double> area) const { model_->add_nodal_area(x, area); }
void Interface::add_nodal_contact(std::span<NodalContact> nodes) const { model_->add_nodal_contact(nodes); }
std::span<const Index> Interface::nodes_in_contact() const { return model_->nodes_in_contact(); }
std::vector<std::byte> Interface::history() const { return model_->history(); }
void Interface::restore(std::span<const std::byte> history) { model_->restore(history); }

}  // namespace abut::contact
