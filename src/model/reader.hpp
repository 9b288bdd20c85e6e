// What the readers of single keywords share: units, cards of one block with typed fields, tables of ids.
#pragma once

#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/diagnostic.hpp"
#include "deck/deck.hpp"
#include "deck/fields.hpp"
#include "model/field_edges.hpp"
#include "model/model.hpp"

namespace abut::model {

/// Exponents of mass, length and time of a dimensional value (deck-format.md, conventions).
struct Dimension {
  int mass = 0, length = 0, time = 0;
};
namespace dim {
inline constexpr Dimension none{}, mass{1, 0, 0}, length{0, 1, 0}, time{0, 0, 1}, force{1, 1, -2}, pressure{1, -1, -2}, velocity{0, 1, -1},
    acceleration{0, 1, -2}, density{1, -3, 0}, stiffness{1, 0, -2}, energy{1, 2, -2}, rate{0, 0, -1}, rate2{0, 0, -2}, inertia{1, 2, 0},
    moment{1, 2, -2}, mass_per_area{1, -2, 0};
}  // namespace dim

/// Ids to indices, one table per family (A.7). Filled as the families are read; a set id appears in every table it may serve.
struct Tables {
  using Map = std::unordered_map<Id, Index>;
  Map nodes, shells, sh3ns, bricks, tetras, parts, materials, properties, functions, skews, sensors;
  Map node_groups, surfaces, interfaces, rigid_bodies, rigid_walls, sections, accelerometers;
  Map shell_groups, sh3n_groups, brick_groups, part_groups;  ///< into the lists of Context with the same names
};

/// Members of an element or part group, sorted indices. In a brick group k < #bricks is a brick, k - #bricks a tetrahedron.
struct IndexGroup {
  Id id = 0;
  std::vector<Index> members;
};

/// /DEF_SHELL and /DEF_SOLID with built-in defaults filled in (A.12).
struct ShellDefaults {
  int ishell = 1, ismstr = 2, ithick = 2, iplas = 2, ish3n = 2, idrill = 0;
};
struct SolidDefaults {
  int isolid = 1, ismstr = 4, icpre = 0, itetra4 = 1000, imas = 2, iframe = 1;
};

/// A field that a reader looked at.
struct FieldUse {
  std::size_t card = 0;  ///< counted from 1, without the title
  deck::Columns columns;
  std::string name;
};

/// State of one model build.
struct Context {
  const deck::Deck* deck = nullptr;
  Model* model = nullptr;
  Diagnostics* diagnostics = nullptr;
  Tables tables;
  std::vector<IndexGroup> shell_groups, sh3n_groups, brick_groups, part_groups;
  ShellDefaults shell_defaults;
  SolidDefaults solid_defaults;
  std::vector<Id> part_subset;                 ///< subset id of each part (0: root)
  std::vector<Place> part_subset_place;        ///< where it stands
  std::vector<bool> part_lacks_material;       ///< the card of the part names none
  Units input;                                 ///< units of the deck's values; work units are model->units
  std::unordered_map<Id, Units> local;         ///< /UNIT/id
  std::vector<FieldUse>* field_log = nullptr;  ///< receives every field that is looked at (keyword_table.hpp); usually none
  /// Blocks of a keyword by id, in the order of the deck. Filled by place_of() for the keywords that it is asked for.
  mutable std::map<std::string, std::unordered_map<Id, std::vector<const deck::Block*>>, std::less<>> blocks_by_id;

  /// Factor from the deck's value to the work unit, with the local unit system `unit_id` (0: input units of /BEGIN).
  [[nodiscard]] double factor(Dimension d, Id unit_id) const;
};

/// Walks over the cards of one block and reads typed fields; faults become diagnostics, never exceptions.
/// Columns are those of the 10/20-column layout; for versions <= 44 they are mapped to 8/16 columns here.
class BlockReader {
 public:
  /// @param has_title the keyword is followed by a title card (from version 51 on)
  /// @param id_word   which word of the keyword line holds the id (e.g. 2 for /INTER/TYPE3/1); -1: the keyword has no id
  BlockReader(Context& context, const deck::Block& block, int id_word, bool has_title);
  /// Judges the last card, and warns of lines that no card was read from, unless the block has an error.
  ~BlockReader();
  BlockReader(const BlockReader&) = delete;
  BlockReader& operator=(const BlockReader&) = delete;

  [[nodiscard]] Id id() const { return id_; }
  [[nodiscard]] Id unit_id() const { return unit_id_; }
  [[nodiscard]] const std::string& title() const { return title_; }
  [[nodiscard]] std::string keyword() const;  ///< "/INTER/TYPE3/1"

  /// The block's cards have no field right of this column; without it they end with the line.
  void last_column(int column) { last_column_ = column; }

