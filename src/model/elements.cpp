// /SHELL, /SH3N, /BRICK, /TETRA4, /PENTA6 (deck-format.md B.3).
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "model/mesh.hpp"
#include "model/sort_by_id.hpp"
#include "model/topology.hpp"

namespace abut::model {

namespace {

constexpr double flat = 1e-12;  ///< an area below flat * (longest diagonal)^2, a volume below flat * its cube, is zero to rounding

/// Node id -> index; an array when ids are dense, which is what meshes look like.
class NodeLookup {
 public:
  explicit NodeLookup(const Context& c) : table_(c.tables.nodes) {
    const Ids& ids = c.model->node_id;
    if (ids.empty() || ids.back() - ids.front() > 4 * static_cast<Id>(ids.size()) + 1024) return;
    first_ = ids.front();
    dense_.assign(static_cast<std::size_t>(ids.back() - ids.front()) + 1, no_index);
    for (std::size_t k = 0; k < ids.size(); ++k) dense_[static_cast<std::size_t>(ids[k] - first_)] = static_cast<Index>(k);
  }
  [[nodiscard]] Index find(Id id) const {
    if (!dense_.empty())
      return id >= first_ && id - first_ < static_cast<Id>(dense_.size()) ? dense_[static_cast<std::size_t>(id - first_)] : no_index;
    const auto found = table_.find(id);
    return found == table_.end() ? no_index : found->second;
  }

 private:
  const Tables::Map& table_;
  Id first_ = 0;
  std::vector<Index> dense_;
};

enum class Family { shell, sh3n, brick, tetra, penta };

constexpr std::array<std::string_view, 8> node_fields{"n1", "n2", "n3", "n4", "n5", "n6", "n7", "n8"};

/// Elements of one table while they are read; where each was defined, for messages about duplicates.
template <std::size_t N>
struct Reading {
  Elements<N> elements;  ///< but for ids
  std::vector<Id> ids;
  struct Origin {
    const deck::Block* block;
    std::int32_t file, line;
  };
  std::vector<Origin> origins;

  void add(Id id, Index part, const std::array<Index, N>& nodes, double thickness, const deck::Block& b, const deck::Card& card) {
    ids.push_back(id);
    elements.part.push_back(part);
    elements.nodes.push_back(nodes);
    elements.thickness.push_back(thickness);
    origins.push_back({&b, card.file, card.line});
  }

  void finish(Context& c, std::string_view keyword, Elements<N>& out, Tables::Map& table) {
    const auto place_of = [&](std::size_t k) { return c.deck->place(*origins[k].block, {{}, origins[k].file, origins[k].line}); };
    const std::size_t n = ids.size();
    out.part.reserve(n);
    out.nodes.reserve(n);
    const bool own = std::any_of(elements.thickness.begin(), elements.thickness.end(), [](double t) { return t != 0.0; });
    if (own) out.thickness.reserve(n);
    table.reserve(n);
    std::size_t first = 0;
    for (const std::size_t k : ascending_order(ids)) {
      if (!out.id.empty() && out.id.back() == ids[k]) {
        report_duplicate(c, keyword, ids[k], place_of(k), place_of(first));
        continue;
      }
      first = k;
      table.emplace(ids[k], out.size());
      out.id.push_back(ids[k]);
      out.part.push_back(elements.part[k]);
      out.nodes.push_back(elements.nodes[k]);
      if (own) out.thickness.push_back(elements.thickness[k]);
    }
  }
};

class ElementReader {
 public:
  explicit ElementReader(Context& c) : c_(c), nodes_(c) {}

  void read() {
    for (const deck::Block& b : c_.deck->blocks) {
      if (b.is(0, "SHELL")) read_block(b, Family::shell);
      if (b.is(0, "SH3N")) read_block(b, Family::sh3n);
      if (b.is(0, "BRICK")) read_block(b, Family::brick);
      if (b.is(0, "TETRA4")) read_block(b, Family::tetra);
      if (b.is(0, "PENTA6")) read_block(b, Family::penta);
    }
    Model& m = *c_.model;
    shells_.finish(c_, "/SHELL", m.shells, c_.tables.shells);
    sh3ns_.finish(c_, "/SH3N", m.sh3ns, c_.tables.sh3ns);
    bricks_.finish(c_, "/BRICK", m.bricks, c_.tables.bricks);
    tetras_.finish(c_, "/TETRA4", m.tetras, c_.tables.tetras);
  }

