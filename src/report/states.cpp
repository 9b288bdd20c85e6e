#include "report/states.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

#include "core/diagnostic.hpp"
#include "report/faces.hpp"
#include "report/grid.hpp"

namespace abut::report {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// A field of the page, made from one of the animation.
struct Shown {
  std::string name;
  bool on_nodes = true;
  int components = 1;
  std::string source;  ///< field of the animation
  int source_components = 1;
  std::function<void(const float* from, float* to)> make;  ///< one value; none: as it is
};

float length_of(const float* v) { return static_cast<float>(std::sqrt(double(v[0]) * v[0] + double(v[1]) * v[1] + double(v[2]) * v[2])); }

/// Values of a report beyond which only the fields that everybody looks at go in.
constexpr double many_values = 4e6;

/// Fields of the page for what the first state has. Small runs: all of it. Large ones: no components of stress, speed instead of velocity.
std::vector<Shown> choose_fields(const Grid& first, bool all) {
  std::vector<Shown> shown;
  const auto length = [](const float* from, float* to) { *to = length_of(from); };
  const auto add = [&](bool on_nodes, const char* source, int source_components, const char* name, int components, auto make) {
    const Field* field = Grid::find(on_nodes ? first.node_fields : first.cell_fields, source);
    if (field == nullptr || field->components != source_components) return;
    shown.push_back({name, on_nodes, components, source, source_components, make});
  };
  const std::function<void(const float*, float*)> as_it_is;
  add(true, "displacement", 3, "displacement", 3, as_it_is);
  if (all) {
    add(true, "velocity", 3, "velocity", 3, as_it_is);
  } else {
    add(true, "velocity", 3, "speed", 1, length);
  }
  add(true, "contact_pressure_normal", 3, "contact_pressure", 1, length);
  add(true, "contact_gap", 1, "contact_gap", 1, as_it_is);
  add(true, "contact_penetration", 1, "contact_penetration", 1, as_it_is);
  add(true, "contact_state", 1, "contact_state", 1, as_it_is);
  if (all) {
    add(true, "contact_pressure_tangential", 3, "contact_shear", 1, length);
    add(true, "contact_force", 3, "contact_force", 3, as_it_is);
  }
  add(false, "plastic_strain", 1, "plastic_strain", 1, as_it_is);
  add(false, "von_mises", 1, "von_mises", 1, as_it_is);
  if (Grid::find(first.cell_fields, "pressure") == nullptr) {
    add(false, "stress", 6, "pressure", 1, [](const float* from, float* to) { *to = -(from[0] + from[1] + from[2]) / 3.0f; });
  }
  if (!all) return shown;
  add(false, "stress", 6, "stress", 6, as_it_is);
  const auto known = [&](const std::string& name) {
    static constexpr const char* taken[] = {"contact_pressure_normal", "contact_pressure_tangential"};
    return std::any_of(shown.begin(), shown.end(), [&](const Shown& s) { return s.source == name; }) ||
           std::find(std::begin(taken), std::end(taken), name) != std::end(taken);
  };
  for (const bool on_nodes : {true, false}) {
    for (const Field& f : on_nodes ? first.node_fields : first.cell_fields) {
      if (!known(f.name)) shown.push_back({f.name, on_nodes, f.components, f.name, f.components, as_it_is});
    }
  }
  return shown;
}

/// Values of a field at some of its owners.
std::vector<float> gather(const Shown& shown, const Field& field, const std::vector<Index>& owners) {
  const auto width = static_cast<std::size_t>(shown.components);
  std::vector<float> out(owners.size() * width, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < owners.size(); ++i) {
    if (owners[i] == no_index) continue;
    const float* from = &field.values[at(owners[i]) * static_cast<std::size_t>(field.components)];
    if (shown.make) {
      shown.make(from, &out[i * width]);
    } else {
      std::copy(from, from + width, &out[i * width]);
    }
  }
  return out;
}

/// Smallest and largest length of vectors.
std::array<double, 2> lengths(const std::vector<float>& values) {
  std::array<double, 2> out{};
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) {
    const auto l = static_cast<double>(length_of(&values[i]));
    if (!std::isfinite(l)) continue;
    out = i == 0 ? std::array{l, l} : std::array{std::min(out[0], l), std::max(out[1], l)};
  }
  return out;
}