  /// Moves to the next data card, after a look at the edges of the fields that were read from the one at hand. false: the card is missing;
  /// its fields then read as blank (A.5).
  bool next_card();
  [[nodiscard]] bool more() const;  ///< another data card follows
  void leave_rest();                ///< the cards that follow are not read, and this is said elsewhere

  [[nodiscard]] double real(deck::Columns c, std::string_view field, Dimension d = dim::none);
  [[nodiscard]] Id integer(deck::Columns c, std::string_view field);
  [[nodiscard]] std::string_view text(deck::Columns c) const;
  [[nodiscard]] std::string_view text(deck::Columns c, std::string_view field);
  [[nodiscard]] bool flag(int column, std::string_view field);  ///< one-character 0/1/blank
  /// Reports text in the other columns of a field of flags, which stand in fixed columns.
  void only_flags(deck::Columns c, std::initializer_list<int> flags, std::string_view field, std::string_view what_is_right);
  [[nodiscard]] bool blank(deck::Columns c) const { return text(c).empty(); }

  /// Ids of a list, 10 per line, to the end of the block (blank fields skipped). Stops with a warning at a line that does not parse,
  /// warns once of text right of the fields.
  [[nodiscard]] std::vector<Id> id_list(std::string_view field);

  /// Warns of text right of the ten fields of a line of a list, which is not read. @returns whether there is some
  bool surplus_text(std::string_view field);

  /// Index of `id` in `table`; reports an error ("no /FUNCT with id 7") and returns no_index when absent. 0 gives no_index silently.
  [[nodiscard]] Index resolve(const Tables::Map& table, Id id, std::string_view what, deck::Columns c, std::string_view field);

  void error(std::string_view code, deck::Columns c, std::string_view field, std::string message);
  void warning(std::string_view code, deck::Columns c, std::string_view field, std::string message);
  [[nodiscard]] Place place() const;                                         ///< of the block
  [[nodiscard]] Place place(deck::Columns c, std::string_view field) const;  ///< of a field of the current card
  Context& context() { return *context_; }

 private:
  Context* context_;
  const deck::Block* block_;
  Id id_ = 0;
  Id unit_id_ = 0;
  std::string title_;
  bool titled_ = false;  ///< the first card is the title
  int errors_before_ = 0;
  std::size_t next_ = 0;
  /// "'1 2' is not an integer", with a word on tabs where the line has some.
  [[nodiscard]] std::string not_a(std::string_view what, std::string_view text) const;

  /// Text of a field that is read as a number.
  [[nodiscard]] std::string_view number(deck::Columns c, std::string_view field);
  /// Reports numbers that cross the edge of a field.
  void leave_card();
  /// Warns, once, of a number other than 0 right of the last field.
  void number_right_of_fields();
  [[nodiscard]] deck::Columns in_layout(deck::Columns c) const;

  const deck::Card* card_ = nullptr;
  FieldEdges edges_;
  int last_column_ = 100;
  bool told_surplus_ = false;
};

// Readers by group of keywords. Each takes the blocks it knows (returns true) and leaves the others (false).
// `pass` order is fixed by build.cpp: everything that others refer to comes first (A.7: order of blocks is free).
void read_control(Context& c);     ///< /BEGIN units version title, /UNIT, /DEF_*, /ANALY, /SHFRA, /RANDOM, /IOFLAG ...
void read_mesh(Context& c);        ///< /NODE, /PART, elements, /PROP, /MAT, /FUNCT, /SKEW
void read_sets(Context& c);        ///< /GRNOD, /GRSHEL, ..., /BOX, /SUBSET, /SURF, /SET
void read_sensors(Context& c);     ///< /SENSOR
void read_conditions(Context& c);  ///< /BCS, /INIVEL, /IMP*, /CLOAD, /PLOAD, /GRAV, /ADMAS, /RBODY, /RWALL
void read_interfaces(Context& c);  ///< /INTER
void read_outputs(Context& c);     ///< /TH, /SECT, /ACCEL
/// All of them but read_control, in the order in which one refers to another.
inline void read_entities(Context& c) {
  read_mesh(c);
  read_sets(c);
  read_sensors(c);
  read_conditions(c);
  read_interfaces(c);
  read_outputs(c);
}
void read_engine(Context& c, const deck::Deck& engine, int run);  ///< Engine deck of a run -> changes of Model::controls
void check_keywords(Context& c);  ///< keywords nobody took: refused when they can change physics, else listed as skipped
[[nodiscard]] bool is_refused(const deck::Block& block);  ///< check_keywords refuses this block: readers pass over it
void check_plausibility(Context& c);                      ///< what a deck may say but rarely means (units, walls and rigid bodies)
void check_motions(Context& c);                           ///< motions and conditions that contradict each other or a rigid body
void validate(Context& c);  ///< what can only be judged with everything read (shared nodes, zero areas, masses ...)

}  // namespace abut::model
