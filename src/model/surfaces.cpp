// /SURF (deck-format.md C.5, C.6).
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "deck/text.hpp"
#include "model/sets.hpp"

namespace abut::model {

namespace {

/// Nodes of a segment as a face (no repeated node).
Face face_of(const std::array<Index, 4>& n) { return {n[0], n[1], n[2], n[3] == n[2] ? no_index : n[3]}; }

}  // namespace

void SetReader::add_shell(Index shell, bool reversed, std::vector<Segment>& out) const {
  const auto& n = m_.shells.nodes[static_cast<std::size_t>(shell)];
  out.push_back({reversed ? reversed_nodes(n) : n, {ElementKind::shell4, shell}});
}

void SetReader::add_sh3n(Index sh3n, bool reversed, std::vector<Segment>& out) const {
  const auto& n = m_.sh3ns.nodes[static_cast<std::size_t>(sh3n)];
  const std::array<Index, 4> nodes{n[0], n[1], n[2], n[2]};
  out.push_back({reversed ? reversed_nodes(nodes) : nodes, {ElementKind::shell3, sh3n}});
}

/// Faces of `solids`; external ones are those that no candidate shares and that no segment of `shells` covers (C.6, rules 4 and 5).
void SetReader::add_solids(const Members& solids, const Members& candidates, Faces faces, const std::vector<Segment>& shells,
                           std::vector<Segment>& out) const {
  if (faces == Faces::all) {
    for (const Index s : solids) {
      for (const Face& f : solid_faces(m_, s)) {
        if (f[0] != no_index) out.push_back({segment_nodes(f), solid_ref(m_, s)});
      }
    }
    return;
  }
  std::vector<Face> covered;
  covered.reserve(shells.size());
  for (const Segment& s : shells) covered.push_back(sorted_face(face_of(s.nodes)));
  std::sort(covered.begin(), covered.end());
  for (const SolidFace& f : external_faces(m_, solids, candidates)) {
    if (covered.empty() || !std::binary_search(covered.begin(), covered.end(), sorted_face(f.face))) {
      out.push_back({segment_nodes(f.face), solid_ref(m_, f.solid)});
    }
  }
}

void SetReader::add_parts(BlockReader& r, const SignedParts& parts, Faces faces, std::vector<Segment>& out) {
  // Positive ids come first; a part that is listed with both signs counts as positive.
  std::vector<std::pair<Index, bool>> listed;
  std::vector<bool> seen(m_.parts.size(), false);
  for (const bool reversed : {false, true}) {
    for (const Index p : reversed ? parts.minus : parts.plus) {
      if (seen[static_cast<std::size_t>(p)]) continue;
      seen[static_cast<std::size_t>(p)] = true;
      listed.emplace_back(p, reversed);
    }
  }
  std::vector<Segment> shells;
  for (const auto& [p, reversed] : listed) {
    for (const Index e : part_shells_[static_cast<std::size_t>(p)]) add_shell(e, reversed, shells);
  }
  for (const auto& [p, reversed] : listed) {
    for (const Index e : part_sh3ns_[static_cast<std::size_t>(p)]) add_sh3n(e, reversed, shells);
  }
  Members solids;
  for (const auto& [p, reversed] : listed) {
    const Members& own = part_solids_[static_cast<std::size_t>(p)];
    if (!own.empty() && faces == Faces::none) {
      c_.diagnostics->error("model.solids_in_surface", r.place(),
                            fmt::format("part {} holds solids: use /SURF/.../EXT for their outer faces or /SURF/.../ALL for all",
                                        m_.parts[static_cast<std::size_t>(p)].id));
    }
    solids.insert(solids.end(), own.begin(), own.end());
  }
  out.insert(out.end(), shells.begin(), shells.end());
  if (faces == Faces::none) return;
  make_set(solids);
  add_solids(solids, solids, faces, shells, out);
}

void SetReader::add_element_groups(BlockReader& r, SetFamily family, std::vector<Segment>& out) {
  const SignedIds ids = signed_ids(r, "group_ID");
  std::vector<Id> missing;
  for (const bool reversed : {false, true}) {
    for (const Id id : reversed ? ids.minus : ids.plus) {
      const Members* group = members(family, id);
      if (group == nullptr) {
        missing.push_back(id);
        continue;
      }
      for (const Index e : *group) {
        if (family == SetFamily::grshel) add_shell(e, reversed, out);
        if (family == SetFamily::grsh3n) add_sh3n(e, reversed, out);
      }
    }
  }
  warn_missing(r, family_name(family), missing);
}

void SetReader::add_solid_groups(BlockReader& r, bool free_faces, std::vector<Segment>& out) {
  const Members solids = combine_groups_of_solids(r);
  Members everything;
  if (free_faces) {
    everything.resize(static_cast<std::size_t>(solid_count(m_)));
    std::iota(everything.begin(), everything.end(), Index{0});
  }
  add_solids(solids, free_faces ? everything : solids, Faces::external, {}, out);
}

/// Shells and solid faces with all (or any) of their nodes in the boxes; external faces are those of the whole model.
void SetReader::add_box(BlockReader& r, bool any, Faces faces, std::vector<Segment>& out) {
  const std::vector<bool> in = inside_boxes(r);
  for (const Index e : elements_inside(SetFamily::grshel, in, any)) add_shell(e, false, out);
  for (const Index e : elements_inside(SetFamily::grsh3n, in, any)) add_sh3n(e, false, out);
  if (faces == Faces::none) return;
  Members everything(static_cast<std::size_t>(solid_count(m_)));
  std::iota(everything.begin(), everything.end(), Index{0});
  std::vector<Segment> all_faces;
  add_solids(everything, everything, faces, out, all_faces);
  for (const Segment& s : all_faces) {
    const auto inside = [&](Index n) { return in[static_cast<std::size_t>(n)]; };
    if (any ? std::any_of(s.nodes.begin(), s.nodes.end(), inside) : std::all_of(s.nodes.begin(), s.nodes.end(), inside)) out.push_back(s);
  }
}

std::optional<Segment> SetReader::read_segment(BlockReader& r, int first_column) {
  static constexpr std::array<std::string_view, 4> names{"n1", "n2", "n3", "n4"};
  Segment s;
  bool good = true;
  for (std::size_t k = 0; k < 4; ++k) {
    const deck::Columns columns{first_column + 10 * static_cast<int>(k), first_column + 10 * static_cast<int>(k) + 9};
    const Id id = r.integer(columns, names[k]);
    if (id == 0 && k == 3) {
      s.nodes[3] = s.nodes[2];
      continue;
    }
    if (id == 0)
      r.error("model.missing_node", columns, names[k], "a segment needs three or four nodes; the first field is the segment's own id");
    s.nodes[k] = r.resolve(c_.tables.nodes, id, "/NODE", columns, names[k]);
    good = good && s.nodes[k] != no_index;
  }
  if (!good) return std::nullopt;
  std::array<Vec3, 4> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = m_.node_x[static_cast<std::size_t>(s.nodes[k])];
  const double size = std::max(squared_norm(x[2] - x[0]), squared_norm(x[3] - x[1]));
  constexpr double flat = 1e-12;
  if (!(facet_area(x) > flat * size)) {
    r.error("model.zero_area", {first_column, first_column + 39}, "n1-n4", fmt::format("the segment has no area: {}", why_no_area(x)));
    return std::nullopt;
  }
  if (s.nodes[3] != s.nodes[2] && turned_corners(x) > 1) {
    r.error("model.crossed_sides", {first_column, first_column + 39}, "n1-n4",
            "sides of the segment cross: list its nodes one after the other around its border");
    return std::nullopt;
  }
  if (!node_elements_) node_elements_.emplace(m_);
  s.element = node_elements_->behind(m_, s.nodes);
  return s;
}

void SetReader::read_segments(BlockReader& r, std::vector<Segment>& out) {
  while (r.next_card()) {
    if (r.blank({1, 100})) continue;
    (void)r.integer({1, 10}, "seg_ID");
    if (const std::optional<Segment> s = read_segment(r, 11)) out.push_back(*s);
  }
}

void SetReader::evaluate_surface(Item& item) {
  const deck::Block& b = *item.block;
  BlockReader r(c_, b, item.id_word, true);
  item.title = r.title();
  const std::string type = deck::to_upper(b.word(1));
  const std::string option = item.id_word == 3 ? deck::to_upper(b.word(2)) : std::string();
  const Faces faces = option == "EXT" ? Faces::external : (option == "ALL" ? Faces::all : Faces::none);
  std::vector<Segment>& out = item.segments;
  bool known = true;
  if (option == "FREE" && type != "GRBRIC") {
    known = false;
  } else if (type == "SEG") {
    read_segments(r, out);
  } else if (type == "GRSHEL" || type == "GRSH3N") {
    add_element_groups(r, type == "GRSHEL" ? SetFamily::grshel : SetFamily::grsh3n, out);
  } else if (type == "GRBRIC" && (option == "EXT" || option == "FREE")) {
    add_solid_groups(r, option == "FREE", out);
  } else if (type == "GRBRIC") {
    c_.diagnostics->error("model.unknown_type", r.place(), "/SURF/GRBRIC needs a choice of faces: /SURF/GRBRIC/EXT or /SURF/GRBRIC/FREE");
    return;
  } else if (type == "SURF" || type == "DSURF") {
    const SignedIds ids = signed_ids(r, "surf_ID");
    std::vector<Id> missing;
    for (const bool reversed : {false, true}) {
      for (const Id id : reversed ? ids.minus : ids.plus) {
        const std::vector<Segment>* other = segments(id);
        if (other == nullptr) {
          missing.push_back(id);
          continue;
        }
        for (const Segment& s : *other) out.push_back({reversed ? reversed_nodes(s.nodes) : s.nodes, s.element});
      }
    }
    warn_missing(r, "/SURF", missing);
  } else if (type == "BOX" || type == "BOX2") {
    add_box(r, type == "BOX2", faces, out);
  } else if (const std::optional<SignedParts> parts = parts_of(r, type, signed_ids(r, "ID"))) {
    add_parts(r, *parts, faces, out);
  } else {
    known = false;
  }
  if (!known) {
    c_.diagnostics->error(
        "model.unknown_type", r.place(),
        fmt::format("type '{}' of /SURF is not supported: SEG, PART, SUBSET, MAT, PROP (with /EXT or /ALL for solids), GRSHEL, GRSH3N, "
                    "GRBRIC/EXT, GRBRIC/FREE, SURF and BOX are",
                    deck::printable(b.word(1))));
    return;
  }
  if (out.empty()) c_.diagnostics->warning("model.empty_surface", r.place(), "the surface holds no segment");
}

}  // namespace abut::model
