// Engine deck -> Model::controls (deck-format.md G). Data lines are free format; the order of keywords is free.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "deck/text.hpp"
#include "model/animation_names.hpp"
#include "model/condition_fields.hpp"
#include "model/free_format.hpp"

namespace abut::model {

namespace {

bool starts_with_any(std::string_view text, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return text.starts_with(w); });
}

class EngineReader {
 public:
  EngineReader(Context& c, const deck::Deck& engine, int run) : c_(c), engine_(engine), k_(c.model->controls), run_(run) {}

  void read() {
    // The general step first, so that the order of the deck does not decide between it and the one of a type.
    for (const deck::Block& block : engine_.blocks) {
      if (is_keyword(block, "DT") && block.word(1).empty()) read_general_step(block);
    }
    for (const deck::Block& block : engine_.blocks) {
      check_indented(block);
      if (read_block(block)) {
        check_repeated(block);
        continue;
      }
      if (refused_.empty()) first_refused_ = engine_.place(block);
      refused_.push_back(named(block));
    }
    Place place;
    place.file = engine_.files.empty() ? std::string{} : engine_.files.front();
    if (!has_run_) {
      c_.diagnostics->error("engine.missing_run", place,
                            fmt::format("the Engine deck has no /RUN/name/{} with the final time on the line below", run_));
    }
    if (has_run_ && run_ == 1 && k_.history_interval == infinity && k_.animation_interval == infinity) {
      c_.diagnostics->note("engine.few_outputs", place,
                           "neither /TFILE nor /ANIM/DT gives an interval: the time history has the row of the start, and there is no "
                           "animation");
    }
    if (!refused_.empty()) {
      c_.diagnostics->error(
          "engine.unsupported", first_refused_,
          fmt::format("these keywords are not supported, and without them the result would be wrong: {}; take them out to run without",
                      fmt::join(refused_, ", ")));
    }
    if (!left_out_.empty()) {
      c_.diagnostics->warning(
          "engine.left_out", first_left_out_,
          fmt::format("abut does not compute these fields of the animation; they are left out: {}", fmt::join(left_out_, ", ")));
    }
    if (!skipped_.empty()) {
      c_.diagnostics->note("engine.skipped", place,
                           fmt::format("these keywords do not change the mechanics and are skipped: {}", fmt::join(skipped_, ", ")));
    }
  }

 private:
  void check_indented(const deck::Block& block) {
    if (is_keyword(block, "TITLE")) return;
    for (const deck::Card& card : block.cards) {
      const std::string_view text = deck::trimmed(card.text);
      if (!text.starts_with('/')) continue;
      c_.diagnostics->error(
          "deck.indented_keyword", engine_.place(block, card),
          fmt::format("'{}' does not begin in column 1 and would be taken for data; take out the blanks before it", deck::printable(text)));
      return;
    }
  }

  /// Settings of which the last counts: two of them are rarely meant.
  void check_repeated(const deck::Block& block) {
    static const std::set<std::string> settings{"RUN", "TFILE", "PRINT", "RFILE", "STOP", "DT", "DTIX", "ANIM"};
    std::string setting = deck::to_upper(block.word(0));
    if (!settings.contains(setting)) return;
    const bool has_kinds = setting == "DT" || setting == "ANIM" || (setting == "TFILE" && !is_id(block.word(1)));
    if (has_kinds && !block.word(1).empty()) setting += "/" + deck::to_upper(block.word(1));
    if (setting.starts_with("ANIM") && setting != "ANIM/DT") return;
    const auto [first, inserted] = line_of_.emplace(setting, block.line);
    if (inserted) return;
    c_.diagnostics->warning(
        "engine.repeated", engine_.place(block),
        fmt::format("a second /{} (the first is in line {}): the last one counts, keep one of them", setting, first->second));
  }

  static std::string joined(const deck::Block& block) { return fmt::format("{}", fmt::join(block.words, "/")); }

  /// "/KEREL (line 5)"
  std::string named(const deck::Block& block) const { return fmt::format("/{} (line {})", joined(block), engine_.place(block).line); }

  FreeFormat data(const deck::Block& block) { return {engine_, block, *c_.diagnostics}; }

  /// A keyword without lines of its own: those below it are warned of.
  bool no_data(const deck::Block& block) {
    (void)data(block);
    return true;
  }

  static double scale_or_default(double scale) { return scale == 0.0 ? 0.9 : scale; }

