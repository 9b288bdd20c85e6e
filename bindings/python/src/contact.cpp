// Surfaces and interfaces for hosts written in Python.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "arrays.hpp"
#include "core/fingerprint.hpp"
#include "files.hpp"
#include "held_interface.hpp"
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
  h.mass = masses(mass, count);
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

void check_step(double dt) {
  if (!(dt > 0.0 && dt < 1e30)) throw py::value_error("dt must be positive");
}

void commit(HeldInterface& i, double dt) {
  check_step(dt);
  const Work work(i);
  if (!i.evaluated) throw std::runtime_error("commit() comes after evaluate()");
  i.interface.commit(dt);
  i.step_before = i.last_step;
  i.last_step = dt;
  i.evaluated = false;
}

StepResult step(HeldInterface& i, const ArrayLike& x, const ArrayLike& v, const ArrayLike& force, const ArrayLike& stiffness, double dt,
                const std::optional<ArrayLike>& mass, double time) {
  check_step(dt);  // before anything is added
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
  if (threads < 1 || threads > parallel::most_threads) {
    throw py::value_error("threads must be 1 to " + std::to_string(parallel::most_threads));
  }
  const Work work(i);
  constexpr std::size_t grain = 4;  // pieces of a loop that are worth a thread
  auto pool = threads > 1 ? std::make_shared<parallel::ThreadPool>(threads) : nullptr;
  i.interface.set_executor(
      pool == nullptr ? contact::Executor{} : [pool](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        pool->for_ranges(count, grain, [&body](std::size_t begin, std::size_t end) { body(begin, end); });
      });
  i.pool = std::move(pool);
}

std::uint64_t checksum(std::string_view bytes) {
  Fingerprint sum;
  sum.add_bytes(bytes);
  return sum.value();
}

/// A checksum over what follows it: the two steps that this binding keeps, and the library's blob.
py::bytes history(HeldInterface& i) {
  const Work work(i);
  const std::array<double, 2> steps{i.last_step, i.step_before};
  const std::vector<std::byte> blob = i.interface.history();
  std::string bytes(sizeof(std::uint64_t) + sizeof steps + blob.size(), '\0');
  std::memcpy(bytes.data() + sizeof(std::uint64_t), steps.data(), sizeof steps);
  if (!blob.empty()) std::memcpy(bytes.data() + sizeof(std::uint64_t) + sizeof steps, blob.data(), blob.size());
  const std::uint64_t sum = checksum(std::string_view(bytes).substr(sizeof(std::uint64_t)));
  std::memcpy(bytes.data(), &sum, sizeof sum);
  return bytes;
}

void restore(HeldInterface& i, const py::bytes& saved) {
  const auto whole = static_cast<std::string_view>(saved);
  std::uint64_t sum = 0;
  std::array<double, 2> steps{};
  if (whole.size() < sizeof sum + sizeof steps) throw py::value_error("this is not the history of an interface");
  std::memcpy(&sum, whole.data(), sizeof sum);
  const std::string_view bytes = whole.substr(sizeof sum);
  if (sum != checksum(bytes)) throw py::value_error("this is not the history of an interface, or it is damaged: its checksum is another");
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
  InterfaceClass interface(
      m, "Interface",
      "What is held, what holds it, and the three verbs of a step: search, evaluate, commit.\n\n"
      "N is the number of the host's nodes. Positions x and velocities v are (N, 3), those of central differences: x at t^n, v at\n"
      "the half step before. float64 arrays in C order are used without a copy. All three verbs leave the interpreter's lock free; a\n"
      "second thread that comes in meanwhile gets a RuntimeError.");
  bind_interface_looks(interface);
  interface
      .def_static("two_surfaces", &two_surfaces, "first"_a, "second"_a, "options"_a = Options{},
                  "Two passes; neither surface is main (TYPE3). Raises ValueError when a node lies on both.")
      .def_static("nodes_to_surface", &nodes_to_surface, "nodes"_a, "surface"_a, "options"_a = Options{}, py::kw_only(),
                  "node_stiffness"_a = py::none(),
                  "Nodes held against a surface, one pass (TYPE5). The surface is side 1.\n\n"
                  "nodes: (S,) indices, sorted by key. node_stiffness: (S,) their own stiffness, force/length, >= 0; None: half of the\n"
                  "facet's.")
      .def_static("both_sides", &both_sides, "nodes"_a, "surface"_a, "options"_a,
                  "Every pair of node and facet within the gap repels, on both sides (TYPE7). nodes: (S,) indices; the surface is side 1.")
      .def("set_surface", &set_surface, "side"_a, py::kw_only(), "stiffness"_a = py::none(), "thickness"_a = py::none(),
           "active"_a = py::none(), "node_active"_a = py::none(),
           "What changes about a side; None leaves what was set before.\n\n"
           "stiffness: (F,) own stiffness per facet, force/length: E t (shell) or B A^2/V (brick face). thickness: (F,) of shells.\n"
           "active: (F,) False for eroded facets. node_active: (S,) False lets a node go. For a side of nodes F is their number.")
      .def("set_threads", &set_threads, "threads"_a, "Loops over nodes run in this many threads, 1 to 4096; results do not depend on it.")
      .def("search", &search, "x"_a, "v"_a, py::kw_only(), "mass"_a = py::none(), "time"_a = 0.0, "dt"_a = py::none(),
           "Finds who can touch. Once per step, with the arguments that evaluate() will get.\n\n"
           "x: (N, 3) positions at t^n; v: (N, 3) velocities half a step before. time: t^n; dt: the step that\n"
           "ended at t^n, None: the last one committed. Raises ValueError when arrays are too short for the surfaces or not finite, for a\n"
           "negative mass, a time that is not finite, and a dt that is negative or not finite; RuntimeError where set_surface() never gave\n"
           "the stiffness of a side.")
      .def("evaluate", &evaluate, "x"_a, "v"_a, "force"_a, "stiffness"_a, py::kw_only(), "mass"_a = py::none(), "time"_a = 0.0,
           "dt"_a = py::none(),
           "Adds forces into force (N, 3) and nodal contact stiffness into stiffness (N,): float64, C order, writable.\n\n"
           "A host is stable with h <= sqrt(2 m/K) for the stiffness K of elements and contacts at every node.\n"
           "mass: (N,), 0 for a node that cannot move; time: t^n; dt: the step that ended at t^n, None: the last one committed.\n"
           "x: those of search(), of which a few are compared. Raises RuntimeError without a search() in this step and where they differ,\n"
           "ValueError as search().")
      .def("commit", &commit, "dt"_a,
           "Friction and energy history move on; dt > 0 is the step that the host takes now.\n\n"
           "Raises ValueError for a dt that is not positive, RuntimeError without an evaluate() in this step.")
      .def("step", &step, "x"_a, "v"_a, "force"_a, "stiffness"_a, py::kw_only(), "dt"_a, "mass"_a = py::none(), "time"_a = 0.0,
           "search, evaluate and commit in one call, for hosts that know their step beforehand.\n\n"
           "x, v: (N, 3) positions at t^n and velocities half a step before. force (N, 3) and stiffness (N,), float64 in C order and\n"
           "writable, are added to. mass: (N,), 0 for a node that cannot move. dt: the step that the host takes now; time: t^n.\n"
           "Raises ValueError for arrays of another shape or values that are not finite, and for a dt that is not positive.")
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
