// /TH, /SECT and /ACCEL (deck-format.md F). Outputs cannot change the mechanics: what abut has not is left out with a warning.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "model/condition_fields.hpp"
#include "model/th_variables.hpp"

namespace abut::model {

namespace {

void read_section(Context& c, const deck::Block& block) {
  if (!is_id(block.word(1))) {
    c.diagnostics->warning("model.left_out", c.deck->place(block), "this form of section is not supported; it is left out (use /SECT/id)");
    return;
  }
  BlockReader r(c, block, 1, true);
  Section s;
  s.id = r.id();
  r.next_card();
  constexpr std::array<std::string_view, 3> names{"node_ID1", "node_ID2", "node_ID3"};
  for (int i = 0; i < 3; ++i) {
    const deck::Columns columns{10 * i + 1, 10 * i + 10};
    const auto k = static_cast<std::size_t>(i);
    s.frame_nodes[k] = r.resolve(c.tables.nodes, r.integer(columns, names[k]), "/NODE", columns, names[k]);
  }
  s.nodes = optional_group(r, {31, 40}, "grnd_ID");
  const Id save = r.integer({41, 50}, "Isave");
  if (save >= 100) {
    r.error("model.unsupported", {41, 50}, "Isave", fmt::format("reading motion from a cut file ({}) is not supported; write 0", save));
  } else if (save != 0) {
    r.warning("model.left_out", {41, 50}, "Isave", fmt::format("no cut file is written ({}); write 0", save));
  }
  if (r.integer({51, 60}, "Frame_ID") != 0) {
    r.warning("model.left_out", {51, 60}, "Frame_ID", "frames are not supported; the section is left out (give three nodes)");
    return r.leave_rest();
  }
  if (!old_layout(c)) r.next_card();  // file name
  r.next_card();
  const auto members = [&](const Tables::Map& table, const std::vector<IndexGroup>& groups, deck::Columns columns, std::string_view field,
                           std::string_view what) {
    const Index group = r.resolve(table, r.integer(columns, field), what, columns, field);
    return group == no_index ? std::vector<Index>{} : groups[static_cast<std::size_t>(group)].members;
  };
  s.bricks = members(c.tables.brick_groups, c.brick_groups, {1, 10}, "grbric_ID", "/GRBRIC");
  const std::size_t solids = s.bricks.size();  // the group counts tetrahedra after the bricks
  std::erase_if(s.bricks, [&](Index k) { return k >= c.model->bricks.size(); });
  if (s.bricks.size() < solids) {
    r.warning("model.left_out", {1, 10}, "grbric_ID", "tetrahedra do not count in the forces of a section; cut through bricks or shells");
  }
  s.shells = members(c.tables.shell_groups, c.shell_groups, {21, 30}, "grshel_ID", "/GRSHEL");
  s.sh3ns = members(c.tables.sh3n_groups, c.sh3n_groups, {61, 70}, "grsh3n_ID", "/GRSH3N");
  if (solids == 0 && s.shells.empty() && s.sh3ns.empty()) {
    r.warning("model.empty_set", {1, 70}, "grbric_ID, grshel_ID, grsh3n_ID",
              fmt::format("this section holds no element, and its force is zero; name the elements on one side of its nodes{}",
                          old_layout(c) ? "" : " (on the card after the file name, which has a line of its own even if blank)"));
  }
  const Id interfaces = r.integer({71, 80}, "Niter");
  s.iframe = static_cast<int>(r.integer({91, 100}, "Iframe"));
  if (interfaces > 0) {
    r.warning(
        "model.left_out", {71, 80}, "Niter",
        fmt::format("forces of interfaces do not count in those of section {}; add the force of each by /TH/INTER, or write 0", s.id));
    for (const Id id : r.id_list("inter_ID")) {
      const Index i = r.resolve(c.tables.interfaces, id, "/INTER", {1, 100}, "inter_ID");
      if (i != no_index) s.interfaces.push_back(i);
    }
  }
  c.model->sections.push_back(std::move(s));
}

void read_accelerometer(Context& c, const deck::Block& block) {
  BlockReader r(c, block, 1, true);
  r.next_card();
  Accelerometer a;
  a.id = r.id();
  const Id node = r.integer({1, 10}, "node_ID");
  if (node == 0) r.error("model.missing_reference", {1, 10}, "node_ID", "no node is given; write the id of a /NODE");
  a.node = r.resolve(c.tables.nodes, node, "/NODE", {1, 10}, "node_ID");
  a.skew = read_skew(r, {11, 20}, "skew_ID");
  const deck::Columns cut_off = old_layout(c) ? deck::Columns{35, 54} : deck::Columns{31, 50};  // 27-42 of the old card
  a.cut_off = r.real(cut_off, "Fcut", dim::rate);
  if (a.cut_off < 0.0) r.error("model.out_of_range", cut_off, "Fcut", "a cut-off frequency is positive, or 0 for none");
  if (a.node != no_index) c.model->accelerometers.push_back(a);
}

/// A line of /TH belongs to the names as long as its first field is not an integer; a blank first line asks for DEF.
int variable_lines(const Context& c, const deck::Block& block) {
  const bool old = old_layout(c);
  const deck::Columns first = old ? deck::Columns{1, 8} : deck::Columns{1, 10};
  std::size_t i = old ? 0 : 1;
  int lines = 0;
  for (; i < block.cards.size(); ++i, ++lines) {
    const std::string_view text = deck::field_text(block.cards[i].text, first);
    const bool is_name = text.empty() || !deck::parse_integer(text);
    if (!is_name || (lines > 0 && (text.empty() || block.cards[i].file != block.file))) break;
  }
  return lines;
}

class HistoryReader {
 public:
  explicit HistoryReader(Context& c) : c_(c) {}

