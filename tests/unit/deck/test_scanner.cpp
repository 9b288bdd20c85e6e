// Text -> blocks: line kinds, keyword lines, includes, one-file decks (deck-format.md A.1 to A.9); surprises of H.2 by their number.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "deck/deck.hpp"

namespace abut::deck {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> messages(const Diagnostics& d) {
  std::vector<std::string> out;
  for (const Diagnostic& item : d.all()) out.push_back(to_string(item));
  return out;
}

std::vector<std::string> card_texts(const Block& b) {
  std::vector<std::string> out;
  for (const Card& c : b.cards) out.emplace_back(c.text);
  return out;
}

/// With /END at its end where the text has none.
Deck scan(const std::string& text) {
  Diagnostics d;
  const bool ends = text.find("/END\n") != std::string::npos;
  Deck deck = read_starter_text(ends ? text : text + "\n/END\n", "t_0000.rad", d);
  EXPECT_EQ(messages(d), std::vector<std::string>{});
  return deck;
}

/// A folder that lives as long as a test.
class Folder {
 public:
  Folder()
      : path_(fs::temp_directory_path() /
              ("abut_deck_" + std::to_string(::getpid()) + "_" + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(Scanner, CommentsNeverCountAsCards) {
  const Deck deck =
      scan("#RADIOSS STARTER\n# text\n/PART/1\n#title comes\n$ old comment\nplate\n         1\n# between\n         2\n/END\n");
  ASSERT_EQ(deck.blocks.size(), 1u);
  EXPECT_EQ(card_texts(deck.blocks[0]), (std::vector<std::string>{"plate", "         1", "         2"}));
  EXPECT_EQ(deck.blocks[0].line, 3);
  EXPECT_EQ(deck.blocks[0].cards[2].line, 9);
  EXPECT_EQ(deck.header, "#RADIOSS STARTER");
}

TEST(Scanner, Surprise7DollarCommentsOutABlock) {
  const Deck deck = scan("/TH/NODE/1\nt\n$/TH/INTER/2\n$t\n/END\n");
  ASSERT_EQ(deck.blocks.size(), 1u);
  EXPECT_EQ(deck.blocks[0].cards.size(), 1u);
}

TEST(Scanner, Surprise8KeywordSpellings) {
  const Deck deck = scan("/BEGIN/\n/BEGIN/0\n/BCS/       1\n/TITLE " + std::string(140, ' ') + "\n/MAT/LAW01/ 3 / 7/\n/rbody/2\n");
  ASSERT_EQ(deck.blocks.size(), 6u);
  EXPECT_EQ(deck.blocks[0].words.size(), 1u);
  EXPECT_EQ(deck.blocks[2].name(), "/BCS/1");
  EXPECT_EQ(deck.blocks[3].name(), "/TITLE");
  EXPECT_EQ(deck.blocks[4].name(), "/MAT/LAW01/3/7");
  EXPECT_TRUE(deck.blocks[5].is(0, "RBODY"));
  EXPECT_FALSE(deck.blocks[5].is(7, "RBODY"));
}

TEST(Scanner, Surprise10BlankCardsInsideCountAndAtTheEndDoNot) {
  const Deck deck = scan("/MAT/X/1\n\n1\n   \n2\n\n \t \n\n/NODE\n\n");
  ASSERT_EQ(deck.blocks.size(), 2u);
  EXPECT_EQ(card_texts(deck.blocks[0]), (std::vector<std::string>{"", "1", "   ", "2"}));
  EXPECT_TRUE(deck.blocks[1].cards.empty());
}

TEST(Scanner, Surprise17CarriageReturnsMissingNewlineForeignBytes) {
  const Deck deck = scan("#caf\xe9\r\n/NODE\r\n         1\r\n         2\r\n/END");
  ASSERT_EQ(deck.blocks.size(), 1u);
  EXPECT_EQ(card_texts(deck.blocks[0]), (std::vector<std::string>{"         1", "         2"}));
  EXPECT_EQ(deck.blocks[0].name(), "/NODE");
}

TEST(Scanner, ByteOrderMarkIsNotText) { EXPECT_EQ(scan("\xEF\xBB\xBF/NODE\n").blocks.size(), 1u); }

TEST(Scanner, HashOrSlashNotInColumnOneIsData) {
  const Deck deck = scan("/FUNCT_PYTHON/1\nt\n  # text\n  /x\n");
  ASSERT_EQ(deck.blocks.size(), 1u);
  EXPECT_EQ(deck.blocks[0].cards.size(), 3u);
}

TEST(Scanner, Surprise6NothingAfterEndIsRead) {
  const Deck deck = scan("/NODE\n         1\n/END\n/ASSEMBLY/1\n1 2 3 garbage\n/NODE\n");
  ASSERT_EQ(deck.blocks.size(), 1u);
  EXPECT_EQ(deck.blocks[0].cards.size(), 1u);
}

TEST(Scanner, SubmodelKeepsItsSecondSlash) {
  const Deck deck = scan("//SUBMODEL/3\nt\n//ENDSUB\n");
  ASSERT_EQ(deck.blocks.size(), 2u);
  EXPECT_EQ(deck.blocks[0].word(0), "/SUBMODEL");
  EXPECT_EQ(deck.blocks[0].name(), "//SUBMODEL/3");
}

TEST(Scanner, DataBeforeTheFirstKeywordIsAWarning) {
  Diagnostics d;
  (void)read_starter_text("1 2 3\n4\n/NODE\n/END\n", "t", d);
  EXPECT_EQ(messages(d),
            std::vector<std::string>{"t:1: warning: data before the first keyword is ignored: a data line belongs below a keyword line"});
}

TEST(Scanner, TextWithoutKeywordIsAnError) {
  for (const char* text : {"", "hello\n", "#only a comment", "/END\n"}) {
    Diagnostics d;
    (void)read_starter_text(text, "t", d);
    EXPECT_TRUE(d.has_errors()) << text;
    EXPECT_EQ(messages(d).back(), "t: no keyword line (a line that starts with '/') found: this is not a Starter deck");
  }
}

TEST(Scanner, LoneSlashIsAnError) {
  Diagnostics d;
  (void)read_starter_text("/NODE\n/ /\n5\n/END\n", "t", d);
  EXPECT_EQ(messages(d), std::vector<std::string>{"t:2: a keyword line holds nothing but '/': a keyword such as /NODE is needed"});
}

TEST(Scanner, IncludeNeedsAFile) {
  Diagnostics d;
  (void)read_starter_text("/NODE\n#include x.inc\n#included is only a comment\n/END\n", "t", d);
  EXPECT_EQ(messages(d), std::vector<std::string>{"t:2: #include needs a deck that is read from a file, not from memory"});
}

TEST(Scanner, IncludeThatIsNoneIsAnError) {
  for (const char* line : {" #include m.inc", "#includem.inc", "#include", "\t#INCLUDE sub/NODES"}) {
    Diagnostics d;
    (void)read_starter_text("/NODE\n" + std::string(line) + "\n/END\n", "t", d);
    ASSERT_EQ(messages(d).size(), 1u) << line;
    EXPECT_NE(messages(d)[0].find("does not include a file: write '#include FILE' from column 1 on"), std::string::npos) << messages(d)[0];
  }
  for (const char* line : {"#included m.inc", "#includes:", "#include_me", "#includes everything."})
    scan("/NODE\n" + std::string(line) + "\n/END\n");
}

TEST(Include, Surprise2NestedPastedTextWithoutExtension) {
  const Folder folder;
  folder.write("sub/NODESD0B", "         1\n#include inner\n         3\n");
  folder.write("sub/inner", "         2\n");
  const fs::path main = folder.write("a_0000.rad", "#RADIOSS STARTER\n/NODE\n#include sub/NODESD0B   \n         4\n/END\n");
  Diagnostics d;
  const DeckPair pair = read(main, d);
  EXPECT_EQ(messages(d), std::vector<std::string>{});
  ASSERT_EQ(pair.starter.blocks.size(), 1u);
  const Block& b = pair.starter.blocks[0];
  EXPECT_EQ(card_texts(b), (std::vector<std::string>{"         1", "         2", "         3", "         4"}));
  EXPECT_EQ(pair.starter.place(b, b.cards[1]).file, (folder.path() / "sub/inner").string());
  EXPECT_EQ(pair.starter.place(b, b.cards[2]).line, 3);
  EXPECT_FALSE(pair.has_engine);
}

TEST(Include, Surprise3PlainTextIsNoCard) {
  const Folder folder;
  folder.write("notes.inc", "Notice> some words\nNotice>\nNotice> 2 more 3\n");
  const fs::path main =
      folder.write("a_0000.rad", "/TITLE\nmodel\n#include notes.inc\n/TH/BRIC/1\nt\nDEF\n         1\n#include notes.inc\n/END\n");
  Diagnostics d;
  const DeckPair pair = read(main, d);
  EXPECT_FALSE(d.has_errors());
  ASSERT_EQ(pair.starter.blocks.size(), 2u);
  EXPECT_EQ(pair.starter.blocks[0].cards.size(), 1u);
  EXPECT_EQ(pair.starter.blocks[1].cards.size(), 3u);
  EXPECT_EQ(messages(d)[0], (folder.path() / "notes.inc").string() + ": note: 3 lines of plain text in an included file are skipped");
}

// Lines of a set start with a word, too.
TEST(Include, LinesOfASetAreNoProse) {
  const Folder folder;
  folder.write("rest.inc", "# more of it\nPART               1\nALL\n");
  folder.write("notes.inc", "Notice> some words\nNotice>\nNotice> 2 more 3\n");
  const fs::path main =
      folder.write("a_0000.rad", "/SET/GENERAL/9\nset\nSHELL            100       101\n#include rest.inc\n#include notes.inc\n/END\n");
  Diagnostics d;
  const DeckPair pair = read(main, d);
  ASSERT_EQ(pair.starter.blocks.size(), 1u);
  EXPECT_EQ(card_texts(pair.starter.blocks[0]),
            (std::vector<std::string>{"set", "SHELL            100       101", "PART               1", "ALL"}));
  EXPECT_EQ(messages(d)[0], (folder.path() / "notes.inc").string() + ": note: 3 lines of plain text in an included file are skipped");
}

TEST(Include, Surprise4And5WholeDeckWithItsOwnBeginAndEnd) {
  const Folder folder;
  folder.write("dummy_0000.rad", "#RADIOSS STARTER\n/BEGIN\ndummy\n      2019\n/NODE\n         1\n#enddata\n         9\n/END\n");
  folder.write("other.inc", "/BEGIN\nx\n/PART/1\np\n/END\n/PART/2\n");
  const fs::path main =
      folder.write("a_0000.rad", "/BEGIN\nsled\n      2022\n#include dummy_0000.rad\n#include other.inc\n/NODE\n         2\n/END\n");
  Diagnostics d;
  const DeckPair pair = read(main, d);
  EXPECT_EQ(messages(d), std::vector<std::string>{});
  std::vector<std::string> names;
  for (const Block& b : pair.starter.blocks) names.push_back(b.name());
  EXPECT_EQ(names, (std::vector<std::string>{"/BEGIN", "/NODE", "/PART/1", "/NODE"}));
  EXPECT_EQ(pair.starter.blocks[0].cards.size(), 2u);
  EXPECT_EQ(pair.starter.blocks[1].cards.size(), 1u);
  ASSERT_EQ(pair.starter.inner_begins.size(), 2u);  // kept aside, to compare
  EXPECT_EQ(pair.starter.inner_begins[0].cards[1].text, "      2019");
  EXPECT_EQ(pair.starter.inner_begins[1].cards.size(), 1u);
}

TEST(Include, MissingFileNamesWhereItWasSearched) {
  const Folder folder;
  const fs::path main = folder.write("a_0000.rad", "/NODE\n#include gone.inc\n#include \n/END\n");
  Diagnostics d;
  (void)read(main, d);
  EXPECT_EQ(messages(d), (std::vector<std::string>{main.string() + ":2: included file 'gone.inc' not found or not readable; searched in '" +
                                                       folder.path().string() + "' and in the working directory",
                                                   main.string() + ":3: #include without a file name: write '#include FILE'"}));
}

TEST(Include, CycleIsReportedAndEnds) {
  const Folder folder;
  folder.write("b.inc", "/NODE\n#include a_0000.rad\n");
  const fs::path main = folder.write("a_0000.rad", "/PART/1\np\n#include b.inc\n/END\n");
  Diagnostics d;
  const DeckPair pair = read(main, d);
  ASSERT_EQ(messages(d).size(), 1u);
  EXPECT_EQ(messages(d)[0], (folder.path() / "b.inc").string() + ":2: file 'a_0000.rad' includes itself, directly or through others");
  EXPECT_EQ(pair.starter.blocks.size(), 2u);
}

TEST(Include, AFolderIsNotAFile) {
  const Folder folder;
  fs::create_directory(folder.path() / "d");
  Diagnostics d;
  (void)read(folder.write("a_0000.rad", "/NODE\n#include d\n"), d);
  EXPECT_TRUE(d.has_errors());
}

TEST(OneFile, EnginePartComesFirst) {
  const Folder folder;
  const fs::path main = folder.write("one_0000.rad", "# RADIOSS\n/RUN/one/1\n 0.5\n/END/ENGINE\n/BEGIN\none\n/NODE\n         1\n/END\n");
  folder.write("one_0001.rad", "/RUN/one/1\n99\n");
  Diagnostics d;
  const DeckPair pair = read(main, d);
  EXPECT_EQ(messages(d),
            std::vector<std::string>{main.string() + ": warning: the Engine part at the head of this file counts; 'one_0001.rad' beside "
                                                     "it is not read, take one of them away"});
  EXPECT_TRUE(pair.has_engine);
  ASSERT_EQ(pair.engine.blocks.size(), 1u);
  EXPECT_EQ(card_texts(pair.engine.blocks[0]), std::vector<std::string>{" 0.5"});
  ASSERT_EQ(pair.starter.blocks.size(), 2u);
  EXPECT_EQ(pair.starter.blocks[0].line, 5);
  EXPECT_EQ(pair.starter.blocks[1].cards[0].line, 8);
}

TEST(Engine, Surprise24BlankLinesVanishAndReadingStopsAtEnd) {
  Diagnostics d;
  const Deck deck = read_engine_text("#/PRINT/-10/55\n\n/RUN/Name/1/\n\n 0.5\n/TITLE\n\n/PRINT/ -10\n$ x\n/END\n/STOP\n", "t_0001.rad", d);
  EXPECT_EQ(messages(d), std::vector<std::string>{});
  ASSERT_EQ(deck.blocks.size(), 3u);
  EXPECT_EQ(deck.blocks[0].word(1), "Name");
  EXPECT_EQ(deck.blocks[0].words.size(), 3u);
  EXPECT_EQ(deck.blocks[0].cards.size(), 1u);
  EXPECT_TRUE(deck.blocks[1].cards.empty());
  EXPECT_EQ(deck.blocks[2].name(), "/PRINT/-10");
}

TEST(Engine, IncludeIsRefused) {
  Diagnostics d;
  (void)read_engine_text("/RUN/a/1\n1\n#include x\n", "t_0001.rad", d);
  EXPECT_EQ(messages(d), std::vector<std::string>{"t_0001.rad:3: #include is not allowed in an Engine deck"});
}

TEST(Files, EngineIsFoundBesideTheStarterDeck) {
  const Folder folder;
  folder.write("m_0001.rad", "/RUN/m/1\n1\n");
  folder.write("BARD01", "/RUN/bar/1\n1\n");
  folder.write("BARD02", "/RUN/bar/2\n1\n");
  Diagnostics d;
  EXPECT_TRUE(read(folder.write("m_0000.rad", "/NODE\n/END\n"), d).has_engine);
  EXPECT_FALSE(d.has_errors());
  EXPECT_EQ(d.warning_count(), 0);
  const DeckPair bar = read(folder.write("BARD00", "/NODE\n/END\n"), d);
  EXPECT_TRUE(bar.has_engine);
  EXPECT_EQ(bar.restarts.size(), 1u);  // run 2 goes on from it
  EXPECT_EQ(d.warning_count(), 0);
  EXPECT_FALSE(read(folder.write("other.rad", "/NODE\n"), d).has_engine);
}

TEST(Files, AnEngineDeckAfterAHoleIsNamed) {
  const Folder folder;
  for (const char* name : {"m_0001.rad", "m_0003.rad", "m_0004.rad"}) folder.write(name, "/RUN/m/1\n1\n");
  Diagnostics d;
  EXPECT_TRUE(read(folder.write("m_0000.rad", "/NODE\n/END\n"), d).restarts.empty());
  EXPECT_EQ(messages(d),
            std::vector<std::string>{(folder.path() / "m_0003.rad").string() +
                                     ": warning: this Engine deck is not read: that of run 2 before it, 'm_0002.rad', is missing"});
}

TEST(Scanner, ADeckWithoutEndMayBeCutOff) {
  for (const auto& [text, where] :
       {std::pair{"/NODE\n         1\n", ""}, std::pair{"/NODE\n         1", ", and within a line, where a number would be cut too"}}) {
    Diagnostics d;
    (void)read_starter_text(text, "t", d);
    EXPECT_EQ(messages(d), std::vector<std::string>{"t: warning: there is no /END: the file may be cut off" + std::string(where) +
                                                    "; end a whole deck with /END"});
  }
}

TEST(Files, AMissingDeckIsAnError) {
  Diagnostics d;
  const DeckPair pair = read("/nonexistent/x_0000.rad", d);
  EXPECT_TRUE(pair.starter.blocks.empty());
  EXPECT_EQ(messages(d),
            std::vector<std::string>{"/nonexistent/x_0000.rad: cannot be read: the path of a Starter deck NAME_0000.rad is needed"});
}

TEST(Files, ViewsSurviveAMoveOfTheDeck) {
  Diagnostics d;
  Deck first = read_starter_text("/NODE\n 1\n", "t", d);
  const Deck second = std::move(first);
  EXPECT_EQ(card_texts(second.blocks[0]), std::vector<std::string>{" 1"});
  EXPECT_EQ(second.blocks[0].word(0), "NODE");
}

}  // namespace
}  // namespace abut::deck
