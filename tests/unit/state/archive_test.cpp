// Archive and checkpoint frame: what is written is read back to the bit; whatever is not whole, or not what the owner expects, is
// refused with the part that it was found in.
#include "state/archive.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "state/checkpoint.hpp"

namespace abut::state {
namespace {

using Bytes = std::vector<std::byte>;

/// One member of every kind that an owner of state may have.
struct Owner {
  struct Record {
    double value = 0.0;
    std::vector<std::int32_t> list;
  };
  double number = 0.0;
  std::int64_t cycle = 0;
  bool flag = false;
  Vec3 point;
  std::string name;
  std::array<double, 3> triple{};
  std::vector<double> known = std::vector<double>(5);
  std::vector<Vec3> grown;
  std::vector<Record> records = std::vector<Record>(2);
  std::vector<Record> more;

  void persist(Archive& a) {
    a.section("numbers", [&] {
      a(number);
      a(cycle);
      a(flag);
      a(point);
      a(name);
      a(triple);
    });
    a.section("arrays", [&] {
      a.fixed(known);
      a.growing(grown);
    });
    a.section("records", [&] {
      const auto record = [&a](Record& r) {
        a(r.value);
        a.growing(r.list);
      };
      a.each(records, record);
      a.each_growing(more, record);
    });
  }
};

Owner filled() {
  Owner o;
  o.number = std::nextafter(1.0, 2.0);
  o.cycle = -(std::int64_t{1} << 40);
  o.flag = true;
  o.point = {-0.0, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::infinity()};
  o.name = std::string("a name with a \0 inside", 22);
  o.triple = {1.0, 2.0, std::nan("7")};
  o.known = {1, 2, 3, 4, 5};
  o.grown = {{1, 2, 3}, {4, 5, 6}};
  o.records[0] = {0.5, {1, 2, 3}};
  o.more = {{1.5, {}}, {2.5, {7}}, {3.5, {8, 9}}};
  return o;
}

Bytes written(Owner& owner) {
  Archive a;
  owner.persist(a);
  a.finish();
  return {a.bytes().begin(), a.bytes().end()};
}

/// Message of the error, "" when there was none.
std::string refused(const std::function<void()>& body) {
  try {
    body();
  } catch (const ArchiveError& error) { return error.what(); }
  return "";
}

std::string refused_by_owner(const Bytes& bytes, Owner owner = {}) {
  return refused([&] {
    Archive a{std::span<const std::byte>(bytes)};
    owner.persist(a);
    a.finish();
  });
}

TEST(Archive, ReadsBackEveryBit) {
  Owner one = filled(), other;
  const Bytes bytes = written(one);
  Archive a{std::span<const std::byte>(bytes)};
  EXPECT_TRUE(a.loading());
  other.persist(a);
  a.finish();
  EXPECT_EQ(written(other), bytes) << "written again";
  EXPECT_EQ(other.number, one.number);
  EXPECT_EQ(other.cycle, one.cycle);
  EXPECT_TRUE(other.flag);
  EXPECT_TRUE(std::signbit(other.point.x));
  EXPECT_EQ(other.name, one.name);
  EXPECT_EQ(std::memcmp(&other.triple, &one.triple, sizeof one.triple), 0);
  EXPECT_EQ(other.known, one.known);
  ASSERT_EQ(other.grown.size(), 2U);
  EXPECT_EQ(other.grown[1], one.grown[1]);
  ASSERT_EQ(other.more.size(), 3U);
  EXPECT_EQ(other.more[2].list, one.more[2].list);
}

// Handed on in pieces, the bytes are those of an archive that keeps them; each piece but the last is whole words.
TEST(Archive, HandsOnTheSameBytesInPieces) {
  Owner owner = filled();
  owner.name.resize(13);  // not a multiple of a word
  owner.grown.assign(150000, {0.1, 0.2, 0.3});
  const Bytes whole = written(owner);
  Bytes joined;
  std::vector<std::size_t> sizes;
  Archive a([&](std::span<const std::byte> piece) {
    joined.insert(joined.end(), piece.begin(), piece.end());
    sizes.push_back(piece.size());
  });
  owner.persist(a);
  EXPECT_LT(joined.size(), whole.size()) << "the rest is handed on by finish()";
  a.finish();
  EXPECT_EQ(joined, whole);
  EXPECT_TRUE(a.bytes().empty());
  ASSERT_GT(sizes.size(), 2U);
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) EXPECT_EQ(sizes[i] % 8, 0U);
}

TEST(Archive, EveryTruncationIsRefused) {
  Owner owner = filled();
  const Bytes bytes = written(owner);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_NE(refused_by_owner(Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length))), "") << length;
  }
  EXPECT_EQ(refused_by_owner(bytes), "");
  Bytes longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_EQ(refused_by_owner(longer), "the checkpoint is damaged: it goes on after its end");
}

TEST(Archive, LengthsThatTheOwnerDoesNotExpectAreRefused) {
  Owner owner = filled();
  const Bytes bytes = written(owner);
  Owner other;
  other.known.resize(6);
  EXPECT_EQ(refused_by_owner(bytes, other), "the checkpoint does not fit the model: part 'arrays' has 5 values where 6 are expected");
  other = {};
  other.records.resize(3);
  EXPECT_EQ(refused_by_owner(bytes, other), "the checkpoint does not fit the model: part 'records' has 2 values where 3 are expected");
}

// A length of the file itself is compared with what is left before anything is allocated for it.
TEST(Archive, HugeLengthsAreRefusedBeforeTheyAreTaken) {
  for (const std::uint64_t length : {std::uint64_t{4}, std::uint64_t{1} << 40, ~std::uint64_t{0}}) {
    Bytes bytes(8 + 3 * sizeof(double));
    std::memcpy(bytes.data(), &length, sizeof length);
    std::vector<double> values;
    EXPECT_EQ(refused([&] {
                Archive a{std::span<const std::byte>(bytes)};
                a.growing(values);
              }),
              "the checkpoint is damaged (in part 'archive')")
        << length;
    EXPECT_LE(values.capacity(), 3U) << length;
  }
}

