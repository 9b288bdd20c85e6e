// TYPE3 (two passes) and TYPE5 (one pass) behind Interface.
#pragma once

#include <array>

#include "contact/enforce/interface_model.hpp"
#include "contact/enforce/pass.hpp"

namespace abut::contact {

class OneSided final : public InterfaceModel {
 public:
  OneSided(Surface first, Surface second, const Options& options);
  OneSided(std::vector<Index> nodes, std::vector<double> node_stiffness, Surface surface, const Options& options);

  [[nodiscard]] const Side& side(std::size_t k) const override { return side_[k]; }
  void set_surface(int side, const SurfaceState& state) override;
  [[nodiscard]] std::vector<Projection> projections(std::span<const Vec3> x, bool move_surface) const override;
  void set_executor(Executor executor) override;
  void search(const HostState& host) override;
  StepResult evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) override;
  void clear(std::span<Vec3> force, std::span<double> stiffness) const override;
  void commit() override;
  [[nodiscard]] bool begun() const override { return started_; }
  void add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const override;
  void add_nodal_area(std::span<const Vec3> x, std::span<double> area) const override;
  void add_nodal_contact(std::span<NodalContact> nodes) const override;
  [[nodiscard]] std::span<const Index> nodes_in_contact() const override { return in_contact_; }
  [[nodiscard]] std::span<const Index> nodes_crossed() const override { return crossed_; }
  [[nodiscard]] std::span<const Index> nodes_lost() const override { return lost_; }
  void save(HistoryWriter& out) const override;
  void load(HistoryReader& in) override;

 private:
  Options options_;
  bool two_passes_;
  std::size_t host_nodes_ = 0;  ///< that the host must have at least
  std::array<Side, 2> side_;
  std::array<SideLoads, 2> loads_;
  Executor executor_;
  std::array<std::vector<MotionPart>, 2> parts_;
  std::vector<Pass> pass_;  ///< [0]: nodes of side 0 on side 1; [1]: the reverse
  std::vector<Index> in_contact_, crossed_, lost_;
  double friction_work_ = 0.0, friction_step_ = 0.0, damping_work_ = 0.0, damping_step_ = 0.0, start_work_ = 0.0, start_step_ = 0.0;
  double stepped_work_ = 0.0, stepped_step_ = 0.0;  ///< made by steps that changed under contact forces
  double initial_elastic_ = 0.0;                    ///< stored before anything moved: initial penetrations
  bool started_ = false;                            ///< a step was committed
  bool tried_ = false;                              ///< searched or restored: until a step is committed passes begin anew
  bool acted_ = false;                              ///< in the last evaluate(), since a history was loaded
  bool waiting_ = false, waiting_step_ = false;     ///< the last step, this one was before the birth
  bool stepped_ = false;                 ///< SideLoads::x_before are, or after committed_ will be, the positions of the last search
  bool committed_ = false;               ///< since the last search: the sides' positions are now those before the step
  std::array<Vec3, 2> mean_velocity_{};  ///< of each side's nodes in the last step

  void prepare();
  void make_passes();
  /// The host's positions, and for each pass how far they are from those of the last step. Any common motion gives a true bound; the last
  /// mean velocity gives a close one, so that one look at the nodes is enough.
  std::array<Motion, 2> gather(const HostState& host);
  /// body(begin, end) over all nodes of side k in consecutive pieces of `piece` nodes (the last one is shorter), on the executor's threads.
  template <class Body>
  void over_pieces(std::size_t k, const Body& body) const;
  void project(Side& held, Side& surface, bool move_surface, std::vector<Vec3>& moved) const;
};

}  // namespace abut::contact