  void read(const deck::Block& block) {
    const std::optional<ThKind> kind = th_kind(block.word(1));
    if (!kind) {
      c_.diagnostics->warning("model.left_out", c_.deck->place(block),
                              fmt::format("time history of '{}' is not supported; it is left out", block.word(1)));
      return;
    }
    BlockReader r(c_, block, 2, true);
    const std::set<std::string> variables = read_variables(r, *kind, variable_lines(c_, block));
    switch (*kind) {
      case ThKind::node:
      case ThKind::shell:
      case ThKind::sh3n:
      case ThKind::brick:
        return read_lines(r, *kind, variables);
      default:
        for (const Id id : r.id_list("object")) add(r, *kind, id, no_index, {}, variables);
    }
  }

  /// Requests by kind and id, those of one object in the order of the deck, each variable once, in the order of its table.
  void finish() {
    for (auto& [key, requests] : requests_) {
      for (auto& [request, variables] : requests) {
        for (const std::string& name : th_variables(request.kind)) {
          if (variables.contains(name)) request.variables.push_back(name);
        }
        c_.model->th_requests.push_back(std::move(request));
      }
    }
  }

 private:
  std::set<std::string> read_variables(BlockReader& r, ThKind kind, int lines) {
    std::set<std::string> variables;
    bool any = false;
    for (int line = 0; line < lines; ++line) {
      r.next_card();
      for (int i = 0; i < 10; ++i) {
        const deck::Columns columns{10 * i + 1, 10 * i + 10};
        const std::string_view name = r.text(columns, "var");
        if (name.empty()) continue;
        any = true;
        const std::vector<std::string> expanded = th_expand(kind, name);
        variables.insert(expanded.begin(), expanded.end());
        if (expanded.empty()) {
          r.warning("model.unknown_variable", columns, "var",
                    fmt::format("'{}' is not a variable of /TH/{}; it is left out ({})", name, th_word(kind),
                                name.find(' ') == std::string::npos ? "DEF asks for the usual ones" : "each name has a field of its own"));
        }
      }
      r.surplus_text("var");
    }
    if (!any) {
      const std::vector<std::string> expanded = th_expand(kind, "DEF");
      variables.insert(expanded.begin(), expanded.end());
    }
    return variables;
  }

  /// The column of the skew may name a /FRAME (F.1), which has ids of its own.
  bool names_frame(BlockReader& r) const {
    const Id id = r.integer({11, 20}, "skew_ID");
    if (id == 0 || c_.tables.skews.contains(id)) return false;
    const auto is_it = [id](const deck::Block& b) { return is_keyword(b, "FRAME") && deck::parse_integer(b.word(2)) == id; };
    if (std::none_of(c_.deck->blocks.begin(), c_.deck->blocks.end(), is_it)) return false;
    r.warning("model.left_out", {11, 20}, "frame_ID",
              fmt::format("/FRAME/{} is a moving frame, which outputs cannot be given in; this node is left out (use a /SKEW, or 0)", id));
    return true;
  }