TEST(Archive, FlagsAndPartsAreChecked) {
  bool flag = true;
  Archive out;
  out.section("flags", [&] { out(flag); });
  Bytes bytes(out.bytes().begin(), out.bytes().end());
  const auto read = [&](const char* tag, auto value) {
    return refused([&] {
      Archive a{std::span<const std::byte>(bytes)};
      a.section(tag, [&] { a(value); });
    });
  };
  EXPECT_EQ(read("flags", false), "");
  EXPECT_EQ(read("others", false), "the checkpoint is damaged: part 'others' is missing");
  EXPECT_EQ(read("flags", std::array<bool, 2>{}), "the checkpoint ends too early (in part 'flags')");
  bytes.resize(bytes.size() + 8);
  EXPECT_EQ(read("flags", std::array<bool, 2>{}), "the checkpoint does not fit the model (part 'flags' has another length)");
  bytes[8] = std::byte{2};
  EXPECT_EQ(read("flags", false), "the checkpoint is damaged (in part 'flags')");
}

/// Arrays of zeros take a byte; what only looks like zero is kept, and what was there before goes.
TEST(Archive, ArraysOfZerosTakeNoRoom) {
  constexpr std::size_t count = 3000;
  const auto size_of = [](std::vector<double> values, std::vector<double>& back) {
    Archive out;
    out.fixed_or_zero(std::span(values));
    const Bytes bytes(out.bytes().begin(), out.bytes().end());
    Archive in{std::span<const std::byte>(bytes)};
    in.fixed_or_zero(std::span(back));
    in.finish();
    return bytes.size();
  };
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
  };
  const std::vector<double> zeros(count, 0.0);
  std::vector<double> back(count, 3.0);
  EXPECT_LT(size_of(zeros, back), 16u);
  EXPECT_TRUE(same(back, zeros));
  for (const std::size_t at : {std::size_t{0}, std::size_t{511}, std::size_t{512}, count - 1}) {
    for (const double value : {1.0, -0.0, std::numeric_limits<double>::denorm_min()}) {
      std::vector<double> one = zeros;
      one[at] = value;
      EXPECT_GT(size_of(one, back), count * sizeof(double));
      EXPECT_TRUE(same(back, one)) << at << " " << value;
    }
  }
}

/// A file with this content, handed over in pieces of some words.
Bytes sealed(const Bytes& content, std::size_t piece) {
  Bytes file;
  Sealer sealer([&](std::span<const std::byte> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
  for (std::size_t i = 0; i < content.size(); i += piece) {
    sealer.add(std::span(content).subspan(i, std::min(piece, content.size() - i)));
  }
  sealer.finish();
  return file;
}

Bytes counted(std::size_t size) {
  Bytes content(size);
  for (std::size_t i = 0; i < size; ++i) content[i] = static_cast<std::byte>(i * 37 + 11);
  return content;
}

TEST(Checkpoint, ContentComesBackWhateverItsLengthAndPieces) {
  for (const std::size_t size : {0UL, 1UL, 7UL, 8UL, 9UL, 64UL, 1001UL}) {
    const Bytes content = counted(size), file = sealed(content, 8);
    EXPECT_EQ(file.size(), size + 32);
    for (const std::size_t piece : {24UL, 40UL, 64UL, 1UL << 12})
      EXPECT_EQ(sealed(content, piece), file) << "the pieces leave no trace, " << size;
    const auto back = unseal(file);
    EXPECT_TRUE(std::equal(back.begin(), back.end(), content.begin(), content.end())) << size;
  }
}

// No bit can change and no byte can be missing or added without a refusal.
TEST(Checkpoint, EveryFlippedBitAndEveryOtherLengthIsRefused) {
  const Bytes file = sealed(counted(45), 8);
  for (std::size_t i = 0; i < file.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      Bytes bad = file;
      bad[i] ^= static_cast<std::byte>(1U << bit);
      EXPECT_NE(refused([&] { static_cast<void>(unseal(bad)); }), "") << "byte " << i << " bit " << bit;
    }
  }
  for (std::size_t length = 0; length < file.size(); ++length) {
    EXPECT_NE(refused([&] { static_cast<void>(unseal(std::span(file).first(length))); }), "") << length;
  }
  Bytes longer = file;
  longer.push_back(std::byte{0});
  EXPECT_NE(refused([&] { static_cast<void>(unseal(longer)); }), "");
}

TEST(Checkpoint, SaysWhatIsWrong) {
  const Bytes file = sealed(counted(40), 8);
  const auto message = [](Bytes bytes, std::size_t at, unsigned char flip) {
    bytes[at] ^= std::byte{flip};
    return refused([&] { static_cast<void>(unseal(bytes)); });
  };
  EXPECT_EQ(message(file, 0, 1), "it is not a checkpoint of abut");
  EXPECT_EQ(message(file, 8, 1), "it has checkpoint format " + std::to_string(checkpoint_format ^ 1U) + ", this abut reads format " +
                                     std::to_string(checkpoint_format));
  EXPECT_EQ(message(file, 20, 1), "it is damaged: its checksum is wrong");
  EXPECT_EQ(refused([&] { static_cast<void>(unseal(std::span(file).first(20))); }), "it was cut off");
  EXPECT_EQ(refused([&] { static_cast<void>(unseal(std::span(file).first(file.size() - 8))); }), "it was cut off");
}

}  // namespace
}  // namespace abut::state