/// Cells of `first` that are in `later`: their place there, else no_index. Later states keep the order and leave cells out.
std::vector<Index> places(const std::vector<Cell>& first, const std::vector<Cell>& later) {
  std::vector<Index> out(first.size(), no_index);
  std::size_t next = 0;
  for (std::size_t c = 0; c < first.size() && next < later.size(); ++c) {
    if (first[c].shape == later[next].shape && first[c].id == later[next].id) out[c] = static_cast<Index>(next++);
  }
  if (next != later.size()) throw RunError("an animation state has elements that the first state does not have");
  return out;
}

std::vector<std::uint8_t> marks(const std::vector<Index>& places, bool of_present) {
  std::vector<std::uint8_t> out;
  for (const Index p : places) out.push_back((p != no_index) == of_present ? 1 : 0);
  return out;
}

/// Numbers the marked ones 0, 1, 2, ...
std::vector<Index> number(const std::vector<std::uint8_t>& marked, std::vector<Index>& chosen) {
  std::vector<Index> out(marked.size(), no_index);
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] == 0) continue;
    out[i] = static_cast<Index>(chosen.size());
    chosen.push_back(static_cast<Index>(i));
  }
  return out;
}

/// The mesh of a report: what is seen, with numbers of its own.
struct Mesh {
  FaceSet faces;
  std::vector<Index> nodes, cells;  ///< of the first state
  std::vector<Index> node_number, cell_number;
};

Mesh make_mesh(const Grid& first, const std::vector<std::uint8_t>& erodes, const std::vector<ContactSurface>& contact) {
  Mesh mesh{FaceSet(first.cells, erodes), {}, {}, {}, {}};
  std::vector<std::uint8_t> node(first.points.size() / 3), cell(first.cells.size());
  for (const Face& f : mesh.faces.faces()) {
    for (const Index n : f.nodes) node[at(n)] = 1;
    cell[at(f.cell)] = 1;
  }
  for (const ContactSurface& s : contact) {
    for (const auto& segment : s.segments) {
      for (const Index n : segment) node[at(n)] = 1;
    }
  }
  mesh.node_number = number(node, mesh.nodes);
  mesh.cell_number = number(cell, mesh.cells);
  return mesh;
}

Json segments_json(const ContactSurface& s, const Mesh& mesh, ChunkStore& store) {
  std::vector<std::uint32_t> nodes;
  for (const auto& segment : s.segments) {
    for (const Index n : segment) nodes.push_back(static_cast<std::uint32_t>(mesh.node_number[at(n)]));
  }
  return {{"interface", s.interface}, {"side", s.side}, {"surface", s.surface}, {"segments", store.add(integers(nodes, 4))}};
}