  double scale(FreeFormat& d) {
    const double s = scale_or_default(d.positive(0, "Tsca"));
    constexpr double largest = 1.5;
    if (s > largest) {
      d.bad(0, "Tsca",
            fmt::format("{} is far above 1, and the step would be beyond the stable one; write 0.9 or another value below 1", s));
    } else if (s > 1.0) {
      d.bad(0, "Tsca", fmt::format("{} is above 1; the step may be beyond the stable one, 0.9 is usual", s), Severity::warning);
    }
    return s;
  }

  void read_general_step(const deck::Block& block) {
    FreeFormat d = data(block);
    const double s = scale(d);
    const double minimum = d.positive(1, "Tmin");
    using Action = StepControl::Action;
    for (StepControl* control : {&k_.brick, &k_.tetra, &k_.shell, &k_.sh3n}) {
      if (control->own) continue;  // in an earlier run
      const bool solid = control == &k_.brick || control == &k_.tetra;
      *control = {s, minimum, minimum > 0.0 ? (solid ? Action::stop : Action::remove) : Action::none};
    }
    if (!k_.nodal_step) k_.nodal_scale = s;
    if (!k_.contact_scale_given) k_.contact_scale = s;
  }

  /// true: the block is understood, or may be skipped.
  bool read_block(const deck::Block& block) {
    const std::string word = deck::to_upper(block.word(0));
    if (word == "RUN") return read_run(block);
    if (word == "TFILE") return read_history(block);
    if (word == "PRINT") return read_print(block);
    if (word == "RFILE") return read_restart(block);
    if (word == "STOP" || word == "KILL") return read_stop(block);
    if (word == "DT") return read_step(block);
    if (word == "DTIX") return read_step_limits(block);
    if (word == "ANIM") return read_animation(block);
    if (word == "RBODY") return read_rigid_bodies(block);
    if (word == "TITLE" || word == "END") return true;
    if (word == "VERS" || word == "MON" || word == "PARITH") return no_data(block);
    if (is_output_file(word) ||
        starts_with_any(word, {"PROC", "DEBUG", "CHECKPOINT", "THREAD", "NOISE", "OUTP", "STATE", "DYNAIN", "ABF", "H3D", "IOFLAG"}) ||
        (word == "TH" && (same_word(block.word(1), "VERS") || same_word(block.word(1), "TITLE")))) {
      skipped_.insert("/" + word);
      return true;
    }
    return false;
  }

  /// /ATFILE to /ITFILE and /@TFILE: time history in files of their own.
  static bool is_output_file(std::string_view word) { return word.size() == 6 && word.substr(1) == "TFILE"; }

  bool read_run(const deck::Block& block) {
    has_run_ = true;
    const std::string name = std::exchange(k_.run_name, std::string(block.word(1)));
    if (run_ > 1 && !same_word(k_.run_name, name)) {
      c_.diagnostics->error(
          "engine.bad_run", engine_.place(block),
          fmt::format("'{}' is another run than '{}', which this one continues; write /RUN/{}/{}", k_.run_name, name, name, run_));
    }
    if (!block.word(2).empty() || run_ > 1) {
      const auto number = deck::parse_integer(block.word(2));
      if (!number || *number != run_) {
        c_.diagnostics->error(
            "engine.bad_run", engine_.place(block),
            fmt::format("'{}' is not run {}, which this file is of by its name; write /RUN/{}/{}", block.word(2), run_, k_.run_name, run_));
      }
    }
    const double before = k_.t_end;
    k_.run_number = run_;
    FreeFormat d = data(block);
    if (d.empty()) {
      c_.diagnostics->error("engine.missing_time", engine_.place(block), "the final time is missing; write it on the line below /RUN");
      return true;
    }
    const int errors = c_.diagnostics->error_count();
    k_.t_end = d.real(0, "Tstop");
    if (k_.t_end <= 0.0 && c_.diagnostics->error_count() == errors)
      d.bad(0, "Tstop", fmt::format("{} is not a final time; it must be greater than 0", k_.t_end));
    if (run_ > 1 && k_.t_end <= before && c_.diagnostics->error_count() == errors)
      d.bad(0, "Tstop", fmt::format("{} is not after the final time {} of run {}, which this run continues", k_.t_end, before, run_ - 1));
    return true;
  }

  bool read_history(const deck::Block& block) {
    const std::string_view type = block.word(1);
    if (!type.empty() && !is_id(type)) {
      skipped_.insert("/" + joined(block));
      return true;
    }
    FreeFormat d = data(block);
    const double interval = d.positive(0, "dt_TH");
    k_.history_interval = interval > 0.0 ? interval : infinity;
    return true;
  }

