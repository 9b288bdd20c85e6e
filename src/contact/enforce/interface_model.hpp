// What every kind of interface provides behind Interface (one-sided: TYPE3, TYPE5; others derive their own).
#pragma once

#include "abut/contact/interface.hpp"
#include "contact/enforce/history.hpp"
#include "contact/surface/side.hpp"

namespace abut::contact {

class InterfaceModel {
 public:
  InterfaceModel() = default;
  InterfaceModel(const InterfaceModel&) = delete;
  InterfaceModel& operator=(const InterfaceModel&) = delete;
  virtual ~InterfaceModel() = default;

  [[nodiscard]] virtual const Side& side(std::size_t k) const = 0;
  virtual void set_surface(int side, const SurfaceState& state) = 0;
  [[nodiscard]] virtual std::vector<Projection> projections(std::span<const Vec3> x, bool move_surface) const = 0;
  /// Those whose loops are short may leave it.
  virtual void set_executor(Executor /*executor*/) {}
  virtual void search(const HostState& host) = 0;
  virtual StepResult evaluate(const HostState& host, std::span<Vec3> force, std::span<double> stiffness) = 0;
  virtual void clear(std::span<Vec3> force, std::span<double> stiffness) const = 0;
  virtual void commit() = 0;
  /// A step was committed.
  [[nodiscard]] virtual bool begun() const = 0;
  virtual void add_nodal_forces(std::span<Vec3> normal, std::span<Vec3> tangential) const = 0;
  virtual void add_nodal_area(std::span<const Vec3> x, std::span<double> area) const = 0;
  virtual void add_nodal_contact(std::span<NodalContact> nodes) const = 0;
  [[nodiscard]] virtual std::span<const Index> nodes_in_contact() const = 0;
  [[nodiscard]] virtual std::span<const Index> nodes_crossed() const { return {}; }
  [[nodiscard]] virtual std::span<const Index> nodes_lost() const { return {}; }
  virtual void save(HistoryWriter& out) const = 0;
  virtual void load(HistoryReader& in) = 0;
};

}  // namespace abut::contact