Json mesh_json(const Grid& first, const Mesh& mesh, ChunkStore& store) {
  const Field* displacement = Grid::find(first.node_fields, "displacement");
  const auto initial = [&](Index n, std::size_t c) {
    const double moved =
        displacement != nullptr && displacement->components == 3 ? static_cast<double>(displacement->values[3 * at(n) + c]) : 0.0;
    return first.points[3 * at(n) + c] - moved;
  };
  std::array<double, 3> origin{};
  for (std::size_t c = 0; c < 3; ++c) {
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const Index n : mesh.nodes) {
      low = std::min(low, initial(n, c));
      high = std::max(high, initial(n, c));
    }
    origin[c] = mesh.nodes.empty() ? 0.0 : 0.5 * (low + high);
  }
  std::vector<float> x;
  std::vector<std::int64_t> node_id, element_id;
  std::vector<std::uint32_t> corners, face_element, element_part;
  for (const Index n : mesh.nodes) {
    for (std::size_t c = 0; c < 3; ++c) x.push_back(static_cast<float>(initial(n, c) - origin[c]));
    node_id.push_back(first.node_id.empty() ? n + 1 : first.node_id[at(n)]);
  }
  for (const Face& f : mesh.faces.faces()) {
    for (const Index n : f.nodes) corners.push_back(static_cast<std::uint32_t>(mesh.node_number[at(n)]));
    face_element.push_back(static_cast<std::uint32_t>(mesh.cell_number[at(f.cell)]));
  }
  std::map<Id, std::uint32_t> part_number;
  for (const Cell& c : first.cells) part_number.try_emplace(c.part, 0);
  Json parts = Json::array();
  for (auto& [id, index] : part_number) {
    index = static_cast<std::uint32_t>(parts.size());
    parts.push_back(id);
  }
  std::vector<std::size_t> part_elements(parts.size());
  for (const Cell& c : first.cells) ++part_elements[part_number[c.part]];
  std::vector<std::uint8_t> shape;
  for (const Index c : mesh.cells) {
    const Cell& cell = first.cells[at(c)];
    element_id.push_back(cell.id);
    element_part.push_back(part_number[cell.part]);
    shape.push_back(static_cast<std::uint8_t>(cell.shape));
  }
  return {{"origin", origin},
          {"points", store.add(singles(x, 3))},
          {"node_id", store.add(identifiers(node_id))},
          {"faces", store.add(integers(corners, 4))},
          {"face_element", store.add(integers(face_element, 1))},
          {"element_id", store.add(identifiers(element_id))},
          {"element_part", store.add(integers(element_part, 1))},
          {"element_shape", store.add(bytes(shape))},
          {"parts", parts},
          {"part_elements", part_elements},
          {"elements_total", first.cells.size()},
          {"nodes_total", first.points.size() / 3}};
}

}  // namespace

Json ChunkStore::add(Chunk chunk) {
  Json j{{"id", -1}, {"kind", chunk.kind}, {"count", chunk.count}, {"components", chunk.components}};
  if (!chunk.low.empty()) {
    j["low"] = chunk.low;
    j["high"] = chunk.high;
  }
  if (chunk.text.empty()) return j;
  j["id"] = texts_.size();
  texts_.push_back(std::move(chunk.text));
  return j;
}

std::vector<StateFile> read_index(const std::filesystem::path& index) {
  std::vector<StateFile> out;
  std::ifstream in(index);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  static const std::regex entry("<DataSet timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
  for (std::sregex_iterator i(all.begin(), all.end(), entry), end; i != end; ++i) {
    std::string name = (*i)[2];
    for (const auto& [code, character] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}}) {
      for (std::size_t p = name.find(code); p != std::string::npos; p = name.find(code, p + 1)) {
        name.replace(p, std::string_view(code).size(), character);
      }
    }
    const std::string time = (*i)[1];
    char* rest = nullptr;
    out.push_back({std::strtod(time.c_str(), &rest), index.parent_path() / name});
    if (rest == time.c_str()) throw RunError(index.string() + ": '" + time + "' is not a time");
  }
  return out;
}

/// The first state that can be read. @throws RunError of the first of all when there is none
Grid first_readable(const std::vector<StateFile>& states) {
  for (const StateFile& state : states) {
    try {
      return read_grid(state.file);
    } catch (const RunError&) {}
  }
  return read_grid(states.front().file);
}

/// Which elements are gone in the last state that can be read.
std::vector<std::uint8_t> gone_at_the_end(const std::vector<StateFile>& states, const std::vector<Cell>& first) {
  for (auto state = states.rbegin(); state != states.rend(); ++state) {
    try {
      return marks(places(first, read_grid(state->file, false).cells), false);
    } catch (const RunError&) {}
  }
  return std::vector<std::uint8_t>(first.size(), 0);
}