  static void warn_of_skew(BlockReader& r, ThKind kind) {
    if (deck::parse_integer(r.text({11, 20})).value_or(0) == 0) return;
    const std::string_view axes = kind == ThKind::brick ? "stresses are along the global axes" : "values are those of the element's frame";
    r.warning("model.left_out", {11, 20}, "skew_ID",
              fmt::format("the time history of /TH/{} knows no skew: {} (only nodes may have one)", th_word(kind), axes));
  }

  void read_lines(BlockReader& r, ThKind kind, const std::set<std::string>& variables) {
    while (r.next_card()) {
      if (r.place({1, 10}, "object").file != r.place().file) return r.leave_rest();  // text of an included file below the last object (H.2)
      if (!deck::parse_integer(r.text({1, 10}))) {
        r.warning("model.surplus_text", {1, 10}, "object", "this line is not an object; it and what follows is left out");
        return r.leave_rest();
      }
      const Id id = r.integer({1, 10}, "object");
      if (id == 0) continue;
      if (kind == ThKind::node && names_frame(r)) continue;
      if (kind != ThKind::node) warn_of_skew(r, kind);
      const Index skew = kind == ThKind::node ? read_skew(r, {11, 20}, "skew_ID") : no_index;
      add(r, kind, id, skew, std::string(r.text({21, 100}, "name")), variables);
    }
  }

  [[nodiscard]] const Tables::Map& table(ThKind kind) const {
    const Tables& t = c_.tables;
    switch (kind) {
      case ThKind::node:
        return t.nodes;
      case ThKind::part:
        return t.parts;
      case ThKind::shell:
        return t.shells;
      case ThKind::sh3n:
        return t.sh3ns;
      case ThKind::brick:
        return t.bricks;
      case ThKind::inter:
        return t.interfaces;
      case ThKind::rwall:
        return t.rigid_walls;
      case ThKind::rbody:
        return t.rigid_bodies;
      case ThKind::accelerometer:
        return t.accelerometers;
      default:
        return t.sections;
    }
  }

  [[nodiscard]] std::string title_of(ThKind kind, Index index) const {
    const auto k = static_cast<std::size_t>(index);
    if (kind == ThKind::part) return c_.model->parts[k].title;
    if (kind == ThKind::inter) return c_.model->interfaces[k].title;
    if (kind == ThKind::rwall) return c_.model->rigid_walls[k].title;
    return {};
  }

  void add(BlockReader& r, ThKind kind, Id id, Index skew, std::string name, const std::set<std::string>& variables) {
    ThRequest request;
    request.kind = kind;
    request.id = id;
    request.skew = skew;
    const auto found = table(kind).find(id);
    if (found == table(kind).end()) return warn_missing(r, kind, id);
    request.index = found->second;
    request.name = name.empty() ? title_of(kind, request.index) : std::move(name);
    std::vector<Asked>& asked = requests_[{kind, id}];
    auto same = std::find_if(asked.begin(), asked.end(), [skew](const Asked& a) { return a.request.skew == skew; });
    if (same == asked.end()) same = asked.insert(asked.end(), {std::move(request), {}});
    same->variables.insert(variables.begin(), variables.end());
  }

  void warn_missing(BlockReader& r, ThKind kind, Id id) {
    c_.diagnostics->warning("model.missing_output", r.place(),
                            fmt::format("there is no {} {}; its time history is left out", th_word(kind), id));
  }

  Context& c_;
  struct Asked {
    ThRequest request;
    std::set<std::string> variables;
  };
  std::map<std::pair<ThKind, Id>, std::vector<Asked>> requests_;  ///< of an object one per skew, the first one first
};

/// /TH, and /ATH to /ITH, which ask for files of their own.
bool is_history(const deck::Block& block) {
  const std::string_view word = block.word(0);
  return same_word(word, "TH") || (word.size() == 3 && word[0] >= 'A' && word[0] <= 'I' && same_word(word.substr(1), "TH"));
}

}  // namespace

void read_outputs(Context& c) {
  for (const deck::Block& block : c.deck->blocks) {
    if (is_keyword(block, "SECT")) read_section(c, block);
    if (is_keyword(block, "ACCEL")) read_accelerometer(c, block);
  }
  order_by_id(c, c.model->sections, "SECT", false);
  fill_table(c.tables.sections, c.model->sections);
  order_by_id(c, c.model->accelerometers, "ACCEL", false);
  fill_table(c.tables.accelerometers, c.model->accelerometers);
  HistoryReader histories(c);
  for (const deck::Block& block : c.deck->blocks) {
    if (is_history(block)) histories.read(block);
  }
  histories.finish();
}

}  // namespace abut::model
