// Groups, surfaces and sets: evaluated on demand, each once, in any order of definition (deck-format.md C).
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "model/boxes.hpp"
#include "model/reader.hpp"
#include "model/topology.hpp"

namespace abut::model {

enum class SetFamily { grnod, grshel, grsh3n, grbric, grpart, surf, set };
inline constexpr std::size_t set_family_count = 7;

class SetReader {
 public:
  explicit SetReader(Context& c);
  void read();

 private:
  using Members = std::vector<Index>;  ///< sorted, distinct

  /// What a /SET/GENERAL holds while its clauses are worked through.
  struct Content {
    std::set<Index> nodes, removed_nodes, parts;
    std::map<Index, bool> shells, sh3ns;  ///< element -> segment reversed
    std::map<Index, bool> solids;         ///< solid -> all its faces, not only external ones
    std::vector<Segment> segments;
  };

  struct Item {
    SetFamily family = SetFamily::grnod;
    const deck::Block* block = nullptr;
    int id_word = 2;
    Id id = 0;
    std::string title;
    enum class State { unknown, in_progress, done } state = State::unknown;
    Members members;                ///< nodes, elements or parts
    std::vector<Segment> segments;  ///< surfaces and sets
    std::unique_ptr<Content> content;
    Members shells, sh3ns, solids, parts;  ///< sets
  };

  /// A list of signed ids, split.
  struct SignedIds {
    std::vector<Id> plus, minus;
  };
  struct SignedParts {
    Members plus, minus;  ///< in the order of the list
  };

  // ---- sets.cpp
  void collect();
  Item* find(SetFamily family, Id id);
  bool evaluate(Item& item);
  const Members* members(SetFamily family, Id id);
  const std::vector<Segment>* segments(Id id);
  void register_results();

  /// Warns of references to subsets that are not defined; a subset that holds itself is an error.
  void check_subsets();

  // ---- groups.cpp
  [[nodiscard]] SignedIds signed_ids(BlockReader& r, std::string_view field) const;
  void warn_missing(BlockReader& r, std::string_view what, const std::vector<Id>& missing);
  [[nodiscard]] std::optional<SignedParts> parts_of(BlockReader& r, std::string_view type, const SignedIds& ids);
  [[nodiscard]] std::vector<Index> parts_of_subset(Id subset) const;
  [[nodiscard]] bool subset_exists(Id subset) const;
  /// Members of `ids` (sorted) within the ranges of the block's cards; `offset` is added to each index.
  void add_ranges(BlockReader& r, bool triples, const std::vector<std::pair<const Ids*, Index>>& tables, Members& out);
  void append_nodes_of_part(Index part, Members& out) const;
  void append_nodes_of_element(SetFamily family, Index element, Members& out) const;
  [[nodiscard]] const Members& elements_of_part(SetFamily family, Index part) const;
  [[nodiscard]] std::span<const Index> nodes_of(SetFamily family, Index element) const;
  [[nodiscard]] Index element_count(SetFamily family) const;
  [[nodiscard]] std::optional<Index> element_index(SetFamily family, Id id) const;
  /// The elements of a family with all (or any) nodes inside.
  [[nodiscard]] Members elements_inside(SetFamily family, const std::vector<bool>& inside, bool any) const;
  template <class Append>
  Members combine_groups(BlockReader& r, SetFamily family, std::string_view what, const Append& append);
  Members combine_groups_of_solids(BlockReader& r);
  [[nodiscard]] std::vector<bool> inside_boxes(BlockReader& r);
  void evaluate_node_group(Item& item);
  void evaluate_element_group(Item& item);
  void evaluate_part_group(Item& item);

  // ---- surfaces.cpp
  void evaluate_surface(Item& item);
  void read_segments(BlockReader& r, std::vector<Segment>& out);
  std::optional<Segment> read_segment(BlockReader& r, int first_column);
  void add_shell(Index shell, bool reversed, std::vector<Segment>& out) const;
  void add_sh3n(Index sh3n, bool reversed, std::vector<Segment>& out) const;
  enum class Faces { none, external, all };
  void add_parts(BlockReader& r, const SignedParts& parts, Faces faces, std::vector<Segment>& out);
  void add_solids(const Members& solids, const Members& candidates, Faces faces, const std::vector<Segment>& shells,
                  std::vector<Segment>& out) const;
  void add_element_groups(BlockReader& r, SetFamily family, std::vector<Segment>& out);
  void add_solid_groups(BlockReader& r, bool free_faces, std::vector<Segment>& out);
  void add_box(BlockReader& r, bool any, Faces faces, std::vector<Segment>& out);

  // ---- general_sets.cpp
  void evaluate_general_set(Item& item);
  void apply_clause(BlockReader& r, std::string_view key, const std::vector<Id>& ids, Content& content);
  void finish_general_set(Item& item);

  Context& c_;
  const Model& m_;
  Boxes boxes_;
  std::deque<Item> items_;
  std::array<std::unordered_map<Id, Item*>, set_family_count> by_id_;
  std::unordered_map<Id, std::vector<Id>> subset_children_;
  std::map<Id, Place> subset_places_;  ///< of those that are defined
  std::unordered_map<Id, std::vector<Index>> subset_parts_;
  std::vector<Members> part_shells_, part_sh3ns_, part_solids_;
  std::optional<NodeElements> node_elements_;
  int depth_ = 0;
};

/// Sorts and removes repetitions.
void make_set(std::vector<Index>& members);
/// a without b; both sorted.
[[nodiscard]] std::vector<Index> difference(const std::vector<Index>& a, const std::vector<Index>& b);
/// The same face seen from the other side; a triangle keeps its repeated last node.
[[nodiscard]] std::array<Index, 4> reversed_nodes(const std::array<Index, 4>& n);
[[nodiscard]] std::string_view family_name(SetFamily family);

}  // namespace abut::model