 private:
  [[nodiscard]] const Vec3& x(Index node) const { return c_.model->node_x[static_cast<std::size_t>(node)]; }

  /// Whether the part can hold this kind of element; reports once per block.
  void check_part(BlockReader& r, Index part, bool solid) {
    const Part& p = c_.model->parts[static_cast<std::size_t>(part)];
    if (p.property == no_index) return;  // reported with the part
    const Property& property = c_.model->properties[static_cast<std::size_t>(p.property)];
    const bool empty = std::holds_alternative<VoidProperty>(property.data);
    const bool fits = solid ? std::holds_alternative<SolidProperty>(property.data) : std::holds_alternative<ShellProperty>(property.data);
    if (!empty && !fits) {
      c_.diagnostics->error("model.wrong_property", r.place(),
                            fmt::format("part {} has property {}, which is not for {}: {} is needed", p.id, property.id,
                                        solid ? "solids" : "shells", solid ? "/PROP/SOLID" : "/PROP/SHELL"));
    }
    if (!empty && fits && c_.part_lacks_material[static_cast<std::size_t>(part)]) {
      c_.diagnostics->error("model.missing_material", r.place(),
                            fmt::format("part {} has elements but no material: give it a mat_ID", p.id));
    }
  }

  void read_block(const deck::Block& b, Family family) {
    BlockReader r(c_, b, 1, false);
    Index part = no_index;
    if (r.id() > 0) {
      const auto found = c_.tables.parts.find(r.id());
      if (found == c_.tables.parts.end()) {
        c_.diagnostics->error("model.unknown_reference", r.place(), fmt::format("no /PART with id {}", r.id()));
      } else {
        part = found->second;
        if (!b.cards.empty()) check_part(r, part, family != Family::shell && family != Family::sh3n);
      }
    }
    const std::size_t count = family == Family::sh3n                               ? 3
                              : family == Family::shell || family == Family::tetra ? 4
                              : family == Family::penta                            ? 6
                                                                                   : 8;
    turned_ = {};
    concave_ = {};
    for (const deck::Card& card : b.cards) {
      r.next_card();
      if (deck::field_text(card.text, {1, 100}).empty()) continue;
      const Id id = r.integer({1, 10}, "id");
      if (id <= 0) {
        if (deck::parse_integer(r.text({1, 10})))
          r.error("deck.bad_id", {1, 10}, "id", fmt::format("{} is not an id: a positive integer is needed", id));
        continue;
      }
      std::array<Index, 8> nodes;
      nodes.fill(no_index);
      const std::size_t given = read_node_fields(r, family, id, count, nodes);
      if (given == 0 || part == no_index) continue;
      switch (family) {
        case Family::shell:
          add_shell(r, id, part, nodes, b, card);
          break;
        case Family::sh3n:
          add_sh3n(r, id, part, nodes, b, card);
          break;
        case Family::tetra:
          add_tetra(r, id, part, nodes, b, card);
          break;
        case Family::penta:
          add_brick(r, id, part, nodes, 6, b, card);
          break;
        case Family::brick:
          add_brick(r, id, part, nodes, given, b, card);
          break;
      }
    }
    if (turned_.count > 0) {
      c_.diagnostics->warning(
          "model.negative_volume", r.place(),
          fmt::format("{} elements with negative volume were turned inside out, the first is {}", turned_.count, turned_.first));
    }
    if (concave_.count > 0) {
      const bool shells = family == Family::shell;
      c_.diagnostics->warning(
          shells ? "model.concave_shell" : "model.concave_brick", r.place(),
          shells ? fmt::format("{} shells have a corner beyond 180 degrees, the first is {}: no quadrilateral element is right there, "
                               "make two triangles of each",
                               concave_.count, concave_.first)
                 : fmt::format("{} bricks have a corner that is turned inside out, the first is {}: no brick is right there, mesh it anew",
                               concave_.count, concave_.first));
    }
  }