  bool read_print(const deck::Block& block) {
    const auto every = deck::parse_integer(block.word(1));
    if (!every) {
      c_.diagnostics->warning("engine.bad_value", engine_.place(block),
                              fmt::format("'{}' is not a number of cycles; the listing has a line every 100", block.word(1)));
    } else if (*every != 0) {
      k_.print_every = static_cast<int>(std::min<Id>(std::abs(*every), 1000000000));
    }
    return no_data(block);
  }

  bool read_restart(const deck::Block& block) {
    FreeFormat d = data(block);
    const double cycles = d.positive(0, "ncycle");
    k_.restart_every = static_cast<int>(std::min(cycles, 1e9));
    return true;
  }

  bool read_stop(const deck::Block& block) {
    if (!block.word(1).empty()) return false;  // on a sensor
    FreeFormat d = data(block);
    const auto limit = [&](std::size_t k, std::string_view field) {
      const double value = d.positive(k, field);
      return value >= infinity ? 0.0 : value;
    };
    k_.stop_energy_error = limit(0, "Emax");
    k_.stop_total_mass = limit(1, "Mmax");
    k_.stop_nodal_mass = limit(2, "Nmax");
    k_.stop_positive_only = d.positive(5, "NERR_POSIT") == 1.0;  // NTH, NANIM: the last history row and the checkpoint are always there
    return true;
  }

  bool read_step(const deck::Block& block) {
    const std::string type = deck::to_upper(block.word(1));
    const std::string action = deck::to_upper(block.word(2));
    if (type.empty()) return true;  // read first
    if (type == "NODA") return read_nodal_step(block, action);
    if (type == "INTER") return read_contact_step(block, action);
    const bool solid = type == "BRICK" || type == "BRIC";
    const bool shell = type == "SHELL" || type == "SHEL";
    const bool triangle = type == "SH_3N" || type == "SH3N";
    if (type == "QUAD" || type == "TRUSS" || type == "BEAM" || type == "SPRING") {
      skipped_.insert("/" + joined(block));  // elements that abut has not
      return true;
    }
    if (!solid && !shell && !triangle) return false;
    using Action = StepControl::Action;
    static const std::map<std::string, Action> actions{
        {"STOP", Action::stop}, {"KILL", Action::stop}, {"DEL", Action::remove}, {"CST", Action::constant}};
    FreeFormat d = data(block);
    StepControl control{scale(d), d.positive(1, "Tmin"), solid ? Action::stop : Action::remove, true};
    if (!action.empty()) {
      const auto found = actions.find(action);
      if (found == actions.end()) return false;
      control.action = found->second;
    }
    if (control.minimum == 0.0) control.action = Action::none;
    if (solid && control.action == Action::constant) return false;  // solids do not change to small strain on the way
    if (!block.word(3).empty() && block.word(3) != "0" && control.action != Action::none) return false;  // criteria of shape
    if (solid) k_.brick = k_.tetra = control;
    if (shell) k_.shell = control;
    if (triangle) k_.sh3n = control;
    return true;
  }

  bool read_nodal_step(const deck::Block& block, const std::string& action) {
    const bool constant = action == "CST" || action == "CST1" || action == "CST2";
    if (!constant && !action.empty() && !is_id(action)) return false;  // STOP, SET, DEL
    FreeFormat d = data(block);
    k_.nodal_step = true;
    k_.nodal_scale = scale(d);
    const double minimum = d.positive(1, "Tmin");
    if (!constant) return true;
    k_.nodal_minimum = minimum;
    if (minimum == 0.0) {
      d.bad(0, "Tmin", "mass scaling needs the step that it shall keep: write a scale and a minimum step, e.g. 0.9 1e-6");
    }
    if (k_.t_end > 0.0 && minimum > k_.t_end) {
      d.bad(0, "Tmin", fmt::format("a minimum step of {} is longer than the whole run, which ends at {}", minimum, k_.t_end));
    }
    if (d.real(2, "Mratio") != 0.0) {
      d.bad(0, "Mratio", "a limit of the added mass is not supported: write 0; /STOP with Mmax ends a run that adds too much");
    }
    k_.mass_scaling = true;
    const std::string_view flag = block.word(3);
    if (!flag.empty() && flag != "0" && flag != "1") {
      d.bad(0, "Iflag", fmt::format("'{}' is not 0 (all nodes) or 1 (the /GRNOD of the next line)", flag));
    }
    k_.mass_scaling_nodes = flag == "1" ? std::optional(scaled_nodes(d)) : std::nullopt;
    return true;
  }

