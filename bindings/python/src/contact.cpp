// Surfaces and interfaces for hosts written in Python.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "abut/contact/interface.hpp"
#include "arrays.hpp"
#include "files.hpp"
#include "parallel/thread_pool.hpp"
#include "parts.hpp"

namespace abut::python {
namespace {

using namespace py::literals;
using contact::BothSidesOptions;
using contact::HostState;
using contact::Interface;
using contact::Options;
using contact::StepResult;
using contact::Surface;

py::array facet_view(const py::object& self) {
  static_assert(sizeof(contact::Facet) == 4 * sizeof(Index));
  const auto all = self.cast<const Surface&>().facets();
  return view({all.empty() ? nullptr : all.front().node.data(), 4 * all.size()}, self, 4);
}

py::array neighbours(const Surface& s) {
  std::vector<std::array<Index, 4>> all(s.facets().size());
  for (std::size_t f = 0; f < all.size(); ++f) {
    const int edges = s.facets()[f].corners();
    for (int e = 0; e < 4; ++e) all[f][static_cast<std::size_t>(e)] = e < edges ? s.neighbour(static_cast<Index>(f), e) : no_index;
  }
  return copy(std::span<const std::array<Index, 4>>(all));
}

void bind_surface(py::module_& m) {
  py::class_<Surface>(m, "Surface",
                      "Topology of a contact surface: checked once, immutable. Its positive side is given by the right-hand rule.")
      .def(py::init([](const ArrayLike& f, const std::optional<ArrayLike>& node_keys) {
             return Surface(facets(f, "facets"), node_keys ? ids(*node_keys, "node_keys") : std::vector<Id>{});
           }),
           "facets"_a, py::kw_only(), "node_keys"_a = py::none(),
           "facets: (F, 3) or (F, 4) indices of the host's nodes; in four columns a triangle repeats its third node or ends in -1.\n"
           "node_keys: (N,) ids that order every sum; None: the node's index.\n"
           "Raises ValueError for a facet with fewer than three distinct nodes, or one that appears twice.")
      .def_property_readonly("facets", &facet_view, "(F, 4) node indices, a triangle repeats its third; a read-only view")
      .def_property_readonly(
          "nodes", [](const py::object& self) { return view(self.cast<const Surface&>().nodes(), self); },
          "(S,) the host's nodes on this surface, by key; a read-only view")
      .def_property_readonly("neighbours", &neighbours, "(F, 4) facet across edge e (corner e to e + 1); -1 at a free border")
      .def("__len__", &Surface::facet_count)
      .def("__repr__", [](const Surface& s) {
        return "Surface(" + std::to_string(s.facet_count()) + " facets, " + std::to_string(s.node_count()) + " nodes)";
      });
}

/// An interface with what its host need not know: how many nodes it reads, the steps that were committed.
struct HeldInterface {
  HeldInterface(Interface i, py::ssize_t needed, std::array<py::ssize_t, 2> f, std::array<py::ssize_t, 2> h)
      : interface(std::move(i)), nodes_needed(needed), facets(f), held(h) {}

  std::ofstream log;  ///< of record(); goes after the interface that writes to it
  Interface interface;
  py::ssize_t nodes_needed;
  std::array<py::ssize_t, 2> facets, held;  ///< of each side
  double last_step = 0.0, step_before = 0.0;
  bool evaluated = false;
  bool busy = false;  ///< another thread is inside, without the lock of the interpreter
  std::shared_ptr<parallel::ThreadPool> pool;
};

py::ssize_t beyond_last(std::span<const Index> nodes) {
  Index last = no_index;
  for (const Index n : nodes) last = std::max(last, n);
  return static_cast<py::ssize_t>(last) + 1;
}

using Pair = std::array<py::ssize_t, 2>;

py::ssize_t count_of(std::size_t n) { return static_cast<py::ssize_t>(n); }

std::unique_ptr<HeldInterface> two_surfaces(const Surface& first, const Surface& second, const Options& options) {
  const auto needed = std::max(beyond_last(first.nodes()), beyond_last(second.nodes()));
  return std::make_unique<HeldInterface>(Interface::two_surfaces(first, second, options), needed,
                                         Pair{first.facet_count(), second.facet_count()}, Pair{first.node_count(), second.node_count()});
}

std::unique_ptr<HeldInterface> nodes_to_surface(const ArrayLike& nodes, const Surface& surface, const Options& options,
                                                const std::optional<ArrayLike>& node_stiffness) {
  std::vector<Index> held = indices(nodes, "nodes");
  const Reals stiffness = reals(node_stiffness, "node_stiffness", count_of(held.size()));
  const auto needed = std::max(beyond_last(held), beyond_last(surface.nodes()));
  const auto count = count_of(held.size());
  return std::make_unique<HeldInterface>(
      Interface::nodes_to_surface(std::move(held), {stiffness.span.begin(), stiffness.span.end()}, surface, options), needed,
      Pair{count, surface.facet_count()}, Pair{count, surface.node_count()});
}

std::unique_ptr<HeldInterface> both_sides(const ArrayLike& nodes, const Surface& surface, const BothSidesOptions& options) {
  std::vector<Index> held = indices(nodes, "nodes");
  const auto needed = std::max(beyond_last(held), beyond_last(surface.nodes()));
  const auto count = count_of(held.size());
  return std::make_unique<HeldInterface>(Interface::both_sides(std::move(held), surface, options), needed,
                                         Pair{count, surface.facet_count()}, Pair{count, surface.node_count()});
}

/// The interpreter's lock is free while an interface works; a second thread that comes in is refused.
class Work {
 public:
  explicit Work(HeldInterface& i) : interface_(i) {
    if (i.busy) throw std::runtime_error("this interface is at work in another thread");
    i.busy = true;
  }
  ~Work() { interface_.busy = false; }
  Work(const Work&) = delete;
  Work& operator=(const Work&) = delete;