  /// Reads the nodes; returns how many places they take (4, 6 or 8 for a brick), 0 after a fault.
  std::size_t read_node_fields(BlockReader& r, Family family, Id id, std::size_t count, std::array<Index, 8>& nodes) {
    std::size_t used = 0;
    bool good = true;
    std::array<bool, 8> given{};
    for (std::size_t k = 0; k < count; ++k) {
      const deck::Columns columns{static_cast<int>(10 * k + 11), static_cast<int>(10 * k + 20)};
      const Id node = r.integer(columns, node_fields[k]);
      if (node == 0) continue;
      given[k] = true;
      used = k + 1;
      nodes[k] = nodes_.find(node);
      if (nodes[k] == no_index) {
        r.error("model.unknown_reference", columns, node_fields[k], fmt::format("no /NODE with id {}", node));
        good = false;
      }
    }
    std::size_t needed = count;
    if (family == Family::shell && used == 3) needed = 3;
    if (family == Family::brick) needed = used <= 4 ? 4 : (used <= 6 ? 6 : 8);
    for (std::size_t k = 0; k < needed; ++k) {
      if (given[k]) continue;
      const deck::Columns columns{static_cast<int>(10 * k + 11), static_cast<int>(10 * k + 20)};
      r.error("model.missing_node", columns, node_fields[k], fmt::format("element {} lacks this node: a node id is needed", id));
      good = false;
    }
    return good ? needed : 0;
  }

  double read_thickness(BlockReader& r) {
    const double t = r.real({81, 100}, "Thick", dim::length);
    if (t < 0.0)
      r.error("model.negative_thickness", {81, 100}, "Thick",
              fmt::format("{:g} is negative: a thickness is positive, or 0 for that of the property", t));
    return std::max(t, 0.0);
  }

  bool check_area(BlockReader& r, Id id, const std::array<Index, 4>& n) {
    const std::array<Vec3, 4> p{x(n[0]), x(n[1]), x(n[2]), x(n[3])};
    const double size = std::max(squared_norm(p[2] - p[0]), squared_norm(p[3] - p[1]));
    if (facet_area(p) > flat * size) return true;
    r.error("model.zero_area", {11, 50}, "n1-n4", fmt::format("element {} has no area: {}", id, why_no_area(p)));
    return false;
  }

  void add_shell(BlockReader& r, Id id, Index part, const std::array<Index, 8>& nodes, const deck::Block& b, const deck::Card& card) {
    const bool triangle = nodes[3] == no_index || nodes[3] == nodes[2];
    const std::array<Index, 4> n{nodes[0], nodes[1], nodes[2], triangle ? nodes[2] : nodes[3]};
    const double thickness = read_thickness(r);
    if (!check_area(r, id, n)) return;
    const int turned = triangle ? 0 : turned_corners({x(n[0]), x(n[1]), x(n[2]), x(n[3])});
    if (turned > 1) {
      r.error("model.crossed_sides", {11, 50}, "n1-n4",
              fmt::format("sides of shell {} cross: list its nodes one after the other around its border", id));
      return;
    }
    if (turned == 1) concave_.add(id);
    if (triangle) r.warning("model.degenerate_shell", {41, 50}, "n4", fmt::format("shell {} is a triangle: /SH3N is better", id));
    shells_.add(id, part, n, thickness, b, card);
  }

  void add_sh3n(BlockReader& r, Id id, Index part, const std::array<Index, 8>& nodes, const deck::Block& b, const deck::Card& card) {
    const double thickness = read_thickness(r);
    if (!check_area(r, id, {nodes[0], nodes[1], nodes[2], nodes[2]})) return;
    sh3ns_.add(id, part, {nodes[0], nodes[1], nodes[2]}, thickness, b, card);
  }

  /// -1, 0 or 1: sign of a volume, 0 when it is zero to rounding.
  [[nodiscard]] int sign(double volume, std::span<const Index> n) const {
    double size = 0.0;
    for (const Index k : n) size = std::max(size, squared_norm(x(k) - x(n[0])));
    if (!(std::abs(volume) > flat * size * std::sqrt(size))) return 0;
    return volume > 0.0 ? 1 : -1;
  }

