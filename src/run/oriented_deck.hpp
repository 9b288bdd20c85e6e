// Writes the Starter deck with the surfaces that --orient auto turned.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "init/contact_inspection.hpp"
#include "model/model.hpp"

namespace abut::run {

/// A copy of `starter` in which each interface of `turned` names new /SURF/SEG surfaces that hold its segments as the model has
/// them now (Irs/Irm 2: left as they are). The surfaces stand before /END, with the deck's line ends. Everything else is kept byte for
/// byte, but that a last line without an end gets one where there is no /END.
/// @param decks  the deck's files, Engine decks and includes with them: `target` is none of these
/// @throws RunError when it is, when an interface is defined in an include file or in a layout before version 50, or the file cannot be
///         written; what was there stays
void write_oriented_deck(const std::filesystem::path& starter, const std::vector<std::string>& decks, const std::filesystem::path& target,
                         const model::Model& model, const std::vector<init::TurnedSurface>& turned);

}  // namespace abut::run
