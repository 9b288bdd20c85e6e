// A model: what a deck means, validated and immutable. It is read from a file, or from deck text in memory.
//
//   abut::Model model = abut::Model::read("plate_drop_0000.rad");
//   for (const abut::Diagnostic& d : model.findings()) std::puts(to_string(d).c_str());
//
// Nodes, elements, parts, ... are sorted by id. Units are the work units of the deck. Spans live as long as some copy of
// the model. A model may be used by several threads at a time: nothing changes it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "abut/contact/inspect.hpp"
#include "abut/contact/options.hpp"
#include "abut/diagnostic.hpp"
#include "abut/results.hpp"
#include "abut/types.hpp"
#include "abut/vec3.hpp"

namespace abut {

/// Size of the work units in SI (kg, m, s) and their names as the deck writes them.
struct Units {
  double mass = 1.0, length = 1.0, time = 1.0;  ///< kg, m, s per unit
  std::string mass_name = "kg", length_name = "m", time_name = "s";
};

enum class ElementKind { none, shell4, shell3, brick, tetra };

/// All elements of one kind: views of #E values.
struct ElementTable {
  ElementKind kind = ElementKind::none;
  int nodes_per_element = 0;
  std::span<const Id> id;       ///< ascending
  std::span<const Index> part;  ///< index into Model::parts()
  std::span<const Index> node;  ///< #E by nodes_per_element, row-major, node indices
  [[nodiscard]] std::size_t size() const { return id.size(); }
};

struct PartInfo {
  Id id = 0;
  std::string title;
  Id property_id = 0, material_id = 0;  ///< ids of the deck
};

struct SurfaceInfo {
  Id id = 0;
  std::string title;
  std::vector<std::array<Index, 4>> facets;  ///< node indices; a triangle repeats its third. Positive side: right-hand rule
};

struct InterfaceInfo {
  Id id = 0;
  std::string title;
  std::string type;                                         ///< "TYPE3", "TYPE5", "TYPE7"
  std::array<Index, 2> surface{no_index, no_index};         ///< first and second, indices into Model::surfaces(); no_index: a set of nodes
  std::vector<Index> nodes;                                 ///< of TYPE5 and TYPE7: the nodes that are held
  double stiffness_scale = 0.0, friction = 0.0, gap = 0.0;  ///< Stfac and Fric without a unit, Gap a length
};

/// One finding of the contact inspection in the deck's ids (docs/findings/index.md).
struct ContactFinding {
  Id interface_id = 0;
  Id surface_id = 0;  ///< 0: the interface as a whole, or its node group
  contact::Finding finding;
  std::vector<Id> nodes;                    ///< ids of finding.nodes
  std::vector<std::array<Id, 4>> segments;  ///< node ids of finding.facets
  Place place;
};

/// The two rule sets (docs/guide/profiles.md).
enum class Rules { standard, reference };

/// Settings of an interface of TYPE3 or TYPE5 that have no field on its card: contact::Options has them all. What is not set stays as the
/// rule set and the card have it.
struct InterfaceChoice {
  Id interface_id = 0;                      ///< 0: all interfaces of TYPE3 and TYPE5; a choice that names one comes before those of all
  std::optional<contact::Law> law;          ///< normal law of contacts with a gap
  std::optional<bool> automatic_gap;        ///< half of the thickness of both sides, at least the card's Gap
  std::optional<contact::Initial> initial;  ///< initial penetrations; `project` moves nodes before the masses are made
  std::optional<double> damping;            ///< fraction of critical, 0 to 1
  std::optional<double> depth_limit;        ///< length, > 0
  std::optional<double> start_duration;     ///< time, >= 0: gradual start
  bool operator==(const InterfaceChoice&) const = default;
};

/// "ID:KEY=VALUE,...", ID an interface id or "all", keys law (stiffening, constant), gap (auto, card), initial (keep, offset, project,
/// ignore), damping, depth, start. @throws RunError naming the text and what is wrong with it
[[nodiscard]] InterfaceChoice interface_choice(std::string_view text);
/// The text that interface_choice() reads, keys in the order above.
[[nodiscard]] std::string to_string(const InterfaceChoice& choice);

/// Choices of the mechanics that a deck does not make.
struct Choices {
  Rules rules = Rules::standard;
  std::vector<InterfaceChoice> interfaces;  ///< of two that set the same thing of the same interface the later one counts
};

/// What can be said of a model before it runs.
struct Inspection {
  std::vector<ContactFinding> contact;  ///< worst first for each interface
  std::vector<double> part_mass;        ///< #parts, order of Model::parts()
  double first_step = 0.0;              ///< time; 0: not asked for, or interfaces have errors and cannot be built
  StepController controller;            ///< of the first step
};

struct ReadOptions {
  bool orient = false;               ///< turn the segments of contact surfaces to face each other where that is unambiguous
  std::filesystem::path write_deck;  ///< with orient: the Starter deck with the turned surfaces goes to this file
  int run = 1;                       ///< Engine decks 1 to `run` are read, each changes what its cards say; 0: all there are
};

/// Text of a deck in memory.
struct DeckText {
  std::string starter;               ///< what NAME_0000.rad would hold; #include is an error
  std::vector<std::string> engines;  ///< NAME_0001.rad, NAME_0002.rad, ...
  std::string name = "deck";         ///< messages call the texts name_0000.rad, name_0001.rad, ...
};

class Model {
 public:
  /// Reads NAME_0000.rad and the Engine decks beside it.
  /// @throws InputError with every finding when there is an error: a file that cannot be read is one; RunError when write_deck cannot be
  ///         written, is one of the deck's own files, is asked for without orient, or the deck's form does not let it
  [[nodiscard]] static Model read(const std::filesystem::path& starter, const ReadOptions& options = {});
  /// The same from text in memory: the same validation, the same messages.
  /// @throws InputError as read(); RunError when write_deck is asked for
  [[nodiscard]] static Model from_text(const DeckText& text, const ReadOptions& options = {});