  void report_zero_volume(BlockReader& r, Id id) {
    r.error("model.zero_volume", {11, 90}, "n1-n8",
            fmt::format("element {} has no volume: its nodes must not lie in one plane or coincide", id));
  }

  /// Orders the four nodes so that the volume is positive; false: no volume.
  bool orient_tetra(BlockReader& r, Id id, std::array<Index, 4>& n) {
    const int s = sign(tetra_volume({x(n[0]), x(n[1]), x(n[2]), x(n[3])}), n);
    if (s == 0) report_zero_volume(r, id);
    if (s < 0) {
      std::swap(n[1], n[3]);
      turned_.add(id);
    }
    return s != 0;
  }

  void add_tetra(BlockReader& r, Id id, Index part, const std::array<Index, 8>& nodes, const deck::Block& b, const deck::Card& card) {
    std::array<Index, 4> n{nodes[0], nodes[1], nodes[2], nodes[3]};
    if (orient_tetra(r, id, n)) tetras_.add(id, part, n, 0.0, b, card);
  }

  void add_brick(BlockReader& r, Id id, Index part, const std::array<Index, 8>& nodes, std::size_t given, const deck::Block& b,
                 const deck::Card& card) {
    std::array<Index, 8> n = nodes;
    if (given == 4) {
      std::array<Index, 4> t{nodes[0], nodes[1], nodes[2], nodes[3]};
      if (!orient_tetra(r, id, t)) return;
      bricks_.add(id, part, {t[0], t[0], t[1], t[1], t[3], t[2], t[2], t[3]}, 0.0, b, card);
      return;
    }
    const auto corners = [&] {
      std::array<Vec3, 8> p;
      std::transform(n.begin(), n.end(), p.begin(), [this](Index k) { return x(k); });
      return p;
    };
    if (given == 6) n = {nodes[0], nodes[1], nodes[2], nodes[0], nodes[3], nodes[4], nodes[5], nodes[3]};
    const int s = sign(one_point_volume(corners()), n);
    if (s == 0) {
      report_zero_volume(r, id);
      return;
    }
    // Bottom and top change places; for a pentahedron this is the exchange of its two triangles.
    if (s < 0) std::swap_ranges(n.begin(), n.begin() + 4, n.begin() + 4);
    if (given == 8 && !check_corners(r, id, n, corners())) return;
    if (s < 0) turned_.add(id);
    bricks_.add(id, part, n, 0.0, b, card);
  }

  /// Reports a brick of eight nodes that folds through itself: sides of a face cross, or a node lies beyond those opposite to it, which
  /// turns its corner and those of its neighbours inside out. One or two such corners alone are what a corner beyond 180 degrees is to a
  /// shell.
  bool check_corners(BlockReader& r, Id id, std::array<Index, 8> n, const std::array<Vec3, 8>& p) {
    const int inverted = inverted_corners(p);
    if (inverted == 0) return true;
    std::sort(n.begin(), n.end());
    if (std::adjacent_find(n.begin(), n.end()) != n.end()) return true;  // a collapsed form
    if (inverted < 3 && !has_crossed_face(p)) {
      concave_.add(id);
      return true;
    }
    r.error("model.inverted_brick", {11, 90}, "n1-n8",
            fmt::format("brick {} folds through itself ({} of its corners are inside out): list the nodes of one face one after the other "
                        "around its border, then those of the opposite face in the same order, and look where its nodes lie",
                        id, inverted));
    return false;
  }

  Context& c_;
  NodeLookup nodes_;
  Reading<4> shells_;
  Reading<3> sh3ns_;
  Reading<8> bricks_;
  Reading<4> tetras_;
  /// Elements of a block of which one message speaks.
  struct Counted {
    int count = 0;
    Id first = 0;
    void add(Id id) {
      if (count++ == 0) first = id;
    }
  };
  Counted turned_, concave_;
};

}  // namespace

void read_elements(Context& c) { ElementReader(c).read(); }

}  // namespace abut::model
