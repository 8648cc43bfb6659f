#include "parallel/bytes.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <stdexcept>
#include <string>

namespace coastmesh {

namespace {

using ByteReader = BasicByteReader<std::runtime_error>;

TEST(Bytes, FlagsComeBack) {
  for (const std::optional<bool> flag : {std::optional<bool>(), std::optional(false), std::optional(true)}) {
    ByteWriter writer;
    writer.pass(flag);
    const std::string bytes = writer.take();
    ByteReader reader(bytes, "it");
    std::optional<bool> back;
    reader.pass(back);
    EXPECT_EQ(back, flag);
    EXPECT_TRUE(reader.atEnd());
  }
}

TEST(Bytes, AFlagThatIsNeitherIsRefused) {
  ByteReader reader("\x02", "it");
  bool flag = false;
  EXPECT_THROW(reader.pass(flag), std::runtime_error);
}

TEST(Bytes, ALengthBeyondTheEndIsRefused) {
  ByteWriter writer;
  writer.pass(std::uint64_t{1'000'000'000});
  const std::string bytes = writer.take();
  ByteReader reader(bytes, "it");
  std::string text;
  EXPECT_THROW(reader.pass(text), std::runtime_error);
  EXPECT_LT(text.capacity(), 100u);
}

}  // namespace

}  // namespace coastmesh