 private:
  HeldInterface& interface_;
};

struct HostArrays {
  Points x, v;
  Reals mass;
  HostState state;
};

HostArrays host_arrays(const HeldInterface& i, const ArrayLike& x, const ArrayLike& v, const std::optional<ArrayLike>& mass, double time,
                       const std::optional<double>& dt) {
  HostArrays h{points(x, "x"), {}, {}, {}};
  const py::ssize_t count = h.x.array.shape(0);
  if (count < i.nodes_needed) {
    throw py::value_error("x has " + std::to_string(count) + " rows, but the surfaces name node " + std::to_string(i.nodes_needed - 1));
  }
  h.v = points(v, "v", count);
  h.mass = mass ? reals(*mass, "mass", count) : Reals{};
  h.state = {h.x.span, h.v.span, h.mass.span, time, dt.value_or(i.last_step), 0.5 * (dt.value_or(i.last_step) + i.step_before)};
  if (i.last_step == 0.0 && !dt) h.state.dt_bar_old = 0.0;
  return h;
}

void search(HeldInterface& i, const ArrayLike& x, const ArrayLike& v, const std::optional<ArrayLike>& mass, double time,
            const std::optional<double>& dt) {
  const HostArrays host = host_arrays(i, x, v, mass, time, dt);
  const Work work(i);
  const py::gil_scoped_release free;
  i.interface.search(host.state);
}

StepResult evaluate(HeldInterface& i, const ArrayLike& x, const ArrayLike& v, const ArrayLike& force, const ArrayLike& stiffness,
                    const std::optional<ArrayLike>& mass, double time, const std::optional<double>& dt) {
  const HostArrays host = host_arrays(i, x, v, mass, time, dt);
  const auto count = host.x.array.shape(0);
  const std::span<Vec3> f = writable_points(force, "force", count);
  const std::span<double> k = writable_reals(stiffness, "stiffness", count);
  const Work work(i);
  const py::gil_scoped_release free;
  const StepResult result = i.interface.evaluate(host.state, f, k);
  i.evaluated = true;
  return result;
}

void commit(HeldInterface& i, double dt) {
  if (!(dt > 0.0 && dt < 1e30)) throw py::value_error("dt must be positive");
  if (!i.evaluated) throw std::runtime_error("commit() comes after evaluate()");
  const Work work(i);
  i.interface.commit(dt);
  i.step_before = i.last_step;
  i.last_step = dt;
  i.evaluated = false;
}

StepResult step(HeldInterface& i, const ArrayLike& x, const ArrayLike& v, const ArrayLike& force, const ArrayLike& stiffness, double dt,
                const std::optional<ArrayLike>& mass, double time) {
  search(i, x, v, mass, time, std::nullopt);
  StepResult result = evaluate(i, x, v, force, stiffness, mass, time, std::nullopt);
  commit(i, dt);
  return result;
}

void set_surface(HeldInterface& i, int side, const std::optional<ArrayLike>& stiffness, const std::optional<ArrayLike>& thickness,
                 const std::optional<ArrayLike>& active, const std::optional<ArrayLike>& node_active) {
  if (side != 0 && side != 1) throw py::value_error("side is " + std::to_string(side) + ", expected 0 or 1");
  const auto s = static_cast<std::size_t>(side);
  const Reals k = reals(stiffness, "stiffness", i.facets[s]), t = reals(thickness, "thickness", i.facets[s]);
  const auto checked = [](const std::optional<ArrayLike>& value, const char* name, py::ssize_t count) {
    const std::vector<std::uint8_t> values = value ? flags(*value, name) : std::vector<std::uint8_t>{};
    if (value && count_of(values.size()) != count) {
      throw py::value_error(std::string(name) + " has " + std::to_string(values.size()) + " values, expected " + std::to_string(count));
    }
    return values;
  };
  const auto a = checked(active, "active", i.facets[s]), n = checked(node_active, "node_active", i.held[s]);
  const Work work(i);
  i.interface.set_surface(side, {k.span, t.span, a, n});
}

void set_threads(HeldInterface& i, int threads) {
  if (threads < 1) throw py::value_error("threads must be 1 or more");
  const Work work(i);
  constexpr std::size_t grain = 4;  // pieces of a loop that are worth a thread
  auto pool = threads > 1 ? std::make_shared<parallel::ThreadPool>(threads) : nullptr;
  i.interface.set_executor(
      pool == nullptr ? contact::Executor{} : [pool](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        pool->for_ranges(count, grain, [&body](std::size_t begin, std::size_t end) { body(begin, end); });
      });
  i.pool = std::move(pool);
}

std::vector<contact::Finding> inspect(const HeldInterface& i, const ArrayLike& x, const std::optional<ArrayLike>& v,
                                      const std::optional<ArrayLike>& mass, double element_step,
                                      const std::optional<ArrayLike>& first_outward, const std::optional<ArrayLike>& second_outward,
                                      const contact::InspectionLimits& limits) {
  const Points at = points(x, "x"), speed = v ? points(*v, "v", at.array.shape(0)) : Points{};
  if (at.array.shape(0) < i.nodes_needed) throw py::value_error("x must have at least " + std::to_string(i.nodes_needed) + " rows");
  const Reals masses = reals(mass, "mass", at.array.shape(0));
  const auto sign = [](const std::optional<ArrayLike>& value, const char* name) {
    std::vector<std::int8_t> signs;
    for (const double o : reals(value, name).span) signs.push_back(o > 0.0 ? 1 : o < 0.0 ? -1 : 0);
    return signs;
  };
  const auto first = sign(first_outward, "first_outward"), second = sign(second_outward, "second_outward");
  return i.interface.inspect({.x = at.span, .v = speed.span, .mass = masses.span}, element_step, {first, second}, limits);
}

py::tuple nodal_forces(const HeldInterface& i, py::ssize_t count) {
  if (count < i.nodes_needed) throw py::value_error("node_count must be at least " + std::to_string(i.nodes_needed));
  py::array_t<double> normal({count, py::ssize_t{3}}), tangential({count, py::ssize_t{3}});
  const auto zeroed = [count](py::array_t<double>& a) {
    std::fill_n(a.mutable_data(), a.size(), 0.0);
    return std::span<Vec3>(reinterpret_cast<Vec3*>(a.mutable_data()), static_cast<std::size_t>(count));
  };
  const auto n = zeroed(normal), t = zeroed(tangential);
  i.interface.add_nodal_forces(n, t);
  return py::make_tuple(normal, tangential);
}

py::tuple nodal_contact(const HeldInterface& i, py::ssize_t count) {
  if (count < i.nodes_needed) throw py::value_error("node_count must be at least " + std::to_string(i.nodes_needed));
  std::vector<contact::NodalContact> nodes(static_cast<std::size_t>(count));
  i.interface.add_nodal_contact(nodes);
  py::array_t<std::int8_t> states(count);
  std::vector<double> opening, penetration;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    states.mutable_at(static_cast<py::ssize_t>(n)) = static_cast<std::int8_t>(nodes[n].state);
    opening.push_back(nodes[n].opening);
    penetration.push_back(nodes[n].penetration);
  }
  return py::make_tuple(states, take(std::move(opening)), take(std::move(penetration)));
}

py::array nodal_area(const HeldInterface& i, const ArrayLike& x) {
  const Points at = points(x, "x");
  if (at.array.shape(0) < i.nodes_needed) throw py::value_error("x must have at least " + std::to_string(i.nodes_needed) + " rows");
  std::vector<double> area(at.span.size(), 0.0);
  i.interface.add_nodal_area(at.span, area);
  return take(std::move(area));
}

py::tuple projections(const HeldInterface& i, const ArrayLike& x, bool move_surface) {
  const Points at = points(x, "x");
  if (at.array.shape(0) < i.nodes_needed) throw py::value_error("x must have at least " + std::to_string(i.nodes_needed) + " rows");
  std::vector<Index> nodes;
  std::vector<Vec3> moves;
  for (const contact::Projection& p : i.interface.projections(at.span, move_surface)) {
    nodes.push_back(p.node);
    moves.push_back(p.by);
  }
  return py::make_tuple(copy(std::span<const Index>(nodes)), copy(std::span<const Vec3>(moves)));
}

/// The library's blob after the two steps that this binding keeps.
py::bytes history(const HeldInterface& i) {
  const std::array<double, 2> steps{i.last_step, i.step_before};
  const std::vector<std::byte> blob = i.interface.history();
  std::string bytes(sizeof steps + blob.size(), '\0');
  std::memcpy(bytes.data(), steps.data(), sizeof steps);
  if (!blob.empty()) std::memcpy(bytes.data() + sizeof steps, blob.data(), blob.size());
  return bytes;
}

void restore(HeldInterface& i, const py::bytes& saved) {
  const auto bytes = static_cast<std::string_view>(saved);
  std::array<double, 2> steps{};
  if (bytes.size() < sizeof steps) throw py::value_error("this is not the history of an interface");
  std::memcpy(steps.data(), bytes.data(), sizeof steps);
  const Work work(i);
  i.interface.restore({reinterpret_cast<const std::byte*>(bytes.data()) + sizeof steps, bytes.size() - sizeof steps});
  i.last_step = steps[0];
  i.step_before = steps[1];
  i.evaluated = false;
}

void record(HeldInterface& i, const std::filesystem::path& path, const std::string& label) {
  const Work work(i);
  i.interface.stop_recording();
  i.log.close();
  i.log.clear();
  i.log.open(path, std::ios::binary | std::ios::trunc);
  if (!i.log) throw_os_error(path);
  i.interface.record(i.log, label);
}

void stop_recording(HeldInterface& i) {
  const Work work(i);
  i.interface.stop_recording();
  if (!i.log.is_open()) return;
  i.log.close();
  if (i.log.fail()) throw std::runtime_error("the end of the call log cannot be written");
}

void bind_interface(py::module_& m) {
  py::class_<HeldInterface>(
      m, "Interface",
      "What is held, what holds it, and the three verbs of a step: search, evaluate, commit.\n\n"
      "N is the number of the host's nodes. Positions x and velocities v are (N, 3), those of central differences: x at t^n, v at\n"
      "the half step before. float64 arrays in C order are used without a copy. All three verbs leave the interpreter's lock free.")
      .def_static("two_surfaces", &two_surfaces, "first"_a, "second"_a, "options"_a = Options{},
                  "Two passes; neither surface is main (TYPE3). Raises ValueError when a node lies on both.")
      .def_static("nodes_to_surface", &nodes_to_surface, "nodes"_a, "surface"_a, "options"_a = Options{}, py::kw_only(),
                  "node_stiffness"_a = py::none(),
                  "Nodes held against a surface, one pass (TYPE5). The surface is side 1.\n\n"
                  "nodes: (S,) indices, sorted by key. node_stiffness: (S,) their own stiffness, force/length; None: half of the facet's.")
      .def_static("both_sides", &both_sides, "nodes"_a, "surface"_a, "options"_a,
                  "Every pair of node and facet within the gap repels, on both sides (TYPE7). nodes: (S,) indices; the surface is side 1.")
      .def("set_surface", &set_surface, "side"_a, py::kw_only(), "stiffness"_a = py::none(), "thickness"_a = py::none(),
           "active"_a = py::none(), "node_active"_a = py::none(),
           "What changes about a side; None leaves what was set before.\n\n"
           "stiffness: (F,) own stiffness per facet, force/length: E t (shell) or B A^2/V (brick face). thickness: (F,) of shells.\n"
           "active: (F,) False for eroded facets. node_active: (S,) False lets a node go. For a side of nodes F is their number.")
      .def("set_threads", &set_threads, "threads"_a, "Loops over nodes run in this many threads; results do not depend on it.")
      .def(
          "inspect", &inspect, "x"_a, py::kw_only(), "v"_a = py::none(), "mass"_a = py::none(), "element_step"_a = 0.0,
          "first_outward"_a = py::none(), "second_outward"_a = py::none(), "limits"_a = contact::InspectionLimits{},
          "contact.inspect() of what this interface knows of itself: surfaces, stiffness, gap and stiffness scale. Best before the first\n"
          "step; worst first. Eroded facets are looked at like others.\n\n"
          "x, v: (N, 3), v None: at rest. mass: (N,), None: not known. element_step: time, stable step without the interface, 0: not "
          "known.\n"
          "*_outward: (F,) +1 normal out of the solid behind, -1 into it, 0 shell or not known. Raises ValueError for arrays that are too\n"
          "short or of another shape.")
      .def("search", &search, "x"_a, "v"_a, py::kw_only(), "mass"_a = py::none(), "time"_a = 0.0, "dt"_a = py::none(),
           "Finds who can touch. Once per step, with the arguments that evaluate() will get.\n\n"
           "x: (N, 3) positions at t^n; v: (N, 3) velocities half a step before. Raises ValueError when they are too short for the\n"
           "surfaces or not finite.")
      .def("evaluate", &evaluate, "x"_a, "v"_a, "force"_a, "stiffness"_a, py::kw_only(), "mass"_a = py::none(), "time"_a = 0.0,
           "dt"_a = py::none(),
           "Adds forces into force (N, 3) and nodal contact stiffness into stiffness (N,): float64, C order, writable.\n\n"
           "A host is stable with h <= sqrt(2 m/K) for the stiffness K of elements and contacts at every node.\n"
           "mass: (N,), 0 for a node that cannot move; time: t^n; dt: the step that ended at t^n, None: the last one committed.\n"
           "Raises RuntimeError without a search() in this step.")
      .def("commit", &commit, "dt"_a,
           "Friction and energy history move on; dt > 0 is the step that the host takes now.\n\n"
           "Raises ValueError for a dt that is not positive, RuntimeError without an evaluate() in this step.")
      .def("step", &step, "x"_a, "v"_a, "force"_a, "stiffness"_a, py::kw_only(), "dt"_a, "mass"_a = py::none(), "time"_a = 0.0,
           "search, evaluate and commit in one call, for hosts that know their step beforehand.\n\n"
           "x, v: (N, 3) positions at t^n and velocities half a step before. force (N, 3) and stiffness (N,), float64 in C order and\n"
           "writable, are added to. mass: (N,), 0 for a node that cannot move. dt: the step that the host takes now; time: t^n.\n"
           "Raises ValueError for arrays of another shape or values that are not finite, and for a dt that is not positive.")
      .def("nodal_forces", &nodal_forces, "node_count"_a, "Normal and tangential contact force on the host's nodes: two (N, 3) arrays.")
      .def("nodal_contact", &nodal_contact, "node_count"_a,
           "What held nodes have to do with the other side, at the positions of the last search: three (N,) arrays.\n\n"
           "State: 0 apart, 1 stick, 2 slip. Opening: distance less the gap, nan where nothing is near or the node is not held.\n"
           "Penetration: of a node in contact, else 0.")
      .def("nodal_area", &nodal_area, "x"_a, "(N,) tributary area of the surfaces' nodes at positions x (N, 3).")
      .def_property_readonly(
          "nodes_in_contact", [](const HeldInterface& i) { return copy(i.interface.nodes_in_contact()); },
          "(K,) held nodes that touch now: indices, each once")
      .def_property_readonly(
          "nodes_crossed", [](const HeldInterface& i) { return copy(i.interface.nodes_crossed()); },
          "(K,) nodes that StepResult.crossed of the last evaluate() counts: indices")
      .def_property_readonly(
          "nodes_lost", [](const HeldInterface& i) { return copy(i.interface.nodes_lost()); },
          "(K,) nodes that StepResult.lost of the last evaluate() counts: indices")
      .def("projections", &projections, "x"_a, py::kw_only(), "move_surface"_a = false,
           "Moves that take initial penetrations away, for the host to apply before it starts: nodes (K,) and moves (K, 3).")
      .def("history", &history, "Friction anchors, held pairs, energies and previous forces as bytes, for a checkpoint.")
      .def("record", &record, "path"_a, "label"_a = "",
           "From now on all inputs go to a file that replay() and `abut replay` make again; results do not change by it.\n\n"
           "The log begins with the history so far: 48 bytes per node and step. label: what the host calls itself and the job.\n"
           "Raises OSError when the file cannot be opened; later calls raise RuntimeError when it cannot be written.")
      .def("stop_recording", &stop_recording, "Ends the log and closes its file; the end of the interface does it too.")
      .def("restore", &restore, "history"_a,
           "Takes the history of an equal interface. Raises ValueError when it is a foreign or damaged one.");
}

}  // namespace

void bind_contact(py::module_& m) {
  bind_surface(m);
  bind_interface(m);
}

}  // namespace abut::python