/// A state with its elements found in the first one, and the shown fields.
struct State {
  Grid grid;
  std::vector<Index> place;  ///< #cells of the first state
  std::vector<const Field*> fields;

  /// @throws RunError when it cannot be read or is not of the run of `first`
  State(const std::filesystem::path& file, const Grid& first, const std::vector<Shown>& shown) : grid(read_grid(file)) {
    const auto refuse = [&file](const std::string& why) { throw RunError(file.string() + ": " + why); };
    if (grid.points.size() != first.points.size() || grid.node_id != first.node_id) refuse("other nodes than the first state");
    place = places(first.cells, grid.cells);
    for (const Shown& s : shown) {
      fields.push_back(Grid::find(s.on_nodes ? grid.node_fields : grid.cell_fields, s.source));
      if (fields.back() == nullptr || fields.back()->components != s.source_components)
        refuse("no field " + s.source + " as in the first state");
    }
  }
};

Written add_states(const std::vector<StateFile>& states, const std::filesystem::path& contact_file, Fields choice, ChunkStore& store,
                   Json& document) {
  Written written;
  document["frames"] = Json::array();
  if (states.empty()) return written;
  const Grid first = first_readable(states);
  const std::vector<ContactSurface> contact = read_contact_surfaces(contact_file, first.node_id);
  const Mesh mesh = make_mesh(first, gone_at_the_end(states, first.cells), contact);
  const double all_values = static_cast<double>(mesh.nodes.size() + mesh.cells.size()) * static_cast<double>(states.size());
  const bool all = choice == Fields::all || all_values < many_values;
  const std::vector<Shown> shown = choose_fields(first, all);

  document["mesh"] = mesh_json(first, mesh, store);
  document["contact"] = Json::array();
  for (const ContactSurface& s : contact) document["contact"].push_back(segments_json(s, mesh, store));
  document["fields"] = Json::array();
  for (const Shown& s : shown) {
    document["fields"].push_back({{"name", s.name}, {"on", s.on_nodes ? "node" : "element"}, {"components", s.components}});
  }
  document["fields_left_out"] = !all;

  double highest = -1.0;
  for (const StateFile& file : states) {
    std::optional<State> state;
    try {
      state.emplace(file.file, first, shown);
    } catch (const RunError& error) {
      written.left_out.emplace_back(error.what());
      continue;
    }
    std::vector<Index> cells;
    for (const Index c : mesh.cells) cells.push_back(state->place[at(c)]);
    Json frame{{"time", file.time}, {"cycle", state->grid.cycle}, {"values", Json::array()}};
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const Shown& s = shown[i];
      const std::vector<float> values = gather(s, *state->fields[i], s.on_nodes ? mesh.nodes : cells);
      Chunk chunk = quantised(values, s.components);
      if (s.name == "contact_pressure" && chunk.high[0] > highest) {
        highest = chunk.high[0];
        document["first"] = document["frames"].size();
      }
      Json value = store.add(std::move(chunk));
      if (s.components == 3) value["norm"] = lengths(values);
      frame["values"].push_back(std::move(value));
    }
    const std::vector<std::uint8_t> hidden = mesh.faces.hidden(marks(state->place, true));
    if (std::find(hidden.begin(), hidden.end(), 1) != hidden.end()) {
      frame["hidden"] = store.add(bytes(hidden));
      frame["deleted"] = first.cells.size() - state->grid.cells.size();
    }
    document["frames"].push_back(std::move(frame));
  }
  written.states = document["frames"].size();
  if (!(highest > 0.0)) document["first"] = written.states - 1;
  document["states_left_out"] = written.left_out.size();
  written.nodes = mesh.nodes.size();
  written.faces = mesh.faces.faces().size();
  written.elements = first.cells.size();
  return written;
}

}  // namespace abut::report