  /// The nodes of all groups from the second line on.
  std::vector<Index> scaled_nodes(FreeFormat& d) {
    std::vector<Index> nodes;
    const std::vector<Id> groups = d.integers(1, "grnd_ID");
    if (groups.empty()) {
      d.bad(1, "grnd_ID",
            "/1 scales the mass of a group of nodes only: write its /GRNOD id on the next line, or take /1 out for all nodes");
    }
    for (const Id id : groups) {
      const auto found = c_.tables.node_groups.find(id);
      if (found == c_.tables.node_groups.end()) {
        d.bad(1, "grnd_ID", fmt::format("no /GRNOD with id {}", id));
        continue;
      }
      const NodeGroup& group = c_.model->node_groups[static_cast<std::size_t>(found->second)];
      if (group.nodes.empty())
        d.bad(1, "grnd_ID", fmt::format("/GRNOD {} holds no node; name one that does, or take /1 out for all nodes", id));
      nodes.insert(nodes.end(), group.nodes.begin(), group.nodes.end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  bool read_contact_step(const deck::Block& block, const std::string& action) {
    using Action = StepControl::Action;
    static const std::map<std::string, Action> actions{{"", Action::none},        {"STOP", Action::stop},     {"DEL", Action::remove},
                                                       {"CST", Action::constant}, {"CST1", Action::constant}, {"CST2", Action::constant}};
    const auto found = actions.find(action);
    if (found == actions.end()) return false;
    FreeFormat d = data(block);
    k_.contact_scale = scale(d);
    k_.contact_scale_given = true;
    k_.contact_minimum = d.positive(1, "Tmin");
    k_.contact_action = found->second;
    return true;
  }

  bool read_step_limits(const deck::Block& block) {
    FreeFormat d = data(block);
    k_.dt_initial = d.positive(0, "dt_ini");
    const double largest = d.positive(1, "dt_max");
    k_.dt_max = largest > 0.0 ? largest : infinity;
    if (k_.dt_initial > k_.dt_max)
      d.bad(0, "dt_ini", fmt::format("the first step {} is larger than the largest one {}", k_.dt_initial, k_.dt_max));
    return true;
  }

  bool read_animation(const deck::Block& block) {
    const std::string field = animation_selection(block);
    if (field == "DT") {
      FreeFormat d = data(block);
      k_.animation_start = d.positive(0, "Tstart");
      const double interval = d.positive(1, "Tfreq");
      k_.animation_interval = interval > 0.0 ? interval : infinity;
      return true;
    }
    if (field.empty() || field == "GZIP" || field.starts_with("VERS")) return no_data(block);
    if (std::find(k_.animation_fields.begin(), k_.animation_fields.end(), field) == k_.animation_fields.end()) {
      k_.animation_fields.push_back(field);
    }
    if (!has_animation_field(field)) {
      if (left_out_.empty()) first_left_out_ = engine_.place(block);
      left_out_.push_back(named(block));
    }
    return no_data(block);
  }

  bool read_rigid_bodies(const deck::Block& block) {
    const bool on = same_word(block.word(1), "ON");
    if (!on && !same_word(block.word(1), "OFF")) return false;
    FreeFormat d = data(block);
    for (const Id id : d.integers(0, "node_ID")) {
      (on ? k_.rbody_on : k_.rbody_off).push_back(id);
      const auto node = c_.tables.nodes.find(id);
      const auto body = std::find_if(c_.model->rigid_bodies.begin(), c_.model->rigid_bodies.end(),
                                     [&](const RigidBody& b) { return node != c_.tables.nodes.end() && b.main == node->second; });
      if (body == c_.model->rigid_bodies.end()) {
        d.bad(0, "node_ID", fmt::format("node {} is not the main node of a /RBODY", id));
      } else {
        body->active = on;
      }
    }
    return true;
  }

  Context& c_;
  const deck::Deck& engine_;
  Controls& k_;
  int run_;
  bool has_run_ = false;
  std::vector<std::string> refused_;
  Place first_refused_;
  std::vector<std::string> left_out_;  ///< fields of the animation
  Place first_left_out_;
  std::map<std::string, int> line_of_;  ///< of settings
  std::set<std::string> skipped_;
};

}  // namespace

void read_engine(Context& c, const deck::Deck& engine, int run) { EngineReader(c, engine, run).read(); }

}  // namespace abut::model