  [[nodiscard]] const std::string& name() const;               ///< NAME of NAME_0000.rad
  [[nodiscard]] const std::string& title() const;              ///< of the deck
  [[nodiscard]] const Units& units() const;                    ///< of everything that a model or its run gives
  [[nodiscard]] double end_time() const;                       ///< time at which the Engine deck ends the run
  [[nodiscard]] int run_number() const;                        ///< n of /RUN/name/n that this model's controls are of
  [[nodiscard]] int last_run_number() const;                   ///< of the last Engine deck that there is
  [[nodiscard]] const std::filesystem::path& path() const;     ///< of the Starter deck; empty: from text
  [[nodiscard]] std::span<const std::string> files() const;    ///< all decks and includes
  [[nodiscard]] std::span<const Diagnostic> findings() const;  ///< warnings and notes of reading
  /// Hash over the text of the Starter deck, its includes and the options that change the model: a restart checks it.
  [[nodiscard]] std::uint64_t fingerprint() const;

  [[nodiscard]] std::span<const Id> node_ids() const;               ///< #N, ascending
  [[nodiscard]] std::span<const Vec3> coordinates() const;          ///< #N by 3 lengths
  [[nodiscard]] ElementTable elements(ElementKind kind) const;      ///< an empty table when there are none of this kind
  [[nodiscard]] std::size_t element_count() const;                  ///< of all kinds
  [[nodiscard]] std::span<const PartInfo> parts() const;            ///< by id
  [[nodiscard]] std::span<const SurfaceInfo> surfaces() const;      ///< by id
  [[nodiscard]] std::span<const InterfaceInfo> interfaces() const;  ///< by id

  /// Looks at the contacts with the masses, velocities and step of the first cycle.
  /// @param with_step  the first step too: the interfaces are built for it
  /// @throws RunError when a choice is of an interface that is not there or cannot have it, or out of range
  [[nodiscard]] Inspection inspect(const Choices& choices = {}, bool with_step = false) const;

  struct Impl;
  [[nodiscard]] const Impl& impl() const { return *impl_; }                                           ///< internal
  [[nodiscard]] static Model of(std::shared_ptr<const Impl> impl) { return Model(std::move(impl)); }  ///< internal

 private:
  explicit Model(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// One line for people: what was found, the first 20 ids, what to do, the code.
[[nodiscard]] Diagnostic to_diagnostic(const ContactFinding& finding);

}  // namespace abut
